"""Runs of double row bearings: speeds against closed-form kinematics, mirror images, both
integrators, what is recorded, and what is refused."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
import pytest

from flexcage import load_case, simulate
from flexcage.case import catalogue
from flexcage.case.new import new_case
from flexcage.core.errors import InputError
from flexcage.stages import cage_modes

B3205 = {
    "type": "double_row_angular_contact_ball", "bore": "25 mm", "outside_diameter": "52 mm",
    "width": "20.6 mm", "pitch_diameter": "38.5 mm", "ball_diameter": "7.938 mm", "ball_count": 9,
    "inner_groove_radius": "4.088 mm", "outer_groove_radius": "4.167 mm",
    "contact_angle": "30 deg", "row_distance": "9.5 mm",
}  # fmt: skip
CROWN = {
    "model": "rigid", "type": "crown", "bore": "34.93 mm", "outside_diameter": "42.07 mm",
    "width": "7.1 mm", "pocket_diameter": "8.18 mm", "throat": "7.3 mm",
    "claw_thickness": "1.03 mm",
}  # fmt: skip
NONE = {"model": "none"}


def ran(cage: Mapping[str, object] = NONE, *, bearing=None, load=None, **solver):
    case = load_case({
        "name": "3205", "bearing": {**B3205, **(bearing or {})}, "cage": cage,
        "drive": {"speed": "3000 rpm"}, "load": load or {"axial": "1 kN"},
        "mesh": {"fineness": "coarse"}, "solver": {"duration": "1 ms", **solver},
    })  # fmt: skip
    return simulate(case, stress=False)


@pytest.fixture(scope="module")
def pushed():
    """Under an axial load that one row bears."""
    return ran(load={"axial": "1 kN", "gravity": "0 m/s^2"}, duration="4 ms")


def test_an_axial_load_drives_one_row_as_it_drives_a_single_bearing(pushed):
    """The orbit of its balls against pure rolling at their contact angles."""
    ds = pushed.dataset
    force = ds["race_force"].sel(race="inner").values
    assert force[:, :9].min() > 50.0 and force[:, 9:].max() < 1.0
    late = ds.isel(time=slice(len(ds["time"]) // 2, None), element=slice(0, 9))
    angle = np.abs(late["contact_angle"].values).mean(axis=(0, 1))
    ratio = 7.938 / 38.5
    lean_in, lean_out = 1.0 - ratio * np.cos(angle[0]), 1.0 + ratio * np.cos(angle[1])
    rolling = late["inner_speed"].values.mean() * lean_in / (lean_in + lean_out)
    orbit = (
        late["element_velocity"].sel(cyl="psi") / late["element_position"].sel(cyl="r")
    ).values.mean()
    assert orbit == pytest.approx(rolling, rel=4e-3)


def test_elements_know_their_row(pushed):
    row = pushed.dataset["row"]
    assert row.dims == ("element",) and row.values.tolist() == [0] * 9 + [1] * 9
    x = pushed.dataset["element_position"].sel(cyl="x").values[-1]
    np.testing.assert_allclose(x, np.repeat([-4.75e-3, 4.75e-3], 9), atol=0.1e-3)
    assert pushed.summary["energy_audit"] == "passed"
    evenly = 38.5 * np.pi / 9 - 38.5 * np.arcsin(7.938 / 38.5)
    assert pushed.summary["largest_gap"] * 1e3 == pytest.approx(evenly, rel=0.05)


def test_a_radial_load_presses_rows_that_are_mirror_images():
    run = ran(bearing={"staggered": False}, load={"radial": "2 kN", "gravity": "0 m/s^2"})
    force = run.dataset["race_force"].values
    angle = run.dataset["contact_angle"].values
    most = force.max()
    np.testing.assert_allclose(force[:, :9], force[:, 9:], atol=1e-4 * most)
    loaded = force[:, :9] > 0.01 * most
    np.testing.assert_allclose(angle[:, :9][loaded], -angle[:, 9:][loaded], atol=1e-4)
    assert np.abs(run.dataset["inner_position"].sel(axis="x").values).max() < 1e-9


@pytest.mark.parametrize("cage", [NONE, CROWN], ids=["without a cage", "one cage"])
def test_both_integrators_agree(cage):
    load = {"radial": "1 kN", "axial": "500 N"}
    one, other = (
        ran(cage, load=load, method=method, duration="0.5 ms").dataset
        for method in ("explicit", "bdf")
    )
    most = float(one["race_force"].max())
    np.testing.assert_allclose(
        one["race_force"].values[-1], other["race_force"].values[-1], atol=0.01 * most
    )
    np.testing.assert_allclose(
        one["inner_position"].values[-1], other["inner_position"].values[-1], atol=2e-8
    )


def test_a_common_cage_has_the_pockets_of_both_rows():
    run = ran(CROWN, load={"axial": "500 N", "radial": "500 N"})
    ds = run.dataset
    assert ds.sizes["pocket"] == 18 and run.mesh.pocket_count == 9
    x = run.mesh.points[:, 0]
    assert x.min() == pytest.approx(-x.max(), rel=1e-9) and x.max() < 10.3e-3
    assert run.summary["cage_speed"] * 30 / np.pi == pytest.approx(
        1232.0, rel=0.08
    )  # balls of steep angles lead


@pytest.mark.parametrize(
    ("cage", "changes", "said"),
    [
        ({**CROWN, "model": "flexible"}, {}, "a common cage that bends is one body; give 6.595"),
        ({**CROWN, "throat": "6 mm"}, {"row_distance": "5 mm"}, "halves of a cage for both rows"),
    ],
)
def test_what_a_common_cage_cannot_be(cage, changes, said):
    with pytest.raises(InputError, match=said):
        ran(cage, bearing=changes)


def test_a_common_cage_has_no_modes():
    case = load_case({
        "bearing": B3205, "cage": CROWN, "mesh": {"fineness": "coarse"}, "load": {"axial": "1 kN"},
    })  # fmt: skip
    with pytest.raises(InputError, match="a common cage that bends is one body"):
        cage_modes(case)


def test_a_self_aligning_ring_that_nothing_holds_is_refused():
    entry = catalogue.find("1205")
    text = new_case(entry.outline, entry.source).text
    with pytest.raises(InputError, match="nothing in the motion of a self-aligning ball bearing"):
        load_case(text, overrides={"load.tilt": "free"})


@pytest.mark.parametrize("name", ["3205", "1205", "NN3010"])
def test_a_designation_becomes_a_case_that_runs(name):
    entry = catalogue.find(name)
    made = new_case(entry.outline, entry.source)
    case = load_case(made.text, overrides={"solver.duration": "0.2 ms", "mesh.fineness": "coarse"})
    run = simulate(case, stress=False)
    assert run.summary["energy_audit"] == "passed"
    assert abs(made.chosen.static_error) < 0.02
    assert run.dataset.sizes["element"] == 2 * case.bearing.element_count
