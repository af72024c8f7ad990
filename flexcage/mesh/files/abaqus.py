"""Reading the mesh of an Abaqus or CalculiX deck (.inp): one part of tetrahedra, its surfaces.

meshio reads neither ``*SURFACE, TYPE=ELEMENT`` nor six-node triangles of most names; gmsh no
surfaces. Keywords that change the mesh are followed or refused by name; those that say nothing of
it (``keywords.HARMLESS``) are passed over.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from math import cos, radians, sin
from pathlib import Path

import numpy as np

from flexcage.mesh.files.deck import NO_SHIFT, Deck, DeckPart
from flexcage.mesh.files.keywords import WRITTEN_OUT, Block, blocks, real, reals, refuse, whole
from flexcage.mesh.files.raw import RawMesh, Refused, listed, text_of
from flexcage.mesh.files.sets import key_of
from flexcage.mesh.files.surfaces import surfaces_of

_ASSEMBLY = "*"  # scope of what stands in the assembly itself
_TETRA = re.compile(r"(?:A|D|Q)?C3D(4|10)(?!\d)")
_SOLID = re.compile(r"(?:A|D|Q)?C3D|SC\d|CCL")
_SHELL = re.compile(r"(?:S|DS|STRI|R3D|M3D|SFM3D|F3D|CP[ESG]+|DC2D)(3|6|65)(?!\d)")


def read_deck(path: Path, *, nodes_alone: bool = False) -> Deck:
    """Read a deck; ``nodes_alone``: elements and surfaces are passed over. Raises ``Refused``."""
    deck = Deck()
    for block in blocks(text_of(path)):
        if block.keyword in ("ELEMENT", "ELSET", "SURFACE") and nodes_alone:
            continue
        if block.keyword == "TRANSFORM" and nodes_alone:
            raise Refused(
                f"line {block.line}: *TRANSFORM turns the directions in which nodes move, and is "
                "not followed; write the matrices in the common directions, without it"
            )
        if read := _KEYWORDS.get(block.keyword):
            read(deck, block)
        else:
            refuse(block)
    return deck


def _part(deck: Deck, block: Block) -> None:
    block.only("NAME")
    deck.scope = key_of(block.values.get("NAME", ""))
    deck.names[deck.scope], deck.shift = block.values.get("NAME", ""), NO_SHIFT


def _assembly(deck: Deck, block: Block) -> None:
    block.only("NAME")
    deck.scope = _ASSEMBLY


def _instance(deck: Deck, block: Block) -> None:
    block.only("NAME", "PART")
    name, part = (key_of(block.values.get(k, "")) for k in ("NAME", "PART"))
    deck.part_of[name], deck.moves[name] = part, block
    deck.scope = part  # nodes that stand in an instance are those of its part


def _end(deck: Deck, block: Block) -> None:
    deck.scope, deck.shift = _ASSEMBLY if block.keyword == "END INSTANCE" else "", NO_SHIFT


def _system(deck: Deck, block: Block) -> None:
    block.only()
    numbers = [real(v, line) for line, row in block.data() for v in row]
    if any(numbers[3:]):
        raise Refused(
            f"line {block.line}: *SYSTEM turns the axes of the nodes, and only its shifts are "
            f"followed; {WRITTEN_OUT}"
        )
    x, y, z, *_ = [*numbers, 0.0, 0.0, 0.0]
    deck.shift = (x, y, z)


def _nodes(deck: Deck, block: Block) -> None:
    block.only("NSET", "SYSTEM")
    system = block.values.get("SYSTEM", "R").upper()
    if system not in ("R", "C"):
        raise Refused(
            f"line {block.line}: *NODE, SYSTEM={system} is not followed; write x, y, z (R) or "
            "r, theta, z (C)"
        )
    known, numbers, (dx, dy, dz) = deck.here(block).nodes, [], deck.shift
    for line, row in block.data():
        number, (x, y, z) = whole(row[0], line), reals(row[1:], line, 3)
        if number in known:
            raise Refused(
                f"line {line}: it numbers nodes twice ({number}), as decks of several parts do; "
                "write one part"
            )
        if system == "C":
            x, y = x * cos(radians(y)), x * sin(radians(y))
        known[number] = [x + dx, y + dy, z + dz]
        numbers.append((number, line))
    if "NSET" in block.values:
        deck.nsets.put(deck.scope, deck.scope, block.values["NSET"], numbers)


def _elements(deck: Deck, block: Block) -> None:
    block.only("TYPE", "ELSET")
    name = block.values.get("TYPE", "").upper()
    tetra, shell = _TETRA.match(name), _SHELL.match(name)
    part = deck.here(block)
    if not tetra and not shell:
        if _SOLID.match(name):
            raise Refused(
                f"line {block.line}: it has elements of type {name}; only tetrahedra are read"
            )
        rows = [(int(row[0]), line) for line, row in block.data() if row[0].isdigit()]
        part.others.update((number, name) for number, _ in rows)
    else:
        size = {"4": 4, "10": 10, "3": 3, "6": 6, "65": 6}[(tetra or shell).group(1)]  # type: ignore
        rows = _add(part, block, f"{'tetra' if tetra else 'triangle'}{size}", size, name)
    if "ELSET" in block.values:
        deck.elsets.put(deck.scope, deck.scope, block.values["ELSET"], rows)


def _add(part: DeckPart, block: Block, kind: str, size: int, name: str) -> list[tuple[int, int]]:
    """Add elements, each of which may take several lines; their numbers and lines."""
    added, line, begun = [], block.line, []
    for line, row in block.data():
        begun += [whole(v, line) for v in row if v]
        if len(begun) <= size:
            continue
        if len(begun) > size + 1:
            break
        number, *nodes = begun
        if number in part.elements or number in part.others:
            raise Refused(
                f"line {line}: it numbers elements twice ({number}), as decks of several parts do; "
                "write one part"
            )
        part.elements[number], begun = (kind, nodes), []
        added.append((number, line))
    if begun:
        raise Refused(f"line {line}: element {begun[0]} of type {name} has other than {size} nodes")
    return added


def _elset(deck: Deck, block: Block) -> None:
    block.only("ELSET", "GENERATE", "INTERNAL", "UNSORTED", "INSTANCE")
    deck.elsets.read(block, deck.scope, deck.owner(block))


def _nset(deck: Deck, block: Block) -> None:
    if "ELSET" not in block.values:  # nodes of elements: no surface needs them
        block.only("NSET", "GENERATE", "INTERNAL", "UNSORTED", "INSTANCE")
        deck.nsets.read(block, deck.scope, deck.owner(block))


def _surface(deck: Deck, block: Block) -> None:
    name = block.values.get("NAME", "")
    deck.surfaces.setdefault((deck.scope, key_of(name)), []).append(block)


_KEYWORDS: dict[str, Callable[[Deck, Block], None]] = {
    "PART": _part, "END PART": _end, "ASSEMBLY": _assembly, "END ASSEMBLY": _end,
    "INSTANCE": _instance, "END INSTANCE": _end, "SYSTEM": _system, "NODE": _nodes,
    "ELEMENT": _elements, "ELSET": _elset, "NSET": _nset, "SURFACE": _surface,
}  # fmt: skip


def read_inp(path: Path) -> RawMesh:
    """The mesh of a deck: the one part of tetrahedra, where its instance puts it. Raises
    ``Refused``."""
    deck = read_deck(path)
    own = _with_solids(deck)
    part = deck.parts.get(own, DeckPart())
    place = {number: i for i, number in enumerate(part.nodes)}
    used = {n for _, nodes in part.elements.values() for n in nodes}
    if lacking := sorted(used - place.keys()):
        raise Refused(f"its elements have node {listed(lacking)}, which is not in it")
    points = np.array(list(part.nodes.values()), float).reshape(-1, 3)
    kinds = {"tetra4", "tetra10"} & {kind for kind, _ in part.elements.values()}
    members = {
        kind: [e for e, (k, _) in part.elements.items() if k == kind] for kind in sorted(kinds)
    }
    surfaces, no_surfaces = surfaces_of(deck, own)
    return RawMesh(
        points=_placed(points, deck, own),
        solids=tuple(
            np.array([[place[n] for n in part.elements[e][1]] for e in numbers])
            for numbers in members.values()
        ),
        surfaces={
            name: np.array([[place[n] for n in corners] for corners in found], int).reshape(-1, 3)
            for name, found in surfaces.items()
        },
        point_numbers=np.array(list(part.nodes), np.int64),
        solid_numbers=np.array([e for numbers in members.values() for e in numbers], np.int64),
        no_surfaces=no_surfaces,
    )


def _with_solids(deck: Deck) -> str:
    """The one part that has tetrahedra; '' if none has any."""
    solid = [key for key, part in deck.parts.items() if part.has_solids]
    if len(solid) > 1:
        first, second = (deck.label(key) for key in solid[:2])
        raise Refused(
            f"line {deck.parts[solid[1]].first}: {second} has tetrahedra as {first} has; write the "
            "cage as one part, alone"
        )
    return solid[0] if solid else ""


def read_nodes(path: Path) -> tuple[np.ndarray, np.ndarray, dict[str, np.ndarray]]:
    """Nodes of a deck, whatever its elements: numbers (N,), places (N, 3), and node sets by name.

    Raises ``Refused``.
    """
    deck = read_deck(path, nodes_alone=True)
    nodes: dict[int, np.ndarray] = {}
    for key, part in deck.parts.items():
        places = np.array(list(part.nodes.values()), float).reshape(-1, 3)
        if nodes.keys() & part.nodes.keys():
            raise Refused(
                f"line {part.first}: it numbers nodes twice, as decks of several parts do; write "
                "one part"
            )
        nodes.update(zip(part.nodes, _placed(places, deck, key)))
    whole_ = np.array(list(nodes.values()), float).reshape(-1, 3)
    sets: dict[str, np.ndarray] = {}
    for scope, name in deck.nsets.found:
        members = deck.nsets.of(scope, name, 0, deck.part_of)
        sets[name] = np.array([number for _, number in members], np.int64)
    return np.array(list(nodes), np.int64), whole_, sets


def _placed(points: np.ndarray, deck: Deck, part: str) -> np.ndarray:
    """Points (n, 3) of a part where its instance puts them: shifted, then turned about an axis."""
    mine = [block for name, block in deck.moves.items() if deck.part_of[name] == part]
    if len(mine) > 1:
        raise Refused(
            f"line {mine[1].line}: part {deck.label(part)} stands in {len(mine)} instances; write "
            "one"
        )
    if not mine or not mine[0].rows:
        return points
    from scipy.spatial.transform import Rotation

    rows = [reals(row, line, 7) for line, row in mine[0].data()]
    points = points + rows[0][:3]
    if len(rows) > 1:
        start, end, angle = np.array(rows[1][:3]), np.array(rows[1][3:6]), rows[1][6]
        along = end - start
        if angle and not along.any():
            raise Refused(f"line {mine[0].lines[1]}: the axis that it turns about has no length")
        unit = along / (np.linalg.norm(along) or 1.0)
        points = Rotation.from_rotvec(np.deg2rad(angle) * unit).apply(points - start) + start
    return points
