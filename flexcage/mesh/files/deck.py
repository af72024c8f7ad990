"""What an Abaqus or CalculiX deck says, as it is read line by line."""

from __future__ import annotations

from dataclasses import dataclass, field

from flexcage.mesh.files.keywords import Block
from flexcage.mesh.files.sets import Sets, key_of

NO_SHIFT = (0.0, 0.0, 0.0)


@dataclass
class DeckPart:
    """Nodes and elements of a part, an instance with a mesh of its own, or a deck without parts."""

    nodes: dict[int, list[float]] = field(default_factory=dict)
    elements: dict[int, tuple[str, list[int]]] = field(default_factory=dict)  # kind, node numbers
    others: dict[int, str] = field(default_factory=dict)  # elements of no use here: their type
    first: int = 0  # line

    @property
    def has_solids(self) -> bool:
        return any(kind.startswith("tetra") for kind, _ in self.elements.values())


@dataclass
class Deck:
    """What a deck says: parts, their instances, sets and surfaces."""

    parts: dict[str, DeckPart] = field(default_factory=dict)
    part_of: dict[str, str] = field(default_factory=dict)  # instance -> part
    moves: dict[str, Block] = field(default_factory=dict)  # instance -> its block
    elsets: Sets = field(default_factory=lambda: Sets("element"))
    nsets: Sets = field(default_factory=lambda: Sets("node"))
    surfaces: dict[tuple[str, str], list[Block]] = field(default_factory=dict)
    names: dict[str, str] = field(default_factory=dict)  # of parts, in their own capitals
    scope: str = ""
    shift: tuple[float, float, float] = NO_SHIFT  # of nodes, by *SYSTEM

    def here(self, block: Block) -> DeckPart:
        """The part that a block is of."""
        part = self.parts.setdefault(self.scope, DeckPart())
        part.first = part.first or block.line
        return part

    def owner(self, block: Block) -> str:
        """The part that a set's numbers are of: that of its instance, or where it stands."""
        instance = key_of(block.values.get("INSTANCE", ""))
        return self.part_of.get(instance, instance) if instance else self.scope

    def label(self, part: str) -> str:
        return f"'{self.names.get(part, part)}'" if part else "the deck itself"
