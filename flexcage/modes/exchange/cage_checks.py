"""Does a body from elsewhere fit the cage of the case? Nodes, mass, inertia, units by magnitude."""

from __future__ import annotations

import numpy as np
from scipy.spatial import cKDTree

from flexcage.core.errors import InputError
from flexcage.fem.model import FEModel
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.systems import SYSTEMS, nearest_system, system_of

WHERE = "modes.body"
_SIZE = (
    0.05  # share by which the largest distance from the axis may differ: nodes are compared then
)
_NODE_TOLERANCE = 1e-4  # of the cage's radius: GRID fields have eight characters
_LUMPED = 0.5  # share by which the mass of single modes may differ: lumped masses of coarse meshes
_MASS = 0.02  # share by which mass, inertia and the best of the modal masses may differ


def match_nodes(body: ReducedBody, model: FEModel, units: str) -> np.ndarray:
    """Node of the body (N,) at every node of the model; InputError where there is none."""
    radius, own = (float(np.hypot(*p[:, 1:].T).max()) for p in (model.nodes, body.nodes))
    if abs(own / radius - 1.0) > _SIZE:
        unit = nearest_system(SYSTEMS[units].length * radius / own)
        known = unit and unit != units
        remedy = f'set {WHERE}_units = "{unit}"' if known else "write them in the bearing's frame"
        raise InputError(
            f"{body.source}: its nodes reach {1e3 * own:.4g} mm from the x axis if they are in "
            f"{units}, and those of the cage {1e3 * radius:.4g} mm; {remedy}.",
            where=f"{WHERE}_units",
            value=own,
        )
    distance, found = cKDTree(body.nodes).query(model.nodes)
    missed = distance > _NODE_TOLERANCE * radius
    if missed.any():
        raise InputError(
            f"{body.source} has {len(body.nodes):,} nodes, but none within "
            f"{1e6 * _NODE_TOLERANCE * radius:.2g} um of {int(missed.sum()):,} of the "
            f"{len(model.nodes):,} nodes of the cage's mesh; name its own mesh as mesh.file, "
            "with mesh.order as its elements are, and write the shapes of all its nodes.",
            where=WHERE,
            value=int(missed.sum()),
        )
    return found


def check_mass(body: ReducedBody, model: FEModel, units: str) -> None:
    """Refuse a body whose mass or inertia about the axes is not that of the mesh.

    Both are those of its rigid motions, about the origin; without them nothing is known.
    """
    if body.rigid is None or body.mass is None:
        return
    own = np.diag(np.asarray(body.rigid.T @ (body.mass @ body.rigid)))
    second = model.nodes.T @ (model.mass_scalar @ model.nodes)
    wanted = np.concatenate([[model.mass] * 3, np.trace(second) - np.diag(second)])
    off = np.abs(own / wanted - 1.0) > _MASS
    if not off.any():
        return
    k = int(np.argmax(off))  # mass before inertia
    what = f"inertia about {'xyz'[k - 3]}" if k > 2 else "mass"
    unit = "kg m^2" if k > 2 else "kg"
    raise InputError(
        f"{body.source}: its {what} is {own[k]:.4g} {unit}, that of the cage's mesh "
        f"{wanted[k]:.4g} {unit}; {_remedy(own[k] / wanted[k], units, mass=k < 3)}.",
        where=WHERE,
        value=float(own[k]),
    )


def _remedy(ratio: float, units: str, *, mass: bool) -> str:
    other = system_of(SYSTEMS[units].length, SYSTEMS[units].mass / ratio) if mass else ""
    if other and other != units:
        return f'set {WHERE}_units = "{other}"'
    return "give cage.material the body's density, or name the body's own mesh as mesh.file"


def check_modal_mass(source: str, masses: np.ndarray, own: np.ndarray) -> float:
    """Mass (m,) of the modes over that of their shapes on the mesh, ``own``: the ratio that is
    farthest from 1.

    Lumped masses move that of the higher modes, which is accepted and said. InputError where no
    mode has the mass of its shape: then all have another density or unit.
    """
    ratio = masses / own
    off = np.abs(ratio - 1.0)
    if off.min() > _MASS or off.max() > _LUMPED:
        worst = int(np.argmax(off))
        raise InputError(
            f"{source}: the mass of mode {worst + 1} is {masses[worst]:.4g}, but its shape on the "
            f"cage's mesh makes {own[worst]:.4g} of it; give cage.material the body's density, and "
            "shapes in the unit and the order of the matrices.",
            where=WHERE,
            value=float(off[worst]),
        )
    return float(ratio[np.argmax(off)])
