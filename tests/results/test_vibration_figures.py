"""Passing frequencies and severity as figures: of a run whose speeds are known, and whose outer
ring is struck as often as a test likes."""

from __future__ import annotations

import numpy as np
import pytest

from flexcage.results.figures.part import SettledRun
from flexcage.results.figures.sections import summarise

RPM = 1.0 / 60.0


def struck(run, rate, height=1.0):
    """The run with bursts of a 9 kHz ringing along y, ``rate`` [Hz] of them a second."""
    t = run["time_hf"].values
    since = t % (1.0 / rate)
    blows = height * np.exp(-since / 1e-4) * np.sin(2 * np.pi * 9e3 * since)
    noise = 0.02 * np.random.default_rng(1).normal(size=len(t))
    ds = run.copy()
    ds["outer_acceleration"] = ds["outer_acceleration"] + np.stack([blows + noise, 0.5 * noise], 1)
    return ds


def figures(ds, bearing):
    return summarise(SettledRun(ds, bearing))


def test_frequencies_by_the_run_s_own_speeds_and_nominal(known_run, bearing):
    """6000 rpm, a cage 2 % slower than 2709.09 rpm; 3 of 22 rollers spin 1 % slower, the others 5 %
    slower, than 27937.5 rpm in space."""
    found = figures(known_run, bearing)
    cage, spin = 0.98 * 2709.0909, 27937.5 * (19 * 0.95 + 3 * 0.99) / 22
    for key, rpm in (
        ("ftf", cage), ("shaft", 6000.0), ("bpfo", 22 * cage), ("bpfi", 22 * (6000.0 - cage)),
        ("bsf", spin + cage), ("bsf_twice", 2 * (spin + cage)),
    ):  # fmt: skip
        assert found[f"frequency_{key}"] == pytest.approx(rpm * RPM, rel=1e-6), key
    ratio = 8.0 / 82.5
    for key, orders in (
        ("ftf", 0.5 * (1 - ratio)), ("bpfo", 11 * (1 - ratio)), ("bpfi", 11 * (1 + ratio)),
        ("bsf", 0.5 * (1 - ratio**2) / ratio), ("bsf_twice", (1 - ratio**2) / ratio),
    ):  # fmt: skip
        assert found[f"nominal_{key}"] == pytest.approx(100.0 * orders), key
    assert found.row("frequency_bpfo").note == "nominal 993.33 Hz"


@pytest.mark.parametrize("line", ["bpfo", "bpfi", "bsf_twice"])
def test_the_line_that_is_struck_stands_above_the_floor_and_the_others_do_not(
    line, known_run, bearing
):
    still = figures(known_run, bearing)
    lines = {k: still[f"frequency_{k}"] for k in ("bpfo", "bpfi", "bsf_twice", "ftf")}
    found = figures(struck(known_run, lines[line]), bearing)
    floor = found["envelope_floor"]
    assert found[f"envelope_{line}"] > 20.0 * floor
    assert found[f"envelope_{line}_multiples"] > 1.2 * found[f"envelope_{line}"]
    apart = [k for k in lines if abs(lines[k] - lines[line]) > 5.0 / 0.07]  # five bins
    assert len(apart) >= 2
    for other in apart:
        assert found[f"envelope_{other}"] < 0.1 * found[f"envelope_{line}"]
    row = found.row(f"envelope_{line}")
    assert row.note == f"{row.value / floor:.3g} times the floor"
    assert found.row("vibration_rms").note == "along y"


def test_severity_of_blows_and_of_noise(known_run, bearing):
    quiet = figures(struck(known_run, 100.0, 0.0), bearing)
    assert quiet["vibration_rms"] == pytest.approx(0.02, rel=0.02)
    assert quiet["vibration_kurtosis"] == pytest.approx(3.0, abs=0.1)
    # white noise to 100 kHz: a band of 18 kHz holds 18 % of its power, of which a Butterworth
    # filter of order 4, run both ways, passes 7/8 (pi/8)/sin(pi/8)
    passed = 0.18 * 7 / 8 * (np.pi / 8) / np.sin(np.pi / 8)
    assert quiet["vibration_band"] == pytest.approx(0.02 * np.sqrt(passed), rel=0.05)
    loud = figures(struck(known_run, 100.0), bearing)
    assert (
        loud["vibration_kurtosis"] > 20.0 and loud["vibration_crest"] > 2 * quiet["vibration_crest"]
    )


def test_samples_too_slow_for_the_band_say_so(known_run, bearing):
    slow = struck(known_run, 993.0).isel(time_hf=slice(None, None, 8))  # 25 kHz
    row = figures(slow, bearing).row("vibration_rms")
    assert row.value is None and row.note.endswith("raise output.vibration_rate")


def test_a_run_too_short_for_lines_says_so(known_run, bearing):
    short = struck(known_run, 993.0).isel(time=slice(60), time_hf=slice(240))
    row = figures(short, bearing).row("envelope_ftf")
    assert row.value is None and row.note == "the run is too short to tell; raise solver.duration"
    assert figures(short, bearing)["frequency_shaft"] == pytest.approx(100.0)
    few = short.isel(time=slice(6), time_hf=slice(24))  # fewer than a filter wants before it begins
    assert figures(few, bearing).row("envelope_bpfo").value is None
