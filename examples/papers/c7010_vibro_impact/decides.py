"""What decides the claims on vibro-impacts: sentences with the numbers of what was computed."""

from __future__ import annotations

from collections import Counter

import numpy as np
from claims import ALL_LOADS, ALL_SPEEDS, MAPPED
from figures import AXIAL, BETTER, COMBINED, PERCENT, digits, starts
from paper_weighed import warns, with_rigid_cage
from repeat import Computed

NAMES = {AXIAL: "axial map", COMBINED: "combined map"}  # in sentences
DRIVEN = 50.0  # N in a pocket, above which friction drives the cage


def line(c: Computed, output: str, conditions, factor: float) -> str:
    """An output of the better model under conditions, in a row."""
    return ", ".join(starts(c.readings[BETTER], output, k, factor) for k in conditions)


def means(c: Computed, output: str, conditions, factor: float) -> str:
    """Its means alone, of starts that hardly differ."""
    found = [c.readings[BETTER].values(output, k) for k in conditions]
    return ", ".join(digits(v.mean() * factor) if len(v) else "-" for v in found)


def both(c: Computed, key: str, name: str) -> str:
    """The same of every map."""
    return ", ".join(c.part(column, key, name) for column in c.maps)


def deviation(c: Computed, condition: str) -> str:
    """Deviation ratio over the axial map: its median and middle 80 %."""
    return c.maps[AXIAL].middle("deviation", condition, PERCENT, digits)


def whole(c: Computed, column: str) -> int:
    """Points of a map that are done under every condition."""
    found = np.array([c.maps[column].means("deviation", k) for k in MAPPED])
    return int(np.isfinite(found).all(axis=0).sum())


def driven(c: Computed, column: str) -> str:
    """Runs of a map in which friction drives the cage, of all that are done, and the largest share
    of time that balls are off the inner ring."""
    force = np.array([c.maps[column].means("largest_pocket_force", k) for k in MAPPED])
    gaps = np.array([c.maps[column].means("gaps", k) for k in MAPPED]) * PERCENT
    wild = force > DRIVEN
    off = gaps[np.isfinite(gaps)].max(initial=0.0)
    return (
        f"{wild.sum()} of {np.isfinite(force).sum()} runs of the {NAMES[column]} (balls are off "
        f"the inner ring for {off:.2g} % of the time at most)"
    )


def driven_rechecked(c: Computed) -> list[str]:
    """Runs in which friction drives the cage, at points that were computed with both cages."""
    rigid, flexible = [], []
    for results in c.rechecks.values():
        one, other = (
            np.array([r.means("largest_pocket_force", k) for k in results.conditions])
            for r in (with_rigid_cage(c, results), results)
        )
        there = np.isfinite(one) & np.isfinite(other)
        rigid += list(one[there])
        flexible += list(other[there])
    if not rigid:
        return []
    wild = [int((np.array(force) > DRIVEN).sum()) for force in (rigid, flexible)]
    change = np.median(np.array(flexible) / np.array(rigid))
    return [
        f"Of these {len(rigid)} runs friction drives the cage in {wild[0]} with a rigid and in "
        f"{wild[1]} with an elastic cage; the largest force in a pocket is {digits(change)} times "
        "that of a rigid one (median)."
    ]


def by_starts(c: Computed) -> str:
    """Starts of every reading, in words."""
    return ", ".join(f"{r.starts} ({column})" for column, r in c.readings.items())


def wild_starts(c: Computed, *conditions: str) -> str:
    """Starts of the better model in which friction drives the cage, of all."""
    force = np.concatenate(
        [c.readings[BETTER].values("largest_pocket_force", k) for k in conditions]
    )
    return f"{(force > DRIVEN).sum()} of {len(force)}"


def calm_ratio(c: Computed) -> str:
    """Least and largest ratio of calm runs of the better model, and of driven ones [%]."""
    r = c.readings[BETTER]
    ratio, force = (np.concatenate([r.values(o, k) for k in (*ALL_SPEEDS, *ALL_LOADS[1:])])
                    for o in ("deviation", "largest_pocket_force"))  # fmt: skip
    calm, wild = ratio[force <= DRIVEN] * PERCENT, ratio[force > DRIVEN] * PERCENT
    least = f"{digits(calm.min())} to {digits(calm.max())} %" if len(calm) else "-"
    if not len(wild):
        return least
    return f"{least}, driven ones {digits(wild.min())} to {digits(wild.max())} %"


def wild_by_land(c: Computed) -> str:
    """Runs of both maps in which friction drives the cage, by what the cage may meet of a ring."""
    wild, done = Counter[str](), Counter[str]()
    for joined in c.maps.values():
        for part in joined.parts:
            place = part.names.index("land")
            lands = [values[place] for values in part.about["values"]]
            for condition in MAPPED:
                forces = part.means("largest_pocket_force", condition)
                for land, force in zip(lands, forces):
                    done[land] += bool(np.isfinite(force))
                    wild[land] += bool(force > DRIVEN)
    return ", ".join(f"{wild[land]} of {done[land]} ({land})" for land in done)


def met(c: Computed) -> str:
    """Runs of the better model in which the cage meets a shoulder, of all."""
    done = [row for row in c.readings[BETTER].rows if row.state == "done"]
    return f"{sum(warns(row, 'meets_ring') for row in done)} of {len(done)}"
