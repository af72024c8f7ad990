"""Where a study's cases run: a Dask cluster of processes made here, or a scheduler by address.

The local scheduler and its workers are processes of their own (``dask_process``): a script that
calls ``run_study`` then needs no ``if __name__ == "__main__"``, Ctrl-C reaches this process alone,
and what Dask remembers of its tasks is not this process's memory. They answer this study alone, by
a certificate made for it, and end with this process, however it ends.
"""

from __future__ import annotations

import asyncio
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

from flexcage.compiling import SAME_PACKAGE
from flexcage.core.errors import EnvironmentLacks, InputError, RunFailed, install
from flexcage.core.stopping import check

log = logging.getLogger(__name__)

_MAIN = "from flexcage.study.dask_process import main; main(*sys.argv[1:])"

ANSWER = 5.0  # s that a scheduler has to answer
START = 60.0  # s for the local cluster's processes to start
PREFIX = "flexcage-dask-"  # of the folders of local clusters
_HELD = "held.lock"  # in such a folder, by the process that uses it
_STALE = 60.0  # s, the age from which a folder that nobody holds is one of a killed process
_PACKAGES = {
    "distributed": "dask.distributed", "pyarrow": "pyarrow", "cryptography": "cryptography",
}  # fmt: skip
_CHATTY = ("distributed", "asyncio", "tornado")  # loggers: we say it in our own words


def require_packages() -> None:
    """Raise EnvironmentLacks if a package that studies need is not installed."""
    for module, name in _PACKAGES.items():
        if find_spec(module) is None:
            raise EnvironmentLacks(
                f"Studies need {name}, which is not installed here; install it {install('study')}"
            )


@contextmanager
def connect(scheduler: Any, workers: int | None) -> Iterator[Any]:
    """Client of a scheduler, given by its address or as a Dask cluster, whose certificate is taken
    as well, or of a local cluster of ``workers`` processes."""
    if scheduler is not None:
        address = getattr(scheduler, "scheduler_address", scheduler)
        with _client(address, getattr(scheduler, "security", None), timeout=ANSWER) as client:
            _warn_if_open(address)
            if not client.nthreads():
                log.info("the scheduler has no workers yet; the cases wait for them")
            yield client
        return
    with _folder() as folder, _local_cluster(folder, workers or default_workers()) as address:
        from flexcage.study.dask_process import security_of

        with _client(address, security_of(folder), timeout=START) as client:
            yield client


def _warn_if_open(address: Any) -> None:
    if str(address).startswith("tcp:"):
        log.warning(
            "the scheduler at '%s' and its workers run what anyone sends who can reach them; start "
            "them with certificates (tls://), as examples/studies.md shows.",
            address,
        )


@contextmanager
def _folder() -> Iterator[Path]:
    """A folder for a local cluster, which the user alone may read; those of killed processes are
    removed before."""
    import filelock

    from flexcage.study.dask_process import remove

    _remove_stale()
    folder = Path(tempfile.mkdtemp(prefix=PREFIX))
    try:
        with filelock.FileLock(folder / _HELD):
            yield folder
    finally:
        remove(folder)


def _remove_stale() -> None:
    """Remove the user's folders of local clusters that no living process holds."""
    import filelock

    from flexcage.study.dask_process import remove

    for folder in Path(tempfile.gettempdir()).glob(f"{PREFIX}*"):
        with suppress(OSError, filelock.Timeout):
            found = folder.lstat()
            mine = not hasattr(os, "getuid") or found.st_uid == os.getuid()
            if folder.is_symlink() or not mine or time.time() - found.st_mtime < _STALE:
                continue
            with filelock.FileLock(folder / _HELD, timeout=0):
                remove(folder)


def default_workers() -> int:
    """As many workers as this process may use cores."""
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


@contextmanager
def _client(address: str, security: Any, *, timeout: float) -> Iterator[Any]:
    import distributed

    with _silence():
        try:
            with ThreadPoolExecutor(1) as aside:  # a notebook runs an event loop of its own
                aside.submit(asyncio.run, _knock(address, security, timeout)).result()
            client = distributed.Client(
                address, timeout=timeout, set_as_default=False, security=security
            )
        except (OSError, TimeoutError, TypeError, ValueError, RuntimeError) as exc:
            raise InputError(
                f"No scheduler answers at '{address}' within {timeout:g} s; start one with 'dask "
                "scheduler' and give its address, such as 'tls://127.0.0.1:8786', with its "
                "certificates in Dask's configuration, or leave it out to use this machine's "
                "cores.",
                where="scheduler",
                value=address,
            ) from exc
        try:
            yield client
        finally:
            with suppress(OSError, TimeoutError, RuntimeError):  # one that is lost says no goodbye
                client.close(timeout=2)


@contextmanager
def _silence() -> Iterator[None]:
    """Let Dask and its event loop say nothing, as of a scheduler that is lost."""
    known = list(logging.root.manager.loggerDict)  # Dask gives many of its own a level and a stream
    names = {*_CHATTY, *(name for name in known if name.partition(".")[0] in _CHATTY)}
    loggers = [logging.getLogger(name) for name in names]
    levels = [logger.level for logger in loggers]
    for logger in loggers:
        logger.setLevel(logging.CRITICAL + 1)
    try:
        yield
    finally:
        for logger, level in zip(loggers, levels):
            logger.setLevel(level)


async def _knock(address: str, security: Any, timeout: float) -> None:
    """Raise an error unless a scheduler answers; Dask's client waits for ever on a stranger."""
    import distributed

    arguments = (security or distributed.Security()).get_connection_args("client")
    async with distributed.rpc(address, timeout=timeout, connection_args=arguments) as server:
        identity = await asyncio.wait_for(server.identity(), timeout)
    if identity.get("type") != "Scheduler":
        raise ValueError(f"{address} is a {identity.get('type')}")


@contextmanager
def _local_cluster(folder: Path, workers: int) -> Iterator[str]:
    """Address of a scheduler on this machine with ``workers`` workers of one thread each."""
    from flexcage.study.dask_process import make_certificate

    make_certificate(folder)
    with open(folder / "log", "wb") as output:
        scheduler = _start(folder, output=output)
        crew = None
        try:
            found = _address(folder, scheduler)
            crew = _start(folder, found, workers, output=output)
            yield found
        finally:
            for process in filter(None, (crew, scheduler)):
                _stop(process)


def _start(*options: object, output: IO[bytes]) -> subprocess.Popen:
    """A scheduler (of a folder), or workers (of a folder, an address, and how many)."""
    command = [sys.executable, "-c", f"{SAME_PACKAGE}; {_MAIN}", os.getpid(), *options]
    environment = {**os.environ, "DASK_LOGGING__DISTRIBUTED": "error"}
    return subprocess.Popen(
        list(map(str, command)), stdin=subprocess.DEVNULL, stdout=output, stderr=output,
        env=environment, start_new_session=True,
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


def _address(folder: Path, scheduler: subprocess.Popen) -> str:
    """Address that a starting scheduler writes to a file."""
    from flexcage.study.dask_process import ADDRESS

    end = time.monotonic() + START
    while scheduler.poll() is None and time.monotonic() < end:
        check()
        with suppress(OSError):  # not there yet
            return (folder / ADDRESS).read_text("utf-8")
        time.sleep(0.05)
    lines = (folder / "log").read_text("utf-8", errors="replace").strip().splitlines()
    reason = f" ({lines[-1]})" if lines else ""
    raise RunFailed(f"Dask's scheduler did not start on this machine{reason}.")
