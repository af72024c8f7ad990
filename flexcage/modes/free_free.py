"""Free-free eigenmodes alone: the smallest basis, and too stiff under forces on the pockets."""

from __future__ import annotations

from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.modes.basis import ModeBasis
from flexcage.modes.ritz import eigen_basis
from flexcage.modes.spec import ModesSpec


def build(solver: FreeBodySolver, *, pocket_count: int, spec: ModesSpec) -> ModeBasis:
    """The first ``spec.count`` elastic modes of the free body."""
    if spec.land:
        raise InputError(
            "the free_free basis has no land vectors; take kind 'ritz' or 'craig_bampton', or "
            "leave modes.land out",
            where="modes.land",
            value=spec.land,
        )
    omega2, shapes = free_modes(solver, spec.count)
    return eigen_basis("free_free", shapes, omega2, ["free"] * len(omega2))
