"""Metrics against a motion whose figures are known."""

import re

import numpy as np
import pytest
import xarray as xr

from flexcage.bearings.cylindrical_roller import slip as roller_slip
from flexcage.contacts.spec import EhlTraction, FrictionLaw
from flexcage.core.errors import InputError
from flexcage.results import audit, metrics
from flexcage.results.figures.part import SettledRun
from flexcage.results.figures.sections import summarise
from flexcage.results.row import SummaryRow
from flexcage.results.slip import SlipRange, cage_speed, element_spin
from flexcage.results.spectra import amplitude_spectrum
from flexcage.results.summary import Summary

RPM = np.pi / 30


def test_cage_speed_and_slip(known_run, bearing):
    speed = cage_speed(metrics.settled(known_run), bearing)
    assert speed.epicyclic * 30 / np.pi == pytest.approx(2709.09, abs=0.01)
    assert speed.slip_ratio == pytest.approx(0.02, abs=1e-9)
    assert speed.revolutions == pytest.approx(3.0, abs=0.01)


def test_roller_slip_zones_apart(known_run, bearing):
    summary = summarise(SettledRun(known_run, bearing))
    assert summary["slip_loaded"] == pytest.approx(0.01, abs=1e-6)
    assert summary["slip_unloaded"] == pytest.approx(0.05, abs=1e-6)
    assert summary["loaded_share"] == pytest.approx(3 / 22)
    sliding = [summary[f"sliding_{race}_loaded"] for race in ("inner", "outer")]
    assert sliding == pytest.approx([0.02, 0.02])


@pytest.mark.parametrize(
    ("law", "note"),
    [
        (FrictionLaw(law="step_coulomb", v_static=0.05), "unresolved.*creep speed 0.05 m/s"),
        (FrictionLaw(law="ramp_coulomb", v_static=0.01), "unresolved.*creep speed 1 m/s"),
        (FrictionLaw(law="ramp_coulomb", v_static=0.001, v_dynamic=0.01), "^$"),
        (FrictionLaw(law="traction"), "traction curve's slope.*rise, which ends at 0.3 m/s"),
        (FrictionLaw(law="traction", peak_speed=0.01), "^$"),
        (EhlTraction(creep_speed=0.05), "traction curve's slope.*ends at 0.05 m/s"),
        (EhlTraction(creep_speed=0.01), "^$"),
        (FrictionLaw(law="none"), "^$"),
    ],
)
def test_the_summary_says_what_loaded_slip_rests_on(known_run, bearing, law, note):
    """Loaded rollers of this run slide at 0.02 m/s."""
    limits = SlipRange(law.creeps_below, law.rises_below)
    told = summarise(SettledRun(known_run, bearing, slip_range=limits)).row("slip_loaded").note
    assert re.search(note, told), told


def test_unloaded_slip_is_noted_by_its_own_sliding(known_run, bearing):
    """Unloaded rollers of this run do not slide on their races; then most do at 0.8 m/s."""
    limits = SlipRange(creep=0.1)
    summary = summarise(SettledRun(known_run, bearing, slip_range=limits))
    assert "unresolved" in summary.row("slip_unloaded").note
    sliding = known_run.copy(deep=True)
    sliding["race_slip"][:, 6:, 1] = -0.8
    summary = summarise(SettledRun(sliding, bearing, slip_range=limits))
    assert summary.row("slip_unloaded").note == ""
    assert "unresolved" in summary.row("slip_loaded").note


