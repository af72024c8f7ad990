"""Defects of ball cages, and where they leave the pockets' walls.

A pocket's axis is radial. Its wall, cut by any plane across that axis, is a circle or, elongated,
a slot: that circle swept along a straight line. The circle has the pocket's radius where the
pocket is cylindrical; a spherical one has it at the pitch radius alone. Web k lies between the
pockets k-1 and k (mod Z), thinnest at the pockets' waist.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from math import pi
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.shapes import PocketShapes, is_sphere, level_radius, web_thickness
from flexcage.core.errors import InputError
from flexcage.core.spec import option, quantity
from flexcage.core.units import mm, typeset
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import (
    CageDefect,
    CageLine,
    Finding,
    Mark,
    Reading,
    around,
    defect_type,
    raise_first,
    signed_mm,
)

if TYPE_CHECKING:
    from flexcage.mesh.cage_mesh import CageMesh

_DIRECTIONS = ("axial", "circumferential")
_SPACING = 1  # what tells the seed of pockets' places from that of ball diameters
_RIM = "rim without the defect"
_HOLES = (
    Mark("patch", "smaller", "pocket made smaller"),
    Mark("patch", "larger", "pocket made larger"),
    Mark("dashes", "sound", _RIM),
)


@dataclass(frozen=True, kw_only=True)
class BallCageDefect(CageDefect):
    """A defect of a cage with round pockets: it alters walls, or opens the mesh."""

    @classmethod
    def check_all(
        cls, defects: Sequence[Any], cage: Cage, *, pocket_count: int, pitch_diameter: float,
        element_diameter: float = 0.0,
    ) -> None:  # fmt: skip
        super().check_all(
            defects, cage, pocket_count=pocket_count, pitch_diameter=pitch_diameter,
            element_diameter=element_diameter,
        )  # fmt: skip
        assert isinstance(cage, BallCage)
        if cage.pockets_vary:
            check_pockets(
                defects, cage, pocket_count=pocket_count, pitch_diameter=pitch_diameter,
                ball_diameter=element_diameter,
            )  # fmt: skip

    @classmethod
    def by_chance(cls, cage: Cage, pocket_count: int, seed: int) -> tuple[CageDefect, ...]:
        """Pockets displaced around a cage at random by its ``pocket_scatter``, not on average."""
        assert isinstance(cage, BallCage)
        if cage.pocket_scatter == 0.0:
            return ()
        shift = np.random.default_rng([seed, _SPACING]).standard_normal(pocket_count)
        shift = cage.pocket_scatter * (shift - shift.mean())
        return tuple(
            DisplacedPocket(pocket=k, circumferential=float(s)) for k, s in enumerate(shift)
        )

    def alter(self, shapes: PocketShapes) -> None:
        """Add what it changes of the pockets' walls to their shapes."""

    def tips(self, cage: BallCage) -> Sequence[float]:
        """Distances [m] from the cage's middle at which the sound mesh must have edges."""
        return ()

    def opened(self, sound: CageMesh, mesh: CageMesh, cage: Any) -> CageMesh:
        """``mesh``, numbered as the ``sound`` one but for doubled vertices, with what it opens."""
        return mesh


@dataclass(frozen=True, kw_only=True)
class EnlargedPocket(BallCageDefect):
    """Pocket bored to another diameter about the same axis; < 0 makes it smaller."""

    type: str = defect_type("enlarged")
    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    increase: float = quantity("mm", doc="what is added to the pocket's diameter")

    def alter(self, shapes: PocketShapes) -> None:
        shapes.radius[self.pocket] += 0.5 * self.increase

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> list[Reading]:
        found = _measured(mesh, cage, self.pocket, pitch_radius)
        change = 2.0 * float(found.radius[0]) - cage.pocket_diameter
        return [Reading(self.type, self.increase, [change])]

    def changes(self, count: int) -> dict[tuple[int, str], float]:
        return {(self.pocket, "diameter"): self.increase}

    @property
    def legend(self) -> Sequence[Mark]:
        return _HOLES

    @property
    def label(self) -> str:
        what = "enlarged" if self.increase > 0.0 else "made smaller"
        return f"pocket {self.pocket} {what}, diameter {signed_mm(self.increase)}"

    def in_words(self, count: int) -> str:
        change = "larger" if self.increase > 0.0 else "smaller"
        return f"pocket {self.pocket} is {change} in diameter by {_size(self.increase)}"


