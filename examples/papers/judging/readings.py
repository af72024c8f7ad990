"""Readings of a paper: a model, as printed or better, by a few starts whose runs are kept."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from scipy.stats import t as student

from flexcage import Run
from flexcage.core.digits import texts_with_margin
from flexcage.study import StudyResults


@dataclass(frozen=True)
class Reading:
    """One reading of a study whose axes are called "condition" and "reading"."""

    label: str
    results: StudyResults

    @cached_property
    def _rows(self) -> dict[str, list]:
        found: dict[str, list] = {}
        for row in self.results.rows:
            labels = row.planned.point.labels
            if labels.get("reading") == self.label and row.state == "done":
                found.setdefault(labels["condition"], []).append(row)
        return found

    @property
    def conditions(self) -> tuple[str, ...]:
        """Conditions that have a start."""
        return tuple(self._rows)

    def among(self, names: Mapping[str, str]) -> dict[str, str]:
        """Those of some conditions, with their names, that have a start."""
        return {c: name for c, name in names.items() if c in self.conditions}

    def values(self, output: str, condition: str) -> np.ndarray:
        """An output of every start that is done (starts,), SI; NaN where the study lacks it."""
        own = output in self.results.about.outputs
        rows = self._rows.get(condition, [])
        return np.array([float(r.figures[output].value) if own else np.nan for r in rows])

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
        """The run of one start."""
        planned = self._rows[condition][start].planned
        return self.results.run(planned.number, planned.repetition)


def readings_of(out: Path, files: Mapping[str, tuple[str, str]]) -> dict[str, Reading]:
    """Readings by column, of the studies in the folder ``out`` that are there: each a file and a
    label."""
    opened: dict[Path, StudyResults] = {}
    found = {}
    for column, (file, label) in files.items():
        path = out / Path(file).stem
        if path.is_dir():
            opened.setdefault(path, StudyResults(path))
            found[column] = Reading(label, opened[path])
    return found
