"""Scheduler and workers of a study: whom they answer, where they listen, and when they end."""

import asyncio
import io
import os
import signal
import socket
import subprocess
import sys
import tempfile
import time
from contextlib import suppress
from types import SimpleNamespace

import pytest
from dask_processes import PATIENCE, start, wait_for, when_written, without_warnings
from study_cases import short_study, study_file

from flexcage.core.progress import Progress
from flexcage.study import cluster
from flexcage.study.axes import Grid
from flexcage.study.cluster import PREFIX, connect
from flexcage.study.run import run_study

SOON = 8.0  # s, within which processes end (measured: 0.6 s), on a busy machine
LOADS = ["500 N", "1000 N", "1500 N", "2000 N"]
HOLDS = """
import time
from flexcage.study.cluster import connect
with connect(None, 1) as client:
    client.wait_for_workers(1)
    print("ready", flush=True)
    time.sleep(600)
"""


def family():
    import psutil

    return psutil.Process().children(recursive=True)


@pytest.fixture(scope="module")
def client():
    with connect(None, 2) as found:
        found.wait_for_workers(2)
        yield found


def listening():
    """Address and port of every socket on which this process's children listen."""
    connections = [c for p in family() for c in p.net_connections(kind="inet")]
    return [tuple(c.laddr) for c in connections if c.status == "LISTEN"]


def test_a_study_listens_on_loopback_alone_and_serves_no_http(client):
    places = listening()
    assert len(places) >= 4  # scheduler, two guards or more, two workers
    assert {host for host, _ in places} == {"127.0.0.1"}
    for place in places:
        with socket.create_connection(place, timeout=1.0) as stranger:
            stranger.sendall(b"GET /health HTTP/1.0\r\n\r\n")
            answer = b""
            with suppress(OSError):  # it hangs up, or waits for a handshake
                answer = stranger.recv(100)
            assert b"HTTP" not in answer


async def ask(address, security):
    """What a server of Dask says of itself."""
    import distributed

    arguments = security.get_connection_args("client")
    async with distributed.rpc(address, timeout=2, connection_args=arguments) as server:
        return await asyncio.wait_for(server.identity(), 3)


def test_scheduler_and_workers_answer_nobody_without_the_certificate(client):
    """As another user on this machine would ask, plainly or with a certificate of his own."""
    from distributed.security import Security

    addresses = [client.scheduler.address, *client.nthreads()]
    assert len(addresses) == 3
    assert all(address.startswith("tls://127.0.0.1:") for address in addresses)
    for address in addresses:
        assert asyncio.run(ask(address, client.security))["id"]  # its own may
        for stranger in (Security.temporary(), Security(require_encryption=False)):
            for asked in (address, address.replace("tls:", "tcp:")):
                with pytest.raises((OSError, TimeoutError, RuntimeError, TypeError)):
                    asyncio.run(ask(asked, stranger))


def test_a_study_on_a_cluster_with_certificates_shows_what_its_workers_do(client, tmp_path):
    """The cluster is given as an object, as dask-jobqueue's are: its certificates come with it."""
    stream, places = io.StringIO(), SimpleNamespace()
    places.scheduler_address, places.security = client.scheduler.address, client.security
    study = short_study(Grid("load.radial", LOADS[:2]))
    results = run_study(
        study, out=tmp_path / "out", scheduler=places,
        progress=lambda total, label: Progress(total, label, stream=stream, enabled=True),
    )  # fmt: skip
    assert results.count("done") == 2
    shown = stream.getvalue()
    assert "0 of 2 done, 2 workers" in shown and "cases: done at 100 %" in shown
    assert any(f"case {k} {stage}" in shown for k in (0, 1) for stage in ("kernels", "mesh"))


def test_workers_keep_no_profile_which_grew_by_megabytes_a_case(client):
    import dask

    kept = client.run(dask.config.get, "distributed.worker.profile.enabled")
    assert list(kept.values()) == [False, False]


