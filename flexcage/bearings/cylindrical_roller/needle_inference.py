"""Needles inside a catalogue's needle roller bearing: diameter, number and length, from its
boundary dimensions and ratings.

C0 tells the product of number, diameter and length; at a given C0 the dynamic rating grows with
about the 0.3rd power of the diameter, which so tells the diameter, among those of ISO 3096. Sheets
of cups, and how close makers set needles, decide what is left.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from math import pi, sin

from flexcage.bearings.cylindrical_roller.needle import (
    SLENDER,
    DrawnCupNeedleRollerBearing,
    NeedleRollerBearing,
)
from flexcage.core.units import describe
from flexcage.geometry.full_complement import FULL, elements_around, filling_count, reason_of_count
from flexcage.geometry.inference import Candidate, Outline, rounded

TYPES = {
    "needle_roller": NeedleRollerBearing,
    "drawn_cup_needle_roller": DrawnCupNeedleRollerBearing,
}
_DIAMETERS = (1e-3, 1.5e-3, 2e-3, 2.5e-3, 3e-3, 3.5e-3, 4e-3, 5e-3, 6e-3)  # ISO 3096
_STEP = 0.1e-3  # m, of lengths
_END, _LEAST_END = 0.2e-3, 0.1e-3  # m: usual rounding of a needle's end, and the least
_SHEETS = ((2e-3, 0.5e-3), (1.0, 1e-3))  # of cups: section up to, usual wall [m]
_WALL = 0.5  # of a machined ring, over the section
_SPREAD = 0.12  # of the wall, over the section
_CLOSE, _CLOSE_SPREAD = 0.62, 0.05  # number of needles over those that fill the circle
_SIDE = 0.5  # width of a cage's side beam over the needle's diameter
_THIN = 0.8  # lips of a cup without a cage, over the wall
_PLAY = 0.2e-3  # m, along the axis between ribs, of cage or needles
_OFF = 0.8e-3  # m, by which lengths differ from those that leave such side beams
_RIB, _RIB_BORE = 0.06, 0.5  # a machined rib over the width; its bore above F over the diameter
_CLEARANCE = 20e-6  # m
_FILLED = 0.9  # of ISO 281's C: what makers rate drawn cups at whose needles fill the circle


def candidates(outline: Outline) -> list[Candidate]:
    """Needles of each diameter and number that leave an outer ring and cage, or fill the circle."""
    bore = outline.inner_race_diameter or outline.bore
    found = []
    for diameter in _DIAMETERS:
        races = replace(
            outline, inner_race_diameter=bore, outer_race_diameter=round(bore + 2.0 * diameter, 9)
        )
        for count in _counts(outline, diameter, bore + diameter):
            found += [replace(made, outline=outline) for made in _made(races, diameter, count)]
    return found


def _counts(outline: Outline, diameter: float, pitch: float) -> Iterator[int]:
    if outline.complement == FULL:
        yield filling_count(diameter, pitch)
        return
    around = elements_around(diameter, pitch)
    yield from range(max(3, int(0.45 * around)), int(0.82 * around) + 1)


def _made(outline: Outline, diameter: float, count: int) -> Iterator[Candidate]:
    """The needles' length that C0 asks for, if there is one."""
    bore, race = outline.inner_race_diameter or 0.0, outline.outer_race_diameter or 0.0
    wall, full = 0.5 * (outline.outside_diameter - race), outline.complement == FULL
    spec = TYPES[outline.type]
    cup = spec is DrawnCupNeedleRollerBearing
    lip = (_THIN * wall if full else wall) if cup else _RIB * outline.width
    gap = outline.width - 2.0 * lip
    gamma = diameter / (bore + diameter)
    due = 1e-6 * outline.static_rating / (44.0 * (1.0 - gamma) * count * diameter)
    length = rounded(due + 2.0 * _END, _STEP)
    slender = SLENDER[0] <= length / diameter <= SLENDER[1]
    if not (spec.walls[0] <= wall <= spec.walls[1] and 0.15 * diameter <= wall and slender):
        return
    if length + (0.5 * _PLAY if full else 2.0 * _PLAY) > gap:
        return
    ribs = min(length + _PLAY, gap) if full else gap
    bearing = spec(
        **outline.boundary, designation=outline.designation, inner_race_diameter=bore,
        outer_race_diameter=race, roller_diameter=diameter, roller_length=length,
        effective_length=rounded(due, 10e-6), roller_count=count, radial_clearance=_CLEARANCE,
        rib_diameter=rounded(bore + _RIB_BORE * diameter, 0.1e-3), rib_gap=rounded(ribs, 10e-6),
    )  # fmt: skip
    yield Candidate(
        outline=outline, bearing=bearing, reasons=_reasons(bearing, cup, full),
        unlikely=_unlikely(bearing, wall, lip, cup, full), least_factor=_FILLED if full else 1.0,
    )  # fmt: skip


def _unlikely(b: NeedleRollerBearing, wall: float, lip: float, cup: bool, full: bool) -> float:
    section = 0.5 * (b.outside_diameter - b.inner_race_diameter)
    usual = next(w for upto, w in _SHEETS if section <= upto) if cup else _WALL * section
    found = ((wall - usual) / (_SPREAD * section)) ** 2
    beams = 0.0 if full else _SIDE * b.roller_diameter
    found += ((b.width - b.roller_length - 2.0 * (lip + beams)) / _OFF) ** 2
    if full:
        return float(found)
    close = b.roller_count / elements_around(b.roller_diameter, b.pitch_diameter)
    return float(found + ((close - _CLOSE) / _CLOSE_SPREAD) ** 2)


def _reasons(b: NeedleRollerBearing, cup: bool, full: bool) -> dict[str, str]:
    """How each value was found."""
    wall = 0.5 * (b.outside_diameter - b.outer_race_diameter)
    size = f"{1e3 * b.roller_diameter:g} x {1e3 * b.roller_length:g}"
    share = b.gamma / sin(pi / b.roller_count)
    lips = "as thick as the wall" if cup else f"{_RIB:g} of the width thick"
    without = {} if b.has_inner_ring else {"bore": "given: F; the needles run on the shaft"}
    return {
        **without,
        "outer_race_diameter": f"inferred: F + 2 Dw, under a wall of {describe(wall, 'mm')}",
        "roller_diameter": "inferred from C and C0, of ISO 3096",
        "roller_length": f"inferred from C0: a needle {size}",
        "effective_length": "inferred from C0: the length less rounded ends",
        "roller_count": reason_of_count(b) if full
        else f"inferred from C0: a needle takes {share:.0%} of the distance of two",
        "radial_clearance": "assumption: in operation, on a shaft of h5 or h6",
        "rib_diameter": f"assumption: {_RIB_BORE:g} Dw above F",
        "rib_gap": "assumption: axial play of 0.2 mm for the needles" if full
        else f"assumption: lips {lips}",
    }  # fmt: skip
