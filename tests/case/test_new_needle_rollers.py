"""A new case of a needle roller bearing: names, needles inferred from ratings against what makers
publish and the inference does not read, and a full complement."""

from math import pi

import pytest

from flexcage.case import catalogue, load_case, load_static
from flexcage.case.new import new_case
from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.geometry.full_complement import filling_count
from flexcage.static import solve_static


def made_of(designation):
    entry = catalogue.find(designation)
    return new_case(entry.outline, entry.source)


@pytest.mark.parametrize(
    ("designation", "same"),
    [
        ("HK 2016", "HK2016"),
        ("hk2016", "HK2016"),
        ("NK 20/16", "NK20/16"),
        ("nk20/16-XL", "NK20/16"),
        ("NKI 20/16", "NKI20/16"),
        ("RNA 4904", "RNA4904"),
        ("NA 49/22", "NA49/22"),
        ("HN 2016", "HN2016"),
    ],
)
def test_names_of_needle_bearings(designation, same):
    found, plain = catalogue.find(designation), catalogue.find(same)
    assert found.outline.boundary == plain.outline.boundary
    assert found.outline.dynamic_rating == plain.outline.dynamic_rating


@pytest.mark.parametrize(
    ("designation", "words"),
    [
        ("HK2016-2RS", "seals, which take their place from the needles"),
        ("HK2099", "not in the catalogue; the nearest known one"),
        ("NKIA 5904", "a needle roller bearing combined with a ball bearing"),
        ("K20x24x13", "without rings"),
        ("HK2016 C3", "knows none of bearings of type 'drawn_cup_needle_roller'"),
    ],
)
def test_what_there_is_not_is_said(designation, words):
    with pytest.raises(InputError, match=words):
        catalogue.find(designation)


@pytest.mark.parametrize("pair", [("RNA4904", "NA4904"), ("NK24/16", "NKI20/16")])
def test_a_bearing_with_an_inner_ring_has_the_needles_of_the_one_without(pair):
    without, ringed = (made_of(name).chosen.bearing for name in pair)
    assert not without.has_inner_ring and ringed.has_inner_ring
    for key in ("roller_count", "roller_diameter", "effective_length", "outer_race_diameter"):
        assert getattr(without, key) == getattr(ringed, key)


@pytest.mark.parametrize("width", [12, 16, 20])
def test_one_cup_holds_as_many_needles_whatever_its_width(width):
    """By NTN's ratings C0 of HK2012, HK2016 and HK2020 (CAT. No. 2300/E: 13.0, 20.1, 27.1 kN) a mm
    of length adds 1.76 kN, 22.0 needles of 2 mm; SKF's ratings tell 21 or 22, each by itself."""
    bearing = made_of(f"HK20{width}").chosen.bearing
    assert bearing.roller_diameter == 2e-3
    assert 1.76e3 / (44.0 * (10.0 / 11.0) * 2.0) == pytest.approx(22.0, abs=0.05)
    assert bearing.roller_count in (21, 22)


def test_races_are_those_of_makers_needle_cages():
    """SKF lists needle cages K of F x E: E of HK0810 to HK4520 is F + 2 Dw of one of them."""
    listed = {8: {11, 12}, 10: {13, 14, 16}, 15: {18, 19, 20, 21}, 20: {24, 26, 28, 30},
              25: {29, 30, 31, 32, 33, 35}, 30: {34, 35, 37, 40}, 45: {49, 50, 52, 53}}  # fmt: skip
    for name in ("HK0810", "HK1010", "HK1516", "HK2020", "HK2520", "HK3020", "HK4520"):
        b = made_of(name).chosen.bearing
        assert round(1e3 * b.outer_race_diameter) in listed[round(1e3 * b.bore)]


@pytest.mark.parametrize(("name", "published"), [("HN2016", 22.0), ("HN2020", 29.5)])
def test_the_mass_of_cup_and_needles_is_the_maker_s(name, published):
    """Masses [g] are published, and not read by the inference. Lips count as rings."""
    b = made_of(name).chosen.bearing
    assert b.roller_count == filling_count(b.roller_diameter, b.pitch_diameter)
    lips = 0.25 * pi * (b.outer_race_diameter**2 - b.rib_diameter**2) * (b.width - b.rib_gap)
    mass = b.outer_ring_mass + b.material.density * lips + b.roller_count * b.roller_mass
    assert 1e3 * mass == pytest.approx(published, rel=0.06)


def test_a_full_complement_is_written_and_solved():
    made = made_of("HN2016")
    assert 'model = "none"' in made.text and made.chosen.makers_factor == pytest.approx(0.906, 1e-2)
    case = load_static(made.text)
    assert solve_static(case).elements.force[0, 0] > 0.0
    assert load_case(made.text).bearing.roller_count == 34


def test_a_closed_end_is_told(tmp_path, capsys):
    out = tmp_path / "bk.toml"
    assert main(["new", "BK2016", "-o", str(out)]) == 0
    assert "its closed end counts as a lip" in capsys.readouterr().out
    cup = load_case(out)
    assert cup.bearing.type == "drawn_cup_needle_roller"
    assert cup.cage.width < cup.bearing.rib_gap
    assert cup.bearing.land(cup.cage).clearance == pytest.approx(0.15e-3, abs=1e-5)


def test_dimensions_and_ratings_of_another_maker(tmp_path):
    out = tmp_path / "own.toml"
    words = ["new", "--type", "drawn_cup_needle_roller", "--bore", "20 mm", "--outside", "26 mm"]
    words += ["--width", "16 mm", "--dynamic", "13 kN", "--static", "20.1 kN", "-o", str(out)]
    assert main(words) == 0
    assert load_case(out).bearing.roller_count == 22
