"""Repeat a paper from its folder: run its readings and maps, judge its claims, write its page.

    python examples/papers/repeat.py examples/papers/c7010_centroid --page

A paper is a folder: ``paper.py`` with ``PAPER``, ``claims.py``, ``outputs.py`` (numbers of a run),
``figures.py`` and the TOML files of its readings and maps. All else is here, in ``paper_results``,
``paper_figures`` and ``paper_page``.
"""

from __future__ import annotations

import argparse
import importlib.util
import sys
from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from datetime import date
from pathlib import Path

from paper_figures import STRESS
from paper_index import Measured, write_index, write_measured
from paper_page import Cell, Line, Page, Picture, Table, compose, draw_matrix
from paper_results import (
    Joined,
    Mapped,
    Reading,
    cells_of_starts,
    lines_of,
    mapped,
    not_mapped,
    readings_of,
    verdicts_of,
    write_shares,
)
from paper_weighed import MOST_NAMED, Asked, weigh, weighed_table, write_indices

import flexcage
from flexcage.case.extensions import forget
from flexcage.core.digits import percent_text
from flexcage.core.progress import Progress
from flexcage.study import MapResults, StudyResults, load_map, load_study, run_map, run_study
from flexcage.study.claims import Claim
from flexcage.study.own import OWN
from flexcage.study.verdicts import FAILS, HOLDS, UNDECIDED, write_verdicts

QUICK = {"solver.duration": "40 ms"}
CLEAR = 0.05  # level of the unknowns that a sentence names


@dataclass(frozen=True)
class Words:
    """What the page says beside its numbers: a summary, a reason for every claim in one line, what
    decides, and how it was read."""

    summary: str
    reasons: Mapping[str, str]
    decides: Sequence[str]
    readings: Sequence[str]


@dataclass(frozen=True, kw_only=True)
class Paper:
    """A paper: where it is from, its claims, the columns of its matrix, and what its page shows.

    ``columns`` names the readings of ``readings`` by their labels, ``alone`` those that have a
    study of their own (its file, their label), ``beside`` files of studies that put out more of
    such a reading. ``maps`` are the files that make a column, ``rechecks`` files of maps whose
    ``points`` are computed anew with a flexible cage, under ``recheck_conditions`` or, if a map has
    none of these, all that it has; all rechecked points are a column of their own where
    ``recheck_column`` names it. ``stress`` is what changes the file of a case for a run whose
    stress is drawn; ``studies`` are beside. ``weighed`` are numbers by file of a map, whose
    unknowns the page weighs by their first-order indices, ``measured`` rows of the table of all
    papers.
    """

    title: str
    source: str
    claims: Sequence[Claim]
    readings: str
    columns: Mapping[str, str]
    maps: Mapping[str, Sequence[str]]
    decided_by: Mapping[str, str]
    alone: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    beside: Mapping[str, str] = field(default_factory=dict)
    studies: Sequence[str] = ()
    rechecks: Mapping[str, Sequence[int]] = field(default_factory=dict)
    recheck_conditions: Sequence[str] = ()
    recheck_column: str = ""
    stress: tuple[str, Mapping[str, str]] | None = None
    weighed: Mapping[str, Sequence[Asked]] = field(default_factory=dict)
    draw: Callable[[Computed, Path], list[Picture]]
    tables: Callable[[Computed], list[Table]]
    words: Callable[[Computed], Words]
    measured: Callable[[Computed], Sequence[Measured]] = lambda computed: ()
    files: Sequence[str] = ()


@dataclass(frozen=True)
class Computed:
    """What there is of a paper: readings and maps by column, and its matrix."""

    paper: Paper
    readings: Mapping[str, Reading]
    maps: Mapping[str, Joined]
    found: Mapping[str, Mapping[str, Mapped]]
    rechecks: Mapping[str, MapResults]
    lines: Sequence[Line]
    times: Mapping[str, float]  # of processors, by study and map [s]
    out: Path

    @property
    def counts(self) -> Counter[str]:
        """Claims by the outcome of the reading that decides."""
        return Counter(line.verdict.outcome for line in self.lines)

    @property
    def tally(self) -> str:
        """The same in words that follow "of its claims"."""
        holds, fails, left = (self.counts[o] for o in (HOLDS, FAILS, UNDECIDED))
        return (
            f"{holds} hold{'s' * (holds == 1)} over most of what the paper leaves open, {fails} "
            f"do{'es' * (fails == 1)} not, and {left} stay{'s' * (left == 1)} open"
        )

    def by(self, column: str, key: str, verb: str = "decided by") -> str:
        """What decides a claim over a map, in words."""
        clear = [d for d in self.found[column][key].deciders if d.p < CLEAR]
        if not clear:
            return "no unknown alone decides it"
        names = (f"{'large' if d.holds_above else 'small'} {d.name}" for d in clear[:MOST_NAMED])
        return f"{verb} {', '.join(names)}"

    def part(self, column: str, key: str, name: str) -> str:
        """Share of one part of a claim over a map, in percent."""
        found = self.found[column][key].parts.get(name)
        return percent_text(found.value) if found is not None and found.decided else "-"


