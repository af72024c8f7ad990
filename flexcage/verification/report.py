"""Outcomes as one table of text, as a chapter in Markdown, and as JSON."""

from __future__ import annotations

import json
from collections.abc import Sequence
from math import isfinite
from pathlib import Path
from typing import Any

from flexcage._version import __version__
from flexcage.core.listing import aligned
from flexcage.core.writing import write_text
from flexcage.verification.known_answer import Outcome, Row

HEADER = ("quantity", "reference", "flexcage", "difference", "tolerance", "verdict")


def _cells(row: Row) -> tuple[str, ...]:
    name = f"{row.quantity}, {row.unit}" if row.unit else row.quantity
    return (
        name, f"{row.reference:.7g}", f"{row.value:.7g}", row.difference_text, str(row.tolerance),
        "pass" if row.passed else "FAIL",
    )  # fmt: skip


def _without_rows(outcome: Outcome) -> str:
    """What to say of a case that gave no row, or stopped among them."""
    return outcome.error or ("" if outcome.rows else "the case has no rows")


def table(outcomes: Sequence[Outcome]) -> str:
    """One table of all rows, and a last line that counts."""
    lines: list[tuple[str, ...]] = [("case", *HEADER)]
    for outcome in outcomes:
        lines += [(outcome.case.name, *_cells(row)) for row in outcome.rows]
        if _without_rows(outcome):
            lines.append((outcome.case.name, _without_rows(outcome), "", "", "", "", "FAIL"))
    return "\n".join([aligned(lines, sides="llrrrrl", heads=True), "", count(outcomes)])


def count(outcomes: Sequence[Outcome]) -> str:
    """How many rows and cases passed, and how long they took."""
    rows = [row for outcome in outcomes for row in outcome.rows]
    return (
        f"{sum(o.passed for o in outcomes)} of {len(outcomes)} cases passed, "
        f"{sum(r.passed for r in rows)} of {len(rows)} rows, "
        f"in {sum(o.seconds for o in outcomes):.0f} s"
    )


def markdown(outcomes: Sequence[Outcome]) -> str:
    """The chapter: a section a case, with its source, its table and why each tolerance."""
    parts = ["# Verification of flexcage " + __version__, count(outcomes) + "."]
    for outcome in outcomes:
        case = outcome.case
        parts += [f"## {case.title}", case.checks, f"Source: {case.source}"]
        grid = ["| " + " | ".join(HEADER) + " |", "|" + "---|" * len(HEADER)]
        grid += ["| " + " | ".join(_cells(row)) + " |" for row in outcome.rows]
        reasons = dict.fromkeys(row.tolerance for row in outcome.rows)
        parts += ["\n".join(grid), "\n".join(f"- {t}: {t.why}." for t in reasons)]
        if _without_rows(outcome):
            parts.append(f"**Failed:** {_without_rows(outcome)}")
    return "\n\n".join(part for part in parts if part) + "\n"


def _finite(x: float) -> float | None:
    """JSON has no word for infinity and what is not a number."""
    return float(x) if isfinite(x) else None


def _record(row: Row) -> dict[str, Any]:
    return {
        "quantity": row.quantity,
        "unit": row.unit,
        "reference": _finite(row.reference),
        "flexcage": _finite(row.value),
        "difference": _finite(row.difference),
        "tolerance": row.tolerance.size,
        "relative": not row.tolerance.absolute,
        "why": row.tolerance.why,
        "passed": row.passed,
    }


def as_json(outcomes: Sequence[Outcome]) -> str:
    """Everything, for other programs; ``difference`` is relative where the tolerance is."""
    record = {
        "format": 1,
        "flexcage": __version__,
        "passed": all(o.passed for o in outcomes),
        "cases": [
            {
                "name": o.case.name,
                "title": o.case.title,
                "source": o.case.source,
                "passed": o.passed,
                "seconds": round(o.seconds, 3),
                "error": o.error,
                "rows": [_record(row) for row in o.rows],
            }
            for o in outcomes
        ],
    }
    return json.dumps(record, indent=2) + "\n"


FORMATS = {".json": as_json, ".md": markdown}


def write(outcomes: Sequence[Outcome], path: Path) -> None:
    """Write the outcomes in the format of the file's ending, one of ``FORMATS``."""
    write_text(path, FORMATS[path.suffix](outcomes))
