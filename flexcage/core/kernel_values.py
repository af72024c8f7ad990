"""Kernels as values: laws and other kernels that a kernel receives, and calls.

numba's type of functions as values also stands for Python functions. Whoever takes or calls such
a value then holds its whole signature, pickled; with a bearing's groups of arrays in that, it was
nine tenths of all compiled code (measured). Here a value is a kernel, compiled for one signature.
"""

from __future__ import annotations

import hashlib
from typing import Any

from numba import types
from numba.core import cgutils
from numba.experimental.function_type import FunctionModel
from numba.extending import NativeValue, register_model, unbox

from flexcage.core.type_texts import described

_ADDRESS = "_flexcage_address"  # of a kernel, kept by it


def short_name(kind: str, content: Any) -> str:
    """A type's name for what may take many lines to name: names are part of compiled code."""
    return f"{kind}({hashlib.sha256(described(content).encode()).hexdigest()[:16]})"


class KernelType(types.FunctionType):
    """Type of kernels that are compiled for one signature."""

    def __init__(self, signature: Any) -> None:
        super().__init__(signature)
        self._name = short_name("Kernel", self.signature)

    @property
    def key(self) -> str:
        return self._name

    @property
    def name(self) -> str:
        return self._name


register_model(KernelType)(FunctionModel)


def kernel_address(kernel: Any) -> int:
    """Address of the only function that is compiled of a kernel, looked up once."""
    if not hasattr(kernel, _ADDRESS):
        (compiled,) = kernel.overloads.values()
        found = compiled.library.get_pointer_to_function(compiled.fndesc.llvm_func_name)
        setattr(kernel, _ADDRESS, found)
    return getattr(kernel, _ADDRESS)


@unbox(KernelType)
def _unbox(kind, kernel, c):
    """The address, found by ``kernel_address``."""
    name = c.context.insert_const_string(c.builder.module, __name__)
    module = c.pyapi.import_module(name)
    find = c.pyapi.object_getattr_string(module, kernel_address.__name__)
    c.pyapi.decref(module)
    found = c.pyapi.call_function_objargs(find, (kernel,))
    c.pyapi.decref(find)
    with c.builder.if_then(cgutils.is_null(c.builder, found), likely=False):
        c.builder.ret(c.pyapi.get_null_object())
    value = cgutils.create_struct_proxy(kind)(c.context, c.builder)
    value.jit_addr = c.pyapi.long_as_voidptr(found)
    c.pyapi.decref(found)
    value.py_addr = c.builder.ptrtoint(kernel, c.context.get_value_type(types.voidptr))
    return NativeValue(value._getvalue())
