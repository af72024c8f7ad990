"""Equilibrium of the inner ring, and of every rolling element between it and the outer ring.

Newton's method on all coordinates at once, the elements' own eliminated. Where forces have a
potential it is convex (springs that bear only pressure, between centres), so that a step which
lowers it leads to its one minimum from anywhere; this comes first, with the centrifugal force
at the free contact angle. Then what has no potential is added, in steps if need be.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from flexcage.core.errors import RunFailed
from flexcage.system.statics.elements import Elements, Response

_CLOSE = 1e-11  # unbalanced force, as a share of the load
_ITERATIONS = 200
_HALVINGS = 30
_SOFT = 1e-9  # of a hard-pressed element's stiffness: holds what touches nothing
_FAR = 40.0  # of the elements' scale: a ring so far away has fallen out
_SHARES = (1, 4, 16, 64)  # steps in which speed's other effects come in: all at once, or more


@dataclass(frozen=True)
class Posture:
    """Displacement u (5,) of the inner ring and coordinates w (Z, 2) of the elements."""

    ring: np.ndarray
    own: np.ndarray
    unbalanced: float = np.inf  # largest force, as a share of the load


@dataclass(frozen=True)
class Problem:
    """What is to be balanced: ``free`` (5,) marks the ring's free motions, others keep ``held``."""

    elements: Elements
    load: np.ndarray  # (5,)
    free: np.ndarray  # (5,) bool
    held: np.ndarray  # (5,)

    @property
    def lever(self) -> np.ndarray:
        """Lengths (5,) that make displacements and forces of rotations comparable: 1, or an arm."""
        arm = 100.0 * self.elements.scale
        return np.array([1.0, 1.0, 1.0, arm, arm])

    @property
    def size(self) -> float:
        """Magnitude of the load [N], for what is small beside it."""
        return max(float(np.abs(self.load / self.lever).max()), 1e-6)

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
class State:
    """A posture with the elements' response there, its forces on the ring and its tangent."""

    posture: Posture
    response: Response
    force: np.ndarray  # (5,) that the elements bear
    energy: float


def balance(problem: Problem) -> Posture:
    """Posture in equilibrium. Raises RunFailed if there is none, or none is found."""
    posture = Posture(problem.held.copy(), problem.elements.start())
    posture = _march(problem, posture, 0.0)
    if problem.elements.own_energy:
        return posture
    for count in _SHARES:
        found, reached = posture, True
        for k in range(count):
            found = _march(problem, found, (k + 1) / count, fails=False)
            reached = found.unbalanced < _CLOSE
            if not reached:
                break
        if reached:
            return found
    raise RunFailed(
        f"no equilibrium was found at this speed: {found.unbalanced:.1e} of the load stays "
        "unbalanced; is the speed too high for the load?"
    )


def stiffness(problem: Problem, posture: Posture) -> np.ndarray:
    """Exact tangent (5, 5) of the forces on the ring, the elements following."""
    share = 0.0 if problem.elements.own_energy else 1.0
    state = _evaluate(problem, posture, share)
    direct, coupling, _ = _tangent(problem, state, 0.0)
    return direct - coupling


def bears(problem: Problem, posture: Posture) -> np.ndarray:
    """Forces and moments (5,) that the elements bear; load where free, and reactions."""
    share = 0.0 if problem.elements.own_energy else 1.0
    return _evaluate(problem, posture, share).force


def _evaluate(problem: Problem, posture: Posture, share: float) -> State:
    B = problem.at_azimuths()
    response = problem.elements.respond(B @ posture.ring, posture.own, share)
    force = np.einsum("zij,zi->j", B, response.ring)
    energy = float(response.energy.sum() - problem.load @ posture.ring)
    return State(posture, response, force, energy)


