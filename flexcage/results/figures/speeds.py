"""Figures of the statistics, of the cage's speed, and of the elements' slip."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite

from flexcage.results.angles import at_angles
from flexcage.results.bootstrap import FEWEST
from flexcage.results.figures.figure import (
    BRIEF,
    CAGED,
    CONVERGENCE,
    FULL,
    LARGE,
    SETTLING,
    SIGNED,
    STATISTIC,
    TEXT,
    Facts,
    Figure,
    Found,
    Table,
)
from flexcage.results.figures.part import Part
from flexcage.results.statistics import Record

JOINT = 1.25  # times its margin a drift must be, for that three figures err together in 5 % of runs
#: What ``drift`` says where no figure does.
NO_DRIFT = "none"


@dataclass(frozen=True, eq=False)
class Taken(Facts):
    """A part of a run, and of its figures those that show whether it has settled, with their
    records."""

    part: Part
    watched: Mapping[Figure, Record]

    @property
    def words(self) -> Mapping[str, str]:
        return self.part.words


STATISTICS = Table[Taken]("Statistics")


@STATISTICS.figure("Settled from", "ms", "end of the share that output.settle leaves out")
def settled_at(taken: Taken) -> Found:
    part = taken.part
    return Found(float(part.ds["time"][0]), f"{100.0 * part.settle:g} % of the run left out")


@STATISTICS.figure("Time in statistics", "ms", "length of the settled part")
def settled_time(taken: Taken) -> float:
    begin, end = (float(taken.part.ds["time"][k]) for k in (0, -1))
    return end - begin


@STATISTICS.figure(
    "{Element} passes counted", "", "windows of one element pass in the settled part", BRIEF
)
def roller_passes(taken: Taken) -> Found:
    count = len(taken.part.windows.first)
    few = "" if count >= FEWEST else f"; intervals need {FEWEST}"
    return Found(count, f"± is a 95 % interval{few}")


@STATISTICS.figure(
    "Still drifting", "",
    "figures that differ beyond the intervals between the halves of the settled part", TEXT,
)  # fmt: skip
def drift(taken: Taken) -> Found:
    drifts = {figure.quantity: record.drift for figure, record in taken.watched.items()}
    if not any(isfinite(d) for d in drifts.values()):
        return Found(None, f"too few passes to tell: {2 * FEWEST} are needed")
    if drifting := ", ".join(name for name, d in drifts.items() if d > JOINT):
        return Found(drifting, "beyond the intervals: not settled, raise output.settle")
    return Found(NO_DRIFT)


SPEEDS = Table[Part]("Speeds")


@SPEEDS.figure("Inner ring speed", "rpm", "mean", SIGNED)
def inner_speed(part: Part) -> float:
    return part.inner_speed


@SPEEDS.figure(
    "Cage speed", "rpm", "mean over whole turns of the cage",
    CAGED, SIGNED, STATISTIC, BRIEF, LARGE, SETTLING, CONVERGENCE,
)  # fmt: skip
def cage_speed(part: Part) -> Found:
    whole = f"mean of {part.speed.revolutions:.2f} cage revolutions"
    return Found(part.speed.mean, whole, part.whole_windows.mean(part.omega))


@SPEEDS.figure(
    "{Element}s' orbital speed", "rpm", "mean of all, over whole turns; without a cage",
    FULL, SIGNED, STATISTIC, BRIEF, LARGE, SETTLING, CONVERGENCE,
)  # fmt: skip
def orbital_speed(part: Part) -> Found:
    whole = f"mean of {part.speed.revolutions:.2f} turns"
    return Found(part.speed.mean, whole, part.whole_windows.mean(part.omega))


@SPEEDS.figure(
    "Epicyclic cage speed", "rpm",
    "cage speed of pure rolling, of balls at the run's mean contact angles", SIGNED,
)  # fmt: skip
def epicyclic_speed(part: Part) -> Found:
    return Found(part.speed.epicyclic, at_angles(part.own))


@SPEEDS.figure(
    "Cage slip ratio", "%", "(epicyclic speed - cage speed) / epicyclic speed",
    CAGED, SIGNED, STATISTIC, BRIEF, LARGE, CONVERGENCE,
)  # fmt: skip
def cage_slip_ratio(part: Part) -> Found:
    curved = ""
    if part.rolling is not None:
        curved = f"the grooves' curvature alone makes {100.0 * part.rolling.cage_slip:.2g} %"
    return Found(part.speed.slip_ratio, curved, part.slip(part.own))


@SPEEDS.figure(
    "Cage speed ripple", "%", "standard deviation over mean of the cage's speed",
    CAGED, STATISTIC, CONVERGENCE,
)  # fmt: skip
def cage_speed_ripple(part: Part) -> Found:
    return Found(part.whole_windows.deviation(part.omega), "standard deviation over mean")


SPEEDS.add(
    "orbital_slip_ratio", "{Element}s' orbital slip ratio", "%",
    "(epicyclic speed - orbital speed) / epicyclic speed; without a cage",
    FULL, SIGNED, STATISTIC, BRIEF, LARGE, CONVERGENCE, take=cage_slip_ratio,
)  # fmt: skip


SLIP = Table[Part]("Slip")


@SLIP.figure(
    "Slip ratio, loaded elements", "%",
    "mean over elements that bear more than 1 % of the largest inner race force",
    SIGNED, STATISTIC, BRIEF, CONVERGENCE,
)  # fmt: skip
def slip_loaded(part: Part) -> Found:
    loaded, _ = part.element_slip
    curved = part.rolling.sliding if part.rolling else ()
    return Found(loaded, part.slip_range.note(loaded.value, part.sliding_loaded, curved))


@SLIP.figure(
    "Slip ratio, unloaded elements", "%", "mean over the others", SIGNED, STATISTIC, CONVERGENCE
)
def slip_unloaded(part: Part) -> Found:
    _, unloaded = part.element_slip
    return Found(unloaded, part.slip_range.note(unloaded.value, part.sliding_unloaded))


@SLIP.figure("Sliding, inner race, loaded", "m/s", "mean sliding speed of loaded elements", SIGNED)
def sliding_inner_loaded(part: Part) -> Found:
    return Found(part.sliding_loaded[0], part.of_family.sliding)


@SLIP.figure("Sliding, outer race, loaded", "m/s", "mean sliding speed of loaded elements", SIGNED)
def sliding_outer_loaded(part: Part) -> Found:
    return Found(part.sliding_loaded[1], part.of_family.sliding)


@SLIP.figure("Loaded elements", "%", "share of all elements")
def loaded_share(part: Part) -> float:
    return float(part.zone.mean())
