"""``import flexcage`` is light, and its table of names is true."""

import ast
import subprocess
import sys
from pathlib import Path

import flexcage

_ALLOWED = {"flexcage", "flexcage._version"}


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


def test_stubs_and_table_name_the_same():
    stub = Path(flexcage.__file__).with_suffix(".pyi")
    tree = ast.parse(stub.read_text("utf-8"))
    named = {a.name: n.module for n in tree.body for a in n.names}  # type: ignore[attr-defined]
    rooms = {name: "flexcage" for name in flexcage._ROOMS}
    assert named == {**flexcage._LAZY, **rooms, "__version__": "flexcage._version"}


def test_every_name_is_there():
    missing = []
    for name in flexcage.__all__:
        try:
            getattr(flexcage, name)
        except (ImportError, AttributeError):
            missing.append(name)
    assert not missing


def test_simulate_is_the_function_even_when_its_module_is_imported():
    code = (
        "import flexcage, importlib; importlib.import_module('flexcage.simulate'); "
        "assert callable(flexcage.simulate), flexcage.simulate"
    )
    subprocess.run([sys.executable, "-c", code], check=True)
