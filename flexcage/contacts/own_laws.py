"""Laws from outside, tried before they are used: do they keep what the signature asks of a law?

A law that reads beyond its parameters, or whose slopes are not those of its force, runs on without
a word: an explicit method never looks at slopes.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.probing import check_reading, wrong_slopes, zero_padded

# penetrations [m] and their rates [m/s], sliding speeds [m/s] at which laws are tried
_DEPTHS = np.geomspace(1e-9, 3e-5, 40)
_RATES = np.array([-0.5, -0.1, -0.01, 0.0, 0.01, 0.1, 0.5])
_OPEN = -np.array([0.0, 1e-9, 1e-6, 1e-3])  # without contact
_ONSET = 0.2  # [m/s]
_SLIDING = np.geomspace(1e-6, 10.0, 240)
_SPARE = 8  # entries of arrays beyond those that a law is told of
_SAME = 1e-6  # of a force: what rounding leaves
_FEW = 0.05  # of all places, at which slopes may be off: corners and jumps


@dataclass(frozen=True)
class _Trial:
    """A law that is called on arrays longer than it is told, with nothing in what it fills."""

    law: Callable[..., None]
    what: str  # "Normal law 'name'"
    inputs: tuple[str, ...]
    outputs: tuple[str, ...]

    def __call__(self, p: np.ndarray, *values: np.ndarray) -> np.ndarray:
        """Outputs (outputs, n) at values (n,); InputError for a law that writes elsewhere."""
        n = len(values[0])
        given = [np.append(v, np.full(_SPARE, v[-1])) for v in values]
        filled = np.full((len(self.outputs), n + _SPARE), np.nan)
        taken = [v.copy() for v in (*given, p)]
        with np.errstate(all="ignore"):  # of laws that run as plain Python
            self.law(n, *taken, *filled)
        for name, before, after in zip((*self.inputs, "p"), (*given, p), taken, strict=True):
            if not np.array_equal(before, after, equal_nan=True):
                raise self.refused(f"writes into {name}, which is not its own")
        if not np.isnan(filled[:, n:]).all():
            raise self.refused("writes beyond the first n entries, into those of other contacts")
        return filled[:, :n]

    def refused(self, said: str) -> InputError:
        kind = f"({', '.join(('n', *self.inputs, 'p', *self.outputs))})"
        return InputError(f"{self.what} {kind} {said}.", where=self.what)


@lru_cache(maxsize=256)
def check_normal(law: Callable[..., None], name: str, given: tuple[float, ...]) -> None:
    """Raise InputError for a normal law that is none with the parameters ``given``."""
    what, p = f"Normal law '{name}'", zero_padded(np.array(given))
    trial = _Trial(law, what, ("d", "v", "onset"), ("F", "Fe", "Fd", "Fv"))

    def at(q: np.ndarray, d: np.ndarray, v: np.ndarray) -> np.ndarray:
        return trial(q, d, v, np.full(len(d), _ONSET))

    d, v = (x.ravel() for x in np.meshgrid(_DEPTHS, _RATES))
    every = np.concatenate([d, _OPEN]), np.concatenate([v, np.full(len(_OPEN), 0.1)])
    check_reading(what, lambda q: at(q, *every), np.array(given), where=what)
    found = at(p, *every)
    _check_numbers(what, "F, Fe, Fd and Fv", found, (every[0], "a penetration", "m"))
    if found[:, len(d) :].any():
        raise trial.refused("gives a force or a slope without contact, where d is zero or less")
    slopes = found[2:, : len(d)]
    by_depth = wrong_slopes(lambda x: at(p, x, v)[0], slopes[0], d, d)
    near = np.maximum(np.abs(v), _RATES[-3])
    by_rate = wrong_slopes(lambda x: at(p, d, x)[0], slopes[1], v, near)

    def place(k: int) -> str:
        return f"a penetration of {1e6 * d[k]:.3g} um and a rate of {v[k]:g} m/s"

    _check_slope(what, ("dF/dd (Fd)", "N/m"), place, slopes[0], by_depth)
    _check_slope(what, ("dF/dv (Fv)", "N s/m"), place, slopes[1], by_rate)
    _check_force(trial, found[:2, : len(d)], at(p, d, 0.0 * v)[0], v, place)


def _check_force(
    trial: _Trial, forces: np.ndarray, still: np.ndarray, v: np.ndarray, place: Callable[[int], str]
) -> None:
    """Refuse forces F and Fe (2, n) that pull, or give energy; ``still`` (n,) are F at v = 0."""
    F, elastic = np.nan_to_num(forces, posinf=0.0)
    still = np.nan_to_num(still, posinf=0.0)
    slack = _SAME * np.maximum(np.abs(F), still)
    for wrong, values, said in (
        (F < -slack, F, "pulls: F is {:.4g} N at {}, but must not be negative"),
        (np.abs(elastic - still) > slack, elastic, "gives Fe = {:.4g} N at {}, which is not F at "
                                                   "rest there (v = 0)"),
        ((F - still) * np.sign(v) < -slack, F - still,
         "gives energy: F less that at rest is {:.4g} N at {}, but must be against the motion"),
    ):  # fmt: skip
        if wrong.any():
            k = int(np.argmax(np.where(wrong, np.abs(values), -1.0)))
            raise trial.refused(said.format(values[k], place(k)))


@lru_cache(maxsize=256)
def check_friction(law: Callable[..., None], name: str, given: tuple[float, ...]) -> None:
    """Raise InputError for a friction law that is none with the parameters ``given``."""
    what, p = f"Friction law '{name}'", zero_padded(np.array(given))
    trial = _Trial(law, what, ("u",), ("g", "dg"))
    every = np.concatenate([[0.0, 1e-9], _SLIDING])
    check_reading(what, lambda q: trial(q, every), np.array(given), where=what)
    both = trial(p, every)
    _check_numbers(what, "g = mu/u and dg", both, (every, "a sliding speed", "m/s"))
    slope = both[1, -len(_SLIDING) :]
    found = wrong_slopes(lambda u: trial(p, u)[0], slope, _SLIDING, _SLIDING)

    def place(k: int) -> str:
        return f"a sliding speed of {_SLIDING[k]:.3g} m/s"

    _check_slope(what, ("dg/du (dg)", "s^2/m^2"), place, slope, found)
    if (both[0] < 0.0).any():
        k = int(np.argmin(both[0]))
        raise trial.refused(
            f"pushes along the motion: g = mu/u is {both[0, k]:.4g} s/m at a sliding speed of "
            f"{every[k]:.3g} m/s, but must not be negative"
        )


def _check_numbers(
    what: str, names: str, found: np.ndarray, along: tuple[np.ndarray, str, str]
) -> None:
    """``along``: what the law was tried at, its name and unit. An overflow far in is none."""
    x, at, unit = along
    wrong = np.isnan(found).any(axis=0) | (np.isinf(found).any(axis=0) & (x <= 0.0))
    if wrong.any():
        k = int(np.argmax(wrong))
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
