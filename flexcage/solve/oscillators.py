"""Linear oscillators among the unknowns, whose own motion a step integrates exactly.

Each is a displacement q and its velocity u with

    q' = u,    u' = -(g^2 + w^2) q - 2 g u + N(t, y),

of which only the drive N is left to the method. With z = u + (g + i w) q that is
z' = (-g + i w) z + N, and over a step of h, Z = h (-g + i w), exactly

    z(h) = exp(Z) z(0) + int_0^h exp(Z (1 - s/h)) N ds.

Cox and Matthews, J. Comput. Phys. 176 (2002) 430, equations 26 to 29 (ETD4RK), give weights of the
drive at the stages of the classical Runge-Kutta method that keep its order 4, and are its own
weights at Z = 0.

Plain Python that numba also compiles, as ``contract`` says. Complex numbers are two rows: the real
part, then the imaginary.
"""

from __future__ import annotations

from math import cos, exp, factorial, sin
from typing import NamedTuple

import numpy as np

# rows of the weights of a step: over half of it, over all of it, of the half steps' drive, of the
# drive at the first, at either middle and at the last stage
HALF, WHOLE, MIDDLE, FIRST, INNER, LAST = range(0, 12, 2)
ROWS = 12
SMALL = 0.25  # abs(Z) below which phi is taken from its series
_SERIES = tuple(1.0 / factorial(k) for k in range(12, 2, -1))


class Oscillators(NamedTuple):
    """Which unknowns of y are such oscillators, and their constants; m of them."""

    place: np.ndarray  # (2, m) of displacements and of velocities in y
    decay: np.ndarray  # (m,) g [1/s]
    frequency: np.ndarray  # (m,) w > 0 [rad/s]


def no_oscillators() -> Oscillators:
    return Oscillators(np.zeros((2, 0), np.int64), np.zeros(0), np.zeros(0))


def step_weights(h, modes, out):
    """Weights (ROWS, m) of a step of h.

    With phi_1 = (exp(Z) - 1)/Z and phi_k+1 = (phi_k - 1/k!)/Z; of small Z by the series of phi_3.
    """
    for m in range(modes.decay.shape[0]):
        x, y = -h * modes.decay[m], h * modes.frequency[m]
        z, squared = complex(x, y), x * x + y * y
        half = exp(0.5 * x) * complex(cos(0.5 * y), sin(0.5 * y))
        whole = half * half
        if squared < SMALL**2:
            p3 = 0.0 * z
            for c in _SERIES:
                p3 = p3 * z + c
            p2 = 0.5 + z * p3
            p1 = 1.0 + z * p2
            middle = p1 / (1.0 + half)
        else:
            inverse = complex(x / squared, -y / squared)
            p1 = (whole - 1.0) * inverse
            p2 = (p1 - 1.0) * inverse
            p3 = (p2 - 0.5) * inverse
            middle = (half - 1.0) * inverse
        first, inner, last = p1 - 3.0 * p2 + 4.0 * p3, 2.0 * p2 - 4.0 * p3, 4.0 * p3 - p2
        out[HALF, m], out[HALF + 1, m] = half.real, half.imag
        out[WHOLE, m], out[WHOLE + 1, m] = whole.real, whole.imag
        out[MIDDLE, m], out[MIDDLE + 1, m] = h * middle.real, h * middle.imag
        out[FIRST, m], out[FIRST + 1, m] = h * first.real, h * first.imag
        out[INNER, m], out[INNER + 1, m] = h * inner.real, h * inner.imag
        out[LAST, m], out[LAST + 1, m] = h * last.real, h * last.imag


def find_turns(y, modes, turn):
    """z (2, m) of all oscillators."""
    for m in range(modes.decay.shape[0]):
        q, u = y[modes.place[0, m]], y[modes.place[1, m]]
        turn[0, m], turn[1, m] = u + modes.decay[m] * q, modes.frequency[m] * q


def find_drives(y, yd, modes, drive):
    """Drives N (m,) of all oscillators, from y and y'."""
    for m in range(modes.decay.shape[0]):
        g, w = modes.decay[m], modes.frequency[m]
        q, u = y[modes.place[0, m]], y[modes.place[1, m]]
        drive[m] = yd[modes.place[1, m]] + (g * g + w * w) * q + 2.0 * g * u


