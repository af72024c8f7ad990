"""Static solutions of a ring cut into parts, of which those that are alike are factored once.

The ring is cut through the middle of every pocket, where it is thinnest, into parts of one
crossbeam each. With the interiors of all parts eliminated, the stiffness of the nodes on the cuts,

    S = K_cc - sum_p K_cp K_pp^-1 K_pc,

is small and couples neighbouring cuts only. In the frames of their sectors, parts that differ by a
turn have the same matrices, so that a damaged cage costs an elimination for every kind of part and
one of S, and a load is condensed only in those parts where it acts. Where a crack doubled nodes,
the copies are added to their part. It is exact (static condensation, R. J. Guyan, AIAA Journal 3
(1965) 380; as substructuring, J. S. Przemieniecki, ibid. 1 (1963) 138).
"""

from __future__ import annotations

import logging
import time
from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp

from flexcage.fem.dissection import dissect
from flexcage.fem.fronts import Contribution, Elimination
from flexcage.fem.linear import check_factor
from flexcage.fem.model import FEModel
from flexcage.fem.sectors import Sectors, group_alike

log = logging.getLogger(__name__)

_ALIKE = 1e-11  # misfit of stiffness acting on a turned random field, relative to its action


@dataclass(frozen=True)
class RingParts:
    """Nodes of a ring cut into parts: cut k lies between parts k - 1 and k."""

    sectors: Sectors
    inside: tuple[np.ndarray, ...]  # of every part, in order of elimination
    blocks: tuple[tuple[int, ...], ...]  # how many of them are eliminated together
    cuts: np.ndarray  # (count, n_cut)


def find_parts(model: FEModel) -> RingParts | None:
    """The parts between mid-pockets of a ring of sectors, or None if the model is no such ring."""
    sectors = model.sectors
    if sectors is None:
        return None
    own, following = sectors.cells[:2]
    middle = model.points[model.tets[own]].mean(axis=1)
    upper = np.arctan2(middle[:, 2], middle[:, 1]) > 0.0  # of sector 0, around psi = 0
    part = np.concatenate([own[upper], following[~upper]])
    cells = sectors.place[model.cells[part]]
    places = sectors.followed(np.unique(cells))
    shared = np.isin(places[0], places[-1]), np.isin(places[0], places[1])
    cuts = places[:, shared[0]]
    inside = places[:, ~(shared[0] | shared[1])]
    numbers = np.concatenate([inside.ravel(), cuts.ravel()])
    counted = len(model.nodes) - len(sectors.doubled)
    if (shared[0] & shared[1]).any() or len(np.unique(numbers)) != counted:
        return None
    if len(numbers) != counted or not len(inside[0]) or not len(cuts[0]):
        return None
    if np.isin(sectors.place[sectors.doubled], cuts).any():
        return None
    blocks = dissect(model.points[model.tets[part]].mean(axis=1), cells, inside[0])
    order = np.concatenate(blocks)
    sizes = np.array([len(block) for block in blocks])
    parts, sizes_of = zip(*(_with_doubles(own[order], sizes, sectors) for own in inside))
    return RingParts(sectors, parts, sizes_of, cuts)


def _with_doubles(
    nodes: np.ndarray, sizes: np.ndarray, sectors: Sectors
) -> tuple[np.ndarray, tuple[int, ...]]:
    """Nodes of a part in blocks of these sizes, each with its copies behind it."""
    more = sectors.doubled[np.isin(sectors.place[sectors.doubled], nodes)]
    if not len(more):
        return nodes, tuple(sizes)
    rising = np.argsort(nodes)
    at = rising[np.searchsorted(nodes[rising], sectors.place[more])]
    order = np.argsort(np.append(np.arange(len(nodes)), at), kind="stable")
    block = np.repeat(np.arange(len(sizes)), sizes)
    sizes = sizes + np.bincount(block[at], minlength=len(sizes))
    return np.append(nodes, more)[order], tuple(sizes)


@dataclass(frozen=True)
class Kind:
    """Parts that differ by a turn; their unknowns are those inside, of cut k, and of cut k + 1,
    each in its sector's frame."""

    members: np.ndarray
    inside: np.ndarray  # (members, n_inside) their nodes
    elimination: Elimination  # of what is inside


