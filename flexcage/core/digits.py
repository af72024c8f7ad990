"""Numbers as people read them: as many digits as the number has, and no more.

A number alone has about five significant digits. One with a margin (half the width of its 95 %
interval) ends where the margin ends, and the margin keeps two digits: 100 ± 150, 12.35 ± 0.14.
"""

from __future__ import annotations

from decimal import Decimal
from math import floor, isfinite, log10

_OF_MARGIN = 2  # significant digits of a margin
_MOST = 7  # significant digits of a value, however narrow its interval is
_LEAST, _LARGE = 1e-4, 1e6  # between these no exponent is needed


def number_text(value: float) -> str:
    """A number without a margin, in about five significant digits."""
    a = abs(value)
    if not isfinite(value):
        return "-"
    if a == 0.0:
        return "0"
    if a >= _LARGE or a < _LEAST:
        return f"{value:.3e}"
    if a >= 1e3:
        return f"{value:,.1f}"
    digits = 5 - len(str(int(a))) if a >= 1 else 4
    return f"{value:.{max(digits, 1)}f}"


def percent_text(share: float) -> str:
    """A share in whole percents, as '47 %'."""
    return f"{share:.0%}".replace("%", " %")


def texts_with_margin(value: float, margin: float | None) -> tuple[str, str]:
    """A number and its margin, both with the digits that the margin leaves; no second text where
    no margin is known."""
    if margin is None or not (isfinite(value) and isfinite(margin)):
        return number_text(value), ""
    a, m = abs(value), abs(margin)
    if m == 0.0:
        return number_text(value), "0"
    largest = max(a, m)
    if largest >= _LARGE or largest < _LEAST:
        power = _place(largest)
        last = max(_last_place(m), power + 1 - _MOST) - power
        return tuple(  # type: ignore[return-value]
            f"{_rounded(x / 10.0**power, last)}e{power:+03d}" for x in (value, m)
        )
    last = _last_place(m)
    if a and last < _place(a) + 1 - _MOST:  # so narrow that the value's own digits end first
        return _rounded(value, _place(a) + 1 - _MOST), f"{m:.{_OF_MARGIN}g}"
    return _rounded(value, last), _rounded(m, last)


def _place(x: float) -> int:
    """Power of ten of the first digit of x > 0."""
    return floor(log10(x))


def _last_place(margin: float) -> int:
    """Power of ten of the last digit that a margin > 0 keeps, once it is rounded to those."""
    return Decimal(f"{margin:.{_OF_MARGIN - 1}e}").adjusted() + 1 - _OF_MARGIN


def _rounded(x: float, last: int) -> str:
    """x rounded to the power of ten ``last``; zero has no sign."""
    text = f"{round(x, -last):,.{max(-last, 0)}f}"
    return text.removeprefix("-") if not text.strip("-0.,") else text
