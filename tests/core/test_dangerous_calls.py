"""What could run code, or take memory as a file asks for it, is called in few files and nowhere
else."""

import ast
from pathlib import Path

import pytest

import flexcage

PACKAGE = Path(flexcage.__file__).parent
#: Calls, by the end of their dotted name, and the files that may make them.
ALLOWED_IN = {
    "pickle.load": (),
    "pickle.loads": ("core/kernel_cache.py",),  # of a folder that nobody else can write (trust)
    "pickle.Unpickler": (),
    "marshal.loads": (),
    "shelve.open": (),
    "yaml.load": (),
    "json.loads": ("core/reading.py",),
    "json.load": (),
    "JSONDecoder": (),
    "tomllib.loads": ("core/toml.py",),
    "tomllib.load": (),
    "np.load": (),  # core/arrays.py reads .npz
    "numpy.load": (),
    "read_array": ("core/arrays.py", "results/metadata.py"),  # numpy's; and that of checked_zarr
    "pd.read_pickle": (),
    "zarr.open": (),
    "zarr.open_group": (),
    "zarr.open_array": ("results/checked_zarr.py",),
    "zarr.load": (),
    "xarray.open_zarr": (),
    "xr.open_zarr": (),
    "ZipFile": ("core/arrays.py", "results/checked_zarr.py"),
    "ZipStore": ("results/cage_file.py", "results/checked_zarr.py"),  # the first writes
    "tarfile.open": (),
    "extractall": (),
    "eval": (),
    "blosc.decompress": ("results/shards.py",),
}


def calls() -> dict[str, set[str]]:
    """Files by the dotted names that they call."""
    found: dict[str, set[str]] = {}
    for path in PACKAGE.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text("utf-8"))):
            if isinstance(node, ast.Call):
                name = ast.unparse(node.func)
                found.setdefault(name, set()).add(path.relative_to(PACKAGE).as_posix())
    return found


@pytest.fixture(scope="module")
def called():
    return calls()


@pytest.mark.parametrize("name", ALLOWED_IN)
def test_only_allowed_files_call_it(called, name):
    users = {
        file
        for dotted, files in called.items()
        if dotted == name or dotted.endswith(f".{name}")
        for file in files
    }
    assert users == set(ALLOWED_IN[name])
