"""Defects on the mesh: what is asked is delivered, and nothing else breaks."""

from __future__ import annotations

import numpy as np
import pytest

from flexcage.cages.window.defects import (
    CrossbeamDefect,
    SideBeamDefect,
    clamped_beam,
    pocket_changes,
)
from flexcage.cages.window.faces import pocket_size
from flexcage.core.errors import InputError
from flexcage.mesh.measure import in_pocket_frame
from flexcage.mesh.quality import check_mesh, report_mesh

MM = 1e-3
SHAPES = ("bent", "shifted")


def size(n1013, mesh, pocket):
    return np.array(pocket_size(mesh, pocket, pitch_radius=n1013.pitch_radius))


def test_an_undamaged_pocket_measures_its_nominal_size(n1013):
    mesh = n1013(fineness="coarse")
    for k in (0, 7, 21):
        assert size(n1013, mesh, k) == pytest.approx([8.2e-3, 8.25e-3], abs=1e-12)


@pytest.mark.parametrize("shape", SHAPES)
@pytest.mark.parametrize("delta", [0.2 * MM, -0.1 * MM, 1.0 * MM, -1.0 * MM])
@pytest.mark.parametrize("crossbeam", [5, 0])
def test_crossbeam_narrows_one_pocket_and_widens_the_other(n1013, crossbeam, delta, shape):
    defect = CrossbeamDefect(crossbeam=crossbeam, displacement=delta, shape=shape)
    mesh = n1013(defect, fineness="medium")
    before, after = (crossbeam - 1) % 22, crossbeam
    assert size(n1013, mesh, before)[0] == pytest.approx(8.2e-3 - delta, abs=1e-9)
    assert size(n1013, mesh, after)[0] == pytest.approx(8.2e-3 + delta, abs=1e-9)
    assert size(n1013, mesh, before)[1] == pytest.approx(8.25e-3, abs=1e-9)
    assert size(n1013, mesh, (crossbeam + 1) % 22) == pytest.approx([8.2e-3, 8.25e-3], abs=1e-12)
    report = mesh.info["defects"][0]
    assert report["asked"] == delta
    assert report["delivered"] == pytest.approx(delta, abs=1e-9)
    assert abs(report["volume_change"]) < 1e-3
    check_mesh(mesh)


@pytest.mark.parametrize("side", ["+x", "-x"])
@pytest.mark.parametrize("delta", [0.3 * MM, -0.3 * MM, 1.0 * MM, -1.0 * MM])
def test_side_beam_lengthens_its_pocket_only(n1013, side, delta):
    mesh = n1013(SideBeamDefect(pocket=5, side=side, displacement=delta), fineness="medium")
    assert size(n1013, mesh, 5) == pytest.approx([8.2e-3, 8.25e-3 + delta], abs=1e-9)
    for other in (4, 6, 16):
        assert size(n1013, mesh, other) == pytest.approx([8.2e-3, 8.25e-3], abs=1e-12)
    assert mesh.info["defects"][0]["delivered"] == pytest.approx(delta, abs=1e-9)
    assert abs(mesh.info["defects"][0]["volume_change"]) < 1e-3
    check_mesh(mesh)


@pytest.mark.parametrize("fineness", ["coarse", "medium", "fine"])
def test_any_number_together_add_up(n1013, fineness):
    defects = (
        CrossbeamDefect(crossbeam=5, displacement=0.2 * MM),
        CrossbeamDefect(crossbeam=6, displacement=-0.15 * MM, shape="shifted"),
        CrossbeamDefect(crossbeam=6, displacement=-0.05 * MM),
        SideBeamDefect(pocket=5, displacement=-0.3 * MM),
        SideBeamDefect(pocket=5, side="-x", displacement=0.1 * MM),
        SideBeamDefect(pocket=21, displacement=1.0 * MM),
    )
    mesh = n1013(*defects, fineness=fineness)
    width, length = pocket_changes(defects, pocket_count=22)
    measured = np.array([size(n1013, mesh, k) for k in range(22)])
    assert measured[:, 0] == pytest.approx(8.2e-3 + width, abs=1e-9)
    assert measured[:, 1] == pytest.approx(8.25e-3 + length, abs=1e-9)
    assert (width[5], length[5]) == pytest.approx((0.4 * MM, -0.2 * MM))
    for asked, found in zip(defects, mesh.info["defects"], strict=True):
        assert found["delivered"] == pytest.approx(asked.displacement, abs=1e-9)
    assert abs(mesh.info["volume_change"]) < 1e-3
    assert report_mesh(mesh).inverted == 0
    assert set(mesh.info["altered_sectors"]) <= {4, 5, 6, 21}


@pytest.mark.parametrize("shape", SHAPES)
def test_both_faces_follow_the_shape_and_the_beam_keeps_its_width(n1013, shape):
    delta = 0.2 * MM
    defect = CrossbeamDefect(crossbeam=5, displacement=delta, shape=shape)
    sound, bent = n1013(fineness="fine"), n1013(defect, fineness="fine")
    for pocket, face, sign in ((4, "front", -1.0), (5, "rear", -1.0)):
        vertices = np.unique(sound.groups[f"pocket{pocket}_{face}"])
        step = in_pocket_frame(bent.points[vertices] - sound.points[vertices], pocket, 22)
        wanted = sign * delta * defect.profile(sound.points[vertices, 0], 8.25e-3)
        assert step[:, 2] == pytest.approx(wanted, abs=1e-15)
        assert np.abs(step[:, 0]).max() < 1e-15
    beam = in_pocket_frame(sound.points, 4.5, 22)
    middle = (np.abs(beam[:, 0]) < 1e-9) & (beam[:, 1] > 0) & (np.abs(beam[:, 2]) < 2.5e-3)
    step = in_pocket_frame((bent.points - sound.points)[middle], 4.5, 22)
    assert middle.sum() > 10
    assert np.ptp(step, axis=0).max() < 1e-15  # the section only translates
    assert np.abs(step[:, 1]).max() < 1e-15  # along the beam's own tangent


