"""A kernel is compiled anew when what it was made of is edited, in whatever file, and only then."""

import shutil

import numba
import pytest
from warm_process import said_and_told

pytestmark = pytest.mark.skipif(
    bool(numba.config.DISABLE_JIT), reason="plain Python compiles nothing"
)

MINE = {
    "__init__.py": "",
    "numbers.py": '''
import enum
import numpy as np
FACTOR = 3.0
FAR = 0.5
TABLE = np.array([1.0, 2.0])
PAIR = (1, 2)
NOT_READ = 7

class Place(enum.IntEnum):
    FIRST = 0
    SECOND = 1
''',
    "groups.py": '''
from typing import NamedTuple

class Pair(NamedTuple):
    a: float
    b: float

class Boxed(NamedTuple):
    c: float
    d: float

class Made(NamedTuple):
    e: float
    f: float
''',
    "deepest.py": '''
import mine.numbers as far_away
from flexcage.core.jit import part

@part
def deepest(x):
    return x + far_away.FAR
''',
    "deep.py": '''
from flexcage.core.jit import part
from mine.deepest import deepest

@part
def deep(x, plus=0.0):
    """Text."""
    return deepest(x) + plus
''',
    "laws.py": '''
from numba import types
from flexcage.core.jit import kernel

SIGNATURE = types.float64(types.float64)

@kernel(SIGNATURE)
def law(x):
    return 2.0 * x

@kernel(SIGNATURE)
def other_law(x):
    return -x

@kernel(types.float64(types.float64))
def fixed(x):
    return x
''',
    "kernels.py": '''
from flexcage.core.jit import fields, kernel, part
from mine.deep import deep
from mine.groups import Made
from mine.laws import fixed
from mine.numbers import FACTOR, PAIR, TABLE, Place

def scaled_by(scale):
    @part
    def scaled(x):
        return scale * x
    return scaled

tenfold = scaled_by(10.0)

@kernel
def whole(law, pair, box):
    """Text."""
    group, made = fields(box), Made(4.0, 1.0)
    total = law(pair.a) + 1e1 * pair.b + 1e2 * group.c + 1e3 * group.d
    total += 1e4 * FACTOR + 1e5 * deep(1.0) + 1e6 * made.f + 1e7 * PAIR[1]
    if Place.SECOND == 1:
        total += 0.5
    return total + 1e8 * TABLE[1] + 1e9 * tenfold(0.1) + 1e10 * fixed(1)

@kernel
def alone(x):
    return x

def plain():
    return 1

def helper(x):
    return x + 1.0

def integrate(x):
    return helper(x)
''',
    "unread.py": "VALUE = 1\n",
}  # fmt: skip
RUN = """
import mine.unread
from flexcage.core.jit import boxed
from flexcage.core.kernel_values import KernelType
from mine import kernels, laws
from mine.groups import Boxed, Pair
import numba

pair, box = Pair(a=1.0, b=2.0), boxed(Boxed(c=3.0, d=4.0))
kernels.whole.compile((KernelType(laws.SIGNATURE), numba.typeof(pair), numba.typeof(box)))
kernels.whole.disable_compile()
kernels.alone(1.0)
named = {"law": laws.law, "other_law": laws.other_law, "whole": kernels.whole,
         "alone": kernels.alone, "fixed": laws.fixed}
print(kernels.whole(laws.law, pair, box))
print(*[name for name, kernel in named.items() if sum(kernel.stats.cache_misses.values())])
"""
AS_IT_IS = 0.5 + 2.0 + 20.0 + 300.0 + 4000.0 + 3e4 + 1.5e5 + 1e6 + 2e7 + 2e8 + 1e9 + 1e10

