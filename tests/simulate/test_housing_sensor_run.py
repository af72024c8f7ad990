"""An accelerometer on a housing against the outer ring that moves with it in the same run."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.interpolate import CubicSpline

from flexcage import simulate
from flexcage.case import load_case
from flexcage.core.errors import InputError
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.formats import write_body
from flexcage.spec import Accelerometer
from flexcage.system.rings.low_modes import DAMPED

MASS, STIFFNESS, ROUND = 1.5, 3e8, 2e5  # kg, N/m, N m/rad


def case(folder, *, mass=True, duration="4 ms", **sensor):
    """The seat's one node in the bearing's centre, with six coordinates."""
    body = ReducedBody(
        stiffness=np.diag([STIFFNESS] * 3 + [ROUND] * 3),
        mass=np.diag([MASS] * 3 + [2e-3] * 3) if mass else None,
        nodes=np.zeros((1, 3)),
        dofs=np.array([(0, k) for k in range(6)]),
    )
    folder.mkdir(exist_ok=True)
    path = write_body(body, folder / "housing.npz")
    foot = {"type": "accelerometer", "name": "foot", "place": "housing", "node": 1, **sensor}
    return load_case(
        {
            "bearing": {"preset": "7010C-PI"}, "cage": {"model": "rigid"},
            "mount": {"body": str(path), "mass": f"{MASS} kg"},
            "drive": {"speed": "6000 rpm"},
            "load": {"radial": "800 N", "axial": "500 N", "wave": "sine",
                     "wave_amplitude": "300 N", "wave_period": "0.7 ms"},
            "solver": {"duration": duration}, "output": {"settle": 0.7},
            "sensors": [{**foot, "direction": "10 deg"}],
        }
    )  # fmt: skip


def test_the_seat_s_node_moves_as_the_ring_did(tmp_path):
    """A housing of one mass, which the run has as mount.mass: one equation, solved by the run with
    its own steps, and here over frequencies from the recorded forces."""
    run = simulate(case(tmp_path, duration="14 ms"))
    own = np.sqrt(STIFFNESS / (MASS + run.bearing.outer_ring_mass))
    damping = 0.5 * DAMPED * run.case.outer_ring.relaxation * own
    own = Accelerometer(
        name="foot", place="housing", node=1, direction=np.pi / 18, low_pass=4e3,
        housing_damping=damping,
    )  # fmt: skip
    ring = Accelerometer(name="ring", direction=np.pi / 18, low_pass=4e3)
    found = run.signals_of([own, ring])
    foot, ring = (found[n] for n in ("foot", "ring"))
    t = foot[foot.dims[0]].values[20:-20]
    seen = CubicSpline(foot[foot.dims[0]], foot)(t)
    moved = CubicSpline(ring[ring.dims[0]], ring)(t)
    most = np.abs(moved).max()
    assert most > 100.0  # m/s^2
    np.testing.assert_allclose(seen, moved, atol=0.04 * most)


def test_what_a_housing_lacks_is_said_before_the_run(tmp_path):
    with pytest.raises(InputError, match="has no mass matrix"):
        simulate(case(tmp_path / "a", mass=False))
    with pytest.raises(InputError, match="on node 3, but .* it has 1"):
        simulate(case(tmp_path / "b", node=3))
    with pytest.raises(InputError, match="give the number of its node there"):
        case(tmp_path / "c", node=0)
