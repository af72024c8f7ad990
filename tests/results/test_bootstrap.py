"""Margins of means against processes whose mean and correlation are known."""

import numpy as np
import pytest
from scipy.signal import lfilter

from flexcage.results import bootstrap
from flexcage.results.statistics import Record, Windows, element_passes, spread


def records(count, n, phi, seed=3):
    """AR(1) records (count, n) of mean 0 and unit innovations, run in for 300 entries."""
    noise = np.random.default_rng(seed).standard_normal((count, n + 300))
    return lfilter([1.0], [1.0, -phi], noise, axis=1)[:, 300:]


@pytest.mark.parametrize(("phi", "least"), [(0.0, 0.90), (0.5, 0.85), (0.8, 0.80)])
def test_intervals_of_an_ar1_process_hold_its_mean(phi, least):
    """Nominal 95 %; fewer blocks know less, and a bootstrap of few is known to fall short."""
    found = records(300, 100, phi)
    margins = [bootstrap.margin(x) for x in found]
    held = np.abs(found.mean(axis=1)) < margins
    assert least < held.mean() < 0.99


@pytest.mark.parametrize("phi", [0.3, 0.5, 0.7])
def test_block_length_of_an_ar1_process(phi):
    """(2 phi/(1 - phi^2))^(2/3) n^(1/3): the optimum of Politis and White for this process."""
    n = 4000
    lengths = [bootstrap.block_length(x) for x in records(40, n, phi)]
    best = (2.0 * phi / (1.0 - phi**2)) ** (2.0 / 3.0) * n ** (1.0 / 3.0)
    assert np.median(lengths) == pytest.approx(best, rel=0.15)


def test_resampling_keeps_blocks_and_visits_all_alike():
    rows = bootstrap.resampled(50, 5.0, np.random.default_rng(0))
    follows = np.diff(rows, axis=1) % 50 == 1
    assert follows.mean() == pytest.approx(1.0 - 1.0 / 5.0 + 1.0 / 250.0, abs=0.01)
    assert np.bincount(rows.ravel()).std() < 0.1 * bootstrap.RESAMPLES


def test_margin_of_a_ratio_scales_and_a_short_record_has_none():
    x = records(1, 200, 0.5)[0] + 10.0
    table = np.stack([x, np.ones(200)], axis=1)
    one = Record(table).margin
    assert one == pytest.approx(bootstrap.margin(x), rel=0.02)
    assert Record(table * [1e-6, 1.0]).margin == pytest.approx(1e-6 * one)
    assert Record(np.ones((200, 2))).margin == 0.0
    assert np.isnan(Record(table[: bootstrap.FEWEST - 1]).margin)
    assert np.isnan(Record(table * [1.0, 0.0]).margin)


@pytest.mark.parametrize("turns", [2, 3, 6])
def test_what_repeats_with_every_turn_is_no_uncertainty(turns):
    """A wave ten times as large as the noise, of unknown mean 50: it neither widens the interval,
    nor makes it miss."""
    wave = 50.0 + 10.0 * np.sin(2.0 * np.pi * np.arange(22) / 22.0)
    held, widths, plain = [], [], []
    for noise in records(150, 22 * turns, 0.4):
        record = Record(np.stack([np.tile(wave, turns) + noise, np.ones(22 * turns)], 1), 22)
        held.append(abs(record.value - 50.0) < record.margin)
        widths.append(record.margin)
        plain.append(bootstrap.margin(noise))
    assert 0.75 < np.mean(held) < 1.0
    assert np.median(widths) == pytest.approx(np.median(plain), rel=0.3)


def test_windows_are_roller_passes(known_run, bearing):
    """0.1 s at 98 % of 2709.09 rpm are 4.425 turns, of 22 roller passes each."""
    windows = element_passes(known_run, bearing)
    assert len(windows.first) == round(0.98 * 2709.0909 / 60.0 * 0.1 * 22)
    assert np.ptp(np.diff(windows.first)) <= 1


def test_peaks_of_windows_do_not_grow_with_the_record():
    """Largest of 50 uniform numbers: 50/51 on average, however many windows there are."""
    for count in (40, 400):
        values = np.random.default_rng(1).random(50 * count)
        peak = Windows(50 * count, np.arange(count) * 50).peak(values)
        assert abs(peak.value - 50.0 / 51.0) < peak.margin < 0.02


def test_deviation_of_a_wave():
    """10 + sin: 1/sqrt(2) over 10."""
    x = 10.0 + np.sin(np.linspace(0.0, 60.0 * np.pi, 3000, endpoint=False))
    assert Windows(3000, np.arange(60) * 50).deviation(x).value == pytest.approx(0.1 / 2**0.5)


def test_drift_tells_a_settling_record_from_a_settled_one():
    """Halves of a stationary record lie apart in about one of twenty; a ramp's always do."""
    windows = Windows(100, np.arange(100))
    still = np.array([windows.mean(x).drift for x in records(100, 100, 0.3) + 9.0])
    assert 0.01 < (still > 1.0).mean() < 0.15
    ramp = 0.05 * np.arange(100)
    assert all(windows.mean(x + ramp).drift > 1.0 for x in records(5, 100, 0.3))
    assert np.isnan(Windows(30, np.arange(30)).mean(records(1, 30, 0.3)[0]).drift)


def test_what_repeats_with_the_turn_is_no_drift():
    """Halves of 4.5 turns are two whole turns each: a wave of a turn is then in both alike. Of
    settled records about one of twenty is taken for one that drifts; a ramp of seven turns is."""
    wave = 3.0 * np.sin(2.0 * np.pi * np.arange(154) / 22.0)
    windows, more = (Windows(n, np.arange(n), 22) for n in (100, 154))
    still = [9.0 + wave[:100] + noise for noise in records(100, 100, 0.8)]
    assert np.mean([windows.mean(x).drift > 1.0 for x in still]) < 0.15
    ramp = 9.0 + wave + 0.05 * np.arange(154)
    assert all(more.mean(ramp + noise).drift > 1.0 for noise in records(5, 154, 0.3))
    gone = windows.ratio(np.repeat([1.0, 0.0], 50), np.repeat([1.0, 0.0], 50))
    assert gone.drift == np.inf, "what there is in one half alone"


def test_spread_of_a_ratio_leaves_out_what_both_runs_do():
    """A common part thirty times as large as what differs: the ratio is known thirty times as
    well as from the runs' own margins, and the interval holds the truth, 1, as it should."""
    held, shares = [], []
    for common, *own in zip(
        records(100, 80, 0.6, 1), records(100, 80, 0.6, 2), records(100, 80, 0.6)
    ):
        one, other = (Record(np.stack([50.0 + common + x / 30.0, np.ones(80)], 1)) for x in own)
        width = spread(one, other)
        held.append(abs(one.value / other.value - 1.0) < width)
        shares.append(width / (np.hypot(one.margin, other.margin) / other.value))
    assert 0.8 < np.mean(held) < 1.0
    assert np.median(shares) == pytest.approx(1.0 / 30.0, rel=0.3)
