"""Tapered rollers between two cones and on the inner ring's large rib, in slices: ISO/TS 16281.

A roller's own coordinates are displacements of its middle along its axis, towards the apex (s), and
across it, outwards (t), and its tilt about the tangent times half of its effective length, so that
all are lengths. Both races push it towards its large end, whose sphere bears on the rib by Hertz
without friction: the rib's force follows from the equilibrium of the wedge. Centrifugal force
and the gyroscopic moment of pure rolling are constant, so that all forces have a convex potential.
Small displacements and angles; skew and roundness are left out.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, sin, tan

import numpy as np

from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.contacts.spec import Contacts
from flexcage.geometry.kinematics import Kinematics, epicyclic, rolling_shares
from flexcage.geometry.rollers import (
    LINE_EXPONENT,
    STATIC_PRESSURE,
    line_pressure,
    reference_life,
    roller_ratings,
)
from flexcage.system.statics.elements import ElementLoads, Response, azimuths
from flexcage.system.statics.laws import check_law
from flexcage.system.statics.options import StaticOptions

_RIB_EXPONENT = 1.5  # Hertz


def rollers_of(
    bearing: TaperedRollerBearing, *, speed: float, contacts: Contacts, options: StaticOptions
) -> TaperedRollers:
    """Rollers of a bearing, in the slices and with the stiffness of ``contacts.race``, on a rib as
    stiff as Hertz and ``contacts.rib`` have it."""
    from flexcage.contacts.laws import iso_line_stiffness  # its kernels take seconds to load

    race, rib = contacts.race.normal, contacts.rib.normal
    check_law(race.law, "contacts.race.normal.law", "rollers on races by ISO/TS 16281")
    check_law(rib.law, "contacts.rib.normal.law", "rollers' ends on the rib by Hertz")
    n = contacts.race.slices
    line = iso_line_stiffness(bearing.effective_length, bearing.race_modulus)
    on_race = line * race.stiffness_factor / n
    on_rib = bearing.rib_contact.stiffness * rib.stiffness_factor
    return TaperedRollers(
        bearing=bearing,
        meeting=meeting(bearing, n),
        stiffness=np.array([on_race] * 2 * n + [on_rib]),
        rolling=rolling_at(bearing, speed, options.cage_speed),
        rating=options.dynamic_rating or bearing.dynamic_rating,
    )


def rolling_at(b: TaperedRollerBearing, speed: float, cage: float | None = None) -> Kinematics:
    """Speeds of pure rolling; at a cage speed [rad/s] that is prescribed, those of the inner ring's
    speed that makes it."""
    angle, ratio = b.nominal_contact_angle, b.roller_diameter / b.pitch_diameter
    inner = speed if cage is None else cage / rolling_shares(ratio, (angle, angle)).orbit
    return epicyclic(
        element_diameter=b.roller_diameter, pitch_diameter=b.pitch_diameter,
        element_count=b.roller_count, inner_speed=inner, contact_angle=angle,
    )  # fmt: skip


@dataclass(frozen=True)
class Meeting:
    """Where a roller meets its partners: n slices on the inner race, n on the outer, and the rib.

    ``ring`` (2n+1, 3) and ``own`` (2n+1, 3) are how displacements v of the inner ring and w of the
    roller press them together, ``gap`` (2n+1,) what a profile takes from that.
    """

    ring: np.ndarray
    own: np.ndarray
    gap: np.ndarray
    exponent: np.ndarray
    races: tuple[slice, slice]


def meeting(b: TaperedRollerBearing, slices: int) -> Meeting:
    """The contacts of a bearing's roller."""
    x, drop = b.profile.slices(slices, diameter=b.roller_diameter, length=b.effective_length)
    radius, eps = 0.5 * b.roller_diameter - x * tan(b.half_angle), b.half_angle
    across = [-radius, radius]
    places = [np.stack([x, t], axis=1) for t in across]
    normals = [np.tile([-sin(eps), sign * cos(eps)], (slices, 1)) for sign in (1.0, -1.0)]
    rib = np.array([cos(b.rib_angle), sin(b.rib_angle)])
    place = np.vstack([*places, b.rib_place])
    normal = np.vstack([*normals, rib])  # of the partner, towards the roller
    half = 0.5 * b.effective_length
    turn = place[:, 0] * normal[:, 1] - place[:, 1] * normal[:, 0]
    own = -np.column_stack([normal, turn / half])
    ring = _on_ring(b, place, normal)
    ring[slices : 2 * slices] = 0.0  # the outer ring stands
    return Meeting(
        ring=ring, own=own, gap=np.concatenate([drop, drop, [0.0]]),
        exponent=np.array([LINE_EXPONENT] * 2 * slices + [_RIB_EXPONENT]),
        races=(slice(0, slices), slice(slices, 2 * slices)),
    )  # fmt: skip


