"""Run stores: a run written block by block, safe against being killed at any moment.

On disk a run is a Zarr (version 3) group whose arrays are allocated in full on the sampling grid,
with one chunk a block along time, and up to ``shards.SLOTS`` of them in a file. Tables of blocks
(steps, events, loads) stand in such files as well. A block exists only once ``_run/commit.json``
counts it (``commit``); that file is written aside, fsynced and atomically moved into place after
the block's chunks, its tables and its checkpoint are written. Readers trim every array to the
commit, so what a kill left half written is never seen. (Appending to arrays instead leaves
unreadable stores.)

Format 6: the attribute ``run`` holds the case as it was run, its hash, and the digest of the cage
that modal coordinates refer to (``cage_file``); ``layout`` holds all shapes and labels. Both are
JSON text, which NetCDF can hold. Labels are arrays as well, for other programs.
"""

from __future__ import annotations

import shutil
from collections.abc import Mapping, Sequence
from functools import partial
from math import prod
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.arrays import UNREADABLE
from flexcage.core.errors import InputError, RunFailed
from flexcage.core.reading import check_size
from flexcage.core.writing import replace
from flexcage.results.checked_zarr import NODE
from flexcage.results.commit import (
    COMMIT,
    SIDE,
    continued,
    damaged,
    first_commit,
    read_commit,
    vouched,
    vouches,
    write_commit,
)
from flexcage.results.files import disk, joined, load, npz_of, prepare_folder, save
from flexcage.results.layout import Arrays, StoreLayout, label_dataset, make_layout
from flexcage.results.metadata import create_arrays, metadata_checksum, read_layout, slots
from flexcage.results.registry import TIME, TIME_HF, Variable, rounded_loads
from flexcage.results.shards import Chunks, encoded, packed, unpacked

if TYPE_CHECKING:
    import xarray

CHECKPOINT = "checkpoint"  # what a commit calls it, whose name changes
LAST = "last_state.npz"  # in SIDE, of a run whose solver stopped
LOADS = "loads"  # table of what moves and pushes a flexible cage at steps between samples
_EVERY = ("steps", "events")  # tables that every run has
_NOTHING: Mapping[str, np.ndarray] = {}
_NO_TABLES: Mapping[str, Arrays] = {}


