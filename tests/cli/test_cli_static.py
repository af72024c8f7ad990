"""flexcage static: its table, its files, and what it says to mistakes."""

import json
import tomllib
from pathlib import Path

import pytest

from flexcage import cli
from flexcage.case import load_static
from flexcage.core.listing import PAGE

EXAMPLES = Path(__file__).parents[2] / "examples"
BALLS, ROLLERS = str(EXAMPLES / "c7010_static.toml"), str(EXAMPLES / "n1013.toml")


def test_table_of_balls(capsys):
    assert cli.main(["static", BALLS]) == 0
    text = capsys.readouterr().out
    assert "7010C, angular contact ball bearing with 18" in text and "10000 rpm" in text
    first = next(line for line in text.splitlines() if line.split()[:2] == ["0", "0"])
    # Q inner and outer, contact angles: V3's line for 10,000 rpm under outer race control
    assert [float(x) for x in first.split()[2:6]] == [16.392, 39.456, 19.811, 10.619]
    assert "1.80914" in text and "life L10r" in text and "h at this speed" in text


def test_files_of_a_static_solution(tmp_path, capsys, monkeypatch):
    monkeypatch.setenv("COLUMNS", str(PAGE))
    out = tmp_path / "static"
    assert cli.main(["static", ROLLERS, "--set", "load.radial=800 N", "-o", str(out)]) == 0
    assert sorted(p.name for p in out.iterdir()) == [
        "case.toml", "static.json", "static.png", "static.txt"
    ]  # fmt: skip
    shown = capsys.readouterr().out
    assert (out / "static.txt").read_text("utf-8").strip() in shown
    found = json.loads((out / "static.json").read_text("utf-8"))
    assert found["format"] == 1 and found["load"][1] == 800.0
    forces = found["elements"]["force"]
    assert len(forces) == 22 and max(f[1] for f in forces) > 800 * 4.08 / 22
    assert any(a[0] is None for a in found["elements"]["angle"])  # unloaded: no contact, no angle
    assert (out / "static.png").stat().st_size > 20_000
    assert tomllib.loads((out / "case.toml").read_text("utf-8"))["load"]["radial"] == "800 N"
    assert load_static(out / "case.toml").load.radial == 800.0

    assert cli.main(["static", ROLLERS, "-o", str(out)]) == 2
    assert "exists already; --force" in capsys.readouterr().err
    assert cli.main(["static", ROLLERS, "-o", str(out), "--force"]) == 0


ARCS = [
    "--set", "outer_ring.ring=flexible", "--set", "outer_ring.seat=arcs",
    "--set", "outer_ring.supports=[\"60 deg\", \"-60 deg\"]",
]  # fmt: skip


def test_rings_that_bend(tmp_path, capsys):
    out = tmp_path / "bent"
    argv = ["static", ROLLERS, "--set", "drive.speed=0 rpm", *ARCS, "-o", str(out)]
    assert cli.main(argv) == 0
    assert "outer ring: how far its race yields" in capsys.readouterr().out
    ring = json.loads((out / "static.json").read_text("utf-8"))["rings"]["outer"]
    assert len(ring["deflection"]) == 22 and min(ring["support_force"]) >= 0.0
    assert (out / "outer_ring.png").stat().st_size > 20_000
    again = load_static(out / "case.toml").outer_ring
    assert again.bends and again.seat == "arcs" and len(again.supports) == 2


MISTAKES = [
    (["static", ROLLERS, "--set", "outer_ring.seat=arcs"], 2, "has no azimuths"),
    (
        ["static", ROLLERS, "--set", 'outer_ring.supports=["60 deg"]'],
        2,
        "has 1 azimuth, but outer_ring.seat is 'rigid'",
    ),
    (
        [
            "static",
            ROLLERS,
            *ARCS,
            "--set",
            "outer_ring.support_arc=89 deg",
            "--set",
            'outer_ring.supports=["60 deg", "80 deg"]',
        ],
        2,
        "20 deg apart",
    ),
    (
        ["static", ROLLERS, *ARCS, "--set", 'outer_ring.supports=["60 deg", "240 deg"]'],
        2,
        "opposite sides",
    ),
    (["static", ROLLERS, *ARCS, "--set", "outer_ring.diameter=91 mm"], 2, "0.25 mm behind"),
    (["run", ROLLERS, *ARCS, "--set", "mount.kind=bushing"], 2, "in a run supports stand still"),
    (["static", BALLS, "--set", "bearing.ball_count=24"], 2, "24 balls"),
    (["static", BALLS, "--set", "load.axial=0 N"], 2, "bears no load"),
    (["static", BALLS, "--set", "load.axial=-100 N"], 2, "cannot bear this load"),
    (["static", "none.toml"], 2, "no case file"),
    (["static", ROLLERS, "--set", "load.axial=5 N"], 2, "load.axial is 5 N"),
    (["mesh", BALLS, "--set", "cage.pocket_diameter=10.6 mm"], 2, "makes the 18 webs thinner"),
]


@pytest.mark.parametrize(("argv", "code", "words"), MISTAKES)
def test_mistakes_are_one_sentence(argv, code, words, capsys, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert cli.main(argv) == code
    err = capsys.readouterr().err
    assert err.startswith("flexcage: ") and err.count("\n") == 1 and words in err, err
    assert list(tmp_path.iterdir()) == []
