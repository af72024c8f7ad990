"""Inertia of a roller that is cut into grains, which turn about its axis while that goes round."""

from math import cos, sin

import numpy as np


def turned_about(axis, angle, points):
    """Points (3, n) turned about a coordinate axis."""
    c, s = cos(angle), sin(angle)
    i, j = [(1, 2), (2, 0), (0, 1)][axis]
    out = points.copy()
    out[i], out[j] = c * points[i] - s * points[j], s * points[i] + c * points[j]
    return out


def inertia_of(own, mass, lean, radius, rolling, h=1e-5):
    """Less mass times acceleration, by second differences of where rotations take each grain: force
    along s and t, and moment in their plane about the roller's middle.

    ``own`` (3, n): places of the grains along s, t and e_psi; ``lean`` of the roller's axis;
    ``radius`` of its middle; ``rolling``: speeds of pure rolling.
    """
    c, s = cos(lean), sin(lean)
    to_space = np.array([[c, s, 0], [-s, c, 0], [0, 0, 1.0]])

    def placed(t):
        spun = turned_about(0, rolling.element_spin_in_cage * t, own)
        middle = np.array([0.0, radius, 0.0])[:, None]
        return turned_about(0, rolling.cage_speed * t, to_space @ spun + middle)

    force = -mass * (placed(h) - 2.0 * placed(0.0) + placed(-h)) / h**2
    local = to_space.T @ force
    return local[:2].sum(axis=1), (own[0] * local[1] - own[1] * local[0]).sum()