#: File, what is there, what comes in its place, kernels compiled anew, what is then added.
EDITS = {
    "a constant": ("numbers.py", "FACTOR = 3.0", "FACTOR = 5.0", "whole", 2e4),
    "a constant of a module": ("numbers.py", "FAR = 0.5", "FAR = 0.25", "whole", -2.5e4),
    "a table": ("numbers.py", "1.0, 2.0", "1.0, 3.0", "whole", 1e8),
    "a pair": ("numbers.py", "(1, 2)", "(1, 3)", "whole", 1e7),
    "a member": ("numbers.py", "SECOND = 1", "THIRD = 1; SECOND = 0", "whole", -0.5),
    "order of fields": (
        "groups.py", "a: float\n    b: float", "b: float\n    a: float", "whole", 0
    ),
    "in a box": ("groups.py", "c: float\n    d: float", "d: float\n    c: float", "whole", 0),
    "in a tuple made here": ("groups.py", "e: float\n    f: float", "f: float\n    e: float",
                             "whole", 3e6),
    "a callee three files deep": ("deepest.py", "x +", "x -", "whole", -1e5),
    "a default argument": ("deep.py", "plus=0.0", "plus=1.0", "whole", 1e5),
    "what a function closes over": ("kernels.py", "by(10.0)", "by(20.0)", "whole", 1e9),
    "a law, passed as a value": ("laws.py", "2.0 * x", "3.0 * x", "law", 1.0),
    "another law": ("laws.py", "return -x", "return x", "other_law", 0),
    "a signature": (
        "laws.py", "@kernel(types.float64(types.float64))",
        "@kernel(types.float64(types.float32))", "whole fixed", 0,
    ),
    "how sums are taken": ("deep.py", "@part", "@part(fastmath=True)", "whole", 0),
    "a constant that is not read": ("numbers.py", "NOT_READ = 7", "NOT_READ = 8", "", 0),
    "plain Python beside kernels": ("kernels.py", "return 1", "return 2", "", 0),
    "a docstring": ("kernels.py", '"""Text."""', '"""Another\n    text."""', "", 0),
    "no docstring": ("deep.py", '    """Text."""\n', "", "", 0),
    "a helper that is compiled later": ("kernels.py", "x + 1.0", "1.0 + x", "", 0),
    "a comment": ("kernels.py", "\n@kernel\ndef whole", "# text\n\n@kernel\ndef whole", "", 0),
    "another file": ("unread.py", "VALUE = 1", "VALUE = 2", "", 0),
}  # fmt: skip


@pytest.fixture(scope="module")
def built(warm, tmp_path_factory):
    """A folder with the package, and the cache of its kernels."""
    folder = tmp_path_factory.mktemp("built")
    (folder / "mine").mkdir()
    for name, text in MINE.items():
        (folder / "mine" / name).write_text(text)
    said, told = said_and_told(warm, RUN, folder, folder / "cache", folder)
    assert said.splitlines() == [f"{AS_IT_IS}", "law other_law whole alone fixed"] and told == ""
    return folder


@pytest.fixture
def run(warm, built, tmp_path):
    """run() -> what the package in a copy of the folder gives, and kernels that it compiled."""
    shutil.copytree(built, tmp_path, dirs_exist_ok=True)

    def ran() -> tuple[float, set[str]]:
        said, told = said_and_told(warm, RUN, tmp_path, tmp_path / "cache", tmp_path)
        assert told == ""
        number, names = said.split("\n")[:2]
        return float(number), set(names.split())

    return ran


@pytest.mark.parametrize("edit", EDITS)
def test_an_edit_compiles_what_was_made_of_it(tmp_path, run, edit):
    name, before, after, anew, added = EDITS[edit]
    file = tmp_path / "mine" / name
    text = file.read_text()
    assert text.count(before) == 1
    file.write_text(text.replace(before, after))
    assert run() == (AS_IT_IS + added, set(anew.split()))
    file.write_text(text)
    assert run() == (AS_IT_IS, set())  # both versions are kept


MARK = f"""{RUN}
from flexcage.core.kernel_marks import mark_compiled
from flexcage.core.jit import allocating_kernel, compiled
kernels.helper = allocating_kernel(kernels.helper)  # as a bearing does with an integrator's
assert compiled(kernels.integrate, laws.SIGNATURE)(1.0) == 2.0
mark_compiled("mine")
"""
ASK = """
from flexcage.core.kernel_marks import kernels_cached
import mine.kernels, mine.laws
print(kernels_cached("mine"), kernels_cached("another's"))
"""


