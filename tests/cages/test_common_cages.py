"""Meshes of common cages of two rows: one closed body, pockets where they belong, mass against the
dimensions, defects of either row, and what is refused."""

from __future__ import annotations

from dataclasses import replace
from math import pi, sqrt

import numpy as np
import pytest
import scipy.sparse as sp
from barrel_cage import BARREL_CAGE, BARRELS
from common_cages import COMMON, MM, WINDOW, common_mesh, places_of, pocket_places
from scipy.integrate import dblquad
from scipy.sparse.linalg import eigsh

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.conical.mass import mass_of
from flexcage.cages.halves import find_apart, is_one_piece, signs_of
from flexcage.cages.ribbon.cage import RibbonCage
from flexcage.cages.round_pocket.defects import EnlargedPocket, WebCrack
from flexcage.cages.window.broken import BrokenCrossbeam
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect
from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import assemble
from flexcage.geometry.bearing import RowPlace
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.cage_mesh import signed_volumes
from flexcage.mesh.options import MeshOptions

KINDS, ROWS = tuple(COMMON), pytest.mark.parametrize("staggered", [False, True])


def frequencies(model, count=6):
    return np.sqrt(free_modes(FreeBodySolver(model), count)[0]) / (2.0 * pi)


@ROWS
@pytest.mark.parametrize("kind", KINDS)
def test_both_halves_are_one_closed_body_of_equal_sectors(kind, staggered):
    mesh = common_mesh(kind, staggered=staggered)
    count = COMMON[kind][1]
    assert (signed_volumes(mesh.points, mesh.tets) > 0.0).all()
    model = assemble(mesh, COMMON[kind][0].material, order=1)
    faces = np.sort(np.concatenate(list(mesh.groups.values())), axis=1)
    boundary = {tuple(face) for face in np.sort(model.surface, axis=1)}
    assert {tuple(face) for face in faces} <= boundary and len(np.unique(faces, axis=0)) == len(
        faces
    )
    middle = np.abs(mesh.points[model.surface][..., 0]).max(axis=1) < 1e-9
    assert not middle.any()  # nothing ends in the middle plane
    assert model.sectors is not None and model.sectors.count == count
    assert len(mesh.points) % count == 0 and mesh.pocket_count == count


@ROWS
@pytest.mark.parametrize("kind", KINDS)
def test_pockets_of_the_second_row_count_on_where_elements_are(kind, staggered):
    mesh = common_mesh(kind, staggered=staggered)
    count, pitch = COMMON[kind][1:3]
    face = "_wall" if f"pocket{count}_wall" in mesh.groups else "_front"
    for pocket in (0, count - 1, count, 2 * count - 1):
        own = mesh.points[np.unique(mesh.groups[f"pocket{pocket}{face}"])]
        x, r, t = pocket_places(own, kind, pocket, staggered=staggered).mean(axis=0)
        assert abs(x) < (1.5 if kind == "crown" else 0.6) * MM  # its wall is open on one side
        assert r == pytest.approx(0.5 * pitch, rel=0.1)
        assert t == pytest.approx(0.0, abs=1e-9) if face == "_wall" else t > 1.0 * MM
    assert f"pocket{2 * count}{face}" not in mesh.groups
    for end, sign in (("end+x", 1.0), ("end-x", -1.0)):
        at = sign * mesh.points[np.unique(mesh.groups[end]), 0]
        assert at.max() == pytest.approx(np.abs(mesh.points[:, 0]).max())


def test_a_common_window_cage_weighs_what_its_dimensions_say():
    """Two hollow cylinders less their pockets: prisms between planes with rounded corners, cut out
    of the wall between its cylinders."""
    mesh, c, count = common_mesh("window", fineness="fine"), WINDOW, COMMON["window"][1]
    density, (a, b) = c.material.density, (0.5 * c.bore, 0.5 * c.outside_diameter)
    half_x, half_t, r = 0.5 * c.pocket_length, 0.5 * c.pocket_width, c.fillet_radius

    def ends(t):
        return half_x - r + sqrt(r**2 - max(t - half_t + r, 0.0) ** 2)

    def pocket(moment):  # all is even in x and t
        return sum(
            dblquad(lambda y, t: 4.0 * moment(y, t) * ends(t), lo, hi,
                    lambda t: sqrt(a**2 - t**2), lambda t: sqrt(b**2 - t**2))[0]
            for lo, hi in ((0.0, half_t - r), (half_t - r, half_t))
        )  # fmt: skip

    volume = pi * (b**2 - a**2) * c.width - count * pocket(lambda y, t: 1.0)
    polar = 0.5 * pi * (b**4 - a**4) * c.width - count * pocket(lambda y, t: y**2 + t**2)
    model = assemble(mesh, c.material, order=1)
    assert model.mass == pytest.approx(2.0 * density * volume, rel=5e-4)
    assert model.inertia[0, 0] == pytest.approx(2.0 * density * polar, rel=1e-3)
    assert model.centre == pytest.approx(0.0, abs=1e-9)


