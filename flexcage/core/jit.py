"""Compilation of kernels: options in one place, and boxes by which kernels receive arrays.

Kernels are kept on disk (``kernel_cache``), each under a key of what it was made from.
"""

from __future__ import annotations

import os
import re
import struct
import warnings
from pathlib import Path
from typing import Any

import numba
import numpy as np
from llvmlite import ir
from numba import types
from numba.core import cgutils
from numba.core.imputils import impl_ret_borrowed, lower_getattr_generic
from numba.core.typing.templates import AttributeTemplate, infer_getattr
from numba.extending import (
    NativeValue,
    intrinsic,
    models,
    register_model,
    typeof_impl,
    unbox,
)

from flexcage.core.garbage import uncollected
from flexcage.core.kernel_cache import KernelCache
from flexcage.core.kernel_files import KernelFolder, kernel_cache_dir
from flexcage.core.kernel_values import short_name
from flexcage.core.numba_changes import PART_NAME, own_compilation

#: Where kernels are kept; numba's own variable puts them, and what numba keeps, elsewhere.
kernel_folder = KernelFolder(Path(os.environ.get("NUMBA_CACHE_DIR") or kernel_cache_dir()))
# laws are passed to kernels as first-class functions, which numba calls experimental
warnings.simplefilter("ignore", numba.errors.NumbaExperimentalFeatureWarning)

OPTIONS: dict[str, Any] = {"cache": True, "error_model": "numpy", "fastmath": False}
# without numba's reference counts a kernel cannot allocate, and a call that hands over a hundred
# arrays costs 10 ns instead of 150 (measured); whoever calls owns the arrays
WITHOUT_NRT = {**OPTIONS, "_nrt": False}
VECTORISED = {"reassoc", "nsz", "contract"}  # fastmath: long sums may be added in any order
# parts are inlined into their callers: handing large groups of arrays from one compiled function
# to another costs more than the mathematics between; wrappers for Python double the compile time
PART = {
    **WITHOUT_NRT,
    "cache": False,
    "forceinline": True,
    "no_cpython_wrapper": True,
    "no_cfunc_wrapper": True,
}


def kernel(*args: Any, **kwargs: Any) -> Any:
    """``numba.njit`` for code that allocates nothing; the compiler refuses it otherwise.

    The plain function is ``.py_func``.
    """
    if args and callable(args[0]):
        return _jitted(args[0], None, WITHOUT_NRT)
    signature = args[0] if args else None
    return lambda function: _jitted(function, signature, {**WITHOUT_NRT, **kwargs})


def _jitted(function: Any, signature: Any, options: dict[str, Any]) -> Any:
    """``numba.njit``, for one signature or for any, with kernels kept on disk by our own cache."""
    made = numba.njit(**{**options, "cache": False})(function)
    if numba.config.DISABLE_JIT:  # type: ignore[attr-defined]
        return made
    made.compile = _as_our_own(made.compile)
    if options["cache"]:
        made._cache = KernelCache(made, kernel_folder)
    if signature is not None:
        made.compile(signature)
        made.disable_compile()
    return made


def _as_our_own(compile_for: Any) -> Any:
    """A kernel's method that compiles it, or reads it from disk, with our changes to numba."""

    def compile_as_our_own(signature: Any) -> Any:
        with own_compilation():
            return compile_for(signature)

    return compile_as_our_own


def kernel_of(function: Any, signature: Any) -> Any:
    """A kernel of a user's function for one signature."""
    return kernel(signature)(function)


_NO_REASON = ("Failed in nopython mode", "- Resolution failure")
_WHY = {  # of what numba says to what it means
    "return_value": "it returns a value, but must write into the arrays that it is given, and "
    "return nothing",
    "NRT required": "it makes an array of its own, but must write into those that it is given, "
    "entry by entry, as F[i] = p[0] * d[i]",
    "No implementation of function Function(<built-in function": "numba does not know this "
    "operation for numbers and arrays of numbers",
}


