"""Everything a case may choose runs, and does what its name says."""

import numpy as np
import pytest
from simulate_cases import PLACES, bent, n1013

from flexcage.case import load_case
from flexcage.compiling import build_bearing
from flexcage.contacts.spec import FRICTION_LAWS, NORMAL_LAWS
from flexcage.results.audit import energy_audit
from flexcage.results.metrics import settled
from flexcage.simulate import simulate
from flexcage.stages import assembled_start, cage_mesh, cage_reduction
from flexcage.static import solve_static

RIGID = {"cage.model": "rigid"}
SHORT = {"solver.duration": "0.5 ms"}


def finite(run):
    for name, values in run.dataset.data_vars.items():
        assert np.isfinite(values.values).all(), name
    return run.dataset


@pytest.mark.parametrize("friction", FRICTION_LAWS)
@pytest.mark.parametrize("normal", NORMAL_LAWS)
def test_every_law_at_every_place(normal, friction):
    """Run, lose what the law loses, and balance."""
    laws = {f"contacts.{p}.normal.law": normal for p in PLACES}
    laws |= {f"contacts.{p}.friction.law": friction for p in PLACES}
    if normal in ("impact", "impact_step"):
        laws |= {f"contacts.{p}.normal.damping": "10 N*s/m" for p in PLACES}
    run = simulate(n1013(RIGID, SHORT, laws, defects=bent("0.2 mm")))
    lost = energy_audit(finite(run)).channels
    assert (lost["race_damping"] == 0.0) == (normal == "elastic")
    assert (lost["race_friction"] == 0.0) == (friction == "none")
    assert lost["race_damping"] <= 0.0 and lost["pocket_friction"] <= 0.0


@pytest.mark.parametrize("method", ["explicit", "bdf"])
def test_methods(method):
    run = simulate(n1013(RIGID, SHORT, {"solver.method": method}))
    steps, explicit = run.summary["steps"], run.summary["explicit_steps"]
    assert steps > 0 and explicit == (steps if method == "explicit" else 0)
    assert energy_audit(finite(run)).passed


def test_auto_leaves_explicit_steps_when_they_become_too_short():
    """Damping and stiffness of the races grow with the load, and the bound falls to 7 us."""
    ramp = {"load.radial": "0 N", "load.ramp_to": "1 kN", "load.ramp_time": "3 ms"}
    auto = {"solver.stable_step": "12 us", "solver.duration": "4 ms", "output.block": 25}
    run = simulate(n1013(RIGID, ramp, auto))
    steps, explicit = run.summary["steps"], run.summary["explicit_steps"]
    assert 20 < explicit < steps - 20
    assert 5e-6 < run.summary["stable_step"] < 12e-6
    order = run.steps["order"]
    assert set(order[:explicit]) == {4} and set(order[explicit:]) <= {1, 2}  # one change, no more
    assert energy_audit(finite(run)).passed  # integrals went on through it


@pytest.mark.parametrize("method", ["explicit", "bdf"])
def test_the_outer_rings_acceleration_is_its_races_force_over_its_mass(method):
    """Between steps it is interpolated, which leaves a few per cent of its swing."""
    case = n1013(RIGID, {"solver.method": method, "solver.duration": "3 ms"})
    ds = simulate(case).dataset
    psi = ds["element_position"].sel(cyl="psi").values
    races = ds.sel(race="outer")
    push, drag = races["race_force"].values, -races["race_traction"].values
    y = (push * np.cos(psi) - drag * np.sin(psi)).sum(axis=1)
    z = (push * np.sin(psi) + drag * np.cos(psi)).sum(axis=1)
    ratio = ds.sizes["time_hf"] // ds.sizes["time"]
    found = ds["outer_acceleration"].values[ratio - 1 :: ratio] * case.bearing.outer_ring_mass
    missed = found - np.stack([y, z], axis=1)
    assert np.ptp(y) > 3.0 and (missed.std(axis=0) < 0.15).all()


