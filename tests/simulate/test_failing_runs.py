"""Runs that go wrong say when and where, and keep the last good state."""

import re

import numpy as np
import pytest
from n1013_states import bearing_of
from simulate_cases import Interrupted

from flexcage.bearings.cylindrical_roller.recording import RECORDING, overlaps
from flexcage.core.errors import InputError, RunFailed
from flexcage.integrate.integration import integration_of
from flexcage.integrate.recorded import new_store
from flexcage.system.start import find_start
from flexcage.verification.runs import n1013

BLOCK = 50 / 50e3  # [s]


class Broken(Interrupted):
    """A progress context that changes the bearing once the first block is done."""

    def __init__(self, harm):
        super().__init__(10**6, BLOCK)
        self.harm = harm

    def to(self, done):
        if not self.calls:
            self.harm()
        super().to(done)


@pytest.fixture
def integration(tmp_path):
    case = n1013({"cage.model": "rigid", "solver.duration": "4 ms", "output.block": 50})
    bearing = bearing_of(case)
    start = find_start(bearing, limit_force=2e4)
    store = new_store(
        tmp_path / "r.zarr", bearing, RECORDING, duration=4e-3, output=case.output, attrs={}
    )
    return integration_of(bearing, RECORDING, start, store, solver=case.solver, output=case.output)


def kept(integration, until):
    """Samples are there and finite up to ``until`` [s], and so is the last good state."""
    ds, last = integration.store.dataset(), integration.store.last()
    assert BLOCK <= ds["time"].values[-1] <= float(last["time"]) <= until
    assert all(np.isfinite(ds[name].values).all() for name in ("cage_position", "race_force"))
    assert np.isfinite(last["y"]).all() and integration.store.blocks >= 1
    return last


def test_a_value_that_is_no_number(integration):
    normal = integration.bearing.data.model.outer.normal

    def harm():
        normal[0] = np.nan

    with pytest.raises(RunFailed, match=r"t = 1\.00.* ms: .*roller \d+ on its outer race with nan"):
        integration.march(Broken(harm))
    kept(integration, 1.01e-3)


def test_a_pocket_that_has_no_force_is_named_before_it_is_touched(integration):
    """The last good state has all forces: that of no pocket that touches is asked for in it."""
    normal = integration.bearing.data.model.pocket.normal

    def harm():
        normal[0, 0] = np.nan

    with pytest.raises(RunFailed, match=r"then was roller \d+ on its pocket's face \w+ with nan"):
        integration.march(Broken(harm))


def test_a_race_that_gives_way(integration):
    """Its contacts lose their stiffness: the load drives the inner ring through its rollers."""
    bearing = integration.bearing

    def harm():
        bearing.data.model.inner.normal[0] = 1.0

    with pytest.raises(RunFailed, match=r"roller \d+ lies 1 mm deep in its inner race at") as said:
        integration.march(Broken(harm))
    last = kept(integration, 4e-3)
    roller = int(re.search(r"roller (\d+)", str(said.value))[1])
    azimuth = bearing.layout.q(last["y"])["elements"][roller, 2]
    assert np.cos(azimuth) > 0.95  # where the load points
    depth = overlaps(bearing.data.model, bearing.layout, last["y"][None])[0]
    assert 0.5e-3 < depth[:, 0].max() < 1e-3 and depth[:, 1:].max() < 0.2e-3


def started(limit, load=None, **changes):
    case = n1013({"cage.model": "rigid", "mesh.fineness": "coarse", **changes})
    bearing = bearing_of(case)
    if load is not None:
        bearing.data.model.bodies.load[1][:] = load  # beyond what a case may ask for
    return find_start(bearing, limit_force=limit)


def test_a_defect_is_blamed_only_if_the_bearing_without_it_assembles():
    bent = {"defects": [{"type": "crossbeam", "crossbeam": 5, "displacement": "0.5 mm"}]}
    with pytest.raises(InputError, match=r"a defect pinches roller 4 with .* make the defect sm"):
        started(1e3, **bent)
    with pytest.raises(InputError, match=r"whatever the defects: .* the load, the speed"):
        started(1e3, load=5e7, **bent)
    with pytest.raises(RunFailed, match=r"no equilibrium .* is the load, the speed"):
        started(1e3, load=5e7)


def test_rollers_larger_than_their_pockets_are_not_called_a_defect():
    changes = {"bearing.roller_scatter": "50 um", "cage.pocket_width": "8.02 mm"}
    with pytest.raises(InputError, match=r"roller \d+ is 0\.\d+ mm larger than its pocket") as said:
        started(100.0, **changes)
    assert said.value.where == "bearing.roller_scatter"


def test_overlaps_of_a_start(integration):
    """Loaded rollers touch both races by micrometres, and lie in the middle of their pockets."""
    bearing = integration.bearing
    depth = overlaps(bearing.data.model, bearing.layout, integration.state.D[:1])[0]
    play = bearing.data.model.pocket.half[0] - bearing.data.model.bodies.radius[0]
    assert 1e-6 < depth[0, 0] < 20e-6 and 1e-6 < depth[0, 1] < 20e-6
    np.testing.assert_allclose(depth[:, 2] + depth[:, 3], -2.0 * play, rtol=0.02)
    case = integration.bearing.data.model
    for at, room in ((4, case.pocket.half[1]), (6, case.rib.half_gap)):
        both = depth[:, at] + depth[:, at + 1]
        np.testing.assert_allclose(both, -2.0 * (room - case.pocket.half_roller), rtol=1e-3)


def test_a_moment_that_a_soft_shaft_does_not_bear():
    soft = {"load.tilt": "free", "load.tilt_stiffness": "500 N*m/rad", "load.moment_z": "100 N*m"}
    with pytest.raises(RunFailed, match="the moment for such a load.tilt_stiffness, the speed"):
        started(2e4, **soft)
