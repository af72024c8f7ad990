"""Compiled kernels on disk, in a cache that never ends a run.

numba's own cache raises whatever the disk or a damaged file gives it, and where it cannot write it
keeps kernels beside the sources, where a change in a callee goes unseen. Here every entry carries
a checksum: one that cannot be read is removed, and its kernel compiled anew. A folder that cannot
be written is read as far as it goes; what is compiled is then kept in a temporary folder, as long
as the process lives. So it is where another user may write to the folder (``trust``).

Kernels of the user's own lie in a folder for what his files hold (``users_files``). A kernel of
flexcage's for types of the user's own is found by their names: numba would keep the types, and a
process that has not loaded their module could read none of the function's kernels.
"""

from __future__ import annotations

import atexit
import logging
import os
import pickle
import pickletools
import shutil
import tempfile
import zlib
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import IO, Any

from numba import types
from numba.core.caching import (
    CompileResultCacheImpl,
    FunctionCache,
    IndexDataCacheFile,
    UserProvidedCacheLocator,
)
from numba.core.serialize import dumps
from numba.core.typing import Signature

from flexcage.core.cache import check_writable, tell_unwritable, trusted
from flexcage.core.trust import distrusted_file, make_private
from flexcage.core.users_files import contents_key

log = logging.getLogger(__name__)

_PACKAGE = Path(__file__).resolve().parents[1]
_OURS = "-checked"  # in the names of files, which numba's own cache may keep in the same folder


_spares: list[Path] = []  # temporary folders of this process


@atexit.register
def remove_spares() -> None:
    """Remove the temporary folders, as the process ends."""
    for folder in _spares:
        shutil.rmtree(folder, ignore_errors=True)


class KernelFolder:
    """Where kernels are read and written: the cache's folder, then a temporary one, then none."""

    def __init__(self, path: Path) -> None:
        self.path = path
        self._spare: Path | None = None
        self._given_up = False
        self._told_damage = False
        self._trusted: bool | None = None

    @property
    def places(self) -> tuple[Path, ...]:
        """Folders in which a kernel may lie, that nobody else can write to."""
        if self._trusted is None:
            self._trusted = trusted(self.path)
            if not self._trusted:
                self._take_spare()
        own = (self.path,) if self._trusted else ()
        return own if self._spare is None else (self._spare, *own)

    @property
    def place(self) -> Path | None:
        """Folder to write to; None if there is none."""
        places = self.places
        return None if self._given_up else places[0]

    def ensure_writable(self) -> None:
        """Take a temporary folder if the cache's cannot be written."""
        if self.place is None or self._spare is not None:
            return
        try:
            check_writable(self.path)
        except OSError as error:
            self.refuse(error)

    def refuse(self, error: OSError) -> bool:
        """Write elsewhere from now on; False if there is no other place."""
        if self._spare is not None or self._given_up:
            self._given_up = True
            return False
        tell_unwritable(self.path, error)
        return self._take_spare()

    def _take_spare(self) -> bool:
        """Write to a temporary folder from now on; False if there is none."""
        try:
            self._spare = Path(tempfile.mkdtemp(prefix="flexcage-kernels-"))
        except OSError:
            self._given_up = True
            return False
        _spares.append(self._spare)
        return True

    def tell_damage(self, name: str, error: Exception) -> None:
        """Say once that kernels could not be read."""
        reason = str(error) or type(error).__name__
        level = logging.DEBUG if self._told_damage else logging.WARNING
        log.log(
            level, "the compiled kernel '%s' in %s cannot be read (%s); it is removed and compiled "
            "anew, as is any other that is damaged", name, self.path, reason,
        )  # fmt: skip
        self._told_damage = True


class _Checked(IndexDataCacheFile):
    """Files of one function, each entry with its checksum."""

    def save(self, key: Any, data: Any) -> None:
        content = dumps(data)
        super().save(key, _sealed(content))

    def load(self, key: Any) -> Any:
        entry = super().load(key)
        return None if entry is None else pickle.loads(_opened(entry))

    def check_owner(self) -> None:
        """ValueError if a file of the function's was not put there by this user."""
        for path in self._paths():
            with suppress(FileNotFoundError):
                if distrusted_file(path):
                    raise ValueError("it belongs to another user")

    def _paths(self) -> list[Path]:
        index = Path(self._index_path)
        return [index, *index.parent.glob(f"{index.stem}.*.nbc")]

    def remove(self) -> None:
        """Remove the function's files, as far as they can be."""
        for path in self._paths():
            try:
                path.unlink(missing_ok=True)
            except OSError:
                continue


