"""Runs of format 4, whose variables and dimensions had a name for each kind of rolling elements."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    import xarray

OLD_FORMAT = 4
FAMILIES = {"roller": "cylindrical_roller", "ball": "ball"}  # by rolling elements
#: Variables, recorded and derived, and dimensions, old to new.
NAMES: Mapping[str, str] = {
    "roller": "element",
    "roller_position": "element_position",
    "roller_velocity": "element_velocity",
    "roller_quaternion": "element_quaternion",
    "roller_tilt": "element_tilt",
    "roller_omega": "element_omega",
    "roller_slip_ratio": "element_slip_ratio",
    "ball": "element",
    "ball_position": "element_position",
    "ball_velocity": "element_velocity",
    "ball_omega": "element_omega",
    "ball_slip_ratio": "element_slip_ratio",
    "contact_force": "race_force",
    "contact_slip": "race_slip",
}
#: Components that became variables: old variable, its dimension, and names by its labels.
SPLIT = ("contact_traction", "direction", {
    "rolling": "race_traction", "across": "race_traction_across",
})  # fmt: skip
_SPIN_AXES = ("axial", "radial", "tangential")
_SPARSE = {"slice", "end_point", "station", "residual"}  # dimensions of variables mostly zero


def stored_then(variable: Mapping[str, Any]) -> dict[str, Any]:
    """The fields of a stored variable, with those that its format left to its dimensions."""
    return {**variable, "sparse": bool(_SPARSE & set(variable["dims"]))}


def renamed(ds: xarray.Dataset) -> xarray.Dataset:
    """A dataset of format 4 with the names of today; values are not read."""
    if "ball_omega" in ds:  # had the labels of positions, (x, r, psi)
        omega = ds["ball_omega"].drop_vars("cyl").rename(cyl="spin_axis")
        ds = ds.drop_vars("ball_omega").assign(ball_omega=omega)
        ds = ds.assign_coords(spin_axis=list(_SPIN_AXES))
    old, dim, parts = SPLIT
    if old in ds:
        whole = ds[old]
        for label, name in parts.items():
            part = whole.sel({dim: label}, drop=True)
            ds = ds.assign({name: part.assign_attrs(long_name=f"{whole.long_name}: {label}")})
        ds = ds.drop_dims(dim)
    ds = ds.rename({name: new for name, new in NAMES.items() if name in ds.variables})
    return ds.assign_attrs(family=FAMILIES[ds.attrs["element"]])
