"""Where a study's cases run: a Dask cluster of processes made here, or a scheduler by address.

The local scheduler and its workers are processes of their own, started by Dask's command line: a
script that calls ``run_study`` then needs no ``if __name__ == "__main__"``, Ctrl-C reaches this
process alone, and what Dask remembers of its tasks is not this process's memory.
"""

from __future__ import annotations

import asyncio
import json
import logging
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress
from importlib.util import find_spec
from pathlib import Path
from typing import IO, Any

from flexcage.core.errors import EnvironmentLacks, InputError, RunFailed, install

log = logging.getLogger(__name__)

ANSWER = 5.0  # s that a scheduler has to answer
START = 60.0  # s for the local cluster's processes to start
ORPHAN = "60 s"  # without client, scheduler or work, a local process ends after this
_PACKAGES = {"distributed": "dask.distributed", "pyarrow": "pyarrow"}


def require_packages() -> None:
    """Raise EnvironmentLacks if a package that studies need is not installed."""
    for module, name in _PACKAGES.items():
        if find_spec(module) is None:
            raise EnvironmentLacks(
                f"Studies need {name}, which is not installed here; install it {install('study')}"
            )


@contextmanager
def connect(scheduler: str | None, workers: int | None) -> Iterator[Any]:
    """Client of the scheduler at an address, or of a local cluster of ``workers`` processes."""
    if scheduler is not None:
        with _client(scheduler, timeout=ANSWER) as client:
            if not client.nthreads():
                log.info("the scheduler has no workers yet; the cases wait for them")
            yield client
        return
    with tempfile.TemporaryDirectory(prefix="flexcage-dask-") as folder:
        with _local_cluster(Path(folder), workers or default_workers()) as address:
            with _client(address, timeout=START) as client:
                yield client


def default_workers() -> int:
    """As many workers as this process may use cores."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


@contextmanager
def _client(address: str, *, timeout: float) -> Iterator[Any]:
    import distributed

    logging.getLogger("distributed").setLevel(logging.CRITICAL)  # we say it in our own words
    try:
        with ThreadPoolExecutor(1) as aside:  # a notebook runs an event loop of its own
            aside.submit(asyncio.run, _knock(address, timeout)).result()
        client = distributed.Client(address, timeout=timeout, set_as_default=False)
    except (OSError, TimeoutError, TypeError, ValueError) as exc:
        raise InputError(
            f"No scheduler answers at '{address}' within {timeout:g} s; start one with 'dask "
            "scheduler' and give its address, such as 'tcp://127.0.0.1:8786', or leave it out to "
            "use this machine's cores.",
            where="scheduler",
            value=address,
        ) from exc
    try:
        yield client
    finally:
        with suppress(OSError, TimeoutError):  # a scheduler that is lost, or busy, says no goodbye
            client.close(timeout=2)


async def _knock(address: str, timeout: float) -> None:
    """Raise an error unless a scheduler answers; Dask's client waits for ever on a stranger."""
    import distributed

    async with distributed.rpc(address, timeout=timeout) as server:
        identity = await asyncio.wait_for(server.identity(), timeout)
    if identity.get("type") != "Scheduler":
        raise ValueError(f"{address} is a {identity.get('type')}")


@contextmanager
def _local_cluster(folder: Path, workers: int) -> Iterator[str]:
    """Address of a scheduler on this machine with ``workers`` workers of one thread each."""
    address = folder / "scheduler.json"
    with open(folder / "log", "wb") as output:
        scheduler = _start(
            "scheduler", "--host", "127.0.0.1", "--port", "0", "--no-dashboard",
            "--scheduler-file", address, "--idle-timeout", ORPHAN, output=output,
        )  # fmt: skip
        crew = None
        try:
            found = _address(address, scheduler, folder / "log")
            crew = _start(
                "worker", "--scheduler-file", address, "--host", "127.0.0.1", "--nworkers", workers,
                "--nthreads", 1, "--memory-limit", 0, "--no-dashboard", "--death-timeout", 60,
                "--local-directory", folder, output=output,
            )  # fmt: skip
            yield found
        finally:
            for process in filter(None, (crew, scheduler)):
                _stop(process)


def _start(what: str, *options: object, output: IO[bytes]) -> subprocess.Popen:
    command = [sys.executable, "-m", f"distributed.cli.dask_{what}", *map(str, options)]
    environment = {**os.environ, "DASK_LOGGING__DISTRIBUTED": "error"}
    return subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=output, stderr=output, env=environment,
        start_new_session=True,
    )  # fmt: skip


def _stop(process: subprocess.Popen) -> None:
    """End a process and those that it started."""
    import psutil

    try:
        family = psutil.Process(process.pid).children(recursive=True)
    except psutil.NoSuchProcess:
        family = []
    process.kill()
    process.wait()
    for child in family:
        try:
            child.kill()
        except psutil.NoSuchProcess:
            continue


def _address(file: Path, scheduler: subprocess.Popen, output: Path) -> str:
    """Address that a starting scheduler writes to a file."""
    end = time.monotonic() + START
    while scheduler.poll() is None and time.monotonic() < end:
        try:
            return str(json.loads(file.read_text("utf-8"))["address"])
        except (OSError, ValueError):  # not there yet, or half written
            time.sleep(0.05)
    lines = output.read_text("utf-8", errors="replace").strip().splitlines()
    reason = f" ({lines[-1]})" if lines else ""
    raise RunFailed(f"Dask's scheduler did not start on this machine{reason}.")
