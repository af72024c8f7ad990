"""Kinds of modal basis by name, the one call that builds one, and the one that adds one."""

from __future__ import annotations

import logging
from collections.abc import Callable
from dataclasses import replace
from pathlib import Path

import numpy as np
from scipy.linalg import eigvalsh

from flexcage.core.errors import InputError
from flexcage.core.missing import no_file
from flexcage.core.registry import add, check_free, source_of
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel
from flexcage.mesh.cage_mesh import WALL_GROUPS, pocket_groups
from flexcage.modes import craig_bampton, free_free, ritz
from flexcage.modes.basis import ModeBasis
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.cage import basis_from_body
from flexcage.modes.orientation import oriented
from flexcage.modes.spec import KINDS, ModesSpec
from flexcage.modes.stiffening import spin_stiffness

log = logging.getLogger(__name__)

BUILDERS: dict[str, Callable[..., ModeBasis]] = {
    "ritz": ritz.build,
    "craig_bampton": craig_bampton.build,
    "free_free": free_free.build,
}
# kinds of bases that are others for a cage with round pockets, or (None) have no form for it
ROUND_POCKETS: dict[str, Callable[..., ModeBasis] | None] = {
    "ritz": ritz.build_without_attachments,
    "craig_bampton": None,
}
_MANY = 300  # modes: on an N1013's coarse mesh 400 take 14 s, 800 take 134 s
_VECTORS = 4  # of all nodes that are kept for a mode while it is sought
_RIGID = 1e-9  # of the largest squared frequency: what rounding leaves of a rigid motion


def register_basis(
    name: str, build: Callable[..., ModeBasis], *, spec: type[ModesSpec] | None = None
) -> None:
    """Add a kind of modal basis: ``modes.kind = "name"`` in a case then asks for it.

    ``build(solver, *, pocket_count, spec)`` takes the cage's factored free body
    (``fem.free.FreeBodySolver``: ``solver.model`` has nodes, K, M and groups, ``solver.solve(F)``
    answers loads (3N, m) with inertia relief) and returns a ``ModeBasis`` in SI units and the
    cage's frame, without rigid motion. ``spec``, if the basis has values of its own, is a frozen
    dataclass derived from ``ModesSpec`` whose ``kind`` defaults to ``name``. Bases are cached on
    disk; an edit of the file that defines ``build`` makes them anew.

    Raises InputError for a name that is taken or a spec that does not fit.
    """
    check_free(BUILDERS, name, what="mode basis")
    if spec is not None:
        default = getattr(spec, "kind", None)
        if not (isinstance(spec, type) and issubclass(spec, ModesSpec)) or default != name:
            raise InputError(
                f"The spec of mode basis '{name}' must be a dataclass derived from ModesSpec whose "
                f"kind defaults to '{name}'.",
                where=name,
            )
    add(BUILDERS, name, build, what="mode basis", source=build)
    KINDS[name] = spec


def check_files(spec: ModesSpec) -> None:
    """InputError for a file of the spec that is not there: what it held is not known."""
    for name in ("body", "body_nodes"):
        file = getattr(spec, name)
        if file and not Path(file).is_file():
            raise InputError(f"{no_file('file', Path(file))}.", where=f"modes.{name}", value=file)


