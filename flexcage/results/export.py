"""Datasets to files that other programs read: NetCDF, Parquet, CSV."""

from __future__ import annotations

import importlib.util
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.results.layout import plain_attr
from flexcage.results.registry import TIME

if TYPE_CHECKING:
    import pandas
    import xarray

FEW = 8  # components a variable may have to enter the default table


def to_netcdf(ds: xarray.Dataset, path: str | Path) -> Path:
    """Write the dataset as NetCDF 4, compressed; units and long names go with it."""
    engine: Any = next((e for e in ("netCDF4", "h5netcdf") if importlib.util.find_spec(e)), None)
    if engine is None:
        raise _lacks("NetCDF", "netCDF4")
    plain = ds.copy()
    plain.attrs = {k: plain_attr(v) for k, v in ds.attrs.items()}
    encoding = {str(n): {"zlib": True, "complevel": 1} for n, v in ds.data_vars.items() if v.ndim}
    path = _ready(path)
    plain.to_netcdf(path, engine=engine.lower(), encoding=encoding)
    return path


def scalar_table(ds: xarray.Dataset, variables: Sequence[str] | None = None) -> pandas.DataFrame:
    """Tidy table: one row a sample of the main grid, one column a scalar, ``time_s`` first.

    Columns are named ``variable.label.label [unit]``. Without ``variables``: all those with at
    most eight components a sample (states of rings and cage, energies), not per roller or pocket.
    """
    import pandas as pd

    if variables is None:
        chosen = [
            str(n)
            for n, v in ds.data_vars.items()
            if v.dims and v.dims[0] == TIME and np.prod(v.shape[1:], initial=1) <= FEW
        ]
    else:
        chosen = list(variables)
        for name in chosen:
            if name not in ds or ds[name].dims[:1] != (TIME,):
                raise InputError(f"{name!r} is no variable over time of this dataset.", value=name)
    columns: dict[str, Any] = {"time_s": ds[TIME].values}
    for name in chosen:
        columns.update(_columns(ds[name]))
    return pd.DataFrame(columns)


def to_parquet(
    ds: xarray.Dataset, path: str | Path, variables: Sequence[str] | None = None
) -> Path:
    """Write :func:`scalar_table` as Parquet."""
    return frame_to_parquet(scalar_table(ds, variables), path)


def to_csv(ds: xarray.Dataset, path: str | Path, variables: Sequence[str] | None = None) -> Path:
    """Write :func:`scalar_table` as CSV, numbers in full precision."""
    return frame_to_csv(scalar_table(ds, variables), path)


def frame_to_parquet(frame: pandas.DataFrame, path: str | Path) -> Path:
    """Write a table as Parquet."""
    if not any(importlib.util.find_spec(e) for e in ("pyarrow", "fastparquet")):
        raise _lacks("Parquet", "pyarrow")
    path = _ready(path)
    frame.to_parquet(path, index=False)
    return path


def frame_to_csv(frame: pandas.DataFrame, path: str | Path) -> Path:
    """Write a table as CSV."""
    path = _ready(path)
    frame.to_csv(path, index=False)
    return path


def _columns(array: xarray.DataArray) -> dict[str, np.ndarray]:
    unit = array.attrs.get("units", "1")
    values = array.values.reshape(array.shape[0], -1)
    out = {}
    for flat, index in enumerate(np.ndindex(*array.shape[1:])):
        labels = [str(array[d].values[i]) for d, i in zip(array.dims[1:], index)]
        out[f"{'.'.join([str(array.name), *labels])} [{unit}]"] = values[:, flat]
    return out


def _ready(path: str | Path) -> Path:
    path = Path(path)
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InputError(f"The folder {path.parent} cannot be made: {error.strerror}.") from error
    return path


def _lacks(what: str, package: str) -> EnvironmentLacks:
    return EnvironmentLacks(
        f"Writing {what} needs the package {package}, which is not installed here: "
        f'install it with  pip install "flexcage[study]"  (or  pip install {package}).'
    )
