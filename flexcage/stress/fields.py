"""Stress fields of unit coordinates and unit contact forces at the surface of the mesh.

A unit force's field is what the dynamic modes miss: its inertia-relieved answer on the full mesh
less the part that the modes carry. Modes times q plus these fields times the forces is then
exactly mode acceleration, for any basis. The interface says which forces of a station have fields
of their own and which enter by their resultant, spread evenly over the face: with window cages
normal forces and friction, with round pockets all of them have their own. Fields are kept in single
precision: over the whole surface as the five deviator components of ``operators.deviator``, and as
all six stresses at chosen vertices.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cached_property, partial
from typing import Protocol

import numpy as np

from flexcage.core.threads import on_all_cores
from flexcage.fem.effort import stress_progress
from flexcage.fem.symmetry import CyclicSymmetry, find_symmetry
from flexcage.modes.pockets import pocket_frames
from flexcage.stress.midpoints import edges_across
from flexcage.stress.operators import deviator
from flexcage.stress.recovery import StressRecovery
from flexcage.stress.screening import ROUNDING, Screen

_KEPT = 48  # fields that are evaluated at once: bounds the memory of all six parts
_TOGETHER = 33  # right-hand sides of land forces that are solved at once


class Tables(Protocol):
    """Fields of unit coordinates and forces at points: columns of ``parts`` numbers for each."""

    parts: int

    @property
    def modes(self) -> np.ndarray: ...
    @property
    def forces(self) -> np.ndarray: ...
    @property
    def land_forces(self) -> np.ndarray: ...


class SomePoints:
    """The tables of some points of others, taken when first asked for."""

    def __init__(self, whole: Tables, points: np.ndarray) -> None:
        self._whole, self._points, self.parts = whole, points, whole.parts

    def _at(self, table: np.ndarray) -> np.ndarray:
        columns = table.shape[1]
        return table.reshape(self.parts, -1, columns)[:, self._points].reshape(-1, columns)

    @cached_property
    def modes(self) -> np.ndarray:
        return self._at(self._whole.modes)

    @cached_property
    def forces(self) -> np.ndarray:
        return self._at(self._whole.forces)

    @cached_property
    def land_forces(self) -> np.ndarray:
        return self._at(self._whole.land_forces)


class Operator(Protocol):
    """What displacements (N, 3, m) and the forces (Z, F, n_st, 3, m) that made them, if these
    matter, give at n points: (n, m, 6)."""

    def __call__(self, fields: np.ndarray, forces: np.ndarray | None = None, /) -> np.ndarray: ...


class UnitFields:
    """Precomputed fields: ``parts`` numbers at each point of what an operator gives."""

    parts = 6
    prefix = "tensor_"  # of the names under which they are kept

    def __init__(self, recovery: StressRecovery, operator: Operator) -> None:
        self._recovery, self._operator = recovery, operator

    def _parts(self, values: np.ndarray) -> np.ndarray:
        """What is kept (..., parts) of the operator's values (..., 6)."""
        return values

    def at(self, points: np.ndarray) -> SomePoints:
        """The fields at some of the points, by their numbers."""
        return SomePoints(self, points)

    @cached_property
    def modes(self) -> np.ndarray:
        """(parts n_points, n) per unit modal coordinate."""
        return self._mode_values.astype(np.float32)

    @cached_property
    def _mode_values(self) -> np.ndarray:
        """The same before rounding."""
        return self._values(self._recovery.basis.shapes)

    @cached_property
    def forces(self) -> np.ndarray:
        """(parts n_points, Z per_pocket) per newton of ``reduced_forces``, beyond the modes."""
        return self._kept_as("forces", self._force_fields)

    def _force_fields(self) -> np.ndarray:
        recovery = self._recovery
        per_row = recovery.pocket_count // recovery.rows
        symmetry = find_symmetry(recovery.model, per_row)
        first = self._loads(0)
        every = recovery.pocket_count * first.shape[1]
        with stress_progress(recovery.model, f"{every} forces in pockets", every) as done:
            self._mode_values  # noqa: B018  (before threads share it)
            if symmetry is None:
                recovery.solver.factor()
            else:
                starts = range(0, recovery.pocket_count, per_row)
                answers = [recovery.solver.solve(self._loads(k)) for k in starts]

            def fields(pocket: int) -> np.ndarray:
                if symmetry is None:
                    found = self._beyond_modes(self._loads(pocket), pocket=pocket)
                else:
                    found = self._turned(symmetry, answers[pocket // per_row], pocket)
                done(first.shape[1])
                return found

            return np.concatenate(on_all_cores(fields, range(recovery.pocket_count)), axis=1)

    @cached_property
    def land_forces(self) -> np.ndarray:
        """(parts n_points, 2*n_land*3) per newton at the land stations, beyond the modes."""
        return self._kept_as("land_forces", self._land_fields)

    def _kept_as(self, name: str, make: Callable[[], np.ndarray]) -> np.ndarray:
        kept = self._recovery.keep(f"{self.prefix}{name}", lambda: {"fields": make()})
        return kept["fields"]

    def _land_fields(self) -> np.ndarray:
        recovery, weights = self._recovery, self._recovery.land_weights
        n_land = weights.shape[0] // 2
        dense = weights.toarray()
        loads = [
            np.outer(dense[land * n_land + j], axis).ravel()
            for land in range(2)
            for j, frame in enumerate(pocket_frames(n_land))
            for axis in frame
        ]
        columns = np.stack(loads, axis=1)
        every = columns.shape[1]
        with stress_progress(recovery.model, f"{every} forces on lands", every) as done:
            self._mode_values  # noqa: B018  (before threads share it)
            recovery.solver.factor()

            def fields(first: int) -> np.ndarray:
                some = columns[:, first : first + _TOGETHER]
                found = self._beyond_modes(some, recovery.felt_by_lands)
                done(some.shape[1])
                return found

            return np.concatenate(on_all_cores(fields, range(0, every, _TOGETHER)), axis=1)

    def reduced_forces(self, station_forces: np.ndarray) -> np.ndarray:
        """Forces (nt, Z per_pocket) of ``forces``' columns from (nt, Z, F, n_st, 3)."""
        interface, columns = self._recovery.interface, []
        for face, (single, even) in enumerate(zip(interface.single, interface.even)):
            for component in single:
                columns.append(station_forces[:, :, face, :, component])
            for component in even:
                columns.append(station_forces[:, :, face, :, component].sum(-1)[..., None])
        return np.concatenate(columns, axis=2).reshape(len(station_forces), -1)

    def _loads(self, pocket: int) -> np.ndarray:
        """Nodal loads (3N, per_pocket) in the order of ``reduced_forces``."""
        own = self._forces(pocket)[pocket]
        at_stations = np.einsum("fsac,ab->fsbc", own, self._recovery.frames[pocket])
        n_rows, per_pocket = own.shape[0] * own.shape[1], own.shape[3]
        weights = self._recovery.weights[pocket * n_rows : (pocket + 1) * n_rows]
        return (weights.T @ at_stations.reshape(n_rows, -1)).reshape(-1, per_pocket)

    def _forces(self, pocket: int) -> np.ndarray:
        """The same loads as forces (Z, F, n_st, 3, per_pocket) at the stations."""
        interface, count = self._recovery.interface, self._recovery.pocket_count
        n_faces = len(interface.single)
        n_st = self._recovery.weights.shape[0] // (count * n_faces)
        alone, evenly, columns = np.eye(n_st), np.full((1, n_st), 1.0 / n_st), []
        for face, (single, even) in enumerate(zip(interface.single, interface.even)):
            for components, shares in ((single, alone), (even, evenly)):
                for component in components:
                    one = np.zeros((n_faces, n_st, 3, len(shares)))
                    one[face, :, component] = shares.T
                    columns.append(one)
        own = np.concatenate(columns, axis=-1)
        forces = np.zeros((count, *own.shape))
        forces[pocket] = own
        return forces

    def _turned(self, symmetry: CyclicSymmetry, first: np.ndarray, pocket: int) -> np.ndarray:
        static = symmetry.rotate(first, pocket)
        return self._less_modes(static, self._loads(pocket), pocket=pocket)

    def _beyond_modes(
        self,
        loads: np.ndarray,
        pushed: np.ndarray | float = 1.0,
        *,
        pocket: int | None = None,
    ) -> np.ndarray:
        static = self._recovery.solver.solve(loads)
        return self._less_modes(static, loads, pushed, pocket=pocket)

    def _less_modes(
        self,
        static: np.ndarray,
        loads: np.ndarray,
        pushed: np.ndarray | float = 1.0,
        *,
        pocket: int | None = None,
    ) -> np.ndarray:
        """What is kept of the answers (3N, m) to loads, those of a pocket's forces if it is given,
        less what the modes carry, those that the loads push (n,) as 1."""
        basis = self._recovery.basis
        work = (basis.shapes.reshape(len(loads), -1).T @ loads) * np.reshape(pushed, (-1, 1))
        values = self._values(static.reshape(-1, 3, loads.shape[1]), pocket=pocket)
        values -= self._mode_values @ np.linalg.solve(basis.stiffness, work)
        return values.astype(np.float32)

    def _values(self, shapes: np.ndarray, *, pocket: int | None = None) -> np.ndarray:
        """What is kept of shapes (N, 3, m), those of a pocket's forces if it is given."""
        forces = None if pocket is None else self._forces(pocket)
        columns = []
        for first in range(0, shapes.shape[2], _KEPT):
            some = slice(first, first + _KEPT)
            push = None if forces is None else forces[..., some]
            parts = self._parts(self._operator(shapes[:, :, some], push))
            columns.append(parts.transpose(2, 0, 1).reshape(-1, parts.shape[1]))
        return np.concatenate(columns, axis=1)


class StressFields(UnitFields):
    """Precomputed deviators at the points of the surface vertices ``surface`` (vertex numbers);
    ``vertices`` (n,), rising: the vertex of every point. ``edges`` (n, 2) are those that cross a
    face of the body."""

    parts = 5
    prefix = ""

    def __init__(self, recovery: StressRecovery) -> None:
        model = recovery.model
        self.surface = np.unique(model.surface)
        self.places = recovery.roots
        self.searched = np.flatnonzero(~np.isin(self.surface, recovery.contact_zone))
        self._stress = recovery.stress_at(self.surface)
        self.vertices = self._stress.owner
        self.edges = edges_across(model)
        self._ends = np.searchsorted(self.vertices, self.edges.T)
        super().__init__(recovery, self._stress)

    def _parts(self, stress: np.ndarray) -> np.ndarray:
        return deviator(stress)

    def loads(
        self, q: np.ndarray, station_forces: np.ndarray, land_forces: np.ndarray | None
    ) -> np.ndarray:
        """Loads (nt, columns) of the columns of ``screen``'s table."""
        pushes = [q, self.reduced_forces(station_forces)]
        if land_forces is not None:
            pushes.append(land_forces.reshape(len(q), -1))
        return np.concatenate([each.astype(np.float32) for each in pushes], axis=1)

    def largest_each(self, *, lands: bool) -> np.ndarray:
        """Bounds (columns,) on the stress [Pa] at searched points per unit of each of ``loads``,
        those of sums in single precision included."""
        names = ("modes", "forces", *(["land_forces"] if lands else []))
        kept = [self._recovery.keep(f"largest_{n}", partial(self._largest, n)) for n in names]
        return (1.0 + 2.0 * ROUNDING) * np.concatenate([each["largest"] for each in kept])

    def _largest(self, name: str) -> dict[str, np.ndarray]:
        """Largest norms (columns,) of a table among the searched points."""
        searched = np.isin(self.vertices, self.surface[self.searched])
        parts = getattr(self, name).reshape(self.parts, len(searched), -1)[:, searched]
        return {"largest": np.sqrt(np.square(parts).sum(axis=0).max(axis=0)).astype(float)}

    def screen(self, typical: np.ndarray, *, lands: bool) -> tuple[Screen, np.ndarray]:
        """Bounds on the stress of the points and, numbered after these, of the edges' middles; and
        the row (n_points + n_edges,) of each in them. ``typical``: some of the ``loads``.

        Rows of searched vertices come first, and those of a place lie side by side.
        """
        tables = [self.modes, self.forces, *([self.land_forces] if lands else [])]
        count = len(self.vertices)
        label = self._labels()
        order = np.argsort(label, kind="stable")
        ends = np.concatenate([np.stack([np.arange(count)] * 2), self._ends], axis=1)[:, order]
        first = np.cumsum([0, *(table.shape[1] for table in tables)])

        def rows(points: np.ndarray, columns: np.ndarray | None) -> np.ndarray:
            one, two = (count * np.arange(self.parts) + ends[:, points, None]).reshape(2, -1)
            middle = np.flatnonzero(one != two)
            found = []
            for table, begin, end in zip(tables, first, first[1:]):
                if columns is None:
                    own, others = table[one], table[two[middle]]
                else:
                    some = columns[slice(*np.searchsorted(columns, [begin, end]))] - begin
                    own, others = table[one[:, None], some], table[two[middle, None], some]
                own[middle] = 0.5 * (own[middle] + others)
                found.append(own)
            return np.concatenate(found, axis=1)

        row = np.empty(len(order), int)
        row[order] = np.arange(len(order))
        return Screen(rows, np.unique(label, return_counts=True)[1].tolist(), typical), row

    def _labels(self) -> np.ndarray:
        """Group (n_points + n_edges,) of every point and every middle: its place, or the part of
        the cage that it lies in; those of searched vertices first."""
        points, count = self._recovery.model.points, 2 * self._recovery.pocket_count
        at = np.concatenate([points[self.vertices], points[self.edges].mean(axis=1)])
        turn = np.arctan2(at[:, 2], at[:, 1]) / (2.0 * np.pi) % 1.0
        part = (turn * count).astype(int) * 2 + (at[:, 0] > points[:, 0].mean())
        label = len(self.places) + part
        for place, vertices in enumerate(self.places.values()):
            label[: len(self.vertices)][np.isin(self.vertices, vertices)] = place
        searched = np.isin(self.vertices, self.surface[self.searched])
        label[: len(self.vertices)][~searched] += 2 * count + len(self.places)
        label[len(self.vertices) :] += 2 * (2 * count + len(self.places))
        return label

    def largest(self, values: np.ndarray) -> np.ndarray:
        """Largest of the points' values (n_points, ...) at every vertex (n_surface, ...)."""
        return self._stress.largest(values)


class NamedFields(UnitFields):
    """Fields of which ``places`` holds, by name, the rows of its points."""

    places: dict[str, np.ndarray]


class TensorFields(NamedFields):
    """Precomputed stresses xx, yy, zz, xy, yz, xz at the points of the named places; ``vertices``
    (n,), rising: the vertex of every point."""

    def __init__(self, recovery: StressRecovery) -> None:
        named = recovery.roots
        vertices = np.unique(np.concatenate(list(named.values()))) if named else np.zeros(0, int)
        stress = recovery.stress_at(vertices)
        super().__init__(recovery, stress)
        self.vertices = stress.owner
        self.places = {n: np.flatnonzero(np.isin(self.vertices, v)) for n, v in named.items()}
