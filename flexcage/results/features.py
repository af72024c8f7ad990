"""Kinds of cage motion: a few pure numbers that tell them apart, and a class.

An own choice. S. Schwarz and others (Tribology Transactions 65 (2022) 12) sort motions into
"stable", "circling" and "unstable" by quadratic discriminant analysis of a Cage Dynamics Indicator.
Neither its definition nor the boundaries were at hand: only the names of the classes are theirs.
"""

from __future__ import annotations

from dataclasses import astuple, dataclass
from typing import TYPE_CHECKING

import numpy as np

from flexcage.results import metrics

if TYPE_CHECKING:
    import xarray


STABLE, CIRCLING, UNSTABLE = "stable", "circling", "unstable"
# assumptions: where classes part
MOST_SPREAD = 0.2  # of a centre that stands, over its distance from the axis
MOST_PACE = 0.3  # of a centre that creeps, over that of a whirl with the cage
MOST_RIPPLE = 0.2  # of the radius of a circle
LEAST_ORDER = 0.8  # of the turns round a circle


@dataclass(frozen=True)
class OrbitClass:
    """How the cage's centre moves about the ring's axis [1], and the ``kind`` of that.

    ``spread``: root mean square of its distance from its mean place, over that from the axis;
    ``pace``: the same of its speed, over that of going round the axis with the cage; ``ripple``:
    standard deviation over mean of the distance from its mean place; ``order``: net turns about
    its mean place over all turns there and back.
    """

    spread: float
    pace: float
    ripple: float
    order: float

    @property
    def kind(self) -> str:
        """ "stable": it stands or creeps; "circling": it goes round at an even radius in one
        direction; "unstable": else."""
        if self.spread <= MOST_SPREAD or self.pace <= MOST_PACE:
            return STABLE
        round_it = self.ripple <= MOST_RIPPLE and self.order >= LEAST_ORDER
        return CIRCLING if round_it else UNSTABLE


def orbit_class(ds: xarray.Dataset) -> OrbitClass | None:
    """Class of a run's motion, of its settled part; None for less than one turn of the cage, and
    for a centre that stays on the axis."""
    turned = np.ptp(metrics.carrier_angle(ds))
    place, t = metrics.orbit(ds), ds["time"].values
    far = _rms(place)
    if turned < 2.0 * np.pi or far == 0.0:
        return None
    off = place - place.mean(axis=0)
    distance = np.hypot(*off.T)
    turns = np.diff(np.unwrap(np.arctan2(off[:, 1], off[:, 0])))
    speed = _rms(np.gradient(place, t, axis=0))
    return OrbitClass(
        spread=_rms(off) / far,
        pace=speed * float(t[-1] - t[0]) / (turned * far),
        ripple=float(distance.std() / distance.mean()) if distance.any() else 0.0,
        order=float(abs(turns.sum()) / np.abs(turns).sum()) if turns.any() else 0.0,
    )


def _rms(vectors: np.ndarray) -> float:
    """Root mean square of the lengths of vectors (n, 2)."""
    return float(np.sqrt(np.mean(np.sum(vectors**2, axis=1))))


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
