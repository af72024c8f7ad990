"""Number and size of the balls of a row inside a catalogue's double row angular contact bearing."""

from __future__ import annotations

from flexcage.bearings.ball.inference import Balls, between, dimensions_of, every
from flexcage.bearings.double_row_ball.angular_contact import DoubleRowAngularContactBallBearing
from flexcage.geometry.bearing import name_of
from flexcage.geometry.inference import Candidate, Inference, Outline

_APART = 1.2  # distance of the rows over a ball's diameter: cages remain between them
_NO_ROOM = 1e9
_REASONS = {
    "row_distance": f"assumption: {_APART:g} times a ball's diameter: cages have their place",
    "arrangement": "assumption: as of all usual ones",
    "axial_clearance": "assumption: none in operation",
}


def candidates(outline: Outline) -> list[Candidate]:
    """Every number of every standard ball that has room."""
    return [c for c in every(outline, between, _two_rows) if c.unlikely < _NO_ROOM]


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


INFERENCE = Inference(
    candidates=candidates, cages={name_of(DoubleRowAngularContactBallBearing): ""},
    count="ball_count",
)  # fmt: skip
