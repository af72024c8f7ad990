"""Tolerances of seats by ISO 286-1, and of a bearing's bore and outside diameter by ISO 492.

Tables hold the standards' printed values in micrometres, for sizes up to 500 mm: grades IT4 to IT9,
shafts f to r, holes F to R. Those of holes K to R are the standard's rule, ES = -ei + (IT_n -
IT_n-1). The tests compare all of them with the formulas behind the tables (ISO 286-1, annex), whose
values the standard rounds.
"""

from __future__ import annotations

import re
from bisect import bisect_left
from collections.abc import Mapping, Sequence

from flexcage.core.errors import InputError
from flexcage.core.units import mm

_UPTO = (3, 6, 10, 18, 30, 50, 80, 120, 180, 250, 315, 400, 500)  # mm, and the last included
GRADES: Mapping[int, Sequence[int]] = {
    4: (3, 4, 4, 5, 6, 7, 8, 10, 12, 14, 16, 18, 20),
    5: (4, 5, 6, 8, 9, 11, 13, 15, 18, 20, 23, 25, 27),
    6: (6, 8, 9, 11, 13, 16, 19, 22, 25, 29, 32, 36, 40),
    7: (10, 12, 15, 18, 21, 25, 30, 35, 40, 46, 52, 57, 63),
    8: (14, 18, 22, 27, 33, 39, 46, 54, 63, 72, 81, 89, 97),
    9: (25, 30, 36, 43, 52, 62, 74, 87, 100, 115, 130, 140, 155),
}
#: Fundamental deviations of shafts: the upper one of f, g and h, the lower one of the others.
DEVIATIONS: Mapping[str, Sequence[int]] = {
    "f": (-6, -10, -13, -16, -20, -25, -30, -36, -43, -50, -56, -62, -68),
    "g": (-2, -4, -5, -6, -7, -9, -10, -12, -14, -15, -17, -18, -20),
    "h": (0,) * 13,
    "j": (-2, -2, -2, -3, -4, -5, -7, -9, -11, -13, -16, -18, -20),
    "k": (0, 1, 1, 1, 2, 2, 2, 3, 3, 4, 4, 4, 5),
    "m": (2, 4, 6, 7, 8, 9, 11, 13, 15, 17, 20, 21, 23),
    "n": (4, 8, 10, 12, 15, 17, 20, 23, 27, 31, 34, 37, 40),
    "p": (6, 12, 15, 18, 22, 26, 32, 37, 43, 50, 56, 62, 68),
}
_UPTO_R = (3, 6, 10, 18, 30, 50, 65, 80, 100, 120, 140, 160, 180, 200, 225, 250, 280, 315, 355, 400,
           450, 500)  # fmt: skip
_R = (10, 15, 19, 23, 28, 34, 41, 43, 51, 54, 63, 65, 68, 77, 80, 84, 94, 98, 108, 114, 126, 132)
_HOLE_J = {  # upper deviations
    6: (2, 5, 5, 6, 8, 10, 13, 16, 18, 22, 25, 29, 33),
    7: (4, 6, 8, 10, 12, 14, 18, 22, 26, 30, 36, 39, 43),
}
_BELOW = ("f", "g", "h")  # whose deviation is the upper one
# grades of the letters, of shafts and of holes: those whose rules stand above
_ANY = tuple(GRADES)
_SHAFTS = {**dict.fromkeys(("f", "g", "h", "js", "m", "n", "p", "r"), _ANY), "j": (5, 6),
           "k": (4, 5, 6, 7)}  # fmt: skip
_HOLES = {
    **dict.fromkeys(("F", "G", "H", "JS"), _ANY),
    "J": (6, 7),
    **dict.fromkeys(("K", "M", "N"), (5, 6, 7, 8)),
    "P": (5, 6, 7),
    "R": (5, 6, 7),
}
_M6 = (10, -9)  # ISO 286-1: M6 of 250 to 315 mm is -9, not the rule's -11

