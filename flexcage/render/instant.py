"""What pictures of a bearing draw of one instant."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

import numpy as np


@dataclass(frozen=True)
class Instant:
    """What is drawn of one instant."""

    time: float
    element: str  # in words
    position: np.ndarray  # (n, 3) x, r, psi
    tilt: np.ndarray  # (n, 2) skew, tilt; zero without an axis
    inner_load: np.ndarray  # (n,) N
    outer_load: np.ndarray
    # by name of faces, without a cage of neighbours: (n,) N
    pocket: Mapping[str, np.ndarray]
    # position (3,) and quaternion (4,), or those (cages, n) of one for each row
    cage: tuple[np.ndarray, np.ndarray] | None
    inner_position: np.ndarray
    inner_angle: float
    inner_speed: float
    carrier: str  # what goes round with the elements, in words, and its speed
    carrier_speed: float
    spots: Mapping[int, np.ndarray] = field(default_factory=dict)  # by element: direction (3,)

    @property
    def cages(self) -> tuple[np.ndarray, np.ndarray]:
        """Positions (cages, 3) and quaternions (cages, 4) of all cages."""
        place, quaternion = self.cage or (np.zeros((0, 3)), np.zeros((0, 4)))
        return np.atleast_2d(place), np.atleast_2d(quaternion)
