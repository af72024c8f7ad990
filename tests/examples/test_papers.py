"""All repeated papers: plans that build, designs that tell unknowns apart, rules that can win."""

from __future__ import annotations

import sys
from pathlib import Path

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
