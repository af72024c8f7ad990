"""Defects of window cages: beams displaced, and what all defects of such cages must tell.

Crossbeam k is translated along its own tangent by -delta_q g / cos(pi/Z), of walls that slope
against the radius by as much more or less as the width then changes by delta_q: the component along
the tangent of either neighbouring pocket is delta_q g exactly, so both walls stay parallel to
themselves, the beam keeps its width and its radius, and a section that only translates keeps its
volume. g is the defect's shape over the pocket's length; a shifted beam is blended to zero over the
neighbouring half pockets and towards the end faces.

A side beam moves along x, in a cone along the roller's axis, by +-delta_p times its shape over the
pocket's width, the whole section together with its end face: it keeps its width, as a bent beam
does, and its volume exactly.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import copysign, cos, pi, sin
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from flexcage.cages.window.faces import face_position
from flexcage.cages.window.windowed import FACES, WindowedCage
from flexcage.core.errors import InputError
from flexcage.core.spec import option, quantity
from flexcage.core.units import mm, typeset
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import (
    CageDefect,
    Finding,
    Mark,
    Reading,
    around,
    defect_type,
    signed_mm,
)
from flexcage.mesh.measure import in_pocket_frame

if TYPE_CHECKING:
    from flexcage.mesh.cage_mesh import CageMesh

_PINCH_LIMIT = 0.1  # of an element's size: far beyond what any cage material survives
_LEGEND = (
    Mark("patch", "smaller", "pocket made narrower or shorter"),
    Mark("patch", "larger", "pocket made wider or longer"),
    Mark("dashes", "sound", "rim without the defect; arrow: way of the beam"),
)


@dataclass(frozen=True, kw_only=True)
class WindowDefect(CageDefect):
    """A defect of a window cage: a smooth displacement of its vertices."""

    def displace(self, points: np.ndarray, cage: WindowedCage, *, pocket_count: int) -> np.ndarray:
        """Displacement (n, 3) [m] of points (n, 3) of the undamaged cage."""
        raise NotImplementedError(f"{type(self).__name__} does not say what it moves")

    def opened(self, sound: CageMesh, mesh: CageMesh, cage: WindowedCage) -> CageMesh:
        """``mesh``, numbered as the ``sound`` one but for doubled vertices, with what it opens."""
        return mesh

    def offsets(self, points: np.ndarray, cage: WindowedCage, *, pocket_count: int) -> np.ndarray:
        """Outward displacement (Z, 4, n) [m] of the pockets' faces, free of stress, at ``points``
        (4, n) [m] along them from mid-pocket; as ``displace`` has it in the middle of the wall."""
        found = np.zeros((pocket_count, *points.shape))
        ways = np.array([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0], [1.0, 0.0, 0.0], [-1.0, 0.0, 0.0]])
        half = 0.5 * np.repeat([cage.pocket_width, cage.pocket_length], 2)
        for pocket in range(pocket_count):
            axes = cage.pocket_frame(pocket, pocket_count)
            for i, (way, normal) in enumerate(zip(half[:, None] * ways, cage.face_normals)):
                middle = cage.pocket_middle(pocket, pocket_count) + way @ axes
                places = middle + np.multiply.outer(points[i], axes[0 if i < 2 else 2])
                moved = self.displace(places, cage, pocket_count=pocket_count)
                found[pocket, i] = moved @ (normal @ axes)
        return found

    @classmethod
    def check_all(
        cls, defects: Sequence[Any], cage: Cage, *, pocket_count: int, pitch_diameter: float,
        element_diameter: float = 0.0,
    ) -> None:  # fmt: skip
        super().check_all(
            defects, cage, pocket_count=pocket_count, pitch_diameter=pitch_diameter,
            element_diameter=element_diameter,
        )  # fmt: skip
        assert isinstance(cage, WindowedCage)
        _check_sizes(defects, cage, pocket_count)

    @classmethod
    def interference(
        cls, defects: Sequence[Any], cage: Cage, bearing: Bearing
    ) -> Iterator[tuple[str, str]]:
        assert isinstance(cage, WindowedCage)
        widths, lengths = pocket_clearances(cage, bearing, defects)
        for what, clearance, size in (
            ("width", widths, bearing.element_diameter),
            ("length", lengths, bearing.element_length),
        ):
            pocket = int(np.argmin(clearance))
            if clearance[pocket] < -_PINCH_LIMIT * size:
                yield (
                    "defects",
                    f"The defects leave pocket {pocket} a {what} of "
                    f"{mm(clearance[pocket] + size)} for a {bearing.element} of {mm(size)}; no "
                    f"assembly can take more than {_PINCH_LIMIT * 100:.0f} % of interference.",
                )

    def changes(self, count: int) -> dict[tuple[int, str], float]:
        """Outward displacement [m] of pockets' faces at the pitch radius, mid-pocket."""
        return {}

    @property
    def legend(self) -> Sequence[Mark]:
        return _LEGEND

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> Sequence[Reading]:
        """How far the faces that it moves are from their nominal places; those that move as much,
        together and in the sense of the last of them."""
        changes = self.changes(mesh.pocket_count)
        alike: dict[float, list[tuple[float, float]]] = {}
        for (pocket, face), change in changes.items():
            nominal = 0.5 * (cage.pocket_length if face.startswith("side") else cage.pocket_width)
            position = face_position(mesh, pocket, face, pitch_radius=pitch_radius, cage=cage)
            alike.setdefault(abs(change), []).append((change, position - nominal))
        return [
            Reading(self.type, asked, [copysign(1.0, c) * copysign(1.0, asked) * d for c, d in own])
            for own in alike.values()
            for asked in [own[-1][0]]
        ]


