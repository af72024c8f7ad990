"""An own mesh beside the cage of its case: out of place, incomplete and swapped are refused."""

from __future__ import annotations

from dataclasses import dataclass, replace
from types import MappingProxyType

import crown_cage
import numpy as np
import pytest
from test_io import regrouped

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import WebCrack
from flexcage.cages.window.defects import CrossbeamDefect
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.fem.model import assemble
from flexcage.mesh.io import write_mesh
from flexcage.mesh.options import MeshOptions
from flexcage.modes.interface import normalised

MM = 1e-3
N1013 = load_preset("N1013").cage
MACHINED = BallCage(
    bore=20 * MM, outside_diameter=26 * MM, width=12 * MM, pocket_diameter=6 * MM
)  # fmt: skip


@dataclass(frozen=True)
class Family:
    cage: object
    count: int
    pitch: float

    def build(self, *defects, **options):
        return build_cage_mesh(
            self.cage, pocket_count=self.count, pitch_diameter=self.pitch, defects=defects,
            options=MeshOptions(**options),
        )  # fmt: skip

    def read(self, mesh, tmp_path, *defects, suffix=".vtu"):
        path = write_mesh(mesh, tmp_path / f"cage{suffix}")
        return self.build(*defects, file=str(path))


FAMILIES = {
    "window": Family(N1013, 22, 82.5 * MM),
    "machined": Family(MACHINED, 8, 23 * MM),
    "spherical": Family(replace(MACHINED, pocket_shape="spherical"), 8, 23 * MM),
    "crown": Family(crown_cage.CAGE, crown_cage.Z, crown_cage.PITCH),
    "ribbon": Family(load_preset("15x37x10").cage, 7, 26 * MM),
}


@pytest.fixture(params=FAMILIES)
def family(request):
    return FAMILIES[request.param]


def moved(mesh, shift=(0.0, 0.0, 0.0), turn=None):
    points = mesh.points if turn is None else mesh.points @ turn.T
    return replace(mesh, points=points + np.array(shift))


def about(axis, degrees):
    from scipy.spatial.transform import Rotation

    return Rotation.from_euler(axis, degrees, degrees=True).as_matrix()


@pytest.mark.parametrize(("axis", "turn"), [("y", ("z", 90.0)), ("z", ("y", -90.0))])
def test_a_mesh_about_another_axis_is_told_so(family, tmp_path, axis, turn):
    mesh = moved(family.build(fineness="coarse"), turn=about(*turn))
    with pytest.raises(InputError, match=f"the cage's axis is {axis}, but should be x"):
        family.read(mesh, tmp_path)


@pytest.mark.parametrize(
    ("length", "words"),
    [
        (25.4, r"is in inch; write it in mm"),
        (10.0, r"is in cm; write it in mm"),
        (1000.0, r'set mesh.file_unit = "m"'),
    ],
)
def test_a_mesh_in_another_unit_is_told_which(family, tmp_path, length, words):
    """A file of millimetres, whose numbers are of a unit that is so many times as long."""
    mesh = family.build(fineness="coarse")
    path = write_mesh(replace(mesh, points=1e3 * mesh.points / length), tmp_path / "cage.vtu")
    with pytest.raises(InputError, match=words):
        family.build(file=str(path), file_unit="mm")


@pytest.mark.parametrize("fineness", ["coarse", "medium"])
def test_a_mesh_in_its_place_is_taken_without_a_word(family, tmp_path, caplog, fineness):
    mesh = family.build(fineness=fineness)
    assert len(family.read(mesh, tmp_path).tets) == len(mesh.tets)
    assert not caplog.records


@pytest.mark.parametrize(
    ("shift", "words"),
    [
        ((0.5, 0, 0), r"\+0\.[45]\d* mm along x|shifted axially by 0.5"),
        ((-2, 0, 0), r"-(2|1\.9)\S* mm along x|shifted axially by -"),
        ((0, 0.5, 0), r"\+0\.500 mm along y|pocket \d+ is"),
        ((0, 0, -2), r"-2\.000 mm along z|pocket \d+ is"),
    ],
)
def test_a_mesh_out_of_place_is_refused_with_how_far(family, tmp_path, shift, words):
    mesh = moved(family.build(fineness="coarse"), np.array(shift) * MM)
    with pytest.raises(InputError, match=words):
        family.read(mesh, tmp_path)


@pytest.mark.parametrize("axis", "xyz")
def test_a_turned_mesh_is_refused_with_its_angle(tmp_path, axis):
    window = FAMILIES["window"]
    mesh = moved(window.build(fineness="coarse"), turn=about(axis, 0.4))
    with pytest.raises(InputError, match=rf"by \+0\.400 deg about {axis}"):
        window.read(mesh, tmp_path)


def test_a_mesh_a_little_out_of_place_is_told_of(tmp_path, caplog):
    window = FAMILIES["window"]
    window.read(moved(window.build(fineness="coarse"), (0.04 * MM, 0, 0)), tmp_path)
    assert "by +0.040 mm along x (0.040 mm at most)" in caplog.text


@pytest.mark.parametrize("pair", [("land_inner", "land_outer"), ("end+x", "end-x")])
def test_swapped_names_are_refused(family, tmp_path, pair):
    a, b = pair
    mesh = regrouped(
        family.build(fineness="coarse"), lambda g: g.update({a: g[b], b: g[a]})
    )  # fmt: skip
    with pytest.raises(InputError, match="their names are swapped"):
        family.read(mesh, tmp_path)


