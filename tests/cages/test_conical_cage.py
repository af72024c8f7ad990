"""Conical cages: places and planes, clearances of rollers, mass, and what is refused."""

import re
import tomllib
from dataclasses import replace
from math import cos, pi, radians, sin, tan
from pathlib import Path

import numpy as np
import pytest
from conical_cage import CONE, COUNT, MM, ROLLERS

from flexcage.cages.conical.cage import ConicalCage
from flexcage.cages.conical.mass import mass_of
from flexcage.cages.conical.proposal import propose_conical_cage
from flexcage.cages.conical.rollers import clearance_around
from flexcage.cages.conical.walls import pocket_walls
from flexcage.cages.window.broken import BrokenCrossbeam
from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect
from flexcage.case.presets import NAMED
from flexcage.core.binding import Binder, to_table
from flexcage.core.errors import InputError

ANGLE = ROLLERS.axis_angle
ALONG, OUT = np.array([cos(ANGLE), -sin(ANGLE)]), np.array([sin(ANGLE), cos(ANGLE)])  # (x, r)


def in_plane(s, n):
    """Place (x, r) of a point of a roller's own plane."""
    return np.array([0.0, 12.5 * MM]) + s * ALONG + n * OUT


def test_its_outline_is_that_of_the_turned_rectangle():
    corners = np.array(
        [in_plane(s, n) for s in (-6.65 * MM, 6.25 * MM) for n in (1.2 * MM, 2.1 * MM)]
    )
    assert CONE.bore == pytest.approx(2.0 * corners[:, 1].min())
    assert CONE.outside_diameter == pytest.approx(2.0 * corners[:, 1].max())
    assert CONE.width == pytest.approx(np.ptp(corners[:, 0]))
    assert CONE.axial_reach == pytest.approx(np.abs(corners[:, 0]).max())
    assert "wall 0.9 mm thick" in CONE.in_words()


def test_bars_are_as_wide_as_what_pockets_leave_of_a_sector():
    """Distance of the faces of two neighbouring pockets at a place, by turning one of them."""
    s, n = 2.0 * MM, 1.0 * MM
    above = n - pocket_walls(CONE).middle[0, 1]
    w = 2.5 * MM + (4.65 - 2.0) * MM * 0.525 / 9.3 - above * tan(radians(28.0))
    r = in_plane(s, n)[1]
    turn = 2.0 * pi / COUNT
    other = np.array([cos(turn) * r + sin(turn) * w, sin(turn) * r - cos(turn) * w])
    assert CONE.bar_width(s, n, COUNT) == pytest.approx(np.hypot(*(other - [r, w])))


def cone_height(s, n, t):
    """Of a place in a pocket's frame, measured across the wall from the rollers' cone."""
    x, y = in_plane(s, n)
    return x * sin(ANGLE) + (np.hypot(y, t) - 12.5 * MM) * cos(ANGLE)


def nearest(cage, s):
    """Distance of a bar's face from the roller's axis at s, by points of its plane that are in the
    wall."""
    walls = pocket_walls(cage)
    n = np.linspace(-1.0 * MM, 2.5 * MM, 20_001)
    at, normal = walls.middle[0], walls.normal[0]
    t = at[2] - (normal[0] * (s - at[0]) + normal[1] * (n - at[1])) / normal[2]
    height = np.array([cone_height(s, *place) for place in zip(n, t)])
    within = np.abs(height - cage.offset) < 0.5 * cage.thickness
    return np.hypot(n, t)[within].min()


@pytest.mark.parametrize("s", [-4.5 * MM, 0.0, 3.0 * MM, 4.5 * MM])
@pytest.mark.parametrize("flank", [0.0, 28.0, 55.0])
def test_clearance_is_twice_the_least_distance_from_a_bar(s, flank):
    """With flanks that touch a roller within the wall, below and above it."""
    made = replace(CONE, flank_angle=radians(flank))
    radius = 3.0 * MM - s * tan(ROLLERS.half_angle)
    gap = clearance_around(made, ROLLERS.roller, s)
    assert gap == pytest.approx(2.0 * (nearest(made, s) - radius), abs=2e-7)


def test_walls_taper_as_they_are_wide():
    walls = pocket_walls(CONE)
    n = walls.middle[0, 1]
    assert cone_height(0.0, n, 2.7625 * MM) == pytest.approx(1.65 * MM)  # in the middle of the wall
    ends = np.array([[4.65 * MM, n, 2.5 * MM], [-4.65 * MM, n, 3.025 * MM]])
    for end in ends:
        assert (end - walls.middle[0]) @ walls.normal[0] == pytest.approx(0.0, abs=1e-12)
        mirrored = end * [1.0, 1.0, -1.0]
        assert (mirrored - walls.middle[1]) @ walls.normal[1] == pytest.approx(0.0, abs=1e-12)
    np.testing.assert_allclose(np.linalg.norm(walls.normal, axis=1), 1.0)
    np.testing.assert_allclose(walls.reach, [4.65 * MM, 4.65 * MM, 2.5 * MM, 3.025 * MM])
    assert walls.normal[0, 1] / walls.normal[0, 2] == pytest.approx(tan(radians(28.0)))


