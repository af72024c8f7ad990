"""The one list of figures: every figure's title, unit and place come from it, and nowhere else."""

import ast
import functools
import re
from pathlib import Path

import flexcage
from flexcage.results import known
from flexcage.results.known import KNOWN, STATISTIC, TEXT, marked
from flexcage.results.summary import SHOWN, Summary, figure

SOURCES = [
    path
    for path in Path(flexcage.__file__).parent.rglob("*.py")
    if path != Path(known.__file__) and "verification" not in path.parts  # has rows of its own
]
#: Calls that take the name of a figure first.
BY_NAME = {"figure", "statistic", "stored_figure", "_figure"}


@functools.cache
def trees():
    return {path: ast.parse(path.read_text("utf-8")) for path in SOURCES}


def nodes(kind):
    for path, tree in trees().items():
        for node in ast.walk(tree):
            if isinstance(node, kind):
                yield f"{path.name}:{node.lineno}", node


def test_no_title_of_a_figure_is_typed_again():
    titles = {f.title for f in KNOWN.values()} | {f.pattern for f in KNOWN.values()}
    calls = [node for _, node in nodes(ast.Call) if ast.unparse(node.func) == "figures_in"]
    listed = {part for call in calls for part in ast.walk(call)}  # by families, as by ``known``
    again = [
        f"{place} {node.value}"
        for place, node in nodes(ast.Constant)
        if node.value in titles and node not in listed
    ]
    assert not again, f"take it from KNOWN: {again}"


def test_no_row_of_a_summary_has_a_name_of_its_own():
    own = [
        place
        for place, node in nodes(ast.Call)
        if ast.unparse(node.func) in ("Row", "Row.of")
        if node.args and isinstance(node.args[0], ast.Constant)
    ]
    assert not own, f"make it by figure() or statistic(): {own}"


def test_every_stage_of_a_run_has_its_wall_time():
    """A summary written after pictures of rings, or a rivet's joint, once ended in a KeyError."""
    stages = {
        node.args[0].value
        for _, node in nodes(ast.Call)
        if ast.unparse(node.func).removesuffix(".named").rpartition(".")[2] == "stages"
        if node.args and isinstance(node.args[0], ast.Constant)
    }
    assert {"mesh", "solve", "rings", "rivets", "pictures"} <= stages
    assert {f"wall_{stage}" for stage in stages} <= set(KNOWN)


def test_every_name_that_the_package_asks_for_is_a_figure():
    asked = [
        (place, argument.value)
        for place, node in nodes(ast.Call)
        if getattr(node.func, "id", "") in BY_NAME
        for argument in node.args[:3]
        if isinstance(argument, ast.Constant) and isinstance(argument.value, str)
    ]
    assert len(asked) > 50
    unknown = [f"{place} {name}" for place, name in asked if re.fullmatch(r"[a-z]+(_\w+)+", name)
               and name not in KNOWN]  # fmt: skip
    assert not unknown


def test_titles_are_unlike_and_units_are_those_of_summaries():
    titles = [f.title for f in KNOWN.values()]
    assert len(set(titles)) == len(titles)
    assert all(f.shown in SHOWN for f in KNOWN.values())


def test_a_mark_puts_a_figure_on_its_page():
    for mark in (known.BRIEF, known.LARGE, known.EFFORT, known.SETTLING, known.CONVERGENCE):
        assert marked(mark)
    assert all(STATISTIC in KNOWN[key].marks for key in marked(known.SETTLING))
    assert not set(marked(TEXT)) & set(marked(known.CONVERGENCE))


def test_a_title_takes_the_bearings_words():
    assert figure("roller_passes", 3).label == "Element passes counted"
    assert figure("roller_passes", 3, Element="Ball").label == "Ball passes counted"
    assert KNOWN["pocket_force_mean"].quantity == "pocket force"


def test_a_section_of_a_summary_is_named_in_the_list_alone():
    """Titles of sections are not typed again, but where a family gives its own figures."""
    sections = {f.section for f in KNOWN.values()} - {"Cage", "Wear"}  # words of other things too
    calls = [node for _, node in nodes(ast.Call) if ast.unparse(node.func) == "figures_in"]
    listed = {part for call in calls for part in ast.walk(call)}
    rooms = ("results", "run", "stress", "study", "report")
    again = [
        f"{path.name}:{node.lineno} {node.value}"
        for path, tree in trees().items()
        if path.relative_to(Path(flexcage.__file__).parent).parts[0] in rooms
        for node in ast.walk(tree)
        if isinstance(node, ast.Constant) and node.value in sections and node not in listed
    ]
    assert not again, f"take it from KNOWN: {again}"


def test_figures_of_a_section_stand_behind_the_figure_that_is_named():
    first = Summary().with_figures([figure("cage_mass", 1.0)]).with_figures([figure("steps", 3)])
    summary = first.with_figures([figure("stress_peak", 1e6)], after="cage_mass")
    assert [s.rows[0].key for s in summary.sections] == ["cage_mass", "stress_peak", "steps"]
    assert [s.title for s in summary.sections] == [
        KNOWN[key].section for key in ("cage_mass", "stress_peak", "steps")
    ]
    assert summary.with_figures([figure("steps", 4)])["steps"] == 4
    assert summary.with_figures([]) == summary
