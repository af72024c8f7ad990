"""A quadratic surface through noisy points of a box, where it is least, and how sure that is.

Axes are scaled to -1 ... 1 over the box. The model is y = c + b.z + z.B z + noise of one variance,
fitted by least squares. A place is in the region of confidence of the minimum if some surface that
has its least value there fits the points about as well as the best one does: its sum of squares
exceeds the least by no more than d s^2 F(d, dof), with d axes. Where the minimum lies inside the
box this is the region of G. E. P. Box and J. S. Hunter (Biometrika 41 (1954) 190) cut down to
surfaces whose stationary point is a minimum; at the box's edges it goes on to hold.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import combinations_with_replacement

import numpy as np
from scipy.optimize import nnls
from scipy.stats import f as fisher
from scipy.stats import t as student

from flexcage.core.errors import InputError

CONFIDENCE = 0.95
_EDGE = 1e-9  # of half the box, within which a place lies on its edge
_CLOSE = 1e-9  # of the whitened coefficients, in the problem of least distance


def terms(z: np.ndarray) -> np.ndarray:
    """1, z_i and z_i z_j (n, p) of scaled places (n, d)."""
    pairs = combinations_with_replacement(range(z.shape[1]), 2)
    return np.column_stack([np.ones(len(z)), z, *(z[:, i] * z[:, j] for i, j in pairs)])


def _downhill(z: np.ndarray) -> np.ndarray:
    """Rows (m, p) that give, at a scaled place (d,), the slope down along every way into the box:
    none is positive where the surface has its least value there."""
    d = len(z)
    slopes = np.zeros((d, terms(z[None]).shape[1]))
    slopes[:, 1 : 1 + d] = np.eye(d)
    for column, (i, j) in enumerate(combinations_with_replacement(range(d), 2), 1 + d):
        slopes[i, column] += z[j]
        slopes[j, column] += z[i]
    return np.vstack([slopes[z > _EDGE - 1.0], -slopes[z < 1.0 - _EDGE]])


@dataclass(frozen=True, eq=False)
class Quadratic:
    """The fit: coefficients ``beta`` (p,) of ``terms``, their covariance over the noise's variance
    ``spread`` (p, p), the noise's variance ``noise`` and its degrees of freedom ``dof``.

    ``level`` is the probability that terms beside the constant reach by chance what they do, and
    ``misfit`` that repetitions scatter about the surface's values as they do; NaN where no place
    was repeated.
    """

    beta: np.ndarray
    spread: np.ndarray
    noise: float
    dof: int
    ratio: float  # of mean squares: the terms beside the constant to the noise
    misfit: float

    @property
    def level(self) -> float:
        return float(fisher.sf(self.ratio, len(self.beta) - 1, self.dof))

    def mean(self, z: np.ndarray) -> np.ndarray:
        """Values (n,) at scaled places (n, d)."""
        return terms(z) @ self.beta

    def half(self, z: np.ndarray) -> np.ndarray:
        """Half widths (n,) of the 95 % intervals of these values."""
        X = terms(z)
        variance = self.noise * np.einsum("ij,jk,ik->i", X, self.spread, X)
        return student.ppf(0.5 + 0.5 * CONFIDENCE, self.dof) * np.sqrt(variance)

    @cached_property
    def _whitening(self) -> np.ndarray:
        return np.linalg.cholesky(self.noise * self.spread)

    def least_in(self, places: np.ndarray, others: np.ndarray) -> np.ndarray:
        """Which of the scaled ``places`` (n, d) may have the least value among ``others`` (m, d) as
        well as themselves, with 95 % confidence: (n,) of bool."""
        limit = places.shape[1] * fisher.ppf(CONFIDENCE, places.shape[1], self.dof)
        rows = terms(others)
        found = np.zeros(len(places), bool)
        for i, place in enumerate(places):
            above = np.vstack([terms(place[None]) - rows, _downhill(place)])
            found[i] = self._misses(above) <= limit
        return found

    def _misses(self, above: np.ndarray) -> float:
        """Least squared distance (of Mahalanobis) from ``beta`` to coefficients with
        ``above`` (m, p) @ coefficients <= 0.

        With coefficients beta + L x it is the problem of least distance, solved through
        non-negative least squares (C. L. Lawson and R. J. Hanson, Solving Least Squares Problems,
        1974, chapter 23).
        """
        excess, along = above @ self.beta, above @ self._whitening
        steep = np.linalg.norm(along, axis=1)
        real = steep > _CLOSE * steep.max(initial=0.0)
        excess, along = excess[real] / steep[real], along[real] / steep[real, None]
        if not (excess > 0.0).any():
            return 0.0
        worst = float(excess.max()) ** 2
        # the most violated constraints first: they alone bound the distance from below
        matrix = np.vstack([-along.T, excess])
        unit = np.zeros(len(matrix))
        unit[-1] = 1.0
        weights, _ = nnls(matrix, unit, maxiter=50 * matrix.shape[1])
        rest = matrix @ weights - unit
        if not -rest[-1] > _CLOSE:  # no coefficients do
            return float("inf")
        return max(float(((rest[:-1] / rest[-1]) ** 2).sum()), worst)


def fit_quadratic(z: np.ndarray, y: np.ndarray) -> Quadratic:
    """The least-squares surface through values (n,) at scaled places (n, d)."""
    X = terms(z)
    n, p = X.shape
    if np.linalg.matrix_rank(X) < p:
        raise InputError(
            f"The study's {len(np.unique(z, axis=0))} points do not determine the {p} coefficients "
            f"of a quadratic surface over {_axes(z.shape[1])}: every axis needs three values or "
            "more, and axes must not change together; choose axes with --axes.",
            where="axes",
        )
    if n < p + 2:
        raise InputError(
            f"A quadratic surface over {_axes(z.shape[1])} has {p} coefficients; {n} cases leave "
            f"too little to see the noise by, so compute {p + 2} or more.",
            where="study",
        )
    beta, *_ = np.linalg.lstsq(X, y, rcond=None)
    residual = y - X @ beta
    dof = n - p
    noise = float(residual @ residual) / dof
    if not noise > 1e-24 * float(y @ y) / n:
        raise InputError(
            "The values lie on a quadratic surface without any noise, so its minimum is exact and "
            "has no region of confidence.",
            where="study",
        )
    explained = float(((X @ beta - y.mean()) ** 2).sum()) / (p - 1)
    return Quadratic(
        beta, np.linalg.inv(X.T @ X), noise, dof, explained / noise, _misfit(z, y, residual, p)
    )


def _axes(count: int) -> str:
    return f"{count} ax{'i' if count == 1 else 'e'}s"


def _misfit(z: np.ndarray, y: np.ndarray, residual: np.ndarray, p: int) -> float:
    """Probability of the lack of fit by chance; NaN without repetitions or spare places."""
    _, group = np.unique(z, axis=0, return_inverse=True)
    count = np.bincount(group.ravel())
    means = np.bincount(group.ravel(), y) / count
    pure = float(((y - means[group.ravel()]) ** 2).sum())
    between, within = len(count) - p, len(y) - len(count)
    if between < 1 or within < 1 or pure <= 0.0:
        return float("nan")
    lack = max(float(residual @ residual) - pure, 0.0)
    return float(fisher.sf(lack / between / (pure / within), between, within))
