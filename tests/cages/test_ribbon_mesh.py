"""Meshes of ribbon cages against their geometry."""

from dataclasses import replace
from functools import cache
from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import qmc

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.ribbon.cage import HEAD_HEIGHT
from flexcage.cages.ribbon.defects import MissingRivet
from flexcage.case.presets import load_preset
from flexcage.mesh.measure import in_pocket_frame
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.quality import check_mesh, report_mesh

CAGE, Z, PITCH, MM = load_preset("15x37x10").cage, 7, 26e-3, 1e-3
CLOSED = replace(CAGE, width=8.0 * MM, pocket_diameter=7.2 * MM)


@cache
def mesh_of(cage, fineness="coarse", defects=()):
    return build_cage_mesh(
        cage, pocket_count=Z, pitch_diameter=PITCH, defects=defects,
        options=MeshOptions(fineness=fineness),
    )  # fmt: skip


def inside(cage, points):
    """Whether points (n, 3) lie in the cage, by its surfaces one by one."""
    x, radius = np.abs(points[:, 0]), np.hypot(points[:, 1], points[:, 2])
    step = 2.0 * np.pi / Z
    azimuth = np.arctan2(points[:, 2], points[:, 1])
    from_pocket = (azimuth + 0.5 * step) % step - 0.5 * step
    y, t = radius * np.cos(from_pocket) - 0.5 * PITCH, radius * np.sin(from_pocket)
    rho = np.hypot(y, t)
    ball, thick = 0.5 * cage.pocket_diameter, cage.thickness
    reach, (xb, rb) = np.hypot(x, rho), cage.bend_centre
    shell = (reach < ball + thick) & (x < cage.reach)
    under_bend = (x < xb) & (rho < rb) & (x * rb < rho * xb)
    under_bend &= np.hypot(x - xb, rho - rb) > cage.bend
    away = 0.5 * step - np.abs(from_pocket)
    middle = np.hypot(radius * np.cos(away) - 0.5 * PITCH, radius * np.sin(away))
    head = (middle < cage.head_radius) & (x < thick + HEAD_HEIGHT * cage.rivet_diameter)
    sheet = (reach > ball) & (shell | (x < thick) | under_bend)
    on_ring = (radius > 0.5 * cage.bore) & (radius < 0.5 * cage.outside_diameter)
    return on_ring & (sheet | head)


@pytest.mark.parametrize("cage", [CAGE, CLOSED], ids=["open", "closed"])
def test_volume_and_inertia(cage):
    """Those of a cloud of points in one sector: straight faces cut spheres off by 0.7 %."""
    mesh = mesh_of(cage, "fine")
    low, high = np.array([-5.0, 10.0, -7.0]) * MM, np.array([5.0, 15.0, 7.0]) * MM
    points = low + (high - low) * qmc.Sobol(3, seed=1).random_base2(20)
    here = np.abs(np.arctan2(points[:, 2], points[:, 1])) < np.pi / Z
    points = points[here & inside(cage, points)]
    each = Z * np.prod(high - low) / 2**20
    assert mesh.volume == pytest.approx(each * len(points), rel=8e-3)
    spin = (points[:, 1:] ** 2).sum() * each
    report = report_mesh(mesh, density=1.0)
    assert report.inertia[0, 0] == pytest.approx(spin, rel=8e-3)
    tumble = (2.0 * points[:, 0] ** 2 + (points[:, 1:] ** 2).sum(axis=1)).sum() * 0.5 * each
    assert report.inertia[1, 1] == pytest.approx(tumble, rel=8e-3)
    assert report.inertia[2, 2] == pytest.approx(report.inertia[1, 1], rel=1e-9)


@pytest.mark.parametrize("cage", [CAGE, CLOSED], ids=["open", "closed"])
def test_groups_lie_on_their_surfaces(cage):
    mesh = mesh_of(cage)
    check_mesh(mesh)
    for k in (0, 3):
        wall = mesh.points[np.unique(mesh.groups[f"pocket{k}_wall"])]
        at = in_pocket_frame(wall, k, Z) - (0.0, 0.5 * PITCH, 0.0)
        np.testing.assert_allclose(
            np.linalg.norm(at, axis=1), 0.5 * cage.pocket_diameter, rtol=1e-7
        )
        sides = 0.5 * min(cage.width, cage.pocket_diameter)
        assert np.abs(at[:, 0]).max() == pytest.approx(sides, rel=0.02)
    for name, size in (("land_inner", cage.bore), ("land_outer", cage.outside_diameter)):
        on = mesh.points[np.unique(mesh.groups[name])]
        np.testing.assert_allclose(np.hypot(on[:, 1], on[:, 2]), 0.5 * size, rtol=1e-8)
    assert np.abs(mesh.points[:, 0]).max() == pytest.approx(cage.reach, rel=1e-9)


def held_together(mesh):
    """Vertices that cells of both halves share."""
    above = mesh.points[mesh.tets].mean(axis=1)[:, 0] > 0.0
    return np.intersect1d(mesh.tets[above], mesh.tets[~above])


