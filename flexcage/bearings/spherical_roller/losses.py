"""Losses of barrels in the static solution: sliding along curved lines, rolling resistance, drag.

A barrel's speeds are those of its balance (``statics.rolling_losses``), with the sliding of every
slice at the speed of its own radii: a barrel rolls in two places of a line and slides between and
beside them (A. Palmgren; T. A. Harris, Rolling Bearing Analysis, on friction), and races turn on
its lines of contact. Barrels that bear so little on the inner race that friction does not drive
them are pushed by the cage, or by others, and roll on the outer race at their speed.
"""

from __future__ import annotations

from math import cos, sin

import numpy as np

from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.bearings.spherical_roller.statics import slice_forces, slice_places
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.core.errors import RunFailed
from flexcage.system.statics.losses import Losses, friction_over_speed, settled_speeds, summed
from flexcage.system.statics.rolling_losses import RollingRoller, Touch
from flexcage.system.statics.state import StaticState

_SIGNS = (1.0, -1.0)  # of inner and outer race, inwards
_BEARS = 1e-3  # of the largest force: what bears less is not driven


def spherical_losses(
    bearing: SphericalRollerBearing, solution: StaticState, *, contacts: Contacts,
    lubricant: Lubricant,
) -> Losses:  # fmt: skip
    """Losses of a spherical roller bearing's static solution."""
    drag = 0.5 * lubricant.density * lubricant.oil_fraction * lubricant.drag_coefficient
    drag *= bearing.roller_diameter * bearing.roller_length
    touches = _touches(bearing, contacts, lubricant, solution.speed)
    ratio = friction_over_speed(contacts.race.friction)
    forces = slice_forces(bearing, solution, contacts)
    rollers = [
        RollingRoller(touches, tuple(force), (ratio, ratio), bearing.pitch_radius, drag)
        for force in forces
    ]
    speeds = _speeds(rollers, solution, forces.sum(axis=2))
    driven = ~np.isnan(speeds[:, 0])
    speeds[~driven] = _rolling(touches[1], float(speeds[driven, 1].mean()))
    acts = [own.acts(at) for own, at in zip(rollers, speeds)]
    lost = np.array([[a.sliding for a in both] for both in acts])
    rolled = np.array([[a.rolling for a in both] for both in acts])
    dragged = drag * np.abs(bearing.pitch_radius * speeds[:, 1]) ** 3
    torque = sum(acts[k][0].about_bearing for k in np.flatnonzero(driven))
    pushed = (lost + rolled).sum(axis=1) + dragged
    torque += pushed[~driven].sum() / solution.speed
    own = np.abs(speeds[driven, 0] + speeds[driven, 1] * cos(bearing.axis_angle))
    return summed(
        {"drag": float(dragged.sum())}, lost.sum(axis=0), rolled.sum(axis=0), drive=torque,
        speeds=np.stack([speeds[driven, 1], own], axis=1),
    )  # fmt: skip


def _speeds(rollers: list[RollingRoller], solution: StaticState, loads: np.ndarray) -> np.ndarray:
    """Speeds (2Z, 2) of barrels about their own axes and the bearing's; NaN of those that their
    friction does not drive against rolling resistance and drag. RunFailed if it drives none."""
    found = np.full((len(rollers), 2), np.nan)
    touch, failed = rollers[0].touches[1], None
    for k in np.flatnonzero((loads > _BEARS * loads.max()).all(axis=1)):
        first = _rolling(touch, float(solution.elements.orbital_speed[k]))
        try:
            found[k] = settled_speeds(rollers[k].unbalance, first, abs(solution.speed))
        except RunFailed as exc:
            failed = exc
    if np.isnan(found).all() and failed:
        raise failed
    return found


def _rolling(outer: Touch, orbit: float) -> np.ndarray:
    """Speeds about its own axis and the bearing's [rad/s] of a barrel whose middle rolls on the
    outer race."""
    k = outer.middle
    return np.array([orbit * float(outer.ring_radius[k] / outer.own_radius[k]), orbit])


def _touches(
    b: SphericalRollerBearing, contacts: Contacts, lubricant: Lubricant, speed: float
) -> tuple[Touch, Touch]:
    """A barrel's contacts with both races, as in the row at +x."""
    from flexcage.contacts.laws import rolling_resistance  # its kernels take seconds to load

    x = slice_places(b, contacts.race.slices)
    height, made = b.roller.radius(x), []
    for sign, turning, curved in zip(_SIGNS, (speed, 0.0), b.curvature_radii):
        made.append(Touch(
            b.pitch_radius - x * sin(b.axis_angle) - sign * height * cos(b.axis_angle),
            sign * height, turning,
            rolling_resistance(lubricant, curved, b.effective_length, b.race_modulus), len(x) // 2,
        ))  # fmt: skip
    return made[0], made[1]
