"""All repeated papers: plans that build, designs that tell unknowns apart, rules that can win."""

from __future__ import annotations

import sys
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pandas as pd
import pytest

from flexcage.study import load_map, load_study
from flexcage.study.plan import make_plan

PAPERS = Path(__file__).parents[2] / "examples" / "papers"
FOLDERS = sorted(file.parent.name for file in PAPERS.glob("*/paper.py"))
ENOUGH = 0.8  # of samples that are true by construction, found to be reproduced


@pytest.fixture(scope="module", autouse=True)
def as_scripts():
    """Modules of examples/papers import each other as scripts do."""
    sys.path.insert(0, str(PAPERS))
    yield
    sys.path.remove(str(PAPERS))


@pytest.fixture(scope="module", params=FOLDERS)
def folder(request):
    return PAPERS / request.param


@pytest.fixture(scope="module")
def paper(folder):
    import repeat

    return repeat.load(folder)


@pytest.fixture(scope="module")
def maps(paper, folder):
    """Samples by name, each with its maps."""
    return {name: [load_map(folder / f) for f in files] for name, files in paper.samples.items()}


def test_there_are_five():
    assert len(FOLDERS) == 5


def test_settings_are_enough_and_every_range_has_a_reason(maps):
    for specs in maps.values():
        assert sum(len(spec.shares) for spec in specs) >= 128
        for spec in specs:
            assert all(len(unknown.reason) > 20 for unknown in spec.unknowns)
            make_plan(spec.study((0, len(spec.shares) - 1)))


def test_designs_tell_all_unknowns_apart(paper, folder):
    import repeat

    assert repeat.check_designs(paper, folder) == []


def test_readings_and_studies_are_plans(paper, folder):
    files = {file for file, _ in paper.readings.values()} | set(paper.studies)
    for file in sorted(files):
        assert make_plan(load_study(folder / file)).cases
    for column, (file, label) in paper.readings.items():
        points = make_plan(load_study(folder / file)).cases
        assert label in {case.point.labels.get("reading") for case in points}, column


def test_claims_compare_what_their_sample_has(paper, maps):
    keys = [claim.key for claim in paper.claims]
    assert len(set(keys)) == len(keys)
    for claim in paper.claims:
        for spec in maps[paper.sample_for(claim)]:
            there = {str(c["label"]) for c in spec.conditions}
            assert set(claim.conditions) <= there, claim.key
            assert set(claim.outputs) <= set(spec.outputs), claim.key
    assert not paper.drifting or all(paper.drifting in s.outputs for m in maps.values() for s in m)


@pytest.mark.slow
def test_every_rule_can_win(paper, maps):
    """Samples of as many settings and starts as are run, true by construction, with the scatter of
    real starts, are found to be reproduced."""
    import repeat
    from judging.judge import REPRODUCED

    weak = {}
    for claim in paper.claims:
        specs = maps[paper.sample_for(claim)]
        points = sum(len(spec.shares) for spec in specs)
        for part in claim.parts:
            found = repeat.tried(paper, claim, part, (points, specs[0].starts), trials=5)
            if found[REPRODUCED] < 5 * ENOUGH:
                weak[claim.key, part] = dict(found)
    assert not weak


@pytest.fixture
def tables(paper, folder, maps, tmp_path, monkeypatch):
    """A table of made numbers of each map, by file, in place of the paper's own; the second setting
    lacks a run, and the third failed."""
    import repeat
    from judging.stored import CONDITION, PHYSICS, SECONDS, SETTING, START, Settings

    monkeypatch.setattr(repeat, "table_name", lambda file: str(tmp_path / f"{Path(file).stem}.csv"))
    monkeypatch.setattr(repeat, "STARTS", str(tmp_path / "starts.csv"))
    made = {}
    for name, files in paper.samples.items():
        for file, spec in zip(files, maps[name]):
            rng = np.random.default_rng(3)
            rows = [
                {SETTING: k, START: s, CONDITION: str(c["label"]), SECONDS: 2.0, PHYSICS: "one"}
                | {o: np.nan if k == 2 else rng.normal() for o in spec.outputs}
                for k, s, c in product(range(len(spec.shares)), range(spec.starts), spec.conditions)
            ]  # fmt: skip
            runs = pd.DataFrame(rows).drop(len(spec.conditions) * spec.starts)
            made[file] = Settings(spec, runs)
            made[file].write(Path(repeat.table_name(file)))
    return made


