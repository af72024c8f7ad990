"""Number and size of the rollers inside a catalogue's tapered roller bearing, from its outline,
contact angle and ratings.

ISO 355 has the outer race's diameter E at its small end, so that the outer race is known, and walls
of both rings tell the rollers' diameter; without E a usual one is likely. C0 tells the product of
number and effective length. C says hardly more than C0, so that usual distances between rollers,
and lengths of rollers over that of the outer ring, decide.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import asin, cos, pi, sin, tan
from typing import Any

from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.bearings.tapered_roller.ratings import static_rating
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import name_of
from flexcage.geometry.inference import Candidate, Inference, Outline, rounded

_SMALLEST, _USUAL_SIZE, _LARGEST = (
    0.18,
    0.24,
    0.36,
)  # a roller's diameter over the rings' height (D - d)
_CLOSEST, _USUAL = 0.95, 0.89  # roller over the distance of two: bars of a pressed cage remain
_LONGEST, _USUAL_LENGTH = 0.92, 0.75  # roller over the outer ring's width
_CHAMFER, _CHAMFER_SLOPE = 0.27e-3, 0.03  # as of cylindrical rollers
_WALLS = 1.0  # the inner ring's least wall over the outer's
_INNER_WIDTH, _OUTER_WIDTH = 0.93, 0.79  # over T, where nobody says
_RIB = 0.22  # the large rib's height over the roller's diameter
_END = 0.9  # radius of an end's sphere over its distance from the apex: 0.85 to 0.95 are usual
_STEP = 0.1e-3  # m


@dataclass(frozen=True)
class _Rings:
    """What is known of the rings of an outline [m, rad], or assumed, and why."""

    angle: float
    inner_width: float
    outer_width: float
    middle: float | None  # diameter of the outer race, halfway along the outer ring
    reasons: Mapping[str, str]


def candidates(outline: Outline) -> list[Candidate]:
    """Every number of every roller, in steps of a tenth of a millimetre, that has room."""
    rings, height = _rings(outline), outline.outside_diameter - outline.bore
    steps = range(int(_SMALLEST * height / _STEP), int(_LARGEST * height / _STEP) + 1)
    return [c for k in steps for c in _of_diameter(outline, rings, round(k * _STEP, 7))]


def _rings(outline: Outline) -> _Rings:
    angle = outline.required("contact_angle", "the contact angle (--contact-angle)")
    given, reasons = outline.further, {}
    widths = []
    for key, share in (("inner_width", _INNER_WIDTH), ("outer_width", _OUTER_WIDTH)):
        widths.append(given.get(key) or rounded(share * outline.width, 0.25e-3))
        usual = f"assumption: {share:g} of the width T"
        reasons[key] = "given: ISO 355" if key in given else usual
    small = given.get("outer_small_end")
    middle = None if small is None else small + widths[1] * tan(angle)
    return _Rings(angle, widths[0], widths[1], middle, reasons)


def _of_diameter(outline: Outline, rings: _Rings, diameter: float) -> Iterator[Candidate]:
    pitch = 0.5 * (outline.bore + outline.outside_diameter)
    height = outline.outside_diameter - outline.bore
    off = (diameter / height - _USUAL_SIZE) / 0.02 if rings.middle is None else 0.0
    if rings.middle is not None:
        pitch = rounded(_pitch(rings.middle, rings.angle, diameter), 10e-6)
    for count in range(8, 60):
        share = diameter / (pitch * sin(pi / count))
        if share > _CLOSEST:
            break
        made = _candidate(outline, rings, (diameter, pitch, count))
        if made is not None:
            unlikely = ((share - _USUAL) / 0.03) ** 2 + off**2
            yield replace(made, unlikely=made.unlikely + unlikely)


def _pitch(middle: float, angle: float, diameter: float) -> float:
    """Pitch diameter [m] of cones of a mean ``diameter`` [m] that touch the outer race where that
    is ``middle`` [m] in diameter: with one apex, sin(eps) = Dwe sin(alpha)/middle."""
    half = asin(diameter * sin(angle) / middle)
    return middle * cos(half) * sin(angle - half) / sin(angle)


def _candidate(outline: Outline, rings: _Rings, size: tuple[float, float, int]) -> Candidate | None:
    """So many rollers, as long as C0 has them; None where they have no room."""
    diameter, pitch, count = size
    made = _bearing(outline, rings, size, length=diameter)
    effective = rounded(diameter * outline.static_rating / static_rating(made), 10e-6)
    chamfer = _CHAMFER + _CHAMFER_SLOPE * diameter
    length = rounded(effective + 2.0 * chamfer, 0.1e-3)
    along = length * cos(made.axis_angle) / rings.outer_width
    if along > _LONGEST:
        return None
    made = replace(
        _bearing(outline, rings, size, length=length), effective_length=min(effective, length)
    )
    try:
        made.check()
    except InputError:
        return None
    unlikely = ((along - _USUAL_LENGTH) / 0.1) ** 2 + _off_walls(made) ** 2
    return Candidate(
        outline=outline, bearing=made, reasons=_reasons(rings, made), unlikely=unlikely
    )


def _bearing(
    outline: Outline, rings: _Rings, size: tuple[float, float, int], *, length: float
) -> TaperedRollerBearing:
    diameter, pitch, count = size
    made = TaperedRollerBearing(
        **outline.boundary, designation=outline.designation, inner_width=rings.inner_width,
        outer_width=rings.outer_width, contact_angle=rings.angle, pitch_diameter=pitch,
        roller_diameter=diameter, roller_length=length, effective_length=length,
        roller_count=count, rib_height=rounded(_RIB * diameter, 0.1e-3), end_radius=1.0,
    )  # fmt: skip
    return replace(made, end_radius=rounded(_END * made.apex_to_end, 0.5e-3))


def _off_walls(b: TaperedRollerBearing) -> float:
    """How far the rings' least walls differ from usual ones, in usual deviations."""
    half = 0.5 * b.effective_length
    inner = b.race_diameter("inner", half) - b.bore
    outer = b.outside_diameter - b.race_diameter("outer", -half)
    return (inner / outer - _WALLS) / 0.2


def _reasons(rings: _Rings, b: TaperedRollerBearing) -> dict[str, Any]:
    share = b.roller_diameter / (b.pitch_diameter * sin(pi / b.roller_count))
    known = rings.middle is not None
    race = (
        "from the outer race's diameter E at its small end (ISO 355), rollers amid the outer ring"
    )
    return {
        **rings.reasons,
        "pitch_diameter": race if known else "assumption: the mean of bore and outside diameter",
        "roller_diameter": "inferred: rings whose walls are alike",
        "roller_count": f"inferred from C0: a roller takes {share:.0%} of the distance of two",
        "roller_length": "inferred from C0: the effective length and usual chamfers",
        "effective_length": "inferred from C0",
        "rib_height": f"assumption: {_RIB:.0%} of the roller's diameter",
        "end_radius": f"assumption: {_END:g} of the end's distance from the apex",
    }


INFERENCE = Inference(
    candidates=candidates, cages={name_of(TaperedRollerBearing): "conical"}, count="roller_count"
)
