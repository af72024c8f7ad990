"""Balls between races of two arcs: up to four Hertz contacts, centrifugal and gyroscopic forces.

A ball's own coordinates are its centre from the circle of the outer arcs' centres, axially from
their middle, and radially. An arc bears where the ball is further from its centre than it would
just touch; no contact lies beyond the middle of a race, as a ball that is so far to one side leaves
the other arc. So all contacts are springs between centres, as in ``ball.statics``, and while speed
does nothing but push balls outwards, forces have a convex potential.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from math import inf

import numpy as np

from flexcage.bearings.ball.race_control import STEP
from flexcage.bearings.ball.statics import Balls, balls_of, spring
from flexcage.bearings.four_point.bearing import FourPointContactBearing
from flexcage.bearings.four_point.inertia import Arcs, Inertia
from flexcage.bearings.four_point.rules import ROWS
from flexcage.contacts.spec import Contacts
from flexcage.system.statics.elements import ElementLoads, Response
from flexcage.system.statics.options import StaticOptions


def four_point_balls_of(
    bearing: FourPointContactBearing, *, speed: float, contacts: Contacts, options: StaticOptions
) -> FourPointBalls:
    """Balls of a bearing on arcs by Hertz; InputError where ``contacts`` have another law."""
    found = balls_of(bearing, speed=speed, contacts=contacts, options=options)
    one_pair = found.rating if bearing.is_thrust else found.rating / ROWS**0.7
    return FourPointBalls(bearing, found.motion, found.arms, one_pair)


@dataclass(frozen=True)
class FourPointBalls(Balls):
    """The balls of a bearing at one speed; implements ``elements.Elements``."""

    bearing: FourPointContactBearing

    @cached_property
    def races(self) -> tuple[Arcs, Arcs]:
        """Arcs of inner and outer race."""
        b = self.bearing
        inner, outer = (
            Arcs(b.arcs(ring), length, contact.stiffness)
            for ring, length, contact in zip(("inner", "outer"), b.lengths, b.contacts)
        )
        return inner, outer

    @cached_property
    def inertia(self) -> Inertia:
        return Inertia(self.motion, *self.races)

    @cached_property
    def levers(self) -> tuple[np.ndarray, np.ndarray]:
        """How v moves the inner arcs' centres (n, 2, 3), and how their forces act along v."""
        places = self.races[0].places
        moves, acts = (
            np.array([[[1.0, 0.0, -arm], [0.0, 1.0, place]] for place in places])
            for arm in self.arms
        )
        return moves, acts.transpose(0, 2, 1)

    def lines(self, v: np.ndarray, ball: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Lines (n, 2, Z) of the contacts with inner and outer race, each from one centre to the
        other, at displacements v (Z, 3) with balls at ``ball`` (2, Z)."""
        inner, outer = (race.places[:, None] for race in self.races)
        radial = self.bearing.groove_offset[1]
        moved = np.einsum("nij,zj->niz", self.levers[0], v)
        on_inner = moved - ball + np.stack([inner, radial + 0.0 * inner], axis=1)
        on_outer = ball - np.stack([outer, 0.0 * outer], axis=1)
        return on_inner, on_outer

    def guesses(self, v: np.ndarray) -> list[np.ndarray]:
        """Those of a bearing with one arc a race, for each pair of arcs; and balls resting in the
        outer race."""
        at_rest, _ = self.lines(v, np.zeros((2, len(v))))
        found = []
        for line in at_rest:
            for outer in self.races[1].places:
                place = np.array([outer, 0.0])
                found += [w + place for w in self.guesses_at(line - place[:, None])]
        angle, length = self.bearing.shim_angles[1], self.bearing.lengths[1]
        return [*found, np.zeros((len(v), 2)) + np.array([0.0, length * np.cos(angle)])]

    def moved(self, w: np.ndarray, step: np.ndarray) -> np.ndarray:
        """Balls slide round the outer arc that they are pressed into the most."""
        places = self.races[1].places
        far = np.hypot(w[:, 0] - places[:, None], w[:, 1]).argmax(axis=0)
        centre = np.stack([places[far], 0.0 * w[:, 1]], axis=1)
        return super().moved(w - centre, step) + centre

    def respond(self, v: np.ndarray, w: np.ndarray, share: float) -> Response:
        moves, acts = self.levers
        on_inner, on_outer = self.lines(v, w.T)
        push = np.array([[0.0], [self.push]])
        energy, ring, rest = -self.push * w[:, 1], np.zeros((3, len(v))), -push + 0.0 * w.T
        ring_v, ring_w, rest_v, rest_w = (
            np.zeros((len(v), *shape)) for shape in ((3, 3), (3, 2), (2, 3), (2, 2))
        )
        for k, line in enumerate(on_inner):
            e, f, h = spring(line, self.lengths[0], self.bearing.contacts[0])
            energy, ring, rest = energy + e, ring + acts[k] @ f, rest - f
            ring_v, ring_w = ring_v + acts[k] @ h @ moves[k], ring_w - acts[k] @ h
            rest_v, rest_w = rest_v - h @ moves[k], rest_w + h
        for line in on_outer:
            e, f, h = spring(line, self.lengths[1], self.bearing.contacts[1])
            energy, rest, rest_w = energy + e, rest + f, rest_w + h
        if share > 0.0:
            value, slope = self._with_slopes(v, w)
            ring, rest = ring + share * value[2:], rest - share * (value[:2] - push)
            rest_w, rest_v = rest_w - share * slope[:, :2, :2], rest_v - share * slope[:, :2, 2:]
            ring_w, ring_v = ring_w + share * slope[:, 2:, :2], ring_v + share * slope[:, 2:, 2:]
        return Response(
            energy=energy, ring=ring.T, unbalance=rest.T, ring_v=ring_v, ring_w=ring_w,
            unbalance_v=rest_v, unbalance_w=rest_w,
        )  # fmt: skip

    def _inertia_forces(self, v: np.ndarray, w: np.ndarray) -> np.ndarray:
        """Inertia forces on balls, and what the ring exerts of them along v, (5, Z)."""
        ball, each = self.inertia.forces(*self.lines(v, w.T), w[:, 1])
        return np.concatenate([ball, np.einsum("nij,njz->iz", self.levers[1], each)])

    def _with_slopes(self, v: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Those, and their derivatives (Z, 5, 5) along w and v, exact to rounding."""
        value, at = self._inertia_forces(v, w), np.concatenate([w, v], axis=1)
        slope = np.empty((len(v), 5, 5))
        for k in range(5):
            moved = at.astype(complex)
            moved[:, k] += 1j * STEP
            slope[:, :, k] = self._inertia_forces(moved[:, 2:], moved[:, :2]).imag.T / STEP
        return value, slope

    def arc_forces(self, v: np.ndarray, w: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Forces (n, Z) [N] on the arcs of inner and outer race."""
        inner, outer = (race.forces(line) for race, line in zip(self.races, self.lines(v, w.T)))
        return inner, outer

    def loads(self, v: np.ndarray, w: np.ndarray) -> ElementLoads:
        """Of the arc that bears most of each race; ``arcs`` has the forces of all."""
        lines, arcs = self.lines(v, w.T), self.arc_forces(v, w)
        most = [force.argmax(axis=0) for force in arcs]
        balls = np.arange(len(w))
        one = np.stack([line[k, :, balls] for line, k in zip(lines, most)])
        force = np.stack([f[k, balls] for f, k in zip(arcs, most)], axis=1)
        angle = np.where(force > 0.0, np.arctan2(one[..., 0], one[..., 1]).T, np.nan)
        semi = [c.semi_axes(q) for c, q in zip(self.bearing.contacts, force.T)]
        pressure = [c.pressure(q) for c, q in zip(self.bearing.contacts, force.T)]
        _, _, at_inner, at_outer, sign = self.inertia.means(*lines)
        moment = sign * self.motion.moment(at_inner, at_outer)
        traction = 2.0 * np.outer(moment, self.motion.gyroscopic) / self.motion.diameter
        loaded = np.stack([f.sum(axis=0) for f in arcs], axis=1)
        return ElementLoads(
            azimuth=self.azimuth,
            force=force,
            angle=angle,
            pressure=np.stack(pressure, axis=1),
            across=np.stack([a[0] for a in semi], axis=1),
            along=np.stack([a[1] for a in semi], axis=1),
            edge=self.bearing.beyond_edges(force, angle),
            centrifugal=self.motion.centrifugal(at_inner, at_outer, w[:, 1]),
            gyroscopic=moment,
            orbital_speed=self.motion.orbital_speed(at_inner, at_outer),
            friction=np.abs(traction) / np.where(loaded > 0.0, loaded, np.nan),
            arcs=self._named(arcs),
        )

    def _named(self, arcs: tuple[np.ndarray, np.ndarray]) -> dict[str, np.ndarray]:
        """Forces by the names of arcs: the first of the inner race lies at -x of its middle."""
        found: dict[str, np.ndarray] = {}
        for ring, forces, sides in zip(("inner", "outer"), arcs, (("-x", "+x"), ("+x", "-x"))):
            names = [f"{ring} {side}" for side in sides] if len(forces) == 2 else [ring]
            found |= dict(zip(names, forces))
        return {name: found[name] for name in sorted(found, key=lambda n: (n[:5], n[-2:] != "-x"))}

    def reference_life(self, v: np.ndarray, w: np.ndarray) -> float:
        """As ISO/TS 16281 has it for one arc a race, of all arcs: each is a track that fails on
        its own."""
        ratings, worn = self.ball_ratings(), 0.0
        for race, (power, forces) in enumerate(zip((3.0, 10.0 / 3.0), self.arc_forces(v, w))):
            tracks = np.mean(forces**power, axis=1) ** (1.0 / power) / ratings[race]
            worn += float((tracks ** (10.0 / 3.0)).sum())
        return worn**-0.9 if worn > 0.0 else inf
