"""Figures of a roller bearing's summary: how rollers turn and slip, what counter ribs bear."""

from __future__ import annotations

import numpy as np

from flexcage.results.figures.figure import SIGNED, STATISTIC, Found, Table
from flexcage.results.figures.part import OwnFigures, Part

SPEEDS = Table[Part]("Speeds")


@SPEEDS.figure(
    "Roller spin, mean of all", "rpm",
    "about the roller's axis, inertial frame, positive as in rolling", SIGNED,
)  # fmt: skip
def roller_spin(part: Part) -> Found:
    return Found(part.spin, "inertial frame, positive as in rolling")


@SPEEDS.figure("Roller spin, pure rolling", "rpm", "the same in pure rolling", SIGNED)
def roller_spin_ideal(part: Part) -> float:
    return abs(part.bearing.kinematics(part.inner_speed).element_spin)


SLIP = Table[Part]("Slip")


@SLIP.figure(
    "Sliding, inner race, unloaded", "m/s", "mean sliding speed of unloaded rollers", SIGNED
)
def sliding_inner_unloaded(part: Part) -> float:
    return part.sliding_unloaded[0]


@SLIP.figure(
    "Sliding, outer race, unloaded", "m/s", "mean sliding speed of unloaded rollers", SIGNED
)
def sliding_outer_unloaded(part: Part) -> float:
    return part.sliding_unloaded[1]


FORCES = Table[Part]("Forces")


def _counter_ribs(part: Part) -> np.ndarray:
    """Forces of counter ribs (time, element, rib) [N]; none of designs without any."""
    if "counter_rib_force" not in part.ds:  # a part of a run
        return np.zeros((0, 0, 0))
    return part.ds["counter_rib_force"].transpose("time", "element", "rib").values


@FORCES.figure(
    "Axial load through ribs, mean", "N",
    "from ring to ring through all rollers; zero of the designs N and NU", STATISTIC,
)  # fmt: skip
def axial_through_ribs(part: Part) -> Found | None:
    force = _counter_ribs(part)
    if not force.size:
        return None
    plus, minus = np.moveaxis(force.sum(axis=1), -1, 0)
    return Found(part.windows.mean(np.abs(plus - minus)), idle=not force.any())


@FORCES.figure(
    "Counter rib on a roller, peak", "N",
    "largest normal force on one end; zero of the designs N and NU",
)  # fmt: skip
def counter_rib_peak(part: Part) -> Found | None:
    force = _counter_ribs(part)
    return Found(float(force.max()), idle=not force.any()) if force.size else None


FIGURES = OwnFigures(
    tables=(SPEEDS, SLIP, FORCES),
    slip_title="Roller slip (inertial frame)",
    slip=(
        "slip_loaded", "slip_unloaded", "sliding_inner_loaded", "sliding_outer_loaded",
        "sliding_inner_unloaded", "sliding_outer_unloaded", "loaded_share",
    ),
    sliding="mean over the zone",
)  # fmt: skip
