"""Tables of catalogues, as CSV files."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from importlib import resources


def rows(name: str) -> Iterator[dict[str, str]]:
    """Rows of a table, texts by the names of its columns."""
    file = resources.files("flexcage.case.catalogues") / f"{name}.csv"
    return csv.DictReader(file.read_text("utf-8").splitlines())
