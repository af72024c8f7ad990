"""Units at the border: text such as "0.2 mm" becomes SI, and SI becomes such text again.

pint is the authority. Its registry takes 0.3 s to build, so the units that cases use every day
are answered from a small table that a test compares with pint.
"""

from __future__ import annotations

import math
import re
from decimal import Decimal
from functools import cache
from typing import Any

from flexcage.core.errors import InputError

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
    "m/s^2": ("acceleration", 0, 1.0),
    "N*m": ("moment", 0, 1.0),
    "N*mm": ("moment", -3, 1.0),
    "N/m": ("stiffness", 0, 1.0),
    "N/mm": ("stiffness", 3, 1.0),
    "N/um": ("stiffness", 6, 1.0),
    "N*s/m": ("damping", 0, 1.0),
    "Pa*s": ("viscosity", 0, 1.0),
    "mPa*s": ("viscosity", -3, 1.0),
    "1/Pa": ("pressure coefficient", 0, 1.0),
    "1/GPa": ("pressure coefficient", -9, 1.0),
    "N*m/rad": ("torsional stiffness", 0, 1.0),
    "N*m*s/rad": ("torsional damping", 0, 1.0),
    "g*mm": ("unbalance", -6, 1.0),
}
# for pint an angle has no dimension, so that "100 Hz" would pass as 100 rad/s
_CYCLES = re.compile(r"\b[kMG]?(Hz|hertz)\b")
_TURNS = re.compile(r"\b(rpm|rad|radian|radians|mrad|deg|degree|degrees|turn|revolution)\b")
_DECIMAL_COMMA = re.compile(r"\s*[+-]?\d+,\d+\s*\D")
_NUMBER = re.compile(
    r"\s*([+-]?(?:\d+\.?\d*(?:[eE][+-]?\d+)?|\.\d+(?:[eE][+-]?\d+)?|inf))\s*(.*?)\s*$"
)


@cache
def _registry() -> Any:
    import pint

    return pint.UnitRegistry()


def split(text: str) -> tuple[Decimal, str] | None:
    """Number and unit text of "0.2 mm", or None if it does not begin with a number."""
    match = _NUMBER.match(text)
    return (Decimal(match[1]), match[2].replace("µ", "µ").replace("μ", "µ")) if match else None


def parse(value: object, unit: str, *, where: str = "value") -> float:
    """SI value of a text with a unit of the same kind as ``unit`` ("mm", "rpm", "kg/m^3").

    Raises InputError for a bare number, for an unknown unit, and for one of another kind.
    """
    if isinstance(value, (int, float)) and not isinstance(value, bool):
        raise _no_unit(value, unit, where)
    if isinstance(value, str) and _DECIMAL_COMMA.match(value):
        raise InputError(
            f"{where} is '{value}'; write decimals with a point, '{value.replace(',', '.', 1)}'.",
            where=where,
            value=value,
        )
    parts = split(value) if isinstance(value, str) else None
    if parts is None:
        raise InputError(
            f"{where} is {value!r}, but should be a number with a unit, such as '1 {unit}'.",
            where=where,
            value=value,
        )
    number, given = parts
    if not given:
        raise _no_unit(value, unit, where)
    wanted, have = _COMMON.get(unit), _COMMON.get(given)
    if wanted and have and wanted[0] == have[0]:
        return float(number.scaleb(have[1])) * have[2]
    return _parse_by_pint(float(number), given, unit, where, value)


def _no_unit(value: object, unit: str, where: str) -> InputError:
    return InputError(
        f"{where} is {value} without a unit; write it with one, such as '{value} {unit}'.",
        where=where,
        value=value,
    )


def _parse_by_pint(number: float, given: str, unit: str, where: str, value: object) -> float:
    registry = _registry()
    import pint

    try:
        quantity = registry.Quantity(number, given)
    except (pint.errors.PintError, AttributeError, TypeError, ValueError, SyntaxError) as exc:
        raise InputError(
            f"{where} is '{value}', but '{given}' is not a known unit; write it in {unit}.",
            where=where,
            value=value,
        ) from exc
    except Exception as exc:  # pint's tokenizer raises assorted errors on malformed text
        raise InputError(
            f"{where} is '{value}', which cannot be read as a quantity in {unit}.",
            where=where,
            value=value,
        ) from exc
    angular = bool(_TURNS.search(unit))
    mixed = (
        bool(_CYCLES.search(given))
        if angular
        else (bool(_CYCLES.search(unit)) and bool(_TURNS.search(given)))
    )
    wanted = registry.Quantity(1.0, unit).units
    if mixed or quantity.dimensionality != wanted.dimensionality:
        raise InputError(
            f"{where} is '{value}', but '{given}' is of another kind than {unit}, which it wants.",
            where=where,
            value=value,
        )
    return float(quantity.to(wanted).to_base_units().magnitude)


def _factor(unit: str) -> float:
    """What one ``unit`` is in SI."""
    if unit in _COMMON:
        return 10.0 ** _COMMON[unit][1] * _COMMON[unit][2]
    return float(_registry().Quantity(1.0, unit).to_base_units().magnitude)


def format_si(value: float, unit: str) -> str:
    """Text of an SI value in ``unit``, with as few digits as give the same value when read."""
    kind = _COMMON.get(unit)
    if kind and kind[2] == 1.0:
        return f"{_plain(Decimal(repr(float(value))).scaleb(-kind[1]))} {unit}"
    number = value / _factor(unit)
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


def describe(value: float, unit: str) -> str:
    """Short text of an SI value for sentences and tables: six digits."""
    return f"{value / _factor(unit):.6g} {unit}"