@pytest.mark.parametrize("kind", ["none", "dry", "film"])
@pytest.mark.parametrize("guidance", ["roller", "inner", "outer"])
def test_lands(guidance, kind):
    if guidance != "roller" and kind == "none":
        pytest.skip("a guided cage needs its land")
    size = {"cage.guidance": guidance, "contacts.land.kind": kind, **SHORT}
    if guidance == "outer":
        size["contacts.land.clearance"] = "1.955 mm"
    ds = finite(simulate(n1013(RIGID, size)))
    touched = np.abs(ds["land_force"].values).max()
    assert (touched > 0.0) == (kind == "film")  # the dry land is 0.25 mm or more away


TIGHT = {
    "bearing.radial_clearance": "80 um", "cage.guidance": "inner", "cage.material": "PEEK",
    "cage.bore": "78.44 mm", "contacts.land.clearance": "20 um", "solver.tolerance": "1 nm",
}  # fmt: skip


def test_a_cage_makes_room_for_a_ring_with_more_play_than_its_land_has():
    """The ring hangs by 40 um and more; its land would press a cage in the middle by half of it.

    Then it rides on its land, touching once or twice, and energy is conserved.
    """
    run = simulate(n1013(TIGHT, {"solver.duration": "3 ms"}))
    ds = finite(run)
    apart = (ds["cage_position"] - ds["inner_position"]).values[:, 1:]
    sag = np.abs(ds["inner_position"].values[0]).max()
    assert sag > 40e-6 and np.linalg.norm(apart[0]) < 20e-6
    assert np.abs(ds["land_force"].values).max() > 1.0
    assert energy_audit(ds).passed and energy_audit(ds).of_drive < 0.01  # per cent


def at_start(case):
    """Where it begins, and all contacts' report there."""
    mesh = cage_mesh(case)
    bearing = build_bearing(case, mesh, cage_reduction(case, mesh))
    start = assembled_start(case, bearing)
    bearing.residual(0.0, start.y, start.yd, mode=2)
    return start, bearing.data.work.report


@pytest.mark.parametrize("kind", ["dry", "film"])
def test_room_that_a_cage_makes_presses_nothing(kind):
    """Neither pockets of less play than it moves, as rollers go with it, nor a film at its end."""
    close = {"cage.pocket_width": "8.02 mm", "contacts.land.kind": kind, "cage.model": "rigid"}
    start, report = at_start(n1013(TIGHT, close))
    assert start.residual < 1e-6 and report.pocket_normal.max() == 0.0
    assert np.abs(report.land).max() < (100.0 if kind == "film" else 1e-9)


def test_a_pinched_cage_makes_room_too():
    """Its ring would press the land by half of its sag with 430 times the load."""
    case = n1013(
        {"cage.bore": "78.41 mm", "contacts.land.clearance": "5 um"},
        defects=[{"type": "side_beam", "pocket": 9, "side": "+x", "displacement": "-0.3 mm"}],
    )
    start, report = at_start(case)
    assert start.pinched == (9,) and start.residual < 1e-6
    assert start.pinch_force > 100.0 and np.abs(report.land).max() == 0.0


def test_balls_and_their_cage_make_room():
    """The ring gives way to its load by more than the land's 2 um, and balls go with the cage."""
    case = load_case({
        "bearing": {"preset": "7010C-PI"},
        "cage": {"model": "rigid", "guidance": "inner"},
        "contacts": {"land": {"clearance": "2 um"}},
        "drive": {"speed": "4000 rpm"},
        "load": {"axial": "100 N", "radial": "200 N"},
    })  # fmt: skip
    start, report = at_start(case)
    assert start.y[6 * 18 + 1] > 2e-6  # the ring, in y
    assert np.abs(report.land).max() == np.abs(report.pocket_normal).max() == 0.0


@pytest.mark.parametrize("method", ["explicit", "bdf"])
def test_peaks_between_samples_are_kept(method):
    """Of contacts that last 30 us, samples every 50 us miss most; parabolas through the solver's
    steps do not.

    The same motion sampled at 800 kHz has the same largest force in every contact. Steps are the
    same, but for those that end with a block of samples.
    """
    push = {"start.push": "0.5 m/s", "solver.method": method, "solver.duration": "4 ms"}
    coarse, fine = (
        simulate(n1013(RIGID, push, {"output.rate": f"{k} kHz", "output.vibration_rate": "800 kHz",
                                     "output.block": k * 8})).dataset
        for k in (20, 800)
    )  # fmt: skip
    peaks, forces = coarse["pocket_peak"].values, coarse["pocket_force"].values
    assert (peaks >= forces - 1e-6 * forces.max()).all()
    seen = fine["pocket_force"].max("time").values
    hit = seen > 0.2 * seen.max()
    assert hit.sum() > 5
    kept, missed = (x.max(axis=0)[hit] / seen[hit] for x in (peaks, forces))
    assert 0.985 < np.median(kept) < 1.01 and kept.min() > 0.8 and np.median(missed) < 0.9


