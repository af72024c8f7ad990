"""A thousand revolutions: memory does not grow, and twenty kills lose nothing and change nothing.

A quarter of an hour: ``pytest -m slow tests/simulate/test_long_run.py``.
"""

import subprocess
import sys
import threading
import time
from pathlib import Path

import numpy as np
import psutil
import pytest
from simulate_cases import bent, n1013

from flexcage.results.store import RunStore

pytestmark = pytest.mark.slow

DURATION, KILLS = "10 s", 20
MARCH = """
import sys
from pathlib import Path
import flexcage
out = Path(sys.argv[2])
flexcage.simulate(flexcage.load_case(sys.argv[1]), out=out, resume=(out / "results.zarr").exists())
"""


def begin(case: Path, out: Path) -> subprocess.Popen:
    """A process that computes the run, or goes on with it."""
    return subprocess.Popen([sys.executable, "-c", MARCH, str(case), str(out)])


def committed(out: Path) -> int:
    """Samples that a reader sees at this moment."""
    if not (out / "results.zarr" / "_run" / "commit.json").exists():
        return 0
    return RunStore.open(out / "results.zarr").n_time


def watch(process: subprocess.Popen, out: Path, seen: list[tuple[int, float]]) -> None:
    """Committed samples and resident memory [MB] of a process while it lives."""
    it = psutil.Process(process.pid)
    while process.poll() is None:
        try:
            memory = it.memory_info().rss / 1e6  # first: what comes after the march takes more
            seen.append((committed(out), memory))
        except psutil.Error:
            return
        time.sleep(1.0)


@pytest.fixture(scope="module")
def case(tmp_path_factory) -> Path:
    written = n1013(
        {"solver.duration": DURATION, "output.rate": "10 kHz", "output.vibration_rate": "20 kHz"},
        defects=bent("0.2 mm"),
    )
    path = tmp_path_factory.mktemp("case") / "case.toml"
    path.write_text(written.to_toml(), encoding="utf-8")
    return path


def test_a_thousand_turns_and_twenty_kills(case, tmp_path):
    whole, broken = tmp_path / "whole", tmp_path / "broken"
    process, seen = begin(case, whole), []
    watcher = threading.Thread(target=watch, args=(process, whole, seen))
    watcher.start()
    assert process.wait() == 0
    watcher.join()
    total = RunStore.open(whole / "results.zarr").n_time
    marching = [(n, memory) for n, memory in seen if 0 < n < total]
    early = max(memory for n, memory in marching if n < 0.2 * total)
    late = max(memory for n, memory in marching if n > 0.8 * total)
    assert late < early + 30.0, (early, late)

    killed(case, broken, np.random.default_rng(11), total)
    assert begin(case, broken).wait() == 0
    same_runs(RunStore.open(whole / "results.zarr"), RunStore.open(broken / "results.zarr"))


def killed(case: Path, out: Path, rng: np.random.Generator, total: int) -> None:
    """Begin the run, kill it, go on with it, ``KILLS`` times, all along its ``total`` samples."""
    kept = 0
    for wanted in np.sort(rng.integers(1, total, KILLS)):
        process = begin(case, out)
        while committed(out) < wanted and process.poll() is None:
            time.sleep(0.1)
        time.sleep(rng.uniform(0.0, 0.3))
        process.kill()
        process.wait()
        now = committed(out)
        assert now >= max(kept, wanted), "a kill lost what had been committed"
        kept = now


def same_runs(one: RunStore, other: RunStore) -> None:
    """Datasets, steps and events, bit by bit."""
    ours, theirs = one.dataset(), other.dataset()
    assert set(ours.variables) == set(theirs.variables)
    for name in ours.variables:
        for first in range(0, ours[name].shape[0], 10_000):
            part = slice(first, first + 10_000)
            a, b = ours[name][part].values, theirs[name][part].values
            np.testing.assert_array_equal(a, b, err_msg=name)
    for table in ("steps", "events"):
        for column, values in getattr(one, table)().items():
            np.testing.assert_array_equal(values, getattr(other, table)()[column], err_msg=column)
