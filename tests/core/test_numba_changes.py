"""flexcage changes numba only while it compiles its own kernels, and can do without."""

import re
from contextlib import contextmanager
from pathlib import Path

import numba
import numpy as np
import pytest
from numba import types
from numba.core.targetconfig import TargetConfig

from flexcage.core import numba_changes
from flexcage.core.jit import kernel, part

pytestmark = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="needs compiled kernels")
REAL = types.float64


def _methods():
    return [vars(owner)[name] for owner, name, _ in numba_changes.METHODS]


def _compiled_with_a_part():
    """A kernel with a part, compiled: 5 x^2."""

    @part
    def squared(x):
        return x * x

    @kernel(REAL(REAL), cache=False)
    def sum_of_squares(x):
        return squared(x) + squared(2.0 * x)

    return sum_of_squares


def test_numba_is_as_it_was_after_a_kernel_was_compiled(monkeypatch):
    before, during = _methods(), []

    @contextmanager
    def watched():
        with numba_changes.own_compilation():
            during.append(_methods())
            yield

    monkeypatch.setattr("flexcage.core.jit.own_compilation", watched)
    assert _compiled_with_a_part()(3.0) == 45.0
    assert _methods() == before
    assert during and all(new is not old for new, old in zip(during[0], before, strict=True))
    assert {m.__module__ for m in before} == {
        "numba.core.codegen", "numba.core.lowering",
    }  # fmt: skip
    assert {TargetConfig.__eq__.__module__, TargetConfig.__hash__.__module__} == {
        "numba.core.targetconfig"
    }


def test_numba_is_as_it_was_after_a_kernel_that_cannot_be_compiled():
    before = _methods()
    with pytest.raises(numba.errors.TypingError):

        @kernel(REAL(REAL), cache=False)
        def wrong(x):
            return x.nothing

    assert _methods() == before


def test_another_users_function_compiles_as_numba_has_it():
    @numba.njit
    def total(values):
        return values.sum()

    assert _compiled_with_a_part()(1.0) == 5.0
    assert total(np.arange(4.0)) == 6.0


def test_kernels_are_the_same_in_a_release_that_was_not_tested(monkeypatch):
    monkeypatch.setattr(numba, "__version__", "9.0.0")
    monkeypatch.setattr(
        numba_changes, "METHODS", tuple((c, n, _never) for c, n, _ in numba_changes.METHODS)
    )
    assert _compiled_with_a_part()(3.0) == 45.0


def _never(original):
    raise AssertionError("nothing is replaced in a release that was not tested")


@pytest.mark.parametrize(
    "version, tested",
    [("0.61.2", False), ("0.62.0", True), ("0.68.1", True), ("0.69.0", False), ("1.0.0", False)],
)
def test_the_tested_releases(version, tested):
    assert numba_changes.is_tested(version) is tested


def test_the_tested_releases_are_those_that_are_declared():
    text = (Path(__file__).parents[2] / "pyproject.toml").read_text("utf-8")
    low, high = re.search(r'"numba>=([\d.]+),<([\d.]+)"', text).groups()
    assert numba_changes.TESTED == tuple(tuple(map(int, v.split("."))) for v in (low, high))
