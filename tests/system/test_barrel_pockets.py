"""Barrels in pockets of a cage for both rows: slopes of one energy, balance, Newton's matrix."""

from __future__ import annotations

import numpy as np
import pytest
from barrel_parts import caged, in_pockets, settled
from bearing_runs import march
from scipy.spatial.transform import Rotation
from tapered_parts import DRY, ELASTIC, FRICTIONLESS, LIGHT, energy, pushed
from test_newton_matrix import miss
from test_tapered_pockets import shift, turn

from flexcage.bearings.spherical_roller.start import rolling_barrels
from flexcage.system.data import POCKET_FRICTION, POWERS


@pytest.mark.parametrize("soft", [False, True])
def test_forces_in_pockets_of_barrels_are_slopes_of_one_energy(soft):
    """On cage, turned about each axis, its modes, and on barrels of both rows, pressed against bars
    and ends of pockets."""
    _, bearing = caged(soft=soft, **FRICTIONLESS, **ELASTIC, **DRY, **LIGHT)
    y, layout = in_pockets(bearing, settled(bearing)), bearing.layout
    rows = layout.u(-bearing.residual(0.0, y, np.zeros_like(y)))
    energy(bearing, y)
    normal = bearing.data.work.report.pocket_normal
    touched = normal > 1.0
    assert (touched[:, :2].sum(axis=0) > 6).all() and touched[:16].sum() > 8
    assert touched[:16, 2].sum() > 3 and touched[16:, 3].sum() > 3  # ends at the cage's -x
    bearing.residual(0.0, y, np.zeros_like(y), mode=2)
    moments = bearing.data.work.scratch.wrenches[:, 3].copy()

    def slope(move, h):
        high, low = y.copy(), y.copy()
        move(layout.q(high), h)
        move(layout.q(low), -h)
        return -(energy(bearing, high) - energy(bearing, low)) / (2.0 * h)

    found = [*rows["cage"], *rows["modes"]]
    due = [slope(shift("cage", c), 1e-9) for c in range(3)]
    due += [slope(shift("modes", m), 1e-9) for m in range(layout.modes)]
    np.testing.assert_allclose(found, due, atol=2e-5 * np.abs(due).max())
    due = [slope(turn(a), 1e-7) for a in range(3)]
    np.testing.assert_allclose(rows["omega"], due, atol=1e-4 * np.abs(due).max())
    for i in (0, 1, 6, 11, 16, 17, 24):
        own, r = rows["elements"][i], layout.q(y)["elements"][i, 1]
        around = own[2] + moments[i] / r
        due = [slope(shift("elements", i, c), 1e-9 / a) / a for c, a in enumerate((1, 1, r))]
        due += [slope(shift("elements", i, c), 1e-7) for c in (4,)]
        np.testing.assert_allclose(
            [own[0], own[1], around], due[:3], atol=5e-5 * np.abs(own[:3]).max()
        )
        np.testing.assert_allclose(own[5], due[3], atol=1e-3 * np.abs(own[3:]).max())