def test_mass_and_centre_are_those_with_the_unbalance():
    plain, heavy = (
        simulate(n1013(RIGID, SHORT, {"cage.unbalance": f"{u} g*mm"})).summary for u in (0, 50)
    )
    added = heavy["cage_mass"] - plain["cage_mass"]
    assert 0.5 * added * (78.9e-3 + 86.6e-3) / 2 == pytest.approx(50e-6, rel=0.02)
    assert heavy["cage_mass"] * heavy["cage_centre_shift"] == pytest.approx(50e-6, rel=1e-3)
    assert "make the unbalance" in heavy.row("cage_mass").note


def test_a_film_starts_without_a_load():
    """It has no equilibrium with a ring that nothing holds, which it drives round in its play."""
    film = {"contacts.land.kind": "film", "lubricant.viscosity": "0.05 Pa*s", "load.radial": "0 N"}
    ds = finite(simulate(n1013(RIGID, SHORT, film)))
    assert np.abs(ds["land_force"].values).max() > 0.0 and energy_audit(ds).passed


@pytest.mark.parametrize("kind", ["none", "goksem_hargreaves", "blended"])
def test_rolling_resistances(kind):
    run = simulate(n1013(RIGID, SHORT, {"lubricant.rolling_resistance": kind}))
    lost = energy_audit(finite(run)).channels["rolling_resistance"]
    assert (lost == 0.0) == (kind == "none") and lost <= 0.0


@pytest.mark.parametrize(
    "spec",
    [
        {"modes.kind": "craig_bampton"},
        {"modes.kind": "free_free"},
        {"modes.dynamic": "all"},
        {"modes.geometric_stiffening": True},
        {"mesh.order": 1},
    ],
    ids=str,
)
def test_bases(spec):
    ds = finite(simulate(n1013(SHORT, spec, defects=bent("0.2 mm"))))
    assert ds.sizes["mode"] >= 24
    assert np.abs(ds["modal_coordinates"].values).max() > 0.0


def mirrored(ds):
    """Arrays of a run seen in the mirror z -> -z: roller i is roller -i, front is rear."""
    order = -np.arange(ds.sizes["element"]) % ds.sizes["element"]
    faces = ds["pocket_force"].values[:, order][:, :, [1, 0, 2, 3]]
    return {
        "pocket_force": faces,
        "race_force": ds["race_force"].values[:, order],
        "cage_position": ds["cage_position"].values * [1.0, 1.0, -1.0],
        "inner_position": ds["inner_position"].values * [1.0, 1.0, -1.0],
        "roller_spin": -ds["element_omega"].values[:, order, 0],
        "cage_speed": -ds["cage_omega"].values[:, 0],
    }


def plain(ds):
    names = ("pocket_force", "race_force", "cage_position", "inner_position")
    return {
        **{name: ds[name].values for name in names},
        "roller_spin": ds["element_omega"].values[:, :, 0],
        "cage_speed": ds["cage_omega"].values[:, 0],
    }


def test_reversed_rotation_is_the_mirror_image():
    """Crossbeam 5 moved by +0.2 mm and 6000 rpm against crossbeam 18 by -0.2 mm and -6000 rpm."""
    tight = {**RIGID, "solver.tolerance": "0.0003 um"}
    forward = simulate(n1013(tight, defects=bent("0.2 mm")))
    back = simulate(
        n1013(tight, {"drive.speed": "-6000 rpm"}, defects=bent("-0.2 mm", crossbeam=18))
    )
    assert float(back.dataset["inner_speed"][-1]) < 0.0
    assert float(forward.dataset["pocket_force"].max()) > 10.0
    ours, theirs = mirrored(back.dataset), plain(forward.dataset)
    for name, values in theirs.items():
        early = slice(0, 70)  # up to 1.4 ms, before rounding errors of impacts grow
        scale = np.abs(values[early]).max()
        np.testing.assert_allclose(
            ours[name][early], values[early], atol=5e-3 * scale, err_msg=name
        )
    slip = [run.summary["cage_slip_ratio"] for run in (forward, back)]
    assert slip[1] == pytest.approx(slip[0], abs=1e-3)


