"""Decisions: what the starts of a study say for and against a paper's claims.

Every test gives an ``Evidence``: the probability of figures like these if the claim were not so,
and if its contrary were not so. ``decide`` turns those of all claims of a paper into outcomes: by
Holm's procedure over the claims, in each direction, at a level that is spent over planned looks
at the starts (``Looks``). So a study may stop as soon as it has decided, and no claim is found to
hold, or not to, by looking often or by having many claims.

Sources: S. Holm, Scand. J. Statist. 6 (1979) 65; spending, K. K. G. Lan, D. L. DeMets, Biometrika
70 (1983) 659; both together, Y. Ye, A. Li, L. Liu, B. Yao, Stat. Med. 32 (2013) 1112; claims of
several parts, R. L. Berger, Technometrics 24 (1982) 295; equivalence, D. J. Schuirmann, J.
Pharmacokin. Biopharm. 15 (1987) 657.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from math import hypot, inf, nan, sqrt
from typing import Any

import numpy as np
from scipy.stats import t as student

from flexcage.core.errors import InputError
from flexcage.study.looks import Looks
from flexcage.study.ranks import Groups, Sample, jonckheere, mack_wolfe
from flexcage.study.verdicts import FAILS, HOLDS, UNDECIDED


@dataclass(frozen=True)
class Evidence:
    """``p``: probability of what was found, or more of it, if the claim were not so; ``against``:
    if the claim were so, or its contrary not. ``effect`` is what was found, in words, ``starts``
    how many values the samples have, if that is known."""

    p: float
    against: float
    effect: str = ""
    starts: frozenset[int] = frozenset()

    @property
    def contrary(self) -> Evidence:
        """The evidence for the contrary claim."""
        return Evidence(self.against, self.p, self.effect, self.starts)


NOTHING = Evidence(1.0, 1.0, "no figures")  # says nothing for or against


def trend(groups: Groups, *, rising: bool = True, least: float = 0.0) -> Evidence:
    """Does a figure rise (or fall) along an axis, each group the starts at one place of it?

    For it speaks Jonckheere's test; against it the contrary trend, or that the last group's mean
    is as good as the first's: apart by less than the share ``least`` of the first, by
    equivalence.
    """
    test = jonckheere(groups, rising=rising)
    against = test.p_contrary
    if least > 0.0:
        against = min(1.0, 2.0 * min(against, equal(groups[0], groups[-1], within=least).p))
    way = "rising" if rising else "falling"
    return Evidence(test.p, against, f"{test.share:.0%} of pairs {way}", _counts(groups))


def turning(groups: Groups, *, turn: int, lowest: bool = True) -> Evidence:
    """Does a figure fall to group ``turn`` and rise from there (or the other way round)?

    Both arms must do so: the larger p of Jonckheere's tests of the two, and no less than Mack and
    Wolfe's, which alone would take a long arm for both. Against it speaks an arm that goes the
    other way.
    """
    whole = mack_wolfe(groups, turn=turn, lowest=lowest)
    first = jonckheere(groups[: turn + 1], rising=not lowest)
    last = jonckheere(groups[turn:], rising=lowest)
    against = min(1.0, 2.0 * min(first.p_contrary, last.p_contrary))
    ways = ("falling", "rising") if lowest else ("rising", "falling")
    found = f"{first.share:.0%} of pairs {ways[0]}, then {last.share:.0%} {ways[1]}"
    return Evidence(max(whole.p, first.p, last.p), against, found, _counts(groups))


def bending(groups: Groups, at: Sequence[float], *, lowest: bool = True) -> Evidence:
    """Has a figure a least (or largest) value within, wherever that is? By the quadratic contrast
    of the group means over the places ``at`` of an axis, whose variances may differ (Welch)."""
    means, errors, sizes = _moments(groups)
    c = _quadratic(np.asarray(at, float))
    value, error = float(c @ means), sqrt(float(c**2 @ errors))
    freedom = error**4 / float(((c**2 * errors) ** 2 / (sizes - 1)).sum()) if error else inf
    bend = value if lowest else -value
    p = _beyond(bend, error, freedom)
    said = f"quadratic contrast {value:.3g} ± {error:.2g}"
    return Evidence(p, 1.0 - p, said, _counts(groups))


def _quadratic(at: np.ndarray) -> np.ndarray:
    """Contrast of unit size that sees only curvature over places that need not be even."""
    if len(np.unique(at)) != len(at) or len(at) < 3:
        raise InputError(
            f"The places are {at.tolist()}, but a curvature wants three or more that differ.",
            where="at",
        )
    basis, _ = np.linalg.qr(np.vander((at - at.mean()) / np.ptp(at), 3, increasing=True))
    contrast = basis[:, 2]
    middle = np.argsort(at)[len(at) // 2]
    ends = [np.argmin(at), np.argmax(at)]
    return contrast if contrast[ends].sum() > 2.0 * contrast[middle] else -contrast


def equal(one: Sample, other: Sample, *, within: float, absolute: bool = False) -> Evidence:
    """Are two means as good as equal: apart by less than the share ``within`` of the first one's
    size (or by less than ``within`` itself)? Two one-sided tests by Welch's t."""
    means, errors, sizes = _moments((one, other))
    margin = within if absolute else within * abs(float(means[0]))
    return equal_by_moments(means, np.sqrt(errors * sizes), sizes, margin=margin)


