"""Cases whose rings bend, or swing on supports or in a housing."""

import numpy as np

from flexcage.case import Case
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.formats import write_body

LOADS = {"N1013": {"radial": 5000.0}, "7010C-PI": {"radial": 300.0, "axial": 500.0}}


def case_of(preset, *, loads=LOADS, speed=600.0, duration=1e-3, **changes):
    case = Case.from_preset(preset, load=loads[preset], drive={"speed": speed})
    case = case.replace("cage.model", "rigid").replace("mesh.fineness", "coarse")
    return case.replace({"solver.duration": duration, "output.rate": 20e3, **changes})


def at_rest(preset, **changes):
    return case_of(preset, **{"speed": 0.0, "load.gravity": 0.0, **changes})


def housing_file(folder, *, along, coupled):
    """A housing as one node in the bearing's centre, softer along y than along z: its stiffness
    ``along`` the axis, and ``coupled`` with the tilt about z."""
    stiffness = np.diag([along, 2e8, 4e8, 1e6, 4e5, 6e5])
    stiffness[0, 5] = stiffness[5, 0] = coupled
    dofs = np.array([(0, k) for k in range(6)])
    body = ReducedBody(stiffness=stiffness, mass=np.eye(6), nodes=np.zeros((1, 3)), dofs=dofs)
    return str(write_body(body, folder / "housing.npz"))


def soft(*sides, **more):
    """Keys of rings on soft foundations."""
    keys = {"ring": "flexible", "seat": "foundation", "foundation": 3e10}
    return {f"{side}_ring.{key}": value for side in sides for key, value in keys.items()} | more
