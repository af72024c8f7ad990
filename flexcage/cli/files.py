"""Files and folders that commands read and write: what is refused before work begins."""

from __future__ import annotations

import os
import tempfile
from collections.abc import Iterable, Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

from flexcage.core.errors import FlexcageError, InputError, unwritable
from flexcage.core.locks import LOCK, check_free, held
from flexcage.core.output_folders import check_no_file, check_run

_OURS = ("case.toml", "results.zarr", "compare.json")  # one of them is in every folder of ours


def prepare_out(
    out: Path,
    *,
    resume: bool,
    force: bool,
    resumable: bool = True,
    ours: Iterable[str] = _OURS,
    first: str = "case.toml",
) -> None:
    """Refuse an output folder that would be overwritten by accident or cannot be written.

    ``force`` empties one that holds a file named in ``ours``; one to ``resume`` holds the file
    ``first``.
    """
    check_no_file(out)
    if resume:
        from flexcage.run.folder import check_written

        check_written(out, first)
    elif out.is_dir() and not _holds_nothing(out):
        if not force:
            raise InputError(
                f"The output folder '{out}' exists already; "
                f"{'--resume goes on with it, ' if resumable else ''}--force writes it anew, "
                "-o names another.",
                where="out",
                value=str(out),
            )
        empty_run(out, ours)
    try:
        out.mkdir(parents=True, exist_ok=True)
        with tempfile.TemporaryFile(dir=out):
            pass
    except OSError as exc:
        raise _unwritable(out, exc) from exc


@contextmanager
def run_folder(
    out: Path, *, resume: bool, force: bool, ours: Iterable[str] = _OURS, first: str = "case.toml"
) -> Iterator[None]:
    """The folder of a run, prepared for its output and held, so that no other process writes there
    or empties it meanwhile; ``ours`` and ``first`` as ``prepare_out`` takes them."""
    check_no_file(out)
    if resume:
        prepare_out(out, resume=True, force=False, first=first)  # before our own lock lies there
    with ExitStack() as stack:
        try:
            stack.enter_context(held(out))
        except OSError as exc:
            raise _unwritable(out, exc) from exc
        if not resume:
            prepare_out(out, resume=False, force=force, ours=ours)
        yield


def _holds_nothing(out: Path) -> bool:
    if not any(out.iterdir()):
        return True
    from flexcage.run.folder import holds_nothing

    return holds_nothing(out)


def _unwritable(out: Path, error: OSError) -> FlexcageError:
    remedy = "name another with -o"
    return unwritable(f"The output folder '{out}'", error, remedy=remedy, path=out)


def empty_run(out: Path, ours: Iterable[str] = _OURS) -> None:
    """Remove a former output of flexcage; anything else in that folder is not ours to remove, nor
    what another process is writing."""
    import shutil

    check_free(out)
    if not any((out / name).exists() for name in ours):
        raise InputError(
            f"'{out}' holds files that this command did not write, so --force leaves it alone; "
            "name another folder with -o.",
            where="out",
            value=str(out),
        )
    for path in out.iterdir():
        if path.is_dir() and not path.is_symlink():
            shutil.rmtree(path)
        elif path.name != LOCK:  # it may be ours
            path.unlink()


def prepare_file(path: Path, endings: Iterable[str], *, force: bool) -> None:
    """Refuse an output file of another ending, or one that exists or cannot be written."""
    endings = tuple(endings)
    if path.suffix not in endings:
        raise InputError(
            f"'{path}' should end in {' or '.join(endings)}.", where="out", value=str(path)
        )
    if path.is_dir():
        raise InputError(f"'{path}' is a folder; name a file.", where="out", value=str(path))
    if (path.exists() or path.is_symlink()) and not force:
        raise InputError(f"'{path}' exists already; --force writes it anew.", where="out")
    if not path.parent.exists():
        raise InputError(
            f"There is no folder '{path.parent}' for '{path}'; make it first.", where="out"
        )
    if not path.parent.is_dir() or not os.access(path.parent, os.W_OK):
        raise InputError(f"'{path.parent}' is not a folder that can be written.", where="out")


def existing_run(path: str | Path) -> Path:
    """Folder of a stored run, or InputError."""
    path = Path(path)
    check_run(path)
    return path
