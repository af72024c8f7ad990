"""Losses of tapered rollers in the static solution: creep, rolling resistance, the rib and drag.

A roller's speeds are those of its balance (``statics.rolling_losses``). Cones that share an apex
slide alike, relative to their radius, all along their lines: tractions are those at mid-length. The
turning of an end on its own spot on the rib is left out. An element that bears nothing on the inner
race rolls on the outer one at the others' speed.
"""

from __future__ import annotations

from math import cos, sin

import numpy as np

from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.system.statics.losses import (
    Losses,
    friction_over_speed,
    settled_speeds,
    summed,
)
from flexcage.system.statics.rolling_losses import RollingRoller, Touch
from flexcage.system.statics.state import StaticState

_SIGNS = (1.0, -1.0)  # of inner and outer race, inwards


def tapered_losses(
    bearing: TaperedRollerBearing, solution: StaticState, *, contacts: Contacts,
    lubricant: Lubricant,
) -> Losses:  # fmt: skip
    """Losses of a tapered roller bearing's static solution."""
    e, speed = solution.elements, solution.speed
    drag = 0.5 * lubricant.density * lubricant.oil_fraction * lubricant.drag_coefficient
    drag *= bearing.roller_diameter * bearing.roller_length
    touches, pitch = _touches(bearing, lubricant, speed), bearing.pitch_radius
    on_races = friction_over_speed(contacts.race.friction)
    ratios = on_races, on_races, friction_over_speed(contacts.rib.friction)
    ribs = _rib_forces(bearing, solution)
    lost, rolled, torque, dragged, found = np.zeros(3), np.zeros(3), 0.0, 0.0, []
    loaded = np.flatnonzero((e.force > 0.0).all(axis=1))
    for k in loaded:
        forces = tuple(np.array([q]) for q in (*e.force[k], ribs[k]))
        roller = RollingRoller(touches, forces, ratios, pitch, drag)
        orbit = float(e.orbital_speed[k])
        first = np.array([_turn(bearing, touches[1], orbit), orbit])
        speeds = settled_speeds(roller.unbalance, first, abs(speed))
        acts = roller.acts(speeds)
        lost += [a.sliding for a in acts]
        rolled += [a.rolling for a in acts]
        torque += acts[0].about_bearing + acts[2].about_bearing
        dragged += drag * abs(pitch * speeds[1]) ** 3
        found.append((speeds[1], abs(speeds[0] + speeds[1] * cos(bearing.axis_angle))))
    orbit = float(np.mean([o for o, _ in found]))
    for k in np.setdiff1d(np.arange(len(e.force)), loaded):
        speeds = np.array([_turn(bearing, touches[1], orbit), orbit])
        alone = touches[1].act(ratios[1], e.force[k, 1:], speeds).rolling
        in_oil = drag * abs(pitch * orbit) ** 3
        rolled[1] += alone
        dragged += in_oil
        torque += (alone + in_oil) / speed
    places = {"drag": dragged, "inner ribs": float(lost[2])}
    return summed(places, lost[:2], rolled[:2], drive=torque, speeds=np.array(found))


def _turn(b: TaperedRollerBearing, outer: Touch, orbit: float) -> float:
    """Speed [rad/s] about its own axis of a roller that rolls on the outer race."""
    return -orbit * float(outer.ring_radius[0]) / (0.5 * b.roller_diameter)


def _rib_forces(b: TaperedRollerBearing, solution: StaticState) -> np.ndarray:
    """Forces (Z,) [N] normal to the rib's face."""
    assert solution.elements.axial is not None
    found: np.ndarray = solution.elements.axial / cos(b.axis_angle - b.rib_angle)
    return found


def _touches(
    b: TaperedRollerBearing, lubricant: Lubricant, speed: float
) -> tuple[Touch, Touch, Touch]:
    from flexcage.contacts.laws import rolling_resistance

    made, own = [], 0.5 * b.roller_diameter
    for k, (sign, turning) in enumerate(zip(_SIGNS, (speed, 0.0))):
        curved = b.curvature_radii[k]
        resistance = rolling_resistance(lubricant, curved, b.effective_length, b.race_modulus)
        radii = np.array([0.5 * b.race_diameters[k]]), np.array([sign * own])
        made.append(Touch(*radii, turning, resistance))
    along, across = b.rib_place
    radius = b.pitch_radius - along * sin(b.axis_angle) + across * cos(b.axis_angle)
    rib = Touch(np.array([radius]), np.array([-across]), speed, np.zeros(2))
    return made[0], made[1], rib
