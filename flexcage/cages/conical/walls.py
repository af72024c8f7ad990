"""The walls of a conical cage's pockets, as contacts need them: four planes in the pocket's frame.

A pocket's frame has the axes s (along the roller's axis, towards the apex at +x), n (across it,
outwards) and t (towards larger azimuth), and its origin in the pocket's middle: on the pitch
circle, in the plane x = 0 of the cage, at azimuth 2 pi k/Z.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin, tan

import numpy as np

from flexcage.cages.conical.cage import ConicalCage
from flexcage.mesh.measure import in_pocket_frame


@dataclass(frozen=True)
class PocketWalls:
    """The faces front, rear, side+x and side-x of a pocket, in its frame (s, n, t) [m].

    A plane has the points p with (p - middle) . normal = 0; ``normal`` points out of the pocket,
    into the cage, and ``middle`` lies in the middle of the wall's thickness. ``along`` is the
    direction in which a face's stations count, s or t, and ``reach`` half its length in it, from
    corner to corner. All faces end at the heights ``inside`` and ``outside`` n, nearly: at the
    cones of the wall, which are curved by t^2 cos(cone_angle)/(2 radius).
    """

    middle: np.ndarray  # (4, 3)
    normal: np.ndarray  # (4, 3)
    along: np.ndarray  # (4, 3)
    reach: np.ndarray  # (4,)
    inside: float
    outside: float


def pocket_walls(cage: ConicalCage) -> PocketWalls:
    """The walls of a sound pocket; those of all pockets are alike."""
    half, slope = 0.5 * cage.pocket_length, tan(cage.flank_angle)
    n, w = cage.offset, 0.5 * cage.pocket_width
    beam = np.array([cage.taper, slope, 1.0])
    beam /= np.linalg.norm(beam)
    s, t = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
    mirror = np.array([1.0, 1.0, -1.0])
    at = cage.section
    ends = [cage.half_width(x, n) for x in (half, -half)]
    return PocketWalls(
        middle=np.array([[0.0, n, w], [0.0, n, -w], [half, n, 0.0], [-half, n, 0.0]]),
        normal=np.stack([beam, mirror * beam, s, -s]),
        along=np.stack([s, s, t, t]),
        reach=np.array([half, half, *ends]),
        inside=at.inside,
        outside=at.outside,
    )


def pocket_axes(cage: ConicalCage) -> np.ndarray:
    """Rows: axes s, n, t (3, 3) of a pocket's frame, in components (x, r, psi) at its azimuth."""
    c, s = cos(cage.cone_angle), sin(cage.cone_angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def in_pocket(
    points: np.ndarray, pocket: float, pocket_count: int, cage: ConicalCage
) -> np.ndarray:
    """Coordinates (n, 3) [m] of points of the cage in a pocket's frame (s, n, t)."""
    middle = np.array([0.0, 0.5 * cage.pitch_diameter, 0.0])
    return (in_pocket_frame(points, pocket, pocket_count) - middle) @ pocket_axes(cage).T


def in_cone(points: np.ndarray, cage: ConicalCage) -> np.ndarray:
    """Places (n, 2) of points of the cage in its section, turned about the axis: along the wall and
    across it [m]. In a pocket's middle plane they are s and n."""
    x, above = points[:, 0], np.hypot(points[:, 1], points[:, 2]) - 0.5 * cage.pitch_diameter
    return np.stack([x, above], axis=1) @ pocket_axes(cage)[:2, :2].T
