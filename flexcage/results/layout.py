"""The shape of a run's arrays, and how committed samples become a labelled dataset.

Shared by the store on disk and the one in memory, so that both check and label alike.
"""

from __future__ import annotations

import json
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from math import ceil
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.results.registry import LABELS, TIME, TIME_HF, Variable, variable

if TYPE_CHECKING:
    import xarray

Arrays = Mapping[str, np.ndarray]
Coord = tuple[tuple[str, ...], np.ndarray, dict[str, Any]]


@dataclass(frozen=True)
class StoreLayout:
    """Sizes, coordinates and variables of one run; ``coords`` holds (dims, values, attrs)."""

    variables: tuple[Variable, ...]
    coords: Mapping[str, Coord]
    n_time: int
    n_time_hf: int
    block: int
    block_hf: int
    attrs: Mapping[str, Any] = field(default_factory=dict)

    @property
    def n_blocks(self) -> int:
        return ceil(self.n_time / self.block)

    def size(self, dim: str) -> int:
        if dim == TIME:
            return self.n_time
        if dim == TIME_HF:
            return self.n_time_hf
        if dim in self.coords:
            return len(self.coords[dim][1])
        return len(LABELS[dim])

    def shape(self, var: Variable) -> tuple[int, ...]:
        return tuple(self.size(d) for d in var.dims)

    def chunk(self, var: Variable) -> tuple[int, ...]:
        first = self.block if var.dims[0] == TIME else self.block_hf
        shape = self.shape(var)
        return (max(min(first, shape[0]), 1), *(max(n, 1) for n in shape[1:]))

    def order(self, var: Variable) -> tuple[int, ...]:
        """Dimensions in the order of storage: time last, but of sparse variables first."""
        rest = tuple(range(1, len(var.dims)))
        return (0, *rest) if var.sparse else (*rest, 0)

    def span(self, index: int, grid: str) -> tuple[int, int]:
        """First sample of block ``index`` on a grid and the one after its last."""
        block, n = (self.block, self.n_time) if grid == TIME else (self.block_hf, self.n_time_hf)
        return min(index * block, n), min((index + 1) * block, n)

    def checked(self, index: int, arrays: Arrays, grid: str) -> dict[str, np.ndarray]:
        """The block's arrays in the types of datasets, after checking names, lengths and shapes."""
        wanted = {v.name: v for v in self.variables if v.dims[0] == grid}
        if set(wanted) != set(arrays):
            missing, extra = sorted(set(wanted) - set(arrays)), sorted(set(arrays) - set(wanted))
            raise ValueError(f"block {index}: missing {missing}, not declared {extra}")
        start, stop = self.span(index, grid)
        out: dict[str, np.ndarray] = {}
        lengths = set()
        for name, var in wanted.items():
            a = np.asarray(arrays[name], dtype=var.dtype)
            tail = self.shape(var)[1:]
            if a.ndim != len(var.dims) or a.shape[1:] != tail or a.shape[0] > stop - start:
                raise ValueError(
                    f"block {index}: {name} has shape {a.shape}, wanted (<= {stop - start}, "
                    f"{', '.join(map(str, tail))})"
                )
            lengths.add(a.shape[0])
            out[name] = a
        if len(lengths) > 1:
            raise ValueError(f"block {index}: arrays on {grid!r} differ in length: {lengths}")
        return out


def make_layout(
    *,
    coords: Mapping[str, Any],
    variables: Sequence[str | Variable],
    n_time: int,
    n_time_hf: int,
    block: int,
    block_hf: int | None,
    attrs: Mapping[str, Any],
) -> StoreLayout:
    """Check what a caller asks for and complete it with the fixed labels of the registry."""
    table = tuple(variable(v) if isinstance(v, str) else v for v in variables)
    if block_hf is None:
        ratio = round((n_time_hf - 1) / (n_time - 1)) if n_time > 1 and n_time_hf > 1 else 1
        block_hf = block * ratio
    full = {name: _coord(name, value) for name, value in coords.items()}
    for grid, n in ((TIME, n_time), (TIME_HF, n_time_hf)):
        if n and (grid not in full or len(full[grid][1]) != n):
            raise InputError(f"coords[{grid!r}] must hold the {n} sampling instants of the run.")
    for dim in {d for v in table for d in v.dims} - {TIME, TIME_HF}:
        if dim not in full:
            if dim not in LABELS:
                raise InputError(f"Dimension {dim!r} needs labels: pass coords[{dim!r}].")
            full[dim] = ((dim,), np.array(LABELS[dim]), {})
    return StoreLayout(table, full, n_time, n_time_hf, block, block_hf, dict(attrs))


def _coord(name: str, value: Any) -> Coord:
    if isinstance(value, tuple) and len(value) in (2, 3) and not np.isscalar(value[0]):
        dims, values = value[0], value[1]
        return tuple(dims), np.asarray(values), dict(value[2]) if len(value) == 3 else {}
    attrs = {"units": "s", "long_name": "time"} if name in (TIME, TIME_HF) else {}
    return (name,), np.asarray(value), attrs


def label_dataset(
    layout: StoreLayout,
    data: Mapping[str, Any],
    *,
    n_time: int,
    n_time_hf: int,
    state: dict[str, Any],
) -> xarray.Dataset:
    """Dataset of the first ``n_time`` and ``n_time_hf`` samples with labels and units.

    ``data`` maps a name to an array or an xarray variable (lazy from disk) of the full length.
    Adds the coordinate ``revolution`` (turns of the inner ring) where its angle is known.
    """
    import xarray as xr

    cut = {TIME: n_time, TIME_HF: n_time_hf}
    variables: dict[str, Any] = {}
    for var in layout.variables:
        whole = data[var.name]
        values = whole if isinstance(whole, xr.Variable) else xr.Variable(var.dims, whole)
        part = values.isel({var.dims[0]: slice(cut[var.dims[0]])})
        part.attrs = var.attrs
        variables[var.name] = part
    coords = {}
    for name, (dims, labels, attrs) in layout.coords.items():
        sel = tuple(slice(cut.get(d)) for d in dims)
        coords[name] = xr.Variable(dims, labels[sel], attrs)
    attrs = {name: plain_attr(value) for name, value in {**layout.attrs, **state}.items()}
    ds = xr.Dataset(variables, coords=coords, attrs=attrs)
    if "inner_angle" in ds:
        turns = (ds["inner_angle"] - ds["inner_angle"][:1].values) / (2.0 * np.pi)
        turns.attrs = {"units": "1", "long_name": "turns of the inner ring"}
        ds = ds.assign_coords(revolution=turns)
    return ds


def plain_attr(value: Any) -> Any:
    """An attribute as NetCDF can hold it: a text, numbers, anything else as JSON text."""
    if isinstance(value, bool):
        return int(value)
    held = isinstance(value, str | int | float | np.number | np.ndarray)
    return value if held else json.dumps(value)


def coords_to_json(coords: Mapping[str, Coord]) -> dict[str, Any]:
    return {
        name: {"dims": list(dims), "values": values.tolist(), "attrs": attrs}
        for name, (dims, values, attrs) in coords.items()
        if name not in (TIME, TIME_HF)
    }


def coords_from_json(stored: Mapping[str, Any]) -> dict[str, Coord]:
    return {
        name: (tuple(c["dims"]), np.array(c["values"]), dict(c["attrs"]))
        for name, c in stored.items()
    }