@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("speed", [0.0, 4e-27])
def test_a_bearing_that_stands_has_no_slip_ratio_and_no_note(known_run, bearing, speed):
    ds = known_run.copy(deep=True)
    ds["inner_speed"][:] = speed
    summary = summarise(SettledRun(ds, bearing, slip_range=SlipRange(creep=1.0)))
    for key in ("cage_slip_ratio", "slip_loaded", "slip_unloaded"):
        row = summary.row(key)
        assert row.text == "-" and row.note == "" and row.margin is None


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_a_roller_that_turns_backwards_spins_against_rolling(known_run, bearing, sense):
    ds = known_run.copy(deep=True)
    for name in ("inner_speed", "element_omega", "cage_omega"):
        ds[name][:] *= sense
    rolling = summarise(SettledRun(ds, bearing))
    assert rolling["roller_spin"] == pytest.approx((19 * 0.95 + 3 * 0.99) / 22 * 27937.5 * RPM)
    assert rolling["roller_spin_ideal"] == pytest.approx(27937.5 * RPM)
    ds["element_omega"][:, 8, 0] *= -1.0
    spin = element_spin(ds)
    assert float(spin.max("time")[8]) == pytest.approx(-0.95 * 27937.5 * RPM)
    assert float(spin.isel(element=7).min()) > 0.0
    assert summarise(SettledRun(ds, bearing))["roller_spin"] < rolling["roller_spin"]


def test_a_family_that_is_not_known_is_not_taken_for_rollers(known_run):
    with pytest.raises(InputError, match="family 'needle', which is not known"):
        element_spin(known_run.assign_attrs(family="needle"))


def test_mixing_frames_would_fake_slip(known_run, bearing):
    """A roller in pure rolling slips by nothing in either frame; mixed, by 8.8 %."""
    ideal = known_run.copy(deep=True)
    ideal["element_omega"][:, :, 0] = -27937.5 * np.pi / 30
    ideal["cage_omega"][:, 0] = 2709.0909090909 * np.pi / 30
    for frame in ("inertial", "cage"):
        slip = roller_slip.slip_ratio(ideal, bearing, frame=frame)
        assert float(np.abs(slip).max()) < 1e-9
    mixed = 1 - 27937.5 / (bearing.kinematics(-6000).element_spin_in_cage)
    assert mixed == pytest.approx(0.088, abs=5e-4)


def test_whirl_of_a_circle(known_run):
    part = metrics.whole_revolutions(known_run)
    about_mean = metrics.whirl(part)
    assert about_mean.mean == pytest.approx(40e-6, rel=1e-3)
    assert about_mean.ratio == pytest.approx(0.0, abs=2e-3)
    assert about_mean.speed_ratio == pytest.approx(1.0, abs=1e-3)
    about_axis = metrics.whirl(part, about="axis")
    centre = np.hypot(10e-6, 20e-6)
    assert about_axis.largest == pytest.approx(40e-6 + centre, rel=1e-4)
    assert about_axis.smallest == pytest.approx(40e-6 - centre, rel=1e-4)


def test_tilt_from_orientation(known_run):
    """A cage turned by 2 mrad about z after any spin leans towards +y by 2 mrad."""
    ds = known_run.copy(deep=True)
    half, spin = 1e-3, ds["cage_quaternion"].values
    w, x = spin[:, 0], spin[:, 1]
    lean = np.stack([np.cos(half) * w, np.cos(half) * x, np.sin(half) * x, np.sin(half) * w], 1)
    ds["cage_quaternion"][:] = lean
    out = metrics.tilt(ds)
    assert np.allclose(out.sel(component="total"), 2e-3, rtol=1e-9)
    assert np.allclose(out.sel(component="towards y"), 2e-3, rtol=1e-6)
    assert np.allclose(out.sel(component="towards z"), 0.0, atol=1e-12)


def test_pocket_forces(known_run):
    forces = metrics.pocket_forces(known_run)
    assert (forces.peak, forces.peak_pocket, forces.peak_face) == (11.0, 7, "rear")
    assert forces.peak_time == pytest.approx(4000 / 50e3)
    assert forces.mean == pytest.approx((2500 * 3 + 8) / 2501)
    total, faces, largest = metrics.pocket_force_series(known_run)
    assert total.sum() / faces.sum() == pytest.approx(forces.mean) and largest.max() == 11.0
    assert forces.contact_share == pytest.approx(2501 / (5001 * 22 * 4))


