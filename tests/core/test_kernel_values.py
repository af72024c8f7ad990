"""Kernels as values are called at their address, and code holds nothing of their signature."""

from collections import namedtuple

import numba
import numpy as np
import pytest
from numba import types

from flexcage.core.jit import boxed, kernel
from flexcage.core.kernel_values import KernelType

pytestmark = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="needs compiled kernels")
Many = namedtuple("Many", [f"a_field_that_nobody_else_has_{k}" for k in range(40)])


def _taken():
    """A kernel that takes another, whose signature names much, and calls it; the type of that."""
    group = boxed(Many(*[np.zeros(2)] * 40))
    value = KernelType(types.float64(types.float64, group.type))

    @kernel(types.float64(value, types.float64, group.type), cache=False)
    def call(law, x, box):
        return 1.0 + law(x, box)

    return call, value, group


def test_a_kernel_is_called_as_a_value():
    call, value, group = _taken()

    @kernel(value.signature, cache=False)
    def double(x, box):
        return 2.0 * x

    @kernel(value.signature, cache=False)
    def half(x, box):
        return 0.5 * x

    assert call(double, 3.0, group) == 7.0
    assert call(half, 3.0, group) == 2.5


def test_code_holds_no_signature():
    call, _, _ = _taken()
    (compiled,) = call.overloads.values()
    code, _ = compiled.library.serialize_using_object_code()[2]
    assert b"a_field_that_nobody_else_has" not in code


def test_another_signature_is_refused():
    call, _, group = _taken()

    @kernel(types.float64(types.float64), cache=False)
    def other(x):
        return x

    with pytest.raises(TypeError):
        call(other, 3.0, group)
