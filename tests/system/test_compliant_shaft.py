"""An inner ring free axially and in tilt on a shaft of given stiffness, against closed forms."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from bearing_runs import SOFT, march, rolling_start
from solved_bearings import solve_bearing

from flexcage.case.presets import load_preset
from flexcage.system.spec import Drive, Load
from flexcage.system.start import find_start
from flexcage.system.statics.options import StaticOptions

ROLLERS, BALLS = load_preset("N1013").bearing, load_preset("7010C-PI").bearing
HELD = StaticOptions(tilt="held")
STILL = Drive(speed=0.0)


def swing(t, inertia, stiffness, damping, force):
    """Displacement at times t of a mass on spring and damper that a force pushes from t = 0."""
    decay = 0.5 * damping / inertia
    w = np.sqrt(stiffness / inertia - decay**2)
    ring = np.cos(w * t) + decay / w * np.sin(w * t)
    return force / stiffness * (1.0 - np.exp(-decay * t) * ring)


@pytest.mark.parametrize("method", ["bdf", "explicit"])
def test_a_ring_that_touches_nothing_swings_as_a_mass_on_a_spring(bearing_of, method):
    """All three motions at once; the multipliers are what spring and damper bear."""
    load = Load(
        gravity=0.0, axial=100.0, axial_stiffness=5e7, axial_damping=400.0, misalignment=5e-5,
        tilt="free", tilt_stiffness=1e4, tilt_damping=0.3, moment_y=0.1, moment_z=-0.2,
    )  # fmt: skip
    bearing = bearing_of(load=load, drive=STILL)
    layout, ring = bearing.layout, bearing.data.model.inner_ring.inertia
    y, yd = rolling_start(bearing)
    layout.q(y)["inner"][:3] = 0.0
    h = march(bearing, y, yd, duration=1e-3, rate=200e3, tolerance=1e-12, h_max=4e-7, method=method)
    assert h.samples.race[:, :, 0].max() == 0.0 and h.samples.rib.max() == 0.0
    q, u = layout.q(h.y)["inner"], layout.u(h.y)["inner"]
    pull = layout.multipliers(h.y)
    for k, (place, rate, inertia, at, force) in enumerate(
        ((0, 0, ring[0], 0.0, 100.0), (3, 4, ring[2], 0.0, 0.1), (4, 5, ring[2], 5e-5, -0.2))
    ):
        stiffness, damping = load.stiffness[k], load.damping[k]
        expected = swing(h.time, inertia, stiffness, damping, force)
        assert np.ptp(expected) > 1.1 * abs(force / stiffness)  # it swings beyond
        np.testing.assert_allclose(q[:, place] - at, expected, atol=2e-4 * np.ptp(expected))
        borne = -stiffness * (q[:, place] - at) - damping * u[:, rate]
        np.testing.assert_allclose(pull[:, k], borne, atol=2e-3 * abs(force))
    stored, work = h.samples.energy.sum(axis=1), h.work.sum(axis=1)
    assert np.ptp(h.power("mount")) > 0.1 * np.ptp(h.power("load"))
    assert np.abs((stored - stored[0]) - (work - work[0])).max() < 1e-4 * np.ptp(h.power("load"))


def test_the_start_displaces_a_ring_by_force_over_stiffness(bearing_of):
    """The rollers stay between the ribs, the cage with them; the multiplier is the force."""
    for axial in (500.0, -300.0):
        bearing = bearing_of(load=Load(radial=1000.0, axial=axial, axial_stiffness=1e6))
        start = find_start(bearing, limit_force=2e4)
        q = bearing.layout.q(start.y)
        assert q["inner"][0] == pytest.approx(axial / 1e6, rel=1e-9)
        assert bearing.layout.multipliers(start.y)[0] == pytest.approx(-axial, rel=1e-9)
        np.testing.assert_allclose(q["elements"][:, 0], axial / 1e6, rtol=1e-9)
        assert q["cage"][0] == pytest.approx(axial / 1e6, rel=1e-9)


def test_a_run_stays_where_force_and_stiffness_put_it(bearing_of):
    """Straight rollers roll without pushing the ring along."""
    load = Load(radial=1000.0, axial=500.0, axial_stiffness=1e7, axial_damping=2e3)
    bearing = bearing_of(load=load)
    h = march(bearing, *rolling_start(bearing), duration=3e-3)
    assert bearing.layout.q(h.y)["inner"][:, 0] == pytest.approx(5e-5, rel=2e-2)


@pytest.mark.parametrize("moment", [(0.0, 2.0), (1.0, -0.5)])
def test_the_starts_tilt_is_that_of_the_static_solution(bearing_of, moment):
    """Other code that shares neither unknowns nor contact kernels. A tilted race pushes its rollers
    along the axis a little, which small angles leave out."""
    load = Load(
        radial=2000.0, gravity=0.0, axial=-80.0, axial_stiffness=1e7, misalignment=2e-4,
        tilt="free", tilt_stiffness=1e3, moment_y=moment[0], moment_z=moment[1],
    )  # fmt: skip
    bearing = bearing_of(load=load, drive=STILL)
    start = find_start(bearing, limit_force=2e4)
    inner = bearing.layout.q(start.y)["inner"][:5]
    pull = bearing.layout.multipliers(start.y)[:3]
    expected = solve_bearing(ROLLERS, load=load)
    assert np.abs(expected.reaction[3:]).max() > 0.1
    scale = np.abs(expected.displacement[3:]).max()
    np.testing.assert_allclose(inner[3:], expected.displacement[3:], atol=2e-3 * scale)
    assert inner[1] == pytest.approx(expected.displacement[1], rel=2e-3)
    assert inner[0] == pytest.approx(-8e-6, abs=1.1 * 2000.0 * scale / 1e7)
    np.testing.assert_allclose(pull[1:], expected.reaction[3:], atol=5e-3 * np.abs(pull[1:]).max())


def test_a_very_stiff_shaft_holds_the_ring(bearing_of):
    """In the start as in the static solution: tilt as prescribed, the moment that a constraint
    would bear."""
    held = Load(radial=1000.0, gravity=0.0, misalignment=5e-4)
    stiff = replace(held, tilt="free", tilt_stiffness=1e9)
    solutions = [
        solve_bearing(ROLLERS, load=held, options=HELD),
        solve_bearing(ROLLERS, load=stiff),
    ]
    assert solutions[0].reaction[4] > 0.1
    np.testing.assert_allclose(solutions[1].reaction, solutions[0].reaction, rtol=1e-5, atol=1e-7)
    moments = []
    for load in (held, stiff):
        bearing = bearing_of(load=load, drive=STILL)
        start = find_start(bearing, limit_force=2e4)
        rows = bearing.layout.u(bearing.residual(0.0, start.y, start.yd))["inner"]
        moments.append(rows[5] + bearing.layout.multipliers(start.y)[2])
        assert bearing.layout.q(start.y)["inner"][4] == pytest.approx(5e-4, rel=1e-6)
    assert moments[1] == pytest.approx(moments[0], rel=1e-5)
    assert moments[1] == pytest.approx(solutions[0].reaction[4], rel=5e-3)


def test_rollers_share_a_moment_with_the_shaft():
    """The moment that holds a tilt, and the spring's for that tilt, together bring it about."""
    tilt, stiffness = 4e-4, 3e3
    held = solve_bearing(ROLLERS, load=Load(radial=2e3, misalignment=tilt), options=HELD)
    shared = held.reaction[4] + stiffness * tilt
    load = Load(radial=2e3, moment_z=shared, tilt_stiffness=stiffness, tilt="free")
    free = solve_bearing(ROLLERS, load=load)
    assert free.displacement[4] == pytest.approx(tilt, rel=1e-7)
    assert free.reaction[4] == pytest.approx(-stiffness * tilt, rel=1e-7)
    assert free.ratings.equivalent_load == held.ratings.equivalent_load == 2e3


def test_balls_share_an_axial_load_with_the_shaft():
    alone = solve_bearing(BALLS, load=Load(axial=200.0, radial=30.0), options=HELD)
    moved = alone.displacement[0]
    load = Load(axial=200.0 + 1e7 * moved, radial=30.0, axial_stiffness=1e7)
    shared = solve_bearing(BALLS, load=load, options=HELD)
    np.testing.assert_allclose(shared.displacement, alone.displacement, rtol=1e-7, atol=1e-15)
    assert shared.reaction[0] == pytest.approx(-1e7 * moved, rel=1e-7)
    assert shared.ratings.equivalent_load == pytest.approx(alone.ratings.equivalent_load)


def test_without_springs_nothing_else_is_in_the_rows(bearing_of):
    """Springs of motions that are held take no part."""
    bearing = bearing_of(load=replace(SOFT, axial=0.0, axial_stiffness=0.0, tilt="held"))
    ring = bearing.data.model.inner_ring
    assert not ring.stiffness.any() and not ring.damping.any()
    assert not ring.free[[0, 4, 5]].any()
