"""Ribbon cages: what their dimensions mean, and what is refused."""

from dataclasses import replace
from math import acos, asin, degrees, hypot, sqrt
from types import SimpleNamespace

import numpy as np
import pytest

from flexcage.cages.ribbon.cage import RibbonCage
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.case import load_case
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError

PRESET = load_preset("15x37x10")
CAGE = PRESET.cage
MM = 1e-3


def case(*more, defects=""):
    lines = ['[bearing]\npreset = "15x37x10"', "[cage]", *more, '[load]\nradial = "10 N"', defects]
    return load_case("\n".join(lines))


def test_the_preset_is_a_ribbon_cage():
    assert type(CAGE) is RibbonCage and CAGE.type == "ribbon"
    assert CAGE.opening == pytest.approx(sqrt(3.45**2 - 3.25**2) * MM)
    assert CAGE.reach == pytest.approx(3.25 * MM)
    closed = replace(CAGE, width=6.9 * MM)
    assert closed.opening == 0.0 and closed.reach == pytest.approx(4.25 * MM)


def test_the_bend_touches_sheet_and_sphere():
    """Its arc's middle lies a bend's radius above the flat and outside the sphere."""
    cage = replace(CAGE, bend_radius=0.3 * MM)
    x, rho = cage.bend_centre
    assert x == pytest.approx(cage.thickness + 0.3 * MM)
    assert hypot(x, rho) == pytest.approx(0.5 * cage.pocket_diameter + cage.thickness + 0.3 * MM)
    assert CAGE.bend == 0.5 * CAGE.thickness


def test_walls_end_where_the_spheres_meet_bore_outside_and_sides():
    """In front of the ball, at the azimuth whose chord and height reach that radius."""
    outward, inward, along, rear = CAGE.wall_ends(13.0 * MM, 3.45 * MM)
    for radius, sine in ((14.6, outward), (11.4, -inward)):
        point = np.array([13.0 + 3.45 * sine, 3.45 * sqrt(1.0 - sine**2)])
        assert np.linalg.norm(point) == pytest.approx(radius)
    assert rear == along
    assert degrees(acos(along)) == pytest.approx(degrees(asin(CAGE.opening / (3.45 * MM))))
    assert replace(CAGE, width=7.0 * MM).wall_ends(13.0 * MM, 3.45 * MM)[2] > 1.0


def test_a_case_may_ask_for_the_other_kind():
    """Values of the preset's cage that the other kind has not are left out."""
    machined = case('type = "machined"', 'width = "9 mm"').cage
    assert type(machined) is BallCage and machined.pocket_diameter == CAGE.pocket_diameter
    with pytest.raises(InputError, match="lacks 'thickness'"):
        load_case('[bearing]\npreset = "7010C-PI"\n[cage]\ntype = "ribbon"\n[load]\naxial = "9 N"')


def test_assumptions_of_a_preset_whose_cage_is_another():
    """Those of values that the other kind has not are left out."""
    other = case('type = "machined"', 'width = "9 mm"')
    assert "cage.bore" in other.assumptions and "cage.thickness" not in other.assumptions
    assert "cage.thickness" in case().assumptions


def test_round_trip_and_hash():
    first = case('thickness = "0.7 mm"')
    assert load_case(first.to_toml()) == first
    assert first.hash != case().hash
    assert "ribbon" in first.to_toml() and "riveted" in " ".join(words(first))


def words(case):
    from flexcage.case.description import in_words

    return in_words(case)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ('width = "4.4 mm"', "cage.width is 4.4 mm.*cut the sheet through.*exceed 6.12975"),
        ('width = "6.899 mm"', "cage.width, 6.899 mm, leaves holes.*as wide as they are"),
        ('thickness = "2 mm"', "leave no flats between them"),
        (
            'rivet_diameter = "3 mm"',
            "cage.rivet_diameter is 3 mm, but .* leave flats of 2.29599 mm alone",
        ),
        ('bend_radius = "0 mm"', "cage.bend_radius is 0 mm, but must be greater"),
        ('pocket_shape = "cylindrical"', "'cylindrical' is not known; choose from spherical"),
        ('pocket_scatter = "10 um"', "pocket_scatter, 0.01 mm, is of machined cages"),
        ('guidance = "outer"', "'outer' is not known; choose from ball"),
        ('type = "ribon"', "cage.type 'ribon' is not known; the nearest known one is 'ribbon'"),
        ('bore = "30 mm"', "from 30 mm to 29.2 mm in diameter does not hold the balls"),
    ],
)
def test_impossible_cages(values, sentence):
    with pytest.raises(InputError, match=sentence):
        case(values)


def test_a_neck_of_a_hair_is_refused():
    """One of 0.04 um, which a random cage had: gmsh cannot mesh it."""
    cage = RibbonCage(
        bore=76.58501869832378e-3, outside_diameter=93.89861917669731e-3,
        pocket_diameter=13.892404711693042e-3, thickness=1.5342491779592143e-3,
        width=10.786923275237075e-3, rivet_diameter=2.1829632201513143e-3,
    )  # fmt: skip
    around = SimpleNamespace(
        pitch_diameter=85.33960331304474e-3, element_count=12, element_diameter=0.0, element="ball"
    )
    (key, sentence), = cage.obstructions(around)  # fmt: skip
    assert key == "width" and "cut the sheet through, or nearly" in sentence
    assert not list(replace(cage, width=10.9e-3).obstructions(around))


@pytest.mark.parametrize(
    ("defect", "sentence"),
    [
        ('type = "missing_rivet"\nweb = 7', "defects.0.web is 7, but .* numbered 0 to 6"),
        (
            'type = "crack"\nweb = 1\nshare = 0.3',
            "'crack', .* one of the ribbon cages, whose defects are 'missing_rivet'",
        ),
    ],
)
def test_impossible_defects(defect, sentence):
    with pytest.raises(InputError, match=sentence):
        case(defects="[[defects]]\n" + defect)


def test_two_defects_of_one_web_and_machined_cages_without_rivets():
    twice = '[[defects]]\ntype = "missing_rivet"\nweb = 1\n' * 2
    with pytest.raises(InputError, match="Web 1 has 2 missing rivets"):
        case(defects=twice)
    webs = "".join(f'[[defects]]\ntype = "missing_rivet"\nweb = {k}\n' for k in range(7))
    with pytest.raises(InputError, match="All 7 rivets are missing"):
        case(defects=webs)
    with pytest.raises(InputError, match="'missing_rivet', .* one of the machined cages, whose"):
        case('type = "machined"', 'width = "9 mm"', defects=twice[: len(twice) // 2])
