"""Defects of crown cages: on the mesh, in the contact interface, in words, and refused."""

from dataclasses import replace

import numpy as np
import pytest
from crown_cage import CAGE, MM, PITCH, Z, crown, mesh_of

from flexcage.cages.crown.defects import BentClaw, CrackedClaw, MissingClaw, WornPocket
from flexcage.cages.crown.interface import rigid_crown_interface
from flexcage.case.description import in_words
from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.measure import in_pocket_frame
from flexcage.mesh.quality import check_mesh

BENT = BentClaw(pocket=2, claw="front", deflection=0.3 * MM)
CRACKED = CrackedClaw(pocket=3, claw="rear", share=0.4)
MISSING = MissingClaw(pocket=4, claw="front")
WORN = WornPocket(pocket=1, depth=0.1 * MM)


@pytest.mark.parametrize(
    ("defect", "size"),
    [(BENT, 0.3), (CRACKED, 0.4 * 3.57), (MISSING, CAGE.tip / MM), (WORN, 0.1)],
    ids=["bent", "cracked", "missing", "worn"],
)
def test_a_mesh_has_what_was_asked_for(defect, size):
    mesh = mesh_of(CAGE, "coarse", (defect,))
    check_mesh(mesh)
    (row,) = mesh.info["defects"]
    assert row["asked"] == pytest.approx(size * MM) and row["kind"] == defect.type
    assert row["delivered"] == pytest.approx(row["asked"], rel=1e-6)


def test_all_together():
    mesh = mesh_of(CAGE, "coarse", (MISSING, BENT, CRACKED, WORN))
    check_mesh(mesh)
    for row in mesh.info["defects"]:
        assert row["delivered"] == pytest.approx(row["asked"], rel=1e-6)


def test_a_bent_claw_leaves_all_else_in_place():
    sound, mesh = mesh_of(), mesh_of(CAGE, "coarse", (BENT,))
    moved = np.linalg.norm(mesh.points - sound.points, axis=1)
    at = in_pocket_frame(sound.points, 2, Z)
    claw = (at[:, 0] > 0.0) & (np.arctan2(at[:, 2], at[:, 1]) > 0.0)
    claw &= np.arctan2(at[:, 2], at[:, 1]) < np.pi / Z * (1.0 + 1e-9)
    assert (moved[~claw] == 0.0).all() and moved.max() == pytest.approx(0.3 * MM)
    assert mesh.info["altered_sectors"] == (2,)
    after = in_pocket_frame(mesh.points[claw], 2, Z) - at[claw]
    assert (after[:, 2] >= 0.0).all() and np.abs(after[:, :2]).max() < 1e-12


def test_a_missing_claw_takes_its_volume_away():
    """That of a claw of the sound cage: of the mesh with edges in the plane of the bars' end."""
    whole = mesh_of(CAGE, "coarse", (CrackedClaw(pocket=4, claw="front", share=0.4),))
    middles = whole.points[whole.tets].mean(axis=1)
    at = in_pocket_frame(middles, 4, Z)
    angle = np.arctan2(at[:, 2], at[:, 1])
    claw = (at[:, 0] > 0.0) & (angle > 0.0) & (angle < np.pi / Z)
    corners = whole.points[whole.tets[claw]]
    volume = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1])).sum() / 6.0
    mesh = mesh_of(CAGE, "coarse", (MISSING,))
    assert -mesh.info["volume_change"] * mesh.info["undamaged_volume"] == pytest.approx(
        volume, rel=0.01
    )
    tips = in_pocket_frame(mesh.points[np.unique(mesh.groups["end+x"])], 4, Z)
    near = tips[np.abs(np.arctan2(tips[:, 2], tips[:, 1])) < np.pi / Z]
    assert (near[:, 2] < 0.0).all()


def test_a_worn_wall_is_a_larger_sphere_with_tips_as_high_as_before():
    mesh = mesh_of(CAGE, "coarse", (WORN,))
    wall = mesh.points[np.unique(mesh.groups["pocket1_wall"])]
    at = in_pocket_frame(wall, 1, Z) - (0.0, 0.5 * PITCH, 0.0)
    np.testing.assert_allclose(np.linalg.norm(at, axis=1), 4.185 * MM, rtol=1e-6)
    assert at[:, 0].max() == pytest.approx(CAGE.tip, rel=1e-9)
    for name, size in (("land_inner", CAGE.bore), ("land_outer", CAGE.outside_diameter)):
        on = mesh.points[np.unique(mesh.groups[name])]
        np.testing.assert_allclose(np.hypot(on[:, 1], on[:, 2]), 0.5 * size, rtol=1e-8)


