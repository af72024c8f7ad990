"""What a reader takes from a file: its numbers as they stand there, before units and checks."""

from __future__ import annotations

import logging
from collections import Counter
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.arrays import Damaged
from flexcage.core.errors import InputError
from flexcage.core.missing import POINTER, is_pointer
from flexcage.mesh.files.raw import Refused, listed
from flexcage.modes.exchange.body import MODAL, ReducedBody

log = logging.getLogger(__name__)


@dataclass(frozen=True, kw_only=True)
class FileNodes:
    """Nodes of a file: numbers (N,), places (N, 3), elements and named sets of node numbers.

    ``frames`` (N, 3, 3): rows are the directions of a node's coordinates, where these are not those
    of the places.
    """

    numbers: np.ndarray
    places: np.ndarray
    cells: np.ndarray | None = None  # (m, corners) node numbers
    sets: Mapping[str, np.ndarray] = field(default_factory=dict)
    frames: np.ndarray | None = None


@dataclass(frozen=True, kw_only=True)
class Contents:
    """Matrices of a file in its own units.

    ``labels`` (n, 2): node number and component (1 to 6) of every coordinate, component 0 for a
    modal one; None where the file does not say. ``shapes`` goes with ``points``: (3N, n), or
    (6N, n) with rotations.
    """

    stiffness: Any
    mass: Any | None
    labels: np.ndarray | None = None
    points: FileNodes | None = None
    shapes: np.ndarray | None = None
    kind: tuple[str, ...] = ()
    gyroscopic: Any | None = None


def unreadable(path: Path, reason: object, *, where: str) -> InputError:
    """The error to raise for a file that is not what its name says."""
    if isinstance(reason, Refused):
        return InputError(f"{path}: {reason}.", where=where, value=str(path))
    return InputError(
        f"{path} cannot be read as a {path.suffix} file: it is empty, cut short, or not what its "
        f"name says{_reason(path, reason)}.",
        where=where,
        value=str(path),
    )


def _reason(path: Path, reason: object) -> str:
    """A reason that a reader can use; what libraries say of their insides is none."""
    if path.is_file() and path.stat().st_size == 0:
        return " (there is nothing in it)"
    if is_pointer(path):
        return f" ({POINTER})"
    if isinstance(reason, MemoryError):
        return " (memory has no room for matrices as large as it says)"
    return f" ({reason})" if isinstance(reason, Damaged) else ""


def picked(found: Mapping[str, Any], names: tuple[str, ...]) -> Any | None:
    """The first of ``names`` that a file has, in capitals or not; None if it has none."""
    by_name = {name.upper(): value for name, value in found.items()}
    return next((by_name[name] for name in names if name in by_name), None)


#: What matrices are called: Nastran's of EXTSEOUT and of assemblies, and plain names.
STIFFNESS = ("STIFFNESS", "K", "KAAX", "KAA", "KGG", "KJJ", "KXX", "K2GG")
MASS = ("MASS", "M", "MAAX", "MAA", "MGG", "MJJ", "MXX", "M2GG")
GYROSCOPIC = ("GYROSCOPIC", "G")
NODES = ("NODES", "POINTS", "XYZ")
SHAPES = ("SHAPES", "PHI", "PHIG", "PHG")
DOFS = ("DOFS", "LABELS")
_DAMPING = frozenset("C DAMPING BAAX BAA BGG BXX B2GG K4AAX K4AA K4GG K4XX".split())
#: Kinds of coordinates by the number that stands for them in files of numbers alone.
KINDS = (
    "free", "centrifugal", "crossbeam", "land", "attachment", "constraint", "residual", "elastic",
)  # fmt: skip


def refuse_twice(names: Iterable[str], path: Path, *, where: str) -> None:
    """InputError for two matrices of one name, capitals or not: which of them counts?"""
    count = Counter(name.upper() for name in names)
    if twice := [name for name, times in count.items() if times > 1]:
        raise InputError(
            f"{path} has {count[twice[0]]} matrices '{twice[0]}'; leave one of them.",
            where=where,
            value=twice[0],
        )


def warn_of_damping(found: Mapping[str, Any], path: Path) -> None:
    """Say that a damping matrix is not read."""
    if names := [name for name in found if name.upper() in _DAMPING]:
        log.warning(
            "%s has a damping matrix (%s), which is not read: give modes.damping of a cage, "
            "mount.damping of a housing",
            path, ", ".join(names),
        )  # fmt: skip


def from_matrices(found: Mapping[str, Any], path: Path, *, where: str) -> Contents:
    """Contents of a file that is a table of named matrices."""
    refuse_twice(found, path, where=where)
    warn_of_damping(found, path)
    stiffness, mass = picked(found, STIFFNESS), picked(found, MASS)
    gyroscopic = picked(found, GYROSCOPIC)
    if stiffness is None:
        if {"DATA", "INDICES", "INDPTR"} <= {name.upper() for name in found}:
            raise InputError(
                f"{path} is one sparse matrix, as scipy.sparse.save_npz writes it; write K and M "
                "into one file by numpy.savez, each as K.data, K.indices, K.indptr, K.shape, with "
                "NODES.",
                where=where,
                value=str(path),
            )
        raise InputError(
            f"{path} has no stiffness matrix; it has {', '.join(sorted(found)[:8]) or 'nothing'}, "
            f"and one of {', '.join(STIFFNESS)} is looked for.",
            where=where,
            value=str(path),
        )
    nodes, labels, shapes = picked(found, NODES), picked(found, DOFS), picked(found, SHAPES)
    kinds = picked(found, ("KIND",))
    for name, value in zip(
        "K M G NODES DOFS SHAPES".split(), (stiffness, mass, gyroscopic, nodes, labels, shapes)
    ):
        _check_numbers(name, value, path, where)
    size = stiffness.shape[0]
    return Contents(
        stiffness=_real(stiffness),
        mass=None if mass is None else _real(mass),
        gyroscopic=None if gyroscopic is None else _real(gyroscopic),
        labels=None
        if labels is None
        else _whole(_wide(labels, 2, "DOFS", path, where), "DOFS", path, where),
        points=None
        if nodes is None
        else _points(
            _wide(nodes, 3, "NODES", path, where), picked(found, ("NUMBERS",)), path, where
        ),
        shapes=None if shapes is None else _wide(shapes, size, "SHAPES", path, where),
        kind=() if kinds is None else _kinds(np.ravel(_dense(kinds)), path, where=where),
    )


