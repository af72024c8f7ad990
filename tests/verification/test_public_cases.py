"""What ``flexcage verify`` ships asks flexcage what a user can ask it: ``flexcage/verification``'s
page says what that is."""

from __future__ import annotations

import ast
import re
from importlib import import_module
from pathlib import Path

import pytest

import flexcage
from flexcage import verification

HOME = Path(verification.__file__).parent
#: Files that compute answers; the others choose cases, run them, and write of them.
FILES = [*sorted((HOME / "cases").glob("*.py")), HOME / "bearings.py", HOME / "runs.py"]
#: By these a bearing in motion, or a run, hands out arrays of its equations.
INNER = {"data", "layout", "residual", "evaluate", "args", "work", "store", "start", "y", "yd"}


def modules():
    """Modules of flexcage of which a case may import, as the page names them."""
    text = " ".join((HOME / "README.md").read_text("utf-8").split())
    (sentence,) = re.findall(r"A case imports (.*?), and nothing else of flexcage", text)
    return re.findall(r"`(flexcage\.[\w.]+)`", sentence)


def broken(source):
    """What a file imports or reads that a user cannot."""
    for node in ast.walk(ast.parse(source)):
        names = []
        if isinstance(node, ast.Import):
            names = [a.name for a in node.names]
        elif isinstance(node, ast.ImportFrom):
            names = [f"{node.module}.{a.name}" for a in node.names]
        yield from (name for name in names if not known(name))
        if isinstance(node, ast.Attribute):
            private = node.attr.startswith("_") and not node.attr.startswith("__")
            if private or node.attr in INNER:
                yield f".{node.attr}"


def known(name):
    """Is it of another package, a name that ``flexcage`` itself shows, or in a module named?"""
    package, _, rest = name.partition(".")
    inside = [*modules(), "flexcage.verification"]
    return (
        package != "flexcage"
        or not rest
        or rest in flexcage.__all__
        or any(name == module or name.startswith(f"{module}.") for module in inside)
    )


@pytest.mark.parametrize("file", FILES, ids=lambda p: p.name)
def test_cases_ask_what_a_user_can_ask(file):
    assert list(broken(file.read_text("utf-8"))) == []


@pytest.mark.parametrize(
    ("line", "found"),
    [
        ("from flexcage.contacts import laws", "flexcage.contacts.laws"),
        ("from flexcage.results import metrics", "flexcage.results.metrics"),
        ("from flexcage import system", "flexcage.system"),
        ("import flexcage.system.start", "flexcage.system.start"),
        ("mass = bearing.data.model.cage.mass", ".data"),
        ("left = bearing.residual(0.0, u, v)", ".residual"),
        ("run._files", "._files"),
    ],
)
def test_what_reaches_inside_is_found(line, found):
    assert list(broken(line)) == [found]


def test_the_modules_named_are_there_and_in_the_guide():
    root = HOME.parents[1]
    guide = (root / "examples").glob("*.*")
    pages = [root / "README.md", *(p for p in guide if p.suffix in (".md", ".py"))]
    text = "\n".join(page.read_text("utf-8") for page in pages)
    assert len(modules()) > 2
    for name in modules():
        import_module(name)
        room, _, last = name.rpartition(".")
        assert name in text or f"from {room} import {last}" in text, name


def test_the_page_names_every_case():
    rows = re.findall(r"^\| (`.*?) \|", (HOME / "README.md").read_text("utf-8"), flags=re.M)
    named = [name for row in rows for name in re.findall(r"`(\w+)`", row)]
    assert sorted(named) == sorted(verification.CHAPTER)
