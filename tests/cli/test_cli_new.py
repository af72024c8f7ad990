"""``flexcage new``: the file it writes, what it prints, and what it refuses."""

import pytest

from flexcage import cli
from flexcage.case import load_case

DIMENSIONS = (
    "--bore", "25 mm", "--outside", "52 mm", "--width", "15 mm", "--dynamic", "14 kN", "--static",
    "7.8 kN",
)  # fmt: skip


@pytest.fixture(autouse=True)
def here(monkeypatch, tmp_path):
    monkeypatch.chdir(tmp_path)


def test_a_designation_writes_a_case_and_tells_candidates(capsys):
    assert cli.main(["new", "N", "210"]) == 0
    told = capsys.readouterr().out
    assert "16 rollers of 11 x 12 mm" in told and "Next best" in told and "SKF" in told
    assert "by ISO 76 (" in told and "by ISO 281 (as rated: 1.14 times that)" in told
    assert "written: N210.toml" in told and load_case("N210.toml").bearing.roller_count == 16
    assert cli.main(["new", "N 210"]) == 2
    assert cli.main(["new", "N 210", "--force"]) == 0


def test_dimensions_and_ratings_write_a_case_as_well(capsys):
    assert cli.main(["new", *DIMENSIONS, "--type", "deep_groove_ball", "-o", "mine.toml"]) == 0
    assert "9 balls of 7.938 mm" in capsys.readouterr().out
    case = load_case("mine.toml")
    assert case.bearing.ball_count == 9 and case.cage.type == "ribbon"


def test_another_type_of_cage(capsys):
    assert cli.main(["new", "6205", "--cage", "crown"]) == 0
    case = load_case("6205.toml")
    assert case.cage.type == "crown" and case.cage.throat < case.bearing.ball_diameter
    assert cli.main(["new", "6205", "--force"]) == 0
    assert load_case("6205.toml").cage.type == "ribbon"


def test_a_makers_own_ratings_change_an_entry(capsys):
    assert cli.main(["new", "6305", "--dynamic", "23.4 kN", "--static", "11.6 kN"]) == 0
    told = capsys.readouterr().out
    assert "7 balls of 11.509 mm" in told and "--dynamic, --static given by the user" in told


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        ([], "give a designation, such as 6205, or its dimensions and ratings"),
        (["--bore", "25 mm"], "--type, --outside, --width, --dynamic, --static missing"),
        (["6205", "--bore", "30 mm"], "The boundary dimensions of '6205' are known"),
        (["6205", "--type", "cylindrical_roller"], "is a bearing of type 'deep_groove_ball'"),
        (["6205", "--dynamic", "14"], "--dynamic is 14 without a unit"),
        (["6205", "--dynamic", "-14 kN"], "must be greater than zero"),
        (["6205", "-o", "a.txt"], "should end in .toml"),
        ([*DIMENSIONS, "--type", "cylindrical_roller"], "needs the race diameter F (--inner-race)"),
        (["6205", "--cage", "crwn"], "no cage of type 'crwn' for balls; the nearest known one is"),
        (["N 210", "--cage", "crown"], "no cage of type 'crown' for rollers; choose from window"),
        ([*DIMENSIONS, "--type", "tapered"], "bearing.type 'tapered' is not known"),
    ],
)
def test_mistakes_get_one_sentence(arguments, sentence, capsys):
    assert cli.main(["new", *arguments]) == 2
    told = capsys.readouterr().err
    assert sentence in told and told.count("\n") == 1


def test_an_odd_name_stays_text():
    name = 'my "6205"\n[load]'
    assert cli.main(["new", name, *DIMENSIONS, "--type", "deep_groove_ball"]) == 0
    assert load_case("my6205load.toml").bearing.designation == name
