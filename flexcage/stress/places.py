"""Named places of a cage at which stress is followed, and the zones that a peak leaves out."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.fem.model import FEModel

if TYPE_CHECKING:
    from flexcage.stress.fillets import Fillet, Keeping

Vertices = np.ndarray


@dataclass(frozen=True)
class PlaceKind:
    """What the places at which a cage's stress is followed are called."""

    one: str
    many: str
    short: str  # many of them, in few words
    walls: str  # what the search for a peak leaves out, in few words
    left_out: str  # the same, exactly: see ``StressPlaces``


def no_fillets(model: FEModel, interface: Any, pocket_count: int, keep: Keeping) -> list[Fillet]:
    """Of pockets without corners."""
    return []


@dataclass(frozen=True, kw_only=True)
class StressPlaces:
    """Where the stress of the cages of a type is followed, from their model and number of pockets.

    ``roots``: vertices of every named place ("pocket3_..."). ``contact_zone``: vertices of the
    pockets' walls, less their edges or fillets. There the spread contact force acts; the stress
    right under it is that of the contact law, not of the mesh, so peaks leave these vertices out:
    all of them at all times, wherever the contacts are. ``fillets``: submodels of corners.
    """

    roots: Callable[[FEModel, int], dict[str, Vertices]]
    contact_zone: Callable[[FEModel, int], Vertices]
    kind: PlaceKind
    fillets: Callable[[FEModel, Any, int, Keeping], list[Fillet]] = no_fillets


def in_words(name: str) -> str:
    """A place's name as a reader wants it: "pocket5_root_rear+x" is pocket 5, corner rear +x."""
    pocket, _, place = name.partition("_")
    place = place.replace("root_", "corner ").replace("_", " ")
    place = place.replace("+x", " +x").replace("-x", " -x")
    return f"{pocket.replace('pocket', 'pocket ')}, {place}" if place else name
