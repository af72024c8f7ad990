"""Run stores: a run written block by block, safe against being killed at any moment.

On disk a run is a Zarr (version 3) group whose arrays are allocated in full on the sampling grid,
with one chunk a block along time, and up to ``shards.SLOTS`` of them in a file. Tables of blocks
(steps, events, loads) stand in such files as well. A block exists only once ``_run/commit.json``
counts it; that file is written aside, fsynced and atomically moved into place after the block's
chunks, its tables and its checkpoint are written. Readers trim every array to the commit, so what
a kill left half written is never seen. (Appending to arrays instead leaves unreadable stores.)

Format 6: the attribute ``run`` holds the case as it was run, its hash, and the digest of the cage
that modal coordinates refer to (``cage_file``); ``layout`` holds all shapes and labels. Both are
JSON text, which NetCDF can hold. Labels are arrays as well, for other programs. Format 5 has no
such arrays, and these attributes are tables. Format 4 is format 5 with other names (``renamed``);
it is read, not gone on with.
"""

from __future__ import annotations

import json
import shutil
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import asdict
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage import _version
from flexcage.core.errors import InputError
from flexcage.core.writing import replace
from flexcage.results.files import UNREADABLE, disk, joined, load, make_room, save
from flexcage.results.layout import (
    Arrays,
    Layout,
    coords_from_json,
    coords_to_json,
    label_dataset,
    make_layout,
)
from flexcage.results.registry import TIME, TIME_HF, Variable, rounded_loads
from flexcage.results.renamed import OLD_FORMAT, renamed, stored_then
from flexcage.results.shards import BLOSC, SLOTS, Chunks, encoded, packed, unpacked

if TYPE_CHECKING:
    import xarray

FORMAT = 6  # see above
_READ = (OLD_FORMAT, 5, FORMAT)
SIDE = "_run"  # folder beside the arrays: commit, checkpoint, steps, events
LAST = "last_state.npz"  # in SIDE, of a run whose solver stopped
LOADS = "loads"  # table of what moves and pushes a flexible cage at steps between samples
_EVERY = ("steps", "events")  # tables that every run has
_NOTHING: Mapping[str, np.ndarray] = {}
_NO_TABLES: Mapping[str, Arrays] = {}


class MemoryRunStore:
    """A run kept in memory, with the interface of :class:`RunStore`."""

    path: Path | None = None

    def __init__(self, layout: Layout) -> None:
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

    def steps(self) -> dict[str, np.ndarray]:
        """Solver steps of all committed blocks, one array a column."""
        return self._table("steps")

    def events(self) -> dict[str, np.ndarray]:
        """Events of all committed blocks, one array a column."""
        return self._table("events")

    def loads(self, block: int) -> dict[str, np.ndarray]:
        """What moves and pushes a flexible cage at steps of a block, a table: ``time`` [s],
        ``modes``, ``land`` [N], the rows ``touched`` of each step, and of these ``face`` (its
        pocket and number) and ``force`` [N]. Empty for a rigid cage, and for a run that an earlier
        flexcage made."""
        table = self._block_table(LOADS, block)
        return {**table, "modes": table["modes"].astype(float)} if table else {}

    def _table(self, kind: str) -> dict[str, np.ndarray]:
        return joined(self._block_table(kind, i) for i in range(self.shown))

    def _block_table(self, kind: str, block: int) -> dict[str, np.ndarray]:
        return self._tables.get(kind, {}).get(block, {})


