"""Datasets to files that other programs read: NetCDF, CSV, Parquet, MAT.

A table has one axis: the variables in it have the same first dimension, such as ``time`` or
``time_hf``. Each component of a variable is a column, named by its labels and unit, as
``pocket_force[pocket=5,face=rear] (N)``.
"""

from __future__ import annotations

import importlib.util
import re
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.binding import did_you_mean, path_of
from flexcage.core.errors import EnvironmentLacks, InputError, install, unwritable
from flexcage.core.writing import written
from flexcage.results.layout import plain_attr
from flexcage.results.registry import TIME, VARIABLES, families_with, whose

if TYPE_CHECKING:
    import pandas
    import xarray

ENDINGS = (".csv", ".parquet", ".mat")
FEW = 8  # components a variable may have to enter the default table
_LONGEST = 63  # characters of a name in MATLAB
_KEYWORDS = (  # of MATLAB
    "break", "case", "catch", "classdef", "continue", "else", "elseif", "end", "for", "function",
    "global", "if", "otherwise", "parfor", "persistent", "return", "spmd", "switch", "try", "while",
)  # fmt: skip
_LARGEST = 2**31 - 1  # bytes of an array in a MAT file

#: By axis, the columns (n, ...) of its variables: their headings and values (n, columns).
Columns = dict[str, dict[str, tuple[list[str], np.ndarray]]]


def to_netcdf(ds: xarray.Dataset, path: str | Path) -> Path:
    """Write the dataset as NetCDF 4, compressed; units and long names go with it."""
    engine: Any = next((e for e in ("netCDF4", "h5netcdf") if importlib.util.find_spec(e)), None)
    if engine is None:
        raise _lacks("NetCDF", "netCDF4")
    plain = ds.copy()
    plain.attrs = {k: plain_attr(v) for k, v in ds.attrs.items()}
    encoding = {str(n): {"zlib": True, "complevel": 1} for n, v in ds.data_vars.items() if v.ndim}
    path = ready(path)
    _written(path, plain.to_netcdf, engine=engine.lower(), encoding=encoding)
    return path


def scalar_table(ds: xarray.Dataset, variables: Sequence[str] | None = None) -> pandas.DataFrame:
    """Table of variables that share an axis: one row a sample, one column a component; the axis
    first, as ``time (s)``.

    Without ``variables``: all over ``time`` with at most eight components a sample (states of
    rings and cage, energies), not per roller or pocket. Raises InputError for a variable that the
    dataset does not have, and for variables of several axes.
    """
    found = columns(ds, variables)
    if len(found) > 1:
        each = " and ".join(f"{', '.join(of)} over {axis}" for axis, of in found.items())
        raise InputError(
            f"A table has one axis, and the variables have several ({each}): write one file for "
            "each axis, as write_table does.",
            where="variables",
        )
    return next(iter(_frames(ds, found).values()))


def to_csv(ds: xarray.Dataset, path: str | Path, variables: Sequence[str] | None = None) -> Path:
    """Write :func:`scalar_table` as CSV, numbers in full precision."""
    return frame_to_csv(scalar_table(ds, variables), path)


def to_parquet(
    ds: xarray.Dataset, path: str | Path, variables: Sequence[str] | None = None
) -> Path:
    """Write :func:`scalar_table` as Parquet."""
    return frame_to_parquet(scalar_table(ds, variables), path)


def to_mat(ds: xarray.Dataset, path: str | Path, variables: Sequence[str] | None = None) -> Path:
    """Write variables as a MAT file of MATLAB 5: a matrix (samples, components) by name, the
    instants of every axis, and the struct ``columns``, which names each column of a matrix.

    Names that MATLAB cannot have are changed. Without ``variables`` as :func:`scalar_table`.
    Raises InputError for a variable that the dataset does not have, or one above 2 GB.
    """
    from scipy.io import savemat

    found = columns(ds, variables)
    given = {axis: _instants(ds, axis)[1] for axis in found if axis in ds.coords}
    legend: dict[str, Any] = {}
    for axis, of in found.items():
        for name, (headings, values) in of.items():
            given.setdefault(name, _for_mat(name, values))
            legend[name] = np.array(headings, dtype=object)
        if axis in ds.coords:
            legend[axis] = np.array([_instants(ds, axis)[0]], dtype=object)
    names = dict(zip(given, mat_names(given)))
    stored: dict[str, Any] = {names[name]: values for name, values in given.items()}
    stored["columns"] = {names[name]: headings for name, headings in legend.items()}
    path = ready(path)
    _written(path, savemat, stored, long_field_names=True, do_compression=True, oned_as="column")
    return path


