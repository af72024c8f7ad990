"""Runs in which each row has a cage: what they record, summaries, single rows, stress of mirror
images, and what is refused."""

from __future__ import annotations

import numpy as np
import pytest
from simulate_cases import Interrupted

from flexcage import load_case, load_run, simulate
from flexcage.core.errors import InputError
from flexcage.results import metrics
from flexcage.results.each_cage import one_cage

BEARING = {
    "type": "double_row_angular_contact_ball", "bore": "25 mm", "outside_diameter": "52 mm",
    "width": "20.6 mm", "pitch_diameter": "38.5 mm", "ball_diameter": "7.938 mm", "ball_count": 9,
    "inner_groove_radius": "4.088 mm", "outer_groove_radius": "4.167 mm",
    "contact_angle": "30 deg", "row_distance": "9.5 mm",
}  # fmt: skip
EACH = {
    "model": "rigid", "type": "crown", "rows": "each", "bore": "34.93 mm",
    "outside_diameter": "42.07 mm", "width": "7.1 mm", "pocket_diameter": "8.18 mm",
    "throat": "7.3 mm", "claw_thickness": "1.03 mm",
}  # fmt: skip


def case_of(cage=None, *, bearing=None, load=None, duration="1 ms", **sections):
    return load_case({
        "name": "3205", "bearing": {**BEARING, **(bearing or {})}, "cage": {**EACH, **(cage or {})},
        "drive": {"speed": "3000 rpm"}, "load": load or {"radial": "500 N", "axial": "200 N"},
        "mesh": {"fineness": "coarse"}, "solver": {"duration": duration}, **sections,
    })  # fmt: skip


@pytest.fixture(scope="module")
def stored(tmp_path_factory):
    folder = tmp_path_factory.mktemp("runs") / "two"
    return simulate(case_of(), out=folder), folder


def test_variables_of_a_whole_cage_have_a_dimension_of_cages(stored):
    ds = stored[0].dataset
    assert ds["cage"].values.tolist() == [0, 1]
    assert ds["cage_position"].dims == ("time", "cage", "axis")
    assert ds["land_station_force"].dims == ("time", "cage", "land_station", "polar")
    assert ds["pocket_force"].dims == ("time", "pocket", "face") and ds.sizes["pocket"] == 18
    x = ds["cage_position"].sel(axis="x").values
    np.testing.assert_allclose(x, np.broadcast_to([-4.75e-3, 4.75e-3], x.shape), atol=0.3e-3)
    turn = ds["cage_quaternion"].values[0]
    half = np.arctan2(turn[:, 1], turn[:, 0])  # the second row is half a ball's pitch ahead
    assert half[1] - half[0] == pytest.approx(np.pi / 18, abs=2e-3)


def test_a_row_alone_is_a_run_of_one_cage(stored):
    run, ds = stored[0], stored[0].dataset
    for k, row in enumerate(run.rows):
        own = slice(9 * k, 9 * k + 9)
        np.testing.assert_array_equal(
            row.dataset["cage_position"].values, ds["cage_position"].values[:, k]
        )
        np.testing.assert_array_equal(
            row.dataset["pocket_force"].values, ds["pocket_force"].values[:, own]
        )
        assert row.dataset["pocket"].values.tolist() == list(range(9))
        assert row.summary["cage_speed"] == pytest.approx(
            float(metrics.carrier_speed(row.dataset)[15:].mean()), rel=0.02
        )
    sign = np.sign([row.mesh.points[np.abs(row.mesh.points[:, 0]).argmax(), 0] for row in run.rows])
    assert sign.tolist() == [-1.0, 1.0]  # rings of the crowns are outside


def test_the_summary_has_both_cages(stored):
    run = stored[0]
    values = [row.summary["whirl_radius"] for row in run.rows]
    row = run.summary.row("whirl_radius")
    assert row.value == values[0] and values[0] != values[1]
    assert f"at +x {values[1] * 1e6:.3g}"[:9] in row.note
    assert run.summary["energy_audit"] == "passed"
    assert run.summary.row("cage_mass").note == "of each of 2"


