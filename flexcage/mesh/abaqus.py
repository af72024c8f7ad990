"""Reading the mesh of an Abaqus deck (.inp): nodes, elements, element sets and surfaces.

meshio reads neither ``*SURFACE, TYPE=ELEMENT`` nor six-node triangles of most names; gmsh no
surfaces. What concerns no mesh (materials, steps, beams, springs) is ignored.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

# faces S1 to S4 of a tetrahedron (Abaqus Analysis User's Guide, 28.1.4), by its corners
_FACES = {"S1": (0, 1, 2), "S2": (0, 3, 1), "S3": (1, 3, 2), "S4": (2, 3, 0)}
_SHELLS = ("S3", "S6", "STRI", "R3D3", "M3D3", "M3D6", "SFM3D3", "SFM3D6", "CP", "DS3", "DS6")
_COUNTS = {"tetra": 4, "tetra10": 10, "triangle": 3, "triangle6": 6}


@dataclass
class _Deck:
    """What was read so far; elements and nodes by their numbers in the file."""

    nodes: dict[int, list[float]] = field(default_factory=dict)
    elements: dict[int, tuple[str, list[int]]] = field(default_factory=dict)  # kind, node numbers
    sets: dict[str, list[int]] = field(default_factory=dict)
    written: dict[str, str] = field(default_factory=dict)  # names of sets, in their own capitals
    surfaces: dict[str, list[tuple[str, str]]] = field(default_factory=dict)  # set or element, face

    @cached_property
    def shared_faces(self) -> set[frozenset[int]]:
        """Corners of the faces that two tetrahedra share."""
        seen: set[frozenset[int]] = set()
        twice: set[frozenset[int]] = set()
        for kind, nodes in self.elements.values():
            for face in _FACES.values() if kind.startswith("tetra") else ():
                corners = frozenset(nodes[i] for i in face)
                (twice if corners in seen else seen).add(corners)
        return twice

    def set_named(self, name: str) -> list[int]:
        """The set of this name, to be filled."""
        self.written.setdefault(_key(name), name)
        return self.sets.setdefault(_key(name), [])

    def elements_of(self, name: str) -> list[int]:
        """Numbers of the elements of a set, or of one element."""
        if name.isdigit():
            return [int(name)]
        if _key(name) not in self.sets:
            raise ValueError(f"the element set '{name}' is not in it")
        return self.sets[_key(name)]


def read_inp(path: Path) -> Any:
    """meshio's mesh of a deck: blocks of tetrahedra and triangles, and ``cell_sets`` of triangles.

    A surface is one more block of triangles, faces of its elements. Raises ValueError.
    """
    deck, inside = _Deck(), ""
    for keyword, values, rows in _blocks(path.read_text("utf-8-sig", errors="replace")):
        if keyword in ("PART", "ASSEMBLY", "INSTANCE"):
            inside = keyword
            if any(float(v) for row in rows for v in row):
                raise ValueError("it moves an instance; write the mesh where it is")
        elif keyword.startswith("END"):
            inside = "ASSEMBLY" if keyword == "END INSTANCE" else ""
        elif keyword in ("NODE", "ELEMENT") and inside == "ASSEMBLY":
            continue  # reference points and what hangs on them
        elif keyword == "NODE":
            _add(deck.nodes, {int(row[0]): [float(x) for x in row[1:4]] for row in rows}, "nodes")
        elif keyword == "ELEMENT":
            _add_elements(deck, values, rows)
        elif keyword == "ELSET":
            _add_set(deck, values, rows)
        elif keyword == "SURFACE" and values.get("TYPE", "ELEMENT").upper() == "ELEMENT":
            pairs = [(row[0], row[1].upper() if len(row) > 1 else "") for row in rows if row]
            deck.surfaces.setdefault(values.get("NAME", ""), []).extend(pairs)
    return _mesh(deck)


def read_nodes(path: Path) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """Nodes of a deck, whatever its elements: numbers (N,), places (N, 3), and node sets by name.

    Raises ValueError.
    """
    nodes: dict[int, list[float]] = {}
    sets: dict[str, list[int]] = {}
    for keyword, values, rows in _blocks(path.read_text("utf-8-sig", errors="replace")):
        if keyword == "NODE":
            places = {int(row[0]): [float(x or 0.0) for x in row[1:4]] for row in rows}
            _add(nodes, places, "nodes")
            numbers = list(places)
        elif keyword == "NSET":
            numbers = _numbers(rows, generate="GENERATE" in values, sets=sets)
        else:
            continue
        if "NSET" in values:
            sets.setdefault(_key(values["NSET"]), []).extend(numbers)
    whole = np.array(list(nodes.values()), float).reshape(-1, 3)
    return np.array(list(nodes), np.int64), whole, {k: np.array(v) for k, v in sets.items()}


def _numbers(
    rows: list[list[str]], *, generate: bool, sets: dict[str, list[int]] | None = None
) -> list[int]:
    """Node numbers of a set's data lines; names of other sets stand for what is in these."""
    found: list[int] = []
    for row in rows:
        if generate:
            first, last, *by = (int(v) for v in row if v)
            found.extend(range(first, last + 1, by[0] if by else 1))
        else:
            for name in filter(None, row):
                found.extend([int(name)] if name.isdigit() else (sets or {})[_key(name)])
    return found


