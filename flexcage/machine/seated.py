"""A bearing in its place on a machine's shaft."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from flexcage.case.static import StaticCase
from flexcage.machine.spec import BearingPlace


@dataclass(frozen=True, kw_only=True)
class SeatedBearing:
    """A bearing in its place: ``case`` is what it is, with its fits, housing and lubricant; the
    case's own load is not read."""

    place: BearingPlace
    case: StaticCase
    # tables of that case as they were read, cage and all, and the folder of their paths: for a run
    table: Mapping[str, Any] = field(default_factory=dict, compare=False)
    folder: Path | None = field(default=None, compare=False)
