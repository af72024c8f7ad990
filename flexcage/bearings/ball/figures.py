"""Figures of a ball bearing's summary: how balls turn and slip, contact angles, contact forces."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.bearings.ball.slip import slip_ratio
from flexcage.results import metrics
from flexcage.results.angles import at_angles, at_nominal
from flexcage.results.figures import OwnFigures
from flexcage.results.known import BRIEF, SIGNED, STATISTIC, figures_in
from flexcage.results.metrics import BearingNumbers, SlipRange
from flexcage.results.statistics import Record, element_passes
from flexcage.results.summary import Row, Section, figure, statistic

if TYPE_CHECKING:
    import xarray


KNOWN = (
    *figures_in(
        "Speeds",
        ("epicyclic_speed_nominal", "Epicyclic cage speed, nominal", "rpm",
         "cage speed of pure rolling at the nominal contact angle", SIGNED),
        ("cage_slip_ratio_nominal", "Cage slip ratio, nominal", "%", "cage slip against that speed",
         SIGNED, STATISTIC),
        ("ball_spin", "Ball speed, mean of all", "rpm",
         "about the ball's axis, cage frame, positive as in rolling", SIGNED),
        ("ball_spin_ideal", "Ball speed, pure rolling", "rpm",
         "the same in pure rolling at the run's mean contact angles", SIGNED),
    ),
    *figures_in(
        "Slip",
        ("slip_loaded_nominal", "Slip ratio, loaded balls, nominal", "%",
         "loaded balls' slip against pure rolling at the nominal contact angle", SIGNED, STATISTIC),
        ("slip_curvature", "Slip ratio by the grooves' curvature", "%",
         "what curvature alone makes: balls roll on lines beside the middle of a contact"),
        ("contact_angle_inner", "Contact angle, inner race", "deg", "mean of loaded balls", SIGNED,
         BRIEF),
        ("contact_angle_outer", "Contact angle, outer race", "deg", "mean of loaded balls", SIGNED),
    ),
    *figures_in(
        "Grooves",
        ("edge_inner", "Ellipse beyond the inner groove's edge", "deg",
         "largest angle by which a contact ellipse passes the edge; below zero: it stays within",
         SIGNED),
        ("edge_outer", "Ellipse beyond the outer groove's edge", "deg", "likewise", SIGNED),
    ),
    *figures_in(
        "Cage motion",
        ("whirl_difference", "Whirl radius, max - min", "um",
         "of the centre's distance from the ring's axis", SIGNED),
    ),
)  # fmt: skip


def speed_rows(ds: xarray.Dataset, bearing: BearingNumbers) -> tuple[Row, ...]:
    """Speed of balls about their own axes, against pure rolling."""
    inner = float(ds["inner_speed"].mean())
    spin = float(metrics.element_spin(ds).mean())
    note = "about its own axis, cage frame, positive as in rolling"
    own = metrics.at_own_angles(metrics.whole_revolutions(ds), bearing)
    return (
        *_nominal_rows(ds, bearing),
        figure("ball_spin", spin, note),
        figure("ball_spin_ideal", abs(own.kinematics(inner).element_spin_in_cage), at_angles(own)),
    )


def _nominal_rows(ds: xarray.Dataset, bearing: BearingNumbers) -> tuple[Row, ...]:
    """What the cage's speed of pure rolling would be at the nominal contact angle, which balls
    leave under load."""
    speed, note = metrics.cage_speed(ds, bearing), at_nominal(bearing)
    part = metrics.whole_revolutions(ds)
    ideal = part["inner_speed"].values * bearing.nominal.kinematics(1.0).cage_speed
    if not metrics.caged(ds):
        return (figure("epicyclic_speed_nominal", speed.nominal, note),)
    slip = element_passes(part, bearing).ratio(ideal - metrics.carrier_speed(part).values, ideal)
    return (
        figure("epicyclic_speed_nominal", speed.nominal, note),
        statistic("cage_slip_ratio_nominal", slip, note, value=speed.nominal_slip),
    )


def slip_section(ds: xarray.Dataset, bearing: BearingNumbers, slip_range: SlipRange) -> Section:
    """Slip ratios of loaded and unloaded balls, sliding and contact angles of loaded ones."""
    part = metrics.whole_revolutions(ds)
    zone = metrics.loaded_zone(part).transpose("time", "element").values
    sliding = np.abs(part["race_slip"].transpose("time", "element", "race").values)
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
    """Slip ratios in the loaded ``zone`` (time, element) and outside it, where inner and outer race
    slide at mean speeds [m/s]; by the nominal angle; and what the grooves' curvature makes."""
    windows = element_passes(ds, bearing)

    def mean(ratio: xarray.DataArray, where: np.ndarray) -> Record:
        values = ratio.transpose("time", "element").values
        return windows.ratio(np.where(where, values, 0.0).sum(axis=1), where.sum(axis=1))

    own = slip_ratio(ds, bearing)
    loaded, unloaded = mean(own, zone), mean(own, ~zone)
    nominal = mean(slip_ratio(ds, bearing, nominal=True), zone)
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
    force = ds["race_force"].transpose("time", "element", "race").values
    angle = ds["contact_angle"].transpose("time", "element", "race").values
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


FIGURES = OwnFigures(known=KNOWN, speeds=speed_rows, slip=slip_section, motion=motion_rows)
