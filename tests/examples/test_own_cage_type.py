"""A cage type from outside: one file, and meshes, modes and runs take it as any other."""

import json
import subprocess
import sys
from math import pi
from pathlib import Path

import pytest

FILE = Path(__file__).with_name("my_cage_type.py")
CASE = """
[bearing]
preset = "7010C-PI"
[cage]
{cage}
[mesh]
fineness = "coarse"
[modes]
count = 6
[drive]
speed = "4000 rpm"
[load]
axial = "100 N"
[solver]
duration = "0.5 ms"
"""
TAPERED = 'type = "tapered"\ntaper = "0.5 mm"'
REPORT = """
import json, sys
import flexcage
from flexcage.stages import cage_mesh, cage_reduction
flexcage.load_extension(sys.argv[1])
case = flexcage.load_case("case.toml")
mesh = cage_mesh(case)
cage = cage_reduction(case, mesh)
run = flexcage.simulate(case.replace("cage.model", "rigid"))
print(json.dumps({
    "spec": type(case.cage).__name__, "hash": case.hash, "volume": mesh.volume,
    "again": flexcage.load_case(case.to_toml()).hash,
    "frequency": cage.table.frequency[0], "interface": type(cage.interface).__name__,
    "end": float(run.dataset["time"][-1]),
    "speed": run.summary["cage_speed"], "size": [
        case.cage.outside_diameter, case.cage.width, case.cage.pocket_diameter],
}))
"""


def flexcage(tmp_path, cage, *command):
    """In a process of its own: what is registered there is seen by no other test."""
    (tmp_path / "case.toml").write_text(CASE.format(cage=cage))
    return subprocess.run(
        [sys.executable, *command], capture_output=True, text=True, cwd=tmp_path, check=False
    )


def found(tmp_path, cage):
    done = flexcage(tmp_path, cage, "-c", REPORT, str(FILE))
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout.splitlines()[-1])


def test_it_is_meshed_reduced_and_run(tmp_path):
    sound, tapered = found(tmp_path, 'type = "machined"'), found(tmp_path, TAPERED)
    assert (sound["spec"], tapered["spec"]) == ("BallCage", "TaperedCage")
    assert tapered["again"] == tapered["hash"] != sound["hash"]
    outside, width, pocket = tapered["size"]
    radius, taper = 0.5 * outside, 0.5e-3  # each end a truncated cone beside the pockets
    lost = pi * (width - pocket) * (radius * taper - taper**2 / 3.0)
    assert sound["volume"] - tapered["volume"] == pytest.approx(lost, rel=0.04)  # coarse
    assert tapered["interface"] == "BallCageInterface"
    assert 0.7 * sound["frequency"] < tapered["frequency"] < sound["frequency"]
    assert tapered["end"] == pytest.approx(0.5e-3)
    assert tapered["speed"] == pytest.approx(sound["speed"], rel=1e-3)


@pytest.mark.parametrize(
    ("cage", "words"),
    [
        ('type = "tapered"', "[cage] lacks 'taper'"),
        ('type = "tapered"\ntaper = "0 mm"', "cage.taper"),
        ('type = "conical"', "choose from crown, machined, ribbon, tapered"),
    ],
)
def test_mistakes_in_it_are_said_like_all_others(tmp_path, cage, words):
    command = ["-m", "flexcage.cli", "mesh", "case.toml", "--use", str(FILE)]
    done = flexcage(tmp_path, cage, *command)
    assert done.returncode == 2 and done.stderr.count("\n") == 1 and words in done.stderr


def test_without_its_file_no_case_knows_it(tmp_path):
    done = flexcage(tmp_path, TAPERED, "-m", "flexcage.cli", "mesh", "case.toml")
    assert done.returncode == 2 and "choose from crown, machined, ribbon" in done.stderr


WRONG = """
import dataclasses, sys
import flexcage
from flexcage.cages import CageType
from flexcage.cages.machined import CAGE_TYPE as MACHINED
flexcage.load_extension(sys.argv[1])
for change in ({}, {"name": "other"}):
    try:
        flexcage.register.cage_type(dataclasses.replace(MACHINED, **change))
    except flexcage.InputError as exc:
        print(exc)
"""


def test_its_name_is_free_and_that_of_its_spec(tmp_path):
    done = flexcage(tmp_path, TAPERED, "-c", WRONG, str(FILE))
    taken, other = done.stdout.splitlines()
    assert taken == "A cage type 'machined' exists already; choose another name."
    assert other.startswith("The spec of cage type 'other', BallCage, has the cage_type 'machined'")
