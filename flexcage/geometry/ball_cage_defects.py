"""Defects of ball cages: frozen specs, their checks, and where they leave the pockets' walls.

A pocket's axis is radial. Its wall, cut by any plane across that axis, is a circle or, elongated,
a slot: that circle swept along a straight line. The circle has the pocket's radius where the
pocket is cylindrical; a spherical one has it at the pitch radius alone. Web k lies between the
pockets k-1 and k (mod Z), thinnest at the pockets' waist.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import singledispatch
from math import pi
from typing import ClassVar

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.spec import option, quantity
from flexcage.core.units import describe
from flexcage.geometry.ball_cages import BallCage
from flexcage.geometry.ribbon_cage import RibbonCage

_DIRECTIONS = ("axial", "circumferential")
_SPACING = 1  # what tells the seed of pockets' places from that of ball diameters
Finding = tuple[str, str, object]  # where, sentence, value


@dataclass(frozen=True, kw_only=True)
class EnlargedPocket:
    """Pocket bored to another diameter about the same axis; < 0 makes it smaller."""

    tag: ClassVar[str] = "enlarged"

    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    increase: float = quantity("mm", doc="what is added to the pocket's diameter")


@dataclass(frozen=True, kw_only=True)
class ElongatedPocket:
    """Pocket made a slot: its wall swept along a straight line of the length ``elongation``."""

    tag: ClassVar[str] = "elongated"

    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    direction: str = option(doc="along which the pocket is longer", choices=_DIRECTIONS)
    elongation: float = quantity("mm", doc="straight length of the slot", above=0.0)


@dataclass(frozen=True, kw_only=True)
class DisplacedPocket:
    """Pocket bored at another place; its axis stays radial.

    ``circumferential`` is an arc on the pitch circle.
    """

    tag: ClassVar[str] = "displaced"

    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    axial: float = quantity("mm", 0.0, doc="shift of the pocket's axis towards +x")
    circumferential: float = quantity("mm", 0.0, doc="shift of the axis towards pocket k+1")


@dataclass(frozen=True, kw_only=True)
class WebCrack:
    """A slit without width in the plane half-way between two pockets, which holds the cage's axis.

    It goes through the whole wall, from the cage's end ``side`` inwards over ``share`` of the
    cage's width. It stays open: its faces exert no force on each other.
    """

    tag: ClassVar[str] = "crack"

    web: int = option(doc="web number, 0 .. Z-1; web k is between pockets k-1 and k", minimum=0)
    side: str = option("+x", doc="the end of the cage where it begins", choices=("+x", "-x"))
    share: float = option(doc="its length over the cage's width, between 0 and 1")


@dataclass(frozen=True, kw_only=True)
class MissingRivet:
    """A rivet of a ribbon cage that broke or came off: its halves are free of each other there."""

    tag: ClassVar[str] = "missing_rivet"

    web: int = option(doc="web number, 0 .. Z-1; web k is between pockets k-1 and k", minimum=0)


BallCageDefect = EnlargedPocket | ElongatedPocket | DisplacedPocket | WebCrack | MissingRivet


def uneven_pockets(cage: object, pocket_count: int, seed: int) -> tuple[DisplacedPocket, ...]:
    """Pockets displaced around a ball cage at random by its ``pocket_scatter``, not on average;
    none for other cages."""
    if not isinstance(cage, BallCage) or cage.pocket_scatter == 0.0:
        return ()
    shift = np.random.default_rng([seed, _SPACING]).standard_normal(pocket_count)
    shift = cage.pocket_scatter * (shift - shift.mean())
    return tuple(DisplacedPocket(pocket=k, circumferential=float(s)) for k, s in enumerate(shift))


def cracks_of(defects: Sequence[object]) -> list[WebCrack]:
    """The cracks among some defects."""
    return [defect for defect in defects if isinstance(defect, WebCrack)]


@dataclass(frozen=True)
class PocketShapes:
    """Where the wall of every pocket is, with its defects."""

    centre: np.ndarray  # (Z, 2) axial and circumferential shift of the axis [m] at pitch radius
    radius: np.ndarray  # (Z,) [m]
    slot: np.ndarray  # (Z, 2) half straight lengths along x and psi [m]


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
        _add(defect, shapes)
    return shapes


@singledispatch
def _add(defect: object, shapes: PocketShapes) -> None:
    raise InputError(
        f"a {type(defect).__name__} is no defect of a ball cage; those are enlarged, elongated "
        "and displaced pockets, cracks and missing rivets.",
        where="defects",
    )


@_add.register
def _(defect: EnlargedPocket, shapes: PocketShapes) -> None:
    shapes.radius[defect.pocket] += 0.5 * defect.increase


@_add.register
def _(defect: ElongatedPocket, shapes: PocketShapes) -> None:
    along = _DIRECTIONS.index(defect.direction)
    shapes.slot[defect.pocket, along] += 0.5 * defect.elongation


@_add.register
def _(defect: DisplacedPocket, shapes: PocketShapes) -> None:
    shapes.centre[defect.pocket] += (defect.axial, defect.circumferential)


@_add.register(WebCrack)
@_add.register(MissingRivet)
def _(defect: object, shapes: PocketShapes) -> None:
    """Neither moves a pocket's wall."""


