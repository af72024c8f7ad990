"""Epicyclic speeds against published numbers (reference table: printed and verified elsewhere)."""

from math import pi, radians

import pytest

from flexcage.geometry.kinematics import epicyclic

RPM = pi / 30.0

# case: Dw, dm [mm], Z, contact angle [deg], inner rpm; then n_c, n_R relative to the cage [rpm],
# BPFO, BPFI, BSF [Hz]
TABLE = {
    "N1013": (8.0, 82.5, 22, 0, 6000, 2709.0909, 30646.59, 993.3333, 1206.6667, 510.7765),
    "6203": (6.47, 26.0, 7, 0, 9000, 3380.1923, 16963.65, 394.3558, 655.6442, 282.7276),
    "7603025": (5.55, 42.4, 17, 60, 2000, 934.5519, None, 264.7897, 301.8770, None),
    "7010C": (9.525, 65.0, 18, 15, 10000, 4292.2736, None, 1287.6821, 1712.3179, None),
}


@pytest.mark.parametrize("name", TABLE)
def test_published_speeds(name):
    dw, dm, z, angle, rpm, cage, spin, bpfo, bpfi, bsf = TABLE[name]
    found = epicyclic(
        roller_diameter=dw * 1e-3,
        pitch_diameter=dm * 1e-3,
        roller_count=z,
        inner_speed=rpm * RPM,
        contact_angle=radians(angle),
    )
    assert found.cage_speed / RPM == pytest.approx(cage, abs=1e-4)
    assert found.outer_race_passing == pytest.approx(bpfo, abs=1e-4)
    assert found.inner_race_passing == pytest.approx(bpfi, abs=1e-4)
    if spin:
        assert -found.roller_spin_in_cage / RPM == pytest.approx(spin, abs=0.01)
        assert found.roller_frequency == pytest.approx(bsf, abs=1e-4)


def n1013(**speeds):
    return epicyclic(roller_diameter=8e-3, pitch_diameter=82.5e-3, roller_count=22, **speeds)


def test_the_two_spins_of_a_roller_differ_by_the_cage():
    """27,937.5 rpm in the inertial frame, 30,646.6 relative to the cage: a trap of slip."""
    found = n1013(inner_speed=6000 * RPM)
    assert -found.roller_spin / RPM == pytest.approx(27937.5, rel=1e-12)
    assert -found.roller_spin_in_cage / RPM == pytest.approx(30646.59, abs=0.01)
    assert found.roller_spin - found.roller_spin_in_cage == pytest.approx(found.cage_speed)


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
