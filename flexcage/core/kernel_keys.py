"""The key of a kernel: a digest of all that its compiled code was made from.

numba's own cache looks at the compiled function's file alone. But a kernel takes in the functions
that it calls, the constants that they read, default arguments, layouts of NamedTuples and types of
arguments: a change in any of them, in whatever file, is a change of the kernel. So a key follows a
function from name to name, as numba does, and digests bytecode and values. Text that is not run, as
comments and docstrings, does not count, nor do functions beside it that it does not call. What a
kernel receives as a value, as a law, is called through a pointer: its signature counts.

What lies outside, in Python, numba and numpy, is digested as its name and the versions of these.
What is of a kind that is not known here makes a kernel that is not kept at all.
"""

from __future__ import annotations

import builtins
import enum
import hashlib
import platform
import sys
from collections.abc import Callable, Iterable, Mapping
from functools import cache
from pathlib import Path
from types import EllipsisType, FunctionType, ModuleType, NoneType
from typing import Any

import numba
import numpy as np
from llvmlite.binding import get_host_cpu_name
from numba import types
from numba.core.dispatcher import Dispatcher
from numba.core.extending import _Intrinsic

from flexcage.core.code_texts import exact, facts_of
from flexcage.core.type_texts import UnknownContent, class_name, described

_CORE = Path(__file__).resolve().parent
_FILES = "jit", "kernel_cache", "kernel_keys", "kernel_values", "numba_changes", "type_texts"
#: Files whose code makes other code: what is edited there may change every kernel.
COMPILER = tuple(_CORE / f"{name}.py" for name in _FILES)
_VERSIONED = ("numba", "numpy", "llvmlite")
_PYTHON = Path(enum.__file__).resolve().parent
_SETTINGS = (
    "CPU_NAME", "CPU_FEATURES", "OPT", "LOOP_VECTORIZE", "SLP_VECTORIZE", "BOUNDSCHECK",
    "DEBUGINFO_DEFAULT",
)  # fmt: skip
_PLAIN = (bool, int, float, complex, str, bytes, NoneType, EllipsisType)


def kernel_key(kernel: Dispatcher, signature: Any, *more: str) -> str:
    """32 digits that change with what ``kernel`` is made of for a signature, a tuple of types or
    one with a result; ``more``: what else it depends on.

    Raises UnknownContent.
    """
    content = _Content()
    content.write(compiler_key(), described(signature), *more)
    content.add(kernel)
    return content.hexdigest()


def content_key(value: Any) -> str:
    """32 digits that change with the content of a function, a constant or a class, not with how
    functions are compiled: one that will be, as an integrator's, is the same before.

    Raises UnknownContent.
    """
    content = _Content(of_sources=True)
    content.add(value)
    return content.hexdigest()


@cache
def compiler_key() -> str:
    """32 digits that change with what compiles, and for what processor: versions, settings of
    numba, our own files."""
    digest = hashlib.sha256()
    for name in _VERSIONED:
        digest.update(f"{name} {sys.modules[name].__version__}\n".encode())
    python = f"{sys.implementation.cache_tag} {platform.python_version()}"
    digest.update(f"{python} {get_host_cpu_name()}\n".encode())
    for name in _SETTINGS:
        digest.update(f"{name} {getattr(numba.config, name, None)}\n".encode())
    for path in COMPILER:
        digest.update(path.read_bytes())
    return digest.hexdigest()[:32]


