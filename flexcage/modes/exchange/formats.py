"""Import and export: a body from a file, whatever its format, in SI; and a body into a file.

A format is one line of ``FORMATS``.
"""

from __future__ import annotations

import importlib
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.core.binding import path_of
from flexcage.core.errors import InputError, unwritable
from flexcage.core.missing import no_file
from flexcage.core.writing import written
from flexcage.mesh.files.others import PACKED, known_reason
from flexcage.modes.exchange.body import MODAL, ReducedBody
from flexcage.modes.exchange.checks import check_body
from flexcage.modes.exchange.contents import Contents, FileNodes
from flexcage.modes.exchange.modal import check_named, check_usual, usual_dofs
from flexcage.modes.exchange.nodes import read_points
from flexcage.modes.exchange.systems import SI, SYSTEMS, System, coordinate_units

FORMATS = {".npz": "npz", ".op4": "op4", ".pch": "punch", ".mtx": "mtx"}
#: Formats that are asked for and cannot be read: what to write in their place.
_REFUSED = {
    ".mnf": "is a modal neutral file, whose format is closed; write the same reduction from its "
    "program as matrices in place of the MNF: Nastran's EXTSEOUT(DMIGPCH) or an OUTPUT4 file "
    "(.pch, .op4), Abaqus' *SUBSTRUCTURE MATRIX OUTPUT (.mtx), or arrays K, M, NODES, SHAPES "
    "(.npz)",
    ".cdb": "is an Ansys mesh without matrices; name it as mesh.file or as body_nodes, and give "
    "the matrices as .npz (scipy.io.mmread reads what APDL's *EXPORT,,MMF writes)",
    ".sub": "is an Ansys substructure in binary; export its matrices in APDL with "
    "*SMAT,...,IMPORT,SUB and *EXPORT,,MMF, and put them into an .npz with scipy.io.mmread",
}
_REFUSED[".full"] = _REFUSED[".sub"].replace("substructure", "matrix file").replace("SUB", "FULL")
_ARRAYS = "arrays K, M, NODES and SHAPES or DOFS by numpy.savez (.npz)"
_DMIG = "Nastran's EXTSEOUT(DMIGPCH) or an OUTPUT4 file (.pch, .op4)"
_REFUSED |= {
    ".mat": f"is of MATLAB; read it by scipy.io.loadmat, and write {_ARRAYS}",
    ".op2": f"is Nastran's OUTPUT2 in binary; write {_DMIG} in its place",
    ".csv": f"is a table; write {_ARRAYS}",
    **dict.fromkeys((".npy", ".txt", ".h5", ".hdf5"), f"is not read; write {_ARRAYS}"),
    **dict.fromkeys((".uff", ".unv", ".uf"), "is a universal file, whose datasets hold modes or "
                    f"responses and no stiffness; write {_ARRAYS}"),
    **dict.fromkeys((".sim", ".odb", ".fil"), "is Abaqus' own database; write *SUBSTRUCTURE MATRIX "
                    "OUTPUT, OUTPUT FILE=USER DEFINED (.mtx)"),
    **dict.fromkeys((".rst", ".db", ".cms", ".rfl"), _REFUSED[".sub"].replace("substructure",
                    "database")),
    **dict.fromkeys((".bdf", ".nas", ".dat", ".asm"), "is a Nastran deck; name it as body_nodes, "
                    f"and give the matrices by {_DMIG}"),
    ".inp": "is an Abaqus deck; name it as body_nodes, and give the matrices by *SUBSTRUCTURE "
    "MATRIX OUTPUT, OUTPUT FILE=USER DEFINED (.mtx)",
    **PACKED,
}  # fmt: skip


def read_body(
    path: str | Path, *, nodes: str | Path = "", units: str = SI, where: str = "body"
) -> ReducedBody:
    """The body in a file, in SI and checked (``checks``).

    ``nodes``: a deck that says where its nodes are, for files that do not (.bdf, .dat, .inp, .cdb).
    ``units`` of both. InputError, which names ``where``, for what is no body.
    """
    path = path_of(path, where)
    ending = path.suffix.lower()
    if ending not in FORMATS:
        none = f"is no file of a reduced body that can be read: {', '.join(FORMATS)}"
        raise InputError(f"{known_reason(path, _REFUSED, none)}.", where=where, value=str(path))
    if units not in SYSTEMS:
        raise InputError(
            f"{where}_units is {units!r}, and systems of units are {', '.join(SYSTEMS)}.",
            where=f"{where}_units",
            value=units,
        )
    if not path.is_file():
        raise InputError(f"{no_file('file', path)}.", where=where, value=str(path))
    contents = _module(ending).read(path, where=where)
    points = read_points(Path(nodes), where=f"{where}_nodes") if str(nodes) else contents.points
    body = _in_si(_body(contents, points, path, where), SYSTEMS[units])
    check_body(body, where=where)
    return body


