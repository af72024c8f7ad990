"""Reductions of series with known moments and lines, and variables that follow from others."""

import numpy as np
import pytest

from flexcage.results import metrics
from flexcage.results.reductions import DERIVED, REDUCTIONS, crest_factor, kurtosis
from flexcage.results.statistics import element_passes

STEP = 1e-4


def reduced(name, x):
    return REDUCTIONS[name].value(x, STEP)


def test_moments_of_known_signals():
    t = np.arange(10_000) * STEP
    sine = 7.0 + np.sin(2 * np.pi * 50.0 * t)
    assert kurtosis(sine) == pytest.approx(1.5, rel=1e-6)
    assert crest_factor(sine) == pytest.approx(np.sqrt(2.0), rel=1e-5)
    assert reduced("ripple", sine) == pytest.approx(np.sqrt(0.5) / 7.0, rel=1e-6)
    noise = np.random.default_rng(1).normal(size=200_000)
    assert kurtosis(noise) == pytest.approx(3.0, abs=0.05)
    spiky = noise.copy()
    spiky[::1000] += 10.0
    assert kurtosis(spiky) > 8.0


def test_lines_of_known_signals():
    t = np.arange(4_000) * STEP
    two = 2.0 * np.sin(2 * np.pi * 45.0 * t) + np.sin(2 * np.pi * 400.0 * t) + 3.0
    assert reduced("frequency", two) == pytest.approx(45.0, abs=1.0 / (4_000 * STEP))
    assert reduced("line_share", two) == pytest.approx(0.8, abs=0.01)  # 2^2/(2^2 + 1)
    assert reduced("mean_frequency", two) == pytest.approx(0.8 * 45.0 + 0.2 * 400.0, rel=0.01)
    noise = np.random.default_rng(2).normal(size=8_000)
    assert reduced("line_share", noise) < 0.02


def test_a_ratio_of_ripple_to_mean_ignores_the_sign():
    x = np.array([-2.0, -1.0, -3.0])
    assert reduced("ripple", x) == pytest.approx(np.sqrt(2 / 3) / 2)


def test_derived_variables_are_the_metrics_series(known_run, bearing):
    part = metrics.whole_revolutions(known_run)
    slip = DERIVED["element_slip_ratio"].compute(part, bearing)
    assert slip.dims == DERIVED["element_slip_ratio"].variable.dims
    radius = DERIVED["cage_whirl_radius"].compute(part, bearing)
    assert float(radius.mean()) == pytest.approx(40e-6, rel=1e-3)
    away = DERIVED["cage_radial_displacement"].compute(part, bearing)
    assert float(away.max()) == pytest.approx(40e-6 + np.hypot(10e-6, 20e-6), rel=1e-4)


def test_means_have_the_margins_of_their_windows(known_run, bearing):
    windows = element_passes(known_run, bearing)
    speed = known_run["cage_omega"].values
    record = REDUCTIONS["mean"].record(windows, speed)
    assert record.value == pytest.approx(speed.mean())
    assert np.isfinite(record.margin)


def test_margins_by_turns_hold_what_they_estimate():
    """The standard deviation of white noise, of known size 2, in most of 200 records."""
    rng = np.random.default_rng(5)
    std, inside = REDUCTIONS["std"], 0
    for _ in range(200):
        x = 2.0 * rng.normal(size=4000)
        half = std.margin_by_turns(x, STEP, 10)
        inside += abs(std.value(x, STEP) - 2.0) <= half
    assert 0.90 <= inside / 200 <= 0.99
    assert np.isnan(std.margin_by_turns(x, STEP, 4))


def test_the_mean_of_the_largest_of_each_turn():
    x = np.array([[1.0, 2.0], [5.0, 0.0], [3.0, 7.0], [0.0, 1.0], [4.0, 4.0], [2.0, 3.0]])
    reducer = REDUCTIONS["turn_max"]
    assert reducer.over_turns(x, 1.0, 3) == pytest.approx((5.0 + 7.0 + 4.0) / 3.0)
    assert reducer.over_turns(x, 1.0, 1) == reducer.over_turns(x, 1.0, 0) == 7.0
    assert np.isnan(reducer.margin_by_turns(x, 1.0, 3))  # too few turns
    steady = np.tile(x, (2, 1))
    assert reducer.margin_by_turns(steady, 1.0, 6) == pytest.approx(
        2.5706 * np.std([5, 7, 4] * 2, ddof=1) / 6**0.5, rel=1e-4
    )
