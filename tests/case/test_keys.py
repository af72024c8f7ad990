"""The list of keys is read from the specs: complete, true of every example, and as on its pages."""

import re
from pathlib import Path

import pytest

from flexcage.bearings import in_motion
from flexcage.case import Case, keys, load_case
from flexcage.case.keys import groups
from flexcage.case.presets import load_preset, preset_names
from flexcage.cli import main
from flexcage.core.binding import flat

EXAMPLES = Path(__file__).parents[2] / "examples"
LAWS = ("normal", "friction", "material")  # have sections of their own
LISTS = {"defects", "constraints", "sensors"}
IN_MOTION = [name for name in preset_names() if in_motion(type(load_preset(name).bearing))]


def known_paths():
    return {key.path for group in keys.groups() for key in group.keys}


def without_lists_and_laws(table):
    """Paths of a case's values; not those of laws and materials, which have sections of their own,
    nor of tables in lists."""
    for path, _ in flat(table):
        parts = path.split(".")
        if not any(part.isdigit() for part in parts):
            shared = [k for k, part in enumerate(parts) if part in LAWS]
            yield ".".join(parts[: shared[0] + 1] if shared else parts)


@pytest.mark.parametrize("preset", IN_MOTION)
def test_every_value_of_a_case_is_a_key(preset):
    paths = set(without_lists_and_laws(Case.from_preset(preset).to_table()))
    assert paths - LISTS - {"given"} <= known_paths()


def test_every_key_of_an_example_is_listed():
    case = load_case(EXAMPLES / "n1013.toml")
    listed = {
        key.path for group in keys.groups() if group.section == "defects" for key in group.keys
    }
    defect = case.to_table()["defects"][0]
    assert set(defect) - {"type"} <= listed


def test_a_key_shows_unit_default_bounds_and_choices():
    found = {key.path: key for group in keys.groups() for key in group.keys}
    assert found["drive.speed"].kind == "rpm"
    assert found["drive.speed"].default == "6000 rpm"
    assert "one of flexible, rigid" in found["cage.model"].meaning
    assert found["cage.bore"].default == keys.REQUIRED
    assert "3 to 128" in found["contacts.race.slices"].meaning
    assert found["contacts.pocket.slices"].default == "64"  # the place's default, not the spec's
    assert "restitution 0.7" in found["contacts.pocket.normal"].default


def test_a_law_registered_from_outside_has_its_keys(monkeypatch):
    from dataclasses import dataclass

    from flexcage.contacts import spec
    from flexcage.core.spec import quantity

    @dataclass(frozen=True, kw_only=True)
    class Soft(spec.NormalLaw):
        law: str = "soft_for_keys"
        softness: float = quantity("um/N", doc="yield of a wall", above=0.0)

    monkeypatch.setitem(spec.NORMAL_LAWS, "soft_for_keys", Soft)
    found = {key.path: key for group in keys.chosen("normal") for key in group.keys}
    assert found["softness"].kind == "um/N" and found["softness"].default == keys.REQUIRED


def test_a_text_finds_keys(capsys):
    assert main(["keys", "clearance"]) == 0
    shown = capsys.readouterr().out
    assert "bearing.radial_clearance" in shown and "contacts.land.clearance" in shown
    assert "drive.speed" not in shown


def test_sections_come_without_an_argument(capsys):
    assert main(["keys"]) == 0
    shown = capsys.readouterr().out
    assert all(f"\n  {section}" in shown for section in ("bearing", "solver", "friction"))


def test_a_text_that_no_key_has_is_one_sentence(capsys):
    assert main(["keys", "solvr"]) == 2
    assert "the nearest known one is 'solver'" in capsys.readouterr().err
    assert main(["variables", "pocket_forc_"]) == 2
    assert "pocket_force" in capsys.readouterr().err
    assert main(["figures", "cage_sped"]) == 2
    assert "the nearest name is 'cage_speed'" in capsys.readouterr().err
    assert main(["figures", "spall"]) == 2
    said = capsys.readouterr().err
    assert said == "flexcage: No figure has the text 'spall'; 'flexcage figures' lists all.\n"


def test_the_keys_of_a_material_name_those_that_there_are(capsys):
    assert main(["keys", "material"]) == 0
    shown = capsys.readouterr().out
    assert all(name in shown for name in ("GCr15", "PEEK", "PA46-GF30 conditioned"))


@pytest.mark.parametrize(
    "page",
    [
        "keys_bearing.md",
        "keys_cage.md",
        "keys_motion.md",
        "keys_fits.md",
        "keys_sensors.md",
        "variables.md",
        "figures.md",
    ],
)
def test_a_page_is_what_its_command_prints(page, tmp_path):
    text = (EXAMPLES / page).read_text("utf-8")
    command = re.search(r"`flexcage ([^`]*)`", text)[1].split()
    assert main([*command, "-o", str(tmp_path / page)]) == 0
    assert (tmp_path / page).read_text("utf-8") == text


def test_a_page_lists_keys_alone():
    """What a class says of itself beside its fields is no key."""
    every = {key.path for group in groups() for key in group.keys}
    assert "bearing.element_material" in every and "elsewhere" not in every


def test_the_pages_hold_every_section():
    text = "".join(
        (EXAMPLES / f"keys_{part}.md").read_text("utf-8")
        for part in ("bearing", "cage", "motion", "fits", "sensors")
    )
    named = re.findall(r"^Printed by `flexcage keys (.*)`", text, re.MULTILINE)
    assert sorted(" ".join(named).split()) == sorted({g.section for g in keys.groups()})
