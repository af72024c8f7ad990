"""Bearings without a cage: rollers against the next ones, and bodies without one."""

from __future__ import annotations

import numpy as np
import pytest
from ball_parts import ball_bearing, contacts_of
from bearing_runs import march, wrenches

from flexcage.bearings.cylindrical_roller.motion import MOTION
from flexcage.case import load_case
from flexcage.contacts.spec import NormalLaw
from flexcage.stages import bearing_in_motion, bearing_to_compile
from flexcage.system.data import IN_CONTACTS, NEIGHBOUR_DAMPING, NEIGHBOUR_FRICTION

NEXT_ROLLER = 2  # place of the contact: behind the races
PAIRS = ((3, 4), (31, 0))  # the last roller's next one is the first


def rollers(normal="elastic", friction="none", profile="logarithmic"):
    """32 rollers of an N1013 without a cage, where 22 have one; no load, no gravity, no oil."""
    case = load_case(
        {
            "bearing": {
                "preset": "N1013", "roller_count": 32, "profile": {"kind": profile},
            },
            "cage": {"model": "none"},
            "drive": {"speed": "0 rpm"},
            "load": {"gravity": "0 m/s^2"},
            "lubricant": {"rolling_resistance": "none", "oil_fraction": 0.0},
            "contacts": {"race": {"normal": {"law": normal}, "friction": {"law": friction}}},
        }
    )  # fmt: skip
    return bearing_in_motion(case, None, None)


def together(bearing, depth=4e-6, turned=2e-4):
    """y at rest: rollers clear of races and ribs, two pairs pressed together by ``depth`` [m] in
    their middles, their axes turned by up to ``turned`` [rad]."""
    layout, model = bearing.layout, bearing.data.model
    y = np.zeros(layout.size)
    q, Z, radius = layout.q(y)["elements"], layout.elements, model.bodies.radius
    q[:, 1] = model.outer.radius - radius - 5e-6
    q[:, 2] = 2.0 * np.pi * np.arange(Z) / Z
    rng = np.random.default_rng(5)
    for i, j in PAIRS:
        q[[i, j], 0] = 4e-6, -5e-6
        q[i, 1] -= 1e-6
        q[[i, j], 3:5] = turned * rng.uniform(-1.0, 1.0, (2, 2))
        r1, r2 = q[i, 1], q[j, 1]
        reach = radius[i] + radius[j] - depth
        nearer = 2.0 * np.pi / Z - np.arccos((r1**2 + r2**2 - reach**2) / (2.0 * r1 * r2))
        q[i, 2] += 0.5 * nearer
        q[j, 2] -= 0.5 * nearer
    return y


def report_of(bearing, y):
    bearing.residual(0.0, y, np.zeros_like(y), mode=2)
    return bearing.data.work.report


def moving(bearing, y, seed=2):
    u = bearing.layout.u(y)["elements"]
    u[:] = np.random.default_rng(seed).standard_normal(u.shape) * (0.3, 0.3, 0.3, 90, 1, 1)
    return u


def test_straight_rollers_yield_as_palmgren_has_it():
    """d = 3.84e-5 Q^0.9/L^0.8, in mm and N, of steel in line contact (T. Harris, Rolling Bearing
    Analysis); the standard's constants, which races have too, differ by 4 %."""
    bearing = rollers(profile="straight")
    y = together(bearing, depth=4e-6, turned=0.0)
    force = report_of(bearing, y).pocket_normal[3, 0]
    length = 7.3
    due = (4e-3 / 3.84e-5 * length**0.8) ** (1.0 / 0.9)
    assert force == pytest.approx(due, rel=0.06)


def test_forces_are_the_slopes_of_the_energy_and_only_of_those_that_touch():
    bearing = rollers()
    y, layout = together(bearing), bearing.layout
    force = layout.u(-bearing.residual(0.0, y, np.zeros_like(y)))["elements"]
    report = report_of(bearing, y)
    touching = np.flatnonzero(report.contact[:, NEXT_ROLLER])
    assert list(touching) == [3, 31] and not report.contact[:, :NEXT_ROLLER].any()
    assert (report.pocket_normal[touching, 0] > 50.0).all() and not report.rib.any()

    def energy(i, c, h):
        moved = y.copy()
        layout.q(moved)["elements"][i, c] += h
        return report_of(bearing, moved).energy[IN_CONTACTS]

    most, arm = np.abs(force).max(), 4e-3
    for i in np.ravel(PAIRS):
        r = layout.q(y)["elements"][i, 1]
        for c, h, row, lever in ((0, 1e-9, 0, 1.0), (1, 1e-9, 1, 1.0), (2, 1e-9 / r, 2, r),
                                 (3, 1e-7, 4, arm), (4, 1e-7, 5, arm)):  # fmt: skip
            slope = -(energy(i, c, h) - energy(i, c, -h)) / (2.0 * h) / lever
            own = force[i, row] / (arm if c > 2 else 1.0)
            # a thousandth: axes that are turned, and rollers a little askew along the axis
            np.testing.assert_allclose(own, slope, atol=1e-3 * most)
    assert not force[[1, 8]].any()