def test_a_bent_beam_shows_in_one_sense_of_rotation_and_the_other():
    """Both senses run with the defect, and load the narrowed pocket 4 at its middle slices."""
    for speed in ("6000 rpm", "-6000 rpm"):
        ds = finite(simulate(n1013({"drive.speed": speed}, defects=bent("0.2 mm"))))
        slices = ds["pocket_slice_force"].sel(crossbeam_face="front")[:, 4].sum("time")
        assert slices.sum() > 0.0
        assert slices.where(abs(slices["slice"]) < 0.8e-3).sum() > 0.8 * slices.sum()


def test_misalignment_is_held_by_tilt_moments():
    """The moment resists the tilt, turns with its sign, and grows with it; none without it."""
    moments = {}
    for tilt in (-0.2, 0.0, 0.1, 0.2):
        run = simulate(n1013(RIGID, {"load.misalignment": f"{tilt} mrad"}))
        held = finite(run)["multiplier"].isel(time=slice(20, None)).mean("time")
        moments[tilt] = held.values[1:3]
    assert np.abs(moments[0.0]).max() < 1e-3
    about_z = {tilt: m[1] for tilt, m in moments.items()}
    assert about_z[0.2] > 0.1  # N m: the constraint holds the ring in its tilt
    assert about_z[-0.2] == pytest.approx(-about_z[0.2], rel=0.05)
    assert 1.5 < about_z[0.2] / about_z[0.1] < 3.0


def test_a_bushing_lets_the_outer_ring_move():
    """It gives way by load over stiffness, and its acceleration is the ring's own."""
    soft = {"mount.kind": "bushing", "mount.stiffness": "100 N/um", "mount.mass": "0.5 kg"}
    run = simulate(n1013(RIGID, soft, {"solver.duration": "6 ms"}))
    ds, b = finite(run), run.case.bearing
    moved = ds["outer_position"].isel(time=slice(50, None)).mean("time").values
    moving = (
        b.inner_ring_mass + b.outer_ring_mass + 0.5 + 22 * b.roller_mass + run.summary["cage_mass"]
    )
    assert moved[1] == pytest.approx((1000.0 + 9.80665 * moving) / 1e8, rel=0.02)
    assert abs(moved[2]) < 0.05 * moved[1] and moved[0] == 0.0
    raw, smooth = (ds[f"outer_acceleration{n}"].values for n in ("", "_filtered"))
    assert 1.0 < np.abs(raw).max() < 5e3
    assert np.std(smooth[200:]) < np.std(raw[200:])
    assert ds.sizes["time_hf"] * 5e-6 == pytest.approx(6e-3)


def test_a_ring_in_a_bore_lies_where_the_load_presses_it():
    """It rests on the bore by clearance and load over stiffness, and what it does costs energy."""
    loose = {
        "mount.kind": "contact", "mount.stiffness": "100 N/um", "mount.mass": "0.5 kg",
        "mount.clearance": "15 um", "mount.damping": "5000 N*s/m",
    }  # fmt: skip
    run = simulate(n1013(RIGID, loose, {"solver.duration": "8 ms"}))
    ds, b = finite(run), run.case.bearing
    moved = ds["outer_position"].isel(time=slice(150, None)).mean("time").values
    moving = (
        b.inner_ring_mass + b.outer_ring_mass + 0.5 + 22 * b.roller_mass + run.summary["cage_mass"]
    )
    pressed = np.hypot(moved[1], moved[2])
    assert pressed == pytest.approx(15e-6 + (1000.0 + 9.80665 * moving) / 1e8, rel=0.02)
    assert ds["energy"].sel(energy_kind="mount").values.max() > 0.5 * 1e8 * (9e-6) ** 2
    assert run.summary["energy_relative"] < 2e-3