def wall_reach(direction: np.ndarray, radius: float | np.ndarray, slot: np.ndarray) -> np.ndarray:
    """Distance (n,) [m] from a slot's middle to its wall along unit directions (n, 2) in x, psi.

    ``radius`` [m] is that of all or of each direction (n,).
    """
    along, half = np.abs(direction), np.asarray(slot, float)
    radius = np.broadcast_to(radius, len(along))
    with np.errstate(
        divide="ignore", invalid="ignore"
    ):  # to the straight walls at +-psi and at +-x
        flat = (half[::-1] + radius[:, None]) / along[:, ::-1]
    straight = [flat[:, i] * along[:, i] <= half[i] for i in range(2)]
    middle = along @ half
    corner = middle + np.sqrt(np.maximum(middle**2 - half @ half + radius**2, 0.0))
    return np.where(straight[0], flat[:, 0], np.where(straight[1], flat[:, 1], corner))


def is_sphere(cage: BallCage) -> bool:
    """Are the pockets spherical?"""
    return cage.pocket_shape == "spherical"


def level_radius(
    cage: BallCage, radius: float, height: np.ndarray, pitch_radius: float
) -> np.ndarray:
    """Radius [m] of a pocket's circle at heights [m] along its axis from the cage's axis."""
    if not is_sphere(cage):
        return np.full(np.shape(height), radius)
    return np.sqrt(np.maximum(radius**2 - (height - pitch_radius) ** 2, 0.0))


def web_thickness(cage: BallCage, shapes: PocketShapes, *, pitch_diameter: float) -> np.ndarray:
    """Least thickness (Z,) [m] of each web along the circumference, at any radius; < 0: none."""
    pitch_radius = 0.5 * pitch_diameter
    radii = np.linspace(0.5 * cage.bore, 0.5 * cage.outside_diameter, 21)[:, None]
    x = np.linspace(-0.5, 0.5, 2001) * cage.width
    ahead, behind = [], []
    for (shift, arc), hole, slot in zip(shapes.centre, shapes.radius, shapes.slot):
        circle = level_radius(cage, hole, radii, pitch_radius)
        inside = circle**2 - np.maximum(np.abs(x - shift) - slot[0], 0.0) ** 2
        half = np.where(inside > 0.0, slot[1] + np.sqrt(np.maximum(inside, 0.0)), 0.0)
        reach = np.arcsin(np.minimum(half / radii, 1.0))
        ahead.append(arc / pitch_radius + reach)
        behind.append(arc / pitch_radius - reach)
    gap = 2.0 * pi / len(ahead) + np.array(behind) - np.roll(ahead, 1, axis=0)
    return (radii * gap).min(axis=(1, 2))


def check_ball_cage(cage: BallCage, *, pocket_count: int) -> None:
    """Refuse a ball cage whose dimensions leave no body."""
    for name, what in cage.impossible(pocket_count):
        value, where = getattr(cage, name), f"cage.{name}"
        raise InputError(f"{where}, {_mm(value)}, {what}.", where=where, value=value)


def check_ball_defects(
    defects: Sequence[BallCageDefect],
    cage: BallCage,
    *,
    pocket_count: int,
    pitch_diameter: float,
    ball_diameter: float = 0.0,
) -> None:
    """Refuse a defect of a pocket or web that is not there, or that leaves no web, rim or room."""
    for i, defect in enumerate(defects):
        _raise_first(_find_foreign(cage, defect, f"defects.{i}"))
        _raise_first(_find(defect, f"defects.{i}", pocket_count))
    _raise_first(_find_in_webs(defects, pocket_count))
    if isinstance(cage, RibbonCage):
        return
    shapes = pocket_shapes(cage, defects, pocket_count=pocket_count)
    _raise_first(_find_in_pockets(cage, shapes, ball_diameter))
    _raise_first(_find_in_openings(cage, shapes, 0.5 * pitch_diameter))
    webs = web_thickness(cage, shapes, pitch_diameter=pitch_diameter)
    if webs.min() <= 0.0:
        k = int(np.argmin(webs))
        raise InputError(
            f"Pockets {(k - 1) % pocket_count} and {k} run into each other: web {k} would be "
            f"{_mm(webs[k])} thick, but must be thicker than zero; displace or widen these pockets "
            "less.",
            where="defects",
            value=float(webs[k]),
        )


