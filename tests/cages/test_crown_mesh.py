"""Meshes of crown cages against their geometry, and stations on their walls."""

from dataclasses import replace

import numpy as np
import pytest
from crown_cage import CAGE, MM, PITCH, Z, mesh_of
from scipy.stats import qmc

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.crown.interface import station_weights
from flexcage.core.errors import InputError
from flexcage.mesh.io import write_mesh
from flexcage.mesh.measure import in_pocket_frame
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.quality import check_mesh, report_mesh

BARS = replace(CAGE, bar_height=0.4 * MM, root_radius=0.2 * MM, claw_thickness=0.8 * MM)


def inside(cage, points):
    """Whether points (n, 3) lie in the cage, by its surfaces one by one."""
    x, radius = points[:, 0], np.hypot(points[:, 1], points[:, 2])
    step = 2.0 * np.pi / Z
    azimuth = np.arctan2(points[:, 2], points[:, 1])
    from_pocket = (azimuth + 0.5 * step) % step - 0.5 * step
    y, t = radius * np.cos(from_pocket) - 0.5 * PITCH, radius * np.sin(from_pocket)
    rho = np.hypot(y, t)
    reach, (xr, rr) = np.hypot(x, rho), cage.root_centre
    ball = 0.5 * cage.pocket_diameter
    body = (x > cage.back) & (x < cage.bar_height)
    claw = (x >= cage.bar_height) & (x < cage.tip) & (reach < ball + cage.claw_thickness)
    in_root = (x >= cage.bar_height) & (x < xr) & (rho < rr) & (x * rr < rho * xr)
    in_root &= np.hypot(x - xr, rho - rr) > cage.root
    on_ring = (radius > 0.5 * cage.bore) & (radius < 0.5 * cage.outside_diameter)
    return on_ring & (reach > ball) & (body | claw | in_root)


@pytest.mark.parametrize("cage", [CAGE, BARS], ids=["plain", "bars"])
def test_volume_centre_and_inertia(cage):
    """Those of a cloud of points in one sector: straight faces cut spheres off by 0.7 %."""
    mesh = mesh_of(cage, "fine")
    low, high = np.array([-6.5, 15.5, -7.5]) * MM, np.array([2.5, 21.5, 7.5]) * MM
    points = low + (high - low) * qmc.Sobol(3, seed=1).random_base2(20)
    here = np.abs(np.arctan2(points[:, 2], points[:, 1])) < np.pi / Z
    points = points[here & inside(cage, points)]
    each = Z * np.prod(high - low) / 2**20
    assert mesh.volume == pytest.approx(each * len(points), rel=8e-3)
    report = report_mesh(mesh, density=1.0)
    middle = points[:, 0].mean()
    np.testing.assert_allclose(report.mass_centre, [middle, 0.0, 0.0], atol=20e-6)
    spin = (points[:, 1:] ** 2).sum() * each
    assert report.inertia[0, 0] == pytest.approx(spin, rel=8e-3)
    off = points[:, 0] - middle
    tumble = (2.0 * off**2 + (points[:, 1:] ** 2).sum(axis=1)).sum() * 0.5 * each
    assert report.inertia[1, 1] == pytest.approx(tumble, rel=8e-3)
    assert report.inertia[2, 2] == pytest.approx(report.inertia[1, 1], rel=1e-9)