class MemoryRunStore:
    """A run kept in memory, with the interface of :class:`RunStore`."""

    path: Path | None = None

    def __init__(self, layout: StoreLayout) -> None:
        self.layout = layout
        self._commit: dict[str, Any] = {"blocks": 0, "n_time": 0, "n_time_hf": 0}
        self._checkpoint: dict[str, np.ndarray] | None = None
        self._last: dict[str, np.ndarray] | None = None
        self._tables: dict[str, dict[int, dict[str, np.ndarray]]] = {}
        self._data: dict[str, np.ndarray] = {}
        self._allocate()

    def _allocate(self) -> None:
        for v in self.layout.variables:
            self._data[v.name] = np.full(self.layout.shape(v), np.nan, dtype=v.dtype)

    def __repr__(self) -> str:
        where = self.path or "memory"
        return (
            f"{type(self).__name__}({where}, {self.n_time:,} of {self.layout.n_time:,} samples, "
            f"{len(self.layout.variables)} variables)"
        )

    @property
    def n_time(self) -> int:
        """Committed samples on the main grid."""
        return int(self._commit["n_time"])

    @property
    def blocks(self) -> int:
        """Full blocks committed; the next block to write has this number."""
        return int(self._commit["blocks"])

    @property
    def shown(self) -> int:
        """Blocks that have samples, one that is not full included."""
        return self.blocks + int(self.n_time > self.layout.span(self.blocks, TIME)[0])

    @property
    def complete(self) -> bool:
        return self.blocks == self.layout.n_blocks

    def write_block(
        self,
        index: int,
        arrays: Arrays,
        hf_arrays: Arrays | None = None,
        checkpoint: Mapping[str, Any] | None = None,
        tables: Mapping[str, Arrays] = _NO_TABLES,
    ) -> None:
        """Store and commit block ``index``: arrays (samples of the block, ...) by variable name.

        A block shorter than the grid's span (a run that stopped in its middle) is kept, but
        counts as open: pass no checkpoint with it, for a resumed run writes it again in full
        from the checkpoint of the block before. ``tables`` of any length, one array a column:
        "steps", "events", and ``LOADS`` of a flexible cage.
        """
        if index != self.blocks or index >= self.layout.n_blocks:
            raise ValueError(f"block {index} out of order: next is {self.blocks}")
        main = self.layout.checked(index, arrays, TIME)
        fine = self.layout.checked(index, hf_arrays or _NOTHING, TIME_HF)
        commit = dict(self._commit)
        for grid, part, key in ((TIME, main, "n_time"), (TIME_HF, fine, "n_time_hf")):
            start, stop = self.layout.span(index, grid)
            done = start + len(next(iter(part.values()))) if part else stop
            commit[key] = done
            if grid == TIME and done == stop:
                commit["blocks"] = index + 1
        given = {**dict.fromkeys(_EVERY, _NOTHING), **tables}
        self._store(index, {**main, **fine}, commit, checkpoint, given)

    def _store(self, index, data, commit, checkpoint, tables) -> None:
        for name, values in data.items():
            start = self._start(index, name)
            self._data[name][start : start + len(values)] = values
        for kind, table in tables.items():
            kept = self._tables.setdefault(kind, {})
            kept[index] = {k: np.array(v) for k, v in table.items()}
        if checkpoint is not None:
            self._checkpoint = {k: np.array(v) for k, v in checkpoint.items()}
        self._commit = commit

    def _start(self, index: int, name: str) -> int:
        var = next(v for v in self.layout.variables if v.name == name)
        return self.layout.span(index, var.dims[0])[0]

    def dataset(self) -> xarray.Dataset:
        """The committed part as a labelled dataset (SI units in ``attrs["units"]``)."""
        return label_dataset(
            self.layout,
            self._arrays(),
            n_time=self.n_time,
            n_time_hf=int(self._commit["n_time_hf"]),
            state={"complete": int(self.complete)},
        )

    def _arrays(self) -> Mapping[str, Any]:
        return self._data

    def checkpoint(self) -> dict[str, np.ndarray] | None:
        """The last committed checkpoint: arrays by name, or None before the first."""
        return None if self._checkpoint is None else dict(self._checkpoint)

    def keep_last(self, state: Mapping[str, Any]) -> None:
        """Keep the last state that a solver accepted before it stopped: time [s], y and y'."""
        self._last = {k: np.array(v) for k, v in state.items()}

    def last(self) -> dict[str, np.ndarray] | None:
        """The state of ``keep_last``; None for a run that did not stop so."""
        return self._last

    def vouch_for(self, name: str, content: bytes) -> None:
        """Note what a file of the run's folder is about to hold, so that a change is told."""

    def vouches_for(self, name: str, content: bytes) -> bool:
        """Whether a file of the run's folder holds what was noted."""
        return True

    @property
    def seams(self) -> list[dict[str, Any]]:
        """Where other sources went on with the run: ``sample``, ``version`` and ``physics``."""
        return list(self._commit.get("continued", ()))

    def go_on_by(self, version: str, physics: str) -> None:
        """Note that other sources compute what comes; it is kept with the next block."""
        self._commit = continued(self._commit, version, physics)

    def go_back(self, blocks: int) -> None:
        """Count the first ``blocks`` blocks alone; what follows is written again."""
        n_time, n_time_hf = (self.layout.span(blocks, grid)[0] for grid in (TIME, TIME_HF))
        self._commit = {**self._commit, "blocks": blocks, "n_time": n_time, "n_time_hf": n_time_hf}

    def check_there(self) -> None:
        """RunFailed if the run's folder was moved or removed meanwhile."""

    def steps(self) -> dict[str, np.ndarray]:
        """Solver steps of all committed blocks, one array a column."""
        return self._table("steps")

    def events(self) -> dict[str, np.ndarray]:
        """Events of all committed blocks, one array a column."""
        return self._table("events")

    def loads(self, block: int) -> dict[str, np.ndarray]:
        """What moves and pushes a flexible cage at steps of a block, a table: ``time`` [s],
        ``modes``, ``land`` [N], the rows ``touched`` of each step, and of these ``face`` (its
        pocket and number) and ``force`` [N]. Empty for a rigid cage."""
        table = self._block_table(LOADS, block)
        return {**table, "modes": table["modes"].astype(float)} if table else {}

    def _table(self, kind: str) -> dict[str, np.ndarray]:
        return joined(self._block_table(kind, i) for i in range(self.shown))

    def _block_table(self, kind: str, block: int) -> dict[str, np.ndarray]:
        return self._tables.get(kind, {}).get(block, {})


