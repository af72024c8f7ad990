"""Meshes of ball cages: size, groups, quality, symmetry, files, defects as measured."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cache

import numpy as np
import pytest

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.round_pocket.defects import (
    DisplacedPocket,
    ElongatedPocket,
    EnlargedPocket,
    WebCrack,
)
from flexcage.cages.round_pocket.measure import crack_length, measure_pockets
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.mesh.cage_mesh import CageMesh, group_names
from flexcage.mesh.io import read_mesh, write_mesh
from flexcage.mesh.measure import in_pocket_frame
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.quality import check_mesh, report_mesh

MM = 1e-3
POCKETS, PITCH_RADIUS = 8, 11.5 * MM
CAGE = BallCage(bore=20 * MM, outside_diameter=26 * MM, width=12 * MM, pocket_diameter=6 * MM)


@cache
def mesh_of(*defects, fineness: str = "coarse", **options) -> CageMesh:
    return build_cage_mesh(
        CAGE,
        pocket_count=POCKETS,
        pitch_diameter=2.0 * PITCH_RADIUS,
        defects=defects,
        options=MeshOptions(fineness=fineness, **options),
    )


@dataclass(frozen=True)
class Body:
    """Volume and moments of inertia at unit density of a cage without defects."""

    volume: float
    polar: float  # about x
    transverse: float


def exact(cage: BallCage, pockets: int) -> Body:
    """A hollow cylinder less Z radial bores, integrated over a bore's section by Gauss' rule.

    At (x, t) from its axis a bore takes radii from y_i to y_o, y = sqrt(R^2 - t^2).
    """
    inner, outer, width = 0.5 * cage.bore, 0.5 * cage.outside_diameter, cage.width
    volume = np.pi * (outer**2 - inner**2) * width
    polar = 0.5 * np.pi * (outer**4 - inner**4) * width
    transverse = 0.5 * polar + volume * width**2 / 12.0
    nodes, weights = np.polynomial.legendre.leggauss(60)
    radius = 0.25 * cage.pocket_diameter * (nodes + 1.0)
    angle = np.arange(240) * 2.0 * np.pi / 240
    area = 0.25 * cage.pocket_diameter * weights[:, None] * radius[:, None] * 2.0 * np.pi / 240
    x, t = radius[:, None] * np.sin(angle), radius[:, None] * np.cos(angle)
    low, high = np.sqrt(inner**2 - t**2), np.sqrt(outer**2 - t**2)
    height, cube = high - low, (high**3 - low**3) / 3.0
    volume -= pockets * np.sum(area * height)
    polar -= pockets * np.sum(area * (cube + t**2 * height))
    both = np.sum(area * (cube + t**2 * height + 2.0 * x**2 * height))
    return Body(float(volume), float(polar), float(transverse - 0.5 * pockets * both))


def test_mass_properties_come_to_those_of_the_body():
    """Chords of walls and lands miss parts of second order in the elements' size."""
    body, misses = exact(CAGE, POCKETS), []
    for fineness in ("coarse", "fine", "paper"):
        report = report_mesh(mesh_of(fineness=fineness), density=1.0)
        assert report.mass_centre_shift < 1e-12
        found = [report.volume, report.inertia[0, 0], report.inertia[1, 1], report.inertia[2, 2]]
        wanted = [body.volume, body.polar, body.transverse, body.transverse]
        misses.append(np.abs(np.divide(found, wanted) - 1.0).max())
    assert misses[0] < 5e-3 and misses[1] < 2e-3 and misses[2] < 2e-4


@pytest.mark.parametrize("name", ["7010C-PI", "7010C-PA66", "7603025"])
@pytest.mark.parametrize("fineness", ["coarse", "medium", "fine"])
def test_preset_cages_mesh_well(name, fineness):
    preset = load_preset(name)
    count = preset.bearing.ball_count
    mesh = build_cage_mesh(
        preset.cage,
        pocket_count=count,
        pitch_diameter=preset.bearing.pitch_diameter,
        options=MeshOptions(fineness=fineness),
    )
    check_mesh(mesh)
    report = report_mesh(mesh)
    assert report.inverted == 0 and report.min_quality > 0.15
    assert report.volume == pytest.approx(exact(preset.cage, count).volume, rel=0.02)
    assert set(mesh.groups) == set(group_names(count, parts=("wall",)))


