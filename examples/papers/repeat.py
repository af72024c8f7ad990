"""Repeat a paper from its folder: run its readings and samples, judge its claims, write its page.

    python examples/papers/repeat.py examples/papers/c7010_centroid --page

A paper is a folder: ``paper.py`` with ``PAPER``, ``claims.py``, ``outputs.py`` (numbers of a run),
``figures.py`` and the TOML files of its readings and samples. All else is here and in ``judging``.
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

import numpy as np
import pandas as pd
from judging.findings import Claim
from judging.index import Measured, write_index, write_measured
from judging.judge import REPRODUCED, Sample, judge
from judging.page import Figure, Found, Page, Table, compose, compose_appendix
from judging.power import verdicts
from judging.readings import Reading, readings_of
from judging.sample import aliases, in_words, sample_of
from judging.stored import DIGITS, Settings, read_settings, read_starts, settings_of

import flexcage
from flexcage.case.extensions import forget
from flexcage.core.progress import Progress
from flexcage.study import (
    Map,
    MapResults,
    StudyResults,
    load_map,
    load_study,
    run_map,
    run_study,
)
from flexcage.study.own import OWN

At = Callable[[str, str], np.ndarray]  # of an output and a condition: all settings
QUICK = {"solver.duration": "40 ms"}
STARTS = "starts.csv"
MODULES = ("claims", "outputs", "predict", "figures", "mesh_error", "paper")


@dataclass(frozen=True, kw_only=True)
class Draft:
    """What a paper's folder says on its page, with pictures drawn beside it."""

    summary: str
    hero: tuple[str, str]
    model: Sequence[str] = ()
    known: Table
    figures: Sequence[Figure]
    asks: Sequence[str]
    appendix: Sequence[Table] = ()
    history: Sequence[str] = ()
    files: Sequence[str] = ()


@dataclass(frozen=True, kw_only=True)
class Paper:
    """A paper: where it is from, its claims, what is run, and what its page says.

    ``samples`` names the maps (files, joined) over which claims are judged: the first one, or that
    of ``judged_by`` by the claim's key. ``readings`` are studies by column: a file, and a label of
    its axis "reading". ``drifting`` is the output that is 1 for a run that is not stationary, and
    ``spoilt`` names the outputs that are left out of it (none: all).
    ``scatter``: of starts, as a share of their mean, by output; for the power of the rules.
    ``mechanisms``: what contradicts a claim's part ("key, part"), from the runs.
    """

    title: str
    source: str
    claims: Sequence[Claim]
    samples: Mapping[str, Sequence[str]]
    readings: Mapping[str, tuple[str, str]]
    judged_by: Mapping[str, str] = field(default_factory=dict)
    studies: Sequence[str] = ()
    drifting: str = ""
    spoilt: Sequence[str] = ()
    scatter: Mapping[str, float] = field(default_factory=dict)
    mechanisms: Callable[[Computed], Mapping[str, str]] = lambda computed: {}
    draft: Callable[[Computed, Path], Draft]
    measured: Callable[[Computed], Sequence[Measured]] = lambda computed: ()

    def sample_for(self, claim: Claim) -> str:
        """Name of the sample that judges a claim."""
        return self.judged_by.get(claim.key, next(iter(self.samples)))


