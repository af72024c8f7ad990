"""Meshes of conical cages: surfaces, mass against the dimensions, defects, and pictures' marks."""

from dataclasses import replace
from math import cos, pi, radians, sin

import numpy as np
import pytest
from conical_cage import CONE, COUNT, MM, ROLLERS, cone_mesh

from flexcage.cages.conical.mass import mass_of
from flexcage.cages.conical.walls import pocket_walls
from flexcage.cages.window.broken import BrokenCrossbeam
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect
from flexcage.cages.window.faces import pocket_size
from flexcage.cages.window.interface import station_weights
from flexcage.core.errors import InputError
from flexcage.fem.model import assemble
from flexcage.mesh.quality import check_mesh
from flexcage.stages import rigid_interface_of

ANGLE = ROLLERS.axis_angle
FACES = ("front", "rear", "side+x", "side-x")


def pocket_places(points, pocket):
    """(s, n, t) of points (m, 3), by turning a pocket to the top and its roller level."""
    psi = 2.0 * pi * pocket / COUNT
    x, y, z = points.T
    y, t = cos(psi) * y + sin(psi) * z - 12.5 * MM, cos(psi) * z - sin(psi) * y
    return np.stack([x * cos(ANGLE) - y * sin(ANGLE), x * sin(ANGLE) + y * cos(ANGLE), t], axis=1)


@pytest.fixture(scope="module")
def sound():
    return cone_mesh()


def test_faces_lie_on_the_planes_that_contacts_take(sound):
    walls = pocket_walls(CONE)
    for pocket in (0, 3, 9):
        for face, middle, normal in zip(FACES, walls.middle, walls.normal):
            triangles = sound.groups[f"pocket{pocket}_{face}"]
            local = pocket_places(sound.points[triangles.ravel()], pocket)
            assert np.abs((local - middle) @ normal).max() < 1e-10
            a, b, c = local.reshape(-1, 3, 3).transpose(1, 0, 2)
            area = 0.5 * np.cross(b - a, c - a)
            assert (area @ normal < 0.0).all()  # outward of the cage: into the pocket
            if face in ("side+x", "side-x"):
                flat = (
                    2.0
                    * (walls.reach[FACES.index(face)] - 0.3 * MM / cos(radians(28.0)))
                    * 0.9
                    * MM
                )
                assert np.linalg.norm(area, axis=1).sum() == pytest.approx(flat, rel=0.05)


def test_rims_and_cones_lie_where_they_belong(sound):
    x, r = sound.points[:, 0], np.hypot(sound.points[:, 1], sound.points[:, 2])
    along = x * cos(ANGLE) - (r - 12.5 * MM) * sin(ANGLE)
    across = x * sin(ANGLE) + (r - 12.5 * MM) * cos(ANGLE)
    for name, value, place in (
        ("end+x", along, 6.25 * MM), ("end-x", along, -6.65 * MM),
        ("land_inner", across, 1.2 * MM), ("land_outer", across, 2.1 * MM),
    ):  # fmt: skip
        assert np.abs(value[np.unique(sound.groups[name])] - place).max() < 1e-10
    assert 2.0 * r.min() == pytest.approx(CONE.bore, rel=1e-9)
    assert 2.0 * r.max() == pytest.approx(CONE.outside_diameter, rel=1e-9)
    assert np.ptp(x) == pytest.approx(CONE.width, rel=1e-9)
    check_mesh(sound)


@pytest.mark.parametrize("flank", [0.0, 28.0])
@pytest.mark.parametrize(("fineness", "within"), [("coarse", 4e-3), ("fine", 3e-4)])
def test_the_mesh_weighs_what_the_dimensions_say(flank, fineness, within):
    cage = replace(CONE, flank_angle=radians(flank))
    model, said = (
        assemble(cone_mesh(cage=cage, fineness=fineness), cage.material, order=1),
        mass_of(cage, COUNT),
    )
    assert model.mass == pytest.approx(said.mass, rel=within)
    assert model.centre == pytest.approx([said.centre, 0.0, 0.0], abs=5e-3 * MM)
    inertia = np.diag(model.inertia)
    assert inertia == pytest.approx(
        [said.axial, said.transverse, said.transverse], rel=2.0 * within
    )


