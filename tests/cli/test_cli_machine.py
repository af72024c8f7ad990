"""flexcage static MACHINE: its files, and one sentence for every mistake."""

import json

import pytest

from flexcage import cli, load_machine

PAIR = """
name = "pair"
[drive]
speed = "3000 rpm"
[shaft]
[[shaft.sections]]
length = "200 mm"
diameter = "50 mm"
[[shaft.loads]]
position = "0 mm"
force = ["100 N", "300 N", "0 N"]
[[shaft.discs]]
position = "200 mm"
diameter = "150 mm"
width = "20 mm"
unbalance = "50 g*mm"
[[bearings]]
name = "A"
preset = "7010C-PI"
position = "60 mm"
facing = "+x"
axial_offset = "8 um"
[[bearings]]
name = "B"
preset = "7010C-PI"
position = "140 mm"
facing = "-x"
axial_offset = "8 um"
"""


@pytest.fixture
def file(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "pair.toml").write_text(PAIR)
    return tmp_path / "pair.toml"


def test_files_of_a_machine(file, capsys):
    assert cli.main(["static", "pair.toml", "-o", "out"]) == 0
    out = file.parent / "out"
    assert sorted(p.name for p in out.iterdir()) == [
        "A", "B", "machine.json", "machine.png", "machine.toml", "machine.txt", "whirl.csv",
        "whirl.png",
    ]  # fmt: skip
    assert {"static.txt", "static.json", "static.png", "case.toml"} == {
        p.name for p in (out / "A").iterdir()
    }
    shown = capsys.readouterr().out
    assert "elastic shaft in 2 bearings at 3000 rpm" in shown and "critical speeds" in shown
    found = json.loads((out / "machine.json").read_text("utf-8"))
    assert found["bearings"]["A"]["force"][0] + found["bearings"]["B"]["force"][0] == (
        pytest.approx(-100.0, abs=1e-5)
    )
    rows = (out / "whirl.csv").read_text("utf-8").splitlines()
    assert len(rows) == 32 and rows[0].startswith("speed_rpm,frequency_1_Hz,whirl_1")
    assert float(rows[-1].split(",")[-1]) > 0.0  # the disc is out of balance
    again = load_machine(out / "machine.toml")
    assert again == load_machine(file)
    assert cli.main(["static", "pair.toml", "-o", "out"]) == 2
    assert "exists already" in capsys.readouterr().err
    assert cli.main(["static", "pair.toml", "-o", "out", "--force"]) == 0


def test_a_value_of_a_bearing_is_set_by_its_name(file, capsys):
    assert cli.main(["static", "pair.toml", "--set", "bearings.B.axial_offset=0 um"]) == 0
    assert "Warning" not in capsys.readouterr().out.partition("critical")[0]
    assert cli.main(["static", "pair.toml", "--set", "bearings.C.axial_offset=0 um"]) == 2
    assert "names no bearing of the machine; they are A, B" in capsys.readouterr().err