def test_groups_are_the_whole_surface_and_where_they_say():
    mesh = mesh_of(fineness="medium")
    area = {}
    total = np.zeros(3)
    for name, triangles in mesh.groups.items():
        a, b, c = (mesh.points[triangles[:, i]] for i in range(3))
        vectors = 0.5 * np.cross(b - a, c - a)
        area[name] = np.linalg.norm(vectors, axis=1).sum()
        total += vectors.sum(axis=0)
    assert np.abs(total).max() < 1e-12 * sum(area.values())  # closed and outward
    assert area["end+x"] == pytest.approx(np.pi * (13**2 - 10**2) * 1e-6, rel=0.02)
    for k in range(POCKETS):
        points = mesh.points[np.unique(mesh.groups[f"pocket{k}_wall"])]
        x, y, t = in_pocket_frame(points, k, POCKETS).T
        assert np.hypot(x, t) == pytest.approx(3.0 * MM, abs=1e-12)
        assert y.min() > 0.0
    for name, radius in (("land_inner", 10.0), ("land_outer", 13.0)):
        points = mesh.points[np.unique(mesh.groups[name])]
        assert np.hypot(points[:, 1], points[:, 2]) == pytest.approx(radius * MM, abs=1e-12)
    assert mesh.points[np.unique(mesh.groups["end-x"]), 0] == pytest.approx(-6 * MM, abs=1e-12)


def test_every_sector_is_the_first_one_turned():
    mesh = mesh_of()
    n = mesh.info["sector_points"]
    first = in_pocket_frame(mesh.points[:n], 0, POCKETS)
    for k in range(POCKETS):
        own = in_pocket_frame(mesh.points[k * n : (k + 1) * n], k, POCKETS)
        assert own == pytest.approx(first, abs=1e-15)


def test_size_sets_the_far_elements():
    fine, coarse = (len(mesh_of(size=s * MM).tets) for s in (0.4, 1.6))
    assert 4.0 < fine / coarse < 64.0


@pytest.mark.parametrize("suffix", [".msh", ".vtu"])
@pytest.mark.parametrize("defect", [None, WebCrack(web=2, share=0.25)])
def test_files_give_the_mesh_back(tmp_path, suffix, defect):
    mesh = mesh_of(*([defect] if defect else []))
    again = read_mesh(write_mesh(mesh, tmp_path / f"cage{suffix}"), pocket_count=POCKETS)
    assert again.points == pytest.approx(mesh.points, abs=1e-15)
    assert (again.tets == mesh.tets).all() and set(again.groups) == set(mesh.groups)
    for name, triangles in mesh.groups.items():
        assert (np.sort(again.groups[name]) == np.sort(triangles)).all()


def test_files_that_lack_something_are_refused(tmp_path):
    mesh = mesh_of()
    without = {n: t for n, t in mesh.groups.items() if n != "pocket3_wall"}
    path = write_mesh(replace(mesh, groups=without), tmp_path / "cage.msh")
    with pytest.raises(InputError, match="no surface group 'pocket3_wall'"):
        read_mesh(path)
    path = write_mesh(mesh, tmp_path / "whole.msh")
    with pytest.raises(InputError, match="names 8 pockets, but the bearing has 9"):
        read_mesh(path, pocket_count=9)
    turned = dict(mesh.groups)
    turned["pocket0_wall"], turned["pocket1_wall"] = turned["pocket1_wall"], turned["pocket0_wall"]
    with pytest.raises(InputError, match="has pocket 0 at azimuth 45.0 deg"):
        check_mesh(replace(mesh, groups=turned))


