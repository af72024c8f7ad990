"""Losses of static solutions of double row bearings: those of single rows, twice, and what the
drive puts in."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

import flexcage
from flexcage.bearings import losses_of
from flexcage.case.static import StaticCase
from flexcage.geometry.heat.network import OUTER
from flexcage.spec import (
    DoubleRowAngularContactBallBearing,
    DoubleRowRollerBearing,
    Drive,
    Load,
    SelfAligningBallBearing,
)
from flexcage.warming import warm

MM = 1e-3
BALLS = DoubleRowAngularContactBallBearing(
    bore=25 * MM, outside_diameter=52 * MM, width=20.6 * MM, pitch_diameter=38.5 * MM,
    ball_diameter=7.938 * MM, ball_count=9, inner_groove_radius=4.088 * MM,
    outer_groove_radius=4.167 * MM, contact_angle=np.radians(30.0), row_distance=9.5 * MM,
    staggered=False,
)  # fmt: skip
ALIGNING = SelfAligningBallBearing(
    bore=25 * MM, outside_diameter=52 * MM, width=15 * MM, pitch_diameter=38.5 * MM,
    ball_diameter=7.5 * MM, ball_count=12, inner_groove_radius=3.975 * MM, row_distance=7 * MM,
    radial_clearance=5e-6,
)  # fmt: skip
ROLLERS = DoubleRowRollerBearing(
    bore=50 * MM, outside_diameter=80 * MM, width=23 * MM, inner_race_diameter=58 * MM,
    outer_race_diameter=72 * MM, roller_diameter=7 * MM, roller_length=7 * MM,
    effective_length=6.4 * MM, roller_count=24, rib_diameter=60 * MM, rib_gap=7.05 * MM,
    row_distance=9 * MM, staggered=False,
)  # fmt: skip


def lost(bearing, *, speed=300.0, **load):
    case = StaticCase(bearing=bearing, load=Load(gravity=0.0, **load), drive=Drive(speed=speed))
    solution = flexcage.solve_static(case)
    found = losses_of(bearing)(
        bearing, solution, contacts=case.contacts, lubricant=case.lubricant
    )  # fmt: skip
    return found, solution


LOADS = {
    "balls": (BALLS, {"radial": 1500.0, "axial": 300.0}),
    "balls, one row": (replace(BALLS, axial_clearance=20e-6), {"axial": 800.0}),
    "balls, preloaded": (replace(BALLS, axial_clearance=-10e-6), {"radial": 500.0}),
    "aligning": (ALIGNING, {"radial": 1500.0}),
    "rollers": (replace(ROLLERS, staggered=True), {"radial": 4000.0}),
    "rollers, backwards": (ROLLERS, {"radial": 4000.0, "speed": -300.0}),
}


@pytest.mark.parametrize("name", LOADS)
def test_the_drive_puts_in_what_both_rows_lose(name):
    bearing, load = LOADS[name]
    found, solution = lost(bearing, **load)
    assert found.torque * solution.speed == pytest.approx(found.total, rel=1e-9)
    assert all(loss > 0.0 for loss in found.places.values())
    assert found.orbit * solution.speed > 0.0 and found.spin > 0.0


def test_two_rows_of_rollers_lose_twice_what_one_does_under_half_the_load():
    both, _ = lost(ROLLERS, radial=4000.0)
    one, _ = lost(ROLLERS.row, radial=2000.0)
    assert both.torque == pytest.approx(2.0 * one.torque, rel=1e-5)
    for place, loss in one.places.items():
        assert both.places[place] == pytest.approx(2.0 * loss, rel=1e-5, abs=1e-9)
    assert both.orbit == pytest.approx(one.orbit, rel=1e-9)


@pytest.mark.parametrize("arrangement", ["back_to_back", "face_to_face"])
def test_a_row_of_balls_that_bears_all_loses_what_it_does_alone(arrangement):
    """Beside what the balls of the other row lose, which roll on the outer race in the oil."""
    pair = replace(BALLS, arrangement=arrangement, axial_clearance=0.2 * MM)
    both, solution = lost(pair, axial=800.0)
    one, _ = lost(pair.row, axial=800.0)
    bears = solution.elements.force[:, 0].reshape(2, 9).max(axis=1) > 0.0
    assert bears.tolist() == ([True, False] if arrangement == "back_to_back" else [False, True])
    assert both.sliding == pytest.approx(one.sliding, rel=1e-5)
    assert both.rolling[0] == pytest.approx(one.rolling[0], rel=1e-5)
    assert both.rolling[1] > one.rolling[1]
    assert both.places["drag"] == pytest.approx(2.0 * one.places["drag"], rel=0.02)
    assert both.orbit == pytest.approx(one.orbit, rel=1e-6)


def test_pure_radial_load_on_balls_is_shared_by_rows_alike():
    """Each row, with the load of half the force and the axial force of the other."""
    both, solution = lost(BALLS, radial=1500.0)
    e = solution.elements
    axial = float((e.force[:9, 0] * np.sin(e.angle[:9, 0])).sum())
    one, alone = lost(BALLS.row, radial=750.0, axial=abs(axial))
    np.testing.assert_allclose(alone.elements.force, e.force[:9], rtol=2e-3, atol=0.1)
    assert both.torque == pytest.approx(2.0 * one.torque, rel=2e-3)


def test_temperatures_of_double_row_bearings_settle():
    """``flexcage warm``: with the heat that both rows make."""
    oil = {"life.viscosity_40": "68 mm^2/s", "life.viscosity_100": "8.7 mm^2/s"}
    loose = replace(ROLLERS, radial_clearance=20e-6)
    for bearing, load in (LOADS["balls"], (loose, {"radial": 4000.0})):
        case = StaticCase(bearing=bearing, load=Load(**load), drive=Drive(speed=300.0))
        found = warm(case.replace({**oil, "life.temperature": "60 degC"}))
        assert found.settled and 300.0 < found.temperatures[OUTER] < 400.0