def write_body(body: ReducedBody, path: str | Path, **options: Any) -> Path:
    """Write a body in the format of the path's ending, in SI; returns the path.

    ``binary`` False writes an .op4 as text.
    """
    path = path_of(path, "path")
    if path.suffix.lower() not in FORMATS:
        raise InputError(
            f"'{path}' should end in {' or '.join(FORMATS)}.", where="out", value=str(path)
        )
    try:
        with written(path) as temporary:
            _module(path.suffix.lower()).write(body, temporary, **options)
    except OSError as error:
        raise unwritable(f"The body '{path}'", error, path=path) from error
    return path


def _module(ending: str) -> Any:
    return importlib.import_module(f"flexcage.modes.exchange.{FORMATS[ending]}")


def _body(contents: Contents, points: FileNodes | None, path: Path, where: str) -> ReducedBody:
    """The body in the file's own units, coordinates by node."""
    if points is None:
        raise InputError(
            f"{path} does not say where its nodes are; name a deck with them (.bdf, .dat, .inp, "
            f".cdb) as {where}_nodes.",
            where=f"{where}_nodes",
        )
    size = contents.stiffness.shape[0]
    _check_shapes(contents, points, path, where)
    labels = contents.labels
    if labels is None:
        reduced = contents.shapes is not None
        dofs = usual_dofs(contents.stiffness, len(points.numbers), reduced=reduced)
        check_usual(contents.stiffness, dofs, np.sort(points.numbers), path, where)
        order = np.append(np.argsort(points.numbers, kind="stable"), MODAL)  # in rising order
        dofs[:, 0] = order[dofs[:, 0]]
    else:
        _check_from_one(labels, points.numbers, path, where)
        dofs = _by_place(labels, points.numbers)
        check_named(contents.stiffness, dofs, labels, path, where)
    _refuse_same(dofs, points.numbers, path, where)
    place = {int(n): i for i, n in enumerate(points.numbers)}
    sets = {name: np.array([place[n] for n in v if n in place]) for name, v in points.sets.items()}
    stiffness, mass, gyroscopic = contents.stiffness, contents.mass, contents.gyroscopic
    if points.frames is not None:
        turn = _turn(dofs, points.frames, path, where)
        stiffness = turn.T @ stiffness @ turn
        mass = None if mass is None else turn.T @ mass @ turn
        gyroscopic = None if gyroscopic is None else turn.T @ gyroscopic @ turn
    shapes = contents.shapes
    if shapes is not None and shapes.shape[0] == 6 * len(points.numbers):
        shapes = shapes.reshape(-1, 6, size)[:, :3]
    return ReducedBody(
        stiffness=stiffness,
        mass=mass,
        gyroscopic=gyroscopic,
        nodes=np.asarray(points.places, float),
        dofs=dofs,
        shapes=None if shapes is None else np.array(shapes, float).reshape(-1, 3, size),
        kind=contents.kind,
        cells=points.cells,
        interface=MappingProxyType(sets),
        numbers=np.asarray(points.numbers),
        source=str(path),
    )


def _refuse_same(dofs: np.ndarray, numbers: np.ndarray, path: Path, where: str) -> None:
    """Refuse two coordinates that are one component of one node."""
    found, count = np.unique(dofs[dofs[:, 0] != MODAL], axis=0, return_counts=True)
    if (count > 1).any():
        node, component = found[np.argmax(count > 1)]
        raise InputError(
            f"{path}: {count.max()} of its coordinates are component {component + 1} of node "
            f"{numbers[node]}; each component of a node is one coordinate.",
            where=where,
            value=int(numbers[node]),
        )


def _check_from_one(labels: np.ndarray, numbers: np.ndarray, path: Path, where: str) -> None:
    """Refuse labels that count nodes or components from 0, as arrays of Python do."""
    of_nodes = np.isin(labels[:, 0], numbers)
    zero = of_nodes & (labels[:, 1] == 0)
    grid = labels[:, 1] > 0  # no modal coordinate
    both = grid & np.isin(labels[:, 0], labels[zero, 0])
    low = both if (numbers == 0).any() else grid & (labels[:, 0] == 0)
    for wrong, what in ((both, "components"), (low, "nodes")):
        if wrong.any():
            raise InputError(
                f"{path}: its coordinates (DOFS) count {what} from 0; count both from 1, "
                "and give modal coordinates the component 0.",
                where=where,
                value=int(wrong.sum()),
            )
    if labels[:, 1].min(initial=0) < 0 or labels[:, 1].max(initial=0) > 6:
        odd = int(labels[np.argmax(np.abs(labels[:, 1] - 3)), 1])
        raise InputError(
            f"{path}: its coordinates (DOFS) have the component {odd}, but components are 1 to 6, "
            "and 0 for modal coordinates.",
            where=where,
            value=odd,
        )


