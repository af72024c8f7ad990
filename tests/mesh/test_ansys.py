"""Ansys archives: a mesh with components, written by hand as Ansys writes them."""

from __future__ import annotations

import re

import numpy as np
import pytest

from flexcage.core.errors import InputError
from flexcage.mesh.io import read_mesh
from flexcage.modes.exchange.nodes import read_points

pytest.importorskip("mapdl_archive")


def component(name, numbers):
    lines = [f"CMBLOCK,{name},NODE,{len(numbers):8d}", "(8i10)"]
    return [*lines, *("".join(f"{n:10d}" for n in numbers[i : i + 8])
                      for i in range(0, len(numbers), 8))]  # fmt: skip


def write_cdb(mesh, path, *, kind=285, scale=1e3, leave_out=""):
    """NBLOCK, EBLOCK and node components, in mm."""
    lines = ["/PREP7", f"ET,1,{kind}", f"NBLOCK,6,SOLID,{len(mesh.points)},{len(mesh.points)}"]
    lines.append("(3i9,6e21.13e3)")
    for i, point in enumerate(mesh.points * scale):
        lines.append(f"{i + 1:9d}{0:9d}{0:9d}" + "".join(f"{c:21.13E}" for c in point))
    lines.append("N,R5.3,LOC,       -1,")
    lines += [f"EBLOCK,19,SOLID,{len(mesh.tets)},{len(mesh.tets)}", "(19i9)"]
    for i, (a, b, c, d) in enumerate(mesh.tets + 1):
        nodes = [a, b, c, c, d, d, d, d] if kind == 185 else [a, b, c, d]
        head = [1, 1, 1, 1, 0, 0, 0, 0, len(nodes), 0, i + 1]
        lines.append("".join(f"{n:9d}" for n in [*head, *nodes]))
    lines.append("       -1")
    for name, triangles in mesh.groups.items():
        if name != leave_out:
            written = name.upper().replace("+X", "_PX").replace("-X", "_MX")
            lines += component(written, np.unique(triangles) + 1)
    path.write_text("\n".join([*lines, "FINISH", ""]))
    return path


@pytest.mark.parametrize("kind", [285, 185])
def test_a_cage_in_millimetres(n1013, tmp_path, kind):
    mesh = n1013(fineness="coarse")
    read = read_mesh(write_cdb(mesh, tmp_path / "cage.cdb", kind=kind), unit="mm")
    assert read.volume == pytest.approx(mesh.volume, rel=1e-9)
    assert set(read.groups) == set(mesh.groups)
    for name in ("pocket4_side-x", "pocket0_front", "land_inner", "end+x"):
        assert len(read.groups[name]) == len(mesh.groups[name]), name


def of_workbench(path):
    """The archive as Workbench's input file has its nodes: in small letters, with one whole number
    a row, z last, and exponents of three digits."""
    text = re.sub(
        r"^( +\d+) +0 +0(( +-?[\d.]+E[+-]\d+){3})$",
        lambda row: row[1] + "".join(f"{_three(v):>20s}" for v in row[2].split()),
        path.read_text().replace("(3i9,6e21.13e3)", "(1i9,3e20.9e3)"),
        flags=re.MULTILINE,
    )
    text = re.sub("NBLOCK,6,SOLID,.*", "nblock,3", text).replace("N,R5.3,LOC,       -1,", "-1")
    path.write_text(text.replace("EBLOCK", "eblock").replace("SOLID", "solid"))
    return path


def _three(value):
    digits, _, power = f"{float(value):.9E}".partition("E")
    return f"{digits}E{int(power):+04d}"


