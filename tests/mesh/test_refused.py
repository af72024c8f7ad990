"""What a mesh file says and is not followed is refused by name; the message says where."""

from __future__ import annotations

import logging
from pathlib import Path

import dialects
import meshio
import numpy as np
import pytest

from flexcage.core.errors import InputError
from flexcage.mesh.files.abaqus import read_inp
from flexcage.mesh.files.msh import read_msh
from flexcage.mesh.files.raw import Refused
from flexcage.mesh.files.sound import sound_tetrahedra, warn_of_curves
from flexcage.mesh.io import read_mesh, write_mesh

HEAD = "*NODE\n1,0,0,0\n2,1,,\n3,0,1.0D0,0\n4,0,0,1\n5,1,1,1\n"  # 6 lines
SOLID = "*ELEMENT, TYPE=C3D4, ELSET=E\n1,1,2,3,4\n"
SHELLS = "*ELEMENT, TYPE=S3\n11,1,2,3\n12,1,2,4\n13,1,3,4\n"
NAMED = "*ELSET, ELSET=end+x\n11, 12, 13\n"


def deck(tmp_path, text):
    (tmp_path / "cage.inp").write_text(text)
    return tmp_path / "cage.inp"


REFUSED = {
    "*NGEN\n1, 4, 1": r"line 7: \*NGEN makes nodes by a rule",
    "*NFILL\na, b, 1": r"line 7: \*NFILL makes nodes",
    "*NCOPY, OLD SET=a": r"line 7: \*NCOPY makes nodes",
    "*ELGEN\n1, 3": r"line 7: \*ELGEN makes elements",
    "*ELCOPY, ELEMENT SHIFT=10": r"line 7: \*ELCOPY makes elements",
    "*INCLUDE, INPUT=part.inp": r"line 7: \*INCLUDE takes .* another file \('part.inp'\)",
    "*NODE, INPUT=part.inp": r"line 7: \*NODE takes .* another file",
    "*ELEMENT, TYPE=C3D4, INPUT=e.inp": r"line 7: \*ELEMENT takes .* another file",
    "*ELSET, ELSET=a, INPUT=e.inp": r"line 7: \*ELSET takes .* another file",
    "*NODE, SYSTEM=S\n9, 1, 0, 0": r"line 7: \*NODE, SYSTEM=S is not followed",
    "*SYSTEM\n1, 0, 0, 0, 1, 0": r"line 7: \*SYSTEM turns the axes",
    "*IMPERFECTION, FILE=modes": r"line 7: \*IMPERFECTION is not followed",
    "*SYMMETRIC MODEL GENERATION, PERIODIC": r"line 7: \*SYMMETRIC MODEL GENERATION is not",
    "*NODES\n9, 1, 2, 3": r"line 7: \*NODES is not followed",
    "*PARAMETER\nr = 3": r"line 7: \*PARAMETER is not followed",
    "*NODE, OFFSET=5\n9, 1, 2, 3": r"line 7: \*NODE has the parameter OFFSET",
    "*NODE\n9, 1, 2e, 3": "line 8: '2e' stands where a number belongs",
    "*NODE\n9, 1, nan, 3": "line 8: 'nan' stands where a number belongs",
    "*NODE\n4, 1, 2, 3": r"line 8: it numbers nodes twice \(4\)",
    "*ELSET, ELSET=a, GENERATE\n11, 13, -1": "line 8: from 11 to 13 by -1 there is no number",
    "*PART, NAME=B\n*NODE\n1,0,0,0\n2,1,0,0\n3,0,1,0\n4,0,0,1\n*ELEMENT, TYPE=C3D4\n1,1,2,3,4\n"
    "*END PART":
        "line 8: 'B' has tetrahedra as the deck itself has",
}  # fmt: skip


@pytest.mark.parametrize("text", REFUSED)
def test_keywords_that_change_the_mesh_are_named_with_their_line(tmp_path, text):
    path = deck(tmp_path, HEAD + text + "\n" + SOLID + SHELLS + NAMED)
    with pytest.raises(InputError, match=REFUSED[text]) as caught:
        read_mesh(path)
    assert "empty, cut short" not in str(caught.value) and "\n" not in str(caught.value)
    by_rule = any(word in text for word in ("GEN", "FILL", "COPY", "SYSTEM\n", "IMPERF"))
    assert not by_rule or "GENERATE" in text or "Job, Write Input" in str(caught.value)


