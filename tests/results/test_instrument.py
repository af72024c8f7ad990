"""The virtual lasers: an inversion that gives the cage back, noise, real files.

Known readings are in ``flexcage verify laser_inversion``.
"""

from __future__ import annotations

import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

from flexcage.core.errors import InputError
from flexcage.results.instrument import (
    LaserSetup,
    by_tilt_angles,
    invert,
    mark_of_run,
    measured,
    of_run,
    readings,
    run_out,
    sample_times,
)
from flexcage.results.rig_file import load_readings, load_times
from flexcage.results.rim import Rim

SETUP = LaserSetup(radius=33e-3, half_width=16e-3, plane=15e-3, circle=31e-3)


def tilted(about_z, about_y=0.0):
    """Unit axis (1, 3) with slopes tan(about_z) in x-y and tan(about_y) in x-z."""
    axis = np.array([[1.0, np.tan(about_z), np.tan(about_y)]])
    return axis / np.linalg.norm(axis)


def test_the_inversion_gives_any_cage_back():
    rng = np.random.default_rng(4)
    centre = 0.3e-3 * rng.standard_normal((200, 3))
    axis = np.column_stack([np.ones(200), 0.004 * rng.standard_normal((200, 2))])
    axis /= np.linalg.norm(axis, axis=1, keepdims=True)
    found, direction = invert(readings(centre, axis, SETUP), SETUP)
    np.testing.assert_allclose(found, centre, atol=1e-10)
    np.testing.assert_allclose(direction, axis, atol=1e-13)


def test_noise_resolution_and_reach():
    centre, axis = np.zeros((4000, 3)), np.tile([1.0, 0.0, 0.0], (4000, 1))
    noisy = LaserSetup(radius=33e-3, half_width=16e-3, plane=15e-3, circle=31e-3,
                       repeatability=0.02e-6, resolution=0.01e-6, reach=3e-3)  # fmt: skip
    out = readings(centre, axis, noisy, seed=1)
    assert out.std() == pytest.approx(0.02e-6, rel=0.05)
    np.testing.assert_allclose(out / 0.01e-6, np.round(out / 0.01e-6), atol=1e-6)
    centre[:, 1] = 4e-3
    assert np.isnan(readings(centre, axis, noisy)[:, 0]).all()


def test_sensors_that_look_past_the_cage_are_refused():
    with pytest.raises(InputError, match="look past the cage: their plane is 15 mm.*ends at 10 mm"):
        LaserSetup(radius=33e-3, half_width=10e-3, plane=15e-3, circle=31e-3)
    with pytest.raises(InputError, match="stand on a radius of 34 mm.*ends at 33 mm"):
        LaserSetup(radius=33e-3, half_width=16e-3, plane=15e-3, circle=34e-3)


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"radius": 33.0}, r"radius is 33.0, but should be a length in metres; is 33 mm meant\?"),
        ({"radius": "33 mm"}, "radius is '33 mm', but should be a number in SI"),
        ({"circle": 0.0}, "circle is 0.0, but should be greater than 0"),
        ({"plane": np.nan}, "plane is nan, but should be a number"),
        ({"resolution": -1e-8}, "resolution is -1e-08, but should be a number in SI that is not"),
        ({"rate": 0.0}, "rate is 0.0, but should be greater than 0"),
        ({"angles": (0, 120, 240)}, "angles is .0, 120, 240., but should be in radians"),
        ({"angles": (0.0, 0.0, 3.0)}, "should be apart, so that the sensors tell every tilt"),
        ({"angles": (0.0, 2.0)}, "should be three numbers in radians"),
        ({"spot": -1e-3}, "spot is -0.001, but should be a number in SI that is not negative"),
        ({"spot": 40e-3}, "spot of the radial sensors is 40 mm wide, more than .* radius of 33 mm"),
        ({"rim": 80e-6}, "rim is '8e-05', but should be a flexcage.spec.Rim"),
        ({"rim": Rim(lobes=50, amplitude=80e-6)}, "has 50 lobes of 0.08 mm, which are steep"),
    ],
)
def test_a_setup_in_other_units_or_without_a_plane_is_refused(wrong, words):
    """Sensors of which two stand in one place left a singular matrix."""
    usual = {"radius": 33e-3, "half_width": 16e-3, "plane": 15e-3, "circle": 31e-3}
    with pytest.raises(InputError, match=words):
        LaserSetup(**{**usual, **wrong})


