"""What all bearing types share: the name by which a case asks for one.

A type is a spec of its own, one file each in this room. It names itself here, and supplies its
parts by being registered with the functions that want them: ``checks.check_geometry``,
``catalogue.static_rating``, ``catalogue.dynamic_rating``, ``catalogue.equivalent_load`` and
``system.statics.elements.elements_of``.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar, TypeVar

from flexcage.core.registry import add
from flexcage.core.spec import option

Spec = type  # by another name, for inside the spec ``type`` is a field

BEARING_TYPES: dict[str, type | None] = {}  # name in a case: spec


@dataclass(frozen=True, kw_only=True)
class Bearing:
    """A rolling bearing; ``type`` names the spec that describes it."""

    # in words for sentences and titles, and the spec of the cage that goes with it
    kind: ClassVar[str] = "bearing"
    cage_spec: ClassVar[Spec]
    in_motion: ClassVar[bool] = False  # are there equations of motion for this type?

    type: str = option("cylindrical_roller", doc="type of bearing", choices=BEARING_TYPES)
    designation: str = option("", doc="name in a catalogue")

    @property
    def is_thrust(self) -> bool:
        """Do ISO 76 and ISO 281 rate it for axial load?"""
        return False


AnyBearing = TypeVar("AnyBearing", bound=type[Bearing])


def bearing_type(cls: AnyBearing) -> AnyBearing:
    """Register a spec, as a decorator, under the default of its own ``type``."""
    add(BEARING_TYPES, str(cls.__dataclass_fields__["type"].default), cls, what="bearing type")
    return cls
