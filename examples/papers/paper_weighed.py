"""What decides over a map: indices of its numbers by unknown, and what a flexible cage changes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from paper_page import Table, number
from paper_results import conditions_of

from flexcage import InputError
from flexcage.study.maps import MapResults
from flexcage.study.sensitivity import KINDS, Index

if TYPE_CHECKING:
    from repeat import Computed

MOST_NAMED = 3  # unknowns that a sentence or a cell names


@dataclass(frozen=True)
class Asked:
    """A number of a map whose unknowns are weighed by their indices: in words with its unit, under
    which of the map's conditions it is read, and what makes that unit of SI."""

    words: str
    output: str
    condition: str
    factor: float = 1.0


@dataclass(frozen=True)
class Weighed:
    """Indices of one number by unknown, the dummy's last; their kind, and the runs behind them."""

    asked: Asked
    indices: Sequence[Index]
    kind: str
    runs: int

    def said(self, index: Index) -> str:
        """An index with its margin: a share of variance, or an effect in the number's unit."""
        return number(index.value, index.margin, factor=self.factor)

    @property
    def factor(self) -> float:
        return self.asked.factor if self.kind == KINDS["morris"] else 1.0

    def strongest(self) -> str:
        """Unknowns whose index exceeds the dummy's beyond both margins, or the largest."""
        strong = sorted((i for i in self.indices if i.matters), key=lambda i: -i.value)
        if strong:
            return ", ".join(f"{i.name} {self.said(i)}" for i in strong[:MOST_NAMED])
        most = max(self.indices[:-1], key=lambda i: i.value)
        return f"nothing (most: {most.name} {self.said(most)})"


def weigh(results: MapResults, asked: Sequence[Asked]) -> list[Weighed]:
    """Indices of what is asked of one map; what too few runs have is left out. Raises
    EnvironmentLacks without SALib."""
    found = []
    for one in asked:
        try:
            indices = results.indices(one.output, one.condition)
        except InputError:
            continue
        runs = int(np.isfinite(results.means(one.output, one.condition)).sum())
        found.append(Weighed(one, indices, KINDS[results.about["design"]], runs))
    return found


def weighed_table(found: Mapping[str, Sequence[Weighed]]) -> Table:
    """The same of several maps, by their names: what exceeds the dummy, and the dummy's index."""
    rows = [
        (name, w.asked.words, w.kind, w.strongest(), w.said(w.indices[-1]), str(w.runs))
        for name, weighed in found.items() for w in weighed
    ]  # fmt: skip
    return Table(
        "Indices by SALib, ± 95 %: mu* (Morris) in the number's unit, first-order indices as "
        "shares of variance; the dummy changes nothing but the start",
        ("map", "number", "index", "unknowns above the dummy beyond both margins", "dummy", "runs"),
        rows,
    )


def write_indices(found: Mapping[str, Sequence[Weighed]], path: Path) -> Path:
    """Indices of all unknowns in SI, the dummy's among them, as CSV."""
    import pandas as pd

    rows = [
        {"map": name, "output": w.asked.output, "condition": w.asked.condition, "index": w.kind,
         "unknown": i.name, "value": i.value, "+-": i.margin, "matters": i.matters, "runs": w.runs}
        for name, weighed in found.items() for w in weighed for i in w.indices
    ]  # fmt: skip
    pd.DataFrame(rows).to_csv(path, index=False, float_format="%.3g")
    return path


def with_rigid_cage(c: Computed, results: MapResults) -> MapResults:
    """The map of which ``results`` are points with a flexible cage."""
    return next(
        p for m in c.maps.values() for p in m.parts
        if p.names == results.names and np.array_equal(p.shares, results.shares)
    )  # fmt: skip


def rechecked(c: Computed, output: str, *, left_out: Collection[str] = ()) -> list[str]:
    """What a flexible cage changes at the points of every map that were computed anew, in words.

    A point counts whose ``output`` is there under all conditions. ``left_out`` are claims that a
    rigid cage says nothing of.
    """
    said = []
    for file, results in c.rechecks.items():
        rigid = with_rigid_cage(c, results)
        both, other = 0, Counter[str]()
        for claim in c.paper.claims:
            if claim.key in left_out or not conditions_of(claim) <= set(results.conditions):
                continue
            for one, two in zip(rigid.judge(claim.holds), results.judge(claim.holds)):
                if one is not None and two is not None:
                    both += 1
                    other[claim.key] += one != two
        found = np.array([results.means(output, k) for k in results.conditions])
        points = int(np.isfinite(found).all(axis=0).sum())
        if both:
            said.append(
                f"{points} points of {file} with an elastic cage: {both - other.total()} of {both} "
                f"outcomes of claims are as with a rigid one{_others(other)}."
            )
    return [f"**Flexible cage.** {' '.join(said)}"] if said else []


def warns(row, key: str) -> bool:
    """Does a run warn so?"""
    return any(warning.key == key for warning in row.warnings or ())


def warned(
    c: Computed, key: str, names: Mapping[str, str] = {}, columns: Collection[str] = ()
) -> str:
    """Runs that warn so, of all, by reading and map; ``names`` of columns in sentences, of all or
    of some ``columns``."""
    found = []
    there = {column: list(r.rows) for column, r in c.readings.items()}
    for column, joined in c.maps.items():
        there[column] = [row for part in joined.parts for row in part.study.rows]
    for column, rows in there.items():
        if columns and column not in columns:
            continue
        done = [row for row in rows if row.state == "done"]
        count = sum(warns(row, key) for row in done)
        found.append(f"{count} of {len(done)} ({names.get(column, column)})")
    return ", ".join(found)


def _others(other: Counter[str]) -> str:
    """Claims whose outcome differs, and at how many points."""
    named = [f"{key} at {n}" for key, n in sorted(other.items()) if n]
    return f"; others: {', '.join(named)}" if named else ""
