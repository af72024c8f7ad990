"""What a case alone tells of its run is said before anything is computed, once, with a remedy."""

import json
import re
import sys

import pytest
from simulate_cases import bent, n1013

from flexcage import load_run, simulate
from flexcage.case import Case
from flexcage.run.foreseen import foreseen, report_before, report_foreseen
from flexcage.run.pictures import account_of
from flexcage.study import compare, converge
from flexcage.study import run as study_run
from flexcage.study.axes import Grid
from flexcage.study.spec import Study

STEADY = {"solver.duration": "5 ms"}


def texts(case, **options):
    return {w.key: w.text for w in foreseen(case, **options)}


def rolling(*tables) -> Case:
    return n1013({"cage.model": "rigid", "solver.duration": "100 ms"}, *tables)


def test_a_short_run_says_what_it_has():
    """At 6000 rpm the cage turns 45.15 times a second: 3.5 ms are 0.158 turns of 22 rollers."""
    text = texts(rolling(STEADY))["short_run"]
    assert "it has 0.16 turns of the cage (means need 1) and 3 roller passes (inter" in text
    assert "without the first 30 % (output.settle)" in text


@pytest.mark.parametrize(
    "changes",
    [
        {},
        {"drive.speed": "-300 rpm"},
        {"output.settle": 0.8},
        {"drive.speed": "0 rpm", "drive.ramp_to": "6000 rpm", "drive.ramp_time": "40 ms"},
        {"drive.times": ["0 ms", "20 ms"], "drive.speeds": ["6000 rpm", "600 rpm"]},
    ],
)
@pytest.mark.parametrize("preset", ["N1013", "15x37x10"])
def test_what_it_says_is_enough_is_enough_and_hardly_more(preset, changes):
    case = Case.from_preset(preset).replace({**STEADY, "cage.model": "rigid", **changes})
    enough = re.search(r"solver.duration = (\S+ ms) is enough", texts(case)["short_run"])[1]
    assert "short_run" not in texts(case.replace("solver.duration", enough))
    less = f"{0.85 * float(enough.split()[0])} ms"
    assert "short_run" in texts(case.replace("solver.duration", less))


def test_a_long_run_and_a_bearing_at_rest_are_not_short():
    assert "short_run" not in texts(rolling())
    assert "short_run" not in texts(rolling(STEADY, {"drive.speed": "0 rpm"}))


@pytest.mark.parametrize("sign", ["", "-"])
def test_a_speed_that_no_lubrication_bears(sign):
    """65 mm: 3 million are 46,153 rpm."""
    text = texts(rolling({"drive.speed": f"{sign}200000 rpm"}))["speed_factor"]
    assert "200,000 rpm, a speed factor (bore in mm times rpm) of 13 million" in text
    assert "46,100 rpm are within it" in text
    assert "speed_factor" not in texts(rolling({"drive.speed": f"{sign}46100 rpm"}))
    ramp = {"drive.ramp_to": f"{sign}50000 rpm", "drive.ramp_time": "50 ms"}
    assert "speed_factor" in texts(rolling(ramp))


def test_a_mesh_for_motion_whose_stress_is_read():
    flexible = {"cage.model": "flexible", "mesh.fineness": "coarse"}
    assert "mesh.fineness = 'medium' is enough" in texts(rolling(flexible))["coarse_mesh"]
    assert "coarse_mesh" not in texts(rolling(flexible), stress=False)
    for enough in ({"mesh.fineness": "medium"}, {"cage.model": "rigid"}, {"mesh.size": "1 mm"}):
        assert "coarse_mesh" not in texts(rolling(flexible, enough))
    linear = texts(rolling(flexible, {"mesh.fineness": "fine", "mesh.order": 1}))
    assert "mesh.order = 2 is enough" in linear["coarse_mesh"]


def test_many_cases_are_told_of_once_a_kind(caplog):
    fast = {"drive.speed": "90000 rpm"}
    report_foreseen([rolling(), rolling(STEADY), rolling(STEADY, fast), rolling(fast)])
    short, speed = caplog.messages
    assert short.startswith("The run is short") and short.endswith(
        "is enough. (1 of 4 cases; this is the first of them)"
    )
    assert "speed factor" in speed and "(2 of 4 cases;" in speed