def _check_shapes(contents: Contents, points: FileNodes, path: Path, where: str) -> None:
    n, count = contents.stiffness.shape[0], len(points.numbers)
    wanted = {
        "stiffness": (contents.stiffness, (n, n)),
        "mass": (contents.mass, (n, n)),
        "gyroscopic": (contents.gyroscopic, (n, n)),
        "shapes": (contents.shapes, (_rows(contents, count), n)),
        "dofs": (contents.labels, (n, 2)),
    }
    for name, (matrix, shape) in wanted.items():
        if matrix is not None and matrix.shape != shape:
            raise InputError(
                f"{path}: {name} is {' x '.join(map(str, matrix.shape))}, but with {n} "
                f"coordinates and {count} nodes it should be {' x '.join(map(str, shape))}.",
                where=where,
            )
    if contents.kind and len(contents.kind) != n:
        raise InputError(
            f"{path} names the kinds of {len(contents.kind)} coordinates, but has {n}.", where=where
        )


def _rows(contents: Contents, count: int) -> int:
    """Rows of shapes: three a node, or six if there are rotations."""
    with_turns = contents.shapes is not None and contents.shapes.shape[0] == 6 * count
    return 6 * count if with_turns else 3 * count


def _turn(dofs: np.ndarray, frames: np.ndarray, path: Path, where: str) -> sp.csr_matrix:
    """Matrix (n, n) that takes coordinates along the common axes to those of the nodes' frames."""
    place = {(int(n), int(c)): j for j, (n, c) in enumerate(dofs) if n != MODAL}
    rows, columns, values = [], [], []
    for (node, component), j in place.items():
        first = 3 * (component // 3)
        for axis in range(3):
            value = frames[node, component - first, axis]
            if abs(value) > 1e-14:
                if (node, first + axis) not in place:
                    raise InputError(
                        f"{path}: node {node + 1} moves in a coordinate system of its own, but has "
                        "not all three coordinates there; write its matrices in the common one.",
                        where=where,
                    )
                rows.append(j)
                columns.append(place[node, first + axis])
                values.append(value)
    modal = np.flatnonzero(dofs[:, 0] == MODAL)
    indices = (
        np.concatenate([rows, modal]).astype(int),
        np.concatenate([columns, modal]).astype(int),
    )
    entries = np.concatenate([values, np.ones(len(modal))])
    return sp.csr_matrix((entries, indices), shape=(len(dofs),) * 2)


def _by_place(labels: np.ndarray, numbers: np.ndarray) -> np.ndarray:
    """(node, component) from node numbers and components from 1; a number that is no node's, or the
    component 0, is of a modal coordinate."""
    order = np.argsort(numbers)
    at = np.clip(np.searchsorted(numbers, labels[:, 0], sorter=order), 0, len(numbers) - 1)
    node = order[at]
    known = (numbers[node] == labels[:, 0]) & (labels[:, 1] > 0)
    found = np.stack([node, labels[:, 1] - 1], axis=1)
    return np.where(known[:, None], found, [MODAL, 0])


def _in_si(body: ReducedBody, system: System) -> ReducedBody:
    """The same in SI. Energies q^T K q/2 and q'^T M q'/2 keep their values."""
    if system == SYSTEMS[SI]:
        return body
    unit = coordinate_units(body.dofs, system)
    per = sp.diags_array(1.0 / unit)
    shapes, inertia = body.shapes, system.mass * system.length**2
    moving = {name: getattr(body, name) for name in ("mass", "gyroscopic")}
    return ReducedBody(
        **{
            **{name: getattr(body, name) for name in body.__dataclass_fields__},
            "stiffness": system.energy * _scaled(body.stiffness, per),
            **{k: None if m is None else inertia * _scaled(m, per) for k, m in moving.items()},
            "nodes": system.length * body.nodes,
            "shapes": None if shapes is None else system.length * shapes / unit,
        }
    )


def _scaled(matrix: Any, per: sp.dia_array) -> Any:
    return per @ matrix @ per
