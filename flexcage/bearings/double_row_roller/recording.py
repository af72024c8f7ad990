"""What runs of double row roller bearings record beside what those of rollers do."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from flexcage.bearings.cylindrical_roller.model import RollerModel
from flexcage.bearings.cylindrical_roller.recording import RECORDING as ROLLERS
from flexcage.bearings.two_rows import row_labels


def _coords(model: RollerModel) -> dict[str, Any]:
    return {**ROLLERS.coords(model), **row_labels(model.rows.each)}


RECORDING = replace(ROLLERS, coords=_coords)