@ROWS
def test_the_cage_of_barrels_weighs_twice_its_half(staggered):
    mesh = common_mesh("barrel", staggered=staggered, fineness="fine")
    model = assemble(mesh, BARREL_CAGE.material, order=1)
    half = mass_of(BARREL_CAGE, BARRELS.roller_count)
    away = half.centre + 0.5 * BARRELS.row_distance
    across = 2.0 * (half.transverse + half.mass * away**2)
    assert model.mass == pytest.approx(2.0 * half.mass, rel=4e-4)
    inertia = np.diag(model.inertia)
    assert inertia == pytest.approx([2.0 * half.axial, across, across], rel=1e-3)
    assert model.centre == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("kind", ["window", "barrel"])
def test_six_rigid_motions_and_no_more_cost_no_energy(kind):
    model = assemble(common_mesh(kind), COMMON[kind][0].material, order=1)
    own = frequencies(model, 2)[0] * 2.0 * pi
    mass = sp.kron(model.mass_scalar, sp.eye_array(3)).tocsc()
    found = eigsh(model.K.tocsc(), 8, mass, sigma=-0.01 * own**2, return_eigenvectors=False)
    values = np.sort(found)
    assert np.abs(values[:6]).max() < 1e-8 * own**2
    assert values[6:] == pytest.approx(own**2, rel=1e-5)


@ROWS
def test_two_nearly_closed_rows_bend_as_one_ring(staggered):
    """Love's bending of a thin ring in its plane, whatever its width: omega^2 = E h^2/(12 rho a^4)
    n^2 (n^2 - 1)^2/(n^2 + 1), without Poisson's ratio."""
    strip = replace(MATERIALS["steel"], name="strip", poisson_ratio=0.0)
    ring = replace(
        WINDOW, material=strip, bore=64.4 * MM, outside_diameter=65.6 * MM, width=4 * MM,
        pocket_width=0.5 * MM, pocket_length=0.8 * MM, fillet_radius=0.1 * MM,
    )  # fmt: skip
    apart = RowPlace(-2 * MM), RowPlace(2 * MM, -1.0, pi / 12 if staggered else 0.0)
    mesh = build_cage_mesh(
        ring, pocket_count=12, pitch_diameter=65 * MM, places=apart,
        options=MeshOptions(fineness="coarse"),
    )  # fmt: skip
    found = frequencies(assemble(mesh, strip), 6)
    rate = sqrt(strip.youngs_modulus / (12.0 * strip.density)) * 0.6 * MM / (32.5 * MM) ** 2
    love = [rate * n * (n**2 - 1) / sqrt(n**2 + 1) / (2.0 * pi) for n in (2, 3)]
    for due in love:
        assert np.abs(found / due - 1.0).min() < 0.015


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["window", "crown", "barrel"])
def test_frequencies_of_common_cages_converge(kind):
    coarse, medium, fine = (
        frequencies(assemble(common_mesh(kind, fineness=f), COMMON[kind][0].material), 6)
        for f in ("coarse", "medium", "fine")
    )
    assert coarse == pytest.approx(fine, rel=0.04)
    assert medium == pytest.approx(fine, rel=0.012)


