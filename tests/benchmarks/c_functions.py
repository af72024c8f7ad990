"""A bearing's functions as C functions, so that any integrator may call them at their own cost.

numba's wrappers for Python hand over the bearing's groups of arrays one by one, which takes over a
millisecond. Here the arguments are kept in memory as compiled code holds them, and each C function
reads them from there; a call through ctypes then costs a few microseconds.
"""

from __future__ import annotations

import ctypes
from typing import Any

import numba
import numpy as np
from numba import types
from numba.extending import intrinsic
from numba.np.arrayobj import populate_array

from flexcage.core.jit import WITHOUT_NRT
from flexcage.system.data import POWERS
from flexcage.system.problem import BearingSystem

_POINTER, _REAL = types.CPointer(types.float64), types.float64
_HELD = 4096  # bytes kept for the arguments of a bearing
_NAMES = ("residual", "linearise", "factor", "backsolve", "note", "rates")


@intrinsic
def _put(_typing, address, value):
    """Store a value as it is, without counting references."""

    def codegen(context, builder, signature, args):
        kind = context.get_value_type(signature.args[1])
        builder.store(args[1], builder.inttoptr(args[0], kind.as_pointer()))
        return context.get_dummy_value()

    return types.void(address, value), codegen


@intrinsic
def _size(_typing, value):
    """Bytes of a value."""

    def codegen(context, builder, signature, args):
        size = context.get_abi_sizeof(context.get_value_type(signature.args[0]))
        return context.get_constant(types.intp, size)

    return types.intp(value), codegen


@intrinsic
def vector(_typing, pointer, size):
    """The array of ``size`` elements at a pointer (numba's carray needs reference counts)."""
    kind = types.Array(pointer.dtype, 1, "C")

    def codegen(context, builder, signature, args):
        array = context.make_array(kind)(context, builder)
        item = context.get_constant(types.intp, kind.dtype.bitwidth // 8)
        populate_array(array, args[0], [args[1]], [item], item, None)
        return array._getvalue()

    return kind(pointer, types.intp), codegen


def reader(kind: types.Type) -> Any:
    """A compiled function that reads a value of this type from an address."""

    @intrinsic
    def read(_typing, address):
        def codegen(context, builder, signature, args):
            pointer = context.get_value_type(signature.return_type).as_pointer()
            return builder.load(builder.inttoptr(args[0], pointer))

        return kind(address), codegen

    return read


class CFunctions:
    """A bearing's ``residual``, ``rates``, ``setup``, ``solve``, ``accepted``, on float64 arrays.

    A snapshot: it calls the bearing with the arguments of the moment when it was made.
    """

    def __init__(self, bearing: BearingSystem) -> None:
        kinds = tuple(types.FunctionType(bearing.signature(name)) for name in _NAMES)
        both = types.Tuple((types.Tuple(kinds), bearing.data_type))
        self.bearing, self.size = bearing, bearing.layout.size
        functions = tuple(bearing.function(name) for name in _NAMES)
        self._keep = (functions, bearing.args)  # what the memory below refers to
        self._memory = np.zeros(_HELD, np.uint8)
        self.address = self._memory.ctypes.data
        _store(both)(self.address, self._keep)
        self.read = reader(both)
        self.out, self.power = np.zeros(self.size), np.zeros(len(POWERS))
        self._compile()

    def _compile(self) -> None:
        address, read, n, powers = self.address, self.read, self.size, len(POWERS)

        def residual(t, y, yd, out):
            fns, data = read(address)
            fns[0](t, vector(y, n), vector(yd, n), data, vector(out, n), vector(out, 0))

        def setup(t, y, yd, alpha):
            fns, data = read(address)
            fns[1](t, vector(y, n), vector(yd, n), data)
            return 1 if fns[2](alpha, data) else 0

        def solve(alpha, y, r):
            fns, data = read(address)
            fns[3](alpha, vector(y, n), vector(r, n), data)

        def accepted(t, y, yd, out, power):
            fns, data = read(address)
            fns[0](t, vector(y, n), vector(yd, n), data, vector(out, n), vector(power, powers))
            fns[4](t, vector(y, n), data)

        def rates(t, y, yd):
            fns, data = read(address)
            fns[5](t, vector(y, n), vector(yd, n), data, vector(yd, 0))

        three = (_REAL, _POINTER, _POINTER)
        self._residual = c_function(residual, types.void(*three, _POINTER))
        self._setup = c_function(setup, types.int64(*three, _REAL))
        self._solve = c_function(solve, types.void(*three))
        self._accepted = c_function(accepted, types.void(*three, _POINTER, _POINTER))
        self._rates = c_function(rates, types.void(*three))

    def residual(self, t: float, y: np.ndarray, yd: np.ndarray, out: np.ndarray) -> None:
        """F(t, y, y') into ``out``."""
        self._residual(t, y.ctypes.data, yd.ctypes.data, out.ctypes.data)

    def rates(self, t: float, y: np.ndarray, yd: np.ndarray) -> None:
        """y' into ``yd``, and into y what the constraints hold."""
        self._rates(t, y.ctypes.data, yd.ctypes.data)

    def setup(self, t: float, y: np.ndarray, yd: np.ndarray, alpha: float) -> None:
        """Factor dF/dy + alpha dF/dy' in bordered blocks."""
        if not self._setup(t, y.ctypes.data, yd.ctypes.data, alpha):
            raise RuntimeError("Newton's matrix is singular")

    def solve(self, alpha: float, y: np.ndarray, r: np.ndarray) -> None:
        """Newton step r <- -(that)^-1 r; alpha is the one of the factors."""
        self._solve(alpha, y.ctypes.data, r.ctypes.data)

    def accepted(self, t: float, y: np.ndarray, yd: np.ndarray) -> None:
        """A step was accepted: contacts remember their onset."""
        at = (x.ctypes.data for x in (y, yd, self.out, self.power))
        self._accepted(t, *at)


def _store(kind: types.Type) -> Any:
    """A compiled function that stores a value of this type at an address."""

    def store(address, value):
        if _size(value) > _HELD:
            return False
        _put(address, value)
        return True

    compiled = numba.njit(types.boolean(types.intp, kind), **{**WITHOUT_NRT, "cache": False})(store)

    def checked(address: int, value: Any) -> None:
        if not compiled(address, value):
            raise RuntimeError("a bearing's arguments take more memory than is kept for them")

    return checked


def c_function(function: Any, signature: Any) -> Any:
    """A ctypes function of a Python function for numba; pointers are given as integers."""
    compiled = numba.cfunc(signature, _nrt=False, error_model="numpy")(function)
    kinds = {_REAL: ctypes.c_double, types.int64: ctypes.c_int64, types.void: None}
    arguments = [kinds.get(kind, ctypes.c_void_p) for kind in signature.args]
    made = ctypes.CFUNCTYPE(kinds[signature.return_type], *arguments)(compiled.address)
    made.owner = compiled  # or its code is freed
    return made
