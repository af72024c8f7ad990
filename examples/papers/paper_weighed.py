"""What decides over a map: indices of its numbers by unknown, and what a flexible cage changes."""

from __future__ import annotations

from collections import Counter
from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from paper_page import Table
from paper_results import conditions_of

from flexcage import InputError
from flexcage.study.maps import MapResults
from flexcage.study.sensitivity import Index

if TYPE_CHECKING:
    from repeat import Computed

MOST_NAMED = 3  # unknowns that a sentence or a cell names


@dataclass(frozen=True)
class Asked:
    """A number of a map whose unknowns are weighed by their indices: in words, and under which of
    the map's conditions it is read."""

    words: str
    output: str
    condition: str


def weigh(results: MapResults, asked: Sequence[Asked]) -> list[tuple[Asked, list[Index], int]]:
    """First-order indices of what is asked of one map, and the number of runs behind each; what too
    few runs have is left out. Raises EnvironmentLacks without SALib."""
    found = []
    for one in asked:
        try:
            indices = results.indices(one.output, one.condition)
        except InputError:
            continue
        runs = int(np.isfinite(results.means(one.output, one.condition)).sum())
        found.append((one, indices, runs))
    return found


def weighed_table(found: Mapping[str, Sequence[tuple[Asked, list[Index], int]]]) -> Table:
    """The same of several maps, by their names: what exceeds the dummy, and the dummy's index."""
    rows = [
        (name, one.words, _strongest(indices), f"{indices[-1].value:.2f}", str(runs))
        for name, weighed in found.items() for one, indices, runs in weighed
    ]  # fmt: skip
    return Table(
        "First-order indices (shares of variance, RBD-FAST by SALib); the dummy changes nothing",
        ("map", "number", "what exceeds the dummy, each beyond its 95 % margin", "dummy", "runs"),
        rows,
    )


def _strongest(indices: Sequence[Index]) -> str:
    strong = sorted((i for i in indices if i.matters), key=lambda i: -i.value)[:MOST_NAMED]
    if strong:
        return ", ".join(f"{i.name} {i.value:.2f} ± {i.margin:.2f}" for i in strong)
    most = max(indices[:-1], key=lambda i: i.value)
    return f"nothing (most: {most.name} {most.value:.2f} ± {most.margin:.2f})"


def write_indices(
    found: Mapping[str, Sequence[tuple[Asked, list[Index], int]]], path: Path
) -> Path:
    """Indices of all unknowns, the dummy's among them, as CSV."""
    import pandas as pd

    rows = [
        {"map": name, "number": one.words, "output": one.output, "condition": one.condition,
         "unknown": i.name, "index": i.value, "+-": i.margin, "matters": i.matters, "runs": runs}
        for name, weighed in found.items() for one, indices, runs in weighed for i in indices
    ]  # fmt: skip
    pd.DataFrame(rows).to_csv(path, index=False, float_format="%.3g")
    return path


def rechecked(c: Computed, output: str, *, left_out: Collection[str] = ()) -> list[str]:
    """What a flexible cage changes at the points of every map that were computed anew, in words.

    A point counts whose ``output`` is there under all conditions. ``left_out`` are claims that a
    rigid cage says nothing of.
    """
    said = []
    for file, results in c.rechecks.items():
        rigid = next(
            p for m in c.maps.values() for p in m.parts
            if p.names == results.names and np.array_equal(p.shares, results.shares)
        )  # fmt: skip
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
                f"**Flexible cage.** {points} points of {file} with an elastic cage: "
                f"{both - other.total()} of {both} outcomes of claims are as with a rigid one"
                f"{_others(other)}."
            )
    return said


def _others(other: Counter[str]) -> str:
    """Claims whose outcome differs, and at how many points."""
    named = [f"{key} at {n}" for key, n in sorted(other.items()) if n]
    return f"; others: {', '.join(named)}" if named else ""
