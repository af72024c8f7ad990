"""Figures of a ball bearing's summary: how balls turn and slip, contact angles, contact forces."""

from __future__ import annotations

from functools import partial

import numpy as np

from flexcage.bearings.ball.slip import slip_ratio
from flexcage.results.edges import Edge
from flexcage.results.figures.figure import FigureTable, Found
from flexcage.results.figures.part import OwnFigures, SettledRun


def _nominal_slip(part: SettledRun) -> Found | None:
    if not part.caged:
        return None
    slip = part.slip(part.bearing.nominal)
    return Found(part.speed.nominal_slip, part.bearing.at_nominal, slip)


def _spin_ideal(part: SettledRun) -> Found:
    ideal = part.own.kinematics(part.inner_speed).element_spin_in_cage
    return Found(abs(ideal), part.own.at_angles)


# fmt: off
SPEEDS = FigureTable[SettledRun]("Speeds")
SPEEDS.add("epicyclic_speed_nominal", "Epicyclic cage speed, nominal", "rpm",
           "cage speed of pure rolling at the nominal contact angle", "signed",
           take=lambda part: Found(part.speed.nominal, part.bearing.at_nominal))
SPEEDS.add("cage_slip_ratio_nominal", "Cage slip ratio, nominal", "%",
           "cage slip against that speed", "signed", "statistic", take=_nominal_slip)
SPEEDS.add("ball_spin", "Ball speed, mean of all", "rpm",
           "about the ball's axis, cage frame, positive as in rolling", "signed",
           take=lambda part: Found(part.spin,
                                   "about its own axis, cage frame, positive as in rolling"))
SPEEDS.add("ball_spin_ideal", "Ball speed, pure rolling", "rpm",
           "the same in pure rolling at the run's mean contact angles", "signed",
           take=_spin_ideal)
# fmt: on


def _slip_nominal(part: SettledRun) -> Found:
    """Balls leave the nominal contact angle under load."""
    nominal = slip_ratio(part.whole, part.bearing, nominal=True)
    return Found(part.over(nominal, part.zone), part.bearing.at_nominal)


def _curvature(part: SettledRun) -> Found:
    note = "balls roll on lines beside the middle of curved contacts"
    return Found(part.rolling.ball_slip if part.rolling else None, note)


def _contact_angle(race: int, part: SettledRun) -> Found:
    """Mean of loaded balls that touch a race, and how far it ranges; of two rows, whose angles
    have opposite signs, without these."""
    force, angle = (
        part.whole[name].transpose("time", "element", "race").values[..., race]
        for name in ("race_force", "contact_angle")
    )
    there = angle[(force > 0.0) & part.zone]
    if "row" in part.whole.coords:
        there = np.abs(there)
    extremes = np.degrees([there.min(), there.max()]) if there.size else (np.nan, np.nan)
    low, high = (round(float(x), 2) + 0.0 for x in extremes)  # no "-0.00"
    mean = float(there.mean()) if there.size else None
    return Found(mean, f"loaded balls; {low:.2f} to {high:.2f} deg")


# fmt: off
SLIP = FigureTable[SettledRun]("Slip")
SLIP.add("slip_loaded_nominal", "Slip ratio, loaded balls, nominal", "%",
         "loaded balls' slip against pure rolling at the nominal contact angle",
         "signed", "statistic", take=_slip_nominal)
SLIP.add("slip_curvature", "Slip ratio by the grooves' curvature", "%",
         "what curvature alone makes: balls roll on lines beside the middle of a contact",
         take=_curvature)
ANGLES = FigureTable[SettledRun]("Slip")
ANGLES.add("contact_angle_inner", "Contact angle, inner race", "deg", "mean of loaded balls",
         "signed", "brief", take=partial(_contact_angle, 0))
ANGLES.add("contact_angle_outer", "Contact angle, outer race", "deg", "mean of loaded balls",
         "signed", take=partial(_contact_angle, 1))
GROOVES = FigureTable[Edge]("Grooves")
GROOVES.add("edge_inner", "Ellipse beyond the inner groove's edge", "deg",
            "largest angle by which a contact ellipse passes the edge; below zero: it stays within",
            "signed", take=lambda edge: edge.found)
GROOVES.add("edge_outer", "Ellipse beyond the outer groove's edge", "deg", "likewise", "signed",
            take=lambda edge: edge.found)
MOTION = FigureTable[SettledRun]("Cage motion")
MOTION.add("whirl_difference", "Whirl radius, max - min", "um",
           "of the centre's distance from the ring's axis", "signed",
           take=lambda part: Found(part.about_axis.largest - part.about_axis.smallest,
                                   "about the ring's axis"))
# fmt: on

FIGURES = OwnFigures(
    tables=(SPEEDS, SLIP, ANGLES, GROOVES, MOTION),
    slip_title="Balls",
    slip=(
        "slip_loaded", "slip_loaded_nominal", "slip_curvature", "slip_unloaded",
        "sliding_inner_loaded", "contact_angle_inner", "sliding_outer_loaded",
        "contact_angle_outer", "loaded_share",
    ),
    sliding="along the rolling direction, in the middle",
)  # fmt: skip
