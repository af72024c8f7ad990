"""Compiled kernels on disk: damaged, full and read-only caches cost time and never a result."""

import os
import shutil
import subprocess
import sys
import tempfile
import time
from errno import EACCES, ENOSPC
from functools import partial
from pathlib import Path

import numba
import pytest
from warm_process import said_and_told, warm_process

from flexcage.core import environment, kernel_files
from flexcage.core.kernel_files import damaged

pytestmark = pytest.mark.skipif(
    bool(numba.config.DISABLE_JIT), reason="plain Python compiles nothing"
)

SCRIPT = """
import logging
logging.basicConfig(format="%(message)s")
import numpy as np
from flexcage.core.jit import kernel

@kernel
def inner(x, out):
    out[0] = 3.0 * x

@kernel
def whole(x, out):
    inner(x + 1.0, out)

out = np.zeros(1)
whole(2.0, out)
assert out[0] == 9.0, out
print(sum(whole.stats.cache_hits.values()))
"""

REFUSES = """
import builtins, errno
own = builtins.open
def refusing(file, mode="r", *args, **kwargs):
    if "w" in mode and {folder!r} in str(file):
        raise OSError(errno.{name}, os.strerror(errno.{name}), str(file))
    return own(file, mode, *args, **kwargs)
import os, tempfile
builtins.open = refusing
def no_file(*args, dir=None, **kwargs):
    if dir is not None and {folder!r} in str(dir):
        raise OSError(errno.{name}, os.strerror(errno.{name}), str(dir))
    return own_temporary(*args, dir=dir, **kwargs)
own_temporary = tempfile.TemporaryFile
tempfile.TemporaryFile = no_file
"""


@pytest.fixture(scope="module")
def script(tmp_path_factory):
    """Folder of the script: numba knows kernels by where their source is."""
    folder = tmp_path_factory.mktemp("script")
    (folder / "own_kernel.py").write_text(SCRIPT, encoding="utf-8")
    return folder


@pytest.fixture(scope="module")
def built(warm, script, tmp_path_factory):
    """A cache into which one process has written the kernel."""
    folder = tmp_path_factory.mktemp("built")
    assert ran(warm, script, folder) == (0, "")
    return folder / "cache"


@pytest.fixture
def run(warm, script, tmp_path):
    """run(before) -> (kernels read from disk, what was warned of) of a process with a kernel."""
    return partial(ran, warm, script, tmp_path)


@pytest.fixture(scope="module")
def warm():
    with warm_process() as process:
        yield process


def ran(warm: subprocess.Popen, script: Path, folder: Path, before: str = "") -> tuple[int, str]:
    """What a process of the script with a cache in this folder read from disk and warned of."""
    code = f"{before}\nimport own_kernel"
    said, told = said_and_told(warm, code, folder, folder / "cache", script, folder)
    return int(said), told


@pytest.fixture
def cached(tmp_path, built):
    """The folder of ``run``, with a copy of the cache that has been built."""
    shutil.copytree(built, tmp_path / "cache")


def entries(tmp_path: Path) -> list[Path]:
    return [p for p in (tmp_path / "cache").rglob("own_kernel.whole*") if p.is_file()]


