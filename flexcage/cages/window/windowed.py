"""What cages with windows share, whatever their body: crossbeams between pockets with plane walls,
and a rim, or a side beam of each pocket, at either end.

Each pocket has a frame: along the roller's axis, up through the wall, and around, towards larger
azimuth. Defects, measures and contact stations are written in it.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, pi, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.units import mm
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage, Objection
from flexcage.mesh.measure import in_pocket_frame

_SHARPEST = 1e-4  # fillet, of the pocket's smaller side; smaller ones are lost in its mesh
#: Faces of a pocket, and on which side of its middle each lies.
FACE_SIGN = {"front": 1.0, "rear": -1.0, "side+x": 1.0, "side-x": -1.0}
FACES = tuple(FACE_SIGN)


class WindowedCage(Cage):
    """A cage with one window a roller."""

    if TYPE_CHECKING:  # what every type has as a field, or says from its fields

        @property
        def pocket_length(self) -> float: ...
        @property
        def pocket_width(self) -> float: ...
        @property
        def fillet_radius(self) -> float: ...

    @property
    def fillet(self) -> float:
        return self.fillet_radius

    @property
    def pocket_size(self) -> float:
        return self.pocket_width

    @property
    def wall(self) -> float:
        """Thickness [m] of the wall."""
        return 0.5 * (self.outside_diameter - self.bore)

    def unfit_fillets(self, half: float) -> Iterator[Objection]:
        """Fillets that a pocket, ``half`` [m] of its smallest side, has no room for, or no use."""
        if self.fillet_radius >= half:
            yield (
                "fillet_radius",
                f"is too big; it must be less than half of the pocket's side, {mm(half)}",
            )
        if self.fillet_radius < 2.0 * _SHARPEST * half:
            yield (
                "fillet_radius",
                f"is a sharp corner; it must be at least {mm(2.0 * _SHARPEST * half)}",
            )

    def rim_width(self, side: float) -> float:
        """Width [m] of the rim on a side of the pockets, +1 for +x or -1."""
        raise NotImplementedError

    def end_width(self, side: float) -> float:
        """Width [m] of a pocket at its end on a side, +1 for +x or -1."""
        return self.pocket_width

    @property
    def face_normals(self) -> np.ndarray:
        """Normals (4, 3) of a pocket's faces, out of the pocket, in its frame."""
        around, along = np.array([0.0, 0.0, 1.0]), np.array([1.0, 0.0, 0.0])
        return np.stack([around, -around, along, -along])

    def in_pocket(self, points: np.ndarray, pocket: float, pocket_count: int) -> np.ndarray:
        """Coordinates (n, 3) [m] of points of the cage in a pocket's frame; along and around count
        from the pocket's middle."""
        return in_pocket_frame(points, pocket, pocket_count)

    def pocket_frame(self, pocket: float, pocket_count: int) -> np.ndarray:
        """Rows: the axes (3, 3) of a pocket's frame, in the cage's."""
        angle = 2.0 * pi * pocket / pocket_count
        c, s = cos(angle), sin(angle)
        return np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])

    def pocket_middle(self, pocket: float, pocket_count: int) -> np.ndarray:
        """Middle (3,) [m] of a pocket, halfway up the wall, in the cage's frame."""
        return self.mean_radius * self.pocket_frame(pocket, pocket_count)[1]

    def measured_at(self, pitch_radius: float) -> float:
        """How high [m] in their frames pockets are measured, on a pitch circle [m]."""
        return pitch_radius

    def along_crossbeams(self, points: np.ndarray) -> np.ndarray:
        """Places (n,) [m] of points along the crossbeams, from the middle of these."""
        along: np.ndarray = points[:, 0]
        return along

    def heights(self, points: np.ndarray) -> np.ndarray:
        """Places (n,) [m] of points across the wall, outwards."""
        heights: np.ndarray = np.hypot(points[:, 1], points[:, 2])
        return heights

    def pocket_clearance(self, bearing: Any) -> float:
        return self.clearances(bearing)[0]

    def clearances(self, bearing: Bearing) -> tuple[float, float]:
        """Clearance [m] of a roller in its pocket, around the cage and along the roller."""
        return (
            self.pocket_width - bearing.element_diameter,
            self.pocket_length - bearing.element_length,
        )