@pytest.mark.parametrize("of", [invert, by_tilt_angles])
def test_readings_of_another_shape_or_unit_are_refused(of):
    values = readings(np.array([[0.0, 0.1e-3, 0.0]]), tilted(1e-3), SETUP)
    for wrong, words in (
        (1e3 * values, "go up to 0.1.* m, but no cage moves farther"),
        (values[:, :4], r"are of shape \(1, 4\).* should be numbers \(n, 5\), in the order Y, Z"),
        (values[0], r"are of shape \(5,\)"),
        (values.astype(str), "<U"),
    ):
        with pytest.raises(InputError, match=words):
            of(wrong, SETUP)
    lost = np.vstack([values, np.full(5, np.nan)])  # beyond the sensors' reach
    one, two = (np.asarray(of(v, SETUP)[0]).ravel() for v in (values, lost))
    np.testing.assert_allclose(one, two[: len(one)], atol=1e-12)


def test_a_face_that_runs_out_turns_with_the_cage():
    """A cage that only turns, at 10 Hz: each axial reading is a sine of half of the run-out."""
    t = np.arange(1000) / 1e4
    half = 10.0 * np.pi * t
    zero = np.zeros_like(t)
    turned = np.column_stack([np.cos(half), np.sin(half), zero, zero])
    ds = xr.Dataset({"cage_quaternion": (("time", "quaternion"), turned)})
    face = run_out(ds, total=20e-6, circle=31e-3)
    centre, axis = np.zeros((1000, 3)), np.tile([1.0, 0.0, 0.0], (1000, 1))
    out = readings(centre, axis, SETUP, face=face)
    angle = 20.0 * np.pi * t[:, None] - np.array(SETUP.angles)
    np.testing.assert_allclose(out[:, 2:], -10e-6 * np.cos(angle), atol=1e-12)
    assert np.abs(out[:, :2]).max() < 1e-15


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"lobes": 1}, "lobes is 1, but should be a whole number from 2 on; one lobe is an eccen"),
        ({"lobes": 2.5}, "lobes is 2.5, but should be a whole number"),
        ({"amplitude": 80.0}, "amplitude is 80.0, but should be a length in metres"),
        ({"amplitude": "80 um"}, "amplitude is '80 um', but should be a length in metres"),
        ({"eccentricity": -1e-6}, "eccentricity is -1e-06, but should be a length in metres"),
        ({"phase": 90.0}, "phase is 90.0, but should be in radians"),
    ],
)
def test_a_rim_in_other_units_is_refused(wrong, words):
    with pytest.raises(InputError, match=words):
        Rim(**wrong)


def spinning(angle):
    """Marks (n, 3) of a cage that has turned by these angles about x."""
    return np.column_stack([np.zeros_like(angle), np.cos(angle), np.sin(angle)])


TURN = 2.0 * np.pi * np.arange(360) / 360.0  # one turn of a cage
STILL = np.zeros((360, 3)), np.tile([1.0, 0.0, 0.0], (360, 1))  # centred, square


@pytest.mark.parametrize("lobes", [2, 3, 5])
def test_lobes_show_at_their_number_times_the_cages_frequency(lobes):
    """A centred cage that turns: each laser shows a cos(n (angle under it - phase))."""
    rim = Rim(lobes=lobes, amplitude=50e-6, phase=0.4)
    out = readings(*STILL, replace(SETUP, rim=rim), mark=spinning(TURN))
    for k, laser in enumerate((0.0, 0.5 * np.pi)):  # azimuth that it looks along
        expected = 50e-6 * np.cos(lobes * (laser - TURN - 0.4))
        np.testing.assert_allclose(out[:, k], expected, atol=1e-12)
        lines = np.abs(np.fft.rfft(out[:, k])) / 180.0
        assert lines[lobes] == pytest.approx(50e-6)
        assert np.delete(lines, lobes).max() < 1e-12
    assert np.abs(out[:, 2:]).max() < 1e-15