def test_halves_hold_together_under_rivet_heads_alone():
    mesh = mesh_of(CAGE)
    both = mesh.points[held_together(mesh)]
    assert (both[:, 0] == 0.0).all()
    middles = [
        0.5 * PITCH * np.array([np.cos(a), np.sin(a)]) for a in (np.arange(Z) + 0.5) * 2 * np.pi / Z
    ]
    away = np.linalg.norm(both[:, None, 1:] - np.array(middles), axis=2)
    assert away.min(axis=1).max() == pytest.approx(CAGE.head_radius, rel=1e-6)
    assert (np.bincount(away.argmin(axis=1), minlength=Z) > 5).all()


def test_a_missing_rivet_lets_go_at_its_web_alone():
    sound, mesh = mesh_of(CAGE), mesh_of(CAGE, defects=(MissingRivet(web=3),))
    check_mesh(mesh)
    before, after = len(held_together(sound)), len(held_together(mesh))
    assert after == before - before // Z
    both = mesh.points[held_together(mesh)]
    azimuth = np.degrees(np.arctan2(both[:, 2], both[:, 1])) % 360.0
    assert np.abs(azimuth - 2.5 * 360.0 / Z).min() > 20.0
    (row,) = mesh.info["defects"]
    assert row["delivered"] == pytest.approx(row["asked"], rel=1e-6)
    assert row["asked"] == pytest.approx(2.1 * MM)
    assert abs(row["volume_change"]) < 1e-4
    assert set(mesh.info["altered_sectors"]) == {2, 3}


def test_a_mesh_file_of_ones_own(tmp_path):
    """Read back with the defect that it contains, and refused where the case says otherwise."""
    from flexcage.core.errors import InputError
    from flexcage.mesh.io import write_mesh

    defects = (MissingRivet(web=3),)
    path = tmp_path / "cage.msh"
    write_mesh(mesh_of(CAGE, defects=defects), path)
    options = MeshOptions(file=str(path))
    shape = {"pocket_count": Z, "pitch_diameter": PITCH, "options": options}
    again = build_cage_mesh(CAGE, defects=defects, **shape)
    assert again.info["defects"][0]["delivered"] == pytest.approx(2.1 * MM, rel=1e-3)
    with pytest.raises(InputError, match="web 3 is held together over 0.000 mm.*says 2.100 mm"):
        build_cage_mesh(CAGE, defects=(), **shape)
    with pytest.raises(InputError, match="The cage is wide 6.500 mm, but the case says 6.700 mm"):
        build_cage_mesh(replace(CAGE, width=6.7 * MM), defects=defects, **shape)
    with pytest.raises(InputError, match="pocket . is long 6.900 mm, but the case says 7.000 mm"):
        build_cage_mesh(replace(CAGE, pocket_diameter=7.0 * MM), defects=defects, **shape)


def closed_cage(thickness, *, ball, bore, outside, rivet, bend=None):
    """A cage closed over its balls, from dimensions in mm."""
    pocket = 1.0523 * ball * MM
    return replace(
        CAGE, bore=bore * MM, outside_diameter=outside * MM, width=pocket, pocket_diameter=pocket,
        thickness=thickness * MM, rivet_diameter=rivet * MM, bend_radius=bend and bend * MM,
    )  # fmt: skip


@pytest.mark.parametrize("factor", np.linspace(0.8, 1.6, 17).round(2))
def test_closed_cages_of_any_thickness_mesh(factor):
    """The sheet ends on the axis through the ball, whatever rounding makes of its radius."""
    cage = closed_cage(1.716 * factor, ball=14.434, bore=83.7329, outside=98.1669, rivet=2.836)
    mesh = build_cage_mesh(
        cage, pocket_count=10, pitch_diameter=90.9499 * MM, defects=(),
        options=MeshOptions(fineness="coarse"),
    )  # fmt: skip
    check_mesh(mesh)
    assert len(mesh.groups["pocket9_wall"]) > 50
    assert np.abs(mesh.points[:, 0]).max() == pytest.approx(cage.reach, rel=1e-6)


def test_closed_cages_of_any_dimensions_mesh():
    """Random ones that geometry allows, each with its mesh checked."""
    meshed = 0
    for share in qmc.LatinHypercube(6, seed=5).random(36):
        ball, count = 4.0 + 36.0 * share[0], int(6 + 7 * share[1])
        pitch = ball * count / np.pi * (1.3 + 0.5 * share[2])
        half = ball * (0.3 + 0.35 * share[3])
        sheet = ball * (0.05 + 0.09 * share[4])
        cage = closed_cage(
            sheet, ball=ball, bore=pitch - half, outside=pitch + half,
            rivet=ball * (0.1 + 0.1 * share[5]), bend=sheet * (0.3 + share[0]),
        )  # fmt: skip
        around = SimpleNamespace(
            pitch_diameter=pitch * MM, element_count=count, element_diameter=0.0, element="ball"
        )
        if any(cage.impossible(count)) or any(cage.obstructions(around)):
            continue
        mesh = build_cage_mesh(
            cage, pocket_count=count, pitch_diameter=pitch * MM, defects=(),
            options=MeshOptions(fineness="coarse"),
        )  # fmt: skip
        check_mesh(mesh)
        meshed += 1
    assert meshed > 10
