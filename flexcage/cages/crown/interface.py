"""Contact interface of crown cages: stations round the pocket's wall and on the claws' tips.

The wall ends at the tips. A station beyond, in the opening, stands for the nearer tip: its weights
rise over one step of stations towards the tip's edge, so that between the last station on the claw
and the opening a ball on the tip's rim moves the tip. The one in the opening's middle is their
mean.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from math import asin, pi
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.cages.crown.cage import CrownCage
from flexcage.cages.machined.defects import BallCageDefect, PocketShapes
from flexcage.cages.machined.interface import (
    BallCageInterface,
    ball_cage_interface,
    rigid_ball_interface,
    station_hats,
)
from flexcage.fem.model import FEModel
from flexcage.modes.interface import normalised
from flexcage.modes.pockets import pocket_frame
from flexcage.modes.reduction import CageReduction, Interfaces


def crown_weights(
    model: FEModel, stations: np.ndarray, shapes: PocketShapes, cage: CrownCage
) -> sp.csr_matrix:
    """Weights (Z*n_st, N): station value <- nodal values, rows summing to one."""
    count, rows = len(shapes.radius), []
    for pocket, radius in enumerate(shapes.radius):
        end = asin(cage.tip / radius)
        hats = _hats_in(pocket_frame(pocket, count), len(stations), end)
        rows.append(model.face_weights(model.group(f"pocket{pocket}_wall"), hats))
    return normalised(sp.vstack(rows))


def _hats_in(frame: np.ndarray, count: int, end: float) -> Callable[[np.ndarray], np.ndarray]:
    def hats(points: np.ndarray) -> np.ndarray:
        x, _, t = frame @ points.T
        return station_weights(np.arctan2(x, t), count, end)

    return hats


def station_weights(angles: np.ndarray, count: int, end: float) -> np.ndarray:
    """Weights (count, n) of stations at angles (n,) [rad] of a wall that ends at ``end`` on the
    front claw, and at pi - end on the rear one."""
    weights = station_hats(angles, count)
    step, cosine = 2.0 * pi / count, np.cos(angles)
    height = np.arctan2(np.sin(angles), np.abs(cosine))  # of either claw, from its bar
    tip = np.clip(1.0 - (end - height) / step, 0.0, 1.0)
    front, rear = np.where(cosine > 0.0, tip, 0.0), np.where(cosine > 0.0, 0.0, tip)
    for k in range(count):
        side = np.cos(k * step)
        if end < k * step < pi - end:
            middle = abs(side) < 1e-9
            weights[k] = front + rear if middle else front if side > 0.0 else rear
    return weights


def _reduced(cage: CageReduction) -> BallCageInterface:
    return ball_cage_interface(
        cage.model,
        cage.basis,
        pocket_count=cage.mesh.pocket_count,
        cage=cage.cage,
        defects=cage.defects,
        solver=cage.solver,
        weights_of=crown_weights,
    )


def _depends_on(
    cage: CrownCage, defects: Sequence[BallCageDefect], pocket_count: int
) -> tuple[Any, ...]:
    return cage, tuple(defects)


CROWN_INTERFACES: Interfaces[CrownCage] = Interfaces(
    kind=BallCageInterface, rigid=rigid_ball_interface, reduced=_reduced, depends_on=_depends_on
)
