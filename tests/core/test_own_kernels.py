"""Which of flexcage's own kernels an edit of flexcage compiles anew, told from their keys."""

import ast
import json
import re
import shutil
from pathlib import Path

import numba
import pytest
from warm_process import said_and_told

import flexcage
from flexcage.core.kernel_keys import COMPILER

pytestmark = pytest.mark.skipif(
    bool(numba.config.DISABLE_JIT), reason="plain Python compiles nothing"
)
PACKAGE = Path(flexcage.__file__).parent
#: Prints keys of all kernels and of what families and cages make kernels of; nothing is compiled
#: but laws.
KEYS = """
import importlib, json, pkgutil
import flexcage
from numba.core.dispatcher import Dispatcher
from flexcage.core.kernel_keys import content_key
from flexcage.core.wings import CAGE_TYPES, FAMILIES

keys = {}
for room in ("bodies", "contacts", "results", "solve", "system"):
    package = importlib.import_module(f"flexcage.{room}")
    for info in pkgutil.walk_packages(package.__path__, f"flexcage.{room}."):
        for name, value in vars(importlib.import_module(info.name)).items():
            if isinstance(value, Dispatcher):
                keys[f"{info.name.removeprefix('flexcage.')}.{name}"] = content_key(value)
for family in FAMILIES.values():
    if family.motion is not None:
        motion = family.motion()
        for function in (motion.evaluate, *motion.separate):
            keys[f"{family.name}.{function.__name__}"] = content_key(function)
list(CAGE_TYPES.values())
print(json.dumps(keys))
"""
#: Files, what is there (a pattern), and what comes in its place.
EDITS = {
    "nothing that a kernel reads": (
        ("cages/**/*.py", r"\A", "VALUE = 1\n\n"),
        ("cli/**/*.py", r"\A", "VALUE = 1\n\n"),
        ("mesh/**/*.py", r"\Z", "\n\ndef plain():\n    return 1\n"),
        ("contacts/rib.py", r"\Z", "\n\ndef plain():\n    # text\n    return 1\n"),
        ("contacts/laws.py", r"F = K d\^n, nothing dissipated", "Nothing is lost"),
        ("contacts/rib.py", r"(\ndef rib_contact\([^)]*\):\n)", r"\1    # text\n"),
    ),
    "a law": (("contacts/laws.py", r"F\[k\] = Fe\[k\] = slope", "F[k] = Fe[k] = 2.0 * slope"),),
    "ribs": (
        (
            "contacts/rib.py", r"play = data.half_gap - data.half_roller",
            "play = data.half_gap - 2.0 * data.half_roller",
        ),
    ),
    "a constant": (("contacts/evaluation.py", r"\nREPORT = 2", "\nREPORT = 2.5"),),
}  # fmt: skip


@pytest.fixture(scope="module")
def copied(warm, tmp_path_factory):
    """A folder with a copy of the package, the cache of its laws, and keys of its kernels."""
    folder = tmp_path_factory.mktemp("copied")
    shutil.copytree(PACKAGE, folder / "flexcage", ignore=shutil.ignore_patterns("__pycache__"))
    return folder, keys(warm, folder, folder / "cache")


def keys(warm, folder: Path, cache: Path) -> dict[str, str]:
    """Keys of the kernels of a package in this folder."""
    said, told = said_and_told(warm, KEYS, folder, cache, folder)
    assert told == ""  # no kernel is compiled in every process
    return json.loads(said)


@pytest.fixture
def changed(warm, copied, tmp_path):
    """changed(edit) -> names of kernels whose keys an edit of the package changes."""
    folder, before = copied

    def changes(edit: str) -> set[str]:
        shutil.copytree(folder / "flexcage", tmp_path / "flexcage")
        for files, pattern, replacement in EDITS[edit]:
            for path in (tmp_path / "flexcage").glob(files):
                text = path.read_text("utf-8")
                future = re.search(r"^from __future__ .*\n", text, re.MULTILINE)
                at = future.end() if future and pattern == r"\A" else 0
                edited = text[:at] + re.sub(pattern, replacement, text[at:], count=1)
                assert edited != text and ast.parse(edited)
                path.write_text(edited, encoding="utf-8")
        after = keys(warm, tmp_path, folder / "cache")
        assert after.keys() == before.keys()
        return {name for name in before if after[name] != before[name]}

    return changes


def test_there_are_kernels_of_all_rooms(copied):
    names = copied[1]
    assert len(names) > 150
    assert {"cylindrical_roller.evaluate", "contacts.laws.elastic"} <= names.keys()
    assert len(set(names.values())) > 100


def test_what_no_kernel_reads_changes_none(changed):
    assert changed("nothing that a kernel reads") == set()


def test_a_law_changes_itself(changed):
    assert changed("a law") == {"contacts.laws.elastic"}


def test_ribs_change_rollers_and_no_balls(changed):
    names = changed("ribs")
    assert {"contacts.rib.rib_contact", "cylindrical_roller.evaluate"} <= names
    assert not any(name.startswith(("ball", "solve.", "bodies.")) for name in names)


def test_a_constant_changes_all_who_read_it(changed):
    names = changed("a constant")
    assert {"contacts.rib.rib_contact", "cylindrical_roller.evaluate", "ball.evaluate"} <= names
    assert not any(name.startswith(("solve.", "contacts.laws.")) for name in names)


def test_only_what_counts_as_a_compiler_reaches_into_numba():
    """What other code says about code would not be in any key."""
    reaching = set()
    for path in PACKAGE.rglob("*.py"):
        text = path.read_text("utf-8")
        if re.search(
            r"^ *(from|import) (numba\.(core|extending|experimental)|llvmlite)", text, re.M
        ):
            reaching.add(path)
    assert reaching == set(COMPILER)