def _raise_first(findings: Iterator[Finding]) -> None:
    for where, sentence, value in findings:
        raise InputError(sentence, where=where, value=value)


@singledispatch
def _find(defect: object, where: str, count: int) -> Iterator[Finding]:
    """What is impossible in one defect alone."""
    yield (
        where,
        f"{where} is a {type(defect).__name__}, but a ball cage's defects are enlarged, elongated "
        "and displaced pockets, cracks and missing rivets.",
        type(defect).__name__,
    )


def _find_number(where: str, name: str, number: int, count: int) -> Iterator[Finding]:
    if not 0 <= number < count:
        yield (
            f"{where}.{name}",
            f"{where}.{name} is {number}, but the cage's {name}s are numbered 0 to {count - 1}.",
            number,
        )


@_find.register
def _(defect: EnlargedPocket, where: str, count: int) -> Iterator[Finding]:
    return _find_number(where, "pocket", defect.pocket, count)


@_find.register
def _(defect: DisplacedPocket, where: str, count: int) -> Iterator[Finding]:
    return _find_number(where, "pocket", defect.pocket, count)


@_find.register
def _(defect: ElongatedPocket, where: str, count: int) -> Iterator[Finding]:
    yield from _find_number(where, "pocket", defect.pocket, count)
    if defect.direction not in _DIRECTIONS:
        yield (
            f"{where}.direction",
            f"{where}.direction is {defect.direction!r}, but must be 'axial' or 'circumferential'.",
            defect.direction,
        )
    if not defect.elongation > 0.0:
        yield (
            f"{where}.elongation",
            f"{where}.elongation is {_mm(defect.elongation)}, but must be greater than zero.",
            defect.elongation,
        )


@_find.register
def _(defect: WebCrack, where: str, count: int) -> Iterator[Finding]:
    yield from _find_number(where, "web", defect.web, count)
    if defect.side not in ("+x", "-x"):
        yield f"{where}.side", f"{where}.side is {defect.side!r}, but must be '+x' or '-x'.", None
    if not 0.0 < defect.share < 1.0:
        yield (
            f"{where}.share",
            f"{where}.share is {defect.share:g}, but a crack is longer than 0 and shorter than the "
            "cage's width, 1.",
            defect.share,
        )


@_find.register
def _(defect: MissingRivet, where: str, count: int) -> Iterator[Finding]:
    return _find_number(where, "web", defect.web, count)


def _find_foreign(cage: BallCage, defect: object, where: str) -> Iterator[Finding]:
    """A defect of the other kind of ball cage."""
    if isinstance(cage, RibbonCage) != isinstance(defect, MissingRivet):
        tag = getattr(type(defect), "tag", type(defect).__name__)
        yield (
            where,
            f"{where} is '{tag}', but the cage is of the kind '{cage.type}': ribbon cages may have "
            "'missing_rivet' alone, and machined ones all other defects.",
            tag,
        )


def _find_in_webs(defects: Sequence[BallCageDefect], count: int) -> Iterator[Finding]:
    for kind, what in ((WebCrack, "cracks"), (MissingRivet, "missing rivets")):
        webs = [d.web for d in defects if isinstance(d, kind)]
        for web in webs:
            if webs.count(web) > 1:
                yield "defects", f"Web {web} has {webs.count(web)} {what}; give each web one.", web
    missing = sum(isinstance(d, MissingRivet) for d in defects)
    if missing == count:
        yield "defects", f"All {count} rivets are missing; leave the halves one at least.", missing


def _find_in_pockets(
    cage: BallCage, shapes: PocketShapes, ball_diameter: float
) -> Iterator[Finding]:
    for k, radius in enumerate(shapes.radius):
        if not 2.0 * radius > ball_diameter:
            what = f"the ball's, {_mm(ball_diameter)}" if ball_diameter else "zero"
            yield (
                "defects",
                f"The defects leave pocket {k} a diameter of {_mm(2.0 * radius)}; it must be "
                f"greater than {what}.",
                float(2.0 * radius),
            )
        end = abs(shapes.centre[k, 0]) + radius + shapes.slot[k, 0]
        if not end < 0.5 * cage.width:
            yield (
                "defects",
                f"The defects let pocket {k} reach {_mm(end)} from the cage's middle, through the "
                f"cage's end at {_mm(0.5 * cage.width)}.",
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
                f"A spherical pocket of {_mm(2.0 * shapes.radius.min())} about the pitch circle of "
                f"{_mm(2.0 * pitch_radius)} does not open at the cage's {name} of {_mm(diameter)}.",
                cage.pocket_shape,
            )


def _mm(value: float) -> str:
    return describe(value, "mm")
