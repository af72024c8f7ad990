"""A shaft as its run integrates it, and as the run's folder keeps it, to the last bit."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.machine.rotor import TurningShaft
from flexcage.results.commit import damaged
from flexcage.results.store import MemoryRunStore
from flexcage.system.shaft.data import Rotor
from flexcage.system.shaft.problem import OTHER_WAY

KEPT = "turning"  # attribute of the store
_SAME = 1e-4  # m: an end that is so near to a bearing or disc is one place with it
_TYPES = ("float64", "bool")


@dataclass(frozen=True, kw_only=True)
class Turning:
    """The arrays of a rotor's equations, where it begins, and how its named places move with it.

    A run that goes on takes them from its folder: modes that another computer finds differ in
    their signs.
    """

    rotor: Rotor
    pose: np.ndarray  # (5 + m,) coordinates at the start
    places: Mapping[str, float]  # [m] along the shaft
    moved: np.ndarray  # (places, 5, 5 + m) displacements there by the coordinates

    @property
    def sign(self) -> np.ndarray:
        """Signs (b, 5) of what is told in a bearing's axes."""
        return np.where(self.rotor.reversed[:, None], OTHER_WAY, 1.0)

    def to_table(self) -> dict[str, Any]:
        """Plain values, which JSON keeps to the last bit."""
        rotor = {f.name: _listed(getattr(self.rotor, f.name)) for f in fields(Rotor)}
        return {
            "rotor": rotor, "pose": _listed(self.pose), "places": dict(self.places),
            "moved": _listed(self.moved),
        }  # fmt: skip

    @classmethod
    def from_table(cls, table: Mapping[str, Any]) -> Turning:
        """What ``to_table`` was given; KeyError, TypeError or ValueError for anything else."""
        rotor = {f.name: _array(table["rotor"][f.name]) for f in fields(Rotor)}
        places = {str(name): float(x) for name, x in table["places"].items()}
        pose, moved = _array(table["pose"]), _array(table["moved"])
        return cls(rotor=Rotor(**rotor), pose=pose, places=places, moved=moved)


def turning_of(shaft: TurningShaft) -> Turning:
    """A shaft that has been brought into equilibrium."""
    places = _places(shaft)
    moved = np.array([shaft.at(x) for x in places.values()])
    return Turning(rotor=shaft.rotor(), pose=shaft.pose(), places=places, moved=moved)


def kept_turning(store: MemoryRunStore) -> Turning:
    """The shaft of a run, from the store of its rotor."""
    try:
        return Turning.from_table(store.layout.attrs[KEPT])
    except (KeyError, TypeError, ValueError) as error:
        raise damaged(Path(str(store.path)), "does not say what its shaft is") from error


def _places(shaft: TurningShaft) -> dict[str, float]:
    """Named places along the shaft [m]: bearings, discs, ends."""
    machine = shaft.machine
    found = {b.place.name: b.place.position for b in machine.bearings}
    for k, disc in enumerate(machine.shaft.discs):
        found[disc.name or f"disc {k}"] = disc.position
    for name, end in zip(("left end", "right end"), shaft.model.reach):
        if all(abs(end - place) > _SAME for place in found.values()):
            found[name] = end
    return found


def _listed(array: np.ndarray) -> dict[str, Any]:
    return {"type": str(array.dtype), "shape": list(array.shape), "values": array.ravel().tolist()}


def _array(table: Mapping[str, Any]) -> np.ndarray:
    if table["type"] not in _TYPES:
        raise ValueError(f"values of type '{table['type']}'")
    return np.array(table["values"], table["type"]).reshape(table["shape"])
