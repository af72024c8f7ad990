"""Reports of studies whose rows were written here, and the command: what it refuses, and says."""

from __future__ import annotations

import re

import pytest

from flexcage import cli
from flexcage.case import load_case
from flexcage.core.errors import InputError
from flexcage.core.warning import RunWarning
from flexcage.report.comparison import Output
from flexcage.study.axes import Grid, LatinHypercube, Points, Zip
from flexcage.study.case_row import CaseRow, Failure
from flexcage.study.folder import Folder
from flexcage.study.origin import this_one
from flexcage.study.outputs import StudyFigure
from flexcage.study.page_stress import to_show
from flexcage.study.page_tables import abscissas, outputs, point_names
from flexcage.study.plan import make_plan
from flexcage.study.results import StudyResults
from flexcage.study.spec import Repeat, Study
from flexcage.study.words import in_words

CASE = {"bearing": {"preset": "N1013"}, "cage": {"model": "rigid"}, "load": {"radial": "1 kN"}}


def study_folder(
    path, *axes, fails=(), open_=(), outputs=("cage_slip_ratio",), warned=lambda k: (), **rest
):
    """A study as it would lie on disk, with figures that follow from each case's place."""
    rest = {"keep": "figures", **rest}
    plan = make_plan(Study(case=load_case(CASE), axes=axes, outputs=outputs, **rest))
    folder = Folder(path)
    folder.prepare(plan)
    for k, planned in enumerate(plan.cases):
        if k in fails:
            folder.write_failure(planned.hash, Failure("RunFailed", f"case {k} broke", True))
        elif k not in open_:
            figures = {name: StudyFigure(0.01 + 0.001 * k, "1", "%") for name in outputs}
            figures |= {"energy_audit": StudyFigure("EXCEEDED" if k == 0 else "passed", "1"),
                        "steps": StudyFigure(100 + k, "1")}  # fmt: skip
            folder.case(planned.hash).mkdir(parents=True)
            values, origin = planned.point.values, this_one()
            row = CaseRow(planned.hash, 1.5, figures, warned(k), values, origin)
            folder.write_row(folder.case(planned.hash), row)
    return StudyResults(path)


EXCEEDED = RunWarning("energy_audit", "The energy audit is exceeded.")
LOADS = Grid("load.radial", ["500 N", "1 kN"])
SPEEDS = Grid("drive.speed", ["3000 rpm", "6000 rpm", "9000 rpm"])


def test_the_page_of_a_study(tmp_path):
    results = study_folder(
        tmp_path / "s", LOADS, SPEEDS, repeat=Repeat(count=2), name="<i>mine", fails=(3,),
        open_=(11,), warned=lambda k: (EXCEEDED,) * (k < 2),
    )  # fmt: skip
    path = results.page(tmp_path / "page.html")
    text = path.read_text("utf-8")
    assert path.stat().st_size < 15e6
    assert "&lt;i&gt;mine: report of a study" in text and "<i>mine" not in text
    assert "12 cases: 10 done, 1 failed, 1 open" in text
    assert "Point 1, repetition 1 (radial load = 500 N, drive speed = 6000 rpm) failed" in text
    assert "1 of 12 cases are not computed yet" in text
    assert (
        "2 of 10 cases (energy_audit; the first is point 0, repetition 0): The energy audit is "
        "exceeded." in text
    )
    assert "Every point has 2 repetitions" in text
    assert "kept figures only" in text
    order = [text.index(f"<h2>{t}</h2>") for t in ("What was varied", "Results", "Comparison")]
    assert order == sorted(order)


def test_warnings_of_runs_reach_the_table_and_the_report(tmp_path):
    """A kind of warning once in words, by its key in every row that has it."""
    short = [RunWarning("short_run", f"Statistics rest on {k} passes.") for k in range(6)]
    results = study_folder(
        tmp_path / "s", LOADS, SPEEDS, fails=(5,),
        warned=lambda k: (short[k], EXCEEDED) if k == 2 else (short[k],) if k else (),
    )  # fmt: skip
    assert list(results.table["warnings"]) == [
        "", "short_run", "short_run, energy_audit", "short_run", "short_run", "",
    ]  # fmt: skip
    told = results.report().splitlines()
    assert told[0] == (
        "4 of 5 cases (short_run; the first is point 1, repetition 0): Statistics rest on 1 passes."
    )
    assert told[1].startswith("1 of 5 cases (energy_audit; point 2, repetition 0): The energy")
    written = dict(zip(("table",), results.write()))["table"].read_text("utf-8")
    assert "warnings" in written and '"short_run, energy_audit"' in written
    sound = study_folder(tmp_path / "sound", LOADS)
    assert sound.warning_lines() == []


