"""Runs of ball bearings: complete, in balance, resumable, and near what statics and rolling say."""

from __future__ import annotations

import numpy as np
import pytest
from c7010_states import bearing_of
from simulate_cases import Interrupted

from flexcage.case import load_case
from flexcage.core.errors import InputError, RunFailed
from flexcage.render import spectra_picture
from flexcage.results.audit import energy_audit
from flexcage.results.contact_activity import contact_activity
from flexcage.results.metrics import settled
from flexcage.results.registry import VARIABLES, variables_of
from flexcage.results.spectra import run_frequencies
from flexcage.simulate import load_run, simulate

BASE = {
    "bearing": {"preset": "7010C-PI"},
    "mesh": {"fineness": "coarse"},
    "drive": {"speed": "4000 rpm"},
    "load": {"axial": "100 N", "radial": "40 N", "tilt": "free"},
    "output": {"block": 50},
    "solver": {"duration": "10 ms"},
}
RIGID = {"cage.model": "rigid"}
ELSEWHERE = ("ring_", "support_", "spot_")  # of rings that bend and of spotted balls


def c7010(*tables):
    return load_case(BASE, overrides={k: v for table in tables for k, v in table.items()})


@pytest.fixture(scope="module")
def flexible(tmp_path_factory):
    return simulate(c7010(), out=tmp_path_factory.mktemp("balls"))


def test_every_variable_of_balls_is_there_and_finite(flexible):
    ds = flexible.dataset
    rigid = {name for name in variables_of("ball") if not name.startswith(ELSEWHERE)}
    assert set(ds.data_vars) == rigid
    for name, values in ds.data_vars.items():
        assert np.isfinite(values.values).all(), name
        assert values.attrs["units"] == VARIABLES[name].unit
    assert ds["race_force"].dims == ("time", "element", "race") and ds.sizes["element"] == 18
    assert list(ds["face"].values) == ["pocket"]
    assert set(flexible.events["place"].values) <= {"inner race", "outer race", "pocket"}


def test_its_energy_balances_and_balls_roll(flexible):
    audit = energy_audit(flexible.dataset)
    assert audit.of_drive < 1e-4 and audit.of_cage < 0.02
    s = flexible.summary
    assert s["energy_audit"] == "passed"
    assert abs(s["cage_slip_ratio"]) < 0.01 and abs(s["slip_loaded"]) < 0.01
    outer, inner = (np.degrees(s[f"contact_angle_{race}"]) for race in ("outer", "inner"))
    assert 13.0 < outer < inner < 19.0
    assert 0.0 < s["pocket_force_peak"] < 50.0 and s["stress_peak"] > 1e4
    assert s["explicit_steps"] == s["steps"]


def test_the_ring_bears_its_loads(flexible):
    """What the inner ring pushes balls with is, on average, its load and weight: their tractions
    across the groove, which hold the gyroscopic moment, bear three hundredths of the axial load."""
    ds = flexible.dataset.isel(time=slice(100, None)).sel(race="inner")
    N, angle = ds["race_force"].values, ds["contact_angle"].values
    along, across = ds["race_traction"].values, ds["race_traction_across"].values
    psi = ds["element_position"].sel(cyl="psi").values
    outwards = N * np.cos(angle) + across * np.sin(angle)
    axial = (N * np.sin(angle) - across * np.cos(angle)).sum(axis=1).mean()
    radial = (outwards * np.cos(psi) - along * np.sin(psi)).sum(axis=1).mean()
    weight = flexible.case.bearing.inner_ring_mass * flexible.case.load.gravity
    assert axial == pytest.approx(100.0, rel=2e-3)
    assert radial == pytest.approx(40.0 + weight, rel=0.01)


@pytest.mark.parametrize("kind", ["ramp", "table"])
def test_the_ring_bears_an_axial_load_that_rises(kind):
    """100 N, from 2 to 6 ms up to 300 N: what balls push back along the axis follows it."""
    times, values = [0.0, 2e-3, 6e-3, 8e-3], [100.0, 100.0, 300.0, 300.0]
    changes = {
        "ramp": {"load.ramp_to": "300 N", "load.ramp_start": "2 ms", "load.ramp_time": "4 ms"},
        "table": {
            "load.axial": "0 N", "load.times": [f"{1e3 * t} ms" for t in times],
            "load.values": [f"{f} N" for f in values],
        },
    }  # fmt: skip
    along = {"load.varies": "axial", "load.radial": "0 N", "solver.duration": "8 ms"}
    run = simulate(c7010(RIGID, along, changes[kind]))
    ds = run.dataset.sel(race="inner")
    angle, across = ds["contact_angle"], ds["race_traction_across"]
    borne = (ds["race_force"] * np.sin(angle) - across * np.cos(angle)).sum("element").values
    ring = run.case.bearing.inner_ring_mass * np.gradient(
        ds["inner_velocity"].sel(axis="x").values, ds["time"].values
    )
    load = np.interp(ds["time"].values, times, values)
    np.testing.assert_allclose((borne + ring)[2:-2], load[2:-2], atol=1.0)
    assert run.summary["energy_audit"] == "passed"


