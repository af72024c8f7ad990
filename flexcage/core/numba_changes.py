"""Methods of numba that flexcage replaces while it compiles its own kernels, and only then.

They are numba's internals, so they are replaced only in releases that the tests have run with, and
put back after each compilation: whoever else uses numba in the process sees it unchanged. Without
them kernels give the same numbers, and compile more slowly into larger files: in processor time of
the rollers' largest kernel three times as long without all of them, 1.4 times without parts left
unfinished, 1.3 times without calls at an address; the balls' kernels take a tenth longer (numba
0.68, measured in 2026-11).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

import numba
from numba.core import cgutils
from numba.core.codegen import CPUCodeLibrary, JITCPUCodegen
from numba.core.compiler_lock import global_compiler_lock
from numba.core.lowering import Lower

from flexcage.core.kernel_values import KernelType

#: First release of numba with these methods as tested, and the first one not tested.
TESTED = (0, 62), (0, 69)
#: A function whose qualified name begins so is only ever inlined into others.
PART_NAME = "flexcage_part."


def is_tested(version: str) -> bool:
    """Whether the methods of this release of numba may be replaced."""
    major, minor = (int(number) for number in version.split(".")[:2])
    return TESTED[0] <= (major, minor) < TESTED[1]


def _optimise(whole: Callable[..., None]) -> Callable[..., None]:
    """Leave a part as it is until a caller inlines it: numba optimises it there again."""

    def optimise(library: CPUCodeLibrary) -> None:
        if not library.name.startswith(PART_NAME):
            whole(library)

    return optimise


def _finalise(ready: Callable[..., None]) -> Callable[..., None]:
    """Make no machine code of a part."""

    def finalise(library: CPUCodeLibrary) -> None:
        if library.name.startswith(PART_NAME):
            library._finalized = True
        else:
            ready(library)

    return finalise


def _set_environment(address: Callable[..., None]) -> Callable[..., None]:
    """Skip a part's environment, which has no address."""

    def set_environment(codegen: JITCPUCodegen, name: str, environment: Any) -> None:
        if codegen._engine.is_symbol_defined(name):
            address(codegen, name, environment)

    return set_environment


def _call_at_address(call: Callable[..., Any]) -> Callable[..., Any]:
    """Call a kernel at its address, where numba looks first whether there is one."""

    def lower(self: Any, kind: Any, expression: Any, signature: Any) -> Any:
        if not isinstance(kind, KernelType):
            return call(self, kind, expression, signature)
        result, arguments = signature.return_type, signature.args
        values = self.fold_call_args(
            kind, signature, expression.args, expression.vararg, expression.kws
        )
        proxy = cgutils.create_struct_proxy(kind)
        value = proxy(self.context, self.builder, value=self.loadvar(expression.func.name))
        convention = self.context.call_conv
        pointer = convention.get_function_type(result, arguments).as_pointer()
        status, returned = convention.call_function(
            self.builder, self.builder.bitcast(value.jit_addr, pointer), result, arguments, values
        )
        with cgutils.if_unlikely(self.builder, status.is_error):
            convention.return_status_propagate(self.builder, status)
        return returned

    return lower


#: Class and name of each method, and what makes the new one from it.
METHODS: tuple[tuple[type, str, Callable[..., Any]], ...] = (
    (CPUCodeLibrary, "_optimize_final_module", _optimise),
    (CPUCodeLibrary, "_finalize_final_module", _finalise),
    (JITCPUCodegen, "set_env", _set_environment),
    (Lower, "_lower_call_FunctionType", _call_at_address),
)
_complete = all(name in vars(owner) for owner, name, _ in METHODS)
_under_way = False  # a compilation, inside which others may begin


@contextmanager
def own_compilation() -> Iterator[None]:
    """Within it numba compiles as flexcage wants; other threads wait to compile, as always."""
    global _under_way
    if not (_complete and is_tested(numba.__version__)):
        yield
        return
    with global_compiler_lock:
        if _under_way:
            yield
            return
        originals = [(owner, name, vars(owner)[name]) for owner, name, _ in METHODS]
        _under_way = True
        try:
            for owner, name, make in METHODS:
                setattr(owner, name, make(vars(owner)[name]))
            yield
        finally:
            _under_way = False
            for owner, name, original in originals:
                setattr(owner, name, original)
