"""Bearings by their own types. The chapter names these for type checkers alone: its other cases run
where a family is not there."""

from __future__ import annotations

from typing import TYPE_CHECKING, cast

from flexcage.case import Case
from flexcage.case.presets import load_preset

if TYPE_CHECKING:
    from flexcage.bearings.ball.bearing import BallBearing
    from flexcage.bearings.cylindrical_roller.bearing import RollerBearing


def ball_bearing(name: str) -> BallBearing:
    """The ball bearing of a preset."""
    return cast("BallBearing", load_preset(name).bearing)


def roller_bearing(name: str) -> RollerBearing:
    """The roller bearing of a preset."""
    return cast("RollerBearing", load_preset(name).bearing)


def rollers_of(case: Case) -> RollerBearing:
    """The roller bearing of a case."""
    return cast("RollerBearing", case.bearing)
