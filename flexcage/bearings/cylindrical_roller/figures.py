"""Figures of a roller bearing's summary: how rollers turn and slip, what counter ribs bear."""

from __future__ import annotations

import numpy as np

from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import OwnFigures, SettledRun


def _counter_ribs(part: SettledRun) -> np.ndarray | None:
    """Forces of counter ribs (time, element, rib) [N]."""
    if "counter_rib_force" not in part.ds:  # a part of a run
        return None
    return part.ds["counter_rib_force"].transpose("time", "element", "rib").values


def _through_ribs(part: SettledRun) -> Found | None:
    force = _counter_ribs(part)
    if force is None:
        return None
    plus, minus = np.moveaxis(force.sum(axis=1), -1, 0)
    return Found(part.windows.mean(np.abs(plus - minus)), idle=not force.any())


def _rib_peak(part: SettledRun) -> Found | None:
    force = _counter_ribs(part)
    return None if force is None else Found(float(force.max()), idle=not force.any())


def _skew(part: SettledRun) -> Found | None:
    if "element_tilt" not in part.ds:
        return None
    skew = part.ds["element_tilt"].sel(tilt="skew").transpose("time", "element").values
    return Found(part.windows.mean(np.abs(skew).max(axis=1)))


# fmt: off
SPEEDS = FigureTable[SettledRun]("Speeds")
SPEEDS.add("roller_spin", "Roller spin, mean of all", "rpm",
           "about the roller's axis, inertial frame, positive as in rolling", "signed",
           take=lambda part: Found(part.spin, "inertial frame, positive as in rolling"))
SPEEDS.add("roller_spin_ideal", "Roller spin, pure rolling", "rpm", "the same in pure rolling",
           "signed",
           take=lambda part: abs(part.bearing.kinematics(part.inner_speed).element_spin))
SLIP = FigureTable[SettledRun]("Slip")
SLIP.add("sliding_inner_unloaded", "Sliding, inner race, unloaded", "m/s",
         "mean sliding speed of unloaded rollers", "signed",
         take=lambda part: part.sliding_unloaded[0])
SLIP.add("sliding_outer_unloaded", "Sliding, outer race, unloaded", "m/s",
         "mean sliding speed of unloaded rollers", "signed",
         take=lambda part: part.sliding_unloaded[1])
SPEEDS.add("roller_skew", "Roller skew, largest", "mrad",
           "of all rollers' axes against the bearing's, in the tangent plane; mean over time",
           "statistic", take=_skew)
FORCES = FigureTable[SettledRun]("Forces")
FORCES.add("axial_through_ribs", "Axial load through ribs, mean", "N",
           "from ring to ring through all rollers; zero of the designs N and NU", "statistic",
           take=_through_ribs)
FORCES.add("counter_rib_peak", "Counter rib on a roller, peak", "N",
           "largest normal force on one end; zero of the designs N and NU", take=_rib_peak)
# fmt: on

FIGURES = OwnFigures(
    tables=(SPEEDS, SLIP, FORCES),
    slip_title="Roller slip (inertial frame)",
    slip=(
        "slip_loaded", "slip_unloaded", "sliding_inner_loaded", "sliding_outer_loaded",
        "sliding_inner_unloaded", "sliding_outer_unloaded", "loaded_share",
    ),
    sliding="mean over the zone",
)  # fmt: skip
