"""Elastic bodies whose matching surfaces press and rub on each other: static, small motions.

Surfaces lie on each other node by node (``mesh.revolved``), so that what touches what never
changes; a play or an interference is a number, the gap at the start. At every point of integration
of a face the pressure is ``penalty`` times the overlap, and the friction ``penalty`` times the
elastic part of the slip, up to Coulomb's bound (return mapping: A. E. Giannakopoulos, Comput.
Struct. 32 (1989) 157). The rest of the slip stays: a state remembers it, so that loads are applied
in their order. Newton's method; its tangent in slip is not symmetric, so that its symmetric part is
factored and GMRES does the rest. A factor is kept while GMRES converges quickly with it.
"""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import LinearOperator, gmres

from flexcage.core.errors import RunFailed
from flexcage.fem.condensed import dofs_of
from flexcage.fem.curved import FacePoints, face_points
from flexcage.fem.linear import LinearSolver, available_kinds, linear_solver

log = logging.getLogger(__name__)

_MOST = 60  # Newton steps
_FEW, _ENOUGH = 18, 60  # iterations of GMRES with an old factor, and with a new one
_CLOSE = 1e-3  # of a Newton step's equations
_UNHELD = 1e-3  # share of the forces that weak springs may bear
_HALVINGS = 5  # of a step that does not bring the forces nearer to balance


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
    """Displacements (n, 3) [m], and at the points of contact (q,) the pressure [Pa], the friction
    (q, 2) [Pa] on the second body and the slip (q, 2) [m] that stays."""

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
    """Bodies of one stiffness K (3n, 3n) with nodes (n, 3), their touching surfaces, and degrees of
    freedom that are ``held`` (k,).

    ``springs`` [N/m] hold every node against nothing, so weakly that they carry no load.
    """

    def __init__(
        self,
        K: sp.csr_matrix,
        nodes: np.ndarray,
        pairs: Sequence[Touching],
        held: np.ndarray,
        *,
        penalty: float,
        springs: float = 0.0,
    ) -> None:
        self.pairs, self.penalty, self.springs = tuple(pairs), penalty, springs
        self.n_nodes = len(nodes)
        self.free = np.setdiff1d(np.arange(K.shape[0]), held)
        self.K = (K + springs * sp.identity(K.shape[0], format="csr")).tocsr()
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
        self.B_n = _along(relative, self.normals)[:, self.free]
        self.B_t = [_along(relative, self.axes[:, k])[:, self.free] for k in (0, 1)]
        self._factor: LinearSolver | None = None

    def at_rest(self) -> ContactState:
        """Nothing moved, nothing slipped."""
        q = len(self.weights)
        return ContactState(
            np.zeros((self.n_nodes, 3)), np.zeros(q), np.zeros((q, 2)), np.zeros((q, 2))
        )

    def gaps(self, of: Mapping[str, float]) -> np.ndarray:
        """Gaps at the start (q,) [m] by the names of pairs; negative where bodies overlap."""
        out = np.zeros(len(self.weights))
        for name, gap in of.items():
            out[self.part[name]] = gap
        return out

    def respond(self, u: np.ndarray, gaps: np.ndarray, before: ContactState) -> _Response:
        """Tractions at free displacements u, with the slip of the state before."""
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
        f = loads.ravel()[self.free]
        K = self.K[self.free][:, self.free]
        u = before.moved.ravel()[self.free].copy()
        found, residual = self._residual(K, u, f, gaps, before)
        for step in range(_MOST):
            size, scale = np.linalg.norm(residual), self._scale(found, f)
            log.debug("contact: step %d, residual %.2g of the forces", step, size / scale)
            if size <= tolerance * scale and step:
                break
            change = self._newton(K, found, residual)
            for halving in range(_HALVINGS):
                trial = u + 0.5**halving * change
                next_found, next_residual = self._residual(K, trial, f, gaps, before)
                if np.linalg.norm(next_residual) < size or halving == _HALVINGS - 1 or not step:
                    break
            u, found, residual = trial, next_found, next_residual
        else:
            raise RunFailed(
                f"The contact of the joint found no balance in {_MOST} steps (forces are off by "
                f"{size / scale:.1g} of the largest); apply the loads in more steps."
            )
        held = self.springs * np.linalg.norm(u)
        if held > _UNHELD * scale:
            raise RunFailed(
                "Nothing but friction beyond its bound holds a body of the joint against its loads "
                f"(it would move by {np.abs(u).max():.2g} m); clamp it harder or load it less."
            )
        moved = np.zeros(self.K.shape[0])
        moved[self.free] = u
        return ContactState(moved.reshape(-1, 3), found.pressure, found.friction, found.slipped)

    def _residual(
        self, K: sp.csr_matrix, u: np.ndarray, f: np.ndarray, gaps: np.ndarray,
        before: ContactState,
    ) -> tuple[_Response, np.ndarray]:  # fmt: skip
        found = self.respond(u, gaps, before)
        residual = K @ u - f - self.B_n.T @ (self.weights * found.pressure)
        for B, t in zip(self.B_t, found.friction.T):
            residual += B.T @ (self.weights * t)
        return found, residual

    def _scale(self, found: _Response, f: np.ndarray) -> float:
        pressed = np.linalg.norm(self.B_n.T @ (self.weights * found.pressure))
        return float(max(pressed, np.linalg.norm(f), 1e-30))

    def _newton(self, K: sp.csr_matrix, found: _Response, residual: np.ndarray) -> np.ndarray:
        """The step of Newton's method."""
        symmetric, push = self._tangent(K, found)
        slides = (found.onward != 0.0).any()

        def whole(x: np.ndarray) -> np.ndarray:
            out = symmetric @ x
            if slides:  # friction follows the pressure, which falls with the gap
                less = push * (self.B_n @ x)
                for B, way in zip(self.B_t, found.onward.T):
                    out = out - B.T @ (way * less)
            return np.asarray(out)

        operator = LinearOperator(symmetric.shape, matvec=whole)
        for fresh in (False, True):
            if fresh or self._factor is None:
                self._factor = linear_solver(symmetric, kind=_kind())
            count = _ENOUGH if fresh else _FEW
            inverse = LinearOperator(symmetric.shape, matvec=self._factor.solve)
            answer, left = gmres(
                operator, -residual, M=inverse, rtol=_CLOSE, restart=count, maxiter=1
            )
            if not left:
                break
        return np.asarray(answer)

    def _tangent(self, K: sp.csr_matrix, found: _Response) -> tuple[sp.csr_matrix, np.ndarray]:
        """The symmetric part, and slopes (q,) of the forces of pressure in the overlap."""
        push = self.penalty * self.weights * found.closed
        drag = self.penalty * self.weights[:, None, None] * found.slope
        drag = drag * found.closed[:, None, None]
        total = K + self.B_n.T @ sp.diags(push) @ self.B_n
        for i, B in enumerate(self.B_t):
            for j, C in enumerate(self.B_t):
                total = total + B.T @ sp.diags(drag[:, i, j]) @ C
        return total.tocsr(), push

    def resultants(self, state: ContactState, about: np.ndarray) -> dict[str, np.ndarray]:
        """Force [N] and moment [N m] about a point (6,) on the second body of every pair."""
        traction = state.pressure[:, None] * self.normals
        traction = traction - np.einsum("qk,qka->qa", state.friction, self.axes)
        force = self.weights[:, None] * traction
        moment = np.cross(self.places - about, force)
        both = np.concatenate([force, moment], axis=1)
        return {name: both[part].sum(axis=0) for name, part in self.part.items()}


def _kind() -> str:
    """The fastest solver installed: factors are many and large, solutions few."""
    return available_kinds()[0]


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
