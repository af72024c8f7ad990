"""A user's function on trial: does it read parameters that it was not given, and are its slopes
those of its values?
"""

from __future__ import annotations

from collections.abc import Callable, Iterable

import numpy as np

from flexcage.core.errors import InputError

_TRIAL_SIZE = 1024  # parameters of a trial, most of them not given
_TRIAL_VALUES = (np.nan, 1e3, -1e3)  # values that no function overlooks all
_STEP = 1e-5  # of the argument's size, over which a difference is taken
_OFF = 0.01  # share by which a slope may be off
_FLOOR = 1e-3  # of value over argument: a slope that counts
_ROUNDING = 1e-13  # of a value

Evaluate = Callable[[np.ndarray], Iterable[np.ndarray]]


def zero_padded(given: np.ndarray) -> np.ndarray:
    """The parameters given, with zeros after them: what reads further stays in the array."""
    return np.concatenate([given, np.zeros(_TRIAL_SIZE - len(given))])


def check_reading(what: str, evaluate: Evaluate, given: np.ndarray, *, where: str) -> None:
    """InputError, with ``what`` as the name of a function, if the values of ``evaluate(p)`` depend
    on parameters beyond those ``given``."""
    place = place_beyond(evaluate, given)
    if place is None:
        return
    count = len(given)
    few = {0: "none", 1: "one number, p[0]"}.get(count, f"{count} numbers, p[0] to p[{count - 1}]")
    raise InputError(
        f"{what} reads p[{place}], but its parameters are {few}; let its 'parameters' give all "
        "that it reads.",
        where=where,
        value=place,
    )


def place_beyond(evaluate: Evaluate, given: np.ndarray) -> int | None:
    """Place of a parameter beyond those ``given`` on which the values of ``evaluate(p)`` depend,
    negative where it counts from the end; None if there is none.

    Its values are compared between parameters that have zeros after those given, as runs have, and
    others.
    """
    count = len(given)
    wanted = _values(evaluate, zero_padded(given))
    if not _differs(evaluate, given, wanted, slice(count, None)):
        return None
    for place in range(count, _TRIAL_SIZE):
        if _differs(evaluate, given, wanted, slice(place, place + 1)):
            return place if place < _TRIAL_SIZE // 2 else place - _TRIAL_SIZE
    return count


def _differs(evaluate: Evaluate, given: np.ndarray, wanted: np.ndarray, where: slice) -> bool:
    for trial in _TRIAL_VALUES:
        p = zero_padded(given)
        p[where] = trial
        if not np.array_equal(_values(evaluate, p), wanted, equal_nan=True):
            return True
    return False


def _values(evaluate: Evaluate, p: np.ndarray) -> np.ndarray:
    try:
        return np.concatenate([np.ravel(v) for v in evaluate(p)])
    except IndexError:  # of plain Python
        return np.array([np.inf])


def wrong_slopes(
    function: Callable[[np.ndarray], np.ndarray], slope: np.ndarray, x: np.ndarray, size: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Where (n,) a slope is none of ``function`` at x, and the slopes (n,) by differences.

    A slope at a corner may be that of either side, or between them. ``size`` (n,): of arguments, by
    which steps and slopes that count are measured. Where values are not finite nothing is judged.
    """
    step = _STEP * size
    with np.errstate(all="ignore"):
        low, here, high = (function(x + s) for s in (-step, 0.0 * step, step))
        left, right = (here - low) / step, (high - here) / step
        most = np.maximum(np.abs(left), np.abs(right))
        rounding = _ROUNDING * np.maximum(np.abs(low), np.abs(high)) / step
        slack = _OFF * most + _FLOOR * np.abs(here) / size + rounding
        off = (slope < np.minimum(left, right) - slack) | (slope > np.maximum(left, right) + slack)
        judged = np.isfinite(left) & np.isfinite(right)
    return judged & (off | ~np.isfinite(slope)), 0.5 * (left + right)