def write_table(
    ds: xarray.Dataset,
    path: str | Path,
    variables: Sequence[str] | None = None,
    *,
    force: bool = False,
) -> list[Path]:
    """Write variables to ``path``, by its ending as CSV, Parquet or MAT; paths of the files.

    A MAT file holds variables of any axes. CSV and Parquet have one file for each axis: with
    several, the axis is added to the name, as ``forces_time_hf.csv``. Without ``variables`` as
    :func:`scalar_table`. Raises InputError for another ending, a variable that the dataset does
    not have, or a file that is there, unless ``force`` is given; EnvironmentLacks where a library
    is missing.
    """
    path = path_of(path, "path")
    check_ending(path)
    if path.suffix == ".mat":
        check_new([path], force)
        return [to_mat(ds, path, variables)]
    frames = _frames(ds, columns(ds, variables))
    one = len(frames) == 1
    paths = [path if one else path.with_name(f"{path.stem}_{a}{path.suffix}") for a in frames]
    check_new(paths, force)
    write: Callable[..., Path] = frame_to_csv if path.suffix == ".csv" else frame_to_parquet
    return [write(frame, file) for frame, file in zip(frames.values(), paths)]


def check_new(paths: Sequence[Path], force: bool) -> None:
    """InputError for a file that is there, unless ``force`` writes it anew."""
    there = [path for path in paths if path.exists()]
    if there and not force:
        raise InputError(
            f"'{there[0]}' exists already; --force (in Python force=True) writes it anew.",
            where="out",
            value=str(there[0]),
        )


def check_ending(path: Path) -> None:
    """Refuse a table's file of another ending."""
    if path.suffix not in ENDINGS:
        raise InputError(
            f"'{path}' should end in {', '.join(ENDINGS[:-1])} or {ENDINGS[-1]}.",
            where="path",
            value=str(path),
        )


def columns(ds: xarray.Dataset, variables: Sequence[str] | None = None) -> Columns:
    """Columns of variables by axis; InputError for one that the dataset does not have."""
    if variables is None:
        axis = TIME if TIME in ds.dims else str(next(iter(ds.dims)))
        variables = [
            str(n)
            for n, v in ds.data_vars.items()
            if v.dims[:1] == (axis,) and np.prod(v.shape[1:], initial=1) <= FEW
        ]
    found: Columns = {}
    for name in dict.fromkeys(variables):
        check_there(name, ds.variables)
        array = ds[name]
        if not array.dims:
            raise InputError(f"{name!r} is a single value, not a column.", where=name)
        found.setdefault(str(array.dims[0]), {})[name] = _headings(array), _flat(array)
    return found


def check_there(name: str, known: Iterable[Any]) -> None:
    """InputError for a variable that is not known, with the nearest name, or whose
    bearings have it."""
    known = [str(k) for k in known]
    if name in known:
        return
    hint = did_you_mean(name, known, "it has")
    if name in VARIABLES:
        has = whose(families_with(name))
        hint = f"it is recorded of {has} alone" if has else "this run did not record it"
        if VARIABLES[name].of_cage and "cage_position" not in known:
            hint = "the run's bearing has no cage"
        hint += f" ({VARIABLES[name].long_name})"
    parts = [part for part in re.split(r"[\[,; ]+", name) if part in known]
    if "[" in name and parts:
        hint = f"'{parts[0]}' has a column of each of its labels; name it without brackets"
    elif len(parts) > 1:
        hint = f"name each by itself: {' '.join(parts)}"
    raise InputError(
        f"The dataset has no variable {name!r}: {hint}.", where="variables", value=name
    )


def frame_to_parquet(frame: pandas.DataFrame, path: str | Path) -> Path:
    """Write a table as Parquet."""
    if not any(importlib.util.find_spec(e) for e in ("pyarrow", "fastparquet")):
        raise _lacks("Parquet", "pyarrow")
    path = ready(path)
    _written(path, frame.to_parquet, index=False)
    return path


