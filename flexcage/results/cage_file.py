"""The cage that a run's results refer to, in one file: mesh, mode shapes, interface, body.

Modal coordinates mean something only beside the shapes that they multiply, and a basis made again,
on another processor or by other releases of libraries, may be another one. So every run keeps its
cage: a Zarr group (version 3) in one zip file, with a group each for

    mesh        points [m], tets, triangles of the named groups, what is known of the mesh's sectors
    basis       shapes rounded to 24 bits (``modes.storage``; where the mesh repeats, one sector's
                and what those of others are beyond it, ``repeating``), stiffness, mass,
                frequencies, kinds
    interface   contact stations on the pockets' faces: modes there, compliances, weights
    body        inertia and damping of the floating frame
    table       the mode table

Texts are attributes. A rigid cage has a mesh alone. With ``output.keep_cage = false`` the large
parts, mesh and basis, are left out: they are made anew on loading, and compared.
"""

from __future__ import annotations

import json
import os
import zipfile
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from tempfile import TemporaryDirectory
from types import MappingProxyType
from typing import Any

import numpy as np

from flexcage.core.arrays import SPARSE, sparse_matrix
from flexcage.core.errors import InputError
from flexcage.core.hashing import content_hash
from flexcage.core.missing import POINTER, is_pointer
from flexcage.core.reading import json_of, table_of
from flexcage.core.writing import check_name, check_own, move_into_place
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.results.checked_zarr import Arrays, read_zip
from flexcage.results.repeating import pack, unpack

FORMAT = 2
NAME = "cage.zip"  # in a run's folder
SHARED = "cages"  # folder of a study, with one file for each distinct cage
LARGE = ("mesh", "basis")  # groups left out where a run keeps no cage
SAME = 1e-6  # of the largest displacement of a mode: what another processor's rounding may change
_TEXT = "texts"
_CHECKSUM = "checksum"  # of all arrays
_TABLE = "info_"  # before the names of a mesh's arrays beside points and tetrahedra

Groups = Mapping[str, Mapping[str, np.ndarray]]


@dataclass(frozen=True)
class CageRecord:
    """All arrays of one cage by group and name, and ``digest``, 16 digits that name them."""

    groups: Groups
    digest: str

    @property
    def mesh(self) -> CageMesh | None:
        """The mesh; None if the run did not keep it."""
        return _mesh_from(self.groups["mesh"]) if "mesh" in self.groups else None

    @property
    def reduced(self) -> dict[str, Mapping[str, np.ndarray]]:
        """The groups of a flexible cage's reduction; none of a rigid cage's."""
        return {kind: arrays for kind, arrays in self.groups.items() if kind != "mesh"}


def cage_record(mesh: CageMesh, reduced: Groups, *, large: bool = True) -> CageRecord:
    """The record of a cage: its mesh and the arrays of its reduction by kind. The rounded shapes
    enter the digest by that of the basis that they were rounded from.

    ``large`` False leaves the mesh and the shapes of a flexible cage out.
    """
    groups = {"mesh": _mesh_arrays(mesh), **reduced}
    named = {
        kind: {name: value for name, value in arrays.items() if name != "steps"}
        for kind, arrays in groups.items()
    }
    digest = content_hash(named)
    if reduced and not large:
        groups = {kind: arrays for kind, arrays in groups.items() if kind not in LARGE}
    return CageRecord(groups, digest)


@dataclass(frozen=True)
class CageFile:
    """What a record's file holds, and the record's digest."""

    digest: str
    content: np.ndarray  # (n,) bytes


