"""Processes that compile small kernels: one has loaded numba, and forks for every script."""

import json
import os
import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

WARM = """
import json, os, sys
import numba

@numba.njit
def first(x):
    return x

first(1.0)  # what numba sets up at its first compilation
for line in sys.stdin:
    code, folder, env, paths = json.loads(line)
    child = os.fork()
    if not child:
        os.chdir(folder)
        for number, name in ((1, "said"), (2, "told")):
            os.dup2(os.open(name, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), number)
        os.environ.update(env)
        sys.path[:0] = paths
        exec(compile(code, "code", "exec"), {"__name__": "__main__"})
        sys.stdout.flush()
        os._exit(0)
    print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), flush=True)
"""


@contextmanager
def warm_process() -> Iterator[subprocess.Popen]:
    """A process that has loaded numba and no more, and forks for every script: a second less."""
    env = {k: v for k, v in os.environ.items() if k != "NUMBA_CACHE_DIR"}
    env["PYTHONDONTWRITEBYTECODE"] = "1"  # an edit within a second is seen
    pipes = {"stdin": subprocess.PIPE, "stdout": subprocess.PIPE, "text": True}
    with subprocess.Popen([sys.executable, "-c", WARM], env=env, **pipes) as process:
        yield process
        process.stdin.close()


def said_and_told(
    warm: subprocess.Popen, code: str, folder: Path, cache: Path, *paths: Path
) -> tuple[str, str]:
    """Standard output and error of a process that runs the code in a folder, with a cache of its
    own and further folders to import from."""
    env = {"FLEXCAGE_CACHE_DIR": str(cache)}
    job = code, str(folder), env, [str(path) for path in paths]
    print(json.dumps(job), file=warm.stdin, flush=True)
    done, told = warm.stdout.readline(), (folder / "told").read_text()
    assert done == "0\n", told
    return (folder / "said").read_text(), told
