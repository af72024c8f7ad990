"""The cage's mode table as a file."""

from __future__ import annotations

import csv
import io
from pathlib import Path

from flexcage.core.writing import replace
from flexcage.modes.table import ModeTable

FILE = "modes.csv"  # in a run's folder
_UNITS = {"frequency": "Hz", "effective_mass_x": "kg", "effective_mass_y": "kg",
          "effective_mass_z": "kg"}  # fmt: skip


def write_modes(table: ModeTable, path: str | Path) -> Path:
    """Write the table as CSV, one row a dynamic mode, numbers from 1 in full precision."""
    columns = table.columns()
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(["number", *(_head(name) for name in columns)])
    for number, row in enumerate(zip(*columns.values(), strict=True), start=1):
        writer.writerow([number, *(value.item() for value in row)])
    path = Path(path)
    replace(path, text.getvalue().encode())
    return path


def _head(name: str) -> str:
    return f"{name} [{_UNITS[name]}]" if name in _UNITS else name
