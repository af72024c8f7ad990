"""Export to files, and output options."""

import importlib.util

import numpy as np
import pandas as pd
import pytest
import xarray as xr

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.results import export
from flexcage.results.options import OutputOptions


def test_csv_is_tidy(known_run, tmp_path):
    path = export.to_csv(known_run.isel(time=slice(0, 50)), tmp_path / "new" / "t.csv")
    table = pd.read_csv(path, float_precision="round_trip")
    assert len(table) == 50 and table.columns[0] == "time_s"
    assert np.array_equal(table["cage_position.y [m]"], known_run["cage_position"][:50, 1])
    assert not any(c.startswith("race_force") for c in table)
    chosen = export.scalar_table(known_run, ["pocket_force"])
    assert "pocket_force.7.rear [N]" in chosen and chosen.shape == (5001, 1 + 88)
    with pytest.raises(InputError, match="no variable over time"):
        export.scalar_table(known_run, ["outer_acceleration"])


@pytest.mark.parametrize("writer", [export.to_netcdf, export.to_parquet])
def test_a_missing_package_is_named(known_run, tmp_path, monkeypatch, writer):
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    with pytest.raises(EnvironmentLacks, match=r"pip install"):
        writer(known_run, tmp_path / "x")


def test_netcdf_round_trip(known_run, tmp_path):
    path = export.to_netcdf(known_run, tmp_path / "r.nc")
    with xr.open_dataset(path) as back:
        assert back["cage_position"].attrs["units"] == "m"
        assert np.array_equal(back["cage_position"], known_run["cage_position"])


def test_parquet_round_trip(known_run, tmp_path):
    back = pd.read_parquet(export.to_parquet(known_run, tmp_path / "r.parquet"))
    assert np.array_equal(back["inner_speed [rad/s]"], known_run["inner_speed"])


def test_default_grids_fit():
    assert OutputOptions().vibration_ratio == 4 and OutputOptions().block_hf == 1000
