"""Cases of static solutions: the same files, what takes part, and what is refused."""

from math import radians
from pathlib import Path

import numpy as np
import pytest

import flexcage
from flexcage.case import Case, StaticCase, load_case, load_static
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError

EXAMPLES = Path(__file__).parents[2] / "examples"
BEARING = '[bearing]\npreset = "7010C-PI"\n'
BALLS = '[bearing]\npreset = "7010C-PI"\n[load]\naxial = "100 N"\n'


def test_the_example():
    case = load_static(EXAMPLES / "c7010_static.toml")
    assert case.bearing.ball_count == 18 and case.bearing.contact_angle == radians(15.0)
    assert case.speed == pytest.approx(1e4 * np.pi / 30.0) and case.load.axial == 100.0


def test_the_example_of_the_page_on_cases():
    page = (EXAMPLES / "cases.md").read_text("utf-8")
    section = page.split("## Static solution")[1].split("\n## ")[0]
    case = load_static(section.split("```toml\n")[1].split("```")[0])
    assert case.preset == "7010C-PI" and case.static.tilt == "free"
    assert case.bearing == load_static(EXAMPLES / "c7010_static.toml").bearing


def test_without_a_drive_the_bearing_stands():
    assert load_static(BALLS).speed == 0.0
    assert load_static(BALLS + '[drive]\nspeed = "60 rpm"\n').speed == pytest.approx(2.0 * np.pi)


def test_a_varied_copy():
    case = load_static(BALLS)
    more = case.replace({"load.axial": "1 kN", "drive.speed": "60 1/min", "static.tilt": "free"})
    assert (case.load.axial, more.load.axial, more.static.tilt) == (100.0, 1000.0, "free")
    assert more.speed == pytest.approx(2.0 * np.pi) and isinstance(more, StaticCase)
    assert case.replace("load.axial", 50.0).load.axial == 50.0
    assert case.replace(**{"bearing.ball_count": 17}).bearing.ball_count == 17
    for path, value, words in (
        ("load.axial", "1 mm", "another kind"),
        ("load.axial", "900 kN", "static rating"),
        ("solver.duration", "1 s", "Unknown key 'solver'"),
        ("bearing.preset", "N1013", "cannot be replaced"),
    ):
        with pytest.raises(InputError, match=words):
            case.replace(path, value)


def test_a_simulations_case_is_read_as_well():
    """Its mesh, defects and solver are ignored; bearing, load and race contacts are not."""
    case = load_static(EXAMPLES / "n1013.toml", overrides={"contacts.race.slices": 30})
    full = load_case(EXAMPLES / "n1013.toml")
    assert case.bearing == full.bearing and case.load == full.load and case.speed == 200.0 * np.pi
    assert case.contacts.race.slices == 30 and full.contacts.race.slices == 16
    assert flexcage.solve_static(full).displacement == pytest.approx(
        flexcage.solve_static(load_static(EXAMPLES / "n1013.toml")).displacement
    )


def test_of_tables_over_time_the_start_counts():
    text = BALLS + '[drive]\ntimes = ["0 s", "1 s"]\nspeeds = ["600 rpm", "0 rpm"]\n'
    assert load_static(text).speed == pytest.approx(20.0 * np.pi)


@pytest.mark.parametrize("name", ["7010C-PI", "7603025", "15x37x10", "N1013"])
def test_round_trip_through_text(name):
    case = load_static(
        {"bearing": {"preset": name}, "load": {"radial": "10 N", "direction": "20 deg"},
         "static": {"tilt": "held", "cage_speed": "100 rpm"}},
    )  # fmt: skip
    again = load_static(case.to_toml())
    assert again == case and again.preset == name


def test_a_designation_of_digits_is_a_name():
    case = load_static(BALLS, overrides={"bearing.preset": 7603025})
    assert case.bearing == load_preset("7603025").bearing


def test_part_of_a_material_is_overridden():
    case = load_static(BALLS, overrides={"bearing.material.density": "3200 kg/m^3"})
    assert case.bearing.material.density == 3200.0
    assert case.bearing.material.youngs_modulus == 208e9