def test_a_stored_run_gives_the_same_rows(stored):
    run, folder = stored
    again = load_run(folder)
    assert len(again.rows) == 2
    np.testing.assert_allclose(
        again.row(1).dataset["cage_omega"].values, run.row(1).dataset["cage_omega"].values
    )
    events = [row.events for row in run.rows]
    assert sum(len(e["time"]) for e in events) == len(run.events["time"])
    assert all(e["element"].values.max() < 9 for e in events)
    with pytest.raises(InputError, match="There is no cage 2"):
        run.row(2)


def test_what_takes_one_cage_says_so(stored):
    ds = stored[0].dataset
    with pytest.raises(InputError, match="Each row of the run's bearing has a cage"):
        metrics.whirl(ds)
    assert metrics.whirl(one_cage(ds, 0)).mean > 0.0
    with pytest.raises(InputError, match="take one of them"):
        metrics.tilt(ds)


def test_wear_is_that_of_all_pockets(stored):
    run = stored[0]
    found, rows = run.wear().dataset["volume_rate"], [row.wear().dataset for row in run.rows]
    np.testing.assert_allclose(
        found.values, np.concatenate([row["volume_rate"].values for row in rows]), rtol=1e-12
    )


@pytest.mark.parametrize(
    ("cage", "sections", "said"),
    [
        ({"throat": "6 mm"}, {"bearing": {"row_distance": "5 mm"}}, "the cages of both rows"),
        ({"rows": "both"}, {}, "cage.rows"),
        ({}, {"constraints": [{"type": "cage_speed", "ratio": 0.4}]}, "each row has one"),
        ({}, {"sensors": [{"type": "strain_gauge", "name": "s"}]}, "each row has one"),
    ],
)
def test_what_cages_of_rows_cannot_be(cage, sections, said):
    with pytest.raises(InputError, match=said):
        simulate(case_of(cage, **sections), stress=False)


@pytest.mark.parametrize("model", ["rigid", pytest.param("flexible", marks=pytest.mark.slow)])
def test_a_resumed_run_of_two_cages_is_the_unbroken_one(tmp_path, model):
    case = case_of({"model": model}, duration="2 ms", output={"block": 50})
    whole = simulate(case, stress=False)
    with pytest.raises(KeyboardInterrupt):
        simulate(case, out=tmp_path, progress=Interrupted(1, 1e-3), stress=False)
    resumed = simulate(case, out=tmp_path, resume=True, stress=False)
    for name in ("cage_quaternion", "cage_position", "element_position", "pocket_force"):
        a, b = whole.dataset[name].values, resumed.dataset[name].values
        size = np.abs(a).max()
        np.testing.assert_allclose(b, a, rtol=0.0, atol=3e-7 * size, err_msg=name)  # as stored
    np.testing.assert_array_equal(
        whole.dataset["cage_omega"].values, resumed.dataset["cage_omega"].values
    )


@pytest.mark.slow
def test_flexible_cages_with_defects_are_strained_as_mirror_images():
    """Rows without stagger under a radial load; a worn pocket and a bent claw make each cage
    uneven, and their own modes and stresses are those of the other in a mirror."""
    defects = [
        {"type": "worn_pocket", "pocket": 1, "depth": "0.1 mm"},
        {"type": "bent_claw", "pocket": 2, "claw": "rear", "deflection": "-0.15 mm"},
    ]
    run = simulate(case_of(
        {"model": "flexible"}, bearing={"staggered": False}, defects=defects, duration="0.6 ms",
        load={"radial": "2 kN", "gravity": "0 m/s^2"},
    ))  # fmt: skip
    ds = run.dataset
    modal = ds["modal_coordinates"].values
    assert modal.shape[1] == 2 and np.abs(modal).max() > 0.0
    np.testing.assert_allclose(modal[:, 1], modal[:, 0], atol=1e-3 * np.abs(modal).max())
    force = ds["pocket_force"].values
    assert force[:, :9].max() > 1.0
    np.testing.assert_allclose(force[:, 9:], force[:, :9], atol=2e-3 * force.max())
    first, second = (row.stress_history for row in run.rows)
    np.testing.assert_allclose(second.peak, first.peak, rtol=5e-3)
    fields = [row.stress(time="0.5 ms") for row in run.rows]
    np.testing.assert_allclose(
        fields[1].displacement * [-1.0, 1.0, 1.0], fields[0].displacement,
        atol=5e-3 * np.abs(fields[0].displacement).max(),
    )  # fmt: skip
    assert run.summary["energy_audit"] == "passed"


