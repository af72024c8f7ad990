"""What a convergence study says, from runs whose figures are chosen; and one real study."""

import json
import re

import numpy as np
import pandas as pd
import pytest

from flexcage import cli
from flexcage.case import load_case
from flexcage.core.errors import InputError, RunFailed
from flexcage.core.warning import RunWarning
from flexcage.results.figures.table import FIGURES
from flexcage.results.row import SummaryRow
from flexcage.results.statistics import Record
from flexcage.results.summary import Section, Summary
from flexcage.simulate import simulate
from flexcage.study import converge as module
from flexcage.study import work
from flexcage.study.converge import converge, levels
from flexcage.study.convergence import Finding

CASE = load_case({"name": "it", "bearing": {"preset": "N1013"}})


class FakeRun:
    """Leaves a summary in its folder, as a run does; force and frequency depend on the case."""

    calls: list[str] = []

    def __init__(self, case, *, out, progress, resume=False, study=None):
        FakeRun.calls.append(case.hash)
        if case.modes.count == 96:
            raise RunFailed("the solver stopped at t = 1 ms: too stiff")
        force = 2.0 + 0.04 * (case.contacts.race.slices == 8) + 0.3 * (case.solver.tolerance < 5e-9)
        wandering = np.random.default_rng(7).standard_normal(80).cumsum()  # of every run alike
        speed = 100.0 + wandering + 0.5 * (case.contacts.race.slices == 8)
        frequency = {"coarse": 869.1, "medium": 860.6}.get(case.mesh.fineness, 858.5)
        rows = (
            FIGURES["cage_speed"].row(Record(np.stack([speed, np.ones(80)], 1))),
            SummaryRow("pocket_force_mean", "Pocket force, mean", force, "N", "", 0.02),
            SummaryRow("whirl_radius", "Whirl radius, mean", 40e-6, "um", "", 8e-6),
            SummaryRow("slip_loaded", "Loaded zone, slip ratio", 0.01, "%"),
            SummaryRow("first_frequency", "First frequency", frequency, "Hz"),
        )
        high = case.mesh.fineness == "fine" or case.modes.count == 48
        warned = (RunWarning("stress_above_proof", f"{case.modes.count} modes"),) if high else ()
        self.summary = Summary((Section("all", rows),), warned)
        out.mkdir(parents=True, exist_ok=True)
        self.summary.write(out)


@pytest.fixture(autouse=True)
def fake(monkeypatch):
    monkeypatch.setattr(work, "simulate", FakeRun)
    FakeRun.calls = []


def at(found, axis, level, output):
    (one,) = (f for f in found.findings if (f.axis, f.level, f.output) == (axis, level, output))
    return one


def test_warnings_of_its_runs_come_first(tmp_path):
    for found in (converge(CASE, out=tmp_path), converge(CASE, out=tmp_path)):  # made, and read
        first = str(found).splitlines()[0]
        assert re.fullmatch(r"Warning, 2 of \d+ runs \(modes 48; mesh fine\): 48 modes", first)
        assert found.warnings["as is"] == ()
    assert first in (tmp_path / "converge.txt").read_text()
    stored = json.loads((tmp_path / "converge.json").read_text())["warnings"]
    assert stored["mesh fine"] == [{"key": "stress_above_proof", "text": "24 modes"}]


def test_what_it_says_of_each_output(tmp_path):
    found = converge(CASE, out=tmp_path)
    slices = at(found, "slices", "race 8, pocket 32", "pocket_force_mean")
    assert slices.difference == pytest.approx(0.02) and slices.spread == pytest.approx(
        0.02**0.5 / 10
    )
    assert slices.verdict == "apart"
    paired = at(found, "slices", "race 8, pocket 32", "cage_speed")
    assert paired.margin > 2.0 and paired.difference == pytest.approx(0.5 / 89.0, rel=0.02)
    assert paired.verdict == "within 2 %" and paired.spread < 1e-3
    assert at(found, "slices", "race 16, pocket 64", "pocket_force_mean").verdict == "within 2 %"
    assert at(found, "tolerance", "x1", "pocket_force_mean").verdict == "apart"
    assert at(found, "slices", "race 16, pocket 64", "whirl_radius").verdict == "overlap"
    assert at(found, "slices", "race 16, pocket 64", "slip_loaded").verdict == "no interval"
    assert at(found, "mesh", "medium", "first_frequency").verdict == "2 digits"
    assert at(found, "slices", "race 8, pocket 32", "first_frequency").digits == 9
    assert list(found.failures) == ["modes 96"] and "too stiff" in str(found)
    assert found.compared["mesh"] == ("medium", "fine")
    table = pd.read_csv(tmp_path / "converge.csv")
    assert len(table) == len(found.findings) == 5 * 8
    stored = json.loads((tmp_path / "converge.json").read_text())
    assert stored["findings"][0]["verdict"] == found.findings[0].verdict
    assert (tmp_path / "converge.png").stat().st_size > 20_000


def test_a_second_call_does_only_what_is_new(tmp_path):
    first = converge(CASE, out=tmp_path, axes=["slices"])
    assert len(FakeRun.calls) == 3 and CASE.hash in FakeRun.calls
    FakeRun.calls = []
    again = converge(CASE, out=tmp_path, axes=["slices", "mesh"])
    assert len(FakeRun.calls) == 2
    assert again.findings[: len(first.findings)] == first.findings
    FakeRun.calls = []
    converge(CASE, out=tmp_path, axes=["slices"], duration="50 ms")
    assert len(FakeRun.calls) == 3