def test_a_file_must_hold_the_cage_and_its_defects(tmp_path):
    defects = (
        EnlargedPocket(pocket=1, increase=0.2 * MM),
        DisplacedPocket(pocket=4, axial=0.1 * MM),
        WebCrack(web=6, share=0.2),
    )
    path = str(write_mesh(mesh_of(*defects), tmp_path / "cage.msh"))
    found = mesh_of(*defects, file=path).info["defects"]
    assert [d["kind"] for d in found] == ["enlarged", "displaced axial", "crack"]
    for d in found:
        assert d["delivered"] == pytest.approx(d["asked"], abs=1e-8)
    with pytest.raises(InputError, match="pocket 1 is long 6.200 mm, but the case says 6.000 mm"):
        mesh_of(*defects[1:], file=path)


def slot_distance(points, centre, slot):
    """Distance of points (n, 2) in the pocket's plane from a line of half length |slot|."""
    from_middle = points - centre
    along = np.clip(from_middle, -np.asarray(slot), slot)
    return np.linalg.norm(from_middle - along, axis=1)


@pytest.mark.parametrize("fineness", ["coarse", "medium"])
@pytest.mark.parametrize(
    ("defect", "radius", "slot", "shift", "arc"),
    [
        (EnlargedPocket(pocket=3, increase=0.6 * MM), 3.3, (0, 0), 0, 0),
        (EnlargedPocket(pocket=0, increase=-0.2 * MM), 2.9, (0, 0), 0, 0),
        (ElongatedPocket(pocket=3, direction="axial", elongation=0.8 * MM), 3.0, (0.4, 0), 0, 0),
        (
            ElongatedPocket(pocket=3, direction="circumferential", elongation=0.8 * MM),
            3.0, (0, 0.4), 0, 0,
        ),
        (DisplacedPocket(pocket=3, axial=-0.5 * MM), 3.0, (0, 0), -0.5, 0),
        (DisplacedPocket(pocket=7, axial=0.3 * MM, circumferential=0.6 * MM),
         3.0, (0, 0), 0.3, 0.6),
    ],
)  # fmt: skip
def test_walls_are_where_the_defect_says(defect, radius, slot, shift, arc, fineness):
    mesh, sound = mesh_of(defect, fineness=fineness), mesh_of(fineness=fineness)
    check_mesh(mesh)
    assert report_mesh(mesh).min_quality > 0.08
    k = defect.pocket
    turned = k + arc * MM / PITCH_RADIUS * POCKETS / (2.0 * np.pi)
    wall = in_pocket_frame(mesh.points[np.unique(mesh.groups[f"pocket{k}_wall"])], turned, POCKETS)[
        :, [0, 2]
    ]
    distance = slot_distance(wall, (shift * MM, 0.0), np.multiply(slot, MM))
    assert distance == pytest.approx(radius * MM, abs=1e-12)
    fit = measure_pockets(mesh, [k], pitch_radius=PITCH_RADIUS)
    assert fit.radius[0] == pytest.approx(radius * MM, abs=1e-8)
    assert fit.slot[0] == pytest.approx(np.multiply(slot, MM), abs=1e-8)
    assert fit.centre[0] == pytest.approx(np.multiply((shift, arc), MM), abs=1e-8)
    for row in mesh.info["defects"]:
        assert row["delivered"] == pytest.approx(row["asked"], abs=1e-8)
    moved = np.hypot(*mesh.points[:, 1:].T) - np.hypot(*sound.points[:, 1:].T)
    assert np.abs(moved).max() < 1e-15  # all keep their distance from the axis
    others = [n for n in mesh.groups if n.startswith("pocket") and n != f"pocket{k}_wall"]
    far = np.unique(np.concatenate([mesh.groups[n].ravel() for n in others]))
    assert (mesh.points[far] == sound.points[far]).all()
    assert set(mesh.info["altered_sectors"]) == {(k - 1) % 8, k, (k + 1) % 8}


