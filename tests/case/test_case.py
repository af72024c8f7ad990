"""Cases: from text and objects, varied, written back, hashed."""

import dataclasses
from math import pi
from pathlib import Path

import numpy as np
import pytest

from flexcage.cages.window.defects import CrossbeamDefect, SideBeamDefect
from flexcage.case import Case, load_case
from flexcage.case.checks import not_reached
from flexcage.contacts.spec import FrictionLaw
from flexcage.core.errors import InputError
from flexcage.geometry.materials import MATERIALS

EXAMPLE = Path(__file__).parents[2] / "examples" / "n1013.toml"
MINIMAL = '[bearing]\npreset = "N1013"\n'


@pytest.fixture(scope="module")
def case():
    return load_case(EXAMPLE)


def test_the_main_job(case):
    assert case.drive.speed == pytest.approx(200.0 * pi)
    assert case.load.radial == 1000.0
    assert case.solver.duration == 0.1
    assert case.cage_model == "flexible" and case.cage.material is MATERIALS["brass"]
    (defect,) = case.defects
    assert defect == CrossbeamDefect(crossbeam=5, displacement=0.2e-3, shape="bent")
    assert case.bearing.roller_count == 22
    assert "N1013" in repr(case) and "6000 rpm" in repr(case) and case.hash in repr(case)


def test_file_text_and_tables_are_the_same(case):
    import tomllib

    text = EXAMPLE.read_text("utf-8")
    assert load_case(str(EXAMPLE)) == load_case(text) == load_case(tomllib.loads(text)) == case


def test_a_section_without_a_place_in_the_order_is_written_too(case, monkeypatch):
    monkeypatch.setattr("flexcage.case.case._ORDER", ("bearing", "name"))
    assert list(case.to_table())[:2] == ["bearing", "name"]
    assert load_case(case.to_toml()) == case


def test_round_trip_through_text(case):
    rich = case.replace(
        **{
            "defects": [
                CrossbeamDefect(crossbeam=1, displacement=-1e-4 / 3, shape="shifted"),
                SideBeamDefect(pocket=2, displacement=1e-4, side="-x"),
            ],
            "cage.material": {"name": "PEEK", "density": "1400 kg/m^3"},
            "limits.stress": "200 MPa",
            "drive.times": ["0 s", "10 ms"],
            "drive.speeds": ["0 rpm", "6000 rpm"],
            "modes.ratios": [0.01, 0.02],
            "modes.bands": [{"low": "0 Hz", "high": "5 kHz", "ratio": 0.02}],
            "description": 'quotes " and \\ and\nlines, and µ',
            "cage.model": "rigid",
        }
    )
    for one in (case, rich):
        again = load_case(one.to_toml())
        assert again == one and again.hash == one.hash


def test_text_of_a_case_is_complete():
    """Nothing is left to defaults, so that a later version with other defaults runs the same."""
    case = load_case(MINIMAL)
    for field in dataclasses.fields(case.solver):
        assert field.name in case.to_table()["solver"]


def test_a_preset_is_a_base_that_text_overrides():
    case = load_case(
        MINIMAL + 'roller_count = 21\neffective_length = "7.64 mm"\n'
        '[cage]\npocket_width = "8.15 mm"\n'
    )
    assert case.bearing.roller_count == 21 and case.bearing.effective_length == 7.64e-3
    assert case.cage.pocket_width == 8.15e-3 and case.cage.pocket_length == 8.25e-3


def test_part_of_a_named_material_is_overridden():
    brass = load_case(MINIMAL + '[cage.material]\ndensity = "8400 kg/m^3"\n').cage.material
    assert brass == dataclasses.replace(MATERIALS["brass"], density=8400.0)


def test_variation_leaves_the_original_alone(case):
    varied = case.replace("defects.0.displacement", "0.1 mm")
    assert varied.defects[0].displacement == 0.1e-3
    assert case.defects[0].displacement == 0.2e-3
    assert varied.hash != case.hash


