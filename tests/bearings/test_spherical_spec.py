"""Spherical roller bearings as specs: geometry, ratings, profiles, and what is impossible."""

from dataclasses import replace
from math import cos, hypot, pi, radians, sin

import numpy as np
import pytest
from spherical_bearings import BEARING, MM

from flexcage.core.errors import InputError
from flexcage.geometry.fits.changed import Changed
from flexcage.render import section_picture
from flexcage.render.shapes import shapes_of
from flexcage.spec import DoubleRowRollerBearing, SphericalRollerBearing

# T. A. Harris, Rolling Bearing Analysis, examples of a 22317, from memory: contours of barrels and
# races, and the radius of the sphere, 81.585 mm, of a bearing with about 0.1 mm of clearance
HARRIS = SphericalRollerBearing(
    bore=85 * MM, outside_diameter=180 * MM, width=60 * MM, contact_angle=radians(12.0),
    pitch_diameter=135.077 * MM, roller_diameter=25 * MM, roller_length=20.762 * MM,
    effective_length=19 * MM, roller_count=14, barrel_radius=79.959 * MM,
    inner_groove_radius=81.585 * MM, radial_clearance=0.1 * MM,
)  # fmt: skip


def test_a_published_bearings_sphere_follows_from_where_its_rollers_are():
    HARRIS.check()
    assert HARRIS.sphere_radius == pytest.approx(81.585 * MM, rel=3e-4)
    assert HARRIS.osculations == pytest.approx((0.98, 0.98), abs=2e-3)


def test_barrels_touch_both_races_in_the_middle_of_the_clearance():
    """Points of a barrel on its line of contact, a gap off the sphere and the groove."""
    b, angle = BEARING, BEARING.contact_angle
    middle = np.array([0.5 * b.row_distance, 0.5 * b.pitch_diameter])
    out = np.array([sin(angle), cos(angle)])
    gap = 0.25 * b.radial_clearance * cos(angle)
    above = middle + 0.5 * b.roller_diameter * out
    assert hypot(*above) == pytest.approx(b.sphere_radius - gap, rel=1e-12)
    assert middle / hypot(*middle) == pytest.approx(out)
    assert 0.5 * b.race_diameter("outer", 0.0) == pytest.approx(b.sphere_radius * cos(angle))
    race = middle - (0.5 * b.roller_diameter + gap) * out
    assert 0.5 * b.race_diameter("inner", 0.0) == pytest.approx(race[1], rel=1e-12)


def test_a_barrel_weighs_what_its_discs_do():
    b, n = BEARING, 4000
    x = ((np.arange(n) + 0.5) / n - 0.5) * b.roller_length
    r = 0.5 * b.roller_diameter - b.barrel_radius + np.sqrt(b.barrel_radius**2 - x**2)
    disc = b.material.density * pi * r**2 * b.roller_length / n
    assert b.element_mass == pytest.approx(disc.sum(), rel=1e-6)
    axial, transverse = (0.5 * disc * r**2).sum(), (disc * (0.25 * r**2 + x**2)).sum()
    assert b.roller_inertia == pytest.approx((axial, transverse), rel=1e-6)


def test_ratings_are_those_of_cylinders_as_the_angle_vanishes():
    """But for b_m, 1.15 of spherical roller bearings to 1.1."""
    b = replace(BEARING, contact_angle=1e-6)
    cylinders = DoubleRowRollerBearing(
        bore=b.bore, outside_diameter=b.outside_diameter, width=b.width, row_distance=9 * MM,
        inner_race_diameter=b.pitch_diameter - b.roller_diameter,
        outer_race_diameter=b.pitch_diameter + b.roller_diameter,
        roller_diameter=b.roller_diameter, roller_length=b.roller_length,
        effective_length=b.effective_length, roller_count=16, rib_diameter=54 * MM,
        rib_gap=8.6 * MM,
    )  # fmt: skip
    assert b.static_rating == pytest.approx(cylinders.static_rating)
    assert b.dynamic_rating == pytest.approx(1.15 / 1.1 * cylinders.dynamic_rating)


