"""The low-pass of results gives what SciPy's does, and a filter goes on from block to block."""

import subprocess
import sys

import numpy as np
import pytest
from scipy.signal import butter, sosfilt, sosfiltfilt

from flexcage.results.lowpass import butterworth, low_passed, low_passed_both_ways

CUTS = [0.02, 0.2, 0.5, 0.95]


@pytest.fixture
def samples():
    return np.random.default_rng(3).normal(size=(300, 3)).cumsum(axis=0)


@pytest.mark.parametrize("cut", CUTS)
def test_the_filter_is_scipys(samples, cut):
    sections = butter(4, cut, output="sos")
    np.testing.assert_allclose(butterworth(cut), sections, rtol=1e-11)
    wanted = sosfilt(sections, samples, axis=0)
    found = low_passed(butterworth(cut), samples, np.zeros((2, 2, 3)))
    np.testing.assert_allclose(found, wanted, atol=1e-10 * np.abs(wanted).max())


@pytest.mark.parametrize("cut", CUTS)
def test_both_ways_as_scipy(samples, cut):
    wanted = sosfiltfilt(butter(4, cut, output="sos"), samples, axis=0)
    found = low_passed_both_ways(butterworth(cut), samples)
    np.testing.assert_allclose(found, wanted, atol=1e-10 * np.abs(wanted).max())


def test_blocks_are_filtered_as_one(samples):
    sections, state = butterworth(0.2), np.zeros((2, 2, 3))
    parts = [low_passed(sections, part, state) for part in np.array_split(samples, 4)]
    whole = low_passed(sections, samples, np.zeros((2, 2, 3)))
    np.testing.assert_array_equal(np.concatenate(parts), whole)


def test_the_figures_of_a_run_import_no_heavy_part_of_scipy():
    code = (
        "import sys, flexcage.simulate, flexcage.results.lowpass as lowpass; import numpy; "
        "lowpass.low_passed_both_ways(lowpass.butterworth(0.1), numpy.ones((40, 1))); "
        "print(*[m for m in sys.modules if m in ('scipy.signal', 'scipy.stats')])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert not done.stdout.split()
