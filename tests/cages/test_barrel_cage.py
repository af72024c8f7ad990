"""Cages of spherical roller bearings: places in them, checks, proposals."""

from dataclasses import replace
from math import asin, cos, degrees, hypot, pi, radians, sin, tan

import numpy as np
import pytest
from barrel_cage import BARREL_CAGE, BARRELS, COUNT, MM
from PIL import Image

from flexcage.cages.barrel.proposal import propose_barrel_cage
from flexcage.cages.conical.mass import mass_of
from flexcage.cages.conical.walls import pocket_walls
from flexcage.core.errors import InputError
from flexcage.render import section_picture


def test_a_barrel_lies_along_its_pocket():
    """The pocket's axis is the barrel's, across the line of contact, which goes through the
    bearing's middle; s counts away from it."""
    s, n, _ = BARREL_CAGE.axes
    middle = np.array([0.5 * BARREL_CAGE.row_distance, 0.5 * BARREL_CAGE.pitch_diameter, 0.0])
    assert np.cross(n, middle) == pytest.approx(0.0, abs=1e-12)
    assert s[0] > 0.0 and s @ middle == pytest.approx(0.0, abs=1e-12)
    assert degrees(asin(-s[1])) == pytest.approx(12.0)


def test_both_halves_end_in_the_middle_of_the_bearing():
    for n in BARREL_CAGE.section[2:]:
        s = BARREL_CAGE.large_end(n)
        assert BARREL_CAGE.axial(s, n) == pytest.approx(-0.5 * BARREL_CAGE.row_distance)
    rim = -0.5 * 9.25 * MM - BARREL_CAGE.large_end(1.4 * MM)
    assert BARREL_CAGE.large_rim == pytest.approx(rim)
    end = BARREL_CAGE.axial(6.125 * MM, 3.8 * MM) + 0.5 * BARREL_CAGE.row_distance
    assert BARREL_CAGE.width == pytest.approx(2.0 * end)


def test_barrels_touch_bars_within_their_faces():
    around, along = BARREL_CAGE.clearances(BARRELS)
    assert along == pytest.approx(0.25 * MM)
    walls = pocket_walls(BARREL_CAGE)
    off = walls.middle[0] @ walls.normal[0]  # of the plane from the barrel's axis
    assert around == pytest.approx(2.0 * (off - 5.5 * MM), rel=1e-9)
    assert walls.inside < off * sin(radians(24.0)) < walls.outside


def test_half_of_a_plain_double_cone_weighs_what_pappus_says():
    """Without windows to speak of: area of the section times the way of its centre."""
    shut = replace(BARREL_CAGE, pocket_length=0.1 * MM, pocket_width=0.1 * MM, flank_angle=0.0,
                   fillet_radius=0.01 * MM, rim=6 * MM)  # fmt: skip
    at = shut.section
    corners = np.array([
        (shut.axial(s, n), shut.radius(s, n))
        for s, n in ((shut.large_end(at.inside), at.inside), (at.small, at.inside),
                     (at.small, at.outside), (shut.large_end(at.outside), at.outside))
    ])  # fmt: skip
    x, r = corners.T
    ahead, up = np.roll(x, -1), np.roll(r, -1)
    cross = x * up - ahead * r
    area = 0.5 * cross.sum()
    centre = ((r + up) @ cross) / (6.0 * area)
    said = mass_of(shut, 3)
    windows = 3 * 0.01 * MM**2 * 2.4 * MM
    volume = 2.0 * pi * centre * area - windows
    assert said.mass == pytest.approx(shut.material.density * volume, rel=1e-6)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        (
            {"cone_angle": radians(11.0)},
            "cage.cone_angle is 11 deg, but the rollers' axes have",
        ),
        (
            {"row_distance": 12 * MM},
            "but the rows of barrels are 11.05",
        ),
        ({"pocket_width": 9.9 * MM}, "cage.pocket_width is 9.9 mm, a clearance of -"),
        ({"pocket_length": 9 * MM}, "cage.pocket_length is 9 mm, a clearance of 0 mm"),
        ({"offset": 4.5 * MM}, "cage.offset is 4.5 mm, so the wall cuts .* into the sphere"),
        ({"offset": 1.0 * MM, "thickness": 1.6 * MM}, "cage.pocket_width"),
        ({"pocket_length": 12.5 * MM}, "so the pockets of both rows run into each other"),
        ({"pocket_width": 15 * MM}, "crossbeams thinner than zero"),
        ({"fillet_radius": 6 * MM}, "cage.fillet_radius"),
        ({"unbalance": 1.0}, "cage.unbalance"),
    ],
)
def test_cages_of_barrels_that_cannot_be(changes, said):
    BARRELS.check(cage=BARREL_CAGE)
    with pytest.raises(InputError, match=said):
        BARRELS.check(cage=replace(BARREL_CAGE, **changes))


@pytest.mark.parametrize("angle", [8.0, 12.0, 15.0])
def test_proposed_cages_of_barrels_fit(angle):
    bearing = replace(BARRELS, contact_angle=radians(angle), roller_length=(2.5 + angle / 2.5) * MM,
                      effective_length=3 * MM)  # fmt: skip
    proposed = propose_barrel_cage(bearing)
    bearing.check(cage=proposed.cage)
    assert set(proposed.reasons) <= set(proposed.cage.__dataclass_fields__)
    assert proposed.cage.material.name == "brass"
    gap = bearing.sphere_radius - hypot(
        bearing.reach + proposed.cage.section.outside, proposed.cage.section.small
    )
    assert gap > 0.02 * bearing.roller_diameter
    chord = 2.0 * 26 * MM * sin(pi / COUNT) * cos(0.0)
    assert proposed.cage.pocket_width < chord + 2.0 * tan(0.5) * 3 * MM


def test_the_section_of_both_halves_lies_in_the_sphere(tmp_path):
    corners = np.array(BARREL_CAGE.half_section) + (0.5 * BARREL_CAGE.row_distance, 0.0)
    assert corners[:, 0].min() == pytest.approx(0.0, abs=1e-12)
    assert np.hypot(*corners.T).max() < BARRELS.sphere_radius
    plain, caged = tmp_path / "plain.png", tmp_path / "caged.png"
    section_picture(BARRELS, plain)
    section_picture(BARRELS, caged, cage=BARREL_CAGE)
    seen = [np.asarray(Image.open(p).convert("RGB"), int) for p in (plain, caged)]
    assert (np.abs(seen[0] - seen[1]).max(axis=2) > 40).mean() > 0.01
