"""Free-free eigenmodes alone: the smallest basis, and too stiff under forces on the pockets."""

from __future__ import annotations

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.modes.basis import ModeBasis
from flexcage.modes.ritz import eigen_basis
from flexcage.modes.spec import ModesSpec


def build(solver: FreeBodySolver, *, pocket_count: int, spec: ModesSpec) -> ModeBasis:
    """The first ``spec.count`` elastic modes of the free body."""
    omega2, shapes = free_modes(solver, spec.count)
    return eigen_basis("free_free", shapes, omega2, ["free"] * len(omega2))
