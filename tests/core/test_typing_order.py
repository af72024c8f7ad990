"""numba's typing rules for numbers and arrays, tried first: they say what numba says without."""

import operator

import numba
import pytest
from numba import types
from numba.core.registry import cpu_target
from numba.core.typing.templates import Signature

from flexcage.core import jit, typing_order

pytestmark = pytest.mark.skipif(numba.config.DISABLE_JIT, reason="needs compiled kernels")
REAL, COUNT, FLAG = types.float64, types.int64, types.boolean
SHORT, COMPLEX = types.float32, types.complex128
VECTOR, MATRIX = types.Array(REAL, 1, "C"), types.Array(REAL, 2, "A")
PLACES = COUNT, types.uint64, types.slice2_type, types.literal(1), types.UniTuple(COUNT, 2)
BINARY = [o for o in typing_order._OF_NUMBERS if o is not operator.neg]


def kind_of(function) -> types.Function:
    cpu_target.typing_context.refresh()
    return cpu_target.typing_context.resolve_value_type(function)


def signature(function, *arguments) -> Signature:
    return kind_of(function).get_call_type(cpu_target.typing_context, arguments, {})


def without(function, *arguments) -> Signature:
    """What numba says where no rule is tried before the others."""
    kind = kind_of(function)
    rules = [r for r in kind.templates if getattr(r, "metadata", None) is not typing_order._FIRST]
    assert len(rules) == len(kind.templates) - 1  # ours is there, once
    return types.Function(rules).get_call_type(cpu_target.typing_context, arguments, {})


def agree(function, *arguments):
    found = signature(function, *arguments)
    assert found is not None and found == without(function, *arguments)


@pytest.mark.parametrize("function", BINARY)
@pytest.mark.parametrize("second", [REAL, COUNT, FLAG, SHORT, COMPLEX, types.literal(2), VECTOR])
@pytest.mark.parametrize("first", [REAL, COUNT, VECTOR])
def test_operators_on_numbers(function, first, second):
    ordered = function in (operator.lt, operator.le, operator.gt, operator.ge)
    in_place = function in (operator.iadd, operator.isub, operator.imul)
    if COMPLEX in (first, second) and ordered or in_place and VECTOR in (first, second):
        pytest.skip("numba has no such operation, or one that depends on more")
    agree(function, first, second)


@pytest.mark.parametrize("place", PLACES)
def test_places_in_arrays(place):
    array = MATRIX if isinstance(place, types.UniTuple) else VECTOR
    agree(operator.getitem, array, place)
    agree(operator.setitem, array, place, REAL)


@pytest.mark.parametrize("kind", [REAL, COUNT, FLAG])
def test_signs_and_truth(kind):
    agree(operator.neg, kind)
    agree(bool, kind)


def test_a_part_is_compiled_once_for_all_whole_numbers():
    @jit.part
    def times(n, x):
        return n * x

    @jit.part(of_constants=True)
    def times_constant(n, x):
        return n * x

    @jit.kernel(REAL(REAL), cache=False)
    def polynomial(x):
        return times(2, x) + times(3, x) + times_constant(2, x) + times_constant(3, x)

    assert polynomial(1.5) == 15.0
    assert len(times.signatures) == 1 and len(times_constant.signatures) == 2
