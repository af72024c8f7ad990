"""Boxes of arrays, and parts of kernels, as kernels receive them."""

import gc
import os
import subprocess
import sys
from typing import NamedTuple

import numba
import numpy as np
import pytest

from flexcage import compiling
from flexcage.core.jit import allocating_kernel, boxed, fields
from flexcage.core.sources import kernel_sources

PLAIN = bool(numba.config.DISABLE_JIT)


def test_the_fingerprint_of_kernels_knows_every_file_that_feeds_them():
    """Named constants and plain functions reach kernels from files that compile nothing."""
    known = {f"{path.parent.name}/{path.name}" for path in kernel_sources()}
    assert {"contacts/evaluation.py", "system/data.py", "system/layout.py"} <= known
    assert {"bearings/family.py", "cages/cage_type.py"} <= known
    assert not {"contacts/spec.py", "system/spec.py", "solve/options.py"} & known


class Group(NamedTuple):
    count: int
    table: np.ndarray
    ratio: float
    whole: np.ndarray
    rows: np.ndarray


def group() -> Group:
    rows = np.zeros(2, [("a", float), ("b", float, 3)])
    rows["b"] = 7.0
    whole = np.arange(4)
    return Group(-3, np.arange(24.0).reshape(2, 3, 4), 0.25, whole, rows)


def read(box):
    g = fields(box)
    rows = g.rows.shape[0] * g.rows[1]["b"][2]
    g.table[1, 2, 3] += 1.0
    return g.count, g.ratio, g.table[1, 2, 3], g.table.shape[1], g.whole.sum(), rows


def test_a_kernel_reads_and_writes_what_a_box_holds():
    values = group()
    kernel = allocating_kernel(read)
    assert kernel(boxed(values)) == (-3, 0.25, 24.0, 3, 6, 14.0)
    assert values.table[1, 2, 3] == 24.0
    assert kernel(boxed(values._replace(count=2**40)))[:3] == (2**40, 0.25, 25.0)


def test_groups_of_one_name_are_told_apart_by_their_fields():
    a_first, b_first = (
        NamedTuple("Same", [(name, float) for name in names]) for names in ("ab", "ba")
    )
    kernel = allocating_kernel(lambda box: fields(box).a)
    assert kernel(boxed(a_first(a=1.0, b=2.0))) == 1.0
    assert kernel(boxed(b_first(a=1.0, b=2.0))) == 1.0


def test_numpy_numbers_are_boxed_as_themselves():
    values = group()._replace(count=np.int64(5), ratio=np.float64(-1.5))
    assert allocating_kernel(read)(boxed(values))[:2] == (5, -1.5)


@pytest.mark.skipif(PLAIN, reason="plain Python has no boxes")
def test_a_box_keeps_its_arrays():
    box = boxed(group())
    gc.collect()
    rubbish = [np.full((2, 3, 4), np.nan) for _ in range(1000)]
    assert allocating_kernel(read)(box)[2] == 24.0
    assert len(rubbish) == 1000


SCRIPT = """
import numpy as np
from flexcage.core.jit import kernel, part

@part
def inner(x, out):
    out[0] = 3.0 * x

@part
def outer(x, out):
    inner(x + 1.0, out)
    out[0] += 1.0

@kernel
def whole(x, out):
    outer(x, out)

out = np.zeros(1)
whole(2.0, out)
assert out[0] == 10.0, out
print(sum(whole.stats.cache_hits.values()), sum(len(f.overloads) for f in (inner, outer)))
"""


ANOTHER_NUMBA = """
from numba.core.codegen import JITCPUCodegen
own = JITCPUCodegen.set_env
del JITCPUCodegen.set_env
import flexcage.core.jit
JITCPUCodegen.set_env = own
"""


@pytest.mark.skipif(PLAIN, reason="plain Python compiles nothing")
@pytest.mark.parametrize("before", ["", ANOTHER_NUMBA], ids=["numba", "another numba"])
def test_what_is_made_of_parts_comes_back_from_disk(tmp_path, before):
    """Also where numba lacks a method that is replaced, and makes machine code of parts."""
    (tmp_path / "made_of_parts.py").write_text(before + SCRIPT, encoding="utf-8")
    env = {**os.environ, "NUMBA_CACHE_DIR": str(tmp_path / "cache")}
    printed = [
        subprocess.run(
            [sys.executable, "made_of_parts.py"], cwd=tmp_path, env=env, check=True,
            capture_output=True, text=True,
        ).stdout.split()
        for _ in range(2)
    ]  # fmt: skip
    assert printed == [["0", "2"], ["1", "0"]]  # hits, parts compiled


def test_the_second_process_compiles_for_the_package_of_the_first(tmp_path):
    """A user's folder may hold a clone of flexcage while the one that runs is installed."""
    (tmp_path / "flexcage").mkdir()
    (tmp_path / "flexcage" / "__init__.py").write_text("", encoding="utf-8")
    command = f"{compiling.SAME_PACKAGE}; from flexcage import compiling; print(compiling.__file__)"
    found = subprocess.run(
        [sys.executable, "-P", "-c", command], cwd=tmp_path, check=True, capture_output=True,
        text=True,
    ).stdout.strip()  # fmt: skip
    assert found == compiling.__file__
