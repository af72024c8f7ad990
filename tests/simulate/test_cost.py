"""How long runs and studies will take is said before they begin, or once their pace is seen."""

import logging
import math
import time

import pytest
from simulate_cases import n1013

from flexcage.integrate import foresight
from flexcage.integrate.foresight import Foresight
from flexcage.integrate.integration import Integration
from flexcage.run import cost
from flexcage.run.cost import Cost, expected_seconds, note_pace
from flexcage.simulate import simulate
from flexcage.study import run as study_run
from flexcage.study.axes import Grid
from flexcage.study.case_row import CaseRow
from flexcage.study.folder import Folder
from flexcage.study.origin import this_one
from flexcage.study.plan import make_plan
from flexcage.study.spec import Study

CASE = n1013({"cage.model": "rigid", "solver.duration": "100 ms"})


@pytest.fixture(autouse=True)
def paces(tmp_path, monkeypatch):
    monkeypatch.setattr(cost, "_file", lambda: tmp_path / "pace.json")
    return tmp_path / "pace.json"


@pytest.fixture
def said(caplog):
    caplog.set_level(logging.INFO, logger="flexcage")

    def lines() -> list[str]:
        found = list(caplog.messages)
        caplog.clear()
        return found

    return lines


def tell(*cases, folder=None, **how):
    found = Cost()
    for case in cases:
        found.counted(case)
    found.announce(folder, **how)


def test_a_kind_of_run_is_known_by_the_last_of_it():
    """10 s for 20 ms: 50 s for 100 ms; another speed, cage or tolerance is another kind."""
    assert expected_seconds(CASE) is None
    note_pace(CASE, 10.0, 20e-3)
    assert math.isclose(expected_seconds(CASE), 50.0)
    assert math.isclose(expected_seconds(CASE.replace("solver.duration", "1 s")), 500.0)
    for path, value in (
        ("drive.speed", "600 rpm"), ("cage.model", "flexible"), ("solver.tolerance", "1 nm"),
    ):  # fmt: skip
        assert expected_seconds(CASE.replace(path, value)) is None
    note_pace(CASE, 40.0, 20e-3)
    assert math.isclose(expected_seconds(CASE), 200.0)
    note_pace(CASE, 0.1, 1e-6)  # too short to tell
    assert math.isclose(expected_seconds(CASE), 200.0)


def test_a_long_run_says_so_and_what_is_not(said):
    note_pace(CASE, 120.0, 10e-3)
    tell(CASE)
    (line,) = said()
    assert line == (
        "solving will take about 20 min 00 s, as the last such run on this machine; "
        "solver.duration = 25 ms takes 5 min 00 s"
    )
    tell(CASE.replace("solver.duration", "25 ms"))
    tell(CASE.replace("drive.speed", "600 rpm"))  # nobody knows
    assert not said()


def test_a_study_divides_by_its_workers_and_trusts_its_own_cases(said):
    note_pace(CASE, 12.0, 10e-3)  # 120 s a case
    tell(*[CASE] * 10, workers=2)
    (line,) = said()
    assert "10 cases will take about 10 min 00 s on 2 workers, as the last such run" in line
    tell(*[CASE] * 10, workers=2, each=600.0)
    (line,) = said()
    assert "10 cases will take about 50 min 00 s on 2 workers, by the cases that are done" in line
    tell(*[CASE] * 4, workers=2)
    assert not said()


@pytest.mark.parametrize("damaged", ["{", "[]", '{"x": 1}', "[" * 100_000])
def test_a_damaged_file_is_none(paces, damaged):
    paces.write_text(damaged)
    assert expected_seconds(CASE) is None
    note_pace(CASE, 10.0, 20e-3)
    assert expected_seconds(CASE) is not None


def test_a_run_keeps_its_pace_without_the_loading_of_kernels(monkeypatch):
    monkeypatch.setattr(cost, "_LEAST", 0.0)
    chosen, slept = Integration._choose, []

    def loads(self):
        slept or time.sleep(2.0)
        slept.append(True)
        chosen(self)

    monkeypatch.setattr(Integration, "_choose", loads)
    case = CASE.replace("solver.duration", "3 ms")  # three blocks
    run = simulate(case)
    assert run.stages["solve"] > 2.0 > expected_seconds(case) > 0.0


def test_a_study_says_it_of_the_cases_that_it_lacks(tmp_path, said, monkeypatch):
    monkeypatch.setattr(study_run, "require_packages", lambda: None)
    monkeypatch.setattr(study_run, "_compute", lambda *_: None)
    loads = Grid("load.radial", ["500 N", "1000 N", "2000 N"])
    study = Study(case=CASE, axes=(loads,), outputs=("cage_speed",))
    plan, folder = make_plan(study), Folder(tmp_path / "s")
    folder.prepare(plan)
    first = plan.cases[0].hash
    folder.case(first).mkdir()
    folder.write_row(folder.case(first), CaseRow(first, 900.0, {}, (), {}, this_one()))
    study_run.run_study(study, out=tmp_path / "s", workers=1)
    assert [
        line for line in said() if "2 cases will take about 30 min 00 s on 1 worker, by" in line
    ]


def test_the_pace_of_a_run_is_said_once(said, monkeypatch):
    """A per cent in 20 s: 33 minutes; and a run of 100 s says nothing."""
    now = [0.0]
    monkeypatch.setattr(foresight.clocks, "perf_counter", lambda: now[0])
    for seconds, lines in ((2000.0, 1), (100.0, 0)):
        ahead = Foresight(50_000_000, 0.1)
        for block in range(50):
            now[0] += seconds / 100.0
            ahead.pace(1e-3 * block)
        found = said()
        assert len(found) == lines
    assert not found


def test_what_the_pace_says(said, monkeypatch):
    now = [0.0]
    monkeypatch.setattr(foresight.clocks, "perf_counter", lambda: now[0])
    ahead = Foresight(50_000_000, 0.1)
    ahead.pace(0.0)
    now[0] = 20.0
    ahead.pace(1e-3)
    (line,) = said()
    assert line.startswith("at the pace of its 20 s so far the run takes about 33 min 00 s more; ")
    assert "solver.duration = 16 ms would take 5 min 00 s more" in line