DAMAGES = {
    "empty": lambda data: b"",
    "half": lambda data: data[: len(data) // 2],
    "text": lambda data: b"hello",
    "zeros": lambda data: bytes(len(data)),
    "flipped": lambda data: data[: len(data) // 2] + bytes([data[len(data) // 2] ^ 1])
    + data[len(data) // 2 + 1 :],
}  # fmt: skip


@pytest.mark.parametrize("damage", DAMAGES)
def test_a_damaged_kernel_is_compiled_anew(tmp_path, run, cached, damage):
    (file,) = entries(tmp_path)
    file.write_bytes(DAMAGES[damage](file.read_bytes()))
    hits, told = run()
    assert hits == 0 and len(told.splitlines()) == 1
    assert "own_kernel.whole" in told and "cannot be read" in told
    assert run() == (1, "")


def test_old_versions_of_a_kernel_go_when_nobody_reads_them(tmp_path, script, run, cached):
    """One is old when it was neither written nor read for a month; another kernel's stay."""
    (current,) = entries(tmp_path)
    old, read, other = (
        current.with_name(name) for name in (
            f"own_kernel.whole-{'1' * 32}.kernel", f"own_kernel.whole-{'2' * 32}.kernel",
            f"own_kernel.whole_of_it-{'3' * 32}.kernel",
        )
    )  # fmt: skip
    shutil.copy(current, old), shutil.copy(current, read), shutil.copy(current, other)
    long_ago = time.time() - 31 * 86400.0
    for path in (old, read, other, current):
        os.utime(path, (long_ago, long_ago))
    kernel_files.mark_as_used(read)
    assert run() == (1, "")  # the current one was read
    current.unlink()
    assert run() == (0, "")
    assert set(entries(tmp_path)) == {current, read, other}


def test_the_doctor_names_a_damaged_kernel(tmp_path, cached, monkeypatch):
    folder = tmp_path / "cache" / "kernels"
    assert damaged(folder) == []
    (file,) = entries(tmp_path)
    data = bytearray(file.read_bytes())
    data[len(data) // 2] ^= 1  # what unpickles as before and would run as another program
    file.write_bytes(data)
    assert damaged(folder) == [file]
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "cache"))
    finding = environment._kernel_cache()
    assert not finding.ok and file.name in finding.detail
    assert "flexcage cache --clear" in finding.remedy


@pytest.mark.parametrize("name", ["ENOSPC", "EACCES", "EROFS", "EDQUOT"])
def test_a_cache_that_cannot_be_written_is_told_once(tmp_path, run, name):
    folder = str(tmp_path / "cache")
    hits, told = run(REFUSES.format(folder=folder, name=name))
    assert hits == 0 and len(told.splitlines()) == 1
    assert f"'{folder}'" in told and "FLEXCAGE_CACHE_DIR" in told
    assert not entries(tmp_path)
    assert run() == (0, "")  # once it can be written, kernels are kept as ever
    assert run() == (1, "")


def test_kernels_of_a_read_only_cache_are_read(tmp_path, run, cached):
    assert run(REFUSES.format(folder=str(tmp_path / "cache"), name="EROFS")) == (1, "")


def test_without_any_folder_every_process_compiles(tmp_path, run):
    (tmp_path / "cache").write_text("in the way")
    assert run()[0] == 0
    nowhere = "import tempfile\ndef no(**_):\n    raise OSError(28, 'full')\ntempfile.mkdtemp = no"
    hits, told = run(nowhere)
    assert hits == 0 and len(told.splitlines()) == 1


def test_never_beside_the_sources(tmp_path, script, run):
    """There a change in a callee of another file would go unseen."""
    (tmp_path / "cache").write_text("in the way")
    run()
    assert not [p for folder in (tmp_path, script) for p in folder.rglob("*.kernel")]


@pytest.mark.parametrize("number", [ENOSPC, EACCES])
def test_the_doctor_names_a_folder_that_cannot_be_written(tmp_path, monkeypatch, number):
    def refuse(*args, **kwargs):
        raise OSError(number, os.strerror(number))

    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.setattr(tempfile, "TemporaryFile", refuse)
    finding = environment._cache_folder()
    assert not finding.ok and str(tmp_path / "cache") in finding.detail
    assert os.strerror(number).lower() in finding.detail.lower()
    assert "FLEXCAGE_CACHE_DIR" in finding.remedy


def test_the_doctor_names_a_folder_with_little_room(tmp_path, monkeypatch):
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path))
    usage = shutil.disk_usage(tmp_path)._replace(free=3_000_000)
    monkeypatch.setattr(shutil, "disk_usage", lambda path: usage)
    finding = environment._cache_folder()
    assert not finding.ok and f"{tmp_path} has 3 MB left" in finding.detail and finding.remedy


OWN = """
from flexcage.case import load_extension
load_extension("mine")
import numpy as np
from mine.kernels import whole
out = np.zeros(1)
whole(2.0, out)
print(out[0], sum(whole.stats.cache_hits.values()))
"""
OWN_KERNEL = """
from flexcage.core.jit import kernel
from mine.numbers import FACTOR

@kernel
def whole(x, out):
    out[0] = FACTOR * x
"""


def test_kernels_of_a_package_follow_every_file_of_it(tmp_path):
    """A user's kernel takes a number in from another file, which numba's own cache does not see."""
    package = tmp_path / "mine"
    package.mkdir()
    (package / "__init__.py").touch()
    (package / "kernels.py").write_text(OWN_KERNEL)
    env = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    env["PYTHONPATH"] = os.pathsep.join([str(tmp_path), env.get("PYTHONPATH", "")])
    found = []
    for factor in (3.0, 3.0, 5.0, 3.0):
        (package / "numbers.py").write_text(f"FACTOR = {factor}\n")
        done = subprocess.run(
            [sys.executable, "-B", "-c", OWN], env=env, check=True, capture_output=True, text=True
        )
        found.append(done.stdout.split())
    assert found == [["6.0", "0"], ["6.0", "1"], ["10.0", "0"], ["6.0", "1"]]
