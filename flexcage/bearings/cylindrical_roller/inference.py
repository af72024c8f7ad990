"""Number and length of the rollers inside a catalogue's bearing, from its outline and ratings.

Race diameters F and E give the rollers' diameter, C0 the product of number and effective length.
C says hardly more than C0 (number and length count alike in both), so that lengths of standard
rollers and usual distances between rollers decide.
"""

from __future__ import annotations

from dataclasses import replace
from math import ceil, pi, sin
from typing import Any

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.cylindrical_roller.designs import DESIGNS
from flexcage.bearings.cylindrical_roller.ratings import static_rating
from flexcage.core.binding import check_value
from flexcage.core.errors import InputError
from flexcage.core.units import describe
from flexcage.geometry.inference import Candidate, Outline, rounded

_LONGEST = 1.6  # length over diameter of rollers
_WIDEST = 0.74  # length over the bearing's width: ribs remain at both sides
_CLOSEST = 0.92  # roller over the distance of two rollers: crossbeams of a cage remain
_USUAL = 0.815  # likewise, in bearings of today
_CHAMFER, _CHAMFER_SLOPE = 0.27e-3, 0.03  # usual end chamfer [m] of rollers of diameter 0, and more
_SHORTEST_CHAMFER, _LONGEST_CHAMFER = 0.02, 0.1  # of the diameter
_RIB = 0.22  # a rib's height over the roller's diameter
_PLAY = 30e-6  # m, axially between the ribs
_CLEARANCE = 20e-6  # m
_LARGEST = 0.15  # m, a roller's diameter


def candidates(outline: Outline) -> list[Candidate]:
    """Rollers of the diameter that the races leave, as long as or longer than it."""
    inner = outline.required("inner_race_diameter", "the race diameter F (--inner-race)")
    outer = outline.required("outer_race_diameter", "the race diameter E (--outer-race)")
    diameter, pitch = 0.5 * (outer - inner), 0.5 * (outer + inner)
    check_design(outline)
    if diameter <= 0.0:
        raise races_the_wrong_way(inner, outer)
    found = []
    for length in lengths(outline, diameter, _LONGEST):
        for count in range(6, 60):
            share = diameter / (pitch * sin(pi / count))
            if share > _CLOSEST:
                break
            made = candidate(outline, length, count)
            how = f"inferred from C0: a roller takes {share:.0%} of the distance of two"
            crowded = (share - _USUAL) / (0.03 if share > _USUAL else 0.1)
            found.append(replace(made, reasons={**made.reasons, "roller_count": how},
                                 unlikely=made.unlikely + crowded**2))  # fmt: skip
    return found


def check_design(outline: Outline) -> None:
    """Raise InputError for a design that there is not."""
    check_value(outline.design or "N", RollerBearing.__dataclass_fields__["design"].metadata,
                "--design")  # fmt: skip


def races_the_wrong_way(inner: float, outer: float) -> InputError:
    """The sentence on race diameters [m] between which no roller goes."""
    return InputError(
        f"The race diameter E, {describe(outer, 'mm')}, must be greater than F, "
        f"{describe(inner, 'mm')}.",
        where="--outer-race",
    )


def lengths(outline: Outline, diameter: float, longest: float) -> list[float]:
    """Lengths [m] that rollers of a diameter [m] may have, in steps of half a millimetre, up to
    ``longest`` times the diameter and as far as ribs remain."""
    most = min(longest * min(diameter, _LARGEST), _WIDEST * outline.width)
    steps = range(ceil(2e3 * diameter - 1e-6), int(2e3 * most) + 1)
    found = {round(diameter, 9), *(round(0.5e-3 * k, 9) for k in steps)}
    return sorted(length for length in found if length <= most)


def candidate(outline: Outline, length: float, count: int) -> Candidate:
    """So many rollers of a length [m] between the outline's races, with the chamfers that C0
    leaves them."""
    inner, outer = outline.inner_race_diameter or 0.0, outline.outer_race_diameter or 0.0
    diameter = 0.5 * (outer - inner)
    bearing = RollerBearing(
        **outline.boundary,
        designation=outline.designation,
        inner_race_diameter=inner,
        outer_race_diameter=outer,
        roller_diameter=round(diameter, 9),
        roller_length=round(length, 9),
        effective_length=round(length, 9),
        roller_count=count,
        radial_clearance=outline.clearance_in_operation(_CLEARANCE)[0],
        **_ribs(outline, length, diameter),
    )
    due = length * outline.static_rating / static_rating(bearing)
    least, most = (2.0 * k * diameter for k in (_SHORTEST_CHAMFER, _LONGEST_CHAMFER))
    effective = rounded(min(max(due, length - most), length - least), 10e-6)
    bearing = replace(bearing, effective_length=effective)
    chamfer = 0.5 * (length - effective)
    off = (chamfer - _CHAMFER - _CHAMFER_SLOPE * diameter) / 0.12e-3
    whole = round(length - diameter, 9) == 0.0 or round(1e3 * length, 6).is_integer()
    return Candidate(
        outline=outline, bearing=bearing, reasons=_reasons(outline, bearing, chamfer),
        unlikely=off**2 + (0.0 if whole else 2.0),
    )  # fmt: skip


def _ribs(outline: Outline, length: float, roller: float) -> dict[str, Any]:
    """Fields of the ribs that the design has, by a roller's length and diameter [m]; diameters of
    the catalogue, or usual ones."""
    name = outline.design or "N"
    design = DESIGNS[name]
    found: dict[str, Any] = {"design": name}
    for ring, prefix in ((design.guide, ""), (design.other, "counter_")):
        if prefix and not design.counter:
            continue
        race, known = getattr(outline, f"{ring}_race_diameter"), _rib_diameter(outline, ring)
        sense = 1.0 if ring == "inner" else -1.0
        usual = rounded(race + sense * 2.0 * _RIB * roller, 0.1e-3)
        found[f"{prefix}rib_diameter"] = usual if known is None else known
        found[f"{prefix}rib_gap"] = round(length + _PLAY, 9)
    return found


def _rib_diameter(outline: Outline, ring: str) -> float | None:
    """Diameter [m] of a ring's ribs, where the catalogue has it."""
    found: float | None = getattr(outline, f"{ring}_rib_diameter")
    return found


def _reasons(outline: Outline, bearing: RollerBearing, chamfer: float) -> dict[str, str]:
    size = f"{1e3 * bearing.roller_diameter:g} x {1e3 * bearing.roller_length:g}"
    return {
        "roller_diameter": "from the race diameters: (E - F)/2",
        "roller_length": f"inferred from C0: a roller {size}",
        "effective_length": f"inferred from C0: the length less chamfers of {1e3 * chamfer:.2g} mm",
        "radial_clearance": outline.clearance_in_operation(_CLEARANCE)[1],
        **_reasons_of_ribs(outline),
    }


def _reasons_of_ribs(outline: Outline) -> dict[str, str]:
    design, found = DESIGNS[outline.design or "N"], {}
    for ring, prefix in ((design.guide, ""), (design.other, "counter_")):
        if prefix and not design.counter:
            continue
        known = _rib_diameter(outline, ring) is not None
        usual = f"assumption: ribs {_RIB:.0%} of the roller's diameter high"
        given = f"given: ribs of the {ring} ring"
        found[f"{prefix}rib_diameter"] = given if known else usual
        found[f"{prefix}rib_gap"] = "assumption: axial play of 0.03 mm for the roller"
    return found
