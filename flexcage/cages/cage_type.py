"""What a cage type is: one value, composed of what each floor asks for."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Generic, TypeVar

from flexcage.core.errors import InputError
from flexcage.core.registry import note_source
from flexcage.core.wings import CAGE_TYPES
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import CageDefect, note_listed

if TYPE_CHECKING:
    from flexcage.geometry.inference import CageProposal
    from flexcage.mesh.build import MeshBuilder
    from flexcage.modes.reduction import Interfaces
    from flexcage.stress.places import StressPlaces

C = TypeVar("C", bound=Cage)


@dataclass(frozen=True, kw_only=True)
class CageType(Generic[C]):
    """Cages of one make: ``spec`` has their dimensions and checks, and ``holds`` names the elements
    that they hold (``element`` of a bearing).

    All else is heavy: functions without arguments that import what they return.
    """

    name: str
    spec: type[C]
    holds: tuple[str, ...]
    mesh: Callable[[], MeshBuilder[C]]
    interfaces: Callable[[], Interfaces[C]]
    places: Callable[[], StressPlaces]  # at which stress is followed
    proposal: Callable[[], CageProposal] | None  # a cage for ``flexcage new``; None: no rule
    defects: tuple[type[CageDefect], ...] = ()
    defect_spec: type[CageDefect] = CageDefect  # what its mesh needs of each
    # do halves of its mesh meet in one grid (``mesh.joint``) where ``joint=True`` asks for it?
    joins: bool = False

    def __post_init__(self) -> None:
        if self.spec.cage_type != self.name:
            raise InputError(
                f"The spec of cage type '{self.name}', {self.spec.__name__}, has the cage_type "
                f"'{self.spec.cage_type}'; give both the same name.",
                where="cage_type",
                value=self.spec.cage_type,
            )


def cage_type_of(cage: Cage) -> CageType[Any]:
    """The type of a cage; InputError for what is no cage of a known type."""
    name = getattr(cage, "cage_type", "")
    if name not in CAGE_TYPES:
        raise InputError(
            f"A {type(cage).__name__} is no cage of a known type; cage types are "
            f"{', '.join(CAGE_TYPES)}.",
            where="cage",
        )
    return CAGE_TYPES[name]


def riveted_cages() -> tuple[str, str]:
    """Cage types that rivets hold together: in words, and as a case chooses them."""
    names = [name for name, made in CAGE_TYPES.items() if made.spec.riveted]
    chosen = " or ".join(f"'{name}'" for name in names)
    return f"{' and '.join(names)} cages", f"cage.type = {chosen}"


def proposal_of(name: str) -> CageProposal:
    """What proposes a cage of a type, by its name; InputError where nothing does."""
    made = CAGE_TYPES.get(name)
    if made is None or made.proposal is None:
        raise InputError(
            f"No dimensions are proposed for a cage of type '{name}'; describe it in a case.",
            where="cage.type",
            value=name,
        )
    return made.proposal()


def register_cage_type(made: CageType[Any]) -> CageType[Any]:
    """Add a cage type of your own, and return it; InputError if its name is taken.

    ``type`` of its spec chooses it in a case (``geometry.cage.cages_of``). Hashes of cases with
    such a cage change with the file that defines the spec, and with those of its own defects.
    """
    note_listed(made.defects)
    CAGE_TYPES.add(made)
    note_source(made.name, made.spec)
    return made
