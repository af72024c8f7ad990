"""A pocket with its rolling element: where the element stands, and what the picture shows."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest
from PIL import Image

from flexcage import load_case
from flexcage.case.presets import load_preset
from flexcage.render.instant import Instant
from flexcage.render.pocket_pictures import element_in_pocket, nearest_pocket, pocket_picture

COUNT = 22


ROWS = {
    "type": "double_row_cylindrical_roller", "bore": "50 mm", "outside_diameter": "80 mm",
    "width": "23 mm", "inner_race_diameter": "58 mm", "outer_race_diameter": "72 mm",
    "roller_diameter": "7 mm", "roller_length": "7 mm", "effective_length": "6.4 mm",
    "roller_count": 8, "rib_diameter": "60 mm", "rib_gap": "7.05 mm", "row_distance": "9 mm",
}  # fmt: skip


def shown(*, turned: float = 0.0, centre=(0.0, 0.0, 0.0), skew: float = 0.0) -> Instant:
    """Rollers of an N1013 in the middle of their pockets, of a cage that turned and moved."""
    psi = 2.0 * pi * np.arange(COUNT) / COUNT + turned
    position = np.column_stack([np.zeros(COUNT), np.full(COUNT, 41.25e-3), psi])
    quaternion = np.array([np.cos(0.5 * turned), np.sin(0.5 * turned), 0.0, 0.0])
    none = np.zeros(COUNT)
    force = none.copy()
    force[5] = 1234.5
    return Instant(
        1e-3, "roller", position, np.column_stack([np.full(COUNT, skew), none]), none, none,
        {"side beams": force}, (np.asarray(centre), quaternion), np.zeros(3), 0.0, 0.0, "cage", 0.0,
    )  # fmt: skip


@pytest.mark.parametrize("pocket", [0, 5, 21])
@pytest.mark.parametrize("turned", [0.0, 2.3])
def test_an_element_stands_in_its_pocket_however_the_cage_turned(pocket, turned):
    bearing = load_preset("N1013").bearing
    body = element_in_pocket(shown(turned=turned), bearing, pocket)
    psi = 2.0 * pi * pocket / COUNT
    middle = 0.5 * (body.points.max(axis=0) + body.points.min(axis=0))
    assert middle == pytest.approx(41.25e-3 * np.array([0.0, np.cos(psi), np.sin(psi)]), abs=2e-6)
    assert np.ptp(body.points[:, 0]) == pytest.approx(8e-3, abs=1e-6)


def test_a_cage_that_moved_leaves_its_element_behind():
    bearing = load_preset("N1013").bearing
    still, moved = (
        element_in_pocket(shown(centre=c), bearing, 3).points for c in (np.zeros(3), [0, 1e-4, 0])
    )
    assert moved - still == pytest.approx(np.array([[0.0, -1e-4, 0.0]]).repeat(len(still), 0))
    skewed = element_in_pocket(shown(skew=0.01), bearing, 0).points
    assert np.ptp(skewed[:, 2]) > np.ptp(element_in_pocket(shown(), bearing, 0).points[:, 2])


def test_the_pocket_of_a_point_is_the_nearest():
    bearing = load_preset("N1013").bearing
    count = bearing.element_count
    angle = 2.0 * pi * (5.4 + np.array([0.0, 0.2])) / count
    points = np.stack([0.0 * angle, np.cos(angle), np.sin(angle)], axis=1)
    assert [nearest_pocket(p, bearing) for p in points] == [5, 6]
    assert nearest_pocket(np.array([0.0, 1.0, -0.01]), bearing) == 0


def test_the_pocket_of_a_point_of_two_rows_is_in_its_row():
    pair = load_case(
        {"bearing": ROWS, "cage": {"model": "none"}, "load": {"radial": "1 kN"}}
    ).bearing
    psi = pair.element_azimuths
    for pocket in (0, 7, 8, 15):
        x = -3e-3 if pocket < 8 else 3e-3
        point = np.array([x, np.cos(psi[pocket] + 0.1), np.sin(psi[pocket] + 0.1)])
        assert nearest_pocket(point, pair) == pocket


def test_the_picture_shows_stress_and_element(ring, tmp_path):
    """A cage without stress is dark, one with stress bright; the roller of pocket 0 is grey in the
    middle of both."""
    preset = load_preset("N1013")
    stress = np.zeros(len(ring.points))
    paths = [
        pocket_picture(
            ring.points, ring.tets, np.zeros_like(ring.points), values, tmp_path / f"{k}.png",
            shown=shown(), bearing=preset.bearing, pitch_radius=41.25e-3, pocket=0, limit=1e8,
            note="N1013",
        )
        for k, values in enumerate((stress, stress + 0.5e8))
    ]  # fmt: skip
    dark, bright = (np.asarray(Image.open(path).convert("RGB"), float) for path in paths)
    high, wide, _ = dark.shape
    at = dark[high // 2, wide // 4]
    assert np.ptp(at) < 30 and 90 < at.mean() < 220  # the roller, grey
    assert np.array_equal(at, bright[high // 2, wide // 4])
    assert np.abs(bright - dark).max(axis=2).astype(bool).mean() > 0.1  # the cage
