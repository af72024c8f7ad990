"""Figures of a four-point contact bearing's summary: on how many contacts its balls run."""

from __future__ import annotations

from dataclasses import replace
from functools import partial

import numpy as np

from flexcage.bearings.ball.figures import FIGURES as BALLS
from flexcage.bearings.ball.figures import GROOVES, MOTION, SLIP, SPEEDS
from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import SettledRun

_TOUCHING = 1e-6  # of the run's largest force of an arc


def _contacts(part: SettledRun) -> np.ndarray:
    """How many arcs carry each loaded ball, over samples and balls."""
    force = part.whole["arc_force"].transpose("time", "element", "race", "arc").values
    carried = (force > _TOUCHING * force.max()).sum(axis=(2, 3))
    found: np.ndarray = carried[part.zone]
    return found


def _share(count: int, part: SettledRun) -> Found:
    carried = _contacts(part)
    return Found(float((carried == count).mean()) if carried.size else None, "of loaded balls")


def _steepness(race: int, part: SettledRun) -> Found:
    angle = part.whole["contact_angle"].transpose("time", "element", "race").values[..., race]
    there = np.abs(angle[part.zone])
    return Found(float(there.mean()) if there.size else None, "of the arc that bears most")


# fmt: off
CONTACTS = FigureTable[SettledRun]("Slip")
for _race, _name in enumerate(("inner", "outer")):
    CONTACTS.add(f"contact_steepness_{_name}", f"Contact angle, {_name} race, magnitude", "deg",
                 "mean of loaded balls, on the arc that bears most", "brief",
                 take=partial(_steepness, _race))
for _count in (2, 3, 4):
    CONTACTS.add(f"share_on_{_count}_contacts", f"Time on {_count} contacts", "%",
                 f"share of loaded balls' time in which {_count} arcs carry them", "brief",
                 take=partial(_share, _count))
# fmt: on

FIGURES = replace(
    BALLS,
    tables=(SPEEDS, SLIP, CONTACTS, GROOVES, MOTION),
    slip=(
        "slip_loaded", "slip_loaded_nominal", "slip_curvature", "slip_unloaded",
        "sliding_inner_loaded", "contact_steepness_inner", "sliding_outer_loaded",
        "contact_steepness_outer", "share_on_2_contacts", "share_on_3_contacts",
        "share_on_4_contacts", "loaded_share",
    ),
)  # fmt: skip
