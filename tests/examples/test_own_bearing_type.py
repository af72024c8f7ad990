"""A bearing type from outside: one file, and the static solution takes it as any other."""

import subprocess
import sys
from pathlib import Path

import pytest

FILE = Path(__file__).with_name("my_bearing_type.py")
CASE = """
[bearing]
type = "springs"
designation = "S12"
count = 12
stiffness = "5 N/um"
[load]
radial = "120 N"
direction = "10 deg"
"""


def static(tmp_path, *extra):
    """In a process of its own: what is registered there is seen by no other test."""
    case = tmp_path / "case.toml"
    case.write_text(CASE)
    command = [sys.executable, "-m", "flexcage.cli", "static", str(case), *extra]
    return subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)


def test_a_type_of_ones_own(tmp_path):
    """12 springs k all around bear a displacement u by 6 k u: 120 N give 4 um."""
    done = static(tmp_path, "--use", str(FILE))
    assert done.returncode == 0, done.stderr
    assert "S12, spring bearing with 12 rolling elements" in done.stdout
    row = next(line for line in done.stdout.splitlines() if line.startswith("displacement"))
    x, y, z = (float(value) for value in row.split()[4:7])
    assert x == 0.0 and (y**2 + z**2) ** 0.5 == pytest.approx(4.0, rel=1e-5)
    stiffness = next(line for line in done.stdout.splitlines() if line.startswith("force y"))
    assert float(stiffness.split()[4]) == pytest.approx(30.0, rel=1e-5)


def test_mistakes_in_it_are_said_like_all_others(tmp_path):
    done = static(tmp_path)
    assert done.returncode == 2 and "bearing.type 'springs' is not known" in done.stderr
    done = static(tmp_path, "--use", str(FILE), "--set", "bearing.stiffness=5 mm")
    assert done.returncode == 2 and "another kind than N/um" in done.stderr
    done = static(tmp_path, "--use", str(FILE), "--set", "load.axial=1 N")
    assert done.returncode == 2 and "a spring bearing bears none of it" in done.stderr
    done = static(tmp_path, "--use", str(FILE), "--set", "load.radial=0 N")
    assert done.returncode == 2 and "bears no load" in done.stderr


def test_a_type_without_equations_of_motion_is_not_run(tmp_path):
    case = tmp_path / "case.toml"
    case.write_text(CASE)
    command = [sys.executable, "-m", "flexcage.cli", "run", str(case), "--use", str(FILE)]
    done = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path, check=False)
    assert done.returncode == 2 and done.stderr.count("\n") == 1
    assert "the motion of spring bearings is not computed yet; 'flexcage static'" in done.stderr


MAGNETO = """
name = "magneto"
[bearing]
type = "magneto"
designation = "E15"
bore = "15 mm"
outside_diameter = "40 mm"
width = "10 mm"
pitch_diameter = "27.5 mm"
ball_diameter = "5.5 mm"
ball_count = 10
inner_groove_radius = "2.9 mm"
outer_groove_radius = "2.95 mm"
radial_clearance = "15 um"
[cage]
model = "rigid"
bore = "25 mm"
outside_diameter = "30 mm"
width = "9 mm"
pocket_diameter = "5.8 mm"
[mesh]
fineness = "coarse"
[drive]
speed = "3000 rpm"
[load]
axial = "60 N"
[solver]
duration = "2 ms"
"""


def test_a_type_whose_elements_are_there_runs(tmp_path):
    """Ten lines in a user's file move by the balls' kernels, and keep limits of their own."""
    file, case = FILE.with_name("my_ball_bearing_type.py"), tmp_path / "case.toml"
    case.write_text(MAGNETO)

    def run(*extra):
        command = [sys.executable, "-m", "flexcage.cli", "run", str(case), "--use", str(file)]
        return subprocess.run(
            [*command, *extra], capture_output=True, text=True, cwd=tmp_path, check=False
        )

    done = run("-o", "out")
    assert done.returncode == 0, done.stderr
    speed = next(line for line in done.stdout.splitlines() if line.startswith("  Cage speed  "))
    gamma = 5.5 / 27.5  # at a small contact angle
    assert float(speed.split()[2].replace(",", "")) == pytest.approx(1500 * (1 - gamma), rel=0.02)
    assert 'type = "magneto"' in (tmp_path / "out" / "case.toml").read_text()
    assert (tmp_path / "out" / "images" / "bearing.png").is_file()
    wrong = run("-o", "other", "--set", "load.axial=-60 N")
    assert wrong.returncode == 2 and "where magneto bearings have no shoulder" in wrong.stderr


def test_it_has_no_fits(tmp_path):
    done = static(tmp_path, "--use", str(FILE), "--set", "fit.shaft=k5")
    assert done.returncode == 2
    assert "[fit] is given, but a spring bearing does not say how its races follow" in done.stderr