def test_an_entry_of_a_list_becomes_another_kind(case):
    side = {"defects.0.type": "side_beam", "defects.0.pocket": 2, "defects.0.side": "-x"}
    (bent,) = case.replace({**side, "defects.0.displacement": "0.1 mm"}).defects
    assert bent == SideBeamDefect(pocket=2, side="-x", displacement=0.1e-3)
    (same,) = case.replace({"defects.0.type": "crossbeam", "defects.0.crossbeam": 7}).defects
    assert same == dataclasses.replace(case.defects[0], crossbeam=7)
    with pytest.raises(InputError, match="lacks 'displacement'"):
        case.replace(side)


@pytest.mark.parametrize(
    ("path", "value", "expected"),
    [
        ("cage.pocket_width", "8.25 mm", 8.25e-3),
        ("cage.pocket_width", 8.25e-3, 8.25e-3),
        ("bearing.roller_count", 21, 21),
        ("cage.material", "PEEK", MATERIALS["PEEK"]),
        ("cage.material", "steel", MATERIALS["steel"]),
        ("contacts.pocket.friction", FrictionLaw(static=0.2), FrictionLaw(static=0.2)),
        ("contacts.pocket.friction.static", 0.2, 0.2),
        ("defects", [], ()),
        ("limits.stress", "300 MPa", 300e6),
    ],
)
def test_replace_takes_text_si_and_objects(case, path, value, expected):
    changed = case.replace(path, value)
    found = changed
    for key in path.split("."):
        found = getattr(found, key)
    assert found == expected
    assert case.replace(**{path: value}) == changed


@pytest.mark.parametrize(
    ("path", "value", "plain"),
    [
        ("modes.crossbeams", np.bool_(False), False),
        ("modes.count", np.int64(12), 12),
        ("modes.damping", np.float32(0.5), 0.5),
        ("load.radial", np.float32(800.0), 800.0),
        ("load.radial", np.int16(800), 800.0),
        ("modes.ratios", np.array([0.25, 0.5], np.float32), (0.25, 0.5)),
    ],
)
def test_replace_takes_numbers_of_numpy(case, path, value, plain):
    changed = case.replace(path, value)
    room, key = path.split(".")
    found = getattr(getattr(changed, room), key)
    assert found == plain and type(found) is type(plain)
    assert changed == case.replace(path, plain) == load_case(changed.to_toml())


def test_a_spec_of_objects_takes_numpys_truth(case):
    one, other = (dataclasses.replace(case.modes, crossbeams=v) for v in (np.bool_(False), False))
    mine, plain = (dataclasses.replace(case, modes=modes) for modes in (one, other))
    assert mine.hash == plain.hash and load_case(mine.to_toml()) == plain


def test_numbers_of_numpy_of_another_kind_are_refused(case):
    for path, value in (("modes.count", np.float64(3.0)), ("modes.land", np.int64(1))):
        with pytest.raises(InputError, match=f"{path} is {value.item()}, but should be"):
            case.replace(path, value)


def test_changes_that_only_fit_together_are_made_together(case):
    both = {"cage.bore": "79 mm", "contacts.land.clearance": "0.3 mm"}
    assert case.replace(both) == case.replace(**both) != case
    assert case.replace(both).cage.bore == 79e-3
    stated = case.replace("contacts.land.clearance", "0.25 mm")
    with pytest.raises(InputError, match="0.25 mm, but cage.bore and .* leave 0.3 mm"):
        stated.replace("cage.bore", "79 mm")


@pytest.mark.parametrize(
    ("given", "words"),
    [((5, 3), "dotted paths, .* not 5"), (({"load.radial": "1 N"}, 3), "a table .*, not also 3")],
)
def test_replace_says_what_it_takes(case, given, words):
    with pytest.raises(InputError, match=words):
        case.replace(*given)


def test_partial_override_keeps_the_places_own_default():
    """A pocket's restitution is 0.7 where another place's is 0.9; friction alone is changed."""
    case = load_case(MINIMAL + "[contacts.pocket.friction]\nstatic = 0.15\n")
    assert case.contacts.pocket.friction.static == 0.15
    assert (
        case.contacts.pocket.normal.restitution
        == load_case(MINIMAL).contacts.pocket.normal.restitution
    )


