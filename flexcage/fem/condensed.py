"""Static solutions of a ring cut into parts, of which those that are alike are factored once.

The ring is cut through the middle of every pocket, where it is thinnest, into parts of one
crossbeam each. With the interiors of all parts eliminated, the stiffness of the nodes on the cuts,

    S = K_cc - sum_p K_cp K_pp^-1 K_pc,

is small and couples neighbouring cuts only. Parts that differ by a turn share K_pp^-1 and
G = K_pp^-1 K_pc, so that a damaged cage costs a factorisation for every kind of part and one of S,
and a load an interior solution only in those parts where it acts. The elimination is exact (static
condensation, R. J. Guyan, AIAA Journal 3 (1965) 380; as substructuring, J. S. Przemieniecki, ibid.
1 (1963) 138).
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp

from flexcage.fem.linear import LinearSolver, linear_solver
from flexcage.fem.model import FEModel
from flexcage.fem.sectors import Sectors, group_alike

_ALIKE = 1e-11  # misfit of stiffness acting on a turned random field, relative to its action


@dataclass(frozen=True)
class RingParts:
    """Nodes of a ring cut into parts: cut k lies between parts k - 1 and k."""

    sectors: Sectors
    inside: np.ndarray  # (count, n_inside)
    cuts: np.ndarray  # (count, n_cut)


def find_parts(model: FEModel) -> RingParts | None:
    """The parts between mid-pockets of a ring of sectors, or None if the model is no such ring."""
    sectors = model.sectors
    if sectors is None:
        return None
    n = sectors.cells
    middle = model.points[model.tets[: 2 * n]].mean(axis=1)
    upper = np.arctan2(middle[:n, 2], middle[:n, 1]) > 0.0  # of sector 0, around psi = 0
    following = model.cells[n : 2 * n]
    own = np.unique(np.concatenate([model.cells[:n][upper].ravel(), following[~upper].ravel()]))
    places = sectors.followed(own)
    shared = np.isin(own, places[-1]), np.isin(places[0], places[1])
    cuts = sectors.followed(own[shared[0]])
    inside = places[:, ~(shared[0] | shared[1])]
    numbers = np.concatenate([inside.ravel(), cuts.ravel()])
    if (shared[0] & shared[1]).any() or len(np.unique(numbers)) != len(model.nodes):
        return None
    if len(numbers) != len(model.nodes) or not len(inside[0]) or not len(cuts[0]):
        return None
    return RingParts(sectors, inside, cuts)


@dataclass(frozen=True)
class Kind:
    """Parts that differ by a turn; matrices are those of the first of them."""

    members: list[int]
    solver: LinearSolver  # of K_pp
    across: sp.csr_matrix  # K_pc (3 n_inside, 6 n_cut): cut k, then cut k + 1
    coupling: np.ndarray  # G = K_pp^-1 K_pc (3 n_inside, 6 n_cut)
    condensed: np.ndarray  # K_cp G (6 n_cut, 6 n_cut)


class CondensedRing:
    """The factored stiffness of a ring held at six dofs on its cuts.

    ``held`` are dofs of nodes on cuts that keep the body from rigid motion.
    """

    def __init__(
        self, model: FEModel, parts: RingParts, held: np.ndarray, *, kind: str = "auto"
    ) -> None:
        self.parts, self._count = parts, parts.sectors.count
        alike = [group_alike(action, _ALIKE) for action in _actions(model, parts)]
        self.kinds = [self._condense(model, members, kind) for members in alike[0]]
        self.is_cyclic = len(alike[0]) == len(alike[1]) == 1  # all sectors differ by turns only
        self._cut_dofs = dofs_of(parts.cuts.ravel())
        free = np.flatnonzero(~np.isin(self._cut_dofs, held))
        stiffness = self._cut_stiffness(model)[free][:, free]
        self._free = free
        self._cut_solver = linear_solver(sp.csr_matrix(stiffness), kind=kind)
        different = "1 kind" if len(self.kinds) == 1 else f"{len(self.kinds)} kinds"
        self.name = f"{self._cut_solver.name}, {self._count} parts of {different}"

    def solve(self, loads: np.ndarray) -> np.ndarray:
        """Displacements (3N, m) of nodal loads (3N, m); reactions at the held dofs are free."""
        m = loads.size // len(loads)
        fields = np.ascontiguousarray(loads.T, float).reshape(m, -1, 3)
        answer = np.empty_like(fields)
        on_cuts = fields[:, self.parts.cuts]  # (m, count, n_cut, 3)
        inside = [self._gather(kind, fields) for kind in self.kinds]
        for kind, (acting, forces) in zip(self.kinds, inside):
            pulls = np.zeros((len(acting), kind.coupling.shape[1]))
            pulls[acting] = forces @ kind.coupling
            nodal = pulls.reshape(m, len(kind.members), -1, 3)
            first, second = np.split(self._turned(kind, nodal), 2, axis=2)
            on_cuts[:, kind.members] -= first
            on_cuts[:, (np.array(kind.members) + 1) % self._count] -= second
        cuts = np.zeros((m, on_cuts[0].size))
        cuts[:, self._free] = self._cut_solver.solve(on_cuts.reshape(m, -1)[:, self._free].T).T
        answer[:, self.parts.cuts] = cuts = cuts.reshape(on_cuts.shape)
        both = np.concatenate([cuts, np.roll(cuts, -1, axis=1)], axis=2)
        for kind, (acting, forces) in zip(self.kinds, inside):
            ends = self._turned(kind, both[:, kind.members], back=True).reshape(len(acting), -1)
            moved = np.empty((len(acting), len(kind.coupling)))
            moved[~acting] = -ends[~acting] @ kind.coupling.T
            if acting.any():
                forces = forces - (kind.across @ ends[acting].T).T
                moved[acting] = kind.solver.solve(forces.T).T
            nodal = moved.reshape(m, len(kind.members), -1, 3)
            answer[:, self.parts.inside[kind.members]] = self._turned(kind, nodal)
        return np.ascontiguousarray(answer.reshape(m, -1).T).reshape(loads.shape)

    def _gather(self, kind: Kind, fields: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Which loads act inside a part of a kind (m members,), and these (n, 3 n_inside) turned to
        its first member."""
        loads = fields[:, self.parts.inside[kind.members]]
        acting: np.ndarray = np.any(loads, axis=(2, 3))
        turns = np.broadcast_to(self._turns(kind), (*acting.shape, 3, 3))
        forces = loads[acting] @ turns[acting]
        return acting.ravel(), forces.reshape(len(forces), len(kind.coupling))

    def _turned(self, kind: Kind, fields: np.ndarray, *, back: bool = False) -> np.ndarray:
        """Fields (m, members, n, 3) turned from the first member to each, or back."""
        turns = self._turns(kind)
        return fields @ (turns if back else turns.transpose(0, 2, 1))

    def _turns(self, kind: Kind) -> np.ndarray:
        """Rotations (members, 3, 3) from the first member of a kind to each."""
        return np.stack([self.parts.sectors.turn(k - kind.members[0]) for k in kind.members])

    def _condense(self, model: FEModel, members: list[int], kind: str) -> Kind:
        first = members[0]
        inside = dofs_of(self.parts.inside[first])
        ends = dofs_of(self._ends[first])
        rows = model.K[inside]
        solver = linear_solver(sp.csr_matrix(rows[:, inside]), kind=kind)
        across = sp.csr_matrix(rows[:, ends])
        coupling = np.asarray(solver.solve(across.toarray(order="F")))
        return Kind(members, solver, across, coupling, np.asarray(across.T @ coupling))

    @cached_property
    def _ends(self) -> np.ndarray:
        """Nodes of the cuts at both ends of every part (count, 2 n_cut)."""
        cuts = self.parts.cuts
        return np.concatenate([cuts, np.roll(cuts, -1, axis=0)], axis=1)

    def _cut_stiffness(self, model: FEModel) -> sp.csr_matrix:
        """S with all its dofs, numbered cut by cut."""
        size = len(self._cut_dofs)
        number = np.empty(model.n_dof, np.int32)
        number[self._cut_dofs] = np.arange(size)
        rows, columns, values = [], [], []
        for kind in self.kinds:
            for k in kind.members:
                turn = self.parts.sectors.turn(k - kind.members[0])
                n = len(kind.condensed) // 3
                blocks = kind.condensed.reshape(n, 3, n, 3)
                turned = np.einsum("ab,ibjd,cd->iajc", turn, blocks, turn, optimize=True)
                own = number[dofs_of(self._ends[k])]
                rows.append(np.repeat(own, len(own)))
                columns.append(np.tile(own, len(own)))
                values.append(turned.ravel())
        pairs = np.concatenate(rows), np.concatenate(columns)
        taken = sp.coo_matrix((np.concatenate(values), pairs), (size, size)).tocsr()
        return sp.csr_matrix(model.K[self._cut_dofs][:, self._cut_dofs] - taken)


def dofs_of(nodes: np.ndarray) -> np.ndarray:
    """Unknowns (3 n,) of nodes (n,)."""
    return (3 * nodes[:, None] + np.arange(3)).ravel()


def _actions(model: FEModel, parts: RingParts) -> list[np.ndarray]:
    """What stiffness and mass make of a random field that repeats, on the inside of every part
    (count, 2 n, 3) and on every cut: turned back, and relative to the largest."""
    turns = np.stack([parts.sectors.turn(k) for k in range(parts.sectors.count)])
    rng = np.random.default_rng(0)
    field = np.empty((len(model.nodes), 3))
    for nodes in (parts.inside, parts.cuts):
        field[nodes] = rng.standard_normal((nodes.shape[1], 3)) @ turns.transpose(0, 2, 1)
    forces = [model.K @ field.ravel(), model.mass_times(field.ravel())]
    nodal = [force.reshape(-1, 3) / np.abs(force).max() for force in forces]
    return [
        np.concatenate([force[nodes] @ turns for force in nodal], axis=1)
        for nodes in (parts.inside, parts.cuts)
    ]
