"""Courses of speed and loads over time, tables with a wave on top: kernels for value, slope and
integral at any time, and the corners at which slopes jump."""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, floor, pi, sin

import numpy as np

from flexcage.core.jit import kernel, part

SHAPE, RISE, AMPLITUDE, PERIOD = range(4)  # places in ``wave``
NONE, SINE, TRAPEZOID = 0.0, 1.0, 2.0  # shapes

# ``wave[RISE]`` is the share of the period that a rise from zero takes. A
# triangle rises for a quarter of its period. A table (2, n) holds times and values, linear between
# and constant outside. A slope at a corner is that of the piece before it.
_AT_CORNER = 1e-15  # of the time: by how much rounding may put a time behind a corner


@part
def piece(table, t):
    """The i with table[0, i-1] < t <= table[0, i]: 0 before a table's first time, n after its
    last."""
    low, high = 0, table.shape[1]
    while low < high:
        middle = (low + high) // 2
        if table[0, middle] < t:
            low = middle + 1
        else:
            high = middle
    return low


@part
def table_value(table, t):
    n, i = table.shape[1], piece(table, t)
    if i == 0 or i == n:
        return table[1, max(i - 1, 0)]
    f = (t - table[0, i - 1]) / (table[0, i] - table[0, i - 1])
    return table[1, i - 1] + f * (table[1, i] - table[1, i - 1])


@part
def table_slope(table, t):
    i = piece(table, t)
    if i == 0 or i == table.shape[1]:
        return 0.0
    return (table[1, i] - table[1, i - 1]) / (table[0, i] - table[0, i - 1])


@part
def table_integral(table, areas, t):
    """From 0 to t; ``areas`` (n,) from the table's first time to each of its times."""
    n, i = table.shape[1], piece(table, t)
    if i == 0:
        return table[1, 0] * t
    base = table[1, 0] * table[0, 0] + areas[i - 1]
    h = t - table[0, i - 1]
    if i == n:
        return base + table[1, n - 1] * h
    f = h / (table[0, i] - table[0, i - 1])
    return base + h * (table[1, i - 1] + 0.5 * f * (table[1, i] - table[1, i - 1]))


@part
def wave_value(wave, t):
    """Value at time t; zero at t = 0 and rising."""
    if wave[SHAPE] == NONE:
        return 0.0
    x = t / wave[PERIOD]
    if wave[SHAPE] == SINE:
        return wave[AMPLITUDE] * sin(2.0 * pi * x)
    y, sign = _half(x)
    return sign * wave[AMPLITUDE] * min(min(y, 0.5 - y) / wave[RISE], 1.0)


@part
def wave_slope(wave, t):
    """Slope at time t."""
    if wave[SHAPE] == NONE:
        return 0.0
    x = t * (1.0 - _AT_CORNER) / wave[PERIOD]
    if wave[SHAPE] == SINE:
        return wave[AMPLITUDE] * 2.0 * pi / wave[PERIOD] * cos(2.0 * pi * x)
    y, sign = _half(x)
    steep = sign * wave[AMPLITUDE] / (wave[RISE] * wave[PERIOD])
    if y < wave[RISE]:
        return steep
    return -steep if 0.5 - y < wave[RISE] else 0.0


@part
def wave_integral(wave, t):
    """Integral from 0 to t."""
    if wave[SHAPE] == NONE:
        return 0.0
    x = t / wave[PERIOD]
    if wave[SHAPE] == SINE:
        return wave[AMPLITUDE] * wave[PERIOD] / (2.0 * pi) * (1.0 - cos(2.0 * pi * x))
    y, sign = _half(x)
    rise = wave[RISE]
    area = 0.5 - rise  # of a half wave
    risen = 0.5 * y * y / rise if y < rise else y - 0.5 * rise
    if 0.5 - y < rise:
        risen = area - 0.5 * (0.5 - y) * (0.5 - y) / rise
    whole = risen if sign > 0.0 else area - risen
    return wave[AMPLITUDE] * wave[PERIOD] * whole


@part
def _half(x):
    """Place in the half wave, 0 to 0.5, and its sign."""
    y = x - floor(x)
    if y < 0.5:
        return y, 1.0
    return y - 0.5, -1.0


@kernel
def time_function(table, wave, times, out):
    """Values (n,) at ``times`` [s] of a table with a wave on top."""
    for k in range(times.shape[0]):
        out[k] = table_value(table, times[k]) + wave_value(wave, times[k])


def corners(
    tables: Sequence[np.ndarray], waves: Sequence[np.ndarray], begin: float, end: float
) -> np.ndarray:
    """Times in [begin, end), in order, at which the slope of any of these functions jumps."""
    found = [_table_corners(table) for table in tables]
    found += [_wave_corners(wave, begin, end) for wave in waves if wave[SHAPE] == TRAPEZOID]
    times = np.unique(np.concatenate(found))
    return times[(times >= begin) & (times < end)]


def _table_corners(table: np.ndarray) -> np.ndarray:
    slopes = np.diff(table[1]) / np.diff(table[0])
    return table[0][np.diff(slopes, prepend=0.0, append=0.0) != 0.0]


def _wave_corners(wave: np.ndarray, begin: float, end: float) -> np.ndarray:
    _, rise, _, period = wave
    places = np.array([rise, 0.5 - rise, 0.5 + rise, 1.0 - rise])
    periods = np.arange(floor(begin / period), floor(end / period) + 1.0)
    return ((periods[:, None] + places) * period).ravel()