def test_runs_of_another_flexcage_are_named(tmp_path):
    clean = converge(CASE, out=tmp_path, axes=["slices"])
    assert not any(warned for warned in clean.warnings.values())
    (tmp_path / "cases" / FakeRun.calls[0] / "origin.json").write_text(
        json.dumps({"version": "0.0.9", "physics": "a" * 16})
    )
    found = converge(CASE, out=tmp_path, axes=["slices"])
    said = [w.text for warned in found.warnings.values() for w in warned if w.key == "version"]
    assert len(said) == 1 and len(FakeRun.calls) == 3
    assert "Flexcage 0.0.9 (physics aaaaaaaa) computed this run" in said[0]
    assert "results may differ" in (tmp_path / "converge.txt").read_text()


@pytest.mark.parametrize("text", ["", "{}", "[]", "nonsense"])
def test_a_run_beside_a_damaged_origin_is_not_compared(text, tmp_path):
    converge(CASE, out=tmp_path, axes=["slices"])
    (tmp_path / "cases" / CASE.hash / "origin.json").write_text(text)
    with pytest.raises(InputError, match="origin.json' does not say which flexcage"):
        converge(CASE, out=tmp_path, axes=["slices"])


def test_a_run_that_was_killed_before_its_windows_were_kept_is_completed(tmp_path):
    converge(CASE, out=tmp_path, axes=["slices"])
    (tmp_path / "cases" / CASE.hash / "origin.json").unlink()
    found = converge(CASE, out=tmp_path, axes=["slices"])
    assert FakeRun.calls.count(CASE.hash) == 2 and len(FakeRun.calls) == 4
    assert not any(warned for warned in found.warnings.values())


def test_levels_keep_what_the_case_says():
    own = CASE.replace("contacts.race.slices", 80).replace("mesh.fineness", "fine")
    names = {axis: [s.name for s in levels(own) if s.axis == axis] for axis in module.AXES}
    cut = ["race 40, pocket 32", "race 80, pocket 64", "race 128, pocket 128"]
    assert names["slices"] == cut and names["mesh"] == ["coarse", "medium", "fine"]
    assert names["samples"] == ["50 kHz", "100 kHz", "200 kHz"]
    often = next(s for s in levels(own) if s.name == "200 kHz").case.output
    assert often.vibration_rate == 200e3 and often.block == 4 * own.output.block
    twice = next(s for s in levels(own) if s.name == cut[-1]).case
    assert (twice.contacts.race.slices, twice.contacts.pocket.slices) == (128, 128)
    assert {s.axis for s in levels(CASE.replace("cage.model", "rigid"))} == {
        "tolerance", "slices", "samples",
    }  # fmt: skip
    most = levels(CASE.replace("contacts.race.slices", 128), ["slices"])
    assert [s.name for s in most] == [
        "race 64, pocket 32", "race 128, pocket 64", "race 128, pocket 128",
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("changes", "axes", "words"),
    [
        ({}, ["slice"], "'slice' is not known"),
        ({"cage.model": "rigid"}, ["modes"], "rigid"),
        ({"mesh.size": 1e-3}, ["mesh"], "sizes of its own"),
    ],
)
def test_axes_that_do_not_fit(tmp_path, changes, axes, words):
    with pytest.raises(InputError, match=words):
        converge(CASE.replace(**changes), out=tmp_path, axes=axes)
    assert not FakeRun.calls


def test_a_difference_from_zero_is_no_digit():
    plain = {"axis": "a", "level": "1", "finest": "2", "output": "o", "label": "l", "unit": "N"}
    values = {"value": 1.0, "margin": None, "finest_value": 0.0, "finest_margin": None}
    assert Finding(**plain, **values, statistic=False, spread=0.0).digits == 0


def test_the_command(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "c.toml").write_text('[bearing]\npreset = "N1013"\n', encoding="utf-8")
    argv = ["converge", "c.toml", "--axes", "slices", "--duration", "40 ms", "-o", "out"]
    assert cli.main(argv) == 0 and len(FakeRun.calls) == 3
    assert "slices: race 16, pocket 64 against race 32, pocket 128" in capsys.readouterr().out
    assert cli.main(argv) == 0 and len(FakeRun.calls) == 3
    assert cli.main([*argv, "--force"]) == 0 and len(FakeRun.calls) == 6
    for wrong, words in ((["--axes", "x"], "'x' is not known"), (["--duration", "4"], "unit")):
        assert cli.main([*argv, *wrong]) == 2
        assert words in capsys.readouterr().err
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "letter.txt").write_text("")
    assert cli.main([*argv[:-1], "mine"]) == 2


def test_a_real_study_keeps_its_windows(tmp_path, monkeypatch):
    """Three short runs; read back, they give the very same table."""
    monkeypatch.setattr(work, "simulate", simulate)
    changes = {"cage.model": "rigid", "mesh.fineness": "coarse", "output.block": 50}
    case = CASE.replace(**changes)
    first = converge(case, out=tmp_path, axes=["slices"], duration="34 ms")
    speed = at(first, "slices", "race 8, pocket 32", "cage_speed")
    assert 0.0 < speed.spread < 0.01 and speed.verdict == "within 2 %"
    folders = list((tmp_path / "cases").iterdir())
    assert len(folders) == 3 and all((f / "windows.npz").exists() for f in folders)
    monkeypatch.setattr(work, "simulate", FakeRun)
    assert converge(case, out=tmp_path, axes=["slices"], duration="34 ms").table() == first.table()
    assert not FakeRun.calls


def test_what_is_no_case_is_told(tmp_path):
    with pytest.raises(
        InputError, match="case is 'mine.toml', but should be a Case; flexcage.load"
    ):
        converge("mine.toml", out=tmp_path)
    with pytest.raises(InputError, match="Axis 'tolerances' is not known"):
        converge(CASE, out=tmp_path, axes="tolerances")