def test_one_triangle_does_not_stand_for_a_face(family, tmp_path):
    mesh = family.build(fineness="coarse")
    lands = regrouped(mesh, lambda g: g.update({n: t[:1] for n, t in g.items() if "land" in n}))
    with pytest.raises(InputError, match=r"group 'land_\w+' has \S+ mm\^2 of a face that has"):
        family.read(lands, tmp_path)


def test_a_group_without_part_of_its_face_is_refused_with_how_much(family, tmp_path):
    mesh = family.build(fineness="coarse")
    x = mesh.points[mesh.groups["land_outer"], 0].mean(axis=1)
    kept = x > np.quantile(x, 0.2)
    less = regrouped(mesh, lambda g: g.update(land_outer=g["land_outer"][kept]))
    with pytest.raises(InputError, match=r"'land_outer' lacks [12]\d % of its face .*no group"):
        family.read(less, tmp_path)


def test_a_pocket_face_that_another_group_holds_is_named(tmp_path):
    window = FAMILIES["window"]

    def give(groups):
        face = groups["pocket4_side+x"]
        groups["pocket4_fillet"] = np.vstack([groups["pocket4_fillet"], face[:2]])
        groups["pocket4_side+x"] = face[2:]

    with pytest.raises(InputError, match=r"'pocket4_side\+x' lacks \d+ % .*'pocket4_fillet'"):
        window.read(regrouped(window.build(fineness="coarse"), give), tmp_path)


def test_an_odd_triangle_is_told_of(tmp_path, caplog):
    crown = FAMILIES["crown"]
    mesh = regrouped(
        crown.build(fineness="medium"), lambda g: g.update(pocket2_wall=g["pocket2_wall"][3:])
    )
    crown.read(mesh, tmp_path)
    assert "group 'pocket2_wall' lacks 2 % of its face (3 triangles" in caplog.text


def test_another_bore_than_the_case_says_is_refused(tmp_path):
    window = FAMILIES["window"]
    other = replace(window, cage=replace(window.cage, bore=78.5 * MM))
    mesh = other.build(fineness="coarse")
    with pytest.raises(InputError, match=r"'land_inner' has a mean radius of 39\.250 mm"):
        window.read(mesh, tmp_path)


def test_defects_of_the_case_are_part_of_it(tmp_path, caplog):
    window, bent = FAMILIES["window"], CrossbeamDefect(crossbeam=5, displacement=0.2 * MM)
    mesh = window.build(bent, fineness="medium")
    window.read(mesh, tmp_path, bent)
    assert not caplog.records


def test_an_unbalanced_cage_is_the_users_own_and_told_of(tmp_path, caplog):
    """Its pockets, lands and ends are in their places, and it has a hole on one side."""
    window = FAMILIES["window"]
    mesh = window.build(fineness="medium")
    faces = np.sort(mesh.tets[:, [[1, 2, 3], [0, 2, 3], [0, 1, 3], [0, 1, 2]]], axis=2)
    named = {tuple(t) for g in mesh.groups.values() for t in np.sort(g, axis=1).tolist()}
    free = np.array([not any(tuple(f) in named for f in own) for own in faces.tolist()])
    hole = free & (mesh.points[mesh.tets].mean(axis=1)[:, 1] > 0.03)
    whole = replace(mesh, tets=mesh.tets[~hole])
    used = np.unique(whole.tets)
    number = np.full(len(mesh.points), -1)
    number[used] = np.arange(len(used))
    groups = MappingProxyType({n: number[t] for n, t in mesh.groups.items()})
    window.read(
        replace(whole, points=mesh.points[used], tets=number[whole.tets], groups=groups), tmp_path
    )
    assert "the mass centre (" in caplog.text and "the mesh counts" in caplog.text


def test_nodes_in_one_place_are_told_of_unless_the_case_has_a_crack_there(tmp_path, caplog):
    """A deck whose parts were not merged is open there, in silence, as a cracked cage is."""
    machined, crack = FAMILIES["machined"], WebCrack(web=3, share=0.4)
    mesh = machined.build(crack, fineness="coarse")
    machined.read(mesh, tmp_path, crack)
    assert not caplog.records
    machined.read(mesh, tmp_path)
    assert "lie in the place of others: the mesh is open" in caplog.text


def test_a_station_without_area_is_refused(n1013):
    from flexcage.cages.window.interface import face_stations, station_weights

    mesh = n1013(fineness="coarse")
    x = mesh.points[mesh.groups["pocket3_front"], 0].mean(axis=1)
    half = regrouped(mesh, lambda g: g.update(pocket3_front=g["pocket3_front"][x > 1 * MM]))
    model = assemble(half, N1013.material, order=1)
    with pytest.raises(InputError, match="'pocket3_front' at its contact station 1 of 7"):
        station_weights(model, face_stations(N1013, 7), 22)


def test_stations_with_area_are_means():
    import scipy.sparse as sp

    weights = normalised(sp.csr_matrix([[1.0, 3.0], [2.0, 0.0]]), ["a", "b"])
    assert weights.toarray().tolist() == [[0.25, 0.75], [1.0, 0.0]]