def test_mass_of_a_cage_with_narrow_slits_is_pappus():
    """A rectangle's area times the way of its centroid; Steiner for its moments."""
    slit = replace(CONE, pocket_width_small=4e-6, pocket_width_large=4e-6, fillet_radius=1e-7)
    s, n = -0.2 * MM, 1.65 * MM
    area, centroid = 12.9 * MM * 0.9 * MM, in_plane(s, n)
    mass = 7850.0 * area * 2.0 * pi * centroid[1]
    found = mass_of(replace(slit, flank_angle=0.0), 3)
    slits = 3 * 7850.0 * 4e-6 * 9.3 * MM * 0.9 * MM
    assert found.mass == pytest.approx(mass - slits, rel=1e-7)
    along, across = 12.9**2 / 12 * 1e-6, 0.9**2 / 12 * 1e-6  # second moments over the area
    radial = along * ALONG[1] ** 2 + across * OUT[1] ** 2
    mixed = along * ALONG[0] * ALONG[1] + across * OUT[0] * OUT[1]
    assert found.centre == pytest.approx(centroid[0] + mixed / centroid[1], rel=1e-3)
    assert found.axial == pytest.approx(mass * (centroid[1] ** 2 + 3.0 * radial), rel=1e-3)


@pytest.mark.parametrize(
    ("change", "where", "words"),
    [
        ({"cone_angle": 0.2}, "cone_angle", "the rollers' axes have"),
        ({"pitch_diameter": 26 * MM}, "pitch_diameter", "the rollers' axes have 25 mm"),
        ({"pocket_length": 8.9 * MM}, "pocket_length", "-0.1 mm"),
        ({"pocket_width_small": 4.4 * MM}, "pocket_width_small", "round the tapered roller there"),
        ({"offset": 2.6 * MM}, "offset", "into the outer race beside the small rim"),
        ({"fillet_radius": 2.4 * MM}, "fillet_radius", "is too big"),
        ({"fillet_radius": 1e-8}, "fillet_radius", "a sharp corner"),
        ({"pocket_width_small": 6.2 * MM}, "pocket_width_small", "wider than at the large end"),
        ({"pocket_width_large": 12 * MM}, "pocket_width_small", "crossbeams thinner than zero"),
        ({"flank_angle": radians(59.0), "thickness": 3 * MM}, "flank_angle", "within the wall"),
        ({"small_rim": 80 * MM}, "pitch_diameter", "runs into the bearing's axis"),
    ],
)  # fmt: skip
def test_an_impossible_cone_is_told(change, where, words):
    ROLLERS.check(CONE)
    with pytest.raises(InputError, match=words) as error:
        ROLLERS.check(replace(CONE, **change))
    assert error.value.where == f"cage.{where}"


@pytest.mark.parametrize(
    ("defect", "words"),
    [
        (CrossbeamDefect(crossbeam=10, displacement=0.1 * MM), "numbered 0 to 9"),
        (CrossbeamDefect(crossbeam=1, displacement=3.0 * MM), "half of the pocket's width"),
        (CrossbeamDefect(crossbeam=1, displacement=1.2 * MM), "10 % of interference"),
        (SideBeamDefect(pocket=1, side="+x", displacement=1.7 * MM), "below 1.6 mm"),
        (SideBeamDefect(pocket=1, side="-x", displacement=2.1 * MM), "below 2 mm"),
        (BrokenCrossbeam(crossbeam=12), "numbered 0 to 9"),
    ],
)
def test_an_impossible_defect_of_a_cone_is_told(defect, words):
    with pytest.raises(InputError, match=words):
        ROLLERS.check(CONE, [defect])


@pytest.mark.parametrize("angle", [12.0, 15.0, 20.0, 28.8])
@pytest.mark.parametrize("diameter", [4.5, 6.0])
def test_a_cone_is_proposed_that_holds_the_rollers(angle, diameter):
    """Its clearance is what the reasons say, at all places along the roller."""
    rollers = replace(
        ROLLERS, contact_angle=radians(angle), roller_diameter=diameter * MM, end_radius=20 * MM
    )
    made = propose_conical_cage(rollers)
    rollers.check(made.cage)
    gaps = [clearance_around(made.cage, rollers.roller, s * MM) for s in (-4.5, 0.0, 4.5)]
    assert gaps == pytest.approx([0.03 * diameter * MM] * 3, abs=0.02 * MM)
    assert made.cage.parts(0.0, COUNT)["crossbeams"] > 0.15 * diameter * MM
    assert all(field in made.cage.__dataclass_fields__ for field in made.reasons)


def test_the_cone_of_the_page_is_a_cage():
    """As a case gives it, with a bearing of its angle and rollers; it returns as it was written."""
    page = Path(__file__).parents[2] / "flexcage" / "cages" / "README.md"
    (block,) = re.findall(r"^```toml\n(\[cage\]\ntype = .conical.*?)^```", page.read_text("utf-8"),
                          flags=re.S | re.M)  # fmt: skip
    table = tomllib.loads(block)
    binder = Binder(named=NAMED)
    made = binder.bind(ConicalCage, table["cage"], "cage")
    assert binder.bind(ConicalCage, to_table(made), "cage") == made
    made.check(17)
    rollers = replace(
        ROLLERS, contact_angle=radians(14.0), pitch_diameter=39 * MM, roller_diameter=6.2 * MM,
        roller_length=9.5 * MM, effective_length=8.8 * MM, roller_count=17, bore=25 * MM,
        outside_diameter=52 * MM, end_radius=76 * MM,
    )  # fmt: skip
    (defect,) = table["defects"]
    rollers.check(made, [binder.bind(CrossbeamDefect, defect, "defects.0")])