class RunStore(MemoryRunStore):
    """A run on disk. Make one with :meth:`create`, read or go on with one by :meth:`open`."""

    path: Path

    def __init__(self, path: Path, layout: Layout, commit: dict[str, Any]) -> None:
        self.path = path
        super().__init__(layout)
        self._commit = commit

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
        make_room(path, overwrite)
        with disk(path, 0):
            _create_arrays(path, layout)
            commit = {"format": FORMAT, "blocks": 0, "n_time": 0, "n_time_hf": 0, "checkpoint": ""}
            for kind in _EVERY:
                (path / SIDE / kind).mkdir(parents=True)
            replace(path / SIDE / "commit.json", json.dumps(commit).encode())
        return cls(path, layout, commit)

    @staticmethod
    def begun(path: Path) -> bool:
        """Whether a run has its place on disk, so that it can be opened and gone on with."""
        return (path / SIDE / "commit.json").exists()

    @staticmethod
    def clear_unbegun(path: Path) -> None:
        """Remove what a run left that was stopped before its first block; InputError if there are
        blocks, which then only lack the file that counts them."""
        side = path / SIDE
        if any(side.glob("checkpoint*")) or any(side.glob("*/*")):
            raise _damaged(path, f"holds blocks, but lacks {SIDE}/commit.json")
        shutil.rmtree(path, ignore_errors=True)

    @classmethod
    def open(cls, path: str | Path) -> RunStore:
        """Open a run, finished or not, for reading or for writing its next block."""
        import zarr

        path = Path(path)
        commit = read_commit(path)
        try:
            group = zarr.open_group(str(path), mode="r", zarr_format=3)
            layout = _layout_from(group, commit["format"])
            for v in layout.variables:
                _array(group, v.name)
        except InputError:
            raise
        except Exception as error:
            raise InputError(f"The arrays of {path} cannot be opened: {error}.") from error
        store = cls(path, layout, commit)
        _check_whole(store)
        return store

    def dataset(self) -> xarray.Dataset:
        found = super().dataset()
        return renamed(found) if self._commit["format"] == OLD_FORMAT else found

    def _store(self, index, data, commit, checkpoint, tables) -> None:
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
                save(side / commit["checkpoint"], checkpoint)
            replace(side / "commit.json", json.dumps(commit).encode())
        before = self._commit["checkpoint"]
        self._commit = commit
        if before and before != commit["checkpoint"]:
            (side / before).unlink(missing_ok=True)

    def _arrays(self) -> Mapping[str, Any]:
        from flexcage.results.lazy import Blocks, lazy_variable

        found = {}
        for v in self.layout.variables:
            what = f"holds samples of the array '{v.name}' that cannot be read"
            refuse = partial(_damaged, self.path, what)
            found[v.name] = lazy_variable(Blocks(self.layout, v, self._chunks(v).read, refuse))
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
        return Chunks(self.path / var.name / "c", _slots(self.layout), rest)

    def _tables_of(self, kind: str) -> Chunks:
        return Chunks(self.path / SIDE / kind, _slots(self.layout))

    def checkpoint(self) -> dict[str, np.ndarray] | None:
        name = self._commit["checkpoint"]
        return self._load(name) if name else None

    def keep_last(self, state: Mapping[str, Any]) -> None:
        with disk(self.path, self.n_time):
            save(self.path / SIDE / LAST, state)

    def last(self) -> dict[str, np.ndarray] | None:
        return self._load(LAST) if (self.path / SIDE / LAST).exists() else None

    def _block_table(self, kind: str, block: int) -> dict[str, np.ndarray]:
        try:
            (chunk,) = self._tables_of(kind).read([block])
            return {} if chunk is None else unpacked(chunk)
        except UNREADABLE as error:
            raise _damaged(
                self.path, f"holds {kind} of block {block} that cannot be read"
            ) from error

    def _load(self, name: str) -> dict[str, np.ndarray]:
        """Arrays of a file of ``SIDE``."""
        try:
            return load(self.path / SIDE / name)
        except UNREADABLE as error:
            raise _damaged(self.path, f"holds {SIDE}/{name}, which cannot be read") from error


def read_commit(path: Path) -> dict[str, Any]:
    """What a run on disk counts as committed; InputError for one of another format."""
    try:
        commit = json.loads((path / SIDE / "commit.json").read_text("utf-8"))
    except FileNotFoundError:
        raise InputError(
            f"{path} holds no run of flexcage (it has no {SIDE}/commit.json).",
            where="path",
            value=str(path),
        ) from None
    except (OSError, ValueError) as error:
        raise InputError(f"The commit file of {path} cannot be read: {error}.") from error
    found = commit.get("format") if isinstance(commit, dict) else None
    if found not in _READ:
        raise InputError(
            f"The run in {path} is stored in format {found}, and this flexcage "
            f"({_version.__version__}) reads formats {OLD_FORMAT} to {FORMAT}: "
            "open it with the flexcage that wrote it, or run the case again.",
            where="path",
            value=str(path),
        )
    return commit


