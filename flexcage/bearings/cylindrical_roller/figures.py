"""Figures of a roller bearing's summary: how rollers turn and slip."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.bearings.cylindrical_roller.slip import slip as roller_slip
from flexcage.bearings.cylindrical_roller.slip import slip_ratio
from flexcage.results import metrics
from flexcage.results.figures import OwnFigures
from flexcage.results.known import SIGNED, STATISTIC, figures_in
from flexcage.results.metrics import BearingNumbers, SlipRange
from flexcage.results.statistics import Windows, element_passes
from flexcage.results.summary import Row, Section, figure, statistic

if TYPE_CHECKING:
    import xarray

KNOWN = (
    *figures_in(
        "Speeds",
        ("roller_spin", "Roller spin, mean of all", "rpm",
         "about the roller's axis, inertial frame, positive as in rolling", SIGNED),
        ("roller_spin_ideal", "Roller spin, pure rolling", "rpm", "the same in pure rolling",
         SIGNED),
    ),
    *figures_in(
        "Slip",
        ("sliding_inner_unloaded", "Sliding, inner race, unloaded", "m/s",
         "mean sliding speed of unloaded rollers", SIGNED),
        ("sliding_outer_unloaded", "Sliding, outer race, unloaded", "m/s",
         "mean sliding speed of unloaded rollers", SIGNED),
    ),
    *figures_in(
        "Forces",
        ("axial_through_ribs", "Axial load through ribs, mean", "N",
         "from ring to ring through all rollers; zero of the designs N and NU", STATISTIC),
        ("counter_rib_peak", "Counter rib on a roller, peak", "N",
         "largest normal force on one end; zero of the designs N and NU"),
    ),
)  # fmt: skip


def speed_rows(ds: xarray.Dataset, bearing: BearingNumbers) -> tuple[Row, ...]:
    inner = float(ds["inner_speed"].mean())
    spin = float(metrics.element_spin(ds).mean())
    note = "inertial frame, positive as in rolling"
    return (
        figure("roller_spin", spin, note),
        figure("roller_spin_ideal", abs(bearing.kinematics(inner).element_spin)),
    )


def slip_section(ds: xarray.Dataset, bearing: BearingNumbers, slip_range: SlipRange) -> Section:
    slip = roller_slip(ds, bearing)
    part = metrics.whole_revolutions(ds)
    ratio = slip_ratio(part, bearing).values
    zone = metrics.loaded_zone(part).transpose("time", "element").values
    windows = element_passes(part, bearing)
    loaded, unloaded = (
        windows.ratio(np.where(z, ratio, 0.0).sum(axis=1), z.sum(axis=1)) for z in (zone, ~zone)
    )
    mean = "mean over the zone"
    rows = (
        statistic("slip_loaded", loaded, slip_range.note(loaded.value, slip.sliding_loaded)),
        statistic(
            "slip_unloaded", unloaded, slip_range.note(unloaded.value, slip.sliding_unloaded)
        ),
        figure("sliding_inner_loaded", slip.sliding_loaded[0], mean),
        figure("sliding_outer_loaded", slip.sliding_loaded[1], mean),
        figure("sliding_inner_unloaded", slip.sliding_unloaded[0]),
        figure("sliding_outer_unloaded", slip.sliding_unloaded[1]),
        figure("loaded_share", slip.loaded_share),
    )
    return Section("Roller slip (inertial frame)", rows)


def force_rows(ds: xarray.Dataset, windows: Windows) -> tuple[Row, ...]:
    """What counter ribs bear; not shown of designs without any."""
    if "counter_rib_force" not in ds:  # a part of a run
        return ()
    force = ds["counter_rib_force"].transpose("time", "element", "rib").values
    plus, minus = np.moveaxis(force.sum(axis=1), -1, 0)
    idle = not force.any()
    return (
        statistic("axial_through_ribs", windows.mean(np.abs(plus - minus)), idle=idle),
        figure("counter_rib_peak", float(force.max()), idle=idle),
    )


FIGURES = OwnFigures(known=KNOWN, speeds=speed_rows, slip=slip_section, forces=force_rows)