def _sealed(content: bytes) -> tuple[int, bytes]:
    return zlib.crc32(content), content


def _opened(entry: Any) -> bytes:
    checksum, content = entry
    if zlib.crc32(content) != checksum:
        raise ValueError("its checksum differs")
    return content


class _Locator(UserProvidedCacheLocator):
    """Names the files of a function; ``KernelCache`` chooses their folder."""

    @classmethod
    def from_function(cls, py_func: Any, py_file: str) -> _Locator | None:
        return cls(py_func, py_file) if os.path.exists(py_file) else None

    def ensure_cache_path(self) -> None:
        """Left to ``KernelCache``."""


class _Impl(CompileResultCacheImpl):
    _locator_classes = [_Locator]


def _outer_modules(kind: Any) -> Iterator[str]:
    """Modules outside flexcage that define tuples in a numba type, or a signature, which a user's
    family has among its own."""
    if isinstance(kind, types.BaseNamedTuple):
        module = kind.instance_class.__module__
        if module.partition(".")[0] != __name__.partition(".")[0]:
            yield module
    if isinstance(kind, Signature):
        kind = kind.args
    for part in kind if isinstance(kind, tuple | types.BaseTuple) else ():
        yield from _outer_modules(part)
    if isinstance(held := getattr(kind, "held", None), types.Type):
        yield from _outer_modules(held)


class KernelCache(FunctionCache):
    """numba's cache of one function, in a ``KernelFolder``."""

    _impl_class = _Impl

    def __init__(self, function: Any, folder: KernelFolder) -> None:
        super().__init__(function)
        self._folder = folder
        file = function.__code__.co_filename
        self._sub = self._impl.locator.get_suitable_cache_subpath(file)
        self._users_own = not Path(file).resolve().is_relative_to(_PACKAGE)
        self._stamp = self._impl.locator.get_source_stamp()

    def _folder_in(self, place: Path) -> Path:
        key = contents_key() if self._users_own else ""
        return place / f"{self._sub}-{key}" if key else place / self._sub

    def _files(self, place: Path) -> _Checked:
        folder = str(self._folder_in(place))
        return _Checked(folder, self._impl.filename_base + _OURS, self._stamp)

    def _index_key(self, sig: Any, codegen: Any) -> Any:
        """numba's key, in which a signature with the user's own types is their names."""
        key = super()._index_key(sig, codegen)
        modules = sorted(set(_outer_modules(sig)))
        return (f"{sig} of {modules}", *key[1:]) if modules else key

    def load_overload(self, sig: Any, target_context: Any) -> Any:
        """The kernel compiled for a signature, or None if it is not there or damaged."""
        for place in self._folder.places:
            self._cache_file = self._files(place)
            try:
                self._cache_file.check_owner()
                found = super().load_overload(sig, target_context)
            except NotADirectoryError:
                continue  # no cache at all: what writes to it says so
            except Exception as error:  # a damaged file may hold anything
                self._cache_file.remove()
                self._folder.tell_damage(self._impl.filename_base, error)
                continue
            if found is not None:
                return found
        return None

    def save_overload(self, sig: Any, data: Any) -> None:
        """Keep a kernel where that is possible."""
        while (place := self._folder.place) is not None:
            self._cache_file = self._files(place)
            try:
                make_private(self._folder_in(place))
                return super().save_overload(sig, data)
            except OSError as error:
                self._folder.refuse(error)
            except Exception as error:  # an index that is damaged
                self._cache_file.remove()
                self._folder.tell_damage(self._impl.filename_base, error)
                return None
        return None


def damaged(folder: Path) -> list[Path]:
    """Files of compiled kernels in a folder that cannot be read. They are looked at, not loaded:
    that would run what they hold."""
    found = []
    for path in sorted(folder.rglob(f"*{_OURS}.*")):
        try:
            with open(path, "rb") as file:
                if path.suffix == ".nbi":
                    _values(file), _values(file)
                elif path.suffix == ".nbc":
                    (checksum, *_), (content, *_) = _values(file)
                    _opened((checksum, content))
        except FileNotFoundError:
            continue  # another process removed it
        except Exception:
            found.append(path)
    return found


def _values(file: IO[bytes]) -> tuple[list[Any], list[Any]]:
    """The whole numbers and the bytes in a pickle, which is not loaded; an error for one that is
    cut short."""
    numbers, contents = [], []
    for code, value, _ in pickletools.genops(file):
        if code.name.startswith(("BININT", "LONG")):
            numbers.append(value)
        elif "BINBYTES" in code.name:
            contents.append(value)
    return numbers, contents