def _create_arrays(path: Path, layout: Layout) -> None:
    import zarr
    from zarr.codecs import BloscCodec, Crc32cCodec, TransposeCodec
    from zarr.errors import ContainsGroupError

    shape = {
        "variables": [asdict(v) for v in layout.variables],
        "coords": coords_to_json(layout.coords),
        "n_time": layout.n_time,
        "n_time_hf": layout.n_time_hf,
        "block": layout.block,
        "block_hf": layout.block_hf,
    }
    stored: dict[str, Any] = {
        "flexcage_format": FORMAT,
        "flexcage_version": _version.__version__,
        "layout": json.dumps(shape),
        "run": json.dumps(dict(layout.attrs)),
        "coordinates": " ".join(sorted(layout.coords)),  # CF: those without a dimension of a name
    }
    try:
        group = zarr.create_group(store=str(path), attributes=stored, zarr_format=3)
    except ContainsGroupError as exc:  # it was empty a moment ago
        raise InputError(
            f"Another run has just begun in '{path}'; name another folder, or wait for it.",
            where="out", value=str(path),
        ) from exc  # fmt: skip
    compressors = [BloscCodec(**BLOSC), Crc32cCodec()]
    for v in layout.variables:
        first, *rest = chunk = layout.chunk(v)
        shards: Any = {"shape": (first * _slots(layout), *rest), "index_location": "start"}
        group.create_array(
            v.name,
            shape=layout.shape(v),
            chunks=chunk,
            shards=shards,
            dtype=v.stored,
            fill_value=np.nan,
            filters=TransposeCodec(order=layout.order(v)),
            compressors=compressors,
            dimension_names=v.dims,
            attributes=dict[str, Any](v.attrs),
        )
    for name, (dims, values, attrs) in layout.coords.items():
        kind = "string" if values.dtype.kind in "UOT" else values.dtype
        labels = group.create_array(
            name, shape=values.shape, dtype=kind, dimension_names=dims, attributes=attrs,
            compressors=compressors,
        )  # fmt: skip
        labels[...] = values
    with warnings.catch_warnings():  # readers then need not list the folder
        warnings.filterwarnings("ignore", message=".*[Cc]onsolidated.*")
        zarr.consolidate_metadata(str(path), zarr_format=3)


def _array(group: Any, name: str) -> Any:
    """An array of a group, refused in Zarr's format 2: that may hold pickles, which run code."""
    array = group[name]
    if array.metadata.zarr_format != 3:
        raise ValueError(f"'{name}' is of Zarr format {array.metadata.zarr_format}, not 3")
    return array


def _layout_from(group: Any, of_format: int) -> Layout:
    stored, run = (_unpacked_attr(group.attrs[name]) for name in ("layout", "run"))
    if of_format == OLD_FORMAT:
        stored = {**stored, "variables": [stored_then(v) for v in stored["variables"]]}
    coords = coords_from_json(stored["coords"])
    for grid in (TIME, TIME_HF):
        if grid in group:
            array = _array(group, grid)
            coords[grid] = ((grid,), np.asarray(array[:]), dict(array.attrs))
    return Layout(
        tuple(Variable(**{**v, "dims": tuple(v["dims"])}) for v in stored["variables"]),
        coords,
        stored["n_time"],
        stored["n_time_hf"],
        stored["block"],
        stored["block_hf"],
        dict(run),
    )


def _unpacked_attr(value: Any) -> Any:
    """The table that an attribute holds: as JSON text, or in format 5 as it is."""
    return json.loads(value) if isinstance(value, str) else value


def _check_whole(store: RunStore) -> None:
    """Refuse a run that lacks an array, or samples that were committed: they would read as NaN;
    or one of the tables of its blocks."""
    path, layout = store.path, store.layout
    for grid, n in ((TIME, layout.n_time), (TIME_HF, layout.n_time_hf)):
        if n and not (path / grid / "zarr.json").exists():
            raise _damaged(path, f"lacks the instants '{grid}'")
    for v in layout.variables:
        if not (path / v.name / "zarr.json").exists():
            raise _damaged(path, f"lacks the array '{v.name}'")
        if 0 not in layout.shape(v):
            _check_there(store, store._chunks(v), f"samples of the array '{v.name}'")
    for kind in (*_EVERY, *([LOADS] if (path / SIDE / LOADS).is_dir() else [])):
        _check_there(store, store._tables_of(kind), f"{kind} of its blocks")


def _check_there(store: RunStore, chunks: Chunks, what: str) -> None:
    try:
        there = chunks.holds(store.shown)
    except ValueError as error:
        raise _damaged(store.path, f"holds {what} that cannot be read") from error
    if not there:
        raise _damaged(store.path, f"lacks {what}")


def _slots(layout: Layout) -> int:
    """Blocks that a file has room for."""
    return min(SLOTS, max(layout.n_blocks, 1))


def _damaged(path: Path, what: str) -> InputError:
    return InputError(
        f"The run in {path} is damaged: it {what}; bring it back from a copy, or run the case "
        "again.",
        where="path",
        value=str(path),
    )
