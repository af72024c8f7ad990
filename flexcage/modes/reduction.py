"""From a cage's mesh to its reduced model: FE matrices, modal basis, interface; basis cached."""

from __future__ import annotations

import logging
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from flexcage.core.cache import cached_arrays
from flexcage.core.hashing import content_hash
from flexcage.core.threads import one_blas_thread
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel, assemble
from flexcage.geometry.cages import Defect, WindowCage
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.basis import CageInterface, ModeBasis, ResidualFlexibility
from flexcage.modes.interface import cage_interface
from flexcage.modes.registry import basis_version, build_basis
from flexcage.modes.spec import ModesSpec

log = logging.getLogger(__name__)

MODEL_VERSION = 3  # of the reduction: raise it when the same input gives another basis


@dataclass(frozen=True)
class CageReduction:
    """A cage's finite-element model with its modal basis and contact interface."""

    model: FEModel
    basis: ModeBasis
    interface: CageInterface
    key: str

    @cached_property
    def solver(self) -> FreeBodySolver:
        """Factored free body, made when first needed."""
        return FreeBodySolver(self.model)


@one_blas_thread
def reduce_cage(
    mesh: CageMesh,
    *,
    cage: WindowCage,
    defects: Sequence[Defect],
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
    arrays = cached_arrays(
        "basis",
        key,
        lambda: _to_arrays(build_basis(model, pocket_count=mesh.pocket_count, spec=spec)),
    )
    basis = _from_arrays(arrays)
    interface = cage_interface(
        model, basis, pocket_count=mesh.pocket_count, cage=cage, defects=defects
    )
    return CageReduction(model, basis, interface, key)


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
