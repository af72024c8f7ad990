"""What was computed for a repeated paper: readings by starts, maps by points, and its verdicts."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path

import numpy as np
from paper_page import Cell, Line, Table, by_share, number
from scipy.stats import t as student

from flexcage import Run
from flexcage.study import StudyResults
from flexcage.study.claims import Claim, Values
from flexcage.study.decisions import NOTHING, decide
from flexcage.study.looks import Looks
from flexcage.study.maps import MapResults, Test
from flexcage.study.sensitivity import Decider, Share, deciders, share
from flexcage.study.verdicts import UNDECIDED, Verdict

LOOKS = Looks((8, 16, 30))


@dataclass(frozen=True)
class Reading:
    """One reading of a study whose axes are called "condition" and "reading"; what it does not put
    out may be in a study ``beside`` it, of the same reading and conditions."""

    label: str
    results: StudyResults
    beside: Reading | None = None

    @cached_property
    def _rows(self) -> dict[str, list]:
        found: dict[str, list] = {}
        for row in self.results.rows:
            labels = row.planned.point.labels
            if labels.get("reading") == self.label:
                found.setdefault(labels["condition"], []).append(row)
        return found

    @property
    def rows(self) -> list:
        """Rows of all its starts."""
        return [row for rows in self._rows.values() for row in rows]

    @property
    def conditions(self) -> set[str]:
        """Conditions that the study has."""
        return set(self._rows)

    def values(self, output: str, condition: str) -> np.ndarray:
        """An output of every start that is done (starts,), SI; NaN where no study puts it out."""
        own = output in self.results.about.outputs
        if not own and self.beside is not None:
            return self.beside.values(output, condition)
        rows = [r for r in self._rows.get(condition, ()) if r.state == "done"]
        return np.array([float(r.figures[output].value) if own else np.nan for r in rows])

    def said(self, output: str, condition: str, factor: float) -> str:
        """Mean of the starts with half its 95 % interval; of two to seven the mean alone."""
        found = self.values(output, condition)
        n = len(found)
        if n < 2:
            return "-"
        half = None
        if n >= LOOKS.starts[0]:
            half = float(student.ppf(0.975, n - 1) * found.std(ddof=1) / np.sqrt(n))
        return number(float(found.mean()), half, factor=factor)

    @property
    def starts(self) -> int:
        """Starts that every condition has."""
        counts = [sum(r.state == "done" for r in rows) for rows in self._rows.values()]
        return min(counts, default=0)

    def failed(self) -> list[str]:
        """Reasons of starts that failed."""
        return [r.reason for rows in self._rows.values() for r in rows if r.state == "failed"]

    def at_look(self, starts: int) -> Values:
        """Values of so many starts; NaN where there are fewer."""

        def at(output: str, condition: str) -> np.ndarray:
            found = self.values(output, condition)
            return found[:starts] if len(found) >= starts else np.full(starts, np.nan)

        return at

    @property
    def look(self) -> int:
        """The last planned look that every condition has reached."""
        return max((n for n in LOOKS.starts if n <= self.starts), default=0)

    def look_at(self, claim: Claim) -> int:
        """The last planned look that the claim's conditions have reached, but the first at least:
        where a condition is missing, there are no figures."""
        counts = [
            len(self.values(output, c)) for output in claim.outputs for c in conditions_of(claim)
        ]
        return max((n for n in LOOKS.starts if n <= min(counts)), default=LOOKS.starts[0])

    @property
    def studies(self) -> list[StudyResults]:
        """All studies that it reads."""
        return [r.results for r in (self, self.beside) if r is not None]

    def run(self, condition: str, start: int = 0) -> Run:
        """The run of one start."""
        planned = self._rows[condition][start].planned
        return self.results.run(planned.number, planned.repetition)


def readings_of(
    out: Path, files: Mapping[str, tuple[str, str]], beside: Mapping[str, str]
) -> dict[str, Reading]:
    """Readings by column, of the studies in the folder ``out`` that are there: each a file and a
    label; ``beside`` are files."""
    opened: dict[Path, StudyResults] = {}

    def read(column: str, file: str | None) -> Reading | None:
        path = out / Path(file or "").stem
        if file is None or not path.is_dir():
            return None
        if path not in opened:
            opened[path] = StudyResults(path)
        return Reading(files[column][1], opened[path])

    found = {}
    for column, (file, _) in files.items():
        own = read(column, file)
        if own is not None:
            found[column] = replace(own, beside=read(column, beside.get(column)))
    return found


def cells_of_starts(claims: Sequence[Claim], reading: Reading) -> dict[str, Cell]:
    """Outcomes of all claims by one reading's starts."""
    if not reading.look:
        return {claim.key: Cell(UNDECIDED, "not computed") for claim in claims}
    starts = {claim.key: reading.look_at(claim) for claim in claims}
    evidence = {c.key: c.evidence(reading.at_look(starts[c.key])) for c in claims}
    outcomes = decide(evidence, starts=starts, looks=LOOKS)
    lacking = {c.key for c in claims if not conditions_of(c) <= reading.conditions}
    none = {key: "no figures" for key, found in evidence.items() if found == NOTHING}
    none |= dict.fromkeys(lacking, "not computed")
    return {key: Cell(outcome, none.get(key, "")) for key, outcome in outcomes.items()}


@dataclass(frozen=True)
class Mapped:
    """A claim over a map: its share, that of its parts, and what decides it."""

    share: Share
    parts: Mapping[str, Share]
    deciders: Sequence[Decider]
    outcomes: Sequence[bool | None]


