"""A Butterworth low-pass of order 4: two sections of second order, one after the other.

``scipy.signal`` has it too, but its import takes longer than the filters of a whole run (0.3 s).
"""

from __future__ import annotations

import numpy as np
from numba import float64, void

from flexcage.core.jit import kernel

SECTIONS = 2
_PADDING = 3 * (2 * SECTIONS + 1)  # samples before the first and after the last, both ways


def butterworth(cut: float) -> np.ndarray:
    """Sections (2, 6) b0 b1 b2 1 a1 a2; ``cut``: cutoff frequency over half the sampling rate."""
    warped = 4.0 * np.tan(0.5 * np.pi * cut)
    poles = -warped * np.exp(0.25j * np.pi * np.array([1.5, 0.5]))  # those with mates come last
    gain = warped**4 / np.prod(np.abs(4.0 - poles) ** 2)
    poles = (4.0 + poles) / (4.0 - poles)
    poles = poles[np.argsort(np.abs(poles))]
    sections = np.array([[1.0, 2.0, 1.0, 1.0, -2.0 * p.real, abs(p) ** 2] for p in poles])
    sections[0, :3] *= gain
    return sections


@kernel(void(float64[:, ::1], float64[:, ::1], float64[:, :, ::1]))
def _filter(sections, x, state):
    """Filter the columns of ``x`` (n, m) in place, from and to the ``state`` (2, 2, m)."""
    for k in range(x.shape[1]):
        for s in range(sections.shape[0]):
            b0, b1, b2, _, a1, a2 = sections[s]
            z0, z1 = state[s, 0, k], state[s, 1, k]
            for i in range(x.shape[0]):
                now = x[i, k]
                out = b0 * now + z0
                z0 = b1 * now - a1 * out + z1
                z1 = b2 * now - a2 * out
                x[i, k] = out
            state[s, 0, k], state[s, 1, k] = z0, z1


def low_passed(sections: np.ndarray, x: np.ndarray, state: np.ndarray) -> np.ndarray:
    """Samples (n, m) filtered; the ``state`` (2, 2, m) of the filter goes on to the next ones."""
    out = np.array(x, float, order="C")
    _filter(sections, out, state)
    return out


def low_passed_both_ways(sections: np.ndarray, x: np.ndarray) -> np.ndarray:
    """Samples (n, m) filtered forwards and backwards, without delay. Both ends go on for some
    samples, turned by half a revolution about the end, and begin at rest."""
    before, after = 2.0 * x[0] - x[_PADDING:0:-1], 2.0 * x[-1] - x[-2 : -_PADDING - 2 : -1]
    padded = np.concatenate([before, x, after])
    for _ in range(2):
        padded = low_passed(sections, padded, _at_rest(sections, padded[0]))[::-1]
    return padded[_PADDING:-_PADDING]


def _at_rest(sections: np.ndarray, x: np.ndarray) -> np.ndarray:
    """The state (2, 2, m) after samples that were ``x`` (m,) for long."""
    state = []
    for b0, b1, b2, _, a1, a2 in sections:
        out = x * (b0 + b1 + b2) / (1.0 + a1 + a2)
        state.append([out - b0 * x, b2 * x - a2 * out])
        x = out
    return np.array(state)