@dataclass(frozen=True, kw_only=True)
class ElongatedPocket(BallCageDefect):
    """Pocket made a slot: its wall swept along a straight line of the length ``elongation``."""

    type: str = defect_type("elongated")
    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    direction: str = option(doc="along which the pocket is longer", choices=_DIRECTIONS)
    elongation: float = quantity("mm", doc="straight length of the slot", above=0.0)

    @property
    def _along(self) -> int:
        return _DIRECTIONS.index(self.direction)

    def alter(self, shapes: PocketShapes) -> None:
        shapes.slot[self.pocket, self._along] += 0.5 * self.elongation

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> list[Reading]:
        found = _measured(mesh, cage, self.pocket, pitch_radius)
        return [Reading(self.type, self.elongation, [2.0 * float(found.slot[0, self._along])])]

    def changes(self, count: int) -> dict[tuple[int, str], float]:
        return {(self.pocket, self.direction): self.elongation}

    @property
    def legend(self) -> Sequence[Mark]:
        return _HOLES

    @property
    def label(self) -> str:
        return f"pocket {self.pocket} elongated, {self.direction} {signed_mm(self.elongation)}"

    def in_words(self, count: int) -> str:
        way = {"axial": "axially", "circumferential": "around the cage"}[self.direction]
        return f"pocket {self.pocket} is a slot, longer {way} by {_size(self.elongation)}"

    def check(self, where: str, cage: Cage, count: int) -> Iterator[Finding]:
        yield from self.check_number(where, count)
        if self.direction not in _DIRECTIONS:
            yield (
                f"{where}.direction",
                f"{where}.direction is {self.direction!r}, but must be 'axial' or "
                "'circumferential'.",
                self.direction,
            )
        if not self.elongation > 0.0:
            yield (
                f"{where}.elongation",
                f"{where}.elongation is {mm(self.elongation)}, but must be greater than zero.",
                self.elongation,
            )


@dataclass(frozen=True, kw_only=True)
class DisplacedPocket(BallCageDefect):
    """Pocket bored at another place; its axis stays radial.

    ``circumferential`` is an arc on the pitch circle.
    """

    type: str = defect_type("displaced")
    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    axial: float = quantity("mm", 0.0, doc="shift of the pocket's axis towards +x")
    circumferential: float = quantity("mm", 0.0, doc="shift of the axis towards pocket k+1")

    def alter(self, shapes: PocketShapes) -> None:
        shapes.centre[self.pocket] += (self.axial, self.circumferential)

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> list[Reading]:
        found = _measured(mesh, cage, self.pocket, pitch_radius).centre[0]
        sizes = zip(_DIRECTIONS, (self.axial, self.circumferential), found)
        return [
            Reading(f"{self.type} {name}", asked, [float(size)])
            for name, asked, size in sizes
            if asked
        ]

    def changes(self, count: int) -> dict[tuple[int, str], float]:
        return {(self.pocket, "place"): 0.0}

    @property
    def legend(self) -> Sequence[Mark]:
        return (
            Mark("patch", "moved", "pocket displaced"),
            Mark("dashes", "sound", f"{_RIM}; arrow: way of the pocket"),
        )

    def way(self, count: int) -> tuple[float, np.ndarray] | None:
        way = self.circumferential * around(self.place, count)
        way[0] = self.axial
        size = float(np.linalg.norm(way))
        return (-0.3, way / size) if size else None  # below the pocket's name

    @property
    def label(self) -> str:
        parts = {"axially": self.axial, "along ψ": self.circumferential}
        moved = " and ".join(f"{signed_mm(size)} {way}" for way, size in parts.items() if size)
        return f"pocket {self.pocket} displaced, {moved or 'by nothing'}"

    def in_words(self, count: int) -> str:
        ahead = (self.pocket + (1 if self.circumferential > 0.0 else -1)) % count
        ways = {
            f"towards {'+x' if self.axial > 0.0 else '-x'}": self.axial,
            f"towards pocket {ahead}": self.circumferential,
        }
        moved = " and ".join(f"{_size(size)} {way}" for way, size in ways.items() if size)
        return f"pocket {self.pocket} is displaced by {moved or 'nothing'}"


