"""Bodies as Abaqus substructures (.mtx): a linear user element with its matrices.

Abaqus writes them with ``*SUBSTRUCTURE MATRIX OUTPUT, OUTPUT FILE=USER DEFINED, STIFFNESS=YES,
MASS=YES``: the element's nodes as a comment, its degrees of freedom, and the lower triangles row by
row (Abaqus Analysis User's Guide, User-defined elements). CalculiX has the same keyword, for
stiffness alone. Its version 2.20 writes the rows of the retained degrees of freedom as they were
assembled, without what the others yield: such a file is refused.

Where the nodes are stands in another deck (``nodes``). flexcage writes them into the same file as a
``*NODE`` block, and shapes and kinds, which a user element does not have, as comments that Abaqus
passes over.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from flexcage.core.arrays import Damaged
from flexcage.core.errors import InputError
from flexcage.mesh.files.abaqus import read_nodes
from flexcage.mesh.files.raw import lines_of, text_of
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.contents import Contents, FileNodes, labels_of, numbers_of, unreadable

_OWN = "** FLEXCAGE "  # begins the comments of ours
_CALCULIX, _HEAD = "** GENERATION OF SUBSTRUCTURE", 5  # among its first lines
_A_LINE = 4  # numbers of a matrix


def read(path: Path, *, where: str) -> Contents:
    """Stiffness, mass if it has one, and coordinates; nodes and shapes of a file of ours."""
    try:
        return _contents(path, where)
    except InputError:
        raise
    except (ValueError, IndexError, KeyError, OSError) as error:
        raise unreadable(path, error, where=where) from error


def _contents(path: Path, where: str) -> Contents:
    lines = lines_of(text_of(path))
    labels, matrices = _element(lines), dict(_matrices(lines))
    if labels is None:
        _refuse_entries(lines, path, where)
        raise Damaged("it has no *USER ELEMENT with its nodes")
    if "STIFFNESS" not in matrices:
        raise Damaged("it has no *MATRIX, TYPE=STIFFNESS")
    for name, matrix in matrices.items():
        if len(matrix) != len(labels):
            raise Damaged(
                f"its {name.lower()} has {len(matrix)} rows, its nodes {len(labels)} degrees of "
                "freedom"
            )
    if any(line.startswith(_CALCULIX) for line in lines[:_HEAD]):
        _refuse_assembled(labels, matrices["STIFFNESS"], path, where)
    numbers, places, sets = read_nodes(path)
    inside = np.isin(labels[:, 0], numbers)
    if len(numbers):
        labels = np.where(inside[:, None], labels, labels * [-1, 1])  # of no node in any deck
    own = dict(_own(lines))
    shapes = own.get("SHAPES")
    return Contents(
        stiffness=matrices["STIFFNESS"],
        mass=matrices.get("MASS"),
        labels=labels,
        points=FileNodes(numbers=numbers, places=places, sets=sets) if len(numbers) else None,
        shapes=None if shapes is None else np.array(shapes, float).reshape(-1, len(labels)),
        kind=tuple(own.get("KINDS", ())),
    )


def _refuse_entries(lines: list[str], path: Path, where: str) -> None:
    """Refuse files of single entries, which other commands write with the same ending."""
    first = next((line for line in lines if line.strip() and not line.startswith("**")), "")
    if first.startswith("%%MatrixMarket"):
        what = "a matrix in the Matrix Market format; read stiffness and mass by scipy.io.mmread"
    elif re.fullmatch(r"(\s*-?\d+\s*[,\s]){2,4}\s*[-+.\dDEde]+\s*,?\s*", first):
        what = (
            "the entries of one matrix, as Abaqus' *MATRIX OUTPUT writes them; write *SUBSTRUCTURE "
            "MATRIX OUTPUT, OUTPUT FILE=USER DEFINED in its place, or read stiffness and mass by "
            "numpy.loadtxt"
        )
    else:
        return
    raise InputError(
        f"{path} holds {what} and put them into an .npz as K and M, with NODES.",
        where=where,
        value=str(path),
    )


def _refuse_assembled(labels: np.ndarray, stiffness: np.ndarray, path: Path, where: str) -> None:
    """Refuse a stiffness without what the eliminated degrees of freedom yield: only there do two
    nodes that share no element have no force at all between them."""
    names, node = np.unique(labels[:, 0], return_inverse=True)
    first, second = np.nonzero(stiffness)
    coupled = np.zeros((len(names), len(names)), bool)
    coupled[node[first], node[second]] = True
    if not coupled.all():
        pairs = int((~coupled).sum()) // 2
        raise InputError(
            f"{path}: {pairs:,} pairs of the {len(names):,} nodes have no stiffness between them: "
            "CalculiX wrote the rows of the retained nodes as assembled, without what the other "
            "nodes yield, as its version 2.20 does; reduce the body with another program, or give "
            "the full matrices of all nodes as .npz.",
            where=where,
            value=pairs,
        )


def _element(lines: list[str]) -> np.ndarray | None:
    """Node number and component from 1 (n, 2) of every coordinate of the user element."""
    begin = next((i for i, line in enumerate(lines) if _keyword(line) == "USER ELEMENT"), None)
    if begin is None:
        return None
    nodes: list[int] = []
    rows: list[list[int]] = []
    for line in lines[begin + 1 :]:
        if line.startswith("**"):
            values = [v.strip() for v in line[2:].split(",")]
            if all(v.lstrip("-").isdigit() for v in values if v):
                nodes += [int(v) for v in values if v]
        elif line.startswith("*"):
            break
        elif line.strip():
            rows.append([int(v) for v in line.replace(",", " ").split()])
    if not nodes or not rows:
        return None
    # a row is (position of a node, components); the first row has the components alone, of node 1.
    # They hold up to the next row's node.
    begins = [(1, rows[0]), *((row[0], row[1:]) for row in rows[1:])]
    ends = [position for position, _ in begins[1:]] + [len(nodes) + 1]
    return np.array(
        [
            (nodes[at - 1], component)
            for (first, components), end in zip(begins, ends)
            for at in range(first, end)
            for component in components
        ],
        np.int64,
    ).reshape(-1, 2)


def _keyword(line: str) -> str:
    """Keyword of a line, in capitals; '' for comments and data."""
    if not line.startswith("*") or line.startswith("**"):
        return ""
    return " ".join(line[1:].split(",")[0].upper().split())


def _matrices(lines: list[str]) -> Iterator[tuple[str, np.ndarray]]:
    """Type and matrix (n, n) of every *MATRIX block, from its lower triangle."""
    begins = [i for i, line in enumerate(lines) if _keyword(line) == "MATRIX"]
    for begin in begins:
        words = [p.partition("=") for p in lines[begin].upper().split(",")[1:]]
        kind = next((v.strip() for k, _, v in words if k.strip() == "TYPE"), "")
        numbers: list[float] = []
        for line in lines[begin + 1 :]:
            if line.startswith("*"):
                if line.startswith("**"):
                    continue
                break
            numbers.extend(
                float(v) for v in line.upper().replace(",", " ").replace("D", "E").split()
            )
        size = int((np.sqrt(8.0 * len(numbers) + 1.0) - 1.0) / 2.0 + 0.5)
        if size * (size + 1) // 2 != len(numbers):
            raise Damaged(f"its {kind.lower()} has {len(numbers)} numbers, and is no triangle")
        matrix = np.zeros((size, size))
        matrix[np.tril_indices(size)] = numbers
        yield kind, matrix + np.tril(matrix, -1).T


def _own(lines: list[str]) -> Iterator[tuple[str, list[str]]]:
    """Name and values of the comments of ours; lines of one name go on."""
    found: dict[str, list[str]] = {}
    for line in lines:
        if line.startswith(_OWN):
            name, _, rest = line[len(_OWN) :].partition(",")
            found.setdefault(name.strip(), []).extend(v.strip() for v in rest.split(","))
    yield from found.items()


def write(body: ReducedBody, path: Path) -> None:
    """Write a body as a user element, with its nodes, and with shapes and kinds as comments."""
    stiffness, mass = body.dense()
    labels = labels_of(body)
    nodes = list(dict.fromkeys(labels[:, 0].tolist()))
    with path.open("w", encoding="ascii") as file:
        put = file.write
        put("** WRITTEN BY FLEXCAGE, IN M, KG, S\n*NODE\n")
        for number, place in zip(numbers_of(body), body.nodes):
            put(f"{number}, {', '.join(repr(float(c)) for c in place)}\n")
        put(f"*USER ELEMENT, NODES={len(nodes)}, LINEAR\n** ELEMENT NODES\n")
        for first in range(0, len(nodes), 10):
            put(f"** {', '.join(map(str, nodes[first : first + 10]))}\n")
        before: list[int] = []
        for position, node in enumerate(nodes, start=1):
            of_node = [max(int(c), 1) for c in labels[labels[:, 0] == node, 1]]
            if of_node != before:
                head = [] if position == 1 else [position]
                put(f"{', '.join(map(str, [*head, *of_node]))}\n")
            before = of_node
        for name, matrix in (("STIFFNESS", stiffness), ("MASS", mass)):
            if name == "STIFFNESS" or body.mass is not None:
                put(f"*MATRIX, TYPE={name}\n")
                for row in range(body.size):
                    put("".join(_in_lines(matrix[row, : row + 1])))
        if body.shapes is not None:
            for row_of in body.shapes.reshape(-1, body.size):
                put(f"{_OWN}SHAPES, {', '.join(repr(float(v)) for v in row_of)}\n")
        if body.kind:
            put(f"{_OWN}KINDS, {', '.join(body.kind)}\n")


def _in_lines(values: np.ndarray) -> Iterator[str]:
    for first in range(0, len(values), _A_LINE):
        yield f"{', '.join(repr(float(v)) for v in values[first : first + _A_LINE])},\n"