@dataclass(frozen=True)
class Computed:
    """What there is of a paper: readings by column, samples by name, and its findings."""

    paper: Paper
    readings: Mapping[str, Reading]
    samples: Mapping[str, Sample]
    specs: Mapping[str, Map]  # of the samples
    found: Sequence[Found]
    times: Mapping[str, float]  # of processors, by study and map [s]
    out: Path
    maps: Mapping[str, Settings]  # by file

    def of(self, key: str, part: str) -> Found:
        """One finding."""
        return next(f for f in self.found if (f.claim, f.part) == (key, part))

    def numbers(self, sample: str, output: str, condition: str) -> np.ndarray:
        """An output over the settings of a sample that have it; none without the sample."""
        if sample not in self.samples:
            return np.zeros(0)
        found = self.samples[sample].means[output, condition]
        return found[np.isfinite(found)]

    def middle(
        self, sample: str, output: str, condition: str, factor: float = 1.0, *, digits: int = 2
    ) -> str:
        """Median of an output over the settings; "-" where there is none."""
        found = self.numbers(sample, output, condition)
        if not len(found):
            return "-"
        value = float(np.median(found)) * factor
        return f"{value:.{digits}g}" if abs(value) < 10**digits else f"{value:,.0f}"

    def middles(
        self, sample: str, output: str, conditions: Sequence[str], factor: float = 1.0
    ) -> str:
        """Medians along some conditions, as "1.2, 3.4 and 5.6"."""
        found = [self.middle(sample, output, c, factor, digits=3) for c in conditions]
        return ", ".join(found[:-1]) + f" and {found[-1]}"

    def share(self, sample: str, rule: Callable[[At], np.ndarray]) -> float:
        """Share of the settings at which a rule on outputs holds, of those that have all that it
        reads; 0 without any."""
        if sample not in self.samples:
            return 0.0
        means, read = self.samples[sample].means, []

        def at(output: str, condition: str) -> np.ndarray:
            read.append(means[output, condition])
            return read[-1]

        found = np.asarray(rule(at), bool)
        known = np.isfinite(read).all(axis=0)
        return float(found[known].mean()) if known.any() else 0.0

    @property
    def counts(self) -> Counter[str]:
        """Findings by verdict."""
        return Counter(found.judged.verdict for found in self.found)


def load(folder: Path) -> Paper:
    """The paper of a folder, whose modules import each other as scripts do.

    One paper at a time: outputs of papers that were loaded before may have the same names, and are
    dropped.
    """
    folder = folder.resolve()
    sys.path.insert(0, str(folder))
    for name, output in list(OWN.items()):
        file = Path(output.compute.__code__.co_filename).resolve()
        if file.parent.parent == folder.parent:
            del OWN[name]
            forget(file)
    try:
        for name in MODULES:
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
    """Compute what the paper's tables and the folders of all readings, samples and studies lack;
    ``quick``: two starts of 40 ms, four settings, no other study."""
    changes = QUICK if quick else None
    for file in dict.fromkeys(file for file, _ in paper.readings.values()):
        study = load_study(folder / file, overrides=changes)
        if quick:
            study = replace(study, repeat=replace(study.repeat, count=2))
        run_study(study, out=_of(out, file), workers=workers, progress=Progress)
    for file in () if quick else paper.studies:
        run_study(load_study(folder / file), out=_of(out, file), workers=workers, progress=Progress)
    for file in _maps(paper):
        spec = _spec(folder, file, quick)
        lacking = None if quick else read_settings(folder / table_name(file), spec).lacking
        if lacking != []:
            run_map(spec, points=lacking, out=_of(out, file), workers=workers, progress=Progress)


def _spec(folder: Path, file: str, quick: bool) -> Map:
    """A map of the paper; ``quick``: of four settings and short runs."""
    if not quick:
        return load_map(folder / file)
    return replace(load_map(folder / file, overrides=QUICK), count=4, starts=1)


def table_name(file: str) -> str:
    """Name of the table of a map's runs."""
    name = Path(file).stem.removeprefix("map").strip("_")
    return f"settings_{name}.csv" if name else "settings.csv"


def _maps(paper: Paper) -> list[str]:
    return list(dict.fromkeys(file for files in paper.samples.values() for file in files))


def _of(out: Path, file: str) -> Path:
    return out / Path(file).stem


def check_designs(paper: Paper, folder: Path) -> list[str]:
    """What is wrong with the designs of a paper's samples: unknowns that cannot be told apart."""
    found = []
    for file in _maps(paper):
        spec = load_map(folder / file)
        columns = len(spec.unknowns)
        found += [f"{file}: {said}" for said in aliases(spec.shares[:, :columns], spec.names)]
    return found