def test_names_and_words_do_not_change_the_hash(case):
    assert case.replace(name="other", description="words").hash == case.hash
    assert case.replace("load.radial", "1 kN").hash == case.hash
    assert case.replace("load.radial", "1001 N").hash != case.hash
    assert case.replace("cage.model", "rigid").hash != case.hash


def test_attachments_count_where_there_are_any(case):
    assert case.replace("modes.attachments", "linear").hash != case.hash
    rigid = case.replace("cage.model", "rigid")
    assert rigid.replace("modes.attachments", "linear").hash == rigid.hash
    ball = load_case('[bearing]\npreset = "7010C-PI"\n[load]\naxial = "100 N"\n')
    assert ball.replace("modes.attachments", "linear").hash == ball.hash


def test_hash_counts_the_bytes_of_a_mesh_file(tmp_path):
    (tmp_path / "case.toml").write_text(MINIMAL + '[mesh]\nfile = "cage.msh"\n')
    (tmp_path / "cage.msh").write_text("one")
    first = load_case(tmp_path / "case.toml")
    assert first.mesh.file == str(tmp_path / "cage.msh")
    hash_of_one = first.hash
    (tmp_path / "cage.msh").write_text("two")
    assert load_case(tmp_path / "case.toml").hash != hash_of_one


def test_built_from_objects(case):
    built = Case(bearing=case.bearing, cage=case.cage, drive=case.drive)
    assert built.defects == () and built.contacts == Case.from_preset("N1013").contacts
    defect = CrossbeamDefect(crossbeam=5, displacement=0.2e-3)
    same = Case.from_preset("N1013", defects=[defect], load={"radial": 1000.0})
    assert same.replace(solver=case.solver, drive=case.drive).hash == case.hash
    with pytest.raises(InputError, match="numbered 0 to 21"):
        Case(
            bearing=case.bearing,
            cage=case.cage,
            defects=(CrossbeamDefect(crossbeam=22, displacement=0.0),),
        )


def test_assumptions_are_told_until_they_are_replaced(case):
    assert "cage.pocket_width" in case.assumptions
    assert "cage.pocket_width" not in case.replace("cage.pocket_width", "8.25 mm").assumptions
    assert "modes.damping" in case.assumptions


def test_what_slip_follows_from_is_an_assumption_with_its_reason(case):
    """Lubricant, traction, rolling resistance, oil, pocket friction, restitution at every place."""
    told = case.assumptions
    named = [f"lubricant.{f.name}" for f in dataclasses.fields(case.lubricant)]
    named += [f"contacts.race.friction.{key}" for key in ("peak", "peak_speed", "high_speed")]
    for place in ("pocket", "side", "rib", "land"):
        named += [f"contacts.{place}.friction.{key}" for key in ("static", "dynamic", "v_static")]
    named += [f"contacts.{place}.normal.restitution" for place in ("race", "pocket", "land")]
    assert all(told.get(path) for path in named), set(named) - set(told)


def test_only_values_that_the_chosen_law_reads_are_assumptions(case):
    assert "contacts.race.friction.static" not in case.assumptions
    assert "contacts.pocket.friction.peak" not in case.assumptions
    film = case.replace("contacts.race.friction.law", "ehl").assumptions
    assert "contacts.race.friction.creep_speed" in film
    assert "contacts.race.friction.peak" not in film
    elastic = case.replace("contacts.pocket.normal.law", "elastic").assumptions
    assert "contacts.pocket.normal.restitution" not in elastic
    own = case.replace("contacts.pocket.normal.restitution", 0.9).assumptions
    assert "contacts.pocket.normal.restitution" not in own  # though races have it by default


def test_overrides_want_units(case):
    assert load_case(EXAMPLE, overrides={"load.radial": "2 kN"}).load.radial == 2000.0
    with pytest.raises(InputError, match="'2000 N'"):
        load_case(EXAMPLE, overrides={"load.radial": 2000})


