"""Absurd input: numbers beyond all floats, texts and brackets without end. One sentence each."""

from __future__ import annotations

import random

import pytest

from flexcage.case import load_case
from flexcage.core.binding import flat
from flexcage.core.errors import InputError

ROLLERS, BALLS = '[bearing]\npreset = "N1013"\n', '[bearing]\npreset = "7010C-PI"\n'
LONGEST = 500  # characters of a sentence about values of any length

ABSURD = {
    "no float is as large": (
        ROLLERS + '[cage]\nbore = "1e999999999999999999999 mm"',
        "cage.bore",
        ["'1e999999999999999999999 mm'", "too large"],
    ),
    "digits without end": (f"seed = {'1' * 4400}\n" + ROLLERS, "case", ["thousands of digits"]),
    "no word is as long": (f"seed = {'1' * 4200}\n" + ROLLERS, "seed", ["about 4199 digits"]),
    "lists in lists": (f"x = {'[' * 1500}{']' * 1500}\n" + ROLLERS, "case", ["20 deep", "bracket"]),
    "lists within Python's depth": (f"x = {'[' * 99}{']' * 99}\n" + ROLLERS, "case", ["20 deep"]),
    "tables in tables": (f"a{'.a' * 3000} = 1\n" + ROLLERS, "case", ["20 deep"]),
    "longer than the universe": (
        ROLLERS + '[solver]\nduration = "1e299 s"',
        "solver.duration",
        ["1e+299 s", "or less"],
    ),
    "more samples than a disk holds": (
        ROLLERS + '[solver]\nduration = "1e5 s"',
        "solver.duration",
        ["5e+09 samples of output.rate", "2000 s or less"],
    ),
    "vibration without end": (
        ROLLERS + '[solver]\nduration = "999 s"',
        "solver.duration",
        ["output.vibration_rate", "500 s or less"],
    ),
    "samples of light": (
        ROLLERS + '[output]\nrate = "1 THz"',
        "output.rate",
        ["10000 kHz or less"],
    ),
    "name of a file": (
        ROLLERS + f'[mesh]\nfile = "{"a" * 5000}.msh"',
        "mesh.file",
        ["characters)", "too long"],
    ),
    "home of nobody": (
        ROLLERS + '[mesh]\nfile = "~nobody_at_all/x.msh"',
        "mesh.file",
        ["'~nobody_at_all/x.msh'", "no user"],
    ),
    "NUL in a name": ('name = "a\\u0000b"\n' + ROLLERS, "name", [r"'a\x00b'", "NUL"]),
    "NUL in a file's name": (ROLLERS + '[mesh]\nfile = "a\\u0000.msh"', "mesh.file", ["NUL"]),
    "NUL in words": ('description = "a\\u0000b"\n' + ROLLERS, "description", ["NUL"]),
    "bell in a name": ('name = "a\\u0007b"\n' + ROLLERS, "name", [r"'a\x07b'", "a folder"]),
    "name of a folder": (f'name = "{"n" * 300}"\n' + ROLLERS, "name", ["300 bytes", "200"]),
    "groove as wide as a house": (
        BALLS + 'inner_groove_radius = "3332 mm"',
        "bearing.inner_groove_radius",
        ["3332 mm", "no groove", "9.525 mm or less"],
    ),
    "balls of any size": (
        BALLS + 'ball_scatter = "1 m"',
        "bearing.ball_scatter",
        ["1000 mm", "0.09525 mm or less"],
    ),
    "fillet of an atom": (
        ROLLERS + '[cage]\nfillet_radius = "5e-7 mm"',
        "cage.fillet_radius",
        ["5e-07 mm", "sharp corner", "0.00082 mm"],
    ),
    "stiffness": (
        ROLLERS + "[contacts.race.normal]\nstiffness_factor = 1e300",
        "contacts.race.normal.stiffness_factor",
        ["1e+300", "1e+06 or less"],
    ),
    "friction": (
        ROLLERS + "[contacts.pocket.friction]\nstatic = 1e299",
        "contacts.pocket.friction.static",
        ["1e+299", "100 or less"],
    ),
    "stress of no body": (
        ROLLERS + '[limits]\nstress = "-1 MPa"',
        "limits.stress",
        ["-1 MPa", "greater than 0 MPa"],
    ),
    "a cage shot off": (
        ROLLERS + '[start]\npush = "1e12 mm/s"',
        "start.push",
        ["1e+12 mm/s", "10000 mm/s or less"],
    ),
    "a thin oil": (
        ROLLERS + '[lubricant]\nviscosity = "1e-200 Pa*s"',
        "lubricant.viscosity",
        ["1e-200 Pa*s", "1e-09 Pa*s or more"],
    ),
    "gravity": (
        ROLLERS + '[load]\ngravity = "1e30 m/s^2"',
        "load.gravity",
        ["1e+06 m/s^2 or less"],
    ),
    "pull of a star": (ROLLERS + '[load]\naxial = "-1e30 N"', "load.axial", ["-1e+09 N or more"]),
    "endless choice": (
        ROLLERS + f'[cage]\nguidance = "{"x" * 100_000}"',
        "cage.guidance",
        ["(100002 characters)", "choose from roller"],
    ),
    "endless key": (ROLLERS + f"[cage]\n{'x' * 100_000} = 1", None, ["characters)", "in [cage]"]),
    "endless words": (
        ROLLERS + f'[cage]\nmaterial = "{"x y " * 30_000}"',
        "cage.material",
        ["(120002 characters)", "known are"],
    ),
    "endless unit": (ROLLERS + f'[cage]\nbore = "1 {"m*" * 9999}m"', "cage.bore", ["known unit"]),
    "endless number": (ROLLERS + f'[cage]\nbore = "{"1" * 9999} m"', "cage.bore", ["too large"]),
    "endless preset": (f'[bearing]\npreset = "{"N" * 100_000}"', "bearing.preset", ["presets are"]),
}