class RunStore(MemoryRunStore):
    """A run on disk. Make one with :meth:`create`, read or go on with one by :meth:`open`."""

    path: Path

    def __init__(self, path: Path, layout: StoreLayout, commit: dict[str, Any]) -> None:
        self.path = path
        super().__init__(layout)
        self._commit = commit
        self._place = _place_of(path)

    def _allocate(self) -> None:
        """Nothing in memory: the arrays are on disk."""

    @classmethod
    def create(
        cls,
        path: str | Path | None,
        *,
        coords: Mapping[str, Any],
        variables: Sequence[str | Variable],
        n_time: int,
        n_time_hf: int = 0,
        block: int,
        attrs: Mapping[str, Any],
        block_hf: int | None = None,
        overwrite: bool = False,
    ) -> MemoryRunStore:
        """Allocate a run at ``path`` (a new folder), or in memory if it is None.

        ``coords`` holds the instants "time" and "time_hf" [s] and the labels of every dimension
        that the registry does not fix; further ones as (dims, values, attrs). ``attrs`` must be
        plain JSON values.
        """
        layout = make_layout(
            coords=coords,
            variables=variables,
            n_time=n_time,
            n_time_hf=n_time_hf,
            block=block,
            block_hf=block_hf,
            attrs=attrs,
        )
        if path is None:
            return MemoryRunStore(layout)
        path = Path(path)
        prepare_folder(path, overwrite)
        with disk(path, 0):
            create_arrays(path, layout)
            commit = first_commit(metadata_checksum(path, layout))
            for kind in _EVERY:
                (path / SIDE / kind).mkdir(parents=True)
            write_commit(path, commit)
        return cls(path, layout, commit)

    @staticmethod
    def begun(path: Path) -> bool:
        """Whether a run has its place on disk, so that it can be opened and gone on with."""
        return (path / SIDE / COMMIT).exists()

    @staticmethod
    def clear_unbegun(path: Path) -> None:
        """Remove what a run left that was stopped before its first block; InputError if there are
        blocks, which then only lack the file that counts them."""
        side = path / SIDE
        if any(side.glob("checkpoint*")) or any(side.glob("*/*")):
            raise damaged(path, f"holds blocks, but lacks {SIDE}/{COMMIT}")
        shutil.rmtree(path, ignore_errors=True)

    @classmethod
    def open(cls, path: str | Path) -> RunStore:
        """Open a run, finished or not, for reading or for writing its next block."""
        path = Path(path)
        commit = read_commit(path)
        try:
            layout = read_layout(path)
        except InputError:
            raise
        except FileNotFoundError as error:
            lost = Path(error.filename).name if error.filename else "files of its arrays"
            raise damaged(path, f"lacks {lost}") from error
        except Exception as error:  # of whichever library reads a part of it
            raise damaged(path, f"has arrays that cannot be opened ({error})") from error
        store = cls(path, layout, commit)
        _check_whole(store)
        return store

    def _store(self, index, data, commit, checkpoint, tables) -> None:
        self.check_there()
        side = self.path / SIDE
        with disk(self.path, self.n_time):
            for v in self.layout.variables:
                if v.name in data and 0 not in self.layout.shape(v):
                    self._chunks(v).write(index, self._chunk(v, data[v.name]))
            for kind, table in tables.items():
                kept = rounded_loads(table) if kind == LOADS else table
                self._tables_of(kind).write(index, packed(kept))
            if checkpoint is not None:
                commit["checkpoint"] = f"checkpoint-{index + 1:06d}.npz"
                content = npz_of(checkpoint)
                replace(side / commit["checkpoint"], content)
                commit = vouched(commit, CHECKPOINT, content, and_before=False)
            write_commit(self.path, commit)
        before = self._commit["checkpoint"]
        self._commit = commit
        if before and before != commit["checkpoint"]:
            (side / before).unlink(missing_ok=True)

    def check_there(self) -> None:
        if _place_of(self.path) != self._place:
            raise RunFailed(
                f"The run's folder '{self.path.parent}' was moved or removed while it was in use; "
                "move it back and go on with --resume, or run the case again."
            )

    def _arrays(self) -> Mapping[str, Any]:
        from flexcage.results.lazy import Blocks, lazy_variable

        found = {}
        for v in self.layout.variables:
            what = f"holds samples of the array '{v.name}' that cannot be read"
            refuse = partial(damaged, self.path, what)
            read = partial(self._read, self._chunks(v))
            found[v.name] = lazy_variable(Blocks(self.layout, v, read, refuse))
        return found

    def _read(self, chunks: Chunks, numbers: Sequence[int]) -> list[bytes | None]:
        """Chunks, None for those that are not there; RunFailed if the folder is not."""
        found = chunks.read(numbers)
        if None in found:
            self.check_there()
        return found

    def _chunk(self, var: Variable, values: np.ndarray) -> bytes:
        """A block of a variable as it is stored; of one that is not full, the rest is NaN."""
        shape = self.layout.chunk(var)
        if len(values) < shape[0]:
            rest = np.full((shape[0] - len(values), *shape[1:]), np.nan, values.dtype)
            values = np.concatenate([values, rest])
        return encoded(var.rounded(values), self.layout.order(var))

    def _chunks(self, var: Variable) -> Chunks:
        """The blocks of a variable."""
        rest = ["0"] * (len(var.dims) - 1)
        return Chunks(self.path / var.name / "c", slots(self.layout), rest)

    def _tables_of(self, kind: str) -> Chunks:
        return Chunks(self.path / SIDE / kind, slots(self.layout))

    def checkpoint(self) -> dict[str, np.ndarray] | None:
        name = self._commit["checkpoint"]
        if not name:
            return None
        found, file = self._load(name), self.path / SIDE / name
        if not vouches(self._commit, CHECKPOINT, file.read_bytes()):
            raise damaged(self.path, f"holds {SIDE}/{name}, which was changed afterwards")
        return found

    def keep_last(self, state: Mapping[str, Any]) -> None:
        with disk(self.path, self.n_time):
            save(self.path / SIDE / LAST, state)

    def last(self) -> dict[str, np.ndarray] | None:
        return self._load(LAST) if (self.path / SIDE / LAST).exists() else None

    def _block_table(self, kind: str, block: int) -> dict[str, np.ndarray]:
        try:
            (chunk,) = self._read(self._tables_of(kind), [block])
            return {} if chunk is None else unpacked(chunk)
        except UNREADABLE as error:
            raise damaged(
                self.path, f"holds {kind} of block {block} that cannot be read"
            ) from error

    def _load(self, name: str) -> dict[str, np.ndarray]:
        """Arrays of a file of ``SIDE``."""
        try:
            return load(self.path / SIDE / name)
        except FileNotFoundError:
            raise damaged(self.path, f"lacks {SIDE}/{name}") from None
        except UNREADABLE as error:
            raise damaged(self.path, f"holds {SIDE}/{name}, which cannot be read") from error

    def vouch_for(self, name: str, content: bytes) -> None:
        with disk(self.path, self.n_time):
            self._commit = vouched(self._commit, name, content)
            write_commit(self.path, self._commit)

    def vouches_for(self, name: str, content: bytes) -> bool:
        return vouches(self._commit, name, content)


