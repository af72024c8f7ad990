"""What a cage type is: one value, composed of what each floor asks for."""

from __future__ import annotations

from dataclasses import dataclass
from typing import cast

from flexcage.core.wings import CAGE_TYPES
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import CageDefect


@dataclass(frozen=True, kw_only=True)
class CageType:
    """Cages of one make: ``spec`` has their dimensions and checks.

    All else is heavy: functions that import what they call.
    """

    name: str
    spec: type[Cage]
    defects: tuple[type[CageDefect], ...] = ()
    defect_spec: type[CageDefect] = CageDefect  # what its mesh wants of each


def cage_type_of(cage: Cage) -> CageType:
    """The type of a cage."""
    return cast(CageType, CAGE_TYPES[cage.cage_type])