def _tangent(
    problem: Problem, state: State, soft: float
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Stiffness (5, 5) with elements held, what their following takes from it, and (Z, 2, 5) how
    they follow."""
    B, r = problem.at_azimuths(), state.response
    direct = np.einsum("zia,zij,zjb->ab", B, r.ring_v, B)
    own = r.unbalance_w + soft * np.eye(2)
    if soft == 0.0:  # elements that touch nothing follow nothing
        loose = np.abs(own).max(axis=(1, 2)) == 0.0
        own = np.where(loose[:, None, None], np.eye(2), own)
    follow = np.linalg.solve(own, r.unbalance_v @ B)
    return direct, np.einsum("zia,zij,zjb->ab", B, r.ring_w, follow), follow


def _unbalanced(problem: Problem, state: State) -> float:
    ring = ((state.force - problem.load) / problem.lever)[problem.free]
    return (
        max(float(np.abs(ring).max(initial=0.0)), float(np.abs(state.response.unbalance).max()))
        / problem.size
    )


def _march(problem: Problem, posture: Posture, share: float, *, fails: bool = True) -> Posture:
    """Newton's method at one share of what has no potential; ``fails``: raise if none is found."""
    scale = problem.elements.scale
    state = _evaluate(problem, posture, share)
    hard = problem.size / scale
    for _ in range(_ITERATIONS):
        left = _unbalanced(problem, state)
        if left < _CLOSE:
            return replace(state.posture, unbalanced=left)
        ring, own, slope = _step(problem, state, _SOFT * hard)
        largest = max(float(np.abs(ring * problem.lever).max()), float(np.abs(own).max()))
        state = _shorter(problem, state, ring, own, slope, share, min(1.0, scale / largest))
        if np.abs(state.posture.ring * problem.lever).max() > _FAR * scale:
            break
    left = _unbalanced(problem, state)
    if fails:
        raise _no_equilibrium(problem, state, left)
    return replace(state.posture, unbalanced=left)


def _step(problem: Problem, state: State, soft: float) -> tuple[np.ndarray, np.ndarray, float]:
    """Newton's step of ring (5,) and elements (Z, 2), and the energy's slope along it."""
    B, r, free = problem.at_azimuths(), state.response, problem.free
    direct, coupling, follow = _tangent(problem, state, soft)
    own = r.unbalance_w + soft * np.eye(2)
    eased = np.linalg.solve(own, r.unbalance[..., None])[..., 0]
    gap = state.force - problem.load
    right = gap - np.einsum("zia,zij,zj->a", B, r.ring_w, eased)
    matrix = direct - coupling + np.diag(soft * problem.lever**2)
    ring = np.zeros(5)
    ring[free] = -np.linalg.solve(matrix[np.ix_(free, free)], right[free])
    moved = -eased - follow @ ring
    return ring, moved, float(gap[free] @ ring[free] + (r.unbalance * moved).sum())


def _shorter(
    problem: Problem,
    state: State,
    ring: np.ndarray,
    own: np.ndarray,
    slope: float,
    share: float,
    length: float,
) -> State:
    """The step, or as much of it as lowers the energy; where there is none, the unbalance."""
    before, potential = _unbalanced(problem, state), share == 0.0
    for _ in range(_HALVINGS):
        posture = Posture(state.posture.ring + length * ring, state.posture.own + length * own)
        new = _evaluate(problem, posture, share)
        drop = new.energy - state.energy <= 1e-4 * length * slope + 1e-14 * abs(state.energy)
        after = _unbalanced(problem, new)
        if (potential and drop) or after < (1.0 - 1e-4 * length) * before:
            return new
        length *= 0.5
    return new


def _no_equilibrium(problem: Problem, state: State, left: float) -> RunFailed:
    where = state.posture.ring
    if np.abs(where * problem.lever).max() > _FAR * problem.elements.scale:
        return RunFailed(
            f"the bearing cannot bear this load: the inner ring moves off by more than "
            f"{np.abs(where[:3]).max() * 1e3:.2g} mm or {np.abs(where[3:]).max() * 1e3:.2g} mrad; "
            "a single angular contact bearing needs an axial load of about 1.2 times the radial "
            "one times tan(contact angle) or more, a moment-free ring no tilt of its own"
        )
    return RunFailed(
        f"no equilibrium was found: {left:.1e} of the load stays unbalanced "
        f"({_CLOSE:.0e} is allowed)"
    )
