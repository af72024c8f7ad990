"""Every spelling of every quantity that a case can hold: read for what it says, or refused."""

from __future__ import annotations

import dataclasses
import typing
from collections.abc import Iterator, Mapping
from math import atan, pi

import pytest

from flexcage.case import Case, load_case
from flexcage.case.static import StaticCase
from flexcage.core.binding import hints
from flexcage.core.errors import InputError
from flexcage.core.units import _COMMON, parse
from flexcage.geometry.bearing import BEARING_TYPES
from flexcage.render.look import Look
from flexcage.study.spec import Repeat

RPM, DEG = pi / 30.0, pi / 180.0
AMBIGUOUS = "revolutions or radians"
OTHER = "another kind"
UNKNOWN = "not a known unit"
GROUPS = "write thousands without marks"

# kind: value in SI, or words of the sentence that refuses, and the spellings that have it
SPELLINGS: dict[str, tuple[tuple[float | str, str], ...]] = {
    "angular speed": (
        (
            2.0 * pi,
            "60 rpm | 60 RPM | 60 r.p.m. | 60 1/min | 60 1 / min | 60/min | 60 /min | 60 min^-1 | "
            "60 min**-1 | 60 min-1 | 60 min⁻¹ | 60 rev/min | 60 revs/min | 60 U/min | 60 r/min | "
            "60 tr/min | 60 rot/min | 60 turns/min | 60 turn/minute | 60 revolutions/minute | 60 "
            "revolutions per minute | 60 cycles/min | 60 rev min^-1 | 0.06 krpm | 1 rev/s | 1 r/s "
            "| 1 U/s | 1 rps | 1 turn/s | 1 cycle/s | 3600 rev/h",
        ),
        (1.0, "1 rad/s | 1 rad s^-1 | 1 rad s⁻¹ | 1 rad*s-1 | 60 rad/min"),
        (DEG, "1 deg/s | 1 °/s | 60 deg/min"),
        (
            AMBIGUOUS,
            "1 1/s | 1 s^-1 | 1 s-1 | 1 s⁻¹ | 1/s | 1 Hz | 1 kHz | 1 1/h | 1 1/ms | 1 hertz",
        ),
        (OTHER, "1 m/s | 1 rad | 1 rpm/s | 1 deg | 1 min | 1 rad^2/s | 1 %"),
        (GROUPS, "6 000 rpm | 1_000 rpm"),
        (UNKNOWN, "1 u/mn | 1 100*rpm | 6000 rpm% | 1 Bq | 1 baud"),
    ),
    "angular acceleration": (
        (1.0, "1 rad/s^2 | 1 rad/s2 | 1 rad/s² | 1 rad s^-2 | 1 rad/s/s"),
        (2 * pi, "60 rpm/s | 1 rev/s^2 | 1 rev/s/s | 60 U/min/s | 3600 rev/min^2"),
        (DEG, "1 deg/s^2"),
        (AMBIGUOUS, "1 1/s^2 | 1 s^-2 | 1 Hz/s | 1 1/min^2 | 1 1/min/s"),
        (OTHER, "1 rpm | 1 m/s^2 | 1 rad/s"),
    ),
    "angle": (
        (
            pi,
            "180 deg | 180 ° | 180° | 180 degrees | 0.5 turn | 0.5 rev | 10800 arcmin | 200 gon | "
            "3.141592653589793 rad",
        ),
        (1e-3, "1 mrad"),
        (1e-6, "1 urad"),
        (DEG / 3600.0, "1 arcsec"),
        (atan(1e-3), "1 mm/m | 1 um/mm | 1 µm/mm"),
        (pi / 4.0, "1000 mm/m"),
        (OTHER, "1 % | 1 mm | 1 rad/s | 1 Hz/Hz | 1 N/mm"),
    ),
    "frequency": (
        (1.0, "1 Hz | 1 1/s | 1 s^-1 | 1 s⁻¹ | 0.001 kHz | 60 1/min | 1/s"),
        (1e6, "1 MHz"),
        (1e3, "1 1/ms"),
        ("cycles a second", "1 rpm | 1 rad/s | 1 rev/s | 1 deg/s | 1 U/min | 1 cycle/s"),
        (OTHER, "1 s | 1 m/s"),
    ),
    "moment": (
        (
            1.0,
            "1 N*m | 1 N m | 1 N·m | 1 Nm | 1000 N*mm | 1000 N mm | 1000 Nmm | 0.001 kN*m | 0.001 "
            "kNm | 1000 mN*m | 1000 mNm",
        ),
        (1.3558179483314, "1 lbf*ft"),
        (0.112984829027617, "1 lbf*in"),
        ("leave the angle out", "1 N*m/rad | 1 N*m*rad"),
        (OTHER, "1 N/m | 1 nm | 1 N | 1 lb*ft | 1 kg*m"),
        ("write 'Nm' or 'Nm\\*s'", "1 Nms"),
    ),
    "torsional stiffness": (
        (1.0, "1 N*m/rad | 1 Nm/rad | 1 N*m*rad^-1 | 1 N*mm/mrad | 1e-3 kN*m/rad"),
        (180.0 / pi, "1 N*m/deg"),
        (0.18 / pi, "1 N*mm/deg"),
        (0.5 / pi, "1 N*m/turn"),
        ("name the angle", "1 N*m | 1 N*mm | 1 J"),
        (OTHER, "1 N/m | 1 N*m*s/rad"),
        ("write 'Nm/rad' or 'Nm\\*s/rad', whichever is meant", "2000 Nms/rad"),
    ),
    "torsional damping": (
        (1.0, "1 N*m*s/rad | 1 N m s/rad | 1 Nm*s/rad | 1 N*m/(rad/s)"),
        (180.0 / pi, "1 N*m*s/deg"),
        (1e-3, "1 N*mm*s/rad"),
        (1.0 / RPM, "1 N*m/rpm"),
        ("name the angle", "1 N*m*s | 1 N*m/Hz"),
        (OTHER, "1 N*m/rad"),
        ("write 'Nm/rad' or 'Nm\\*s/rad'", "1 Nms/rad"),
    ),
    "length": (
        (1e-3, "1 mm | 1000 um | 1000 µm | 1000 μm | 1e6 nm | 0.1 cm | 1e-3 m"),
        (25.4e-3, "1 inch | 1 in"),
        (1e-6, "1 micron"),
        (25.4e-6, "1 thou"),
        (OTHER, "1 um/mm | 1 mm^2 | 1 mil | 1 Nm | 1 rad"),
        (UNKNOWN, "1 %mm | 1 % mm | 1 0mm"),
    ),
    "time": (
        (1.0, "1 s | 1 sec | 1000 ms | 1e6 us | 1e6 µs"),
        (60.0, "1 min"),
        (3600.0, "1 h"),
        ("leave the angle out", "1 s/rad | 1 rad*s | 1 1/rpm"),
        ("angle cancels", "1 rev/rpm"),
        (UNKNOWN, "1 shake | 1 fortnight"),
        (OTHER, "1 Hz | 1 rev | 1 m"),
    ),
    "speed": (
        (1.0, "1 m/s | 1000 mm/s | 1 m s^-1 | 60 m/min | 3.6 km/h | 1 m*Hz"),
        ("leave the angle out", "1 m*rad/s | 1 m*rpm"),
        (OTHER, "1 rpm | 1 m | 1 m/s^2 | 1 rad/s"),
    ),
    "inverse speed": (
        (1.0, "1 s/m | 0.001 s/mm | 1 s m^-1 | 1 s*m^-1 | 1 1/(m/s)"),
        (OTHER, "1 m/s | 1 s | 1 s/rad"),
    ),
    "acceleration": (
        (1.0, "1 m/s^2 | 1 m/s2 | 1 m/s² | 1000 mm/s^2"),
        (9.80665, "1 g_0"),
        (OTHER, "1 g | 1 rad/s^2 | 1 m/s"),
    ),
    "force": (
        (1.0, "1 N | 1e-3 kN | 1e-6 MN | 1 kg*m/s^2 | 1 N"),
        (9.80665, "1 kgf | 1 kp"),
        (10.0, "1 daN"),
        ("is 'kN' meant", "1 kn | 1 KN"),
        (4.4482216152605, "1 lbf"),
        (OTHER, "1 kg | 1 lb | 1 N*m | 1 N/mm"),
        (UNKNOWN, "1 kNn"),
        (GROUPS, "1 000 N"),
    ),
    "stiffness": (
        (1.0, "1 N/m | 1e-3 N/mm | 1e-6 N/um | 1e-6 N/µm | 1e-3 kN/m | 1 N*m^-1"),
        (OTHER, "1 N*m | 1 N*m/rad | 1 N/m^2 | 1 Nm | 1 lb/in"),
        ("is 'N/mm' meant", "200 N/Mm"),
    ),
    "stiffness per area": (
        (1e9, "1e9 N/m^3 | 1 N/mm^3 | 1 MPa/mm | 1e3 N/cm^3 | 1 kPa/um"),
        (OTHER, "1 N/m | 1 N/mm^2 | 1 MPa | 1 kg/m^3"),
    ),
    "damping": (
        (1.0, "1 N*s/m | 1e-3 N*s/mm | 1 N/(m/s) | 1 kg/s"),
        (OTHER, "1 N/m | 1 N*m*s/rad | 1 %"),
    ),
    "mass": (
        (1.0, "1 kg | 1000 g | 1e6 mg | 1e-3 t | 1e-3 tonne"),
        (0.45359237, "1 lb"),
        ("1000 kg or 2000 lb", "1 ton | 1 tons | 1 kton"),
        (OTHER, "1 N"),
    ),
    "density": (
        (
            7850.0,
            "7850 kg/m^3 | 7850 kg/m3 | 7850 kg/m³ | 7.85 g/cm^3 | 7.85 g/cm3 | 7.85 g/cc | 7.85 "
            "kg/dm^3 | 7.85 t/m^3 | 7.85e-9 t/mm^3 | 7.85e-6 kg/mm^3",
        ),
        ("1000 kg or 2000 lb", "1 ton/m^3"),
        (OTHER, "1 kg"),
    ),
    "pressure": (
        (1e6, "1 MPa | 1 N/mm^2 | 1 N/mm2 | 1 N/mm² | 1e-3 GPa | 1000 kPa | 10 bar"),
        (6894.757293168, "1 psi"),
        (1e-3, "1 mPa"),
        (OTHER, "1 N | 1 N/mm | 1 mPas | 1 Pa*s"),
        ("is 'MPa' or 'mPa' meant", "1 MPA"),
        ("write 'MPa' or 'MPa\\*s'", "320 MPas"),
    ),
    "pressure coefficient": (
        (2e-8, "20 1/GPa | 20 GPa^-1 | 20 GPa⁻¹ | 20/GPa | 2e-8 1/Pa | 0.02 mm^2/N"),
        (OTHER, "20 GPa | 20 1/s"),
    ),
    "kinematic viscosity": (
        (32e-6, "32 mm^2/s | 32 mm²/s | 32 cSt | 32e-6 m^2/s | 0.32 St"),
        (OTHER, "32 mPa*s | 32 mm/s"),
    ),
    "thermal expansion": (
        (12e-6, "12e-6 1/K | 12e-6/K | 1.2e-5 K^-1 | 12 um/(m*K) | 12 µm/m/K | 12e-6 1/°C"),
        (OTHER, "12 um/m | 12 K"),
    ),
    "power": (
        (20.0, "20 W | 0.02 kW | 20 J/s | 20 N m/s | 2e4 mW"),
        (OTHER, "20 J | 20 N*m | 20 W/K"),
        ("is 'W' meant", "20 w"),
    ),
    "thermal conductance": (
        (2.0, "2 W/K | 2 W/degC | 2 W/°C | 2 W K^-1 | 2e-3 kW/K"),
        (OTHER, "2 W | 2 W/m | 2 W/(m*K) | 2 W/mK | 2 K/W"),
    ),
    "heat transfer": (
        (
            5000.0,
            "5000 W/(m^2*K) | 5000 W/m^2/K | 5000 W/m²K | 5000 W/m^2K | 5000 W/m2K | 5000 W/m² K | "
            "5000 W/(m2 K) | 5000 W/(m²·K) | 5 kW/m²K | 5 kW/(m^2*K)",
        ),
        (OTHER, "5000 W/m^2 | 5000 W/K | 5000 W/mK"),
    ),
    "thermal conductivity": (
        (45.0, "45 W/(m*K) | 45 W/m/K | 45 W/mK | 45 W/m K | 45 W/(m·K) | 0.45 W/(cm K)"),
        (OTHER, "45 W/K | 45 W/m | 45 W/m²K"),
    ),
    "specific heat": (
        (
            470.0,
            "470 J/(kg*K) | 470 J/kg/K | 470 J/kgK | 470 J/kg K | 0.47 kJ/(kg K) | 0.47 kJ/kgK",
        ),
        (OTHER, "470 J/kg | 470 J/K"),
    ),
    "flow": (
        (1e-3 / 60.0, "1 l/min | 1 L/min | 1000 cm^3/min | 60 l/h | 1 dm^3/min | 1000 ml/min"),
        (OTHER, "1 l | 1 kg/s | 1 m/s"),
        (UNKNOWN, "1 lpm"),
    ),
    "viscosity": (
        (
            0.01,
            "0.01 Pa*s | 0.01 Pa s | 0.01 Pas | 10 mPa*s | 10 mPas | 10 mPa·s | 10 cP | 0.1 P | "
            "0.01 N*s/m^2 | 0.01 kg/(m*s)",
        ),
        ("by the oil's density", "10 cSt | 10 mm^2/s | 10 mm2/s | 1e-5 m^2/s"),
        (OTHER, "10 Pa"),
    ),
    "temperature": (
        (
            393.15,
            "120 degC | 120 °C | 120°C | 120 celsius | 120 degree_Celsius | 393.15 K | 393.15 "
            "kelvin | 248 degF | 248 °F | 120 ℃ | 120℃ | 248 ℉",
        ),
        (263.15, "-10 degC | 14 degF"),
        (273.15, "0 degC"),
        ("not a difference", "1 delta_degC | 1 Δ°C"),
        (OTHER, "120 deg | 120 °"),
        ("is 'degC' meant", "120 C"),
        (UNKNOWN, "96 deg Re | 707.67 degR | 707.67 °R"),
        ("below absolute zero, -273.15 degC", "-300 degC | -1 K | -500 °F"),
    ),
    "unbalance": (
        (1e-6, "1 g*mm | 1 g mm | 1 g·mm | 1000 mg*mm | 0.1 g*cm | 1e-6 kg*m"),
        (OTHER, "1 N*mm | 1 g | 1 g/mm"),
        (UNKNOWN, "1 gmm"),
    ),
    "density of acceleration": (
        (0.003, "0.003 m/s^2/Hz^0.5 | 3 mm/s^2/Hz^0.5"),
        (OTHER, "0.003 m/s^2 | 1 um/Hz^0.5"),
    ),
    "density of length": ((1e-6, "1 um/Hz^0.5 | 1e-3 mm/Hz^0.5"), (OTHER, "1 um | 1 um/Hz")),
    "density of moment": ((1e-3, "1 N*mm/Hz^0.5 | 0.001 N*m/Hz^0.5"), (OTHER, "1 N*mm")),
    "strain": ((5e-6, "5 um/m | 5 µm/m | 0.005 mm/m | 5 um m^-1"), (OTHER, "5 um | 5 um/m/Hz^0.5")),
    "density of strain": ((1e-8, "0.01 um/m/Hz^0.5 | 1e-5 mm/m/Hz^0.5"), (OTHER, "1 um/m")),
}
ROWS = [
    (kind, text, due)
    for kind, rows in SPELLINGS.items()
    for due, texts in rows
    for text in texts.split(" | ")
]