GROUPS = {
    "*ELSET, ELSET=end+x\n11, 12, 77": "77: missing",
    "*ELSET, ELSET=end+x\n11, 12, 1": r"holds elements that are no triangles, 1 of 3 \(1: tetra4\)",
    "*ELEMENT, TYPE=S4\n21,1,2,3,4\n*ELSET, ELSET=end+x\n11, 21": "no triangles, 1 of [12] .21: S4",
    "*ELEMENT, TYPE=S4, ELSET=end+x\n21,1,2,3,4": "no triangles, 1 of [12] .21: S4",
    "*ELSET, ELSET=end+x\nnone": "line 14: the element set 'none' is not in it",
    "*ELSET, ELSET=end+x\nend+x": "holds itself",
    "*SURFACE, NAME=end+x, TYPE=NODE\n1, 1.": "line 13: the surface 'end.x' is of TYPE=NODE",
    "*SURFACE, NAME=end+x, CROP=YES\nE, S1": r"line 13: \*SURFACE has the parameter CROP",
    "*SURFACE, NAME=end+x, COMBINE=XOR\nA": "the surface 'A' is not in it",
    "*SURFACE, NAME=A\n1, S1\n*SURFACE, NAME=end+x, COMBINE=CUT\nA": "COMBINE=CUT is not followed",
    "*SURFACE, NAME=end+x\n99, S1": "line 14: a surface names element 99, which is not in it",
    "*SURFACE, NAME=end+x\n11, E1": "'E1' of a shell, which is an edge",
}


@pytest.mark.parametrize("text", GROUPS)
def test_a_group_is_read_whole_or_refused(tmp_path, text):
    with pytest.raises(Refused, match=GROUPS[text]):
        read_inp(deck(tmp_path, HEAD + SOLID + SHELLS + text + "\n"))


def test_combined_surfaces(tmp_path):
    text = "*SURFACE, NAME=A\nE, S1\nE, S2\n*SURFACE, NAME=B\nE, S2\nE, S3\n"
    for how in ("UNION", "INTERSECTION", "DIFFERENCE"):
        text += f"*SURFACE, NAME={how}, COMBINE={how}\nA, B\n"
    found = read_inp(deck(tmp_path, HEAD + SOLID + text)).surfaces
    sets = {n: {frozenset((t + 1).tolist()) for t in v} for n, v in found.items()}
    one, two, three = frozenset((1, 2, 3)), frozenset((1, 4, 2)), frozenset((2, 4, 3))
    assert sets["UNION"] == {one, two, three}
    assert sets["INTERSECTION"] == {two} and sets["DIFFERENCE"] == {one}


def test_what_says_nothing_of_the_mesh_is_passed_over(tmp_path):
    text = (
        "*MATERIAL, NAME=BRASS\n*ELASTIC\n1e5, 0.3\n*DENSITY\n8e-9,\n*EXPANSION\n2e-5\n"
        "*SOLID SECTION, ELSET=E, MATERIAL=BRASS\n1.,\n*NSET, NSET=N, GENERATE\n1, 4\n"
        "*AMPLITUDE, NAME=A\n0, 0, 1, 1\n*INITIAL CONDITIONS, TYPE=TEMPERATURE\nN, 20.\n"
        "*ORIENTATION, NAME=O\n1,0,0,0,1,0\n*BOUNDARY\n1, 1, 3\n*TIE, NAME=T\na, b\n"
        "*SPRING, ELSET=S\n\n1.\n*ELEMENT, TYPE=SPRINGA, ELSET=S\n50, 1, 2\n"
        "*STEP\n*STATIC\n*NODE FILE\nU\n*MODEL CHANGE, REMOVE\nE\n*END STEP\n*NGEN\n1, 2\n"
    )
    found = read_inp(deck(tmp_path, HEAD + SOLID + SHELLS + NAMED + text))
    assert len(found.tets) == 1 and len(found.surfaces["end+x"]) == 3


