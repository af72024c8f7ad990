"""Rollers that meet their partners in a plane through the bearing's axis, in slices.

A roller's own coordinates w are displacements of its middle along its axis (s) and across it,
outwards (t), and its tilt about the tangent times half of its effective length, so that all are
lengths. How deep slices are pressed in is linear in w and in the inner ring's v (small angles), and
centrifugal force and the gyroscopic moment of pure rolling are constant, so that all forces have
one convex potential.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, sin
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.geometry.kinematics import Kinematics, epicyclic, rolling_shares
from flexcage.geometry.rollers import (
    STATIC_PRESSURE,
    line_pressure,
    reference_life,
    roller_ratings,
)
from flexcage.system.statics.elements import ElementLoads, Response, azimuths


@dataclass(frozen=True)
class Meeting:
    """Where a roller meets its partners: n slices on the inner race, n on the outer, and others.

    ``ring`` (m, 3) and ``own`` (m, 3) are how displacements v of the inner ring and w of the
    roller press them together, ``gap`` (m,) what a profile and clearance take from that.
    """

    ring: np.ndarray
    own: np.ndarray
    gap: np.ndarray
    exponent: np.ndarray
    races: tuple[slice, slice]


@dataclass(frozen=True)
class RollerPlane:
    """A roller in its plane: the angle [rad] between its axis and the bearing's, towards which it
    leans at +x, the radius [m] of its middle, and half of its effective length [m]."""

    angle: float
    radius: float
    half: float

    @property
    def frame(self) -> np.ndarray:
        """Rows s and t in (x, r)."""
        return np.array([[cos(self.angle), -sin(self.angle)], [sin(self.angle), cos(self.angle)]])

    def pressed_by_ring(self, place: np.ndarray, normal: np.ndarray) -> np.ndarray:
        """How axial and radial displacement and tilt of the inner ring move its places (k, 2) along
        normals (k, 2), both in (s, t) from the roller's middle: (k, 3)."""
        at = place @ self.frame + np.array([0.0, self.radius])
        along = normal @ self.frame
        return np.column_stack([along, at[:, 0] * along[:, 1] - at[:, 1] * along[:, 0]])

    def pressed_by_roller(self, place: np.ndarray, normal: np.ndarray) -> np.ndarray:
        """How w presses the roller's places (k, 2) against normals (k, 2), towards it: (k, 3)."""
        turn = place[:, 0] * normal[:, 1] - place[:, 1] * normal[:, 0]
        return -np.column_stack([normal, turn / self.half])


def rolling_of(b: Any, speed: float, cage: float | None) -> Kinematics:
    """Speeds of pure rolling of a bearing's rollers; at a cage speed [rad/s] that is prescribed,
    those of the inner ring's speed that makes it."""
    angle, ratio = b.nominal_contact_angle, b.roller_diameter / b.pitch_diameter
    inner = speed if cage is None else cage / rolling_shares(ratio, (angle, angle)).orbit
    return epicyclic(
        element_diameter=b.roller_diameter, pitch_diameter=b.pitch_diameter,
        element_count=b.roller_count, inner_speed=inner, contact_angle=angle,
    )  # fmt: skip


