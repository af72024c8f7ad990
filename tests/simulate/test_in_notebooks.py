"""What a notebook and a terminal show of a case, a run, its summary and a static solution."""

from xml.etree import ElementTree

import pytest

import flexcage
from flexcage.core.warning import RunWarning
from flexcage.results.figures.figure import BRIEF
from flexcage.results.figures.table import marked
from flexcage.results.row import SummaryRow
from flexcage.results.summary import Section, Summary


def cells(tree):
    return [[cell.text or "" for cell in line] for line in tree.iter("tr")]


def words(tree):
    return " ".join(tree.itertext())


@pytest.fixture(scope="module")
def case():
    times = [1e-3 * k for k in range(20)]
    return flexcage.Case.from_preset(
        "N1013", name="a <b> & c", cage={"model": "rigid"}, load={"radial": 1000.0},
        drive={"times": times, "speeds": [600.0] * 20}, solver={"duration": 1e-3},
    )  # fmt: skip


def test_a_case_in_words_and_what_was_given(case):
    tree = ElementTree.fromstring(case._repr_html_())
    assert tree[0].text == f"Case a <b> & c ({case.hash})"
    assert "22 rollers of 8 mm" in words(tree) and "1000 N" in words(tree)
    heads, *rows = cells(tree)
    given = dict(rows)
    assert heads == ["key", "value"] and given.pop("drive.times") == "20 values"
    assert given.pop("drive.speeds") == "20 values"
    assert given == {"cage.model": "rigid", "load.radial": "1000 N", "solver.duration": "0.001 s"}


def test_a_case_of_nothing_but_a_preset_has_no_table():
    tree = ElementTree.fromstring(flexcage.Case.from_preset("7010C-PI")._repr_html_())
    assert not cells(tree) and "18 balls" in words(tree)


def test_a_run_shows_warnings_and_the_figures_that_matter(case):
    run = flexcage.simulate(case)
    tree = ElementTree.fromstring(run._repr_html_())
    assert tree[0].text == f"Run a <b> & c: {run.store.n_time:,} samples"
    assert [item.text for item in tree.iter("li")] == [f"Warning: {w.text}" for w in run.warnings]
    shown = {row[0]: row[1] for row in cells(tree)}
    figure = run.summary.row("cage_speed")
    assert shown[figure.label] == figure.text and len(shown) <= len(marked(BRIEF))
    whole = ElementTree.fromstring(run.summary._repr_html_())
    labels = {row[0] for row in cells(whole)}
    assert labels == {r.label for s in run.summary.sections for r in s.shown}


def test_a_summary_is_short_in_a_terminal_and_whole_in_a_notebook():
    rows = (
        SummaryRow("cage_speed", "Cage speed", 283.6, "rpm", "mean; of all", margin=10.0),
        SummaryRow("none", "None", 0.0, "N", idle=True),
    )
    summary = Summary((Section("Speeds & more", rows),), (RunWarning("short", "Too <short>."),))
    assert repr(summary) == "Summary(2 figures in 1 sections, warnings: 1)"
    assert repr(Summary()) == "Summary(0 figures in 0 sections)"
    tree = ElementTree.fromstring(summary._repr_html_())
    assert [item.text for item in tree.iter("li")] == ["Warning: Too <short>."]
    assert [fold.text for fold in tree.iter("summary")] == ["Speeds & more"]
    value = ["Cage speed", rows[0].text, rows[0].margin_text, "rpm"]
    assert cells(tree) == [[*value, "mean"], [*value, "mean; of all"]]


def test_a_static_case_shows_what_it_asks():
    bearing = flexcage.load_preset("7010C-PI").bearing
    case = flexcage.StaticCase(bearing=bearing, load=flexcage.spec.Load(axial=500.0))
    tree = ElementTree.fromstring(case._repr_html_())
    assert "7010C" in tree[0].text and cells(tree)[1:] == [["load.axial", "500 N"]]


@pytest.mark.parametrize(("preset", "load"), [("N1013", "radial"), ("7010C-PI", "axial")])
def test_a_static_solution_shows_what_its_text_says(preset, load):
    bearing = flexcage.load_preset(preset).bearing
    load, drive = flexcage.spec.Load(**{load: 500.0}), flexcage.spec.Drive(speed=100.0)
    solution = flexcage.solve_static(flexcage.StaticCase(bearing=bearing, load=load, drive=drive))
    tree = ElementTree.fromstring(solution._repr_html_())
    assert solution.title in tree[0].text and "954.93 rpm" in tree[0].text
    text, rows = solution.table(), cells(tree)
    peaks = {"loaded elements", "largest force on a race", "largest pressure"}
    for row in rows:
        assert row[0] in peaks or all(cell in text for cell in row)
    assert len(rows) > bearing.element_count + 15
    assert [fold.text for fold in tree.iter("summary")] == ["Stiffness", "Frequencies", "Elements"]