@pytest.mark.parametrize("shape", ["bent", "shifted"])
@pytest.mark.parametrize("delta", [0.2 * MM, -0.4 * MM])
def test_a_cone_s_crossbeam_narrows_one_pocket_and_widens_the_other(shape, delta):
    mesh = cone_mesh(
        CrossbeamDefect(crossbeam=4, displacement=delta, shape=shape), fineness="medium"
    )
    widths = [pocket_size(mesh, k, pitch_radius=12.5 * MM, cage=CONE)[0] for k in range(COUNT)]
    wanted = np.full(COUNT, 5.525 * MM)
    wanted[[3, 4]] += [-delta, delta]
    within = 1e-9 if shape == "shifted" else 0.01 * abs(delta)
    assert widths == pytest.approx(wanted, abs=within)
    assert mesh.info["defects"][0]["delivered"] == pytest.approx(delta, abs=within)
    assert abs(mesh.info["volume_change"]) < 1e-3
    assert mesh.info["altered_sectors"] == (3, 4)
    check_mesh(mesh)


@pytest.mark.parametrize(("side", "delta"), [("+x", 0.3 * MM), ("-x", 0.3 * MM), ("-x", -0.2 * MM)])
def test_a_rim_of_a_cone_lengthens_its_pocket_only(side, delta):
    mesh = cone_mesh(SideBeamDefect(pocket=5, side=side, displacement=delta))
    lengths = [pocket_size(mesh, k, pitch_radius=12.5 * MM, cage=CONE)[1] for k in range(COUNT)]
    wanted = np.full(COUNT, 9.3 * MM)
    wanted[5] += delta
    assert lengths == pytest.approx(wanted, abs=1e-9)
    assert abs(mesh.info["volume_change"]) < 1e-4
    check_mesh(mesh)


DEFECTS = (
    CrossbeamDefect(crossbeam=4, displacement=0.3 * MM),
    CrossbeamDefect(crossbeam=8, displacement=-0.2 * MM, shape="shifted"),
    SideBeamDefect(pocket=1, side="-x", displacement=0.2 * MM),
)


def test_offsets_at_stations_are_those_of_the_mesh(sound):
    """How far the faces moved along their normals, as contacts take it and as the mesh has it."""
    said = rigid_interface_of(CONE, pocket_count=COUNT, defects=DEFECTS)
    model = assemble(sound, CONE.material, order=1)
    moved = station_weights(model, said.stations, COUNT) @ (
        cone_mesh(*DEFECTS).points - sound.points
    )
    moved = moved.reshape(COUNT, 4, -1, 3)
    for pocket in range(COUNT):
        normals = pocket_walls(CONE).normal @ CONE.pocket_frame(pocket, COUNT)
        found = np.einsum("fsa,fa->fs", moved[pocket], normals)
        wanted = [
            np.interp(at, points, offset)
            for at, points, offset in zip(said.stations, said.offset_at, said.offset[pocket])
        ]
        np.testing.assert_allclose(found, wanted, atol=0.02 * MM)  # hats are wide, the mesh coarse
    assert np.abs(said.offset).max() > 0.2 * MM


def test_a_broken_bar_of_a_cone_is_in_two_parts(sound):
    broken = BrokenCrossbeam(crossbeam=6)
    mesh = cone_mesh(broken)
    check_mesh(mesh)
    assert mesh.volume == pytest.approx(sound.volume, rel=1e-12)
    assert mesh.info["defects"][0]["delivered"] == pytest.approx(0.9 * MM, rel=1e-6)
    model = assemble(mesh, CONE.material, order=1)
    x, r = model.points[:, 0], np.hypot(model.points[:, 1], model.points[:, 2])
    along = x * cos(ANGLE) - (r - 12.5 * MM) * sin(ANGLE)
    corners = model.surface[(np.abs(along[model.surface]) < 1e-9).all(axis=1)]
    sides = model.points[corners[:, 1:]] - model.points[corners[:, :1]]
    area = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum()
    width = CONE.bar_width(0.0, CONE.bar_height, COUNT)
    assert area == pytest.approx(2.0 * width * 0.9 * MM, rel=0.02)
    ((line, seen),) = broken.lines(mesh.points, COUNT)
    assert np.hypot(*seen[1:]) == pytest.approx(r[np.unique(corners)].max(), rel=1e-3)
    widest = CONE.bar_width(0.0, CONE.face_heights(0.0)[1], COUNT)
    assert np.linalg.norm(line[-1] - line[0]) == pytest.approx(widest, rel=0.03)
    assert not BrokenCrossbeam(crossbeam=2).lines(sound.points, COUNT)


def test_a_cone_with_too_much_in_it_is_refused():
    with pytest.raises(InputError, match="invert"):
        cone_mesh(CrossbeamDefect(crossbeam=4, displacement=2.7 * MM, shape="shifted"))
