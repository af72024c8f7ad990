"""Needle roller bearings: what they can be, their ratings, and how they sit."""

from dataclasses import replace
from math import pi

import numpy as np
import pytest
from needle_rollers import CAGE, CUP, CUP_CASE, FULL, RINGED

from flexcage.case import load_static
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import BEARING_TYPES
from flexcage.static import solve_static


def test_their_types_are_known_by_name():
    names = ("needle_roller", "drawn_cup_needle_roller")
    assert [BEARING_TYPES[name] for name in names] == [type(RINGED), type(CUP)]
    assert CUP.name_and_size == "A drawn cup needle roller bearing of 20 × 26 × 16 mm"


@pytest.mark.parametrize("bearing", [CUP, RINGED, FULL])
def test_such_bearings_of_makers_are_possible(bearing):
    bearing.check()


def test_a_cage_lies_between_the_lips_and_faces_the_races():
    CUP.check(CAGE)
    inner, outer = CUP.cage_space(CAGE)
    assert (inner.name, outer.name) == ("the inner race", "the outer race")
    land = CUP.land(CAGE)
    assert land.clearance == pytest.approx(0.5 * (24e-3 + 10e-6 - CAGE.outside_diameter))
    assert land.end == pytest.approx(0.5 * CAGE.width)
    with pytest.raises(InputError, match="lies between the ribs, 14.2 mm apart"):
        CUP.check(replace(CAGE, width=14.2e-3))


@pytest.mark.parametrize(
    ("bearing", "changes", "words"),
    [
        (CUP, {"roller_length": 4.9e-3, "effective_length": 4.5e-3}, "2.45 times the diameter"),
        (CUP, {"roller_length": 21e-3, "width": 25e-3, "rib_gap": 23e-3}, "2.5 to 10 times"),
        (CUP, {"bore": 20.5e-3}, "or the same without an inner ring"),
        (CUP, {"outside_diameter": 24.5e-3}, "a wall of 0.25 mm"),
        (CUP, {"outside_diameter": 30e-3}, "is 0.3 mm to 2.5 mm thick"),
        (RINGED, {"outside_diameter": 32.9e-3}, "a wall of 0.45 mm"),
        (CUP, {"rib_gap": 11.7e-3}, "greater than the roller's length"),
        (CUP, {"rib_diameter": 19.9e-3}, "inner_race_diameter"),
    ],
)
def test_impossible_needle_bearings_are_refused(bearing, changes, words):
    with pytest.raises(InputError, match=words):
        replace(bearing, **changes).check()


def test_ratings_follow_iso_76_and_281():
    """C0 by hand; drawn cups without the b_m = 1.1 of machined rings."""
    assert CUP.static_rating == pytest.approx(44.0 * (10.0 / 11.0) * 22 * 11.4 * 2.0, rel=1e-12)
    machined = replace(RINGED, **{f: getattr(CUP, f) for f in vars(CUP) if f != "type"})
    assert machined.dynamic_rating == pytest.approx(1.1 * CUP.dynamic_rating, rel=1e-12)


def test_a_catalogue_s_ratings_come_out_of_needles_as_makers_build_them():
    """HK2012, HK2016 and HK2020 of NTN (CAT. No. 2300/E): 13.0, 20.1 and 27.1 kN, needles 4.2 mm
    shorter than the cup; C with the b_m of machined rings: 9.25, 13.0 and 16.4 kN."""
    for width, static, dynamic in ((12, 13.0, 9.25), (16, 20.1, 13.0), (20, 27.1, 16.4)):
        length = (width - 4.2) * 1e-3
        made = replace(CUP, width=width * 1e-3, roller_length=length,
                       effective_length=length - 0.4e-3, rib_gap=length + 2.4e-3)  # fmt: skip
        assert made.static_rating == pytest.approx(1e3 * static, rel=3e-3)
        assert 1.1 * made.dynamic_rating == pytest.approx(1e3 * dynamic, rel=6e-3)


def test_needle_bearings_carry_no_axial_load():
    assert "carries no axial load" in CUP.axial_refusal(1.0)
    assert CUP.axial_refusal(0.0) == "" and not any(CUP.carried)
    with pytest.raises(InputError, match="needle roller bearings for radial load alone"):
        CUP.equivalent_load(600.0, 10.0)
    with pytest.raises(InputError, match="carries no axial load"):
        solve_static(load_static(CUP_CASE + 'axial = "10 N"\n'))


