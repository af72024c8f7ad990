"""A measuring chain against closed forms: resonance, band, sampling, noise, converter."""

from __future__ import annotations

import numpy as np
import pytest
import xarray as xr

from flexcage.core.errors import InputError
from flexcage.results.signals.chain import (
    converted,
    in_band,
    measured,
    ratio,
    resampled,
    resonating,
    with_noise,
)
from flexcage.results.spectra import spectral_density
from flexcage.spec import Accelerometer

RATE = 200e3
N = 40_000
T = np.arange(N) / RATE


def line(x, frequency, rate=RATE):
    """Complex amplitude of a sine at a frequency, of the middle of a record (Hann window)."""
    w, t = np.hanning(len(x)), np.arange(len(x)) / rate
    return 2.0 * np.sum(w * x * np.exp(-2j * np.pi * frequency * t)) / w.sum()


@pytest.mark.parametrize("frequency", [200.0, 5e3, 30e3, 32e3, 60e3])
@pytest.mark.parametrize("damping", [0.02, 0.7])
def test_gain_and_phase_of_a_resonance_are_those_of_a_mass_on_a_spring(frequency, damping):
    x = np.cos(2 * np.pi * frequency * T)
    r = frequency / 32e3
    wanted = 1.0 / (1.0 - r**2 + 2j * damping * r)
    found = line(resonating(x, RATE, 32e3, damping)[N // 4 :], frequency) / line(
        x[N // 4 :], frequency
    )
    assert found == pytest.approx(wanted, rel=2e-3)


def test_a_resonance_that_is_struck_rings_at_its_damped_frequency_and_dies():
    """exp(-D w t) sin(w_d t)/w_d w^2 after a blow; before it, next to nothing."""
    x = np.zeros(N)
    width = 3  # samples of a smooth blow of unit area
    x += np.exp(-0.5 * ((np.arange(N) - 8000) / width) ** 2)
    x *= RATE / x.sum()
    w, d = 2 * np.pi * 5e3, 0.05
    late = T - 8000 / RATE
    damped = w * np.sqrt(1 - d**2)
    wanted = np.where(late > 0, w**2 / damped * np.exp(-d * w * late) * np.sin(damped * late), 0.0)
    found = resonating(x, RATE, 5e3, d)
    away = np.abs(np.arange(N) - 8000) > 20
    blunted = np.exp(-0.5 * (w * width / RATE) ** 2)  # what the blow's width takes
    np.testing.assert_allclose(found[away], blunted * wanted[away], atol=0.02 * wanted.max())


def test_a_sensor_that_has_seen_a_constant_shows_it_at_once():
    x = np.full(N, 3.0)
    np.testing.assert_allclose(resonating(x, RATE, 1e3, 0.01), 3.0, rtol=1e-12)
    np.testing.assert_allclose(in_band(x, RATE, 0.0, 10e3), 3.0, rtol=1e-9)
    np.testing.assert_allclose(in_band(x, RATE, 5.0, 0.0), 0.0, atol=1e-6)
    # a ramp does not fold its end onto its start
    assert abs(resonating(T, RATE, 1e3, 0.01)[:50]).max() < 1e-3 * T[-1]


def test_a_high_pass_does_not_drift_from_a_first_value_that_is_far_from_the_mean():
    x = np.random.default_rng(2).normal(size=N)
    x[0] = 30.0
    found = in_band(x, RATE, 1.0, 0.0)
    assert abs(found[1:].std() / x[1:].std() - 1.0) < 0.02
    assert abs(found[1 : N // 4].mean()) < 4.0 / np.sqrt(N // 4)


@pytest.mark.parametrize(
    ("cut", "gain"), [((100.0, 0.0), lambda f: 1 / np.sqrt(1 + (100.0 / f) ** 4)),
                      ((0.0, 10e3), lambda f: 1 / np.sqrt(1 + (f / 10e3) ** 8))],
)  # fmt: skip
@pytest.mark.parametrize("frequency", [60.0, 100.0, 5e3, 10e3, 15e3])
def test_the_band_is_butterworth_s(cut, gain, frequency):
    x = np.cos(2 * np.pi * frequency * T)
    found = abs(line(in_band(x, RATE, *cut)[N // 4 :], frequency))
    assert found == pytest.approx(gain(frequency), rel=0.1 if frequency > 10e3 else 0.02)


@pytest.mark.parametrize("rate", [50e3, 51.2e3, 48e3, 44.1e3, 12e3])
def test_what_lies_above_half_the_rate_does_not_come_back(rate):
    """70 kHz would fold into the band of each; 0.3 of the rate passes, without delay."""
    low = 0.3 * rate
    x = np.cos(2 * np.pi * low * T) + np.cos(2 * np.pi * 70e3 * T)
    folded = abs(70e3 - rate * round(70e3 / rate))
    found = resampled(x, RATE, rate)
    assert len(found) == int((N - 1) * rate / RATE + 1e-9) + 1
    middle = found[200:-200]
    t = (np.arange(len(found)) / rate)[200:-200]
    np.testing.assert_allclose(middle, np.cos(2 * np.pi * low * t), atol=3e-4)
    bare = resampled(x, RATE, rate, anti_alias=False)[200:-200]
    assert abs(line(bare, folded, rate)) == pytest.approx(1.0, rel=0.25)
    assert abs(line(middle, folded, rate)) < 2e-4


def test_noise_has_the_density_that_is_asked_for():
    density = 0.003
    x = with_noise(np.zeros(400_000), 50e3, density, (1, 2))
    t = np.arange(len(x)) / 50e3
    signal = xr.DataArray(x, dims="time", coords={"time": t}, attrs={"units": "m/s^2"})
    found = spectral_density(signal, resolution=50.0).sel(frequency=slice(200, 24800))
    assert float(found.mean()) == pytest.approx(density**2, rel=0.01)
    assert float(found.std() / found.mean()) < 0.06
    assert (x == with_noise(np.zeros(400_000), 50e3, density, (1, 2))).all()
    assert (x != with_noise(np.zeros(400_000), 50e3, density, (2, 2))).any()


def test_a_converter_reads_steps_within_its_range():
    """Steps of 2 range/2^bits; an error of up to half a step, step/sqrt(12) in the mean."""
    x = 90.0 * np.sin(2 * np.pi * 37.1 * T)
    step = 200.0 / 2**12
    found = converted(x, 100.0, 12)
    np.testing.assert_allclose(found / step, np.round(found / step), atol=1e-9)
    error = found - x
    assert abs(error).max() <= 0.5 * step * (1 + 1e-9)
    assert error.std() == pytest.approx(step / np.sqrt(12), rel=0.02)
    over = converted(2.0 * x, 100.0, 12)
    assert over.max() == 100.0 - step and over.min() == -100.0
    assert converted(2.0 * x, 100.0, 0).max() == 100.0 and (converted(x, 0.0, 0) == x).all()


def test_the_whole_chain_in_its_order():
    """The resonance is struck before the anti-aliasing filter, and noise comes behind it."""
    sensor = Accelerometer(
        name="a", rate=50e3, resonance=20e3, damping_ratio=0.05, range=50.0, bits=16, noise=1e-3
    )
    x = np.cos(2 * np.pi * 10e3 * T)
    found = measured(x, RATE, sensor)
    assert len(found) == N // 4
    gain = 1.0 / abs(1 - 0.25 + 2j * 0.05 * 0.5)
    assert abs(line(found[1000:], 10e3, 50e3)) == pytest.approx(gain, rel=2e-3)
    step = 100.0 / 2**16
    np.testing.assert_allclose(found / step, np.round(found / step), atol=1e-9)


def test_rates_are_ratios_of_whole_numbers():
    assert ratio(200e3, 51.2e3) == ratio(400e3, 102.4e3)
    with pytest.raises(InputError, match="no simple ratio to the 200000 Hz"):
        ratio(200e3, 33_333.337)
