"""Meshes in files: round trips, files of other programs, and files that cannot be used."""

from __future__ import annotations

import logging
from dataclasses import replace
from types import MappingProxyType

import meshio
import numpy as np
import pytest

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.window.defects import CrossbeamDefect
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import group_names
from flexcage.mesh.io import read_mesh, write_mesh
from flexcage.mesh.measure import in_pocket_frame
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.quality import check_mesh


def triangle_set(mesh, name):
    """Group as a set of oriented triangles, each rotated to start at its least vertex."""
    rows = mesh.groups[name]
    first = np.argmin(rows, axis=1)[:, None]
    return {tuple(r) for r in np.take_along_axis(rows, (first + [0, 1, 2]) % 3, axis=1)}


def assert_same(a, b):
    assert np.abs(a.points - b.points).max() < 1e-15
    assert (a.tets == b.tets).all()
    assert set(a.groups) == set(b.groups) and a.pocket_count == b.pocket_count
    for name in a.groups:
        assert triangle_set(a, name) == triangle_set(b, name), name


@pytest.mark.parametrize("suffix", [".msh", ".vtu"])
def test_round_trip(n1013, tmp_path, suffix):
    mesh = n1013(CrossbeamDefect(crossbeam=5, displacement=0.2e-3), fineness="coarse")
    path = write_mesh(mesh, tmp_path / f"cage{suffix}")
    assert_same(mesh, read_mesh(path))
    assert_same(mesh, read_mesh(path, pocket_count=22))


def test_medium_mesh_stays_below_a_megabyte(n1013, tmp_path):
    path = write_mesh(n1013(fineness="medium"), tmp_path / "cage.msh")
    assert path.stat().st_size < 1_000_000


@pytest.mark.parametrize("binary", [0, 1])
def test_gmsh_reads_ours_and_we_read_what_it_writes(n1013, tmp_path, binary):
    gmsh = pytest.importorskip("gmsh")
    mesh = n1013(fineness="coarse")
    path = write_mesh(mesh, tmp_path / "cage.msh")
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Verbosity", 0)
        gmsh.open(str(path))
        names = {gmsh.model.getPhysicalName(*g) for g in gmsh.model.getPhysicalGroups()}
        assert names == {*mesh.groups, "cage"}
        gmsh.option.setNumber("Mesh.MshFileVersion", 4.1)
        gmsh.option.setNumber("Mesh.Binary", binary)
        gmsh.model.mesh.setOrder(2)  # ten-node tetrahedra, read by their corners
        gmsh.write(str(tmp_path / "theirs.msh"))
    finally:
        gmsh.finalize()
    theirs = read_mesh(tmp_path / "theirs.msh")
    assert len(theirs.points) == len(mesh.points)
    assert theirs.volume == pytest.approx(mesh.volume, rel=1e-12)
    for name, triangles in mesh.groups.items():
        assert len(theirs.groups[name]) == len(triangles)


def write_inp(mesh, path, *, scale=1e3, rename=lambda n: n, inline=False):
    """An Abaqus deck in mm as a preprocessor writes it: solids, shells, and element sets."""
    lines = ["*HEADING", "cage", "*NODE"]
    for i, point in enumerate(mesh.points * scale):
        lines.append(f"{i + 1}, " + ", ".join(f"{c:.12g}" for c in point))
    lines.append("*ELEMENT, TYPE=C3D4, ELSET=solid")
    lines += [f"{i + 1}, " + ", ".join(map(str, t + 1)) for i, t in enumerate(mesh.tets)]
    number, sets = len(mesh.tets), {}
    if not inline:
        lines.append("*ELEMENT, TYPE=S3")
    for name, triangles in mesh.groups.items():
        if inline:
            lines.append(f"*ELEMENT, TYPE=S3, ELSET={rename(name)}")
        ids = []
        for t in triangles:
            number += 1
            ids.append(number)
            lines.append(f"{number}, " + ", ".join(map(str, t + 1)))
        sets[rename(name)] = ids
    for name, ids in () if inline else sets.items():
        lines.append(f"*ELSET, ELSET={name}")
        lines += [", ".join(map(str, ids[i : i + 8])) for i in range(0, len(ids), 8)]
    path.write_text("\n".join(lines) + "\n")
    return path


