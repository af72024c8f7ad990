"""The built ring against closed forms, and its symmetry."""

from __future__ import annotations

import pickle
from dataclasses import replace
from math import pi

import numpy as np
import pytest
from scipy.integrate import quad

from flexcage.cages.build import build_cage_mesh
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import group_names
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.quality import check_mesh, report_mesh


def window_integral(cage, height) -> float:
    """Integral over the filleted window of height(t), t the tangential coordinate."""
    rf, half = cage.fillet_radius, 0.5 * cage.pocket_width
    straight = half - rf

    def length(t):
        drop = rf - np.sqrt(max(rf**2 - max(t - straight, 0.0) ** 2, 0.0))
        return cage.pocket_length - 2.0 * drop

    inside = quad(lambda t: length(t) * height(t), 0.0, straight)[0]
    return 2.0 * (inside + quad(lambda t: length(t) * height(t), straight, half)[0])


def wall_height(cage, t):
    outer, inner = 0.5 * cage.outside_diameter, 0.5 * cage.bore
    return np.sqrt(outer**2 - t**2) - np.sqrt(inner**2 - t**2)


def exact_volume(cage, pockets) -> float:
    outer, inner = 0.5 * cage.outside_diameter, 0.5 * cage.bore
    ring = pi * (outer**2 - inner**2) * cage.width
    return ring - pockets * window_integral(cage, lambda t: wall_height(cage, t))


def exact_areas(cage, pockets) -> dict[str, float]:
    outer, inner = 0.5 * cage.outside_diameter, 0.5 * cage.bore
    rf, half = cage.fillet_radius, 0.5 * cage.pocket_width
    straight = half - rf
    beam = (cage.pocket_length - 2.0 * rf) * wall_height(cage, half)
    side = 2.0 * quad(lambda t: wall_height(cage, t), 0.0, straight)[0]
    arc = quad(lambda a: rf * wall_height(cage, straight + rf * np.sin(a)), 0.0, 0.5 * pi)[0]

    def land(r):
        hole = window_integral(cage, lambda t: r / np.sqrt(r**2 - t**2))
        return 2.0 * pi * r * cage.width - pockets * hole

    areas = {"land_inner": land(inner), "land_outer": land(outer)}
    areas |= dict.fromkeys(("end+x", "end-x"), pi * (outer**2 - inner**2))
    for k in range(pockets):
        areas |= {f"pocket{k}_front": beam, f"pocket{k}_rear": beam, f"pocket{k}_fillet": 4.0 * arc}
        areas |= {f"pocket{k}_side+x": side, f"pocket{k}_side-x": side}
    return areas


def area_vectors(mesh, name) -> np.ndarray:
    a, b, c = (mesh.points[mesh.groups[name][:, i]] for i in range(3))
    return 0.5 * np.cross(b - a, c - a)


@pytest.mark.parametrize(
    ("fineness", "tolerance"),
    [("coarse", 2e-3), ("medium", 1e-3), ("fine", 4e-4), ("paper", 3.5e-4)],
)
def test_volume_is_that_of_the_annulus_less_its_pockets(n1013, fineness, tolerance):
    mesh = n1013(fineness=fineness)
    assert mesh.volume == pytest.approx(exact_volume(n1013.cage, 22), rel=tolerance)


def test_volume_error_falls_with_the_square_of_the_size(n1013):
    exact = exact_volume(n1013.cage, 22)
    errors = [
        abs(n1013(size=h, fillet_size=0.1963495e-3 * h / 1e-3).volume - exact)
        for h in (2.8e-3, 0.7e-3)
    ]
    assert np.log(errors[0] / errors[1]) / np.log(4.0) > 1.5


@pytest.mark.parametrize(
    ("fineness", "nodes"), [("coarse", 12_000), ("medium", 36_000), ("fine", 88_000)]
)
def test_named_fineness_has_the_nodes_it_promises(n1013, fineness, nodes):
    assert report_mesh(n1013(fineness=fineness)).quadratic_nodes == pytest.approx(nodes, rel=0.06)


def test_paper_mesh_has_the_density_of_the_paper(n1013):
    mesh = n1013(fineness="paper")
    assert len(mesh.points) == pytest.approx(87_014, rel=0.02)
    assert len(mesh.tets) == pytest.approx(377_400, rel=0.02)


@pytest.mark.parametrize(("fineness", "tolerance"), [("coarse", 0.11), ("paper", 0.012)])
def test_every_group_is_there_with_its_area(n1013, fineness, tolerance):
    mesh = n1013(fineness=fineness)
    exact = exact_areas(n1013.cage, 22)
    assert set(mesh.groups) == set(exact) == set(group_names(22))
    for name, area in exact.items():
        found = np.linalg.norm(area_vectors(mesh, name), axis=1).sum()
        assert found == pytest.approx(area, rel=tolerance), name


def test_groups_close_the_surface_with_outward_normals(n1013):
    """Gauss: the area vectors add to zero and the flux of x/3 is the volume, once each."""
    mesh = n1013(fineness="coarse")
    vectors = np.vstack([area_vectors(mesh, name) for name in mesh.groups])
    triangles = np.vstack(list(mesh.groups.values()))
    centres = mesh.points[triangles].mean(axis=1)
    assert np.abs(vectors.sum(axis=0)).max() < 1e-15
    assert np.einsum("ij,ij->", vectors, centres) / 3.0 == pytest.approx(mesh.volume, rel=1e-12)
    assert len(np.unique(np.sort(triangles, axis=1), axis=0)) == len(triangles)


