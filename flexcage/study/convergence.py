"""What a convergence study found: every output of a case against the finest level of every axis."""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import asdict, dataclass, field
from math import floor, isfinite, log10, nan
from pathlib import Path
from typing import Any

from flexcage.core.listing import PAGE, aligned, wrapped
from flexcage.core.warning import RunWarning
from flexcage.core.writing import write_text, written
from flexcage.results.row import SummaryRow

GOAL = 0.02  # relative difference within which a statistic counts as converged
MOST_DIGITS = 9


@dataclass(frozen=True, kw_only=True)
class Finding:
    """One output at one level of an axis, against the axis's finest level (values in SI)."""

    axis: str
    level: str
    finest: str
    output: str
    label: str
    unit: str
    statistic: bool  # of a chaotic motion, known only with an interval
    spread: float  # half the 95 % interval of ``difference``; 0 of a plain value, NaN if unknown
    value: float
    margin: float | None
    finest_value: float
    finest_margin: float | None

    @property
    def difference(self) -> float:
        """Value less the finest level's, over the latter's size."""
        if self.value == self.finest_value:
            return 0.0
        return (self.value - self.finest_value) / abs(self.finest_value or nan)

    @property
    def digits(self) -> int:
        """Digits that are known to agree."""
        total = abs(self.difference) + self.spread
        if not isfinite(total):
            return 0
        return MOST_DIGITS if total == 0.0 else min(max(floor(-log10(total)), 0), MOST_DIGITS)

    @property
    def verdict(self) -> str:
        """Of a plain value its digits; of a statistic whether it is within ``GOAL``, or whether
        the intervals overlap, so that the runs were too short to tell, or lie apart."""
        if not self.statistic:
            return f"{self.digits} digits"
        if not isfinite(self.spread):
            return "no interval"
        if abs(self.difference) + self.spread <= GOAL:
            return f"within {100.0 * GOAL:g} %"
        return "overlap" if abs(self.difference) <= self.spread else "apart"

    @property
    def text(self) -> str:
        """Difference, its interval and the verdict in a few words."""
        spread = f" ± {100.0 * self.spread:.2g}" if isfinite(self.spread) and self.spread else ""
        return f"{100.0 * self.difference:+.2g}{spread} %, {self.verdict}"

    def record(self) -> dict[str, Any]:
        """All of it as plain values, one row of a table."""
        return {
            **asdict(self),
            "difference": self.difference,
            "digits": self.digits,
            "verdict": self.verdict,
        }


@dataclass(frozen=True, kw_only=True)
class Convergence:
    """A study of one case: ``own`` figures, ``findings`` by output, ``failures`` by level, and what
    ``warnings`` each of the distinct runs has.

    ``compared`` names for each axis the level that the table holds against the finest: the
    case's own, or the one before the finest if the case itself is the finest.
    """

    name: str
    own: tuple[SummaryRow, ...]
    findings: tuple[Finding, ...]
    compared: dict[str, tuple[str, str]]
    failures: dict[str, str]
    warnings: Mapping[str, Sequence[RunWarning]] = field(default_factory=dict)

    def __str__(self) -> str:
        return self.table()

    def table(self, width: int = 0) -> str:
        """Warnings, then the outputs of the case, and how far each is from the finest level of
        every axis; in lines of at most ``width`` characters (0: as the terminal is wide)."""
        cells = [
            [
                "",
                "as is",
                "",
                *(f"{axis}: {low} against {high}" for axis, (low, high) in self.compared.items()),
            ]
        ]
        for row in self.own:
            found = [self._at(axis, row.key) for axis in self.compared]
            figure = f"{row.text} {row.margin_text}".rstrip()
            cells.append([row.label, figure, row.shown, *(f.text if f else "-" for f in found)])
        table = aligned(cells, sides="lrl", heads=True, width=width)
        failed = [f"failed, {where}: {reason}" for where, reason in self.failures.items()]
        before, after = (
            [wrapped(line, width=width) for line in lines]
            for lines in (self._warning_lines(), failed)
        )
        return "\n".join([*before, table, *after])

    def _warning_lines(self) -> list[str]:
        """One line for every kind of warning: the runs that have it, and what the first says."""
        found: dict[str, dict[str, str]] = {}
        for run, warnings in self.warnings.items():
            for warning in warnings:
                found.setdefault(warning.key, {}).setdefault(run, warning.text)
        return [
            f"Warning, {len(texts)} of {len(self.warnings)} runs ({'; '.join(texts)}): "
            f"{next(iter(texts.values()))}"
            for texts in found.values()
        ]

    def _at(self, axis: str, output: str) -> Finding | None:
        level = self.compared[axis][0]
        for f in self.findings:
            if (f.axis, f.level, f.output) == (axis, level, output):
                return f
        return None

    def write(self, folder: str | Path) -> None:
        """Write ``converge.txt``, ``converge.csv`` and ``converge.json`` into ``folder``."""
        import pandas as pd

        folder = Path(folder)
        records = [f.record() for f in self.findings]
        write_text(folder / "converge.txt", self.table(PAGE) + "\n")
        with written(folder / "converge.csv") as path:
            pd.DataFrame(records).to_csv(path, index=False)
        plain = [{k: None if v != v else v for k, v in r.items()} for r in records]
        content = {
            "case": self.name,
            "findings": plain,
            "failures": self.failures,
            "warnings": {run: [asdict(w) for w in warned] for run, warned in self.warnings.items()},
        }
        write_text(folder / "converge.json", json.dumps(content, indent=2))