def drive_half(modes, C, begin, new, old, turn, y):
    """Half a step from z ``begin`` (2, m) under the drive 2 new - old, into z ``turn`` and y."""
    for m in range(modes.decay.shape[0]):
        a, b, drive = C[HALF, m], C[HALF + 1, m], 2.0 * new[m] - old[m]
        x = a * begin[0, m] - b * begin[1, m] + C[MIDDLE, m] * drive
        z = a * begin[1, m] + b * begin[0, m] + C[MIDDLE + 1, m] * drive
        turn[0, m], turn[1, m] = x, z
        q = z / modes.frequency[m]
        y[modes.place[0, m]], y[modes.place[1, m]] = q, x - modes.decay[m] * q


def drive_whole(modes, C, begin, N, y):
    """The whole step under the drives N (4 or more, m) of its stages, into y."""
    for m in range(modes.decay.shape[0]):
        a, b, inner = C[WHOLE, m], C[WHOLE + 1, m], N[1, m] + N[2, m]
        x = a * begin[0, m] - b * begin[1, m]
        z = a * begin[1, m] + b * begin[0, m]
        x += C[FIRST, m] * N[0, m] + C[INNER, m] * inner + C[LAST, m] * N[3, m]
        z += C[FIRST + 1, m] * N[0, m] + C[INNER + 1, m] * inner + C[LAST + 1, m] * N[3, m]
        q = z / modes.frequency[m]
        y[modes.place[0, m]], y[modes.place[1, m]] = q, x - modes.decay[m] * q


def drive_missed(modes, C, N, late, bend, estimate):
    """What a share ``late`` of the step of the drive's change from its last stage to the new
    point, and ``bend`` of its bend, make in the displacement and the velocity."""
    for m in range(modes.decay.shape[0]):
        change = late * (N[4, m] - N[3, m]) + bend * (N[0, m] - N[1, m] - N[2, m] + N[4, m])
        q = 6.0 * C[LAST + 1, m] * change / modes.frequency[m]
        estimate[modes.place[0, m]] = q
        estimate[modes.place[1, m]] = 6.0 * C[LAST, m] * change - modes.decay[m] * q


def drive_within(x, modes, C, D, begin, N, y, yd):
    """y and y' of the oscillators at share x of a step; C, D: weights of the step and that share.

    The drive is the parabola through its ends and the mean of its middle stages, for which weights
    are exact. The step itself took the last stage's drive for its end; a cubic makes up for that.
    """
    for m in range(modes.decay.shape[0]):
        g, w = modes.decay[m], modes.frequency[m]
        bend = 2.0 * (N[0, m] + N[4, m] - N[1, m] - N[2, m])
        slope = N[4, m] - N[0, m] - bend
        middle = N[0, m] + 0.5 * x * (slope + 0.5 * x * bend)
        drive = N[0, m] + x * (slope + x * bend)
        late = x * x * (3.0 - 2.0 * x) * (N[3, m] - N[4, m])
        a, b = D[WHOLE, m], D[WHOLE + 1, m]
        u = a * begin[0, m] - b * begin[1, m]
        q = a * begin[1, m] + b * begin[0, m]
        u += D[FIRST, m] * N[0, m] + 2.0 * D[INNER, m] * middle + D[LAST, m] * drive
        q += D[FIRST + 1, m] * N[0, m] + 2.0 * D[INNER + 1, m] * middle + D[LAST + 1, m] * drive
        q = (q + C[LAST + 1, m] * late) / w
        u += C[LAST, m] * late - g * q
        y[modes.place[0, m]], y[modes.place[1, m]] = q, u
        yd[modes.place[0, m]] = u
        yd[modes.place[1, m]] = drive - (g * g + w * w) * q - 2.0 * g * u


def leave_own(v, Jv, modes):
    """Take from J v, J = df/dy, what makes the oscillators swing by themselves."""
    for m in range(modes.decay.shape[0]):
        g, w = modes.decay[m], modes.frequency[m]
        q, u = modes.place[0, m], modes.place[1, m]
        Jv[u] += (g * g + w * w) * v[q] + 2.0 * g * v[u]