@pytest.mark.parametrize("inline", [True, False])
def test_abaqus_deck_in_millimetres(n1013, tmp_path, inline):
    mesh = n1013(fineness="coarse")
    path = write_inp(mesh, tmp_path / "cage.inp", inline=inline)
    read = read_mesh(path, unit="mm")
    assert read.volume == pytest.approx(mesh.volume, rel=1e-9)
    assert set(read.groups) == set(mesh.groups)
    assert triangle_set(read, "pocket4_side-x") == triangle_set(mesh, "pocket4_side-x")
    with pytest.raises(InputError, match='file_unit = "mm"'):
        read_mesh(path)


FACES = ((0, 1, 2), (0, 3, 1), (1, 3, 2), (2, 3, 0))  # S1 to S4 of a tetrahedron in Abaqus
MIDDLES = ((0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3))


def write_deck_of_surfaces(mesh, path, *, quadratic=False, bulge=0.0, part=True, name=str,
                           order=range(6)):  # fmt: skip
    """A deck in mm as Abaqus/CAE writes it: solids in a part, surfaces of their faces in the
    assembly. ``bulge`` moves the nodes in the middle of edges away from the axis; ``order`` is
    theirs in each element."""
    points, tets, written = mesh.points * 1e3, mesh.tets, mesh.tets
    if quadratic:
        pairs = np.sort(tets[:, MIDDLES].reshape(-1, 2), axis=1)
        edges, which = np.unique(pairs, axis=0, return_inverse=True)
        middle = points[edges].mean(axis=1) * [1.0, 1.0 + bulge, 1.0 + bulge]
        written = np.hstack([tets, len(points) + which.reshape(-1, 6)[:, list(order)]])
        points = np.vstack([points, middle])
    lines = ["*Heading", "** a comment", *(["*Part, name=CAGE"] if part else []), "*Node"]
    lines += [f"{i + 1:7d}, " + ", ".join(f"{c:.12g}" for c in p) for i, p in enumerate(points)]
    lines.append(f"*Element, type={'C3D10' if quadratic else 'C3D4'}")
    for i, nodes in enumerate(written + 1):
        row = [i + 1, *nodes]
        lines += [", ".join(map(str, row[:8])) + ("," if row[8:] else "")]
        lines += [", ".join(map(str, row[8:]))] if row[8:] else []
    lines.append("*Solid Section, elset=all, material=brass\n1.,")
    if part:
        lines += ["*End Part", "*Assembly, name=Assembly", "*Instance, name=CAGE-1, part=CAGE"]
        lines += ["*End Instance", "*Node", "1, 0., 0., 0."]
    owner = {frozenset(t[list(f)]): (i, s) for i, t in enumerate(tets) for s, f in enumerate(FACES)}
    for group, triangles in mesh.groups.items():
        sides = {}
        for triangle in triangles:
            element, side = owner[frozenset(triangle)]
            sides.setdefault(side, []).append(element + 1)
        for side, elements in sides.items():
            more = ", internal, instance=CAGE-1" if part else ""
            lines.append(f'*Elset, elset="_{name(group)}_S{side + 1}"{more}')
            lines += [", ".join(map(str, elements[i : i + 8])) for i in range(0, len(elements), 8)]
        lines.append(f'*Surface, type=ELEMENT,\nname="{name(group)}"')
        lines += [f'"_{name(group)}_S{side + 1}", S{side + 1}' for side in sides]
    path.write_text("\n".join([*lines, *(["*End Assembly"] if part else []), "*Step"]) + "\n")
    return path


