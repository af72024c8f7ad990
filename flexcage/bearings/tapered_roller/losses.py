"""Losses of tapered rollers in the static solution: creep, rolling resistance, the rib and drag.

A roller's two speeds, its orbit and its rotation about its own axis, follow from its balance about
the bearing's axis and about its own. Cones that share an apex slide alike, relative to their
radius, all along their lines: tractions are those at mid-length. Skew is left out (what holds it
does no work), and so is the turning of an end on its own spot on the rib. An element that bears
nothing on the inner race rolls on the outer one at the others' speed.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import cos, sin

import numpy as np

from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.system.statics.losses import (
    Losses,
    Ratio,
    friction_over_speed,
    settled_speeds,
    summed,
)
from flexcage.system.statics.state import StaticState

_SIGNS = (1.0, -1.0)  # of inner and outer race, inwards


@dataclass(frozen=True)
class _Touch:
    """Where a roller touches a ring: radii [m] about the bearing's axis and its own (> 0 inwards),
    and the law of its rolling resistance (0 where none is)."""

    ring_radius: float
    own_radius: float
    ring_speed: float
    rolling: np.ndarray

    def act(
        self, ratio: Ratio, force: float, speeds: np.ndarray, smooth: float = 0.0
    ) -> tuple[float, float, float, float]:
        """Moments [N m] about the bearing's axis and the roller's, and losses [W] of sliding and
        rolling. ``speeds``: of the roller about its axis, relative to its orbit, and of the orbit.
        """
        from flexcage.contacts.laws import rolling_forces

        turn, orbit = speeds
        own = -turn * self.own_radius
        ring = (self.ring_speed - orbit) * self.ring_radius
        slip, resists = own - ring, np.zeros(1)
        traction = -force * float(ratio(np.array([abs(slip)]), smooth)[0]) * slip
        if self.rolling[0] > 0.0:
            rolling_forces(
                1, self.rolling, np.array([0.5 * (own + ring)]), np.array([force]), resists
            )
        R = float(resists[0])
        about_bearing = (traction + R) * self.ring_radius
        return about_bearing, (R - traction) * self.own_radius, -traction * slip, R * (own + ring)


@dataclass(frozen=True)
class _Roller:
    """A roller on both races and the rib, under forces (3,) [N]."""

    touches: tuple[_Touch, _Touch, _Touch]
    forces: np.ndarray
    ratios: tuple[Ratio, Ratio, Ratio]
    pitch: float
    drag: float

    def acts(
        self, speeds: np.ndarray, smooth: float = 0.0
    ) -> list[tuple[float, float, float, float]]:
        parts = zip(self.touches, self.ratios, self.forces)
        return [touch.act(ratio, float(q), speeds, smooth) for touch, ratio, q in parts]

    def unbalance(self, speeds: np.ndarray, smooth: float = 0.0) -> np.ndarray:
        """Moments about both axes (2,) over what friction of 1 would give."""
        acts, v = self.acts(speeds, smooth), self.pitch * speeds[1]
        scale, own = float(self.forces.max()), self.touches[0].own_radius
        about_bearing = sum(a[0] for a in acts) - self.drag * abs(v) * v * self.pitch
        return np.array([sum(a[1] for a in acts) / (scale * own),
                         about_bearing / (scale * self.pitch)])  # fmt: skip


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
        roller = _Roller(touches, np.array([*e.force[k], ribs[k]]), ratios, pitch, drag)
        orbit = float(e.orbital_speed[k])
        first = np.array([-orbit * touches[1].ring_radius / (0.5 * bearing.roller_diameter), orbit])
        speeds = settled_speeds(roller.unbalance, first, abs(speed))
        acts = roller.acts(speeds)
        lost += [a[2] for a in acts]
        rolled += [a[3] for a in acts]
        torque += acts[0][0] + acts[2][0]
        dragged += drag * abs(pitch * speeds[1]) ** 3
        found.append((speeds[1], abs(speeds[0] + speeds[1] * cos(bearing.axis_angle))))
    orbit = float(np.mean([o for o, _ in found]))
    for k in np.setdiff1d(np.arange(len(e.force)), loaded):
        turn = -orbit * touches[1].ring_radius / (0.5 * bearing.roller_diameter)
        alone = touches[1].act(ratios[1], float(e.force[k, 1]), np.array([turn, orbit]))[3]
        in_oil = drag * abs(pitch * orbit) ** 3
        rolled[1] += alone
        dragged += in_oil
        torque += (alone + in_oil) / speed
    places = {"drag": dragged, "inner ribs": float(lost[2])}
    return summed(places, lost[:2], rolled[:2], drive=torque, speeds=np.array(found))


def _rib_forces(b: TaperedRollerBearing, solution: StaticState) -> np.ndarray:
    """Forces (Z,) [N] normal to the rib's face."""
    assert solution.elements.axial is not None
    found: np.ndarray = solution.elements.axial / cos(b.axis_angle - b.rib_angle)
    return found


def _touches(
    b: TaperedRollerBearing, lubricant: Lubricant, speed: float
) -> tuple[_Touch, _Touch, _Touch]:
    from flexcage.contacts.laws import rolling_resistance

    made, own = [], 0.5 * b.roller_diameter
    for k, (sign, turning) in enumerate(zip(_SIGNS, (speed, 0.0))):
        curved = b.curvature_radii[k]
        resistance = rolling_resistance(lubricant, curved, b.effective_length, b.race_modulus)
        made.append(_Touch(0.5 * b.race_diameters[k], sign * own, turning, resistance))
    along, across = b.rib_place
    radius = b.pitch_radius - along * sin(b.axis_angle) + across * cos(b.axis_angle)
    return made[0], made[1], _Touch(radius, -across, speed, np.zeros(2))
