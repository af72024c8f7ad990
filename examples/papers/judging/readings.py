"""Readings of a paper: a model, as printed or better, by a few starts whose runs are kept."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
import pandas as pd
from scipy.stats import t as student

from flexcage import InputError, Run
from flexcage.core.digits import texts_with_margin
from flexcage.study import StudyResults
from judging.stored import CONDITION, SECONDS, START, figures_of


class NoRuns(InputError):
    """A picture needs runs, and there is only the table of what they gave."""


@dataclass(frozen=True)
class Reading:
    """One reading: ``table`` has a row a start that is done (``stored.read_starts``); ``runs`` the
    study and its planned cases, by condition, where they are there."""

    label: str
    table: pd.DataFrame
    results: StudyResults | None = None
    runs: Mapping[str, Sequence[Any]] = field(default_factory=dict)

    @property
    def conditions(self) -> tuple[str, ...]:
        """Conditions that have a start."""
        return tuple(dict.fromkeys(self.table[CONDITION]))

    @property
    def seconds(self) -> float:
        """Processor time [s]."""
        return float(self.table[SECONDS].sum())

    def among(self, names: Mapping[str, str]) -> dict[str, str]:
        """Those of some conditions, with their names, that have a start."""
        return {c: name for c, name in names.items() if c in self.conditions}

    def values(self, output: str, condition: str) -> np.ndarray:
        """An output of every start that is done (starts,), SI; NaN where the study lacks it."""
        rows = self.table[self.table[CONDITION] == condition]
        if output not in rows:
            return np.full(len(rows), np.nan)
        return rows[output].to_numpy(float)

    def mean(self, output: str, condition: str, factor: float = 1.0) -> str:
        """Mean of the starts in the digits that their 95 % interval leaves, without it."""
        found = self.values(output, condition)
        n = len(found)
        if not n or not np.isfinite(found).all():
            return "-"
        if n < 3:
            return f"{found.mean() * factor:.2g}"
        half = float(student.ppf(0.975, n - 1) * found.std(ddof=1) / np.sqrt(n))
        return texts_with_margin(float(found.mean()) * factor, half * factor)[0]

    def scatter(self, output: str, condition: str) -> float:
        """Standard deviation of the starts as a share of their mean."""
        found = self.values(output, condition)
        return float(found.std(ddof=1) / abs(found.mean())) if len(found) > 1 else np.nan

    def run(self, condition: str, start: int = 0) -> Run:
        """The run of one start; NoRuns where only its numbers are there."""
        if self.results is None or condition not in self.runs:
            raise NoRuns(f"The runs of '{self.label}' are not there; compute them first.")
        planned = self.runs[condition][start]
        return self.results.run(planned.number, planned.repetition)


def readings_of(
    out: Path, files: Mapping[str, tuple[str, str]], stored: Mapping[str, pd.DataFrame]
) -> dict[str, Reading]:
    """Readings by column, each of a file and a label: of the studies in the folder ``out``, or of
    ``stored`` tables where these have more starts."""
    opened: dict[Path, StudyResults] = {}
    found = {}
    for column, (file, label) in files.items():
        path = out / Path(file).stem
        if path.is_dir():
            opened.setdefault(path, StudyResults(path))
            found[column] = _of_study(label, opened[path])
        if column in stored and (
            column not in found or len(found[column].table) < len(stored[column])
        ):
            found[column] = Reading(label, stored[column])
    return found


def _of_study(label: str, results: StudyResults) -> Reading:
    """The reading ``label`` of a study whose axes are called "condition" and "reading"."""
    rows, runs = [], {}
    for row in results.rows:
        labels = row.planned.point.labels
        if labels.get("reading") == label and row.state == "done":
            there = runs.setdefault(labels["condition"], [])
            rows.append({CONDITION: labels["condition"], START: len(there),
                         **figures_of(row, results.about.outputs)})  # fmt: skip
            there.append(row.planned)
    return Reading(label, pd.DataFrame(rows, columns=None if rows else [CONDITION, SECONDS]),
                   results, runs)  # fmt: skip
