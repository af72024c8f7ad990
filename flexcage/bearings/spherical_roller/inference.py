"""Number and size of the barrels inside a catalogue's spherical roller bearing, from its outline,
contact angle and ratings.

The bore of the outer ring at its sides tells the sphere, and the inner ring's diameter there the
barrels' diameter; without them usual walls are likely. C0 tells the product of number and effective
length. C says hardly more than C0, so that usual distances between barrels, and of barrels from the
other row and the bearing's sides, decide.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from math import cos, hypot, pi, sin, tan
from typing import Any

from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.bearings.spherical_roller.ratings import static_rating
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import name_of
from flexcage.geometry.inference import Candidate, Inference, Outline, rounded

# a barrel's diameter over the rings' height (D - d)/2, and the outer ring's least wall over it
_SMALLEST, _USUAL_SIZE, _LARGEST = 0.4, 0.51, 0.66
_USUAL_WALL = 0.18
_CLOSEST, _USUAL = 0.95, 0.84  # barrel over the distance of two: bars of a pressed cage remain
_USUAL_GAP = 0.08  # between a barrel and the middle of the bearing, over its diameter: a guide ring
_USUAL_REACH = 0.93  # of barrels from the bearing's middle, over half of its width
_CHAMFER, _CHAMFER_SLOPE = 0.27e-3, 0.03  # as of cylindrical rollers
_OSCULATION = 0.98  # T. A. Harris' example of a 22317: 0.980 on both races
_CLEARANCE = 20e-6  # m, in operation, of a bearing with normal clearance before mounting
_STEP = 0.1e-3  # m


@dataclass(frozen=True)
class _Rings:
    """What is known of the rings of an outline [m, rad], or assumed, and why."""

    angle: float
    sphere: float
    inner_end: float | None  # diameter of the inner ring at its sides
    why: str


def candidates(outline: Outline) -> list[Candidate]:
    """Every number of every barrel, in steps of a tenth of a millimetre, that has room."""
    rings, height = _rings(outline), 0.5 * (outline.outside_diameter - outline.bore)
    steps = range(int(_SMALLEST * height / _STEP), int(_LARGEST * height / _STEP) + 1)
    return [c for k in steps for c in _of_diameter(outline, rings, round(k * _STEP, 7))]


def _rings(outline: Outline) -> _Rings:
    angle = outline.required("contact_angle", "the contact angle (--contact-angle)")
    given, height = outline.further, 0.5 * (outline.outside_diameter - outline.bore)
    if (end := given.get("outer_end")) is None:
        sphere = 0.5 * outline.outside_diameter - _USUAL_WALL * height
        why = f"assumption: the outer ring's least wall is {_USUAL_WALL:g} of (D - d)/2"
    else:
        sphere = 0.5 * hypot(end, outline.width)
        why = "from the outer ring's bore at its sides (catalogue)"
    return _Rings(angle, sphere, given.get("inner_end"), why)


def _of_diameter(outline: Outline, rings: _Rings, diameter: float) -> Iterator[Candidate]:
    pitch = rounded(2.0 * (rings.sphere - 0.5 * diameter) * cos(rings.angle), 10e-6)
    for count in range(8, 60):
        share = diameter / (pitch * sin(pi / count))
        if share > _CLOSEST:
            break
        made = _candidate(outline, rings, (diameter, pitch, count))
        if made is not None:
            yield replace(made, unlikely=made.unlikely + ((share - _USUAL) / 0.03) ** 2)


def _candidate(outline: Outline, rings: _Rings, size: tuple[float, float, int]) -> Candidate | None:
    """So many barrels, as long as C0 has them; None where they have no room."""
    diameter = size[0]
    made = _bearing(outline, rings, size, length=diameter)
    effective = rounded(diameter * outline.static_rating / static_rating(made), 10e-6)
    chamfer = _CHAMFER + _CHAMFER_SLOPE * diameter
    length = rounded(effective + 2.0 * chamfer, 0.1e-3)
    made = replace(made, roller_length=length, effective_length=min(effective, length))
    try:
        made.check()
    except InputError:
        return None
    return Candidate(
        outline=outline, bearing=made, reasons=_reasons(outline, rings, made),
        unlikely=_off_rows(made) + _off_walls(made, rings),
    )  # fmt: skip


def _bearing(
    outline: Outline, rings: _Rings, size: tuple[float, float, int], *, length: float
) -> SphericalRollerBearing:
    diameter, pitch, count = size
    barrel = rounded(_OSCULATION * rings.sphere, 10e-6)
    clearance, _ = outline.clearance_in_operation(_CLEARANCE)
    return SphericalRollerBearing(
        **outline.boundary, designation=outline.designation, contact_angle=rings.angle,
        pitch_diameter=pitch, roller_diameter=diameter, roller_length=length,
        effective_length=length, roller_count=count, barrel_radius=barrel,
        inner_groove_radius=rounded(barrel / _OSCULATION, 10e-6), radial_clearance=clearance,
    )  # fmt: skip


def _off_rows(b: SphericalRollerBearing) -> float:
    """How unusual the places of both rows are."""
    half = 0.5 * b.roller_length * cos(b.contact_angle)
    half += b.roller.end_radius * sin(b.contact_angle)
    middle = 0.5 * b.pitch_diameter * tan(b.contact_angle)
    gap, reach = (middle - half) / b.roller_diameter, (middle + half) / (0.5 * b.width)
    return ((gap - _USUAL_GAP) / 0.02) ** 2 + ((reach - _USUAL_REACH) / 0.025) ** 2


def _off_walls(b: SphericalRollerBearing, rings: _Rings) -> float:
    """How far the inner ring's diameter at its sides is from that of the race where barrels end."""
    if rings.inner_end is None:
        height = 0.5 * (b.outside_diameter - b.bore)
        return ((b.roller_diameter / height - _USUAL_SIZE) / 0.03) ** 2
    race = b.race_diameter("inner", 0.5 * b.roller_length)
    return ((race / rings.inner_end - 1.0) / 0.012) ** 2


def _reasons(outline: Outline, rings: _Rings, b: SphericalRollerBearing) -> Mapping[str, Any]:
    share = b.roller_diameter / (b.pitch_diameter * sin(pi / b.roller_count))
    known = rings.inner_end is not None
    side = "inferred: the inner race ends at the inner ring's diameter at its sides (catalogue)"
    return {
        "pitch_diameter": f"inferred: barrels touch the sphere; {rings.why}",
        "roller_diameter": side if known else f"inferred: about {_USUAL_SIZE:g} of (D - d)/2",
        "roller_count": f"inferred from C0: a barrel takes {share:.0%} of the distance of two",
        "roller_length": "inferred from C0: the effective length and usual chamfers",
        "effective_length": "inferred from C0",
        "barrel_radius": f"assumption: {_OSCULATION:g} of the sphere's radius",
        "inner_groove_radius": f"assumption: the barrels' profile over {_OSCULATION:g}",
        "radial_clearance": outline.clearance_in_operation(_CLEARANCE)[1],
    }


INFERENCE = Inference(
    candidates=candidates, cages={name_of(SphericalRollerBearing): "barrel"}, count="roller_count"
)
