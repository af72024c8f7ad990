"""Sets of nodes or elements of a deck, by the part that they are of."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

from flexcage.mesh.files.keywords import Block, whole
from flexcage.mesh.files.raw import Refused

Member = tuple[str, int]  # part and number of a node or an element


@dataclass
class Sets:
    """Sets of one kind: of a scope (a part, or the assembly) and a name, what was put into them.

    A member is a number, or the name of another set; names may be used before they are given.
    """

    kind: str  # "node" or "element"
    found: dict[tuple[str, str], list[tuple[str, int | str, int]]] = field(default_factory=dict)
    written: dict[tuple[str, str], str] = field(default_factory=dict)  # in its own capitals

    def put(
        self, scope: str, part: str, name: str, members: Sequence[tuple[int | str, int]]
    ) -> None:
        """Add members (number or name, line) to a set, which belong to a part."""
        key = scope, key_of(name)
        self.written.setdefault(key, name)
        self.found.setdefault(key, []).extend((part, what, line) for what, line in members)

    def read(self, block: Block, scope: str, part: str) -> None:
        """Add what a block of data lines names; with GENERATE these are ranges."""
        name = block.values.get(block.keyword, "")
        if not name:
            raise Refused(f"line {block.line}: *{block.keyword} names no set")
        members: list[tuple[int | str, int]] = []
        for line, row in block.data():
            if "GENERATE" in block.values:
                members += [(number, line) for number in _range(row, line)]
            else:
                members += [(int(v) if v.isdigit() else v, line) for v in row if v]
        self.put(scope, part, name, members)

    def of(self, scope: str, name: str, line: int, parts: dict[str, str]) -> list[Member]:
        """Members of a set, or of one element or node; ``parts``: the part of every instance."""
        return list(dict.fromkeys(self._of(scope, scope, name, line, parts, ())))

    def _of(
        self, scope: str, part: str, name: str, line: int, parts: dict[str, str], seen: tuple
    ) -> Iterator[Member]:
        instance, dot, rest = name.rpartition(".")
        if (scope, key_of(name)) not in self.found and dot and key_of(instance) in parts:
            scope = part = parts[key_of(instance)]
            name = rest
        if name.isdigit():
            yield part, int(name)
            return
        key = scope, key_of(name)
        if key not in self.found or key in seen:
            raise Refused(
                f"line {line}: the {self.kind} set '{name}' is not in it"
                if key not in seen
                else f"line {line}: the {self.kind} set '{name}' holds itself"
            )
        for own, what, at in self.found[key]:
            if isinstance(what, int):
                yield own, what
            else:
                yield from self._of(scope, own, what, at, parts, (*seen, key))


def key_of(name: str) -> str:
    """Abaqus tells no capitals from small letters in names."""
    return name.lower()


def _range(row: list[str], line: int) -> range:
    first, *rest = (whole(v, line) for v in row if v)
    last, step = (*rest[:2], *(first, 1)[len(rest[:2]) :])
    if step == 0 or (last - first) * step < 0:
        raise Refused(f"line {line}: from {first} to {last} by {step} there is no number")
    return range(first, last + (1 if step > 0 else -1), step)
