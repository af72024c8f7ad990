"""Figures of a tapered roller bearing's summary: how rollers turn and skew, what the rib bears."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from flexcage.bearings.cylindrical_roller.figures import FIGURES as OF_ROLLERS
from flexcage.bearings.cylindrical_roller.figures import SLIP
from flexcage.bearings.cylindrical_roller.figures import SPEEDS as ROLLERS
from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import SettledRun


def _rib(part: SettledRun) -> np.ndarray | None:
    """Forces of the large rib (time, element) [N]."""
    if "rib_force" not in part.ds:  # a part of a run
        return None
    force: np.ndarray = part.ds["rib_force"].sel(rib="-x").transpose("time", "element").values
    return force


def _rib_peak(part: SettledRun) -> Found | None:
    force = _rib(part)
    return None if force is None else Found(float(force.max()))


def _rib_sum(part: SettledRun) -> Found | None:
    force = _rib(part)
    return None if force is None else Found(part.windows.mean(force.sum(axis=1)))


def _loaded_skew(part: SettledRun) -> Found | None:
    if "element_tilt" not in part.ds:
        return None
    return Found(part.over(part.whole["element_tilt"].sel(tilt="skew", drop=True), part.zone))


# fmt: off
SPEEDS = FigureTable[SettledRun]("Speeds")
SPEEDS.add("tapered_spin", "Roller speed, mean of all", "rpm",
           "about the roller's axis, cage frame, positive as in rolling", "signed",
           take=lambda part: Found(part.spin,
                                   "about its own axis, cage frame, positive as in rolling"))
SPEEDS.add("tapered_spin_ideal", "Roller speed, pure rolling", "rpm", "the same in pure rolling",
           "signed",
           take=lambda part: abs(part.bearing.kinematics(part.inner_speed).element_spin_in_cage))
SPEEDS.figures["roller_skew"] = ROLLERS.figures["roller_skew"]
SPEEDS.add("roller_skew_loaded", "Roller skew, loaded", "mrad",
           "mean of loaded rollers; positive: their large ends lead, in the positive sense about x",
           "signed", "statistic", take=_loaded_skew)
FORCES = FigureTable[SettledRun]("Forces")
FORCES.add("rib_load", "Large rib, on all rollers", "N",
           "sum of the normal forces on their ends; mean over time", "statistic", take=_rib_sum)
FORCES.add("rib_peak", "Large rib on a roller, peak", "N", "largest normal force on one end",
           take=_rib_peak)
# fmt: on

FIGURES = replace(OF_ROLLERS, tables=(SPEEDS, SLIP, FORCES), slip_title="Roller slip (cage frame)")
