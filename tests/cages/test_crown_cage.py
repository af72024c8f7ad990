"""Crown cages: what their dimensions mean, and what is refused."""

from dataclasses import replace
from math import hypot

import numpy as np
import pytest
from crown_cage import CAGE, MM, PITCH, crown

from flexcage.cages.crown.cage import CrownCage
from flexcage.cages.crown.proposal import propose_crown_cage
from flexcage.case import load_case
from flexcage.case.description import in_words
from flexcage.core.errors import InputError


def test_a_case_describes_one():
    case = crown()
    assert type(case.cage) is CrownCage and case.cage == replace(CAGE, material=case.cage.material)
    assert load_case(case.to_toml()) == case
    assert "ring with claws" in " ".join(in_words(case))


def test_tips_lie_where_the_sphere_is_as_wide_as_the_throat():
    assert hypot(CAGE.tip, 0.5 * CAGE.throat) == pytest.approx(0.5 * CAGE.pocket_diameter)
    assert CAGE.back == pytest.approx(CAGE.tip - 7.7 * MM)
    assert CAGE.ring_thickness == pytest.approx(7.7 * MM - CAGE.tip - 4.085 * MM)
    assert CAGE.axial_reach == pytest.approx(-CAGE.back)


def test_the_root_touches_bar_and_claw():
    """Its arc's middle lies its radius above the bar and outside the claw's sphere."""
    cage = replace(CAGE, root_radius=0.3 * MM, bar_height=0.2 * MM)
    x, rho = cage.root_centre
    assert x == pytest.approx(0.5 * MM)
    assert hypot(x, rho) == pytest.approx(4.085 * MM + 1.03 * MM + 0.3 * MM)
    met = (4.085 * MM + 1.03 * MM) / hypot(x, rho) * np.array([x, rho])
    assert cage.claw_begin == pytest.approx(met[0])
    assert np.linalg.norm(met - (x, rho)) == pytest.approx(0.3 * MM)


def test_walls_end_at_the_tips_alone():
    outward, inward, ahead, behind = CAGE.wall_ends(0.5 * PITCH, 4.085 * MM)
    for radius, sine in ((0.5 * 42.07, outward), (0.5 * 34.93, -inward)):
        point = np.array([0.5 * PITCH + 4.085 * MM * sine, 4.085 * MM * (1.0 - sine**2) ** 0.5])
        assert np.linalg.norm(point) == pytest.approx(radius * MM)
    assert ahead == pytest.approx(CAGE.tip / (4.085 * MM)) and behind > 1.0


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        (
            {"claw_thickness": "1.8 mm"},
            "cage.claw_thickness is 1.8 mm, so the claws of neighbouring pockets meet.*"
            "they take .* of the 13.1678 mm between two balls' centres; make claws",
        ),
        (
            {"throat": "8 mm"},
            "cage.throat is 8 mm, so the balls fall out; it must be less than the ball's "
            "diameter, 7.938 mm",
        ),
        (
            {"width": "5.9 mm"},
            "cage.width, 5.9 mm, leaves no ring under the pockets, which with their claws are "
            "5.919.* mm wide; it must be at least 6.08",
        ),
        ({"bore": "33 mm"}, "cage.bore is 33 mm, so the cage runs into the inner ring"),
        ({"outside_diameter": "44 mm"}, "is 44 mm, so the cage runs into the outer ring"),
        ({"bar_height": "1.5 mm"}, "cage.bar_height, 1.5 mm, leaves no claws between bars and"),
        ({"claw_thickness": "0.1 mm"}, "cage.claw_thickness, 0.1 mm, makes no claws"),
        ({"pocket_diameter": "7.9 mm"}, "cage.pocket_diameter is 7.9 mm, but must be greater"),
        ({"guidance": "outer"}, "'outer' is not known; choose from ball"),
        ({"pocket_scatter": "10 um"}, "pocket_scatter, 0.01 mm, is of machined cages"),
    ],
)
def test_impossible_cages(values, sentence):
    with pytest.raises(InputError, match=sentence):
        crown({f"cage.{key}": value for key, value in values.items()})


def test_a_throat_as_wide_as_the_pocket_is_refused_without_balls_too():
    with pytest.raises(InputError, match="cage.throat, 8.2 mm, leaves no claws; it must be less"):
        replace(CAGE, throat=8.2 * MM).check(9)


@pytest.mark.parametrize(
    ("values", "sentence"),
    [
        ({"bore": "33 mm"}, "cage.bore is 33 mm, so the claws overlap the inner ring's shoulder"),
        ({"outside_diameter": "44 mm"}, "so the claws overlap the outer ring's shoulder"),
    ],
)
def test_claws_over_a_shoulder_that_is_not_given(values, sentence):
    """A fifth of the ball's diameter is assumed for it."""
    shoulders = {"bearing.inner_shoulder": "none", "bearing.outer_shoulder": "none"}
    with pytest.raises(InputError, match=sentence):
        crown({f"cage.{key}": value for key, value in values.items()} | shoulders)


def test_the_proposal_is_possible_in_all_bearings_of_a_series():
    """Those of 60, 62 and 63 whose insides are inferred, small and large."""
    from flexcage.bearings.ball.inference import candidates
    from flexcage.case.catalogue import find
    from flexcage.geometry.inference import ranked

    for name in ("6000", "6005", "6010", "6201", "6205", "6212", "6302", "6308"):
        bearing = ranked(candidates(find(name).outline))[0].bearing
        cage = propose_crown_cage(bearing).cage
        bearing.check(cage)
        assert cage.throat < bearing.ball_diameter < cage.pocket_diameter