def collect(paper: Paper, folder: Path, out: Path, *, quick: bool = False) -> Computed:
    """What the folder of runs and the paper's own tables hold, judged. Raises InputError where
    nothing was computed. ``quick``: of four settings, tables aside."""
    maps = {file: there for file in _maps(paper)
            if len((there := _runs(folder, out, file, quick)).table)}  # fmt: skip
    if not maps:
        raise flexcage.InputError(
            f"Neither '{out}' nor '{folder}' has the paper's samples; compute them first."
        )
    specs, samples = {}, {}
    for name, files in paper.samples.items():
        there = [maps[file].begun for file in files if file in maps]
        if there:
            specs[name] = there[0].spec
            samples[name] = sample_of(there, paper.drifting, paper.spoilt)
    stored = {} if quick else read_starts(folder / STARTS)
    readings = readings_of(out, paper.readings, stored)
    times: dict[str, float] = {}
    for column, (file, _) in paper.readings.items():
        if column in readings:
            times[Path(file).stem] = times.get(Path(file).stem, 0.0) + readings[column].seconds
    times |= {
        p.name: _seconds(StudyResults(p)) for f in paper.studies if (p := _of(out, f)).is_dir()
    }
    times |= {Path(file).stem: found.seconds for file, found in maps.items()}
    computed = Computed(paper, readings, samples, specs, (), times, out, maps)
    return replace(computed, found=_judged(computed))


def _runs(folder: Path, out: Path, file: str, quick: bool) -> Settings:
    """Runs of a map: of the paper's table, and of the folder of runs, which count first."""
    spec, path = _spec(folder, file, quick), _of(out, file)
    if quick:
        return settings_of(MapResults(path), spec)
    found = read_settings(folder / table_name(file), spec)
    return found.with_(settings_of(MapResults(path), spec)) if path.is_dir() else found


def _seconds(results: StudyResults) -> float:
    return sum(row.seconds for row in results.stored.values())


def _judged(computed: Computed) -> list[Found]:
    paper, found = computed.paper, []
    mechanisms = paper.mechanisms(computed)
    for claim in paper.claims:
        name = paper.sample_for(claim)
        if name not in computed.samples:
            continue
        for part, finding in claim.parts.items():
            why = mechanisms.get(f"{claim.key}, {part}", "")
            judged = judge(finding, computed.samples[name], why)
            unknowns = computed.specs[name].unknowns
            under = in_words(judged.region, unknowns) if judged.region else ""
            found.append(Found(claim.key, claim.text, part, claim.where, judged, under))
    return found


def power_table(computed: Computed) -> Table:
    """How often each rule reaches its verdict on samples that are true by construction."""
    rows = []
    for claim in computed.paper.claims:
        name = computed.paper.sample_for(claim)
        if name not in computed.samples:
            continue
        size = next(iter(computed.samples[name].values.values())).shape
        for part, finding in claim.parts.items():
            scatter = scatter_of(computed.paper, finding.outputs)
            wins = tried(computed.paper, claim, part, size, trials=20)[REPRODUCED]
            rows.append(
                (claim.key, part, f"{claim.change:.0%}", f"{scatter:.0%}", f"{wins / 20:.0%}")
            )
    return Table(
        "Power: how often a finding that is true by construction is found to be reproduced",
        ("claim", "finding", "change", "scatter of starts", "found"), rows,
    )  # fmt: skip


def tried(
    paper: Paper, claim: Claim, part: str, size: tuple[int, int], *, trials: int
) -> Counter[str]:
    """Verdicts on a part of a claim by samples of a ``size`` (points, starts) for which it is true
    by construction, with the scatter of real starts."""
    finding, (points, starts) = claim.parts[part], size
    return verdicts(
        finding, claim.change, points=points, starts=starts,
        scatter=scatter_of(paper, finding.outputs), trials=trials,
    )  # fmt: skip


def scatter_of(paper: Paper, outputs: Sequence[str]) -> float:
    """Scatter of starts of the noisiest of some outputs."""
    return max(paper.scatter.get(output, 0.05) for output in outputs)


