"""What makers write before and after a number: every part is read for what it means, or named as
left out; and large bearings by their dimensions."""

from __future__ import annotations

import re

import pytest

from flexcage.case import catalogue, load_case
from flexcage.case.catalogues import rows
from flexcage.case.designation import meanings, prefixes, read
from flexcage.case.new import new_case
from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.geometry.cage import cages_of
from flexcage.geometry.materials import MATERIALS
from flexcage.geometry.other_kinds import kind_of


def written(designation, **options):
    entry = catalogue.find(designation)
    made = new_case(entry.outline, entry.source, **options)
    return made, load_case(made.text)


@pytest.mark.parametrize(
    ("designation", "parts"),
    [
        ("NU210-E-TVP2", ("NU210", ("E", "TVP2"))),  # once read as ET, V (no cage) and P2
        ("NU210ETVP2", ("NU210", ("E", "TVP2"))),
        ("NU 210 ECP/C3", ("NU210", ("EC", "P", "C3"))),
        ("NU210ET2", ("NU210", ("E", "T2"))),
        ("7208 BECBP", ("7208B", ("E", "CB", "P"))),
        ("7010 CD/HCP4A", ("7010C", ("D", "HC", "P4A"))),
        ("7010CTYNSULP4", ("7010C", ("TYN", "SUL", "P4"))),
        ("6205-2RSLTN9/HC5C3", ("6205", ("2RSL", "TN9", "HC5", "C3"))),
        ("6204LLUC3", ("6204", ("LLU", "C3"))),
        ("6205 P63", ("6205", ("P6", "C3"))),
        ("6302-Z/C2", ("6302", ("Z", "C2"))),
        ("608-2Z", ("608", ("2Z",))),
        ("NU 2210 EC", ("NU2210", ("EC",))),
        ("6805ZZ", ("61805", ("ZZ",))),
        ("NJ2308-VH", ("NJG2308", ("VH",))),
        ("NJ2308 EC", ("NJ2308", ("EC",))),
        ("62/22-2RS1", ("62/22", ("2RS1",))),  # 22 mm; 6222 has 110 mm
        ("NU 210/C3", ("NU210", ("C3",))),
    ],
)
def test_parts_of_a_designation(designation, parts):
    found = read(designation)
    assert (found.bare, found.marks) == parts and not found.unknown


@pytest.mark.parametrize(
    ("designation", "group"),
    [("6205-2RS C3", "C3"), ("NU 210 C2", "C2"), ("6205 CN", "CN"), ("6205/C5", "C5"),
     ("6210-2Z/C3HT51", "C3"), ("6205 P64", "C4"), ("6205", None), ("7010 CD/P4A", None)],
)  # fmt: skip
def test_the_class_of_clearance_stands_in_one_place(designation, group):
    assert read(designation).clearance_class == group


@pytest.mark.parametrize(
    "designation",
    ["7010 CD/HCP4A", "6205-2RSLTN9/HC5C3", "HCB7010-C-T-P4S", "5S-7010C", "3NC6205", "NU 210/HC5"],
)
def test_hybrid_bearings_have_balls_and_rollers_of_silicon_nitride(designation):
    made, case = written(designation)
    bearing = case.bearing
    assert bearing.rolling_material == MATERIALS["Si3N4"] and bearing.material.name == "GCr15"
    assert 'element_material = "Si3N4"' in made.text
    assert not any("left out" in t for t in made.outline.left_out if "silicon" in t)


@pytest.mark.parametrize(
    ("designation", "kind", "material"),
    [
        ("NU 210 ECP", "window", "PA66-GF25"),
        ("NU 210 ECPH", "window", "PEEK"),
        ("NU 210 ECM", "window", "brass"),
        ("7208 BEP", "machined", "PA66-GF25"),
        ("7208 BEM", "machined", "brass"),
        ("6205 TN9", "crown", "PA66-GF25"),
        ("6205 TNH", "crown", "PEEK"),
        ("6205-TVH", "crown", "PA66-GF25"),
        ("6205 M", "machined", "brass"),
        ("6205 J", "ribbon", "steel"),
        ("6205 Y", "ribbon", "brass"),
        ("6205", "ribbon", "steel"),
    ],
)
def test_a_mark_chooses_type_and_material_of_the_cage(designation, kind, material):
    made, case = written(designation)
    assert case.cage.cage_type == kind and case.cage.material == MATERIALS[material]
    if designation != "6205":
        assert re.search(r'^material = ".*# given: ', made.text, flags=re.M)
        assert any(text.endswith(", as the case here has it.") for text in made.outline.left_out)


