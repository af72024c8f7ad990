"""Balls that touch the next one: energy, momentum, third law, tangent, and a blow."""

from __future__ import annotations

import numpy as np
import pytest
from ball_parts import PITCH, ball_bearing, contacts_of
from bearing_runs import march, wrenches

from flexcage.system.data import IN_CONTACTS, NEIGHBOUR_DAMPING, NEIGHBOUR_FRICTION

NEXT_BALL = 3  # place of the contact: behind races and the pocket
PAIRS = ((3, 4), (17, 0))  # the last ball's next one is the first


def slots(interface):
    interface.slot[:, 1] = 2.5e-3  # pockets so long that they keep no balls apart


def together(depth=4e-6, **specs):
    """A bearing at rest whose balls are clear of races and pockets, but for two pairs that are
    pressed together by ``depth`` [m]; and its y."""
    bearing = ball_bearing(change=slots, modes=0, **specs)
    y = np.zeros(bearing.layout.size)
    q, Z, radius = bearing.layout.q(y), bearing.layout.elements, bearing.data.model.bodies.radius
    q["quaternion"][0], q["inner"][0] = 1.0, -0.1e-3
    model = bearing.data.model
    q["elements"][:, 0] = model.outer.axial - 10e-6
    q["elements"][:, 1] = model.outer.centre + (model.outer.radius - radius[0]) - 5e-6
    q["elements"][:, 2] = 2.0 * np.pi * np.arange(Z) / Z
    for i, j in PAIRS:
        q["elements"][i, 0] += 30e-6
        q["elements"][i, 1] -= 5e-6
        x, r, _ = (q["elements"][i] - q["elements"][j])[:3]
        r1, r2 = q["elements"][i, 1], q["elements"][j, 1]
        reach = radius[i] + radius[j] - depth
        ahead = np.arccos((r1**2 + r2**2 + x**2 - reach**2) / (2.0 * r1 * r2))
        nearer = 2.0 * np.pi / Z - ahead
        q["elements"][i, 2] += 0.5 * nearer
        q["elements"][j, 2] -= 0.5 * nearer
    return bearing, y


def report_of(bearing, y):
    bearing.residual(0.0, y, np.zeros_like(y), mode=2)
    return bearing.data.work.report


def test_forces_are_the_slopes_of_the_energy_and_only_of_those_that_touch():
    bearing, y = together()
    layout = bearing.layout
    force = layout.u(-bearing.residual(0.0, y, np.zeros_like(y)))["elements"]
    report = report_of(bearing, y)
    touching = np.flatnonzero(report.contact[:, NEXT_BALL])
    assert list(touching) == [3, 17] and not report.contact[:, :NEXT_BALL].any()
    assert (report.rib[touching, 0] > 50.0).all()

    def energy(i, c, h):
        moved = y.copy()
        layout.q(moved)["elements"][i, c] += h
        return report_of(bearing, moved).energy[IN_CONTACTS]

    for i in np.ravel(PAIRS):
        steps = (1e-9, 1e-9, 1e-9 / PITCH)
        slope = [-(energy(i, c, h) - energy(i, c, -h)) / (2.0 * h) for c, h in enumerate(steps)]
        slope[2] /= layout.q(y)["elements"][i, 1]
        np.testing.assert_allclose(force[i, :3], slope, atol=2e-6 * np.abs(force).max())
    assert not force[[1, 8]].any()


def moving(bearing, y, seed=2):
    u = bearing.layout.u(y)["elements"]
    u[:] = np.random.default_rng(seed).standard_normal(u.shape) * (0.3, 0.3, 0.3, 90, 90, 90)
    return u


def test_momentum_and_its_moment_are_kept_with_friction_and_damping():
    bearing, y = together(contacts=contacts_of("restitution", "step_coulomb"))
    moving(bearing, y)
    force, moment = wrenches(bearing, y)
    report = bearing.data.work.report
    assert np.abs(force).max() > 50.0 and report.power[NEIGHBOUR_FRICTION] < -1e-3
    for i, j in PAIRS:
        np.testing.assert_allclose(force[i], -force[j], atol=1e-12 * np.abs(force).max())
        np.testing.assert_allclose(moment[i], -moment[j], atol=1e-12 * np.abs(moment).max())


