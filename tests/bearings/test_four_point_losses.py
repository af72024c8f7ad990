"""Losses of balls on up to four arcs: the drive pays for them, and spin by hand."""

from dataclasses import replace
from math import cos, pi, sin

import numpy as np
import pytest
from qj208 import QJ208, solved

from flexcage.bearings import losses_of
from flexcage.bearings.four_point.losses import on_arcs
from flexcage.contacts.spec import Contacts, FrictionLaw, Lubricant

RPM = pi / 30.0
LOADS = {
    "both directions": {"radial": 2000.0, "axial": 600.0},
    "radial load alone": {"radial": 2000.0},
    "axial load alone": {"axial": 3000.0},
}


def losses(solution, contacts=None, lubricant=None):
    return losses_of(QJ208)(
        QJ208, solution, contacts=contacts or Contacts(), lubricant=lubricant or Lubricant()
    )


@pytest.mark.parametrize("load", LOADS.values(), ids=LOADS)
def test_the_drive_pays_for_every_arc(load):
    solution = solved(speed=4200 * RPM, gyroscopic="none", **load)
    found = losses(solution)
    assert found.torque * solution.speed == pytest.approx(found.total, rel=1e-6)
    assert all(loss > 0.0 for loss in found.places.values())


@pytest.mark.parametrize("load", LOADS.values(), ids=LOADS)
def test_forces_on_arcs_balance_at_the_angles_that_losses_take(load):
    solution, most = solved(**load), 0
    for k in range(QJ208.ball_count):
        touches = on_arcs(QJ208, solution, k)
        sums, size = np.zeros(2), 0.0
        for race, force, angle in touches:
            sign = -1.0 if race else 1.0
            sums += sign * force * np.array([sin(angle), cos(angle)])
            size += force
        assert sums == pytest.approx([0.0, 0.0], abs=1e-6 * size)
        most = max(most, len(touches))
    assert most == (2 if "radial" not in load else 4)


def test_a_ball_on_four_arcs_spins_on_each_of_them():
    """Under a radial load, dry, with Coulomb's friction, a ball turns about an axis parallel to the
    bearing's and rolls on circles of radius r cos(a). It spins by sin(a) of its relative speed on
    every arc, and an ellipse of half axis A loses 3/8 mu Q A per spin."""
    mu, speed = 0.05, 100 * RPM
    law = FrictionLaw(law="step_coulomb", static=mu, dynamic=mu, v_static=1e-5, v_dynamic=2e-5)
    contacts = replace(Contacts(), race=replace(Contacts().race, friction=law))
    dry = Lubricant(rolling_resistance="none", oil_fraction=0.0)
    solution = solved(speed=speed, gyroscopic="none", radial=2000.0)
    found = losses(solution, contacts, dry)
    due, r, pitch = 0.0, 0.5 * QJ208.ball_diameter, 0.5 * QJ208.pitch_diameter
    for k in range(QJ208.ball_count):
        for race, force, angle in on_arcs(QJ208, solution, k):
            near = r * cos(angle)
            orbit = speed * 0.5 * (pitch - near) / pitch
            turn = orbit * (pitch + near) / near  # of the ball, from its orbit
            relative = turn + (speed - orbit) if race == 0 else turn - orbit
            half = float(QJ208.contacts[race].semi_axes(force)[0])
            due += 0.375 * mu * force * half * abs(relative * sin(angle))
    assert found.total == pytest.approx(due, rel=0.01)


def test_thicker_oil_resists_balls_on_arcs_more():
    warm = solved(speed=4200 * RPM, gyroscopic="none", radial=2000.0, axial=600.0)
    thin, thick = (losses(warm, lubricant=Lubricant(viscosity=v)) for v in (5e-3, 50e-3))
    assert thick.rolling.sum() > 1.3 * thin.rolling.sum()