class Joined:
    """Maps of the same outputs and conditions as one, over the unknowns that all of them have."""

    def __init__(self, parts: Sequence[MapResults]) -> None:
        self.parts = list(parts)
        first = self.parts[0].names if parts else []
        self.names = [n for n in first if all(n in part.names for part in self.parts)]
        self.shares = np.vstack([
            part.shares[:, [part.names.index(n) for n in self.names]] for part in self.parts
        ]) if parts else np.zeros((0, 0))  # fmt: skip

    def judge(self, test: Test) -> list[bool | None]:
        """Outcome of a claim at every point."""
        return [outcome for part in self.parts for outcome in part.judge(test)]

    def means(self, output: str, condition: str) -> np.ndarray:
        """An output (points,) averaged over starts."""
        found = [part.means(output, condition) for part in self.parts]
        return np.concatenate(found) if found else np.zeros(0)

    def spread(self, output: str, condition: str) -> np.ndarray | None:
        """10 %, 50 % and 90 % (3,) of an output over the points; None where no point has it."""
        if not self.parts or condition not in self.parts[0].conditions:
            return None
        found = self.means(output, condition)
        return np.nanpercentile(found, (10.0, 50.0, 90.0)) if np.isfinite(found).any() else None

    def middle(
        self, output: str, condition: str, factor: float, text: Callable[[float], str] = number
    ) -> str:
        """Median of an output and its middle 80 %, each as a ``text``."""
        found = self.spread(output, condition)
        if found is None:
            return "-"
        low, mid, high = (text(float(value)) for value in found * factor)
        return f"{mid} ({low} to {high})"

    @property
    def ranges(self) -> list[str]:
        """Ranges of ``names`` but for the dummy, in words."""
        return [self._about("ranges", name) for name in self.names[:-1]]

    def _about(self, what: str, name: str) -> str:
        part = next(p for p in self.parts if name in p.names)
        return str(part.about[what][part.names.index(name)])

    def unknowns(self) -> Table:
        """What was left open, its ranges and their reasons; those of any part."""
        names = list(dict.fromkeys(n for part in self.parts for n in part.names[:-1]))
        rows = [(n, self._about("ranges", n), self._about("reasons", n)) for n in names]
        return Table("What the paper leaves open", ("unknown", "range", "reason"), rows)

    def lost(self) -> tuple[int, int]:
        """Runs that failed, and all that were tried."""
        counts = [(p.study.count("failed"), p.study.count("done")) for p in self.parts]
        failed = sum(f for f, _ in counts)
        return failed, failed + sum(d for _, d in counts)


def not_mapped() -> Mapped:
    """A claim without a map."""
    return Mapped(share([]), {}, [], [])


def conditions_of(claim: Claim) -> set[str]:
    """All conditions that a claim compares."""
    return {
        condition for part in claim.parts.values()
        for condition in getattr(part, "conditions", None) or (part.condition,)
    }  # fmt: skip


def mapped(claim: Claim, results: Joined) -> Mapped:
    """One claim judged at every point of a map; not at all where the map lacks its conditions or
    outputs."""
    there = set.intersection(*(set(part.conditions) for part in results.parts))
    put_out = set.intersection(*(set(part.study.about.outputs) for part in results.parts))
    if not (conditions_of(claim) <= there and set(claim.outputs) <= put_out):
        return not_mapped()
    outcomes = results.judge(claim.holds)
    parts = {name: share(results.judge(part.holds)) for name, part in claim.parts.items()}
    by = deciders(results.shares, results.names, outcomes)
    return Mapped(share(outcomes), parts, by, outcomes)


def of_map(found: Mapped) -> Cell:
    """What a map says of a claim, whose conditions it may lack."""
    return by_share(found.share) if found.outcomes else Cell(UNDECIDED, "not mapped")


def lines_of(
    claims: Sequence[Claim],
    starts: Mapping[str, Mapping[str, Cell]],
    maps: Mapping[str, Mapping[str, Mapped]],
    decided_by: Mapping[str, str],
    reasons: Mapping[str, str],
) -> list[Line]:
    """The matrix: columns of ``starts`` and ``maps``, each with its cells by claim."""
    return [
        Line(
            claim.key, claim.text, claim.where,
            {**{column: cells[claim.key] for column, cells in starts.items()},
             **{column: of_map(found[claim.key]) for column, found in maps.items()}},
            decided_by[claim.key], reasons[claim.key],
        )
        for claim in claims
    ]  # fmt: skip


def verdicts_of(lines: Sequence[Line], source: str) -> list[Verdict]:
    """The same for ``verdicts.json``: the outcome by the reading that decides."""
    return [
        Verdict(
            key=line.key, claim=line.claim, outcome=line.verdict.outcome, source=source,
            range="; ".join(f"{name}: {cell.outcome} {cell.note}".rstrip()
                            for name, cell in line.cells.items()),
            reason=line.reason,
        )
        for line in lines
    ]  # fmt: skip


def write_shares(maps: Mapping[str, Mapping[str, Mapped]], path: Path) -> Path:
    """All shares and deciders of all claims as CSV."""
    import pandas as pd

    rows = []
    for column, found in maps.items():
        for key, claim in found.items():
            for name, part in {"whole": claim.share, **claim.parts}.items():
                rows.append({"map": column, "claim": key, "part": name, "holds": part.holds,
                             "decided": part.decided, "open": part.open, "share": part.value,
                             "low": part.low, "high": part.high})  # fmt: skip
            for by in claim.deciders:
                rows.append({"map": column, "claim": key, "part": f"decided by {by.name}",
                             "share": by.distance, "low": by.p})  # fmt: skip
    pd.DataFrame(rows).to_csv(path, index=False, float_format="%.4g")
    return path