class _Content:
    """A digest of values and of all that they refer to, each where it is met first; ``of_sources``:
    compiled functions are as they are written."""

    def __init__(self, *, of_sources: bool = False) -> None:
        self._of_sources = of_sources
        self._digest = hashlib.sha256()
        self._met: dict[int, tuple[int, Any]] = {}  # its number; kept alive, as ids are used again

    def hexdigest(self) -> str:
        return self._digest.hexdigest()[:32]

    def write(self, *texts: object) -> None:
        for text in texts:
            data = text if isinstance(text, bytes) else str(text).encode()
            self._digest.update(b"%d:" % len(data))
            self._digest.update(data)

    def add(self, value: Any) -> None:
        """Take in a value."""
        if self._of_sources and isinstance(value, Dispatcher):
            value = value.py_func
        if isinstance(value, _PLAIN) and type(value) in _PLAIN:
            self.write(exact(value))
            return
        for kind, take in _VALUES:
            if isinstance(value, kind):
                take(self, value)
                return
        if self._is_new(value):
            self._referred(value)

    def _is_new(self, value: Any) -> bool:
        """Whether something that refers to others is met for the first time; else its number is
        taken in."""
        if found := self._met.get(id(value)):
            self.write("met", found[0])
            return False
        self._met[id(value)] = len(self._met), value
        return True

    def _referred(self, value: Any) -> None:
        if name := _name_outside(value):
            self.write("outside", name)
            return
        for kind, take in _REFERRING:
            if isinstance(value, kind):
                take(self, value)
                return
        raise UnknownContent(f"{value!r:.80} of the type {type(value).__name__}")

    def _function(self, function: FunctionType) -> None:
        facts = facts_of(function.__code__, function.__doc__)
        self.write("function", facts.text)
        self.add(function.__defaults__)
        for name, value in sorted((function.__kwdefaults__ or {}).items()):
            self.write(name)
            self.add(value)
        for value in _closed_over(function):
            self._named(value, facts.attributes)
        for name in facts.globals:
            self.write(name)
            if name in function.__globals__:
                self._named(function.__globals__[name], facts.attributes)
            else:
                self.write("builtin" if hasattr(builtins, name) else "missing")

    def _named(self, value: Any, attributes: Iterable[str]) -> None:
        """A global; of a module, what may be read of it by these names."""
        if not isinstance(value, ModuleType):
            self.add(value)
            return
        self.write("module", value.__name__)
        if _outside(value.__name__) or not self._is_new(value):
            return
        for name in attributes:
            if name in vars(value):
                self.write(name)
                self._named(vars(value)[name], attributes)

    def _kernel(self, kernel: Dispatcher) -> None:
        options = {name: _sorted(option) for name, option in kernel.targetoptions.items()}
        self.write("kernel", sorted(options.items()), sorted(map(str, kernel.locals.items())))
        if not kernel._can_compile:  # arguments are converted to what there is
            self.write(*map(described, kernel.nopython_signatures))
        self.add(kernel.py_func)

    def _intrinsic(self, intrinsic: Any) -> None:
        made = intrinsic._defn
        self.write("intrinsic", class_name(made))
        if Path(made.__code__.co_filename).resolve() not in COMPILER:
            self.add(made)
            return
        for value in _closed_over(made):
            self.add(value)

    def _type(self, kind: types.Type) -> None:
        self.write("type", described(kind))

    def _class(self, kind: type) -> None:
        self.write("class", class_name(kind))
        if issubclass(kind, tuple) and hasattr(kind, "_fields"):
            self.write(*kind._fields)
            self._mapping(getattr(kind, "_field_defaults", {}))
        elif issubclass(kind, enum.Enum):
            self._mapping({name: member.value for name, member in kind.__members__.items()})
        else:
            raise UnknownContent(f"the class {class_name(kind)}")

    def _mapping(self, values: Mapping[str, Any]) -> None:
        for name, value in values.items():
            self.write(name)
            self.add(value)

    def _member(self, member: enum.Enum) -> None:
        self.write("member", member.name)
        self.add(type(member))

    def _tuple(self, values: tuple[Any, ...]) -> None:
        self.write("tuple", len(values))
        if type(values) is not tuple:
            self.add(type(values))
        for value in values:
            self.add(value)

    def _array(self, array: np.ndarray) -> None:
        if array.dtype.hasobject:
            raise UnknownContent("an array of objects")
        order = array.flags.c_contiguous, array.flags.f_contiguous, array.flags.aligned
        self.write("array", _layout(array.dtype), array.shape, order, array.tobytes())

    def _scalar(self, value: np.generic) -> None:
        self.write("scalar", _layout(value.dtype), value.tobytes())

    def _dtype(self, dtype: np.dtype) -> None:
        self.write("dtype", _layout(dtype))


_Take = Callable[[_Content, Any], None]
_VALUES: tuple[tuple[type, _Take], ...] = (
    (types.Type, _Content._type),
    (enum.Enum, _Content._member),
    (tuple, _Content._tuple),
    (np.ndarray, _Content._array),
    (np.generic, _Content._scalar),
    (np.dtype, _Content._dtype),
)
_REFERRING: tuple[tuple[type, _Take], ...] = (
    (FunctionType, _Content._function),
    (Dispatcher, _Content._kernel),
    (_Intrinsic, _Content._intrinsic),
    (type, _Content._class),
)


def _name_outside(value: Any) -> str:
    """The name by which a value is found in a module that is outside; empty if it is not."""
    module = getattr(value, "__module__", None)
    if isinstance(value, np.ufunc):
        module = "numpy"
    name = getattr(value, "__qualname__", None) or getattr(value, "__name__", None)
    if not (isinstance(name, str) and isinstance(module, str) and _outside(module)):
        return ""
    found = sys.modules.get(module)
    for part in name.split("."):
        found = getattr(found, part, None)
    return f"{module}:{name}" if found is value else ""


@cache
def _outside(module: str) -> bool:
    """Whether a module is Python's, or one whose version is in every key; a user's file may be
    called as one of Python's."""
    top = module.partition(".")[0]
    if top not in sys.stdlib_module_names or top not in sys.modules:
        return top in _VERSIONED
    file = getattr(sys.modules[top], "__file__", None)
    return file is None or Path(file).resolve().is_relative_to(_PYTHON)


def _closed_over(function: FunctionType) -> list[Any]:
    """Values of a function's closure; "empty" for a name that has none yet."""
    found: list[Any] = []
    for cell in function.__closure__ or ():
        try:
            found.append(cell.cell_contents)
        except ValueError:
            found.append("empty")
    return found


def _layout(dtype: np.dtype) -> str:
    return f"{dtype.str} {dtype.fields} {dtype.isalignedstruct}"


def _sorted(option: object) -> object:
    return sorted(option) if isinstance(option, set | frozenset) else option
