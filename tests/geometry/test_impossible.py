"""Impossible geometry is refused in one sentence that says where and what would be right."""

from dataclasses import replace

import numpy as np
import pytest

from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect, pocket_clearances
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.geometry.rollers import RollerProfile

PRESET = load_preset("N1013")
BEARING, CAGE = PRESET.bearing, PRESET.cage

BEARINGS = [
    ({"roller_count": 33}, ["33 rollers", "overlap", "at most 32 fit"]),
    ({"roller_diameter": 8.1e-3}, ["8.1 mm", "8 mm", "(E - F)/2"]),
    ({"bore": 75e-3}, ["inner_race_diameter is 74.5 mm", "bore, 75 mm"]),
    ({"outside_diameter": 90e-3}, ["outside_diameter is 90 mm"]),
    ({"rib_diameter": 70e-3}, ["rib_diameter is 70 mm"]),
    ({"rib_diameter": 91e-3}, ["outer_race_diameter is 90.5 mm"]),
    ({"radial_clearance": -5e-6}, ["-5 um", "negative"]),
    ({"effective_length": 8.1e-3}, ["8.1 mm", "longer than the roller"]),
    ({"rib_gap": 8e-3}, ["rib_gap is 8 mm", "8 mm"]),
    ({"rib_gap": 18e-3}, ["no ribs"]),
    ({"profile": RollerProfile(kind="crowned", crown_radius=1e-3)}, ["crown_radius is 0.001 m"]),
]
CAGES = [
    ({"pocket_width": 12e-3}, ["thinner than zero", "12 mm", "11.2286 mm"]),
    ({"pocket_length": 16e-3}, ["16 mm", "no side beams"]),
    ({"bore": 87e-3}, ["outside_diameter, 86.6 mm", "87 mm"]),
    ({"pocket_width": 7.9e-3}, ["clearance of -0.1 mm", "8 mm"]),
    ({"pocket_length": 8e-3}, ["clearance of 0 mm", "8 mm"]),
    ({"fillet_radius": 4.1e-3}, ["4.1 mm", "too big"]),
    ({"bore": 78e-3}, ["cuts through the inner ring's ribs", "78.4 mm"]),
    ({"outside_diameter": 90.6e-3}, ["outer race", "90.51 mm"]),
    ({"bore": 83e-3}, ["82.5 mm", "cannot guide"]),
]
DEFECTS = [
    ([CrossbeamDefect(crossbeam=22, displacement=1e-4)], ["22", "numbered 0 to 21"]),
    ([SideBeamDefect(pocket=30, displacement=1e-4)], ["30", "numbered 0 to 21"]),
    ([CrossbeamDefect(crossbeam=5, displacement=5e-3)], ["5 mm", "leaves the pocket", "4.1 mm"]),
    ([CrossbeamDefect(crossbeam=5, displacement=-5e-3)], ["-5 mm", "leaves the pocket"]),
    ([SideBeamDefect(pocket=5, displacement=4e-3)], ["4 mm", "leaves the pocket", "3.875 mm"]),
    ([CrossbeamDefect(crossbeam=0, displacement=1.1e-3)], ["pocket 21", "7.1 mm", "assembly"]),
    ([CrossbeamDefect(crossbeam=1, displacement=-1.1e-3)], ["pocket 1 ", "7.1 mm"]),
    (
        [
            CrossbeamDefect(crossbeam=1, displacement=0.6e-3),
            CrossbeamDefect(crossbeam=0, displacement=-0.6e-3),
        ],
        ["pocket 0", "7 mm", "10 % of interference"],
    ),
    ([SideBeamDefect(pocket=3, displacement=-1.1e-3)], ["pocket 3", "length of 7.15 mm"]),
]


def refused(bearing, cage, defects, words):
    with pytest.raises(InputError) as caught:
        bearing.check(cage, defects)
    sentence = str(caught.value)
    assert caught.value.where and sentence.endswith(".") and "\n" not in sentence
    assert all(word in sentence for word in words), sentence


@pytest.mark.parametrize(("change", "words"), BEARINGS)
def test_impossible_bearing(change, words):
    refused(replace(BEARING, **change), CAGE, (), words)


@pytest.mark.parametrize(("change", "words"), CAGES)
def test_impossible_cage(change, words):
    refused(BEARING, replace(CAGE, **change), (), words)


@pytest.mark.parametrize(("defects", "words"), DEFECTS)
def test_impossible_defect(defects, words):
    refused(BEARING, CAGE, defects, words)


def test_most_rollers_that_fit_do_fit():
    """32 on a circle of 82.5 mm: the chord 82.5 sin(pi/32) = 8.087 mm is over 8 mm."""
    narrow = replace(CAGE, bore=82.4e-3, pocket_width=8.05e-3)
    replace(BEARING, roller_count=32).check(narrow)


def test_crossbeams_vanish_where_neighbouring_pockets_meet():
    """Planes +-w/2 beside radii pi/Z apart meet at radius w/(2 sin(pi/Z)): here at the bore."""
    meeting = CAGE.bore * np.sin(np.pi / 22)
    wide = replace(BEARING, roller_diameter=BEARING.roller_diameter)
    wide.check(replace(CAGE, pocket_width=meeting * (1 - 1e-9)))
    refused(wide, replace(CAGE, pocket_width=meeting * (1 + 1e-9)), (), ["thinner than zero"])


def test_the_papers_defects_are_possible():
    for size in (0.1e-3, 0.2e-3, -0.2e-3, 0.5e-3):
        BEARING.check(CAGE, [CrossbeamDefect(crossbeam=5, displacement=size)])
    for size in (0.3e-3, -0.3e-3):
        BEARING.check(CAGE, [SideBeamDefect(pocket=5, displacement=size, side="-x")])


def test_clearances_of_every_pocket():
    """+ moves crossbeam k towards pocket k-1: that one narrows, k widens; ring closes at 0."""
    defects = [
        CrossbeamDefect(crossbeam=0, displacement=0.2e-3),
        CrossbeamDefect(crossbeam=5, displacement=0.1e-3),
        SideBeamDefect(pocket=7, displacement=-0.3e-3),
    ]
    width, length = pocket_clearances(CAGE, BEARING, defects)
    expected = np.full(22, 0.2e-3)
    expected[[21, 0, 4, 5]] += [-0.2e-3, 0.2e-3, -0.1e-3, 0.1e-3]
    assert width == pytest.approx(expected, abs=1e-15)
    expected = np.full(22, 0.25e-3)
    expected[7] = -0.05e-3
    assert length == pytest.approx(expected, abs=1e-15)
