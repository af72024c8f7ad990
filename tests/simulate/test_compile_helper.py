"""The process that helps to compile ends with the one that started it."""

import os
import signal
import subprocess
import sys
import time

import numba
import pytest

STARTS = """
import time
import flexcage
from flexcage.stages import begin_compiling
print(begin_compiling(flexcage.Case.from_preset("N1013")).helper.pid, flush=True)
time.sleep(600)
"""


def runs(pid: int) -> bool:
    import psutil

    try:
        return psutil.Process(pid).status() != psutil.STATUS_ZOMBIE
    except psutil.NoSuchProcess:
        return False


@pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="plain Python compiles nothing")
@pytest.mark.skipif(os.name != "posix", reason="a process there does not see its parent end")
def test_the_helper_ends_when_its_parent_is_killed(tmp_path):
    env = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path)}
    parent = subprocess.Popen([sys.executable, "-c", STARTS], stdout=subprocess.PIPE, env=env)
    helper = int(parent.stdout.readline())
    assert runs(helper)
    os.kill(parent.pid, signal.SIGKILL)
    parent.wait()
    end = time.monotonic() + 60.0  # far less than it would take without looking
    while runs(helper) and time.monotonic() < end:
        time.sleep(0.1)
    found = list(tmp_path.rglob("*.nbc"))
    assert not runs(helper)
    assert len(found) < 20, "it had compiled all that there is"