def test_a_mesh_file_is_found_from_anywhere(tmp_path, monkeypatch):
    """Given in a change, it is relative to where the user stands; its place is no physics."""
    (tmp_path / "cage.msh").write_bytes(b"one")
    monkeypatch.chdir(tmp_path)
    case = load_case(MINIMAL, overrides={"mesh.file": "cage.msh"})
    assert case.mesh.file == str(tmp_path / "cage.msh")
    assert Case.from_preset("N1013", mesh={"file": "cage.msh"}).mesh.file == case.mesh.file
    assert load_case(case.to_toml()) == case
    (tmp_path / "elsewhere").mkdir()
    (tmp_path / "elsewhere" / "other.msh").write_bytes(b"one")
    assert case.replace("mesh.file", "elsewhere/other.msh").hash == case.hash
    assert case.replace("mesh.file", "").mesh.file == ""


def test_values_that_only_fit_together_may_be_replaced_in_any_order():
    case = Case.from_preset("N1013")
    for names in (("rate", "vibration_rate"), ("vibration_rate", "rate")):
        new = case.replace(**{f"output.{n}": "300 kHz" for n in names})
        assert new.output.vibration_ratio == 1


@pytest.mark.parametrize(
    ("changes", "told"),
    [
        ({"load.ramp_start": "99 ms"}, []),
        ({"load.ramp_start": "200 ms"}, ["load.ramp_start is 200 ms, but the run ends at 100 ms"]),
        ({"solver.duration": "5 ms"}, ["load.ramp_start is 10 ms", "drive.times begins at 20 ms"]),
    ],
)
def test_what_a_run_does_not_reach_is_told(case, changes, told):
    ramp = {"load.ramp_to": "2 kN", "load.ramp_start": "10 ms", "load.ramp_time": "5 ms"}
    table = {"drive.times": ["20 ms", "30 ms"], "drive.speeds": ["6000 rpm", "7000 rpm"]}
    found = list(not_reached(case.replace({**ramp, **table, **changes})))
    assert len(found) == len(told) and all(b in a for a in found for b in told if b[:5] in a)


def test_a_difference_in_a_list_names_its_entries_alone():
    bent = load_case("examples/n1013.toml")
    found = bent.difference(bent.replace("defects", ()))
    assert "defects.0.displacement" in found and "defects" not in found
    assert found["defects.0.crossbeam"][1] is None


@pytest.mark.parametrize("path", ["preset", "bearing.preset"])
def test_a_preset_cannot_be_replaced(case, path):
    """The name alone would be, and a case say another bearing than it has."""
    with pytest.raises(InputError, match="write a case for each preset"):
        case.replace(path, "7010C-PI")
    with pytest.raises(InputError, match="write a case for each preset"):
        case.replace(**{path: "N1013"})


@pytest.mark.parametrize(
    ("assign", "sentence"),
    [
        (lambda case: setattr(case, "name", "x"), 'case = case.replace("name", value).'),
        (lambda case: setattr(case.load, "radial", 5.0), 'case.replace("load.radial", value).'),
        (lambda case: setattr(case.cage, "width", 1.0), 'case.replace("cage.width", value).'),
        (lambda case: delattr(case.drive, "speed"), 'case.replace("drive.speed", value).'),
        (
            lambda case: setattr(case.cage.material, "density", 1.0),
            "density of a Material was to be set",
        ),
        (
            lambda case: setattr(case.contacts.pocket.normal, "law", "x"),
            "case.replace(...), with the path of this value.",
        ),
        (
            lambda case: setattr(case.defects[0], "displacement", 1.0),
            "displacement of a CrossbeamDefect was to be set",
        ),
    ],
)
def test_a_value_that_is_assigned_is_told_how_to_be_changed(case, assign, sentence):
    before = case.hash, case.load.radial
    with pytest.raises(InputError) as caught:
        assign(case)
    assert sentence in str(caught.value)
    assert isinstance(caught.value, dataclasses.FrozenInstanceError)
    assert (case.hash, case.load.radial) == before
    assert case.replace("load.radial", "5 N").load.radial == 5.0
