"""What a run's Zarr group says of it: shapes, labels, and the case, made once when it begins."""

from __future__ import annotations

import hashlib
import json
import re
import warnings
from collections.abc import Iterable
from dataclasses import asdict
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from flexcage import _version
from flexcage.core.errors import InputError
from flexcage.core.reading import json_of, read_json, table_of
from flexcage.core.writing import check_name
from flexcage.results.checked_zarr import NODE, TYPES, array_shape, group_attributes, read_array
from flexcage.results.commit import FORMAT, SIDE, damaged
from flexcage.results.layout import StoreLayout, coords_from_json, coords_to_json
from flexcage.results.registry import LABELS, TIME, TIME_HF, Variable
from flexcage.results.shards import BLOSC, SLOTS

LARGEST_BLOCK = 2**31  # bytes of a variable's block: Blosc holds no more
_GRIDS = (TIME, TIME_HF)
_CHUNK = re.compile(r"c(/\d+)*")  # a file of an array's chunk


def create_arrays(path: Path, layout: StoreLayout) -> None:
    """Allocate the arrays of a layout at ``path``, and write its instants and labels."""
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
        shards: Any = {"shape": (first * slots(layout), *rest), "index_location": "start"}
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


def slots(layout: StoreLayout) -> int:
    """Blocks that a file has room for."""
    return min(SLOTS, max(layout.n_blocks, 1))


def read_layout(path: Path) -> StoreLayout:
    """The layout of a run on disk; InputError or ValueError for one that cannot be."""
    attributes = group_attributes(read_json(path / NODE))
    stored = table_of(
        json_of(attributes.get("layout", "")), variables=list, coords=dict, n_time=int,
        n_time_hf=int, block=int, block_hf=int,
    )  # fmt: skip
    coords = coords_from_json(stored["coords"])
    for grid in _GRIDS:
        if (path / grid / NODE).exists():
            node = read_json(path / grid / NODE)
            about = table_of(node.get("attributes", {}))
            coords[grid] = ((grid,), read_array(path / grid), about)
    layout = StoreLayout(
        tuple(Variable(**{**v, "dims": tuple(v["dims"])}) for v in stored["variables"]),
        coords,
        stored["n_time"],
        stored["n_time_hf"],
        stored["block"],
        stored["block_hf"],
        dict(table_of(json_of(attributes.get("run", "")))),
    )
    _check_layout(path, layout)
    return layout


def _check_layout(path: Path, layout: StoreLayout) -> None:
    """ValueError or InputError for names that lead out of the folder, and for sizes and types that
    are not those of the arrays there."""
    if layout.block < 1 or layout.block_hf < 0 or min(layout.n_time, layout.n_time_hf) < 0:
        raise ValueError("its sizes are no sizes of blocks")
    for dim, (dims, values, _) in layout.coords.items():
        check_name(dim, f"The name of labels in '{path}'")
        if np.ndim(values) != len(dims) or np.asarray(values).dtype.kind not in "biufU":
            raise ValueError(f"the labels '{dim}' do not fit their dimensions")
    taken = {SIDE, *_GRIDS}
    for v in layout.variables:
        if check_name(v.name, f"The name of a variable in '{path}'") in taken:
            raise ValueError(f"it has the variable '{v.name}' twice")
        taken.add(v.name)
        if v.dtype not in TYPES or not set(v.dims) <= {*layout.coords, *LABELS, *_GRIDS}:
            raise ValueError(f"its variable '{v.name}' is of an unknown kind")
        if v.dims[:1] not in [(grid,) for grid in _GRIDS] or (
            prod(layout.chunk(v)) * np.dtype(v.dtype).itemsize > LARGEST_BLOCK
        ):
            raise ValueError(f"its variable '{v.name}' has no blocks that can be")
        _check_array(path, layout, v)


def _check_array(path: Path, layout: StoreLayout, variable: Variable) -> None:
    """Compare a variable's array with the layout, which says how it is read."""
    name = variable.name
    if not (path / name / NODE).exists():
        raise damaged(path, f"lacks the array '{name}'")
    try:
        shape, dtype = array_shape(read_json(path / name / NODE))
    except ValueError as error:
        raise ValueError(f"in the array '{name}' {error}") from error
    if (shape, dtype) != (layout.shape(variable), np.dtype(variable.stored)):
        raise damaged(path, f"has an array '{name}' of other sizes than it says")


def metadata_checksum(path: Path, layout: StoreLayout) -> str:
    """64 digits that change with all that says what the arrays are: attributes, shapes, labels,
    instants."""
    digest = hashlib.sha256()
    for name in _metadata_files(path, layout):
        file = path / name
        digest.update(f"{name}\0".encode())
        if file.is_file():
            content = file.read_bytes()
            digest.update(f"{len(content)}\0".encode() + content)
    return digest.hexdigest()


def _metadata_files(path: Path, layout: StoreLayout) -> Iterable[str]:
    yield NODE
    for v in layout.variables:
        yield f"{v.name}/{NODE}"
    for name in sorted(layout.coords):
        files = (file for file in sorted((path / name).rglob("*")) if file.is_file())
        inside = (file.relative_to(path / name).as_posix() for file in files)
        # what Zarr reads; file managers leave files of their own (.DS_Store)
        yield from (f"{name}/{file}" for file in inside if file == NODE or _CHUNK.fullmatch(file))