@dataclass(frozen=True, kw_only=True)
class CrossbeamDefect(WindowDefect):
    """Crossbeam k (between pockets k-1 and k) displaced; > 0 narrows pocket k-1, widens pocket k.

    ``displacement`` is the change of pocket width at the pitch radius, mid-pocket. ``bent``: the
    deflection of a clamped-clamped beam under a uniform load, w(s) = 16 s^2 (1-s)^2 with s from 0
    to 1 along the crossbeam; ``shifted``: the beam as a whole, blended to zero in the side beams.
    """

    part: ClassVar[str] = "crossbeam"

    type: str = defect_type("crossbeam")
    crossbeam: int = option(doc="crossbeam number, 0 .. Z-1", minimum=0)
    displacement: float = quantity("mm", doc="delta_q")
    shape: str = option("bent", doc="bent or shifted as a whole", choices=("bent", "shifted"))

    def profile(self, x: np.ndarray, pocket_length: float) -> np.ndarray:
        """Share (0..1) of the displacement at axial positions x [m] from mid-pocket: 1 at x = 0."""
        if self.shape == "shifted":
            return np.ones_like(np.asarray(x, float))
        return clamped_beam(x, pocket_length)

    def displace(self, points: np.ndarray, cage: WindowedCage, *, pocket_count: int) -> np.ndarray:
        """Translation of the crossbeam along its own tangent; > 0 towards pocket k-1."""
        half = pi / pocket_count
        _, radial, tangential = in_pocket_frame(points, self.place, pocket_count).T
        near = np.abs(np.arctan2(tangential, radial)) < half * (1.0 + 1e-9)  # up to mid-pockets
        field = near * self._field(points, cage, pocket_count)
        angle = 2.0 * half * self.place
        tangent = np.array([0.0, -sin(angle), cos(angle)])
        share = _moved_face(cage, pocket_count)
        return np.multiply.outer(-self.displacement / share * field, tangent)

    def _field(self, points: np.ndarray, cage: WindowedCage, pocket_count: int) -> np.ndarray:
        """Share (n,) of the displacement near the crossbeam: 1 at the middle of its faces."""
        x = cage.along_crossbeams(points)
        if self.shape == "bent":  # zero with zero slope where the side beams begin
            return self.profile(x, cage.pocket_length)
        reach = 0.5 * cage.pocket_width - cage.fillet_radius  # the fillets move with the beam
        behind = in_pocket_frame(points, self.crossbeam - 1, pocket_count)[:, 2]
        ahead = -in_pocket_frame(points, self.crossbeam, pocket_count)[:, 2]
        rims = np.where(x > 0.0, cage.rim_width(1.0), cage.rim_width(-1.0))
        into_side = (np.abs(x) - 0.5 * cage.pocket_length) / rims
        return (
            _smooth(1.0 - into_side)
            * _smooth(behind / reach)
            * _smooth(ahead / reach)
            * self.profile(x, cage.pocket_length)
        )

    def offsets(self, points: np.ndarray, cage: WindowedCage, *, pocket_count: int) -> np.ndarray:
        """Its shape to the corners, in front of pocket k-1 and behind pocket k."""
        found = np.zeros((pocket_count, *points.shape))
        shift = self.displacement * self.profile(points[0], cage.pocket_length)
        before, after = self.pockets(pocket_count)
        shift = shift * cage.face_normals[0, 2]  # along a face's normal
        found[before, FACES.index("front")] = -shift
        found[after, FACES.index("rear")] = shift
        return found

    def changes(self, count: int) -> dict[tuple[int, str], float]:
        before, after = self.pockets(count)
        return {(before, "front"): -self.displacement, (after, "rear"): self.displacement}

    def way(self, count: int) -> tuple[float, np.ndarray]:
        return 0.0, -np.sign(self.displacement) * around(self.place, count)

    @property
    def label(self) -> str:
        return f"crossbeam {self.crossbeam} {self.shape}, $δ_q$ = {signed_mm(self.displacement)}"

    def in_words(self, count: int) -> str:
        before, after = self.pockets(count)
        if self.displacement < 0.0:
            before, after = after, before
        how = "bent" if self.shape == "bent" else "shifted as a whole"
        return (
            f"crossbeam {self.crossbeam} is {how} by {_size(self.displacement)}, so that pocket "
            f"{before} is narrower and pocket {after} wider by as much"
        )

    def check(self, where: str, cage: Any, count: int) -> Iterator[Finding]:
        yield from self.check_number(where, count)
        yield from _check_displacement(
            self.displacement, where, 0.5 * cage.pocket_width, "half of the pocket's width"
        )

    @classmethod
    def check_together(cls, own: Sequence[CrossbeamDefect], count: int) -> Iterator[Finding]:
        return find_repeated(f"Crossbeam {d.crossbeam} is {d.shape}" for d in own)


