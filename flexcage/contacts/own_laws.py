"""Laws from outside, tried before they are used: do they keep what the signature asks of a law?

A law that reads beyond its parameters, or whose slopes are not those of its force, runs on without
a word: an explicit method never looks at slopes.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import lru_cache
from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.probing import place_beyond, read_beyond, with_room, wrong_slopes

# penetrations [m] and their rates [m/s], sliding speeds [m/s] at which laws are tried
_DEPTHS = np.geomspace(1e-9, 3e-5, 40)
_RATES = np.array([-0.5, -0.1, -0.01, 0.0, 0.01, 0.1, 0.5])
_APART = -np.array([0.0, 1e-9, 1e-6, 1e-3])  # without contact
_ONSET = 0.2  # [m/s]
_SLIDING = np.geomspace(1e-6, 10.0, 240)
_FEW = 0.05  # of all places, at which slopes may be off: corners and jumps


@lru_cache(maxsize=256)
def check_normal(law: Callable[..., None], name: str, given: tuple[float, ...]) -> None:
    """Raise InputError for a normal law that is none with the parameters ``given``."""
    what, p = f"Normal law '{name}'", with_room(np.array(given))
    d, v = (x.ravel() for x in np.meshgrid(_DEPTHS, _RATES))
    every = np.concatenate([d, _APART]), np.concatenate([v, np.full(len(_APART), 0.1)])
    _check_reading(what, lambda q: _normal(law, q, *every), np.array(given))
    found = np.stack(_normal(law, p, *every))
    _check_numbers(what, "F, Fe, Fd and Fv", found, (every[0], "a penetration", "m"))
    if found[:, len(d) :].any():
        raise InputError(
            f"{what} gives a force or a slope without contact, but must give zeros where the "
            "penetration d is zero or less.",
            where=what,
        )
    slopes = found[2:, : len(d)]
    by_depth = wrong_slopes(lambda x: _normal(law, p, x, v)[0], slopes[0], d, d)
    near = np.maximum(np.abs(v), _RATES[-3])
    by_rate = wrong_slopes(lambda x: _normal(law, p, d, x)[0], slopes[1], v, near)

    def place(k: int) -> str:
        return f"a penetration of {1e6 * d[k]:.3g} um and a rate of {v[k]:g} m/s"

    _check_slope(what, ("dF/dd (Fd)", "N/m"), place, slopes[0], by_depth)
    _check_slope(what, ("dF/dv (Fv)", "N s/m"), place, slopes[1], by_rate)


@lru_cache(maxsize=256)
def check_friction(law: Callable[..., None], name: str, given: tuple[float, ...]) -> None:
    """Raise InputError for a friction law that is none with the parameters ``given``."""
    what, p = f"Friction law '{name}'", with_room(np.array(given))
    every = np.concatenate([[0.0, 1e-9], _SLIDING])
    _check_reading(what, lambda q: _friction(law, q, every), np.array(given))
    both = np.stack(_friction(law, p, every))
    _check_numbers(what, "g = mu/u and dg", both, (every, "a sliding speed", "m/s"))
    slope = both[1, -len(_SLIDING) :]
    found = wrong_slopes(lambda u: _friction(law, p, u)[0], slope, _SLIDING, _SLIDING)

    def place(k: int) -> str:
        return f"a sliding speed of {_SLIDING[k]:.3g} m/s"

    _check_slope(what, ("dg/du (dg)", "s^2/m^2"), place, slope, found)


def _normal(law: Any, p: np.ndarray, d: np.ndarray, v: np.ndarray) -> tuple[np.ndarray, ...]:
    found = np.full((4, len(d)), np.nan)  # what is not written stays none
    with np.errstate(all="ignore"):  # of laws that run as plain Python
        law(len(d), d.copy(), v.copy(), np.full(len(d), _ONSET), p, *found)
    return tuple(found)


def _friction(law: Any, p: np.ndarray, u: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    g, dg = np.full((2, len(u)), np.nan)
    with np.errstate(all="ignore"):
        law(len(u), u.copy(), p, g, dg)
    return g, dg


def _check_reading(what: str, evaluate: Any, p: np.ndarray) -> None:
    place = place_beyond(evaluate, p)
    if place is not None:
        raise InputError(
            f"{what} {read_beyond(place, len(p))}.",
            where=what,
            value=place,
        )


def _check_numbers(
    what: str, names: str, found: np.ndarray, along: tuple[np.ndarray, str, str]
) -> None:
    """``along``: what the law was tried at, its name and unit. An overflow far in is none."""
    x, at, unit = along
    odd = np.isnan(found).any(axis=0) | (np.isinf(found).any(axis=0) & (x <= 0.0))
    if odd.any():
        k = int(np.argmax(odd))
        raise InputError(
            f"{what} gives no finite number at {at} of {x[k]:.3g} {unit}, but must write one into "
            f"every entry of {names}.",
            where=what,
            value=float(x[k]),
        )


def _check_slope(
    what: str, name: tuple[str, str], place: Callable[[int], str], slope: np.ndarray, found: Any
) -> None:
    wrong, differences = found
    if np.mean(wrong) <= _FEW:
        return
    off = np.where(wrong, np.abs(slope - differences) / (np.abs(slope) + np.abs(differences)), -1.0)
    k = int(np.argmax(off))
    raise InputError(
        f"{what} gives {name[0]} = {slope[k]:.4g} {name[1]} at {place(k)}, where differences of "
        f"its values give {differences[k]:.4g} {name[1]}, and is off at {np.mean(wrong):.0%} of "
        "the places tried; let it write the slope of what it writes.",
        where=what,
        value=float(slope[k]),
    )
