"""Static land vectors: what the modes miss of a cage pressed radially on its lands.

A local radial force on a land is a sum of harmonics in azimuth. The low ones bend the ring as its
free modes do and are carried by them; the centrifugal shape carries the uniform one. Only those
that the basis misses are added.
"""

from __future__ import annotations

import logging

import numpy as np

from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel

log = logging.getLogger(__name__)

LANDS = ("land_inner", "land_outer")
HARMONICS = 12  # what the 24 land stations of an interface can resolve
CARRIED = 0.95  # a pattern is left out if the basis has this part of its deflection already


def land_loads(model: FEModel) -> list[np.ndarray]:
    """Nodal loads (3N, 1 or 2) of radial tractions cos(n psi), sin(n psi), n = 0 to 12.

    Both lands are pushed alike, so that the wall is bent but not squeezed (which only adds
    frequencies of hundreds of kHz). psi is the azimuth from y towards z; a pattern's scale is a
    force of 1 N over a land of even traction 1.
    """
    present = [name for name in LANDS if len(model.groups.get(name, ()))]
    if not present:
        raise InputError(
            "modes.land is set, but the mesh has neither of the surface groups "
            f"{' and '.join(LANDS)}",
            where="modes.land",
            value=True,
        )
    triangles = np.vstack([model.group(name) for name in present])
    orders = np.repeat(np.arange(HARMONICS + 1), 2)[1:]

    def tractions(points: np.ndarray) -> np.ndarray:
        azimuth = np.arctan2(points[:, 2], points[:, 1])
        phase = np.outer(orders, azimuth)
        waves = np.cos(phase)
        waves[2::2] = np.sin(phase[2::2])
        return np.concatenate([waves * np.cos(azimuth), waves * np.sin(azimuth)])

    y, z = np.split(model.face_weights(triangles, tractions).toarray(), 2)
    area = model.face_weights(triangles, lambda p: np.ones((1, len(p)))).sum()
    loads = np.stack([np.zeros_like(y), y, z], axis=2).reshape(len(orders), -1).T / area
    return [loads[:, orders == n] for n in range(HARMONICS + 1)]


def land_vectors(
    solver: FreeBodySolver, kept: np.ndarray, kept_stiffness: np.ndarray
) -> np.ndarray:
    """Inertia-relieved answers (3N, m) of those land patterns that a basis misses.

    ``kept`` (3N, n) are K-orthogonal shapes of stiffness ``kept_stiffness`` (n,). A harmonic is
    added with both its phases if they carry less than 95 % of either's deflection.
    """
    added, orders = [], []
    for n, loads in enumerate(land_loads(solver.model)):
        static = solver.solve(loads)
        work = kept.T @ loads
        carried = np.sum(work**2 / kept_stiffness[:, None], axis=0)
        if np.any(carried < CARRIED * np.einsum("ij,ij->j", loads, static)):
            added.append(static)
            orders.append(n)
    log.debug("land vectors for the harmonics %s", ", ".join(map(str, orders)) or "none")
    return np.column_stack(added) if added else np.zeros((len(kept), 0))