def frame_to_csv(frame: pandas.DataFrame, path: str | Path) -> Path:
    """Write a table as CSV."""
    path = ready(path)
    _written(path, frame.to_csv, index=False)
    return path


def _frames(ds: xarray.Dataset, found: Columns) -> dict[str, pandas.DataFrame]:
    """A table for each axis."""
    import pandas as pd

    frames = {}
    for axis, of in found.items():
        table: dict[str, Any] = dict([_instants(ds, axis)]) if axis in ds.coords else {}
        for headings, values in of.values():
            table.update((heading, values[:, k]) for k, heading in enumerate(headings))
        frames[axis] = pd.DataFrame(table)
    return frames


def _instants(ds: xarray.Dataset, axis: str) -> tuple[str, np.ndarray]:
    """Heading and values of an axis."""
    return _with_unit(axis, ds[axis].attrs.get("units")), ds[axis].values


def _headings(array: xarray.DataArray) -> list[str]:
    """A column's name for each component: labels and unit."""
    shape, dims = array.shape[1:], [str(d) for d in array.dims[1:]]
    units = _units(array)
    found = []
    for flat, index in enumerate(np.ndindex(*shape)):
        labels = (f"{d}={_label(array, d, i)}" for d, i in zip(dims, index))
        name = f"{array.name}[{','.join(labels)}]" if dims else str(array.name)
        found.append(_with_unit(name, units[flat % len(units)]))
    return found


def _label(array: xarray.DataArray, dim: str, index: int) -> str:
    if dim not in array.coords:
        return str(index)
    label = array[dim].values[index]
    return f"{label:.6g}" if isinstance(label, float) else str(label)


def _units(array: xarray.DataArray) -> list[str | None]:
    """Units of the components along the last dimension, or one of all."""
    own = array.coords.get(f"{array.name}_unit")  # of multipliers: by constraint
    if own is not None:
        return [str(unit) for unit in own.values]
    unit = array.attrs.get("units")
    each = str(unit).split(", ")
    return list(each) if len(each) > 1 and len(each) == array.shape[-1] else [unit]


def _with_unit(name: str, unit: str | None) -> str:
    return f"{name} ({unit})" if unit else name


def _flat(array: xarray.DataArray) -> np.ndarray:
    values = array.values
    return values.reshape(len(values), int(np.prod(values.shape[1:], initial=1)))


def _for_mat(name: str, values: np.ndarray) -> np.ndarray:
    """Values as a MAT file holds them: texts as cells."""
    if values.dtype.kind in "UTO":
        return values.astype(str).astype(object)
    if values.nbytes > _LARGEST:
        raise InputError(
            f"{name!r} has {values.nbytes / 1e9:.3g} GB, and an array in a MAT file at most 2 GB: "
            "write Parquet or NetCDF, or a part of the run.",
            where="variables",
            value=name,
        )
    return values


def mat_names(names: Iterable[str]) -> list[str]:
    """Names as MATLAB allows them: letters, digits and underscores, a letter first, 63 at most."""
    found: list[str] = []
    for name in names:
        valid = re.sub(r"[^0-9A-Za-z_]", "_", name)
        if not valid[:1].isalpha() or valid in (*_KEYWORDS, "columns"):
            valid = f"x_{valid}"
        base, number = valid[:_LONGEST], 2
        valid = base
        while valid in found:
            valid = f"{base[: _LONGEST - 4]}_{number}"
            number += 1
        found.append(valid)
    return found


def put(path: Path, write: Callable[[Path], Any]) -> None:
    """Let ``write`` make a file aside, which then takes its place."""
    _written(path, write)


def _written(path: Path, write: Callable[..., Any], *args: Any, **options: Any) -> None:
    try:
        with written(path) as temporary:
            write(temporary, *args, **options)
    except OSError as error:
        raise unwritable(f"The file '{path}'", error, path=path) from error


def ready(path: str | Path) -> Path:
    """A path whose folder is there, and which is no link."""
    path = path_of(path, "path")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"The folder {path.parent} cannot be made: {error.strerror}.") from error
    if path.is_symlink():
        path.unlink()  # not written through
    return path


def _lacks(what: str, package: str) -> EnvironmentLacks:
    return EnvironmentLacks(
        f"Writing {what} needs the package {package}, which is not installed here: "
        f"install it {install('study')}  (or anywhere:  pip install {package})."
    )
