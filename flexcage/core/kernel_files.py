"""Files of compiled kernels on disk: where they lie, and whether one is whole.

A file is a checksum and what it is of. A folder that cannot be written is read as far as it goes;
what is compiled is then kept in a temporary folder, as long as the process lives. So it is where
another user may write to the folder (``trust``).
"""

from __future__ import annotations

import atexit
import logging
import os
import shutil
import tempfile
import time
import zlib
from pathlib import Path

from flexcage.core.cache import cache_root, check_writable, trusted, warn_unwritable
from flexcage.core.trust import distrusted_file, make_private

log = logging.getLogger(__name__)

SUFFIX = ".kernel"
KEY_LENGTH = 32
_CHECKSUM = 4  # bytes
_UNUSED = 30 * 86400.0  # [s] without a reader, after which an old version of a kernel goes


def kernel_cache_dir() -> Path:
    """Folder of compiled kernels."""
    return cache_root() / "kernels"


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
        self._damage_reported = False
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
        warn_unwritable(self.path, error)
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

    def warn_damage(self, name: str, error: Exception) -> None:
        """Say once that kernels could not be read."""
        reason = str(error) or type(error).__name__
        level = logging.DEBUG if self._damage_reported else logging.WARNING
        log.log(
            level, "the compiled kernel '%s' in %s cannot be read (%s); it is removed and compiled "
            "anew, as is any other that is damaged", name, self.path, reason,
        )  # fmt: skip
        self._damage_reported = True


def write_whole(path: Path, content: bytes) -> None:
    """Write a kernel, so that a reader sees all of it or nothing; OSError if that cannot be."""
    make_private(path.parent)
    temporary = path.with_name(f"{path.name}.{os.getpid()}.tmp")
    try:
        with open(temporary, "wb") as file:
            file.write(zlib.crc32(content).to_bytes(_CHECKSUM, "little") + content)
        os.replace(temporary, path)
    except OSError:
        remove(temporary)
        raise


def read_whole(path: Path) -> bytes:
    """What was written; FileNotFoundError, or ValueError for a damaged or another user's file."""
    if distrusted_file(path):
        raise ValueError("it belongs to another user")
    with open(path, "rb") as file:
        data = file.read()
    checksum, content = data[:_CHECKSUM], data[_CHECKSUM:]
    if zlib.crc32(content).to_bytes(_CHECKSUM, "little") != checksum:
        raise ValueError("its checksum differs")
    return content


def mark_as_used(path: Path) -> None:
    """Take note that a kernel was read."""
    try:
        os.utime(path)
    except OSError:
        pass


def remove(path: Path) -> None:
    """Remove a file, if that can be."""
    try:
        path.unlink(missing_ok=True)
    except OSError:
        pass


def remove_unused(folder: Path, name: str) -> None:
    """Remove a kernel's versions ``name``-*key* that nobody has read for long."""
    for path in folder.glob(f"{name}-{'?' * KEY_LENGTH}{SUFFIX}"):
        try:
            if time.time() - path.stat().st_mtime > _UNUSED:
                remove(path)
        except OSError:
            continue  # another process removed it


def damaged(folder: Path) -> list[Path]:
    """Files of compiled kernels in a folder that cannot be read. They are looked at, not loaded:
    that would run what they hold."""
    found = []
    for path in sorted(folder.rglob(f"*{SUFFIX}")):
        try:
            read_whole(path)
        except FileNotFoundError:
            continue  # another process removed it
        except (OSError, ValueError):
            found.append(path)
    return found
