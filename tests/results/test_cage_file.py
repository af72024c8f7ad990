"""The file of a run's cage gives back what was written, or says in a sentence why it does not."""

import zipfile
from dataclasses import replace
from types import MappingProxyType

import numpy as np
import pytest

from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.results.cage_file import (
    CageRecord,
    cage_file,
    cage_record,
    check_same,
    find_cage,
    read_cage,
    shared_cage,
    write_cage,
)


@pytest.fixture
def record():
    random = np.random.default_rng(0)
    mesh = CageMesh(
        points=random.random((5, 3)),
        tets=np.array([[0, 1, 2, 3], [1, 2, 3, 4]]),
        groups=MappingProxyType(
            {"pocket0_wall": np.array([[0, 1, 2]]), "end+x": np.array([[1, 2, 4], [2, 3, 4]])}
        ),
        pocket_count=1,
        info=MappingProxyType(
            {
                "source": "built",
                "sector_points": 5,
                "following": np.array([1, 2, 3, 4, 0]),
                "sector_tets": np.array([[1], [0]]),
                "altered_sectors": (0, np.int64(3)),
                "volume_change": np.float64(1e-4),
                "defects": [{"kind": "x", "defect": object(), "asked": 1e-4}],
            }
        ),
    )
    reduced = {
        "basis": {
            "steps": random.integers(-(2**23), 2**23, (5, 3, 2), dtype=np.int32),
            "step": np.array([1e-9, 2e-9]),
            "kind": np.array(["free", "centrifugal"]),
            "digest": np.array("abc"),
        },
        "interface": {"modes": random.random((1, 4, 3, 2)), "patch_half_width": np.array(1e-3)},
    }
    return cage_record(mesh, reduced)


def test_all_comes_back(tmp_path, record):
    found = read_cage(write_cage(tmp_path / "deeper" / "cage.zip", cage_file(record)))
    np.testing.assert_array_equal(found.mesh.info["following"], [1, 2, 3, 4, 0])
    np.testing.assert_array_equal(found.mesh.info["sector_tets"], [[1], [0]])
    assert found.digest == record.digest and len(record.digest) == 16
    for kind, arrays in record.reduced.items():
        for name, array in arrays.items():
            np.testing.assert_array_equal(found.groups[kind][name], array)
    assert found.groups["basis"]["steps"].dtype == np.int32
    mesh, ours = found.mesh, record.mesh
    np.testing.assert_array_equal(mesh.points, ours.points)
    np.testing.assert_array_equal(mesh.tets, ours.tets)
    assert list(mesh.groups) == ["pocket0_wall", "end+x"]
    for name in mesh.groups:
        np.testing.assert_array_equal(mesh.groups[name], ours.groups[name])
    assert mesh.pocket_count == 1 and mesh.info["altered_sectors"] == (0, 3)
    assert mesh.info["defects"] == ({"kind": "x", "asked": 1e-4},)
    assert [p.name for p in (tmp_path / "deeper").iterdir()] == ["cage.zip"]


def test_another_cage_has_another_digest(record):
    def digest(points=0.0, **groups):
        mesh = replace(record.mesh, points=record.mesh.points + points)
        return cage_record(mesh, {**record.reduced, **groups}).digest

    interface = record.groups["interface"]
    others = {
        digest(),
        digest(points=1e-9),
        digest(basis={**record.groups["basis"], "digest": np.array("abd")}),
        digest(interface={**interface, "modes": interface["modes"] + 1e-12}),
    }
    assert len(others) == 4 and record.digest in others


def test_a_damaged_file_is_refused_in_a_sentence(tmp_path, record):
    path = write_cage(tmp_path / "cage.zip", cage_file(record))
    content = path.read_bytes()
    for spoiled in (b"", content[: len(content) // 2], b"no zip" * 100):
        path.write_bytes(spoiled)
        with pytest.raises(InputError, match=r"cannot be read .*; bring it back from a copy"):
            read_cage(path)
    middle = content.index(b"interface/modes/c") + 60  # within the samples of an array
    path.write_bytes(content[:middle] + bytes([content[middle] ^ 255]) + content[middle + 1 :])
    with pytest.raises(InputError, match="cannot be read"):
        read_cage(path)


def test_another_format_is_refused(tmp_path, record):
    path = write_cage(tmp_path / "cage.zip", cage_file(record))
    with zipfile.ZipFile(path) as old, zipfile.ZipFile(tmp_path / "new.zip", "w") as new:
        for name in old.namelist():
            text = old.read(name).replace(b'"flexcage_cage": 2', b'"flexcage_cage": 9')
            new.writestr(name, text)
    with pytest.raises(InputError, match="in format 9, and this flexcage reads format 2"):
        read_cage(tmp_path / "new.zip")


def test_a_missing_cage_is_named_with_both_places(tmp_path, record):
    run = tmp_path / "study" / "cases" / "abc"
    run.mkdir(parents=True)
    with pytest.raises(InputError, match=r"lacks its cage: neither .*abc/cage.zip' nor .*cages/0f"):
        find_cage(run, "0f")
    shared = write_cage(shared_cage(tmp_path / "study", "0f"), cage_file(record))
    assert find_cage(run, "0f") == shared
    own = write_cage(run / "cage.zip", cage_file(record))
    assert find_cage(run, "0f") == own


def test_a_cage_without_its_large_parts_is_compared(record):
    small = cage_record(record.mesh, record.reduced, large=False)
    assert small.digest == record.digest and small.mesh is None and "basis" not in small.groups
    made = record.reduced
    check_same(small, made)
    modes = made["interface"]["modes"]
    slightly = {"interface": {"modes": modes * (1.0 + 1e-8)}}
    check_same(small, slightly)
    for other in (-modes, modes[..., :1]):
        with pytest.raises(InputError, match="did not keep its cage .* made anew is another"):
            check_same(small, {"interface": {"modes": other}})


def test_a_rigid_cage_keeps_its_mesh(tmp_path, record):
    rigid = cage_record(record.mesh, {}, large=False)
    found = read_cage(write_cage(tmp_path / "cage.zip", cage_file(rigid)))
    assert isinstance(found, CageRecord) and found.reduced == {} and found.mesh is not None
