"""Waves of speed and load: shapes, slopes and integrals that belong together, and what they do."""

from __future__ import annotations

import numba
import numpy as np
import pytest
from scipy import signal

from flexcage.case import load_case
from flexcage.core.errors import InputError
from flexcage.simulate import simulate
from flexcage.system.bodies import _wave
from flexcage.system.spec import Drive
from flexcage.system.waves import wave_integral, wave_slope, wave_value

AMPLITUDE, PERIOD = 7.0, 0.03


@numba.njit
def along(wave, times):
    out = np.empty((3, len(times)))
    for k in range(len(times)):
        out[0, k] = wave_value(wave, times[k])
        out[1, k] = wave_slope(wave, times[k])
        out[2, k] = wave_integral(wave, times[k])
    return out


def of(shape):
    drive = Drive(wave=shape, wave_amplitude=AMPLITUDE, wave_period=PERIOD)
    return np.array(_wave(drive, AMPLITUDE))


SHAPES = {
    "sine": lambda x: np.sin(2 * np.pi * x),
    "triangle": lambda x: signal.sawtooth(2 * np.pi * (x + 0.25), width=0.5),
    "rectangle": lambda x: signal.square(2 * np.pi * x),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_shape_slope_and_integral(shape):
    times = np.linspace(0.0, 2.5 * PERIOD, 50_001)
    value, slope, integral = along(of(shape), times)
    x = times / PERIOD
    flat = np.abs((2 * x + 0.5) % 1.0 - 0.5) > 0.021  # away from a rectangle's edges
    there = flat if shape == "rectangle" else np.ones_like(flat)
    np.testing.assert_allclose(value[there], AMPLITUDE * SHAPES[shape](x)[there], atol=1e-9)
    assert value[0] == 0.0 and np.abs(value).max() == pytest.approx(AMPLITUDE)
    step = times[1]
    trapezoid = np.concatenate([[0.0], np.cumsum(0.5 * (value[1:] + value[:-1]) * step)])
    np.testing.assert_allclose(integral, trapezoid, atol=2e-6 * AMPLITUDE * PERIOD)
    middle = np.gradient(value, step)
    kinks = np.abs(np.convolve(slope, [1, -1], "same")) > 0.01 * np.abs(slope).max()
    kinks = np.convolve(kinks, np.ones(5), "same") > 0
    np.testing.assert_allclose(middle[~kinks], slope[~kinks], atol=1e-4 * np.abs(slope).max())


def test_no_wave():
    value, slope, integral = along(np.array(_wave(Drive(), 0.0)), np.linspace(0.0, 1.0, 5))
    assert not value.any() and not slope.any() and not integral.any()


def test_a_cage_follows_a_fluctuating_speed():
    """7603025 at 2000 rpm with 6 % at the ring's own frequency: the cage does the same 6 %, about
    a mean that is less than 1 % from pure rolling; energy balances while the speed changes."""
    case = load_case(
        {
            "bearing": {"preset": "7603025"},
            "cage": {"model": "rigid"},
            "mesh": {"fineness": "coarse"},
            "drive": {"speed": "2000 rpm", "wave": "sine", "wave_amplitude": "120 rpm",
                      "wave_period": "30 ms"},
            "load": {"axial": "3500 N", "radial": "1200 N"},
            "solver": {"duration": "60 ms"},
            "output": {"rate": "20 kHz", "vibration_rate": "20 kHz", "settle": 0.5},
        }
    )  # fmt: skip
    run = simulate(case)
    ds = run.dataset.isel(time=slice(600, None))
    inner, cage = ds["inner_speed"].values, ds["cage_omega"].sel(axis="x").values
    assert np.ptp(inner) / (2 * inner.mean()) == pytest.approx(0.06, rel=1e-3)
    turn = np.exp(-2j * np.pi * ds["time"].values / 0.03)
    at_once = 2.0 * abs((cage * turn).mean()) / cage.mean()  # chatter in pockets left out
    assert at_once == pytest.approx(0.06, rel=0.1)
    assert cage.mean() * 30 / np.pi == pytest.approx(935.0, rel=0.015)
    assert run.summary["energy_audit"] == "passed"


def test_waves_that_cannot_be():
    base = {"bearing": {"preset": "7010C-PI"}, "load": {"axial": "100 N"}}
    for changes, words in (
        ({"drive.wave": "sine", "drive.wave_amplitude": "10 rpm"}, "wave_period is 0 ms.*longer"),
        ({"load.wave_amplitude": "10 N"}, "load.wave is 'none'"),
        ({"drive.wave": "saw"}, "drive.wave 'saw' is not known"),
    ):
        with pytest.raises(InputError, match=words):
            load_case(base, overrides=changes)
    axial = {"load.wave": "sine", "load.wave_amplitude": "9 N", "load.wave_period": "5 ms",
             "load.wave_of": "axial"}  # fmt: skip
    with pytest.raises(InputError, match="axial motion is held; take 'radial'"):
        load_case('[bearing]\npreset = "N1013"\n', overrides=axial)
    assert load_case(base, overrides=axial).load.wave_of == "axial"