def test_an_option_comes_before_a_mark_and_a_form_that_flexcage_has_not_is_left_out():
    made, case = written("6205 TN9", cage="ribbon")
    assert case.cage.cage_type == "ribbon" and case.cage.material.name == "steel"
    made, case = written("7208 BEJ")  # pressed: none of angular contact bearings is described
    assert case.cage.cage_type == "machined" and case.cage.material.name == "PA66"
    assert "J: a pressed steel cage, the cage here is of a common form" in made.text


def test_a_marked_cage_without_a_place_gives_way_to_a_common_one(monkeypatch):
    from flexcage.cages.crown import proposal

    monkeypatch.setattr(proposal, "_THINNEST", 0.5)
    made, case = written("6205 TN9")
    assert case.cage.cage_type == "ribbon"
    assert "TN9: a cage of glass fibre reinforced polyamide PA66; none of usual" in made.text


def test_what_is_not_known_is_named_as_left_out():
    made, _ = written("6205-2Z/C3HT51 QX")
    assert made.outline.left_out[1:] == (
        "HT51: not known to flexcage, and left out.",
        "QX: not known to flexcage, and left out.",
    )
    with pytest.raises(InputError, match="'6205QX' has 'QX' beside '6205', which flexcage does"):
        catalogue.find("6205QX")


@pytest.mark.parametrize(
    ("designation", "marks", "unknown"),
    [
        ("6205-2RS1/C3VT143", ("2RS1", "C3"), ("VT143",)),  # a grease: not V, without a cage
        ("6205 C6", (), ("C6",)),
        ("6205-2RSTN9XY", (), ("2RSTN9XY",)),
        ("6205-2RS T1X", ("2RS",), ("T1X",)),
    ],
)
def test_a_mark_is_not_taken_out_of_another(designation, marks, unknown):
    found = read(designation)
    assert (found.marks, found.unknown) == (marks, unknown)


def test_a_bore_behind_a_stroke_is_in_millimetres():
    assert 1e3 * catalogue.known("62/22")["bore"] == pytest.approx(22.0)
    for text in ("618/8", "60/500", "62/222"):
        with pytest.raises(InputError, match="is not in the catalogue"):
            catalogue.find(text)


def test_two_bearings_are_refused():
    with pytest.raises(InputError, match="'6205, 6206' names two bearings; give one"):
        catalogue.find("6205, 6206")


@pytest.mark.parametrize("name", ["NJ2310", "NU 2210 ECP", "6216"])
def test_a_preset_that_a_catalogue_knows_by_dimensions_is_answered_so(name):
    with pytest.raises(InputError) as caught:
        load_case({"bearing": {"preset": name}})
    assert f"'flexcage new {name}' writes such a case, from your maker's" in str(caught.value)


def test_stainless_steel_is_named():
    for name in ("W 6205-2RS1", "S6205-2RSR", "SS6205"):
        made, _ = written(name)
        assert "stainless steel" in made.outline.left_out[0]


@pytest.mark.parametrize(
    ("name", "kind"),
    [("4206-2RS", "a double row deep groove ball bearing"),
     ("RNU 210", "a cylindrical roller bearing without an inner ring"),
     ("LM11949", "a tapered roller bearing in inches"), ("7208 BDU", "a set of bearings (DU)"),
     ("7010 CD/P4ADGA", "a set of bearings (DG)")],
)  # fmt: skip
def test_further_bearings_are_declined_by_kind(name, kind):
    assert kind_of(name).startswith(f"is {kind}") and "flexcage new" not in kind_of(name)