@pytest.mark.parametrize("name", ABSURD)
def test_absurd_input_is_one_sentence_of_sensible_length(name):
    text, where, words = ABSURD[name]
    with pytest.raises(InputError) as caught:
        load_case(text + "\n")
    sentence = str(caught.value)
    assert len(sentence) < LONGEST and sentence.endswith(".") and "\n" not in sentence, sentence
    assert all(word in sentence for word in words), sentence
    assert where is None or caught.value.where == where


def test_a_file_that_no_name_can_have(tmp_path):
    for name in ("a\0b.toml", "a" * 5000 + ".toml", "~nobody_at_all/case.toml"):
        with pytest.raises(InputError) as caught:
            load_case(tmp_path / name if name[0] != "~" else name)
        assert len(str(caught.value)) < LONGEST


def test_numbers_of_python_have_bounds_too():
    case = load_case(ROLLERS)
    for path, value in (("seed", 10**30), ("load.radial", 10**400), ("load.axial", float("nan"))):
        with pytest.raises(InputError) as caught:
            case.replace(path, value)
        assert caught.value.where == path


VALUES = [
    "1e300 mm", "-1e300 N", "1e-300 mm", "0 mm", "-5 s", "inf rpm", "nan", "", "none", "\0", "1 Hz",
    "1 rad", "1e9999999999999 MPa", "x" * 9999, "ж" * 999, "a\nb", "../..", "~x/y",
    0, -1, 10**18, 10**30, 1e300, -1e300, 1e-300, float("inf"), float("nan"), True, [], [[]], {},
    ["1 s"] * 300, [1e300, -1e300], {"type": "x"}, {"a": {"b": {}}}, "1e20 mm", "1e12 rpm",
]  # fmt: skip


@pytest.mark.parametrize("preset", ["N1013", "7010C-PI", "15x37x10", "7603025"])
def test_any_value_at_any_key_gives_a_case_or_one_sentence(preset):
    case = load_case(f'[bearing]\npreset = "{preset}"\n')
    rng = random.Random(preset)
    for path, _ in flat(case.to_table()):
        for value in rng.sample(VALUES, 3):
            try:
                case.replace({path: value}, si=False)
            except InputError as exc:
                sentence = str(exc)
                assert len(sentence) < LONGEST and "\n" not in sentence, (path, value, sentence)
