"""Classes of the cage's motion, of orbits that are known."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.signal import butter, sosfiltfilt

from flexcage.results.features import CIRCLING, STABLE, UNSTABLE, orbit_class
from flexcage.results.figures.part import SettledRun
from flexcage.results.figures.sections import summarise

CAGE = 0.98 * 2709.0909090909 * np.pi / 30  # rad/s, of ``known_run``


def classed(known_run, y, z):
    ds = known_run.copy(deep=True)
    ds["cage_position"].loc[{"axis": "y"}], ds["cage_position"].loc[{"axis": "z"}] = y, z
    return orbit_class(ds)


def noise(t, seed, cut):
    """White noise (2, n) of rms 1 up to ``cut`` [Hz]."""
    found = np.random.default_rng(seed).standard_normal((2, len(t)))
    found = sosfiltfilt(butter(4, cut, fs=1.0 / (t[1] - t[0]), output="sos"), found)
    return found / found.std(axis=1, keepdims=True)


@pytest.mark.parametrize("whirl", [1.0, -0.6, 2.3, 14.0])
def test_a_centre_that_goes_round_circles(known_run, whirl):
    """At 40 um about (10, -20) um, forward or backward, slow or fast; 4 um of rattle besides."""
    t = known_run["time"].values
    round_it = np.array([10e-6 + 40e-6 * np.cos(whirl * CAGE * t),
                         -20e-6 + 40e-6 * np.sin(whirl * CAGE * t)])  # fmt: skip
    found = classed(known_run, *round_it)
    assert found.kind == CIRCLING and found.order == pytest.approx(1.0)
    assert found.spread == pytest.approx(40 / np.hypot(40, np.hypot(10, 20)), rel=0.05)
    rattled = round_it + 4e-6 * noise(t, 1, 300.0) * max(1.0, abs(whirl)) ** 0.5 / 2.0
    assert classed(known_run, *rattled).kind == CIRCLING


def test_a_centre_that_stands_off_the_axis_or_creeps_is_stable(known_run):
    t = known_run["time"].values
    rattle = 5e-6 * noise(t, 2, 5e3)
    assert classed(known_run, 60e-6 + rattle[0], -20e-6 + rattle[1]).kind == STABLE
    small = 5e-6 * np.array([np.cos(9 * CAGE * t), np.sin(9 * CAGE * t)])  # a small circle there
    assert classed(known_run, 60e-6 + small[0], -20e-6 + small[1]).kind == STABLE
    creep = 0.2 * CAGE * t
    found = classed(known_run, 60e-6 * np.cos(creep), 60e-6 * np.sin(creep))
    assert found.kind == STABLE and found.pace == pytest.approx(0.2, rel=0.01)


@pytest.mark.parametrize("seed", range(5))
@pytest.mark.parametrize("cut", [150.0, 1000.0])
def test_a_centre_that_wanders_to_and_fro_is_unstable(known_run, seed, cut):
    """Noise within a clearance, so that it is thrown from wall to wall."""
    y, z = 40e-6 * np.tanh(2.0 * noise(known_run["time"].values, seed, cut))
    found = classed(known_run, y, z)
    assert found.kind == UNSTABLE and found.order < 0.8


def test_a_swing_along_a_line_and_a_circle_that_turns_back_are_unstable(known_run):
    t = known_run["time"].values
    swing = 40e-6 * np.sin(3 * CAGE * t)
    assert classed(known_run, swing, 1e-6 + 0.1 * swing).kind == UNSTABLE
    back = 8.0 * np.sin(0.3 * CAGE * t)
    assert classed(known_run, 40e-6 * np.cos(back), 40e-6 * np.sin(back)).kind == UNSTABLE


def test_less_than_a_turn_has_no_class_and_the_summary_says_the_class(known_run, bearing):
    assert orbit_class(known_run.isel(time=slice(1000))) is None  # 20 ms: 0.9 turns
    summary = summarise(SettledRun(known_run, bearing, 0.0))
    assert summary["cage_motion"] == CIRCLING
    assert "order 1; own rule" in summary.row("cage_motion").note