def test_a_pocket_with_more_diameter_loses_that_volume():
    defect = EnlargedPocket(pocket=3, increase=0.6 * MM)
    mesh = mesh_of(defect, fineness="fine")
    larger = replace(CAGE, pocket_diameter=6.6 * MM)
    lost = (exact(larger, POCKETS).volume - exact(CAGE, POCKETS).volume) / POCKETS
    change = mesh.info["defects"][0]["volume_change"] * mesh_of(fineness="fine").volume
    assert change == pytest.approx(lost, rel=0.02)
    assert mesh.info["volume_change"] == pytest.approx(mesh.info["defects"][0]["volume_change"])


@pytest.mark.parametrize("fineness", ["coarse", "medium"])
@pytest.mark.parametrize(("web", "side", "share"), [(0, "+x", 0.2), (5, "-x", 0.5), (3, "+x", 0.7)])
def test_a_crack_parts_the_web_and_nothing_else(web, side, share, fineness):
    crack = WebCrack(web=web, side=side, share=share)
    mesh = mesh_of(crack, fineness=fineness)
    check_mesh(mesh)
    sign = 1.0 if side == "+x" else -1.0
    assert crack_length(mesh, web, side) == pytest.approx(share * 12 * MM, abs=1e-12)
    assert crack_length(mesh, (web + 1) % POCKETS, side) == 0.0
    faces = np.sort(mesh.tets[:, [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]]].reshape(-1, 3))
    faces, times = np.unique(faces, axis=0, return_counts=True)
    named = {tuple(t) for t in np.sort(np.vstack(list(mesh.groups.values())))}
    free = np.array([f for f in faces[times == 1] if tuple(f) not in named])
    corners = in_pocket_frame(mesh.points, web - 0.5, POCKETS)[free]
    assert np.abs(corners[..., 2]).max() < 1e-12  # in the plane between the pockets
    assert (sign * corners[..., 0]).min() == pytest.approx((6 - 12 * share) * MM, abs=1e-12)
    sides = corners[:, 1:] - corners[:, :1]
    area = 0.5 * np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1).sum()
    assert area == pytest.approx(2.0 * share * 12 * 3 * MM**2, rel=1e-9)  # both faces
    assert mesh.volume == pytest.approx(mesh_of(fineness=fineness).volume, rel=2e-3)
    assert mesh.info["defects"][0]["delivered"] == pytest.approx(share * 12 * MM, abs=1e-12)


def test_defects_of_all_kinds_together():
    defects = (
        WebCrack(web=4, share=0.3),
        EnlargedPocket(pocket=4, increase=0.3 * MM),
        ElongatedPocket(pocket=4, direction="axial", elongation=0.4 * MM),
        EnlargedPocket(pocket=5, increase=0.2 * MM),
        DisplacedPocket(pocket=4, axial=0.1 * MM, circumferential=-0.1 * MM),
        WebCrack(web=6, side="-x", share=0.45),
    )
    mesh = mesh_of(*defects)
    check_mesh(mesh)
    for row in mesh.info["defects"][1:5]:
        assert row["delivered"] == pytest.approx(row["asked"], abs=1e-8)
    crack = mesh.info["defects"][-1]  # its tip is drawn along a little by the pocket beside it
    assert crack["delivered"] == pytest.approx(crack["asked"], abs=2e-5)
    assert mesh.info["defects"][0]["delivered"] == pytest.approx(3.6 * MM, abs=1e-12)
    fit = measure_pockets(mesh, [4, 5], pitch_radius=PITCH_RADIUS)
    assert fit.radius == pytest.approx([3.15 * MM, 3.1 * MM], abs=1e-8)
    assert "defect displaced axial" in str(report_mesh(mesh))


def test_a_defect_that_crushes_the_mesh_is_refused():
    """A web of a thousandth of a millimetre is left by the check, but not by the elements."""
    with pytest.raises(InputError, match="invert .* elements"):
        mesh_of(
            DisplacedPocket(pocket=2, circumferential=1.45 * MM),
            ElongatedPocket(pocket=2, direction="axial", elongation=5.5 * MM),
        )


