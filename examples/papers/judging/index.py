"""What the papers measured beside what was computed: a table of each, all of them on one page."""

from __future__ import annotations

import csv
from collections.abc import Sequence
from dataclasses import astuple, dataclass, fields
from pathlib import Path

FILE = "measured.csv"
_HEAD = "| measured | | better model | map |"


@dataclass(frozen=True)
class Measured:
    """One measured number: of what, as printed, and what the better model and a map have, each with
    its interval."""

    of: str
    printed: str
    better: str
    map: str


def write_measured(rows: Sequence[Measured], folder: Path) -> Path:
    """A paper's numbers as CSV beside its page."""
    path = folder / FILE
    with path.open("w", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(field.name for field in fields(Measured))
        writer.writerows(astuple(row) for row in rows)
    return path


def write_index(page: Path) -> Path:
    """Put the numbers of all papers, in the order of the page's links, into its table of them."""
    text = page.read_text("utf-8")
    names = sorted(
        (f.parent.name for f in page.parent.glob(f"*/{FILE}")), key=lambda n: text.find(f"({n}/")
    )
    rows = []
    for name in names:
        with (page.parent / name / FILE).open(encoding="utf-8") as file:
            rows += [f"| {' | '.join(row)} |" for row in list(csv.reader(file))[1:]]
    before, _, rest = text.partition(_HEAD)
    after = rest.partition("\n\n")[2]
    table = "\n".join((_HEAD, "|---|---|---|---|", *rows))
    page.write_text(f"{before}{table}\n\n{after}", "utf-8")
    return page
