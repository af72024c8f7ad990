"""Volume, centre of mass and inertia of a conical cage, from its dimensions.

The wall without pockets is a body of revolution with a rectangular section, the pockets are cut out
of it between planes; both integrals are of smooth functions, by Gauss's rule to rounding. What the
fillets leave of a pocket's corners counts at the corners.
"""

from __future__ import annotations

from math import asin, cos, pi, tan
from typing import NamedTuple

import numpy as np

from flexcage.cages.conical.shape import ConeShaped

_ORDER = 12


class Mass(NamedTuple):
    """Mass [kg], place x [m] of its centre, which is on the axis, and moments of inertia [kg m^2]
    about this centre: axial and transverse."""

    mass: float
    centre: float
    axial: float
    transverse: float


def mass_of(cage: ConeShaped, pocket_count: int) -> Mass:
    """Of a sound cage."""
    places, weights = _wall(cage)
    window, cut = _window(cage)
    moments = _moments(places, weights) - pocket_count * _moments(window, cut)
    volume, first, second, polar = (float(value) for value in moments)
    density, centre = cage.material.density, first / volume
    transverse = 0.5 * polar + second - volume * centre**2
    return Mass(density * volume, centre, density * polar, density * transverse)


def _moments(places: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Integrals of 1, x, x^2 and r^2 over places (n, 2), x and r, of volumes (n,)."""
    x, r = places.T
    return np.array([weights.sum(), weights @ x, weights @ x**2, weights @ r**2])


def _gauss(low: float, high: float) -> tuple[np.ndarray, np.ndarray]:
    u, w = np.polynomial.legendre.leggauss(_ORDER)
    half = 0.5 * (high - low)
    return low + half * (1.0 + u), half * w


def _wall(cage: ConeShaped) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 2), x and r, and volumes (n,) of the wall without pockets."""
    at = cage.section
    (u, wu), (n, wn) = _gauss(0.0, 1.0), _gauss(at.inside, at.outside)
    large = cage.large_end(n)
    s = large + np.multiply.outer(u, at.small - large)
    n = np.broadcast_to(n, s.shape)
    r, areas = cage.radius(s, n), np.outer(wu, wn * (at.small - large))
    places = np.stack([cage.axial(s, n), r], axis=-1).reshape(-1, 2)
    return places, (2.0 * pi * r * areas).ravel()


def _window(cage: ConeShaped) -> tuple[np.ndarray, np.ndarray]:
    """The same of one pocket. At (s, u), with u from -1 to 1 between the bars' faces, it reaches
    from one cone to the other."""
    at, half = cage.section, 0.5 * cage.pocket_length
    (s, ws), (u, wu), (b, wb) = (
        _gauss(-half, half),
        _gauss(-1.0, 1.0),
        _gauss(at.inside, at.outside),
    )
    s, u, b = (a.ravel() for a in np.meshgrid(s, u, b, indexing="ij"))
    weights = np.multiply.outer(np.outer(ws, wu), wb).ravel()
    places, volumes = _between_planes(cage, s, u, b)
    corners, kept = _corners(cage)
    return np.concatenate([places, corners]), np.concatenate([volumes * weights, -kept])


def _between_planes(
    cage: ConeShaped, s: np.ndarray, u: np.ndarray, b: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Places (n, 2), x and r, on cones at heights b of the wall, and volumes per ds du db."""
    sine, cosine, slope = np.sin(cage.cone_angle), np.cos(cage.cone_angle), tan(cage.flank_angle)
    n = b.copy()
    for _ in range(50):  # Newton's method: the height n in the middle plane's section
        y, half = cage.radius(s, n), cage.half_width(s, n)
        r = np.hypot(y, u * half)
        height = cage.axial(s, n) * sine + (r - 0.5 * cage.pitch_diameter) * cosine
        rise = sine**2 + cosine * (y * cosine - u**2 * half * slope) / r
        step = (b - height) / rise
        n = n + step
        if np.abs(step).max() < 1e-15:
            break
    half = cage.half_width(s, n)
    r = np.hypot(cage.radius(s, n), u * half)
    return np.stack([cage.axial(s, n), r], axis=1), half / rise


def _corners(cage: ConeShaped) -> tuple[np.ndarray, np.ndarray]:
    """Places (4, 2), x and r, and volumes (4,) of what fillets leave in the corners."""
    half, rho = 0.5 * cage.pocket_length, cage.fillet_radius
    tilt = asin(cage.face_normals[0, 0])
    places, volumes = [], []
    for sign in (-1.0, 1.0):
        inner = 0.5 * pi + sign * tilt  # angle between the faces, blunt at the small end
        area = rho**2 * (1.0 / tan(0.5 * inner) - 0.5 * (pi - inner))
        s, n = sign * (half - _DEPTH * rho), cage.bar_height
        low, high = cage.face_heights(s)
        t = cage.half_width(s, n) - _DEPTH * rho
        places += 2 * [(cage.axial(s, n), np.hypot(cage.radius(s, n), t))]
        volumes += 2 * [area * (high - low) / cos(cage.flank_angle)]
    return np.array(places), np.array(volumes)


# centroid of what an arc leaves in a square corner, over its radius: (10 - 3 pi)/(12 - 3 pi)
_DEPTH = (10.0 - 3.0 * pi) / (12.0 - 3.0 * pi)
