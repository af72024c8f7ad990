"""How many starts would tell a surface from a flat one.

The F test of all terms of a quadratic beside its constant has the non-centrality of its true
effects, which grows with the number of values a point (H. Scheffe, The Analysis of Variance, 1959,
chapter 2).
"""

from __future__ import annotations

from dataclasses import dataclass
from math import ceil, isfinite

import numpy as np
from scipy.stats import f as fisher
from scipy.stats import ncf

from flexcage.study.quadratic import Quadratic
from flexcage.study.samples import Samples

FLAT = 0.05  # probability by chance, above which a surface counts as flat within noise
POWER = 0.8  # with which a study is to tell
_MOST = 1e5  # times as many values that are looked at


@dataclass(frozen=True)
class Needed:
    """Starts a point that tell a surface from a flat one with 80 % power: for the effects that the
    fit shows beyond those of noise alone, and for a bowl of the range that ``matters`` (a share of
    the mean). Infinite where there is nothing to be found."""

    flat: bool
    starts: float  # a point, that the study has
    fitted: float
    matters: float
    bowl: float
    within: float  # share of the noise that the runs' own intervals explain; NaN if unknown

    def lines(self) -> list[str]:
        """All of it as sentences."""
        have = f"{self.starts:.3g} start{'' if self.starts == 1.0 else 's'} a point"
        head = (
            f"Flat within noise by {have}." if self.flat else
            f"Not flat: {have} {'tells' if self.starts == 1.0 else 'tell'} it from noise."
        )  # fmt: skip
        found = (
            "Starts a point that tell effects as large as those found from noise (80 % power): "
            f"{ceil(self.fitted)}"
            if isfinite(self.fitted) else
            "The effects found are no larger than those of noise alone"
        )  # fmt: skip
        bowl = (
            f"a bowl whose range is {100.0 * self.matters:g} % of the mean by {ceil(self.bowl)}"
            if isfinite(self.bowl) else
            f"a bowl of {100.0 * self.matters:g} % of the mean is out of reach"
        )  # fmt: skip
        lines = [head, f"{found}; {bowl}."]
        if isfinite(self.within):
            lines.append(
                f"Intervals of the single runs explain {100.0 * min(self.within, 1.0):.0f} % of "
                "the scatter: " + (
                    "runs with as many more turns decide as well as more starts."
                    if self.within >= 0.5 else "take more starts, longer runs help little."
                )
            )  # fmt: skip
        return lines


def needed(samples: Samples, fit: Quadratic, matters: float) -> Needed:
    """What would decide, by the quadratic fit; see ``Needed``."""
    terms, n, starts = len(fit.beta) - 1, len(samples.y), samples.starts
    seen = terms * fit.ratio * (fit.dof - 2.0) / fit.dof - terms  # unbiased, of non-centrality
    bowl = (samples.z**2).sum(axis=1)
    height = matters * abs(float(samples.y.mean())) / samples.z.shape[1]
    wanted = float(((height * (bowl - bowl.mean())) ** 2).sum()) / fit.noise
    return Needed(
        fit.level > FLAT,
        starts,
        starts * _times(seen, terms, n),
        matters,
        starts * _times(wanted, terms, n),
        samples.within / fit.noise,
    )


def power(effect: float, terms: int, values: float) -> float:
    """Probability that the F test finds effects of this non-centrality."""
    dof = values - terms - 1.0
    return float(ncf.sf(fisher.isf(FLAT, terms, dof), terms, dof, effect))


def _times(effect: float, terms: int, n: int) -> float:
    """How many times as many values find effects whose non-centrality is ``effect`` by n."""
    if not effect > 0.0:
        return float("inf")
    low, high = np.log((terms + 2.0) / n), np.log(_MOST)
    if power(effect * np.exp(high), terms, n * np.exp(high)) < POWER:
        return float("inf")
    for _ in range(60):
        middle = 0.5 * (low + high)
        enough = power(effect * np.exp(middle), terms, n * np.exp(middle)) >= POWER
        low, high = (low, middle) if enough else (middle, high)
    return float(np.exp(high))
