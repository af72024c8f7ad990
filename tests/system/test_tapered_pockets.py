"""Tapered rollers in pockets of a conical cage: slopes of one energy, balance, Newton's matrix."""

from __future__ import annotations

import numpy as np
import pytest
from bearing_runs import march
from scipy.spatial.transform import Rotation
from tapered_parts import (
    DRY,
    ELASTIC,
    FRICTIONLESS,
    LIGHT,
    caged,
    energy,
    in_pockets,
    pressed,
    pushed,
)
from test_newton_matrix import miss

from flexcage.bearings.tapered_roller.start import rolling_cones
from flexcage.system.data import POCKET_FRICTION, POWERS


def turn(axis):
    def move(q, h):
        now = Rotation.from_quat(q["quaternion"], scalar_first=True)
        step = Rotation.from_rotvec(h * np.eye(3)[axis])
        q["quaternion"][:] = (now * step).as_quat(scalar_first=True)

    return move


def shift(name, *index):
    def move(q, h):
        q[name][index] += h

    return move


@pytest.mark.parametrize("soft", [False, True])
def test_forces_in_conical_pockets_are_slopes_of_one_energy(soft):
    """On cage, turned about each axis, its modes, and on rollers, pressed against bars that lean
    and taper and against ends across their axes."""
    _, bearing = caged(soft=soft, **FRICTIONLESS, **ELASTIC, **DRY, **LIGHT)
    y, layout = in_pockets(bearing, pressed(bearing)), bearing.layout
    rows = layout.u(-bearing.residual(0.0, y, np.zeros_like(y)))
    energy(bearing, y)
    normal = bearing.data.work.report.pocket_normal
    assert ((normal > 1.0).sum(axis=0)[[0, 1, 3]] > 3).all()
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
    for i in (0, 1, 6, 11):
        own, r = rows["elements"][i], layout.q(y)["elements"][i, 1]
        around = own[2] + moments[i] / r
        due = [slope(shift("elements", i, c), 1e-9 / a) / a for c, a in enumerate((1, 1, r))]
        due += [slope(shift("elements", i, c), 1e-7) for c in (4,)]
        np.testing.assert_allclose(
            [own[0], own[1], around], due[:3], atol=5e-5 * np.abs(own[:3]).max()
        )
        np.testing.assert_allclose(own[5], due[3], atol=1e-3 * np.abs(own[3:]).max())


def test_all_forces_in_conical_pockets_balance():
    _, bearing = caged(modes=0, soft=False, **{"lubricant.oil_fraction": 0.0}, **LIGHT)
    y, rng = in_pockets(bearing, pressed(bearing)), np.random.default_rng(7)
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


NO_RIB_FRICTION = {"contacts.rib.friction.law": "none"}


@pytest.mark.parametrize(
    "changes, soft, limit",
    [
        (NO_RIB_FRICTION, False, 0.05),
        (NO_RIB_FRICTION, True, 0.05),
        ({}, False, 1.5),
        ({}, True, 1.0),
    ],
)
def test_newton_matrix_in_conical_pockets(changes, soft, limit):
    """At a run's steps, with friction and damping. The rib presses ends with 3 to 6 kN here, whose
    friction lever and force turn rollers that nothing holds: it is the worst for Newton's steps,
    which missed by 12 to 90 without the slopes of ``test_tapered_rib`` and without how axes that
    lean keep their direction while rollers orbit."""
    _, bearing = caged(soft=soft, **changes)
    y, rng = in_pockets(bearing, pressed(bearing)), np.random.default_rng(5)
    yd = rolling_cones(bearing.data.model, bearing.layout, bearing.spec, y)
    u = bearing.layout.u(y)
    u["elements"][:] += rng.standard_normal(u["elements"].shape) * (0.005, 0.005, 0.05, 20, 1, 1)
    u["cage"][:] = 0.02 * rng.standard_normal(3)
    u["omega"][:] += np.array([1.0, 0.3, 0.3]) * rng.standard_normal(3)
    u["modes"][:] = 1e-3 * rng.standard_normal(bearing.layout.modes)
    power = np.zeros(len(POWERS))
    bearing.function("residual")(0.0, y, yd, bearing.args, np.zeros(len(y)), power)
    bearing.function("note")(0.0, y, bearing.args)
    bearing.residual(0.0, y, yd, mode=2)
    assert (bearing.data.work.report.pocket_normal > 1.0).sum() > 10
    assert max(miss(bearing, y, yd, rng, 3e5) for _ in range(5)) < limit


@pytest.mark.slow
def test_both_integrators_move_tapered_rollers_in_pockets_alike():
    """A flexible cage with yielding walls, whose bars the rollers strike."""
    states = []
    for method in ("explicit", "bdf"):
        _, bearing = caged(**LIGHT)
        y = in_pockets(bearing, pressed(bearing), depth=0.0)
        layout = bearing.layout
        yd = rolling_cones(bearing.data.model, layout, bearing.spec, y)
        h = march(bearing, y, yd, duration=0.2e-3, method=method, tolerance=1e-9)
        assert h.outcome == 0 and h.samples.pocket_normal.max() > 1.0
        states.append(layout.q(h.y))
    explicit, implicit = states
    np.testing.assert_allclose(explicit["cage"][-1], implicit["cage"][-1], atol=2e-8)
    one, other = (s["elements"][-1, :, :2] for s in states)
    np.testing.assert_allclose(one, other, atol=6e-8)
