"""Smooth interpolation between evenly spaced stations, for kernels."""

from __future__ import annotations

from flexcage.core.jit import VECTORISED, part


@part(fastmath=VECTORISED)
def smooth_weights(t):
    """Weights of stations -1, 0, 1, 2 at t in 0..1 between stations 0 and 1, and their slopes.

    Catmull and Rom's cubic: value and slope are continuous, straight lines are met exactly.
    """
    t2, t3 = t * t, t * t * t
    return (
        (
            -0.5 * t3 + t2 - 0.5 * t,
            1.5 * t3 - 2.5 * t2 + 1.0,
            -1.5 * t3 + 2.0 * t2 + 0.5 * t,
            0.5 * t3 - 0.5 * t2,
        ),
        (
            -1.5 * t2 + 2.0 * t - 0.5,
            4.5 * t2 - 5.0 * t,
            -4.5 * t2 + 4.0 * t + 0.5,
            1.5 * t2 - t,
        ),
    )