def test_a_cracked_claw_is_softer():
    """Pulled outwards at its tip against its bar, beside the other claw of the pocket."""
    model = assemble(mesh_of(CAGE, "coarse", (CRACKED,)), MATERIALS["PA66"])
    at = in_pocket_frame(model.points, 3, Z)
    near = np.abs(np.arctan2(at[:, 2], at[:, 1])) < np.pi / Z
    tip, bar = at[:, 0] > CAGE.tip - 1e-9, (at[:, 0] < -0.5 * MM) & (at[:, 0] > -2.0 * MM)
    out = model.points * (0.0, 1.0, 1.0)
    out /= np.linalg.norm(out, axis=1)[:, None]
    loads = np.zeros((len(model.nodes), 3, 2))
    for k, side in enumerate((at[:, 2] > 0.0, at[:, 2] < 0.0)):
        for place, sign in ((tip, 1.0), (bar, -1.0)):
            own = np.flatnonzero(near & side & place)
            loads[own, :, k] = sign * out[own] / len(own)
    flat = loads.reshape(-1, 2)
    sound, cracked = np.einsum("ik,ik->k", flat, FreeBodySolver(model).solve(flat))
    assert cracked > 1.2 * sound


def test_the_interface_has_bent_and_missing_claws_and_worn_walls():
    made = rigid_crown_interface(CAGE, pocket_count=Z, defects=(BENT, MISSING, WORN))
    assert made.radius[1] == pytest.approx(4.185 * MM) and made.radius[0] == pytest.approx(4.085e-3)
    assert made.open_at[4] == 0.0 and made.open_at[3] == pytest.approx(CAGE.tip)
    moved = made.offset[2, :, 2]
    assert moved[2] == pytest.approx(0.3 * MM) and moved[4] == pytest.approx(0.15 * MM)
    height = 4.085 * MM * np.sin(np.pi / 8.0) / CAGE.tip
    assert moved[1] == pytest.approx(0.3 * MM * 0.5 * height**2 * (3.0 - height))
    assert (moved[5:] == 0.0).all() and moved[0] == 0.0
    assert (made.offset[[0, 1, 3, 4]] == 0.0).all()
    sound = rigid_crown_interface(CAGE, pocket_count=Z)
    assert sound.offset is None and sound.open_at is None


def defective(text):
    return crown(defects=[text])


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        (
            {"type": "bent_claw", "pocket": 9, "claw": "front", "deflection": "0.1 mm"},
            "defects.0.pocket is 9, but the cage's pockets are numbered 0 to 8",
        ),
        (
            {"type": "bent_claw", "pocket": 1, "claw": "front", "deflection": "2 mm"},
            "a claw 1.83432 mm long bends by less than its length",
        ),
        (
            {"type": "bent_claw", "pocket": 1, "claw": "left", "deflection": "0.1 mm"},
            "'left' is not known; choose from front, rear",
        ),
        (
            {"type": "cracked_claw", "pocket": 1, "claw": "rear", "share": 1.0},
            "defects.0.share is 1, but a crack is deeper than 0 .* is a 'missing_claw'",
        ),
        (
            {"type": "worn_pocket", "pocket": 1, "depth": "0.9 mm"},
            "defects.0.depth is 0.9 mm, but must be greater than zero and less than half",
        ),
        ({"type": "crack", "web": 1, "share": 0.3}, "one of the crown cages, whose defects are"),
    ],
)
def test_impossible_defects(values, sentence):
    with pytest.raises(InputError, match=sentence):
        defective(values)


def test_two_defects_of_one_claw():
    twice = [{"type": "missing_claw", "pocket": 1, "claw": "rear"}] * 2
    with pytest.raises(InputError, match="The rear claw of pocket 1 has 2 defects of type"):
        crown(defects=twice)


def test_words():
    case = crown(defects=[{"type": "missing_claw", "pocket": 1, "claw": "rear"}])
    assert "the rear claw of pocket 1 is missing" in " ".join(in_words(case)).lower()
    assert replace(BENT, deflection=-0.1 * MM).in_words(9).endswith("0.1 mm towards the ball")