def test_certificates_are_for_the_user_alone(client):
    (folder,) = (
        path for path in (cluster.Path(tempfile.gettempdir()).glob(f"{PREFIX}*"))
        if str(path) == os.path.dirname(client.security.tls_client_key)
    )  # fmt: skip
    assert folder.stat().st_mode & 0o077 == 0
    for name in ("certificate.pem", "key.pem"):
        assert (folder / name).stat().st_mode & 0o077 == 0


@pytest.mark.parametrize("end", ["SIGTERM", "SIGHUP", "SIGKILL"])
def test_processes_and_folder_go_with_the_parent(end, tmp_path):
    import psutil

    parent = subprocess.Popen(
        [sys.executable, "-c", HOLDS], stdout=subprocess.PIPE,
        env={**os.environ, "TMPDIR": str(tmp_path)},
    )  # fmt: skip
    assert parent.stdout.readline() == b"ready\n"
    children = psutil.Process(parent.pid).children(recursive=True)
    assert len(children) >= 3 and list(tmp_path.glob(f"{PREFIX}*"))
    parent.send_signal(getattr(signal, end))
    parent.wait()
    assert not psutil.wait_procs(children, timeout=SOON)[1]
    assert not list(tmp_path.iterdir())


def test_folders_of_killed_processes_are_removed_and_others_stay(tmp_path, monkeypatch):
    import filelock

    monkeypatch.setattr(tempfile, "tempdir", str(tmp_path))
    old = time.time() - 2 * cluster._STALE
    dead, held, young = (tmp_path / f"{PREFIX}{name}" for name in ("dead", "held", "young"))
    for folder in (dead, held, young):
        folder.mkdir()
        (folder / "log").touch()
    elsewhere, link = tmp_path / "elsewhere", tmp_path / f"{PREFIX}link"
    elsewhere.mkdir()
    link.symlink_to(elsewhere)
    with filelock.FileLock(held / cluster._HELD):
        for folder in (dead, held, elsewhere):
            os.utime(folder, (old, old))
        cluster._remove_stale()
        left = {path.name for path in tmp_path.iterdir()}
    assert left == {held.name, young.name, elsewhere.name, link.name}


def run_of(tmp_path):
    """The command line at work on a study of a few cases, once the first is finished."""
    axis = f'[[axes]]\npath = "load.radial"\nvalues = {LOADS}'
    file, out = study_file(tmp_path, axis, duration="4 ms"), tmp_path / "out"
    pipes = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
    command = ("flexcage.cli", "study", "run", file, "-o", out, "--workers", 1)
    process = start(*command, **pipes)
    wait_for(lambda: when_written(out) or process.poll() is not None)
    return process, out


def test_a_lost_scheduler_is_one_sentence(tmp_path):
    import psutil

    process, out = run_of(tmp_path)
    (scheduler,) = (
        child for child in psutil.Process(process.pid).children()
        if "dask_process" in " ".join(child.cmdline()) and "tls:" not in " ".join(child.cmdline())
    )  # fmt: skip
    scheduler.kill()
    said, complained = process.communicate(timeout=PATIENCE)
    assert (process.returncode, said) == (1, "")
    assert "is lost; what is finished is kept in" in complained
    assert without_warnings(complained).count("\n") == 1, complained
    assert when_written(out)


@pytest.mark.parametrize("end, code", [("SIGTERM", 143), ("SIGHUP", 129)])
def test_a_terminated_study_says_so_and_keeps_its_tables(end, code, tmp_path):
    import psutil

    process, out = run_of(tmp_path)
    children = psutil.Process(process.pid).children(recursive=True)
    process.send_signal(getattr(signal, end))
    said, complained = process.communicate(timeout=PATIENCE)
    assert (process.returncode, said) == (code, ""), complained
    assert f"'flexcage study resume {out}' goes on" in complained
    assert without_warnings(complained).count("\n") == 1
    assert not psutil.wait_procs(children, timeout=SOON)[1]
    table = (out / "table.csv").read_text()
    assert table.count("\n") == 1 + len(LOADS) and "done" in table
    assert not (out / "running.lock").exists()
