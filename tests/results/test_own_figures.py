"""Figures of a user's own file stand in summaries, lists, comparisons, pages and studies."""

import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

import flexcage
from flexcage import register
from flexcage.case import extensions, load_extension
from flexcage.core.errors import InputError
from flexcage.results.compared import Comparison
from flexcage.results.figures.figure import Found
from flexcage.results.figures.own import OUTPUTS, SECTION, own_warnings, with_own
from flexcage.results.figures.part import SettledRun
from flexcage.results.figures.sections import summarise
from flexcage.results.figures.table import FIGURES, listing, marked
from flexcage.results.summary import Summary
from flexcage.simulate import load_run, simulate
from flexcage.study.axes import Grid
from flexcage.study.outputs import beyond_summary, check_outputs, lacking, never_negative
from flexcage.study.run import run_study

MINE = Path(__file__).with_name("my_figures.py")
CASE = """
[bearing]
preset = "N1013"
[cage]
model = "rigid"
[mesh]
fineness = "coarse"
[load]
radial = "1 kN"
[solver]
duration = "0.2 ms"
"""


@pytest.fixture(autouse=True)
def clean():
    """Other tests do not see what is registered here."""
    loaded, outputs, modules = list(extensions._loaded), dict(OUTPUTS), set(sys.modules)
    yield
    FIGURES._added.clear()
    extensions._loaded[:] = loaded
    OUTPUTS.clear()
    OUTPUTS.update(outputs)
    for name in set(sys.modules) - modules:
        if getattr(sys.modules[name], "__file__", None) == str(MINE):
            del sys.modules[name]


def add(key="my_number", take=lambda part: 1.0, **values):
    register.figure(
        key, take, **{"title": "My number", "unit": "mm", "meaning": "a number", **values}
    )


def test_they_stand_in_a_summary_like_others(known_run, bearing):
    load_extension(MINE)
    summary = summarise(SettledRun(known_run, bearing))
    section = summary.sections[-1]
    assert section.title == SECTION
    assert [row.key for row in section.rows] == ["my_axial_play", "my_loaded"]
    assert summary["my_loaded"] == pytest.approx(3.0)  # rollers 3 to 5 of this run
    row = summary.row("my_loaded")
    assert row.margin is not None and row.label == "Elements above 1 N, mean"
    along = known_run["cage_position"].sel(axis="x").values
    settled = along[int(0.3 * (len(along) - 1)) :]
    assert summary["my_axial_play"] == pytest.approx(np.ptp(settled))
    assert "Cage, motion along the axis" in summary.text() and "my_axial_play" in marked("brief")
    assert own_warnings(summary) == ()
    back = Summary.from_json(summary.to_json())
    assert back["my_loaded"] == summary["my_loaded"] and back.row("my_loaded").unit == "1"


def test_they_are_listed_and_compared(known_run, bearing):
    load_extension(MINE)
    rows = {row[0]: row for row in listing().rows}
    assert list(rows)[-2:] == ["my_axial_play", "my_loaded"]
    assert rows["my_axial_play"][1:] == (
        "um",
        "Cage, motion along the axis: largest less least place of its centre; needs a cage",
    )
    assert rows["my_loaded"][2].endswith("number at an instant; with an interval")
    summary = summarise(SettledRun(known_run, bearing))
    found = Comparison({"a": summary, "b": summary})
    assert found["my_loaded"].ratio == 1.0 and found["my_loaded"].beyond == "no"


def test_what_a_run_does_not_have_is_left_out(known_run, bearing):
    add(take=lambda part: None)
    add("my_gap", title="Gap", marks="full complement")
    summary = summarise(SettledRun(known_run, bearing))
    assert summary.row("my_number").text == "-" and "my_gap" not in summary
    assert own_warnings(summary) == ()


@pytest.mark.parametrize(
    ("take", "words"),
    [
        (lambda part: 1.0 / 0.0, r"ZeroDivisionError: .*test_own_figures.py, line \d+\)\.$"),
        (lambda part: part.ds["no_such"], "KeyError.*no_such"),
        (lambda part: part.ds["time"], r"gave an array of shape \(3501,\), but should give one"),
        (lambda part: [1.0, 2.0], r"an array of shape \(2,\)"),
        (lambda part: np.float64("nan"), "gave nan, but should give a number, or None"),
        (lambda part: part.windows.mean(part.ds["time"].values * np.inf), "gave (inf|nan)"),
        (lambda part: "high", "gave 'high', but should give one number"),
        (lambda part: True, "gave True, but should give one number"),
        (lambda part: {"a": 1.0}, "gave a dict, but should give one number"),
        (lambda part: Found([1.0]), r"an array of shape \(1,\)"),
    ],
)
def test_a_function_that_fails_is_a_warning_and_the_run_goes_on(known_run, bearing, take, words):
    add(take=take)
    summary = summarise(SettledRun(known_run, bearing))
    assert summary["my_number"] is None and summary["cage_speed"] is not None
    [warning] = own_warnings(summary)
    assert warning.text.startswith("The figure 'my_number' of your own has no value: ")
    assert re.search(words, warning.text), warning.text
    FIGURES._added.clear()  # mended
    add(take=lambda part: Found(2e-3, "a note"))
    mended = with_own(summary.with_warnings([warning]), lambda: SettledRun(known_run, bearing))
    assert mended["my_number"] == 2e-3 and mended.row("my_number").note == "a note"
    assert mended.warnings == () and sum(s.title == SECTION for s in mended.sections) == 1


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"key": "cage_speed"}, "A figure 'cage_speed' exists already; choose another name"),
        ({"key": "my number"}, "must be one word"),
        ({"key": "my_number.mean"}, "must be one word"),  # else a reduction of a variable
        ({"unit": "furlong"}, "The figure 'my_number' is shown in 'furlong', but should be in one"),
        ({"title": "Cage speed"}, "title 'Cage speed', which is that of 'cage_speed'"),
        ({"title": ""}, "has the title '', but should have words"),
        ({"meaning": 3}, "has the meaning 3, but should have words"),
        ({"marks": "breif"}, "the mark 'breif', which is not known; the nearest.* 'brief'"),
        ({"marks": ("rare", 3)}, "has the mark 3, which is not known"),
        ({"marks": ("cage",)}, "the mark 'cage', which is not known; the nearest.* 'a cage'"),
        ({"take": 1.0}, "needs a function of one value"),
        ({"take": lambda: 1.0}, "needs a function of one value, the settled part"),
        ({"take": lambda part, case: 1.0}, "needs a function of one value"),
    ],
)
def test_what_cannot_be_a_figure_is_refused(values, words):
    with pytest.raises(InputError, match=words) as caught:
        add(**values)
    assert str(caught.value).count(". ") == 0 and not FIGURES.added