def _blocks(text: str) -> Iterator[tuple[str, dict[str, str], list[list[str]]]]:
    """Keyword, its parameters and the values of its data lines, block by block."""
    keyword, begun = "", ""
    values: dict[str, str] = {}
    rows: list[list[str]] = []
    for raw in text.splitlines():
        line = raw.strip()
        if not line or line.startswith("**"):
            continue
        if begun or line.startswith("*"):
            begun += line
            if begun.endswith(","):  # goes on in the next line
                continue
            if keyword:
                yield keyword, values, rows
            head, *parameters = begun[1:].split(",")
            pairs = [p.partition("=") for p in parameters]
            values = {k.strip().upper(): v.strip().strip("\"'") for k, _, v in pairs}
            keyword, rows, begun = " ".join(head.upper().split()), [], ""
        else:
            rows.append([v.strip().strip("\"'") for v in line.rstrip(",").split(",")])
    if keyword:
        yield keyword, values, rows


def _key(name: str) -> str:
    """Abaqus tells no capitals from small letters in names."""
    return name.lower()


def _add(known: dict[int, Any], more: dict[int, Any], what: str) -> None:
    if known.keys() & more.keys():
        raise ValueError(f"it numbers {what} twice, as decks of several parts do; write one part")
    known.update(more)


def _add_elements(deck: _Deck, values: dict[str, str], rows: list[list[str]]) -> None:
    name = values.get("TYPE", "").upper()
    if name.startswith("C3D4") or name.startswith("C3D10"):
        kind = "tetra" if name.startswith("C3D4") else "tetra10"
    elif name.startswith(_SHELLS) and any(c in name for c in "36"):
        kind = "triangle6" if "6" in name else "triangle"
    elif name.startswith(("C3D", "SC")):
        raise ValueError(f"it has elements of type {name}; only tetrahedra are read")
    else:
        return
    numbers = [int(v) for row in rows for v in row if v]  # an element may take several lines
    size = _COUNTS[kind] + 1
    if len(numbers) % size:
        raise ValueError(f"elements of type {name} have other than {size - 1} nodes")
    lines = np.array(numbers).reshape(-1, size).tolist()
    _add(deck.elements, {line[0]: (kind, line[1:]) for line in lines}, "elements")
    if "ELSET" in values:
        deck.set_named(values["ELSET"]).extend(line[0] for line in lines)


def _add_set(deck: _Deck, values: dict[str, str], rows: list[list[str]]) -> None:
    found = deck.set_named(values.get("ELSET", ""))
    for row in rows:
        if "GENERATE" in values:
            first, last, *by = (int(v) for v in row if v)
            found.extend(range(first, last + 1, by[0] if by else 1))
        else:
            for name in filter(None, row):
                found.extend(deck.elements_of(name.rpartition(".")[2]))


def _mesh(deck: _Deck) -> Any:
    import meshio

    place = {number: i for i, number in enumerate(deck.nodes)}
    used = {n for _, nodes in deck.elements.values() for n in nodes}
    if lacking := used - place.keys():
        raise ValueError(f"its elements have node {min(lacking)}, which is not in it")
    members: dict[str, list[int]] = {kind: [] for kind in _COUNTS}
    for number, (kind, _) in deck.elements.items():
        members[kind].append(number)
    kinds = [kind for kind in _COUNTS if members[kind]]
    cells = [
        (kind, np.array([[place[n] for n in deck.elements[e][1]] for e in members[kind]]))
        for kind in kinds
    ]
    row = {e: i for kind in kinds for i, e in enumerate(members[kind])}
    chosen: dict[str, dict[int, np.ndarray]] = {}
    faces = {_key(name) for name in deck.surfaces}
    for name, elements in deck.sets.items():
        if name not in faces:  # a surface of the same name is what is meant
            chosen[deck.written[name]] = {
                i: np.array([row[e] for e in elements if deck.elements.get(e, ("",))[0] == kind])
                for i, kind in enumerate(kinds)
            }
    for name, pairs in deck.surfaces.items():
        triangles = list(dict.fromkeys(_triangles(deck, pairs)))
        chosen[name] = {len(cells): np.arange(len(triangles))}
        corners = [[place[n] for n in triangle] for triangle in triangles]
        cells.append(("triangle", np.array(corners, int).reshape(-1, 3)))
    sets = {
        name: [blocks.get(i, np.empty(0, int)).astype(int) for i in range(len(cells))]
        for name, blocks in chosen.items()
    }
    points = np.array(list(deck.nodes.values()), float).reshape(-1, 3)
    return meshio.Mesh(points, cells, cell_sets=sets)


def _triangles(deck: _Deck, pairs: list[tuple[str, str]]) -> Iterator[tuple[int, int, int]]:
    """Node numbers of the triangles of a surface's elements; without a face's name those faces of
    solids that no two share."""
    for name, face in pairs:
        for number in deck.elements_of(name.rpartition(".")[2]):
            if number not in deck.elements:
                raise ValueError(f"a surface names element {number}, which is not in it")
            kind, nodes = deck.elements[number]
            if kind.startswith("triangle"):
                yield nodes[0], nodes[1], nodes[2]
            elif face in _FACES:
                a, b, c = _FACES[face]
                yield nodes[a], nodes[b], nodes[c]
            elif not face:
                yield from _free_faces(deck, nodes)
            else:
                raise ValueError(f"a surface names face '{face}' of a tetrahedron, which has none")


def _free_faces(deck: _Deck, nodes: list[int]) -> Iterator[tuple[int, int, int]]:
    shared = deck.shared_faces
    for a, b, c in _FACES.values():
        face = (nodes[a], nodes[b], nodes[c])
        if frozenset(face) not in shared:
            yield face
