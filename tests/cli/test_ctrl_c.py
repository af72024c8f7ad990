"""Ctrl-C ends a command in one line, at whatever moment it comes."""

import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

CASE = """
bearing = { preset = "N1013" }
cage = { model = "rigid" }
mesh = { fineness = "coarse" }
load = { radial = "1000 N" }
"""
# the console script, which says when it listens; its disk has room for any run
SCRIPT = """
import shutil, signal, sys
signal.signal(signal.SIGINT, signal.default_int_handler)  # tests in the background ignore it
own_usage = shutil.disk_usage
shutil.disk_usage = lambda path: own_usage(path)._replace(free=10**15)
from flexcage import cli
from flexcage.core import stopping
own = stopping.on_interrupt
def told(sentence):
    own(sentence)
    print("listens", flush=True)
stopping.on_interrupt = told
cli.entry()
"""
pytestmark = pytest.mark.skipif(os.name != "posix", reason="signals of a group of processes")
MOMENTS = np.random.default_rng(5).uniform(0.0, 6.0, 8)


def interrupted(folder, moment: float, *words: str, **env: str) -> tuple[int, list[str]]:
    """Exit code, and lines on standard error, of a command stopped so many seconds after it has
    begun to listen."""
    process = subprocess.Popen(
        [sys.executable, "-c", SCRIPT, *words], cwd=folder, stdout=subprocess.PIPE,
        stderr=subprocess.PIPE, text=True, start_new_session=True, env={**os.environ, **env},
    )  # fmt: skip
    assert process.stdout.readline() == "listens\n"
    time.sleep(moment)
    os.killpg(process.pid, signal.SIGINT)
    _, err = process.communicate()
    return process.returncode, err.splitlines()


def stopped_in_one_line(code: int, lines: list[str]) -> None:
    before = "the results (", "solving will take", "at the pace", "compiling the kernels"
    said = [k for k in lines if not k.startswith(before)]
    assert code == 130, lines
    assert len(said) == 1 and said[0].startswith("flexcage: Stopped"), lines


@pytest.mark.parametrize("moment", MOMENTS)
def test_of_a_very_long_run(tmp_path, moment):
    (tmp_path / "case.toml").write_text(CASE)
    long = ("--set", "solver.duration=100 s")
    stopped_in_one_line(*interrupted(tmp_path, moment, "run", "case.toml", *long, "-o", "out"))


def test_while_kernels_are_compiled(tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    env = {"NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    stopped_in_one_line(*interrupted(tmp_path, 6.0, "run", "case.toml", "-o", "out", **env))


def test_what_it_leaves_can_be_run_again(tmp_path):
    (tmp_path / "case.toml").write_text(CASE)
    short = ("--set", "solver.duration=0.2 ms", "--no-images")
    interrupted(tmp_path, 2.0, "run", "case.toml", "-o", "out", *short)
    done = subprocess.run(
        [sys.executable, "-m", "flexcage.cli", "run", "case.toml", "-o", "out", *short,
         *(["--resume"] if (tmp_path / "out" / "case.toml").exists() else [])],
        cwd=tmp_path, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr


@pytest.mark.parametrize("moment", [0.5, 3.0, 7.0])
def test_of_a_study(tmp_path, moment):
    (tmp_path / "case.toml").write_text(CASE)
    axis = '[[axes]]\npath = "load.radial"\nvalues = ["500 N", "1 kN"]\n'
    (tmp_path / "study.toml").write_text(f'case = "case.toml"\noutputs = ["cage_speed"]\n{axis}')
    words = ("study", "run", "study.toml", "-o", "out", "--workers", "1")
    stopped_in_one_line(*interrupted(tmp_path, moment, *words))
