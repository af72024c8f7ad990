"""What `flexcage run` says to mistakes in a ball bearing's case: one sentence, exit code 2."""

import re
from pathlib import Path

import pytest

from flexcage import cli

CASE = """
[bearing]
preset = "7010C-PI"
[mesh]
fineness = "coarse"
[cage]
model = "rigid"
[load]
axial = "100 N"
[solver]
duration = "0.2 ms"
"""
DISPLACED = '[[defects]]\ntype = "displaced"\npocket = 3\ncircumferential = {}\n'
CRACK = '[[defects]]\ntype = "crack"\nweb = {}\nshare = {}\n'
SETTINGS = {
    "angle and clearance": ("bearing.radial_clearance=80 um", ["80 um", "15 deg", "32.46 um"]),
    "balls overlap": ("bearing.ball_count=24", ["24 balls of 9.525 mm", "at most 21 fit"]),
    "pocket below ball": ("cage.pocket_diameter=9.4 mm", ["9.4 mm", "greater than", "9.525 mm"]),
    "no unit": ("load.axial=100", ["load.axial is 100 without a unit", "'100 N'"]),
    "wrong unit": ("load.axial=100 kg", ["load.axial is '100 kg'", "another kind than N"]),
    "load away": ("load.axial=-100 N", ["cannot bear this load", "axial load, towards +x"]),
    "no load": ("load.axial=0 N", ["bears no load", "load.axial"]),
    "overload": ("load.axial=300 kN", ["300 kN", "4 times", "21.2 kN"]),
}
TEXTS = {
    "fast wave": (
        '[drive]\nwave = "sine"\nwave_amplitude = "9 rpm"\nwave_period = "10 us"\n',
        ["drive.wave_period is 0.01 ms", "0.04 ms", "longer"],
    ),
    "into the neighbour": (DISPLACED.format('"3 mm"'), ["Pockets 3 and 4", "web 4", "less"]),
    "defect without unit": (DISPLACED.format("0.3"), ["defects.0.circumferential", "'0.3 mm'"]),
    "long crack": (CRACK.format(3, 1.2), ["defects.0.share is 1.2", "shorter than the cage's"]),
    "crack nowhere": (CRACK.format(18, 0.2), ["defects.0.web is 18", "0 to 17"]),
    "pocket made small": (
        '[[defects]]\ntype = "enlarged"\npocket = 3\nincrease = "-0.6 mm"\n',
        ["pocket 3", "9.425 mm", "the ball's, 9.525 mm"],
    ),
}


@pytest.fixture
def case(tmp_path, monkeypatch):
    """Writes the case with more text; its path. Every run's folder would lie beside it."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv("FLEXCAGE_DEBUG", raising=False)

    def write(more: str = "") -> str:
        (tmp_path / "balls.toml").write_text(CASE + more, encoding="utf-8")
        return "balls.toml"

    return write


def refused(capsys, argv, words) -> None:
    assert cli.main(["-q", *argv]) == 2
    err = capsys.readouterr().err
    err = re.sub(r"^warning: The run is short.*\n", "", err)  # said before anything is computed
    assert err.startswith("flexcage: ") and err.count("\n") == 1 and err.endswith(".\n"), err
    assert "Traceback" not in err and all(word in err for word in words), err
    assert [p.name for p in Path.cwd().rglob("*") if p.is_file()] == ["balls.toml"]


@pytest.mark.parametrize("name", SETTINGS)
def test_a_setting(name, case, capsys):
    setting, words = SETTINGS[name]
    refused(capsys, ["run", case(), "--set", setting], words)


@pytest.mark.parametrize("name", SETTINGS)
def test_a_setting_of_a_static_solution(name, case, capsys):
    setting, words = SETTINGS[name]
    refused(capsys, ["static", case(), "--set", setting], words)


@pytest.mark.parametrize("name", TEXTS)
def test_a_text(name, case, capsys):
    text, words = TEXTS[name]
    refused(capsys, ["run", case(text)], words)


SHALLOW = ["--set", "bearing.inner_shoulder=0.5 mm", "--set", "load.axial=2 kN"]


def test_an_ellipse_over_the_edge_is_warned_of_in_a_run(case, capsys):
    """At its start, at its end, and in its summary: where, by how much, under which load."""
    assert cli.main(["run", case(), *SHALLOW, "-o", "out", "--no-images"]) == 0
    out, err = capsys.readouterr()
    out = re.sub(r"\n {4}(?=\S)", " ", out)  # warnings wrap
    (before,) = (line for line in err.splitlines() if "runs over" in line)
    assert before.startswith("warning: At the start the contact ellipse of element")
    head = out.partition("passes counted")[0].splitlines()  # before the figures
    at_start, at_end = (line for line in head if "runs over" in line)
    assert at_start.startswith("  - At the start the contact ellipse of element")
    assert at_end.startswith("  - The contact ellipse of ball") and "at t = " in at_end
    for line in (at_start, at_end):
        assert "inner groove's edge by" in line and " N at a contact angle of " in line
    told = Path("out/summary.txt").read_text("utf-8")
    told = re.sub(r"\n {4}(?=\S)", " ", told).splitlines()
    assert at_end in told
    (row,) = (line for line in told if "beyond the inner groove" in line)
    assert float(row.split("edge")[1].split()[0]) > 0.0 and " N at " in row


def test_an_ellipse_over_the_edge_is_warned_of_in_a_static_solution(case, capsys):
    assert cli.main(["static", case(), *SHALLOW]) == 0
    warned = [x for x in capsys.readouterr().out.splitlines() if x.startswith("Warning: ")]
    assert len(warned) == 1 and "runs over the inner groove's edge by" in warned[0]
    assert " N at a contact angle of " in warned[0]


def test_no_edge_is_warned_of_where_there_is_none(case, capsys):
    assert cli.main(["run", case(), "-o", "out", "--no-images"]) == 0
    out, err = capsys.readouterr()
    assert "runs over" not in out + err
    told = Path("out/summary.txt").read_text("utf-8").splitlines()
    (row,) = (line for line in told if "beyond the inner groove" in line)
    assert float(row.split("edge")[1].split()[0]) < 0.0
