"""Equilibrium of a shaft and of all its bearings, by Newton's method with exact slopes.

Unknown are the shaft's motions a (displacements q = ``motions`` a), and the outer rings' p. While
the elements' forces have a potential, so has the whole machine: beams, seats and springs add
quadratic parts, loads and pushes linear ones. It is convex, so steps that lower it lead to its one
minimum; what has no potential (speed) is added after that, in parts if need be
(``system.statics.equilibrium``).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from flexcage.core.errors import FlexcageError, InputError, RunFailed
from flexcage.machine.seating import Seated
from flexcage.machine.shaft import ShaftModel
from flexcage.system.statics.equilibrium import Posture, continued

_CLOSE = 1e-10  # unbalanced force, as a share of the loads
_ROUNDING = 1e-14  # of the stiff parts' forces: what is left of their differences
_ITERATIONS = 120
_FEW, _ENOUGH = 16, 1e-4
_FAR = 40.0  # of the elements' scale: a shaft so far away has fallen out of its bearings
_AWAY = 0.05  # m: and so may one whose outer rings slide along with it


@dataclass(frozen=True, eq=False)
class Together:
    """A shaft under generalised forces ``load`` (c,) in its bearings; ``seats`` (P, P) is the
    stiffness of all seats over the coordinates p of all outer rings."""

    shaft: ShaftModel
    load: np.ndarray
    bearings: Sequence[Seated]
    seats: np.ndarray

    @cached_property
    def size(self) -> float:
        """Magnitude of the forces [N], for what is small beside it."""
        return max(b.problem.size for b in self.bearings)

    @cached_property
    def starts(self) -> np.ndarray:
        """Where the unknowns of every outer ring begin, and where all end."""
        counts = [self.shaft.motions.shape[1], *(b.outer.ways.shape[1] for b in self.bearings)]
        return np.cumsum(counts)

    @cached_property
    def linear(self) -> np.ndarray:
        """Stiffness of the shaft in its own motions."""
        T = self.shaft.made
        return T.T @ self.shaft.stiffness @ T if not self.shaft.rigid else np.zeros((5, 5))

    @cached_property
    def pull(self) -> np.ndarray:
        """Loads in the shaft's own motions."""
        return np.asarray(self.shaft.made.T @ self.load)

    @cached_property
    def shares(self) -> list[np.ndarray]:
        """How the unknowns move r of every bearing: (5, size of the unknowns)."""
        found = []
        for k, b in enumerate(self.bearings):
            moves = np.zeros((5, self.starts[-1]))
            moves[:, : self.starts[0]] = b.mirror[:, None] * self.shaft.motions[b.at]
            moves[:, self.starts[k] : self.starts[k + 1]] = -b.outer.ways
            found.append(moves)
        return found

    @cached_property
    def lever(self) -> np.ndarray:
        """Lengths that make forces and moments of all unknowns comparable."""
        arms = np.tile([1.0, 1.0, 1.0, 0.01, 0.01], len(self.shaft.places))
        own = arms if not self.shaft.rigid else np.array([1.0, 1.0, 1.0, 0.05, 0.05])
        more = np.diag(self.linear)[len(own) :]  # coordinates of no node, beside the stiffest x
        own = np.concatenate(
            [own, np.sqrt(more / max(float(self.linear.diagonal().max()), 1e-300))]
        )
        return np.concatenate([own, np.ones(self.starts[-1] - self.starts[0])])

    def split(self, z: np.ndarray) -> tuple[np.ndarray, list[np.ndarray]]:
        """The shaft's displacements q (5 n,), and the outer rings' p."""
        rings = [z[i:j] for i, j in zip(self.starts, self.starts[1:])]
        return self.shaft.motions @ z[: self.starts[0]], rings


@dataclass(frozen=True, eq=False)
class Standing:
    """Unknowns z, and what follows: postures of all bearings, what is unbalanced (1: as much as is
    allowed), and the energy."""

    z: np.ndarray
    postures: list[Posture]
    gap: np.ndarray
    unbalanced: float
    share_left: float  # largest unbalanced force, as a share of the loads
    energy: float


def standing(m: Together, z: np.ndarray, near: Standing | None, share: float) -> Standing:
    """State of the machine at unknowns z; ``share`` of what has no potential counts."""
    q, rings = m.split(z)
    a = z[: m.starts[0]]
    gap = np.zeros(len(z))
    pulled = m.linear @ a
    gap[: m.starts[0]] = pulled - m.pull
    noise = np.zeros(len(z))
    noise[: m.starts[0]] = np.abs(m.linear) @ np.abs(a)
    energy = 0.5 * float(a @ pulled) - float(m.pull @ a)
    postures, settled = [], True
    for k, (b, p) in enumerate(zip(m.bearings, rings)):
        found = b.press(b.relative(q, p), None if near is None else near.postures[k], share)
        postures.append(found)
        settled &= bool(np.isfinite(found.unbalanced))
        gap += m.shares[k].T @ found.force
        gap[m.starts[k] : m.starts[k + 1]] += b.outer.push
        energy += found.energy + float(p @ b.outer.push)
    p = z[m.starts[0] :]
    gap[m.starts[0] :] += m.seats @ p
    noise[m.starts[0] :] = np.abs(m.seats) @ np.abs(p)
    energy += 0.5 * float(p @ m.seats @ p)
    allowed = _CLOSE * m.size * m.lever + _ROUNDING * noise
    worst = float(np.abs(gap / allowed).max()) if settled else np.inf
    return Standing(z, postures, gap, worst, float(np.abs(gap / m.lever).max()) / m.size, energy)


