"""Reports of real runs: one that ended, one in memory, one that stopped, one with nothing in it."""

from __future__ import annotations

import re

import numpy as np
import pytest

from flexcage import cli
from flexcage.case import load_case
from flexcage.core.environment import offscreen_backend
from flexcage.core.errors import EnvironmentLacks
from flexcage.report import page as page_module
from flexcage.run import Run
from flexcage.simulate import load_run, simulate
from flexcage.study.axes import Grid
from flexcage.study.run import run_study
from flexcage.study.spec import Study

BASE = {
    "name": "short <run>",
    "bearing": {"preset": "N1013"},
    "mesh": {"fineness": "coarse"},
    "load": {"radial": "1000 N"},
    "output": {"block": 50},
    "solver": {"duration": "2 ms"},
}


class Stop:
    """A progress context that presses Ctrl-C once half of the run is done."""

    def __init__(self, total, label):
        self.half = 0.5 * total if label == "solving" else float("inf")

    def __enter__(self):
        return self

    def __exit__(self, *error):
        pass

    def begin_at(self, done):
        pass

    def to(self, done):
        if done >= self.half:
            raise KeyboardInterrupt


@pytest.fixture(scope="module")
def rigid(tmp_path_factory):
    folder = tmp_path_factory.mktemp("rigid") / "run"
    simulate(load_case(BASE, overrides={"cage.model": "rigid"}), out=folder)
    return folder


def words(path) -> str:
    """Text of a page without its scripts, styles and tags."""
    text = re.sub(r"(?s)<(script|style).*?</\1>", " ", path.read_text("utf-8"))
    text = text.replace("<wbr>", "")
    return " ".join(re.sub(r"<[^>]*>", " ", text).split())


def test_a_run_with_a_rigid_cage(rigid, capsys):
    assert cli.main(["-q", "report", str(rigid)]) == 0
    page = rigid / "report.html"
    text, run = words(page), load_run(rigid)
    assert page.stat().st_size < 15e6
    assert "short &lt;run&gt;: report of a run" in text
    assert "N1013, a cylindrical roller bearing of 65 × 100 × 18 mm with 22 rollers" in text
    assert "Its cage is rigid, of brass" in text and "it has no stress" in text
    for key in ("cage_speed", "energy_imbalance", "steps"):
        row = run.summary.row(key)
        assert f"{row.label} {row.text}" in text, key
    assert all(path in text for path in run.case.assumptions)
    assert "[bearing] preset = &#34;N1013&#34;" in text
    assert "written: " in capsys.readouterr().out


def test_pictures_are_drawn_only_if_there_are_none(rigid, tmp_path, monkeypatch):
    run = load_run(rigid)
    if offscreen_backend() is not None:
        run.report(tmp_path / "a.html")
        assert (rigid / "images" / "orbit.png").is_file()
        monkeypatch.setattr(Run, "draw", None)
        assert "image/png;base64" in run.report(tmp_path / "b.html").read_text("utf-8")


def test_a_machine_that_cannot_draw_still_reports(rigid, tmp_path, monkeypatch):
    def refuse(*args, **kwargs):
        raise EnvironmentLacks("no EGL here")

    run = load_run(rigid)
    monkeypatch.setattr(run, "folder", None)
    monkeypatch.setattr(run, "draw", refuse)
    assert "No pictures: no EGL here" in words(run.report(tmp_path / "a.html"))


def test_a_run_that_stopped_says_so(tmp_path):
    case = load_case(BASE, overrides={"cage.model": "rigid"})
    with pytest.raises(KeyboardInterrupt):
        simulate(case, out=tmp_path / "run", progress=Stop)
    text = words(load_run(tmp_path / "run").report(tmp_path / "a.html"))
    assert re.search(r"The run stopped at [\d.]+ ms of 2 ms", text)


def test_a_run_with_nothing_in_it_gets_a_sentence(tmp_path, capsys):
    class AtOnce(Stop):
        def begin_at(self, done):
            raise KeyboardInterrupt

    case = load_case(BASE, overrides={"cage.model": "rigid"})
    with pytest.raises(KeyboardInterrupt):
        simulate(case, out=tmp_path / "run", progress=AtOnce)
    assert cli.main(["report", str(tmp_path / "run")]) == 2
    err = capsys.readouterr().err
    err = err[err.index("flexcage: ") :]
    assert "has no sample yet" in err and re.fullmatch(r"flexcage: [^\n]*\.\n", err), err
    assert not (tmp_path / "run" / "report.html").exists()


@pytest.mark.slow
def test_a_study_of_flexible_cages_shows_their_stress(tmp_path, monkeypatch):
    axis = Grid("load.radial", ["500 N", "1 kN", "2 kN"])
    study = Study(case=load_case(BASE), axes=(axis,), outputs=("stress_root",))
    results = run_study(study, out=tmp_path / "study", workers=1)
    page = results.page(tmp_path / "a.html")
    text = words(page)
    first, *shown = [float(peak) for peak in re.findall(r"Peak ([\d.]+) MPa in", text)]
    assert first == shown[0]  # beside what was computed
    stored = [results.stored[r.planned.hash].figures["stress_peak"].value for r in results.rows]
    assert shown == pytest.approx(np.array(stored) / 1e6, rel=0.01)  # printed to three digits
    whole = page.stat().st_size
    monkeypatch.setattr(page_module, "LIMIT", whole - 1000)
    smaller = results.page(tmp_path / "b.html")
    assert smaller.stat().st_size < whole - 1000
    assert "Only the first 1 fitted into the page" in words(smaller)
