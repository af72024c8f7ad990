"""Elastic bodies whose matching surfaces press and rub on each other: static, small motions.

Surfaces lie on each other node by node (``mesh.revolved``), so that what touches what never
changes; a play or an interference is a number, the gap at the start. At every point of integration
of a face the pressure is ``penalty`` times the overlap, and the friction ``penalty`` times the
elastic part of the slip, up to Coulomb's bound (return mapping: A. E. Giannakopoulos, Comput.
Struct. 32 (1989) 157). The rest of the slip stays: a state remembers it, so that loads are applied
in their order. Newton's method, with the tangent's unsymmetric part.

Nothing but the motions of surfaces against each other matters to the contact: all else is
eliminated once (``fem.separation``), for all gaps and loads.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.linalg import LinAlgError, solve

from flexcage.core.errors import RunFailed
from flexcage.fem.condensed import dofs_of
from flexcage.fem.curved import FacePoints, face_points
from flexcage.fem.linear import SINGULAR
from flexcage.fem.separation import SeparationModel

log = logging.getLogger(__name__)

_MOST = 60  # Newton steps
_UNHELD = 1e-3  # share of the forces that weak springs may bear
_HALVINGS = 5  # of a step that does not bring the forces nearer to balance


class NoBalance(RunFailed):
    """Newton's steps did not balance the forces of a contact; smaller load steps may."""


@dataclass(frozen=True, eq=False)
class Touching:
    """Two surfaces: ``faces`` (m, 6) of one body, ``others`` (m, 6) of the other at the same places
    in the same order; ``inside`` (m, 3) are places in the first body behind its faces."""

    name: str
    faces: np.ndarray
    others: np.ndarray
    inside: np.ndarray
    friction: float


@dataclass(frozen=True, eq=False)
class ContactState:
    """Separations of surfaces (m,), displacements (n, 3) [m], and at the points of contact (q,) the
    pressure [Pa], the friction (q, 2) [Pa] against the second body's slip, and the slip (q, 2) [m]
    that stays."""

    separation: np.ndarray
    moved: np.ndarray
    pressure: np.ndarray
    friction: np.ndarray
    slipped: np.ndarray


@dataclass(frozen=True, eq=False)
class _Response:
    """Tractions at given displacements, and their slopes."""

    pressure: np.ndarray
    friction: np.ndarray
    slipped: np.ndarray
    closed: np.ndarray  # (q,) of bool
    slope: np.ndarray  # (q, 2, 2) of the friction in the slip, over the penalty
    onward: np.ndarray  # (q, 2) slope of the friction in the pressure, where it slips


