"""Wear by Archard's law: constant force and sliding by hand, and work of friction in real runs."""

from dataclasses import replace

import numpy as np
import pytest
import xarray as xr

from flexcage.contacts.spec import LandSpec
from flexcage.core.errors import InputError
from flexcage.geometry.materials import MATERIALS
from flexcage.results.statistics import Windows
from flexcage.simulate import simulate
from flexcage.stress.wear import wear
from flexcage.stress.wear_laws import WEAR_LAWS, WearLaw, register_wear_law, wear_law
from flexcage.verification.runs import c7010
from flexcage.verification.runs import n1013 as n1013_case

Z, NT, SLICES, STEP = 22, 400, 16, 2e-5
CAGE_SPEED, SPIN, RISE, FORCE, MU = 280.0, -2900.0, 0.5, 12.0, 0.05  # rad/s, m/s, N
STILL = ("cage_position", "cage_velocity", "land_force", "inner_position", "inner_velocity")
LAW = WearLaw(material="brass", coefficient=2e-15)


def near(value, rel=1e-9):
    return pytest.approx(value, rel=rel, abs=0.0)


@pytest.fixture
def rolling(n1013):
    """Rollers that spin in the middle of their pockets and all move outwards against the cage,
    which turns; pocket 3's front, its rear and pocket 5's side +x are pressed all the time."""
    bearing, _ = n1013
    t, k = np.arange(NT) * STEP, np.arange(Z)
    angle, zero = CAGE_SPEED * t, np.zeros((NT, Z))
    radius = zero + bearing.pitch_radius
    azimuth = angle[:, None] + 2.0 * np.pi * k / Z
    position = np.stack([zero, radius, azimuth], axis=-1)
    velocity = np.stack([zero, zero + RISE, CAGE_SPEED * radius], axis=-1)
    omega = np.stack([zero + SPIN, zero, zero], axis=-1)
    attitude = np.stack([np.cos(angle / 2), np.sin(angle / 2), 0 * t, 0 * t], axis=1)
    force, slices = np.zeros((NT, Z, 4)), np.zeros((NT, Z, 2, SLICES))
    slices[:, 3] = FORCE / SLICES
    force[:, 3, :2], force[:, 5, 2] = FORCE, FORCE
    still, turning = np.zeros((NT, 3)), np.outer(np.ones(NT), [CAGE_SPEED, 0.0, 0.0])
    length = bearing.effective_length
    x = (np.arange(SLICES) + 0.5) * length / SLICES - 0.5 * length
    body, element = ("time", "axis"), ("time", "element", "cyl")
    return xr.Dataset(
        {
            "element_position": (element, position),
            "element_velocity": (element, velocity),
            "element_omega": (("time", "element", "spin_axis"), omega),
            "element_tilt": (("time", "element", "tilt"), np.zeros((NT, Z, 2))),
            "cage_quaternion": (("time", "quaternion"), attitude),
            "cage_omega": (body, turning),
            "pocket_force": (("time", "pocket", "face"), force),
            "pocket_friction": (("time", "pocket", "face"), MU * force),
            "pocket_slice_force": (("time", "pocket", "crossbeam_face", "slice"), slices),
            "pocket_slice_friction": (("time", "pocket", "crossbeam_face", "slice"), MU * slices),
            "work": (("time", "channel"), -power_by_hand() * MU * t[:, None]),
            "inner_speed": ("time", np.full(NT, 628.0)),
            **{name: (body, still.copy()) for name in STILL},
        },
        coords={
            "time": t, "pocket": k, "element": k, "face": ["front", "rear", "side+x", "side-x"],
            "slice": x, "axis": ["x", "y", "z"], "channel": ["pocket_friction"],
        },
        attrs={"family": "cylindrical_roller", "element": "roller"},
    )  # fmt: skip


def speeds_by_hand():
    """Sliding [m/s] at front and rear, where the spin moves the surface inwards or outwards."""
    spin = (SPIN - CAGE_SPEED) * 4e-3
    return abs(RISE - spin), abs(RISE + spin)


def end_speed(bearing, cage):
    from flexcage.bearings.cylindrical_roller.model import end_points

    y, z = end_points(bearing, cage).T
    spin = SPIN - CAGE_SPEED
    return np.hypot(RISE - spin * z, spin * y).mean()


def power_by_hand():
    from flexcage.case.presets import load_preset

    preset = load_preset("N1013")
    return FORCE * (sum(speeds_by_hand()) + end_speed(preset.bearing, preset.cage))