# SKF, General Catalogue 6000: of a 22208 E, e = 0.28, Y1 = 2.4, Y2 = 3.6; of a 22210 E, and a 22308
@pytest.mark.parametrize(
    ("angle", "limit", "below", "beyond"),
    [(10.55, 0.28, 2.4, 3.6), (9.07, 0.24, 2.8, 4.2), (13.86, 0.37, 1.8, 2.7)],
)
def test_makers_print_the_standards_factors(angle, limit, below, beyond):
    b = replace(BEARING, contact_angle=radians(angle))
    little, much = (b.equivalent_load(1000.0, 1000.0 * f * limit) for f in (0.95, 1.05))
    assert (little.radial_factor, much.radial_factor) == (1.0, 0.67)
    assert little.axial_factor == pytest.approx(below, abs=0.05)
    assert much.axial_factor == pytest.approx(beyond, abs=0.05)
    # both are alike at e, to the digits of X
    at = 1000.0 * limit
    assert little.load + little.axial_factor * 0.05 * at == pytest.approx(
        much.load - much.axial_factor * 0.05 * at, rel=0.01
    )


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"pitch_diameter": 85 * MM}, "must be between bore, 40 mm, and outside_diameter, 80 mm"),
        ({"effective_length": 9 * MM}, "longer than the barrel itself, 8.5 mm"),
        ({"barrel_radius": 4 * MM}, "come to a point; give more than"),
        ({"barrel_radius": 36.58 * MM, "inner_groove_radius": 37 * MM},
         "but the sphere of the outer ring has a radius of 36.5"),
        ({"inner_groove_radius": 35.8 * MM}, "but the inner groove has a radius of 35.8 mm, so"),
        ({"roller_count": 18}, "18 barrels of 10.7 mm a row overlap .* at most 17 fit"),
        ({"roller_length": 10 * MM}, "of the other row, whose middles are 11.4278 mm off"),
        ({"width": 20 * MM}, "out of a bearing 20 mm wide; give a width of 21"),
        ({"bore": 50 * MM}, "inner race is 49.7624 mm in diameter at the barrels' outer ends"),
        ({"outside_diameter": 73 * MM}, "the outer race's sphere is 73.1249 mm in dia"),
    ],
)  # fmt: skip
def test_impossible_spherical_roller_bearings(changes, said):
    BEARING.check()
    with pytest.raises(InputError, match=said):
        replace(BEARING, **changes).check()


def test_as_many_barrels_fit_as_the_sentence_says():
    full = replace(BEARING, roller_count=17)
    full.check()
    share = full.roller_diameter / (full.pitch_diameter * sin(pi / 17))
    assert 0.9 < share < 1.0


def test_fits_move_races_and_leave_the_clearance():
    changed = Changed(
        inner_race=12e-6, outer_race=-4e-6, element=2e-6, inner_strain=2e-4, outer_strain=-1e-4,
        initial=40e-6, clearance=20e-6,
    )  # fmt: skip
    b = replace(BEARING, radial_clearance=40e-6).in_place(changed)
    assert b.radial_clearance == 20e-6
    assert b.pitch_diameter - BEARING.pitch_diameter == pytest.approx(4e-6)
    assert b.inner_groove_radius == pytest.approx(BEARING.inner_groove_radius * 1.0002)


def test_barrels_run_over_the_spheres_edge_beyond_the_greatest_tilt():
    """The corner of the effective length is then where the sphere ends."""
    b, tilt = BEARING, BEARING.greatest_tilt
    assert radians(1.5) < tilt < radians(2.5)  # as makers have it
    end = b.contact_angle + np.arcsin(0.5 * b.effective_length / b.sphere_radius) + tilt
    assert b.sphere_radius * sin(end) == pytest.approx(0.5 * b.width)


def test_profiles_are_closed_bodies_that_do_not_meet(tmp_path):
    found, b = shapes_of(BEARING), BEARING
    for profile in (found.inner, found.outer, found.element):
        x, r = np.array(profile).T
        assert 0.5 * (x * np.roll(r, -1) - np.roll(x, -1) * r).sum() > 0.0  # counter-clockwise
    inner, outer = np.array(found.inner), np.array(found.outer)
    assert inner[:, 1].min() == 0.5 * b.bore and outer[:, 1].max() == 0.5 * b.outside_diameter
    assert inner[:, 0].min() == outer[:, 0].min() == -0.5 * b.width
    on_sphere = np.hypot(*outer[outer[:, 1] < 0.95 * 0.5 * b.outside_diameter].T)
    assert on_sphere == pytest.approx(b.sphere_radius)
    # the groove's arc: its points are as far from the centre of that of the row at -x
    far = b.reach + b.inner_groove_radius - 0.5 * b.roller_diameter - b.gap
    centre = far * np.array([-sin(b.contact_angle), cos(b.contact_angle)])
    arc = inner[3:-1]
    assert np.hypot(*(arc - centre).T) == pytest.approx(b.inner_groove_radius)
    assert section_picture(b, tmp_path / "section.png").stat().st_size > 20_000
