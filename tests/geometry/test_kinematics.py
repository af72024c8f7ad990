"""Epicyclic speeds: rolling at both contacts, reversal, rings that turn together."""

import pytest

from flexcage.geometry.kinematics import epicyclic


def n1013(**speeds):
    return epicyclic(roller_diameter=8e-3, pitch_diameter=82.5e-3, roller_count=22, **speeds)


@pytest.mark.parametrize(("inner", "outer"), [(600.0, 0.0), (0.0, 300.0), (600.0, -250.0)])
def test_both_contacts_roll(inner, outer):
    """Surface velocities of roller and races are equal at both contacts, in the inertial frame."""
    found = n1013(inner_speed=inner, outer_speed=outer)
    pitch, radius = 41.25e-3, 4e-3
    at_inner = found.cage_speed * pitch - found.roller_spin * radius
    at_outer = found.cage_speed * pitch + found.roller_spin * radius
    assert at_inner == pytest.approx(inner * (pitch - radius), rel=1e-12)
    assert at_outer == pytest.approx(outer * (pitch + radius), rel=1e-12, abs=1e-12)


def test_reversal_mirrors():
    forward, back = n1013(inner_speed=600.0), n1013(inner_speed=-600.0)
    assert back.cage_speed == -forward.cage_speed
    assert back.roller_spin == -forward.roller_spin
    assert back.inner_race_passing == forward.inner_race_passing


def test_rings_turning_together_carry_all_along():
    found = n1013(inner_speed=100.0, outer_speed=100.0)
    assert found.cage_speed == pytest.approx(100.0)
    assert found.roller_spin_in_cage == 0.0
    assert found.roller_spin == pytest.approx(100.0)
