"""Dask's scheduler and workers as a user starts them by hand, and what dies of signal 9."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

PATIENCE = 300.0  # s that anything here may take on a busy machine


def start(*command: object, **options: Any) -> subprocess.Popen:
    """A process of this Python, in a session of its own, as a terminal starts it.

    What a shell puts in the background ignores Ctrl-C, and so do all that it starts: not this one.
    """
    return subprocess.Popen(
        [sys.executable, "-m", *map(str, command)],
        start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
        text=True,
        **options,
    )


def kill_family(process: subprocess.Popen) -> None:
    """Signal 9 to a process and all that descends from it, as when a machine goes off."""
    import psutil

    try:
        family = psutil.Process(process.pid).children(recursive=True)
    except psutil.NoSuchProcess:
        family = []
    for member in (process.pid, *(child.pid for child in family)):
        try:
            os.kill(member, signal.SIGKILL)
        except ProcessLookupError:
            continue
    process.wait()


def worker_of(lock: Path, pids: list[int]) -> int:
    """Process among ``pids`` that holds the lock of a case, and so computes it."""
    import psutil

    return next(
        pid
        for pid in pids
        if any(file.path == str(lock) for file in psutil.Process(pid).open_files())
    )


def wait_for(what: Callable[[], Any]) -> Any:
    """First true value of a condition; AssertionError if none comes."""
    end = time.monotonic() + PATIENCE
    while time.monotonic() < end:
        found = what()
        if found:
            return found
        time.sleep(0.01)
    raise AssertionError(f"waited {PATIENCE:g} s in vain")


@contextmanager
def dask_cluster(folder: Path, *, workers: int = 2) -> Iterator[tuple[str, subprocess.Popen]]:
    """Address of a scheduler on loopback with its workers, and the scheduler's process."""
    file = folder / "scheduler.json"
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    common = ("--host", "127.0.0.1", "--no-dashboard", "--scheduler-file", file)
    scheduler = start("distributed.cli.dask_scheduler", "--port", 0, *common, **quiet)
    crew = None
    try:
        address = wait_for(lambda: file.exists() and json.loads(file.read_text() or "{}"))
        crew = start(
            "distributed.cli.dask_worker", *common, "--nworkers", workers, "--nthreads", 1,
            "--local-directory", folder, **quiet,
        )  # fmt: skip
        yield address["address"], scheduler
    finally:
        for process in filter(None, (crew, scheduler)):
            kill_family(process)


def begun(folder: Path) -> list[Path]:
    """Folders of running cases that have committed a block and are not finished."""
    return [
        commit.parents[2]
        for commit in folder.glob("cases/*.part/results.zarr/_run/commit.json")
        if '"blocks": 0' not in commit.read_text()
    ]


def when_written(folder: Path) -> dict[str, int]:
    """When the row of every finished case was written, by hash."""
    rows = (p for p in folder.glob("cases/*/row.json") if p.parent.suffix != ".part")
    return {p.parent.name: p.stat().st_mtime_ns for p in rows}


def without_warnings(complained: str) -> str:
    """What a command wrote to stderr beside warnings of what its cases foresee."""
    lines = complained.splitlines(keepends=True)
    return "".join(line for line in lines if not line.startswith("warning: "))