class ContactProblem:
    """Surfaces that touch, of bodies that are ``separation`` (``fem.separation``)."""

    def __init__(
        self, separation: SeparationModel, pairs: Sequence[Touching], *, penalty: float
    ) -> None:
        self.separation, self.pairs, self.penalty = separation, tuple(pairs), penalty
        nodes = separation.nodes
        points = [face_points(nodes, pair.faces) for pair in pairs]
        counts = [len(p.weights) for p in points]
        ends = np.cumsum([0, *counts])
        self.part = {p.name: slice(a, b) for p, a, b in zip(pairs, ends, ends[1:])}
        self.places = np.vstack([p.places for p in points])
        self.weights = np.concatenate([p.weights for p in points])
        self.coefficient = np.repeat([p.friction for p in pairs], counts)
        self.normals = np.vstack([_outward(p, pair) for p, pair in zip(points, pairs)])
        self.axes = _across(self.normals)  # (q, 2, 3)
        relative = sp.vstack([
            face_points(nodes, pair.others).shapes - p.shapes for p, pair in zip(points, pairs)
        ]).tocsr()  # fmt: skip
        self.B_n = separation.of_separations(_along(relative, self.normals))
        self.B_t = [separation.of_separations(_along(relative, self.axes[:, k])) for k in (0, 1)]

    def at_rest(self) -> ContactState:
        """Nothing moved, nothing slipped."""
        q = len(self.weights)
        return ContactState(
            np.zeros(self.B_n.shape[1]), np.zeros_like(self.separation.nodes), np.zeros(q),
            np.zeros((q, 2)), np.zeros((q, 2)),
        )  # fmt: skip

    def gaps(self, of: Mapping[str, float]) -> np.ndarray:
        """Gaps at the start (q,) [m] by the names of pairs; negative where bodies overlap."""
        out = np.zeros(len(self.weights))
        for name, gap in of.items():
            out[self.part[name]] = gap
        return out

    def respond(self, u: np.ndarray, gaps: np.ndarray, before: ContactState) -> _Response:
        """Tractions at separations u (m,), with the slip of the state before."""
        overlap = -(gaps + self.B_n @ u)
        closed = overlap >= 0.0  # at rest without a gap they touch
        pressure = self.penalty * np.where(closed, overlap, 0.0)
        slip = np.stack([B @ u for B in self.B_t], axis=1)
        trial = self.penalty * (slip - before.slipped)
        size, bound = np.linalg.norm(trial, axis=1), self.coefficient * pressure
        sticks = closed & (size <= bound)
        share = np.where(sticks, 1.0, bound / np.where(size > 0.0, size, 1.0))
        way = trial / np.where(size > 0.0, size, 1.0)[:, None]
        friction = trial * share[:, None]
        slope = share[:, None, None] * (
            np.eye(2) - np.where(sticks, 0.0, 1.0)[:, None, None] * way[:, :, None] * way[:, None]
        )
        slides = closed & ~sticks
        onward = np.where(slides, self.coefficient, 0.0)[:, None] * way
        return _Response(pressure, friction, slip - friction / self.penalty, closed, slope, onward)

    def solve(
        self, loads: np.ndarray, gaps: np.ndarray, before: ContactState, *, tolerance: float = 1e-6
    ) -> ContactState:
        """Equilibrium under nodal loads (n, 3) [N], from the state before; forces balance to within
        ``tolerance`` of the largest."""
        f, moving = self.separation.condensed(loads)
        u = before.separation.copy()
        found, residual = self._residual(u, f, gaps, before)
        size = scale = 1.0
        for step in range(_MOST):
            size, scale = float(np.linalg.norm(residual)), self._scale(found, f)
            log.debug("contact: step %d, residual %.2g of the forces", step, size / scale)
            if size <= tolerance * scale and step:
                break
            change = self._newton(found, residual)
            most = size if step else np.inf
            for halving in range(_HALVINGS):
                trial = u + 0.5**halving * change
                next_found, next_residual = self._residual(trial, f, gaps, before)
                if np.linalg.norm(next_residual) < most:
                    break
            u, found, residual = trial, next_found, next_residual
        else:
            raise NoBalance(
                f"The contact of the joint found no balance in {_MOST} steps (forces are off by "
                f"{size / scale:.1g} of the largest); apply the loads in more steps."
            )
        moved = self.separation.expanded(u, moving)
        held = self.separation.springs * float(np.abs(moved).sum())
        if held > _UNHELD * float(np.abs(loads).sum() + self.weights @ found.pressure):
            raise RunFailed(
                "Nothing but friction beyond its bound holds a body of the joint against its loads "
                f"(it would move by {np.abs(moved).max():.2g} m); clamp it harder or load it less."
            )
        return ContactState(u, moved, found.pressure, found.friction, found.slipped)

    def _residual(
        self, u: np.ndarray, f: np.ndarray, gaps: np.ndarray, before: ContactState
    ) -> tuple[_Response, np.ndarray]:
        found = self.respond(u, gaps, before)
        residual = self.separation.stiffness @ u - f - self.B_n.T @ (self.weights * found.pressure)
        for B, t in zip(self.B_t, found.friction.T):
            residual += B.T @ (self.weights * t)
        return found, residual

    def _scale(self, found: _Response, f: np.ndarray) -> float:
        pressed = np.linalg.norm(self.B_n.T @ (self.weights * found.pressure))
        return max(float(pressed), float(np.linalg.norm(f)), 1e-30)

    def _newton(self, found: _Response, residual: np.ndarray) -> np.ndarray:
        """The step of Newton's method."""
        push = self.penalty * self.weights * found.closed
        drag = self.penalty * self.weights[:, None, None] * found.slope
        drag = drag * found.closed[:, None, None]
        more = self.B_n.T @ sp.diags(push) @ self.B_n
        for i, B in enumerate(self.B_t):
            for j, C in enumerate(self.B_t):
                more = more + B.T @ sp.diags(drag[:, i, j]) @ C
        slides = bool((found.onward != 0.0).any())
        if slides:  # friction follows the pressure, which falls with the gap
            for B, way in zip(self.B_t, found.onward.T):
                more = more - B.T @ sp.diags(way * push) @ self.B_n
        matrix = np.array(self.separation.stiffness, order="F")
        entry = more.tocoo()
        matrix[entry.row, entry.col] += entry.data
        try:
            return np.asarray(
                solve(matrix, -residual, assume_a="gen" if slides else "pos", overwrite_a=True)
            )
        except LinAlgError as error:
            raise RunFailed(SINGULAR.format(what=str(error))) from error

    def resultants(self, state: ContactState, about: np.ndarray) -> dict[str, np.ndarray]:
        """Force [N] and moment [N m] about a point (6,) on the second body of every pair."""
        traction = state.pressure[:, None] * self.normals
        traction = traction - np.einsum("qk,qka->qa", state.friction, self.axes)
        force = self.weights[:, None] * traction
        moment = np.cross(self.places - about, force)
        both = np.concatenate([force, moment], axis=1)
        return {name: both[part].sum(axis=0) for name, part in self.part.items()}


def _outward(points: FacePoints, pair: Touching) -> np.ndarray:
    """Normals (q, 3) that point from the first body to the second."""
    behind = np.repeat(pair.inside, len(points.weights) // len(pair.faces), axis=0)
    side = np.einsum("qa,qa->q", points.normals, points.places - behind)
    return points.normals * np.sign(side)[:, None]


def _across(normals: np.ndarray) -> np.ndarray:
    """Two unit vectors (q, 2, 3) across each normal."""
    least = np.eye(3)[np.argmin(np.abs(normals), axis=1)]
    first = np.cross(normals, least)
    first /= np.linalg.norm(first, axis=1)[:, None]
    return np.stack([first, np.cross(normals, first)], axis=1)


def _along(relative: sp.csr_matrix, ways: np.ndarray) -> sp.csr_matrix:
    """Components (q, 3n) of relative displacements (q, n) along ways (q, 3)."""
    entry = relative.tocoo()
    rows, columns = np.repeat(entry.row, 3), dofs_of(entry.col)
    data = (entry.data[:, None] * ways[entry.row]).ravel()
    return sp.csr_matrix((data, (rows, columns)), (relative.shape[0], 3 * relative.shape[1]))
