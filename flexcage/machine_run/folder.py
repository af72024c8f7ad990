"""The folder of a machine's run, and whether the run there can be gone on with.

machine.toml, ...   the machine as it was run, its static solution (``machine.writing``)
NAME/               each bearing's run (``run.folder``)
shaft.zarr/         what happened to the rotor. It is written behind the bearings' blocks, counts
                    the machine's, and holds the checkpoints (``results.store``)
shaft.nc, machine_summary.*, images/   what was made of them
"""

from __future__ import annotations

import logging
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from flexcage._version import __version__
from flexcage.case import Case, load_case
from flexcage.case.files import bytes_of
from flexcage.core.binding import flat
from flexcage.core.errors import InputError
from flexcage.core.output_folders import RESULTS, SHAFT_STORE
from flexcage.core.sources import physics
from flexcage.core.toml import read_toml
from flexcage.core.writing import check_own
from flexcage.machine.machine import Machine
from flexcage.machine.writing import MACHINE
from flexcage.machine_run.turning import KEPT, Turning, kept_turning
from flexcage.results.commit import checksum, damaged
from flexcage.results.store import MemoryRunStore, RunStore
from flexcage.run.folder import difference, kept, named, was_written
from flexcage.run.seams import check_physics

log = logging.getLogger(__name__)

_NOT_OF_A_RUN = ("name", "description", "whirl", "given")
_FROM_STATIC = "load."  # keys of a bearing's case that the static solution gives


def attributes(machine: Machine, turning: Turning, cases: Mapping[str, Case]) -> dict[str, Any]:
    """What the store of a rotor holds beside the numbers; ``cases`` of its bearings by name."""
    files = machine.files
    for name, case in cases.items():
        files |= {f"bearings.{name}.{key}": file for key, file in case.files.items()}
    return {
        "machine": machine.to_toml(), "version": __version__, "physics": physics(),
        "files": {key: checksum(bytes_of(file)) for key, file in files.items()},
        KEPT: turning.to_table(),
    }  # fmt: skip


@dataclass(frozen=True)
class BegunMachine:
    """The run of a machine that stopped: stores of its rotor and, by name, of its bearings."""

    folder: Path
    shaft: RunStore
    bearings: Mapping[str, RunStore]

    @property
    def turning(self) -> Turning:
        """The shaft as the run has it."""
        return kept_turning(self.shaft)

    def case(self, name: str, fresh: Case) -> Case:
        """The case of a bearing's run: ``fresh``, or as it was begun where no more differs than
        last digits of its static load, as on another computer; InputError for another one."""
        store = self.bearings[name]
        _check_files(
            self.folder, self.shaft, {f"bearings.{name}.{k}": v for k, v in fresh.files.items()}
        )
        if fresh.hash == kept(store, "hash"):
            return fresh
        stored = load_case(kept(store, "case"))
        differ = fresh.difference(stored)
        if differ and all(key.startswith(_FROM_STATIC) for key in differ):
            return stored
        raise _another(self.folder, difference(fresh, stored), f"bearings.{name}")


def begun_machine(
    folder: Path, machine: Machine, *, other_version: bool = False
) -> BegunMachine | None:
    """The machine's run in ``folder``; None if it has not come so far that it can be gone on with.

    InputError if the folder holds the run of another machine, or one of another flexcage's physics
    unless ``other_version`` allows that.
    """
    path = folder / SHAFT_STORE
    check_own(path, *(folder / b.place.name for b in machine.bearings))
    if was_written(folder, MACHINE):
        _check_same(folder, machine, (folder / MACHINE).read_text("utf-8"))
    if not RunStore.begun(path):
        _clear(folder, [b.place.name for b in machine.bearings])
        log.warning("the run in '%s' was stopped before its first block; it begins anew", folder)
        return None
    shaft = RunStore.open(path)
    _check_same(folder, machine, kept(shaft, "machine"))
    _check_files(folder, shaft, machine.files)
    stores = {b.place.name: _opened(folder / b.place.name, shaft) for b in machine.bearings}
    if not shaft.complete:
        for store in (shaft, *stores.values()):
            check_physics(folder, store, other_version)
    return BegunMachine(folder, shaft, stores)


def _clear(folder: Path, names: Sequence[str]) -> None:
    """Remove what bearings left of a run whose rotor has no store, which is made last; InputError
    if there are blocks."""
    paths = [folder / name / RESULTS for name in names]
    if any(RunStore.open(path).n_time for path in paths if RunStore.begun(path)):
        raise damaged(folder / SHAFT_STORE, "is gone, and its bearings have blocks")
    for path in (folder / SHAFT_STORE, *paths):
        RunStore.clear_unbegun(path)


def _opened(folder: Path, shaft: MemoryRunStore) -> RunStore:
    """The store of a bearing; a block that it has and the shaft has not is written again."""
    store = RunStore.open(folder / RESULTS)
    if not 0 <= store.blocks - shaft.blocks <= 1:
        raise damaged(
            folder / RESULTS, f"holds {store.blocks} blocks, but the shaft's {shaft.blocks}"
        )
    if store.blocks > shaft.blocks:
        store.go_back(shaft.blocks)
    return store


def _check_same(folder: Path, machine: Machine, text: str) -> None:
    """InputError if the machine of a run, by its text, is another one."""
    was, now = (_entries(read_toml(t, MACHINE)) for t in (text, machine.to_toml()))
    keys = [key for key in {**was, **now} if was.get(key) != now.get(key)]
    if keys:
        raise _another(folder, named(keys, now, was), "machine")


def _entries(table: Mapping[str, Any]) -> dict[str, Any]:
    """Values of a machine that count in a run, by dotted path with bearings by name."""
    table = {key: value for key, value in table.items() if key not in _NOT_OF_A_RUN}
    rows = table.get("bearings", ())
    table["bearings"] = {str(row.get("name", k)): row for k, row in enumerate(rows)}
    return dict(flat(table))


def _check_files(folder: Path, shaft: MemoryRunStore, files: Mapping[str, str]) -> None:
    """InputError for a file that has changed since the run began; the run keeps what it needs of
    one that is gone."""
    was = shaft.layout.attrs.get("files", {})
    for key, file in files.items():
        if Path(file).is_file() and was.get(key) != checksum(bytes_of(file)):
            raise _another(folder, f" (the file of {key}, '{file}', has changed)", key)


def _another(folder: Path, how: str, where: str) -> InputError:
    return InputError(
        f"The machine differs from the one of the run in '{folder}'{how}; resume the same machine, "
        "or name another folder.",
        where=where,
    )