def test_a_ramp_by_acceleration_is_the_ramp_by_time():
    """1500 rad/s^2 over 300 rpm are 20.94 ms, up as well as down."""
    for ramp_to in ("4300 rpm", "3700 rpm"):
        tables = [
            bearing_of(c7010(RIGID, {"drive.ramp_to": ramp_to, **how})).data.model.bodies.speed
            for how in (
                {"drive.acceleration": "1500 rad/s^2"},
                {"drive.ramp_time": f"{300.0 * np.pi / 30.0 / 1500.0} s"},
            )
        ]
        np.testing.assert_allclose(tables[0], tables[1], rtol=1e-12)


def test_races_bear_the_gyroscopic_moment(flexible):
    """A ball that orbits with its axis tilted needs I psi' w_r about the direction of its orbit;
    tractions across both grooves give it, towards the shoulder that is not loaded."""
    ds = flexible.dataset.isel(time=slice(200, None))
    across = ds["race_traction_across"].mean(("time", "element"))
    orbit = (ds["element_velocity"].sel(cyl="psi") / ds["element_position"].sel(cyl="r")).values
    bearing = flexible.case.bearing
    wanted = (
        bearing.ball_inertia * (orbit * ds["element_omega"].sel(spin_axis="radial").values).mean()
    )
    given = -0.5 * bearing.ball_diameter * float(across.sum())
    assert wanted > 0.0 and given == pytest.approx(wanted, rel=0.03)
    assert float(across.sel(race="outer")) < 0.0


def test_contacts_of_the_cage_by_events_are_those_of_its_forces(flexible):
    """Two accounts of one run: flags of the solver's steps, and forces between them."""
    ds, s = settled(flexible.dataset, flexible.case.output.settle), flexible.summary
    sampled = contact_activity(ds)
    assert 0.0 < s["contact_frequency"] < 2e3
    assert s["contact_frequency_total"] == pytest.approx(18 * s["contact_frequency"])
    assert s["contact_frequency_total"] == pytest.approx(sampled.total, rel=0.1, abs=400.0)
    assert s["free_flight_share"] == pytest.approx(sampled.free_flight_share, abs=0.02)
    assert "step of the solver" in s.row("contact_frequency").note
    assert 0.0 < s["velocity_deviation_2khz"] < 2.0 and 0.0 < s["velocity_deviation"] < 2.0


def test_its_spectra_and_the_lines_that_so_short_a_run_tells(flexible, tmp_path):
    numbers, settle = flexible.numbers, flexible.case.output.settle
    nominal = run_frequencies(flexible.dataset, numbers, own=False)
    assert nominal["BPFO"] == pytest.approx(515.0728, abs=1e-3)
    own = run_frequencies(flexible.dataset, numbers)["BPFO"]
    assert own == pytest.approx(18 * flexible.summary["epicyclic_speed"] / (2 * np.pi), rel=3e-4)
    assert 515.2 < own < 515.6, "contact angles are a little over their nominal 15 degrees"
    path = spectra_picture(
        flexible.dataset, tmp_path / "spectra.png", bearing=numbers, settle=settle
    )
    assert path.stat().st_size > 40_000
    with pytest.raises(InputError, match="684.6 Hz; there are .* raise solver.duration"):
        spectra_picture(flexible.dataset, path, bearing=numbers, settle=0.7)


def test_a_run_comes_back_from_its_folder(flexible):
    again = load_run(flexible.folder)
    assert again.case == flexible.case and str(again.summary) == str(flexible.summary)


@pytest.mark.parametrize("method", ["explicit", "bdf"])
def test_a_resumed_run_is_the_unbroken_one(tmp_path, method):
    case = c7010(RIGID, {"solver.duration": "4 ms", "solver.method": method})
    whole = simulate(case, out=tmp_path / "whole")
    with pytest.raises(KeyboardInterrupt):
        simulate(case, out=tmp_path / "run", progress=Interrupted(2, 1e-3))
    resumed = simulate(case, out=tmp_path / "run", resume=True)
    for name in ("element_position", "element_omega", "cage_position", "race_force", "work"):
        assert np.array_equal(resumed.dataset[name].values, whole.dataset[name].values), name


