"""Common cages of two rows for tests: of an NN 3010's rollers, a 3205's balls, and of barrels."""

from __future__ import annotations

from functools import cache
from math import pi

import numpy as np
from barrel_cage import BARREL_CAGE, BARRELS

from flexcage.cages.build import build_cage_mesh, reduce_cage
from flexcage.cages.crown.cage import CrownCage
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.window.cage import WindowCage
from flexcage.geometry.bearing import RowPlace
from flexcage.mesh.options import MeshOptions
from flexcage.modes.spec import ModesSpec

MM = 1e-3
WINDOW = WindowCage(
    bore=61 * MM, outside_diameter=66.4 * MM, width=9 * MM, pocket_width=7.2 * MM,
    pocket_length=7.25 * MM, fillet_radius=0.45 * MM,
)  # fmt: skip
MACHINED = BallCage(
    bore=35 * MM, outside_diameter=42 * MM, width=9.6 * MM, pocket_diameter=8.1 * MM
)
CROWN = CrownCage(
    bore=34.9 * MM, outside_diameter=42.1 * MM, width=6.7 * MM, pocket_diameter=8.18 * MM,
    throat=7.3 * MM, claw_thickness=1.0 * MM,
)  # fmt: skip
# cage, pockets a row, pitch diameter, distance of the rows
COMMON = {
    "window": (WINDOW, 12, 65 * MM, 9 * MM),
    "machined": (MACHINED, 9, 38.5 * MM, 9.6 * MM),
    "crown": (CROWN, 9, 38.5 * MM, -2.0 * CROWN.back),
    "barrel": (BARREL_CAGE, BARRELS.roller_count, 52 * MM, BARRELS.row_distance),
}


def places_of(kind: str, *, staggered: bool = True) -> tuple[RowPlace, RowPlace]:
    """Where the rows stand."""
    _, count, _, apart = COMMON[kind]
    turned = pi / count if staggered else 0.0
    return RowPlace(-0.5 * apart), RowPlace(0.5 * apart, -1.0, turned)


def common_mesh(kind: str, *defects, staggered=True, fineness="coarse", cage=None):
    """Mesh of both halves."""
    own, count, pitch, _ = COMMON[kind]
    return build_cage_mesh(
        cage or own, pocket_count=count, pitch_diameter=pitch, defects=defects,
        options=MeshOptions(fineness=fineness), places=places_of(kind, staggered=staggered),
    )  # fmt: skip


@cache
def reduced(kind: str, *, staggered: bool = True, method: str = "ritz"):
    """The reduction of a sound one."""
    mesh = common_mesh(kind, staggered=staggered)
    return reduce_cage(mesh, cage=COMMON[kind][0], defects=(), spec=ModesSpec(kind=method))


def pocket_places(points: np.ndarray, kind: str, pocket: int, *, staggered=True) -> np.ndarray:
    """Places (n, 3) of points along x from the row's middle, along r and psi of a pocket."""
    _, count, _, apart = COMMON[kind]
    row, own = divmod(pocket, count)
    psi = 2.0 * pi * (own + (0.5 if row and staggered else 0.0)) / count
    x, y, z = points.T
    r, t = y * np.cos(psi) + z * np.sin(psi), z * np.cos(psi) - y * np.sin(psi)
    return np.stack([x - (row - 0.5) * apart, r, t], axis=1)