def test_two_lobes_widen_the_radius_of_a_circle():
    """Y = r cos s + a cos 2s and Z = r sin s - a cos 2s of a centre that goes round with the cage:
    their radius is r + sqrt(2) a cos 2s cos(s + 45 deg) to first order, off by 2 a^2/r at most."""
    r, a = 250e-6, 5e-6
    centre = r * spinning(TURN)
    setup = replace(SETUP, rim=Rim(lobes=2, amplitude=a))
    out = readings(centre, STILL[1], setup, mark=spinning(TURN))
    away = np.hypot(out[:, 0], out[:, 1])
    expected = r + np.sqrt(2.0) * a * np.cos(2.0 * TURN) * np.cos(TURN + 0.25 * np.pi)
    bent = r**2 / (2.0 * SETUP.radius)  # a laser that sees a round cage beside its top
    np.testing.assert_allclose(away, expected, atol=2.0 * a**2 / r + 2.0 * bent)
    assert np.ptp(away) > 2.0 * np.ptp(np.hypot(*readings(centre, STILL[1], SETUP)[:, :2].T))


def test_an_eccentric_rim_goes_round_with_the_cage():
    """It is the centre that the lasers and their inversion find."""
    setup = replace(SETUP, rim=Rim(eccentricity=30e-6, eccentricity_phase=0.7))
    out = readings(*STILL, setup, mark=spinning(TURN))
    rim = 30e-6 * spinning(TURN + 0.7)
    np.testing.assert_allclose(invert(out, setup)[0], rim, atol=1e-12)
    np.testing.assert_allclose(out[:, :2], rim[:, 1:], atol=(30e-6) ** 2 / SETUP.radius)


@pytest.mark.parametrize("lobes", [2, 12, 30])
def test_a_spot_takes_the_mean_of_lobes(lobes):
    """Over a width w on a radius R lobes are shown by sin(s)/s of their height, s = n w/2R."""
    spot, amplitude = 2e-3, 10e-6
    setup = replace(SETUP, rim=Rim(lobes=lobes, amplitude=amplitude), spot=spot)
    out = readings(*STILL, setup, mark=spinning(TURN))
    s = 0.5 * lobes * spot / SETUP.radius
    share = np.abs(np.fft.rfft(out[:, 0]))[lobes] / 180.0 / amplitude
    assert share == pytest.approx(np.sin(s) / s, rel=1e-3)  # chord for arc: w^2/24R^2
    assert np.abs(readings(*STILL, replace(SETUP, spot=spot))).max() < 1e-15
    moved = np.array([[0.0, 0.1e-3, 0.0]])
    shown = readings(moved, STILL[1][:1], replace(SETUP, spot=spot))
    assert shown[0, 0] == pytest.approx(0.1e-3, rel=1e-9)


def test_a_tilt_adds_the_same_to_a_rim_that_is_not_round():
    """The deflection error plane * tan(tilt) stays beside a lobe of 20 um."""
    axis = np.repeat(tilted(1e-3), 360, axis=0)
    aside = np.cross(axis, np.array([0.0, 0.0, 1.0]))
    across = np.cross(aside, axis)
    unit = [v / np.linalg.norm(v, axis=1, keepdims=True) for v in (-aside, across)]
    mark = np.cos(TURN)[:, None] * unit[0] + np.sin(TURN)[:, None] * unit[1]
    rim = Rim(lobes=3, amplitude=20e-6)
    out = readings(STILL[0], axis, replace(SETUP, rim=rim), mark=mark)
    plain = readings(STILL[0], axis, SETUP)
    np.testing.assert_allclose(plain[:, 0], 15e-6 + 0.5e-6 * 33e-3, atol=1e-9)
    np.testing.assert_allclose(out[:, 0] - plain[:, 0], 20e-6 * np.cos(3.0 * TURN), atol=2e-9)


def test_a_rim_that_is_not_round_needs_the_cages_turn():
    setup = replace(SETUP, rim=Rim(amplitude=20e-6))
    with pytest.raises(InputError, match="give mark, the direction of pocket 0"):
        readings(*STILL, setup)


