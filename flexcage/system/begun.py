"""What a family's start gives and takes: the state in which a run begins, the static solution."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from flexcage.system.statics.solution import StaticSolution

StaticStart = Callable[[], StaticSolution]
Advance = Callable[[float], None]  # called with the share of the work that is done


@dataclass(frozen=True)
class Start:
    """Where a run begins: y and y', and what the assembly of the bearing took."""

    y: np.ndarray
    yd: np.ndarray
    pinched: tuple[int, ...]  # pockets that hold their roller with force
    pinch_force: float  # largest [N]
    residual: float  # of the equilibrium, as a share of the load
    station: np.ndarray  # (Z, 4, nst, 3) station forces on the cage
    warnings: tuple[str, ...] = ()  # of the static solution, sentences