def test_a_mark_says_beforehand_whether_there_is_something_to_compile(warm, built, tmp_path):
    shutil.copytree(built, tmp_path, dirs_exist_ok=True)

    def said(code: str) -> str:
        return said_and_told(warm, code, tmp_path, tmp_path / "cache", tmp_path)[0]

    assert said(ASK) == "False False\n"
    said(MARK)
    assert said(ASK) == "True False\n"
    for edit, cached in (
        ("another file", True), ("a docstring", True), ("plain Python beside kernels", True),
        ("a callee three files deep", False), ("a law, passed as a value", False),
        ("in a box", False), ("order of fields", False),
        ("a helper that is compiled later", False),
    ):  # fmt: skip
        name, before, after, *_ = EDITS[edit]
        file = tmp_path / "mine" / name
        text = file.read_text()
        file.write_text(text.replace(before, after))
        assert said(ASK) == f"{cached} False\n", edit
        file.write_text(text)
    assert said(ASK.replace("import mine.kernels, mine.laws", "")) == "False False\n"


def test_what_nobody_can_judge_is_compiled_in_every_process(warm, tmp_path):
    """A C function's address says nothing of what the function does."""
    (tmp_path / "from_c.py").write_text(
        "import ctypes, ctypes.util\n"
        "from flexcage.core.jit import kernel\n"
        "cosine = ctypes.CDLL(ctypes.util.find_library('m')).cos\n"
        "cosine.restype, cosine.argtypes = ctypes.c_double, [ctypes.c_double]\n"
        "@kernel\ndef of_c(x):\n    return cosine(x)\n"
        "assert of_c(0.0) == 1.0\n"
        "print(sum(of_c.stats.cache_misses.values()))\n"
    )
    code = 'import logging\nlogging.basicConfig(format="%(message)s")\nimport from_c'
    for _ in range(2):
        said, told = said_and_told(warm, code, tmp_path, tmp_path / "cache", tmp_path)
        assert said == "1\n" and len(told.splitlines()) == 1
        assert "'from_c.of_c' is compiled in every process" in told


@pytest.mark.parametrize(
    "names, kept", [({"__name__": "__main__"}, 1), ({}, 0)], ids=["at a prompt", "of no module"]
)
def test_a_function_without_a_file(warm, tmp_path, names, kept):
    """Its content is known without a file; numba cannot read back one of no module."""
    code = (
        "from numba import float64\n"
        "from flexcage.core.jit import kernel_of\n"
        f"names = {names}\n"
        "exec('def typed(x): return 2.0 * x', names)\n"
        "typed = kernel_of(names['typed'], float64(float64))\n"
        "print(typed(2.0), sum(typed.stats.cache_hits.values()))\n"
    )
    for hits in (0, kept):
        found = said_and_told(warm, code, tmp_path, tmp_path / "cache")
        assert found == (f"4.0 {hits}\n", "")


def test_a_users_file_called_as_one_of_pythons_is_his(warm, tmp_path):
    """Python's own modules count by the version of Python alone."""
    found = []
    for factor in (2.0, 3.0):
        (tmp_path / "colorsys.py").write_text(
            "from flexcage.core.jit import kernel, part\n"
            f"@part\ndef times(x):\n    return {factor} * x\n"
            "@kernel\ndef whole(x):\n    return times(x)\n"
        )
        code = "import colorsys\nprint(colorsys.whole(1.0))"
        found.append(said_and_told(warm, code, tmp_path, tmp_path / "cache", tmp_path)[0])
    assert found == ["2.0\n", "3.0\n"]


def test_a_constant_that_changes_while_a_kernel_is_compiled_keeps_nothing(warm, tmp_path):
    (tmp_path / "in_between.py").write_text(
        "from flexcage.core import jit\n"
        "NUMBER = 1.0\n"
        "@jit.kernel\ndef whole(x):\n    return NUMBER * x\n"
    )
    code = (
        "import in_between\n"
        "own = in_between.whole._compiler.compile\n"
        "def compile(*args):\n    in_between.NUMBER = 2.0\n    return own(*args)\n"
        "in_between.whole._compiler.compile = compile\n"
        "assert in_between.whole(1.0) == 2.0\n"
    )
    said_and_told(warm, code, tmp_path, tmp_path / "cache", tmp_path)
    assert not list((tmp_path / "cache").rglob("*.kernel"))
