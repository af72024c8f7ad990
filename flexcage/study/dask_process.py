"""Dask's scheduler and workers of one study, each a process that this module is the whole of.

They answer only who has the study's certificate, on loopback only, and serve no HTTP, which Dask's
own commands do even without a dashboard. They end with the process that started them, also if that
one is killed, and the scheduler then removes their folder.
"""

from __future__ import annotations

import asyncio
import os
import shutil
import sys
import time
from pathlib import Path
from typing import Any

import dask
import distributed
from distributed.security import Security

from flexcage.core.orphan import end_with

HOST = "tls://127.0.0.1"
CERTIFICATE, KEY, ADDRESS = "certificate.pem", "key.pem", "address"
_ORPHAN = 60.0  # s; without client, scheduler or work, a process ends after this in any case
# Dask's profile of a worker's calls, an hour of it, grew by 1.7 MB a case (measured)
_TRIES = 20  # at removing a folder into which a dying worker may still write


class _WithoutHttp:
    """Part of a server of Dask that listens to its own protocol alone."""

    def start_http_server(self, *args: Any, **kwargs: Any) -> None:
        """Start none."""


class Scheduler(_WithoutHttp, distributed.Scheduler):
    """A scheduler without HTTP; by its class's name it says what it is."""


class Worker(_WithoutHttp, distributed.Worker):
    """A worker without HTTP."""


def make_certificate(folder: Path) -> None:
    """Write a new certificate and its key into a folder that the user alone may read."""
    made = Security.temporary()
    for name, text in ((CERTIFICATE, made.tls_ca_file), (KEY, made.tls_client_key)):
        with open(os.open(folder / name, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w") as file:
            file.write(text)


def security_of(folder: Path) -> Security:
    """What lets client, scheduler and workers of a study know each other."""
    certificate, key = str(folder / CERTIFICATE), str(folder / KEY)
    parts: dict[str, str] = {}
    for role in ("client", "scheduler", "worker"):
        parts |= {f"tls_{role}_cert": certificate, f"tls_{role}_key": key}
    return Security(require_encryption=True, tls_ca_file=certificate, **parts)


def remove(folder: Path) -> None:
    """Remove a folder, in which something may still be written for a moment."""
    for _ in range(_TRIES):
        shutil.rmtree(folder, ignore_errors=True)
        if not folder.exists():
            return
        time.sleep(0.1)


async def _schedule(folder: Path) -> None:
    scheduler = Scheduler(
        host=HOST, port=0, dashboard=False, security=security_of(folder), idle_timeout=_ORPHAN
    )
    await scheduler
    written = folder / f"{ADDRESS}.new"
    written.write_text(scheduler.address, encoding="utf-8")
    os.replace(written, folder / ADDRESS)
    await scheduler.finished()


async def _work(folder: Path, address: str, count: int) -> None:
    guards = [
        distributed.Nanny(
            address, nthreads=1, host="127.0.0.1", memory_limit=0, death_timeout=_ORPHAN,
            dashboard=False, local_directory=str(folder), security=security_of(folder),
            worker_class=Worker, name=str(k),
        )
        for k in range(count)
    ]  # fmt: skip
    await asyncio.gather(*guards)
    await asyncio.gather(*(guard.finished() for guard in guards))


def main(parent: str, folder: str, address: str = "", count: str = "") -> None:
    """Be the scheduler of a folder, or workers for one at ``address``, until ``parent`` ends."""
    home = Path(folder)
    end_with(int(parent), then=(lambda: None) if address else (lambda: remove(home)))
    dask.config.set({"temporary-directory": folder, "distributed.worker.profile.enabled": False})
    asyncio.run(_work(home, address, int(count)) if address else _schedule(home))


if __name__ == "__main__":
    main(*sys.argv[1:])