def test_a_surface_of_nodes_of_another_name_is_no_matter(tmp_path):
    text = "*SURFACE, NAME=other, TYPE=NODE\n1, 1.\n"
    found = read_inp(deck(tmp_path, HEAD + SOLID + SHELLS + NAMED + text))
    assert "TYPE=NODE" in found.no_surfaces["other"]


def sound(tmp_path, text):
    return sound_tetrahedra(read_inp(deck(tmp_path, HEAD + text)), Path("cage.inp"))


def test_two_elements_in_one_place_are_refused(tmp_path):
    with pytest.raises(InputError, match="in the place of others .1 of 2.: 7 on the nodes of 1;"):
        sound(tmp_path, SOLID + "*ELEMENT, TYPE=C3D4\n7, 2, 3, 1, 4\n")


def test_elements_that_overlap_are_refused(tmp_path):
    with pytest.raises(InputError, match="same side of a face and overlap: 8 and 1"):
        sound(tmp_path, SOLID + "*ELEMENT, TYPE=C3D4\n8, 1, 2, 3, 5\n")


def test_elements_without_volume_are_named_by_their_numbers(tmp_path):
    more = "".join(f"{70 + i}, 2, 3, 4, 5\n" if i == 3 else "" for i in range(4))
    flat = "*NODE\n6, .5, .5, 0\n*ELEMENT, TYPE=C3D4\n91, 1, 2, 3, 6\n"
    with pytest.raises(InputError, match=r"2 inverted or flat elements of 3 \(73, 91\)"):
        sound(tmp_path, SOLID + "*ELEMENT, TYPE=C3D4\n" + more.replace("4, 5", "5, 4") + flat)


def test_nodes_of_no_element_are_told_of(tmp_path, caplog):
    sound(tmp_path, SOLID)
    assert "nodes that no tetrahedron has (1 of 5): 5; they" in caplog.text


def test_a_comma_within_quotes_parts_no_name(tmp_path):
    """As Abaqus/CAE writes names that a person gave."""
    text = (
        f'*PART, NAME="cage, rev 2"\n{HEAD}{SOLID}*ELSET, ELSET="side, outer"\n1\n'
        '*SURFACE, TYPE=ELEMENT, NAME="end+x"\n"side, outer", S1\n*END PART\n'
        '*INSTANCE, NAME="cage, rev 2-1", PART="cage, rev 2"\n1, 2, 3\n*END INSTANCE\n'
    )
    mesh = read_inp(deck(tmp_path, text))
    assert mesh.surfaces["end+x"].tolist() == [[0, 1, 2]]
    assert mesh.points[0].tolist() == [1.0, 2.0, 3.0]


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("cage.frd", "holds results of CalculiX"),
        ("cage.exo", "a mesh whose groups are not read; save it as .msh"),
        ("cage.CATPart", "a shape without a volume mesh"),
        ("cage.hmascii", "a program whose decks are not read"),
    ],
)
def test_a_mesh_of_a_program_that_is_not_read_is_told_what_to_write(tmp_path, name, words):
    (tmp_path / name).write_text("nothing")
    with pytest.raises(InputError, match=words):
        read_mesh(tmp_path / name)


def test_many_numbers_are_counted(tmp_path, caplog):
    sound(tmp_path, "".join(f"{i}, 3, 3, {i}\n" for i in range(10, 20)) + SOLID)
    assert "nodes that no tetrahedron has (11 of 15): 5, 10, 11, 12, 13 and 6 more;" in caplog.text


