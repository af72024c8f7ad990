"""The stages before a run take the sections of a case alone."""

from dataclasses import fields

import numpy as np

from flexcage import load_case
from flexcage.case.sections import CageSections, CaseSections
from flexcage.stages import (
    assembled_start,
    bearing_in_motion,
    cage_mesh,
    cage_modes,
    cage_reduction,
)

CASE = load_case({
    "bearing": {"preset": "N1013"},
    "load": {"radial": "500 N"},
    "cage": {"model": "rigid"},
    "mesh": {"fineness": "coarse"},
    "solver": {"duration": "1 ms"},
    "start": {"push": "5 mm/s"},
})  # fmt: skip


def only(sections, case):
    """These sections of a case, and nothing else: no checks, no texts."""
    return sections(**{field.name: getattr(case, field.name) for field in fields(sections)})


def test_a_start_comes_from_specs_alone():
    def start(cage, specs):
        mesh = cage_mesh(cage)
        bearing = bearing_in_motion(specs, mesh, cage_reduction(cage, mesh))
        return assembled_start(specs, bearing)

    bare = start(only(CageSections, CASE), only(CaseSections, CASE))
    whole = start(CASE, CASE)
    np.testing.assert_array_equal(bare.y, whole.y)
    np.testing.assert_array_equal(bare.yd, whole.yd)


def test_modes_are_those_of_the_flexible_cage_whatever_the_model():
    specs = only(CageSections, CASE.replace("modes.count", 4))
    assert cage_reduction(specs, cage_mesh(specs)) is None
    assert len(cage_modes(specs).frequency) >= 4
