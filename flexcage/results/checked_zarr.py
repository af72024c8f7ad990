"""Zarr stores, read safely: each node is checked before Zarr sees it.

A store may come from a stranger, and Zarr takes what its metadata says: filters of format 2 can be
pickles, which run code; metadata that a group holds of others ("consolidated") stand for theirs; a
shape may want more memory than there is. So only nodes of format 3 pass, of their own metadata, of
the types and codecs that flexcage writes, and of sizes that their bytes can hold.
"""

from __future__ import annotations

import zipfile
from collections.abc import Callable, Mapping, Sequence
from itertools import product
from math import prod
from pathlib import Path
from typing import Any

import numpy as np

from flexcage.core.reading import (
    MOST_MEMBERS,
    check_size,
    json_of,
    read_json,
    stored_members,
    table_of,
)
from flexcage.core.writing import unusable
from flexcage.results.shards import blosc_size

Arrays = Mapping[str, np.ndarray]

NODE = "zarr.json"
TYPES = (
    "bool", "int8", "int16", "int32", "int64", "uint8", "uint16", "uint32", "uint64", "float16",
    "float32", "float64",
)  # fmt: skip
CODECS = ("transpose", "bytes", "blosc", "crc32c")
_ARRAY_KEYS = {
    "shape", "data_type", "chunk_grid", "chunk_key_encoding", "fill_value", "codecs", "attributes",
    "dimension_names", "zarr_format", "node_type", "storage_transformers",
}  # fmt: skip


def group_attributes(node: Any) -> dict[str, Any]:
    """Attributes of a group by its metadata; ValueError for what is no group of format 3. What it
    says of other nodes is ignored."""
    _check_node(node, "group")
    return table_of(node.get("attributes", {}))


def array_shape(node: Any) -> tuple[tuple[int, ...], np.dtype]:
    """Shape and type of an array by its metadata; ValueError for one that flexcage would not have
    written."""
    _check_node(node, "array")
    table_of(node, shape=list, data_type=str, chunk_grid=dict, codecs=list)
    if unknown := set(node) - _ARRAY_KEYS:
        raise ValueError(f"it has the entry '{min(unknown)}'")
    if node["data_type"] not in TYPES:
        raise ValueError(f"it holds values of type '{node['data_type']}'")
    if node.get("storage_transformers"):
        raise ValueError("it is stored in transformed form")
    if table_of(node.get("chunk_key_encoding"), name=str)["name"] != "default":
        raise ValueError("its chunks have other names")
    shape, dtype = _sizes(node["shape"]), np.dtype(node["data_type"])
    _check_codecs(node["codecs"], _chunk_shape(node), dtype)
    fill = node.get("fill_value")
    if not isinstance(fill, (bool, int, float)) and fill not in ("NaN", "Infinity", "-Infinity"):
        raise ValueError("the value of its empty chunks is no number")
    return shape, dtype


def read_array(path: Path) -> np.ndarray:
    """A small array of a store in a folder, whose chunks are all there; ValueError otherwise."""
    import zarr

    node = read_json(path / NODE)
    there = sum(file.stat().st_size for file in path.rglob("*") if file.is_file())
    _check_chunks(node, lambda name: (path / name).read_bytes(), there)
    return np.asarray(zarr.open_array(str(path), mode="r", zarr_format=3)[...])


def read_zip(path: Path) -> tuple[dict[str, Any], dict[str, tuple[dict[str, Any], Arrays]]]:
    """The attributes of a store in a zip file, and of each of its groups attributes and arrays by
    name. ValueError for what flexcage would not have written, OSError from the disk."""
    import zarr
    from zarr.storage import ZipStore

    root, groups = _zip_nodes(path)
    with ZipStore(path, mode="r") as store:
        found: dict[str, tuple[dict[str, Any], Arrays]] = {}
        for kind, (attributes, names) in groups.items():
            arrays = {}
            for name in names:
                array = zarr.open_array(store, path=f"{kind}/{name}", mode="r", zarr_format=3)
                arrays[name] = np.asarray(array[...])
            found[kind] = attributes, arrays
    return root, found


def _zip_nodes(path: Path) -> tuple[dict[str, Any], dict[str, tuple[dict[str, Any], list[str]]]]:
    """Attributes of a zip file's root, and of each group attributes and names of arrays, all
    checked."""
    try:
        with zipfile.ZipFile(path) as archive:
            members = stored_members(archive)
            nodes: dict[str, Any] = {}
            for name in members:
                _check_member(name)
                folder, _, file = name.rpartition("/")
                if file == NODE:
                    nodes[folder] = json_of(archive.read(name))
            return _check_zip(archive, members, nodes)
    except (zipfile.BadZipFile, NotImplementedError, RuntimeError, EOFError) as error:
        raise ValueError(str(error) or type(error).__name__) from error