def load(folder: Path) -> Paper:
    """The paper of a folder, whose modules import each other as scripts do.

    One paper at a time: outputs of papers that were loaded before may have the same names, and are
    dropped.
    """
    sys.path.insert(0, str(folder))
    for name, output in list(OWN.items()):
        file = Path(output.compute.__code__.co_filename)
        if file.parent.parent == folder.parent:
            del OWN[name]
            forget(file)
    try:
        for name in ("claims", "outputs", "predict", "figures", "decides", "paper"):
            sys.modules.pop(name, None)
        spec = importlib.util.spec_from_file_location("paper", folder / "paper.py")
        assert spec is not None and spec.loader is not None
        module = importlib.util.module_from_spec(spec)
        sys.modules["paper"] = module
        spec.loader.exec_module(module)
        return module.PAPER
    finally:
        sys.path.remove(str(folder))


def run(paper: Paper, folder: Path, out: Path, *, workers: int, quick: bool) -> None:
    """Compute what the folders of all readings, maps and rechecks lack."""
    for file in (paper.readings, *(file for file, _ in paper.alone.values() if not quick)):
        study = load_study(folder / file, overrides=QUICK if quick else None)
        if quick:
            study = replace(study, repeat=replace(study.repeat, count=1))
        run_study(study, out=_of(out, file), workers=workers, progress=Progress)
    if quick:
        return
    for file in (*paper.studies, *paper.beside.values()):
        run_study(load_study(folder / file), out=_of(out, file), workers=workers, progress=Progress)
    for file in dict.fromkeys(
        (*(f for files in paper.maps.values() for f in files), *paper.weighed)
    ):
        run_map(load_map(folder / file), out=_of(out, file), workers=workers, progress=Progress)
    for file, points in paper.rechecks.items():
        flexible = load_map(folder / file, overrides={"cage.model": "flexible"})
        if paper.recheck_conditions:
            kept = [c for c in flexible.conditions if c["label"] in paper.recheck_conditions]
            flexible = replace(flexible, conditions=tuple(kept) or flexible.conditions)
        where = _of(out, file).with_name(f"{Path(file).stem}_flexible")
        run_map(flexible, out=where, points=points, workers=workers, progress=Progress)
    if paper.stress is not None and not (out / STRESS).is_dir():
        file, changes = paper.stress
        case = flexcage.load_case(folder / file, overrides=changes)
        flexcage.simulate(case, progress=Progress).draw(out / STRESS)


def _of(out: Path, file: str) -> Path:
    return out / Path(file).stem