# ISO 492, class Normal: sizes up to [mm] and how far bore and outside diameter may be below them
_BORE = ((18, 8), (30, 10), (50, 12), (80, 15), (120, 20), (180, 25), (250, 30), (315, 35),
         (400, 40), (500, 45))  # fmt: skip
_OUTSIDE = ((18, 8), (30, 9), (50, 11), (80, 13), (120, 15), (150, 18), (180, 25), (250, 30),
            (315, 35), (400, 40), (500, 45))  # fmt: skip

Limits = tuple[float, float]  # lower and upper deviation [m]


def shaft_limits(code: str, size: float, where: str) -> Limits:
    """Lower and upper deviation [m] of a shaft of a size [m] by its code, such as "k5".

    Raises InputError for a code that is none, and for sizes above 500 mm.
    """
    letter, grade = _parts(code, _SHAFTS, where, "shafts", "k5")
    k, width = _index(size, where), 0
    width = GRADES[grade][k]
    if letter == "js":
        return _um(-0.5 * width, 0.5 * width)
    least = _of_r(size) if letter == "r" else DEVIATIONS[letter][k]
    return _um(least - width, least) if letter in _BELOW else _um(least, least + width)


def hole_limits(code: str, size: float, where: str) -> Limits:
    """Lower and upper deviation [m] of a hole of a size [m] by its code, such as "H7"; InputError
    likewise."""
    letter, grade = _parts(code, _HOLES, where, "holes", "H7")
    k = _index(size, where)
    width, own = GRADES[grade][k], letter.lower()
    if letter == "JS":
        return _um(-0.5 * width, 0.5 * width)
    if own in _BELOW:
        return _um(-DEVIATIONS[own][k], width - DEVIATIONS[own][k])
    if letter == "J":
        most = _HOLE_J[grade][k]
    elif letter == "M" and grade == 6 and k == _M6[0]:
        most = _M6[1]
    else:
        step = width - GRADES[grade - 1][k] if k > 0 else 0
        most = step - (_of_r(size) if letter == "R" else DEVIATIONS[own][k])
    return _um(most - width, most)


def bearing_limits(size: float, *, outside: bool, where: str) -> Limits:
    """Deviations [m] of the mean bore, or outside diameter, of a radial bearing of class Normal
    (ISO 492); InputError above 500 mm."""
    _index(size, where)
    table = _OUTSIDE if outside else _BORE
    return _um(-next(least for upto, least in table if 1e3 * size <= upto + 1e-9), 0)


def _um(lower: float, upper: float) -> Limits:
    return round(1e-6 * lower, 10), round(1e-6 * upper, 10)


def _of_r(size: float) -> int:
    return _R[bisect_left(_UPTO_R, 1e3 * size - 1e-9)]


def _index(size: float, where: str) -> int:
    k = bisect_left(_UPTO, 1e3 * size - 1e-9)
    if k == len(_UPTO):
        raise InputError(
            f"{where} is a code of ISO 286, whose tables here end at {mm(0.5)}, but the seat has "
            f"{mm(size)}; give {where}_interference.",
            where=where,
        )
    return k


def _parts(
    code: str, known: Mapping[str, Sequence[int]], where: str, what: str, such: str
) -> tuple[str, int]:
    """Letter and grade of a code."""
    match = re.fullmatch(r"\s*([A-Za-z]{1,2})\s*(\d{1,2})\s*", code)
    letter, grade = (match[1], int(match[2])) if match else ("", 0)
    if grade in known.get(letter, ()):
        return letter, grade
    otherwise = letter.swapcase()
    if grade in known.get(otherwise, ()):
        case = "small" if what == "shafts" else "capital"
        hint = f"{what} have {case} letters: is {otherwise}{grade} meant?"
    elif letter in known:
        grades = known[letter]
        hint = f"{letter} has the grades {grades[0]} to {grades[-1]}, as in {letter}{grades[1]}."
    else:
        letters = ", ".join(known)
        hint = f"flexcage knows {letters} with a grade, as in {such}; or give {where}_interference."
    raise InputError(
        f"{where} is '{code}', which is no tolerance of {what} (ISO 286): {hint}",
        where=where,
        value=code,
    )