NN3010 = {
    "type": "double_row_cylindrical_roller", "bore": "50 mm", "outside_diameter": "80 mm",
    "width": "23 mm", "inner_race_diameter": "58 mm", "outer_race_diameter": "72 mm",
    "roller_diameter": "7 mm", "roller_length": "7 mm", "effective_length": "6.4 mm",
    "roller_count": 22, "rib_diameter": "60 mm", "rib_gap": "7.05 mm", "row_distance": "9 mm",
    "staggered": False, "radial_clearance": "20 um",
}  # fmt: skip
WINDOW = {
    "model": "flexible", "rows": "each", "guidance": "inner", "bore": "60.5 mm",
    "outside_diameter": "67 mm", "width": "8.9 mm", "pocket_width": "7.2 mm",
    "pocket_length": "7.25 mm", "fillet_radius": "0.4 mm",
}  # fmt: skip


@pytest.mark.slow
def test_flexible_window_cages_with_defects_are_strained_as_mirror_images():
    """A crossbeam pinches its roller from the start, a side beam at +x of one cage, -x of the
    other, is bent: pockets' own coordinates, forces by face and stresses are mirror images."""
    run = simulate(load_case({
        "name": "NN3010", "bearing": NN3010, "cage": WINDOW, "drive": {"speed": "3000 rpm"},
        "load": {"radial": "3 kN", "gravity": "0 m/s^2"}, "mesh": {"fineness": "coarse"},
        "defects": [
            {"type": "crossbeam", "crossbeam": 3, "displacement": "0.25 mm", "shape": "bent"},
            {"type": "side_beam", "pocket": 8, "side": "+x", "displacement": "-0.28 mm"},
        ],
        "solver": {"duration": "0.4 ms"},
    }))  # fmt: skip
    ds = run.dataset
    force = ds["pocket_force"].transpose("time", "pocket", "face").values
    assert force[:, 2].max() > 5.0 and force[:, 8, 2:].max() > 5.0
    np.testing.assert_allclose(
        force[:, 22:][..., [0, 1, 3, 2]], force[:, :22], atol=2e-3 * force.max()
    )
    modal = ds["modal_coordinates"].values
    np.testing.assert_allclose(modal[:, 1], modal[:, 0], atol=2e-3 * np.abs(modal).max())
    own = ds["residual_coordinates"].values
    np.testing.assert_allclose(own[:, 22:], own[:, :22], atol=3e-3 * np.abs(own).max())
    first, second = (row.stress_history for row in run.rows)
    np.testing.assert_allclose(second.peak, first.peak, rtol=5e-3)
    assert run.summary["stress_peak"] > 10e6 and run.summary["energy_audit"] == "passed"


@pytest.mark.slow
@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_both_integrators_agree_on_two_cages(model):
    one, other = (
        simulate(
            load_case(case_of({"model": model}, duration="0.5 ms").to_toml(),
                      overrides={"solver.method": method}),
            stress=False,
        ).dataset
        for method in ("explicit", "bdf")
    )  # fmt: skip
    most = float(one["race_force"].max())
    np.testing.assert_allclose(
        one["race_force"].values[-1], other["race_force"].values[-1], atol=0.01 * most
    )
    np.testing.assert_allclose(
        one["cage_position"].values[-1], other["cage_position"].values[-1], atol=1e-6
    )
