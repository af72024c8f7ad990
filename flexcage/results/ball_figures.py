"""Figures of a ball bearing's summary: how balls turn and slip, contact angles, contact forces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics
from flexcage.results.metrics import BearingNumbers, SlipRange
from flexcage.results.statistics import Record, roller_passes
from flexcage.results.summary import Row, Section, figure, statistic

if TYPE_CHECKING:
    import xarray


def at_angles(bearing: BearingNumbers) -> str:
    """At which contact angles a bearing's kinematics are taken, in words; "" for rollers' angle."""
    if bearing.own_angles is None:
        return ""
    inner, outer = np.degrees(bearing.own_angles)
    return f"pure rolling at the mean contact angles, {inner:.1f} deg inner, {outer:.1f} deg outer"


def at_nominal(bearing: BearingNumbers) -> str:
    """Likewise at the nominal contact angle."""
    return f"by the nominal contact angle, {np.degrees(bearing.contact_angle):.4g} deg"


def of_curvature(ds: xarray.Dataset, bearing: BearingNumbers) -> str:
    """What the grooves' curvature makes of the cage's slip ratio, in words; "" for rollers."""
    rolling = metrics.rolling_by_curvature(ds, bearing)
    if rolling is None:
        return ""
    return f"the grooves' curvature alone makes {100.0 * rolling.cage_slip:.2g} %"


def speed_rows(ds: xarray.Dataset, bearing: BearingNumbers) -> tuple[Row, ...]:
    """Speed of balls about their own axes, against pure rolling."""
    inner = float(ds["inner_speed"].mean())
    spin = float(metrics.ball_spin(ds).mean())
    note = "about its own axis, cage frame, positive as in rolling"
    own = metrics.at_own_angles(metrics.whole_revolutions(ds), bearing)
    return (
        figure("ball_spin", spin, note),
        figure("ball_spin_ideal", abs(own.kinematics(inner).roller_spin_in_cage), at_angles(own)),
    )


def slip_section(ds: xarray.Dataset, bearing: BearingNumbers, slip_range: SlipRange) -> Section:
    """Slip ratios of loaded and unloaded balls, sliding and contact angles of loaded ones."""
    part = metrics.whole_revolutions(ds)
    zone = metrics.loaded_zone(part).transpose("time", "ball").values
    sliding = np.abs(part["contact_slip"].transpose("time", "ball", "race").values)
    fast, free = (
        [float(sliding[..., k][z].mean()) if z.any() else np.nan for k in range(2)]
        for z in (zone, ~zone)
    )
    rows = [
        *_slip_rows(part, bearing, zone, slip_range, (fast, free)),
        *_race_figures(part, zone, fast),
        figure("loaded_share", float(zone.mean())),
    ]
    return Section("Balls", tuple(rows))


def _slip_rows(
    ds: xarray.Dataset,
    bearing: BearingNumbers,
    zone: np.ndarray,
    slip_range: SlipRange,
    sliding: tuple[list[float], list[float]],
) -> tuple[Row, ...]:
    """Slip ratios in the loaded ``zone`` (time, ball) and outside it, where inner and outer race
    slide at mean speeds [m/s]; by the nominal angle; and what the grooves' curvature makes."""
    windows = roller_passes(ds, bearing)

    def mean(ratio: xarray.DataArray, where: np.ndarray) -> Record:
        values = ratio.transpose("time", "ball").values
        return windows.ratio(np.where(where, values, 0.0).sum(axis=1), where.sum(axis=1))

    own = metrics.ball_slip_ratio(ds, bearing)
    loaded, unloaded = mean(own, zone), mean(own, ~zone)
    nominal = mean(metrics.ball_slip_ratio(ds, bearing, nominal=True), zone)
    rolling = metrics.rolling_by_curvature(ds, bearing)
    curved = rolling.sliding if rolling else ()
    of_curvature = rolling.ball_slip if rolling else None
    return (
        statistic("slip_loaded", loaded, slip_range.note(loaded.value, sliding[0], curved)),
        statistic("slip_loaded_nominal", nominal, at_nominal(bearing)),
        figure(
            "slip_curvature",
            of_curvature,
            "balls roll on lines beside the middle of curved contacts",
        ),
        statistic("slip_unloaded", unloaded, slip_range.note(unloaded.value, sliding[1])),
    )


def _race_figures(ds: xarray.Dataset, zone: np.ndarray, sliding: list[float]) -> list[Row]:
    """Mean ``sliding`` speeds [m/s] and contact angles of loaded balls at both races."""
    force = ds["contact_force"].transpose("time", "ball", "race").values
    angle = ds["contact_angle"].transpose("time", "ball", "race").values
    rows = []
    for k, race in enumerate(("inner", "outer")):
        touching = force[..., k] > 0.0
        rows.append(
            figure(
                f"sliding_{race}_loaded", sliding[k], "along the rolling direction, in the middle"
            )
        )
        there = angle[..., k][touching & zone]
        extremes = np.degrees([there.min(), there.max()]) if there.size else (np.nan, np.nan)
        low, high = (round(float(x), 2) + 0.0 for x in extremes)  # no "-0.00"
        rows.append(
            figure(
                f"contact_angle_{race}",
                float(there.mean()) if there.size else None,
                f"loaded balls; {low:.2f} to {high:.2f} deg",
            )
        )
    return rows


def motion_rows(ds: xarray.Dataset) -> tuple[Row, ...]:
    """How far the cage's centre comes and goes."""
    axis = metrics.whirl(metrics.whole_revolutions(ds), about="axis")
    return (figure("whirl_difference", axis.largest - axis.smallest, "about the ring's axis"),)


def race_rows(ds: xarray.Dataset) -> tuple[Row, ...]:
    """Largest normal forces of both races on a ball."""
    force = ds["contact_force"].max("time")
    inner, outer = (float(force.sel(race=r).max()) for r in ("inner", "outer"))
    return (
        figure("race_force_inner", inner),
        figure("race_force_outer", outer),
    )
