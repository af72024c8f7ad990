"""Waves that speeds and loads ride on, as kernels: value, slope and integral at any time."""

from __future__ import annotations

from math import cos, floor, pi, sin

from flexcage.core.jit import part

NONE, SINE, TRAPEZOID = 0.0, 1.0, 2.0  # shapes in ``wave[0]``

# ``wave`` (4,): shape, share of the period that a rise from zero takes, amplitude, period. A
# triangle rises for a quarter of its period.


@part
def wave_value(wave, t):
    """Value at time t; zero at t = 0 and rising."""
    if wave[0] == NONE:
        return 0.0
    x = t / wave[3]
    if wave[0] == SINE:
        return wave[2] * sin(2.0 * pi * x)
    y, sign = _half(x)
    return sign * wave[2] * min(min(y, 0.5 - y) / wave[1], 1.0)


@part
def wave_slope(wave, t):
    """Slope at time t."""
    if wave[0] == NONE:
        return 0.0
    x = t / wave[3]
    if wave[0] == SINE:
        return wave[2] * 2.0 * pi / wave[3] * cos(2.0 * pi * x)
    y, sign = _half(x)
    steep = sign * wave[2] / (wave[1] * wave[3])
    if y < wave[1]:
        return steep
    return -steep if 0.5 - y < wave[1] else 0.0


@part
def wave_integral(wave, t):
    """Integral from 0 to t."""
    if wave[0] == NONE:
        return 0.0
    x = t / wave[3]
    if wave[0] == SINE:
        return wave[2] * wave[3] / (2.0 * pi) * (1.0 - cos(2.0 * pi * x))
    y, sign = _half(x)
    rise = wave[1]
    area = 0.5 - rise  # of a half wave
    risen = 0.5 * y * y / rise if y < rise else y - 0.5 * rise
    if 0.5 - y < rise:
        risen = area - 0.5 * (0.5 - y) * (0.5 - y) / rise
    whole = risen if sign > 0.0 else area - risen
    return wave[2] * wave[3] * whole


@part
def _half(x):
    """Place in the half wave, 0 to 0.5, and its sign."""
    y = x - floor(x)
    if y < 0.5:
        return y, 1.0
    return y - 0.5, -1.0
