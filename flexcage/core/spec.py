"""Fields of specs: frozen dataclasses whose physical values carry their unit in metadata.

Every room owns its specs; ``flexcage.case`` binds TOML text to them by reading this metadata,
so that a unit, a bound and a sentence of documentation are written once, beside the field.
"""

from __future__ import annotations

import dataclasses
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
) -> Any:
    """A physical value held in SI; ``unit`` is the unit a person would write ("mm", "rpm").

    ``minimum`` and ``maximum`` are inclusive and ``above`` exclusive bounds, in SI.
    ``assumption`` says why a default that no source gives was chosen.
    """
    meta = {
        "unit": unit,
        "doc": doc,
        "minimum": minimum,
        "above": above,
        "maximum": maximum,
        "assumption": assumption,
    }
    return dataclasses.field(default=default, metadata=meta)


def option(
    default: Any = MISSING,
    *,
    doc: str = "",
    choices: tuple[str, ...] | None = None,
    minimum: float | None = None,
    maximum: float | None = None,
    assumption: str = "",
) -> Any:
    """A dimensionless value, count, flag or name; ``choices`` lists the names accepted."""
    meta = {
        "doc": doc,
        "choices": choices,
        "minimum": minimum,
        "maximum": maximum,
        "assumption": assumption,
    }
    return dataclasses.field(default=default, metadata=meta)