def _on_ring(b: TaperedRollerBearing, place: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """How axial and radial displacement and tilt of the inner ring move its places (k, 2), given
    along and across the roller's axis, along normals (k, 2): (k, 3)."""
    beta = b.axis_angle
    frame = np.array([[cos(beta), -sin(beta)], [sin(beta), cos(beta)]])  # rows s, t in (x, r)
    at = place @ frame + np.array([0.0, b.pitch_radius])
    along = normal @ frame
    return np.column_stack([along, at[:, 0] * along[:, 1] - at[:, 1] * along[:, 0]])


@dataclass(frozen=True)
class TaperedRollers:
    """The rollers of a bearing at one speed; implements ``elements.Elements``."""

    bearing: TaperedRollerBearing
    meeting: Meeting
    stiffness: np.ndarray  # (2n+1,) of slices [N/m^(10/9)] and the rib [N/m^(3/2)]
    rolling: Kinematics
    rating: float
    carries = (True, True, True, True, True)
    conservative = True
    pressure_limit = STATIC_PRESSURE

    @cached_property
    def azimuth(self) -> np.ndarray:
        return azimuths(self.bearing.roller_count)

    @property
    def scale(self) -> float:
        return 0.01 * self.bearing.roller_diameter

    @cached_property
    def centrifugal(self) -> float:
        """Force [N] on the roller's centre of mass, which is nearer to its large end."""
        b = self.bearing
        radius = b.pitch_radius - b.roller.centre * sin(b.axis_angle)
        return b.element_mass * radius * self.rolling.cage_speed**2

    @cached_property
    def gyroscopic(self) -> float:
        """Moment [N m] of inertia about the tangent, with the tilt's sign: less the change of the
        angular momentum of a roller that turns about its axis while that goes round."""
        b, orbit = self.bearing, self.rolling.cage_speed
        axial, transverse = b.roller_inertia
        spin = self.rolling.element_spin_in_cage + orbit * cos(b.axis_angle)
        momentum = axial * spin - transverse * orbit * cos(b.axis_angle)
        return orbit * sin(b.axis_angle) * momentum

    @cached_property
    def push(self) -> np.ndarray:
        """What speed exerts on a roller (3,), along w."""
        b = self.bearing
        along, across = -sin(b.axis_angle) * self.centrifugal, cos(b.axis_angle) * self.centrifugal
        moment = self.gyroscopic + b.roller.centre * across
        return np.array([along, across, moment / (0.5 * b.effective_length)])

    def guesses(self, v: np.ndarray) -> list[np.ndarray]:
        """Rollers where they are without load, or halfway along with the inner ring."""
        beta = self.bearing.axis_angle
        frame = np.array([[cos(beta), -sin(beta)], [sin(beta), cos(beta)]])
        half = np.column_stack([0.5 * v[:, :2] @ frame.T, 0.0 * v[:, 0]])
        return [np.zeros((len(v), 3)), half]

    def moved(self, w: np.ndarray, step: np.ndarray) -> np.ndarray:
        return w + step

    def depths(self, v: np.ndarray, w: np.ndarray) -> np.ndarray:
        """How deep (Z, 2n+1) slices and end are pressed in."""
        m = self.meeting
        return np.maximum(v @ m.ring.T + w @ m.own.T - m.gap, 0.0)

    def forces(self, v: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Forces (Z, 2n+1) [N] of slices on races and of the end on the rib."""
        found: np.ndarray = self.stiffness * self.depths(v, w) ** self.meeting.exponent
        return found

    def respond(self, v: np.ndarray, w: np.ndarray, share: float) -> Response:
        m, depth = self.meeting, self.depths(v, w)
        yielding = self.stiffness * depth ** (m.exponent - 1.0)
        force, slope = yielding * depth, m.exponent * yielding

        def stiffness(one: np.ndarray, other: np.ndarray) -> np.ndarray:
            return np.einsum("zk,ka,kb->zab", slope, one, other)

        across = stiffness(m.ring, m.own)
        return Response(
            energy=(force * depth / (m.exponent + 1.0)).sum(axis=1) - w @ self.push,
            ring=force @ m.ring,
            unbalance=force @ m.own - self.push,
            ring_v=stiffness(m.ring, m.ring),
            ring_w=across,
            unbalance_v=across.transpose(0, 2, 1),
            unbalance_w=stiffness(m.own, m.own),
        )

    def slice_forces(self, v: np.ndarray, w: np.ndarray) -> list[np.ndarray]:
        """Forces (Z, n) of the slices on the inner and the outer race [N]."""
        force = self.forces(v, w)
        return [force[:, part] for part in self.meeting.races]

    def rib_forces(self, v: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Forces (Z,) [N] of the rib on the rollers' ends, normal to its face."""
        return self.forces(v, w)[:, -1]

    def loads(self, v: np.ndarray, w: np.ndarray) -> ElementLoads:
        b, Z = self.bearing, len(v)
        slices = np.stack(self.slice_forces(v, w), axis=1)  # (Z, 2, n)
        force, n = slices.sum(axis=2), slices.shape[2]
        line = slices.max(axis=2) * n / b.effective_length  # N/m
        pressure, width = line_pressure(line, np.array(b.curvature_radii), b.race_modulus)
        return ElementLoads(
            azimuth=self.azimuth,
            force=force,
            angle=np.where(force > 0.0, b.race_angles, np.nan),
            pressure=pressure,
            across=0.5 * b.effective_length * (slices > 0.0).mean(axis=2),
            along=width,
            edge=np.full((Z, 2), -np.inf),
            centrifugal=np.full(Z, self.centrifugal),
            gyroscopic=np.full(Z, self.gyroscopic),
            orbital_speed=np.full(Z, self.rolling.cage_speed),
            friction=np.where(force > 0.0, 0.0, np.nan),
            axial=self.rib_forces(v, w) * cos(b.axis_angle - b.rib_angle),
        )

    def check(self, loads: ElementLoads) -> None:
        """Slices bear only where there is a race."""

    def reference_life(self, v: np.ndarray, w: np.ndarray) -> float:
        b = self.bearing
        ratings = roller_ratings(self.rating, b.roller_count, b.gamma, b.contact_angle)
        inner, outer = self.slice_forces(v, w)
        return reference_life(inner, outer, ratings)