def _check_zip(
    archive: zipfile.ZipFile, members: Mapping[str, zipfile.ZipInfo], nodes: Mapping[str, Any]
) -> tuple[dict[str, Any], dict[str, tuple[dict[str, Any], list[str]]]]:
    if "" not in nodes:
        raise ValueError("it is no store of Zarr")
    groups: dict[str, tuple[dict[str, Any], list[str]]] = {}
    total, there = 0, sum(info.file_size for info in members.values())
    for folder, node in sorted(nodes.items(), key=lambda item: item[0].count("/")):
        kind, _, name = folder.partition("/")
        if not name:
            if "consolidated_metadata" in node and node["consolidated_metadata"] is not None:
                raise ValueError(f"'{folder}' speaks for other nodes (consolidated metadata)")
            groups[kind] = group_attributes(node), []
            continue
        if "/" in name or kind not in groups:
            raise ValueError(f"'{folder}' is in no group")

        def content(key: str, folder: str = folder) -> bytes | None:
            member = members.get(f"{folder}/{key}")
            return None if member is None else archive.read(member)

        total += _check_chunks(node, content, there)
        groups[kind][1].append(name)
    check_size(total, there)
    root, _ = groups.pop("")
    return root, groups


def _check_member(name: str) -> None:
    """ValueError for a name that leads out of the store, or of a file of another format."""
    parts = name.split("/")
    if any(unusable(part) for part in parts) or parts[-1].startswith("."):
        raise ValueError(f"it has a member '{name}'")


def _check_node(node: Any, kind: str) -> None:
    table_of(node)
    if node.get("zarr_format") != 3:
        raise ValueError(f"it is of Zarr format {node.get('zarr_format')}, not 3")
    if node.get("node_type") != kind:
        raise ValueError(f"it is no {kind}")


def _sizes(sizes: Any) -> tuple[int, ...]:
    if not isinstance(sizes, list) or not all(type(n) is int and 0 <= n < 2**62 for n in sizes):
        raise ValueError("its sizes are no whole numbers")
    return tuple(sizes)


def _chunk_shape(node: Mapping[str, Any]) -> tuple[int, ...]:
    """Sizes of an array's chunks, none larger than a chunk need be."""
    grid = table_of(node["chunk_grid"], name=str, configuration=dict)
    if grid["name"] != "regular":
        raise ValueError(f"its chunks lie on a grid '{grid['name']}'")
    return _sizes(grid["configuration"].get("chunk_shape"))


def _check_codecs(codecs: Any, chunk: Sequence[int], dtype: np.dtype) -> None:
    """ValueError for codecs other than those that flexcage writes, in its order."""
    names = [table_of(codec, name=str)["name"] for codec in codecs]
    if names == ["sharding_indexed"]:
        about = table_of(codecs[0].get("configuration"), chunk_shape=list, codecs=list)
        inner = _sizes(about["chunk_shape"])
        if len(inner) != len(chunk) or any(n == 0 or m % n for m, n in zip(chunk, inner)):
            raise ValueError("its chunks do not fill its files")
        if [table_of(c, name=str)["name"] for c in about.get("index_codecs") or ()] != [
            "bytes",
            "crc32c",
        ]:
            raise ValueError("the index of its files is of another kind")
        if any(codec.get("name") == "sharding_indexed" for codec in about["codecs"]):
            raise ValueError("its files lie in files")
        return _check_codecs(about["codecs"], inner, dtype)
    order = [CODECS.index(name) if name in CODECS else -1 for name in names]
    if -1 in order:
        raise ValueError(f"it is packed by '{names[order.index(-1)]}'")
    if "bytes" not in names or order != sorted(set(order)):
        raise ValueError(f"it is packed by {' and '.join(names) or 'nothing'}")
    return None


def _check_chunks(node: Any, content: Callable[[str], bytes | None], there: int) -> int:
    """Bytes of an array's values, after each chunk was compared with what it claims to hold;
    ``content`` gives the bytes of a file of the array, None for one that is not there, and
    ``there`` are the bytes of all."""
    shape, dtype = array_shape(node)
    chunk = _chunk_shape(node)
    if len(chunk) != len(shape) or any(n > max(m, 1) or n == 0 for n, m in zip(chunk, shape)):
        raise ValueError("its chunks are larger than it is")
    names = [codec["name"] for codec in node["codecs"]]
    if "sharding_indexed" in names:
        raise ValueError("its chunks lie in files of many")
    total = prod(shape) * dtype.itemsize
    check_size(total, there)
    counts = [-(-n // m) for n, m in zip(shape, chunk)]
    if prod(counts) > MOST_MEMBERS:
        raise ValueError(f"it has {prod(counts):,} chunks")
    for place in product(*map(range, counts)):
        packed = content("/".join(["c", *map(str, place)]))
        if packed is not None:
            _check_chunk(packed, prod(chunk) * dtype.itemsize, names)
    return total


def _check_chunk(packed: bytes, size: int, names: Sequence[str]) -> None:
    end = len(packed) - (4 if "crc32c" in names else 0)
    claimed = end if "blosc" not in names else blosc_size(packed[:end])
    if claimed != size:
        raise ValueError(f"a chunk claims to hold {claimed:,} bytes, where {size:,} are wanted")
