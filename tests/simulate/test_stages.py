"""The stages before a run take their specs alone; a case is one thing that has them."""

from types import SimpleNamespace

import numpy as np

from flexcage import load_case
from flexcage.stages import (
    CageSpecs,
    MotionSpecs,
    StartSpecs,
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


def only(protocol, case):
    """What the Protocol names of a case, and nothing else."""
    names = [name for name, member in vars(protocol).items() if isinstance(member, property)]
    return SimpleNamespace(**{name: getattr(case, name) for name in names})


def test_a_start_comes_from_specs_alone():
    def start(cage_specs, motion_specs, start_specs):
        mesh = cage_mesh(cage_specs)
        bearing = bearing_in_motion(motion_specs, mesh, cage_reduction(cage_specs, mesh))
        return assembled_start(start_specs, bearing)

    bare = start(only(CageSpecs, CASE), only(MotionSpecs, CASE), only(StartSpecs, CASE))
    whole = start(CASE, CASE, CASE)
    np.testing.assert_array_equal(bare.y, whole.y)
    np.testing.assert_array_equal(bare.yd, whole.yd)


def test_modes_are_those_of_the_flexible_cage_whatever_the_model():
    specs = only(CageSpecs, CASE.replace("modes.count", 4))
    assert cage_reduction(specs, cage_mesh(specs)) is None
    assert len(cage_modes(specs).frequency) >= 4