def collect(paper: Paper, out: Path) -> Computed:
    """What the folders hold, judged."""
    if not _of(out, paper.readings).is_dir():
        raise flexcage.InputError(f"'{out}' lacks the paper's readings; compute them first.")
    files = {column: (paper.readings, label) for label, column in paper.columns.items()}
    readings = readings_of(out, {**files, **paper.alone}, paper.beside)
    others = [StudyResults(_of(out, f)) for f in paper.studies if _of(out, f).is_dir()]
    read = [*(results for r in readings.values() for results in r.studies), *others]
    studies = {results.folder.path: results for results in read}
    there = {
        column: Joined([MapResults(_of(out, f)) for f in files if _of(out, f).is_dir()])
        for column, files in paper.maps.items()
    }
    flexible = {f: _of(out, f).with_name(f"{Path(f).stem}_flexible") for f in paper.rechecks}
    again = {f: MapResults(p) for f, p in flexible.items() if p.is_dir()}
    if paper.recheck_column:
        there[paper.recheck_column] = Joined(list(again.values()))
    found = {
        column: {c.key: mapped(c, joined) if joined.parts else not_mapped() for c in paper.claims}
        for column, joined in there.items()
    }
    mapped_files = {f for files in paper.maps.values() for f in files}
    screens = [_of(out, f) for f in paper.weighed if f not in mapped_files]
    all_maps = [
        *(part for column in paper.maps for part in there[column].parts), *again.values(),
        *(MapResults(p) for p in screens if p.is_dir()),
    ]  # fmt: skip
    times = {
        path.name: sum(row.seconds for row in results.stored.values())
        for path, results in studies.items()
    }  # fmt: skip
    times |= {results.study.folder.path.name: results.seconds for results in all_maps}
    computed = Computed(paper, readings, there, found, again, (), times, out)
    starts = {column: cells_of_starts(paper.claims, r) for column, r in readings.items()}
    starts |= {
        column: {claim.key: Cell(UNDECIDED, "not computed") for claim in paper.claims}
        for column in paper.alone if column not in readings
    }  # fmt: skip
    reasons = {claim.key: "" for claim in paper.claims}
    lines = lines_of(paper.claims, starts, found, paper.decided_by, reasons)
    computed = replace(computed, lines=lines)
    if not all(joined.parts for joined in there.values()):  # reasons are those of maps
        return computed
    reasons = paper.words(computed).reasons
    return replace(computed, lines=[replace(line, reason=reasons[line.key]) for line in lines])


def write(computed: Computed, folder: Path) -> Path:
    """The page, its pictures and its CSV files, beside the paper's files. Raises InputError where a
    map is not there."""
    if not all(joined.parts for joined in computed.maps.values()):
        raise flexcage.InputError(f"'{computed.out}' lacks a map of the paper; compute it first.")
    paper, words = computed.paper, computed.paper.words(computed)
    write_shares(computed.found, folder / "shares.csv")
    found = {
        Path(file).stem: weigh(MapResults(_of(computed.out, file)), asked)
        for file, asked in paper.weighed.items() if _of(computed.out, file).is_dir()
    }  # fmt: skip
    files, table = ("shares.csv", *paper.files), None
    if any(found.values()):
        write_indices(found, folder / "indices.csv")
        files, table = (*files, "indices.csv"), weighed_table(found)
    page = Page(
        title=paper.title, summary=words.summary, lines=computed.lines,
        pictures=paper.draw(computed, folder), tables=paper.tables(computed),
        decides=words.decides,
        readings=[
            *words.readings,
            f'"{paper.source}". Written on {date.today():%-d %B %Y} with flexcage '
            f"{flexcage.__version__}; its runs took {_minutes(computed.times)}.",
        ],
        unknowns=next(iter(computed.maps.values())).unknowns(), weighed=table, files=files,
    )  # fmt: skip
    draw_matrix(page, folder / "matrix.png")
    (folder / "README.md").write_text(compose(page), encoding="utf-8")
    if rows := paper.measured(computed):
        write_measured(rows, folder)
        write_index(folder.parent / "README.md")
    return folder / "README.md"


def _minutes(times: Mapping[str, float]) -> str:
    """Processor time of all runs, and of those of every study, in words."""
    each = ", ".join(f"{name} {seconds / 60.0:,.0f}" for name, seconds in times.items())
    total = sum(times.values()) / 60.0
    return f"{total:,.0f} minutes of processor time ({each})"


def main(arguments: Sequence[str] | None = None) -> Computed:
    """Compute what is missing of a paper, print a line for every claim, and write its page."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path, help="of the paper")
    parser.add_argument("--quick", action="store_true", help="short runs of one start, no map")
    parser.add_argument("-o", "--out", type=Path, help="folder of what is computed")
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--page", action="store_true", help="write the page from what is there")
    options = parser.parse_args(arguments)
    folder = options.folder.resolve()
    paper = load(folder)
    out = options.out or Path("runs") / f"{folder.name}{'_quick' * options.quick}"
    if not options.page:
        run(paper, folder, out, workers=options.workers, quick=options.quick)
    computed = collect(paper, out)
    write_verdicts(_of(out, paper.readings), verdicts_of(computed.lines, paper.source))
    for line in computed.lines:
        print(f"{line.key} {line.verdict.outcome:14} {line.claim} ({line.reason})")
    if options.page:
        print(f"written: {write(computed, folder)}")
    return computed


if __name__ == "__main__":
    main()
