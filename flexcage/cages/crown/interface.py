"""Contact interface of crown cages: stations round the pocket's wall and on the claws' tips.

The wall ends at the tips. A station beyond, in the opening, stands for the nearer tip: its weights
rise over one step of stations towards the tip's edge, so that between the last station on the claw
and the opening a ball on the tip's rim moves the tip. The one in the opening's middle is their
mean.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import asin, pi
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.cages.crown.cage import CrownCage
from flexcage.cages.crown.defects import CrownDefect
from flexcage.cages.round_pocket.interface import (
    BallCageInterface,
    ball_cage_interface,
    rigid_ball_interface,
    station_hats,
)
from flexcage.cages.round_pocket.shapes import PocketShapes
from flexcage.fem.model import FEModel
from flexcage.modes.interface import normalised
from flexcage.modes.pockets import pocket_frame
from flexcage.modes.reduction import CageReduction, Interfaces


def crown_weights(
    model: FEModel, stations: np.ndarray, shapes: PocketShapes, ends: np.ndarray
) -> sp.csr_matrix:
    """Weights (Z*n_st, N): station value <- nodal values, rows summing to one; walls end at
    x = ``ends`` (Z,) [m]."""
    count, rows = len(shapes.radius), []
    for pocket, radius in enumerate(shapes.radius):
        end = asin(ends[pocket] / radius)
        hats = _hats_in(pocket_frame(pocket, count), len(stations), end)
        rows.append(model.face_weights(model.group(f"pocket{pocket}_wall"), hats))
    return normalised(sp.vstack(rows), [f"pocket{k}_wall" for k in range(count)])


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


def rigid_crown_interface(
    cage: CrownCage, *, pocket_count: int, defects: Sequence[CrownDefect] = ()
) -> BallCageInterface:
    """Interface of a rigid cage: no modes, no compliance, no mesh."""
    made = rigid_ball_interface(cage, pocket_count=pocket_count, defects=defects)
    return _with_defects(made, cage, defects)


def _reduced(cage: CageReduction) -> BallCageInterface:
    ends = _open_at(cage.cage, cage.defects, cage.mesh.pocket_count)

    def weights(
        model: FEModel, stations: np.ndarray, shapes: PocketShapes, _: Any
    ) -> sp.csr_matrix:
        return crown_weights(model, stations, shapes, ends)

    made = ball_cage_interface(
        cage.model,
        cage.basis,
        pocket_count=cage.mesh.pocket_count,
        cage=cage.cage,
        defects=cage.defects,
        solver=cage.solver,
        weights_of=weights,
    )
    return _with_defects(made, cage.cage, cage.defects)


def _open_at(cage: CrownCage, defects: Sequence[CrownDefect], pocket_count: int) -> np.ndarray:
    """Places x (Z,) [m] at which the pockets' walls end."""
    ends = np.full(pocket_count, cage.tip)
    for defect in defects:
        defect.lower_walls(ends, cage)
    return ends


def _with_defects(
    made: BallCageInterface, cage: CrownCage, defects: Sequence[CrownDefect]
) -> BallCageInterface:
    """The interface with what defects moved of stations and tips; as it is if they moved none."""
    ends = _open_at(cage, defects, len(made.radius))
    offset = np.zeros(made.modes.shape[:3])
    for defect in defects:
        defect.move_stations(offset, made.stations, cage)
    return replace(
        made,
        offset=offset if offset.any() else None,
        open_at=ends if (ends < cage.tip).any() else None,
    )


def _depends_on(
    cage: CrownCage, defects: Sequence[CrownDefect], pocket_count: int
) -> tuple[Any, ...]:
    return cage, tuple(defects)


CROWN_INTERFACES: Interfaces[CrownCage] = Interfaces(
    kind=BallCageInterface, rigid=rigid_crown_interface, reduced=_reduced, depends_on=_depends_on
)