@pytest.mark.parametrize("parametric", [False, True])
@pytest.mark.parametrize("parts", [0, 3])
@pytest.mark.parametrize("version", [2.2, 4.1])
def test_sound_files_of_gmsh_that_meshio_rejects(tmp_path, version, parametric, parts):
    """Of a box: nodes with parameters, partitions, a face in two physical groups."""
    import gmsh

    path = tmp_path / "box.msh"
    gmsh.initialize(interruptible=False, readConfigFiles=False)
    try:
        gmsh.option.setNumber("General.Verbosity", 0)
        gmsh.model.occ.addBox(0, 0, 0, 1, 1, 1)
        gmsh.model.occ.synchronize()
        gmsh.model.addPhysicalGroup(2, [1, 2], 1, "end+x")
        gmsh.model.addPhysicalGroup(2, [2, 3], 2, "gauge")
        gmsh.model.addPhysicalGroup(3, [1], 3, "cage")
        gmsh.option.setNumber("Mesh.MeshSizeMax", 0.4)
        gmsh.model.mesh.generate(3)
        tets = len(gmsh.model.mesh.getElementsByType(4)[0])
        if parts:
            gmsh.model.mesh.partition(parts)
        gmsh.option.setNumber("Mesh.MshFileVersion", version)
        gmsh.option.setNumber("Mesh.SaveParametric", int(parametric))
        gmsh.write(str(path))
    finally:
        gmsh.finalize()
    raw = read_msh(path)
    assert len(raw.tets) == tets
    for name, area in (("end+x", 2.0), ("gauge", 2.0)):
        faces = np.unique(np.sort(raw.surfaces[name], axis=1), axis=0)
        a, b, c = raw.points[faces].transpose(1, 0, 2)
        assert 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() == pytest.approx(area)


def test_a_face_in_two_physical_groups_keeps_all_its_triangles(tmp_path):
    rng = np.random.default_rng(5)
    mesh = dialects.small(rng)
    dialects.msh(mesh, rng, tmp_path / "cage.msh", version=4.1, binary=False)
    found = read_msh(tmp_path / "cage.msh").surfaces
    assert {n: len(t) for n, t in found.items() if n in mesh.groups} == {
        n: len(t) for n, t in mesh.groups.items()
    }


def test_a_script_that_calls_itself_a_mesh_is_not_run(tmp_path):
    (tmp_path / "cage.msh").write_text(f'SystemCall "touch {tmp_path}/done";\n')
    with pytest.raises(InputError, match="does not begin with \\$MeshFormat"):
        read_mesh(tmp_path / "cage.msh")
    assert not (tmp_path / "done").exists()


@pytest.mark.parametrize("order", [2, 3])
def test_bent_edges_of_any_order_are_told_of(tmp_path, caplog, order):
    rng = np.random.default_rng(1)
    mesh = dialects.small(rng)
    dialects.msh(mesh, rng, tmp_path / "c.msh", version=4.1, binary=True, order=order)
    raw = read_msh(tmp_path / "c.msh")
    warn_of_curves(raw, Path("c.msh"))
    assert not caplog.records
    raw.points[raw.solids[0][0, 4]] += 0.1
    with caplog.at_level(logging.WARNING):
        warn_of_curves(raw, Path("c.msh"))
    assert "edges of elements are curved" in caplog.text


def test_groups_of_a_mesh_are_faces_of_its_boundary(n1013, tmp_path):
    mesh = n1013(fineness="coarse")
    triangles = np.vstack(list(mesh.groups.values()))
    inner = mesh.tets[0, [1, 2, 3]]
    faces = np.sort(mesh.tets[:, dialects.FACES].reshape(-1, 3), axis=1)
    rows, count = np.unique(faces, axis=0, return_counts=True)
    inner = rows[count == 2][0]
    flags = {
        name: np.isin(np.arange(len(triangles)), at).astype(np.int32)
        for name, at in zip(mesh.groups, _places(mesh))
    }

    def written(change, more=()):
        data = {n: f.copy() for n, f in flags.items()}
        change(data)
        cells = [("tetra", mesh.tets), ("triangle", np.vstack([triangles, *more]))]
        none = np.zeros(len(mesh.tets), np.int32)
        both = {n: [none, f] for n, f in data.items()}
        meshio.Mesh(mesh.points, cells, cell_data=both).write(tmp_path / "c.vtu")
        return tmp_path / "c.vtu"

    def twice(data):
        data["land_inner"][np.flatnonzero(data["pocket3_rear"])[:2]] = 1

    with pytest.raises(InputError, match="2 triangles are in two groups, as of .*pocket3_rear"):
        read_mesh(written(twice))

    def inside(data):
        for name in data:
            data[name] = np.append(data[name], int(name == "end-x"))

    with pytest.raises(InputError, match="'end-x' has triangles that lie inside the body"):
        read_mesh(written(inside, [inner[None]]))