def test_energy_audit_balances_and_sees_a_leak(known_run):
    assert audit.energy_audit(known_run).relative < 1e-12
    leaky = known_run.copy(deep=True)
    leaky["energy"][:, 1] += 0.12 * leaky["time"].values
    check = audit.energy_audit(leaky)
    assert check.final == pytest.approx(0.012)
    assert check.moved == pytest.approx(1.2)
    assert check.relative == pytest.approx(0.01)
    assert check.channels == pytest.approx({"drive": 0.5, "race_friction": -0.7})


@pytest.mark.parametrize(
    ("leak", "of_drive", "of_cage", "verdict"),
    [(4e-4, 8e-4, 0.04, "passed"), (6e-4, 1.2e-3, 0.06, "EXCEEDED"), (0.0, 0.0, 0.0, "passed")],
)
def test_energy_audit_of_the_cage(known_run, bearing, leak, of_drive, of_cage, verdict):
    """0.5 J of drive, of which pockets take 10 mJ: a leak of 0.4 mJ passes, one of 0.6 does not."""
    ds = known_run.assign_coords(channel=["drive", "pocket_friction"])
    ds["work"][:, 1] = -0.1 * ds["time"].values
    ds["energy"][:, 0] = ds["work"].sum("channel").values
    ds["energy"][:, 1] = 10.0 * leak * ds["time"].values
    check = audit.energy_audit(ds)
    assert check.of_drive == pytest.approx(of_drive, abs=1e-12)
    assert check.of_cage == pytest.approx((1.0 - audit.BEGUN) * of_cage, abs=1e-12)
    assert check.passed == (verdict == "passed")
    assert summarise(SettledRun(ds, bearing))["energy_audit"] == verdict


def test_what_a_cage_loses_at_its_lands_is_of_the_cage(known_run):
    """The land takes 19 mJ and pockets 1: an imbalance of 0.4 mJ is 2 % of what the cage exchanges,
    and 40 % of what pockets alone take. One of 2 mJ is too large for both."""
    ds = known_run.assign_coords(channel=["land_friction", "pocket_friction"])
    ds["work"][:, 0] = -0.19 * ds["time"].values
    ds["work"][:, 1] = -0.01 * ds["time"].values
    ds["energy"][:, 0] = ds["work"].sum("channel").values + 4e-3 * ds["time"].values
    ds["energy"][:, 1] = 0.0
    check = audit.energy_audit(ds)
    assert check.of_cage == pytest.approx((1.0 - audit.BEGUN) * 0.02, abs=1e-3) and check.passed
    ds["energy"][:, 0] += 16e-3 * ds["time"].values
    assert audit.energy_audit(ds).verdict == "EXCEEDED"


@pytest.mark.parametrize(
    ("leaks", "of_cage", "verdict"),
    [((0.1, 0.3), 0.0, "passed"), ((0.6, 0.9), 0.4, "EXCEEDED"), ((0.1, 0.9), 0.1, "EXCEEDED")],
)
def test_what_is_missed_before_the_cage_is_touched_is_not_the_cages(
    known_run, leaks, of_cage, verdict
):
    """0.4 mJ leak in a part of the run; the cage loses 1 mJ near its end."""
    ds = known_run.assign_coords(channel=["drive", "pocket_friction"])
    share = ds["time"].values / ds["time"].values[-1]
    touched = 0.5 if leaks[1] - leaks[0] < 0.5 else 0.7
    ds["work"][:, 1] = -1e-3 * np.clip((share - touched) / (1.0 - touched), 0.0, 1.0)
    leak = 4e-4 * np.clip((share - leaks[0]) / (leaks[1] - leaks[0]), 0.0, 1.0)
    ds["energy"][:, 0] = ds["work"].sum("channel").values + leak
    ds["energy"][:, 1] = 0.0
    check = audit.energy_audit(ds)
    assert check.of_drive == pytest.approx(8e-4, rel=1e-6)
    assert check.of_cage == pytest.approx(of_cage, abs=0.01)
    assert check.verdict == verdict