@dataclass(frozen=True, kw_only=True)
class WebCrack(BallCageDefect):
    """A slit without width in the plane half-way between two pockets, which holds the cage's axis.

    It goes through the whole wall, from the cage's end ``side`` inwards over ``share`` of the
    cage's width. It stays open: its faces exert no force on each other.
    """

    part: ClassVar[str] = "web"

    type: str = defect_type("crack")
    web: int = option(doc="web number, 0 .. Z-1; web k is between pockets k-1 and k", minimum=0)
    side: str = option("+x", doc="the end of the cage where it begins", choices=("+x", "-x"))
    share: float = option(doc="its length over the cage's width, between 0 and 1")

    def move_stations(self, offset: np.ndarray, stations: np.ndarray) -> None:
        """Add what it moves of the pockets' stations (angles [rad] from +psi towards +x) beyond
        their shapes to ``offset`` (Z, n_st, 3) [m], components (x, r, psi)."""

    def extent(self, cage: Cage) -> float:
        return self.share * cage.width

    def tips(self, cage: BallCage) -> Sequence[float]:
        return (abs(0.5 - self.share) * cage.width,)

    def opened(self, sound: CageMesh, mesh: CageMesh, cage: Any) -> CageMesh:
        from flexcage.cages.round_pocket.crack import open_crack

        return open_crack(sound, mesh, cage, self.web, self.side, self.share)

    def readings(self, mesh: Any, cage: Any, *, pitch_radius: float) -> list[Reading]:
        from flexcage.cages.round_pocket.measure import crack_length

        length = crack_length(mesh, self.web, self.side)
        return [Reading(self.type, self.share * cage.width, [length])]

    @property
    def legend(self) -> Sequence[Mark]:
        return (Mark("line", "crack", "crack through the whole wall"),)

    def lines(self, points: np.ndarray, count: int) -> list[CageLine]:
        """On the outside, across the end, and on the inside of the cage."""
        psi = 2.0 * pi * self.place / count
        radial, axis = np.array([0.0, np.cos(psi), np.sin(psi)]), np.array([1.0, 0.0, 0.0])
        r, half = np.hypot(points[:, 1], points[:, 2]), float(points[:, 0].max())
        end = half if self.side == "+x" else -half
        tip = end * (1.0 - 2.0 * self.share)
        places = [(tip, r.max()), (end, r.max()), (end, r.min()), (tip, r.min())]
        path = np.array([x * axis + radius * radial for x, radius in places])
        return [CageLine(np.array([a, b]), 0.5 * (a + b)) for a, b in zip(path, path[1:])]

    @property
    def label(self) -> str:
        side, share = self.side.replace("-", "−"), 100.0 * self.share
        return f"web {self.web} cracked from the end {side}, {share:g} % of the width"

    def in_words(self, count: int) -> str:
        return (
            f"web {self.web}, between pockets {(self.web - 1) % count} and {self.web}, is "
            f"cracked from the end {self.side} over {100.0 * self.share:g} % of the cage's width"
        )

    def check(self, where: str, cage: Cage, count: int) -> Iterator[Finding]:
        yield from self.check_number(where, count)
        if self.side not in ("+x", "-x"):
            yield f"{where}.side", f"{where}.side is {self.side!r}, but must be '+x' or '-x'.", None
        if not 0.0 < self.share < 1.0:
            yield (
                f"{where}.share",
                f"{where}.share is {self.share:g}, but a crack is longer than 0 and shorter than "
                "the cage's width, 1.",
                self.share,
            )

    @classmethod
    def check_together(cls, own: Sequence[WebCrack], count: int) -> Iterator[Finding]:
        return find_repeated([crack.web for crack in own], "cracks")


