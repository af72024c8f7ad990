"""Nothing outside the folder of a family and its line names it: a copy of flexcage without that
family passes its checks, and still has the other."""

import os
import re
import shutil
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path

import pytest

from flexcage.core.wings import FAMILIES as WING
from flexcage.geometry.bearing import BEARING_TYPES

ROOT = Path(__file__).parents[2]
#: Rooms in which bearings touch and move; the others' tests take long, or know no family.
ROOMS = ("contacts", "solve", "system")


@dataclass(frozen=True)
class Left:
    """A family that is left out: a preset that wants it, or its type of bearing, and one that does
    not, one of its specs, what its tests have in their texts, and answers of ``flexcage verify`` on
    it alone."""

    preset: str
    other: str
    spec: str
    said: str
    words: str
    answers: str = "no such file"


FAMILIES = {
    "ball": Left(
        "7010C-PI", "N1013", "BallBearing", "bearing.type 'angular_contact_ball' is not known",
        "ball|groove|ribbon|crown|7010|6205|7603025|moving_rows",
    ),
    "cylindrical_roller": Left(
        "N1013", "7010C-PI", "RollerBearing", "which is not registered",
        r"roller|n1013|\bnu\d|\bnj\d|window|crossbeam|bearing_runs|bearing_of|kernels import land|"
        "moving_rows",
        "roller*.py",
    ),
    "tapered_roller": Left(
        "tapered_roller", "N1013", "TaperedRollerBearing",
        "bearing.type 'tapered_roller' is not known", "tapered",
    ),
}  # fmt: skip


@pytest.fixture(scope="module", params=FAMILIES)
def without(request, tmp_path_factory):
    """run(module, *arguments) in a copy of flexcage without one family."""
    copy = tmp_path_factory.mktemp("copy")
    own = shutil.ignore_patterns("__pycache__")
    shutil.copytree(ROOT / "flexcage", copy / "flexcage", ignore=own)
    for name in (request.param, *built_on(request.param)):
        shutil.rmtree(copy / "flexcage/bearings" / name)
        _edit(copy / "flexcage/bearings/specs.py", rf"from flexcage\.bearings\.{name} .*\n")
    left = FAMILIES[request.param]
    for answer in (copy / "flexcage/verification/cases").glob(left.answers):
        answer.unlink()
        _edit(answer.with_name("__init__.py"), rf"    {answer.stem}(\.CASE)?,\n")
    shutil.copy(ROOT / "pyproject.toml", copy)
    env = {**os.environ, "PYTHONPATH": str(copy)}

    def run(*command):
        return subprocess.run(command, cwd=copy, env=env, capture_output=True, text=True)

    run.copy, run.left = copy, left
    return run


def built_on(name):
    """Names of the families that are built on one, or on those."""
    for family in WING.values():
        if family.built_on == name:
            yield family.name
            yield from built_on(family.name)


def _edit(path, pattern):
    """Take what fits a pattern out of a file."""
    old = path.read_text("utf-8")
    new = re.sub(pattern, "", old)
    assert new != old
    path.write_text(new, "utf-8")


@pytest.mark.slow
def test_types_hold(without):
    done = without(sys.executable, "-m", "mypy", "--cache-dir", ".mypy")
    assert done.returncode == 0, done.stdout + done.stderr


@pytest.mark.slow
def test_walls_hold(without):
    code = "from importlinter.cli import lint_imports_command as lint; lint()"
    done = without(sys.executable, "-c", code)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_other_family_remains_and_this_one_is_refused(without):
    left, asked = without.left, f"flexcage.Case.from_preset('{without.left.preset}')"
    if left.preset in BEARING_TYPES:
        asked = f"flexcage.load_static({{'bearing': {{'type': '{left.preset}'}}}})"
    code = (
        f"import flexcage; flexcage.Case.from_preset('{left.other}').to_toml(); "
        f"assert '{left.spec}' not in dir(flexcage.spec)\n"
        f"try: {asked}\n"
        "except flexcage.InputError as exc: print(exc)"
    )
    done = without(sys.executable, "-c", code)
    assert done.returncode == 0, done.stderr
    assert left.said in done.stdout


@pytest.mark.slow
def test_tests_of_the_other_family_pass(without):
    """All of these rooms that say nothing of the one that is left out."""
    for folder in ("tests", "examples"):
        shutil.copytree(ROOT / folder, without.copy / folder)
    tests = [p for room in ROOMS for p in (without.copy / "tests" / room).glob("test_*.py")]
    words = re.compile(without.left.words, re.IGNORECASE)
    others = [str(path) for path in tests if not words.search(path.read_text("utf-8"))]
    assert len(others) >= 10
    done = without(sys.executable, "-m", "pytest", "-p", "no:cacheprovider", *others)
    assert done.returncode == 0, done.stdout + done.stderr
