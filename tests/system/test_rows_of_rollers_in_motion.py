"""Two rows of rollers in motion: the static solution row by row, balance, and their ribs and
neighbours."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from moving_rows import MM, NN3010, in_space, moving, reported

import flexcage
from flexcage.case.static import StaticCase
from flexcage.contacts.spec import Contacts
from flexcage.spec import Drive, Load

Z = NN3010.roller_count


def test_at_rest_both_rows_bear_as_in_the_static_solution():
    """Under a radial load and a tilt, which loads the ends of rollers of either row otherwise; that
    a roller may tilt in its row is in both."""
    load = {"radial": 4000.0, "misalignment": 2e-4}
    case = StaticCase(bearing=NN3010, load=Load(gravity=0.0, **load), drive=Drive(speed=0.0))
    due = flexcage.solve_static(case)
    _, system, start = moving(NN3010, **load)
    report = reported(system, start.y)
    most = due.elements.force.max()
    np.testing.assert_allclose(report.race[:, :, 0], due.elements.force, atol=0.01 * most)
    assert start.residual < 1e-6
    lean = abs(report.outer_wrench[5] - 0.0)
    assert lean == pytest.approx(abs(due.reaction[4]), rel=0.02)


def test_rows_without_stagger_are_two_single_bearings_with_half_the_load():
    straight = replace(NN3010, staggered=False)
    _, both, start = moving(straight, radial=4000.0)
    _, alone, begun = moving(straight.row, radial=2000.0)
    force, due = (
        reported(system, at.y).race[:, 0, 0].copy()
        for system, at in ((both, start), (alone, begun))
    )
    np.testing.assert_allclose(force[:Z], due, atol=1e-5 * due.max())
    np.testing.assert_allclose(force[Z:], force[:Z], atol=1e-9 * due.max())
    x = both.layout.q(start.y)["elements"][:, 0]
    np.testing.assert_allclose(x, np.repeat([-4.5 * MM, 4.5 * MM], Z), atol=1e-9)


def test_what_both_rows_of_rollers_do_to_the_rings_is_in_balance():
    _, system, start = moving(NN3010, speed=300.0, contacts=Contacts(), radial=4000.0)
    y, rng = start.y.copy(), np.random.default_rng(4)
    q, u = system.layout.q(y), system.layout.u(y)
    q["elements"][:, 0] += 20e-6 * rng.standard_normal(2 * Z)
    q["elements"][:, 3:5] += 1e-4 * rng.standard_normal((2 * Z, 2))
    u["elements"][:] *= 1.0 + 0.02 * rng.standard_normal(u["elements"].shape)
    report = reported(system, y, start.yd)
    assert report.rib[:Z].max() > 1.0 and report.rib[Z:].max() > 1.0
    force, moment, size = in_space(system, y)
    np.testing.assert_allclose(force, 0.0, atol=1e-11 * size)
    np.testing.assert_allclose(moment, 0.0, atol=1e-11 * size)


def test_ribs_stand_beside_the_middle_of_their_row():
    """A roller of either row meets its rib after the same way, towards +x and -x."""
    _, system, start = moving(NN3010, radial=4000.0)
    play = 0.5 * (NN3010.rib_gap - NN3010.roller_length)
    for way, beyond in ((1.0, 1e-6), (-1.0, 1e-6), (1.0, -1e-6)):
        y = start.y.copy()
        system.layout.q(y)["elements"][:, 0] += way * (play + beyond)
        rib = reported(system, y).rib
        assert (rib[:, 0 if way > 0.0 else 1] > 0.0).all() == (beyond > 0.0)
        assert not rib[:, 1 if way > 0.0 else 0].any()


def test_rollers_touch_the_next_one_of_their_row():
    _, system, start = moving(NN3010, radial=500.0)
    y = start.y.copy()
    rollers = system.layout.q(y)["elements"]
    near = 2.0 * np.arcsin((0.5 * NN3010.roller_diameter - 1e-6) / rollers[Z:, 1].mean())
    rollers[2 * Z - 1, 2] = rollers[Z, 2] + 2.0 * np.pi - near
    rollers[2 * Z - 1, 1] = rollers[Z, 1]
    force = reported(system, y).pocket_normal[:, 0]
    assert np.flatnonzero(force).tolist() == [2 * Z - 1] and force[-1] > 1.0
