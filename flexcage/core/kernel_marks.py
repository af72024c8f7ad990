"""Marks that say: all kernels that a family's run needs are on disk, made of what is there now.

A process finds its kernels one by one, when it has a bearing; a mark tells beforehand whether
there is something to compile. It lists functions and NamedTuples with the keys of their contents,
and holds as long as these are the same.
"""

from __future__ import annotations

import hashlib
import importlib
import sys
from functools import reduce
from pathlib import Path

import numba

from flexcage.core import kernel_cache
from flexcage.core.jit import kernel_folder
from flexcage.core.kernel_files import read_whole, write_whole
from flexcage.core.kernel_keys import compiler_key, content_key
from flexcage.core.type_texts import UnknownContent
from flexcage.core.users_files import contents_key

_PACKAGE = f"{__name__.partition('.')[0]}."
_held: set[tuple[str, ...]] = set()  # stems, and where: what this process found once, it still has


def _stem(what: str) -> str:
    """Beginning of the names of marks made with this compiler and these files of the user's."""
    key = hashlib.sha256(f"{compiler_key()} {contents_key()}".encode()).hexdigest()[:16]
    return f"compiled-{what}-{key}"


def _package_stem(what: str) -> str:
    """The same of marks that leave the user's files out."""
    return f"package-{what}-{hashlib.sha256(compiler_key().encode()).hexdigest()[:16]}"


def kernels_cached(what: str) -> bool:
    """True if nothing is left to be compiled for a run of the family ``what``, or nothing ever
    is."""
    return bool(numba.config.DISABLE_JIT) or _marked(_stem(what))  # type: ignore[attr-defined]


def own_kernels_cached(what: str) -> bool:
    """True if flexcage's own kernels of such a run are on disk, so that few are left to be
    compiled: those of a user's functions, or of other laws."""
    return _marked(_package_stem(what))


def _marked(stem: str) -> bool:
    keys: dict[str, str] = {}
    this = (stem, *map(str, kernel_folder.places))
    if this not in _held and any(
        _holds(mark, keys)
        for place in kernel_folder.places
        for mark in sorted(place.glob(f"{stem}-*.mark"))
    ):
        _held.add(this)
    return this in _held


def mark_compiled(what: str) -> None:
    """Say that all kernels are on disk, if they are."""
    if kernel_folder.place is None or kernels_cached(what):
        return
    _write(_stem(what), kernel_cache.used)
    _write(_package_stem(what), {name for name in kernel_cache.used if name.startswith(_PACKAGE)})


def _write(stem: str, names: set[str]) -> None:
    """A mark that lists functions and NamedTuples; none where there are none."""
    place = kernel_folder.place
    keys = ((_key_of(name), name) for name in sorted(names))
    content = "\n".join(f"{key} {name}" for key, name in keys if key).encode()
    if place is None or not content:
        return
    name = f"{stem}-{hashlib.sha256(content).hexdigest()[:16]}.mark"
    try:
        write_whole(place / name, content)
    except OSError as error:
        kernel_folder.refuse(error)


def compiling_lock(what: str) -> Path | None:
    """A file by which processes agree who compiles; None where none can be written."""
    kernel_folder.ensure_writable()
    place = kernel_folder.place
    return None if place is None else place / f"{_stem(what)}.lock"


def _holds(mark: Path, keys: dict[str, str]) -> bool:
    """Whether all that a mark lists has the contents that it had; ``keys``: those known now."""
    try:
        lines = read_whole(mark).decode().splitlines()
    except (OSError, ValueError):
        return False
    for line in lines:
        key, _, name = line.partition(" ")
        if name not in keys:
            keys[name] = _key_of(name)
        if keys[name] != key:
            return False
    return True


def _key_of(name: str) -> str:
    """Key of a function or class called "module:name"; empty if there is none in its module, as of
    what stands inside a function, or if its module is a user's that is not loaded."""
    module, _, path = name.partition(":")
    try:
        own = module.startswith(_PACKAGE)
        found: object = importlib.import_module(module) if own else sys.modules[module]
        return content_key(reduce(getattr, path.split("."), found))
    except (ImportError, KeyError, AttributeError, UnknownContent):
        return ""
