"""Samples of what maps gave, and regions of them in words."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from flexcage.study.unknowns import Unknown
from judging.judge import Region, Sample
from judging.stored import Settings

ALIAS = 0.6  # correlation of two unknowns (or of their middles) from which they are one
CELLS = 4  # parts of a range by which coverage of pairs is counted


def sample_of(parts: Sequence[Settings], drifting: str = "", spoilt: Sequence[str] = ()) -> Sample:
    """Maps of the same unknowns, conditions and outputs as one sample.

    A run whose output ``drifting`` is above 1/2 is not stationary: its numbers depend on how long
    it was followed, so they are left out; of outputs that are ``spoilt`` by it, or all if none is.
    """
    first = parts[0]
    values = {}
    for condition in first.conditions:
        kept = [_steady(part, condition, drifting) for part in parts]
        for output in first.spec.outputs:
            counts = not spoilt or output in spoilt
            found = [np.where(there if counts else True, part.values(output, condition), np.nan)
                     for part, there in zip(parts, kept)]  # fmt: skip
            values[output, condition] = np.concatenate(found)
    shares = np.vstack([part.spec.shares[:, :-1] for part in parts])
    unknowns = first.spec.unknowns
    names = [unknown.name for unknown in unknowns]
    return Sample(names, shares, values, first.conditions, cuts_of(unknowns))


def _steady(part: Settings, condition: str, drifting: str) -> np.ndarray | bool:
    """Which runs (settings, starts) are stationary."""
    return ~(part.values(drifting, condition) > 0.5) if drifting else True


def cuts_of(unknowns: Sequence[Unknown]) -> dict[str, tuple[float, ...]]:
    """Shares between the choices of unknowns that are choices."""
    found = {}
    for unknown in unknowns:
        if unknown.choices:
            ends = np.cumsum(unknown.weights) / sum(unknown.weights)
            found[unknown.name] = tuple(float(end) for end in ends[:-1])
    return found


def in_words(region: Region, unknowns: Sequence[Unknown]) -> str:
    """The region's limits, as "Cq - Dw below 0.15 mm and friction 0.1 to 0.2"."""
    by_name = {unknown.name: unknown for unknown in unknowns}
    return " and ".join(_limits(by_name[n], *ends) for n, ends in region.limits.items())


def _limits(unknown: Unknown, low: float, high: float) -> str:
    if unknown.choices:
        ends = np.cumsum(unknown.weights) / sum(unknown.weights)
        middles = np.concatenate([[0.0], ends[:-1]]) + 0.5 * np.diff([0.0, *ends])
        inside = [c["label"] for c, m in zip(unknown.choices, middles) if low < m < high]
        return f"{unknown.name} {' or '.join(map(str, inside))}"
    first, last = (_short(unknown.changes(share)[0]) for share in (low, high))
    if low <= 0.0:
        return f"{unknown.name} below {last}"
    return f"{unknown.name} above {first}" if high >= 1.0 else f"{unknown.name} {first} to {last}"


def _short(value: object) -> str:
    """A number, with its unit if it has one, in two digits."""
    number, _, unit = str(value).partition(" ")
    short = float(f"{float(number):.2g}")
    return f"{short:{',.0f' if abs(short) >= 100.0 else 'g'}} {unit}".rstrip()


def aliases(shares: np.ndarray, names: Sequence[str]) -> list[str]:
    """Pairs of unknowns that a design (points, unknowns) does not tell apart, or not everywhere:
    each with the reason. A design that judges claims has none."""
    found = []
    cell = np.minimum((shares * CELLS).astype(int), CELLS - 1)
    middle = np.abs(shares - 0.5) < 0.25
    for i in range(shares.shape[1]):
        for j in range(i):
            counts = np.bincount(cell[:, i] * CELLS + cell[:, j], minlength=CELLS * CELLS)
            pair = f"{names[j]} and {names[i]}"
            if not counts.all():
                found.append(f"{pair}: no point in {int((counts == 0).sum())} of {CELLS**2} cells")
            elif _correlation(shares[:, i], shares[:, j]) > ALIAS:
                found.append(f"{pair} move together")
            elif _correlation(middle[:, i], middle[:, j]) > ALIAS:
                found.append(f"middles of {pair} coincide")
    return found


def _correlation(one: np.ndarray, other: np.ndarray) -> float:
    return abs(float(np.corrcoef(one, other)[0, 1]))