def test_power_is_what_the_channels_say():
    bearing, y = together(contacts=contacts_of("restitution", "step_coulomb"))
    u, layout = moving(bearing, y), bearing.layout
    bearing.residual(0.0, y, np.zeros_like(y), mode=2)
    power = float(np.sum(bearing.data.work.scratch.wrenches * u))
    losses = bearing.data.work.report.power[[NEIGHBOUR_DAMPING, NEIGHBOUR_FRICTION]].sum()

    def energy(t):
        moved = y.copy()
        q = layout.q(moved)["elements"]
        q[:, :2] += t * u[:, :2]
        q[:, 2] += t * u[:, 2] / layout.q(y)["elements"][:, 1]
        return report_of(bearing, moved).energy[IN_CONTACTS]

    h = 1e-9
    stored = (energy(h) - energy(-h)) / (2.0 * h)
    assert abs(stored) > 0.1 and losses < 0.0
    assert power == pytest.approx(losses - stored, rel=1e-5)


def in_space(bearing, y):
    """Places and velocities (Z, 3) of all balls in space."""
    q, u = bearing.layout.q(y)["elements"], bearing.layout.u(y)["elements"]
    c, s = np.cos(q[:, 2]), np.sin(q[:, 2])
    place = np.stack([q[:, 0], q[:, 1] * c, q[:, 1] * s], axis=1)
    speed = [u[:, 0], c * u[:, 1] - s * u[:, 2], s * u[:, 1] + c * u[:, 2]]
    return place, np.stack(speed, axis=1)


@pytest.mark.parametrize("method", ["explicit", "bdf"])
def test_both_methods_pass_a_blow(method):
    """Ball 3 runs into ball 4, which stands; they part with momentum and restitution."""
    bearing, y = together(depth=-8e-6, contacts=contacts_of("restitution"))
    i, j = PAIRS[0]
    bearing.layout.u(y)["elements"][i, 2] = 0.2
    yd = np.zeros_like(y)
    bearing.layout.q(yd)["elements"][i, 2] = 0.2 / bearing.layout.q(y)["elements"][i, 1]
    history = march(bearing, y, yd, duration=0.2e-3, method=method, tolerance=1e-9)
    given = contacts_of("restitution").race.normal.restitution
    (before, first), (after, last) = (in_space(bearing, state) for state in (y, history.y[-1]))
    np.testing.assert_allclose(last.sum(axis=0), first.sum(axis=0), atol=1e-4)
    line = before[j] - before[i]
    line /= np.linalg.norm(line)
    near, part = ((v[i] - v[j]) @ line for v in (first, last))
    assert near > 0.19 and part == pytest.approx(-given * near, rel=0.03)
    assert np.abs(np.delete(last, [i, j], axis=0)).max() < 1e-6


def test_tangent_holds_each_ball_s_own_slopes():
    """Against differences of the ball's own forces over its own motion, within a few per cent: it
    leaves out how friction follows the load, and how the line of centres turns."""
    bearing, y = together(contacts=contacts_of("restitution", "traction"))
    moving(bearing, y)
    layout = bearing.layout
    bearing.function("linearise")(0.0, y, np.zeros_like(y), bearing.args)
    tangent = bearing.data.work.tangent
    for i in np.ravel(PAIRS):
        r = layout.q(y)["elements"][i, 1]

        def rows(name, c, h, i=i):
            moved = y.copy()
            getattr(layout, name)(moved)["elements"][i, c] += h
            return layout.u(bearing.residual(0.0, moved, np.zeros_like(y)))["elements"][i]

        K = np.stack([(rows("q", c, h) - rows("q", c, -h)) / (2e-9)
                      for c, h in enumerate((1e-9, 1e-9, 1e-9 / r))], axis=1)  # fmt: skip
        C = np.stack([(rows("u", c, h) - rows("u", c, -h)) / (2.0 * h)
                      for c, h in enumerate([1e-6] * 3 + [1e-3] * 3)], axis=1)  # fmt: skip
        np.testing.assert_allclose(tangent.Krr[i][:3, :3], K[:3], atol=0.05 * np.abs(K).max())
        lever = np.array([1, 1, 1, 4e-3, 4e-3, 4e-3])
        scale = np.outer(lever, lever)
        np.testing.assert_allclose(
            tangent.Crr[i] / scale, C / scale, atol=0.05 * np.abs(C / scale).max()
        )