def test_a_run_shows_its_lobes_at_any_rate():
    """A run's cage that spins at 10 Hz: the same lobes at its samples and at 7 kHz."""
    t = np.arange(10_001) / 1e5
    zero = np.zeros_like(t)
    half = 10.0 * np.pi * t
    at = (("time", "axis"), np.zeros((10_001, 3)))
    turned = (("time", "quaternion"), np.column_stack([np.cos(half), np.sin(half), zero, zero]))
    ds = xr.Dataset({"cage_position": at, "outer_position": at, "cage_quaternion": turned},
                    coords={"time": t})  # fmt: skip
    rim = Rim(lobes=2, amplitude=40e-6)
    for rate in (None, 7e3):
        setup = replace(SETUP, rim=rim, rate=rate)
        angle = 20.0 * np.pi * sample_times(ds, rate=rate)
        np.testing.assert_allclose(mark_of_run(ds, rate=rate), spinning(angle), atol=1e-7)
        shown = measured(ds, setup)[:, 0]
        np.testing.assert_allclose(shown, 40e-6 * np.cos(2.0 * angle), atol=1e-10)


def test_readings_of_a_rig(tmp_path):
    file = tmp_path / "rig.csv"
    file.write_text("X1,Y,Z,X2,X3\n1,2,3,4,5\n0,0,0,0,0\n")
    np.testing.assert_allclose(load_readings(file)[0], [2e-3, 3e-3, 1e-3, 4e-3, 5e-3])
    file.write_text("X1,Y,Z,X2\n1,2,3,4\n")
    with pytest.raises(InputError, match="no column 'X3'"):
        load_readings(file)
    file.write_text("X1,Y,Z,X2,X3\n1,2,3,4,five\n")
    with pytest.raises(InputError, match="what is no number"):
        load_readings(file)
    with pytest.raises(InputError, match="cannot be read"):
        load_readings(tmp_path / "none.csv")
    file.write_text("X1,Y,Z,X2,X3\n1,2,3,4\n")
    with pytest.raises(InputError, match="name 5 columns, but their line 2 holds 4"):
        load_readings(file)
    file.write_text("X1,Y,Z,X2,X3\n")
    with pytest.raises(InputError, match="hold 0 numbers"):
        load_readings(file)


@pytest.mark.parametrize(
    ("text", "coding", "words"),
    [
        ("Y;Z;X1;X2;X3\n0,1;0,2;0,3;0,4;0,5\n", "utf-8", "have ';' between their columns; write"),
        ("Y\tZ\tX1\tX2\tX3\n1\t2\t3\t4\t5\n", "utf-8", "have tabs between their columns"),
        ("Y,Z,X1,X2,X3\n0,1,0,2,0,3,0,4,0,5\n", "utf-8", "line 2 holds 10 numbers; write one"),
        ("Y,Z,X1,X2,X3\n1,2,3,4,5\n\n1,,3,4,5\n", "utf-8", "'' in line 4, column 'Z'; leave out"),
        ("Y,Z,X1,X2,X3\n1,2,nan,4,5\n", "utf-8", "'nan' in line 2, column 'X1'"),
        ("Y,Z,X1,X2,X3\n1,2,3,4,5\n", "utf-16", "is text in UTF-16; readings are text in UTF-8"),
        ("Y,Z,X1,X2,X3,Y\n1,2,3,4,5,6\n", "utf-8", "have 2 columns 'Y'; leave one"),
        ("Y,Z,X1,X2,X3\n1,2,3,-150,5\n", "utf-8", "go up to 150 mm.*write mm, as 0.15 for 150 um"),
        ("Y,Z,X1,X2,X3\n1e-4,2e-4,0,0,0\n", "utf-8", "stay within 0.0002 mm, less than any laser"),
        ("Y,Z,X1,X2,X3,Größe\n1,2,3,4,5,6\n", "latin-1", "line 1 has a character of another enc"),
    ],
)  # fmt: skip
def test_readings_that_another_program_wrote(tmp_path, text, coding, words):
    file = tmp_path / "rig.csv"
    file.write_bytes(text.encode(coding))
    with pytest.raises(InputError, match=words) as caught:
        load_readings(file)
    assert str(caught.value).endswith(".") and not str(caught.value).endswith("..")


