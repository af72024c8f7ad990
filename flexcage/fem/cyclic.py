"""Elastic modes of a ring of equal sectors, one sector at a time for every harmonic.

A mode of such a ring is u_k = Re or Im of R_k x exp(i n k a) in sector k, a = 2 pi/Z, R_k its turn,
n = 0 to Z/2: so x, on the nodes of one sector, is an eigenvector of a small Hermitian problem
(D. L. Thomas, Int. J. Numer. Methods Eng. 14 (1979) 81). With the inside of a sector eliminated
(``condensed``), harmonics differ by the stiffness of one cut only.
"""

from __future__ import annotations

import logging
from collections.abc import Callable

import numpy as np
import scipy.sparse as sp
from scipy.linalg import cho_factor, cho_solve

from flexcage.fem.condensed import CondensedRing, dofs_of
from flexcage.fem.lanczos import lowest_modes
from flexcage.fem.model import FEModel

log = logging.getLogger(__name__)

_MORE = 3  # modes by which a harmonic is searched further, at least


def cyclic_modes(model: FEModel, ring: CondensedRing, count: int) -> tuple[np.ndarray, np.ndarray]:
    """The lowest elastic modes, ``count`` or more: (omega^2 (n,), shapes (3N, n)), ascending.

    Every harmonic is searched until it has a mode above the last one counted, so none is missed.
    """
    harmonics = [Harmonic(model, ring, n) for n in range(ring.parts.sectors.count // 2 + 1)]
    wanted = [max(_MORE, count // len(harmonics))] * len(harmonics)
    found = [_modes(h, w) for h, w in zip(harmonics, wanted)]
    while True:
        values = np.concatenate([np.repeat(v, h.copies) for h, (v, _) in zip(harmonics, found)])
        last = np.sort(values)[:count][-1]
        short = [i for i, (v, _) in enumerate(found) if v[-1] <= last]
        if not short:
            break
        for i in short:
            wanted[i] += max(_MORE, wanted[i] // 2)
            found[i] = _modes(harmonics[i], wanted[i])
    log.info("%d modes among %d of %d harmonics", count, sum(wanted), len(harmonics))
    shapes = [h.shapes(x[:, v <= last]) for h, (v, x) in zip(harmonics, found)]
    low = np.concatenate([np.tile(v[v <= last], h.copies) for h, (v, _) in zip(harmonics, found)])
    order = np.argsort(low, kind="stable")
    return low[order], np.hstack(shapes)[:, order]


class Harmonic:
    """The nodes of one part of a cyclic ring, moving as harmonic n of the whole.

    Fields (3n, m) are of the part's inside, then of its first cut; complex but for n = 0 and Z/2.
    """

    def __init__(self, model: FEModel, ring: CondensedRing, order: int) -> None:
        parts, self._kind = ring.parts, ring.kinds[0]
        count = parts.sectors.count
        self._model, self._parts, self.order = model, parts, order
        self.copies = 1 if 2 * order in (0, count) else 2  # modes of the ring from one x
        self.dtype = float if self.copies == 1 else complex
        own, following = (np.concatenate([parts.inside[k], parts.cuts[k]]) for k in (0, 1))
        self.n_dof, self._n_inside = 3 * len(own), 3 * parts.inside.shape[1]
        self._turn = self._phase(1) * parts.sectors.turn(1)
        mass = model.mass_scalar[own]
        across = sp.kron(mass[:, following], self._turn)
        self._mass = sp.csr_matrix(
            sp.kron(mass[:, own], np.eye(3)) + across + across.conj().T, dtype=self.dtype
        )
        self._rigid = self._rigid_motions(own)
        self._cut_factor = cho_factor(self._cut_stiffness())

    def _phase(self, sectors: int) -> complex | float:
        phase = np.exp(2j * np.pi * self.order * sectors / self._parts.sectors.count)
        return phase if self.copies == 2 else float(np.round(phase.real))

    def mass_times(self, fields: np.ndarray) -> np.ndarray:
        return self._mass @ fields

    def _rigid_motions(self, own: np.ndarray) -> np.ndarray:
        """Mass-orthonormal rigid motions (3n, 0 or 2) among the fields of this harmonic."""
        axes = {0: np.array([1.0, 0.0, 0.0]), 1: np.array([0.0, 1.0, 1.0j])}
        if self.order not in axes:
            return np.zeros((self.n_dof, 0))
        axis = axes[self.order]
        nodes = self._model.nodes[own]
        motions = [np.broadcast_to(axis, nodes.shape).ravel(), np.cross(axis, nodes).ravel()]
        rigid = np.stack(motions, axis=1)
        lower = np.linalg.cholesky(rigid.conj().T @ self.mass_times(rigid))
        return rigid @ np.linalg.inv(lower).conj().T

    def _cut_stiffness(self) -> np.ndarray:
        """Hermitian stiffness of the cut (3 n_cut, 3 n_cut); rigid motion made stiff."""
        stiffness, (cut, following) = self._model.K, self._parts.cuts[:2]
        rows = stiffness[dofs_of(cut)]
        own = rows[:, dofs_of(cut)].toarray()
        across = self._spread(rows[:, dofs_of(following)].toarray().T).T
        condensed = self._both_ends(self._both_ends(self._kind.condensed).conj().T)
        total = own + across + across.conj().T - condensed
        rigid = np.linalg.qr(self._rigid[self._n_inside :])[0]
        return total + np.abs(np.diag(own)).mean() * (rigid @ rigid.conj().T)

    def _spread(self, fields: np.ndarray) -> np.ndarray:
        """The transpose of turning on by a sector: fields (3n, m) at the next cut."""
        nodal = fields.reshape(-1, 3, fields.shape[1])
        return np.einsum("ab,nam->nbm", self._turn, nodal).reshape(fields.shape)

    def _both_ends(self, pulls: np.ndarray) -> np.ndarray:
        """Forces (6 n_cut, m) on both cuts of a part, all brought to the first."""
        first, second = np.split(pulls, 2)
        nodal = second.reshape(-1, 3, second.shape[1])
        return first + np.einsum("ba,nbm->nam", self._turn.conj(), nodal).reshape(first.shape)

    def flexibility(self, loads: np.ndarray) -> np.ndarray:
        """Inertia-relieved displacements (3n, m) of loads (3n, m)."""
        loads = loads - self.mass_times(self._rigid) @ (self._rigid.conj().T @ loads)
        inside, cut = np.split(loads, [self._n_inside])
        coupling = self._kind.coupling
        pulls = self._really(lambda columns: coupling.T @ columns, inside)
        moved = cho_solve(self._cut_factor, cut - self._both_ends(pulls))
        nodal = moved.reshape(-1, 3, moved.shape[1])
        ahead = np.einsum("ab,nbm->nam", self._turn, nodal).reshape(moved.shape)
        inside = inside - self._kind.across @ np.vstack([moved, ahead])
        answer = np.vstack([self._really(self._kind.solver.solve, inside), moved])
        return answer - self._rigid @ (self._rigid.conj().T @ self.mass_times(answer))

    def _really(
        self, operate: Callable[[np.ndarray], np.ndarray], fields: np.ndarray
    ) -> np.ndarray:
        """What a real operator makes of fields (n, m): real and imaginary parts as its columns."""
        columns = np.ascontiguousarray(fields, self.dtype).view(float)
        return np.ascontiguousarray(operate(columns)).view(self.dtype)

    def shapes(self, fields: np.ndarray) -> np.ndarray:
        """Mass-orthonormal shapes of the ring (3N, m or 2 m) from orthonormal fields (3n, m)."""
        parts, m = self._parts, fields.shape[1]
        count = parts.sectors.count
        whole = np.empty((len(self._model.nodes), 3, m), self.dtype)
        nodal = fields.reshape(len(fields) // 3, 3, m)
        for k in range(count):
            own = np.concatenate([parts.inside[k], parts.cuts[k]])
            whole[own] = np.einsum("ab,nbm->nam", self._phase(k) * parts.sectors.turn(k), nodal)
        whole = whole.reshape(self._model.n_dof, m) * np.sqrt(self.copies / count)
        return whole if self.copies == 1 else np.hstack([whole.real, whole.imag])


def _modes(harmonic: Harmonic, count: int) -> tuple[np.ndarray, np.ndarray]:
    return lowest_modes(harmonic, harmonic.flexibility, count, block=2, dtype=harmonic.dtype)