@dataclass(frozen=True, kw_only=True)
class SideBeamDefect(WindowDefect):
    """One side beam of a pocket displaced along the axis; > 0 lengthens the pocket (delta_p)."""

    type: str = defect_type("side_beam")
    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    side: str = option("+x", doc="which of the two side beams", choices=("+x", "-x"))
    displacement: float = quantity("mm", doc="delta_p")

    @property
    def sign(self) -> float:
        """Of x on its side."""
        return 1.0 if self.side == "+x" else -1.0

    def displace(self, points: np.ndarray, cage: WindowedCage, *, pocket_count: int) -> np.ndarray:
        """Translation of the side beam along x; > 0 away from the pocket's middle."""
        radial = in_pocket_frame(points, self.pocket, pocket_count)[:, 1]
        x, _, tangential = cage.in_pocket(points, self.pocket, pocket_count).T
        here = (self.sign * x > 0.0) & (radial > 0.0)  # others' beams have |t| > half a width
        shape = np.where(here, clamped_beam(tangential, cage.end_width(self.sign)), 0.0)
        along = cage.pocket_frame(self.pocket, pocket_count)[0]
        return np.multiply.outer(self.sign * self.displacement * shape, along)

    def offsets(self, points: np.ndarray, cage: WindowedCage, *, pocket_count: int) -> np.ndarray:
        found = np.zeros((pocket_count, *points.shape))
        face = FACES.index(f"side{self.side}")
        shape = clamped_beam(points[face], cage.end_width(self.sign))
        found[self.pocket % pocket_count, face] = self.displacement * shape
        return found

    def changes(self, count: int) -> dict[tuple[int, str], float]:
        return {(self.pocket, f"side{self.side}"): self.displacement}

    def way(self, count: int) -> tuple[float, np.ndarray]:
        return 0.78 * self.sign, self.sign * np.sign(self.displacement) * np.array([1.0, 0.0, 0.0])

    @property
    def label(self) -> str:
        side = self.side.replace("-", "−")
        return f"pocket {self.pocket}, side beam {side}, $δ_p$ = {signed_mm(self.displacement)}"

    def in_words(self, count: int) -> str:
        change = "longer" if self.displacement > 0.0 else "shorter"
        return (
            f"the side beam {self.side} of pocket {self.pocket} is displaced by "
            f"{_size(self.displacement)}, so that the pocket is {change} by as much"
        )

    def check(self, where: str, cage: Any, count: int) -> Iterator[Finding]:
        rim = cage.rim_width(self.sign)
        limit, reason = min(0.5 * cage.pocket_length, rim), "the side beam's width"
        if limit < rim:
            reason = "half of the pocket's length"
        yield from self.check_number(where, count)
        yield from _check_displacement(self.displacement, where, limit, reason)

    @classmethod
    def check_together(cls, own: Sequence[SideBeamDefect], count: int) -> Iterator[Finding]:
        return find_repeated(
            f"The side beam {d.side} of pocket {d.pocket} is displaced" for d in own
        )