def test_all_of_a_kind_is_told_of_the_first_case(caplog):
    late = {"load.ramp_to": "2 kN", "load.ramp_start": "1 s", "load.ramp_time": "5 ms"}
    later = {"drive.ramp_to": "9000 rpm", "drive.ramp_start": "2 s", "drive.ramp_time": "5 ms"}
    report_foreseen([rolling(), rolling(late, later)])
    assert [text[:17] for text in caplog.messages] == ["drive.ramp_start ", "load.ramp_start i"]
    assert all("(1 of 2 cases;" in text for text in caplog.messages)


def test_it_is_said_before_the_mesh_is_made(caplog, monkeypatch):
    class Stopped(Exception):
        pass

    def made(*_):
        raise Stopped

    monkeypatch.setattr(sys.modules["flexcage.simulate"], "made_cage", made)
    with pytest.raises(Stopped):
        simulate(n1013(STEADY))
    kinds = [text[:12] for text in caplog.messages]
    assert kinds == ["The run is s", "The mesh is "]


def test_it_stays_with_the_run_and_is_said_once(tmp_path, caplog):
    run = simulate(n1013({"solver.duration": "0.4 ms"}, defects=bent("0.1 mm")), out=tmp_path)
    assert [w.key for w in run.warnings] == ["short_run", "coarse_mesh"]
    assert sum("turns of the cage" in text for text in caplog.messages) == 1
    stored = json.loads((tmp_path / "summary.json").read_text("utf-8"))["warnings"]
    assert [w["key"] for w in stored] == ["short_run", "coarse_mesh"]
    text = " ".join((tmp_path / "summary.txt").read_text("utf-8").split())
    assert text.count("means need 1") == text.count("good for motion, but stress") == 1
    page = account_of(load_run(tmp_path), [], "").warnings
    assert page == [w["text"] for w in stored]


ONCE = ["The run is short", "The mesh is coar"]


def counts(messages):
    """Beginnings of what was told, and of how many cases."""
    told = [
        (text[:16], re.search(r"\((\d+ of \d+) cases; this is the fi", text)) for text in messages
    ]
    return [(begins, number[1]) for begins, number in told if number]


def test_a_comparison_says_it_once(tmp_path, caplog, monkeypatch):
    monkeypatch.setattr(compare, "simulate", lambda case, **_: report_before(case, stress=True))
    monkeypatch.setattr(compare, "compare_runs", lambda runs, out: " ".join(runs))
    assert compare.compare_case(n1013(STEADY), out=tmp_path) == "rigid flexible"
    assert counts(caplog.messages) == list(zip(ONCE, ["2 of 2", "1 of 2"]))


def test_a_convergence_study_says_it_once(tmp_path, caplog, monkeypatch):
    monkeypatch.setattr(converge, "run_in", lambda _, case, **__: report_before(case, stress=True))
    monkeypatch.setattr(converge, "_figures_of", lambda case, *_: converge.run_in("", case))

    class Stopped(Exception):
        pass

    def stop(*_):
        raise Stopped

    monkeypatch.setattr(converge, "_compare", stop)
    with pytest.raises(Stopped):
        converge.converge(n1013(STEADY), out=tmp_path, axes=["tolerance"])
    assert counts(caplog.messages) == [(text, "3 of 3") for text in ONCE]


@pytest.mark.parametrize("output", ["cage_speed", "stress_peak"])
def test_a_study_says_it_of_the_cases_that_it_lacks(tmp_path, caplog, monkeypatch, output):
    """A coarse mesh only where an output is stress; nothing once all is done."""
    monkeypatch.setattr(study_run, "require_packages", lambda: None)
    monkeypatch.setattr(study_run, "_compute", lambda *_: None)
    speeds = Grid("drive.speed", ["1000 rpm", "6000 rpm", "60000 rpm"])
    study = Study(case=n1013(STEADY), axes=(speeds,), outputs=(output,))
    study_run.run_study(study, out=tmp_path / "s")
    coarse = [(ONCE[1], "3 of 3")] if output == "stress_peak" else []
    wanted = [(ONCE[0], "2 of 3"), ("The inner ring r", "1 of 3"), *coarse]
    assert sorted(counts(caplog.messages)) == sorted(wanted)
    caplog.clear()
    monkeypatch.setattr(study_run, "_lacking", lambda *_, **__: set())
    study_run.run_study(study, out=tmp_path / "s")
    assert not caplog.messages