def test_both_rows_of_pockets_are_mirror_images():
    """What a row does to the cage along x and in tilt the other one does the other way."""
    _, bearing = caged(modes=0, soft=False, **FRICTIONLESS, **ELASTIC, **DRY, **LIGHT,
                       **{"bearing.staggered": False})  # fmt: skip
    y = np.zeros(bearing.layout.size)
    q, each = bearing.layout.q(y), bearing.spec.roller_count
    y[:] = settled(bearing)
    first, second = q["elements"][:each], q["elements"][each:]
    second[:] = first * (-1.0, 1.0, 1.0, -1.0, -1.0, 1.0)
    q["inner"][:], q["outer"][:], q["quaternion"][0] = 0.0, 0.0, 1.0
    first[:, 2] += 20e-6 / first[0, 1] * np.tile([1.0, -1.0], each // 2) + 2e-3
    second[:, 2] = first[:, 2]
    q["elements"][:, :5] += 0.0
    moved = 0.12e-3 * np.cos(bearing.spec.axis_angle)
    first[:, 0] -= moved
    second[:, 0] += moved
    force, moment = pushed(bearing, y)[-1]
    normal = bearing.data.work.report.pocket_normal
    assert (normal[:each, 2] > 0.1).all()  # outer ends
    np.testing.assert_allclose(normal[:each], normal[each:], atol=1e-9 * normal.max())
    assert abs(force[0]) < 1e-9 * normal.sum()
    assert np.abs(moment[1:]).max() < 1e-9 * normal.sum() * bearing.spec.pitch_radius


def test_all_forces_in_pockets_of_barrels_balance():
    _, bearing = caged(modes=0, soft=False, **{"lubricant.oil_fraction": 0.0}, **LIGHT)
    y, rng = in_pockets(bearing, settled(bearing)), np.random.default_rng(7)
    u = bearing.layout.u(y)
    u["elements"][:] = rng.standard_normal(u["elements"].shape) * (0.1, 0.1, 2.0, 900, 20, 20)
    u["inner"][:] = rng.standard_normal(6) * (0.1, 0.1, 0.1, 300.0, 5.0, 5.0)
    u["omega"][:], u["cage"][:] = (100.0, 2.0, -3.0), (0.1, -0.1, 0.05)
    found = pushed(bearing, y)
    assert bearing.data.work.report.power[POCKET_FRICTION] < -0.1
    forces = np.vstack([np.atleast_2d(f) for f, _ in found])
    moments = np.vstack([np.atleast_2d(m) for _, m in found])
    assert np.abs(forces[-1]).max() > 1.0
    assert np.abs(forces.sum(axis=0)).max() < 1e-12 * np.abs(forces).sum()
    assert np.abs(moments.sum(axis=0)).max() < 1e-12 * np.abs(moments).sum()


@pytest.mark.parametrize("soft, limit", [(False, 0.4), (True, 0.8)])
def test_newton_matrix_in_pockets_of_barrels(soft, limit):
    """At a run's steps, with friction and damping, as of tapered rollers."""
    _, bearing = caged(soft=soft)
    y, rng = in_pockets(bearing, settled(bearing)), np.random.default_rng(5)
    yd = rolling_barrels(bearing, y, Rotation.identity())
    u = bearing.layout.u(y)
    u["elements"][:] += rng.standard_normal(u["elements"].shape) * (0.005, 0.005, 0.05, 20, 1, 1)
    u["cage"][:] = 0.02 * rng.standard_normal(3)
    u["omega"][:] += np.array([1.0, 0.3, 0.3]) * rng.standard_normal(3)
    u["modes"][:] = 1e-3 * rng.standard_normal(bearing.layout.modes)
    power = np.zeros(len(POWERS))
    bearing.function("residual")(0.0, y, yd, bearing.args, np.zeros(len(y)), power)
    bearing.function("note")(0.0, y, bearing.args)
    bearing.residual(0.0, y, yd, mode=2)
    assert (bearing.data.work.report.pocket_normal > 1.0).sum() > 16
    assert max(miss(bearing, y, yd, rng, 3e5) for _ in range(5)) < limit


@pytest.mark.slow
def test_both_integrators_move_barrels_in_pockets_alike():
    """A flexible cage with yielding walls, whose bars the barrels strike."""
    states = []
    for method in ("explicit", "bdf"):
        _, bearing = caged(**LIGHT)
        y, layout = in_pockets(bearing, settled(bearing), depth=0.0), bearing.layout
        yd = rolling_barrels(bearing, y, Rotation.identity())
        h = march(bearing, y, yd, duration=0.15e-3, method=method, tolerance=1e-9)
        assert h.outcome == 0 and h.samples.pocket_normal.max() > 1.0
        states.append(layout.q(h.y))
    explicit, implicit = states
    np.testing.assert_allclose(explicit["cage"][-1], implicit["cage"][-1], atol=2e-8)
    one, other = (s["elements"][-1, :, :2] for s in states)
    np.testing.assert_allclose(one, other, atol=6e-8)
