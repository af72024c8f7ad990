"""What is said of a file or folder that is not there: what is, and is named alike."""

from __future__ import annotations

from collections.abc import Iterable
from pathlib import Path

from flexcage.core.binding import near_names

_LFS = b"version https://git-lfs"

#: Of a file that a clone of a repository has not fetched.
POINTER = "it is a pointer of Git LFS; 'git lfs pull' in its folder brings the file"


def is_pointer(path: Path) -> bool:
    """Does a pointer of Git LFS stand in the place of a file?"""
    try:
        with path.open("rb") as file:
            return file.read(len(_LFS)) == _LFS
    except OSError:
        return False


def no_file(what: str, path: Path, endings: Iterable[str] = ()) -> str:
    """A sentence without its full stop: there is no ``what`` ("case file") at a path. It names the
    folder that is not there, or the nearest file of these endings (any, if none are given)."""
    said = f"There is no {what} '{path}'"
    folder = _lacking(path.parent)
    if folder is not None:
        return f"{said}: there is no folder '{folder}'"
    near = _nearest(path, tuple(endings))
    return f"{said}; the nearest one there is '{near}'" if near else said


def no_folder(path: Path) -> str:
    """The same of a folder."""
    near = _nearest(path, (), folders=True)
    said = f"There is no folder '{path}'"
    return f"{said}; the nearest one there is '{near}'" if near else said


def _lacking(folder: Path) -> Path | None:
    """The outermost folder of a path that is not there; None if all are."""
    return next((p for p in (*reversed(folder.parents), folder) if not p.exists()), None)


def _nearest(path: Path, endings: tuple[str, ...], *, folders: bool = False) -> Path | None:
    """What is beside a path and has a name like its; the same name with another ending first."""
    try:
        siblings = [p for p in path.parent.iterdir() if p.is_dir() == folders]
    except OSError:
        return None
    names = sorted(p.name for p in siblings if folders or not endings or p.suffix in endings)
    same = [name for name in names if Path(name).stem.casefold() == path.stem.casefold()]
    close = near_names(path.name, same, 1, cutoff=0.0) or near_names(path.name, names, 1)
    return path.parent / close[0] if close else None