def find_repeated(webs: list[int], what: str) -> Iterator[Finding]:
    """A web with several defects of a kind of which it has one at most."""
    for web in webs:
        if webs.count(web) > 1:
            yield "defects", f"Web {web} has {webs.count(web)} {what}; give each web one.", web


def _measured(mesh: CageMesh, cage: BallCage, pocket: int, pitch_radius: float) -> PocketShapes:
    from flexcage.cages.round_pocket.measure import measure_pockets

    sphere = is_sphere(cage)
    return measure_pockets(mesh, [pocket], pitch_radius=pitch_radius, spherical=sphere)


def pocket_shapes(
    cage: BallCage, defects: Sequence[BallCageDefect], *, pocket_count: int
) -> PocketShapes:
    """Axis, radius and straight lengths of every pocket; several defects of one pocket add up."""
    shapes = PocketShapes(
        np.zeros((pocket_count, 2)),
        np.full(pocket_count, 0.5 * cage.pocket_diameter),
        np.zeros((pocket_count, 2)),
    )
    for defect in defects:
        defect.alter(shapes)
    return shapes


def check_pockets(
    defects: Sequence[BallCageDefect],
    cage: BallCage,
    *,
    pocket_count: int,
    pitch_diameter: float,
    ball_diameter: float = 0.0,
) -> None:
    """Refuse defects that together leave no web, rim or room."""
    shapes = pocket_shapes(cage, defects, pocket_count=pocket_count)
    raise_first(_find_in_pockets(cage, shapes, ball_diameter))
    raise_first(_find_in_openings(cage, shapes, 0.5 * pitch_diameter))
    webs = web_thickness(cage, shapes, pitch_diameter=pitch_diameter)
    if webs.min() <= 0.0:
        k = int(np.argmin(webs))
        raise InputError(
            f"Pockets {(k - 1) % pocket_count} and {k} run into each other: web {k} would be "
            f"{mm(webs[k])} thick, but must be thicker than zero; displace or widen these pockets "
            "less.",
            where="defects",
            value=float(webs[k]),
        )


def _find_in_pockets(
    cage: BallCage, shapes: PocketShapes, ball_diameter: float
) -> Iterator[Finding]:
    for k, radius in enumerate(shapes.radius):
        if not 2.0 * radius > ball_diameter:
            what = f"the ball's, {mm(ball_diameter)}" if ball_diameter else "zero"
            yield (
                "defects",
                f"The defects leave pocket {k} a diameter of {mm(2.0 * radius)}; it must be "
                f"greater than {what}.",
                float(2.0 * radius),
            )
        end = abs(shapes.centre[k, 0]) + radius + shapes.slot[k, 0]
        if not end < 0.5 * cage.width:
            yield (
                "defects",
                f"The defects let pocket {k} reach {mm(end)} from the cage's middle, through the "
                f"cage's end at {mm(0.5 * cage.width)}.",
                float(end),
            )


def _find_in_openings(
    cage: BallCage, shapes: PocketShapes, pitch_radius: float
) -> Iterator[Finding]:
    for name, diameter in (("bore", cage.bore), ("outside", cage.outside_diameter)):
        open_ = level_radius(cage, shapes.radius.min(), np.array(0.5 * diameter), pitch_radius)
        if not open_ > 0.0:
            yield (
                "cage.pocket_shape",
                f"A spherical pocket of {mm(2.0 * shapes.radius.min())} about the pitch circle of "
                f"{mm(2.0 * pitch_radius)} does not open at the cage's {name} of {mm(diameter)}.",
                cage.pocket_shape,
            )


def _size(value: float) -> str:
    return typeset(abs(value), "mm")