def why_not_compiled(error: Exception) -> str:
    """Why a user's function cannot be compiled, in words or by the line of numba's that says it,
    and where that is in the user's file."""
    text = str(error)
    lines = [line.strip() for line in text.splitlines() if line.strip()]
    said = (line for line in lines if not line.startswith(_NO_REASON))
    reason = next((why for mark, why in _WHY.items() if mark in text), None)
    reason = reason or next(said, type(error).__name__).rstrip(".:")
    places = re.findall(r'File "([^"]+)", line (\d+):', text)
    own = [(file, line) for file, line in places if "site-packages" not in file]
    return f"{reason} (line {own[0][1]} of {own[0][0]})" if own else reason


def part(*args: Any, **kwargs: Any) -> Any:
    """A kernel that only other kernels call: inlined there, not callable from Python."""
    if not (args and callable(args[0])):
        return lambda function: part(function, **kwargs)
    args[0].__qualname__ = PART_NAME + args[0].__qualname__  # known below by it
    return numba.njit(**{**PART, **kwargs})(args[0])


outlined = part(forceinline=False)  # a part that stays a function: large, or rarely called


def allocating_kernel(function: Any) -> Any:
    """``kernel`` for the few that make arrays or boxes, away from the contact loops."""
    return _jitted(function, None, OPTIONS)


_compiled: dict[tuple[Any, ...], Any] = {}


def compiled(function: Any, signature: Any, options: dict[str, Any] = WITHOUT_NRT) -> Any:
    """``function`` compiled for one signature, once in a process: compiled code is never freed."""
    key = function, signature, tuple(options.items())
    if key not in _compiled:
        with uncollected():
            _compiled[key] = _jitted(function, signature, options)
    return _compiled[key]


def entry_of(kernel: Any) -> Any:
    """What a kernel for one signature is in Python, for arguments that certainly fit it.

    A kernel finds the types of its arguments at every call; of tuples of kernels that takes
    milliseconds.
    """
    if not hasattr(kernel, "overloads"):
        return kernel
    (compiled_for,) = kernel.overloads.values()
    return compiled_for.entry_point


def cache_environment() -> dict[str, str]:
    """Environment variables by which another process finds the same cache, which can be written
    if there is any way."""
    kernel_folder.ensure_writable()
    return {"NUMBA_CACHE_DIR": str(kernel_folder.place or kernel_folder.path)}


class Box:
    """A NamedTuple of arrays and numbers as one address: a call passes that for all of them.

    At the address stands what numba's compiled functions take the NamedTuple to be; a box holds
    its arrays, so that they live as long. (Made by a compiled function, boxes took 5 s to compile.)
    """

    def __init__(self, value: Any) -> None:
        self.value, self.type = value, BoxType(numba.typeof(value))
        self.words = np.array([word for field in value for word in _words(field)], np.int64)
        self.address = self.words.ctypes.data


def _words(field: Any) -> list[int]:
    """The 64-bit words of a field: of an array no owner, sizes, address, shape and strides."""
    if isinstance(field, np.ndarray):
        return [0, 0, field.size, field.itemsize, field.ctypes.data, *field.shape, *field.strides]
    if isinstance(field, float):
        return list(struct.unpack("<q", struct.pack("<d", field)))
    return [int(field)]


class BoxType(types.Type):
    """Type of a ``Box`` that holds a value of type ``held``."""

    def __init__(self, held: Any) -> None:
        self.held = held
        super().__init__(short_name("Box", held))


register_model(BoxType)(models.OpaqueModel)


@typeof_impl.register(Box)
def _type_of_box(box, _context):
    return box.type


@unbox(BoxType)
def _unbox(_kind, box, context):
    address = context.pyapi.object_getattr_string(box, "address")
    pointer = context.pyapi.long_as_voidptr(address)
    context.pyapi.decref(address)
    return NativeValue(pointer, is_error=context.pyapi.c_api_error())


