"""Losses of rollers in the static solution: creep, rolling resistance, ribs and drag.

A roller's two speeds, its orbit and its rotation, follow from its balance along its path and
about its axis. Tractions and rolling resistance are those of a run (``contacts.race``) of a roller
that lies parallel to the axis: all slices slide alike. Ribs that carry axial load rub its ends by
the law of ``contacts.rib``. Races are where rollers on the pitch circle touch them: what the
clearance moves them by is left out of the speeds, 1e-4 of these.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import copysign, nan

import numpy as np

from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.bearings.cylindrical_roller.ribs import rib_height
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
class _Race:
    """One raceway, and what a roller pressed on it feels."""

    sign: float
    radius: float
    roller: float  # radius
    rolling: np.ndarray  # (2,)
    hydro: float
    ring_speed: float

    def act(
        self, ratio: Ratio, force: float, turn: float, orbit: float, smooth: float = 0.0
    ) -> tuple[float, float, float, float]:
        """Force along e_psi on a roller, moment about its axis, and losses [W] of sliding and
        rolling."""
        from flexcage.contacts.laws import rolling_forces

        own = (orbit - turn) * self.sign * self.roller
        ring = (self.ring_speed - orbit) * self.radius
        slip = own - ring
        traction = -force * float(ratio(np.array([abs(slip)]), smooth)[0]) * slip
        resistance = np.zeros(1)
        rolling_forces(1, self.rolling, np.array([0.5 * (own + ring)]), np.array([force]),
                       resistance)  # fmt: skip
        resists = float(resistance[0]) if self.rolling[0] > 0.0 else 0.0
        along = traction + (self.hydro - 1.0) * resists
        moment = self.sign * self.roller * (resists - traction)
        return along, moment, -traction * slip, resists * (own + ring)


@dataclass(frozen=True)
class _Rib:
    """A rib's contact with a roller's end, ``height`` [m] from its axis outwards."""

    height: float
    ring_speed: float
    force: float

    def act(
        self, ratio: Ratio, pitch: float, turn: float, orbit: float, smooth: float
    ) -> tuple[float, float, float]:
        """Force along e_psi, moment about the roller's axis, and loss [W]."""
        slip = (orbit - self.ring_speed) * pitch + (turn - self.ring_speed) * self.height
        along = -self.force * float(ratio(np.array([abs(slip)]), smooth)[0]) * slip
        return along, self.height * along, -along * slip


@dataclass(frozen=True)
class _Roller:
    """A roller between both races and, if it carries axial load, ribs of both rings."""

    races: tuple[_Race, _Race]
    forces: tuple[float, float]
    ribs: tuple[_Rib, ...]
    pitch: float
    drag: float
    ratios: tuple[Ratio, Ratio]

    def acts(
        self, speeds: np.ndarray, smooth: float = 0.0
    ) -> tuple[list[tuple[float, float, float, float]], list[tuple[float, float, float]]]:
        turn, orbit = speeds
        on_races, on_ribs = self.ratios
        races = [r.act(on_races, q, turn, orbit, smooth) for r, q in zip(self.races, self.forces)]
        return races, [r.act(on_ribs, self.pitch, turn, orbit, smooth) for r in self.ribs]

    def unbalance(self, speeds: np.ndarray, smooth: float = 0.0) -> np.ndarray:
        """Moment and force (2,) over what friction of 1 would give."""
        races, ribs = self.acts(speeds, smooth)
        v, scale = self.pitch * speeds[1], max(self.forces)
        along = sum(a[0] for a in races) + sum(a[0] for a in ribs) - self.drag * abs(v) * v
        moment = sum(a[1] for a in races) + sum(a[1] for a in ribs)
        return np.array([moment / (scale * self.races[0].roller), along / scale])

    def torque(self, speeds: np.ndarray) -> float:
        """Torque [N m] that the roller takes from the inner ring."""
        races, ribs = self.acts(speeds)
        return self.pitch * races[0][0] + races[0][1] + sum(
            self.pitch * a[0] + a[1] for a in ribs[:1])  # fmt: skip