def test_momentum_and_its_moment_are_kept_with_friction_and_damping():
    bearing = rollers("restitution", "step_coulomb")
    y = together(bearing)
    moving(bearing, y)
    force, moment = wrenches(bearing, y)
    assert np.abs(force).max() > 50.0
    assert bearing.data.work.report.power[NEIGHBOUR_FRICTION] < -1e-3
    for i, j in PAIRS:
        np.testing.assert_allclose(force[i], -force[j], atol=1e-12 * np.abs(force).max())
        np.testing.assert_allclose(moment[i], -moment[j], atol=1e-12 * np.abs(moment).max())


def test_power_is_what_the_channels_say():
    bearing = rollers("restitution", "step_coulomb")
    y = together(bearing, turned=0.0)
    u, layout = moving(bearing, y), bearing.layout
    u[:, 4:] = 0.0
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


@pytest.mark.parametrize("method", ["explicit", "bdf"])
def test_both_methods_pass_a_blow(method):
    """Roller 3 runs into roller 4, which stands; they part with momentum and restitution."""
    bearing = rollers("restitution")
    y = together(bearing, depth=-8e-6, turned=0.0)
    layout, (i, j) = bearing.layout, PAIRS[0]
    layout.u(y)["elements"][i, 2] = 0.2
    yd = np.zeros_like(y)
    layout.q(yd)["elements"][i, 2] = 0.2 / layout.q(y)["elements"][i, 1]
    history = march(bearing, y, yd, duration=0.2e-3, method=method, tolerance=1e-9)
    first, last = (layout.u(state)["elements"] for state in (y, history.y[-1]))
    psi = layout.q(history.y[-1])["elements"][[i, j], 2]
    ahead = psi[1] - psi[0]
    given = NormalLaw(law="restitution").restitution
    # along the line between both: the chord, half of the angle off each one's own direction
    near = (first[i, 2] - first[j, 2]) * np.cos(0.5 * ahead)
    part = sum(
        sign * (last[k, 2] * np.cos(0.5 * ahead) + side * last[k, 1] * np.sin(0.5 * ahead))
        for k, sign, side in ((i, 1.0, 1.0), (j, -1.0, -1.0))
    )
    assert near > 0.19 and part == pytest.approx(-given * near, rel=0.05)
    assert last[j, 2] == pytest.approx(0.5 * (1.0 + given) * 0.2, rel=0.05)
    assert np.abs(np.delete(last, [i, j], axis=0)[:, :3]).max() < 1e-6


def test_kernels_of_a_bearing_take_one_with_a_cage_and_one_without():
    """The residual is compiled once for both: a bearing is a list of bodies."""
    text = {"bearing": {"preset": "N1013"}}
    caged = bearing_to_compile(load_case(text))
    without = bearing_to_compile(load_case({**text, "cage": {"model": "none"}}))
    assert caged.data_type == without.data_type
    assert caged.evaluate is without.evaluate
    at = without.layout.places
    assert (at.cages, at.cage_q, at.cage_b) == (0, at.u, at.border)
    assert without.layout.n_u == caged.layout.n_u - 6
    assert MOTION.without_cage.faces == ("next roller",)


def test_balls_move_as_in_pockets_that_never_touch_them():
    """A cage that stands in nobody's way, left out: the same motion but for steps' errors, which
    are measured over all bodies."""

    def wide(interface):
        interface.slot[:] = 2.5e-3
        interface.radius[:] = 6e-3

    contacts = contacts_of("restitution", "traction")
    caged = ball_bearing(change=wide, modes=0, contacts=contacts, speed=200.0)
    case = load_case(
        {
            "bearing": {"preset": "7010C-PI"},
            "cage": {"model": "none"},
            "drive": {"speed": "200 rad/s"},
            "lubricant": {"rolling_resistance": "none", "oil_fraction": 0.0},
            "load": {"gravity": "0 m/s^2"},
        }
    ).replace("contacts", contacts)
    free = bearing_in_motion(case, None, None)
    states = []
    for bearing in (caged, free):
        layout, model = bearing.layout, bearing.data.model
        y, yd = np.zeros(layout.size), np.zeros(layout.size)
        q, u = layout.q(y), layout.u(y)
        q["inner"][0] = 40e-6
        q["elements"][:, 0] = model.outer.axial + 20e-6
        q["elements"][:, 1] = model.outer.centre + model.outer.radius - model.bodies.radius
        q["elements"][:, 2] = 2.0 * np.pi * np.arange(layout.elements) / layout.elements
        u["elements"][:, 2] = 80.0 * q["elements"][:, 1]
        u["inner"][3] = 200.0
        if "quaternion" in q:
            q["quaternion"][0], u["omega"][0] = 1.0, 80.0
        bearing.function("rates")(0.0, y, yd, bearing.args, np.zeros(0))
        history = march(bearing, y, yd, duration=0.3e-3, method="explicit", tolerance=1e-8)
        states.append(layout.q(history.y[-1])["elements"].copy())
    np.testing.assert_allclose(*states, rtol=0.0, atol=1e-11)
