"""No file of flexcage imports one that imports it, at its head, for types, or inside a function."""

import ast
from graphlib import CycleError, TopologicalSorter
from pathlib import Path

import pytest

ROOT = Path(__file__).parents[2] / "flexcage"


def name_of(file, root):
    parts = file.relative_to(root.parent).with_suffix("").parts
    return ".".join(parts[:-1] if parts[-1] == "__init__" else parts)


def imports_of(root):
    """By module: the modules of the package ``root`` that it imports anywhere in its file."""
    files = {name_of(file, root): file for file in root.rglob("*.py")}
    found = {}
    for module, file in files.items():
        wanted = found[module] = set()
        for node in ast.walk(ast.parse(file.read_text("utf-8"))):
            if isinstance(node, ast.Import):
                wanted.update(alias.name for alias in node.names)
            elif isinstance(node, ast.ImportFrom):
                inside = (f"{node.module}.{alias.name}" for alias in node.names)
                wanted.update(name if name in files else node.module for name in inside)
        wanted &= files.keys()
        wanted.discard(module)
    return found


def circle_in(imports):
    """Modules of a circle, each imported by the next; none if there is no circle."""
    try:
        TopologicalSorter(imports).prepare()
    except CycleError as error:
        return error.args[1]
    return []


def test_no_file_imports_back():
    imports = imports_of(ROOT)
    assert len(imports) > 500
    assert not circle_in(imports)


@pytest.mark.parametrize(
    "text",
    [
        "from made.a import A\n",
        "from made import a\n",
        "import made.a\n",
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from made.a import A\n",
        "def f():\n    from made.a import A\n    return A\n",
    ],
)
def test_a_circle_is_found(text, tmp_path):
    package = tmp_path / "made"
    package.mkdir()
    (package / "__init__.py").write_text("")
    (package / "a.py").write_text("from made.b import B\nA = 1\n")
    (package / "b.py").write_text("B = 1\n")
    assert not circle_in(imports_of(package))
    (package / "b.py").write_text(f"{text}B = 1\n")
    assert {"made.a", "made.b"} <= set(circle_in(imports_of(package)))
