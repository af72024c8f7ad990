"""Figures of a ball bearing's summary: how balls turn and slip, contact angles, contact forces."""

from __future__ import annotations

from functools import partial

import numpy as np

from flexcage.bearings.ball.slip import slip_ratio
from flexcage.results.angles import at_angles, at_nominal
from flexcage.results.edges import Edges
from flexcage.results.figures.figure import BRIEF, SIGNED, STATISTIC, Found, Table
from flexcage.results.figures.part import OwnFigures, Part

SPEEDS = Table[Part]("Speeds")


@SPEEDS.figure(
    "Epicyclic cage speed, nominal", "rpm",
    "cage speed of pure rolling at the nominal contact angle", SIGNED,
)  # fmt: skip
def epicyclic_speed_nominal(part: Part) -> Found:
    """Balls leave that angle under load."""
    return Found(part.speed.nominal, at_nominal(part.bearing))


@SPEEDS.figure("Cage slip ratio, nominal", "%", "cage slip against that speed", SIGNED, STATISTIC)
def cage_slip_ratio_nominal(part: Part) -> Found | None:
    if not part.caged:
        return None
    slip = part.slip(part.bearing.nominal)
    return Found(part.speed.nominal_slip, at_nominal(part.bearing), slip)


@SPEEDS.figure(
    "Ball speed, mean of all", "rpm",
    "about the ball's axis, cage frame, positive as in rolling", SIGNED,
)  # fmt: skip
def ball_spin(part: Part) -> Found:
    return Found(part.spin, "about its own axis, cage frame, positive as in rolling")


@SPEEDS.figure(
    "Ball speed, pure rolling", "rpm",
    "the same in pure rolling at the run's mean contact angles", SIGNED,
)  # fmt: skip
def ball_spin_ideal(part: Part) -> Found:
    ideal = part.own.kinematics(part.inner_speed).element_spin_in_cage
    return Found(abs(ideal), at_angles(part.own))


SLIP = Table[Part]("Slip")


@SLIP.figure(
    "Slip ratio, loaded balls, nominal", "%",
    "loaded balls' slip against pure rolling at the nominal contact angle", SIGNED, STATISTIC,
)  # fmt: skip
def slip_loaded_nominal(part: Part) -> Found:
    nominal = slip_ratio(part.whole, part.bearing, nominal=True)
    return Found(part.over(nominal, part.zone), at_nominal(part.bearing))


@SLIP.figure(
    "Slip ratio by the grooves' curvature", "%",
    "what curvature alone makes: balls roll on lines beside the middle of a contact",
)  # fmt: skip
def slip_curvature(part: Part) -> Found:
    note = "balls roll on lines beside the middle of curved contacts"
    return Found(part.rolling.ball_slip if part.rolling else None, note)


def _contact_angle(race: int, part: Part) -> Found:
    """Mean of loaded balls that touch a race, and how far it ranges."""
    force, angle = (
        part.whole[name].transpose("time", "element", "race").values[..., race]
        for name in ("race_force", "contact_angle")
    )
    there = angle[(force > 0.0) & part.zone]
    extremes = np.degrees([there.min(), there.max()]) if there.size else (np.nan, np.nan)
    low, high = (round(float(x), 2) + 0.0 for x in extremes)  # no "-0.00"
    mean = float(there.mean()) if there.size else None
    return Found(mean, f"loaded balls; {low:.2f} to {high:.2f} deg")


SLIP.add(
    "contact_angle_inner", "Contact angle, inner race", "deg", "mean of loaded balls", SIGNED,
    BRIEF, take=partial(_contact_angle, 0),
)  # fmt: skip
SLIP.add(
    "contact_angle_outer", "Contact angle, outer race", "deg", "mean of loaded balls", SIGNED,
    take=partial(_contact_angle, 1),
)  # fmt: skip


GROOVES = Table[Edges]("Grooves")


@GROOVES.figure(
    "Ellipse beyond the inner groove's edge", "deg",
    "largest angle by which a contact ellipse passes the edge; below zero: it stays within", SIGNED,
)  # fmt: skip
def edge_inner(edges: Edges) -> Found | None:
    return edges.at("inner")


@GROOVES.figure("Ellipse beyond the outer groove's edge", "deg", "likewise", SIGNED)
def edge_outer(edges: Edges) -> Found | None:
    return edges.at("outer")


MOTION = Table[Part]("Cage motion")


@MOTION.figure(
    "Whirl radius, max - min", "um", "of the centre's distance from the ring's axis", SIGNED
)
def whirl_difference(part: Part) -> Found | None:
    """How far the cage's centre comes and goes."""
    if not part.caged:
        return None
    axis = part.about_axis
    return Found(axis.largest - axis.smallest, "about the ring's axis")


FIGURES = OwnFigures(
    tables=(SPEEDS, SLIP, GROOVES, MOTION),
    slip_title="Balls",
    slip=(
        "slip_loaded", "slip_loaded_nominal", "slip_curvature", "slip_unloaded",
        "sliding_inner_loaded", "contact_angle_inner", "sliding_outer_loaded",
        "contact_angle_outer", "loaded_share",
    ),
    sliding="along the rolling direction, in the middle",
)  # fmt: skip
