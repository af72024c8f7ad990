"""Tapered roller bearings: cones, masses, ratings and what is refused."""

from dataclasses import replace
from math import asin, atan, cos, pi, radians, sin, tan

import numpy as np
import pytest
from tapered_bearings import BEARING, MM

from flexcage import load_static
from flexcage.bearings.tapered_roller.frustum import Frustum
from flexcage.bearings.tapered_roller.ratings import static_equivalent_load
from flexcage.core.errors import InputError
from flexcage.geometry.fits.changed import Changed
from flexcage.geometry.kinematics import epicyclic
from flexcage.static import solve_static

RPM = pi / 30.0


@pytest.mark.parametrize("diameter", [2.0, 6.2, 9.0])
@pytest.mark.parametrize("angle", [8.0, 14.0, 28.0])
def test_races_and_rollers_share_one_apex(diameter, angle):
    """Every line of contact, drawn on, meets the bearing's axis at one place."""
    b = replace(BEARING, roller_diameter=diameter * MM, contact_angle=radians(angle))
    eps, beta, r = b.half_angle, b.axis_angle, 0.5 * diameter * MM
    middle = np.array([0.0, 19.5 * MM])
    across, along = np.array([sin(beta), cos(beta)]), np.array([cos(beta), -sin(beta)])
    apex = middle + b.apex_distance * along
    assert apex[1] == pytest.approx(0.0, abs=1e-12)
    assert tan(eps) == pytest.approx(r / b.apex_distance)
    for side, half in ((-1.0, b.race_angles[0]), (1.0, b.race_angles[1])):
        line = apex - (middle + side * r * across)
        assert atan(-line[1] / line[0]) == pytest.approx(half)
    assert b.race_angles[1] == radians(angle)


def test_nothing_slips_at_any_slice():
    """Orbit and spin of pure rolling give inner and outer race and roller one velocity all along
    their lines of contact."""
    b, inner = BEARING, 3000 * RPM
    found = epicyclic(
        element_diameter=b.element_diameter, pitch_diameter=b.pitch_diameter,
        element_count=b.element_count, inner_speed=inner, contact_angle=b.nominal_contact_angle,
    )  # fmt: skip
    for x in (-4 * MM, 0.0, 4 * MM):
        shrink = 1.0 - x / b.apex_distance
        roller = 0.5 * b.roller_diameter * shrink
        own = found.element_spin_in_cage * roller
        races = [0.5 * d * shrink for d in b.race_diameters]
        assert races == [0.5 * b.race_diameter(side, x) for side in ("inner", "outer")]
        # along the tangent, relative to the cage: the roller turns against the inner race
        assert -own == pytest.approx((inner - found.cage_speed) * races[0])
        assert own == pytest.approx(-found.cage_speed * races[1])


def test_mass_and_inertia_are_those_of_thin_discs():
    made = Frustum(mean=3.1 * MM, length=9.5 * MM, half_angle=radians(2.5))
    x = (np.arange(20000) + 0.5) / 20000 * made.length - 0.5 * made.length
    r = np.array([made.radius(at) for at in (x[0], x[-1])])
    radius = np.interp(x, [x[0], x[-1]], r)
    disc = pi * radius**2 * made.length / len(x)
    centre = (disc * x).sum() / disc.sum()
    assert made.volume == pytest.approx(disc.sum(), rel=1e-7)
    assert made.centre == pytest.approx(centre, rel=1e-6) and centre < 0.0
    axial, transverse = made.inertia(7800.0)
    assert axial == pytest.approx(7800.0 * (0.5 * disc * radius**2).sum(), rel=1e-7)
    thin = 0.25 * radius**2 + (x - centre) ** 2
    assert transverse == pytest.approx(7800.0 * (disc * thin).sum(), rel=1e-6)


def test_a_roller_without_taper_is_a_cylinder():
    made = Frustum(mean=3 * MM, length=9 * MM, half_angle=0.0)
    mass = 7800.0 * pi * 9e-6 * 9e-3
    assert made.inertia(7800.0) == pytest.approx((0.5 * mass * 9e-6, mass * (27e-6 + 81e-6) / 12))
    assert made.centre == 0.0


def test_the_rib_meets_the_sphere_at_right_angles():
    b = BEARING
    along, across = b.rib_place
    centre = -0.5 * b.roller_length + b.end_radius  # of the sphere, on the roller's axis
    assert np.hypot(along - centre, across) == pytest.approx(b.end_radius)
    assert b.rib_angle == pytest.approx(asin(-across / b.end_radius))
    # halfway up a rib that begins at the large end's edge on the inner race
    assert -across == pytest.approx(b.roller.ends[0] - 0.6 * MM)
    assert b.rib_contact.rolling > b.rib_contact.transverse  # the rib's cone is hollow
    assert replace(b, end_radius=0.999 * b.apex_to_end).rib_contact.rolling > 0.5  # it fits snugly


def test_ratings_are_those_of_the_standards():
    """ISO 76 and ISO 281 written out for Z = 17, Dwe = 6.2 mm, Lwe = 8.8 mm; f_c of the standard's
    table is 87.7 at gamma = 0.14 and 88.5 at 0.16."""
    b, angle = BEARING, radians(14.0)
    gamma = 6.2 * cos(angle) / 39.0
    assert 0.14 < gamma < 0.16
    static = 44.0 * (1.0 - gamma) * 17 * 8.8 * 6.2 * cos(angle)
    assert b.static_rating == pytest.approx(static)
    size = 1.1 * (8.8 * cos(angle)) ** (7 / 9) * 17**0.75 * 6.2 ** (29 / 27)
    assert 87.7 * size < b.dynamic_rating < 88.5 * size
    assert b.rating_names == ("C0r", "Cr")


