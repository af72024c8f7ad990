"""Tables of catalogues, as CSV files: those that all bearings share, and those of a family's own
package (``Family.catalogue``), which has the same tables or some of them."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from importlib import resources

from flexcage.core.wings import FAMILIES


def rows(name: str) -> Iterator[dict[str, str]]:
    """Rows of a table, texts by the names of its columns."""
    own = [family.catalogue for family in FAMILIES.values() if family.catalogue]
    for package in ("flexcage.case.catalogues", *own):
        file = resources.files(package) / f"{name}.csv"
        if file.is_file():
            yield from csv.DictReader(file.read_text("utf-8").splitlines())


def clearance_limits(kind: str, bore: float, group: str) -> tuple[float, float] | None:
    """Least and largest radial clearance [m] of a group (ISO 5753-1) of a type of bearing with a
    ``bore`` [m]; None where there is no table for such bearings or their bore."""
    for row in rows("clearance"):
        over, to = float(row["over_mm"]), float(row["to_mm"])
        if row["type"] == kind and over < 1e3 * bore <= to:
            least, largest = (1e-6 * float(part) for part in row[group].split("-"))
            return least, largest
    return None