def test_normals_of_a_pocket_point_into_it(n1013):
    """Front is ahead (+psi), so its outward normal looks back along -e_psi; pocket 3 of 22."""
    mesh, angle = n1013(fineness="coarse"), 2.0 * pi * 3 / 22
    tangent = np.array([0.0, -np.sin(angle), np.cos(angle)])
    axis = np.array([1.0, 0.0, 0.0])
    normals = {"front": -tangent, "rear": tangent, "side+x": -axis, "side-x": axis}
    for name, normal in normals.items():
        vectors = area_vectors(mesh, f"pocket3_{name}")
        units = vectors / np.linalg.norm(vectors, axis=1)[:, None]
        assert np.abs(units - normal).max() < 1e-9
    centre = mesh.points[np.unique(mesh.groups["pocket3_front"])].mean(axis=0)
    assert centre @ tangent == pytest.approx(4.1e-3, rel=1e-9)


def test_sectors_repeat_exactly(n1013):
    mesh = n1013(fineness="coarse")
    n, cells, z = mesh.info["sector_points"], mesh.info["sector_cells"], 22
    assert (n * z, cells * z) == (len(mesh.points), len(mesh.tets))
    for k in (1, 13, 21):
        angle = 2.0 * pi * k / z
        y, t = mesh.points[:n, 1], mesh.points[:n, 2]
        turned = np.column_stack(
            [mesh.points[:n, 0], y * np.cos(angle) - t * np.sin(angle),
             y * np.sin(angle) + t * np.cos(angle)]
        )  # fmt: skip
        assert np.abs(mesh.points[k * n : (k + 1) * n] - turned).max() < 1e-16
        expected = (mesh.tets[:cells] + k * n) % len(mesh.points)
        assert (mesh.tets[k * cells : (k + 1) * cells] == expected).all()
        front = (mesh.groups["pocket0_front"] + k * n) % len(mesh.points)
        assert (mesh.groups[f"pocket{k}_front"] == front).all()


@pytest.mark.parametrize("mirror", [(-1, 1, 1), (1, 1, -1)])
def test_mesh_is_its_own_mirror_image(n1013, mirror):
    mesh = n1013(fineness="coarse")
    rounded = {tuple(p) for p in np.round(mesh.points * 1e9).astype(int)}
    image = {tuple(p) for p in np.round(mesh.points * mirror * 1e9).astype(int)}
    assert len(rounded - image) < 0.01 * len(rounded)  # rounding may tip a few


def test_no_vertex_is_double_and_the_mesh_holds_together(n1013):
    from scipy.spatial import cKDTree

    mesh = n1013(fineness="medium")
    assert not cKDTree(mesh.points).query_pairs(1e-7)
    check_mesh(mesh)


def test_mass_properties(n1013):
    """The mass centre is the origin; inertia is the exact body's to the mesh's volume error."""
    cage = n1013.cage
    report = report_mesh(n1013(fineness="paper"), density=8500.0)
    outer, inner = 0.5 * cage.outside_diameter, 0.5 * cage.bore

    def pocket_polar(t):  # integral of r^2 over the height y
        top, bottom = np.sqrt(outer**2 - t**2), np.sqrt(inner**2 - t**2)
        return (top**3 - bottom**3) / 3.0 + t**2 * (top - bottom)

    polar = 0.5 * pi * (outer**4 - inner**4) * cage.width - 22 * window_integral(cage, pocket_polar)
    assert np.abs(report.mass_centre).max() < 1e-12
    assert report.inertia[0, 0] == pytest.approx(8500.0 * polar, rel=5e-4)
    assert report.inertia[1, 1] == pytest.approx(report.inertia[2, 2], rel=1e-10)
    assert abs(report.inertia[1, 2]) < 1e-10 * polar * 8500.0
    assert "vertices" in str(report)


def test_any_other_cage_is_meshed_too():
    from flexcage.cages.window.cage import WindowCage

    cage = WindowCage(
        bore=0.2, outside_diameter=0.23, width=0.06, pocket_width=0.02, pocket_length=0.04,
        fillet_radius=1e-3,
    )  # fmt: skip
    mesh = build_cage_mesh(
        cage, pocket_count=17, pitch_diameter=0.215, options=MeshOptions(fineness="medium")
    )
    check_mesh(mesh)
    assert mesh.volume == pytest.approx(exact_volume(cage, 17), rel=3e-3)
    assert 15_000 < report_mesh(mesh).quadratic_nodes < 60_000


@pytest.mark.parametrize(
    ("change", "where"),
    [
        ({"pocket_length": 16e-3}, "pocket_length"),
        ({"pocket_width": 11.4e-3}, "pocket_width"),
        ({"bore": 90e-3}, "outside_diameter"),
        ({"fillet_radius": 4.2e-3}, "fillet_radius"),
    ],
)
def test_impossible_cages_are_refused_in_a_sentence(n1013, change, where):
    with pytest.raises(InputError) as caught:
        build_cage_mesh(replace(n1013.cage, **change), pocket_count=22, pitch_diameter=82.5e-3)
    assert caught.value.where == f"cage.{where}"


def test_a_mesh_travels_by_pickle(n1013):
    mesh = n1013(fineness="coarse")
    copy = pickle.loads(pickle.dumps(mesh))
    assert (copy.points == mesh.points).all() and copy.info == mesh.info
    with pytest.raises(TypeError):
        copy.groups["new"] = copy.tets