@pytest.mark.parametrize("quadratic", [False, True])
@pytest.mark.parametrize(("part", "name"), [(True, str), (False, str.upper)])
def test_surfaces_of_element_faces(n1013, tmp_path, caplog, quadratic, part, name):
    mesh = n1013(fineness="coarse")
    path = tmp_path / "cage.inp"
    write_deck_of_surfaces(mesh, path, quadratic=quadratic, part=part, name=name)
    read = read_mesh(path, unit="mm", pocket_count=22)
    assert len(read.points) == len(mesh.points)
    assert read.volume == pytest.approx(mesh.volume, rel=1e-9)
    assert set(read.groups) == set(mesh.groups)
    for group in mesh.groups:
        assert triangle_set(read, group) == triangle_set(mesh, group), group
    assert not [r for r in caplog.records if r.levelno >= logging.WARNING]


def test_curved_edges_are_told_of(n1013, tmp_path, caplog):
    mesh = n1013(fineness="coarse")
    path = write_deck_of_surfaces(mesh, tmp_path / "c.inp", quadratic=True, bulge=1e-3)
    read = read_mesh(path, unit="mm")
    assert read.volume == pytest.approx(mesh.volume, rel=1e-9)
    assert "curved faces become flat" in caplog.text and "% of an edge" in caplog.text
    assert "order of another program" not in caplog.text


def test_nodes_on_edges_in_another_programs_order_are_no_curves(n1013, tmp_path, caplog):
    """gmsh numbers the last two edges of a tetrahedron the other way round than Abaqus."""
    mesh = n1013(fineness="coarse")
    path = write_deck_of_surfaces(
        mesh, tmp_path / "c.inp", quadratic=True, order=[0, 1, 2, 3, 5, 4]
    )
    read = read_mesh(path, unit="mm")
    assert read.volume == pytest.approx(mesh.volume, rel=1e-9)
    assert "order of another program, which does no harm if the first four" in caplog.text


@pytest.mark.parametrize("order", [1, 2])
def test_deck_that_gmsh_writes(n1013, tmp_path, order):
    gmsh = pytest.importorskip("gmsh")
    mesh = n1013(fineness="coarse")
    write_mesh(mesh, tmp_path / "cage.msh")
    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.setNumber("General.Verbosity", 0)
        gmsh.open(str(tmp_path / "cage.msh"))
        gmsh.model.mesh.setOrder(order)
        gmsh.write(str(tmp_path / "theirs.inp"))
    finally:
        gmsh.finalize()
    theirs = read_mesh(tmp_path / "theirs.inp")
    assert theirs.volume == pytest.approx(mesh.volume, rel=1e-9)
    assert {name: len(t) for name, t in theirs.groups.items()} == {
        name: len(t) for name, t in mesh.groups.items()
    }


NODES = "*NODE\n" + "".join(f"{i}, {x}, {y}, {z}\n" for i, (x, y, z) in enumerate(
    [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], 1
))  # fmt: skip
DECKS = {
    "bricks": ("*ELEMENT, TYPE=C3D8R\n1, 1, 2, 3, 4, 1, 2, 3, 4", "type C3D8R; only tetrahedra"),
    "too few nodes": ("*ELEMENT, TYPE=C3D10\n1, 1, 2, 3, 4", "other than 10 nodes"),
    "a node too many": ("*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 9", "node 9, which is not in it"),
    "two parts": ("*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n" + NODES, "numbers nodes twice"),
    "two instances": (
        "*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4\n*INSTANCE, NAME=A\n*END INSTANCE\n*INSTANCE, NAME=B\n",
        "stands in 2 instances",
    ),
    "unknown set": ("*SURFACE, NAME=end+x\nnone, S1", "set 'none' is not in it"),
    "unknown face": (
        "*ELEMENT, TYPE=C3D4, ELSET=all\n1, 1, 2, 3, 4\n*SURFACE, NAME=end+x\nall, S9",
        "face 'S9'",
    ),
    "no surfaces": ("*ELEMENT, TYPE=C3D4\n1, 1, 2, 3, 4", "no named surfaces"),
    "no solids": ("*ELEMENT, TYPE=S3\n1, 1, 2, 3", "no tetrahedra"),
}


