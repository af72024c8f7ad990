"""The outer ring on a bushing that yields along the axis and in tilt too: what it bears, where it
stands, and where a run begins."""

from __future__ import annotations

from functools import cache

import numpy as np
import pytest

from flexcage import simulate
from flexcage.case import load_case
from flexcage.results.metrics import settled, tilt

ALONG, ACROSS, IN_TILT = 50e6, 100e6, 20e3  # N/m, N/m, N m/rad
SOFT = {
    "kind": "bushing", "stiffness": "100 N/um", "damping": "2000 N*s/m",
    "axial_stiffness": "50 N/um", "axial_damping": "500 N*s/m",
    "tilt_stiffness": "20 kN*m/rad", "tilt_damping": "5 N*m*s/rad",
}  # fmt: skip
STIFF = {
    "kind": "bushing", "stiffness": "1e6 N/um", "damping": "0 N*s/m", "axial_stiffness": "1e6 N/um",
    "tilt_stiffness": "1e9 N*m/rad",
}  # fmt: skip
LOADS = {
    "7010C-PI": {"radial": "400 N", "axial": "500 N", "tilt": "held"},
    "N1013": {"radial": "1500 N", "misalignment": "0.5 mrad"},
}


@cache
def run(preset, mount):
    """5 ms, with a rigid cage; ``mount`` "soft", "stiff" or "fixed"."""
    table = {"soft": SOFT, "stiff": STIFF, "fixed": {"kind": "fixed"}}[mount]
    case = load_case(
        {
            "bearing": {"preset": preset}, "cage": {"model": "rigid"}, "mount": table,
            "drive": {"speed": "3000 rpm"}, "load": LOADS[preset], "solver": {"duration": "5 ms"},
        }
    )  # fmt: skip
    return simulate(case)


def means(ds, name):
    return settled(ds, 0.3)[name].transpose("time", "axis").values.astype(float).mean(axis=0)


@pytest.mark.parametrize("preset", LOADS)
def test_springs_bear_what_contacts_press_the_ring_with_and_its_weight(preset):
    found = run(preset, "soft")
    ds, bearing = found.dataset, found.case.bearing
    weight = np.array([0.0, -9.81 * bearing.outer_ring_mass, 0.0])  # gravity points along -y or y
    if found.case.load.gravity_direction == 0.0:
        weight = -weight
    pressed = means(ds, "outer_force") + weight
    springs = means(ds, "outer_position") * [ALONG, ACROSS, ACROSS]
    most = np.abs(springs).max()
    np.testing.assert_allclose(springs, pressed, atol=3e-3 * most)
    lean = settled(tilt(ds, body="outer"), 0.3).mean("time")  # of the axis, towards y and z
    moment = means(ds, "outer_moment")
    turned = IN_TILT * np.array([lean.sel(component="towards z"), lean.sel(component="towards y")])
    assert np.abs(moment[1:]).max() > 0.1
    np.testing.assert_allclose(
        [-turned[0], turned[1]], moment[1:], atol=0.02 * np.abs(moment).max()
    )


@pytest.mark.parametrize("preset", LOADS)
def test_loads_reach_the_outer_ring(preset):
    """The load on the inner ring, and the weight of all between."""
    found = run(preset, "soft")
    force, load = means(found.dataset, "outer_force"), found.case.load
    assert force[0] == pytest.approx(load.axial, abs=0.01 * load.radial)
    assert np.hypot(*force[1:]) == pytest.approx(load.radial, rel=0.02)


@pytest.mark.parametrize("preset", LOADS)
def test_a_run_begins_where_the_mount_has_yielded(preset):
    ds = run(preset, "soft").dataset
    place = ds["outer_position"].transpose("time", "axis").values
    most = np.abs(place).max()
    assert most > 1e-6
    np.testing.assert_allclose(place[0], means(ds, "outer_position"), atol=0.02 * most)


@pytest.mark.parametrize("preset", LOADS)
def test_a_stiff_bushing_is_a_fixed_ring(preset):
    stiff, fixed = run(preset, "stiff"), run(preset, "fixed")
    for name in ("outer_force", "outer_moment", "inner_position"):
        one, other = means(stiff.dataset, name), means(fixed.dataset, name)
        np.testing.assert_allclose(one, other, atol=0.01 * np.abs(other).max())
    assert not fixed.dataset["outer_position"].values.any()
    assert (
        fixed.summary.row("outer_tilt").idle
        and not run(preset, "soft").summary.row("outer_tilt").idle
    )
