"""Folders that nobody else can write to: what lies there was put there by this user.

Compiled kernels are code, kept in pickles, which run code when they are read. So a cache is read
only where no other user but root could have put anything: neither into it, nor in its place by way
of a folder above it.
"""

from __future__ import annotations

import os
import stat
from collections.abc import Iterator
from pathlib import Path


def distrusted(folder: Path) -> str:
    """Who else may have written to a folder, as the end of a sentence "the folder ... is not used:
    "; empty if nobody. What is not there yet is judged by the folders above."""
    if os.name != "posix":
        return ""  # permissions are of another kind, and a user's folders his own
    path = Path(os.path.abspath(folder))
    try:
        for part in dict.fromkeys((*_from_top(path), *_from_top(Path(os.path.realpath(path))))):
            if reason := _distrusted_part(part, last=part in (path, Path(os.path.realpath(path)))):
                return reason
    except OSError as error:
        return f"'{error.filename}' cannot be looked at ({(error.strerror or '').lower()})"
    return ""


def distrusted_file(path: Path) -> bool:
    """Whether a file is a link, or belongs to another user."""
    if os.name != "posix":
        return False
    found = path.lstat()
    return not stat.S_ISREG(found.st_mode) or found.st_uid not in _own()


def make_private(folder: Path) -> None:
    """Make a folder, and those above it that are missing, for this user alone."""
    for part in _from_top(Path(os.path.abspath(folder))):
        if not part.exists():
            try:
                part.mkdir(mode=0o700)
            except FileExistsError:
                if not part.is_dir():
                    raise
    folder.mkdir(exist_ok=True)  # raises where a file stands in the way


def _from_top(path: Path) -> Iterator[Path]:
    yield from reversed((path, *path.parents))


def _own() -> tuple[int, int]:
    return os.geteuid(), 0


def _distrusted_part(part: Path, *, last: bool) -> str:
    """The same of one part of a path alone; ``last``: the folder itself, no file of others may be
    in it, where above it a folder whose files only their owners can rename (/tmp) is enough."""
    try:
        found = part.lstat()
    except (FileNotFoundError, NotADirectoryError):
        return ""
    if found.st_uid not in _own():
        return f"'{part}' belongs to another user (number {found.st_uid})"
    if stat.S_ISLNK(found.st_mode):
        return ""  # what it leads to is looked at as well
    mode = found.st_mode
    if mode & stat.S_ISVTX and not last:
        return ""
    if mode & stat.S_IWOTH or (mode & stat.S_IWGRP and not _alone_in(found.st_gid)):
        remedy = "" if mode & stat.S_ISVTX else f" (chmod go-w '{part}' forbids it)"
        return f"other users may write to '{part}'{remedy}"
    return ""


def _alone_in(group: int) -> bool:
    """Whether a group is the user's own, of his name and without further members, which many
    systems let write by default."""
    import grp
    import pwd

    try:
        user, found = pwd.getpwuid(os.geteuid()), grp.getgrgid(group)
    except KeyError:
        return False
    return found.gr_name == user.pw_name and set(found.gr_mem) <= {user.pw_name}
