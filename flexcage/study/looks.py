"""Planned looks at a growing number of starts, and the error that each may spend.

Who looks at 8, at 16 and at 30 starts, each time at a level of 5 %, errs in more than 5 % of all
studies. A spending function says how much of the error is spent by the time a share of the starts
is there; the level of each look follows from the joint normal distribution of the looks
(K. K. G. Lan and D. L. DeMets, Biometrika 70 (1983) 659; P. Armitage, C. K. McPherson, B. C. Rowe,
J. R. Stat. Soc. A 132 (1969) 235).
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import lru_cache
from math import e, log, sqrt
from numbers import Integral

import numpy as np
from scipy.optimize import brentq
from scipy.stats import norm

from flexcage.core.errors import InputError

_NODES = 200  # of Gauss and Legendre, over each look's distribution
_FAR = 9.0  # standard deviations beyond which it is nothing


def _obrien_fleming(alpha: float, share: float) -> float:
    """Little at first, nearly all at the end."""
    return 2.0 * float(norm.sf(norm.isf(0.5 * alpha) / sqrt(share)))


def _pocock(alpha: float, share: float) -> float:
    """Nearly the same level at every look."""
    return alpha * log(1.0 + (e - 1.0) * share)


SPENDING: Mapping[str, Callable[[float, float], float]] = {
    "obrien_fleming": _obrien_fleming,
    "pocock": _pocock,
}


@dataclass(frozen=True)
class Looks:
    """At how many ``starts`` a study is looked at, and the ``error`` that all looks together may
    make, half of it in each direction."""

    starts: tuple[int, ...] = (8, 16, 30)
    error: float = 0.05
    spending: str = "obrien_fleming"

    def __post_init__(self) -> None:
        whole = all(isinstance(n, Integral) for n in self.starts)
        if (
            not whole
            or not self.starts
            or list(self.starts) != sorted(set(self.starts))
            or self.starts[0] < 2
        ):
            raise InputError(
                f"The looks are at {list(self.starts)} starts, but should be whole "
                "numbers that rise from 2 or more.",
                where="starts",
                value=self.starts,
            )
        if self.spending not in SPENDING:
            raise InputError(
                f"The error is spent by '{self.spending}', but should be by one of "
                f"{', '.join(SPENDING)}.",
                where="spending",
                value=self.spending,
            )

    def level(self, starts: int, *, share: float = 1.0) -> float:
        """One-sided level at the look after so many starts, of a ``share`` of the error of one
        direction; InputError for a look that is not planned."""
        if starts not in self.starts:
            raise InputError(
                f"There are {starts} starts, but looks are planned at "
                f"{', '.join(map(str, self.starts))}.",
                where="starts",
                value=starts,
            )
        times = tuple(n / self.starts[-1] for n in self.starts)
        limits = boundaries(times, 0.5 * self.error * share, self.spending)
        return float(norm.sf(limits[self.starts.index(starts)]))


@lru_cache(maxsize=256)
def boundaries(times: tuple[float, ...], alpha: float, spending: str) -> tuple[float, ...]:
    """Limits of the standardised statistic at looks at these shares of all information, beyond
    which one-sided tests of level ``alpha`` in all reject."""
    spent, limits = 0.0, list[float]()
    points, density, before = np.zeros(1), np.ones(1), 0.0  # weights of the sum that went on
    for time in times:
        share, step = SPENDING[spending](alpha, time), sqrt(time - before)

        def passes(limit: float, points=points, density=density, step=step) -> float:
            return float(density @ norm.sf((limit - points) / step))

        far = _FAR * sqrt(time)
        limit = brentq(lambda x: passes(x) - (share - spent), -far, far, xtol=1e-12)  # noqa: B023
        limits.append(limit / sqrt(time))
        nodes, weights = np.polynomial.legendre.leggauss(_NODES)
        grid = 0.5 * (limit + far) * (nodes + 1.0) - far
        spread = norm.pdf((grid[:, None] - points[None, :]) / step) / step
        density = 0.5 * (limit + far) * weights * (spread @ density)
        points, spent, before = grid, share, time
    return tuple(limits)
