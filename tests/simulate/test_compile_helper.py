"""The process that helps to compile ends with the one that started it."""

import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numba
import pytest

OWN = Path(__file__).parents[1] / "examples" / "my_family.py"
STARTS = """
import time
import flexcage
from flexcage.compiling import begin_compiling
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
    found = list(tmp_path.rglob("*.kernel"))
    assert not runs(helper)
    assert len(found) < 20, "it had compiled all that there is"


BUILDS = """
import sys
sys.modules["gmsh"] = None
from pathlib import Path
from flexcage.compiling import compile_pieces
compile_pieces(Path(sys.argv[1]).read_text("utf-8"), sys.argv[2])
"""


@pytest.mark.skipif(bool(numba.config.DISABLE_JIT), reason="plain Python compiles nothing")
def test_the_helper_knows_a_users_family_and_needs_no_mesh():
    """It gets the case and the user's files; here no piece is left for it to compile."""
    done = subprocess.run(
        [sys.executable, "-c", BUILDS, str(OWN.with_suffix(".toml")), str(OWN)],
        stdin=subprocess.DEVNULL, capture_output=True, text=True, check=False,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
