"""One writer at a time in a folder, by a lock that a killed process does not leave behind."""

from __future__ import annotations

import os
import socket
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from contextvars import ContextVar
from pathlib import Path

from flexcage.core.errors import InputError
from flexcage.core.writing import check_own

LOCK = "running.lock"  # in the folder; says which process holds it

_mine: ContextVar[frozenset[Path]] = ContextVar("_mine", default=frozenset())


@contextmanager
def held(folder: Path, what: str = "a run", *, inside: bool = False) -> Iterator[None]:
    """Let no other process, and no other thread, write to ``folder`` meanwhile: InputError, which
    names the process, if one does. ``inside``: nothing is done if the caller holds it already.

    The folder is made if it is not there, and removed if nothing was put into it.
    """
    import filelock

    folder = folder.resolve()
    if inside and folder in _mine.get():
        yield
        return
    new = not folder.exists()
    folder.mkdir(parents=True, exist_ok=True)
    path = folder / LOCK
    check_own(path)
    lock = filelock.FileLock(path)
    try:
        lock.acquire(timeout=0)
    except filelock.Timeout:
        raise _busy(path, what) from None
    token = _mine.set(_mine.get() | {folder})
    try:
        with suppress(OSError):  # a full disk: the lock holds without a name
            path.write_text(f"{os.getpid()} {socket.gethostname()}", encoding="utf-8")
        yield
    finally:
        _mine.reset(token)
        with suppress(OSError):
            path.unlink(missing_ok=True)
        lock.release()
        if new:
            with suppress(OSError):
                folder.rmdir()


def abandon() -> None:
    """Take back the locks of this thread, as the process ends at once."""
    for folder in _mine.get():
        with suppress(OSError):
            (folder / LOCK).unlink(missing_ok=True)
        with suppress(OSError):
            folder.rmdir()  # if nothing was put into it


def is_held(folder: Path) -> bool:
    """Does another process, or another thread, write to ``folder``?"""
    path = folder / LOCK
    if folder.resolve() in _mine.get() or path.is_symlink() or not path.is_file():
        return False
    try:
        return _is_taken(path)
    except OSError:
        return True


def check_free(folder: Path) -> None:
    """InputError if another process writes to ``folder``, or to one inside of it."""
    for path in folder.rglob(LOCK):
        if path.parent.resolve() in _mine.get():
            continue
        check_own(path)
        if _is_taken(path):
            raise _busy(path, "a run or a study")


def _is_taken(path: Path) -> bool:
    """Does another hold this lock file?"""
    import filelock

    lock = filelock.FileLock(path)
    try:
        lock.acquire(timeout=0)
    except filelock.Timeout:
        return True
    lock.release()
    return False


def _busy(path: Path, what: str) -> InputError:
    try:
        pid, _, host = path.read_text("utf-8").partition(" ")
    except (OSError, UnicodeDecodeError):
        pid, host = "", ""
    who = f" (process {pid} on {host})" if pid and host else ""
    return InputError(
        f"Another process{who} is computing {what} in '{path.parent}'; wait until it has finished, "
        "or name another folder with -o.",
        where="out",
        value=str(path.parent),
    )