def write(computed: Computed, folder: Path) -> Path:
    """The page, its appendix, pictures and tables, beside the paper's files."""
    paper, draft = computed.paper, computed.paper.draft(computed, folder)
    tables = write_tables(computed, folder)
    open_ = Table(
        "What the text leaves open", ("unknown", "range", "reason"),
        [(u.name, u.in_words(), u.reason)
         for u in {u.name: u for s in computed.specs.values() for u in s.unknowns}.values()],
    )  # fmt: skip
    page = Page(
        title=paper.title, source=paper.source, summary=draft.summary, hero=draft.hero,
        model=draft.model, known=draft.known, figures=draft.figures, found=computed.found,
        asks=draft.asks, cost=_cost(computed),
        appendix=(open_, power_table(computed), *draft.appendix), history=draft.history,
        files=(*tables, *draft.files),
    )  # fmt: skip
    (folder / "README.md").write_text(compose(page), encoding="utf-8")
    (folder / "appendix.md").write_text(compose_appendix(page), encoding="utf-8")
    if rows := paper.measured(computed):
        write_measured(rows, folder)
        write_index(folder.parent / "README.md")
    return folder / "README.md"


def write_tables(computed: Computed, folder: Path) -> list[str]:
    """All runs of maps and of readings as CSV, from which pages are redrawn and runs go on."""
    files = [found.write(folder / table_name(file)) for file, found in computed.maps.items()]
    if computed.readings:
        tables = {column: reading.table for column, reading in computed.readings.items()}
        starts = pd.concat(tables, names=["reading"]).reset_index(level=0)
        starts.to_csv(folder / STARTS, index=False, float_format=DIGITS)
        files.append(STARTS)
    return files


def _cost(computed: Computed) -> str:
    """Settings, processor time of all runs, version and date, in words."""
    times = computed.times
    each = ", ".join(f"{name} {seconds / 60.0:,.0f}" for name, seconds in times.items())
    total = sum(times.values()) / 60.0
    physics = set().union(*(found.physics for found in computed.maps.values()))
    begun: dict[str, list[str]] = {}
    for file, found in computed.maps.items():
        if found.lacking:
            share = f"{len(found.begun.spec.shares)} of {len(found.spec.shares)}"
            begun.setdefault(share, []).append(Path(file).stem)
    lacking = [
        f"Not all settings are computed: the first {share} are judged ({', '.join(names)})."
        for share, names in begun.items()
    ]
    return " ".join([
        f"Computed with flexcage {flexcage.__version__}, {date.today():%-d %B %Y}; "
        f"{total:,.0f} minutes of processor time ({each}).",
        *([f"{len(physics)} versions of the equations computed them."] if len(physics) > 1 else []),
        *lacking,
    ])  # fmt: skip


def main(arguments: Sequence[str] | None = None) -> Computed:
    """Compute what is missing of a paper, print a line for every finding, and write its page."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("folder", type=Path, help="of the paper")
    parser.add_argument(
        "--quick", action="store_true", help="short runs, two starts, four settings"
    )
    parser.add_argument("-o", "--out", type=Path, help="folder of what is computed")
    parser.add_argument("--workers", type=int, default=1, help="processes")
    parser.add_argument("--page", action="store_true", help="write the page from what is there")
    parser.add_argument(
        "--tables", action="store_true", help="write the tables only: a later run goes on from them"
    )
    options = parser.parse_args(arguments)
    if options.quick and (options.page or options.tables):
        parser.error("--quick tries a folder; its runs would replace those of page and tables")
    folder = options.folder.resolve()
    paper = load(folder)
    out = options.out or Path("runs") / f"{folder.name}{'_quick' * options.quick}"
    if not (options.page or options.tables):
        run(paper, folder, out, workers=options.workers, quick=options.quick)
    computed = collect(paper, folder, out, quick=options.quick)
    for found in computed.found:
        print(f"{found.claim} {found.part}: {found.said}")
    if options.page:
        print(f"written: {write(computed, folder)}")
    elif options.tables:
        print(f"written: {', '.join(write_tables(computed, folder))}")
    return computed


if __name__ == "__main__":
    main()