@pytest.mark.parametrize("cage", [CAGE, BARS], ids=["plain", "bars"])
def test_groups_lie_on_their_surfaces(cage):
    mesh = mesh_of(cage)
    check_mesh(mesh)
    for k in (0, 5):
        wall = mesh.points[np.unique(mesh.groups[f"pocket{k}_wall"])]
        at = in_pocket_frame(wall, k, Z) - (0.0, 0.5 * PITCH, 0.0)
        ball = 0.5 * cage.pocket_diameter
        np.testing.assert_allclose(np.linalg.norm(at, axis=1), ball, rtol=1e-7)
        assert at[:, 0].max() == pytest.approx(cage.tip) and at[:, 0].min() < -0.99 * ball
        assert np.abs(at[np.abs(at[:, 0] - cage.tip) < 1e-9, 2]).max() < 0.5 * cage.throat
    for name, size in (("land_inner", cage.bore), ("land_outer", cage.outside_diameter)):
        on = mesh.points[np.unique(mesh.groups[name])]
        np.testing.assert_allclose(np.hypot(on[:, 1], on[:, 2]), 0.5 * size, rtol=1e-8)
    for name, x in (("end+x", cage.tip), ("end-x", cage.back)):
        np.testing.assert_allclose(mesh.points[np.unique(mesh.groups[name]), 0], x, rtol=1e-9)


def test_tips_have_their_share_of_a_circle_each():
    """Two a pocket, between the circles in which their plane cuts pocket and claw, within bore and
    outside."""
    mesh = mesh_of(CAGE, "fine")
    corners = mesh.points[mesh.groups["end+x"]]
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    assert (across[:, 0] > 0.0).all()
    area = 0.5 * np.linalg.norm(across, axis=1).sum()
    points = (qmc.Sobol(2, seed=2).random_base2(18) - 0.5) * 14.0 * MM
    y, t = points[:, 0], points[:, 1]
    rho = np.hypot(y, t)
    over = (CAGE.claw_outside**2 - CAGE.tip**2) ** 0.5
    radius = np.hypot(0.5 * PITCH + y, t)
    on = (rho > 0.5 * CAGE.throat) & (rho < over)
    on &= (radius > 0.5 * CAGE.bore) & (radius < 0.5 * CAGE.outside_diameter)
    assert area == pytest.approx(Z * on.mean() * (14.0 * MM) ** 2, rel=0.02)


def test_a_mesh_file_of_ones_own(tmp_path):
    """Read back with its sectors, and refused where the case says otherwise."""
    path = tmp_path / "cage.msh"
    write_mesh(mesh_of(), path)
    shape = {"pocket_count": Z, "pitch_diameter": PITCH, "options": MeshOptions(file=str(path))}
    again = build_cage_mesh(CAGE, defects=(), **shape)
    assert again.volume == pytest.approx(mesh_of().volume, rel=1e-12)
    assert set(again.groups) == set(mesh_of().groups)
    longer = replace(CAGE, width=7.9 * MM)
    with pytest.raises(InputError, match="the ring's back is at x = -5.866 mm, but .* -6.066 mm"):
        build_cage_mesh(longer, defects=(), **shape)
    wider = replace(CAGE, throat=7.4 * MM)
    with pytest.raises(InputError, match="the claws' tips are at x = 1.834 mm, but .* 1.731 mm"):
        build_cage_mesh(wider, defects=(), **shape)
    with pytest.raises(InputError, match="pocket . is long 8.170 mm, but the case says 8.250 mm"):
        build_cage_mesh(replace(CAGE, pocket_diameter=8.25 * MM, throat=7.39 * MM), **shape)


def test_stations_in_the_opening_are_the_tips():
    """Front and rear tip, their mean in the middle; elsewhere the hats of other round pockets."""
    end, count = 0.466, 16  # rad: 26.7 degrees
    front, rear = np.linspace(-0.5 * np.pi, end, 400), np.linspace(np.pi - end, 1.5 * np.pi, 400)
    ahead, behind = (station_weights(a, count, end) for a in (front, rear))
    np.testing.assert_allclose(ahead[:, ::-1], np.roll(behind[::-1], 9, axis=0), atol=1e-9)
    assert (ahead[[2, 3]].argmax(axis=1) == 399).all() and (ahead[[5, 6]] == 0.0).all()
    np.testing.assert_allclose(ahead[4], ahead[3])
    assert ahead[0].max() == pytest.approx(1.0, abs=0.01) and (behind[0] == 0.0).all()
    np.testing.assert_allclose(ahead[3, front < end - 2.0 * np.pi / count], 0.0)