def test_side_beam_follows_its_shape_and_keeps_its_width(n1013):
    delta = -0.3 * MM
    defect = SideBeamDefect(pocket=5, displacement=delta)
    sound, bent = n1013(fineness="fine"), n1013(defect, fineness="fine")
    for name in ("pocket5_side+x", "end+x"):
        vertices = np.unique(sound.groups[name])
        local = in_pocket_frame(sound.points[vertices], 5, 22)
        here = local[:, 1] > 0.0
        wanted = np.where(here, delta * clamped_beam(local[:, 2], 8.2e-3), 0.0)
        assert bent.points[vertices, 0] - sound.points[vertices, 0] == pytest.approx(
            wanted, abs=1e-15
        )
    far = np.unique(sound.groups["end-x"])
    assert (sound.points[far] == bent.points[far]).all()


def test_bent_beam_leaves_side_beams_and_lands_alone(n1013):
    defect = CrossbeamDefect(crossbeam=5, displacement=0.2 * MM)
    sound, bent = n1013(fineness="fine"), n1013(defect, fineness="fine")
    side = np.abs(sound.points[:, 0]) >= 4.125e-3 - 1e-12
    assert (sound.points[side] == bent.points[side]).all()
    land = np.unique(sound.groups["land_outer"])
    radius = [np.hypot(*m.points[land, 1:].T) for m in (sound, bent)]
    assert np.abs(radius[1] - radius[0]).max() < 0.06 * 0.2 * MM


def test_numbering_and_groups_stay(n1013):
    sound = n1013(fineness="coarse")
    bent = n1013(CrossbeamDefect(crossbeam=5, displacement=0.2 * MM), fineness="coarse")
    assert (sound.tets == bent.tets).all()
    assert all((sound.groups[n] == bent.groups[n]).all() for n in sound.groups)
    cells = sound.info["sector_cells"]
    moved = (sound.points != bent.points).any(axis=1)[sound.tets].any(axis=1)
    assert set(np.flatnonzero(moved) // cells) == set(bent.info["altered_sectors"]) == {4, 5}


def test_mass_centre_moves_with_the_beam(n1013):
    """Towards pocket 4 by the beam's own share: 8/15 of delta over its length, area 13.5 mm^2."""
    defect = CrossbeamDefect(crossbeam=5, displacement=0.2 * MM)
    report = report_mesh(n1013(defect, fineness="fine"))
    angle = 2.0 * np.pi * 4.5 / 22
    tangent = np.array([0.0, -np.sin(angle), np.cos(angle)])
    outer, inner, half = 43.3, 39.45, 4.1

    def sector(r):  # area of the beam's section within radius r: a wedge less two triangles
        wedge = r**2 * (np.pi / 22 - np.arcsin(half / r))
        return wedge - half * np.sqrt(r**2 - half**2)

    area = (sector(outer) - sector(inner)) * 1e-6
    static = area * 8.25e-3 * 8.0 / 15.0 * 0.2e-3 / np.cos(np.pi / 22)
    shift = -static / report.volume
    assert report.mass_centre @ tangent == pytest.approx(shift, rel=0.02)
    assert report.mass_centre_shift == pytest.approx(abs(shift), rel=0.02)


@pytest.mark.parametrize(
    ("defect", "where"),
    [
        (CrossbeamDefect(crossbeam=22, displacement=0.1 * MM), "crossbeam"),
        (SideBeamDefect(pocket=30, displacement=0.1 * MM), "pocket"),
        (CrossbeamDefect(crossbeam=2, displacement=4.2 * MM), "displacement"),
        (SideBeamDefect(pocket=2, displacement=-5.0 * MM), "displacement"),
    ],
)
def test_impossible_defects_are_refused(n1013, defect, where):
    with pytest.raises(InputError) as caught:
        n1013(defect, fineness="coarse")
    assert caught.value.where.endswith(where)


def test_defects_that_close_a_pocket_together_are_refused(n1013):
    pinch = [CrossbeamDefect(crossbeam=k, displacement=d * MM) for k, d in ((3, -4.0), (4, 4.09))]
    with pytest.raises(InputError, match="invert .* elements"):
        n1013(*pinch, fineness="coarse")
    pinch.append(CrossbeamDefect(crossbeam=4, displacement=0.3 * MM, shape="shifted"))
    with pytest.raises(InputError, match="pocket 3"):
        n1013(*pinch, fineness="coarse")


def test_a_defect_that_changes_the_volume_is_refused(n1013):
    defect = SideBeamDefect(pocket=5, side="+x", displacement=3.8 * MM)
    with pytest.raises(InputError, match=r"3.8 mm changes the cage's volume by \+0.10%") as said:
        n1013(defect, fineness="coarse")
    assert said.value.where == "defects.0.displacement"
