"""Ball bearings: geometry that must close, and impossible ones refused in one sentence."""

from dataclasses import replace
from math import acos, cos, degrees, radians, sin

import numpy as np
import pytest

from flexcage.bearings.ball.ratings import static_factor
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError

PRESET = load_preset("7010C-PA66")
BEARING, CAGE = PRESET.bearing, PRESET.cage
DEEP = load_preset("15x37x10").bearing

IMPOSSIBLE = [
    ({"ball_count": 24}, ["24 balls", "overlap", "at most 23 fit"]),
    ({"inner_groove_radius": 4.36e-3}, ["inner_groove_radius is 4.36 mm", "4.365 mm"]),
    ({"outer_groove_radius": 4.3e-3}, ["outer_groove_radius is 4.3 mm"]),
    ({"bore": 57e-3}, ["bore is 57 mm", "56.5", "no inner ring"]),
    ({"outside_diameter": 73e-3}, ["outside_diameter is 73 mm", "no outer ring"]),
    ({"inner_shoulder": 5e-3}, ["inner_shoulder is 5 mm", "4.58 mm"]),
    ({"contact_angle": None}, ["neither contact_angle nor radial_clearance"]),
    ({"radial_clearance": 80e-6}, ["80 um", "15 deg makes it 32.71 um", 'contact_angle = "none"']),
    ({"radial_clearance": 0.0, "contact_angle": None}, ["0 um", "greater than 0 um"]),
    ({"radial_clearance": 1e-3, "contact_angle": None}, ["1000 um", "960 um"]),
]
CAGES = [
    ({"pocket_diameter": 8.7e-3}, ["pocket_diameter is 8.7 mm", "8.73 mm"]),
    ({"pocket_diameter": 11.5e-3}, ["18 pockets run into each other", "11.27"]),
    ({"bore": 65e-3}, ["65 mm", "cannot guide"]),
    ({"bore": 50e-3}, ["bore is 50 mm", "runs into the inner ring", "bearing.bore, 50 mm"]),
    ({"outside_diameter": 80e-3}, ["runs into the outer ring", "bearing.outside_diameter, 80 mm"]),
    ({"width": 33e-3}, ["cage.width is 33 mm", "16 mm", "2 times as wide"]),
]


def refused(bearing, cage, words):
    with pytest.raises(InputError) as caught:
        bearing.check(cage)
    sentence = str(caught.value)
    assert caught.value.where and sentence.endswith(".") and "\n" not in sentence
    assert all(word in sentence for word in words), sentence


@pytest.mark.parametrize(("change", "words"), IMPOSSIBLE)
def test_impossible_bearing(change, words):
    refused(replace(BEARING, **change), CAGE, words)


@pytest.mark.parametrize(("change", "words"), CAGES)
def test_impossible_cage(change, words):
    refused(BEARING, replace(CAGE, **change), words)


def test_a_deep_groove_cage_keeps_off_shoulders():
    """They stand on both sides of the balls, where an angular contact bearing is open on one."""
    shoulders = replace(DEEP, inner_shoulder=1e-3, outer_shoulder=1e-3)
    over, under = shoulders.shoulder_diameters
    cage = replace(CAGE, bore=over + 1e-4, outside_diameter=under - 1e-4, pocket_diameter=6.8e-3)
    refused(shoulders, replace(cage, width=5e-3, bore=over), ["inner ring's shoulder"])
    refused(shoulders, replace(cage, width=5e-3, outside_diameter=under), ["outer ring's shoulder"])
    plain = replace(DEEP, inner_shoulder=None, outer_shoulder=None)
    refused(plain, replace(cage, width=5e-3, bore=plain.bore), ["bearing.bore"])


def test_a_preload_beyond_all_steel_is_refused():
    refused(replace(DEEP, radial_clearance=-1e-4), None, ["-100 um", "-64.7 um (preload)"])


def test_clearance_and_contact_angle_say_the_same():
    """The paper's clearances of 20, 80 and 140 um go with 11.72, 23.56 and 31.33 degrees."""
    for clearance, angle in ((20e-6, 11.72), (80e-6, 23.56), (140e-6, 31.33)):
        loose = replace(BEARING, contact_angle=None, radial_clearance=clearance)
        assert degrees(loose.free_contact_angle) == pytest.approx(angle, abs=5e-3)
        both = replace(loose, contact_angle=loose.free_contact_angle)
        both.check()
        assert both.clearance == pytest.approx(clearance, rel=1e-12)
        share = 1.0 - clearance / (2.0 * loose.groove_distance)
        assert loose.free_contact_angle == pytest.approx(acos(share), rel=1e-9)


