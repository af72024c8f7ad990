"""Runs of format 4 are read with the names of today."""

import json

import numpy as np
import pytest

from flexcage.results.registry import Variable
from flexcage.results.renamed import NAMES, SPLIT
from flexcage.results.store import RunStore

N, Z = 12, 3
OLD = {
    "ball": {
        "ball_position": ("ball", "cyl"),
        "ball_velocity": ("ball", "cyl"),
        "ball_omega": ("ball", "cyl"),
        "contact_force": ("ball", "race"),
        "contact_slip": ("ball", "race"),
        "contact_traction": ("ball", "race", "direction"),
        "pocket_direction": ("ball",),
    },
    "roller": {
        "roller_position": ("roller", "cyl"),
        "roller_velocity": ("roller", "cyl"),
        "roller_quaternion": ("roller", "quaternion"),
        "roller_tilt": ("roller", "tilt"),
        "roller_omega": ("roller", "spin_axis"),
        "race_force": ("roller", "race"),
        "race_traction": ("roller", "race"),
        "pocket_slice_force": ("pocket", "crossbeam_face", "slice"),
    },
}


def old_run(path, element, blocks):
    """A run in two blocks as format 4 had it; its values by name."""
    table = [Variable(name, ("time", *dims), "m", name) for name, dims in OLD[element].items()]
    table = [v if "slice" not in v.dims else Variable(**vars(v) | {"sparse": True}) for v in table]
    coords = {
        "time": np.arange(N) * 1e-3, element: np.arange(Z), "pocket": np.arange(Z),
        "slice": np.arange(4),
    }  # fmt: skip
    if element == "ball":
        coords["direction"] = ["rolling", "across"]
    attrs = {"element": element, "places": ["inner race"]}
    store = RunStore.create(path, coords=coords, variables=table, n_time=N, block=6, attrs=attrs)
    random = np.random.default_rng(1)
    values = {v.name: random.normal(size=store.layout.shape(v)) for v in table}
    for k in range(blocks):
        store.write_block(k, {name: x[6 * k : 6 * k + 6] for name, x in values.items()})
    for file in (path / "zarr.json", path / "_run/commit.json"):
        stored = json.loads(file.read_text())
        if "attributes" in stored:
            attributes = stored["attributes"]
            attributes |= {k: json.loads(attributes[k]) for k in ("layout", "run")}
            attributes["flexcage_format"] = 4
            for variable in attributes["layout"]["variables"]:
                del variable["sparse"]
        else:
            stored["format"] = 4
        file.write_text(json.dumps(stored))
    return values


@pytest.mark.parametrize("blocks", [1, 2])
@pytest.mark.parametrize("element", OLD)
def test_a_run_of_format_4_has_the_names_of_today(element, blocks, tmp_path):
    values, n = old_run(tmp_path / "r.zarr", element, blocks), 6 * blocks
    ds = RunStore.open(tmp_path / "r.zarr").dataset()
    split, _, parts = SPLIT
    for name, old in values.items():
        if name == split:
            for k, part in enumerate(parts.values()):
                np.testing.assert_array_equal(ds[part].values, old[:n, ..., k])
                assert ds[part].dims == ("time", "element", "race")
        else:
            np.testing.assert_array_equal(ds[NAMES.get(name, name)].values, old[:n])
    assert ds["element"].values.tolist() == [0, 1, 2]
    assert ds["element_omega"].dims == ("time", "element", "spin_axis")
    assert ds["element_omega"].sel(spin_axis="axial").shape == (n, Z)
    assert ds["element_position"].sel(cyl="psi").shape == (n, Z)
    assert not {"roller", "ball", "direction", split} & set(ds.variables)
    families = {"roller": "cylindrical_roller", "ball": "ball"}
    assert ds.attrs["family"] == families[element] and ds.attrs["element"] == element