def test_without_an_inner_ring_the_shaft_turns_instead():
    assert not CUP.has_inner_ring and RINGED.has_inner_ring
    steel = CUP.material.density
    assert CUP.inner_ring_mass == pytest.approx(steel * 0.25 * pi * 20e-3**2 * 16e-3)
    area = 0.25 * pi * (25e-3**2 - 20e-3**2)
    assert RINGED.inner_ring_mass == pytest.approx(steel * area * 17e-3)
    with pytest.raises(InputError, match="the bearing has no inner ring"):
        load_static(CUP_CASE + '[inner_ring]\nring = "flexible"\n')


def test_frequencies_are_those_of_rolling():
    """The cage of needles of 2 mm between 20 and 24 mm turns by 20/44 of the shaft's speed."""
    text = solve_static(load_static(CUP_CASE + '[drive]\nspeed = "3000 rpm"\n')).table(100)
    row = next(line for line in text.splitlines() if line.startswith("pure rolling"))
    found = [float(word) for word in row.split()[2:]]
    spin = 0.5 * 50.0 * (11.0 - 1.0 / 11.0)
    cage = 50.0 * 20.0 / 44.0
    due = [cage, 50.0, spin, 2.0 * spin, 22 * cage, 22 * (50.0 - cage)]
    assert found == pytest.approx(due, rel=1e-4)


def clearance(text, part, at=1):
    return 1e6 * load_static(CUP_CASE + "[fit]\n" + text).mounting.part(part).values[at]


def test_the_shaft_s_tolerance_is_the_inner_race():
    """h6 of 20 mm is 0 to -13 um, and nothing of it is smoothed away; a warm shaft grows whole."""
    assert [clearance('shaft = "h6"\n', "inner_fit", k) for k in range(3)] == pytest.approx(
        [0.0, 6.5, 13.0]
    )
    assert clearance('shaft = "h6"\n', "smoothing") == 0.0
    warm = 'shaft = "h6"\ninner_temperature = "60 degC"\nelement_temperature = "20 degC"\n'
    assert clearance(warm, "temperature") == pytest.approx(-12e-6 * 40.0 * 20e3, rel=0.05)
    case = load_static(CUP_CASE + '[fit]\nshaft = "h6"\n')
    assert case.mounted.bearing.inner_race_radius == pytest.approx(
        0.5 * (20e-3 - 6.5e-6) - 0.25 * 30e-6
    )
    assert not case.mounted.bearing.has_inner_ring
    assert "Shaft, which is the inner race: -6.5 um beyond" in solve_static(case).table(100)


def test_a_pressed_cup_passes_its_interference_on_to_the_race():
    """By Lame: a steel cylinder of 26 mm with the cup's section, in a block without end."""
    found = clearance('housing_interference = "30 um"\nsmoothing = "none"\n', "outer_fit")
    lips = 2 * 0.9 * 1.5  # mm2: two lips of 0.9 mm, from 24 to 21 mm in diameter
    share = ((26.0 - 2.0 * (16.0 + lips) / 16.0) / 26.0) ** 2
    nu = CUP.material.poisson_ratio
    inside = ((1.0 + share) / (1.0 - share) - nu) + (1.0 + nu)  # d p/E of both bodies
    p = 30.0 / (26.0 * inside)
    race = -p * ((1.0 - nu) * 24.0 + (1.0 + nu) * share * 26.0**2 / 24.0) / (1.0 - share)
    assert found == pytest.approx(race, rel=1e-3)
    assert -30.0 < found < -0.85 * 30.0


def test_a_drawn_cup_has_no_tolerance_of_its_own():
    with pytest.raises(InputError, match="takes its shape from the housing"):
        load_static(CUP_CASE + '[fit]\nhousing = "N6"\n')


def test_the_load_zone_bears_the_load():
    solution = solve_static(load_static(CUP_CASE))
    force = solution.elements.force[:, 0]
    azimuth = solution.elements.azimuth
    assert force @ np.cos(azimuth) == pytest.approx(600.0, rel=1e-6)
    assert (force > 0.0).sum() == 3
