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
from flexcage.case.extensions import sources
from flexcage.core.binding import flat
from flexcage.core.errors import FlexcageError, InputError, unwritable
from flexcage.core.locks import LOCK, is_held
from flexcage.core.output_folders import check_run
from flexcage.core.sources import physics
from flexcage.core.warning import RunWarning
from flexcage.core.writing import check_own, replace
from flexcage.results import mode_file
from flexcage.results.cage_file import (
    NAME,
    CageFile,
    CageRecord,
    find_cage,
    read_cage,
    shared_cage,
    write_cage,
)
from flexcage.results.commit import damaged
from flexcage.results.store import MemoryRunStore, RunStore
from flexcage.results.summary import SUMMARY
from flexcage.run.seams import check_physics

log = logging.getLogger(__name__)

PART_OF = "machine"  # attribute of a store: the machine of which the run is a bearing's


def write_case(folder: Path, case: Case) -> None:
    """Write the case as run into the folder."""
    folder.mkdir(parents=True, exist_ok=True)
    replace(folder / "case.toml", case.to_toml().encode())


def was_written(folder: Path, file: str = "case.toml") -> bool:
    """Whether a run was to be written to ``folder``, though it may not have begun yet; ``file`` is
    what it writes first."""
    return (folder / file).is_file()


#: What flexcage reads and writes in a run's folder, beside the page, which it only replaces.
_OURS = (
    "case.toml", "results.zarr", NAME, SUMMARY, "summary.txt", mode_file.FILE, "images", "figures",
    "vtu",
)  # fmt: skip

#: What a run leaves that is killed before its case is on disk.
LEFT_OVER = (LOCK, "case.toml.new", "machine.toml.new")


def holds_nothing(folder: Path) -> bool:
    """Whether a folder is empty, but for what a run left that was killed as it began."""
    return all(path.name in LEFT_OVER for path in folder.iterdir())


def check_written(folder: Path, file: str = "case.toml") -> None:
    """InputError if there is nothing to resume in ``folder``; ``file`` is what a run writes
    first."""
    left = folder.is_dir() and any(folder.iterdir()) and holds_nothing(folder)
    if not was_written(folder, file) and not left:
        raise InputError(
            f"'{folder}' is not the folder of a run (it has no {file}), so there is nothing to "
            "resume there.",
            where="out",
            value=str(folder),
        )


def check_links(folder: Path) -> None:
    """InputError if what flexcage reads or writes in a run's folder is a link, which may lead
    anywhere."""
    check_own(*(folder / name for name in _OURS))


def begun_store(folder: Path, case: Case, *, other_version: bool = False) -> RunStore | None:
    """The store of the case's run in ``folder``; None if it has not come so far that it can be
    gone on with.

    What one left that was killed before is removed, to be begun anew. InputError if the folder
    holds the run of another case, one in another format, or one of another flexcage's physics
    unless ``other_version`` allows that.
    """
    check_links(folder)
    if not was_written(folder):
        log.warning("the run in '%s' was stopped before it had begun; it begins now", folder)
        return None
    path = folder / "results.zarr"
    store = RunStore.open(path) if RunStore.begun(path) else None
    if store is not None and PART_OF in store.layout.attrs:
        raise InputError(
            f"The run in '{folder}' is that of a bearing in a machine, which moves it; go on with "
            f"the machine: {way_on(folder, store)}",
            where="resume",
            value=str(folder),
        )
    stored, its_hash = _stored(folder, store)
    if case.hash != its_hash and not _without_its_files(case, stored):
        raise InputError(
            f"The case differs from the one of the run in '{folder}'{difference(case, stored)}; "
            "resume the same case, or name another folder.",
            where="case",
            value=case.hash,
        )
    if store is None:
        RunStore.clear_unbegun(path)
        log.warning("the run in '%s' was stopped before its first block; it begins anew", folder)
    elif not store.complete:
        check_physics(folder, store, other_version)
    return store


