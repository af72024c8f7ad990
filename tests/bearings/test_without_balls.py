"""Nothing outside the folder of the balls and its line names them: a copy of flexcage without
them passes its checks, and still has its rollers."""

import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]


@pytest.fixture(scope="module")
def without_balls(tmp_path_factory):
    """run(module, *arguments) in a copy of flexcage without the family of balls."""
    copy = tmp_path_factory.mktemp("copy")
    own = shutil.ignore_patterns("__pycache__")
    shutil.copytree(ROOT / "flexcage", copy / "flexcage", ignore=own)
    shutil.rmtree(copy / "flexcage/bearings/ball")
    _edit(copy / "flexcage/bearings/specs.py", r"from flexcage\.bearings\.ball import .*\n")
    shutil.copy(ROOT / "pyproject.toml", copy)
    env = {**os.environ, "PYTHONPATH": str(copy)}

    def run(*command):
        return subprocess.run(command, cwd=copy, env=env, capture_output=True, text=True)

    run.copy = copy
    return run


#: What a test of ball bearings, or on one of their presets, has in its text.
BALLS = re.compile(r"ball|groove|ribbon|crown|7010|6205|7603025", re.IGNORECASE)
#: Rooms in which bearings touch and move; the others' tests take long, or know no family.
ROOMS = ("contacts", "solve", "system")


def _edit(path, pattern):
    """Take what fits a pattern out of a file."""
    old = path.read_text("utf-8")
    new = re.sub(pattern, "", old)
    assert new != old
    path.write_text(new, "utf-8")


@pytest.mark.slow
def test_types_hold(without_balls):
    done = without_balls(sys.executable, "-m", "mypy", "--cache-dir", ".mypy")
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.slow
def test_walls_hold(without_balls):
    code = "from importlinter.cli import lint_imports_command as lint; lint()"
    done = without_balls(sys.executable, "-c", code)
    assert done.returncode == 0, done.stdout + done.stderr


def test_rollers_remain_and_a_ball_bearing_is_refused(without_balls):
    code = (
        "import flexcage; flexcage.Case.from_preset('N1013').to_toml(); "
        "assert 'BallBearing' not in dir(flexcage.spec)\n"
        "try: flexcage.Case.from_preset('7010C-PI')\n"
        "except flexcage.InputError as exc: print(exc)"
    )
    done = without_balls(sys.executable, "-c", code)
    assert done.returncode == 0, done.stderr
    assert "bearing.type 'angular_contact_ball' is not known" in done.stdout


@pytest.mark.slow
def test_tests_of_rollers_pass(without_balls):
    """All of these rooms that say nothing of balls."""
    for folder in ("tests", "examples"):
        shutil.copytree(ROOT / folder, without_balls.copy / folder)
    tests = [p for room in ROOMS for p in (without_balls.copy / "tests" / room).glob("test_*.py")]
    of_rollers = [str(path) for path in tests if not BALLS.search(path.read_text("utf-8"))]
    assert len(of_rollers) >= 16
    done = without_balls(sys.executable, "-m", "pytest", "-p", "no:cacheprovider", *of_rollers)
    assert done.returncode == 0, done.stdout + done.stderr
