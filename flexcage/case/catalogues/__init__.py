"""Tables of catalogues, as CSV files."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from importlib import resources


def rows(name: str) -> Iterator[dict[str, str]]:
    """Rows of a table, texts by the names of its columns."""
    file = resources.files("flexcage.case.catalogues") / f"{name}.csv"
    return csv.DictReader(file.read_text("utf-8").splitlines())


def clearance_limits(kind: str, bore: float, group: str) -> tuple[float, float] | None:
    """Least and largest radial clearance [m] of a group (ISO 5753-1) of a type of bearing with a
    ``bore`` [m]; None where there is no table for such bearings or their bore."""
    for row in rows("clearance"):
        over, to = float(row["over_mm"]), float(row["to_mm"])
        if row["type"] == kind and over < 1e3 * bore <= to:
            least, largest = (1e-6 * float(part) for part in row[group].split("-"))
            return least, largest
    return None