def test_a_page_is_judged_from_its_tables(tables, paper, folder, tmp_path):
    import repeat
    from judging.judge import judge
    from judging.sample import sample_of

    computed = repeat.collect(paper, folder, tmp_path / "none")
    first = paper.claims[0]
    part, finding = next(iter(first.parts.items()))
    parts = [tables[file] for file in paper.samples[paper.sample_for(first)]]
    whole = sample_of(parts, paper.drifting, paper.spoilt)
    assert computed.of(first.key, part).judged.outcomes == judge(finding, whole).outcomes
    rows = sum(len(there.table) for there in tables.values())
    assert sum(computed.times.values()) == pytest.approx(2.0 * rows)


def test_tables_are_written_again_as_they_are(tables, paper, folder, tmp_path):
    import repeat
    from judging.stored import read_starts

    starts = [
        {"reading": name, "condition": c, "start": k, "x": 0.1 * k, "seconds": 1.0, "physics": "a"}
        for name in list(paper.readings)[:2] for c in ("a", "b") for k in range(3)
    ]  # fmt: skip
    pd.DataFrame(starts).to_csv(repeat.STARTS, index=False)
    before = {file: Path(repeat.table_name(file)).read_bytes() for file in tables}
    computed = repeat.collect(paper, folder, tmp_path / "none")
    assert [len(r.table) for r in computed.readings.values()] == [6] * len(computed.readings)
    repeat.write_tables(computed, folder)
    assert {file: Path(repeat.table_name(file)).read_bytes() for file in tables} == before
    again = read_starts(Path(repeat.STARTS))
    assert {n: len(t) for n, t in again.items()} == {n: 6 for n in computed.readings}


def test_runs_go_on_from_the_tables(tables, paper, folder, tmp_path, monkeypatch):
    import repeat

    asked = {}
    monkeypatch.setattr(repeat, "run_study", lambda *a, **k: None)
    monkeypatch.setattr(
        repeat, "run_map", lambda spec, *, points, out, **k: asked.update({out.name: points})
    )
    repeat.run(paper, folder, tmp_path / "out", workers=1, quick=False)
    assert asked == {Path(file).stem: [1] for file in tables}


def test_tables_of_other_settings_are_not_taken(tables):
    import repeat
    from judging.stored import read_settings

    for file, made in tables.items():
        other = replace(made.spec, seed=made.spec.seed + 1)
        assert read_settings(Path(repeat.table_name(file)), made.spec).lacking == [1]
        assert len(read_settings(Path(repeat.table_name(file)), other).lacking) == other.count
        conditions = ({**made.spec.conditions[0], "load.radial": "1 N"}, *made.spec.conditions[1:])
        changed = replace(made.spec, conditions=conditions)
        assert len(read_settings(Path(repeat.table_name(file)), changed).lacking) == other.count


def test_a_sample_that_was_begun_is_one_of_its_first_settings(maps):
    from judging.stored import CONDITION, FEWEST, SETTING, START, Settings

    for spec in [spec for specs in maps.values() for spec in specs]:
        labels = [str(c["label"]) for c in spec.conditions]
        rows = product(range(len(spec.shares)), range(spec.starts), labels)
        table = pd.DataFrame(rows, columns=[SETTING, START, CONDITION])
        assert Settings(spec, table).begun.spec == spec
        begun = Settings(spec, table[table[SETTING] != 70]).begun
        assert begun.lacking == [] and begun.spec.count == 64
        assert np.array_equal(begun.spec.shares, spec.shares[:64])
        few = Settings(spec, table[table[SETTING] != FEWEST - 1])
        assert few.begun is few
