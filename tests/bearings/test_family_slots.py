"""What a family brings along is there, and its variables fit those that all bearings have."""

from dataclasses import fields
from itertools import permutations
from pkgutil import iter_modules

import grimp
import pytest

from flexcage import bearings
from flexcage.core.wings import FAMILIES
from flexcage.results.figures.part import OwnFigures
from flexcage.results.figures.table import FIGURES
from flexcage.results.registry import LABELS, RUN_DIMS, TIME, VARIABLES, families_with, variables_of
from flexcage.results.slip import ElementSpeed

RUN = [family for family in FAMILIES.values() if family.motion is not None]
#: What families that run have not.
WITHOUT = {
    "four_point": {"rings", "bending"},
    "tapered_roller": {"rings", "bending"},
    "spherical_roller": {"rings", "bending"},
    "double_row_ball": {"rings", "bending", "losses"},
    "double_row_roller": {"rings", "bending", "losses"},
}


@pytest.mark.parametrize("family", FAMILIES.values(), ids=lambda family: family.name)
def test_every_slot_gives_something(family):
    """All of a family that runs; of one with a static solution alone, what it fills at all."""
    for slot in fields(family):
        value = getattr(family, slot.name)
        if value is None:
            lacking = WITHOUT.get(family.name, ())
            assert family.motion is None or slot.name in lacking, slot.name
        else:
            assert (value() if callable(value) else value) is not None, slot.name
    if family.motion is not None:
        assert isinstance(family.speed(), ElementSpeed)
        assert isinstance(family.figures(), OwnFigures)


@pytest.mark.parametrize("family", RUN, ids=lambda family: family.name)
def test_own_variables_and_figures_are_registered_and_labelled(family):
    own = family.variables()
    for v in own.variables:
        assert VARIABLES[v.name] == v and family.name in families_with(v.name)
        assert set(v.dims) <= {TIME, *LABELS, *RUN_DIMS, *own.dims}, v.name
    for figure in family.figures().figures.values():
        assert FIGURES[figure.key] == figure and family.name in FIGURES.owners(figure.key)
    assert {"element_position", "race_force", "race_slip"} <= set(variables_of(family.name))


def test_figures_stand_in_one_run_a_section():
    sections = [figure.section for figure in FIGURES.values()]
    assert len(set(sections)) == 1 + sum(a != b for a, b in zip(sections, sections[1:]))


def test_a_family_without_motion_has_statics():
    for family in FAMILIES.values():
        assert family.motion or family.statics() is not None, family.name


def foundations(family):
    """Names of the families on which one is built, one on the other."""
    while family.built_on:
        yield family.built_on
        family = FAMILIES[family.built_on]


def test_families_know_nothing_of_each_other():
    """But for those that say on which other one they are built, and on what that is built."""
    graph = grimp.build_graph("flexcage")
    folders = [f"{bearings.__name__}.{m.name}" for m in iter_modules(bearings.__path__) if m.ispkg]
    assert len(folders) > 1
    rows = {(f"{bearings.__name__}.{f.name}", f"{bearings.__name__}.{below}")
            for f in FAMILIES.values() for below in foundations(f)}  # fmt: skip
    for importer, imported in set(permutations(folders, 2)) - rows:
        chain = graph.find_shortest_chain(importer, imported, as_packages=True)
        assert chain is None, f"{importer} imports {imported}: {' -> '.join(chain)}"