class SlicedRollers:
    """Forces of a bearing's rollers between its rings at one speed, with exact derivatives;
    implements ``elements.Elements``.

    ``bearing``: its ``axis_angle`` is that of ``plane``, its ``roller`` a body of revolution.
    """

    carries = (True, True, True, True, True)
    conservative = True
    pressure_limit = STATIC_PRESSURE

    if TYPE_CHECKING:  # what a family's rollers have

        @property
        def bearing(self) -> Any: ...
        @property
        def meeting(self) -> Meeting: ...
        @property
        def stiffness(self) -> np.ndarray:
            """(m,) of every contact, N/m to the power of its exponent."""

        @property
        def rolling(self) -> Kinematics: ...
        @property
        def rating(self) -> float: ...
        @property
        def plane(self) -> RollerPlane: ...

    @cached_property
    def azimuth(self) -> np.ndarray:
        return azimuths(self.bearing.roller_count)

    @property
    def scale(self) -> float:
        return 0.01 * float(self.bearing.roller_diameter)

    @cached_property
    def centrifugal(self) -> float:
        """Force [N] on the roller's centre of mass."""
        b = self.bearing
        radius = b.pitch_radius - b.roller.centre * sin(b.axis_angle)
        return float(b.element_mass * radius * self.rolling.cage_speed**2)

    @cached_property
    def gyroscopic(self) -> float:
        """Moment [N m] of inertia about the tangent, with the tilt's sign: less the change of the
        angular momentum of a roller that turns about its axis while that goes round."""
        b, orbit = self.bearing, self.rolling.cage_speed
        axial, transverse = b.roller_inertia
        spin = self.rolling.element_spin_in_cage + orbit * cos(b.axis_angle)
        momentum = axial * spin - transverse * orbit * cos(b.axis_angle)
        return float(orbit * sin(b.axis_angle) * momentum)

    @cached_property
    def push(self) -> np.ndarray:
        """What speed exerts on a roller (3,), along w."""
        b = self.bearing
        along, across = -sin(b.axis_angle) * self.centrifugal, cos(b.axis_angle) * self.centrifugal
        moment = self.gyroscopic + b.roller.centre * across
        return np.array([along, across, moment / self.plane.half])

    def guesses(self, v: np.ndarray) -> list[np.ndarray]:
        """Rollers where they are without load, or halfway along with the inner ring."""
        half = np.column_stack([0.5 * v[:, :2] @ self.plane.frame.T, 0.0 * v[:, 0]])
        return [np.zeros((len(v), 3)), half]

    def moved(self, w: np.ndarray, step: np.ndarray) -> np.ndarray:
        return w + step

    def depths(self, v: np.ndarray, w: np.ndarray) -> np.ndarray:
        """How deep (Z, m) all contacts are pressed in."""
        m = self.meeting
        return np.maximum(v @ m.ring.T + w @ m.own.T - m.gap, 0.0)

    def forces(self, v: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Forces (Z, m) [N] of all contacts."""
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

    def bears(self, v: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Forces (Z, 2) [N] of rollers on inner and outer race, and their angles (Z, 2) [rad] to
        the radial direction."""
        force = np.stack([part.sum(axis=1) for part in self.slice_forces(v, w)], axis=1)
        return force, np.tile(np.array(self.bearing.race_angles), (len(v), 1))

    def axial(self, v: np.ndarray, w: np.ndarray) -> np.ndarray | None:
        """Forces (Z,) [N] that ribs carry through rollers towards +x; None without ribs."""
        return None

    def loads(self, v: np.ndarray, w: np.ndarray) -> ElementLoads:
        b, Z = self.bearing, len(v)
        slices = np.stack(self.slice_forces(v, w), axis=1)  # (Z, 2, n)
        (force, angle), n = self.bears(v, w), slices.shape[2]
        line = slices.max(axis=2) * n / b.effective_length  # N/m
        pressure, width = line_pressure(line, np.array(b.curvature_radii), b.race_modulus)
        return ElementLoads(
            azimuth=self.azimuth,
            force=force,
            angle=np.where(force > 0.0, angle, np.nan),
            pressure=pressure,
            across=self.plane.half * (slices > 0.0).mean(axis=2),
            along=width,
            edge=np.full((Z, 2), -np.inf),
            centrifugal=np.full(Z, self.centrifugal),
            gyroscopic=np.full(Z, self.gyroscopic),
            orbital_speed=np.full(Z, self.rolling.cage_speed),
            friction=np.where(force > 0.0, 0.0, np.nan),
            axial=self.axial(v, w),
        )

    def check(self, loads: ElementLoads) -> None:
        """Slices bear only where there is a race."""

    def reference_life(self, v: np.ndarray, w: np.ndarray) -> float:
        b = self.bearing
        ratings = roller_ratings(self.rating, b.roller_count, b.gamma, b.contact_angle)
        inner, outer = self.slice_forces(v, w)
        return reference_life(inner, outer, ratings)