def test_equivalent_loads_by_e_and_y():
    """ISO 281: e = 1.5 tan(alpha), X = 0.4, Y = 0.4 cot(alpha); NSK prints e = 0.37, Y = 1.6 and
    Y0 = 0.88 of its HR30205J, whose contact angle is 14.036 degrees (ISO 355, series 3CC)."""
    b = replace(BEARING, contact_angle=radians(14.0 + 2.166 / 60.0))
    assert b.equivalent_load(1000.0, 370.0).load == 1000.0
    beyond = b.equivalent_load(1000.0, 2000.0)
    assert (beyond.radial_factor, round(beyond.axial_factor, 2)) == (0.4, 1.6)
    assert beyond.load == pytest.approx(400.0 + beyond.axial_factor * 2000.0)
    at_e = b.equivalent_load(1000.0, 1.5 * tan(b.contact_angle) * 1000.0 * (1 + 1e-9)).load
    assert at_e == pytest.approx(1000.0)  # no step
    assert static_equivalent_load(b, 0.0, 1000.0) == pytest.approx(880.0, rel=1e-3)
    assert static_equivalent_load(b, 1000.0, 10.0) == 1000.0


@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"pitch_diameter": 60 * MM}, "must be between bore, 25 mm, and outside_diameter, 52 mm"),
        ({"inner_width": 17 * MM}, "inner_width is 17 mm, wider than the whole bearing, 16.25 mm"),
        ({"effective_length": 9.6 * MM}, "longer than the roller itself, 9.5 mm"),
        ({"roller_length": 17 * MM}, "longer than the bearing is wide"),
        ({"roller_count": 20}, "at most 19 fit"),
        ({"rib_height": 0.6 * MM}, "where their ends have chamfers of 0.35 mm"),
        ({"rib_height": 7 * MM}, "at their large ends; give less"),
        ({"end_radius": 200 * MM}, "its distance from the apex"),
        ({"end_radius": 3 * MM}, "must be between the radius of a roller's large end"),
        ({"bore": 32 * MM}, "in diameter at the rollers' small ends; give less"),
        ({"outside_diameter": 47 * MM}, "in diameter at the rollers' large ends; give more"),
    ],
)
def test_the_impossible_is_refused_in_one_sentence(change, words):
    made = replace(BEARING, **change)
    with pytest.raises(InputError) as caught:
        made.check()
    assert words in str(caught.value)


def case(**bearing):
    own = {
        "type": "tapered_roller", "bore": "25 mm", "outside_diameter": "52 mm", "width": "16.25 mm",
        "inner_width": "15 mm", "outer_width": "13 mm", "contact_angle": "14 deg",
        "pitch_diameter": "39 mm", "roller_diameter": "6.2 mm", "roller_length": "9.5 mm",
        "effective_length": "8.8 mm", "roller_count": 17, "rib_height": "1.2 mm",
        "end_radius": "76 mm", **bearing,
    }  # fmt: skip
    return {"bearing": own, "load": {"axial": "1 kN"}}


@pytest.mark.parametrize(
    ("table", "words"),
    [
        (case(contact_angle="50 deg"), "contact_angle is 50 deg"),
        (case(cup_angle="14 deg"), "contact angle is that of the outer race"),
        (case(radial_clearance="10 um"), "give its preload as load.axial"),
        ({**case(), "load": {"axial": "-1 kN"}}, "towards +x alone, into the outer ring"),
        ({**case(), "fit": {"clearance": "C3"}}, "has no classes of tapered roller bearings"),
    ],
)
def test_what_a_case_cannot_have_is_said(table, words):
    with pytest.raises(InputError) as caught:
        solve_static(load_static(table))
    assert words in str(caught.value)


def test_fits_bring_the_rings_together_by_a_wedge():
    """Races and rollers that grow, rollers that rest on the inner race and its rib and touch the
    outer race: contacts along their normals, solved for the rollers' and the ring's places."""
    b, grown = BEARING, (12e-6, -5e-6, 3e-6)  # of inner race, outer race, rollers; diameters
    changed = Changed(
        inner_race=grown[0], outer_race=grown[1], element=grown[2], inner_strain=0.0,
        outer_strain=0.0, initial=0.0, clearance=grown[1] - grown[0] - 2 * grown[2],
    )  # fmt: skip
    after = b.in_place(changed)
    after.check()
    assert after.roller_diameter - b.roller_diameter == pytest.approx(3e-6)
    beta, eps, eta = b.axis_angle, b.half_angle, b.rib_angle
    x, r = np.array([cos(beta), sin(beta)]), np.array([-sin(beta), cos(beta)])  # in (s, t)
    inner, rib = np.array([-sin(eps), cos(eps)]), np.array([cos(eta), sin(eta)])
    outer, more = np.array([sin(eps), cos(eps)]), 0.5 * grown[2] * cos(eps)
    lifted = 0.5 * grown[0] * r
    # unknown: the roller's place (2,), and how far the ring is along x
    equations = np.array([
        [*inner, -inner @ x], [*rib, -rib @ x], [*outer, 0.0],
    ])  # fmt: skip
    known = [inner @ lifted + more, rib @ lifted, 0.5 * grown[1] * cos(b.contact_angle) - more]
    place = np.linalg.solve(equations, known)
    assert b.approach(after, changed) == pytest.approx(-place[2], rel=2e-3)
    told = solve_static(load_static({**case(), "fit": {"shaft": "n5", "housing": "P6"}}))
    assert told.mounting.approach > 5e-6 and told.mounting.angles is None
    assert not any("preload" in warning for warning in told.warnings)