@pytest.mark.parametrize(
    ("lost", "leak", "judged", "verdict"),
    [
        (4e-4, 1e-4, False, "passed"),
        (4e-4, 1e-5, True, "passed"),
        (6e-4, 1e-4, True, "EXCEEDED"),  # a cage that works
        (4e-4, 6e-4, True, "EXCEEDED"),  # more than the drive may miss
        (-4e-4, 1e-4, True, "EXCEEDED"),  # losses that give energy
    ],
)
def test_a_cage_that_hardly_loses_anything_is_no_measure(
    known_run, bearing, lost, leak, judged, verdict
):
    """The drive does 0.5 J, of which its share may miss 0.5 mJ; the cage's modes lose less."""
    ds = known_run.assign_coords(channel=["drive", "modal_damping"])
    share = ds["time"].values / ds["time"].values[-1]
    ds["work"][:, 0], ds["work"][:, 1] = 0.5 * share, -lost * share
    ds["energy"][:, 0] = ds["work"].sum("channel").values + leak * share
    ds["energy"][:, 1] = 0.0
    check, row = audit.energy_audit(ds), summarise(SettledRun(ds, bearing)).row("energy_of_cage")
    assert check.verdict == verdict and np.isfinite(check.of_cage) == judged
    assert ("too little" in row.note) == (not judged)


@pytest.mark.parametrize(
    ("work", "lost", "leak", "verdict"),
    [
        (0.0, 0.0, 0.0, "not judged"),
        (0.0, 0.0, 1e-3, "EXCEEDED"),  # energy from nowhere
        (1e-40, 0.0, 4e-8, "not judged"),  # the drive's rounding is no work
        (0.5, -1e-3, 4e-4, "EXCEEDED"),  # pockets that give energy do not hide a leak
        (2e-10, 2e-10, 5e-8, "not judged"),  # a bearing that stands, pinched
        (6e-5, 1e-4, 8e-8, "passed"),  # by the cage's losses; the drive does too little
        (2e-10, 2e-10, 2e-7, "EXCEEDED"),  # more than a thousandth of what is held
        (0.5, 1e-2, 6e-4, "EXCEEDED"),
        (0.5, 1e-2, 4e-4, "passed"),
    ],
)
def test_too_little_work_is_no_leak(known_run, bearing, work, lost, leak, verdict):
    """Contacts hold 0.1 mJ; drive and cage move less than that, or as much as in a run."""
    ds = known_run.assign_coords(channel=["drive", "pocket_friction"])
    share = ds["time"].values / ds["time"].values[-1]
    ds["work"][:, 0], ds["work"][:, 1] = work * share, -lost * share
    ds["energy"][:, 0] = ds["work"].sum("channel").values + leak * share
    ds["energy"][:, 1] = 1e-4
    summary = summarise(SettledRun(ds, bearing))
    assert summary["energy_audit"] == verdict
    assert summary["energy_elastic"] == pytest.approx(1e-4)
    assert ("too little work" in summary.row("energy_audit").note) == (verdict == "not judged")
    assert ("tighten" in summary.row("energy_audit").note) == (verdict == "EXCEEDED")


def test_spectrum_reads_amplitude():
    t = np.arange(2000) / 20e3
    signal = xr.DataArray(
        np.stack([3.0 * np.sin(2 * np.pi * 500 * t) + 7.0, np.cos(2 * np.pi * 1000 * t)], axis=1),
        dims=("time", "axis2"),
        coords={"time": t, "axis2": ["y", "z"]},
        attrs={"units": "m/s^2"},
    )
    spectrum = amplitude_spectrum(signal)
    assert spectrum.dims == ("frequency", "axis2")
    assert float(spectrum.sel(frequency=500, axis2="y")) == pytest.approx(3.0, rel=1e-6)
    assert float(spectrum.sel(frequency=1000, axis2="z")) == pytest.approx(1.0, rel=1e-6)
    assert float(spectrum.idxmax("frequency").sel(axis2="y")) == pytest.approx(500)