@pytest.mark.parametrize("bearing", [BEARING, replace(DEEP, radial_clearance=30e-6)])
def test_balls_just_touch_both_grooves_at_the_free_contact_angle(bearing):
    """From the groove's centres: their distance is A, a ball between lies on the pitch circle."""
    inner, outer = np.array(bearing.inner_groove_centre), np.array(bearing.outer_groove_centre)
    assert inner - outer == pytest.approx(np.array(bearing.groove_offset), rel=1e-12)
    angle = bearing.free_contact_angle
    A = bearing.groove_distance
    assert bearing.groove_offset[1] == pytest.approx(A * cos(angle), rel=1e-12)
    if bearing is BEARING:
        ball = np.array([0.0, 0.5 * bearing.pitch_diameter])
        for centre, radius, sign in (
            (inner, bearing.inner_groove_radius, 1.0),
            (outer, bearing.outer_groove_radius, -1.0),
        ):
            reach = radius - 0.5 * bearing.ball_diameter
            along = sign * reach * np.array([sin(angle), cos(angle)])
            assert centre - ball == pytest.approx(along, rel=1e-9)


def test_ratings_of_closer_and_wider_grooves():
    """The standards' grooves are the closest that count; wider ones bear less."""
    size = BEARING.ball_diameter
    bearings = [replace(BEARING, inner_groove_radius=f * size) for f in (0.515, 0.52, 0.53)]
    for rating in ("static_rating", "dynamic_rating"):
        found = [getattr(bearing, rating) for bearing in bearings]
        assert found[0] == found[1] > found[2]


# ISO 281, table 3: factors Y over f0 Fa/C0r of deep grooves, 10 and 15 degrees; then from 20 on
LOADS = (0.172, 0.345, 0.689, 1.03, 1.38, 2.07, 3.45, 5.17, 6.89)
Y_OF_TABLE = {
    0.0: (2.30, 1.99, 1.71, 1.55, 1.45, 1.31, 1.15, 1.04, 1.00),
    10.0: (1.88, 1.71, 1.52, 1.41, 1.34, 1.23, 1.10, 1.01, 1.00),
    15.0: (1.47, 1.40, 1.30, 1.23, 1.19, 1.12, 1.02, 1.00, 1.00),
}
STEEP_Y = {20.0: 1.00, 25.0: 0.87, 30.0: 0.76, 35.0: 0.66, 40.0: 0.57, 45.0: 0.50}


@pytest.mark.parametrize("angle", Y_OF_TABLE)
def test_axial_factors_are_the_tables(angle):
    """The table's columns of loads are 1, 1.016 and 1.036 times those of deep grooves."""
    bearing = DEEP if angle == 0.0 else replace(BEARING, contact_angle=radians(angle))
    per_ball = static_factor(bearing.gamma, 0.52, 0.53) / 5.0
    for relative, expected in zip(LOADS, Y_OF_TABLE[angle]):
        relative *= {0.0: 1.0, 10.0: 1.016, 15.0: 1.036}[angle]
        axial = relative * bearing.static_rating / per_ball
        found = bearing.equivalent_load(0.1 * axial, axial)
        assert found.axial_factor == pytest.approx(expected, abs=0.03 * expected)


@pytest.mark.parametrize("angle", STEEP_Y)
def test_axial_factors_of_steep_angles_are_the_tables(angle):
    found = replace(BEARING, contact_angle=radians(angle)).equivalent_load(1e3, 2e3)
    assert found.axial_factor == pytest.approx(STEEP_Y[angle], rel=0.005)


@pytest.mark.parametrize(
    ("angle", "k"),
    [(5.0, 0.4), (10.0, 0.4), (15.0, 0.4)] + [(angle, 1.0 / 2.75) for angle in STEEP_Y],
)
def test_radial_factors_are_what_stands_behind_the_table(angle, k):
    """ISO/TR 1281-1: X = 1 - 0.4 xi/eta, eta = 1 - k sin(alpha), xi 1.25, up to 5 degrees 1.05."""
    xi = 1.05 if angle <= 5.0 else 1.25
    expected = 1.0 - 0.4 * xi / (1.0 - k * sin(radians(angle)))
    found = replace(BEARING, contact_angle=radians(angle)).equivalent_load(1.0, 1e4)
    assert found.radial_factor == pytest.approx(expected, abs=0.006 if angle > 5.0 else 0.06)


@pytest.mark.parametrize("angle", [5.0, 15.0, 18.0, 20.0, 33.0, 45.0])
def test_equivalent_load_has_no_jump_and_never_falls(angle):
    bearing = replace(BEARING, contact_angle=radians(angle))
    axial = np.linspace(0.0, 5e3, 4001)
    load = np.array([bearing.equivalent_load(1e3, f).load for f in axial])
    assert load[0] == 1e3 and np.diff(load).min() >= -1e-9
    assert np.diff(load).max() < 4.0 * (axial[1] - axial[0])


def test_thrust_bearings_want_axial_load():
    bearing = load_preset("7603025").bearing
    assert bearing.is_thrust and not BEARING.is_thrust
    assert bearing.equivalent_load(1200.0, 3500.0).load == pytest.approx(0.92 * 1200.0 + 3500.0)
    assert np.isnan(bearing.equivalent_load(1200.0, 2000.0).load)