def test_a_fixed_ring_reports_the_force_on_it():
    """What its contact forces would give a free ring: 1000 N and weights and all over its mass."""
    run = simulate(n1013(RIGID, {"solver.duration": "4 ms"}))
    ds, b = finite(run), run.case.bearing
    assert np.all(ds["outer_position"].values == 0.0)
    mean = ds["outer_acceleration"].isel(time_hf=slice(200, None)).mean("time_hf").values
    carried = 1000.0 + 9.80665 * (b.inner_ring_mass + 22 * b.roller_mass + run.summary["cage_mass"])
    assert mean[0] * b.outer_ring_mass == pytest.approx(carried, rel=0.02)


def test_a_compliant_shaft_drives():
    """Torque through the shaft instead of the constraint; it winds up by torque over stiffness."""
    stiffness = 2000.0
    shaft = {
        "drive.kind": "shaft",
        "drive.shaft_stiffness": f"{stiffness} N*m/rad",
        "drive.shaft_damping": "1 N*m*s/rad",
        "solver.duration": "8 ms",
    }
    run = simulate(n1013(RIGID, shaft))
    ds = finite(run).isel(time=slice(200, None))
    fixed = simulate(n1013(RIGID, {"solver.duration": "8 ms"})).dataset.isel(time=slice(200, None))
    assert np.all(ds["multiplier"].sel(constraint="drive_torque").values == 0.0)
    torque = float(fixed["multiplier"].sel(constraint="drive_torque").mean())
    speed = 6000 * np.pi / 30
    wound = float((speed * ds["time"] - ds["inner_angle"]).mean())
    assert torque > 0.0
    assert wound == pytest.approx(torque / stiffness, rel=0.1)
    assert float(ds["inner_speed"].mean()) == pytest.approx(speed, rel=1e-3)


@pytest.mark.parametrize("method", ["explicit", "bdf"])
def test_a_shaft_that_yields_along_the_axis_and_in_tilt(method):
    """It bears the loads as springs do, as the static solution has them, and the audit closes."""
    shaft = {
        "load.axial": "200 N", "load.axial_stiffness": "10 N/um",
        "load.axial_damping": "2000 N*s/m", "load.tilt": "free", "load.moment_z": "1 N*m",
        "load.tilt_stiffness": "2000 N*m/rad", "load.tilt_damping": "0.1 N*m*s/rad",
        "solver.method": method, "solver.duration": "4 ms",
    }  # fmt: skip
    run = simulate(n1013(RIGID, shaft))
    ds = finite(run)
    along = ds["inner_position"].sel(axis="x").values
    borne = ds["multiplier"].values[:, :3]
    damped = 2000.0 * ds["inner_velocity"].sel(axis="x").values
    np.testing.assert_allclose(borne[:, 0], -1e7 * along - damped, atol=0.5)
    still = solve_static(run.case).reaction
    assert along.mean() == pytest.approx(2e-5, rel=0.05) and still[0] == pytest.approx(-200.0)
    assert borne[0, 0] == pytest.approx(-200.0, rel=0.01)
    assert borne[0, 2] == pytest.approx(still[4], rel=0.01) and -0.9 < still[4] < -0.5
    assert -1.0 < borne[100:, 2].mean() < still[4]  # rollers in motion bear less of it
    assert energy_audit(ds).passed and energy_audit(ds).channels["mount"] < 0.0
    told = run.summary
    assert told["reaction_axial_force"] == pytest.approx(-1e7 * told["inner_axial"], rel=0.01)
    torque = ds["multiplier"].sel(constraint="drive_torque")
    assert told["drive_torque"] == pytest.approx(float(settled(torque, 0.3).mean()), rel=0.02)


def test_a_very_stiff_shaft_is_a_constraint():
    """It bears the moment that holds a misaligned ring."""
    tilted = {"load.misalignment": "0.2 mrad"}
    stiff = {
        "load.tilt": "free",
        "load.tilt_stiffness": "1e7 N*m/rad",
        "load.tilt_damping": "10 N*m*s/rad",
    }
    held, free = (
        finite(simulate(n1013(RIGID, tilted, more)))["multiplier"].isel(time=slice(20, None))
        for more in ({}, stiff)
    )
    about_z = [float(ds.sel(constraint="moment_z").mean()) for ds in (held, free)]
    assert about_z[0] > 0.1 and about_z[1] == pytest.approx(about_z[0], rel=0.02)


