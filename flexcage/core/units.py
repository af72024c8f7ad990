"""Units at the border: text such as "0.2 mm" becomes SI, and SI becomes such text again.

pint is the authority, except that here an angle is a dimension of its own: a speed in rad/s is
no frequency, and 1/s may be either. Its registry takes 0.3 s to build, so the units that cases
use every day are answered from a small table that a test compares with pint.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable
from decimal import Decimal, InvalidOperation
from functools import cache
from importlib import resources
from typing import Any

from flexcage.core.errors import InputError, shown
from flexcage.core.unit_names import wrong_name

# unit: (kind, power of ten, factor) to SI; the power shifts the decimal text, so that 78.4 mm
# becomes exactly the number 0.0784 and not its neighbour
_COMMON: dict[str, tuple[str, int, float]] = {
    "m": ("length", 0, 1.0),
    "mm": ("length", -3, 1.0),
    "um": ("length", -6, 1.0),
    "µm": ("length", -6, 1.0),
    "nm": ("length", -9, 1.0),
    "s": ("time", 0, 1.0),
    "ms": ("time", -3, 1.0),
    "us": ("time", -6, 1.0),
    "µs": ("time", -6, 1.0),
    "N": ("force", 0, 1.0),
    "kN": ("force", 3, 1.0),
    "Pa": ("pressure", 0, 1.0),
    "kPa": ("pressure", 3, 1.0),
    "MPa": ("pressure", 6, 1.0),
    "GPa": ("pressure", 9, 1.0),
    "rad": ("angle", 0, 1.0),
    "mrad": ("angle", -3, 1.0),
    "deg": ("angle", 0, math.pi / 180.0),
    "rad/s": ("angular speed", 0, 1.0),
    "rad/s^2": ("angular acceleration", 0, 1.0),
    "rpm": ("angular speed", 0, math.pi / 30.0),
    "Hz": ("frequency", 0, 1.0),
    "kHz": ("frequency", 3, 1.0),
    "MHz": ("frequency", 6, 1.0),
    "kg": ("mass", 0, 1.0),
    "g": ("mass", -3, 1.0),
    "kg/m^3": ("density", 0, 1.0),
    "g/cm^3": ("density", 3, 1.0),
    "m/s": ("speed", 0, 1.0),
    "mm/s": ("speed", -3, 1.0),
    "s/m": ("inverse speed", 0, 1.0),
    "m/s^2": ("acceleration", 0, 1.0),
    "N*m": ("moment", 0, 1.0),
    "N*mm": ("moment", -3, 1.0),
    "N/m": ("stiffness", 0, 1.0),
    "N/mm": ("stiffness", 3, 1.0),
    "N/um": ("stiffness", 6, 1.0),
    "N/m^3": ("stiffness per area", 0, 1.0),
    "N/mm^3": ("stiffness per area", 9, 1.0),
    "N*s/m": ("damping", 0, 1.0),
    "Pa*s": ("viscosity", 0, 1.0),
    "mPa*s": ("viscosity", -3, 1.0),
    "mm^2/s": ("kinematic viscosity", -6, 1.0),
    "1/Pa": ("pressure coefficient", 0, 1.0),
    "1/GPa": ("pressure coefficient", -9, 1.0),
    "1/K": ("thermal expansion", 0, 1.0),
    "N*m/rad": ("torsional stiffness", 0, 1.0),
    "N*m*s/rad": ("torsional damping", 0, 1.0),
    "g*mm": ("unbalance", -6, 1.0),
    "kg*m^2": ("moment of inertia", 0, 1.0),
    "K": ("temperature", 0, 1.0),
    "degC": ("temperature", 0, 1.0),
    "W": ("power", 0, 1.0),
    "W/K": ("thermal conductance", 0, 1.0),
    "W/(m^2*K)": ("heat transfer", 0, 1.0),
    "W/(m*K)": ("thermal conductivity", 0, 1.0),
    "J/(kg*K)": ("specific heat", 0, 1.0),
    "l/min": ("flow", -3, 1.0 / 60.0),
    "m^3/s": ("flow", 0, 1.0),
    "m/s^2/Hz^0.5": ("density of acceleration", 0, 1.0),
    "um/Hz^0.5": ("density of length", -6, 1.0),
    "N*mm/Hz^0.5": ("density of moment", -3, 1.0),
    "um/m": ("strain", -6, 1.0),
    "um/m/Hz^0.5": ("density of strain", -6, 1.0),
}
# units whose zero is not SI's: what it is there
_ZEROS = {"degC": Decimal("273.15")}
# kind: least (of what must be greater than 0) and greatest magnitude in SI. Far beyond any bearing,
# where a number is a slip of the pen, and short of where its squares or inverses leave the floats
_LIMITS: dict[str, tuple[float, float]] = {
    "length": (1e-16, 1e3),
    "time": (1e-15, 1e6),
    "force": (1e-9, 1e9),
    "pressure": (1e-3, 1e18),
    "angle": (1e-12, 20.0 * math.pi),
    "angular speed": (1e-9, 1e6),
    "angular acceleration": (1e-6, 1e9),
    "frequency": (1e-6, 1e10),
    "mass": (1e-12, 1e6),
    "density": (1e-9, 1e12),
    "speed": (1e-9, 1e4),
    "acceleration": (1e-9, 1e6),
    "moment": (1e-9, 1e9),
    "stiffness": (1e-6, 1e15),
    "stiffness per area": (1.0, 1e21),
    "damping": (1e-9, 1e12),
    "viscosity": (1e-9, 1e4),
    "kinematic viscosity": (1e-12, 10.0),
    "pressure coefficient": (1e-15, 1e-5),
    "torsional stiffness": (1e-6, 1e15),
    "torsional damping": (1e-9, 1e12),
    "unbalance": (1e-15, 1e3),
    "moment of inertia": (1e-15, 1e9),
    "temperature": (1e-3, 1e4),
    "thermal expansion": (1e-9, 1e-2),
    "power": (1e-9, 1e9),
    "thermal conductance": (1e-9, 1e6),
    "heat transfer": (1e-6, 1e9),
    "thermal conductivity": (1e-4, 1e4),
    "specific heat": (1.0, 1e5),
    "flow": (1e-15, 10.0),
}
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d+,\d+\s*\D")
_THOUSANDS = re.compile(r"\s*[+-]?[1-9]\d{0,2},\d{3}(?!\d)")
# thousands in groups, as languages mark them: one mark throughout, and another for decimals. Lone
# points and commas may be decimal marks
_GROUPED = re.compile(
    r"\s*([+-]?\d{1,3})(?:(['’_ \u00a0\u2009\u202f])((?:\d{3}\2)*\d{3})(?:[.,](\d+))?"
    r"|([.,])((?:\d{3}\5)*\d{3})(?!\5)[.,](\d+)|([.,])((?:\d{3}\8)+\d{3}))(?!\s*[\d.,*/^])"
)
_NUMBER = re.compile(
    r"\s*([+-]?(?:\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?|inf))\s*(.*?)\s*$"
)
_LONGEST = 60  # characters of a unit
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹⁻"
_LOWERED = str.maketrans(_RAISED, "0123456789-")
# usual spellings that pint does not read, and how it writes them
_SPELLINGS: tuple[tuple[re.Pattern, Any], ...] = (
    (re.compile(f"[{_RAISED}]+"), lambda m: "^" + m[0].translate(_LOWERED)),  # m³
    (re.compile(r"\*\*"), "^"),
    (re.compile("[·⋅∙×]"), "*"),
    (re.compile(r"\b([A-Za-zµ]+)(-?\d+)(?![\w.])"), r"\1^\2"),  # kg/m3, min-1
    (re.compile(r"\b[rR]\.?[pP]\.?[mM]\b\.?"), "rpm"),
    (re.compile(r"\b(m?)Pas\b"), r"\1Pa*s"),  # pint takes it for the plural of Pa
    # K belongs below the stroke: nobody means kelvin times W/m^2, nor millikelvin
    (re.compile(r"\b(k?W)/m[ *]*K\b"), r"\1/(m*K)"),
    (re.compile(r"\b(k?W)/m\^?2[ *]*K\b"), r"\1/(m^2*K)"),
    (re.compile(r"\b(k?J)/kg[ *]*K\b"), r"\1/(kg*K)"),
    (re.compile(r"^/"), "1/"),
    (re.compile("℃"), "°C"),
    (re.compile("℉"), "°F"),
    (re.compile(r"\bkp\b"), "kgf"),  # kilopond
)
_TON = re.compile(r"\b[kM]?tons?\b")  # 907 kg for pint, and 1000 kg for most engineers
_STEP = re.compile(r"delta_|Δ")
# powers that take pint for ever, parts of a unit
_SLOW_OR_PARTIAL = re.compile(r"\d{3}|\d\s*\^|%\s*\w|\w\s*%")
_ANGLE = "[plane_angle]"
# pint's angles have no dimension, so that 100 Hz would pass for 100 rad/s and N*m for N*m/rad
_DEFINITIONS = (
    f"radian = {_ANGLE} = rad",
    "@alias turn = rev = revs = rotation = rot = r = tr = U",
    "newton_metre = newton * metre = Nm",
    "newton_millimetre = newton * millimetre = Nmm",
)


@cache
def _registry() -> Any:
    import pint

    registry: Any = pint.UnitRegistry(None, on_redefinition="ignore")
    registry.load_definitions(str(resources.files("pint") / "default_en.txt"))
    for line in _DEFINITIONS:
        registry.define(line)
    registry.default_system = "mks"
    return registry


def split(text: str) -> tuple[Decimal, str] | None:
    """Number and unit text of "0.2 mm", or None if it does not begin with a number."""
    match = _NUMBER.match(text)
    return (_decimal(match[1]), match[2].replace("μ", "µ")) if match else None


def _decimal(text: str) -> Decimal:
    """Number of a text; one whose exponent no decimal holds becomes one that no float holds."""
    try:
        return Decimal(text)
    except InvalidOperation:
        sign = "-" if text.startswith("-") else ""
        return Decimal(f"{sign}1e{'-' if 'e-' in text.lower() else ''}9999")


def parse(value: object, unit: str, *, where: str = "value") -> float:
    """SI value of a text with a unit of the same kind as ``unit`` ("mm", "rpm", "kg/m^3").

    Raises InputError for a bare number, for an unknown unit, and for one of another kind.
    """
    if isinstance(value, (int, float)) and not isinstance(value, bool) and value == value:
        raise _no_unit(value, unit, where)
    if isinstance(value, str) and (groups := _GROUPED.match(value)):
        raise _with_groups(value, groups, where)
    if isinstance(value, str) and _DECIMAL_COMMA.match(value):
        raise _with_comma(value, where)
    parts = split(value) if isinstance(value, str) else None
    if parts is None:
        given = repr(value) if isinstance(value, str) else shown(value)
        raise InputError(
            f"{where} is {given}, but should be a number with a unit, such as '1 {unit}'.",
            where=where,
            value=value,
        )
    number, given = parts
    if not given:
        raise _no_unit(value, unit, where)
    wanted, have = _COMMON.get(unit), _COMMON.get(given)
    if wanted and have and wanted[0] == have[0]:
        shifted = _shifted(number, have[1])
        if given in _ZEROS and number.adjusted() < 9:  # a sum of greater ones may overflow
            shifted += _ZEROS[given]
        found = float(shifted) * have[2]
    else:
        found = _parse_by_pint(float(number), given, unit, where, value)
    if found < 0.0 and _COMMON.get(unit, ("",))[0] == "temperature":
        raise InputError(
            f"{where} is '{value}', which is below absolute zero, -273.15 degC.",
            where=where,
            value=value,
        )
    if (math.isinf(found) and number.is_finite()) or (found == 0.0 and number != 0):
        size = "large" if found else "small"
        raise InputError(
            f"{where} is '{value}', which is too {size} a number to compute with.",
            where=where,
            value=value,
        )
    return found


def _with_groups(value: str, found: re.Match, where: str) -> InputError:
    """Error for a number whose thousands are in groups."""
    first, *rest = found.groups(default="")
    digits = first + re.sub(r"\D", "", rest[1] + rest[4] + rest[7])
    decimals = rest[2] or rest[5]
    plain = f"{digits}.{decimals}" if decimals else digits
    text = f"{plain} {value[found.end() :].strip()}".strip()
    return InputError(
        f"{where} is '{value}'; write thousands without marks, and decimals with a point: "
        f"'{text}'.",
        where=where,
        value=value,
    )


def _with_comma(value: str, where: str) -> InputError:
    """Error for a number with a comma, which may part thousands only before three digits."""
    point, none = value.strip().replace(",", ".", 1), value.strip().replace(",", "")
    text = f"write '{point}', with a point"
    if _THOUSANDS.match(value):
        text = f"write decimals with a point, '{point}', and thousands without a comma, '{none}'"
    return InputError(f"{where} is '{value}'; {text}.", where=where, value=value)


def _shifted(number: Decimal, power: int) -> Decimal:
    """The number times a power of ten, exactly; numbers beyond all floats as they are."""
    far = not number.is_finite() or abs(number.adjusted()) > 400
    return number if far else number.scaleb(power)


def _no_unit(value: object, unit: str, where: str) -> InputError:
    return InputError(
        f"{where} is {value} without a unit; write it with one, such as '{value} {unit}'.",
        where=where,
        value=value,
    )


def _parse_by_pint(number: float, given: str, unit: str, where: str, value: object) -> float:
    def refused(sentence: str) -> InputError:
        end = "" if sentence.endswith("?") else "."
        return InputError(f"{where} is '{value}', {sentence}{end}", where=where, value=value)

    word, meant = wrong_name(_spelled(given))
    if word:
        raise refused(f"but '{word}' is not a known unit; {meant or f'write it in {unit}'}")
    try:
        quantity = _quantity(number, given)
    except Exception as exc:  # pint's parser raises assorted errors on malformed text
        raise refused(f"but '{given}' is not a known unit; write it in {unit}") from exc
    if _STEP.search(given):
        raise refused("but a temperature is wanted, not a difference; write it in degC or K")
    if _TON.search(given):
        raise refused("but a ton has 1000 kg or 2000 lb; write it in 't' (1000 kg), kg or lb")
    wanted = _quantity(1.0, unit).units
    if _names_angle(quantity) and _ANGLE not in quantity.dimensionality:
        raise refused(f"in whose unit an angle cancels; write it in {unit}")
    if quantity.dimensionality == wanted.dimensionality:
        return float(quantity.to(wanted).to_base_units().magnitude)
    found = _without_angle(quantity, wanted.dimensionality, refused)
    if found is None:
        raise refused(
            f"but '{given}' is of another kind than {unit}, which it needs"
            + _remedy(quantity.dimensionality, wanted.dimensionality, unit)
        )
    return found


def _quantity(number: float, given: str) -> Any:
    """pint's quantity of a unit in any of its usual spellings."""
    given = _spelled(given)
    if len(given) > _LONGEST or _SLOW_OR_PARTIAL.search(given):
        raise ValueError(given)
    return _registry().Quantity(number, given)


