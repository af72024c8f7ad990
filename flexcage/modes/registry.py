"""Kinds of modal basis by name, and the one call that builds one."""

from __future__ import annotations

import logging
from collections.abc import Callable

from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel
from flexcage.modes import craig_bampton, free_free, ritz
from flexcage.modes.basis import ModeBasis
from flexcage.modes.spec import ModesSpec

log = logging.getLogger(__name__)

BUILDERS: dict[str, Callable[..., ModeBasis]] = {
    "ritz": ritz.build,
    "craig_bampton": craig_bampton.build,
    "free_free": free_free.build,
}


def build_basis(
    model: FEModel,
    *,
    pocket_count: int,
    spec: ModesSpec | None = None,
    solver_kind: str = "auto",
    solver: FreeBodySolver | None = None,
) -> ModeBasis:
    """Modal basis of a free cage as ``spec`` asks.

    ``solver``: the model's factored free body, if there is one already; otherwise it is made
    with ``solver_kind``. A builder is ``(solver, *, pocket_count, spec) -> ModeBasis``.
    """
    spec = spec or ModesSpec()
    if spec.kind not in BUILDERS:
        raise InputError(
            f"mode basis {spec.kind!r} is not one of {', '.join(BUILDERS)}",
            where="modes.kind",
            value=spec.kind,
        )
    if spec.count > model.n_dof // 4:
        raise InputError(
            f"{spec.count} modes are asked of a mesh with {model.n_dof} unknowns; "
            f"at most {model.n_dof // 4} are sensible",
            where="modes.count",
            value=spec.count,
        )
    if solver is None:
        solver = FreeBodySolver(model, kind=solver_kind)
    basis = BUILDERS[spec.kind](solver, pocket_count=pocket_count, spec=spec)
    first = ", ".join(f"{f:.1f}" for f in basis.frequencies[:6])
    log.info("basis %s: %d dynamic modes, first %s Hz", basis.name, basis.size, first)
    return basis