def roller_losses(
    bearing: RollerBearing, solution: StaticState, *, contacts: Contacts, lubricant: Lubricant,
    orbit: float = nan,
) -> Losses:  # fmt: skip
    """Losses of a cylindrical roller bearing's static solution; ``orbit`` [rad/s]: how fast rollers
    go round if none bears load."""
    e, speed = solution.elements, solution.speed
    drag = 0.5 * lubricant.density * lubricant.oil_fraction * lubricant.drag_coefficient
    drag *= bearing.roller_diameter * bearing.roller_length
    races = _races(bearing, contacts, lubricant, speed)
    ratios = (
        friction_over_speed(contacts.race.friction), friction_over_speed(contacts.rib.friction)
    )  # fmt: skip
    sliding, rolling, on_ribs, dragged, torque = np.zeros(2), np.zeros(2), np.zeros(2), 0.0, 0.0
    found, loaded = [], np.flatnonzero((e.force > 0.0).all(axis=1))
    for k in loaded:
        roller = _Roller(
            races, (float(e.force[k, 0]), float(e.force[k, 1])),
            _ribs(bearing, 0.0 if e.axial is None else float(e.axial[k]), speed),
            bearing.pitch_radius, drag, ratios,
        )  # fmt: skip
        rolls = float(e.orbital_speed[k])
        first = np.array([rolls - (speed - rolls) * races[0].radius / races[0].roller, rolls])
        speeds = settled_speeds(roller.unbalance, first, abs(speed))
        acts, rubbed = roller.acts(speeds)
        sliding += [a[2] for a in acts]
        rolling += [a[3] for a in acts]
        on_ribs += [a[2] for a in rubbed] if rubbed else 0.0
        torque += roller.torque(speeds)
        dragged += drag * abs(bearing.pitch_radius * speeds[1]) ** 3
        found.append((speeds[1], abs(speeds[0])))
    if found:
        orbit = float(np.mean([o for o, _ in found]))
    else:
        found.append((orbit, abs(orbit) * (races[1].radius / races[1].roller - 1.0)))
    for k in np.setdiff1d(np.arange(len(e.force)), loaded):  # on the outer race alone
        turn = orbit * (1.0 - races[1].radius / races[1].roller)
        lost = races[1].act(ratios[0], float(e.force[k, 1]), turn, orbit)[3]
        in_oil = drag * abs(bearing.pitch_radius * orbit) ** 3
        rolling[1] += lost
        dragged += in_oil
        torque += (lost + in_oil) / speed
    places = {"drag": dragged}
    if e.axial is not None:
        places |= {"inner ribs": float(on_ribs[0]), "outer ribs": float(on_ribs[1])}
    return summed(places, sliding, rolling, drive=torque, speeds=np.array(found))


def _races(
    bearing: RollerBearing, contacts: Contacts, lubricant: Lubricant, speed: float
) -> tuple[_Race, _Race]:
    from flexcage.contacts.laws import rolling_resistance

    roller, found = 0.5 * bearing.roller_diameter, []
    for sign, turning in zip(_SIGNS, (speed, 0.0)):
        radius = bearing.pitch_radius - sign * roller
        curved = roller * radius / (radius + sign * roller)
        resistance = rolling_resistance(
            lubricant, curved, bearing.effective_length, bearing.race_modulus
        )
        found.append(_Race(sign, radius, roller, resistance, 2.0 * curved / roller, turning))
    return found[0], found[1]


def _ribs(bearing: RollerBearing, axial: float, speed: float) -> tuple[_Rib, ...]:
    """The ribs of both rings between which a roller carries an axial force [N]."""
    if axial == 0.0:
        return ()
    force = copysign(axial, 1.0)
    return tuple(
        _Rib(rib_height(bearing, ring), turning, force)
        for ring, turning in (("inner", speed), ("outer", 0.0))
    )
