"""Number and size of the balls inside a catalogue's four-point contact bearing, and its shims.

Its rings come apart, so that as many balls go in as leave webs between them.
"""

from __future__ import annotations

from math import sin

from flexcage.bearings.ball.inference import Balls, between, dimensions_of, every
from flexcage.bearings.four_point.bearing import FourPointContactBearing
from flexcage.geometry.bearing import name_of
from flexcage.geometry.inference import Candidate, Inference, Outline

_AXIAL_CLEARANCE = 60e-6  # m
_WHY = (
    "assumption: an axial clearance of 60 um in operation (56 to 106 um before mounting, ISO "
    "5753-2, bores of 18 to 40 mm), shared so that balls rest at one angle in both races"
)


def candidates(outline: Outline) -> list[Candidate]:
    """Every number of every standard ball that has room."""
    return every(outline, between, _four_point)


def _four_point(outline: Outline, balls: Balls, unlikely: float) -> Candidate:
    """Both races with the shim angle that contact angle and axial clearance leave."""
    dimensions, reasons = dimensions_of(outline, balls)
    radii = [dimensions[f"{ring}_groove_radius"] for ring in ("inner", "outer")]
    inner, outer = (radius - 0.5 * balls.diameter for radius in radii)
    angle = outline.required("contact_angle", "the contact angle (--contact-angle)")
    rests = sin(angle) - 0.5 * _AXIAL_CLEARANCE / (inner + outer)
    for ring, length in (("inner", inner), ("outer", outer)):
        dimensions[f"{ring}_shim"] = round(max(2.0 * length * rests, 0.0), 7)
        reasons[f"{ring}_shim"] = _WHY
    bearing = FourPointContactBearing(contact_angle=angle, **dimensions)
    return Candidate(outline=outline, bearing=bearing, reasons=reasons, unlikely=unlikely)


INFERENCE = Inference(
    candidates=candidates,
    cages={name_of(FourPointContactBearing): "machined"},
    count="ball_count",
)