def boxed(value: Any) -> Any:
    """A ``Box`` of the value."""
    return Box(value)


class FieldsType(types.Type):
    """Type of what ``fields`` returns: still an address, of which each use reads what it needs."""

    def __init__(self, held: Any) -> None:
        self.held = held
        super().__init__(short_name("Fields", held))


register_model(FieldsType)(models.OpaqueModel)


@intrinsic
def fields(_typing, box):
    """The NamedTuple that a box holds, as far as its fields go.

    None of them changes while a kernel runs, so the compiler may read a field where it is used.
    (All read at once were too many for registers: a seventh of an evaluation, measured.)
    """
    return FieldsType(box.held)(box), lambda _context, _builder, _signature, args: args[0]


@infer_getattr
class _Field(AttributeTemplate):
    key = FieldsType

    def generic_resolve(self, value, name):
        held = value.held
        return held.types[held.fields.index(name)] if name in held.fields else None


@lower_getattr_generic(FieldsType)
def _read_field(context, builder, kind, address, name):
    held, k = kind.held, kind.held.fields.index(name)
    record = builder.bitcast(address, context.get_value_type(held).as_pointer())
    field = held.types[k]
    if not isinstance(field, types.Array):
        return _constant_at(builder, record, k)
    value = ir.Constant(context.get_value_type(field), None)  # without an owner
    words = [(2,), (4,), *((p, axis) for p in (5, 6) for axis in range(field.ndim))]
    for place in words:  # size, address, shape and strides
        value = builder.insert_value(value, _constant_at(builder, record, k, *place), place)
    itemsize = context.get_abi_sizeof(context.get_data_type(field.dtype))
    value = builder.insert_value(value, ir.IntType(64)(itemsize), 3)
    return impl_ret_borrowed(context, builder, field, value)


def _constant_at(builder: Any, record: Any, *place: int) -> Any:
    """The word at a place in a record that is never written to."""
    word = builder.load(cgutils.gep_inbounds(builder, record, 0, *place))
    word.set_metadata("invariant.load", builder.module.add_metadata([]))
    return word


def _bitcast(to: Any) -> Any:
    """An intrinsic that reads the bits of a 64-bit number as another type."""

    @intrinsic
    def read_as(_typing, x):
        def codegen(context, builder, signature, args):
            return builder.bitcast(args[0], context.get_value_type(to))

        return to(x), codegen

    return read_as


@intrinsic
def array_from(_typing, field, first):
    """An array field of a record from a place on, as an ordinary array; its length is not cut.

    (numba's own conversion refuses, and its slices are slow to compile.)
    """
    kind = types.Array(field.dtype, field.ndim, "C")

    def codegen(context, builder, signature, args):
        array = context.make_array(kind)(context, builder, args[0])
        array.data = cgutils.gep_inbounds(builder, array.data, args[1])
        return impl_ret_borrowed(context, builder, kind, array._getvalue())

    return kind(field, first), codegen


bits_of, real_of = _bitcast(types.int64), _bitcast(types.float64)
if numba.config.DISABLE_JIT:  # type: ignore[attr-defined]
    # kernels as plain Python, for a debugger

    def boxed(value):
        return value

    def fields(box):
        return box

    def array_from(field, first):
        return field[first:]

    def bits_of(x):
        return struct.unpack("<q", struct.pack("<d", x))[0]

    def real_of(bits):
        return struct.unpack("<d", struct.pack("<q", bits))[0]


@part
def copy_into(target, source):
    """Copy a C-contiguous array into one of the same size, element by element."""
    if target.ndim == 1:  # nothing to reshape, which is a call
        for k in range(source.shape[0]):
            target[k] = source[k]
    else:
        a, b = target.reshape(target.size), source.reshape(source.size)
        for k in range(b.shape[0]):
            a[k] = b[k]


@part
def zero(array):
    """Set an array to zero."""
    array[...] = 0
