"""Figures of a ball bearing's summary: how balls turn and slip, contact angles, contact forces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics
from flexcage.results.metrics import BearingNumbers, SlipRange
from flexcage.results.statistics import roller_passes
from flexcage.results.summary import Row, Section

if TYPE_CHECKING:
    import xarray


def speed_rows(ds: xarray.Dataset, bearing: BearingNumbers) -> tuple[Row, ...]:
    """Speed of balls about their own axes, against pure rolling."""
    inner = float(ds["inner_speed"].mean())
    spin = float(metrics.ball_spin(ds).mean())
    note = "about its own axis, cage frame, positive as rolling has it"
    return (
        Row("ball_spin", "Ball speed, mean of all", spin, "rpm", note),
        Row("ball_spin_ideal", "Ball speed, pure rolling",
            abs(bearing.kinematics(inner).roller_spin_in_cage), "rpm"),
    )  # fmt: skip


def slip_section(ds: xarray.Dataset, bearing: BearingNumbers, slip_range: SlipRange) -> Section:
    """Slip ratios of loaded and unloaded balls, sliding and contact angles of loaded ones."""
    part = metrics.whole_revolutions(ds)
    ratio = metrics.ball_slip_ratio(part, bearing).transpose("time", "ball").values
    force = part["contact_force"].transpose("time", "ball", "race").values
    zone = metrics.loaded_zone(part).transpose("time", "ball").values
    windows = roller_passes(part, bearing)
    loaded, unloaded = (
        windows.ratio(np.where(z, ratio, 0.0).sum(axis=1), z.sum(axis=1)) for z in (zone, ~zone)
    )
    sliding = np.abs(part["contact_slip"].transpose("time", "ball", "race").values)
    angle = part["contact_angle"].transpose("time", "ball", "race").values
    fast, free = (
        [float(sliding[..., k][z].mean()) if z.any() else np.nan for k in range(2)]
        for z in (zone, ~zone)
    )
    rows = [
        Row.of("slip_loaded", "Loaded balls, slip ratio", loaded, "%",
               slip_range.note(loaded.value, fast)),
        Row.of("slip_unloaded", "Unloaded balls, slip ratio", unloaded, "%",
               slip_range.note(unloaded.value, free)),
    ]  # fmt: skip
    for k, race in enumerate(("inner", "outer")):
        touching = force[..., k] > 0.0
        rows.append(Row(f"sliding_{race}_loaded", f"Sliding, {race} race, loaded", fast[k], "m/s",
                        "along the rolling direction, in the middle"))  # fmt: skip
        there = angle[..., k][touching & zone]
        extremes = np.degrees([there.min(), there.max()]) if there.size else (np.nan, np.nan)
        low, high = (round(float(x), 2) + 0.0 for x in extremes)  # no "-0.00"
        rows.append(Row(f"contact_angle_{race}", f"Contact angle, {race} race",
                        float(there.mean()) if there.size else None, "deg",
                        f"loaded balls; {low:.2f} to {high:.2f} deg"))  # fmt: skip
    rows.append(Row("loaded_share", "Balls that are loaded", float(zone.mean()), "%"))
    return Section("Balls", tuple(rows))


def motion_rows(ds: xarray.Dataset) -> tuple[Row, ...]:
    """How far the cage's centre comes and goes."""
    axis = metrics.whirl(metrics.whole_revolutions(ds), about="axis")
    return (
        Row("whirl_difference", "Whirl radius, max - min", axis.largest - axis.smallest, "um",
            "about the ring's axis"),
    )  # fmt: skip


def race_rows(ds: xarray.Dataset) -> tuple[Row, ...]:
    """Largest normal forces of both races on a ball."""
    force = ds["contact_force"].max("time")
    inner, outer = (float(force.sel(race=r).max()) for r in ("inner", "outer"))
    return (
        Row("race_force_inner", "Inner race on a ball, peak", inner, "N"),
        Row("race_force_outer", "Outer race on a ball, peak", outer, "N"),
    )
