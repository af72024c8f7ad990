"""Equilibrium of the inner ring, and of every rolling element between it and the outer ring.

Two nested Newton methods with exact tangents: every element finds its place between the rings,
whereupon the ring takes a step. Where forces have a potential it is convex (springs that bear only
pressure, between centres), so that steps which lower it lead to its one minimum from anywhere; this
comes first, with the centrifugal force at the free contact angle. Then what has no potential is
added, in parts if need be.

Rings that bend come between: for every place of the inner ring's seat, the displacements at the
elements are sought at which races, bent by the elements' forces, lie where the elements feel them.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, Protocol, TypeVar

import numpy as np

from flexcage.core.errors import FlexcageError, InputError, RunFailed
from flexcage.system.statics.elements import Elements, Response

_CLOSE = 1e-10  # unbalanced force of the ring, as a share of the load
_SETTLED = 1e-12  # and of an element
_ITERATIONS = 50
_HALVINGS = 40  # an element that touches nothing must find a race by them
_FEW = 14  # halvings where there is no potential to guide them
_ENOUGH = 1e-4  # of the decrease that the slope promises
_SOFT = 1e-9  # of a hard-pressed element's stiffness: holds what touches nothing
_RANK = 1e-13  # of an element's largest stiffness: below, there is none
_FAR = 40.0  # of the elements' scale: a ring so far away has fallen out
_LOST = 1e-3  # unbalanced force of an element with which a step is not worth taking
_PARTS = (1, 3, 9)  # in which speed's other effects come in: all at once, or more


@dataclass(frozen=True)
class Bending:
    """How races yield to the forces q (Z, 3) of all elements along v: from where the seats have
    them, by ``compliance`` (3 Z, 3 Z) times q, and by ``offset`` (Z, 3), which the elements' own
    forces cause. The inner race yields back and the outer one on, so that v loses both."""

    compliance: np.ndarray
    offset: np.ndarray

    def yielded(self, force: np.ndarray) -> np.ndarray:
        """What v (Z, 3) loses under forces (Z, 3)."""
        return self.offset + (self.compliance @ force.ravel()).reshape(-1, 3)


@dataclass(frozen=True)
class Problem:
    """What is to be balanced: ``free`` (5,) marks the ring's free motions, others keep ``held``.

    Springs (5,) [N/m, N m/rad] draw what is free back to ``held``.
    """

    elements: Elements
    load: np.ndarray  # (5,)
    free: np.ndarray  # (5,) bool
    held: np.ndarray  # (5,)
    spring: np.ndarray  # (5,)
    bending: Bending | None = None  # of rings that bend

    def pull(self, ring: np.ndarray) -> np.ndarray:
        """Forces (5,) of load and springs on a ring displaced by u (5,)."""
        return self.load - self.spring * (ring - self.held)

    @cached_property
    def lever(self) -> np.ndarray:
        """Lengths (5,) that make displacements and forces of rotations comparable: 1, or an arm."""
        arm = 100.0 * self.elements.scale
        return np.array([1.0, 1.0, 1.0, arm, arm])

    @cached_property
    def size(self) -> float:
        """Magnitude of the load [N], for what is small beside it."""
        return max(float(np.abs(self.load / self.lever).max()), 1e-6)

    @property
    def soft(self) -> float:
        """Stiffness [N/m] that is small beside that of a pressed element."""
        return _SOFT * self.size / self.elements.scale

    @cached_property
    def at_azimuths(self) -> np.ndarray:
        """B (Z, 3, 5): displacements v = B u at every element."""
        psi = self.elements.azimuth
        B = np.zeros((len(psi), 3, 5))
        B[:, 0, 0] = 1.0
        B[:, 1, 1] = B[:, 2, 4] = np.cos(psi)
        B[:, 1, 2] = np.sin(psi)
        B[:, 2, 3] = -np.sin(psi)
        return B


@dataclass(frozen=True)
class Posture:
    """Displacement u (5,) of the inner ring, elements settled between the rings, and forces.

    Where the outer ring's seat yields (``yielding``), u is relative to that ring, and ``outer``
    (5,) its own displacement.
    """

    ring: np.ndarray
    v: np.ndarray  # (Z, 3) displacements that the elements feel
    own: np.ndarray  # (Z, n) coordinates of the elements
    response: Response
    force: np.ndarray  # (5,) that the elements bear
    unbalanced: float  # largest force left over, as a share of the load; inf: none settled
    energy: float  # of elements, load and springs; a potential while ``share`` is 0
    outer: np.ndarray = field(default_factory=lambda: np.zeros(5))


class Balanced(Protocol):
    """A state of a search for equilibrium: what is unbalanced of it."""

    @property
    def unbalanced(self) -> float: ...


State = TypeVar("State", bound=Balanced)


def balance(problem: Problem) -> Posture:
    """Posture in equilibrium. Raises InputError if the load leaves none, RunFailed if none is
    found."""
    still = _march(problem, posture_at(problem, problem.held, None, 0.0), 0.0)
    if still.unbalanced > _CLOSE:
        raise _no_equilibrium(problem, still)
    if problem.elements.conservative:
        return still

    def onwards(now: Posture, share: float) -> Posture:
        return _march(problem, posture_at(problem, now.ring, now, share), share)

    found = continued(still, onwards, _CLOSE)
    if found.unbalanced <= _CLOSE:
        return found
    axial, *radial = problem.load[:3]
    little = ", or the axial load too small for the radial one" if axial < np.hypot(*radial) else ""
    raise RunFailed(
        f"no equilibrium was found at this speed: {found.unbalanced:.1e} of the load stays "
        f"unbalanced; is the speed too high for the load{little}?"
    )


def continued(still: State, onwards: Callable[[State, float], State], close: float) -> State:
    """From equilibrium without what has no potential to all of it: at once, or in more and more
    parts. ``onwards`` takes a state to a share of it; where none leads there, the state given back
    is not balanced to ``close``."""
    found = still
    for parts in _PARTS:
        found = still
        for k in range(parts):
            with np.errstate(invalid="ignore", divide="ignore"):  # where the search goes astray
                found = onwards(found, (k + 1) / parts)
            if found.unbalanced > close:
                break
        else:
            break
    return found


def tangent(problem: Problem, posture: Posture) -> np.ndarray:
    """Exact tangent (5, 5) of the forces that elements bear over u, the elements following."""
    B, stiffness = problem.at_azimuths, _condensed(posture.response)
    if problem.bending is not None:
        felt = np.linalg.solve(_yielding(problem.bending, stiffness), B.reshape(-1, 5))
        return np.einsum("zia,zij,zjb->ab", B, stiffness, felt.reshape(B.shape))
    return np.einsum("zia,zij,zjb->ab", B, stiffness, B)


def _condensed(r: Response) -> np.ndarray:
    """Stiffness (Z, 3, 3) of elements along v, their own coordinates following."""
    follow = np.linalg.pinv(r.unbalance_w, rcond=_RANK) @ r.unbalance_v
    return r.ring_v - r.ring_w @ follow


def _yielding(bending: Bending, stiffness: np.ndarray) -> np.ndarray:
    """1 + C K (3 Z, 3 Z) of races that yield to elements of a stiffness (Z, 3, 3)."""
    count = len(stiffness)
    columns = bending.compliance.reshape(3 * count, count, 3)
    whole = np.einsum("pzi,zij->pzj", columns, stiffness).reshape(3 * count, 3 * count)
    return whole + np.eye(3 * count)


def posture_at(problem: Problem, ring: np.ndarray, near: Posture | None, share: float) -> Posture:
    """Posture with the ring displaced by u (5,), elements settled between the rings, sought from a
    posture ``near``; ``share`` of what has no potential counts."""
    B = problem.at_azimuths
    v, own = B @ ring, None if near is None else near.own
    if problem.bending is None:
        own, response, unsettled = settle(problem, v, nearest(problem, v, own, share), share)
    else:
        v, own, response, unsettled = _bend(problem, v, near, share)
    force = np.einsum("zij,zi->j", B, response.ring)
    gap = ((force - problem.pull(ring)) / problem.lever)[problem.free]
    left = float(np.abs(gap).max(initial=0.0)) / problem.size
    left = max(left, unsettled) if unsettled < _LOST else np.inf
    energy = float(response.energy.sum() - problem.load @ ring)
    energy += 0.5 * float(problem.spring @ (ring - problem.held) ** 2)
    if problem.bending is not None:
        energy += 0.5 * float(response.ring.ravel() @ problem.bending.compliance
                              @ response.ring.ravel())  # fmt: skip
    return Posture(ring, v, own, response, force, left, energy)


def _bend(
    problem: Problem, rigid: np.ndarray, near: Posture | None, share: float
) -> tuple[np.ndarray, np.ndarray, Response, float]:
    """Displacements v (Z, 3) that elements feel where a rigid ring would displace them by
    ``rigid``, then as ``settle``: Newton's method for v + what races yield to forces at v = rigid.
    """
    assert problem.bending is not None
    bending, scale = problem.bending, problem.elements.scale
    lever = problem.lever[[0, 1, 3]]

    def tried(v: np.ndarray, own: np.ndarray | None) -> tuple[Any, np.ndarray, float]:
        settled = settle(problem, v, nearest(problem, v, own, share), share)
        gap = v - rigid + bending.yielded(settled[1].ring)
        return settled, gap, float(np.abs(gap * lever).max()) / scale

    v, own = (rigid, None) if near is None else (near.v, near.own)
    settled, gap, left = tried(v, own)
    for _ in range(_ITERATIONS):
        if left <= _SETTLED or settled[2] > _LOST:
            break
        matrix = _yielding(bending, _condensed(settled[1]))
        step = -np.linalg.solve(matrix, gap.ravel()).reshape(-1, 3)
        length = min(1.0, scale / max(float(np.abs(step * lever).max()), 1e-300))
        for _ in range(_FEW):
            new, new_gap, new_left = tried(v + length * step, settled[0])
            if new_left < (1.0 - _ENOUGH * length) * left:
                break
            length *= 0.5
        else:
            break
        v, settled, gap, left = v + length * step, new, new_gap, new_left
    own, response, unsettled = settled
    return v, own, response, unsettled if left <= _CLOSE else np.inf


def nearest(problem: Problem, v: np.ndarray, own: np.ndarray | None, share: float) -> np.ndarray:
    """Coordinates (Z, n) from which to settle: the present ones, or guesses of less energy."""
    if own is not None and share > 0.0:
        return own
    choices = problem.elements.guesses(v) + ([] if own is None else [own])
    energy = np.stack([problem.elements.respond(v, w, 0.0).energy for w in choices])
    return np.stack(choices)[energy.argmin(axis=0), np.arange(len(v))]


def settle(
    problem: Problem, v: np.ndarray, w: np.ndarray, share: float
) -> tuple[np.ndarray, Response, float]:
    """Elements in equilibrium at displacements v (Z, 3) of the ring, sought from w (Z, n).

    Their coordinates w, their response, and the largest force left over, as a share of the load.
    """
    elements, least = problem.elements, _SETTLED * problem.size
    r = elements.respond(v, w, share)
    stuck, halvings = np.zeros(len(w), bool), _HALVINGS if share == 0.0 else _FEW
    for _ in range(_ITERATIONS):
        left = np.abs(r.unbalance).max(axis=1)
        going = (left > least) & ~stuck
        if not going.any():
            break
        stiffness = r.unbalance_w + problem.soft * np.eye(w.shape[1])
        step = -np.linalg.solve(stiffness, r.unbalance[..., None])[..., 0]
        slope = (step * r.unbalance).sum(axis=1)
        far = np.abs(step).max(axis=1)
        length = np.where(going, np.minimum(1.0, elements.scale / np.maximum(far, 1e-300)), 0.0)
        for _ in range(halvings):
            trial = elements.respond(v, elements.moved(w, length[:, None] * step), share)
            fine = np.abs(trial.unbalance).max(axis=1) < (1.0 - _ENOUGH * length) * left
            if share == 0.0:
                fine |= trial.energy - r.energy <= _ENOUGH * length * slope
            if (fine | ~going).all():
                break
            length = np.where(fine | ~going, length, 0.5 * length)
        else:
            stuck |= going & ~fine
            length = np.where(stuck, 0.0, length)
            trial = elements.respond(v, elements.moved(w, length[:, None] * step), share)
        w, r = elements.moved(w, length[:, None] * step), trial
        if (left[stuck] > _LOST * problem.size).any():
            break
    return w, r, float(np.abs(r.unbalance).max()) / problem.size


def _march(problem: Problem, posture: Posture, share: float) -> Posture:
    """Steps of the ring at one share of what has no potential, until it is balanced or stuck."""
    free, scale = problem.free, problem.elements.scale
    for _ in range(_ITERATIONS):
        far = np.abs(posture.ring * problem.lever).max() > _FAR * scale
        if posture.unbalanced <= _CLOSE or far or posture.unbalanced == np.inf:
            break
        matrix = tangent(problem, posture)
        matrix += np.diag(problem.soft * problem.lever**2 + problem.spring)
        gap = posture.force - problem.pull(posture.ring)
        step = np.zeros(5)
        step[free] = -np.linalg.solve(matrix[np.ix_(free, free)], gap[free])
        length = min(1.0, scale / max(float(np.abs(step * problem.lever).max()), 1e-300))
        for _ in range(_FEW):
            new = posture_at(problem, posture.ring + length * step, posture, share)
            fine = new.unbalanced < (1.0 - _ENOUGH * length) * posture.unbalanced
            if share == 0.0 and new.unbalanced < np.inf:
                promised = length * float(gap[free] @ step[free])
                fine |= new.energy - posture.energy <= _ENOUGH * promised
            if fine:
                break
            length *= 0.5
        else:
            break
        posture = new
    return posture


def _no_equilibrium(problem: Problem, posture: Posture) -> FlexcageError:
    where = np.abs(posture.ring)
    if (where * problem.lever).max() > _FAR * problem.elements.scale:
        return InputError(
            "the bearing cannot bear this load: its inner ring moves off, by "
            f"{1e3 * where[:3].max():.2g} mm and {where[3:].max():.2g} rad when the search was "
            "given up; is its axial load towards +x, and large enough?",
            where="load",
        )
    return RunFailed(
        f"no equilibrium was found: {posture.unbalanced:.1e} of the load stays unbalanced "
        f"({_CLOSE:.0e} is allowed)"
    )