def units_under(cls: type, seen: set[type]) -> Iterator[str]:
    """Units of all fields of a spec, of the specs inside it, and of those that names choose."""
    if cls in seen:
        return
    seen.add(cls)
    for field in dataclasses.fields(cls):
        yield from filter(None, [field.metadata.get("unit")])
        choices = field.metadata.get("choices")
        chosen = choices.values() if isinstance(choices, Mapping) else ()
        inside = [hints(cls)[field.name], *filter(None, chosen)]
        while inside:
            hint = inside.pop()
            inside.extend(typing.get_args(hint))
            if dataclasses.is_dataclass(hint):
                yield from units_under(typing.cast(type, hint), seen)


def test_every_kind_of_quantity_of_a_case_is_in_the_table():
    seen: set[type] = set()
    cages = [bearing.cage_spec for bearing in BEARING_TYPES.values()]
    units = {u for cls in (Case, StaticCase, Look, Repeat, *cages) for u in units_under(cls, seen)}
    assert {_COMMON[unit][0] for unit in units} == set(SPELLINGS)
    assert len(units) > 25


def units_of(kind: str) -> list[str]:
    return [unit for unit, row in _COMMON.items() if row[0] == kind]


@pytest.mark.parametrize(("kind", "text", "due"), ROWS)
def test_spelling_is_read_for_what_it_says_or_refused(kind, text, due):
    for unit in units_of(kind):  # whichever of its units a field is written in
        if isinstance(due, float):
            assert parse(text, unit) == pytest.approx(due, rel=1e-12), unit
        else:
            with pytest.raises(InputError, match=due):
                parse(text, unit)


@pytest.mark.parametrize("unit", ["1/min", "min^-1", "rev/min", "U/min", "r/min"])
def test_speeds_of_a_case_are_revolutions(unit):
    case = load_case(f'[bearing]\npreset = "N1013"\n[drive]\nspeed = "6000 {unit}"\n')
    assert case.drive.speed == pytest.approx(200.0 * pi, rel=1e-14)
    assert case.replace("drive.speed", f"3000 {unit}").drive.speed == pytest.approx(100.0 * pi)


@pytest.mark.parametrize("text", ["100 1/s", "100 Hz"])
def test_a_speed_that_may_be_either_is_refused_with_both(text):
    with pytest.raises(InputError) as caught:
        load_case(f'[bearing]\npreset = "N1013"\n[drive]\nspeed = "{text}"\n')
    assert caught.value.where == "drive.speed"
    assert "'100 rev/s' or '100 rad/s'" in str(caught.value)


def test_frequencies_stay_frequencies():
    text = '[bearing]\npreset = "N1013"\n[output]\nrate = "50000 1/s"\nvibration_rate = "0.2 MHz"\n'
    assert load_case(text).output.rate == 50e3
    with pytest.raises(InputError, match="cycles a second"):
        load_case(text.replace("1/s", "rad/s"))