def basis_version(spec: ModesSpec) -> tuple[str | bytes, ...]:
    """What a cached basis depends on besides its spec: the file of a builder from outside, and the
    bytes of a body's files."""
    outside = source_of(spec.kind)
    bodies = (Path(f) for f in (spec.body, spec.body_nodes) if f)
    return (*([outside] if outside else []), *(p.read_bytes() for p in bodies if p.is_file()))


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
    with ``solver_kind``. A builder is ``(solver, *, pocket_count, spec) -> ModeBasis``. Signs of
    modes, and directions among those of equal frequency, are fixed by rule (``orientation``).
    """
    spec = spec or ModesSpec()
    if spec.kind not in BUILDERS:
        raise InputError(
            f"mode basis {spec.kind!r} is not one of {', '.join(BUILDERS)}",
            where="modes.kind",
            value=spec.kind,
        )
    builder = _builder(spec.kind, model)
    _check_count(spec.count, model.n_dof)
    if solver is None:
        solver = FreeBodySolver(model, kind=solver_kind)
    basis = builder(solver, pocket_count=pocket_count, spec=spec)
    check_basis(basis, len(model.nodes))
    return stiffened(oriented(basis, model, pocket_count), solver, spec)


def basis_of_body(
    body: ReducedBody, solver: FreeBodySolver, *, pocket_count: int, spec: ModesSpec
) -> ModeBasis:
    """Modal basis of a cage that was reduced elsewhere; ``solver`` is of the cage's own elements.

    Coordinates that the body names are taken as they are; signs and directions of eigenmodes are
    fixed by rule. InputError for a body that does not fit.
    """
    basis = basis_from_body(body, solver, pocket_count=pocket_count, spec=spec)
    check_basis(basis, len(solver.model.nodes))
    if not body.kind:
        basis = oriented(basis, solver.model, pocket_count)
    return stiffened(basis, solver, spec)


def stiffened(basis: ModeBasis, solver: FreeBodySolver, spec: ModesSpec) -> ModeBasis:
    """The basis with what rotation stiffens, if ``spec`` asks for it."""
    if spec.geometric_stiffening and basis.geometric is None:
        basis = replace(basis, geometric=spin_stiffness(solver, basis.shapes))
    first = ", ".join(f"{f:.1f}" for f in basis.frequencies[:6])
    log.debug("basis %s: %d dynamic modes, first %s Hz", basis.name, basis.size, first)
    return basis


def _check_count(count: int, unknowns: int) -> None:
    """Refuse more modes than a mesh can show, and warn of so many that finding them takes long."""
    if count > unknowns // 4:
        raise InputError(
            f"modes.count is {count:,}, but of a mesh with {unknowns:,} unknowns at most "
            f"{unknowns // 4:,} modes are sensible; ask for fewer, or take a finer mesh.",
            where="modes.count",
            value=count,
        )
    if count > _MANY:
        log.warning(
            "modes.count is %s: finding so many modes takes about %.1f GB, and time that grows "
            "with their number squared; %d are the default", f"{count:,}",
            _VECTORS * 8e-9 * count * unknowns, ModesSpec().count,
        )  # fmt: skip


def _builder(kind: str, model: FEModel) -> Callable[..., ModeBasis]:
    """The builder of a kind for this cage; InputError for a kind that has no form for it."""
    if pocket_groups(model.groups) != WALL_GROUPS:
        return BUILDERS[kind]
    builder = ROUND_POCKETS.get(kind, BUILDERS[kind])
    if builder is None:
        known = ", ".join(k for k in BUILDERS if ROUND_POCKETS.get(k, 1))
        raise InputError(
            f"mode basis {kind!r} needs pockets with plane faces; a cage with round pockets takes "
            f"one of {known}.",
            where="modes.kind",
            value=kind,
        )
    return builder


def check_basis(basis: ModeBasis, nodes: int) -> None:
    """Raise InputError unless a basis is what it should be: shapes of all nodes, none rigid."""
    n = basis.size
    shapes = {
        "shapes": (basis.shapes, (nodes, 3, n)),
        "stiffness": (basis.stiffness, (n, n)),
        "mass": (basis.mass, (n, n)),
        "frequencies": (basis.frequencies, (n,)),
    }
    if basis.geometric is not None:
        shapes["geometric"] = (basis.geometric, (n, n))
    for name, (array, wanted) in shapes.items():
        if array.shape != wanted or not np.isfinite(array).all():
            raise InputError(
                f"{name} of mode basis '{basis.name}' has shape {array.shape}, but must be finite "
                f"numbers of shape {wanted}.",
                where="modes.kind",
                value=basis.name,
            )
    squares = eigvalsh(basis.stiffness, basis.mass)
    if squares[0] < _RIGID * squares[-1]:
        lowest = np.sqrt(max(squares[0], 0.0)) / (2.0 * np.pi)
        raise InputError(
            f"Mode basis '{basis.name}' holds a rigid motion (its lowest frequency is "
            f"{lowest:.2g} Hz); take the six rigid motions out of it.",
            where="modes.kind",
            value=basis.name,
        )