def test_velocity_deviation_of_a_pulsing_circle(known_run):
    """Speed 1 + 0.3 sin has a standard deviation of 0.3/sqrt(2) of its mean."""
    ds = known_run.isel(time=slice(0, 5000)).copy(deep=True)
    t = ds["time"].values
    speed = 1.0 + 0.3 * np.sin(2 * np.pi * 100 * t)
    ds["cage_velocity"][:] = np.stack([0 * t, speed, 0 * t], axis=1)
    assert metrics.velocity_deviation(ds) == pytest.approx(0.3 / np.sqrt(2), rel=1e-3)
    assert metrics.velocity_deviation(ds, low_pass=2e3) == pytest.approx(0.3 / np.sqrt(2), rel=0.01)


def test_rounding_is_shown_as_nothing():
    texts = [SummaryRow("a", "A", v, "mrad").text for v in (7e-25, -7e-25, 2e-9)]
    assert texts == ["0", "0", "2.000e-06"]
    assert SummaryRow("b", "B", 1e-20, "1/h").text == "3.600e-17"  # a small damage is one


def test_summary_prints_and_comes_back(known_run, bearing, tmp_path):
    summary = summarise(
        SettledRun(known_run, bearing, slip_range=SlipRange(creep=0.05))
    ).with_section(
        "Solver", [SummaryRow("steps", "Steps", 12345), SummaryRow("wall", "Wall time", 1.5, "s")]
    )
    text = summary.text()
    assert "unresolved" in text and "12,345" in text and re.search(r" 2,709\.1 +rpm", text)
    assert "95 % interval" in text and re.search(r"Pocket force, mean +\S+ ± \S+ +N", text)
    lines = [line for line in text.splitlines() if line.startswith("  ")]
    ends = {line.index(" rpm") for line in lines if " rpm" in line}
    assert len(ends) == 1, "values are right-aligned"
    assert summary["roller_passes"] == 68
    assert summary["drift"] == "pocket force"  # the face bears nothing in the second half
    back = Summary.from_json(summary.to_json())
    assert back.text() == text
    summary.write(tmp_path)
    assert Summary.read(tmp_path / "summary.json").text() == text
    assert back.row("pocket_force_mean") == summary.row("pocket_force_mean")
    assert back["cage_slip_ratio"] == pytest.approx(0.02, abs=1e-6)
    assert [p.name for p in summary.write(tmp_path)] == ["summary.txt", "summary.json"]
    names = [row.label for row in summary]
    assert len(set(names)) == len(names), "tables without notes tell all rows apart"


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("{", "Expecting property name"),
        ("{}", "it has no figures"),
        ("[1]", "it is no table of figures"),
        ('{"Speeds": {"cage_speed": 1}}', "it is no table of figures"),
        ('{"Speeds": {"cage_speed": {}}}', "it is no table of figures"),
    ],
)
def test_a_summary_that_is_none_gets_a_sentence(tmp_path, text, words):
    path = tmp_path / "summary.json"
    path.write_text(text)
    with pytest.raises(InputError, match=f"summary.json' cannot be read: {words}.*; delete it"):
        Summary.read(path)


def test_a_summary_that_cannot_be_opened_is_not_to_be_deleted(tmp_path):
    path = tmp_path / "summary.json"
    path.mkdir()
    with pytest.raises(InputError, match=r"cannot be read \(.*\); make it a file that") as caught:
        Summary.read(path)
    assert "delete" not in str(caught.value)


def test_summary_sees_a_run_that_has_not_settled(known_run, bearing):
    ds = known_run.copy(deep=True)
    ds["cage_omega"][:, 0] *= np.linspace(1.0, 1.1, ds.sizes["time"])
    ds["pocket_force"][:, 7, 1] = 3.0
    assert summarise(SettledRun(ds, bearing))["drift"] == "cage speed"
    ds = ds.assign(cage_omega=known_run["cage_omega"])
    assert summarise(SettledRun(ds, bearing))["drift"] == "none"
    short = summarise(SettledRun(ds.isel(time=slice(500)), bearing))
    assert short["drift"] is None and short.row("cage_speed").margin is None
