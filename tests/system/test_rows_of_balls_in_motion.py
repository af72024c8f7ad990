"""Two rows of balls in motion: their static solution row by row, one energy, balance, symmetry, a
row that is a bearing of its own, and Newton's matrix."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from moving_rows import (
    B1205,
    B3205,
    DRY,
    FACE_TO_FACE,
    SMOOTH,
    UM,
    energy_misses,
    in_space,
    moving,
    reported,
)

import flexcage
from flexcage.case.static import StaticCase
from flexcage.contacts.spec import Contacts
from flexcage.spec import Drive, Load
from flexcage.system.data import POWERS
from flexcage.system.layout import Layout

SIDES = [B3205, FACE_TO_FACE, B1205]
NAMES = ["back to back", "face to face", "self-aligning"]
LOADED = {"radial": 1500.0, "axial": 300.0}


def static(bearing, **load):
    case = StaticCase(bearing=bearing, load=Load(gravity=0.0, **load), drive=Drive(speed=0.0))
    return flexcage.solve_static(case)


@pytest.mark.parametrize("bearing", SIDES, ids=NAMES)
def test_at_rest_it_has_the_forces_of_the_static_solution(bearing):
    """Row by row; and no ball, nor the ring, is out of balance. Statics move grooves in the plane
    of a ball's section, which leaves out u^2/(2 R) across it: 6 nm, of depths of some 10 um."""
    due = static(bearing, **LOADED)
    _, system, start = moving(bearing, **LOADED)
    rows = system.residual(0.0, start.y, start.yd)
    report = reported(system, start.y)
    most = due.elements.force.max()
    np.testing.assert_allclose(report.race[:, :, 0], due.elements.force, atol=2e-3 * most)
    loaded = due.elements.force[:, 0] > 0.0
    angle = due.elements.angle[loaded]
    np.testing.assert_allclose(report.race[loaded][:, :, 1], angle, rtol=1e-3)
    senses = np.repeat([row.sense for row in bearing.row_places], bearing.ball_count)
    assert (np.sign(angle[:, 0]) == senses[loaded]).all()
    u = system.layout.u(rows)
    assert np.abs(u["elements"][:, :3]).max() < 1e-3 * most
    assert np.abs(u["inner"][:3]).max() < 3e-3 * most


@pytest.mark.parametrize("bearing", [B3205, FACE_TO_FACE], ids=NAMES[:2])
def test_a_tilt_is_resisted_as_in_the_static_solution(bearing):
    tilt = 2e-4
    due, straight = (static(bearing, radial=1500.0, misalignment=at) for at in (tilt, 0.0))
    _, system, start = moving(bearing, radial=1500.0, misalignment=tilt)
    moment = -reported(system, start.y).outer_wrench[5]
    arm = 0.5 * bearing.row_distance
    change = due.reaction[4] - straight.reaction[4]
    assert abs(change) > 0.2
    assert abs(moment) == pytest.approx(abs(due.reaction[4]), abs=1e-3 * 1500.0 * arm)


def test_a_self_aligning_bearing_follows_a_tilt_without_a_moment():
    _, system, start = moving(B1205, radial=1500.0, misalignment=2e-3)
    report = reported(system, start.y)
    arm = 0.5 * B1205.pitch_diameter
    assert abs(report.outer_wrench[5]) < 2e-4 * arm * 1500.0


@pytest.mark.parametrize("bearing", SIDES, ids=NAMES)
def test_forces_of_both_rows_are_slopes_of_one_energy(bearing):
    _, system, start = moving(bearing, contacts=SMOOTH, **LOADED)
    y, rng = start.y.copy(), np.random.default_rng(3)
    q = system.layout.q(y)
    q["inner"][:5] += rng.standard_normal(5) * np.array([3e-6, 3e-6, 3e-6, 1e-4, 1e-4])
    q["elements"][:, :2] += 2e-6 * rng.standard_normal((system.layout.elements, 2))
    rows = system.residual(0.0, y, np.zeros_like(y))
    touching = reported(system, y).race[:, :, 0] > 1.0
    assert touching[: bearing.ball_count].any() and touching[bearing.ball_count :].any()
    assert np.abs(energy_misses(system, y, rows)).max() < 1e-5


@pytest.mark.parametrize("bearing", SIDES, ids=NAMES)
def test_what_both_rows_do_to_the_rings_is_in_balance(bearing):
    """Forces and moments of contacts on balls and rings sum to nothing, with friction and spin."""
    _, system, start = moving(bearing, speed=300.0, contacts=Contacts(), **LOADED)
    y, rng = start.y.copy(), np.random.default_rng(4)
    q, u = system.layout.q(y), system.layout.u(y)
    q["inner"][3:5] = 2e-4, -1e-4
    u["elements"][:] *= 1.0 + 0.02 * rng.standard_normal(u["elements"].shape)
    system.residual(0.0, y, start.yd, mode=2)
    force, moment, size = in_space(system, y)
    friction = np.abs(system.data.work.report.race[:, :, 2]).max()
    assert friction > 1.0
    np.testing.assert_allclose(force, 0.0, atol=1e-11 * size)
    np.testing.assert_allclose(moment, 0.0, atol=1e-11 * size)