def test_a_shaft_of_another_diameter_than_the_bore_is_questioned(file, capsys):
    assert cli.main(["static", "pair.toml"]) == 0
    assert "Warning" not in capsys.readouterr().out
    assert cli.main(["static", "pair.toml", "--set", "shaft.sections.0.diameter=45 mm"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "bearing A has a bore of 50 mm, but at 60 mm the shaft's diameter is 45 mm" in said


@pytest.mark.parametrize("command", ["mesh", "modes", "converge"])
def test_a_machine_is_no_case_of_one_bearing(file, capsys, command):
    assert cli.main([command, "pair.toml"]) == 2
    err = capsys.readouterr().err
    assert "'pair.toml' is a machine, for it has [[bearings]]" in err
    assert err.count("\n") == 1 and sorted(p.name for p in file.parent.iterdir()) == ["pair.toml"]


SECOND = "[[bearings]]\npreset = '15x37x10'\nposition = '{}'\nname = '{}'\n"
TIGHT = SECOND.replace("name", "bearing = {{radial_clearance = '0 um'}}\nname")
DEEP = (
    "[shaft]\nkind = 'rigid'\nlength = '90 mm'\n[[shaft.loads]]\nposition = '9 mm'\n"
    "force = ['0 N', '50 N', '0 N']\n"
)
MISTAKES = [
    (("60 mm", "260 mm"), "bearings.A.position is 260 mm, off the end of the shaft, which"),
    (("7010C-PI", "7010C-XX"), "In [[bearings]] 'A': bearing.preset '7010C-XX' is not known; the "
     "nearest is '7010C-PI'"),
    (('"+x"', '"+y"'), "bearings.0.facing '+y' is not known"),
    (("axial_offset", "axial_ofset"), "Unknown key 'axial_ofset' in [bearings.0]; the nearest "
     "known one is 'axial_offset'"),
    (("axial_offset", "preload"), "a preload is axial_offset"),
    (("facing", "arrangement"), "facing = \"+x\" or \"-x\" is the direction"),
    (('"50 mm"', '"50"'), "shaft.sections.0.diameter"),
    (('diameter = "50 mm"', 'diameter = "50 mm"\nbore = "60 mm"'), "a bore is smaller"),
    (("140 mm", "60 mm"), "Bearings A and B both stand at 60 mm"),
    (('"B"', '"a"'), "Two of [[bearings]] are called 'a'"),
    (('width = "20 mm"\n', ""), "shaft.discs.0 has a diameter or a width alone"),
    (('width = "20 mm"\n', 'mass = "2 kg"\n'), "should have either a mass, or a diameter"),
    (("[[shaft.discs]]", "[[shaft.wheels]]"), "discs are [[shaft.discs]]"),
    (("axial_offset = \"8 um\"", "axial_offset = \"8 um\"\npreload_force = \"9 N\""),
     "both preload_force and axial_offset"),
    (("axial_offset = \"8 um\"", "spring_force = \"9 N\""), "but axial_seat is 'fixed'"),
    (("axial_offset = \"8 um\"", "axial_seat = \"floating\""), "without a push it falls apart"),
    (('preset = "7010C-PI"', 'designation = "2206"'), "a self-aligning ball bearing"),
    (('preset = "7010C-PI"', 'designation = "6206"\npreset = "7010C-PI"'), "both name the bearing"),
    (('preset = "7010C-PI"\n', ""), "In [[bearings]] 'A': the bearing is not named"),
    (('preset = "7010C-PI"', 'case = "none.toml"'), "There is no case file"),
    (('name = "pair"', 'name = "pair"\nload = "5 N"'), "loads are [[shaft.loads]]"),
    (('facing = "-x"', 'facing = "+x"'), "Bearing A faces +x and cannot bear what the shaft"),
    (('speed = "3000 rpm"', 'speed = "3000 rpm"\nramp_to = "9 rpm"'), "flexcage: drive.ramp_to is"),
    (("[drive]", "[gravity]\nalong = \"down\"\n[drive]"), "gravity.along 'down' is not known"),
]  # fmt: skip


@pytest.mark.parametrize(("change", "words"), MISTAKES)
def test_mistakes_are_one_sentence(file, capsys, change, words):
    text = PAIR.replace("100 N", "-100 N").replace(*change, 1)
    file.write_text(text)
    assert cli.main(["static", "pair.toml", "-o", "out"]) == 2
    err = capsys.readouterr().err
    assert err.startswith("flexcage: ") and err.count("\n") == 1 and words in err, err


OTHERS = [
    (DEEP + SECOND.format("10 mm", "A") + TIGHT.format("80 mm", "B"), ""),
    (DEEP + TIGHT.format("10 mm", "A") + TIGHT.format("80 mm", "B"),
     "Bearings A and B both hold the shaft along x and leave it no play"),
    (DEEP.replace("['0 N'", "['5 N'") + SECOND.format("10 mm", "A").replace("15x37x10", "N1013")
     + SECOND.format("80 mm", "B").replace("15x37x10", "N1013"), "no bearing holds it along x"),
    (DEEP.replace("length = '90 mm'\n", "") + SECOND.format("10 mm", "A"), "needs its length"),
    ("[shaft]\n" + SECOND.format("10 mm", "A"), "An elastic shaft needs [[shaft.sections]]"),
    (DEEP, "The machine lacks [[bearings]]"),
    (SECOND.format("10 mm", "A"), "The machine lacks [shaft]"),
    (DEEP + "[bearings]\npreset = '15x37x10'\n", "[[bearings]]"),
    (DEEP + SECOND.format("10 mm", "A") + "[bearings.outer_ring]\nring = 'flexible'\n",
     "rings that bend, which a machine's bearings do not yet"),
    (DEEP + SECOND.format("10 mm", "A") + "[bearings.mount]\nkind = 'contact'\n", "'contact'"),
    (DEEP + SECOND.format("10 mm", "A") + "[bearings.load]\nradial = '4 N'\n",
     "the machine has one [drive]"),
    (DEEP + SECOND.format("10 mm", "A") + SECOND.format("80 mm", "../B"), "usable as the name"),
    (DEEP.replace("['0 N'", "['5 N'") + "".join(
        SECOND.format(x, n) + "axial_seat = 'floating'\nspring_force = '40 N'\n"
        for x, n in (("10 mm", "A"), ("80 mm", "B"))), "it moves off along x; does a bearing"),
]  # fmt: skip


@pytest.mark.parametrize(("text", "words"), OTHERS)
def test_other_mistakes_are_one_sentence(file, capsys, text, words):
    file.write_text(text)
    assert cli.main(["static", "pair.toml"]) == (2 if words else 0)
    err = capsys.readouterr().err
    assert words in err and (not words or err.count("\n") == 1), err