def tangent_of(m: Together, now: Standing, soft: bool = False) -> np.ndarray:
    """Exact slopes of all gaps over the unknowns; ``soft`` springs hold what touches nothing."""
    whole = np.zeros((m.starts[-1], m.starts[-1]))
    whole[: m.starts[0], : m.starts[0]] = m.linear
    whole[m.starts[0] :, m.starts[0] :] = m.seats
    for k, (b, posture) in enumerate(zip(m.bearings, now.postures)):
        slope = b.tangent(posture)
        if soft:
            slope = slope + np.diag(b.problem.soft * b.problem.lever**2)
        whole += m.shares[k].T @ slope @ m.shares[k]
        if soft:
            own = slice(m.starts[k], m.starts[k + 1])
            whole[own, own] += b.problem.soft * np.eye(own.stop - own.start)
    return whole


def balance(m: Together) -> Standing:
    """The machine in equilibrium. Raises InputError for loads that leave none, RunFailed if none is
    found."""
    still = _march(m, standing(m, np.zeros(m.starts[-1]), None, 0.0), 0.0)
    if still.unbalanced > 1.0:
        raise _no_equilibrium(m, still)
    if all(b.elements.conservative for b in m.bearings):
        return still

    def onwards(now: Standing, share: float) -> Standing:
        return _march(m, standing(m, now.z, now, share), share)

    found = continued(still, onwards, 1.0)
    if found.unbalanced <= 1.0:
        return found
    raise RunFailed(
        f"no equilibrium of the machine was found at this speed: {found.share_left:.1e} of its "
        "loads stays unbalanced; is the speed too high for the preload?"
    )


def _march(m: Together, now: Standing, share: float) -> Standing:
    for _ in range(_ITERATIONS):
        if now.unbalanced <= 1.0 or now.unbalanced == np.inf or _farthest(m, now)[0] > _FAR:
            break
        step = -_solved(tangent_of(m, now, soft=True), now.gap)
        reach = max(
            float(np.abs(shares @ step * b.problem.lever).max()) / b.elements.scale
            for b, shares in zip(m.bearings, m.shares)
        )
        length = min(1.0, 1.0 / max(reach, 1e-300))
        for _ in range(_FEW):
            new = standing(m, now.z + length * step, now, share)
            fine = new.unbalanced < max((1.0 - _ENOUGH * length) * now.unbalanced, 1.0)
            if share == 0.0 and new.unbalanced < np.inf:
                promised = length * float(now.gap @ step)
                fine |= new.energy - now.energy <= _ENOUGH * promised
            if fine:
                break
            length *= 0.5
        else:
            break
        now = new
    return now


def _solved(matrix: np.ndarray, right: np.ndarray) -> np.ndarray:
    """Solution of a system whose rows are of many sizes."""
    scale = 1.0 / np.sqrt(np.maximum(np.abs(np.diag(matrix)), 1e-300))
    try:
        found = np.linalg.solve(scale[:, None] * matrix * scale, scale * right)
    except np.linalg.LinAlgError:  # where the search goes astray
        found = np.linalg.lstsq(scale[:, None] * matrix * scale, scale * right)[0]
    return np.asarray(scale * found)


def _farthest(m: Together, now: Standing) -> tuple[float, Seated]:
    """How far the ring that has moved most is from its bearing's elements, in their scale, or from
    where it was, by ``_AWAY``."""
    q, _ = m.split(now.z)
    far = []
    for p, b in zip(now.postures, m.bearings):
        pressed = float(np.abs(p.ring * b.problem.lever).max()) / b.elements.scale
        away = _FAR * float(np.abs(q[b.at[:3]]).max()) / _AWAY
        far.append((max(pressed, away), b))
    return max(far, key=lambda pair: pair[0])


def _no_equilibrium(m: Together, now: Standing) -> FlexcageError:
    far, bearing = _farthest(m, now)
    if far > _FAR:
        q, _ = m.split(now.z)
        x, y, z = q[bearing.at[:3]]
        way = "along x" if abs(x) > np.hypot(y, z) else "across x"
        return InputError(
            f"The bearings cannot hold the shaft: at bearing {bearing.spec.place.name} it moves "
            f"off {way}; does a bearing with a fixed seat face each axial push (facing), and is "
            "there preload, or a second bearing against tilting?",
            where="bearings",
        )
    return RunFailed(
        f"no equilibrium of the machine was found: {now.share_left:.1e} of its loads stays "
        f"unbalanced ({_CLOSE:.0e} is allowed)"
    )
