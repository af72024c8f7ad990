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

import platformdirs

_PACKAGE = Path(__file__).resolve().parents[1]


def kernel_sources() -> list[Path]:
    """Source files that define or feed kernels, in a fixed order."""
    return sorted(p for p in _PACKAGE.rglob("*.py") if "core.jit import" in p.read_text("utf-8"))


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

numba.config.CACHE_DIR = os.environ["NUMBA_CACHE_DIR"]
# laws are passed to kernels as first-class functions, which numba calls experimental
warnings.simplefilter("ignore", numba.errors.NumbaExperimentalFeatureWarning)

OPTIONS = {"cache": True, "error_model": "numpy", "fastmath": False}


def kernel(*args, **kwargs):
    """``numba.njit`` with flexcage's options; the plain function stays reachable as ``.py_func``."""
    if args and callable(args[0]):
        return numba.njit(**OPTIONS)(args[0])
    return numba.njit(*args, **{**OPTIONS, **kwargs})


def kernels_cached() -> bool:
    """True if compiled kernels of these sources are on disk already."""
    path = Path(os.environ["NUMBA_CACHE_DIR"])
    return path.is_dir() and any(path.rglob("*.nbi"))