DEFECTS = {
    "window": (
        CrossbeamDefect(crossbeam=12, displacement=0.1 * MM),
        SideBeamDefect(pocket=15, side="-x", displacement=0.15 * MM),
        SideBeamDefect(pocket=3, side="-x", displacement=0.1 * MM),
        BrokenCrossbeam(crossbeam=7), BrokenCrossbeam(crossbeam=20),
    ),
    "machined": (
        EnlargedPocket(pocket=11, increase=0.1 * MM), WebCrack(web=3, side="+x", share=0.2),
    ),
    "barrel": (
        CrossbeamDefect(crossbeam=15, displacement=-0.2 * MM), BrokenCrossbeam(crossbeam=2),
    ),
}  # fmt: skip


@pytest.mark.parametrize("kind", DEFECTS)
def test_defects_of_either_row_are_in_the_mesh(kind):
    """Each is delivered, by the number that it was given, and moves its own row alone."""
    sound, mesh = common_mesh(kind), common_mesh(kind, *DEFECTS[kind])
    given = sorted((d.type, d.number) for d in DEFECTS[kind])
    found = mesh.info["defects"]
    assert sorted((row["defect"].type, row["defect"].number) for row in found) == given
    for row in found:
        assert row["delivered"] == pytest.approx(row["asked"], rel=0.02)
    if kind == "machined":  # meshed anew for its crack
        return
    moved = np.linalg.norm(mesh.points[: len(sound.points)] - sound.points, axis=1) > 1e-9
    rows = {d.number // COMMON[kind][1] for d in DEFECTS[kind] if d.type != "broken_crossbeam"}
    for row, side in enumerate((-1.0, 1.0)):
        there = side * sound.points[:, 0] > 1e-9
        assert moved[there].any() == (row in rows)
    assert len(mesh.info["doubled"]) == len(mesh.points) - len(sound.points) > 0


def test_a_middle_rim_moves_for_both_rows():
    """A side beam of the first row next to the middle: the second row's vertices there are its."""
    sound = common_mesh("window")
    bent = common_mesh("window", SideBeamDefect(pocket=3, side="+x", displacement=0.1 * MM))
    moved = np.linalg.norm(bent.points - sound.points, axis=1)
    middle = np.abs(sound.points[:, 0]) < 1e-9
    assert moved[middle].max() == pytest.approx(0.1 * MM, rel=1e-6)
    assert (signed_volumes(bent.points, bent.tets) > 0.0).all()


@pytest.mark.parametrize("kind", ["window", "barrel"])
def test_halves_that_do_not_meet_are_no_one_body(kind):
    cage, count, _, apart = COMMON[kind]
    assert is_one_piece(cage, places_of(kind)) and not list(find_apart(cage, places_of(kind)))
    further = RowPlace(-0.6 * apart), RowPlace(0.6 * apart, -1.0, pi / count)
    assert not is_one_piece(cage, further)
    ((where, said),) = find_apart(cage, further)
    assert where == "cage.width" and "apart in the middle" in said and "give" in said


def test_which_way_halves_face():
    """A crown's claws point outwards if its rings hold together, and else towards each other."""
    crown, *_, apart = COMMON["crown"]
    assert signs_of(crown, places_of("crown")) == (-1.0, 1.0)
    loose = RowPlace(-0.5 * apart - 1 * MM), RowPlace(0.5 * apart + 1 * MM)
    assert signs_of(crown, loose) == (1.0, -1.0)
    assert signs_of(WINDOW, places_of("window")) == (1.0, 1.0)
    assert signs_of(BARREL_CAGE, places_of("barrel")) == (-1.0, 1.0)


def test_riveted_halves_are_refused_in_a_sentence():
    ribbon = RibbonCage.__new__(RibbonCage)
    object.__setattr__(ribbon, "width", 9 * MM)
    ((where, said),) = find_apart(ribbon, places_of("machined"))
    assert where == "cage.model" and "not one body" in said and "'crown'" in said


@pytest.mark.parametrize(
    ("defect", "said"),
    [
        (CrossbeamDefect(crossbeam=22, displacement=0.1 * MM), "numbered 0 to 21"),
        (CrossbeamDefect(crossbeam=12, displacement=40 * MM), r"defects\.1\.displacement"),
    ],
)
def test_defects_of_the_second_row_are_checked_by_their_numbers(defect, said):
    first = CrossbeamDefect(crossbeam=1, displacement=0.1 * MM)
    with pytest.raises(InputError, match=said):
        BARRELS.check(cage=BARREL_CAGE, defects=(first, defect))
