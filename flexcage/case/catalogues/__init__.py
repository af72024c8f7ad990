"""Tables of catalogues, as CSV files: those that all bearings share, and those of a family's own
package (``Family.catalogue``), which has the same tables or some of them."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from importlib import resources

from flexcage.core.wings import FAMILIES

_SHARED = "flexcage.case.catalogues"


def rows(name: str) -> Iterator[dict[str, str]]:
    """Rows of a table, texts by the names of its columns."""
    for package in (_SHARED, *(f.catalogue for f in FAMILIES.values() if f.catalogue)):
        yield from _table(package, name)


def further(name: str, row: dict[str, str]) -> dict[str, str]:
    """What a row of a family's own table has beyond the shared table of that name, in mm."""
    shared = _table(_SHARED, name).fieldnames or ()
    return {k.removesuffix("_mm"): v for k, v in row.items() if v and k not in shared}


def _table(package: str, name: str) -> csv.DictReader[str]:
    """A package's table, empty if it has none."""
    file = resources.files(package) / f"{name}.csv"
    return csv.DictReader(file.read_text("utf-8").splitlines() if file.is_file() else ())


def clearance_limits(kind: str, bore: float, group: str) -> tuple[float, float] | None:
    """Least and largest radial clearance [m] of a group (ISO 5753-1) of a type of bearing with a
    ``bore`` [m]; None where there is no table for such bearings or their bore."""
    for row in rows("clearance"):
        over, to = float(row["over_mm"]), float(row["to_mm"])
        if row["type"] == kind and over < 1e3 * bore <= to:
            least, largest = (1e-6 * float(part) for part in row[group].split("-"))
            return least, largest
    return None
