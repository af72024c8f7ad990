"""A name that is nearly right gets a hint, wherever names are asked for; what flexcage has not is
declined by name; a path with TOML's backslashes is told how to be written."""

from __future__ import annotations

import pytest

from flexcage import load_case, load_static
from flexcage.core.binding import near_names
from flexcage.core.errors import InputError
from flexcage.results.registry import variable
from flexcage.results.row import SummaryRow
from flexcage.results.summary import Section, Summary

BEARING = '[bearing]\npreset = "N1013"\n'


def said(text, reader=load_case):
    with pytest.raises(InputError) as caught:
        reader(text)
    return str(caught.value)


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ('[bearing]\npreset = "n1013"', "the nearest is 'N1013'"),
        ('[bearing]\npreset = "7010C"', "the nearest is '7010C-PI' or '7010C-PA66'"),
        ('[bearing]\npreset = "N210"', "'flexcage new N210' writes such a case"),
        ('[bearing]\npreset = "51105"', "'51105' is a thrust ball bearing"),
        ('[bearing]\ntype = "needle"', "the nearest known one is 'needle_roller'"),
        ('[bearing]\ntype = "Deep Groove Ball"', "the nearest known one is 'deep_groove_ball'"),
        (BEARING + '[cage]\nmaterial = "Peek"', "the nearest known one is 'PEEK'"),
        (BEARING + '[cage]\nmaterial = "pa66 gf30"', "the nearest known one is 'PA66-GF30'"),
        (BEARING + '[cage]\nPocket_Width = "8 mm"', "the nearest known one is 'pocket_width'"),
        (BEARING + '[[defects]]\ntype = "CrossBeam"', "the nearest known one is 'crossbeam'"),
    ],
)
def test_a_near_name_gets_a_hint(text, words):
    assert words in said(text)


@pytest.mark.parametrize("reader", [load_case, load_static])
@pytest.mark.parametrize(
    ("text", "words"),
    [
        (BEARING + "[shaft]\nlength = 1", "no shaft that bends"),
        (BEARING + 'pair = "DB"', "pairs, sets and bearings of one shaft are a machine"),
        (BEARING + "[[bearings]]\na = 1", "is a machine, for it has [[bearings]]"),
        ('temperature = "70 degC"\n' + BEARING, "computes no heat"),
        (BEARING + '[load]\npreload = "100 N"', "a preload between bearings is that of a machine"),
        (BEARING + '[lubricant]\ntemperature = "70 degC"', "computes no heat"),
    ],
)
def test_what_flexcage_has_not_is_declined_where_people_look(reader, text, words):
    assert words in said(text, reader)


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("100Cr6", "'GCr15' is this steel"),
        ("AISI 52100", "'GCr15' is this steel"),
        ("SUJ2", "'GCr15' is this steel"),
        ("CuZn40Pb2", "'brass' is leaded brass"),
        ("DC04", "'steel' is sheet steel"),
        ("Brass", "the nearest known one is 'brass'"),
        ("silicon nitride", "'Si3N4' is silicon nitride"),
        ("zirconia", "'ZrO2' is zirconia"),
        ("CuSn8", "give its values: {name ="),
    ],
)
def test_a_material_of_another_norm_is_named(name, words):
    assert words in said(f'{BEARING}[cage]\nmaterial = "{name}"\n')
    assert words in said(f'{BEARING}material = "{name}"\n')


@pytest.mark.parametrize("reader", [load_case, load_static])
@pytest.mark.parametrize(
    ("preset", "other", "own"),
    [
        ("N1013", "deep_groove_ball", "cylindrical_roller"),
        ("7010C-PI", "cylindrical_roller", "angular_contact_ball"),
    ],
)
def test_a_type_that_is_not_the_presets_is_named(reader, preset, other, own):
    text = f'[bearing]\npreset = "{preset}"\ntype = "{other}"\n'
    assert said(text, reader) == (
        f"bearing.type is '{other}', but the preset {preset} is one of type '{own}'; leave out "
        "bearing.type, or bearing.preset."
    )
    assert load_case(text.replace(other, own)).bearing.type == own


def test_hints_do_not_depend_on_case_or_strokes():
    assert near_names("PEEK cf", ["PEEK", "PA66-GF30"], 1) == ["PEEK"]
    assert near_names("pa66gf30", ["PEEK", "PA66-GF30"], 1) == ["PA66-GF30"]
    assert near_names("xyz", ["PEEK"]) == []


def test_a_summary_names_the_nearest_figure():
    summary = Summary((Section("Speeds", (SummaryRow("cage_speed", "Cage speed", 1.0),)),))
    with pytest.raises(KeyError) as caught:
        summary["cage_sped"]
    text = "The summary has no figure 'cage_sped'; the nearest name is 'cage_speed'."
    assert str(caught.value) == text
    with pytest.raises(InputError, match="nearest known name is 'pocket_force'"):
        variable("Pocket_Forc")


@pytest.mark.parametrize(
    ("path", "words"),
    [
        (r"meshes\n1013.msh", r"\n as one; write the path in single quotes, 'meshes\n1013.msh'"),
        (r"C:\temp\x.msh", r"double quotes a backslash begins a special character"),
        (r"C:\Users\me\x.msh", "in single quotes, or with '/'"),
        (r"c:\tools\bodies.msh", r"\t as one; write the path in single quotes, 'c:\tools\bodies.m"),
    ],
)
def test_backslashes_of_a_path_are_explained(path, words):
    assert words in said(f'{BEARING}[mesh]\nfile = "{path}"\n')
