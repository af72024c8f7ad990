"""Figures of a ball bearing's summary: how balls turn and slip, contact angles, contact forces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics
from flexcage.results.metrics import BearingNumbers
from flexcage.results.statistics import roller_passes
from flexcage.results.summary import Row, Section

if TYPE_CHECKING:
    import xarray

LOW_PASS = 2e3  # Hz, below which the deviation of the cage's speed is taken
LEAST = 16  # samples, of which that filter wants more than 15


def speed_rows(ds: xarray.Dataset, bearing: BearingNumbers) -> tuple[Row, ...]:
    """Speed of balls about their own axes, against pure rolling."""
    inner = float(ds["inner_speed"].mean())
    spin = float(metrics.ball_spin(ds).mean())
    return (
        Row("ball_spin", "Ball speed, mean of all", spin, "rpm", "about its own axis, cage frame"),
        Row("ball_spin_ideal", "Ball speed, pure rolling",
            abs(bearing.kinematics(inner).roller_spin_in_cage), "rpm"),
    )  # fmt: skip


def slip_section(ds: xarray.Dataset, bearing: BearingNumbers, creep_speed: float | None) -> Section:
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
    fast = [float(sliding[..., k][zone].mean()) if zone.any() else np.nan for k in range(2)]
    note = ""
    if creep_speed is not None and max(fast) < creep_speed:
        note = f"unresolved: sliding is under the law's creep speed {creep_speed:.3g} m/s"
    rows = [
        Row.of("slip_loaded", "Loaded balls, slip ratio", loaded, "%", note),
        Row.of("slip_unloaded", "Unloaded balls, slip ratio", unloaded, "%"),
    ]
    for k, race in enumerate(("inner", "outer")):
        touching = force[..., k] > 0.0
        rows.append(Row(f"sliding_{race}_loaded", f"Sliding, {race} race, loaded", fast[k], "m/s",
                        "along the rolling direction, in the middle"))  # fmt: skip
        there = angle[..., k][touching & zone]
        low, high = np.degrees([there.min(), there.max()]) if there.size else (np.nan, np.nan)
        rows.append(Row(f"contact_angle_{race}", f"Contact angle, {race} race",
                        float(there.mean()) if there.size else None, "deg",
                        f"loaded balls; {low:.2f} to {high:.2f} deg"))  # fmt: skip
    rows.append(Row("loaded_share", "Balls that are loaded", float(zone.mean()), "%"))
    return Section("Balls", tuple(rows))


def motion_rows(ds: xarray.Dataset) -> tuple[Row, ...]:
    """How steadily the cage's centre moves."""
    whole = metrics.whole_revolutions(ds)
    axis = metrics.whirl(whole, about="axis")
    rate = 1.0 / float(np.median(np.diff(ds["time"].values)))
    note = f"of the centre's speed, at {rate / 1e3:g} kHz, low-pass {LOW_PASS / 1e3:g} kHz"
    enough = rate > 2.2 * LOW_PASS and ds.sizes["time"] >= max(LEAST, 4.0 * rate / LOW_PASS)
    steady = metrics.velocity_deviation(ds, low_pass=LOW_PASS) if enough else None
    return (
        Row("whirl_difference", "Whirl radius, max - min", axis.largest - axis.smallest, "um",
            "about the ring's axis"),
        Row("velocity_deviation", "Deviation over mean", steady, "%", note),
    )  # fmt: skip


def race_rows(ds: xarray.Dataset) -> tuple[Row, ...]:
    """Largest normal forces of both races on a ball."""
    force = ds["contact_force"].max("time")
    inner, outer = (float(force.sel(race=r).max()) for r in ("inner", "outer"))
    return (
        Row("race_force_inner", "Inner race on a ball, peak", inner, "N"),
        Row("race_force_outer", "Outer race on a ball, peak", outer, "N"),
    )
