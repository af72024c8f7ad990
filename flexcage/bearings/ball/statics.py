"""Balls between two grooves: Hertz contacts whose angles move, centrifugal and gyroscopic forces.

A ball's own coordinates are its centre from the outer groove's, axially and radially. While speed
does nothing but push it outwards, all forces have a convex potential. Rotations of the ring
are small: a tilt moves the inner groove's centre along straight lines.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import cos, degrees, inf, sin

import numpy as np

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.ball.race_control import BallMotion, directions, with_derivatives
from flexcage.bearings.ball.ratings import STATIC_PRESSURE, ring_share
from flexcage.contacts.spec import Contacts
from flexcage.core.errors import InputError
from flexcage.geometry.hertz import PointContact
from flexcage.system.statics.elements import ElementLoads, Response, azimuths
from flexcage.system.statics.laws import check_law
from flexcage.system.statics.options import StaticOptions

_SHARES = {"outer_race": (0.0, 1.0), "shared": (0.5, 0.5), "none": (0.0, 0.0)}
# ISO/TS 16281:2008, rating of a ball: C/(0.407 Z ...) and C/(0.389 Z ...) of radial bearings
_INNER, _OUTER = 0.407, 0.389
_GROOVE_BOTTOM = 1e-6  # rad: at a lower contact angle nothing holds the ring axially


def balls_of(
    bearing: BallBearing, *, speed: float, contacts: Contacts, options: StaticOptions
) -> Balls:
    """Balls of a bearing on races by Hertz; InputError where ``contacts`` have another law."""
    check_law(contacts.race.normal.law, "contacts.race.normal.law", "balls on races by Hertz")
    motion = BallMotion(
        mass=bearing.ball_mass,
        inertia=bearing.ball_inertia,
        diameter=bearing.ball_diameter,
        pitch_diameter=bearing.pitch_diameter,
        groove_radius=bearing.outer_groove_centre[1],
        speed=speed,
        cage_speed=options.cage_speed,
        gyroscopic=_SHARES[options.gyroscopic],
    )
    rating = options.dynamic_rating or bearing.dynamic_rating
    return Balls(bearing, motion, _arms(bearing, options.tilt_arm), rating)


def _arms(bearing: BallBearing, choice: str) -> tuple[float, float]:
    """Radii [m] at which a tilt moves the inner groove, and at which axial forces turn the ring."""
    groove, pitch = bearing.inner_groove_centre[1], 0.5 * bearing.pitch_diameter
    return {"groove": (groove, groove), "pitch": (pitch, pitch), "iso": (groove, pitch)}[choice]


@dataclass(frozen=True)
class Balls:
    """The balls of a bearing at one speed; implements ``elements.Elements``."""

    bearing: BallBearing
    motion: BallMotion
    arms: tuple[float, float]
    rating: float
    carries = (True, True, True, True, True)
    pressure_limit = STATIC_PRESSURE

    @cached_property
    def azimuth(self) -> np.ndarray:
        return azimuths(self.bearing.ball_count)

    @property
    def scale(self) -> float:
        return 0.25 * self.bearing.groove_distance

    @property
    def conservative(self) -> bool:
        """True at rest, with one lever for tilts."""
        return self.push == 0.0 and self.arms[0] == self.arms[1]

    @cached_property
    def lengths(self) -> tuple[float, float]:
        """Distances [m] of a ball's centre from the grooves' where it just touches."""
        b = self.bearing
        radius = 0.5 * b.ball_diameter
        return b.inner_groove_radius - radius, b.outer_groove_radius - radius

    @cached_property
    def push(self) -> float:
        """Centrifugal force [N] at the free contact angle: constant, so that it has an energy."""
        angle = self.bearing.free_contact_angle
        along = np.array([[cos(angle)], [sin(angle)]])
        radial = 0.5 * self.bearing.pitch_diameter - self.bearing.outer_groove_centre[1]
        return float(self.motion.centrifugal(along, along, np.array([radial]))[0])

    @cached_property
    def _levers(self) -> tuple[np.ndarray, np.ndarray]:
        """How v moves the inner groove's centre (2, 3), and how its force acts along v (3, 2)."""
        offset = self.bearing.inner_groove_centre[0]
        moves, acts = (np.array([[1.0, 0.0, -arm], [0.0, 1.0, offset]]) for arm in self.arms)
        return moves, acts.T

    def groove(self, v: np.ndarray) -> np.ndarray:
        """Inner groove's centre (2, Z) from the outer one's at displacements v (Z, 3)."""
        return np.array(self.bearing.groove_offset)[:, None] + self._levers[0] @ v.T

    def guesses(self, v: np.ndarray) -> list[np.ndarray]:
        """Balls on the outer race alone, where they push; squeezed along the line of both grooves'
        centres; and wedged between both grooves, too far apart to squeeze them."""
        return self.guesses_at(self.groove(v))

    def guesses_at(self, groove: np.ndarray) -> list[np.ndarray]:
        """Those with the inner groove's centre (2, Z) there, seen from the outer one's."""
        inner, outer = self.bearing.contacts
        distance, toward = np.hypot(*groove), np.arctan2(groove[0], groove[1])
        depths = [(self.push / c.stiffness) ** (2.0 / 3.0) for c in (inner, outer)]
        reach = [length + depth for length, depth in zip(self.lengths, depths)]
        soft = [c.stiffness ** (-2.0 / 3.0) for c in (inner, outer)]
        squeeze = np.maximum(distance - sum(self.lengths), 0.0)
        squeezed = self.lengths[1] + squeeze * soft[1] / sum(soft)
        cosine = (reach[1] ** 2 + distance**2 - reach[0] ** 2) / (2.0 * reach[1] * distance)
        outwards = toward - np.sign(toward) * np.arccos(np.clip(cosine, -1.0, 1.0))
        places = (reach[1] + 0.0 * distance, 0.0 * toward), (squeezed, toward), (reach[1], outwards)
        return [np.stack([r * np.sin(t), r * np.cos(t)], axis=1) for r, t in places]

    def moved(self, w: np.ndarray, step: np.ndarray) -> np.ndarray:
        """Balls slide round the outer groove: along its tangent they would run into its wall."""
        reach = np.hypot(*w.T)[:, None]
        normal = w / reach
        across = np.stack([normal[:, 1], -normal[:, 0]], axis=1)
        turn = (step * across).sum(axis=1, keepdims=True) / reach
        new = reach + (step * normal).sum(axis=1, keepdims=True)
        return new * (np.cos(turn) * normal + np.sin(turn) * across)

    def respond(self, v: np.ndarray, w: np.ndarray, share: float) -> Response:
        ball, groove = w.T, self.groove(v)
        inner, outer = self.bearing.contacts
        e_inner, f_inner, h_inner = spring(groove - ball, self.lengths[0], inner)
        e_outer, f_outer, h_outer = spring(ball, self.lengths[1], outer)
        push = np.array([[0.0], [self.push]])
        ring, rest = f_inner, f_outer - f_inner - push
        ring_a, ring_w, rest_a, rest_w = h_inner, -h_inner, -h_inner, h_inner + h_outer
        moves, acts = self._levers
        if share > 0.0:
            value, slope = with_derivatives(self.motion, ball, groove)
            ring = ring + share * value[2:]
            rest = rest - share * (value[:2] - push)
            blocks = share * slope.reshape(2, 2, -1, 2, 2).transpose(0, 3, 2, 1, 4)
            rest_w, rest_a = rest_w - blocks[0, 0], rest_a - blocks[0, 1]
            ring_w, ring_a = ring_w + blocks[1, 0], ring_a + blocks[1, 1]
        return Response(
            energy=e_inner + e_outer - self.push * ball[1],
            ring=(acts @ ring).T,
            unbalance=rest.T,
            ring_v=acts @ ring_a @ moves,
            ring_w=acts @ ring_w,
            unbalance_v=rest_a @ moves,
            unbalance_w=rest_w,
        )

    def loads(self, v: np.ndarray, w: np.ndarray) -> ElementLoads:
        ball, groove = w.T, self.groove(v)
        cosines = directions(ball, groove)
        forces = [
            np.hypot(*spring(line, length, contact)[1])
            for line, length, contact in zip(
                (groove - ball, ball), self.lengths, self.bearing.contacts
            )
        ]
        force = np.stack(forces, axis=1)
        angle = np.stack([np.arctan2(c[1], c[0]) for c in cosines], axis=1)
        angle = np.where(force > 0.0, angle, np.nan)
        axes = [c.semi_axes(q) for c, q in zip(self.bearing.contacts, forces)]
        across = np.stack([a[0] for a in axes], axis=1)
        with np.errstate(invalid="ignore", divide="ignore"):  # balls that nothing presses
            moment = self.motion.moment(*cosines)
            centrifugal = self.motion.centrifugal(*cosines, ball[1])
            orbital_speed = self.motion.orbital_speed(*cosines)
        traction = 2.0 * np.outer(moment, self.motion.gyroscopic) / self.motion.diameter
        loaded = np.where(force > 0.0, force, np.nan)
        return ElementLoads(
            azimuth=self.azimuth,
            force=force,
            angle=angle,
            pressure=np.stack(
                [c.pressure(q) for c, q in zip(self.bearing.contacts, forces)], axis=1
            ),
            across=across,
            along=np.stack([a[1] for a in axes], axis=1),
            edge=self.bearing.beyond_edges(force, angle),
            centrifugal=centrifugal,
            gyroscopic=moment,
            orbital_speed=orbital_speed,
            friction=np.abs(traction) / loaded,
        )

    def check(self, loads: ElementLoads) -> None:
        """Angular contact bearings have no shoulder on the other side."""
        angle = np.nan_to_num(loads.angle[:, 0], nan=np.inf)
        worst = int(angle.argmin())
        if self.bearing.one_sided and angle[worst] < _GROOVE_BOTTOM:
            raise InputError(
                f"the bearing cannot bear this load: ball {worst} would bear "
                f"{loads.force[worst, 0]:.4g} N at a contact angle of "
                f"{degrees(angle[worst]):.3g} deg, where {self.bearing.kind}s have no shoulder; "
                "give it more axial load, towards +x",
                where="load",
            )

    def reference_life(self, v: np.ndarray, w: np.ndarray) -> float:
        force = self.loads(v, w).force
        if not force.max() > 0.0:
            return inf
        inner, outer = self.ball_ratings()
        on_inner = np.mean(force[:, 0] ** 3.0) ** (1.0 / 3.0)  # it turns under the load
        on_outer = np.mean(force[:, 1] ** (10.0 / 3.0)) ** 0.3  # it stands
        worn = (on_inner / inner) ** (10.0 / 3.0) + (on_outer / outer) ** (10.0 / 3.0)
        return float(worn**-0.9)

    def ball_ratings(self) -> tuple[float, float]:
        """Loads [N] of one ball that inner and outer race bear for 10^6 revolutions."""
        b = self.bearing
        angle = b.nominal_contact_angle
        spread = 1.0 if b.is_thrust else 1.044
        share = ring_share(b.gamma, b.inner_conformity, b.outer_conformity, spread) ** (10.0 / 3.0)
        if b.is_thrust:
            per_ball = [self.rating / (b.ball_count * sin(angle))] * 2
        else:
            all_balls = b.ball_count * cos(angle) ** 0.7
            per_ball = [self.rating / (factor * all_balls) for factor in (_INNER, _OUTER)]
        return per_ball[0] * (1.0 + share) ** 0.3, per_ball[1] * (1.0 + 1.0 / share) ** 0.3


def spring(
    line: np.ndarray, length: float, contact: PointContact
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Energy (Z,), force (2, Z) along its line, and stiffness (Z, 2, 2) of one contact.

    ``line`` (2, Z) from one centre to the other; the contact bears load beyond ``length``.
    """
    reach = np.hypot(*line)
    normal = line / reach
    depth = np.maximum(reach - length, 0.0)
    force = contact.stiffness * depth**1.5
    slope = 1.5 * contact.stiffness * np.sqrt(depth)
    along = np.einsum("az,bz->zab", normal, normal)
    stiffness = (slope - force / reach)[:, None, None] * along
    stiffness += (force / reach)[:, None, None] * np.eye(2)
    return 0.4 * force * depth, force * normal, stiffness