def equal_by_moments(means: Any, deviations: Any, sizes: Any, *, margin: float) -> Evidence:
    """The same from means (2,), standard deviations (2,) and numbers of values (2,)."""
    means, sizes = np.asarray(means, float), np.asarray(sizes, float)
    errors = np.asarray(deviations, float) ** 2 / sizes
    apart, error = float(means[1] - means[0]), sqrt(float(errors.sum()))
    freedom = error**4 / float((errors**2 / (sizes - 1)).sum()) if error else inf
    inside = max(_beyond(apart + margin, error, freedom), _beyond(margin - apart, error, freedom))
    outside = min(_beyond(apart - margin, error, freedom), _beyond(-apart - margin, error, freedom))
    said = f"apart by {apart:.3g} ± {error:.2g}, allowed {margin:.3g}"
    return Evidence(inside, outside, said, frozenset(sizes.astype(int).tolist()))


def above(values: Sample, limit: float) -> Evidence:
    """Is the mean of the starts above a limit? By Student's t."""
    means, errors, sizes = _moments((values,))
    error = sqrt(float(errors[0]))
    p = _beyond(float(means[0]) - limit, error, float(sizes[0]) - 1.0)
    said = f"mean {means[0]:.3g} ± {error:.2g}, limit {limit:.3g}"
    return Evidence(p, 1.0 - p, said, _counts((values,)))


def less(one: Sample, other: Sample, *, by: float = 0.0) -> Evidence:
    """Is the mean of ``one`` less than that of ``other``, by the share ``by`` of ``one`` or more?
    By Welch's t."""
    means, errors, sizes = _moments((one, other))
    error = hypot(*np.sqrt(errors))
    freedom = error**4 / float((errors**2 / (sizes - 1)).sum()) if error else inf
    apart = float(means[1] - means[0]) - by * abs(float(means[0]))
    p = _beyond(apart, error, freedom)
    return Evidence(p, 1.0 - p, f"{means[0]:.3g} and {means[1]:.3g}", _counts((one, other)))


def all_of(parts: Iterable[Evidence]) -> Evidence:
    """A claim of several parts is so if all are, and is not if one is not: the largest p for it,
    and the smallest against it, times their number."""
    parts = list(parts)
    against = min(1.0, len(parts) * min(part.against for part in parts))
    said = "; ".join(p.effect for p in parts if p.effect)
    starts = frozenset().union(*(part.starts for part in parts))
    return Evidence(max(p.p for p in parts), against, said, starts)


def decide(
    claims: Mapping[str, Evidence], *, starts: int | Mapping[str, int], looks: Looks | None = None
) -> dict[str, str]:
    """Outcomes of all claims of a paper after so many starts, which are one of the ``looks``; by
    claim, where some have more starts than others.

    Half of the error is spent on claims that hold, half on claims that do not: with Holm's
    procedure over the claims the chance of one wrong decision or more, in either direction, in all
    looks together, is no more than ``looks.error``. Raises InputError for starts that were not
    planned, or that the evidence does not have.
    """
    looks = looks or Looks()
    done = starts if isinstance(starts, Mapping) else dict.fromkeys(claims, starts)
    for key, found in claims.items():
        if found.starts and not min(found.starts) <= done[key] <= max(found.starts):
            has = " to ".join(map(str, sorted({min(found.starts), max(found.starts)})))
            raise InputError(
                f"The evidence of claim '{key}' is of {has} starts, but starts says {done[key]}; "
                "the level of a look is that of its own starts.",
                where="starts",
                value=done[key],
            )
    holds = _rejected({key: e.p for key, e in claims.items()}, done, looks)
    fails = _rejected({key: e.against for key, e in claims.items()}, done, looks)
    return {
        key: UNDECIDED if (key in holds) == (key in fails) else HOLDS if key in holds else FAILS
        for key in claims
    }


def _rejected(p: Mapping[str, float], starts: Mapping[str, int], looks: Looks) -> set[str]:
    """Keys whose hypotheses Holm's procedure rejects: as long as there are any, those whose p is
    within the level that their look leaves to one of those that remain (W. Maurer, F. Bretz, Stat.
    Biopharm. Res. 5 (2013) 311)."""
    found: set[str] = set()
    while len(found) < len(p):
        share = 1.0 / (len(p) - len(found))
        more = {k for k in p.keys() - found if p[k] <= looks.level(starts[k], share=share)}
        if not more:
            break
        found |= more
    return found


def holm(p: Sequence[float]) -> list[float]:
    """Holm's adjusted p, in the order given."""
    adjusted, last = [nan] * len(p), 0.0
    for rank, k in enumerate(sorted(range(len(p)), key=p.__getitem__)):
        last = max(last, min(1.0, (len(p) - rank) * p[k]))
        adjusted[k] = last
    return adjusted


def _counts(groups: Groups) -> frozenset[int]:
    return frozenset(len(group) for group in groups)


def _moments(groups: Groups) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Means, squared standard errors and sizes; InputError for a group of fewer than two."""
    samples = [np.asarray(group, float) for group in groups]
    if any(len(sample) < 2 for sample in samples):
        raise InputError(
            f"A group has {min(map(len, samples))} starts, but a mean's error wants two or more.",
            where="groups",
        )
    if not all(np.isfinite(sample).all() for sample in samples):
        raise InputError("A sample holds a value that is no number; leave it out.", where="groups")
    sizes = np.array([len(sample) for sample in samples], float)
    means = np.array([sample.mean() for sample in samples])
    return means, np.array([sample.var(ddof=1) for sample in samples]) / sizes, sizes


def _beyond(value: float, error: float, freedom: float) -> float:
    """Probability of so large a ``value`` or a larger one if its mean is zero."""
    if error == 0.0:
        return 0.0 if value > 0.0 else 1.0
    return float(student.sf(value / error, freedom))
