"""The one list of figures: every figure's title, unit and place come from it, and nowhere else."""

import ast
import functools
import re
from pathlib import Path

import flexcage
from flexcage.results.figures import figure as marks
from flexcage.results.figures.figure import STATISTIC, TEXT
from flexcage.results.figures.table import FIGURES, marked
from flexcage.results.row import SHOWN
from flexcage.results.summary import Summary

PACKAGE = Path(flexcage.__file__).parent
#: Where figures are listed: the common ones, and a family's own.
TABLES = {*PACKAGE.glob("results/figures/*.py"), *PACKAGE.glob("bearings/*/figures.py")}
SOURCES = [
    path
    for path in PACKAGE.rglob("*.py")
    if path not in TABLES and "verification" not in path.parts  # has rows of its own
]
#: Calls that take the names of figures.
BY_NAME = {"stored_figure", "number", "with_figures"}


@functools.cache
def trees():
    return {path: ast.parse(path.read_text("utf-8")) for path in SOURCES}


def nodes(kind):
    for path, tree in trees().items():
        for node in ast.walk(tree):
            if isinstance(node, kind):
                yield f"{path.name}:{node.lineno}", node


def test_no_title_of_a_figure_is_typed_again():
    titles = {f.title for f in FIGURES.values()} | {f.pattern for f in FIGURES.values()}
    again = [f"{place} {node.value}" for place, node in nodes(ast.Constant) if node.value in titles]
    assert not again, f"take it from FIGURES: {again}"


def test_no_row_of_a_summary_has_a_name_of_its_own():
    own = [
        place
        for place, node in nodes(ast.Call)
        if ast.unparse(node.func) in ("Row", "Row.of")
        if node.args and isinstance(node.args[0], ast.Constant)
    ]
    assert not own, f"make it by a table of results/figures: {own}"


def test_every_stage_of_a_run_has_its_wall_time():
    """A summary written after pictures of rings, or a rivet's joint, once ended in a KeyError."""
    stages = {
        node.args[0].value
        for _, node in nodes(ast.Call)
        if ast.unparse(node.func).removesuffix(".named").rpartition(".")[2] == "stages"
        if node.args and isinstance(node.args[0], ast.Constant)
    }
    assert {"mesh", "solve", "rings", "rivets", "pictures"} <= stages
    assert {f"wall_{stage}" for stage in stages} <= set(FIGURES)


def test_every_name_that_the_package_asks_for_is_a_figure():
    asked = [
        (place, part.value)
        for place, node in (*nodes(ast.Call), *nodes(ast.Subscript))
        if (isinstance(node, ast.Subscript) and ast.unparse(node.value) == "FIGURES")
        or (isinstance(node, ast.Call) and ast.unparse(node.func).rpartition(".")[2] in BY_NAME)
        for part in ast.walk(node)
        if isinstance(part, ast.Constant) and isinstance(part.value, str)
    ]
    assert len(asked) > 15
    unknown = [f"{place} {name}" for place, name in asked if re.fullmatch(r"[a-z]+(_\w+)+", name)
               and name not in FIGURES]  # fmt: skip
    assert not unknown


def test_titles_are_unlike_and_units_are_those_of_summaries():
    titles = [f.title for f in FIGURES.values()]
    assert len(set(titles)) == len(titles)
    assert all(f.shown in SHOWN for f in FIGURES.values())


def test_a_mark_puts_a_figure_on_its_page():
    for mark in (marks.BRIEF, marks.LARGE, marks.EFFORT, marks.SETTLING, marks.CONVERGENCE):
        assert marked(mark)
    assert all(STATISTIC in FIGURES[key].marks for key in marked(marks.SETTLING))
    assert not set(marked(TEXT)) & set(marked(marks.CONVERGENCE))


def test_a_title_takes_the_bearings_words():
    passes = FIGURES["roller_passes"]
    assert passes.row(3).label == "Element passes counted"
    assert passes.row(3, Element="Ball").label == "Ball passes counted"
    assert FIGURES["pocket_force_mean"].quantity == "pocket force"


def test_a_section_of_a_summary_is_named_in_the_list_alone():
    """Titles of sections are not typed again, but where a family gives its own figures."""
    sections = {f.section for f in FIGURES.values()} - {"Cage", "Wear"}  # words of other things too
    rooms = ("results", "run", "stress", "study", "report")
    again = [
        f"{path.name}:{node.lineno} {node.value}"
        for path, tree in trees().items()
        if path.relative_to(Path(flexcage.__file__).parent).parts[0] in rooms
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and node.value in sections
    ]
    assert not again, f"take it from FIGURES: {again}"


def test_figures_of_a_section_stand_behind_the_figure_that_is_named():
    mass, steps, peak = (FIGURES[k].row(1.0) for k in ("cage_mass", "steps", "stress_peak"))
    first = Summary().with_figures([mass]).with_figures([steps])
    summary = first.with_figures([peak], after="cage_mass")
    assert [s.rows[0].key for s in summary.sections] == ["cage_mass", "stress_peak", "steps"]
    assert [s.title for s in summary.sections] == [
        FIGURES[key].section for key in ("cage_mass", "stress_peak", "steps")
    ]
    assert summary.with_figures([FIGURES["steps"].row(4)])["steps"] == 4
    assert summary.with_figures([]) == summary