def test_by_the_bdf_means_are_those_of_explicit_steps():
    """At the default tolerance, from the same start, with steps four times as long and more; and
    energy balances."""
    plain = {"load.axial": "1 kN", "load.radial": "300 N", "solver.duration": "20 ms"}
    explicit, bdf = (
        simulate(c7010(RIGID, plain, {"solver.method": m})) for m in ("explicit", "bdf")
    )
    assert bdf.summary["energy_audit"] == "passed" and bdf.summary["explicit_steps"] == 0
    assert 3 * bdf.summary["steps"] < explicit.summary["steps"]
    half = slice(explicit.dataset.sizes["time"] // 2, None)
    for name, within in (
        ("race_force", 1e-3), ("contact_angle", 1e-3), ("inner_position", 1e-3),
        ("element_omega", 1e-3), ("cage_omega", 1e-3), ("race_traction", 0.05),
    ):  # fmt: skip
        one, other = (
            run.dataset[name].isel(time=half).mean("time").values for run in (explicit, bdf)
        )
        assert np.abs(one - other).max() < within * np.abs(one).max(), name


def test_auto_takes_explicit_steps_of_a_light_bearing_and_implicit_ones_of_a_heavy_one():
    for axial, implicit in (("100 N", False), ("8 kN", True)):
        run = simulate(c7010(RIGID, {"load.axial": axial, "solver.duration": "4 ms"}))
        assert (run.summary["explicit_steps"] == 0) == implicit
        assert run.summary["energy_audit"] == "passed"


def test_a_held_centre_stays_and_bears_what_a_free_one_does():
    """Its load says where it stands: balls press on it as if it were free, to what they vibrate."""
    held = {"load.centre": "held", "solver.method": "explicit", "solver.duration": "4 ms"}
    ds = simulate(c7010(RIGID, held)).dataset
    assert np.ptp(ds["inner_position"].values, axis=0).max() == 0.0
    assert np.abs(ds["inner_velocity"].values).max() == 0.0
    free = simulate(c7010(RIGID, {**held, "load.centre": "free"})).dataset
    assert np.ptp(free["inner_position"].sel(axis="x").values) > 1e-9
    loads = [d["race_force"].sel(race="inner").values for d in (ds, free)]
    assert loads[0].mean() == pytest.approx(loads[1].mean(), rel=0.05)


def test_unequal_balls_bear_unequal_loads_and_uneven_pockets_meet_them_elsewhere():
    """Larger balls are pressed harder than their neighbours."""
    plain = {"load.radial": "0 N", "load.gravity": "0 m/s^2", "solver.duration": "4 ms"}
    uneven = {"bearing.ball_scatter": "0.3 um", "cage.pocket_scatter": "40 um"}
    even = simulate(c7010(RIGID, plain)).dataset
    ds = simulate(c7010(RIGID, plain, uneven)).dataset
    half = slice(ds.sizes["time"] // 2, None)
    force, equal = (
        d["race_force"].sel(race="inner").isel(time=half).mean("time").values for d in (ds, even)
    )
    assert np.ptp(equal) < 0.02 * equal.mean() and np.ptp(force) > 0.1 * equal.mean()
    case = c7010(RIGID, plain, uneven)
    radius = bearing_of(case).data.model.bodies.radius
    # what the ring's displacement and tilt even out goes once round the bearing
    at = 2.0 * np.pi * np.arange(18) / 18
    once = np.stack([np.ones(18), np.cos(at), np.sin(at)], axis=1)
    left = [v - once @ np.linalg.lstsq(once, v, rcond=None)[0] for v in (force, radius)]
    assert np.corrcoef(*left)[0, 1] > 0.95
    moved = [d.circumferential for d in case.all_defects]
    assert len(moved) == 18 and np.std(moved) > 20e-6


def test_contact_loads_of_a_thrust_bearing_are_those_published():
    """7603025 under 3500 N and 1200 N at 2000 rpm: every ball's load, from the loaded side on."""
    table = {
        **BASE, "bearing": {"preset": "7603025"}, "drive": {"speed": "2000 rpm"},
        "load": {"axial": "3500 N", "radial": "1200 N", "gravity": "0 m/s^2"},
    }  # fmt: skip
    case = load_case(table, overrides={**RIGID, "solver.duration": "1 ms"})
    force = simulate(case).dataset["race_force"].sel(race="inner").mean("time").values
    published = (542.523, 514.965, 439.615, 335.616, 226.814, 133.675, 67.710, 30.199, 15.004)
    pairs = [0.5 * (force[k] + force[-k]) for k in range(9)]  # the bearing turns a little
    np.testing.assert_allclose(pairs, published, rtol=0.02, atol=1.5)


def test_a_deformed_pocket_is_felt_where_it_is():
    """A cage pressed forward meets the ball of a pocket that is displaced backwards first."""
    from flexcage.compiling import build_bearing
    from flexcage.stages import cage_mesh
    from flexcage.verification.runs import c7010 as rigid

    def touching(*defects):
        case = rigid({"defects": list(defects)}) if defects else rigid()
        bearing = build_bearing(case, cage_mesh(case), None) if defects else bearing_of(case)
        layout, model = bearing.layout, bearing.data.model
        y = np.zeros(layout.size)
        q = layout.q(y)
        q["elements"][:, 1] = model.pocket.height
        q["elements"][:, 2] = 2 * np.pi * np.arange(18) / 18 + 0.2e-3 / model.pocket.height
        q["quaternion"][0] = 1.0
        bearing.residual(0.0, y, np.zeros_like(y), mode=2)
        return set(np.flatnonzero(bearing.data.work.report.pocket_normal[:, 0] > 0.0))

    assert touching() == set()
    assert touching({"type": "displaced", "pocket": 3, "circumferential": "-0.1 mm"}) == {3}
    assert touching({"type": "enlarged", "pocket": 4, "increase": "-0.2 mm"}) == {4}
    slot = {
        "type": "elongated",
        "pocket": 4,
        "direction": "circumferential",
        "elongation": "0.2 mm",
    }
    assert touching({"type": "enlarged", "pocket": 4, "increase": "-0.2 mm"}, slot) == set()


def test_a_cage_that_comes_off_ends_the_run():
    """Nothing but traction holds a cage with radial holes across the axis; without any, and out of
    balance, it is thrown off."""
    smooth = {f"contacts.{p}.friction.law": "none" for p in ("race", "pocket")}
    case = c7010(RIGID, smooth, {
        "drive.speed": "10000 rpm", "cage.unbalance": "5 g*mm", "solver.duration": "0.2 s",
        "output.rate": "20 kHz", "output.vibration_rate": "20 kHz", "load.radial": "0 N",
        "contacts.land.kind": "none",  # no shoulder stops it
    })  # fmt: skip
    with pytest.raises(RunFailed, match="the cage came off, ball .* outside its pocket at t = "):
        simulate(case)


def test_what_balls_have_not_is_one_sentence():
    with pytest.raises(InputError, match="load.centre is 'held'.*\"explicit\", not 'bdf'"):
        c7010(RIGID, {"solver.method": "bdf", "load.centre": "held"})
    narrow = {"bearing": {"preset": "15x37x10"}, "cage": {"type": "machined"}}
    with pytest.raises(InputError, match="leaves no rims in a cage 6.5 mm wide"):
        load_case(narrow)


@pytest.mark.slow
def test_shoulders_hold_a_cage_that_only_balls_guide():
    """The preset leaves 85 um to the outer ring's shoulder and its balls 150 um; without the
    contact the same start swings by 146 um."""
    case = load_case({
        "bearing": {"preset": "7010C-PA66"}, "mesh": {"fineness": "coarse"},
        "cage": {"model": "rigid", "pocket_shape": "spherical", "pocket_diameter": "9.03 mm"},
        "drive": {"speed": "8000 rpm"},
        "load": {"axial": "1500 N", "radial": "750 N", "gravity": "0 m/s^2"},
        "start": {"push": "20 mm/s", "seed": 3}, "solver": {"duration": "20 ms"},
        "lubricant": {"rolling_resistance": "none", "oil_fraction": 0.0},
        "contacts": {"race": {"friction": {"law": "step_coulomb"}}},
    })  # fmt: skip
    run = simulate(case)
    swing = np.hypot(*run.dataset["cage_position"].values[:, 1:].T).max()
    assert 80e-6 < swing < 87e-6
    assert np.abs(run.dataset["land_force"].values).max() > 1.0
    assert "meets_ring" in [w.key for w in run.warnings] and energy_audit(run.dataset).passed
