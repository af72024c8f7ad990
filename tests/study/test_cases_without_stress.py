"""A study computes its cages' stress where an output needs it, or where a cage might yield."""

import json

import pytest
from study_cases import short_case

from flexcage.results.figures.table import FIGURES
from flexcage.simulate import load_run, simulate
from flexcage.stress.run_stress import RunStress
from flexcage.study import work
from flexcage.study.axes import Grid
from flexcage.study.desk import Crew
from flexcage.study.folder import Folder
from flexcage.study.outputs import lacking, needs_stress
from flexcage.study.page_stress import to_show
from flexcage.study.plan import make_plan
from flexcage.study.results import StudyResults
from flexcage.study.run import _lacking
from flexcage.study.spec import Study
from flexcage.study.work import do_case, order_of

SECTION = "Equivalent stress"
OF_STRESS = tuple(name for name, known in FIGURES.items() if known.section == SECTION)
MOVED = {"cage.model": "flexible", "modes.count": 4, "start.push": "200 mm/s",
         "solver.duration": "1 ms"}  # fmt: skip
MODELS = Grid("cage.model", ["rigid", "flexible"])


def study_of(*axes, outputs=("cage_speed",), **rest):
    return Study(case=short_case(**MOVED), axes=axes, outputs=outputs, **rest)


def compute(path, study):
    """All cases of the study in the folder at ``path``, and what the study found."""
    plan, folder = make_plan(study), Folder(path)
    folder.prepare(plan)
    for planned in plan.cases:
        assert do_case(order_of(plan, planned, folder.path)) == "done", folder.failure(planned.hash)
    return StudyResults(path)


def case_of(results, number=0):
    """Folder of the case of a point."""
    return results.folder.case(results.rows[number].planned.hash)


@pytest.fixture(scope="module")
def plain():
    """The same case by itself."""
    return simulate(short_case(**MOVED))


@pytest.mark.parametrize("name", [n for n, k in FIGURES.items() if k.needs])
def test_outputs_of_stress_rivets_and_fatigue_want_stress(name):
    wanted = FIGURES[name].section in (SECTION, "Rivets", "Fatigue")
    assert needs_stress(("cage_speed", name, "pocket_force.max")) == wanted
    assert not needs_stress(("cage_speed", "pocket_force.max"))


def test_a_rigid_cage_lacks_nothing_that_a_flexible_one_has():
    wanted = ("stress_peak", "fatigue_life", "rivet_stress", "wear_depth_rate", "pocket_force.max")
    assert lacking(wanted, {"cage_speed", "cage_mass"}) == wanted[3:]
    assert lacking(wanted, {"cage_mass", "mode_count", "stress_peak"}) == wanted[1:]


def test_a_study_without_such_an_output_computes_no_stress(tmp_path, monkeypatch, plain):
    def never(self):
        raise AssertionError("stress was computed")

    with monkeypatch.context() as patched:
        patched.setattr(RunStress, "history", property(never))
        results = compute(tmp_path / "study", study_of())
    figures = results.folder.row(results.rows[0].planned.hash).figures
    assert set(OF_STRESS).isdisjoint(figures) and "mode_count" in figures
    stored = (case_of(results) / "summary.json").read_bytes()
    assert SECTION not in json.loads(stored)
    assert "not computed in 1 of 1 cases: no output needs it" in results.report()

    run = load_run(case_of(results))  # read by itself, it has all that a plain run has
    titles = [section.title for section in run.summary.sections]
    assert titles == [section.title for section in plain.summary.sections]
    assert run.summary["stress_peak"] == pytest.approx(plain.summary["stress_peak"], rel=2e-5)
    assert run.warnings == load_run(case_of(results)).summary_at_end.warnings
    assert (case_of(results) / "summary.json").read_bytes() == stored
    assert len(to_show(results, None)[0]) == 1


def test_the_page_of_a_study_says_that_stress_was_left_out(tmp_path):
    results = compute(tmp_path / "study", study_of(MODELS, keep="figures"))
    text = results.page(tmp_path / "page.html").read_text("utf-8")
    assert "Stress was not computed in 1 of 2 cases: no output needs it" in text


def test_a_study_with_one_computes_it(tmp_path):
    results = compute(tmp_path / "study", study_of(outputs=("stress_root",)))
    assert set(OF_STRESS) <= set(results.folder.row(results.rows[0].planned.hash).figures)
    assert SECTION in json.loads((case_of(results) / "summary.json").read_text())
    assert "not computed" not in results.report()


def test_a_cage_that_might_yield_is_warned_of(tmp_path):
    """The study's output needs no stress; of a weak material, the warning comes as ever."""
    strength = Grid("cage.material.proof_stress", ["160 MPa", "0.05 MPa"])
    results = compute(tmp_path / "study", study_of(strength))
    strong, weak = results.rows
    assert "stress_above_proof" not in strong.warned and "stress_above_proof" in weak.warned
    assert "stress_above_proof" in results.table["warnings"][1]
    assert "stress_peak" in results.folder.row(weak.planned.hash).figures
    assert "not computed in 1 of 2 cases" in results.report()


@pytest.mark.parametrize("keep", ["runs", "figures"])
def test_stress_that_is_wanted_later_is_that_of_a_plain_run(tmp_path, monkeypatch, plain, keep):
    """From the stored run where there is one; a rigid cage lacks nothing."""
    results = compute(tmp_path / "study", study_of(MODELS, keep=keep))
    before = [results.folder.row(row.planned.hash).figures for row in results.rows]
    if keep == "runs":

        def never(*args, **kwargs):
            raise AssertionError("a finished case was computed again")

        monkeypatch.setattr(work, "simulate", never)
    more = study_of(MODELS, outputs=("stress_peak", "wall_stress"), keep=keep)
    rigid, flexible = (planned.hash for planned in make_plan(more).cases)
    assert _lacking(make_plan(more), results.folder, Crew()) == {flexible}
    results = compute(tmp_path / "study", more)
    assert _lacking(make_plan(more), results.folder, Crew()) == set()
    assert results.folder.row(rigid).figures == before[0]
    figures = results.folder.row(flexible).figures
    assert set(figures) == {*before[1], *OF_STRESS}
    for name in set(OF_STRESS) - {"wall_stress"}:
        ours, row = figures[name], plain.summary.row(name)
        assert ours.value == pytest.approx(row.value, rel=2e-5)
        assert (ours.unit, ours.shown) == (row.unit, row.shown)
    assert figures["wall_stress"].value > 0.0
    assert "not computed" not in results.report()


def test_simulate_computes_stress_when_it_is_asked_for(plain):
    run = simulate(short_case(**MOVED), stress=False)
    assert "stress_peak" not in run.summary_at_end
    assert run.summary["stress_peak"] == pytest.approx(plain.summary["stress_peak"], rel=2e-5)
    assert run.warnings == tuple(w for w in plain.warnings if w.key != "coarse_mesh")
