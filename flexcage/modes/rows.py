"""Rows of pockets of a common cage, each as its own frame sees them, and interfaces of all."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, fields, replace
from types import MappingProxyType
from typing import Any, TypeVar

import numpy as np
import scipy.sparse as sp

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import FEModel
from flexcage.geometry.defect import in_row
from flexcage.mesh.rows import ENDS, ROWS, RowFrame, rows_in
from flexcage.modes.basis import ModeBasis
from flexcage.modes.pockets import ROW_AXES, frames_at

I = TypeVar("I")


def row_models(model: FEModel) -> tuple[FEModel, ...]:
    """The model once for every row: vertices and nodes in the row's frame, and the groups of its
    pockets, counted from 0. Vectors stay in the cage's frame (``modes.pockets.vector_frames``)."""
    rows = rows_in(model.info)
    if not rows:
        return (model,)
    return tuple(_row_model(model, k, frame, len(rows)) for k, frame in enumerate(rows))


def _row_model(model: FEModel, row: int, frame: RowFrame, rows: int) -> FEModel:
    groups: dict[str, np.ndarray] = dict.fromkeys(ENDS.values(), np.zeros((0, 3), int))
    groups |= _own_groups(model, row, pockets_of(model) // rows)
    outer = ENDS[float(np.sign(frame.place))]
    groups[ENDS[float(np.sign(frame.place)) * frame.sign]] = model.groups[outer]
    info = {key: value for key, value in model.info.items() if key != ROWS}
    info[ROW_AXES] = tuple(map(tuple, frame.axes.tolist()))
    return replace(
        model, points=frame.into(model.points), nodes=frame.into(model.nodes),
        groups=MappingProxyType(groups), info=MappingProxyType(info),
    )  # fmt: skip


def pockets_of(model: FEModel) -> int:
    """How many pockets all rows of a model have."""
    named = (name.partition("_")[0] for name in model.groups if name.startswith("pocket"))
    return 1 + max((int(name[6:]) for name in named), default=-1)


def _own_groups(model: FEModel, row: int, count: int) -> Iterator[tuple[str, np.ndarray]]:
    for name, triangles in model.groups.items():
        pocket, _, part = name.partition("_")
        if not pocket.startswith("pocket"):
            if name not in ENDS.values():
                yield name, triangles
        elif (number := int(pocket[6:])) // count == row:
            yield f"pocket{number - row * count}_{part}", triangles


def pocket_axes(model: FEModel, pocket_count: int) -> np.ndarray:
    """Rows x, r, psi (n, 3, 3) of the frames of the pockets of all rows, right-handed, x as the
    cage's."""
    rows = rows_in(model.info) or (RowFrame(),)
    even = 2.0 * np.pi * np.arange(pocket_count // len(rows)) / (pocket_count // len(rows))
    return frames_at(np.concatenate([even + row.turned for row in rows]))


@dataclass(frozen=True)
class RowOfCage:
    """What the interface of a row is made from, as of a reduced cage (``modes.reduction``)."""

    mesh: Any
    cage: Any
    defects: tuple[Any, ...]
    model: FEModel
    basis: ModeBasis
    solver: FreeBodySolver


def rows_of_cage(cage: Any) -> tuple[RowOfCage, ...]:
    """The rows of a reduced cage."""
    count, models = cage.mesh.pocket_count, row_models(cage.model)
    return tuple(
        RowOfCage(cage.mesh, cage.cage, in_row(cage.defects, k, count), model,
                  _own_vectors(cage.basis, k, len(models)), cage.solver)
        for k, model in enumerate(models)
    )  # fmt: skip


def _own_vectors(basis: ModeBasis, row: int, rows: int) -> ModeBasis:
    """The basis with the residual vectors of a row's pockets alone."""
    residual = basis.residual
    if residual is None or residual.shapes is None:
        return basis
    per = len(residual.stiffness) // rows
    own, pockets = slice(row * per, (row + 1) * per), len(residual.compliance) // rows
    return replace(
        basis,
        residual=replace(
            residual, shapes=residual.shapes[:, :, own], stiffness=residual.stiffness[own, own],
            compliance=residual.compliance[row * pockets : (row + 1) * pockets],
        ),
    )  # fmt: skip


def joined_interfaces(parts: Sequence[I], frames: Sequence[RowFrame]) -> I:
    """One interface of the pockets of all rows, from those of each row in its frame: components of
    modes are along x of the cage, r and psi; what counts along a pocket stays in its row's frame.
    """
    placed: list[Any] = [part.in_row(frame) for part, frame in zip(parts, frames)]  # type: ignore[attr-defined]
    first, every = placed[0], {}
    for field in fields(first):
        values = [getattr(part, field.name) for part in placed]
        if field.name in first.per_pocket and any(v is not None for v in values):
            every[field.name] = _together(values, field.name, placed)
    return replace(first, **every)


def _together(values: Sequence[Any], name: str, placed: Sequence[Any]) -> Any:
    """Values of the pockets of all rows; ``plain`` ones for a row that has none."""
    values = [p.plain(name) if v is None else v for v, p in zip(values, placed)]
    if sp.issparse(values[0]):
        return sp.csr_matrix(sp.vstack(values))
    return np.concatenate(values)
