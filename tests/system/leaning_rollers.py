"""What holds of all rollers whose axes lean, tapered ones and barrels: slopes, balances, powers."""

from __future__ import annotations

from math import cos, sin

import numpy as np
import pytest
from bearing_runs import march
from scipy.spatial.transform import Rotation
from tapered_parts import begun, energy, frames, pushed
from test_newton_matrix import miss

from flexcage.system.data import DRAG, POWERS


def slope_of(bearing, y, move, h):
    """Slope of the energy at y, over minus what ``move(q, h)`` does to coordinates q."""
    sides = []
    for step in (h, -h):
        moved = y.copy()
        move(bearing.layout.q(moved), step)
        sides.append(energy(bearing, moved))
    return (sides[1] - sides[0]) / (2.0 * h)


def shift(name, *index):
    def move(q, h):
        q[name][index] += h

    return move


def turn(axis):
    """The cage about one of its own axes."""

    def move(q, h):
        now = Rotation.from_quat(q["quaternion"], scalar_first=True)
        step = Rotation.from_rotvec(h * np.eye(3)[axis])
        q["quaternion"][:] = (now * step).as_quat(scalar_first=True)

    return move


def check_slopes(bearing, y, rollers, *, arm, of_moments):
    """Forces on x, r, azimuth, skew and tilt of ``rollers`` and on both rings, tilts too, at rest.
    ``of_moments(force, moment)``: what moments on a ring are compared with."""
    layout = bearing.layout
    _, (inner, _), (outer, _) = pushed(bearing, y)
    work, q = bearing.data.work.scratch, layout.q(y)["elements"]
    forces, moments = work.wrenches[:, :3].copy(), work.wrenches[:, 3:].copy()
    border = {name: v.copy() for name, v in layout.border(work.border).items()}
    _, axes = frames(q)
    for i in rollers:
        r = q[i, 1]
        own = [
            *forces[i, :2], (r * forces[i, 2] + moments[i, 0]) / r, moments[i, 1] / arm,
            axes[i, 2] @ moments[i] / arm,
        ]  # fmt: skip
        levers = (1.0, 1.0, r, arm, arm)
        due = [
            slope_of(bearing, y, shift("elements", i, c), 1e-9 / a) / a
            for c, a in enumerate(levers)
        ]
        assert own == pytest.approx(due, abs=3e-5 * np.abs(forces).max()), i
    for name, force in (("inner", inner), ("outer", outer)):
        due = [slope_of(bearing, y, shift(name, c), 1e-9) for c in range(3)]
        assert force == pytest.approx(due, abs=3e-5 * np.abs(force).max())
        (skew, tilt), m = layout.q(y)[name][3:5], border[name][3:]
        due = [slope_of(bearing, y, shift(name, c), 1e-7) for c in (3, 4)]
        assert [m[1], m[0] * sin(skew) + m[2] * cos(skew)] == pytest.approx(
            due, abs=3e-5 * of_moments(np.abs(force).max(), np.abs(m).max())
        )
        assert abs(tilt) > 0.0


def check_slopes_in_pockets(bearing, y, rollers):
    """Forces on the cage, turned about each axis, on its modes, and on ``rollers``, at rest."""
    layout = bearing.layout
    rows = layout.u(-bearing.residual(0.0, y, np.zeros_like(y)))
    bearing.residual(0.0, y, np.zeros_like(y), mode=2)
    moments = bearing.data.work.scratch.wrenches[:, 3].copy()
    found = [*rows["cage"], *rows["modes"]]
    due = [slope_of(bearing, y, shift("cage", c), 1e-9) for c in range(3)]
    due += [slope_of(bearing, y, shift("modes", m), 1e-9) for m in range(layout.modes)]
    np.testing.assert_allclose(found, due, atol=2e-5 * np.abs(due).max())
    due = [slope_of(bearing, y, turn(a), 1e-7) for a in range(3)]
    np.testing.assert_allclose(rows["omega"], due, atol=1e-4 * np.abs(due).max())
    for i in rollers:
        own, r = rows["elements"][i], layout.q(y)["elements"][i, 1]
        around = own[2] + moments[i] / r
        due = [
            slope_of(bearing, y, shift("elements", i, c), 1e-9 / a) / a
            for c, a in enumerate((1, 1, r))
        ]
        tilted = slope_of(bearing, y, shift("elements", i, 4), 1e-7)
        np.testing.assert_allclose([own[0], own[1], around], due, atol=5e-5 * np.abs(own[:3]).max())
        np.testing.assert_allclose(own[5], tilted, atol=1e-3 * np.abs(own[3:]).max())


def stir(bearing, y):
    """Velocities of rollers, of the inner ring and of a cage in y, all of them."""
    u, rng = bearing.layout.u(y), np.random.default_rng(7)
    u["elements"][:] = rng.standard_normal(u["elements"].shape) * (0.1, 0.1, 2.0, 900, 20, 20)
    u["inner"][:] = rng.standard_normal(6) * (0.1, 0.1, 0.1, 300.0, 5.0, 5.0)
    if bearing.layout.has_cage:
        u["omega"][:], u["cage"][:] = (100.0, 2.0, -3.0), (0.1, -0.1, 0.05)


def check_balance(found):
    """Of all forces and moments that ``pushed`` found."""
    forces = np.vstack([np.atleast_2d(f) for f, _ in found])
    moments = np.vstack([np.atleast_2d(m) for _, m in found])
    assert np.abs(forces.sum(axis=0)).max() < 1e-12 * np.abs(forces).sum()
    assert np.abs(moments.sum(axis=0)).max() < 1e-12 * np.abs(moments).sum()