def _spelled(given: str) -> str:
    """A unit's text with usual spellings as pint writes them."""
    for pattern, instead in _SPELLINGS:
        given = pattern.sub(instead, given)
    return given


def _names_angle(quantity: Any) -> bool:
    """Is one of the units that make up a quantity's an angle, or counts angles?"""
    registry = _registry()
    return any(_ANGLE in registry.get_dimensionality(name) for name, _ in quantity.unit_items())


def _without_angle(
    quantity: Any, wanted: Any, refused: Callable[[str], InputError]
) -> float | None:
    """SI value of a quantity whose unit leaves out the angle that is wanted, where it has one
    meaning: 1/min for revolutions a minute, and a slope for an angle. None if it cannot be meant.

    Raises the error that ``refused`` makes of a sentence for one that has two meanings.
    """
    have, registry = quantity.dimensionality, _registry()
    time = registry.Quantity(1.0, "s").dimensionality
    for power in (1, 2):
        if have == time**-power and wanted == registry.Quantity(1.0, "rad").dimensionality * have:
            if dict(quantity.unit_items()) == {"minute": -1}:
                return 2.0 * math.pi * float(quantity.to("1/s").magnitude)
            each = "s" if power == 1 else "s^2"
            size = f"{quantity.to(f'1/{each}').magnitude:g}"
            raise refused(
                "which may count revolutions or radians; write "
                f"'{size} rev/{each}' or '{size} rad/{each}'"
            )
    lengths = {str(registry.get_dimensionality(name)) for name, _ in quantity.unit_items()}
    if wanted == registry.Quantity(1.0, "rad").dimensionality and lengths == {"[length]"}:
        slope = quantity.to("m/m") if not have else None  # 1 mm/m
        return None if slope is None else math.atan(float(slope.magnitude))
    return None