def worn(ds, parts, law=LAW, land=None, passes=40):
    windows = Windows(NT, np.arange(0, NT, NT // passes))
    return wear(ds, *parts, land or LandSpec(), law, windows)


def test_constant_force_and_sliding(rolling, n1013):
    found = worn(rolling, n1013)
    rate = found.dataset["volume_rate"]
    front, rear = speeds_by_hand()
    assert front > 13.0 > 12.5 > rear
    for face, speed in (("front", front), ("rear", rear)):
        value = float(rate.sel(pocket=3, face=face))
        assert value == near(LAW.coefficient * FORCE * speed)
    side = float(rate.sel(pocket=5, face="side+x"))
    assert side == near(LAW.coefficient * FORCE * end_speed(*n1013))
    assert int((rate > 0.0).sum()) == 3
    assert found.friction_check == near(1.0)
    assert float(found.dataset["margin"].sel(pocket=3, face="front")) < 1e-9 * float(rate.max())


def test_a_table_explains_that_it_has_no_intervals(rolling, n1013):
    table = worn(rolling, n1013, passes=2).table()
    assert "No interval (-)" in table and " - " in table and "nan" not in table
    assert "No interval" not in worn(rolling, n1013).table()


def test_depth_is_volume_over_the_track(rolling, n1013):
    """A roller that stays in place leaves a track as high as its Hertz contact (Johnson 4.43)."""
    bearing, cage = n1013
    found = worn(rolling, n1013)
    moduli = [
        (1 - m.poisson_ratio**2) / m.youngs_modulus for m in (bearing.material, cage.material)
    ]
    half = np.sqrt(4.0 * FORCE / 7.3e-3 * 4e-3 * sum(moduli) / np.pi)
    at = {"pocket": 3, "face": "front"}
    area = float(found.dataset["track_area"].sel(at))
    assert area == near(2.0 * half * 7.3e-3, rel=1e-3)
    volume, depth = (float(found.dataset[n].sel(at)) for n in ("volume_rate", "depth_rate"))
    assert depth == near(volume / area)
    # a minute later the groove is as round as the roller, and its section is that of the volume
    deep = float(found.depth(1.0 / 60.0).sel(at))
    section = 2.0 * half * deep + 4.0 / 3.0 * np.sqrt(2.0 * 4e-3) * deep**1.5
    assert section == near(60.0 * volume / 7.3e-3, rel=1e-6)
    assert deep < 60.0 * depth


def test_a_track_is_as_high_as_the_roller_wanders(rolling, n1013):
    swing = 1e-4 * np.sin(2.0 * np.pi * np.arange(NT) / 100)
    rolling["element_position"][:, :, 1] += swing[:, None]
    rolling["element_velocity"][:, :, 2] += CAGE_SPEED * swing[:, None]
    area = worn(rolling, n1013).dataset["track_area"].sel(pocket=3, face="rear")
    steady = np.sqrt(12.0) * 1e-4 / np.sqrt(2.0)
    assert float(area) / 7.3e-3 == near(steady, rel=0.15)


def test_wear_scales_with_the_coefficient(rolling, n1013):
    twice = replace(LAW, coefficient=2.0 * LAW.coefficient)
    one, other = worn(rolling, n1013), worn(rolling, n1013, twice)
    assert other.volume_rate == near(2.0 * one.volume_rate)
    assert other.depth_rate == near(2.0 * one.depth_rate)
    assert "k = 2e-06 mm^3/(N m)" in one.table() and one.table().count("front") == 1
    assert "no cage has" in one.table(1e9) and "no cage has" not in one.table(1e-9)


def test_a_land_that_slides(rolling, n1013):
    """A cage pressed on its inner land by 3 N, its centre 10 um off: the rings pass at R dw."""
    rolling["land_force"][:, 1] = -3.0
    rolling["cage_position"][:, 1] = 1e-5
    _, cage = n1013
    inner = replace(cage, guidance="inner")
    speed = 0.5 * inner.bore * (628.0 - CAGE_SPEED)
    dry = worn(rolling, (n1013[0], inner)).dataset
    assert float(dry["land_volume_rate"]) == near(LAW.coefficient * 3.0 * speed)
    area = 2.0 * np.pi * inner.bore * 3.5e-3
    assert float(dry["land_depth_rate"]) == near(LAW.coefficient * 3.0 * speed / area)
    film = worn(rolling, (n1013[0], inner), land=LandSpec(kind="film")).dataset
    assert np.isnan(float(film["land_volume_rate"]))


def test_sliding_of_rollers_explains_the_work_of_friction():
    """What friction takes at the speeds of wear is what the solver integrated."""
    fine = {"solver.duration": "4 ms", "output.rate": "200 kHz", "cage.model": "rigid",
            "solver.tolerance": "0.001 um"}  # fmt: skip
    assert simulate(n1013_case(fine)).wear().friction_check == near(1.0, rel=0.01)


@pytest.mark.parametrize("shape", ["cylindrical", "spherical"])
def test_sliding_of_balls_explains_the_work_of_friction(shape):
    run = simulate(
        c7010(
            {"cage.pocket_shape": shape, "drive.speed": "4000 rpm", "load.radial": "60 N"},
            {"solver.duration": "6 ms", "start.push": "50 mm/s"},
            {"output.rate": "200 kHz", "output.vibration_rate": "200 kHz"},
        )
    )
    found = run.wear(WearLaw(material="polyimide", coefficient=1e-15))
    assert found.friction_check == near(1.0, rel=0.01)
    assert found.dataset["volume_rate"].dims == ("pocket", "face") and found.depth_rate > 0.0
    with pytest.raises(InputError, match="No published wear coefficient of polyimide"):
        run.wear()


def test_laws_have_sources():
    assert all(law.source for law in WEAR_LAWS.values()) and set(WEAR_LAWS) <= set(MATERIALS)
    with pytest.raises(InputError, match="No published wear coefficient of PEEK"):
        wear_law("PEEK")
    with pytest.raises(InputError, match="no source"):
        register_wear_law(WearLaw(material="my", coefficient=1e-15))