def test_times_of_a_rig(tmp_path):
    """A column t in seconds, which the readings pass over."""
    file = tmp_path / "rig.csv"
    file.write_text("t,Y,Z,X1,X2,X3\n0,1,2,3,4,5\n1e-4,0,0,0,0,0\n\n")
    np.testing.assert_array_equal(load_times(file), [0.0, 1e-4])
    np.testing.assert_allclose(load_readings(file)[0], [1e-3, 2e-3, 3e-3, 4e-3, 5e-3])
    file.write_text("Y,Z,X1,X2,X3\n1,2,3,4,5\n")
    assert load_times(file) is None
    for name in ("t [ms]", "Time", "time_s", "Zeit (s)", "seconds"):
        file.write_text(f"{name},Y,Z,X1,X2,X3\n0,1,2,3,4,5\n")
        with pytest.raises(InputError, match=re.escape(f"column '{name}'; name it t, and give se")):
            load_times(file)
    file.write_text("T,Y,Z,X1,X2,X3\n70,1,2,3,4,5\n")  # a temperature
    assert load_times(file) is None
    file.write_text("t,Y,Z,X1,X2,X3\n0,1,2,3,4,5\n0.1,0,0,0,0,0\n0.1,0,0,0,0,0\n")
    with pytest.raises(InputError, match="do not rise: reading 3 is at 0.1 s, after 0.1 s"):
        load_times(file)


def turning_cage():
    """A cage that goes round by 0.1 mm at 10 Hz with a tilt of 2 mrad, 100 kHz for 0.1 s."""
    t = np.arange(10_001) / 1e5
    phase = 20.0 * np.pi * t
    zero = np.zeros_like(t)
    place = 1e-4 * np.column_stack([zero, np.cos(phase), np.sin(phase)])
    tilt = np.column_stack([np.ones_like(t), zero, 1e-3 * np.cos(phase), 1e-3 * np.sin(phase)])
    return xr.Dataset(
        {
            "cage_position": (("time", "axis"), place),
            "outer_position": (("time", "axis"), 0.0 * place),
            "cage_quaternion": (("time", "quaternion"), tilt),
        },
        coords={"time": t},
    )


def test_a_run_at_the_lasers_rate():
    """Between samples on the circle, as far as a chord leaves it: r (pi f/rate)^2/2."""
    ds = turning_cage()
    t = sample_times(ds, rate=7e3)
    assert len(t) == 701 and t[1] == pytest.approx(1 / 7e3) and t[-1] == pytest.approx(0.1)
    centre, axis = of_run(ds, rate=7e3)
    phase = 20.0 * np.pi * t
    circle = 1e-4 * np.column_stack([0.0 * t, np.cos(phase), np.sin(phase)])
    np.testing.assert_allclose(centre, circle, atol=1e-4 * (np.pi * 10 / 1e5) ** 2)
    np.testing.assert_allclose(np.linalg.norm(axis, axis=1), 1.0, atol=1e-14)
    slow = LaserSetup(radius=33e-3, half_width=16e-3, plane=15e-3, circle=31e-3, rate=7e3)
    np.testing.assert_allclose(invert(measured(ds, slow), slow)[0], centre, atol=1e-10)
    assert len(measured(ds, SETUP)) == 10_001
    with pytest.raises(InputError, match="5 Hz.*fewer than two samples"):
        of_run(ds, rate=5.0)


def test_the_example_of_the_page_on_results(tmp_path, monkeypatch):
    """As printed, on a file of a cage with a known centre."""
    page = Path(__file__).parents[2] / "examples" / "results.md"
    section = page.read_text("utf-8").split("## Measured by lasers")[1].split("\n## ")[0]
    code = re.findall(r"```python\n(.*?)```", section, flags=re.S)[0]
    shown = readings(np.array([[0.0, 0.1e-3, 0.0]] * 3), np.repeat(tilted(0.003), 3, axis=0), SETUP)
    lines = [",".join(f"{1e3 * v:.12g}" for v in row) for row in shown]
    (tmp_path / "rig.csv").write_text("\n".join(["Y,Z,X1,X2,X3", *lines]))
    monkeypatch.chdir(tmp_path)
    names: dict[str, np.ndarray] = {}
    exec(code, names)
    np.testing.assert_allclose(names["centre"][:, 1], 0.1e-3, atol=1e-12)
    np.testing.assert_allclose(names["by_paper"][:, 0], 0.1e-3, atol=1e-12)