def _remedy(have: Any, wanted: Any, unit: str) -> str:
    """What to do about a unit of another kind, where that is plain; empty if it is not."""
    if have and wanted.get(_ANGLE, 0) != have.get(_ANGLE, 0):
        plain = [{k: v for k, v in d.items() if k != _ANGLE} for d in (have, wanted)]
        if plain[0] == plain[1]:
            if unit.endswith("Hz"):
                return "; Hz counts cycles a second"
            left = "leave the angle out" if have.get(_ANGLE) else "name the angle"
            return f"; {left}, as in '{unit}'"
    if _COMMON.get(unit, ("",))[0] == "viscosity" and dict(have) == {"[length]": 2, "[time]": -1}:
        return "; multiply a kinematic viscosity by the oil's density"
    return ""


def _factor(unit: str) -> float:
    """What one ``unit`` is in SI."""
    if unit in _COMMON:
        return 10.0 ** _COMMON[unit][1] * _COMMON[unit][2]
    return float(_quantity(1.0, unit).to_base_units().magnitude)


def _number(value: float, unit: str) -> float:
    """An SI value in ``unit``."""
    if unit in _ZEROS:
        return float(Decimal(repr(float(value))) - _ZEROS[unit])
    if unit in _COMMON or not _quantity(1.0, unit).check("[temperature]"):
        return value / _factor(unit)
    return float(_registry().Quantity(value, "K").to(_quantity(1.0, unit).units).magnitude)


