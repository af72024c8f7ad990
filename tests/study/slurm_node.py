"""SLURM on one node, this machine's loopback: munge and SLURM's two daemons, in a folder that goes
with them. It needs no root and leaves an installed SLURM alone."""

from __future__ import annotations

import getpass
import os
import secrets
import shutil
import signal
import socket
import subprocess
import tempfile
import time
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from pathlib import Path

PROGRAMS = ("munged", "slurmctld", "slurmd", "sbatch", "scancel", "squeue", "sinfo")
PATIENCE = 60.0  # s that a daemon may take to start
SEARCHED = f"{os.environ.get('PATH', '')}:/usr/sbin:/sbin"  # Debian's daemons are in /usr/sbin

CONFIGURATION = """
ClusterName=loopback
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmUser={user}
SlurmdUser={user}
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
MpiDefault=none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core_Memory
SlurmdParameters=config_overrides
KillWait=5
NodeName=localhost NodeAddr=127.0.0.1 CPUs={cores} RealMemory={memory} State=UNKNOWN
PartitionName=all Nodes=ALL Default=YES MaxTime=INFINITE State=UP
"""


def what_is_lacking() -> str:
    """What SLURM lacks on this machine, and how to install it; empty if nothing."""
    lacking = [name for name in PROGRAMS if shutil.which(name, path=SEARCHED) is None]
    if not lacking:
        return ""
    return f"no {', '.join(lacking)}; Debian: apt-get install slurm-wlm munge"


@contextmanager
def one_node_slurm(*, cores: int = 2, memory: int = 10_000) -> Iterator[dict[str, str]]:
    """Environment in which ``sbatch`` and its like find a SLURM of one node.

    The node is said to have ``cores`` cores and ``memory`` megabytes, whatever it has. Raises
    RuntimeError with the daemons' own words if they do not start.
    """
    with tempfile.TemporaryDirectory(prefix="slurm-") as name, ExitStack() as daemons:
        folder = Path(name)
        text = CONFIGURATION.format(
            folder=folder, user=getpass.getuser(), ports=_free_ports(2), cores=cores, memory=memory
        )
        (folder / "slurm.conf").write_text(text)
        for part in ("state", "spool"):
            (folder / part).mkdir()
        key = folder / "key"
        key.touch(0o600)
        key.write_bytes(secrets.token_bytes(1024))
        environment = {
            **os.environ, "PATH": SEARCHED, "SLURM_CONF": str(folder / "slurm.conf"),
        }  # fmt: skip
        files = {"key": key, "socket": folder / "munge.socket", "pid": folder / "munged.pid",
                 "seed": folder / "munged.seed", "log": folder / "munged.log"}  # fmt: skip
        munge = [f"--{what}-file={file}" for what, file in files.items() if what != "socket"]
        munge += ["--foreground", "--force", f"--socket={files['socket']}"]
        daemons.enter_context(_daemon(["munged", *munge], environment, folder))
        _wait_until(files["socket"].exists)
        daemons.enter_context(_daemon(["slurmctld", "-D"], environment, folder))
        daemons.enter_context(_daemon(["slurmd", "-D", "-N", "localhost"], environment, folder))
        _wait_for_node(environment, folder)
        try:
            yield environment
        finally:
            subprocess.run(["scancel", "--user", getpass.getuser()], env=environment)
            _wait_until(lambda: not said("squeue", "--noheader", env=environment))


def _free_ports(count: int) -> list[int]:
    """Ports of loopback that nothing listens to."""
    with ExitStack() as held:
        sockets = [held.enter_context(socket.socket()) for _ in range(count)]
        for each in sockets:
            each.bind(("127.0.0.1", 0))
        return [each.getsockname()[1] for each in sockets]


@contextmanager
def _daemon(command: list[str], environment: dict[str, str], folder: Path) -> Iterator[None]:
    with open(folder / f"{command[0]}.out", "wb") as output:
        process = subprocess.Popen(
            command, env=environment, cwd=folder, stdout=output, stderr=output,
            start_new_session=True,
        )  # fmt: skip
    try:
        yield
    finally:
        process.send_signal(signal.SIGTERM)
        try:
            process.wait(PATIENCE)
        except subprocess.TimeoutExpired:
            process.kill()
            process.wait()


def _wait_for_node(environment: dict[str, str], folder: Path) -> None:
    """Return once the node takes jobs."""
    if not _wait_until(lambda: "idle" in said("sinfo", "-h", "-o", "%T", env=environment)):
        words = [f"{p.name}: {p.read_text(errors='replace')}" for p in folder.glob("*.out")]
        raise RuntimeError("SLURM does not start here\n" + "\n".join(words))


def said(*command: str, env: dict[str, str]) -> str:
    """What a command prints."""
    return subprocess.run(command, env=env, capture_output=True, text=True).stdout.strip()


def _wait_until(condition) -> bool:
    end = time.monotonic() + PATIENCE
    while not condition():
        if time.monotonic() > end:
            return False
        time.sleep(0.2)
    return True
