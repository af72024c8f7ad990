"""A measuring chain: resonance, band, samples behind an anti-aliasing filter, noise, converter.

Filters are ``scipy.signal``'s. Every stage takes evenly sampled values (n,) and their rate [Hz].
"""

from __future__ import annotations

from collections.abc import Callable
from fractions import Fraction
from functools import cache
from math import ceil

import numpy as np

from flexcage.core.errors import InputError
from flexcage.results.signals.spec import Sensor

STOP = (
    80.0  # dB, of the anti-aliasing filter from half the rate on; it passes up to 0.4 of the rate
)
_PASSES = 0.4
_SETTLED = 15.0  # time constants of a resonance, after which nothing of it is left
_LARGEST = 20_000  # of a rate's numerator and denominator over the other


def measured(x: np.ndarray, rate: float, sensor: Sensor, key: int = 0) -> np.ndarray:
    """What a sensor's chain makes of values (n,), at its own rate, from the first instant on;
    ``key`` goes into the seed of its noise."""
    out = rate if sensor.rate == 0.0 else sensor.rate
    x = resonating(x, rate, sensor.resonance, sensor.damping_ratio)
    x = in_band(x, rate, sensor.high_pass, sensor.low_pass)
    x = resampled(x, rate, out, anti_alias=sensor.anti_alias)
    return converted(
        with_noise(x, out, sensor.noise, (sensor.seed, key)), sensor.range, sensor.bits
    )


def response(frequency: np.ndarray, resonance: float, damping_ratio: float) -> np.ndarray:
    """Gain, complex, of a mass on a spring and a damper: 1/(1 - r^2 + 2 j D r), r = f/f0."""
    r = np.asarray(frequency) / resonance
    return 1.0 / (1.0 - r**2 + 2j * damping_ratio * r)


def resonating(x: np.ndarray, rate: float, resonance: float, damping_ratio: float) -> np.ndarray:
    """Values (n,) behind a resonance [Hz] (0: none), which rested at the first one."""
    if resonance == 0.0:
        return x
    least = resonance * min(damping_ratio, 1.0 / (2.0 * damping_ratio))
    answer = passed(x[:, None], rate, lambda f: response(f, resonance, damping_ratio)[:, None],
                    least)  # fmt: skip
    return np.asarray(answer + x[0])


def passed(
    x: np.ndarray, rate: float, gains: Callable[[np.ndarray], np.ndarray], decay: float
) -> np.ndarray:
    """What values (n, k) less the first ones make behind ``gains``, which map frequencies (m,) [Hz]
    to (m, k), added up over k: (n,), by the exact response at every frequency of the record.

    What is behind them rested at the first values, and loses 2 pi ``decay`` [1/s] of what is left.
    The record is continued, smoothly and back to its first values, until nothing is left of what
    its end does.
    """
    n, more = len(x), ceil(_SETTLED / (2.0 * np.pi * decay) * rate) + 64
    fade = 0.5 * (1.0 + np.cos(np.pi * np.arange(1, more + 1) / (more + 1)))
    moved = x - x[0]
    padded = np.concatenate([moved, fade[:, None] * moved[-1], np.zeros((more, x.shape[1]))])
    spectrum = np.fft.rfft(padded, axis=0)
    spectrum *= gains(np.fft.rfftfreq(len(padded), 1.0 / rate))
    return np.asarray(np.fft.irfft(spectrum.sum(axis=1), len(padded))[:n])


def in_band(x: np.ndarray, rate: float, high_pass: float, low_pass: float) -> np.ndarray:
    """Values (n,) behind a Butterworth high-pass of order 2 and low-pass of order 4 (0 Hz: none),
    that have seen a constant for long: the high-pass the mean of all values, from which the first
    one may be far, and the low-pass the first."""
    from scipy.signal import butter, sosfilt, sosfilt_zi

    for order, kind, cut in ((2, "highpass", high_pass), (4, "lowpass", low_pass)):
        if cut > 0.0:
            sections = butter(order, cut, kind, fs=rate, output="sos")
            before = x.mean() if kind == "highpass" else x[0]
            x, _ = sosfilt(sections, x, zi=sosfilt_zi(sections) * before)
    return x


def ratio(rate: float, out: float) -> Fraction:
    """``out`` over ``rate`` as a fraction of whole numbers; InputError where it has none."""
    found = Fraction(out / rate).limit_denominator(_LARGEST)
    if found == 0 or abs(float(found) * rate / out - 1.0) > 1e-9:
        raise InputError(
            f"A rate of {out:g} Hz has no simple ratio to the {rate:g} Hz of the run; give one of "
            "full hertz.",
            where="rate",
            value=out,
        )
    return found


def resampled(x: np.ndarray, rate: float, out: float, *, anti_alias: bool = True) -> np.ndarray:
    """Values at ``out`` [Hz] from those (n,) at ``rate``, within the same time: behind a
    linear-phase filter without delay, or as they are at these instants."""
    share = ratio(rate, out)
    if share == 1:
        return x
    count = int((len(x) - 1) * share) + 1
    if not anti_alias:
        from scipy.interpolate import CubicSpline

        return np.asarray(CubicSpline(np.arange(len(x)), x)(np.arange(count) / float(share)))
    from scipy.signal import resample_poly

    up, down = share.numerator, share.denominator
    taken = resample_poly(x, up, down, window=_filter(max(up, down)), padtype="line")
    return np.asarray(taken)[:count]


@cache
def _filter(longer: int) -> np.ndarray:
    """Coefficients of a low-pass at 0.45 of the lower of two rates, one of which is so many times
    shorter than the rate at which the filter works."""
    from scipy.signal import firwin, kaiserord

    taps, beta = kaiserord(STOP, 2.0 * (0.5 - _PASSES) / longer)
    return np.asarray(firwin(taps | 1, (0.5 + _PASSES) / longer, window=("kaiser", beta)))


def with_noise(x: np.ndarray, rate: float, density: float, seed: tuple[int, int]) -> np.ndarray:
    """Values with white noise of a one-sided density [unit/sqrt(Hz)] up to half the rate [Hz]."""
    if density == 0.0:
        return x
    noise = np.random.default_rng(seed).standard_normal(len(x))
    return x + density * np.sqrt(0.5 * rate) * noise


def converted(x: np.ndarray, most: float, bits: int) -> np.ndarray:
    """Values as a converter reads them: within +-``most`` (0: without end), in 2^``bits`` steps
    over that (0: as they are)."""
    if most == 0.0:
        return x
    if bits == 0:
        return np.clip(x, -most, most)
    step = 2.0 * most / 2**bits
    return np.clip(np.round(x / step) * step, -most, most - step)