@pytest.mark.parametrize("name", DECKS)
def test_deck_that_cannot_be_used_is_one_sentence(name, tmp_path):
    text, words = DECKS[name]
    (tmp_path / "cage.inp").write_text(NODES + text + "\n")
    with pytest.raises(InputError, match=words) as caught:
        read_mesh(tmp_path / "cage.inp")
    assert "\n" not in str(caught.value)


def test_surface_without_faces_is_where_solids_end(tmp_path):
    from flexcage.mesh.files.abaqus import read_inp

    (tmp_path / "two.inp").write_text(
        NODES + "5, 1, 1, 1\n*ELEMENT, TYPE=C3D4, ELSET=all\n1, 1, 2, 3, 4\n2, 2, 3, 4, 5\n"
        "*SURFACE, TYPE=ELEMENT, NAME=skin\nall\n*SURFACE, NAME=one\n2, S4\n"
    )
    mesh = read_inp(tmp_path / "two.inp")
    corners = [frozenset(t) for t in mesh.surfaces["skin"].tolist()]
    assert len(set(corners)) == 6 and frozenset([1, 2, 3]) not in corners
    assert mesh.surfaces["one"].tolist() == [[3, 4, 1]]


def test_bricks_among_tetrahedra_are_refused(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    cells = [("tetra", mesh.tets), ("hexahedron", mesh.tets[:1, [0, 1, 2, 3, 0, 1, 2, 3]])]
    meshio.Mesh(mesh.points, cells).write(tmp_path / "cage.vtu")
    with pytest.raises(InputError, match="another shape \\(hexahedron\\)"):
        read_mesh(tmp_path / "cage.vtu")


def test_vtu_with_an_array_a_group(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    triangles = np.vstack(list(mesh.groups.values()))
    at = np.cumsum([0, *(len(t) for t in mesh.groups.values())])
    data = {}
    for i, name in enumerate(mesh.groups):
        flag = np.zeros(len(triangles), np.int32)
        flag[at[i] : at[i + 1]] = 1
        data[name] = [np.zeros(len(mesh.tets), np.int32), flag]
    cells = [("tetra", mesh.tets), ("triangle", triangles)]
    meshio.write(tmp_path / "own.vtu", meshio.Mesh(mesh.points, cells, cell_data=data))
    assert_same(mesh, read_mesh(tmp_path / "own.vtu"))


def test_elements_numbered_the_other_way_round_are_turned(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    path = write_mesh(replace(mesh, tets=mesh.tets[:, [1, 0, 2, 3]]), tmp_path / "cage.vtu")
    read = read_mesh(path)
    assert read.volume == pytest.approx(mesh.volume, rel=1e-12)
    assert triangle_set(read, "land_outer") == triangle_set(mesh, "land_outer")


def test_a_few_inverted_elements_are_refused(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    tets = mesh.tets.copy()
    tets[7] = tets[7, [1, 0, 2, 3]]
    with pytest.raises(InputError, match="1 inverted or flat"):
        check_mesh(replace(mesh, tets=tets))
    path = write_mesh(replace(mesh, tets=tets), tmp_path / "cage.msh")
    with pytest.raises(InputError, match="1 inverted or flat"):
        read_mesh(path)


def regrouped(mesh, change):
    groups = dict(mesh.groups)
    change(groups)
    return replace(mesh, groups=MappingProxyType(groups))


def test_missing_group_names_the_nearest(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    path = write_inp(
        mesh, tmp_path / "a.inp", rename=lambda n: n.replace("pocket3_front", "Pocket3_frnt")
    )
    with pytest.raises(InputError, match="'pocket3_front'; nearest is 'Pocket3_frnt'"):
        read_mesh(path, unit="mm")
    with pytest.raises(InputError, match="'land_outer'; nearest is 'land_inner'"):
        check_mesh(regrouped(mesh, lambda g: g.pop("land_outer")))


def test_fillets_may_be_missing(n1013, tmp_path):
    """Where a pocket's faces meet."""
    mesh = n1013(fineness="coarse")

    def widen(groups):
        for k in range(22):
            fillet = groups.pop(f"pocket{k}_fillet")
            for face in ("front", "rear"):
                ahead = in_pocket_frame(mesh.points[fillet].mean(axis=1), k, 22)[:, 2] > 0.0
                own = fillet[ahead if face == "front" else ~ahead]
                groups[f"pocket{k}_{face}"] = np.vstack([groups[f"pocket{k}_{face}"], own])

    bare = regrouped(mesh, widen)
    read = read_mesh(write_mesh(bare, tmp_path / "cage.msh"))
    assert set(read.groups) == set(group_names(22)) and len(read.groups["pocket0_fillet"]) == 0


def test_fillets_without_a_name_are_refused(n1013):
    """A pocket whose faces do not meet at edges has fillets, and peaks of stress are there."""
    mesh = n1013(fineness="coarse")
    odd = regrouped(mesh, lambda g: g.update({"pocket3_flt": g.pop("pocket3_fillet")}))
    with pytest.raises(InputError, match=r"no surface group 'pocket3_fillet', .* do not meet"):
        check_mesh(odd)


def test_misplaced_groups_are_refused(n1013):
    mesh = n1013(fineness="coarse")

    def swap(a, b):
        return lambda g: g.update({a: g[b], b: g[a]})

    with pytest.raises(InputError, match="other side of the pocket"):
        check_mesh(regrouped(mesh, swap("pocket2_front", "pocket2_rear")))
    with pytest.raises(InputError, match="pocket 2 at azimuth 49.1 deg"):
        check_mesh(regrouped(mesh, swap("pocket2_side+x", "pocket3_side+x")))


def test_mesh_in_pieces_is_refused(n1013):
    mesh = n1013(fineness="coarse")
    n = len(mesh.points)
    double = replace(
        mesh, points=np.vstack([mesh.points] * 2), tets=np.vstack([mesh.tets, mesh.tets + n])
    )
    with pytest.raises(InputError, match="falls apart into 2 pieces"):
        check_mesh(double)


def test_group_that_is_no_boundary_of_the_body_is_refused(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    odd = regrouped(mesh, lambda g: g.update({"end+x": np.array([[0, 100, 900]])}))
    with pytest.raises(InputError, match="'end\\+x' has triangles that are no face"):
        read_mesh(write_mesh(odd, tmp_path / "cage.msh"))


@pytest.mark.parametrize("suffix", [".msh", ".inp", ".vtu"])
@pytest.mark.parametrize("content", [b"", b"\x00\x01rubbish", b"$MeshFormat\n4.1 0 8\n<VTKFile"])
def test_unreadable_file_is_one_sentence(tmp_path, suffix, content):
    path = tmp_path / f"bad{suffix}"
    path.write_bytes(content)
    with pytest.raises(InputError) as caught:
        read_mesh(path)
    assert "bad" in str(caught.value) and "\n" not in str(caught.value)


def test_cut_off_file_is_refused(n1013, tmp_path):
    for suffix in (".msh", ".vtu"):
        path = write_mesh(n1013(fineness="coarse"), tmp_path / f"cut{suffix}")
        path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])
        with pytest.raises(InputError):
            read_mesh(path)


OTHERS = {
    "cage.bdf": "is a Nastran deck, in which surfaces have no names; export the mesh",
    "cage.unv": r"converts it with its groups:  gmsh -save \S*cage.unv -o \S*cage.msh",
    "cage.med": "is a mesh of Salome; gmsh converts it",
    "cage.STL": "is a shape without a volume mesh; mesh it",
    "cage.vtk": "save it in ParaView as .vtu",
    "cage.msh.gz": "is packed; unpack it",
    "cage.odb": "write its input file",
    "fluent.msh": "is a mesh of Ansys Fluent; write an archive by CDWRITE",
}  # fmt: skip


@pytest.mark.parametrize("name", OTHERS)
def test_files_of_others_are_told_what_to_write(tmp_path, name):
    (tmp_path / name).write_bytes(b'(0 "GAMBIT to Fluent File")\n(2 3)\n')
    with pytest.raises(InputError, match=OTHERS[name]):
        read_mesh(tmp_path / name)


def test_groups_come_through_a_universal_file(n1013, tmp_path):
    """What the message says to do, done."""
    import gmsh

    mesh = n1013(fineness="coarse")
    path = write_mesh(mesh, tmp_path / "cage.msh")
    for source, into in ((path, "cage.unv"), (tmp_path / "cage.unv", "again.msh")):
        gmsh.initialize(interruptible=False, readConfigFiles=False)
        try:
            gmsh.option.setNumber("General.Verbosity", 0)
            gmsh.option.setNumber("Mesh.SaveGroupsOfElements", 1)
            gmsh.open(str(source))
            gmsh.write(str(tmp_path / into))
        finally:
            gmsh.finalize()
    read = read_mesh(tmp_path / "again.msh")
    assert {n: len(t) for n, t in read.groups.items()} == {
        n: len(t) for n, t in mesh.groups.items()
    }


def test_absent_unknown_and_unnamed_files(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    with pytest.raises(InputError, match="There is no mesh file"):
        read_mesh(tmp_path / "none.msh")
    (tmp_path / "cage.xyz").write_text("solid")
    with pytest.raises(InputError, match=".msh, .inp, .cdb or .vtu"):
        read_mesh(tmp_path / "cage.xyz")
    for suffix in (".msh", ".vtu"):
        plain = meshio.Mesh(mesh.points, [("tetra", mesh.tets)])
        path = tmp_path / f"unnamed{suffix}"
        plain.write(path, **({"file_format": "gmsh22"} if suffix == ".msh" else {}))
        with pytest.raises(InputError, match="no named surfaces"):
            read_mesh(path)
    with pytest.raises(InputError, match="written as .msh or .vtu"):
        write_mesh(mesh, tmp_path / "cage.obj")
    with pytest.raises(InputError, match="cannot be written"):
        write_mesh(mesh, tmp_path / "no_folder" / "cage.msh")


class TestFileInACase:
    def build(self, n1013, path, *defects, pocket_count=22):
        return build_cage_mesh(
            n1013.cage,
            pocket_count=pocket_count,
            pitch_diameter=n1013.pitch_diameter,
            defects=defects,
            options=MeshOptions(file=str(path)),
        )

    def test_defects_are_measured_on_the_file(self, n1013, tmp_path):
        defect = CrossbeamDefect(crossbeam=5, displacement=0.2e-3)
        path = write_mesh(n1013(defect, fineness="coarse"), tmp_path / "cage.msh")
        mesh = self.build(n1013, path, defect)
        assert mesh.info["defects"][0]["delivered"] == pytest.approx(0.2e-3, abs=1e-9)

    def test_a_file_that_is_not_what_the_case_says_is_refused(self, n1013, tmp_path):
        defect = CrossbeamDefect(crossbeam=5, displacement=0.2e-3)
        path = write_mesh(n1013(defect, fineness="coarse"), tmp_path / "cage.msh")
        with pytest.raises(InputError, match="pocket 4 is 8.000 mm wide .* 8.200 mm"):
            self.build(n1013, path)
        with pytest.raises(InputError, match="names 22 pockets, but the bearing has 20"):
            self.build(n1013, path, pocket_count=20)
