"""Losses of the static solution of double row ball bearings: those of both rows."""

from __future__ import annotations

from flexcage.bearings.ball.losses import ball_losses
from flexcage.bearings.two_rows import losses_in_rows

losses = losses_in_rows(ball_losses)