def test_a_row_is_the_bearing_that_it_would_be_alone():
    """The first row of the pair, at its place along the axis, to rounding."""
    pair = replace(B3205, axial_clearance=0.0)
    _, both, start = moving(pair, speed=300.0, **LOADED)
    alone_case, alone, begun = moving(pair.row, speed=300.0, axial=300.0, radial=1.0)
    y, Z, place = begun.y.copy(), pair.ball_count, pair.row_places[0].place
    own, whole = alone.layout, both.layout
    for views in ("q", "u"):
        given, taken = getattr(whole, views)(start.y), getattr(own, views)(y)
        taken["elements"][:] = given["elements"][:Z]
        taken["inner"][:], taken["outer"][:] = given["inner"], given["outer"]
    own.q(y)["elements"][:, 0] -= place
    due = own.u(alone.residual(0.0, y, np.zeros_like(y)))["elements"]
    found = whole.u(both.residual(0.0, start.y, np.zeros_like(start.y)))["elements"][:Z]
    np.testing.assert_allclose(found, due, atol=1e-9 * np.abs(due).max())


def test_an_axial_load_loads_one_row_and_leaves_the_other():
    pair = replace(B3205, axial_clearance=0.0)
    for axial, loaded in ((800.0, slice(None, 9)), (-800.0, slice(9, None))):
        _, system, start = moving(pair, axial=axial, radial=0.0)
        force = reported(system, start.y).race[:, 0, 0].copy()
        angle = abs(reported(system, start.y).race[loaded, 0, 1]).mean()
        assert force[loaded].sum() * np.sin(angle) == pytest.approx(800.0, rel=1e-5)
        force[loaded] = 0.0
        assert not force.any()


def test_balls_of_a_row_touch_those_of_their_own_row():
    """The last of a row and its first, not the first of the other row."""
    _, system, start = moving(B3205, radial=500.0)
    y, Z = start.y.copy(), B3205.ball_count
    balls = system.layout.q(y)["elements"]
    near = 2.0 * np.arcsin((0.5 * B3205.ball_diameter - 1e-6) / balls[:, 1].mean())
    balls[Z - 1, 2] = balls[0, 2] + 2.0 * np.pi - near
    balls[Z - 1, :2] = balls[0, :2]
    force = reported(system, y).rib[:, 0]
    assert np.flatnonzero(force).tolist() == [Z - 1] and force[Z - 1] > 1.0


def test_balls_of_rows_that_interleave_touch_each_other():
    """A ball of a 1205's second row, moved to one of the first, in front and behind; rows of a 3205
    never meet."""
    _, system, start = moving(B1205, radial=500.0)
    n = B1205.ball_count
    for side, k in ((1.0, n + 3), (-1.0, n + 2)):
        y = start.y.copy()
        balls = system.layout.q(y)["elements"]
        x, r = balls[k, 0] - balls[3, 0], balls[3, 1]
        apart = np.sqrt((B1205.ball_diameter - 1e-6) ** 2 - x**2)
        balls[k, 1] = r
        balls[k, 2] = balls[3, 2] + side * 2.0 * np.arcsin(0.5 * apart / r)
        rows = system.residual(0.0, y, np.zeros_like(y))
        force = reported(system, y).rib[:, 0]
        assert np.flatnonzero(force).tolist() == [3] and force[3] > 1.0
        assert np.abs(energy_misses(system, y, rows)).max() < 1e-4
        reported(system, y)
        total, moment, size = in_space(system, y)
        np.testing.assert_allclose([*total, *moment], 0.0, atol=1e-11 * size)
    assert not moving(B3205, radial=500.0)[1].data.model.rows.meet


STATES = {
    "back to back": (B3205, {}, 0.05),
    "sliding": (B3205, {}, 2.0),
    "face to face": (FACE_TO_FACE, {}, 0.05),
    "self-aligning": (B1205, {}, 0.05),
}


@pytest.mark.parametrize("name", STATES)
@pytest.mark.parametrize("alpha", [1e4, 1e6])
def test_newtons_matrix_of_both_rows(name, alpha):
    """One Newton step back from a displacement of one allowed error everywhere."""
    bearing, load, slide = STATES[name]
    _, system, start = moving(bearing, speed=300.0, **LOADED, **load)
    y, rng = start.y.copy(), np.random.default_rng(1)
    u = system.layout.u(y)["elements"]
    u[:] += slide * rng.standard_normal(u.shape) * [1.0, 1.0, 1.0, 250.0, 250.0, 250.0]
    system.function("residual")(
        0.0, y, start.yd, system.args, np.zeros(len(y)), np.zeros(len(POWERS))
    )
    system.function("note")(0.0, y, system.args)
    weight = system.error_weights(1e-8)
    d = np.zeros_like(y)
    tested = weight > 0.0
    d[tested] = rng.uniform(-1, 1, tested.sum()) / weight[tested]

    def along(e):
        return system.residual(0.0, y + e * d, start.yd + e * alpha * d)

    r = (along(1e-2) - along(-1e-2)) / 2e-2
    system.function("linearise")(0.0, y, start.yd, system.args)
    assert system.function("factor")(alpha, system.args)
    system.function("backsolve")(alpha, y, r, system.args)
    assert np.abs((r + d) * weight).max() < 0.05


def test_it_has_no_more_unknowns_than_two_rows_and_two_rings():
    _, system, _ = moving(B3205, radial=100.0)
    layout: Layout = system.layout
    assert layout.elements == 18 and layout.size == 18 * 12 + 2 * 12 + 7
    assert DRY.rolling_resistance == "none" and UM == 1e-6
