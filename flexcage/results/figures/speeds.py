"""Figures of the statistics, of the cage's speed, and of the elements' slip."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite

from flexcage.results.bootstrap import FEWEST
from flexcage.results.figures.figure import CAGE_SPEED, Figure, FigureTable, Found
from flexcage.results.figures.part import SettledRun
from flexcage.results.statistics import Record

JOINT = 1.25  # times its margin a drift must be, for that three figures err together in 5 % of runs
#: What ``drift`` says where no figure does.
NO_DRIFT = "none"


@dataclass(frozen=True, eq=False)
class Taken:
    """A part of a run, and of its figures those that show whether it has settled, with their
    records."""

    part: SettledRun
    watched: Mapping[Figure, Record]


def _settled_at(taken: Taken) -> Found:
    left_out = f"{100.0 * taken.part.settle:g} % of the run left out"
    return Found(float(taken.part.ds["time"][0]), left_out)


def _settled_time(taken: Taken) -> float:
    begin, end = (float(taken.part.ds["time"][k]) for k in (0, -1))
    return end - begin


def _passes(taken: Taken) -> Found:
    count = len(taken.part.windows.first)
    few = "" if count >= FEWEST else f"; intervals need {FEWEST}"
    return Found(count, f"± is a 95 % interval{few}")


def _drift(taken: Taken) -> Found:
    drifts = {figure.quantity: record.drift for figure, record in taken.watched.items()}
    if not any(isfinite(d) for d in drifts.values()):
        return Found(None, f"too few passes to tell: {2 * FEWEST} are needed")
    if drifting := ", ".join(name for name, d in drifts.items() if d > JOINT):
        return Found(drifting, "beyond the intervals: not settled, raise output.settle")
    return Found(NO_DRIFT)


# fmt: off
STATISTICS = FigureTable[Taken]("Statistics")
STATISTICS.add("settled_at", "Settled from", "ms",
               "end of the share that output.settle leaves out", take=_settled_at)
STATISTICS.add("settled_time", "Time in statistics", "ms", "length of the settled part",
               take=_settled_time)
STATISTICS.add("roller_passes", "{Element} passes counted", "",
               "windows of one element pass in the settled part", "brief", take=_passes)
STATISTICS.add("drift", "Still drifting", "",
               "figures that differ beyond the intervals between the halves of the settled part",
               "text", take=_drift)
# fmt: on


def _speed(turns: str, part: SettledRun) -> Found:
    whole = f"mean of {part.speed.revolutions:.2f} {turns}"
    return Found(part.speed.mean, whole, part.whole_windows.mean(part.omega))


def _slip(part: SettledRun) -> Found:
    curved = ""
    if part.rolling is not None:
        curved = f"the grooves' curvature alone makes {100.0 * part.rolling.cage_slip:.2g} %"
    return Found(part.speed.slip_ratio, curved, part.slip(part.own))


# fmt: off
SPEEDS = FigureTable[SettledRun]("Speeds")
SPEEDS.add("inner_speed", "Inner ring speed", "rpm", "mean", "signed",
           take=lambda part: part.inner_speed)
SPEEDS.add("cage_speed", CAGE_SPEED, "rpm", "mean over whole turns of the cage",
           "a cage", "signed", "statistic", "brief", "large", "settling", "convergence",
           take=lambda part: _speed("cage revolutions", part))
SPEEDS.add("orbital_speed", "{Element}s' orbital speed", "rpm",
           "mean of all, over whole turns; without a cage",
           "full complement", "signed", "statistic", "brief", "large", "settling", "convergence",
           take=lambda part: _speed("turns", part))
SPEEDS.add("epicyclic_speed", "Epicyclic cage speed", "rpm",
           "cage speed of pure rolling, of balls at the run's mean contact angles", "signed",
           take=lambda part: Found(part.speed.epicyclic, part.own.at_angles))
SPEEDS.add("cage_slip_ratio", "Cage slip ratio", "%",
           "(epicyclic speed - cage speed) / epicyclic speed",
           "a cage", "signed", "statistic", "brief", "large", "convergence", take=_slip)
SPEEDS.add("cage_speed_ripple", "Cage speed ripple", "%",
           "standard deviation over mean of the cage's speed", "a cage", "statistic", "convergence",
           take=lambda part: Found(part.whole_windows.deviation(part.omega),
                                   "standard deviation over mean"))
SPEEDS.add("orbital_slip_ratio", "{Element}s' orbital slip ratio", "%",
           "(epicyclic speed - orbital speed) / epicyclic speed; without a cage",
           "full complement", "signed", "statistic", "brief", "large", "convergence", take=_slip)
# fmt: on


def _loaded(part: SettledRun) -> Found:
    loaded, curved = part.element_slip[0], part.rolling.sliding if part.rolling else ()
    return Found(loaded, part.slip_range.note(loaded.value, part.sliding_loaded, curved))


def _unloaded(part: SettledRun) -> Found:
    unloaded = part.element_slip[1]
    return Found(unloaded, part.slip_range.note(unloaded.value, part.sliding_unloaded))


# fmt: off
SLIP = FigureTable[SettledRun]("Slip")
SLIP.add("slip_loaded", "Slip ratio, loaded elements", "%",
         "mean over elements that bear more than 1 % of the largest inner race force",
         "signed", "statistic", "brief", "convergence", take=_loaded)
SLIP.add("slip_unloaded", "Slip ratio, unloaded elements", "%", "mean over the others",
         "signed", "statistic", "convergence", take=_unloaded)
SLIP.add("sliding_inner_loaded", "Sliding, inner race, loaded", "m/s",
         "mean sliding speed of loaded elements", "signed",
         take=lambda part: Found(part.sliding_loaded[0], part.of_family.sliding))
SLIP.add("sliding_outer_loaded", "Sliding, outer race, loaded", "m/s",
         "mean sliding speed of loaded elements", "signed",
         take=lambda part: Found(part.sliding_loaded[1], part.of_family.sliding))
SLIP.add("loaded_share", "Loaded elements", "%", "share of all elements",
         take=lambda part: float(part.zone.mean()))
# fmt: on
