"""Fields of specs: frozen dataclasses whose physical values carry their unit in metadata.

Every room owns its specs; ``flexcage.case`` binds TOML text to them by reading this metadata,
so that a unit, a bound and a sentence of documentation are written once, beside the field.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Collection, Mapping
from types import MappingProxyType
from typing import Any

MISSING = dataclasses.MISSING


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
    legacy: Any = MISSING,
) -> Any:
    """A physical value held in SI; ``unit`` is the unit a person would write ("mm", "rpm").

    ``minimum`` and ``maximum`` are inclusive and ``above`` exclusive bounds, in SI.
    ``assumption`` says why a default that no source gives was chosen. ``of`` names those of the
    spec's laws (``law``) that read the value; without it all do. ``legacy`` as for ``option``.
    """
    meta = {
        "unit": unit,
        "doc": doc,
        "minimum": minimum,
        "above": above,
        "maximum": maximum,
        "assumption": assumption,
        "of": of,
        "legacy": legacy,
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
    legacy: Any = MISSING,
    elsewhere: Mapping[str, str] = MappingProxyType({}),
    file: bool = False,
) -> Any:
    """A dimensionless value, count, flag or name; ``choices`` holds the names accepted.

    Choices that are a mapping may grow while the program runs (``core.registry``). It gives the
    spec that a name brings along with values of its own, a subclass of the one at hand, or None.
    ``assumption`` and ``of`` as for ``quantity``. ``legacy`` is for an option that is added
    later: what was done before, which leaves the hashes of specs as they were
    (``core.hashing``). ``elsewhere`` maps patterns of names that are asked for here, and are not
    known, to what flexcage has instead. ``file``: the value is the path of a file, relative to the
    case's own, whose bytes count.
    """
    meta = {
        "doc": doc,
        "choices": choices,
        "minimum": minimum,
        "maximum": maximum,
        "assumption": assumption,
        "of": of,
        "legacy": legacy,
        "elsewhere": elsewhere,
        "file": file,
    }
    return dataclasses.field(default=default, metadata=meta)
