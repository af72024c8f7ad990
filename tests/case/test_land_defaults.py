"""The cage's land follows from the dimensions of cage and ring, or is asked for."""

from __future__ import annotations

import pytest

from flexcage.case import load_case
from flexcage.case.checks import land_clearance_mismatch
from flexcage.core.errors import InputError

N1013 = {"bearing": {"preset": "N1013"}, "load": {"radial": "1000 N"}}
DEEP = """
[bearing]
type = "deep_groove_ball"
bore = "25 mm"
outside_diameter = "52 mm"
width = "15 mm"
pitch_diameter = "39.04 mm"
ball_diameter = "7.938 mm"
ball_count = 9
radial_clearance = "10 um"
inner_groove_radius = "4.088 mm"
outer_groove_radius = "4.168 mm"
outer_shoulder = "1.4 mm"
[cage]
model = "rigid"
bore = "36.5 mm"
outside_diameter = "43.4 mm"
width = "13 mm"
pocket_diameter = "8.2 mm"
guidance = "outer"
[load]
radial = "500 N"
"""


def test_the_preset_has_the_land_that_it_had():
    land = load_case(N1013).land
    assert land.clearance == pytest.approx(0.25e-3, rel=1e-12) and land.width == 3.5e-3
    stated = {"contacts.land.clearance": "0.25 mm", "contacts.land.width": "3.5 mm"}
    assert load_case(N1013, overrides=stated).hash == load_case(N1013).hash


def test_a_roller_bearings_land_follows_its_cage():
    """Ribs begin 4.015 mm from the middle, the pockets end at 4.125 mm, the cage at 8 mm."""
    case = load_case(N1013)
    wider = case.replace({"cage.bore": "79.2 mm", "cage.pocket_length": "9 mm"})
    assert wider.land.clearance == pytest.approx(0.4e-3)
    assert wider.land.width == pytest.approx(0.9 * 3.5e-3, rel=0.02)
    short = case.replace({"bearing.rib_gap": "10 mm"})
    assert short.land.width == pytest.approx(2.7e-3), "ribs begin 5 mm from the middle"
    outer = case.replace({"cage.guidance": "outer", "bearing.rib_gap": "10 mm"})
    assert outer.land.clearance == pytest.approx(0.5 * (90.52e-3 - 86.6e-3) - 0.5 * 0.01e-3)
    assert outer.land.width == 3.5e-3, "the outer ring has no ribs"


DESIGN = {"bearing.design": "NU", "bearing.rib_diameter": "87.1 mm"}
COUNTER = {"bearing.counter_rib_diameter": "78.4 mm", "bearing.counter_rib_gap": "9 mm"}


@pytest.mark.parametrize(
    ("changes", "clearance", "begin"),
    [
        (DESIGN | {"cage.guidance": "outer"}, 0.5 * (87.1e-3 - 86.6e-3), 4.125e-3),
        (DESIGN | {"cage.guidance": "outer", "bearing.rib_gap": "9 mm"}, 0.25e-3, 4.5e-3),
        (DESIGN | {"cage.guidance": "roller"}, 0.5 * (78.9e-3 - 74.49e-3), 4.125e-3),  # the race
        (DESIGN | COUNTER | {"bearing.design": "NUP"}, 0.25e-3, 4.5e-3),
        (DESIGN | COUNTER | {"bearing.design": "NUP", "cage.guidance": "outer"}, 0.25e-3, 4.125e-3),
        (DESIGN | COUNTER | {"bearing.design": "NJ", "cage.guidance": "outer"}, 0.25e-3, 4.125e-3),
    ],
)
def test_a_land_lies_on_the_ribs_of_its_ring_or_else_on_the_race(changes, clearance, begin):
    """The cage ends 8 mm from the middle, its pockets 4.125 mm from it."""
    case = load_case(N1013).replace(changes)
    assert case.land.clearance == pytest.approx(clearance)
    assert case.land.width == pytest.approx(0.9 * (8e-3 - begin), rel=0.02)


