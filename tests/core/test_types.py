"""A misspelt dimension is seen by mypy: specs have no attribute that is anything."""

import ast
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2]
SNIPPET = """
from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.cylindrical_roller.bearing import RollerBearing
from flexcage.cages.round_pocket.cage import BallCage
from flexcage.cages.window.defects import WindowDefect
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import CageDefect


def right(
    bearing: Bearing, balls: BallBearing, rollers: RollerBearing, cage: Cage, own: BallCage,
    defect: CageDefect,
) -> tuple[object, ...]:
    dimensions = bearing.pitch_diameter, balls.ball_diameter, rollers.roller_length, cage.width
    return *dimensions, own.pocket_diameter, defect.number


def wrong(
    bearing: Bearing, balls: BallBearing, rollers: RollerBearing, cage: Cage, own: BallCage,
    defect: CageDefect, beam: WindowDefect,
) -> None:
    bearing.pitch_diametre
    balls.ball_diametre
    rollers.roller_lenght
    cage.widht
    own.pocket_diametre
    defect.numbre
    beam.numbre
    cage.pocket_diameter
"""


@pytest.mark.slow  # mypy reads all that the snippet imports
def test_misspelt_dimensions_are_errors(monkeypatch, tmp_path):
    api = pytest.importorskip("mypy.api")
    monkeypatch.chdir(ROOT)
    file = tmp_path / "snippet.py"
    file.write_text(SNIPPET)
    options = ["--config-file=", "--ignore-missing-imports", "--follow-imports=silent"]
    said, usage, _ = api.run([*options, "--cache-dir", str(tmp_path), "--no-pretty", str(file)])
    lines = SNIPPET.splitlines()
    found = {int(line.split(":")[1]) for line in said.splitlines() if "has no attribute" in line}
    first = lines.index("    bearing.pitch_diametre") + 1
    assert found == set(range(first, len(lines) + 1)), said + usage


def test_no_class_has_attributes_that_are_anything():
    """Modules may find names late; a class that answers to every name hides misspellings."""
    for file in sorted((ROOT / "flexcage").rglob("*.py")):
        for cls in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(cls, ast.ClassDef):
                names = [n.name for n in ast.walk(cls) if isinstance(n, ast.FunctionDef)]
                assert "__getattr__" not in names, f"{file.name}: {cls.name}"
