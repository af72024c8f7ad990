"""Can a rule win? Samples that are true by construction, and how often each verdict is reached."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from judging.findings import Finding, Means
from judging.judge import Sample, judge


def made(
    means: Means, *, points: int, starts: int, scatter: float, unknowns: int = 8, seed: int = 0,
    size: float = 0.5, conditions: Sequence[str] = (),
) -> Sample:  # fmt: skip
    """A sample with these means at every point, times a factor of the point's own (logarithms with
    standard deviation ``size``), and starts that scatter by the share ``scatter`` of the mean."""
    rng = np.random.default_rng(seed)
    own = np.exp(size * rng.standard_normal((points, 1)))
    values = {
        key: mean * own * (1.0 + scatter * rng.standard_normal((points, starts)))
        for key, mean in means.items()
    }
    names = [f"u{k}" for k in range(unknowns)]
    there = conditions or tuple(dict.fromkeys(condition for _, condition in means))
    return Sample(names, rng.random((points, unknowns)), values, there)


def in_region(true: Sample, other: Sample, high: float) -> Sample:
    """The points of one sample where the first unknown is below ``high``, else those of another."""
    here = (true.shares[:, 0] < high)[:, None]
    values = {k: np.where(here, true.values[k], other.values[k]) for k in true.values}
    return replace(true, values=values)


def verdicts(
    finding: Finding, change: float, *, points: int, starts: int, scatter: float, trials: int = 40,
    mechanism: str = "named",
) -> Counter[str]:  # fmt: skip
    """Verdicts on samples for which the finding is true by construction."""
    size = 0.0 if getattr(finding, "absolute", False) or not finding.beats else 0.5
    found = Counter[str]()
    for k in range(trials):
        sample = made(
            finding.example(change), points=points, starts=starts, scatter=scatter, size=size,
            seed=k,
        )  # fmt: skip
        found[judge(finding, sample, mechanism).verdict] += 1
    return found
