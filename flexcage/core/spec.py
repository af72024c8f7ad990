"""Fields of specs: frozen dataclasses whose physical values carry their unit in metadata.

Every room owns its specs; ``flexcage.case`` binds TOML text to them by reading this metadata,
so that a unit, a bound and a sentence of documentation are written once, beside the field.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Mapping, Sequence
from enum import Enum
from types import MappingProxyType
from typing import Any

MISSING = dataclasses.MISSING


class Presence(Enum):
    """Is another value there at all? Zero, an empty text or list, and None are not."""

    GIVEN = "given"
    ABSENT = "absent"


GIVEN, ABSENT = Presence.GIVEN, Presence.ABSENT


class OtherThan(tuple):
    """All values but these: those that a user registers may read what they like."""


#: By name of another value of the spec: the values, or the presence, with which a value is read.
#: All of a mapping must hold; of several mappings, one.
Condition = Mapping[str, "Collection[Any] | Presence"]
When = Condition | Sequence[Condition]


def quantity(
    unit: str,
    default: Any = MISSING,
    *,
    doc: str = "",
    minimum: float | None = None,
    above: float | None = None,
    maximum: float | None = None,
    assumption: str = "",
    of: Collection[str] = (),
    when: When = (),
    hashed: bool = True,
) -> Any:
    """A physical value held in SI; ``unit`` is the unit a person would write ("mm", "rpm").

    ``minimum`` and ``maximum`` are inclusive and ``above`` exclusive bounds, in SI.
    ``assumption`` says why a default that no source gives was chosen. ``of`` names those of the
    spec's laws (``law``) that read the value; without it all do. ``when`` says which other values
    of the spec make anything read this one (``When``). Not ``hashed``: hashes leave it out
    (``core.hashing``), for what follows from it counts by itself.
    """
    meta = {
        "unit": unit,
        "doc": doc,
        "minimum": minimum,
        "above": above,
        "maximum": maximum,
        "assumption": assumption,
        "of": of,
        "when": when,
        "hashed": hashed,
    }
    return dataclasses.field(default=default, metadata=meta)


def option(
    default: Any = MISSING,
    *,
    doc: str = "",
    choices: Collection[str] | None = None,
    minimum: float | None = None,
    maximum: float | None = None,
    assumption: str = "",
    of: Collection[str] = (),
    when: When = (),
    elsewhere: Mapping[str, str] = MappingProxyType({}),
    file: bool = False,
) -> Any:
    """A dimensionless value, count, flag or name; ``choices`` holds the names accepted.

    Choices that are a mapping may grow while the program runs (``core.registry``). It gives the
    spec that a name brings along with values of its own, a subclass of the one at hand, or None.
    ``assumption``, ``of`` and ``when`` as for ``quantity``. ``elsewhere`` maps patterns of names
    that are asked for here, and are not known, to what flexcage has instead. ``file``: the value is
    the path of a file, relative to the case's own, whose bytes count.
    """
    meta = {
        "doc": doc,
        "choices": choices,
        "minimum": minimum,
        "maximum": maximum,
        "assumption": assumption,
        "of": of,
        "when": when,
        "elsewhere": elsewhere,
        "file": file,
    }
    return dataclasses.field(default=default, metadata=meta)
