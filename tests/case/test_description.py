"""What a case is, in words: bearings, cages, defects, loads."""

from __future__ import annotations

import pytest

from flexcage.case import description, load_case

BALLS = {"bearing": {"preset": "7010C-PI"}, "load": {"axial": "100 N"}}


def told(table, **overrides) -> str:
    return " ".join(description.in_words(load_case({"name": "told", **table, **overrides})))


def test_a_ball_bearing():
    text = told(BALLS)
    assert text.startswith(
        "7010C, an angular contact ball bearing of 50 × 80 × 16 mm with 18 balls of 9.525 mm, "
        "free contact angle 15°, radial clearance 32.46 µm; the grooves' radii are 0.525 (inner) "
        "and 0.525 (outer) times the ball's diameter. Its cage is flexible, of polyimide, guided "
        "by its balls; its pockets are cylindrical, 10.025 mm across. The cage has no defect."
    )
    assert "under an axial load of 100 N, held in tilt." in text
    assert "roller" not in text.lower()


@pytest.mark.parametrize(
    ("load", "says"),
    [
        ({"axial": "100 N", "radial": "50 N"}, "an axial load of 100 N and a radial load of 50 N,"),
        (
            {"axial": "80 N", "moment_y": "0.5 N*m", "moment_z": "-1 N*m", "tilt": "free"},
            "an axial load of 80 N, a moment of 0.5 N·m about y and a moment of -1 N·m about z, "
            "free in tilt.",
        ),
        ({"axial": "100 N", "misalignment": "1 mrad"}, "100 N, tilted by 1 mrad, held in tilt."),
        ({"radial": "0 N"}, "under a radial load of 0 N, held in tilt."),
        (
            {"axial": "80 N", "varies": "axial", "ramp_to": "300 N", "ramp_time": "1 ms"},
            "under an axial load of 80 N, then 300 N, held in tilt.",
        ),
        (
            {"varies": "axial", "times": ["0 s", "1 s"], "values": ["1 N", "2 N"], "radial": "5 N"},
            "an axial load that a table gives over time and a radial load of 5 N, held",
        ),
    ],
)
def test_loads_of_a_ball_bearing(load, says):
    assert says in told(BALLS, load=load)


def test_a_shaft_that_yields():
    load = {"axial_stiffness": "10 N/um", "tilt": "free", "tilt_stiffness": "500 N*m/rad"}
    rollers = {"bearing": {"preset": "N1013"}}
    both = "on a shaft of 10 N/µm axially and 500 N·m/rad in tilt."
    assert f"0 N, {both}" in told(rollers, load=load)
    assert f"free in tilt, {both}" in told(BALLS, load={"axial": "9 N", **load})
    assert "shaft" not in told(rollers)


@pytest.mark.parametrize(
    ("defect", "says"),
    [
        ({"type": "enlarged", "pocket": 3, "increase": "0.3 mm"},
         "pocket 3 is larger in diameter by 0.3 mm"),
        ({"type": "enlarged", "pocket": 3, "increase": "-0.1 mm"},
         "pocket 3 is smaller in diameter by 0.1 mm"),
        ({"type": "elongated", "pocket": 9, "direction": "circumferential", "elongation": "0.1 mm"},
         "pocket 9 is a slot, longer around the cage by 0.1 mm"),
        ({"type": "displaced", "pocket": 0, "axial": "0.2 mm", "circumferential": "-0.15 mm"},
         "pocket 0 is displaced by 0.2 mm towards +x and 0.15 mm towards pocket 17"),
        ({"type": "crack", "web": 0, "side": "-x", "share": 0.4},
         "web 0, between pockets 17 and 0, is cracked from the end -x over 40 % of the cage's "
         "width"),
    ],
)  # fmt: skip
def test_defects_of_a_ball_cage(defect, says):
    assert f"Defects: {says}." in told(BALLS, defects=[defect])


def test_a_roller_bearing_is_told_as_before():
    text = told(
        {"bearing": {"preset": "N1013"}},
        load={"radial": "1 kN"},
        defects=[{"type": "crossbeam", "crossbeam": 0, "displacement": "0.1 mm"}],
    )
    assert text.startswith(
        "N1013, a cylindrical roller bearing of 65 × 100 × 18 mm with 22 rollers"
    )
    assert "guided by its rollers; pockets are 8.2 mm wide and 8.25 mm long." in text
    assert (
        "Deformed: crossbeam 0 is bent by 0.1 mm, so that pocket 21 is narrower and pocket 0 wider "
        "by as much." in text
    )
    assert "under a radial load of 1000 N. Lubricant" in text
