"""The folder of a run: its case, its results, and the cage that these refer to.

case.toml       the case as it was run (the results hold its text as well, and that one counts)
results.zarr/   samples, steps, checkpoints (``results.store``)
cage.zip        mesh, mode shapes and interface (``results.cage_file``); the runs of a study
                share those in its folder ``cages``
summary.txt, summary.json, modes.csv, images/   what was made of them
"""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any

from flexcage.case import Case, load_case
from flexcage.core.binding import flat
from flexcage.core.errors import FlexcageError, InputError, unwritable
from flexcage.core.locks import LOCK
from flexcage.core.warning import RunWarning
from flexcage.core.writing import replace
from flexcage.results.cage_file import (
    NAME,
    CageFile,
    CageRecord,
    find_cage,
    read_cage,
    shared_cage,
    write_cage,
)
from flexcage.results.store import MemoryRunStore, RunStore

log = logging.getLogger(__name__)


def write_case(folder: Path, case: Case) -> None:
    """Write the case as run into the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    replace(folder / "case.toml", case.to_toml().encode())


def was_written(folder: Path) -> bool:
    """Whether a run was to be written to ``folder``, though it may not have begun yet."""
    return (folder / "case.toml").is_file()


#: What a run leaves that is killed before its case is on disk.
LEFT_OVER = (LOCK, "case.toml.new")


def holds_nothing(folder: Path) -> bool:
    """Whether a folder is empty, but for what a run left that was killed as it began."""
    return all(path.name in LEFT_OVER for path in folder.iterdir())


def check_written(folder: Path) -> None:
    """InputError if there is nothing to resume in ``folder``."""
    left = folder.is_dir() and any(folder.iterdir()) and holds_nothing(folder)
    if not was_written(folder) and not left:
        raise InputError(
            f"'{folder}' is not the folder of a run (it has no case.toml), so there is nothing to "
            "resume there.",
            where="out",
            value=str(folder),
        )


def begun_store(folder: Path, case: Case) -> RunStore | None:
    """The store of the case's run in ``folder``; None if it has not come so far that it can be
    gone on with.

    What one left that was killed before is removed, to be begun anew. InputError if the folder
    holds the run of another case, or one in another format.
    """
    if not was_written(folder):
        log.warning("the run in '%s' was stopped before it had begun; it begins now", folder)
        return None
    path = folder / "results.zarr"
    store = RunStore.open(path) if RunStore.begun(path) else None
    stored, named = _stored(folder, store)
    if case.hash != named and not _without_its_files(case, stored):
        raise InputError(
            f"The case differs from the one of the run in '{folder}'{_difference(case, stored)}; "
            "resume the same case, or name another folder.",
            where="case",
            value=case.hash,
        )
    if store is None:
        RunStore.clear_unbegun(path)
        log.warning("the run in '%s' was stopped before its first block; it begins anew", folder)
    return store


def _difference(case: Case, stored: Case) -> str:
    """The first values in which two cases differ, in brackets."""
    differ = case.difference(stored)
    if not differ:
        return " (a file or function behind it has changed)"
    return _named(list(differ), *({k: v[i] for k, v in differ.items()} for i in (0, 1)))


def _stored(folder: Path, store: RunStore | None) -> tuple[Case, str]:
    """The case of the run in a folder and its hash, as they were when it began."""
    if store is None:
        stored = load_case(folder / "case.toml")
        return stored, stored.hash
    attrs = store.layout.attrs
    return load_case(attrs["case"]), attrs["hash"]


def _without_its_files(case: Case, stored: Case) -> bool:
    """Whether two cases differ in nothing but that files of both are no longer there: the run's
    folder keeps mesh and modes."""
    gone = any(not Path(file).is_file() for file in case.files.values())
    return gone and not case.difference(stored)


def keep_cage(folder: Path, file: CageFile, *, study: Path | None = None) -> None:
    """Write the cage of a run that begins in ``folder``: there, or once for all runs of a study."""
    path = folder / NAME if study is None else shared_cage(study, file.digest)
    if study is not None and path.is_file():
        return  # named by its content
    try:
        write_cage(path, file)
    except OSError as exc:
        raise unwritable(f"The cage's file '{path}'", exc, path=path) from exc


def kept_cage(folder: Path, store: MemoryRunStore) -> CageRecord:
    """The cage of a stored run; InputError if it is missing or another one."""
    digest = store.layout.attrs["cage"]
    path = find_cage(folder, digest)
    record = read_cage(path)
    if record.digest != digest:
        raise InputError(
            f"'{path}' is the cage of another run ({record.digest}); this one has the cage "
            f"{digest}. Bring its own file back, or run the case again.",
            where="cage",
            value=record.digest,
        )
    return record


def open_folder(folder: Path) -> tuple[Case, MemoryRunStore, tuple[RunWarning, ...]]:
    """The case and the store of a run folder. The case is that of the results: an edit of
    case.toml is ignored, and the warning names it."""
    store = RunStore.open(folder / "results.zarr")
    text = store.layout.attrs["case"]
    case = load_case(text)
    edit = _edit(folder / "case.toml", text, case)
    if not edit:
        return case, store, ()
    warning = RunWarning(
        "edited", f"{edit}; this is ignored: the results are those of the case as it was run."
    )
    log.warning(warning.text)
    return case, store, (warning,)


def _edit(path: Path, text: str, case: Case) -> str:
    """What was changed in a run's case.toml after the run, or nothing."""
    try:
        if path.read_text("utf-8") == text:
            return ""
        edited = load_case(path)
    except FileNotFoundError:
        return ""
    except (FlexcageError, OSError, ValueError) as exc:
        return f"'{path}' was changed after the run and is no case any more ({exc})"
    was, now = dict(flat(case.to_table())), dict(flat(edited.to_table()))
    keys = [key for key in {**was, **now} if was.get(key) != now.get(key)]
    return f"'{path}' was edited after the run{_named(keys, now, was)}" if keys else ""


def _named(keys: list[str], new: dict[str, Any], old: dict[str, Any]) -> str:
    """The first of the values that differ, in brackets."""
    told = [f"{key} is {new.get(key)}, was {old.get(key)}" for key in keys[:3]]
    more = f", and {len(keys) - 3} more" if len(keys) > 3 else ""
    return f" ({'; '.join(told)}{more})" if told else ""
