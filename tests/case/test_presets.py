"""Presets: the dimensions of the reference, and every assumption marked as one."""

from importlib import resources
from pathlib import Path

import pytest

from flexcage.case.presets import load_preset, preset_names, register_preset
from flexcage.core.errors import InputError

# value in SI, written out here a second time from the data of paper 000
N1013 = {
    "bearing": {
        "bore": 65e-3,
        "outside_diameter": 100e-3,
        "width": 18e-3,
        "inner_race_diameter": 74.5e-3,
        "outer_race_diameter": 90.5e-3,
        "roller_diameter": 8e-3,
        "roller_length": 8e-3,
        "effective_length": 7.3e-3,
        "roller_count": 22,
        "pitch_diameter": 82.5e-3,
        "radial_clearance": 20e-6,
        "rib_diameter": 78.4e-3,
        "rib_gap": 8.03e-3,
    },
    "cage": {
        "bore": 78.9e-3,
        "outside_diameter": 86.6e-3,
        "width": 16e-3,
        "pocket_width": 8.2e-3,
        "pocket_length": 8.25e-3,
        "side_beam_width": 3.875e-3,
    },
}


@pytest.mark.parametrize("room", N1013)
def test_n1013_has_its_dimensions(room):
    spec = getattr(load_preset("N1013"), room)
    assert {k: getattr(spec, k) for k in N1013[room]} == pytest.approx(N1013[room], rel=1e-12)


@pytest.mark.parametrize("name", preset_names())
def test_every_preset_is_possible(name):
    preset = load_preset(name)
    preset.bearing.check(preset.cage)


@pytest.mark.parametrize("name", preset_names())
def test_assumptions_are_marked_in_both_places(name):
    """A comment beside the value and a reason in the list, for the same values."""
    text = (resources.files("flexcage.case") / "data" / f"{name}.toml").read_text("utf-8")
    commented, table = set(), ""
    for line in text.splitlines():
        if line.startswith("["):
            table = line.strip("[]")
        key, sign, rest = line.partition("=")
        if sign and "assumption" in rest.partition("#")[2]:
            commented.add(f"{table}.{key.strip()}")
    assert commented == set(load_preset(name).assumptions)


def test_unknown_preset_names_the_nearest():
    with pytest.raises(InputError, match="'n1012' is not known; the nearest is 'N1013'; presets"):
        load_preset("n1012")


@pytest.mark.parametrize(
    ("wrong", "right", "words"),
    [
        (
            "[assumptions]",
            "[assumption]",
            "Unknown key 'assumption'; the nearest known one is 'ass",
        ),
        (
            "title =",
            "titel = 'x'\ntitle =",
            r"Unknown key 'titel' in \[preset\]; the nearest .*'title'",
        ),
        (
            "title =",
            "dynamic_ratng = '4 kN'\ntitle =",
            r"in \[preset\]; the nearest .*'dynamic_rating'",
        ),
    ],
)
def test_a_preset_s_misspelt_keys_are_told(tmp_path, wrong, right, words):
    """A rating of another name was left out without a word."""
    text = (Path(__file__).parents[1] / "examples/my_bearing.toml").read_text()
    (tmp_path / "mine.toml").write_text(text.replace(wrong, right, 1))
    with pytest.raises(InputError, match=f"In preset '.*mine.toml': .*{words}"):
        register_preset(tmp_path / "mine.toml")
