"""A ring whose section is displaced by waves round it, as lands and ribs meet it.

A section moves as a rigid one: axially (at the ring's axis), radially and in tilt about the
tangent, each as sum_n (cos n psi, sin n psi) times the crests of wave n. ``crest`` (N + 1, 2, 2, 3)
holds those of cosine and sine: displacement, then rate. What presses on the ring is gathered
likewise, in ``borne`` (N + 1, 2, 3). Both have no waves (N + 1 = 0) where the ring is rigid.
"""

from __future__ import annotations

from math import sqrt

import numpy as np

from flexcage.core.jit import part

COSINE, SINE = range(2)
PLACE, RATE = range(2)
AXIALLY, RADIALLY, IN_TILT = range(3)


def no_waves() -> tuple[np.ndarray, np.ndarray]:
    """Crests and forces of a rigid ring."""
    return np.zeros((0, 2, 2, 3)), np.zeros((0, 2, 3))


@part
def outwards_at(crest, x, y, z):
    """How far the ring is displaced outwards at a place (x, y, z) from its centre: displacement,
    its slope over the azimuth, its rate."""
    d = sqrt(y * y + z * z)
    c, s, cos_n, sin_n = y / d, z / d, 1.0, 0.0
    moved = slope = rate = 0.0
    for n in range(crest.shape[0]):
        even, odd = crest[n, COSINE], crest[n, SINE]
        a = even[PLACE, RADIALLY] + x * even[PLACE, IN_TILT]
        b = odd[PLACE, RADIALLY] + x * odd[PLACE, IN_TILT]
        moved += cos_n * a + sin_n * b
        slope += n * (cos_n * b - sin_n * a)
        rate += cos_n * (even[RATE, RADIALLY] + x * even[RATE, IN_TILT])
        rate += sin_n * (odd[RATE, RADIALLY] + x * odd[RATE, IN_TILT])
        cos_n, sin_n = cos_n * c - sin_n * s, sin_n * c + cos_n * s
    return moved, slope, rate


@part
def push_outwards(borne, x, y, z, force):
    """Add a ``force`` outwards on the ring at a place (x, y, z) from its centre."""
    d = sqrt(y * y + z * z)
    c, s, cos_n, sin_n = y / d, z / d, 1.0, 0.0
    for n in range(borne.shape[0]):
        borne[n, COSINE, RADIALLY] += cos_n * force
        borne[n, COSINE, IN_TILT] += cos_n * x * force
        borne[n, SINE, RADIALLY] += sin_n * force
        borne[n, SINE, IN_TILT] += sin_n * x * force
        cos_n, sin_n = cos_n * c - sin_n * s, sin_n * c + cos_n * s


@part
def furthest(crest, x):
    """A bound of the displacement outwards or inwards anywhere round the ring, within x of its
    middle plane."""
    most = 0.0
    for n in range(crest.shape[0]):
        for quarter in range(2):
            at = crest[n, quarter, PLACE]
            most += abs(at[RADIALLY]) + x * abs(at[IN_TILT])
    return most


@part
def widened(crest, x):
    """By how much the ring is wider in radius at x: its wave 0."""
    if crest.shape[0] == 0:
        return 0.0
    at = crest[0, COSINE, PLACE]
    return at[RADIALLY] + x * at[IN_TILT]


@part
def shifted(crest, x, what):
    """Displacement along y and z of the ring's circle at x, or the rate of that (``what``): its
    wave 1."""
    if crest.shape[0] < 2:
        return 0.0, 0.0
    even, odd = crest[1, COSINE, what], crest[1, SINE, what]
    return even[RADIALLY] + x * even[IN_TILT], odd[RADIALLY] + x * odd[IN_TILT]


@part
def push_shifted(borne, x, y, z):
    """Add a force (y, z) on the ring's circle at x."""
    if borne.shape[0] < 2:
        return
    borne[1, COSINE, RADIALLY] += y
    borne[1, COSINE, IN_TILT] += x * y
    borne[1, SINE, RADIALLY] += z
    borne[1, SINE, IN_TILT] += x * z