def _check_numbers(name: str, value: Any, path: Path, where: str) -> None:
    """InputError for an array that is no table of numbers; what a file lacks is None."""
    if value is None:
        return
    kind, size = value.dtype.kind, value.ndim
    if kind not in "iufc" or (size != 2 and name in "KMG"):
        words = {"U": "texts", "S": "texts", "b": "an array of true and false"}
        found = words.get(kind, f"an array of {size} dimensions")
        raise InputError(
            f"{path}: {name} is {found}, but should be a table of numbers, of rows and columns.",
            where=where,
            value=str(path),
        )


def _real(matrix: Any) -> Any:
    """The matrix in real numbers: unsigned ones know no difference below zero."""
    return matrix.astype(float) if matrix.dtype.kind in "iu" else matrix


def to_matrices(body: ReducedBody) -> dict[str, Any]:
    """The matrices of which ``from_matrices`` makes the contents again; kinds as texts.

    Dofs are written with node numbers from 1 and components from 1, as in files of all programs.
    """
    found = {"K": body.stiffness, "M": body.mass, "NODES": body.nodes, "DOFS": labels_of(body)}
    if body.gyroscopic is not None:
        found["G"] = body.gyroscopic
    if body.numbers is not None:
        found["NUMBERS"] = body.numbers
    if body.shapes is not None:
        found["SHAPES"] = body.shapes.reshape(-1, body.size)
    if body.kind:
        found["KIND"] = np.array(body.kind)
    return {name: value for name, value in found.items() if value is not None}


def labels_of(body: ReducedBody) -> np.ndarray:
    """Node number and component from 1 (n, 2) of every coordinate; modal ones have numbers beyond
    those of the nodes, and component 0."""
    numbers = numbers_of(body)
    modal = body.dofs[:, 0] == MODAL
    beyond = numbers.max(initial=0) + np.cumsum(modal)
    node = np.where(modal, beyond, numbers[body.dofs[:, 0]] if len(numbers) else 0)
    return np.stack([node, np.where(modal, 0, body.dofs[:, 1] + 1)], axis=1)


def numbers_of(body: ReducedBody) -> np.ndarray:
    """Numbers (N,) of the nodes in a file: the body's own, else from 1."""
    return np.arange(1, len(body.nodes) + 1) if body.numbers is None else body.numbers


def kind_codes(kinds: tuple[str, ...]) -> np.ndarray:
    """Kinds as numbers (n,) for files of numbers alone; one that has none is "elastic"."""
    return np.array([KINDS.index(k if k in KINDS else "elastic") for k in kinds])


def _wide(matrix: Any, columns: int, name: str, path: Path, where: str) -> np.ndarray:
    """A dense matrix (m, columns); InputError for one of another width, whose numbers would stand
    in wrong rows."""
    found = _dense(matrix)
    if found.ndim > 1 and found.shape[-1] == columns:
        return found.reshape(-1, columns)
    shape = " x ".join(map(str, found.shape))
    turned = found.ndim == 2 and found.shape[0] == columns
    raise InputError(
        f"{path}: {name} is {shape}, but should have {columns} columns"
        f"{'; write it transposed' if turned else ''}.",
        where=where,
        value=shape,
    )


def _points(places: np.ndarray, numbers: Any | None, path: Path, where: str) -> FileNodes:
    if numbers is None:
        return FileNodes(numbers=np.arange(1, len(places) + 1), places=places)
    given = np.ravel(_whole(numbers, "NUMBERS", path, where))
    found, count = np.unique(given, return_counts=True)
    if len(given) != len(places) or (count > 1).any():
        twice = f", among them {listed(found[count > 1])} twice" if (count > 1).any() else ""
        raise InputError(
            f"{path}: NUMBERS has {len(given)} numbers{twice}, but should have one of its own for "
            f"each of the {len(places)} NODES.",
            where=where,
            value=str(path),
        )
    return FileNodes(numbers=given, places=places)


def _dense(matrix: Any) -> np.ndarray:
    return np.asarray(matrix.toarray() if hasattr(matrix, "toarray") else matrix)


def _whole(matrix: Any, name: str, path: Path, where: str) -> np.ndarray:
    values = _dense(matrix)
    found = np.rint(values).astype(np.int64)
    if (odd := values[found != values]).size:
        raise InputError(
            f"{path}: {name} has {odd.flat[0]:g}, but should have whole numbers.",
            where=where,
            value=float(odd.flat[0]),
        )
    return found


def _kinds(values: np.ndarray, path: Path, *, where: str) -> tuple[str, ...]:
    if values.dtype.kind in "US":
        return tuple(str(v) for v in values)
    codes = np.rint(values.astype(float)).astype(int)
    if len(codes) and not 0 <= codes.min() <= codes.max() < len(KINDS):
        raise InputError(
            f"{path} has a matrix KIND with numbers from {codes.min()} to {codes.max()}, but kinds "
            f"of coordinates are 0 to {len(KINDS) - 1}; leave it out.",
            where=where,
        )
    return tuple(KINDS[code] for code in codes)
