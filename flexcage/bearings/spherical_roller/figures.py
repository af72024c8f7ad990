"""Figures of a spherical roller bearing's summary: how barrels turn, and how far they skew."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from flexcage.bearings.cylindrical_roller.figures import FIGURES as OF_ROLLERS
from flexcage.bearings.cylindrical_roller.figures import SLIP
from flexcage.bearings.cylindrical_roller.figures import SPEEDS as ROLLERS
from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import SettledRun


def _loaded_skew(part: SettledRun) -> Found | None:
    if "element_tilt" not in part.ds:
        return None
    skew = part.whole["element_tilt"].sel(tilt="skew", drop=True)
    outwards = 2.0 * skew["row"] - 1.0
    ahead = np.sign(part.inner_speed) * outwards * skew
    return Found(part.over(ahead.transpose(*skew.dims), part.zone))


# fmt: off
SPEEDS = FigureTable[SettledRun]("Speeds")
SPEEDS.add("barrel_spin", "Barrel speed, mean of all", "rpm",
           "about the barrel's axis, cage frame, positive as in rolling", "signed",
           take=lambda part: Found(part.spin,
                                   "about its own axis, cage frame, positive as in rolling"))
SPEEDS.add("barrel_spin_ideal", "Barrel speed, pure rolling", "rpm", "the same in pure rolling",
           "signed",
           take=lambda part: abs(part.bearing.kinematics(part.inner_speed).element_spin_in_cage))
SPEEDS.figures["roller_skew"] = ROLLERS.figures["roller_skew"]
SPEEDS.add("barrel_skew_loaded", "Barrel skew, loaded", "mrad",
           "mean of loaded barrels of both rows; positive: their ends at the bearing's middle lead",
           "signed", "statistic", take=_loaded_skew)
# fmt: on

FIGURES = replace(OF_ROLLERS, tables=(SPEEDS, SLIP), slip_title="Roller slip (cage frame)")