def test_names_of_figures_and_of_outputs_are_apart():
    register.outputs(lambda run: {}, {"my_output": ""})
    with pytest.raises(InputError, match="A study output 'my_output' exists already"):
        add("my_output")
    add()
    with pytest.raises(InputError, match="A figure 'my_number' exists already"):
        register.outputs(lambda run: {}, {"my_number": ""})


def test_braces_in_a_title_are_text(known_run, bearing):
    add(title="Force {N}")
    assert summarise(SettledRun(known_run, bearing)).row("my_number").label == "Force {N}"


def test_studies_check_them_like_others():
    load_extension(MINE)
    known = {"sizes": {}, "flexible": False, "family": "cylindrical_roller"}
    check_outputs(("my_axial_play", "my_loaded"), **known)
    with pytest.raises(InputError, match="'my_axial_play' is of a cage, but no case"):
        check_outputs(("my_axial_play",), **known, caged=False, uncaged=True)
    assert never_negative("my_axial_play")
    add()
    assert not never_negative("my_number")
    assert beyond_summary(("my_loaded", "cage_speed")) == ("my_loaded",)
    assert lacking(("my_axial_play", "my_loaded"), {"inner_speed"}) == ("my_loaded",)
    assert lacking(("my_loaded",), {"cage_mass", "my_loaded"}) == ()


def test_a_run_stored_before_has_them_once_the_file_is_loaded(tmp_path):
    run = simulate(flexcage.load_case(CASE), out=tmp_path / "run")
    assert "my_loaded" not in run.summary
    load_extension(MINE)
    add("my_mistake", lambda part: [])
    again = load_run(tmp_path / "run")
    assert again.summary["my_loaded"] > 0.0
    assert [w.key for w in again.warnings].count("own_figure") == 1
    page = again.report(tmp_path / "page.html").read_text("utf-8")
    assert "Cage, motion along the axis" in page and "my_mistake" in page
    assert "my_loaded" not in (tmp_path / "run" / "summary.json").read_text()  # as it was


def test_workers_of_a_study_compute_them(tmp_path):
    load_extension(MINE)
    axis = Grid(path="load.radial", values=("500 N", "1 kN"))
    outputs = ("cage_speed", "my_axial_play", "my_loaded")
    case = flexcage.load_case(CASE)
    results = run_study(
        flexcage.Study(case=case, axes=(axis,), outputs=outputs),
        out=tmp_path / "study", workers=1,
    )  # fmt: skip
    assert results.count("done") == 2
    assert (results.table["my_loaded [1]"] > 0.0).all()
    assert (results.table["my_axial_play [m]"] >= 0.0).all()
    assert "my_axial_play [um]" in results.report()


def test_a_figure_that_is_asked_for_later_is_read_from_the_runs(tmp_path):
    axis = Grid(path="load.radial", values=("1 kN",))
    plain = flexcage.Study(case=flexcage.load_case(CASE), axes=(axis,), outputs=("cage_speed",))
    run_study(plain, out=tmp_path / "study", workers=1)
    [row] = (tmp_path / "study" / "cases").glob("*/results.zarr")
    before = row.stat().st_mtime_ns
    load_extension(MINE)
    more = flexcage.Study(case=plain.case, axes=(axis,), outputs=("cage_speed", "my_loaded"))
    results = run_study(more, out=tmp_path / "study", workers=1)
    assert (results.table["my_loaded [1]"] > 0.0).all() and row.stat().st_mtime_ns == before


def test_the_command_line_lists_them(tmp_path):
    command = [sys.executable, "-m", "flexcage.cli", "figures", "my_"]
    done = subprocess.run(
        [*command, "--use", str(MINE)], capture_output=True, text=True, cwd=tmp_path, check=False
    )
    assert done.returncode == 0 and "my_axial_play" in done.stdout, done.stderr
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 2 and "No figure has the text 'my_'" in done.stderr
