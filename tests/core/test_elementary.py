"""Powers and exponentials against numpy's."""

from __future__ import annotations

import numpy as np
import pytest

from flexcage.core.elementary import exponentials, powers
from flexcage.core.jit import kernel


@kernel
def _powers(n, x, a, out):
    powers(n, x, a, out)


@kernel
def _exponentials(n, x, c, out):
    exponentials(n, x, c, out)


@pytest.mark.parametrize("a", [1.0 / 9.0, 0.0, 0.5, 1.0, 1.5, 3.0])
def test_powers(a):
    x = np.concatenate([np.logspace(-16, 4, 4001), [1.0, 2.0, 0.5, np.nextafter(2.0, 0.0)]])
    out = np.full(len(x), np.nan)
    _powers(len(x), x, a, out)
    np.testing.assert_allclose(out, x**a, rtol=1e-13)


def test_powers_of_nothing_are_zero():
    x, out = np.array([0.0, -1e-6, -3.0, 1e-6]), np.full(4, np.nan)
    _powers(4, x, 0.0, out)
    np.testing.assert_array_equal(out, [0.0, 0.0, 0.0, 1.0])


def test_exponentials():
    x, out = np.linspace(-300.0, 300.0, 10001), np.empty(10001)
    _exponentials(len(x), x, 2.0, out)
    np.testing.assert_allclose(out, np.exp(2.0 * x), rtol=3e-13)
    _exponentials(2, np.array([-1e6, 0.0]), 1.0, out)  # too small to be a number: almost zero
    assert 0.0 <= out[0] < 1e-300 and out[1] == 1.0
