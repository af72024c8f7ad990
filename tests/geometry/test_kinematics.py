"""Epicyclic speeds: rolling at both contacts, reversal, rings that turn together."""

import numpy as np
import pytest

from flexcage.core.errors import InputError
from flexcage.geometry.kinematics import epicyclic, rolling_shares


def n1013(**speeds):
    return epicyclic(element_diameter=8e-3, pitch_diameter=82.5e-3, element_count=22, **speeds)


@pytest.mark.parametrize(("inner", "outer"), [(600.0, 0.0), (0.0, 300.0), (600.0, -250.0)])
def test_both_contacts_roll(inner, outer):
    """Surface velocities of roller and races are equal at both contacts, in the inertial frame."""
    found = n1013(inner_speed=inner, outer_speed=outer)
    pitch, radius = 41.25e-3, 4e-3
    at_inner = found.cage_speed * pitch - found.element_spin * radius
    at_outer = found.cage_speed * pitch + found.element_spin * radius
    assert at_inner == pytest.approx(inner * (pitch - radius), rel=1e-12)
    assert at_outer == pytest.approx(outer * (pitch + radius), rel=1e-12, abs=1e-12)


def test_reversal_mirrors():
    forward, back = n1013(inner_speed=600.0), n1013(inner_speed=-600.0)
    assert back.cage_speed == -forward.cage_speed
    assert back.element_spin == -forward.element_spin
    assert back.inner_race_passing == forward.inner_race_passing


def test_rings_turning_together_carry_all_along():
    found = n1013(inner_speed=100.0, outer_speed=100.0)
    assert found.cage_speed == pytest.approx(100.0)
    assert found.element_spin_in_cage == 0.0
    assert found.element_spin == pytest.approx(100.0)


@pytest.mark.parametrize("angles", [(0.3, 0.3), (0.35, 0.12), (-0.1, -0.25), (1.05, 1.0)])
@pytest.mark.parametrize("heights", [(0.0, 0.0), (0.003, 0.002)])
@pytest.mark.parametrize("outer", [0.0, -250.0])
def test_balls_roll_at_two_contact_angles(angles, heights, outer):
    """Vectors: at both races, the strip at its height above the middle does not slide, for a ball
    whose axis halves the angle between both contacts."""
    ball, pitch, inner = 4e-3, 39e-3, 1000.0  # ball's radius, pitch diameter
    shares = rolling_shares(2.0 * ball / pitch, angles, heights)
    orbit = shares.orbit * inner + (1.0 - shares.orbit) * outer
    spin = -shares.spin * (inner - outer)
    middle = 0.5 * sum(angles)
    axis = np.array([np.cos(middle), -np.sin(middle)])  # along x and outwards
    centre = np.array([0.0, 0.5 * pitch])
    for side, ring, angle, height in zip((-1.0, 1.0), (inner, outer), angles, heights):
        arm = side * (1.0 - height) * ball * np.array([np.sin(angle), np.cos(angle)])
        place = centre + arm
        of_ring = (ring - orbit) * place[1]  # along +psi, as seen from the cage
        of_ball = spin * (axis[0] * arm[1] - axis[1] * arm[0])
        assert of_ball == pytest.approx(of_ring, rel=1e-12)


def test_one_contact_angle_is_two_alike():
    """Textbook: gamma = D cos(alpha)/Dpw, w_c = w_i (1 - gamma)/2, BSF (1 - gamma^2) Dpw/(2 D)."""
    sizes = {"element_diameter": 7.938e-3, "pitch_diameter": 39.04e-3, "element_count": 9}
    one, two = (epicyclic(**sizes, inner_speed=1000.0, contact_angle=a) for a in (0.4, (0.4, 0.4)))
    assert one == two
    gamma = 7.938 * np.cos(0.4) / 39.04
    assert one.cage_speed == pytest.approx(500.0 * (1.0 - gamma), rel=1e-14)
    turns = 500.0 * 39.04 / 7.938 * (1.0 - gamma**2) / (2.0 * np.pi)
    assert one.element_frequency == pytest.approx(turns, rel=1e-14)
    assert one.outer_race_passing == pytest.approx(9 * 500.0 * (1.0 - gamma) / (2.0 * np.pi))
    assert one.inner_race_passing == pytest.approx(9 * 500.0 * (1.0 + gamma) / (2.0 * np.pi))


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (
            {"contact_angle": 15.0},
            "contact_angle is 15 rad, .* is 15 deg meant, which is 0.2618 rad",
        ),
        ({"contact_angle": (0.2, 40.0)}, "contact_angle is 40 rad"),
        ({"element_diameter": 90e-3}, "elements with a diameter of 0.09 on a pitch circle of 0.08"),
        ({"element_diameter": 8.0}, "in the same unit"),
        ({"element_count": 0}, "0 elements"),
    ],
)
def test_degrees_and_sizes_of_no_bearing_are_refused(wrong, words):
    """cos(15) is negative: the cage would turn faster than the mean of both rings."""
    usual = {"element_diameter": 8e-3, "pitch_diameter": 82.5e-3, "element_count": 22}
    with pytest.raises(InputError, match=words):
        epicyclic(**{**usual, **wrong}, inner_speed=600.0)
