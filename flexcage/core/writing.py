"""The user's files and folders: names that may become paths, and writing that harms no other file.

A run or a study may come from a stranger. So no name out of it leads out of its folder, nothing
inside it is read or written through a link, and every file is written beside its place and renamed:
what a link in its place points to stays as it is, and a kill at any moment leaves the old content
or the new one.
"""

from __future__ import annotations

import os
import stat
import tempfile
from collections.abc import Collection, Iterator
from contextlib import contextmanager
from pathlib import Path

from flexcage.core.errors import InputError

SPARE = ".new-"  # begins the names of folders in which a file is written before it has its place
LONGEST_NAME = 200  # bytes; folders may have 255, and commands add words to it


def unusable(name: str) -> str:
    """Why a name cannot name a file or a folder, as the end of a sentence "name is ..."; empty if
    it can."""
    if not name.strip() or not name.strip(". ") or not name.isprintable() or set(name) & {*"/\\:"}:
        return (
            f"{name!r}, but must be usable as the name of a folder: one line, not empty, without "
            "'/', '\\' or ':'"
        )
    size = len(name.encode("utf-8", "replace"))
    if size > LONGEST_NAME:
        return f"{size} bytes long, but names a folder; give it {LONGEST_NAME} bytes or fewer"
    return ""


def check_name(name: str, what: str) -> str:
    """The name, if a file or a folder can have it; InputError, which begins with ``what``, if it
    is none, as ``../x``, ``a/b`` or ``..``."""
    if wrong := unusable(name):
        raise InputError(f"{what} is {wrong}.", where=what, value=name)
    return name


def check_own(*paths: Path) -> None:
    """Raise InputError for the first link, or other thing than a file or a folder, at ``paths`` and
    in the folders there; what is not there is left out."""
    for path in paths:
        try:
            mode = path.lstat().st_mode
        except (FileNotFoundError, NotADirectoryError):
            continue
        if stat.S_ISDIR(mode) and not _junction(path):
            check_own(*sorted(path.iterdir()))
        elif not stat.S_ISREG(mode):
            raise _not_own(path, mode)


def _junction(path: Path) -> bool:
    """Whether a folder is a link of another kind, which Windows has."""
    mount = getattr(stat, "IO_REPARSE_TAG_MOUNT_POINT", None)
    return mount is not None and getattr(path.lstat(), "st_reparse_tag", None) == mount


def _not_own(path: Path, mode: int) -> InputError:
    text = f"'{path}' is neither a file nor a folder; remove it."
    if stat.S_ISLNK(mode) or stat.S_ISDIR(mode):
        text = (
            f"'{path}' is a link to '{os.readlink(path)}', and flexcage follows no link inside the "
            "folder of a run or a study; put what it names there, or remove the link."
        )
    return InputError(text, where="path", value=str(path))


def folder_in(folder: Path, *names: str) -> Path:
    """A folder inside ``folder``, made if it is not there; InputError for a name that leads
    elsewhere, or a link on the way. OSError from the disk."""
    for name in names:
        folder = folder / check_name(name, f"A name in '{folder}'")
        if folder.is_symlink():
            check_own(folder)
        folder.mkdir(parents=True, exist_ok=True)
    return folder


def holds_others(folder: Path, known: Collection[str]) -> bool:
    """Whether a folder holds anything but files and folders of these names, and what a kill left of
    ``written``."""
    return folder.is_dir() and any(
        path.name not in known and not path.name.startswith(SPARE) for path in folder.iterdir()
    )


@contextmanager
def written(path: Path) -> Iterator[Path]:
    """A path to write a file to, of the same name, in a temporary folder beside: it gets its place
    once the context ends, with all in it on disk. Of an error nothing is left. OSError from the
    disk."""
    with tempfile.TemporaryDirectory(dir=path.parent, prefix=SPARE) as spare:
        temporary = Path(spare) / path.name
        yield temporary
        move_into_place(temporary, path)


def write_text(path: Path, text: str) -> None:
    """Write a text in UTF-8, in one move. OSError from the disk."""
    replace(path, text.encode())


def replace(path: Path, content: bytes) -> None:
    """Write a file so that either the old or the new content is there after any kill, on disk
    before this returns. Of an error nothing is left. OSError from the disk."""
    temporary = path.with_name(path.name + ".new")
    temporary.unlink(missing_ok=True)  # of a process that was killed; or a link
    try:
        with open(temporary, "xb") as file:
            file.write(content)
            file.flush()
            os.fsync(file.fileno())
        _rename(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise


def move_into_place(temporary: Path, path: Path) -> None:
    """Give a file that was written beside ``path`` its name, once all in it is on disk."""
    sync(temporary)
    _rename(temporary, path)


def sync(path: Path) -> None:
    """Wait until a file, or what a folder lists, is on disk."""
    handle = os.open(path, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)


def _rename(temporary: Path, path: Path) -> None:
    os.replace(temporary, path)
    if os.name == "posix":
        sync(path.parent)
