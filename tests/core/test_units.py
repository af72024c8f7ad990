"""Units at the border: pint is the authority, text is exact, mistakes are sentences."""

import math

import pytest

from flexcage.core import units
from flexcage.core.errors import InputError
from flexcage.core.units import format_si, parse


@pytest.fixture(scope="module")
def registry():
    import pint

    return pint.UnitRegistry()  # as it comes, where angles have no dimension


@pytest.mark.parametrize("unit", sorted(units._COMMON))
def test_everyday_table_agrees_with_pint(unit, registry):
    quantity = registry.Quantity(1.0, unit).to_base_units()
    _, power, factor = units._COMMON[unit]
    zero = float(units._ZEROS.get(unit, 0))
    assert math.isclose(10.0**power * factor + zero, quantity.magnitude, rel_tol=1e-14)


@pytest.mark.parametrize("unit", sorted(units._COMMON))
def test_units_of_one_kind_have_one_dimension(unit, registry):
    kind = units._COMMON[unit][0]
    first = next(u for u, row in units._COMMON.items() if row[0] == kind)
    dimension = registry.Quantity(1.0, unit).dimensionality
    assert dimension == registry.Quantity(1.0, first).dimensionality


@pytest.mark.parametrize(
    ("text", "unit", "value"),
    [
        ("78.4 mm", "mm", 0.0784),
        ("0.2mm", "mm", 0.0002),
        ("200 um", "mm", 0.0002),
        ("-0.3 mm", "mm", -0.0003),
        ("1 inch", "mm", 0.0254),
        ("6000 rpm", "rpm", 200.0 * math.pi),
        ("100 turn/s", "rpm", 200.0 * math.pi),
        ("1 kN", "N", 1000.0),
        ("180 deg", "deg", math.pi),
        ("20 1/GPa", "1/GPa", 2e-8),
        ("1 cP", "Pa*s", 1e-3),
        ("8.5 g/cm^3", "kg/m^3", 8500.0),
        ("40 degC", "K", 313.15),
        ("inf MPa", "MPa", math.inf),
    ],
)
def test_text_becomes_si(text, unit, value):
    assert parse(text, unit) == pytest.approx(value, rel=1e-15)


def test_decimal_text_is_read_exactly():
    """Not the neighbouring float: 78.4/1000 in floats is 0.07840000000000001."""
    assert parse("78.4 mm", "mm") == 0.0784


@pytest.mark.parametrize(
    ("text", "unit", "words"),
    [
        (5, "mm", ["a.b is 5 without a unit", "'5 mm'"]),
        (0.2, "mm", ["'0.2 mm'"]),
        ("5", "mm", ["without a unit", "'5 mm'"]),
        ("5 kg", "mm", ["another kind", "mm"]),
        ("5 foo", "mm", ["'foo' is not a known unit", "mm"]),
        ("five mm", "mm", ["'1 mm'"]),
        ("", "mm", ["'1 mm'"]),
        (None, "mm", ["'1 mm'"]),
        (True, "mm", ["True"]),
        ("100 Hz", "rpm", ["revolutions or radians", "'100 rev/s'", "'100 rad/s'"]),
        ("2 kHz", "rpm", ["'2000 rev/s'", "'2000 rad/s'"]),
        ("3 1/s^2", "rad/s^2", ["'3 rev/s^2'", "'3 rad/s^2'"]),
        ("60 rpm", "Hz", ["another kind", "cycles a second"]),
        ("5 N*m", "N*m/rad", ["another kind", "name the angle"]),
        ("5 N*m/rad", "N*m", ["another kind", "leave the angle out"]),
        ("32 cSt", "Pa*s", ["kinematic", "density"]),
        ("1 ton", "kg", ["1000 kg", "2000 lb"]),
        ("1,000 N", "N", ["'1.000 N'", "'1000 N'"]),
        ("1 000 N", "N", ["without marks, and decimals with a point: '1000 N'."]),
        ("1\u202f000,5N", "N", ["'1000.5 N'."]),
        ("6'000 rpm", "rpm", ["'6000 rpm'."]),
        ("6_000 rpm", "rpm", ["'6000 rpm'."]),
        ("-6.000,25 N", "N", ["'-6000.25 N'."]),
        ("6,000.25 N", "N", ["'6000.25 N'."]),
        ("6.000.000 N", "N", ["'6000000 N'."]),
        ("6,000,000 N", "N", ["'6000000 N'."]),
        ("0,15 mm", "mm", ["write '0.15 mm', with a point."]),
        ("12,5 N", "N", ["write '12.5 N', with a point."]),
        (math.nan, "N", ["is nan, but should be a number with a unit, such as '1 N'"]),
        ("1e999999999999999999999 mm", "mm", ["too large"]),
        ("-1e999999999999999999999 mm", "mm", ["too large"]),
        ("1e-999999999999999999999 mm", "mm", ["too small"]),
        ("1e400 inch", "mm", ["too large"]),
        ("1 2^9^9^9^9", "mm", ["not a known unit"]),
        ("1 m^999999999", "mm", ["not a known unit"]),
        ("1 " + "m*" * 50_000 + "m", "mm", ["not a known unit"]),
        ("5 mm +", "mm", ["mm"]),
        ("1 (", "mm", ["mm"]),
        ("nan mm", "mm", ["'1 mm'"]),
        ("5 N*m", "N/m", ["another kind"]),
    ],
)
def test_mistakes_are_one_sentence(text, unit, words):
    with pytest.raises(InputError) as caught:
        parse(text, unit, where="a.b")
    sentence = str(caught.value)
    assert sentence.startswith("a.b") and sentence.endswith(".") and "\n" not in sentence
    assert all(word in sentence for word in words)
    assert caught.value.where == "a.b"


@pytest.mark.parametrize("unit", ["mm", "rpm", "deg", "GPa", "1/GPa", "um", "lbf", "g*mm", "mrad"])
@pytest.mark.parametrize("value", [0.0, 0.0784, 0.0002, -1e-9, 628.3185307179587, 1 / 3, 2.1e11])
def test_text_of_a_value_reads_back_to_it(value, unit):
    assert parse(format_si(value, unit), unit) == pytest.approx(value, rel=1e-15, abs=0)


def test_one_point_parts_decimals():
    """TOML's own numbers have it so, and drawings: 65.000 mm is no 65 metres."""
    assert parse("6.000 N", "N") == 6.0 and parse("65.000 mm", "mm") == 0.065


def test_text_is_what_a_person_would_write():
    assert format_si(0.0784, "mm") == "78.4 mm"
    assert format_si(200.0 * math.pi, "rpm") == "6000 rpm"
    assert format_si(0.25 * math.pi, "deg") == "45 deg"