def test_nodes_in_the_format_of_workbench_keep_their_z(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    path = of_workbench(write_cdb(mesh, tmp_path / "ds.cdb"))
    assert "(1i9,3e20.9e3)\n        1 " in path.read_text()
    read = read_mesh(path, unit="mm")
    assert read.volume == pytest.approx(mesh.volume, rel=1e-7)
    points = read_points(path, where="modes.body_nodes")
    assert np.abs(1e-3 * points.places - mesh.points).max() < 1e-9
    lines = path.read_text().splitlines()
    path.write_text("\n".join([*lines[:6], lines[6][:-4] + "****", *lines[7:]]))
    with pytest.raises(InputError, match=r"line 7: '3 .*\*\*\*\*' is no node by the format \(1i9"):
        read_mesh(path, unit="mm")


@pytest.mark.parametrize(
    ("change", "words"),
    [
        (lambda text: text.replace("FINISH", "NSCALE,,ALL,,,2,2,2"), "the command NSCALE"),
        (lambda text: text.replace("FINISH", "NROTAT,ALL"), "the command NROTAT"),
        (lambda text: re.sub(r"^( +2 +0 +0 .*)$", rf"\1{90.0:21.13E}", text, flags=re.M),
         "its nodes 2 have axes of their own"),
    ],
)  # fmt: skip
def test_nodes_of_a_body_that_are_moved_or_turned_are_refused(n1013, tmp_path, change, words):
    path = write_cdb(n1013(fineness="coarse"), tmp_path / "cage.cdb")
    assert len(read_points(path, where="modes.body_nodes").numbers) == 1980
    path.write_text(change(path.read_text()))
    with pytest.raises(InputError, match=words):
        read_points(path, where="modes.body_nodes")


def test_nodes_on_edges_of_degenerate_bricks_belong_to_them(n1013, tmp_path, caplog):
    """SOLID186 with corners I J K K M M M M: its nodes on edges are used, and may be curved."""
    mesh = n1013(fineness="coarse")
    path = write_cdb(mesh, tmp_path / "cage.cdb")
    a, b, c, d = mesh.tets[0]
    pairs = ((a, b), (b, c), (c, a), (a, d), (b, d), (c, d))
    places = [1e3 * mesh.points[list(pair)].mean(axis=0) for pair in pairs]
    places[0] = places[0] + 0.1  # mm
    extra = [1981 + i for i in range(6)]
    rows = [f"{n:9d}{0:9d}{0:9d}" + "".join(f"{x:21.13E}" for x in place)
            for n, place in zip(extra, places)]  # fmt: skip
    ij, jk, ki, im, jm, km = extra
    i, j, k, m = (int(n) + 1 for n in mesh.tets[0])
    nodes = [i, j, k, k, m, m, m, m, ij, jk, k, ki, m, m, m, m, im, jm, km, km]
    head = [1, 2, 1, 1, 0, 0, 0, 0, 20, 0, 1]
    numbers = [f"{n:9d}" for n in head + nodes]
    text = path.read_text().splitlines()
    at = next(n for n, line in enumerate(text) if line.startswith("EBLOCK"))
    text[at + 2 : at + 3] = ["".join(numbers[:19]), "".join(numbers[19:])]
    text[at - 1 : at - 1] = rows
    whole = "\n".join(text).replace("ET,1,285", "ET,1,285\nET,2,186")
    path.write_text(whole.replace("SOLID,1980,1980", "SOLID,1986,1986") + "\n")
    read = read_mesh(path, unit="mm")
    assert read.volume == pytest.approx(mesh.volume, rel=1e-9)
    assert "no tetrahedron has" not in caplog.text
    assert "edges of elements are curved" in caplog.text


@pytest.mark.parametrize("end", ["N,R5.3,LOC,       -1,", "N,UNBL,LOC,       -1,"])
def test_nodes_may_end_as_any_release_ends_them(n1013, tmp_path, end):
    path = write_cdb(n1013(fineness="coarse"), tmp_path / "cage.cdb")
    path.write_text(path.read_text().replace("N,R5.3,LOC,       -1,", end))
    assert read_mesh(path, unit="mm").pocket_count == 22


def test_a_component_that_is_missing_is_named(n1013, tmp_path):
    path = write_cdb(n1013(fineness="coarse"), tmp_path / "cage.cdb", leave_out="pocket3_rear")
    with pytest.raises(InputError, match="has no surface group 'pocket3_rear'"):
        read_mesh(path, unit="mm")


def test_bricks_and_no_archive(n1013, tmp_path):
    path = write_cdb(n1013(fineness="coarse"), tmp_path / "cage.cdb")
    text = path.read_text().splitlines()
    first = next(i for i, line in enumerate(text) if line.startswith("EBLOCK")) + 2
    numbers = [1, 1, 1, 1, 0, 0, 0, 0, 8, 0, 1, 1, 2, 3, 4, 5, 6, 7, 8]
    brick = "".join(f"{n:9d}" for n in numbers)
    path.write_text(
        "\n".join([*text[:first], brick, *text[first + 1 :]]).replace("ET,1,285", "ET,1,185")
    )
    with pytest.raises(InputError, match="elements of type 185 that are no tetrahedra"):
        read_mesh(path, unit="mm")
    other = tmp_path / "other.cdb"
    other.write_text("no archive\n")
    with pytest.raises(InputError, match="other.cdb"):
        read_mesh(other)


def with_lines(path, *lines):
    """The archive with commands before its end."""
    path.write_text(path.read_text().replace("FINISH", "\n".join([*lines, "FINISH"])))
    return path


@pytest.mark.parametrize(
    "command",
    ["NGEN,2,100,1,10", "esym,,100,1", "NUMMRG,NODE", "N,7,1.,2.,3.", "/INPUT,more,cdb",
     "NDELE,5", "CM,end_px,NODE", "CMDELE,LAND_INNER"],
)  # fmt: skip
def test_commands_that_change_the_mesh_are_refused_by_name(n1013, tmp_path, command):
    path = with_lines(write_cdb(n1013(fineness="coarse"), tmp_path / "cage.cdb"), command)
    name = command.split(",")[0].upper()
    with pytest.raises(InputError, match=rf"line \d+: the command {name} is not followed"):
        read_mesh(path, unit="mm")


def test_commands_that_change_nothing_are_passed_over(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    path = with_lines(
        write_cdb(mesh, tmp_path / "cage.cdb"),
        "MPTEMP,R5.0, 1, 1,  0.0", "MP,EX,1,1e5", "R,1,1.", "D,1,UX,0", "CM,other,ELEM", "/GO",
        "N,R5.3,LOC,       -1,", "EN,R5.5,ATTR,-1",
    )  # fmt: skip
    assert len(read_mesh(path, unit="mm").tets) == len(mesh.tets)


def test_a_component_with_nodes_that_are_not_there_is_refused(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    path = write_cdb(mesh, tmp_path / "cage.cdb", leave_out="end+x")
    with_lines(path, *component("END_PX", [*np.unique(mesh.groups["end+x"]) + 1, 9001]))
    with pytest.raises(InputError, match=r"'end\+x' has node 9001, which is not in it"):
        read_mesh(path, unit="mm")


def test_elements_of_unknown_type_are_refused(n1013, tmp_path):
    path = write_cdb(n1013(fineness="coarse"), tmp_path / "cage.cdb")
    path.write_text(path.read_text().replace("ET,1,285", "ET,1,96"))
    with pytest.raises(InputError, match="elements of type 96 that are no tetrahedra"):
        read_mesh(path, unit="mm")


def test_a_triangle_in_the_corner_of_two_faces_is_left_to_the_flatter(tmp_path):
    """All its nodes are in both components, since two of its edges are on the edge of both."""
    from flexcage.mesh.files.ansys import _boundary, _part_corners

    x, y = np.meshgrid([0.0, 1.0, 2.0], [0.0, 1.0, 2.0])
    top = np.column_stack([x.ravel(), y.ravel(), np.full(9, 1.0)])
    points = np.vstack([top, top - [0.0, 0.0, 1.0]])
    import scipy.spatial

    tets = scipy.spatial.Delaunay(points + 1e-6 * np.random.default_rng(0).random((18, 3)))
    boundary = _boundary(tets.simplices.astype(int))
    wall = np.abs(points[:, 0] - 2.0) < 1e-9
    corner = [2, 5, 8]  # of the top, on the edge to the wall
    groups = {
        "end+x": (points[boundary][:, :, 2] == 1.0).all(axis=1),
        "land_outer": wall[boundary].all(axis=1),
    }
    groups["land_outer"] |= np.isin(boundary, [1, *corner]).all(axis=1)
    shared = groups["end+x"] & groups["land_outer"]
    assert shared.any()
    _part_corners(points, boundary, groups)
    assert groups["end+x"][shared].all() and not groups["land_outer"][shared].any()
