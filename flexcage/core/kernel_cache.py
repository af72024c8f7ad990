"""Compiled kernels on disk, in a cache that never ends a run and never gives an old kernel back.

numba's own cache sees a change in the compiled function's file alone, raises whatever the disk or a
damaged file gives it, and where it cannot write it keeps kernels beside the sources. Here a file's
name has a key of all that the kernel was made from (``kernel_keys``), so that what is edited is not
found; one that cannot be read is removed, and its kernel compiled anew (``kernel_files``).

A user's own kernels have a key of the files that he loaded (``users_files``) as well.
"""

from __future__ import annotations

import logging
import pickle
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from numba import types
from numba.core.caching import NullCache
from numba.core.compiler import CompileResult
from numba.core.dispatcher import Dispatcher
from numba.core.serialize import dumps

from flexcage.core import kernel_files
from flexcage.core.kernel_files import SUFFIX, KernelFolder
from flexcage.core.kernel_keys import kernel_key
from flexcage.core.type_texts import class_name, parts_of
from flexcage.core.users_files import contents_key

log = logging.getLogger(__name__)

_PACKAGE = Path(__file__).resolve().parents[1]
#: Names of functions and NamedTuples, as ``kernel_keys.class_name``, of which kernels that this
#: process has read or written were compiled.
used: set[str] = set()


class KernelCache(NullCache):
    """The cache of one kernel, in a ``KernelFolder``."""

    def __init__(self, kernel: Dispatcher, folder: KernelFolder) -> None:
        self._kernel, self._folder = kernel, folder
        function = kernel.py_func
        self._name = class_name(function)
        package, _, module = (function.__module__ or "nowhere").rpartition(".")
        self._sub = package or module
        self._stem = f"{module}.{function.__qualname__}".replace("<", "").replace(">", "")
        file = Path(function.__code__.co_filename).resolve()
        self._users_own = not file.is_relative_to(_PACKAGE)
        self._missing: set[str] = set()  # keys of what was looked for and not found
        self._told = False

    @property
    def cache_path(self) -> str:
        """Where kernels are."""
        return str(self._folder.path)

    def _key(self, signature: Any, codegen: Any) -> str | None:
        """What the kernel is for a signature on this processor; None if nobody can say."""
        if self._kernel.py_func.__module__ is None:
            return None  # numba reads no such function back
        more = (repr(codegen.magic_tuple()), contents_key() if self._users_own else "")
        try:
            return kernel_key(self._kernel, signature, *more)
        except Exception as unknown:  # a user's objects may do anything when they are looked at
            log.log(
                logging.DEBUG if self._told else logging.WARNING,
                "the kernel '%s' is compiled in every process: it takes in %s, of which flexcage "
                "cannot say whether it has changed", self._stem, unknown,
            )  # fmt: skip
            self._told = True
            return None

    def _path(self, place: Path, key: str) -> Path:
        return place / self._sub / f"{self._stem}-{key}{SUFFIX}"

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The kernel compiled for a signature, or None if it is not there or damaged."""
        target_context.refresh()
        key = self._key(sig, target_context.codegen())
        if key is None:
            return None
        for place in self._folder.places:
            path = self._path(place, key)
            try:
                payload = pickle.loads(kernel_files.read_whole(path))
                found = CompileResult._rebuild(target_context, *payload)
            except (FileNotFoundError, NotADirectoryError):
                continue  # none, or no cache at all: what writes to it says so
            except Exception as error:  # a damaged file may hold anything
                kernel_files.remove(path)
                self._folder.warn_damage(self._stem, error)
                continue
            kernel_files.mark_as_used(path)
            self._note(sig)
            return found
        self._missing.add(key)
        return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep a kernel where that is possible, if what it is made of has not changed since it was
        looked for."""
        key = self._key(sig, data.codegen)
        if key not in self._missing or data.lifted or data.library.has_dynamic_globals:
            return
        content: bytes = dumps(data._reduce())
        while (place := self._folder.place) is not None:
            path = self._path(place, key)
            try:
                kernel_files.write_whole(path, content)
            except OSError as error:
                self._folder.refuse(error)
                continue
            kernel_files.remove_unused(path.parent, self._stem)
            self._note(sig)
            return

    def _note(self, signature: Any) -> None:
        used.add(self._name)
        used.update(_layouts(signature))


def _layouts(kind: Any) -> Iterator[str]:
    """Names of the NamedTuples in a numba type, a signature or a tuple of types."""
    if isinstance(kind, types.BaseNamedTuple):
        yield class_name(kind.instance_class)
    for part in parts_of(kind):
        yield from _layouts(part)