class CondensedRing:
    """The factored stiffness of a ring held at six dofs on its cuts, which keep it from rigid
    motion: components ``along`` (6,) of places (6, 2), cuts and nodes on them, in sectors' frames.
    """

    def __init__(
        self, model: FEModel, parts: RingParts, places: np.ndarray, along: np.ndarray
    ) -> None:
        started = time.perf_counter()
        self.parts, self._count = parts, parts.sectors.count
        alike = [group_alike(action, _ALIKE) for action in _actions(model, parts)]
        self.kinds = [_condense(model, parts, members) for members in alike[0]]
        self.is_cyclic = len(alike[0]) == len(alike[1]) == 1  # all sectors differ by turns only
        held = 3 * np.ravel_multi_index(tuple(places.T), parts.cuts.shape) + along
        self._cut_order = np.append(np.setdiff1d(np.arange(3 * parts.cuts.size), held), held)
        self._cuts = self._eliminate_cuts(model, held)
        different = "1 kind" if len(self.kinds) == 1 else f"{len(self.kinds)} kinds"
        self.name = f"dense fronts, {self._count} parts of {different}"
        check_factor(self.solve, model.K, dofs_of(parts.cuts[tuple(places.T)]))
        seconds = time.perf_counter() - started
        log.debug("factored %d unknowns with %s in %.1f s", model.n_dof, self.name, seconds)

    def solve(self, loads: np.ndarray) -> np.ndarray:
        """Displacements (3N, m) of nodal loads (3N, m); reactions at the held dofs are free."""
        columns = np.ascontiguousarray(loads, float).reshape(len(loads), -1)
        everywhere = np.arange(self._count)
        cuts = self._local(columns, self.parts.cuts, everywhere)  # (3 n_cut, count, m)
        touched = np.any(columns.reshape(len(loads) // 3, -1), axis=1)
        acting = np.array([touched[own].any() for own in self.parts.inside])
        condensed = [self._condensed(kind, acting, columns, cuts) for kind in self.kinds]
        moved = self._solve_cuts(cuts)
        answer = np.empty_like(columns)
        for kind, inside in zip(self.kinds, condensed):
            order = np.argsort(~acting[kind.members], kind="stable")  # the loaded ones first
            members = kind.members[order]
            fields = np.empty((kind.elimination.size, len(members) * columns.shape[1]))
            fields[: len(inside), : inside.shape[1]] = inside
            fields[: len(inside), inside.shape[1] :] = 0.0
            ends = np.stack([moved[:, members], moved[:, (members + 1) % self._count]])
            fields[len(inside) :] = ends.reshape(-1, fields.shape[1])
            kind.elimination.expand(fields, inside.shape[1])
            self._store(answer, kind.inside[order], members, fields[: len(inside)])
        self._store(answer, self.parts.cuts, everywhere, moved)
        return answer.reshape(loads.shape)

    def _condensed(
        self, kind: Kind, acting: np.ndarray, loads: np.ndarray, cuts: np.ndarray
    ) -> np.ndarray:
        """The condensed loads inside the loaded parts of a kind, of all ``acting`` (count,):
        (3 n_inside, parts m); what these do to the ``cuts`` (3 n_cut, count, m) is added there."""
        loaded = kind.members[acting[kind.members]]
        n = kind.elimination.eliminated
        fields = np.zeros((kind.elimination.size, len(loaded) * loads.shape[1]))
        own = self._local(loads, kind.inside[acting[kind.members]], loaded)
        fields[:n] = own.reshape(n, fields.shape[1])
        kind.elimination.condense(fields)
        first, second = fields[n:].reshape(2, *cuts[:, loaded].shape)
        cuts[:, loaded] += first
        cuts[:, (loaded + 1) % self._count] += second
        return fields[:n]

    def _solve_cuts(self, cuts: np.ndarray) -> np.ndarray:
        """Displacements of the cuts (3 n_cut, count, m) under loads there."""
        by_cut = cuts.transpose(1, 0, 2)
        fields = by_cut.reshape(len(self._cut_order), -1)[self._cut_order]
        self._cuts.condense(fields)
        fields[self._cuts.eliminated :] = 0.0
        self._cuts.expand(fields)
        moved = np.empty_like(fields)
        moved[self._cut_order] = fields
        return np.ascontiguousarray(moved.reshape(by_cut.shape).transpose(1, 0, 2))

    def _local(self, fields: np.ndarray, places: np.ndarray, sectors: np.ndarray) -> np.ndarray:
        """What fields (3N, m) are at the nodes ``places`` (k, n) of k sectors, in the frames of
        these: (3 n, k, m)."""
        taken = fields.take(_by_sector(places), axis=0)
        self._turn(taken, sectors, back=True)
        return taken

    def _store(
        self, fields: np.ndarray, places: np.ndarray, sectors: np.ndarray, local: np.ndarray
    ) -> None:
        """The way back of ``_local``, into ``fields``; overwrites ``local``."""
        local = local.reshape(-1, len(sectors), fields.shape[1])
        self._turn(local, sectors)
        fields[_by_sector(places)] = local

    def _turn(self, local: np.ndarray, sectors: np.ndarray, *, back: bool = False) -> None:
        """Turn fields (3 n, k, m) from the frames of k sectors into the ring's, or back."""
        turns = self.parts.sectors.turns[sectors].repeat(local.shape[2], axis=0)
        cosine, sine = turns[:, 1, 1], -turns[:, 2, 1] if back else turns[:, 2, 1]
        flat = local.reshape(len(local) // 3, 3, len(turns))  # long rows are fast
        y, z = flat[:, 1], flat[:, 2]
        across = sine * y
        y *= cosine
        y -= sine * z
        z *= cosine
        z += across

    def _eliminate_cuts(self, model: FEModel, held: np.ndarray) -> Elimination:
        """S cut by cut; what is left are the held dofs."""
        n_cut = 3 * self.parts.cuts.shape[1]
        number = np.argsort(self._cut_order)
        cuts = self.parts.cuts.ravel()
        turns = np.repeat(self.parts.sectors.turns, self.parts.cuts.shape[1], axis=0)
        stiffness = local_stiffness(model, (cuts, turns), (cuts, turns))
        more: list[Contribution] = []
        for kind in self.kinds:
            schur = kind.elimination.schur
            for k in kind.members:
                following = (k + 1) % self._count
                ends = np.concatenate(
                    [np.arange(c * n_cut, (c + 1) * n_cut) for c in (k, following)]
                )
                rising = np.argsort(number[ends])
                more.append((number[ends][rising], schur[np.ix_(rising, rising)]))
        sizes = n_cut - np.bincount(held // n_cut, minlength=self._count)
        return Elimination(stiffness[self._cut_order][:, self._cut_order], sizes, more)


def dofs_of(nodes: np.ndarray) -> np.ndarray:
    """Unknowns (3 n,) of nodes (n,)."""
    return (3 * nodes[:, None] + np.arange(3)).ravel()


def _by_sector(places: np.ndarray) -> np.ndarray:
    """Unknowns (3 n, k) of nodes (k, n)."""
    dofs = 3 * places.T[:, None, :] + np.arange(3)[:, None]
    return dofs.reshape(3 * places.shape[1], len(places))


Turned = tuple[np.ndarray, np.ndarray]  # nodes (n,) and rotations (n, 3, 3) to their frames


def local_stiffness(model: FEModel, rows: Turned, columns: Turned) -> sp.csr_matrix:
    """The stiffness (3 n, 3 m) between nodes, in the frames of their sectors."""
    taken = model.K[dofs_of(rows[0])][:, dofs_of(columns[0])].tobsr(blocksize=(3, 3))
    back = rows[1].transpose(0, 2, 1).repeat(np.diff(taken.indptr), axis=0)
    blocks = back @ taken.data @ columns[1][taken.indices]
    return sp.bsr_matrix((blocks, taken.indices, taken.indptr), shape=taken.shape).tocsr()


def _condense(model: FEModel, parts: RingParts, members: list[int]) -> Kind:
    first = members[0]
    following = (first + 1) % parts.sectors.count
    inside = parts.inside[first]
    nodes = np.concatenate([inside, parts.cuts[first], parts.cuts[following]])
    sectors = np.repeat([first, following], [len(nodes) - parts.cuts.shape[1], parts.cuts.shape[1]])
    turns = parts.sectors.turns[sectors]
    stiffness = local_stiffness(model, (inside, turns[: len(inside)]), (nodes, turns))
    eliminated = Elimination(stiffness, 3 * np.array(parts.blocks[first]))
    return Kind(np.array(members), np.stack([parts.inside[k] for k in members]), eliminated)


def _actions(model: FEModel, parts: RingParts) -> list[list[np.ndarray]]:
    """What stiffness and mass make of a random field that repeats, on the inside of every part
    (2 n, 3) and on every cut: turned back, and relative to the largest."""
    sectors, first = parts.sectors, parts.inside[0]
    nodes = sectors.followed(np.append(first[sectors.place[first] == first], parts.cuts[0]))
    values = np.random.default_rng(0).standard_normal((nodes.shape[1], 3))
    field = np.empty((len(model.nodes), 3))
    field[nodes] = values @ sectors.turns.transpose(0, 2, 1)
    field = field[sectors.place]
    forces = [model.K @ field.ravel(), model.mass_times(field.ravel())]
    nodal = [force.reshape(-1, 3) / np.abs(force).max() for force in forces]
    return [
        [np.concatenate([f[own] @ turn for f in nodal]) for own, turn in zip(part, sectors.turns)]
        for part in (parts.inside, parts.cuts)
    ]
