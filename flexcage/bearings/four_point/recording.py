"""What runs of four-point contact bearings record beside what those of balls do."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from flexcage.bearings.ball.recording import RECORDING as BALLS
from flexcage.bearings.ball.recording import overlaps
from flexcage.bearings.ball.variables import VARIABLES as OF_BALLS
from flexcage.bearings.four_point.model import FourPointModel
from flexcage.bearings.four_point.residual import INNER, INNER_OTHER, OUTER, OUTER_OTHER
from flexcage.integrate.recording import Recording
from flexcage.results.registry import sampled
from flexcage.system.layout import Layout
from flexcage.system.problem import BearingSystem

_SIDES = [[INNER, INNER_OTHER], [OUTER_OTHER, OUTER]]  # ribs of the arcs at -x and +x, by race

VARIABLES = replace(
    OF_BALLS,
    variables=(
        *OF_BALLS.variables,
        sampled(
            "arc_force", "N",
            "force on a ball from each arc of a race; a single arc's stands where an inner ring "
            "pushed towards +x presses: at -x of the inner race, at +x of the outer",
            "element", "race", "arc",
        ),
    ),
    labels={**OF_BALLS.labels, "arc": ("-x", "+x")},
)  # fmt: skip


def _variables(bearing: BearingSystem, y: np.ndarray) -> dict[str, np.ndarray]:
    ribs = bearing.data.samples.rib[: len(y)]
    return {**BALLS.variables(bearing, y), "arc_force": ribs[:, :, np.array(_SIDES)]}


def _overlaps(model: FourPointModel, layout: Layout, y: np.ndarray) -> np.ndarray:
    """As those of balls, each arc a place of its own behind the next ball."""
    first, other = (overlaps(model.balls(other=other), layout, y) for other in (False, True))
    behind = 3 + int(layout.has_cage)
    arcs = np.stack([first[..., 0], other[..., 0], first[..., 1], other[..., 1]], axis=-1)
    races = np.maximum(first[..., :2], other[..., :2])
    return np.concatenate([races, first[..., 2:behind], arcs, first[..., behind:]], axis=-1)


_BALLS: Recording[Any] = BALLS
RECORDING: Recording[Any] = replace(_BALLS, variables=_variables, overlaps=_overlaps)
