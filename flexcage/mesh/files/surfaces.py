"""Surfaces of a deck: faces of its tetrahedra and triangles, by *SURFACE or by element sets."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property, partial

from flexcage.mesh.files.deck import Deck, DeckPart
from flexcage.mesh.files.keywords import Block
from flexcage.mesh.files.raw import Refused, group_name, listed
from flexcage.mesh.files.sets import Member, key_of

# faces S1 to S4 of a tetrahedron (Abaqus Analysis User's Guide, 28.1.4), by its corners
FACES = {"S1": (0, 1, 2), "S2": (0, 3, 1), "S3": (1, 3, 2), "S4": (2, 3, 0)}
_SHELL_FACES = ("", "SPOS", "SNEG", "S1", "S2")
_HARMLESS = ("NAME", "TYPE", "INTERNAL", "COMBINE", "TRIM", "NO OFFSET", "NO THICK", "PROPERTY")

Corners = tuple[int, int, int]
Surface = dict[frozenset[int], Corners]


def surfaces_of(deck: Deck, part: str) -> tuple[Mapping[str, list[Corners]], Mapping[str, str]]:
    """Surfaces of a part by name, as node numbers of their triangles; and of other names that the
    file has, what they are. Raises ``Refused`` for a group that is not made of its faces."""
    made = _Maker(deck, part)
    found: dict[str, Surface] = {}
    others: dict[str, str] = {}
    for name, line, make in _named(deck, made):
        try:
            surface = make()
        except Refused as error:
            if group_name(name):
                raise
            others[name] = str(error)
            continue
        before = found.setdefault(name, surface)
        if before.keys() != surface.keys() and group_name(name):
            raise Refused(f"line {line}: it has two different surfaces named '{name}'")
    empty = {name: "an element set without triangles" for name, s in found.items() if not s}
    return {n: list(s.values()) for n, s in found.items() if s}, {**others, **empty}


def _named(deck: Deck, made: _Maker) -> Iterator[tuple[str, int, Callable[[], Surface]]]:
    """Name, line and maker of all surfaces, and of the element sets that share no surface's name,
    since the surface is meant."""
    for (scope, key), several in deck.surfaces.items():
        line = several[-1].line
        yield several[-1].values.get("NAME", ""), line, partial(made.surface, scope, key)
    taken = {key for _, key in deck.surfaces}
    for (scope, key), name in deck.elsets.written.items():
        if key not in taken:
            members = deck.elsets.found[scope, key]
            line = members[0][2] if members else 0
            yield name, line, partial(made.of_set, scope, key, name)


@dataclass
class _Maker:
    deck: Deck
    key: str  # of the part

    @property
    def part(self) -> DeckPart:
        return self.deck.parts[self.key]

    @cached_property
    def shared_faces(self) -> set[frozenset[int]]:
        """Corners of the faces that two tetrahedra share."""
        seen: set[frozenset[int]] = set()
        twice: set[frozenset[int]] = set()
        for kind, nodes in self.part.elements.values():
            for face in FACES.values() if kind.startswith("tetra") else ():
                corners = frozenset(nodes[i] for i in face)
                (twice if corners in seen else seen).add(corners)
        return twice

    def of_set(self, scope: str, key: str, name: str) -> Surface:
        """Triangles of an element set; none if it has no surface elements."""
        members = self.deck.elsets.of(scope, key, 0, self.deck.part_of)
        mine = [number for part, number in members if part == self.key]
        kinds = {n: self.part.elements[n][0] for n in mine if n in self.part.elements}
        flat = [n for n in mine if kinds.get(n, "").startswith("triangle")]
        rest = [n for n in mine if not kinds.get(n, "").startswith("triangle")]
        if rest and (flat or any(n in self.part.others for n in rest)) and group_name(name):
            what = self.part.others.get(rest[0]) or kinds.get(rest[0]) or "missing"
            raise Refused(
                f"the element set '{name}' holds elements that are no triangles, "
                f"{len(rest)} of {len(mine)} ({listed(rest)}: {what}); a surface "
                "has triangles alone"
            )
        found = (self.part.elements[n][1] for n in flat)
        return {frozenset(n[:3]): (n[0], n[1], n[2]) for n in found}

    def surface(self, scope: str, key: str, seen: tuple = ()) -> Surface:
        """Triangles of a surface, which may be made of others."""
        if (scope, key) in seen:
            raise Refused(f"the surface '{key}' is made of itself")
        found: Surface = {}
        for block in self.deck.surfaces[scope, key]:
            block.only(*_HARMLESS)
            kind = block.values.get("TYPE", "ELEMENT").upper()
            if kind != "ELEMENT":
                raise Refused(
                    f"line {block.line}: the surface '{block.values.get('NAME', '')}' is of TYPE="
                    f"{kind}, and only surfaces of element faces (TYPE=ELEMENT) are read"
                )
            if "COMBINE" in block.values:
                found |= self._combined(block, scope, (*seen, (scope, key)))
            else:
                found |= {frozenset(c): c for c in self._faces(block, scope)}
        return found

    def _combined(self, block: Block, scope: str, seen: tuple) -> Surface:
        parts: list[Surface] = []
        for line, row in block.data():
            for name in filter(None, row):
                instance, dot, plain = name.rpartition(".")
                own = self.deck.part_of.get(key_of(instance), scope) if dot else scope
                at = (scope, key_of(name))
                at = at if at in self.deck.surfaces else (own, key_of(plain))
                if at not in self.deck.surfaces:
                    raise Refused(f"line {line}: the surface '{name}' is not in it")
                parts.append(self.surface(*at, seen))
        how = block.values["COMBINE"].upper()
        first, rest = (parts or [{}])[0], parts[1:]
        if how == "UNION":
            return {k: v for part in parts for k, v in part.items()}
        if how == "INTERSECTION":
            return {k: v for k, v in first.items() if all(k in part for part in rest)}
        if how == "DIFFERENCE":
            return {k: v for k, v in first.items() if not any(k in part for part in rest)}
        raise Refused(f"line {block.line}: *SURFACE, COMBINE={how} is not followed")

    def _faces(self, block: Block, scope: str) -> Iterator[Corners]:
        for line, row in block.data():
            face = row[1].upper() if len(row) > 1 else ""
            members = self.deck.elsets.of(scope, row[0], line, self.deck.part_of)
            for member in members:
                yield from self._of(member, face, line)

    def _of(self, member: Member, face: str, line: int) -> Iterator[Corners]:
        """Triangles of an element; without a face's name those faces of a solid that no two
        share."""
        part, number = member
        if part != self.key and part in self.deck.parts:
            raise Refused(
                f"line {line}: a surface has elements of part {self.deck.label(part)}, which is "
                "not the one with the tetrahedra"
            )
        if number not in self.part.elements:
            other = self.part.others.get(number)
            raise Refused(
                f"line {line}: a surface names element {number}, which is "
                + (f"of type {other}, no tetrahedron or triangle" if other else "not in it")
            )
        kind, nodes = self.part.elements[number]
        if kind.startswith("triangle"):
            if face not in _SHELL_FACES:
                raise Refused(f"line {line}: a surface names '{face}' of a shell, which is an edge")
            yield nodes[0], nodes[1], nodes[2]
        elif face in FACES:
            a, b, c = FACES[face]
            yield nodes[a], nodes[b], nodes[c]
        elif not face:
            yield from self._free(nodes)
        else:
            raise Refused(
                f"line {line}: a surface names face '{face}' of a tetrahedron, which has none"
            )

    def _free(self, nodes: list[int]) -> Iterator[Corners]:
        for a, b, c in FACES.values():
            face = (nodes[a], nodes[b], nodes[c])
            if frozenset(face) not in self.shared_faces:
                yield face
