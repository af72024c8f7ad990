"""A family from outside, with a model and equations of its own: one file, and it runs as any other,
its kernels are kept, and a study's workers know it."""

import os
import re
import subprocess
import sys
from functools import partial
from math import hypot, sqrt
from pathlib import Path

import numba
import pandas as pd
import pytest

FILE = Path(__file__).with_name("my_family.py")
CASE = FILE.with_suffix(".toml").read_text("utf-8")
STUDY = """
name = "magnets"
case = "case.toml"
outputs = ["race_force_outer"]
[[axes]]
path = "bearing.pull"
values = ["2 N"]
"""
PEAKS = r"Inner race on an element, peak +([\d.]+).*Outer race on an element, peak +([\d.]+)"


def on_outer_race(inner: float, *, pull: float) -> float:
    """Force [N] on the outer race of a ball that the inner one presses with ``inner``: both pass on
    a tenth of the axial load, and the outer one the pull as well."""
    axial = 6.0
    return hypot(axial, sqrt(inner**2 - axial**2) + pull)


def kernels(folder: Path) -> dict[str, int]:
    """Files of compiled kernels: one that is written again is another file (its use changes its
    times)."""
    return {str(p): p.stat().st_ino for p in folder.rglob("*.kernel")}


def run_flexcage(folder, env, *args):
    """What ``flexcage`` with the user's file prints; the folder holds the case."""
    command = [sys.executable, "-m", "flexcage.cli", *args, "--use", str(FILE)]
    done = subprocess.run(
        command, capture_output=True, text=True, cwd=folder, env={**os.environ, **env}, check=False
    )
    assert done.returncode == 0, done.stderr
    return done


def forces(printed: str) -> tuple[float, float]:
    """Peak forces [N] of inner and outer race on an element."""
    inner, outer = re.search(PEAKS, printed, re.DOTALL).groups()
    return float(inner), float(outer)


def test_a_family_of_ones_own_in_plain_python(tmp_path):
    """The outer race bears what the inner does and the magnet's pull."""
    (tmp_path / "case.toml").write_text(CASE)
    args = "run", "case.toml", "-o", "run", "--no-images", "--set", "solver.duration=0.1 ms"
    done = run_flexcage(tmp_path, {"NUMBA_DISABLE_JIT": "1"}, *args)
    inner, outer = forces(done.stdout)
    assert outer == pytest.approx(on_outer_race(inner, pull=5.0), rel=0.01)


@pytest.mark.slow
@pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="plain Python compiles nothing")
def test_kernels_of_ones_own_family_are_kept(tmp_path):
    """Also for other values and for a study's workers."""
    (tmp_path / "case.toml").write_text(CASE)
    (tmp_path / "study.toml").write_text(STUDY)
    cache = tmp_path / "cache"
    flexcage = partial(run_flexcage, tmp_path, {"NUMBA_CACHE_DIR": str(cache)})
    first = flexcage("run", "case.toml", "-o", "first", "--no-images")
    assert "compiling the kernels for the first time" in first.stderr
    inner, outer = forces(first.stdout)
    assert outer == pytest.approx(on_outer_race(inner, pull=5.0), rel=0.01)
    compiled = kernels(cache)
    changed = ("--set", "bearing.pull=2 N")
    second = flexcage("run", "case.toml", "-o", "second", "--no-images", *changed)
    assert "compiling" not in second.stderr
    inner, outer = forces(second.stdout)
    assert outer == pytest.approx(on_outer_race(inner, pull=2.0), rel=0.01)
    flexcage("study", "run", "study.toml", "-o", "study", "--workers", "1")
    table = pd.read_parquet(tmp_path / "study" / "table.parquet")
    assert list(table["state"]) == ["done"]
    assert table["race_force_outer [N]"][0] == pytest.approx(outer, rel=1e-4)
    assert kernels(cache) == compiled