def _places(mesh):
    ends = np.cumsum([0, *(len(t) for t in mesh.groups.values())])
    return [np.arange(a, b) for a, b in zip(ends, ends[1:])]


def test_a_compression_that_is_not_read_is_named(n1013, tmp_path):
    """VTK's own writer compresses in four ways, of which meshio knows three."""
    vtk = pytest.importorskip("vtkmodules.vtkIOXML")
    mesh = n1013(fineness="coarse")
    reader = vtk.vtkXMLUnstructuredGridReader()
    reader.SetFileName(str(write_mesh(mesh, tmp_path / "cage.vtu")))
    writer = vtk.vtkXMLUnstructuredGridWriter()
    writer.SetInputConnection(reader.GetOutputPort())
    writer.SetFileName(str(tmp_path / "theirs.vtu"))
    for way in ("ZLib", "LZMA"):
        getattr(writer, f"SetCompressorTypeTo{way}")()
        writer.Write()
        assert len(read_mesh(tmp_path / "theirs.vtu").tets) == len(mesh.tets)
    writer.SetCompressorTypeToLZ4()
    writer.Write()
    with pytest.raises(InputError, match="compressed by LZ4, which is not read; write them with"):
        read_mesh(tmp_path / "theirs.vtu")


def test_numbers_that_no_program_counts_to_are_named(tmp_path):
    (tmp_path / "cage.inp").write_text(
        f"*NODE\n{10**20}, 0, 0, 0\n*ELEMENT, TYPE=C3D4\n1, {10**20}, 2, 3, 4\n"
    )
    with pytest.raises(InputError, match="line 2: the number 1000+ is larger than any program"):
        read_mesh(tmp_path / "cage.inp")


_MSH_1 = """$NOD
4
1 0 0 0
2 1 0 0
3 0 1 0
4 0 0 1
$ENDNOD
$ELM
2
1 2 1 1 3 1 2 3
2 4 2 1 4 1 2 3 4
$ENDELM
"""


def test_groups_without_names_are_told_so(tmp_path):
    """Format 1 of gmsh keeps numbers of groups; once, its surfaces were one of an empty name."""
    (tmp_path / "cage.msh").write_text(_MSH_1)
    with pytest.raises(InputError, match="has no named surfaces.*format 1 keeps no names: save as"):
        read_mesh(tmp_path / "cage.msh")


@pytest.mark.parametrize("lost", ["one inside", "one with an edge outside", "none"])
def test_a_void_that_a_lost_element_leaves_is_told(lost, caplog):
    """A line of a deck that was lost, inside: no group misses it, and the volume hardly."""
    import skfem

    from flexcage.mesh.cage_mesh import signed_volumes
    from flexcage.mesh.files.raw import RawMesh

    grid = skfem.MeshTet.init_tensor(*[np.linspace(0.0, 1.0, 6)] * 3)
    points, tets = grid.p.T, grid.t.T
    back = signed_volumes(points, tets) < 0.0
    tets = np.where(back[:, None], tets[:, [0, 2, 1, 3]], tets)
    sides = ((points[tets] == 0.0) | (points[tets] == 1.0)).sum(axis=1)  # corners on each plane
    ends = sides.max(axis=1)
    kept = np.ones(len(tets), bool)
    if lost != "none":
        kept[np.flatnonzero(ends == (0 if lost == "one inside" else 2))[0]] = False
    sound_tetrahedra(RawMesh(points=points, solids=(tets[kept],), surfaces={}), Path("box.inp"))
    gone = tets[~kept].ravel() + 1
    if lost == "none":
        assert not caplog.records
    else:
        assert "has 1 voids inside, with the nodes" in caplog.text
        assert all(str(node) in caplog.text for node in gone)