def _place_of(path: Path) -> tuple[int, int] | None:
    """What tells a folder from another of its name; None if there is none."""
    try:
        found = path.stat()
    except OSError:
        return None
    return found.st_dev, found.st_ino


def _check_whole(store: RunStore) -> None:
    """Refuse a run that lacks an array, or samples that were committed: they would read as NaN;
    or one of the tables of its blocks; and one whose metadata were changed."""
    path, layout, commit = store.path, store.layout, store._commit
    for grid, n in ((TIME, layout.n_time), (TIME_HF, layout.n_time_hf)):
        if n and not (path / grid / NODE).exists():
            raise damaged(path, f"lacks the instants '{grid}'")
        if not commit[f"n_{grid}"] <= n:
            raise damaged(path, f"counts more samples than it has instants '{grid}'")
    stored = total = 0
    for v in layout.variables:
        if 0 not in layout.shape(v):
            _check_there(store, store._chunks(v), f"samples of the array '{v.name}'")
            stored += store._chunks(v).size(store.shown)
            total += commit[f"n_{v.dims[0]}"] * prod(layout.shape(v)[1:]) * 8
    for kind in (*_EVERY, *([LOADS] if (path / SIDE / LOADS).is_dir() else [])):
        _check_there(store, store._tables_of(kind), f"{kind} of its blocks")
    try:
        check_size(total, stored)
    except ValueError as error:
        raise damaged(path, f"has samples of which {error}") from error
    if commit["metadata"] != metadata_checksum(path, layout):
        raise damaged(
            path, f"has case, labels or sizes ({NODE} of an array, or of all) that were changed "
            "afterwards",
        )  # fmt: skip


def _check_there(store: RunStore, chunks: Chunks, what: str) -> None:
    try:
        there = chunks.holds(store.shown)
    except ValueError as error:
        raise damaged(store.path, f"holds {what} that cannot be read") from error
    if not there:
        raise damaged(store.path, f"lacks {what}")