def cage_file(record: CageRecord) -> CageFile:
    """The file of a record."""
    import zarr
    from zarr.codecs import BloscCodec, Crc32cCodec
    from zarr.storage import ZipStore

    blocks = BloscCodec(cname="zstd", clevel=3, shuffle="shuffle", blocksize=2**20)
    codecs = [blocks, Crc32cCodec()]
    with TemporaryDirectory() as folder:
        path = Path(folder) / NAME
        with ZipStore(path, mode="w") as store:
            kept = {
                kind: {name: np.asarray(value) for name, value in arrays.items()}
                for kind, arrays in _packed(record).items()
            }
            about = {
                "flexcage_cage": FORMAT, "digest": record.digest, _CHECKSUM: content_hash(kept)
            }  # fmt: skip
            root = zarr.create_group(store, zarr_format=3, attributes=about)
            for kind, values in kept.items():
                texts = {n: v.tolist() for n, v in values.items() if v.dtype.kind in "US"}
                group = root.create_group(kind, attributes={_TEXT: texts})
                for name, value in values.items():
                    if name not in texts:
                        group.create_array(name, data=value, compressors=codecs)
        return CageFile(record.digest, np.fromfile(path, np.uint8))


def write_cage(path: Path, file: CageFile) -> Path:
    """Write a cage's file in one move; one that is there is replaced. OSError from the disk."""
    path.parent.mkdir(parents=True, exist_ok=True)
    temporary = path.with_name(f"{path.name}.{os.getpid()}.new")  # workers may write the same
    try:
        file.content.tofile(temporary)
        move_into_place(temporary, path)
    except BaseException:
        temporary.unlink(missing_ok=True)
        raise
    return path


def read_cage(path: Path) -> CageRecord:
    """The record in a file; InputError if it is none, of another format, damaged, or changed."""
    check_own(path)
    if not zipfile.is_zipfile(path):
        raise _unreadable(path, POINTER if is_pointer(path) else "it was cut short or changed")
    try:
        root, stored = read_zip(path)
        found = root.get("flexcage_cage")
        if found == FORMAT:
            kept = {kind: _with_texts(*group) for kind, group in stored.items()}
            if root.get(_CHECKSUM) != content_hash(kept):
                raise ValueError("it was changed afterwards")
            groups = {kind: unpack(arrays) for kind, arrays in kept.items()}
            record = CageRecord(groups, str(root["digest"]))
            _check_record(record)
            return record
    except Exception as error:  # of the disk, the zip file, its checksums, or Zarr
        raise _unreadable(path, str(error) or type(error).__name__) from error
    raise InputError(
        f"'{path}' holds a cage in format {found}, and this flexcage reads format {FORMAT}; run "
        "the case again.",
        where="cage",
        value=str(path),
    )


def _check_record(record: CageRecord) -> None:
    """ValueError for indices that point nowhere."""
    for arrays in record.groups.values():
        for name in [name.removesuffix(".indptr") for name in arrays if name.endswith(".indptr")]:
            sparse_matrix({part: arrays[f"{name}.{part}"] for part in SPARSE}, name)
    mesh = record.groups.get("mesh")
    if mesh is None:
        return
    for name in ("tets", "triangles"):
        corners = mesh[name]
        if corners.size and not 0 <= corners.min() <= corners.max() < len(mesh["points"]):
            raise ValueError(f"{name} of the mesh have corners that are not there")


def _packed(record: CageRecord) -> Groups:
    """The groups as the file holds them: shapes by what repeats in them."""
    mesh, basis = record.mesh, record.groups.get("basis")
    if mesh is None or basis is None or "steps" not in basis:
        return record.groups
    return {**record.groups, "basis": pack(basis, mesh)}


def _unreadable(path: Path, reason: str) -> InputError:
    return InputError(
        f"The cage of the run, '{path}', cannot be read ({reason}); bring it back from a copy, or "
        "run the case again.",
        where="cage",
        value=str(path),
    )


def _with_texts(attributes: dict[str, Any], arrays: Mapping[str, np.ndarray]) -> Arrays:
    texts = table_of(attributes.get(_TEXT))
    return {**arrays, **{name: np.array(text, dtype=str) for name, text in texts.items()}}