def test_a_single_rib_is_no_land():
    """A cage that rollers guide does not touch it; it stands clear of it all the same."""
    case = load_case(N1013).replace(DESIGN | COUNTER | {"bearing.design": "NJ"})
    assert case.land.kind == "none"
    assert [limit.name for limit in case.bearing.cage_space(case.cage)] == [
        "the inner ring's rib", "the outer ring's ribs",
    ]  # fmt: skip


def test_a_cage_that_does_not_reach_the_ribs_touches_none():
    case = load_case(N1013).replace("bearing.rib_gap", "16.5 mm")
    assert case.land.kind == "none"
    with pytest.raises(InputError, match="does not face that ring; make it wider"):
        case.replace("cage.guidance", "inner")


def test_a_ball_bearings_land_lies_on_the_shoulder():
    """It is 39.04 + 7.938 - 2.8 = 44.178 mm in diameter, from 3.12 mm on; pockets end at 4.1."""
    case = load_case(DEEP)
    assert case.land.clearance == pytest.approx(0.5 * (44.178e-3 - 43.4e-3))
    assert case.land.width == pytest.approx(0.9 * (6.5e-3 - 4.1e-3), rel=0.02)
    assert not list(land_clearance_mismatch(case))
    closer = case.replace("cage.outside_diameter", "44 mm")
    assert closer.land.clearance == pytest.approx(89e-6)


def test_the_model_has_the_land_of_the_dimensions():
    from flexcage.compiling import build_bearing
    from flexcage.stages import cage_mesh

    case = load_case(DEEP).replace("mesh.fineness", "coarse")
    land = build_bearing(case, cage_mesh(case), None).data.model.land
    assert land.clearance == pytest.approx(0.389e-3) and land.kind == 1
    assert land.width == case.land.width
    assert land.x == pytest.approx([-0.5 * (13e-3 - 2.2e-3), 0.5 * (13e-3 - 2.2e-3)])


def test_a_land_reaches_no_further_than_the_ring():
    from flexcage.compiling import build_bearing
    from flexcage.stages import cage_mesh

    case = load_case(DEEP).replace({"cage.width": "18 mm", "mesh.fineness": "coarse"})
    land = build_bearing(case, cage_mesh(case), None).data.model.land
    assert land.x[1] + 0.5 * case.land.width == pytest.approx(7.5e-3)


def test_a_clearance_that_no_dimension_gives_is_asked_for():
    unknown = DEEP.replace('outer_shoulder = "1.4 mm"\n', "")
    with pytest.raises(InputError, match="give contacts.land.clearance or bearing.outer_shoulder"):
        load_case(unknown)
    stated = '[contacts.land]\nclearance = "0.3 mm"\n[load]'
    given = load_case(unknown.replace("[load]", stated))
    assert given.land.clearance == 0.3e-3


def test_a_cage_that_cuts_the_shoulder_is_refused_as_are_lands_beyond_the_rim():
    case = load_case(DEEP)
    with pytest.raises(InputError, match="runs into the outer ring"):
        case.replace("cage.outside_diameter", "44.3 mm")
    with pytest.raises(InputError, match="30 mm, but .* faces the ring over 2.4 mm only"):
        case.replace("contacts.land.width", "30 mm")
    assert case.replace("contacts.land.width", "2.4 mm").land.width == 2.4e-3


def test_a_stated_clearance_beside_the_shoulders_is_told():
    case = load_case(DEEP).replace("contacts.land.clearance", "0.25 mm")
    (told,) = land_clearance_mismatch(case)
    assert "0.25 mm, where cage.outside_diameter and bearing.outer_shoulder leave 0.389 mm" in told


def test_a_cage_that_balls_guide_has_no_land():
    case = load_case(DEEP).replace("cage.guidance", "ball")
    assert case.bearing.land(case.cage) is None
    assert case.replace("contacts.land.width", "3.5 mm").hash == case.hash
