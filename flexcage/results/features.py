"""A few pure numbers that tell kinds of cage motion apart, for sorting many runs.

An own choice: it is not the Cage Dynamics Indicator of S. Schwarz and others (Tribology
Transactions 65 (2022) 12), whose exact definition was not at hand, though it looks at like things.
"""

from __future__ import annotations

from dataclasses import astuple, dataclass
from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class CageMotionFeatures:
    """Features of a cage's motion [1], all of them figures of the summary by the same name.

    ``velocity_deviation``: standard deviation over mean of its centre's speed, at the samples;
    ``whirl_speed_ratio``: net turns of the centre about the ring's axis over the cage's, over whole
    turns of the cage; ``pocket_force_ratio``: largest over mean force while in contact. NaN where
    a feature has no meaning: a centre at rest, pockets without contact.
    """

    velocity_deviation: float
    whirl_speed_ratio: float
    pocket_force_ratio: float

    @property
    def vector(self) -> np.ndarray:
        """The features (3,) in the order above."""
        return np.array(astuple(self))


def cage_motion_features(ds: xarray.Dataset) -> CageMotionFeatures:
    """Features of a run's dataset, or of its settled part."""
    return CageMotionFeatures(
        metrics.velocity_deviation(ds),
        metrics.whirl(metrics.whole_revolutions(ds), about="axis").speed_ratio,
        metrics.pocket_forces(ds).ratio,
    )