def difference(case: Case, stored: Case) -> str:
    """The first values in which two cases differ, in brackets."""
    differ = case.difference(stored)
    if not differ:
        return " (a file or function behind it has changed)"
    return named(list(differ), *({k: v[i] for k, v in differ.items()} for i in (0, 1)))


def _stored(folder: Path, store: RunStore | None) -> tuple[Case, str]:
    """The case of the run in a folder and its hash, as they were when it began."""
    if store is None:
        stored = load_case(folder / "case.toml")
        return stored, stored.hash
    return load_case(kept(store, "case")), kept(store, "hash")


def kept(store: MemoryRunStore, name: str) -> str:
    """A text that the results hold beside the numbers; InputError if they do not."""
    text = store.layout.attrs.get(name)
    if not isinstance(text, str):
        raise damaged(Path(str(store.path)), f"does not say its '{name}'")
    return text


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
    digest = kept(store, "cage")
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
    check_run(folder)
    check_links(folder)
    store = RunStore.open(folder / "results.zarr")
    text = kept(store, "case")
    case = load_case(text)
    _check_hash(folder, case, store)
    edit = _edit(folder / "case.toml", text, case)
    if not edit:
        return case, store, ()
    warning = RunWarning(
        "edited", f"{edit}; this is ignored: the results are those of the case as it was run."
    )
    log.warning(warning.text)
    return case, store, (warning,)


def way_on(folder: Path, store: MemoryRunStore) -> str:
    """The command that goes on with the run in a folder, or with the machine that it is part of."""
    if PART_OF in store.layout.attrs:
        return resume_command(folder.parent, "machine.toml")
    return resume_command(folder, "case.toml")


def resume_command(folder: Path, file: str) -> str:
    """The command that goes on with the run in a folder, of what its ``file`` says."""
    return f"flexcage run {folder / file} -o {folder} --resume"


def report_unfinished(folder: Path, store: MemoryRunStore, duration: float) -> None:
    """Log that a stored run is not finished, so that what is made of it is of a part;
    InputError if it has no sample yet. ``duration`` [s]: of the whole run."""
    if store.complete:
        return
    whole = folder.parent if PART_OF in store.layout.attrs else folder
    busy, n = is_held(whole), store.n_time
    now, way = "is still being computed", "wait until it has finished"
    if not busy:
        now, way = "was stopped", f"'{way_on(folder, store)}' goes on with it"
    if not n:
        raise InputError(
            f"The run in '{folder}' {now}, and has no sample yet; {way}.",
            where="run",
            value=str(folder),
        )
    reached = float(store.layout.coords["time"][1][n - 1])
    log.warning(
        "the run in '%s' %s: this is of its first %.4g ms of %.4g ms; %s",
        folder, now, 1e3 * reached, 1e3 * duration, way,
    )  # fmt: skip


def _check_hash(folder: Path, case: Case, store: MemoryRunStore) -> None:
    """InputError if the case in the results has not the hash that stands beside it. Files and
    functions of the user's own, or another flexcage, may change the hash of the same text."""
    attrs = store.layout.attrs
    same = attrs.get("physics") == physics() and not case.files and not sources()
    if same and kept(store, "hash") != case.hash:
        raise InputError(
            f"The results in '{folder}' name the case {attrs['hash']}, but hold the text of the "
            f"case {case.hash}: one of them was changed afterwards; bring the folder back from a "
            "copy, or run the case again.",
            where="case",
            value=attrs["hash"],
        )


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
    keys = [k for k in {**was, **now} if was.get(k) != now.get(k) and k != "given"]
    return f"'{path}' was edited after the run{named(keys, now, was)}" if keys else ""


def named(keys: list[str], new: dict[str, Any], old: dict[str, Any]) -> str:
    """The first of the values that differ, in brackets."""
    differences = [f"{key} is {new.get(key)}, was {old.get(key)}" for key in keys[:3]]
    more = f", and {len(keys) - 3} more" if len(keys) > 3 else ""
    return f" ({'; '.join(differences)}{more})" if differences else ""
