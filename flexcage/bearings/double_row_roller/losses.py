"""Losses of the static solution of double row roller bearings: those of both rows."""

from __future__ import annotations

from flexcage.bearings.cylindrical_roller.losses import roller_losses
from flexcage.bearings.two_rows import losses_in_rows

losses = losses_in_rows(roller_losses)
