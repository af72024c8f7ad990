"""Which unknown lives where: the places of y = (q, u, lambda, mu, s) follow from a list of bodies.

First come the rolling elements, then the bodies of the list in its order. Kernels get the places as
numbers (``Places``); no constant says where a body is. The border of Newton's matrix has the
velocities of the bodies in the same order, then the multipliers.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from flexcage.core.jit import part
from flexcage.core.vectors import RIGID

PER_ELEMENT = 6  # coordinates, and velocities, of a rolling element
# a ring: centre (x, y, z), skew, tilt, spin; velocity of its centre, angular velocity in its
# non-spinning frame, spin first
RING = 6
# a floating frame: centre, quaternion, modes; velocity of its centre in space, angular velocity in
# its own frame, rates of the modes
CAGE = "cage"  # name of the body that is one, or one for each row
QUATERNION, FRAME = 3, 7  # in its coordinates: where the quaternion begins, and the modes
RING_FORCES = 4  # of every element on rings that bend: two on either ring
CONSTRAINTS = ("axial_force", "moment_y", "moment_z", "drive_torque")
AXIAL_FORCE, MOMENT_Y, MOMENT_Z, DRIVE_TORQUE = range(4)  # places in lambda
N_LAMBDA = len(CONSTRAINTS)  # multipliers that drive and hold the inner ring
N_MU = 3  # position-level constraints among them: all but the drive
N_OWN = N_LAMBDA + N_MU  # multipliers of every bearing, before those of further constraints
HELD_VELOCITIES = (0, 4, 5, 3)  # the inner ring's velocities on which they act
REACTION_UNITS = ("N", "N m", "N m", "N m")  # of their multipliers


class Places(NamedTuple):
    """Where kernels find what: q, u of a body are the places of its first coordinate and velocity
    in y (of their rates in y', of their rows in the residual), b of its velocity in the border."""

    elements: int  # so many
    cages: int  # none, one, or one a row; one that is not there is behind all other bodies
    in_cage: int  # so many elements in each: those of the second are the ones behind
    modes: int  # so many of each cage
    inner_modes: int  # so many of the inner ring; they stand behind its six coordinates
    outer_modes: int
    q: int  # of the elements
    u: int
    inner_q: int
    inner_u: int
    inner_b: int
    outer_q: int
    outer_u: int
    outer_b: int
    cage_q: int  # of the first cage, which the others follow (``cage_at``)
    cage_u: int
    cage_b: int
    bodies_q: int  # of all bodies
    bodies_u: int
    border: int  # so many velocities in the border
    coordinates: int  # so many of all bodies
    lam: int  # multipliers of drive and load, in y; in the border they follow the velocities
    held: int  # those of further constraints, in y
    loads: int  # forces that rings which bend bear, behind all else


class CagePlaces(NamedTuple):
    """Places of a cage's first coordinate, velocity and row of the border."""

    q: int
    u: int
    b: int


@part
def cage_at(k, at):
    """Places of cage k, by the ``Places`` of a bearing."""
    q, u = k * (FRAME + at.modes), k * (RIGID + at.modes)
    return CagePlaces(at.cage_q + q, at.cage_u + u, at.cage_b + u)


@part
def cage_of(i, at):
    """Number of the cage of element i."""
    return 1 if i >= at.in_cage else 0


@dataclass(frozen=True)
class Body:
    """One body of a bearing: its name, how many coordinates its frame has (``RING`` or ``FRAME``),
    and how many modes it has in that frame; or ``count`` such bodies, one after the other."""

    name: str
    frame: int
    modes: int = 0
    count: int = 1

    @property
    def coordinates(self) -> int:
        """So many, of frame and modes."""
        return self.count * (self.frame + self.modes)

    @property
    def velocities(self) -> int:
        """So many, of frame and modes."""
        return self.count * (RIGID + self.modes)

    def views(self, own: np.ndarray, turn: str, end: int) -> dict[str, np.ndarray]:
        """Named views of its coordinates or velocities: of a ring those of its frame, and its
        modes'; of a floating frame its centre's, what stands behind that up to ``end``, called
        ``turn``, and its modes', of several (..., count, n)."""
        if self.frame == RING:
            return {self.name: own[..., :RING], f"{self.name}_modes": own[..., RING:]}
        if self.count > 1:
            own = own.reshape(*own.shape[:-1], self.count, -1)
        centre, modes = own[..., :QUATERNION], own[..., end:]
        return {self.name: centre, turn: own[..., QUATERNION:end], "modes": modes}


def bodies_of_bearing(
    modes: int | None, ring_modes: tuple[int, int] = (0, 0), cages: int = 1
) -> tuple[Body, ...]:
    """Inner ring and outer ring, with so many ``ring_modes``, and so many ``cages``, each with so
    many ``modes``; None: no cage."""
    rings = (
        Body(name, RING, own) for name, own in zip(("inner", "outer"), ring_modes, strict=True)
    )
    return *rings, *(() if modes is None else (Body(CAGE, FRAME, modes, cages),))


@part
def of_element(i):
    """Where those of element i are among the coordinates or velocities of the elements."""
    return slice(PER_ELEMENT * i, PER_ELEMENT * (i + 1))


@dataclass(frozen=True)
class Layout:
    """Slices of y for Z rolling elements and a list of bodies.

    q: elements (x, r, psi, skew, tilt, spin), then each body's; u: elements (v_x, v_r, v_psi,
    w_axis, w_2, w_3), then each body's: ``RING`` and ``FRAME`` say what these are. The border of
    Newton's matrix is (the bodies' velocities, lambda, mu, and the further constraints' lambda and
    mu, one of each for every name in ``held``). A body's modes, a ring's too, follow the
    coordinates of its frame. Where rings bend y ends with the forces s that they bear of every
    element (``rings.races``).
    """

    elements: int
    bodies: tuple[Body, ...]
    held: tuple[str, ...] = ()  # names of the scalar constraints beyond ``CONSTRAINTS``
    bends: bool = False  # do rings bend?

    @property
    def modes(self) -> int:
        """Modes of each cage."""
        return sum(body.modes for body in self.bodies if body.name == CAGE)

    @property
    def cages(self) -> int:
        """So many: none, one, or one for each row of elements."""
        return sum(body.count for body in self.bodies if body.name == CAGE)

    @property
    def has_cage(self) -> bool:
        """Is there a cage?"""
        return self.cages > 0

    @property
    def n_q(self) -> int:
        return self.places.u

    @property
    def n_u(self) -> int:
        return self.places.lam - self.places.u

    @property
    def n_border(self) -> int:
        return self.places.border + N_OWN + 2 * len(self.held)

    @property
    def size(self) -> int:
        return self.places.loads + (RING_FORCES * self.elements if self.bends else 0)

    @property
    def reactions(self) -> tuple[str, ...]:
        """Names of the multipliers, in their order."""
        return (*CONSTRAINTS, *self.held)

    @cached_property
    def places(self) -> Places:
        """The places in y and in the border."""
        own = PER_ELEMENT * self.elements
        q = own + sum(body.coordinates for body in self.bodies)
        v = sum(body.velocities for body in self.bodies)
        lam = q + own + v
        end = lam + N_OWN + 2 * len(self.held)
        at = dict(zip((f"{CAGE}_{kind}" for kind in "qub"), (q, lam, v), strict=True))
        at |= {
            f"{body.name}_{kind}": place
            for body, *where in self._each(own, q + own, 0)
            for kind, place in zip("qub", where, strict=True)
        }
        return Places(
            elements=self.elements, cages=self.cages,
            in_cage=self.elements // max(self.cages, 1), modes=self.modes,
            **{f"{body.name}_modes": body.modes for body in self.bodies if body.frame == RING},
            q=0, u=q, **at, bodies_q=own,
            bodies_u=q + own, border=v, coordinates=q - own, lam=lam, held=lam + N_OWN, loads=end,
        )  # fmt: skip

    def _each(self, q: int, u: int, b: int) -> Iterator[tuple[Body, int, int, int]]:
        """Every body with the places of its first coordinate, velocity and row of the border, where
        those of all bodies begin at q, u and b."""
        for body in self.bodies:
            yield body, q, u, b
            q, u, b = q + body.coordinates, u + body.velocities, b + body.velocities

    def q(self, y: np.ndarray) -> dict[str, np.ndarray]:
        """Named views of the coordinates in y (or of their rates in y')."""
        at = self.places
        views = {"elements": self._elements(y[..., : at.bodies_q])}
        for body, first, _, _ in self._each(at.bodies_q, at.bodies_u, 0):
            views |= body.views(y[..., first : first + body.coordinates], "quaternion", FRAME)
        return views

    def u(self, y: np.ndarray) -> dict[str, np.ndarray]:
        """Named views of the velocities in y (or of accelerations in y')."""
        at = self.places
        own = self._elements(y[..., at.u : at.bodies_u])
        return {"elements": own, **self.border(y[..., at.bodies_u :])}

    def border(self, v: np.ndarray) -> dict[str, np.ndarray]:
        """Named views of what v has of every body's velocities, from the first of all bodies on."""
        views: dict[str, np.ndarray] = {}
        for body, _, _, first in self._each(0, 0, 0):
            views |= body.views(v[..., first : first + body.velocities], "omega", RIGID)
        return views

    def _elements(self, own: np.ndarray) -> np.ndarray:
        return own.reshape(*own.shape[:-1], self.elements, PER_ELEMENT)

    def ring_forces(self, y: np.ndarray) -> np.ndarray:
        """View (..., 2, Z, 2) of the forces that both rings bear, at their ports; none where rings
        are rigid."""
        count = self.elements if self.bends else 0
        return y[..., self.places.loads :].reshape(*y.shape[:-1], 2, count, 2)

    def multipliers(self, y: np.ndarray) -> np.ndarray:
        """Forces and torques of the constraints ``reactions``, a copy."""
        start, further = self.places.lam, self.places.held
        own, more = y[..., start : start + N_LAMBDA], y[..., further : further + len(self.held)]
        return np.concatenate([own, more], axis=-1)
