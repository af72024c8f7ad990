"""Compilation of kernels: options in one place, and a cache keyed by all kernel sources.

numba's own cache looks only at the file of the compiled function: a change in a callee in
another file goes unseen and old numbers come back. So the cache folder carries a hash of
every source file of the package that defines kernels.
"""

from __future__ import annotations

import hashlib
import os
import warnings
from pathlib import Path
from typing import Any

import platformdirs

_PACKAGE = Path(__file__).resolve().parents[1]


def kernel_sources() -> list[Path]:
    """Source files that define or feed kernels, in a fixed order.

    ``solve`` is plain Python that ``system`` compiles: it has no import to be known by.
    """
    return sorted(
        p
        for p in _PACKAGE.rglob("*.py")
        if p.parent.name == "solve" or "core.jit import" in p.read_text("utf-8")
    )


def source_hash(files: list[Path]) -> str:
    """Hash of file names and contents, and of numba's and numpy's versions through the caller."""
    digest = hashlib.sha256()
    for path in files:
        digest.update(path.name.encode())
        digest.update(path.read_bytes())
    return digest.hexdigest()[:16]


def kernel_cache_dir() -> Path:
    """Folder in which numba keeps compiled kernels of exactly these sources."""
    root = Path(os.environ.get("FLEXCAGE_CACHE_DIR") or platformdirs.user_cache_dir("flexcage"))
    return root / "kernels" / source_hash(kernel_sources())


if "NUMBA_CACHE_DIR" not in os.environ:
    os.environ["NUMBA_CACHE_DIR"] = str(kernel_cache_dir())

import numba  # noqa: E402  (its cache folder must be known first)
from numba.experimental import structref  # noqa: E402

numba.config.CACHE_DIR = os.environ["NUMBA_CACHE_DIR"]  # type: ignore[attr-defined]
# laws are passed to kernels as first-class functions, which numba calls experimental
warnings.simplefilter("ignore", numba.errors.NumbaExperimentalFeatureWarning)

OPTIONS: dict[str, Any] = {"cache": True, "error_model": "numpy", "fastmath": False}


def kernel(*args: Any, **kwargs: Any) -> Any:
    """``numba.njit`` with flexcage's options; the plain function is ``.py_func``."""
    if args and callable(args[0]):
        return numba.njit(**OPTIONS)(args[0])
    return numba.njit(*args, **{**OPTIONS, **kwargs})


def kernels_cached() -> bool:
    """True if compiled kernels of these sources are on disk already."""
    path = Path(os.environ["NUMBA_CACHE_DIR"])
    return path.is_dir() and any(path.rglob("*.nbi"))


@structref.register
class BoxType(numba.types.StructRef):
    """Type of a ``Box``."""

    def preprocess_fields(self, fields):
        return tuple((name, numba.types.unliteral(kind)) for name, kind in fields)


class Box(structref.StructRefProxy):
    """A reference to a large NamedTuple of arrays, so that a call passes one pointer.

    Passing a hundred arrays by value costs 0.4 ms a call from Python and most of the compile time.
    """


structref.define_proxy(Box, BoxType, ["value"])


@kernel
def boxed(value):
    """A ``Box`` of the value."""
    return Box(value)


@kernel
def copy_into(target, source):
    """Copy a C-contiguous array into one of the same size, element by element."""
    a, b = target.ravel(), source.ravel()
    for k in range(b.shape[0]):
        a[k] = b[k]


@kernel
def zero(array):
    """Set a C-contiguous array to zero."""
    a = array.ravel()
    for k in range(a.shape[0]):
        a[k] = 0