def test_means_and_intervals_are_those_of_the_statistics(tmp_path):
    results = study_folder(tmp_path / "s", LOADS, repeat=Repeat(count=3))
    (output,) = outputs(results)
    assert isinstance(output, Output) and output.unit == "%"
    assert output.mean == pytest.approx([1.1, 1.4])  # % of 0.010 0.011 0.012, 0.013 0.014 0.015
    assert output.half == pytest.approx([4.30265 * 0.1 / 3**0.5] * 2, rel=1e-4)  # t(0.975, 2)


def test_axes_become_abscissas_and_the_others_groups(tmp_path):
    results = study_folder(tmp_path / "s", LOADS, SPEEDS)
    load, speed = abscissas(results)
    assert (load.title, speed.title) == ("radial load [N]", "drive speed [rpm]")
    assert list(load.values) == [500.0] * 3 + [1000.0] * 3
    assert list(load.group) == [f"drive speed = {v} rpm" for v in (3000, 6000, 9000)] * 2
    assert list(speed.group) == ["radial load = 500 N"] * 3 + ["radial load = 1000 N"] * 3
    assert point_names(results)[5] == "radial load = 1000 N, drive speed = 9000 rpm"


def test_labels_pairs_and_samples_are_axes_as_well(tmp_path):
    labels = Points(({"label": "slow", "drive.speed": "1000 rpm"}, {"label": "base"}))
    (axis,) = abscissas(study_folder(tmp_path / "a", labels))
    assert list(axis.values) == ["slow", "base"] and set(axis.group) == {""}
    pairs = Zip({"load.radial": ["1 N", "2 N"], "drive.speed": ["1 rpm", "2 rpm"]})
    assert [a.name for a in abscissas(study_folder(tmp_path / "b", pairs))] == ["radial load"]
    box = LatinHypercube(
        ranges={"load.radial": ("1 N", "9 N"), "drive.speed": ("1 rpm", "9 rpm")}, count=4
    )
    found = abscissas(study_folder(tmp_path / "c", box))
    assert [a.name for a in found] == ["radial load", "drive speed"]
    assert not any(a.joined for a in found), "lines between scattered points mean nothing"
    assert study_folder(tmp_path / "d", box).page(tmp_path / "d.html").is_file()


@pytest.mark.parametrize(
    ("path", "varied", "words"),
    [
        ("defects.0.displacement", (), "crossbeam 5 displacement"),
        ("defects.0.displacement", ("defects.0.crossbeam",), "crossbeam displacement"),
        ("defects.0.crossbeam", (), "number of the crossbeam"),
        ("defects.1.clearance", (), "pocket 3 worn pocket clearance"),
        ("defects.2.clearance", (), "defects 2 clearance"),
        ("load.axial", (), "axial load"),
        ("cage.model", (), "cage model"),
        ("bearing.radial_clearance", (), "bearing radial clearance"),
        ("contacts.pocket.friction.kinetic", (), "contacts pocket friction kinetic"),
    ],
)
def test_a_path_in_words(path, varied, words):
    defects = [
        {"type": "crossbeam", "crossbeam": 5, "displacement": "0.2 mm"},
        {"type": "worn_pocket", "pocket": 3, "clearance": "0.1 mm"},
    ]
    assert in_words(path, {"defects": defects}, varied) == words


def test_a_varied_defect_is_named_in_words_throughout(tmp_path, monkeypatch):
    monkeypatch.setitem(CASE, "defects", [{"type": "crossbeam", "crossbeam": 5,
                                           "displacement": "0.1 mm"}])  # fmt: skip
    sizes = Grid("defects.0.displacement", ["0.1 mm", "0.2 mm"])
    results = study_folder(tmp_path / "s", sizes)
    assert point_names(results)[1] == "crossbeam 5 displacement = 0.2 mm"
    (axis,) = abscissas(results)
    assert axis.title == "crossbeam 5 displacement [mm]"
    text = results.page(tmp_path / "page.html").read_text("utf-8")
    heads = re.findall(r"<button type=.button.>(.*?)</button>", text)
    assert heads.count("crossbeam 5 displacement [mm]") == 2, "of points and of cases"
    assert "crossbeam 5 displacement (defects.0.displacement): 0.1 mm, 0.2 mm." in text
    assert not [head for head in heads if "defects" in head]
    assert heads.index("folder") < heads.index("state") < len(heads) - 1