def test_a_cage_of_no_known_type_is_refused():
    with pytest.raises(
        InputError,
        match="A str is no cage of a known type",
    ):
        build_cage_mesh("cage", pocket_count=8, pitch_diameter=23 * MM)
    with pytest.raises(InputError, match="leaves no rims"):
        build_cage_mesh(
            replace(CAGE, width=5 * MM), pocket_count=8, pitch_diameter=2.0 * PITCH_RADIUS
        )
    with pytest.raises(InputError, match="numbered 0 to 7"):
        mesh_of(EnlargedPocket(pocket=8, increase=0.1 * MM))
    with pytest.raises(InputError, match="fillet_size is of window cages"):
        mesh_of(fillet_size=0.1 * MM)


SPHERES = replace(CAGE, pocket_shape="spherical", pocket_diameter=7.2 * MM)


def spherical_mesh(*defects, fineness="coarse"):
    return build_cage_mesh(
        SPHERES,
        pocket_count=POCKETS,
        pitch_diameter=2.0 * PITCH_RADIUS,
        defects=defects,
        options=MeshOptions(fineness=fineness),
    )


@pytest.mark.parametrize(
    ("defects", "radius", "shift"),
    [
        ((), 3.6, (0.0, 0.0)),
        ((EnlargedPocket(pocket=3, increase=0.3 * MM),), 3.75, (0.0, 0.0)),
        ((DisplacedPocket(pocket=3, axial=0.3 * MM, circumferential=-0.2 * MM),), 3.6, (0.3, -0.2)),
    ],
)
def test_spherical_pockets_lie_on_their_spheres(defects, radius, shift):
    mesh = spherical_mesh(*defects)
    check_mesh(mesh)
    assert report_mesh(mesh).min_quality > 0.1
    turned = 3 + shift[1] * MM / PITCH_RADIUS * POCKETS / (2.0 * np.pi)
    wall = in_pocket_frame(mesh.points[np.unique(mesh.groups["pocket3_wall"])], turned, POCKETS)
    distance = np.linalg.norm(wall - (shift[0] * MM, PITCH_RADIUS, 0.0), axis=1)
    assert distance == pytest.approx(radius * MM, abs=1e-12)
    for row in mesh.info["defects"]:
        assert row["delivered"] == pytest.approx(row["asked"], abs=1e-8)
    for name, land in (("land_inner", 10 * MM), ("land_outer", 13 * MM)):
        points = mesh.points[np.unique(mesh.groups[name])]
        assert np.hypot(points[:, 1], points[:, 2]) == pytest.approx(land, abs=1e-12)


def test_spherical_pockets_take_their_volume():
    """What two cylinders leave of a sphere, by a cloud of points."""
    mesh = spherical_mesh(fineness="fine")
    rng = np.random.default_rng(0)
    cloud = rng.uniform(-3.6, 3.6, size=(2_000_000, 3)) * MM
    radius = np.hypot(cloud[:, 1] + PITCH_RADIUS, cloud[:, 2])
    inside = (np.linalg.norm(cloud, axis=1) < 3.6 * MM) & (radius > 10 * MM) & (radius < 13 * MM)
    hole = inside.mean() * (7.2 * MM) ** 3
    whole = np.pi * (13**2 - 10**2) * 12 * MM**3
    assert mesh.volume == pytest.approx(whole - POCKETS * hole, rel=8e-3)
    n = mesh.info["sector_points"]
    first, other = (in_pocket_frame(mesh.points[k * n : (k + 1) * n], k, POCKETS) for k in (0, 5))
    assert other == pytest.approx(first, abs=1e-15)


def test_a_sphere_that_does_not_open_is_refused():
    thick = replace(SPHERES, bore=15 * MM, outside_diameter=31 * MM)
    with pytest.raises(InputError, match="does not open at the cage's bore of 15 mm"):
        build_cage_mesh(thick, pocket_count=POCKETS, pitch_diameter=2.0 * PITCH_RADIUS)
