"""A mesh is what its file says: random small meshes in every dialect are read back the same."""

from __future__ import annotations

import dialects
import meshio
import numpy as np
import pytest

from flexcage.mesh.files.abaqus import read_inp, read_nodes
from flexcage.mesh.files.ansys import read_cdb
from flexcage.mesh.files.msh import read_msh
from flexcage.mesh.files.raw import group_name
from flexcage.mesh.files.vtu import read_vtu

SEEDS = range(25)


def assert_same(mesh, raw, *, numbered=True, near=1e-9):
    """Places of nodes, tetrahedra and groups; by numbers where the file has them."""
    used = np.unique(raw.tets)
    where = np.array([
        int(np.argmin(np.linalg.norm(raw.points[used] - p, axis=1))) for p in mesh.points
    ])  # fmt: skip
    rows = used[where]
    assert np.abs(raw.points[rows] - mesh.points).max() < near
    assert len(used) == len(mesh.points)
    if numbered:
        assert (raw.point_numbers[rows] == mesh.numbers).all()
        assert sorted(raw.solid_numbers) == sorted(mesh.elements)
    assert sorted(np.sort(raw.tets, axis=1).tolist()) == sorted(
        np.sort(rows[mesh.tets], axis=1).tolist()
    )
    found = {group_name(name): t for name, t in raw.surfaces.items() if group_name(name)}
    assert set(found) == set(mesh.groups)
    for name, triangles in mesh.groups.items():
        assert {frozenset(t) for t in found[name].tolist()} == {
            frozenset(t) for t in rows[triangles].tolist()
        }, name


@pytest.mark.parametrize("seed", SEEDS)
def test_abaqus(tmp_path, seed):
    rng = np.random.default_rng(seed)
    mesh = dialects.small(rng)
    (tmp_path / "cage.inp").write_bytes(dialects.abaqus(mesh, rng))
    assert_same(mesh, read_inp(tmp_path / "cage.inp"))
    if b"\0" not in (text := (tmp_path / "cage.inp").read_bytes()) and b"nstance" not in text:
        numbers, places, sets = read_nodes(tmp_path / "cage.inp")
        place = dict(zip(numbers.tolist(), places))
        own = np.array([place[n] for n in mesh.numbers])
        assert np.abs(own - mesh.points).max() < 1e-9 and set(sets["all"]) == set(numbers)


@pytest.mark.parametrize("seed", range(12))
@pytest.mark.parametrize(
    ("version", "binary"), [(2.2, False), (2.2, True), (4.0, False), (4.1, False), (4.1, True)]
)
def test_gmsh(tmp_path, seed, version, binary):
    rng = np.random.default_rng(seed)
    mesh = dialects.small(rng)
    order = int(rng.integers(1, 4)) if version != 4.0 else 1
    path = tmp_path / "cage.msh"
    dialects.msh(mesh, rng, path, version=version, binary=binary, order=order)
    if order > 1:  # nodes on edges are used, and no corners
        raw = read_msh(path)
        assert raw.tets.shape == mesh.tets.shape and raw.solids[0].shape[1] == (10, 20)[order - 2]
    assert_same(mesh, read_msh(path), numbered=False)


@pytest.mark.parametrize("seed", SEEDS)
def test_ansys(tmp_path, seed):
    pytest.importorskip("mapdl_archive")
    rng = np.random.default_rng(seed)
    mesh = dialects.small(rng)
    dialects.ansys(mesh, rng, tmp_path / "cage.cdb")
    assert_same(mesh, read_cdb(tmp_path / "cage.cdb"))


@pytest.mark.parametrize("seed", SEEDS)
def test_vtu(tmp_path, seed):
    rng = np.random.default_rng(seed)
    mesh = dialects.small(rng)
    triangles = np.vstack(list(mesh.groups.values()))
    owner = np.repeat(np.arange(len(mesh.groups)), [len(t) for t in mesh.groups.values()])
    cells = [("tetra", mesh.tets), ("triangle", triangles)]
    none = np.zeros(len(mesh.tets), np.int32)
    data = {n: [none, (owner == i).astype(np.int32)] for i, n in enumerate(mesh.groups)}
    meshio.Mesh(mesh.points, cells, cell_data=data).write(
        tmp_path / "cage.vtu", binary=bool(rng.integers(2))
    )
    assert_same(mesh, read_vtu(tmp_path / "cage.vtu"), numbered=False)


@pytest.mark.parametrize("seed", SEEDS)
def test_nastran_grids(tmp_path, seed):
    pytest.importorskip("pyyeti")
    from flexcage.modes.exchange.nodes import read_points

    rng = np.random.default_rng(seed)
    mesh = dialects.small(rng)
    dialects.nastran(mesh, rng, tmp_path / "cage.bdf")
    found = read_points(tmp_path / "cage.bdf", where="modes.body_nodes")
    place = dict(zip(found.numbers.tolist(), found.places))
    assert (
        np.abs(np.array([place[n] for n in mesh.numbers]) - mesh.points).max() < 1e-4
    )  # as written
    assert len(place) == len(mesh.points)
