"""A short run of a ball bearing with a damaged cage, as its summary, pictures and page tell it."""

from __future__ import annotations

import browser as looking
import pytest
from test_reports_of_runs import words

from flexcage import cli
from flexcage.case import load_case
from flexcage.core.environment import offscreen_backend
from flexcage.simulate import load_run, simulate

CASE = {
    "name": "balls",
    "bearing": {"preset": "7010C-PI"},
    "mesh": {"fineness": "coarse"},
    "modes": {"count": 6},
    "defects": [{"type": "displaced", "pocket": 5, "circumferential": "0.3 mm"}],
    "drive": {"speed": "4000 rpm"},
    "load": {"axial": "100 N", "radial": "50 N"},
    "solver": {"duration": "2 ms"},
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("balls") / "run"
    simulate(load_case(CASE), out=folder)
    return folder


def test_its_summary_speaks_of_balls(folder):
    summary = load_run(folder).summary
    assert summary.row("roller_passes").label == "Ball passes counted"
    assert summary.row("pocket_force_pass_peak").note == "mean of the largest in each ball pass"
    assert summary.row("pocket_contact").label == "Pockets in contact"
    assert summary.row("stress_root").label == "Stress at a waist or rim, largest"
    assert "roller" not in str(summary).lower()


def test_its_pictures_are_all_drawn(folder, tmp_path):
    if offscreen_backend() is None:
        pytest.skip("nothing to draw with on this machine")
    run = load_run(folder)
    paths = run.draw(tmp_path)
    assert {path.name for path in paths} == {
        "mesh.png", "modes.png", "bearing.png", "orbit.png", "histories.png", "stress_peak.png",
        "stress_pocket.png", "stress_envelope.png", "deformation.png",
    }  # fmt: skip
    assert all(path.stat().st_size > 20_000 for path in paths)


def test_its_page(folder, capsys):
    assert cli.main(["-q", "report", str(folder)]) == 0
    text = words(folder / "report.html")
    for said in (
        "7010C, an angular contact ball bearing",
        "pocket 5 is displaced by 0.3 mm towards pocket 6",
        "Stress at a waist or rim, peak of a pass",
        "Stress at waists and rims of pockets", "Ball speed about its own axis, cage frame",
        "Contact angles", "Orbit of the cage", "Contact angle, inner race",
    ):  # fmt: skip
        assert said in text, said
    if offscreen_backend() is not None:
        assert "Bearing at that instant, balls coloured by load" in text
    told = text.partition("Solver and model")[0]
    assert "roller" not in told.lower()


@pytest.mark.skipif(bool(looking.why_not()), reason=looking.why_not())
def test_its_page_loads_without_complaint(folder, tmp_path):
    page = load_run(folder).report(tmp_path / "page.html")
    browser = looking.open_browser()
    try:
        looking.load(browser, page)
        assert looking.complaints(browser) == [] and looking.requests(browser) == []
    finally:
        browser.quit()
