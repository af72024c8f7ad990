"""Answers of the full mesh, without modes: compliance at stations, a pinched roller, an impact.

Only the mesh's K and M, the stations' averaging weights and the numbers (K, n) of the normal law
are taken from the program; equilibrium and time integration are written here again.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from flexcage.fem.linear import linear_solver
from flexcage.modes.reduction import CageReduction

NORMAL = (2, 2, 0, 0)  # component (x, r, psi) along the normal of faces 0 to 3
OUTWARD = (1.0, -1.0, 1.0, -1.0)


def station_rows(cage: CageReduction, pocket: int, face: int) -> np.ndarray:
    """Outward displacement (n_st, 3N) of a face's stations as rows on nodal displacements.

    Their transpose spreads an outward force at a station to the nodes.
    """
    n_st = cage.interface.stations.shape[1]
    first = (4 * pocket + face) * n_st
    weights = cage.interface.weights[first : first + n_st].toarray()
    angle = 2.0 * np.pi * pocket / cage.interface.modes.shape[0]
    axes = {0: [1.0, 0.0, 0.0], 2: [0.0, -np.sin(angle), np.cos(angle)]}
    normal = OUTWARD[face] * np.array(axes[NORMAL[face]])
    return np.einsum("sn,c->snc", weights, normal).reshape(n_st, -1)


def reduced_compliance(cage: CageReduction, pocket: int, faces, *, cut: bool = True) -> np.ndarray:
    """Outward displacements of the faces' stations per newton there, in the reduced cage."""
    face_of = cage.interface
    modes = np.concatenate([OUTWARD[f] * face_of.modes[pocket, f, :, NORMAL[f]] for f in faces])
    dynamic = modes @ np.linalg.solve(cage.basis.stiffness, modes.T)
    if cut:
        own = np.concatenate([face_of.residual[pocket, f] for f in faces])
        return dynamic + own @ face_of.compliance[pocket] @ own.T
    vectors = cage.basis.residual.shapes.reshape(cage.model.n_dof, -1)
    rows = np.concatenate([station_rows(cage, pocket, f) for f in faces]) @ vectors
    return dynamic + rows @ np.linalg.solve(cage.basis.residual.stiffness, rows.T)


@dataclass(frozen=True)
class Squeeze:
    """A rigid roller between two opposite faces: where it could touch, and by which law.

    ``depth`` (2, n): penetration of the n slices (or points) of each face with the roller in the
    middle; ``spread`` (2, n, n_st): their weights on the stations; ``law`` (2, 2): K and exponent.
    """

    depth: np.ndarray
    spread: np.ndarray
    law: np.ndarray

    def solve(self, compliance: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Forces of the two faces (2,) and at their stations (2 n_st,), by Newton's method.

        Unknown are the station forces and the roller's place; interference grows in steps.
        """
        n, n_st = self.spread.shape[1:]
        spread = np.zeros((2 * n, 2 * n_st))
        spread[:n, :n_st], spread[n:, n_st:] = self.spread
        depth, side = self.depth.ravel(), np.repeat([1.0, -1.0], n)
        K, exponent = np.repeat(self.law, n, axis=0).T
        interference = self.depth.max(axis=1).mean()
        x, scale = np.zeros(2 * n_st + 1), 1e-6
        for missing in np.linspace(0.95, 0.0, 40):
            for _ in range(200):
                d = depth - missing * interference + scale * side * x[-1]
                d = d - spread @ (compliance @ x[:-1])
                pressed = np.maximum(d, 0.0)
                force = K * pressed**exponent
                slope = np.where(
                    d > 0, K * exponent * np.maximum(pressed, 1e-12) ** (exponent - 1), 0
                )
                r = np.append(spread.T @ force - x[:-1], side @ force)
                rate = np.column_stack([-spread @ compliance, scale * side])
                J = np.vstack([(spread.T * slope) @ rate, (side * slope) @ rate])
                J[:-1, :-1] -= np.eye(2 * n_st)
                x = x - np.linalg.lstsq(J, r, rcond=None)[0]
                if np.abs(r).max() < 1e-9 * max(np.abs(x[:-1]).max(), 1.0):
                    break
        assert np.abs(r).max() < 1e-6 * np.abs(x[:-1]).max()
        return force.reshape(2, n).sum(axis=1), x[:-1]


class Impact:
    """A point mass that strikes stations of a free cage at rest: Newmark, average acceleration.

    ``rows`` (n_st, 3N) of ``station_rows``; ``spread`` (n, n_st), ``drop`` (n,) and ``law`` (K, n)
    of the slices; all unknowns of the mesh take part.
    """

    def __init__(self, cage: CageReduction, rows, spread, drop, law, mass: float, step: float):
        model = cage.model
        self.mass_matrix = sp.kron(model.mass_scalar, sp.identity(3), format="csr")
        self.rows, self.spread, self.drop, self.law = rows, spread, drop, law
        self.mass, self.h = mass, step
        self.solver = linear_solver(sp.csr_matrix(model.K + 4.0 / step**2 * self.mass_matrix))
        self.answer = self.solver.solve(np.ascontiguousarray(rows.T))
        self.compliance = rows @ self.answer

    def run(self, speed: float, duration: float) -> tuple[np.ndarray, np.ndarray]:
        """Times and contact forces from the first touch."""
        h, n = self.h, round(duration / self.h)
        u, v, a = (np.zeros(self.mass_matrix.shape[0]) for _ in range(3))
        x, xd, xdd, f = 0.0, speed, 0.0, np.zeros(len(self.rows))
        history = np.zeros(n + 1)
        for k in range(n):
            moved = self.solver.solve(self.mass_matrix @ (4.0 / h**2 * u + 4.0 / h * v + a))
            x_free = x + h * xd + 0.25 * h * h * xdd
            f = self._contact(f, x_free, self.rows @ moved)
            acceleration = -f.sum() / self.mass
            x = x_free + 0.25 * h * h * acceleration
            xd, xdd = xd + 0.5 * h * (xdd + acceleration), acceleration
            new = moved + self.answer @ f
            rate = 4.0 / h**2 * (new - u) - 4.0 / h * v - a
            v, u, a = v + 0.5 * h * (a + rate), new, rate
            history[k + 1] = f.sum()
        return h * np.arange(n + 1), history

    def _contact(self, f: np.ndarray, x_free: float, wall: np.ndarray) -> np.ndarray:
        """Station forces at the end of a step."""
        K, exponent = self.law
        give = self.spread @ self.compliance + 0.25 * self.h**2 / self.mass
        for _ in range(60):
            d = x_free - self.drop - self.spread @ wall - give @ f
            pressed = np.maximum(d, 0.0)
            slope = np.where(d > 0, K * exponent * np.maximum(pressed, 1e-15) ** (exponent - 1), 0)
            r = f - self.spread.T @ (K * pressed**exponent)
            step = np.linalg.solve(np.eye(len(f)) + (self.spread.T * slope) @ give, r)
            f = f - step
            if np.abs(step).max() < 1e-9 * max(1.0, np.abs(f).max()):
                return f
        raise AssertionError("the contact of a Newmark step did not converge")