def _moved_face(cage: WindowedCage, pocket_count: int) -> float:
    """How much wider a pocket becomes, measured around, when a crossbeam moves along its own
    tangent: by cos(pi/Z) where its faces lie along the radius."""
    normal = cage.face_normals[0]
    tangent = around(0.5, pocket_count)
    return float(normal @ cage.pocket_frame(0.0, pocket_count) @ tangent / normal[2])


def clamped_beam(s: np.ndarray, length: float) -> np.ndarray:
    """Deflection (0..1) of a beam of a length [m], clamped at both ends, under a uniform load, at
    positions s [m] from its middle: 1 at 0."""
    s = np.clip(np.asarray(s, float) / length + 0.5, 0.0, 1.0)
    return 16.0 * s**2 * (1.0 - s) ** 2


def _smooth(s: np.ndarray) -> np.ndarray:
    """0 below 0, 1 above 1, and a cubic with flat ends between."""
    s = np.clip(s, 0.0, 1.0)
    return s * s * (3.0 - 2.0 * s)


def pocket_changes(
    defects: Sequence[WindowDefect], *, pocket_count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Change of every pocket's width and length (Z,) [m] at the pitch radius, mid-pocket."""
    width, length = np.zeros(pocket_count), np.zeros(pocket_count)
    for defect in defects:
        for (pocket, face), change in defect.changes(pocket_count).items():
            (length if face.startswith("side") else width)[pocket] += change
    return width, length


def pocket_clearances(
    cage: WindowedCage, bearing: Bearing, defects: Sequence[WindowDefect] = ()
) -> tuple[np.ndarray, np.ndarray]:
    """Circumferential and axial clearance (Z,), (Z,) [m] of every pocket, at its middle.

    Negative where an element is pinched.
    """
    width, length = pocket_changes(defects, pocket_count=bearing.element_count)
    around_, along = cage.clearances(bearing)
    return around_ + width, along + length


def _check_sizes(defects: Sequence[WindowDefect], cage: WindowedCage, pocket_count: int) -> None:
    """Refuse defects that together leave a pocket no width or length."""
    width, length = pocket_changes(defects, pocket_count=pocket_count)
    for what, sizes in (
        ("width", cage.pocket_width + width),
        ("length", cage.pocket_length + length),
    ):
        k = int(np.argmin(sizes))
        if sizes[k] <= 0.0:
            raise InputError(
                f"The defects together leave pocket {k} a {what} of {mm(sizes[k])}; it must be "
                "greater than zero.",
                where="defects",
                value=float(sizes[k]),
            )


def find_repeated(names: Iterable[str]) -> Iterator[Finding]:
    """A beam that has the same defect more than once."""
    for what, times in Counter(names).items():
        if times > 1:
            yield "defects", f"{what} {times} times; give one such defect.", times


def _check_displacement(
    displacement: float, where: str, limit: float, reason: str
) -> Iterator[Finding]:
    if not abs(displacement) < limit:
        yield (
            f"{where}.displacement",
            f"{where}.displacement is {mm(displacement)}, which leaves the pocket; it must stay "
            f"below {mm(limit)}, {reason}.",
            displacement,
        )


def _size(value: float) -> str:
    return typeset(abs(value), "mm")
