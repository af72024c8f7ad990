"""The walls of a conical cage's pockets, as contacts need them: four planes in the pocket's frame.

A pocket's frame has the axes s (along the roller's axis, towards the apex at +x), n (across it,
outwards) and t (towards larger azimuth), and its origin in the pocket's middle: on the pitch
circle, in the plane x = 0 of the cage, at azimuth 2 pi k/Z (``ConeShaped.pocket_frame``,
``ConeShaped.in_pocket``).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.cages.conical.shape import ConeShaped


@dataclass(frozen=True)
class PocketWalls:
    """The faces front, rear, side+x and side-x of a pocket, in its frame (s, n, t) [m].

    A plane has the points p with (p - middle) . normal = 0; ``normal`` points out of the pocket,
    into the cage, and ``middle`` lies in the face's middle. ``along`` is the
    direction in which a face's stations count, s or t, and ``reach`` half its length in it, from
    corner to corner. The bars' faces begin and end at the heights ``inside`` and ``outside`` n,
    halfway along the pocket (elsewhere: ``ConeShaped.face_heights``).
    """

    middle: np.ndarray  # (4, 3)
    normal: np.ndarray  # (4, 3)
    along: np.ndarray  # (4, 3)
    reach: np.ndarray  # (4,)
    inside: float
    outside: float


def pocket_walls(cage: ConeShaped) -> PocketWalls:
    """The walls of a sound pocket; those of all pockets are alike."""
    half = 0.5 * cage.pocket_length
    n, w = cage.bar_height, 0.5 * cage.pocket_width
    inside, outside = cage.face_heights(0.0)
    s, t = np.array([1.0, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])
    return PocketWalls(
        middle=np.array(
            [[0.0, n, w], [0.0, n, -w], [half, cage.offset, 0.0], [-half, cage.offset, 0.0]]
        ),
        normal=cage.face_normals,
        along=np.stack([s, s, t, t]),
        reach=np.array([half, half, 0.5 * cage.end_width(1.0), 0.5 * cage.end_width(-1.0)]),
        inside=inside,
        outside=outside,
    )