def test_dimensions_reach_a_bore_of_200_mm():
    """ISO 15: bores are five times the code; outside diameter and width grow with them."""
    sizes = {}
    for row in rows("boundary"):
        bore, outside, width = (
            float(row[f"{key}_mm"]) for key in ("bore", "outside_diameter", "width")
        )
        assert bore < outside
        if not row["diameter_series"].isdigit():
            continue  # needle roller bearings, which are as wide as they like
        assert width < outside
        sizes.setdefault(row["diameter_series"], []).append((bore, outside, width))
    for name, found in sizes.items():
        assert found == sorted(found), name
        assert all(a[1] < b[1] and a[2] <= b[2] for a, b in zip(found, found[1:])), name
    for name in ("0", "2", "3", "00", "18", "19", "22", "23", "30"):
        assert sizes[name][-1][0] == 200.0
    for wide, narrow in (("22", "2"), ("23", "3"), ("30", "0"), ("00", "0")):
        outside = {bore: D for bore, D, _ in sizes[wide]}
        shared = [(bore, D) for bore, D, _ in sizes[narrow] if bore in outside]
        assert len(shared) > 15 and all(outside[bore] == D for bore, D in shared)


def test_groups_of_clearance_reach_a_bore_of_200_mm():
    for name in ("6040 C3", "NU 240 C4"):
        sizes = catalogue.known(name)
        assert 1e3 * sizes["bore"] == 200.0
    for row in rows("clearance"):
        groups = [[int(x) for x in row[g].split("-")] for g in ("C2", "CN", "C3", "C4", "C5")]
        lows, highs = zip(*groups)
        assert list(lows) == sorted(lows) and list(highs) == sorted(highs)
    assert row["to_mm"] == "200"


@pytest.mark.parametrize(
    ("designation", "dynamic", "static", "inside"),
    [
        ("6216 C3", "72.5 kN", "53 kN", None),
        ("6240", "270 kN", "310 kN", None),
        ("608-2Z", "3.3 kN", "1.37 kN", (7, 3.969e-3)),  # seven balls of 5/32 in
    ],
)
def test_ratings_alone_describe_a_bearing_of_known_dimensions(
    designation, dynamic, static, inside, tmp_path, monkeypatch, capsys
):
    monkeypatch.chdir(tmp_path)
    assert main(["new", designation, "--dynamic", dynamic, "--static", static, "-o", "a.toml"]) == 0
    bearing = load_case("a.toml").bearing
    assert "given by the user; dimensions of ISO 15" in capsys.readouterr().out.replace("\n ", "")
    assert bearing.dynamic_rating == pytest.approx(1e3 * float(dynamic.split()[0]), rel=0.05)
    if "C3" in designation:  # 12 to 36 and 30 to 58 are those of 100 mm, 10-30 and 25-51 of 80
        assert bearing.radial_clearance == pytest.approx(28e-6)
    if inside:
        assert (bearing.ball_count, round(bearing.ball_diameter, 6)) == inside


def test_a_users_own_ratings_are_not_called_the_catalogues(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    options = ["--dynamic", "78 kN", "--static", "72 kN"]
    assert main(["new", "NU 210 ECP", *options]) == 0
    assert "EC: a reinforced inside of SKF, the ratings are given." in capsys.readouterr().out
    assert main(["new", "6216", *options, "--bore", "70 mm"]) == 2
    assert "The boundary dimensions of '6216' are known" in capsys.readouterr().err
    assert main(["new", "6216", *options, "--type", "cylindrical_roller"]) == 2
    assert "'6216' is a bearing of type 'deep_groove_ball'" in capsys.readouterr().err


def test_rows_of_marks_name_cages_and_materials_that_there_are():
    for row in (*meanings().values(), *prefixes().values()):
        for column, element in (("ball_cage", "ball"), ("roller_cage", "roller")):
            assert not row.get(column) or row[column] in cages_of(element)
        assert not row.get("cage_material") or row["cage_material"] in MATERIALS
        assert not row["element_material"] or row["element_material"] in MATERIALS
        assert row["meaning"]
    assert len({row["mark"] for row in rows("marks")}) == sum(1 for _ in rows("marks"))
