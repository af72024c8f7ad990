"""Elastic modes of a ring of equal sectors, one sector at a time for every harmonic.

A mode of such a ring is u_k = Re or Im of R_k x exp(i n k a) in sector k, a = 2 pi/Z, R_k its turn,
n = 0 to Z/2: so x, on the nodes of one sector, is an eigenvector of a small Hermitian problem
(D. L. Thomas, Int. J. Numer. Methods Eng. 14 (1979) 81). With the inside of a sector eliminated
(``condensed``), harmonics differ by the stiffness of one cut only.
"""

from __future__ import annotations

import logging

import numpy as np
import scipy.sparse as sp
from scipy.linalg import cho_factor, cho_solve

from flexcage.fem.condensed import CondensedRing, local_stiffness
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
    log.debug("%d modes among %d of %d harmonics", count, sum(wanted), len(harmonics))
    shapes = [h.shapes(x[:, v <= last]) for h, (v, x) in zip(harmonics, found)]
    low = np.concatenate([np.tile(v[v <= last], h.copies) for h, (v, _) in zip(harmonics, found)])
    order = np.argsort(low, kind="stable")
    return low[order], np.hstack(shapes)[:, order]


class Harmonic:
    """The nodes of one part of a cyclic ring, moving as harmonic n of the whole.

    Fields (3n, m) are of the part's inside, then of its first cut; complex but for n = 0 and Z/2.
    """

    def __init__(self, model: FEModel, ring: CondensedRing, order: int) -> None:
        parts, self._elimination = ring.parts, ring.kinds[0].elimination
        count = parts.sectors.count
        self._model, self._parts, self.order = model, parts, order
        self.copies = 1 if 2 * order in (0, count) else 2  # modes of the ring from one x
        self.dtype = float if self.copies == 1 else complex
        own, following = (np.concatenate([parts.inside[k], parts.cuts[k]]) for k in (0, 1))
        self.n_dof = 3 * len(own)
        self._ahead = self._phase(1)  # of the next sector's field, in that sector's frame
        mass = model.mass_scalar[own]
        across = sp.kron(mass[:, following], self._ahead * parts.sectors.turn(1))
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
        cuts, turns = self._parts.cuts[:2], self._parts.sectors.turns[:2]
        placed = [(cut, np.broadcast_to(turn, (len(cut), 3, 3))) for cut, turn in zip(cuts, turns)]
        own, across = (local_stiffness(self._model, placed[0], p).toarray() for p in placed)
        across = self._ahead * across
        condensed = self._both_ends(self._both_ends(self._elimination.schur).conj().T)
        total = own + across + across.conj().T + condensed
        rigid = np.linalg.qr(self._rigid[self._elimination.eliminated :])[0]
        return total + np.abs(np.diag(own)).mean() * (rigid @ rigid.conj().T)

    def _both_ends(self, pulls: np.ndarray) -> np.ndarray:
        """Forces (6 n_cut, m) on both cuts of a part, all brought to the first."""
        first, second = np.split(pulls, 2)
        return first + np.conj(self._ahead) * second

    def flexibility(self, loads: np.ndarray) -> np.ndarray:
        """Inertia-relieved displacements (3n, m) of loads (3n, m)."""
        loads = loads - self.mass_times(self._rigid) @ (self._rigid.conj().T @ loads)
        elimination, n = self._elimination, self._elimination.eliminated
        fields = np.zeros((elimination.size, loads.shape[1]), self.dtype)
        fields[:n] = loads[:n]
        columns = fields.view(float)  # real and imaginary parts: the elimination is real
        elimination.condense(columns)
        moved = cho_solve(self._cut_factor, loads[n:] + self._both_ends(fields[n:]))
        fields[n:] = np.vstack([moved, self._ahead * moved])
        elimination.expand(columns)
        answer = fields[: len(loads)]
        return answer - self._rigid @ (self._rigid.conj().T @ self.mass_times(answer))

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
