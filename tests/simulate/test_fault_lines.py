"""Where faults show in the spectra of sensors, against the kinematics of rolling without slip.

Envelope and spectrum are made here with SciPy alone, and the lines from dimensions and speed.
"""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.signal import butter, hilbert, sosfiltfilt

import flexcage
from flexcage.case import load_case

CASE = Path(__file__).parents[2] / "examples" / "6205_signals.toml"
SHAFT, RATIO, BALLS = 100.0, 7.938 / 38.5, 9  # Hz; ball over pitch diameter
FTF = 0.5 * SHAFT * (1 - RATIO)
BPFO, BPFI = BALLS * FTF, BALLS * (SHAFT - FTF)
TWICE_BSF = SHAFT / RATIO * (1 - RATIO**2)
SOUND = {"bearing.outer_spall.length": "0 mm"}
FAULTS = {
    "outer": {"bearing.outer_spall.length": "0.8 mm"},
    "inner": {**SOUND, "bearing.inner_spall.length": "0.8 mm"},
    "ball": {**SOUND, "bearing.ball_spot.size": "0.8 mm"},
    "cage": {**SOUND, "cage.unbalance": "5 g*mm"},
}


def signals(fault, milliseconds, **changes):
    overrides = {"solver.duration": f"{milliseconds} ms", **FAULTS[fault], **changes}
    return flexcage.simulate(load_case(CASE, overrides=overrides), stress=False).signals


def spectrum(signal, band=None):
    """Frequencies [Hz] and amplitudes of a signal, or of its envelope in a band [Hz]."""
    x, rate = signal.values, signal.attrs["rate"]
    if band:
        x = np.abs(hilbert(sosfiltfilt(butter(4, band, "bandpass", fs=rate, output="sos"), x)))
    window = np.hanning(len(x))
    height = 2.0 * np.abs(np.fft.rfft((x - x.mean()) * window)) / window.sum()
    return np.fft.rfftfreq(len(x), 1.0 / rate), height


def peak(frequency, height, line):
    """How far [bins] the highest of the five bins about a line lies from it, and its height."""
    near = np.flatnonzero(np.abs(frequency - line) <= 2.5 * frequency[1])
    top = near[height[near].argmax()]
    return abs(frequency[top] - line) / frequency[1], height[top]


def stands_at(frequency, height, lines, above):
    """Peaks lie within a bin of the lines, ``above`` times the median of what is around."""
    floor = np.median(height[(frequency > 2 * frequency[1]) & (frequency < 4 * BPFI)])
    for line in lines:
        off, top = peak(frequency, height, line)
        assert off <= 1.0, (line, off)
        assert top > above * floor, (line, top / floor)


def test_an_outer_race_s_spall_stands_at_bpfo_and_its_multiples():
    """It rests under the load, so that shocks are alike: no side bands at the shaft's speed."""
    found = spectrum(signals("outer", 60)["casing"], (2e3, 20e3))
    stands_at(*found, [BPFO, 2 * BPFO, 3 * BPFO], above=10.0)
    assert peak(*found, BPFO - SHAFT)[1] < 0.2 * peak(*found, BPFO)[1]
    assert peak(*found, BPFO)[1] > 3.0 * peak(*found, BPFI)[1]


def test_an_inner_race_s_spall_stands_at_bpfi_with_side_bands_at_the_shaft_s_speed():
    found = spectrum(signals("inner", 120)["casing"], (2e3, 20e3))
    stands_at(*found, [SHAFT, BPFI - SHAFT, BPFI, BPFI + SHAFT], above=4.0)


@pytest.mark.slow
def test_an_inner_race_s_side_bands_are_of_the_radial_load():
    """Under an axial load every azimuth is alike."""

    def side_band(**load):
        found = spectrum(signals("inner", 100, **load)["casing"], (2e3, 20e3))
        assert peak(*found, BPFI)[0] <= 1.5
        return sum(peak(*found, BPFI + s * SHAFT)[1] for s in (-1, 1)) / peak(*found, BPFI)[1]

    axial = {"load.radial": "0 N", "load.axial": "400 N"}
    assert side_band(**axial) < 0.3 * side_band()


@pytest.mark.slow
def test_a_ball_s_pit_stands_at_twice_its_spin_with_side_bands_at_the_cage_s_speed():
    """It strikes both races in a turn, and the cage carries it through the loaded zone."""
    found = spectrum(signals("ball", 250)["casing"], (2e3, 20e3))
    stands_at(*found, [FTF, TWICE_BSF - FTF, TWICE_BSF, TWICE_BSF + FTF], above=4.0)


def test_a_cage_out_of_balance_stands_at_ftf_where_a_laser_sees_it():
    """Its centre goes round with it."""
    seen = signals("cage", 150)
    frequency, height = spectrum(seen["cage_laser"])
    stands_at(frequency, height, [FTF], above=10.0)
    within = (frequency > 0.5 * FTF) & (frequency < 4 * FTF)
    assert frequency[within][height[within].argmax()] == pytest.approx(FTF, abs=frequency[1])
    assert height.max() > 20e-6  # m
