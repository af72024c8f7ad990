"""Systems of units that files of other programs are in: what one unit of each is in SI."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.core.body_file import SYSTEM_NAMES
from flexcage.modes.exchange.body import MODAL


@dataclass(frozen=True)
class System:
    """Units of length [m], mass [kg] and time [s]."""

    length: float
    mass: float
    time: float

    @property
    def energy(self) -> float:
        return self.mass * self.length**2 / self.time**2


SI = SYSTEM_NAMES[0]
#: By name. The inch is 25.4 mm; 1 lbf s^2/in is 4.4482216152605 N over 25.4 mm/s^2.
SYSTEMS = dict(
    zip(
        SYSTEM_NAMES,
        (
            System(1.0, 1.0, 1.0),
            System(1e-3, 1e3, 1.0),
            System(1e-3, 1.0, 1e-3),
            System(25.4e-3, 4.4482216152605 / 25.4e-3, 1.0),
        ),
        strict=True,
    )
)


def coordinate_units(dofs: np.ndarray, system: System) -> np.ndarray:
    """Unit (n,) of each coordinate in SI: of length for translations, none for rotations and for
    modal coordinates, whose scale is the file's own."""
    moves = (dofs[:, 0] != MODAL) & (dofs[:, 1] < 3)
    return np.where(moves, system.length, 1.0)


def nearest_system(length: float, *, within: float = 0.1) -> str:
    """The system whose unit of length [m] is ``length``, to ``within`` of itself; '' for none."""
    fits = [n for n, s in SYSTEMS.items() if abs(length / s.length - 1.0) < within]
    return fits[0] if fits else ""


def system_of(length: float, mass: float, *, within: float = 0.2) -> str:
    """The system whose units of length [m] and mass [kg] these are about; '' for none."""
    for name, system in SYSTEMS.items():
        if max(abs(length / system.length - 1.0), abs(mass / system.mass - 1.0)) < within:
            return name
    return ""
