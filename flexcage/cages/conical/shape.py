"""What cages with a wall about a cone share: places in the wall, frames of pockets, thicknesses.

The wall has an even thickness and one window a roller. Its section through the bearing's axis lies
along the axis of a roller. Places in it are (s, n): along the roller's axis from its middle towards
the apex, at +x, and across it outwards. The large rim is at -x.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from math import cos, hypot, pi, sin, tan
from typing import TYPE_CHECKING, Any, ClassVar, NamedTuple

import numpy as np

from flexcage.cages.window.windowed import WindowedCage
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Objection


class Section(NamedTuple):
    """Ends of a wall's section [m]: of the large rim (on its middle) and of the small one, inside
    and outside."""

    large: float
    small: float
    inside: float
    outside: float


class ConeShaped(WindowedCage):
    """A cage whose wall follows a cone, with one window a roller."""

    #: Keys of a pocket's width at its small and at its large end.
    widths: ClassVar[tuple[str, str]] = ("pocket_width_small", "pocket_width_large")

    if TYPE_CHECKING:  # what every type has as a field, or says from its fields

        @property
        def cone_angle(self) -> float: ...
        @property
        def pitch_diameter(self) -> float: ...
        @property
        def offset(self) -> float: ...
        @property
        def thickness(self) -> float: ...
        @property
        def small_rim(self) -> float: ...
        @property
        def large_rim(self) -> float: ...
        @property
        def pocket_width_small(self) -> float: ...
        @property
        def pocket_width_large(self) -> float: ...
        @property
        def flank_angle(self) -> float: ...

    def large_end(self, n: Any) -> Any:
        """Place s [m] at which the wall ends beyond the large rim, at heights n [m]."""
        raise NotImplementedError

    def from_large_end(self, points: np.ndarray) -> np.ndarray:
        """Distances (n,) [m] of points of the cage from the surface at the end of the large rim."""
        raise NotImplementedError

    @property
    def section(self) -> Section:
        """Ends of the wall's section, in s and n."""
        small = 0.5 * self.pocket_length + self.small_rim
        low = self.offset - 0.5 * self.thickness
        return Section(float(self.large_end(self.offset)), small, low, low + self.thickness)

    def radius(self, s: Any, n: Any) -> Any:
        """Distance [m] of a place, or of arrays of them, in the section from the bearing's axis."""
        return 0.5 * self.pitch_diameter - s * sin(self.cone_angle) + n * cos(self.cone_angle)

    def axial(self, s: Any, n: Any) -> Any:
        """Its place x [m] along the bearing's axis, from the plane of the rollers' middles."""
        return s * cos(self.cone_angle) + n * sin(self.cone_angle)

    def half_width(self, s: Any, n: Any) -> Any:
        """Half of a pocket's width [m] at a place in its middle plane's section."""
        above = n - self.bar_height
        return 0.5 * self.pocket_width - s * self.taper - above * tan(self.flank_angle)

    @cached_property
    def bar_height(self) -> float:
        """Height n [m] of the wall's middle at the bars' faces, halfway along a pocket: a cone is
        lower there than in the pocket's middle plane."""
        return self._height_beside(0.0, self.offset, lambda n: 0.5 * self.pocket_width)

    def face_heights(self, s: float) -> tuple[float, float]:
        """Heights n [m] at which a bar's face begins and ends, at a place s along the pocket."""
        at = self.section
        low, high = (
            self._height_beside(s, n, lambda n: float(self.half_width(s, n)))
            for n in (at.inside, at.outside)
        )
        return low, high

    def _height_beside(self, s: float, height: float, beside: Callable[[float], float]) -> float:
        """Height n of a cone, which is at a height in the middle plane, beside that plane."""
        n = height
        for _ in range(60):  # a contraction: bars are steeper than the cone falls
            y, t = float(self.radius(s, n)), beside(n)
            n = height - t**2 / (hypot(y, t) + y) * cos(self.cone_angle)
        return n

    @property
    def half_section(self) -> Sequence[tuple[float, float]]:
        at = self.section
        corners = (
            (float(self.large_end(at.inside)), at.inside), (at.small, at.inside),
            (at.small, at.outside), (float(self.large_end(at.outside)), at.outside),
        )  # fmt: skip
        return [(float(self.axial(s, n)), float(self.radius(s, n))) for s, n in corners]

    @property
    def taper(self) -> float:
        """How much a bar's face approaches the pocket's middle plane along the roller's axis."""
        return 0.5 * (self.pocket_width_large - self.pocket_width_small) / self.pocket_length

    @property
    def bore(self) -> float:  # type: ignore[override]
        """Inside diameter [m] of the small end."""
        return float(2.0 * self.radius(self.section.small, self.section.inside))

    @property
    def outside_diameter(self) -> float:  # type: ignore[override]
        """Outside diameter [m] of the large end."""
        n = self.section.outside
        return float(2.0 * self.radius(self.large_end(n), n))

    @property
    def ends(self) -> tuple[float, float]:
        """Places x [m] of its large and its small end, at -x and +x."""
        at = self.section
        large = self.axial(self.large_end(at.inside), at.inside)
        return float(large), float(self.axial(at.small, at.outside))

    @property
    def width(self) -> float:  # type: ignore[override]
        """What it takes up along the bearing's axis [m]."""
        return self.ends[1] - self.ends[0]

    @property
    def axial_reach(self) -> float:
        return max(-self.ends[0], self.ends[1])

    @property
    def mean_radius(self) -> float:
        """Of the wall's middle, halfway along the pockets [m]."""
        return float(self.radius(0.0, self.offset))

    @property
    def most_unbalance(self) -> float:
        along = self.section.small - self.section.large
        wall = 2.0 * pi * self.mean_radius * self.thickness * along
        return 0.5 * self.material.density * wall * self.mean_radius

    @property
    def pocket_reach(self) -> float:
        return float(self.axial(0.5 * self.pocket_length, abs(self.offset)))

    @property
    def has_land(self) -> bool:
        return False

    @property
    def wall(self) -> float:
        return self.thickness

    def rim_width(self, side: float) -> float:
        return self.small_rim if side > 0.0 else self.large_rim

    def end_width(self, side: float) -> float:
        return self.pocket_width_small if side > 0.0 else self.pocket_width_large

    @property
    def face_normals(self) -> np.ndarray:
        beam = np.array([self.taper, tan(self.flank_angle), 1.0])
        beam, along = beam / np.linalg.norm(beam), np.array([1.0, 0.0, 0.0])
        return np.stack([beam, beam * (1.0, 1.0, -1.0), along, -along])

    @property
    def axes(self) -> np.ndarray:
        """Rows: axes s, n, t (3, 3) of a pocket's frame, in components (x, r, psi) there."""
        c, s = cos(self.cone_angle), sin(self.cone_angle)
        return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])

    def in_pocket(self, points: np.ndarray, pocket: float, pocket_count: int) -> np.ndarray:
        middle = np.array([0.0, 0.5 * self.pitch_diameter, 0.0])
        return (super().in_pocket(points, pocket, pocket_count) - middle) @ self.axes.T

    def pocket_frame(self, pocket: float, pocket_count: int) -> np.ndarray:
        return self.axes @ super().pocket_frame(pocket, pocket_count)

    def pocket_middle(self, pocket: float, pocket_count: int) -> np.ndarray:
        place = np.array([self.axial(0.0, self.offset), self.mean_radius, 0.0])
        return place @ super().pocket_frame(pocket, pocket_count)

    def measured_at(self, pitch_radius: float) -> float:
        return self.bar_height

    def in_section(self, points: np.ndarray) -> np.ndarray:
        """Places (n, 2) [m] of points of the cage in its section, turned about the axis: along the
        wall and across it. In a pocket's middle plane they are s and n."""
        above = np.hypot(points[:, 1], points[:, 2]) - 0.5 * self.pitch_diameter
        return np.stack([points[:, 0], above], axis=1) @ self.axes[:2, :2].T

    def along_crossbeams(self, points: np.ndarray) -> np.ndarray:
        return self.in_section(points)[:, 0]

    def heights(self, points: np.ndarray) -> np.ndarray:
        return self.in_section(points)[:, 1]

    def bar_width(self, s: float, n: float, pocket_count: int) -> float:
        """Width [m] of a bar between the walls of its pockets at a place of their sections."""
        step = pi / pocket_count
        return float(2.0 * (self.radius(s, n) * sin(step) - self.half_width(s, n) * cos(step)))

    def thinnest_bar(self, pocket_count: int) -> float:
        """Least width [m] of a bar, at the corners of its faces."""
        half = 0.5 * self.pocket_length
        places = ((s, n) for s in (-half, half) for n in self.face_heights(s))
        return min(self.bar_width(s, n, pocket_count) for s, n in places)

    def thinnest(self, pitch_diameter: float, pocket_count: int) -> float:
        return min(self.thickness, self.bar_width(0.0, self.bar_height, pocket_count))

    def parts(self, pitch_diameter: float, pocket_count: int) -> dict[str, float]:
        return {
            "crossbeams": self.thinnest_bar(pocket_count),
            "rims": min(self.small_rim, self.large_rim),
            "wall": self.thickness,
        }

    def impossible(self, pocket_count: int) -> Iterator[Objection]:
        from flexcage.cages.conical.checks import impossible

        return impossible(self, pocket_count)

    def nearest(self, s: float) -> tuple[float, float, float]:
        """Where a bar's face is nearest to the pocket's axis at a place s [m] along it: n, distance
        from the middle plane, and distance from the axis [m]. At an edge of the face where the
        foot of the perpendicular is beyond it."""
        flank = self.flank_angle
        foot = self.half_width(s, 0.0) * cos(flank) * sin(flank)
        low, high = self.face_heights(s)
        n = min(max(foot, low), high)
        t = self.half_width(s, n)
        return n, t, hypot(n, t)

    def clearances(self, bearing: Bearing) -> tuple[float, float]:
        from flexcage.cages.conical.rollers import clearance_around

        around = clearance_around(self, bearing.roller, 0.0)  # type: ignore[attr-defined]
        return around, self.pocket_length - bearing.element_length
