"""Bearings of presets, by their own types."""

from __future__ import annotations

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.case.presets import load_preset


def ball_bearing(name: str) -> BallBearing:
    """The ball bearing of a preset."""
    bearing = load_preset(name).bearing
    assert isinstance(bearing, BallBearing)
    return bearing


def roller_bearing(name: str) -> RollerBearing:
    """The roller bearing of a preset."""
    bearing = load_preset(name).bearing
    assert isinstance(bearing, RollerBearing)
    return bearing
