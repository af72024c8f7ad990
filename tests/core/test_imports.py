"""``import flexcage`` is light, shows few names, and every name is where it says."""

import ast
import dataclasses
import importlib
import re
import subprocess
import sys
import typing
from pathlib import Path

import pytest

import flexcage
from flexcage import Case, StaticCase, register, spec

_ALLOWED = {"flexcage", "flexcage._names", "flexcage._version"}


def test_import_loads_nothing_but_itself():
    code = (
        "import sys; before = set(sys.modules); import flexcage; "
        "print(*sorted(m for m in set(sys.modules) - before))"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    standard = set(sys.stdlib_module_names)
    loaded = {m for m in done.stdout.split() if m.partition(".")[0] not in standard}
    assert loaded == _ALLOWED


def test_a_case_needs_no_heavy_module():
    code = (
        "import sys, flexcage; flexcage.Case.from_preset('N1013').to_toml(); "
        "print(*[m for m in sys.modules if '.' not in m])"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    heavy = {
        "numba",
        "pint",
        "gmsh",
        "skfem",
        "pyvista",
        "vtkmodules",
        "matplotlib",
        "xarray",
        "pandas",
        "zarr",
        "meshio",
        "plotly",
        "jinja2",
    }
    assert not heavy & set(done.stdout.split())


PUBLIC_MODULES = [
    "flexcage",
    "flexcage.spec",
    "flexcage.study",
    "flexcage.register",
    "flexcage.render",
]


@pytest.mark.parametrize("public_module", PUBLIC_MODULES)
def test_every_name_is_there(public_module):
    module = importlib.import_module(public_module)
    assert module.__all__ == dir(module)
    for name in module.__all__:
        assert getattr(module, name) is not None
    with pytest.raises(
        AttributeError, match=f"module '{public_module}' has no attribute 'nothing'"
    ):
        _ = module.nothing


@pytest.mark.parametrize("public_module", PUBLIC_MODULES)
def test_a_stub_gives_type_checkers_what_a_module_gives_python(public_module):
    """A stub exports names that it imports "as" themselves or by "*", or those of its
    ``__all__``."""
    stub = Path(importlib.import_module(public_module).__file__).with_suffix(".pyi")
    body = ast.parse(stub.read_text("utf-8")).body
    lines = [(node.module, a) for node in body if isinstance(node, ast.ImportFrom)
             for a in node.names]  # fmt: skip
    exported = [a.asname for _, a in lines if a.asname == a.name]
    for module in (m for m, a in lines if a.name == "*"):
        exported += [n for n in vars(importlib.import_module(module)) if not n.startswith("_")]
    for node in body:
        if isinstance(node, ast.Assign):
            exported += ast.literal_eval(node.value)
    assert sorted(exported) == importlib.import_module(public_module).__all__


def test_a_misspelt_name_is_answered_with_the_nearest():
    for public_module, name, where in (
        (flexcage, "simulat", "flexcage.simulate"),
        (flexcage, "Drvie", "flexcage.spec.Drive"),
        (spec, "Drvie", "flexcage.spec.Drive"),
    ):
        with pytest.raises(AttributeError, match=rf"'{name}'; did you mean {where}\?"):
            getattr(public_module, name)


def test_the_package_shows_few_names():
    assert len(dir(flexcage)) <= 35
    assert {"simulate", "Case", "Run", "InputError", "spec", "register"} <= set(dir(flexcage))


def parts(cls):
    """Specs that stand in a spec, at any depth, and those derived from them."""
    for field in dataclasses.fields(cls):
        for part in classes_in(typing.get_type_hints(cls)[field.name]):
            for kind in derived(part):
                yield kind
                yield from parts(kind)


def derived(cls):
    """A class of flexcage, and those derived from it."""
    found = [part for inner in cls.__subclasses__() for part in derived(inner)]
    return [cls, *found] if cls.__module__.startswith("flexcage.") else found


def classes_in(hint):
    """Dataclasses that an annotation names."""
    if dataclasses.is_dataclass(hint):
        return [hint]
    return [cls for argument in typing.get_args(hint) for cls in classes_in(argument)]


def test_every_part_of_a_case_is_in_spec():
    found = {cls for case in (Case, StaticCase) for cls in parts(case)}
    assert len(found) > 35
    there = [getattr(spec, name) for name in spec.__all__]
    lacking = [cls for cls in found if cls not in there]
    # parts that types share are no types: others are derived from them, and none has their name
    assert not [cls for cls in lacking if not cls.__subclasses__() or "type" in vars(cls)]


def test_all_that_registers_is_in_register():
    """Functions of modules that are called register or register_..., and what specs and variables
    are written with."""
    there = {getattr(register, name) for name in register.__all__}
    for name in ("Variable", "bearing_type", "option", "quantity"):
        there.remove(getattr(register, name))
    folder = Path(flexcage.__file__).parent
    for file in folder.rglob("*.py"):
        for node in ast.parse(file.read_text("utf-8")).body:
            if isinstance(node, ast.FunctionDef) and re.match(r"register(_|$)", node.name):
                name = ".".join(file.relative_to(folder.parent).with_suffix("").parts)
                there.remove(getattr(importlib.import_module(name), node.name))
    assert not there


ROOT, MINE = Path(__file__).parents[2], Path(__file__).name
USERS = [
    file
    for place in ("README.md", "examples", "flexcage", "tests")
    for file in sorted((ROOT / place).rglob("*") if "." not in place else [ROOT / place])
    if file.suffix in (".py", ".md", ".ipynb") and file.name not in (MINE, "CHANGELOG.md")
]


def test_nothing_of_flexcage_uses_an_old_name():
    old = []
    for file in USERS:
        text = file.read_text("utf-8")
        names = re.findall(r"\bflexcage\.([A-Z]\w*)", text)
        for line in re.findall(r"from flexcage import (\([^)]*\)|[^\n\\]*)", text):
            names += re.findall(r"\b[A-Z]\w*", line.partition("#")[0])
        old += [(file.name, name) for name in names if name not in flexcage.__all__]
    assert len(USERS) > 300 and not old


def test_simulate_is_the_function_even_when_its_module_is_imported():
    code = (
        "import flexcage, importlib; importlib.import_module('flexcage.simulate'); "
        "assert callable(flexcage.simulate), flexcage.simulate"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