def test_speed_and_load_follow_their_tables():
    """A ramp of the speed and a table of the load; the inner ring's angle is the integral."""
    changing = {
        "drive.ramp_to": "6600 rpm", "drive.ramp_start": "0.4 ms", "drive.ramp_time": "1 ms",
        "load.times": ["0 ms", "1 ms", "2 ms"], "load.values": ["1000 N", "1000 N", "500 N"],
    }  # fmt: skip
    ds = finite(simulate(n1013(RIGID, changing)))
    t, rpm = ds["time"].values, np.pi / 30
    expected = np.interp(t, [0.4e-3, 1.4e-3], [6000 * rpm, 6600 * rpm])
    np.testing.assert_allclose(ds["inner_speed"], expected, rtol=1e-12)  # steps end at corners
    fine = np.linspace(0.0, 2e-3, 200_001)
    speed = np.interp(fine, [0.4e-3, 1.4e-3], [6000 * rpm, 6600 * rpm])
    angle = np.concatenate([[0.0], np.cumsum(0.5e-8 * (speed[1:] + speed[:-1]))])
    np.testing.assert_allclose(ds["inner_angle"], np.interp(t, fine, angle), atol=1e-5)
    held = ds["race_force"].sel(race="inner").sum("element")
    assert float(held[-1]) < 0.75 * float(held[:40].mean())


def test_roller_scatter_is_seeded():
    """The same seed gives the same rollers; their spread is what is asked."""
    case = n1013(RIGID, {"bearing.roller_scatter": "1 um"})
    mesh = cage_mesh(case)
    one, again = (build_bearing(case, mesh, None).data.model.bodies.radius for _ in range(2))
    np.testing.assert_array_equal(one, again)
    assert 2.0 * np.std(one) == pytest.approx(1e-6, rel=0.4)
    spread = finite(simulate(case))["race_force"].sel(race="inner").values
    even = simulate(n1013(RIGID)).dataset["race_force"].sel(race="inner").values
    assert np.abs(spread[0] - even[0]).max() > 10.0


def test_another_seed_gives_other_rollers():
    case = n1013(RIGID, {"bearing.roller_scatter": "1 um"})
    mesh = cage_mesh(case)
    radii = [
        build_bearing(c, mesh, None).data.model.bodies.radius
        for c in (case, case.replace("seed", 1))
    ]
    assert np.abs(radii[0] - radii[1]).max() > 0.1e-6


def test_waviness_shakes_the_inner_ring():
    """Two waves of 2 um a turn on the inner race: the ring's centre follows by about as much."""
    moved = []
    for amplitude in (0.0, 2.0):
        wavy = {"bearing.inner_waviness": f"{amplitude} um", "bearing.inner_waviness_order": 2}
        ds = finite(simulate(n1013(RIGID, wavy, {"solver.duration": "6 ms"})))
        moved.append(float(np.ptp(ds["inner_position"].sel(axis="y").values[25:])))
    assert moved[0] < 1e-6 < 1.5e-6 < moved[1] < 5e-6


def test_outer_waviness_changes_the_race_forces():
    forces = []
    for amplitude in (0.0, 1.0):
        wavy = {"bearing.outer_waviness": f"{amplitude} um", "bearing.outer_waviness_order": 11}
        ds = finite(simulate(n1013(RIGID, SHORT, wavy)))
        forces.append(ds["race_force"].sel(race="outer").values[0])
    assert np.abs(forces[1] - forces[0]).max() > 10.0


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_unbalance_moves_the_mass_centre(model):
    """0.5 g mm at 90 degrees: the first moment of mass is just that, and the run goes on."""
    heavy = {"cage.unbalance": "500 g*mm", "cage.unbalance_phase": "90 deg", "cage.model": model}
    run = simulate(n1013(heavy))
    c0 = build_bearing(run.case, run.mesh, run.cage).data.model.cage.c0
    np.testing.assert_allclose(c0, [0.0, 0.0, 5e-4], atol=2e-7)
    finite(run)