def format_si(value: float, unit: str) -> str:
    """Text of an SI value in ``unit``, with as few digits as give the same value when read."""
    kind = _COMMON.get(unit)
    if kind and kind[2] == 1.0:
        exact = Decimal(repr(float(value))).scaleb(-kind[1]) - _ZEROS.get(unit, 0)
        return f"{_plain(exact)} {unit}"
    number = _number(value, unit)
    for digits in (12, 15, 16, 17):
        text = f"{number:.{digits}g} {unit}"
        if parse(text, unit) == value:
            break
    return text


def _plain(number: Decimal) -> str:
    """Decimal text without trailing zeros, and without an exponent where that stays readable."""
    if not number.is_finite():
        return str(float(number))
    short = number.normalize()
    return f"{short:f}" if short == 0 or -5 <= short.adjusted() <= 9 else str(short)


def limits_of(unit: str) -> tuple[float, float]:
    """Least magnitude, of what must be greater than 0, and greatest that a value of this unit may
    have, in SI; 0 and infinity for units that cases do not use."""
    return _LIMITS.get(_COMMON.get(unit, ("",))[0], (0.0, math.inf))


def describe(value: float, unit: str) -> str:
    """Short text of an SI value for sentences and tables: six digits."""
    return f"{_number(value, unit):.6g} {unit}"


def mm(value: float) -> str:
    """Short text of a length [m], in millimetres."""
    return describe(value, "mm")


def typeset(value: float, unit: str, *, digits: int = 6) -> str:
    """Short text of an SI value, its unit as print writes it."""
    number, _, name = describe(value, unit).partition(" ")
    text = f"{float(number):.{digits}g} {name.replace('*', '·')}"
    return (
        text.replace(" um", " µm").replace("/um", "/µm").replace(" us", " µs").replace(" deg", "°")
    )