MISTAKES = {
    "angle and clearance": ({"bearing.radial_clearance": "80 um"}, ["32.46 um", "15 deg"]),
    "overlap": ({"bearing.ball_count": 24}, ["24 balls", "overlap"]),
    "pocket": ({"cage.pocket_diameter": "9 mm"}, ["pocket_diameter is 9 mm", "9.525 mm"]),
    "window": ({"cage.pocket_width": "9 mm"}, ["'pocket_width'", "'pocket_shape'"]),
    "rollers": ({"bearing.roller_count": 9}, ["'roller_count'", "'ball_count'"]),
    "type": ({"bearing.type": "ball"}, ["bearing.type 'ball' is not known"]),
    "section": ({"laod.axial": "1 N"}, ["'laod'", "'load'"]),
    "unit": ({"load.moment_z": "1 N"}, ["load.moment_z", "N*m"]),
    "overload": ({"load.axial": "-1000 kN"}, ["1000 kN", "static rating of 21.2 kN"]),
    "elsewhere": ({"defects.0.displacement": "1 mm"}, ["takes no part in a static solution"]),
    "nowhere": ({"load.axial.x": "1 N"}, ["load.axial"]),
    "negative": ({"static.dynamic_rating": "-3 kN"}, ["static.dynamic_rating"]),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes(name):
    overrides, words = MISTAKES[name]
    with pytest.raises(InputError) as caught:
        load_static(BALLS, overrides=overrides)
    sentence = str(caught.value)
    assert sentence.endswith(".") and "\n" not in sentence
    assert all(word in sentence for word in words), sentence


def test_a_cage_goes_with_its_type_of_bearing():
    preset = load_preset("7010C-PI")
    words = "'angular_contact_ball', whose cage is a BallCage, but .* a WindowCage"
    for attempt in (
        lambda: Case(bearing=preset.bearing, cage=load_preset("N1013").cage),
        lambda: load_case('[bearing]\npreset = "N1013"\n').replace("bearing", preset.bearing),
    ):
        with pytest.raises(InputError, match=words):
            attempt()


def test_what_is_not_free_in_a_run_takes_no_load():
    assert load_case(BALLS).load.axial == 100.0
    free = load_case(BALLS, overrides={"load.tilt": "free", "load.moment_y": "1 N*m"})
    assert free.load.moment_y == 1.0
    for path, value, words in (
        ("load.moment_y", "1 N*m", "tilts are held.*load.tilt = \"free\""),
        ("defects", [{"type": "crossbeam", "crossbeam": 1, "displacement": "0.1 mm"}],
         "'crossbeam'.*machined cages.*'enlarged'"),
    ):  # fmt: skip
        with pytest.raises(InputError, match=words):
            load_case(BALLS, overrides={path: value})
    with pytest.raises(InputError, match="load.tilt is 'free', but nothing"):
        load_case('[bearing]\npreset = "N1013"\n', overrides={"load.tilt": "free"})


def test_loads_of_the_static_solution_are_refused_in_a_run():
    for path, value, why in (
        ("load.axial", "5 N", "design N .* no axial load"),
        ("load.moment_y", "1 N*m", "tilts are held"),
    ):
        with pytest.raises(InputError, match=f"{path} is .*{why}"):
            load_case('[bearing]\npreset = "N1013"\n', overrides={path: value})


def test_the_start_of_a_table_counts():
    """Also of one that begins before the run does."""
    table = {"load.times": ["-1 s", "1 s"], "load.values": ["100 N", "300 N"]}
    axial = load_static(BALLS, overrides={**table, "load.varies": "axial"})
    np.testing.assert_array_equal(flexcage.solve_static(axial).load[:3], [200.0, 0.0, 0.0])
    radial = load_static(BALLS, overrides=table)
    np.testing.assert_array_equal(flexcage.solve_static(radial).load[:3], [100.0, 200.0, 0.0])
    drive = {"drive.times": ["-1 s", "1 s"], "drive.speeds": ["0 rpm", "60 rpm"]}
    assert load_static(BALLS, overrides=drive).speed == pytest.approx(np.pi)


def test_a_run_keeps_the_static_section_and_does_not_read_it():
    text = '[bearing]\npreset = "N1013"\n'
    plain, with_options = load_case(text), load_case(text + '[static]\ntilt = "free"\n')
    assert with_options.hash == plain.hash and not with_options.difference(plain)
    assert "[static]" not in plain.to_toml() and load_case(with_options.to_toml()) == with_options
    assert with_options.static.tilt == "free"


def test_one_file_has_one_static_solution():
    """Whether it is read as a simulation's case or as that of a static solution."""
    text = BALLS + '[drive]\nspeed = "20000 rpm"\n[static]\ngyroscopic = "shared"\n'
    own, of_run = (flexcage.solve_static(load(text)) for load in (load_static, load_case))
    np.testing.assert_array_equal(own.elements.angle, of_run.elements.angle)
    free = flexcage.solve_static(load_case(text, overrides={"static.gyroscopic": "none"}))
    assert np.abs(free.elements.angle - own.elements.angle).max() > 1e-4


def test_built_from_objects():
    bearing = load_preset("15x37x10").bearing
    case = StaticCase(bearing=bearing, load=flexcage.spec.Load(radial=200.0))
    solution = flexcage.solve_static(case)
    assert solution.largest_force > 200.0 / 7 and solution.load[1] == 200.0


def test_a_tilt_is_held_or_free_as_in_a_run():
    """One file, two commands: load.tilt says it for both, and both say what is held."""
    for tilt, words in (("held", "held: tilt 0 (load.tilt)"), ("free", "axial motion, tilt")):
        text = f'{BEARING}[load]\naxial = "100 N"\nradial = "40 N"\ntilt = "{tilt}"\n'
        static, run = load_static(text), load_case(text)
        own, of_run = flexcage.solve_static(static), flexcage.solve_static(run)
        for solution in (own, of_run):
            assert (solution.displacement[3:] == 0.0).all() == (tilt == "held")
            assert words in solution.table().splitlines()[1]
        assert words in run.held_in_words
    default = load_static(f'{BEARING}[load]\naxial = "100 N"\nradial = "40 N"\n')
    assert not flexcage.solve_static(default).displacement[3:].any()
    free = load_static(default.to_toml(), overrides={"static.tilt": "free"})
    assert flexcage.solve_static(free).displacement[3:].any()


def test_what_is_held_is_told_in_words():
    n1013 = load_case('[bearing]\npreset = "N1013"\n[load]\nmisalignment = "0.5 mrad"\n')
    assert n1013.held_in_words == (
        "free: radial motion; held: axial motion, tilt 0.5 mrad (load.tilt)"
    )
    shaft = {"load.axial_stiffness": "10 N/um", "load.tilt": "free"}
    sprung = n1013.replace({**shaft, "load.tilt_stiffness": "2000 N*m/rad"}).held_in_words
    assert sprung == (
        "free: radial motion, axial motion, tilt; shaft stiffness: axial 10 N/um, tilt 2000 N*m/rad"
    )