def check_power(bearing, y):
    """What forces do on all velocities is what contacts lose and take from their energy."""
    layout = bearing.layout
    rng, h = np.random.default_rng(3), 1e-9
    u, q = layout.u(y), layout.q(y)["elements"]
    u["elements"][:, :3] = rng.standard_normal((layout.elements, 3)) * (0.1, 0.1, 2.0)
    orbit = u["elements"][:, 2] / q[:, 1]
    skew, tilt = q[:, 3], q[:, 4]
    u["elements"][:, 3] = 900.0 * rng.standard_normal(layout.elements)
    u["elements"][:, 4] = -orbit * np.cos(skew) * np.sin(tilt)  # skew and tilt stay
    u["elements"][:, 5] = orbit * np.sin(skew)
    u["inner"][:4] = 0.05, -0.1, 0.1, 300.0
    spin = layout.q(y)["inner"][3:5]
    pushed(bearing, y)
    report, work = bearing.data.work.report, bearing.data.work.scratch
    w = np.einsum("zij,zi->zj", frames(q)[1], u["elements"][:, 3:])
    power = float((work.wrenches[:, :3] * u["elements"][:, :3]).sum())
    power += float((work.wrenches[:, 3:] * w).sum())
    inner = layout.border(work.border)["inner"]
    axis = [cos(spin[0]) * cos(spin[1]), sin(spin[1]), -sin(spin[0]) * cos(spin[1])]
    power += float(inner[:3] @ u["inner"][:3] + 300.0 * inner[3:] @ axis)
    lost = float(report.power[3:].sum() - report.power[DRAG])

    def stored(t):
        moved = y.copy()
        at = layout.q(moved)
        at["elements"][:, :2] += t * u["elements"][:, :2]
        at["elements"][:, 2] += t * orbit
        at["inner"][:3] += t * u["inner"][:3]
        return energy(bearing, moved)

    gained = (stored(h) - stored(-h)) / (2.0 * h)
    assert abs(gained) > 1.0 and lost < -10.0
    assert power == pytest.approx(lost - gained, rel=2e-3)


def evaluated(bearing, y, yd):
    """y' into yd, and the onset memory set, as at a run's step."""
    power = np.zeros(len(POWERS))
    bearing.function("residual")(0.0, y, yd, bearing.args, np.zeros(len(y)), power)
    bearing.function("note")(0.0, y, bearing.args)


def worst_miss(bearing, y, yd, rng):
    """Of Newton's steps at the steps of a run (``test_newton_matrix.miss``)."""
    return max(miss(bearing, y, yd, rng, 3e5) for _ in range(5))


def miss_of_rollers(case, bearing):
    """``worst_miss`` near a run's start, without a cage."""
    y, yd = begun(case, bearing)
    rng = np.random.default_rng(2)
    u = bearing.layout.u(y)["elements"]
    u += rng.standard_normal(u.shape) * (0.005, 0.005, 0.05, 20.0, 1.0, 1.0)
    evaluated(bearing, y, yd)
    return worst_miss(bearing, y, yd, rng)


def miss_in_pockets(bearing, y, yd, *, touched):
    """``worst_miss`` of a cage more of whose pockets' faces than so many are ``touched``."""
    rng, u = np.random.default_rng(5), bearing.layout.u(y)
    u["elements"][:] += rng.standard_normal(u["elements"].shape) * (0.005, 0.005, 0.05, 20, 1, 1)
    u["cage"][:] = 0.02 * rng.standard_normal(3)
    u["omega"][:] += np.array([1.0, 0.3, 0.3]) * rng.standard_normal(3)
    u["modes"][:] = 1e-3 * rng.standard_normal(bearing.layout.modes)
    evaluated(bearing, y, yd)
    bearing.residual(0.0, y, yd, mode=2)
    assert (bearing.data.work.report.pocket_normal > 1.0).sum() > touched
    return worst_miss(bearing, y, yd, rng)


def check_energy(case, bearing):
    """What is stored changes by what powers brought; the run, and the last orbits [rad/s]."""
    h = march(bearing, *begun(case, bearing), duration=2e-3, method="explicit", tolerance=1e-8)
    assert h.outcome == 0
    stored = h.samples.energy.sum(axis=1)
    missing = (stored - stored[0]) - (h.work - h.work[0]).sum(axis=1)
    assert np.abs(missing).max() < 1e-3 * abs(h.power("drive")[-1])
    q = bearing.layout.q(h.y)["elements"][-1]
    return h, bearing.layout.u(h.y)["elements"][-1, :, 2] / q[:, 1]


def check_integrators(make, duration):
    """Both move rollers of the case and bearing that are made alike."""
    states = []
    for method in ("explicit", "bdf"):
        case, bearing = make()
        h = march(bearing, *begun(case, bearing), duration=duration, method=method, tolerance=1e-9)
        assert h.outcome == 0
        states.append(bearing.layout.q(h.y)["elements"][-1, :, :5])
    explicit, implicit = states
    np.testing.assert_allclose(explicit[:, :2], implicit[:, :2], atol=2e-8)
    np.testing.assert_allclose(explicit[:, 2:], implicit[:, 2:], atol=3e-6)


def check_integrators_in_pockets(make, duration):
    """Both move a cage and rollers alike, of the bearing, y and y' that are made."""
    states = []
    for method in ("explicit", "bdf"):
        bearing, y, yd = make()
        h = march(bearing, y, yd, duration=duration, method=method, tolerance=1e-9)
        assert h.outcome == 0 and h.samples.pocket_normal.max() > 1.0
        states.append(bearing.layout.q(h.y))
    explicit, implicit = states
    np.testing.assert_allclose(explicit["cage"][-1], implicit["cage"][-1], atol=2e-8)
    one, other = (s["elements"][-1, :, :2] for s in states)
    np.testing.assert_allclose(one, other, atol=6e-8)
