"""From a cage's mesh to its reduced model: FE matrices, modal basis and interface, both cached."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from flexcage.core.cache import cached_arrays
from flexcage.core.hashing import content_hash
from flexcage.core.registry import source_of
from flexcage.core.threads import one_blas_thread
from flexcage.fem.effort import check_memory, modes_progress
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel, assemble
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import in_row
from flexcage.mesh.cage_mesh import WALL_GROUPS, CageMesh, pocket_groups
from flexcage.mesh.rows import ROWS, rows_in
from flexcage.modes.basis import BodyFit, ContactInterface, ModeBasis
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.cage import BODY, body_of, full_body_of, imported_model
from flexcage.modes.exchange.cage_checks import WHERE
from flexcage.modes.exchange.formats import read_body
from flexcage.modes.pockets import LOADS
from flexcage.modes.registry import basis_of_body, basis_version, build_basis, check_files
from flexcage.modes.rows import joined_interfaces, rows_of_cage
from flexcage.modes.spec import ModesSpec
from flexcage.modes.storage import (
    basis_arrays,
    basis_from,
    interface_arrays,
    interface_from,
    rounded,
    table_arrays,
    table_from,
)
from flexcage.modes.table import ModeTable, mode_table

Derived = TypeVar("Derived")
C = TypeVar("C", bound=Cage, contravariant=True)
MODEL_VERSION = 9  # of the reduction: raise it when the same input gives another basis
INTERFACE_VERSION = 1  # of interfaces, likewise
_NOT_SHOWN = ("r_shapes",)  # of a basis: residual shapes, the largest part, which no result reads
TABLE_VERSION = 1  # of the mode table, likewise
SHOWN_VERSION = 1  # of shapes as results refer to them, likewise


class RigidInterface(Protocol[C]):
    """The interface of a rigid cage: no modes, no compliance, no mesh."""

    def __call__(
        self, cage: C, *, pocket_count: int, defects: Sequence[Any] = ()
    ) -> ContactInterface: ...


@dataclass(frozen=True, kw_only=True)
class Interfaces(Generic[C]):
    """How the cages of a type are touched.

    ``kind`` is a dataclass of arrays, sparse matrices and numbers, and ``rigid`` makes that of a
    rigid cage. ``reduced`` makes that of a reduced one, a ``CageReduction`` or a ``RowOfCage`` of
    ``modes.rows``, which is kept on disk: besides its basis it
    may depend on what ``depends_on`` gives of cage, defects and number of pockets, and on nothing
    else.
    """

    kind: type[ContactInterface]
    rigid: RigidInterface[C]
    reduced: Callable[[Any], ContactInterface]
    depends_on: Callable[[C, Sequence[Any], int], tuple[Any, ...]]


@dataclass(frozen=True)
class CageReduction:
    """A flexible cage's finite-element model, modal basis and contact interface.

    Each is made, or read from disk, when first asked for. With basis and interface on disk a run
    begins without matrices and nodal shapes, the large parts, which wait for stresses.

    ``stored`` holds the arrays of a reduction that a run's folder keeps, by kind: "basis" (its
    shapes are those of ``shown``), "interface", "body" and "table". Nothing is then made anew, and
    neither is the cache asked.
    """

    mesh: CageMesh
    cage: Any
    defects: tuple[Any, ...]
    spec: ModesSpec
    order: int
    interfaces: Interfaces[Any] = field(compare=False)
    stored: Mapping[str, Mapping[str, np.ndarray]] = field(default_factory=dict)
    _derived: dict[str, Any] = field(default_factory=dict, init=False, repr=False, compare=False)

    def once(self, name: str, make: Callable[[], Derived]) -> Derived:
        """What others derive from this cage alone, made once and kept as long as the cage."""
        if name not in self._derived:
            self._derived[name] = make()
        return self._derived[name]

    def same_as(self, other: CageReduction) -> bool:
        """Whether two cages are the same by content: mesh, shape, defects and modes."""
        return (self.cage, self.defects, self.key) == (other.cage, other.defects, other.key)

    def arrays(
        self,
        kind: str,
        key: str,
        make: Callable[[], Mapping[str, Any]],
        *,
        only: Sequence[str] = (),
        without: Sequence[str] = (),
    ) -> Mapping[str, np.ndarray]:
        """The stored arrays of a ``kind``, else those of the cache (``core.cache``)."""
        if kind in self.stored:
            return self.stored[kind]
        return cached_arrays(kind, key, lambda: dict(make()), only=only, without=without)

    @cached_property
    def key(self) -> str:
        """Names model and basis by what they are made from."""
        if not self.stored:
            check_files(self.spec)
        return content_hash(
            MODEL_VERSION,
            replace(self.spec, body="", body_nodes=""),
            self.order,
            self.cage.warm_material,
            self.mesh.pocket_count,
            self.mesh.points,
            self.mesh.tets,
            dict(self.mesh.groups),
            *((self.mesh.info[ROWS],) if ROWS in self.mesh.info else ()),
            *basis_version(self.spec),
        )

    @cached_property
    def body(self) -> ReducedBody | None:
        """The body that the spec names, in SI and checked; None if it names none."""
        if not self.spec.body:
            return None
        spec = self.spec
        return read_body(spec.body, nodes=spec.body_nodes, units=spec.body_units, where=WHERE)

    @property
    def pockets(self) -> int:
        """How many pockets all rows have."""
        return self.mesh.pocket_count * max(len(rows_in(self.mesh.info)), 1)

    @property
    def _own(self) -> bool:
        """Are stiffness and mass those of the elements, and not a body's full matrices?"""
        if not self.spec.body or str(self.stored.get("basis", {}).get("name")) == BODY:
            return True
        assert self.body is not None
        return not self.body.is_full

    @cached_property
    @one_blas_thread
    def model(self) -> FEModel:
        """The elements, with stiffness and mass: theirs, or the full matrices of a body."""
        made = assemble(self.mesh, self.cage.warm_material, order=self.order)
        if self._own:
            return made
        assert self.body is not None
        return imported_model(self.body, made, self.spec)

    @cached_property
    def solver(self) -> FreeBodySolver:
        """The free body, factored when a load asks for it."""
        return FreeBodySolver(self.model)

    @cached_property
    def basis(self) -> ModeBasis:
        """The modal basis with its nodal shapes."""
        arrays = self._stored_basis
        if "shapes" not in arrays and "steps" not in arrays:
            arrays = self.arrays("basis", self.key, self._make_basis)
        return basis_from(arrays)

    @cached_property
    def shown(self) -> ModeBasis:
        """The basis that results refer to: shapes as a run's folder keeps them (``rounded``), no
        residual shapes. The same numbers come from a run and from its folder."""
        return basis_from(self._rounded)

    @cached_property
    def _rounded(self) -> Mapping[str, np.ndarray]:
        if "steps" in self._stored_basis:
            return self._stored_basis

        def make() -> dict[str, np.ndarray]:
            made = self._stored_basis
            if "shapes" not in made:
                made = self.arrays("basis", self.key, self._make_basis, without=_NOT_SHOWN)
            return rounded(made)

        return self.arrays("shown", f"{self.version}-{SHOWN_VERSION}", make)

    def record(self) -> dict[str, Mapping[str, np.ndarray]]:
        """What ``stored`` takes of this reduction, but for the body."""
        return {
            "basis": self._rounded,
            "interface": interface_arrays(self.interface),
            "table": table_arrays(self.table),
        }

    @cached_property
    @one_blas_thread
    def table(self) -> ModeTable:
        """Number, kind, frequency and effective masses of the dynamic modes."""

        def make() -> dict[str, np.ndarray]:
            count = self.pockets
            return table_arrays(mode_table(self.model, self.basis, pocket_count=count))

        return table_from(self.arrays("table", f"{self.version}-{TABLE_VERSION}", make))

    @property
    def content(self) -> tuple[Any, ...]:
        """All that the arrays of ``record`` depend on, versions included."""
        versions = INTERFACE_VERSION, TABLE_VERSION, SHOWN_VERSION
        return (self.version, self.cage, self.defects, *versions, *self._outside)

    @property
    def _outside(self) -> tuple[str, ...]:
        """Fingerprint of the file of a cage type from outside, which may be edited."""
        source = source_of(self.cage.cage_type)
        return (source,) if source else ()

    @property
    def version(self) -> str:
        """Names this very basis: what else is kept of it on disk fits no other."""
        return f"{self.key}-{self._stored_basis['digest']}"

    @one_blas_thread
    def as_body(self) -> ReducedBody:
        """Dynamic modes and residual vectors as a body for other programs."""
        return body_of(self.basis, self.model)

    @one_blas_thread
    def as_full_body(self) -> ReducedBody:
        """Stiffness and mass of all nodes as a body for other programs."""
        return full_body_of(self.model)

    @property
    def fit(self) -> BodyFit | None:
        """How a reduced body from elsewhere fits the elements; None without one."""
        return self.basis.fit if self.spec.body else None

    @cached_property
    @one_blas_thread
    def interface(self) -> Any:
        """The contact interface, of the cage type's own kind, from disk if it is there."""
        made = self.interfaces
        count, rows = self.mesh.pocket_count, rows_in(self.mesh.info)
        own = [in_row(self.defects, k, count) for k in range(len(rows))]
        content: Sequence[Any] = [made.depends_on(self.cage, d, count) for d in own]
        content = content or made.depends_on(self.cage, self.defects, count)
        key = content_hash(INTERFACE_VERSION, (self.version, *content), *self._outside)

        def reduced() -> Any:
            if not rows:
                return made.reduced(self)
            return joined_interfaces([made.reduced(row) for row in rows_of_cage(self)], rows)

        arrays = self.arrays("interface", key, lambda: interface_arrays(reduced()))
        return interface_from(made.kind, arrays)

    @property
    def _vectors(self) -> int:
        """How many vectors a basis has, about."""
        walls = pocket_groups(self.mesh.groups) == WALL_GROUPS
        per_pocket = 0 if walls else LOADS[self.spec.attachments] + 1
        return self.spec.count + per_pocket * self.pockets

    @cached_property
    @one_blas_thread
    def _stored_basis(self) -> Mapping[str, np.ndarray]:
        """The digest of the basis on disk, or all of a basis just made."""
        return self.arrays("basis", self.key, self._make_basis, only=("digest",))

    @one_blas_thread
    def _make_basis(self) -> dict[str, np.ndarray]:
        check_memory(self.model, self._vectors)
        count, solver = self.pockets, self.solver
        with modes_progress(solver):
            if self.body is not None and not self.body.is_full:
                made = basis_of_body(self.body, solver, pocket_count=count, spec=self.spec)
            else:
                made = build_basis(self.model, pocket_count=count, spec=self.spec, solver=solver)
        return basis_arrays(made)
