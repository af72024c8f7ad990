"""The stages before a run take the sections that they read, in groups that a case is."""

import inspect
import re
import typing
from dataclasses import fields
from functools import partial
from pathlib import Path

import numpy as np
import pytest

from flexcage import Case, load_case, stages
from flexcage.case import sections
from flexcage.case.sections import (
    CageSections,
    MeshSections,
    ModesSections,
    MotionSections,
    RingSections,
    StartSections,
)
from flexcage.core.timing import Stages
from flexcage.stages import (
    assembled_start,
    bearing_in_motion,
    bearing_to_compile,
    bent_rings,
    cage_mesh,
    cage_modes,
    cage_reduction,
    flexible_cage,
    made_cage,
)

CASE = load_case({
    "bearing": {"preset": "N1013"},
    "load": {"radial": "500 N"},
    "cage": {"model": "rigid"},
    "mesh": {"fineness": "coarse"},
    "modes": {"count": 4},
    "solver": {"duration": "1 ms"},
    "start": {"push": "5 mm/s"},
    "defects": [{"type": "crossbeam", "crossbeam": 5, "displacement": "0.1 mm"}],
})  # fmt: skip
FLEXIBLE = CASE.replace("cage.model", "flexible")
BALLS = load_case({
    "bearing": {"preset": "7010C-PI"},
    "cage": {"model": "rigid"},
    "mesh": {"fineness": "coarse"},
    "load": {"axial": "100 N"},
})  # fmt: skip
BENDING = FLEXIBLE.replace("outer_ring.ring", "flexible")


def only(group, case):
    """These sections of a case, and nothing else: no checks, no texts."""
    return group(**{field.name: getattr(case, field.name) for field in fields(group)})


def watched(group, case):
    """The same, and a set that grows by the names of what is read of it."""
    read = set()

    class Watched(group):
        def __getattribute__(self, name):
            read.add(name)
            return super().__getattribute__(name)

    return only(Watched, case), read


def start_of(specs):
    """Start of a run, by groups alone."""
    of = [only(group, specs) for group in (CageSections, MotionSections, StartSections)]
    bearing = bearing_in_motion(of[1], *made_cage(of[0], Stages(None)))
    return assembled_start(of[2], bearing)


@pytest.mark.parametrize("case", [CASE, FLEXIBLE], ids=["rigid", "flexible"])
def test_a_start_comes_from_groups_alone(case):
    mesh = cage_mesh(case)
    bearing = bearing_in_motion(case, mesh, cage_reduction(case, mesh))
    whole, bare = assembled_start(case, bearing), start_of(case)
    np.testing.assert_array_equal(bare.y, whole.y)
    np.testing.assert_array_equal(bare.yd, whole.yd)


def test_modes_are_those_of_the_flexible_cage_whatever_the_model():
    specs = only(CageSections, CASE)
    assert cage_reduction(specs, cage_mesh(specs)) is None
    assert len(cage_modes(specs).frequency) >= 4


def test_the_script_of_the_page_runs():
    page = (Path(__file__).parents[2] / "flexcage" / "README.md").read_text("utf-8")
    blocks = re.findall(r"^```python\n(.*?)^```", page, flags=re.S | re.M)
    (block,) = (block for block in blocks if "flexcage.stages" in block)
    names = {}
    exec(compile(block, "README.md", "exec"), names)
    assert names["frequencies"][0] == pytest.approx(869.1, rel=5e-3)
    np.testing.assert_array_equal(names["mesh"].points, cage_mesh(names["case"]).points)


def moving(specs, case=None):
    """The bearing of sections, with a case's cage, their own if it is not given."""
    case = case or specs
    mesh = cage_mesh(case)
    return bearing_in_motion(specs, mesh, cage_reduction(case, mesh))


def starting(specs):
    return assembled_start(specs, moving(BALLS))


#: The group that a stage takes, and calls, with cases, that read all of it together.
STAGES = {
    made_cage: (CageSections, [(FLEXIBLE, lambda specs: made_cage(specs, Stages(None)))]),
    cage_mesh: (MeshSections, [(FLEXIBLE, cage_mesh)]),
    cage_reduction: (
        CageSections, [(FLEXIBLE, lambda specs: cage_reduction(specs, cage_mesh(specs)))],
    ),
    cage_modes: (ModesSections, [(FLEXIBLE, cage_modes)]),
    flexible_cage: (ModesSections, [(FLEXIBLE, flexible_cage)]),
    bent_rings: (RingSections, [(BENDING, bent_rings)]),
    bearing_in_motion: (
        MotionSections,
        [(case, partial(moving, case=case)) for case in (CASE, FLEXIBLE)],
    ),
    bearing_to_compile: (MotionSections, [(BENDING, bearing_to_compile)]),
    assembled_start: (StartSections, [(BALLS, starting)]),
}  # fmt: skip
#: Of a stage that compiles: what tells kernels apart is not damping.
NOT_READ = {bearing_to_compile: {"modes"}}


@pytest.mark.parametrize("stage", STAGES, ids=lambda f: f.__name__)
def test_a_stage_reads_all_that_it_takes(stage):
    group, calls = STAGES[stage]
    left = {field.name for field in fields(group)}
    for case, call in calls:
        specs, read = watched(group, case)
        call(specs)
        left -= read
    assert left == NOT_READ.get(stage, set())


def test_every_stage_names_a_group_and_none_takes_a_whole_case():
    """A case is all groups, so that each stage takes it as it is."""
    groups = {cls for _, cls in inspect.getmembers(sections, inspect.isclass)
              if cls.__name__.endswith("Sections")}  # fmt: skip
    found = {}
    for name, f in inspect.getmembers(stages, inspect.isfunction):
        hints = typing.get_type_hints(f) if f.__module__ == stages.__name__ else {}
        if "specs" in hints:
            found[name] = hints["specs"]
    assert {f.__name__: STAGES[f][0] for f in STAGES}.items() <= found.items()
    whole = {sections.CaseSections, sections.StaticSections}
    assert set(found.values()) <= groups - whole
    assert all(issubclass(Case, group) for group in found.values())
