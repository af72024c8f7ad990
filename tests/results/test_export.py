"""Export to files, and output options."""

import importlib.util
import re

import numpy as np
import pandas as pd
import pytest
import xarray as xr
from scipy.io import loadmat

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.results import export
from flexcage.results.options import OutputOptions


def test_csv_is_tidy(known_run, tmp_path):
    path = export.to_csv(known_run.isel(time=slice(0, 50)), tmp_path / "new" / "t.csv")
    table = pd.read_csv(path, float_precision="round_trip")
    assert len(table) == 50 and table.columns[0] == "time (s)"
    assert np.array_equal(table["cage_position[axis=y] (m)"], known_run["cage_position"][:50, 1])
    assert not any(c.startswith("race_force") for c in table)
    chosen = export.scalar_table(known_run, ["pocket_force"])
    assert chosen.shape == (5001, 1 + 88)
    force = known_run["pocket_force"].sel(pocket=7, face="rear")
    assert np.array_equal(chosen["pocket_force[pocket=7,face=rear] (N)"], force)


def test_vibration_has_its_own_instants(known_run, tmp_path):
    path = export.to_csv(known_run, tmp_path / "a.csv", ["outer_acceleration"])
    table = pd.read_csv(path, float_precision="round_trip")
    assert list(table) == ["time_hf (s)", *(f"outer_acceleration[axis2={k}] (m/s^2)" for k in "yz")]
    assert np.array_equal(table["time_hf (s)"], known_run["time_hf"])
    with pytest.raises(InputError, match=r"inner_speed over time and outer_acceleration over tim"):
        export.to_csv(known_run, tmp_path / "b.csv", ["inner_speed", "outer_acceleration"])


def test_each_component_has_its_unit(known_run):
    table = export.scalar_table(known_run, ["element_position", "ring_load"])
    headings = [c for c in table if "element=3," in c]
    assert headings == [
        "element_position[element=3,cyl=x] (m)",
        "element_position[element=3,cyl=r] (m)",
        "element_position[element=3,cyl=psi] (rad)",
        "ring_load[element=3,race=inner,bending=axial] (N)",
        "ring_load[element=3,race=inner,bending=radial] (N)",
        "ring_load[element=3,race=inner,bending=tilt] (N m)",
        "ring_load[element=3,race=outer,bending=axial] (N)",
        "ring_load[element=3,race=outer,bending=radial] (N)",
        "ring_load[element=3,race=outer,bending=tilt] (N m)",
    ]
    units = xr.DataArray(["N", "N m", "N m", "N m"], dims="constraint")
    table = export.scalar_table(known_run.assign_coords(multiplier_unit=units), ["multiplier"])
    assert list(table)[1:3] == [
        "multiplier[constraint=axial_force] (N)", "multiplier[constraint=moment_y] (N m)"
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("poket_force", "no variable 'poket_force': the nearest known one is 'pocket_force'"),
        ("contact_angle", "it is recorded of ball bearings alone"),
        ("roller_tilt", "the nearest known one is 'element_tilt'"),
    ],
)
def test_a_wrong_variable_gets_a_hint(known_run, tmp_path, name, words):
    with pytest.raises(InputError, match=words):
        export.write_table(known_run, tmp_path / "a.csv", [name])
    assert not list(tmp_path.iterdir())


@pytest.mark.parametrize(("ending", "read"), [("csv", pd.read_csv), ("parquet", pd.read_parquet)])
def test_every_axis_has_its_file(known_run, tmp_path, ending, read):
    given = ["pocket_force", "outer_acceleration", "inner_speed"]
    paths = export.write_table(known_run, tmp_path / f"a.{ending}", given)
    assert [p.name for p in paths] == [f"a_time.{ending}", f"a_time_hf.{ending}"]
    main, fine = (read(path) for path in paths)
    assert main.shape == (5001, 1 + 88 + 1) and fine.shape == (20001, 3)
    np.testing.assert_allclose(main["inner_speed (rad/s)"], known_run["inner_speed"], rtol=1e-15)
    with pytest.raises(InputError, match="a_time.* exists already; --force"):
        export.write_table(known_run, tmp_path / f"a.{ending}", given)
    export.write_table(known_run, tmp_path / f"a.{ending}", given, force=True)
    with pytest.raises(InputError, match=r"should end in .csv, .parquet or .mat"):
        export.write_table(known_run, tmp_path / "a.xlsx", given)


def test_mat_has_valid_names_and_says_its_columns(known_run, tmp_path):
    odd = {"2nd mean force, of all pockets": ("time", known_run["pocket_force"][:, 7, 1].values)}
    ds = known_run.assign(odd).assign({"x" * 70: odd.copy().popitem()[1]})
    names = ["pocket_force", "outer_acceleration", *odd, "x" * 70]
    (path,) = export.write_table(ds, tmp_path / "a.mat", names)
    stored = loadmat(path, simplify_cells=True)
    own = [name for name in stored if not name.startswith("__")]
    assert all(re.fullmatch(r"[A-Za-z]\w{0,62}", name) for name in own)
    assert set(own) == {
        "time", "time_hf", "pocket_force", "outer_acceleration", "columns", "x" * 63,
        "x_2nd_mean_force__of_all_pockets",
    }  # fmt: skip
    at = list(stored["columns"]["pocket_force"]).index("pocket_force[pocket=7,face=rear] (N)")
    assert stored["pocket_force"][4000, at] == 8.0
    assert np.array_equal(stored["time_hf"], ds["time_hf"])
    assert stored["columns"]["time_hf"] == "time_hf (s)"
    assert set(stored["columns"]) == set(own) - {"columns"}


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
    assert np.array_equal(back["inner_speed (rad/s)"], known_run["inner_speed"])


def test_default_grids_fit():
    assert OutputOptions().vibration_ratio == 4 and OutputOptions().block_hf == 1000


@pytest.mark.parametrize(
    ("name", "words"),
    [
        ("force[pocket=5]", "'force' has a column of each of its labels; name it without brackets"),
        ("force,speed", "name each by itself: force speed"),
        ("force speed", "name each by itself: force speed"),
        ("forc", "the nearest known one is 'force'"),
    ],
)
def test_several_variables_in_one_word_are_told(name, words):
    with pytest.raises(InputError, match=re.escape(words)):
        export.check_there(name, ["force", "speed"])
