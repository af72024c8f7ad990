"""From a cage's mesh to its reduced model: FE matrices, modal basis, interface; basis cached."""

from __future__ import annotations

import logging
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cache, cached_property, singledispatch
from typing import Any

import numpy as np

from flexcage.core.cache import cached_arrays
from flexcage.core.errors import InputError
from flexcage.core.hashing import content_hash
from flexcage.core.threads import one_blas_thread
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel, assemble
from flexcage.geometry.ball_cage_defects import BallCageDefect, pocket_shapes
from flexcage.geometry.ball_cages import BallCage
from flexcage.geometry.cages import Defect, WindowCage
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.ball_interface import (
    BallCageInterface,
    ball_cage_interface,
    rigid_ball_interface,
    static_compliance,
    wall_stations,
    wall_weights,
)
from flexcage.modes.basis import CageInterface, ModeBasis, ResidualFlexibility
from flexcage.modes.interface import cage_interface, rigid_interface
from flexcage.modes.registry import basis_version, build_basis
from flexcage.modes.spec import ModesSpec

log = logging.getLogger(__name__)

MODEL_VERSION = 8  # of the reduction: raise it when the same input gives another basis
BALL_VERSION = 1  # of a ball cage's static compliances, likewise


@dataclass(frozen=True)
class CageReduction:
    """A cage's finite-element model with its modal basis and contact interface."""

    model: FEModel
    basis: ModeBasis
    interface: Any  # CageInterface or BallCageInterface
    key: str

    @cached_property
    def solver(self) -> FreeBodySolver:
        """Factored free body, made when first needed."""
        return FreeBodySolver(self.model)


@one_blas_thread
def reduce_cage(
    mesh: CageMesh,
    *,
    cage: Any,
    defects: Sequence[Any],
    spec: ModesSpec,
    order: int = 2,
) -> CageReduction:
    """Assemble the cage and reduce it; the basis comes from the disk cache if it is there."""
    model = assemble(mesh, cage.material, order=order)
    key = content_hash(
        MODEL_VERSION,
        spec,
        order,
        cage.material,
        mesh.pocket_count,
        mesh.points,
        mesh.tets,
        dict(mesh.groups),
        *basis_version(spec.kind),
    )
    solver = cache(lambda: FreeBodySolver(model))

    def make() -> dict[str, np.ndarray]:
        return _to_arrays(
            build_basis(model, pocket_count=mesh.pocket_count, spec=spec, solver=solver())
        )

    arrays = cached_arrays("basis", key, make)
    reduced = Reduced(model, _from_arrays(arrays), mesh.pocket_count, key, solver)
    return CageReduction(model, reduced.basis, interface_of(cage, defects, reduced), key)


@dataclass(frozen=True)
class Reduced:
    """What the interface of a cage is made from."""

    model: FEModel
    basis: ModeBasis
    pocket_count: int
    key: str  # names model and basis
    solver: Callable[[], FreeBodySolver]  # the factored free body, made once


@singledispatch
def interface_of(cage: object, defects: Sequence[Any], reduced: Reduced) -> Any:
    """The interface of a reduced cage; every type of cage registers here how it is touched."""
    raise InputError(
        f"no interface is known for a {type(cage).__name__}; a cage is a WindowCage or a BallCage",
        where="cage",
    )


@singledispatch
def rigid_interface_of(cage: object, *, pocket_count: int, defects: Sequence[Any] = ()) -> Any:
    """The interface of a rigid cage; every type of cage registers here how it is touched."""
    raise InputError(f"no interface is known for a {type(cage).__name__}", where="cage")


rigid_interface_of.register(WindowCage, rigid_interface)
rigid_interface_of.register(BallCage, rigid_ball_interface)


@interface_of.register
def _(cage: WindowCage, defects: Sequence[Defect], reduced: Reduced) -> CageInterface:
    return cage_interface(
        reduced.model,
        reduced.basis,
        pocket_count=reduced.pocket_count,
        cage=cage,
        defects=defects,
    )


@interface_of.register
def _(cage: BallCage, defects: Sequence[BallCageDefect], reduced: Reduced) -> BallCageInterface:
    """Its static compliances are kept on disk beside the basis."""
    model, count = reduced.model, reduced.pocket_count
    shapes = pocket_shapes(cage, defects, pocket_count=count)

    def make() -> dict[str, np.ndarray]:
        weights = wall_weights(model, wall_stations(), shapes, cage)
        return {"static": static_compliance(reduced.solver(), weights, count)}

    key = content_hash(BALL_VERSION, reduced.key, cage.bore, cage.outside_diameter, shapes)
    static = cached_arrays("compliance", key, make)["static"]
    return ball_cage_interface(
        reduced.model,
        reduced.basis,
        pocket_count=reduced.pocket_count,
        cage=cage,
        defects=defects,
        static=static,
    )


def _to_arrays(basis: ModeBasis) -> dict[str, np.ndarray]:
    arrays = {
        "name": np.array(basis.name),
        "shapes": basis.shapes,
        "stiffness": basis.stiffness,
        "mass": basis.mass,
        "frequencies": basis.frequencies,
        "kind": np.array(basis.kind),
    }
    if basis.geometric is not None:
        arrays["geometric"] = basis.geometric
    if basis.residual is not None:
        r = basis.residual
        arrays |= {
            "r_shapes": r.shapes,
            "r_stiffness": r.stiffness,
            "r_compliance": r.compliance,
            "r_far": np.array(r.far_coupling),
        }
    return arrays


def _from_arrays(a: dict[str, np.ndarray]) -> ModeBasis:
    residual = None
    if "r_shapes" in a:
        residual = ResidualFlexibility(
            shapes=a["r_shapes"],
            stiffness=a["r_stiffness"],
            compliance=a["r_compliance"],
            far_coupling=float(a["r_far"]),
        )
    return ModeBasis(
        name=str(a["name"]),
        shapes=a["shapes"],
        stiffness=a["stiffness"],
        mass=a["mass"],
        frequencies=a["frequencies"],
        kind=tuple(str(k) for k in a["kind"]),
        residual=residual,
        geometric=a.get("geometric"),
    )
