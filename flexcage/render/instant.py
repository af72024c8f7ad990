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
    pocket: Mapping[str, np.ndarray]  # by name of faces: (n,) N
    cage_position: np.ndarray
    cage_quaternion: np.ndarray
    inner_position: np.ndarray
    inner_angle: float
    inner_speed: float
    cage_speed: float
    spots: Mapping[int, np.ndarray] = field(default_factory=dict)  # by element: direction (3,)