def test_a_study_without_axes_or_results(tmp_path):
    results = study_folder(tmp_path / "s", open_=(0,))
    text = results.page(tmp_path / "page.html").read_text("utf-8")
    assert "One point." in text and "nothing to compare yet" in text


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("FLEXCAGE_DEBUG", raising=False)
    study_folder(tmp_path / "study", LOADS)
    (tmp_path / "empty").mkdir()
    (tmp_path / "run" / "results.zarr").mkdir(parents=True)
    (tmp_path / "there.html").write_text("precious")
    return tmp_path


MISTAKES = {
    "nothing there": (["nowhere"], "no folder 'nowhere'"),
    "neither": (
        ["empty"],
        "'empty' is not the folder of a run or a study: it has no results.zarr and no",
    ),
    "a file": (["there.html"], "'there.html' is not the folder of a run or a study: it is a file"),
    "exists": (["study", "-o", "there.html"], "'there.html' exists already; --force"),
    "ending": (["study", "-o", "page.pdf"], "'page.pdf' should end in .html"),
    "no such folder": (["study", "-o", "none/page.html"], "There is no folder 'none' for"),
    "a folder": (["study", "-o", "dir.html", "--force"], "'dir.html' is a folder"),
    "points of a run": (["run", "--points", "1"], "--points belongs to a study"),
    "no numbers": (["study", "--points", "a"], "--points 'a' should be numbers"),
    "kept no runs": (["study", "--points", "0"], "kept figures only"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes_get_one_sentence(name, here, capsys):
    argv, words = MISTAKES[name]
    (here / "dir.html").mkdir()
    assert cli.main(["report", *argv]) == 2
    err = capsys.readouterr().err
    assert words in err and re.fullmatch(r"flexcage: [^\n]*\.\n", err), err
    assert (here / "there.html").read_text() == "precious"


def test_the_command_writes_into_the_folder_unless_told(here, capsys):
    assert cli.main(["report", "study"]) == 0
    assert "written: study/report.html (" in capsys.readouterr().out
    assert cli.main(["report", "study"]) == 0, "a page of ours is written anew"
    assert cli.main(["report", "study", "--force", "-o", "there.html"]) == 0
    assert "report of a study" in (here / "there.html").read_text("utf-8")


def test_a_link_in_the_pages_place_is_replaced_and_not_followed(here, capsys):
    (here / "study" / "report.html").symlink_to(here / "there.html")
    assert cli.main(["report", "study"]) == 0
    assert (here / "there.html").read_text() == "precious"
    page = here / "study" / "report.html"
    assert not page.is_symlink() and "report of a study" in page.read_text("utf-8")


def test_points_are_chosen_among_those_with_a_run(tmp_path):
    results = with_runs(study_folder(tmp_path / "s", LOADS, keep="runs"))
    with pytest.raises(InputError, match="Point 7 has no kept run with a flexible cage"):
        results.page(tmp_path / "page.html", points=[7])
    text = results.page(tmp_path / "page.html").read_text("utf-8")
    assert "No kept run has a flexible cage" in text


def with_runs(results, *points):
    """The study with a run's folder in the cases of these points, or in all."""
    for row in results.rows:
        if not points or row.planned.number in points:
            (results.folder.case(row.planned.hash) / "results.zarr").mkdir()
    return results


@pytest.mark.parametrize("keep", ["runs", "figures"])
def test_stress_is_shown_of_the_cases_that_kept_their_run(keep, tmp_path):
    """Whatever the study says that it keeps: that may have changed since."""
    outputs = ("mode_count", "stress_peak", "cage_speed")
    repeat, flexible = Repeat(count=2), Grid("cage.model", ["flexible"])
    results = study_folder(
        tmp_path / "s", SPEEDS, flexible, keep=keep, outputs=outputs, repeat=repeat
    )
    assert to_show(results, None) == (
        [], "The study kept figures only, so no stress can be shown."
    )  # fmt: skip
    with_runs(results, 1)
    shown, chosen = to_show(results, None)
    assert [(r.planned.number, r.planned.repetition) for r in shown] == [(1, 0)]
    assert chosen == "Shown is the first kept run of every point with stress."
    assert to_show(results, [1])[0] == shown
    with pytest.raises(InputError, match="Point 2 has no kept run .* choose from 1"):
        to_show(results, [2])
