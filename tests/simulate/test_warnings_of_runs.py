"""Warnings reach the terminal, summary and page of a run, and stay with it."""

import json
from pathlib import Path

import pytest
from simulate_cases import bent, n1013

from flexcage import cli
from flexcage.case import load_case
from flexcage.simulate import load_run, simulate

EXAMPLE = Path(__file__).parents[2] / "examples" / "n1013.toml"
COARSE = {"mesh.fineness": "coarse"}
# a deep groove bearing with a machined cage that only its balls guide
LOOSE = {
    "bearing": {
        "type": "deep_groove_ball", "bore": "25 mm", "outside_diameter": "52 mm",
        "width": "15 mm", "ball_diameter": "7.938 mm", "ball_count": 9,
        "pitch_diameter": "38.5 mm", "inner_groove_radius": "4.088 mm",
        "outer_groove_radius": "4.168 mm", "radial_clearance": "10 um",
    },
    "cage": {
        "type": "machined", "model": "rigid", "material": "PA66", "bore": "34 mm",
        "outside_diameter": "43 mm", "width": "12 mm", "pocket_diameter": "8.2 mm",
    },
    "drive": {"speed": "10000 rpm"},
    "load": {"radial": "500 N"},
    "mesh": {"fineness": "coarse"},
    "solver": {"duration": "25 ms"},
}  # fmt: skip


def keys(run):
    return [warning.key for warning in run.warnings]


def test_a_sound_run_has_none():
    """The main job with a rigid cage, as long as it is."""
    run = simulate(load_case(EXAMPLE).replace({**COARSE, "cage.model": "rigid"}))
    assert run.warnings == () and str(run.summary).startswith("Warnings: none")


@pytest.mark.slow
def test_the_main_job_has_none():
    assert keys(simulate(load_case(EXAMPLE).replace(COARSE))) == ["coarse_mesh"]


def test_a_cage_that_is_thrown_off_is_told_before_it_fails():
    run = simulate(load_case(LOOSE))
    assert {"thrown_off", "passes_ring"} <= set(keys(run))
    assert "unfinished" not in keys(run), "it has not failed yet"


def test_a_stress_above_proof_is_told_everywhere(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    fast = ["--set", "drive.speed=60000 rpm", "--set", "solver.duration=2 ms"]
    coarse = ["--set", "mesh.fineness=coarse"]
    assert cli.main(["run", str(EXAMPLE), *fast, *coarse, "-o", "out", "--no-images"]) == 0
    said = capsys.readouterr().out
    above = "MPa, more than the proof stress of brass (160 MPa): a real cage would yield"
    assert above in said.partition("passes counted")[0], "before the figures"
    assert 10 < len(said.partition("\n\n")[2].splitlines()) < 20, "and about a dozen of these"
    assert above in " ".join(Path("out/summary.txt").read_text("utf-8").split())
    stored = json.loads(Path("out/summary.json").read_text("utf-8"))["warnings"]
    at_start = ["short_run", "speed_factor", "coarse_mesh"]
    assert [w["key"] for w in stored] == [*at_start, "stress_above_proof"]
    run = load_run("out")
    assert [w.text for w in run.warnings] == [w["text"] for w in stored]
    Path("out/summary.json").unlink()  # as one that was killed
    assert load_run("out").warnings == run.warnings
    assert above in Path(run.report("page.html")).read_text("utf-8")


def test_what_is_known_at_the_start_stays_with_the_run(tmp_path, caplog):
    """Told at once, before a long run, and once more with its results."""
    late = {"load.ramp_to": "2 kN", "load.ramp_start": "10 ms", "load.ramp_time": "5 ms"}
    thin = {"cage.pocket_length": "15.6 mm", "contacts.land.kind": "none"}
    case = n1013({"cage.model": "rigid", **late, **thin})
    run = simulate(case, out=tmp_path / "run")
    assert keys(run)[:3] == ["not_reached", "short_run", "odd_geometry"]
    assert "nothing ramps." in caplog.text
    (tmp_path / "run" / "summary.json").unlink()
    assert load_run(tmp_path / "run").warnings == run.warnings


def test_a_pinched_roller_pre_stresses_its_cage(caplog):
    run = simulate(n1013({"cage.model": "rigid"}, defects=bent("0.22 mm")))
    assert "pinched" in keys(run) and "the cage is pre-stressed" in caplog.text


def test_a_basis_without_residual_flexibility(caplog):
    short = {"solver.duration": "0.1 ms", "modes.count": 6}
    own = simulate(n1013({**short, "modes.kind": "free_free"}))
    assert "no_residual_flexibility" in keys(own)
    assert "no_residual_flexibility" not in keys(simulate(n1013(short)))


def test_what_is_zero_by_construction_is_not_printed():
    run = simulate(n1013({"cage.model": "rigid"}))
    assert run.summary["work_film"] == run.summary["work_modal_damping"] == 0.0
    text = run.summary.text()
    for said in ("Work: film", "Work: modal damping", "Gained: strain", "axial reaction"):
        assert said not in text, said
    assert "Work: race friction" in text and "Work: drive" in text