def find_cage(folder: Path, digest: str) -> Path:
    """The file of the cage of the run in ``folder``: its own, or its study's; InputError if there
    is none."""
    check_name(digest, f"The cage of the run in '{folder}'")
    own, shared = folder / NAME, shared_cage(folder.resolve().parent.parent, digest)
    for path in (own, shared):
        if path.is_file():
            return path
    raise InputError(
        f"The run in '{folder}' lacks its cage: neither '{own}' nor '{shared}' is there. Bring the "
        f"file back (a study keeps the cages of its runs in its folder '{SHARED}'), or run the "
        "case again.",
        where="cage",
        value=digest,
    )


def check_same(record: CageRecord, made: Groups) -> None:
    """Refuse a cage that was made anew for a record without mesh and shapes, if its modes differ
    at the contact stations from those of the record by more than ``SAME`` of the largest."""
    was, now = record.groups["interface"]["modes"], made["interface"]["modes"]
    far = np.abs(now - was).max() / np.abs(was).max() if now.shape == was.shape else np.inf
    if far > SAME:
        how = (
            f"its modes differ by {far:.1e} of the largest"
            if np.isfinite(far)
            else (f"it has modes of shape {now.shape}, where the run has {was.shape}")
        )
        raise InputError(
            "The run did not keep its cage (output.keep_cage is false), and the one made anew is "
            f"another: {how}. Read the run where it was made, or run the case again with "
            "output.keep_cage = true.",
            where="output.keep_cage",
            value=far,
        )


def shared_cage(study: Path, digest: str) -> Path:
    """Where a study's folder keeps a cage that its runs share."""
    return study / SHARED / f"{digest}.zip"


def _mesh_arrays(mesh: CageMesh) -> dict[str, np.ndarray]:
    """A mesh as arrays: the triangles of all groups in a row, with names and counts; arrays of its
    ``info`` by their names."""
    tables = {k: _small(v) for k, v in mesh.info.items() if isinstance(v, np.ndarray)}
    values = {k: v for k, v in mesh.info.items() if k not in tables}
    names = list(mesh.groups)
    triangles = [np.asarray(mesh.groups[name]).reshape(-1, 3) for name in names]
    return {
        "points": np.asarray(mesh.points),
        "tets": _small(mesh.tets),
        "triangles": _small(np.vstack([np.empty((0, 3), np.int64), *triangles])),
        "group_names": np.array(names, dtype=str),
        "group_sizes": np.array([len(t) for t in triangles], np.int64),
        "pocket_count": np.array(mesh.pocket_count),
        "info": np.array(json.dumps(_plain(values))),
        **{f"{_TABLE}{name}": table for name, table in tables.items()},
    }


def _small(indices: np.ndarray) -> np.ndarray:
    return np.asarray(indices).astype(np.int32)


def _plain(value: Any) -> Any:
    """JSON values of what a mesh's ``info`` holds; the specs of defects, which the case has, are
    left out."""
    if isinstance(value, Mapping):
        return {k: _plain(v) for k, v in value.items() if k != "defect"}
    if isinstance(value, (list, tuple)):
        return [_plain(v) for v in value]
    return value.item() if isinstance(value, np.generic) else value


def _mesh_from(a: Mapping[str, np.ndarray]) -> CageMesh:
    info = {k: tuple(v) if isinstance(v, list) else v for k, v in json_of(str(a["info"])).items()}
    tables = [name for name in a if name.startswith(_TABLE)]
    info |= {name.removeprefix(_TABLE): a[name].astype(np.int64) for name in tables}
    triangles = np.split(a["triangles"].astype(np.int64), np.cumsum(a["group_sizes"])[:-1])
    groups = dict(zip((str(name) for name in a["group_names"]), triangles))
    return CageMesh(
        points=a["points"],
        tets=a["tets"].astype(np.int64),
        groups=MappingProxyType(groups),
        pocket_count=int(a["pocket_count"]),
        info=MappingProxyType(info),
    )
