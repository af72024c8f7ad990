"""Defects of ball cages: where they leave the pockets' walls, and what is refused."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from flexcage.cages.round_pocket.defects import (
    DisplacedPocket,
    ElongatedPocket,
    EnlargedPocket,
    WebCrack,
    pocket_shapes,
)
from flexcage.cages.round_pocket.shapes import wall_reach, web_thickness
from flexcage.cages.window.defects import SideBeamDefect
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.geometry.defect import defect_spec

MM = 1e-3
PRESET = load_preset("7603025")
CAGE, BEARING = PRESET.cage, PRESET.bearing
Z = BEARING.ball_count


def check(*defects):
    defect_spec(CAGE).check_all(
        defects,
        CAGE,
        pocket_count=Z,
        pitch_diameter=BEARING.pitch_diameter,
        element_diameter=BEARING.ball_diameter,
    )


def test_defects_of_one_pocket_add_up():
    defects = (
        EnlargedPocket(pocket=2, increase=0.2 * MM),
        EnlargedPocket(pocket=2, increase=-0.05 * MM),
        ElongatedPocket(pocket=2, direction="axial", elongation=0.4 * MM),
        ElongatedPocket(pocket=3, direction="circumferential", elongation=0.1 * MM),
        DisplacedPocket(pocket=2, axial=-0.1 * MM, circumferential=0.2 * MM),
        WebCrack(web=2, share=0.2),
    )
    shapes = pocket_shapes(CAGE, defects, pocket_count=Z)
    assert shapes.radius[[1, 2, 3]] == pytest.approx([2.925 * MM, 3.0 * MM, 2.925 * MM])
    assert shapes.slot[[1, 2, 3]] == pytest.approx(
        np.array([[0.0, 0.0], [0.2 * MM, 0.0], [0.0, 0.05 * MM]])
    )
    assert shapes.centre[2] == pytest.approx([-0.1 * MM, 0.2 * MM])
    assert np.count_nonzero(shapes.centre) == 2
    check(*defects)


@pytest.mark.parametrize("slot", [(0.0, 0.0), (0.7, 0.0), (0.0, 0.4), (0.5, 0.2)])
def test_the_wall_is_its_radius_away_from_the_slots_middle(slot):
    """The middle of a slot is a rectangle of its straight lengths: a line, or a point."""
    angles = np.linspace(0.0, 2.0 * np.pi, 97)
    direction = np.column_stack([np.sin(angles), np.cos(angles)])
    place = wall_reach(direction, 3.0, np.array(slot))[:, None] * direction
    grid = np.linspace(-1.0, 1.0, 201)
    middle = np.array([(a * slot[0], b * slot[1]) for a in grid for b in (-1.0, 0.0, 1.0)])
    middle = np.vstack([middle, [(a * slot[0], b * slot[1]) for a in (-1.0, 1.0) for b in grid]])
    nearest = np.linalg.norm(place[:, None] - middle[None], axis=2).min(axis=1)
    assert nearest == pytest.approx(3.0, abs=2e-5)


def test_webs_are_as_thick_as_two_walls_are_apart_at_the_bore():
    """Two bored walls cut the bore along curves: their least distance by brute force."""
    defects = (
        EnlargedPocket(pocket=4, increase=0.3 * MM),
        DisplacedPocket(pocket=5, axial=0.4 * MM, circumferential=-0.2 * MM),
    )
    shapes = pocket_shapes(CAGE, defects, pocket_count=Z)
    thickness = web_thickness(CAGE, shapes, pitch_diameter=BEARING.pitch_diameter)
    bore = 0.5 * CAGE.bore

    def rim(k):
        angle = np.linspace(0.0, 2.0 * np.pi, 4001)
        x, t = shapes.radius[k] * np.sin(angle), shapes.radius[k] * np.cos(angle)
        turn = 2.0 * np.pi * k / Z + shapes.centre[k, 1] / (0.5 * BEARING.pitch_diameter)
        return x + shapes.centre[k, 0], bore * (turn + np.arcsin(t / bore))

    (x4, arc4), (x5, arc5) = rim(4), rim(5)
    at = np.linspace(-1.5 * MM, 1.5 * MM, 301)
    ahead, behind = arc4 > arc4.mean(), arc5 < arc5.mean()
    order4, order5 = np.argsort(x4[ahead]), np.argsort(x5[behind])
    front = np.interp(at, x4[ahead][order4], arc4[ahead][order4])
    rear = np.interp(at, x5[behind][order5], arc5[behind][order5])
    assert thickness[5] == pytest.approx((rear - front).min(), abs=2e-7)
    sound = CAGE.bore * (np.pi / Z - np.arcsin(CAGE.pocket_diameter / CAGE.bore))
    assert thickness[10] == pytest.approx(sound, rel=1e-9)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"outside_diameter": 38.0 * MM}, "must exceed its bore, 38.6 mm"),
        ({"width": 5.8 * MM}, "leaves no rims in a cage 5.8 mm wide"),
        ({"pocket_diameter": 7.2 * MM}, "makes the 17 webs thinner than zero at the bore"),
    ],
)
def test_impossible_cages(change, sentence):
    with pytest.raises(InputError, match=sentence) as caught:
        replace(CAGE, **change).check(Z)
    assert caught.value.where.startswith("cage.")


@pytest.mark.parametrize(
    ("defects", "where", "sentence"),
    [
        (
            [EnlargedPocket(pocket=17, increase=0.1 * MM)],
            "defects.0.pocket",
            "pocket is 17, but the cage's pockets are numbered 0 to 16",
        ),
        (
            [DisplacedPocket(pocket=-1, axial=0.1 * MM)],
            "defects.0.pocket",
            "pocket is -1, but the cage's pockets are numbered 0 to 16",
        ),
        (
            [WebCrack(web=0, share=0.1), WebCrack(web=30, share=0.1)],
            "defects.1.web",
            "web is 30, but the cage's webs are numbered 0 to 16",
        ),
        ([WebCrack(web=3, share=1.0)], "defects.0.share", "shorter than the cage's width, 1"),
        ([WebCrack(web=3, share=0.2, side="x")], "defects.0.side", r"must be '\+x' or '-x'"),
        (
            [WebCrack(web=3, share=0.2), WebCrack(web=3, side="-x", share=0.2)],
            "defects",
            "Web 3 has 2 cracks; give each web one",
        ),
        (
            [ElongatedPocket(pocket=1, direction="axial", elongation=-0.1 * MM)],
            "defects.0.elongation",
            "elongation is -0.1 mm, but must be greater than zero",
        ),
        (
            [ElongatedPocket(pocket=1, direction="radial", elongation=0.1 * MM)],
            "defects.0.direction",
            "must be 'axial' or 'circumferential'",
        ),
        (
            [EnlargedPocket(pocket=1, increase=-0.4 * MM)],
            "defects",
            "leave pocket 1 a diameter of 5.45 mm; it must be greater than the ball's, 5.55 mm",
        ),
        (
            [DisplacedPocket(pocket=1, axial=2.6 * MM)],
            "defects",
            "let pocket 1 reach 5.525 mm from the cage's middle, through the cage's end at 5.5 mm",
        ),
        (
            [EnlargedPocket(pocket=1, increase=1.5 * MM), EnlargedPocket(pocket=2, increase=MM)],
            "defects",
            "Pockets 1 and 2 run into each other: web 2",
        ),
        (
            [SideBeamDefect(pocket=1, displacement=0.1 * MM)],
            "defects.0.type",
            "'side_beam', but this bearing's cage is one of the machined cages, whose defects are",
        ),
    ],
)
def test_impossible_defects(defects, where, sentence):
    with pytest.raises(InputError, match=sentence) as caught:
        check(*defects)
    assert caught.value.where == where


def test_uneven_pockets_are_random_by_their_seed_and_centred():
    cage, uneven = replace(CAGE, pocket_scatter=20e-6), defect_spec(CAGE).by_chance
    shifts = np.array([
        [d.circumferential for d in uneven(cage, Z, seed)] for seed in range(200)
    ])  # fmt: skip
    np.testing.assert_allclose(shifts.mean(axis=1), 0.0, atol=1e-12)
    assert shifts.std() == pytest.approx(20e-6 * np.sqrt(1 - 1 / Z), rel=0.03)
    assert uneven(cage, Z, 3) == uneven(cage, Z, 3)
    assert uneven(CAGE, Z, 3) == ()


def test_a_bearing_checks_its_cages_defects():
    BEARING.check(CAGE, (EnlargedPocket(pocket=1, increase=0.2 * MM),))
    with pytest.raises(InputError, match="greater than the ball's"):
        BEARING.check(CAGE, (EnlargedPocket(pocket=1, increase=-0.4 * MM),))
    with pytest.raises(InputError, match="webs thinner than zero"):
        sound = EnlargedPocket(pocket=1, increase=0.1 * MM)
        BEARING.check(replace(CAGE, bore=30.0 * MM), (sound,))
