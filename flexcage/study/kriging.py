"""Kriging with noise: a Gaussian process through the points of a study.

scikit-learn's (the extra ``surface``), imported when first needed. The covariance is Matern's of
smoothness 5/2 with a length an axis, plus noise of one variance; lengths, size and noise by maximum
likelihood (C. E. Rasmussen and C. K. I. Williams, Gaussian Processes for Machine Learning, 2006,
chapters 2 and 5). Axes are scaled to -1 ... 1. What the likelihood leaves open of the lengths is
not in the intervals.
"""

from __future__ import annotations

import importlib.util
import warnings
from dataclasses import dataclass
from math import log, pi
from typing import Any

import numpy as np
from scipy.stats import chi2, norm

from flexcage.core.errors import package_lacks
from flexcage.study.quadratic import CONFIDENCE

_LENGTHS = (0.1, 20.0)  # half the box is 1
_STARTS = 4  # of the search for the likelihood's maximum, beside the first
_DRAWS = 4000  # surfaces drawn for the region of confidence
_JITTER = 1e-10


def require_sklearn() -> None:
    """Raise EnvironmentLacks, which says what to install, unless scikit-learn is there."""
    if importlib.util.find_spec("sklearn") is None:
        raise package_lacks(
            "Kriging is done", "scikit-learn", extra="surface",
            instead=", or leave Kriging out with  --model quadratic",
        )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Kriging:
    """The fitted process; ``noise`` is the variance of single values about the surface.

    ``level`` is the probability that noise about a constant is made as much more likely by chance
    (a likelihood ratio, its logarithm twice against chi squared with a degree an axis and one).
    """

    process: Any
    noise: float
    size: float  # by which values were divided
    lengths: np.ndarray  # (d,) correlation lengths, half the box being 1
    level: float

    def mean(self, z: np.ndarray) -> np.ndarray:
        """Values (n,) of the surface at scaled places (n, d)."""
        return np.asarray(self.process.predict(z))

    def half(self, z: np.ndarray) -> np.ndarray:
        """Half widths (n,) of the 95 % intervals of the surface, its noise not included."""
        variance = np.diag(self._covariance(z)[1])
        return float(norm.ppf(0.5 + 0.5 * CONFIDENCE)) * np.sqrt(np.maximum(variance, 0.0))

    def _covariance(self, z: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        mean, covariance = self.process.predict(z, return_cov=True)
        return mean, covariance - self.noise * np.eye(len(z))

    def least_in(self, places: np.ndarray, seed: int = 0) -> np.ndarray:
        """The smallest set of places (n, d), as (n,) of bool, that holds the least value of 95 % of
        the surfaces drawn from the process given the points."""
        mean, covariance = self._covariance(places)
        values, vectors = np.linalg.eigh(covariance)
        root = vectors * np.sqrt(np.maximum(values, _JITTER * max(values[-1], 0.0)))
        drawn = np.random.default_rng(seed).standard_normal((len(places), _DRAWS))
        least = np.argmin(mean[:, None] + root @ drawn, axis=0)
        share = np.bincount(least, minlength=len(places)) / _DRAWS
        order = np.argsort(-share, kind="stable")
        enough = int(np.searchsorted(np.cumsum(share[order]), CONFIDENCE)) + 1
        found = np.zeros(len(places), bool)
        found[order[:enough]] = True
        return found


def fit_kriging(z: np.ndarray, y: np.ndarray) -> Kriging:
    """The process that makes values (n,) at scaled places (n, d) most likely."""
    require_sklearn()
    from sklearn.exceptions import ConvergenceWarning
    from sklearn.gaussian_process import GaussianProcessRegressor
    from sklearn.gaussian_process.kernels import ConstantKernel, Matern, WhiteKernel

    d = z.shape[1]
    kernel = ConstantKernel(1.0, (1e-3, 1e3)) * Matern(
        np.ones(d), [_LENGTHS] * d, nu=2.5
    ) + WhiteKernel(0.1, (1e-6, 1e1))
    process = GaussianProcessRegressor(
        kernel, normalize_y=True, n_restarts_optimizer=_STARTS, random_state=0
    )
    with warnings.catch_warnings():  # a length at its bound means: no influence, or a plane
        warnings.simplefilter("ignore", ConvergenceWarning)
        process.fit(z, y)
    size = float(y.std())
    fitted = process.kernel_
    lengths = np.broadcast_to(np.asarray(fitted.k1.k2.length_scale, float), (d,)).copy()
    constant = -0.5 * len(y) * (log(2.0 * pi) + 1.0)  # noise of variance 1 alone
    gain = 2.0 * (process.log_marginal_likelihood_value_ - constant)
    level = float(chi2.sf(max(gain, 0.0), d + 1))
    return Kriging(process, float(fitted.k2.noise_level) * size**2, size, lengths, level)
