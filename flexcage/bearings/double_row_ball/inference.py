"""Number and size of the balls of a row inside a catalogue's double row ball bearing."""

from __future__ import annotations

from math import hypot, pi, sin, tan

from flexcage.bearings.ball.inference import Balls, between, dimensions_of, every
from flexcage.bearings.double_row_ball.angular_contact import DoubleRowAngularContactBallBearing
from flexcage.bearings.double_row_ball.self_aligning import SelfAligningBallBearing
from flexcage.geometry.bearing import name_of
from flexcage.geometry.inference import Candidate, Inference, Outline

_APART = 1.2  # distance of the rows over a ball's diameter: cages remain between them
_NO_ROOM = 1e9
_BESIDE = 1.05  # distance of balls of both rows over their diameter, at least
_CLEARANCE = 10e-6  # m
_REASONS = {
    "row_distance": f"assumption: {_APART:g} times a ball's diameter: cages have their place",
    "arrangement": "assumption: as of all usual ones",
    "axial_clearance": "assumption: none in operation",
}


_ALIGNING = name_of(SelfAligningBallBearing)


def candidates(outline: Outline) -> list[Candidate]:
    """Every number of every standard ball that has room."""
    make = _on_a_sphere if outline.type == _ALIGNING else _two_rows
    return [c for c in every(outline, between, make) if c.unlikely < _NO_ROOM]


def _two_rows(outline: Outline, balls: Balls, unlikely: float) -> Candidate:
    dimensions, reasons = dimensions_of(outline, balls)
    bearing = DoubleRowAngularContactBallBearing(
        contact_angle=outline.contact_angle, row_distance=round(_APART * balls.diameter, 5),
        **dimensions,
    )  # fmt: skip
    room = bearing.row_distance + bearing.ball_diameter <= bearing.width
    return Candidate(
        outline=outline, bearing=bearing, reasons={**reasons, **_REASONS},
        unlikely=unlikely if room else _NO_ROOM,
    )  # fmt: skip


def _on_a_sphere(outline: Outline, balls: Balls, unlikely: float) -> Candidate:
    """Rows as far apart as the contact angle says."""
    dimensions, reasons = dimensions_of(outline, balls)
    without = {"outer_groove_radius", "outer_shoulder"}
    clearance, reasons["radial_clearance"] = outline.clearance_in_operation(_CLEARANCE)
    distance = balls.pitch * tan(outline.required("contact_angle", "the contact angle"))
    bearing = SelfAligningBallBearing(
        row_distance=round(distance, 5), radial_clearance=clearance,
        **{key: value for key, value in dimensions.items() if key not in without},
    )  # fmt: skip
    chord = balls.pitch * sin(0.5 * pi / balls.count)
    room = hypot(bearing.row_distance, chord) > _BESIDE * balls.diameter
    reasons = {key: value for key, value in reasons.items() if key not in without}
    reasons["row_distance"] = "from the contact angle, which the catalogue's factor e tells"
    inside = bearing.row_distance + bearing.ball_diameter <= bearing.width
    return Candidate(
        outline=outline, bearing=bearing, reasons=reasons,
        unlikely=unlikely if room and inside else _NO_ROOM,
    )  # fmt: skip


INFERENCE = Inference(
    candidates=candidates,
    cages={name_of(DoubleRowAngularContactBallBearing): "crown", _ALIGNING: ""},
    count="ball_count",
)
