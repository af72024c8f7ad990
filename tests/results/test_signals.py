"""Signals of sensors on a run whose motion is known in closed form."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest

from flexcage.core.errors import InputError
from flexcage.results.signals.figures import clipped, sensor_rows
from flexcage.results.signals.signals import signals_of
from flexcage.spec import Accelerometer, Laser, Proximity, Tacho, Torque

CAGE = SimpleNamespace(outside_diameter=89.3e-3, width=17e-3)
LINES = ("FTF", "2 BSF", "BPFO", "BPFI")
WHIRL = 0.98 * 2709.0909 * np.pi / 30.0  # rad/s, of 40 um about (10, -20) um


def of(run, *sensors, **options):
    return signals_of(run, sensors, cage=CAGE, **options)


def test_a_probe_sees_the_cage_along_its_own_azimuth(known_run):
    direction = np.radians(30.0)
    found = of(known_run, Proximity(name="p", place="cage", direction=direction))["p"]
    t = found["time"].values
    y, z = 10e-6 + 40e-6 * np.cos(WHIRL * t), -20e-6 + 40e-6 * np.sin(WHIRL * t)
    np.testing.assert_allclose(found, y * np.cos(direction) + z * np.sin(direction), atol=2e-10)
    assert found.attrs["units"] == "m" and found.attrs["direction"] == "30"


def test_a_laser_sees_a_round_cage_as_far_as_its_centre_goes(known_run):
    """R - sqrt(R^2 - z^2) less than a centred one: 0.04 um or so at 60 um aside."""
    found = of(known_run, Laser(name="l"), Proximity(name="p", place="cage"))
    np.testing.assert_allclose(found["l"], found["p"], atol=6e-8)
    aside = of(known_run, Laser(name="l", direction=np.pi / 2))["l"]
    t = aside["time"].values
    np.testing.assert_allclose(aside, -20e-6 + 40e-6 * np.sin(WHIRL * t), atol=6e-8)


def test_an_accelerometer_sees_the_outer_ring_at_the_vibration_rate(known_run):
    ds = known_run.copy()
    t = ds["time_hf"].values
    wave = np.sin(2 * np.pi * 3e3 * t)
    ds["outer_acceleration"] = ds["outer_acceleration"] + np.stack([3 * wave, 4 * wave], 1)
    found = of(ds, Accelerometer(name="a", direction=np.arctan2(4, 3)))["a"]
    assert found.attrs["rate"] == 200e3
    np.testing.assert_allclose(found, 5 * wave, atol=1e-6)


def test_torque_is_power_over_speed_and_a_tacho_counts_turns(known_run):
    """5 W at 628.3 rad/s; 100 turns a second."""
    found = of(known_run, Torque(name="t"), Tacho(name="k", pulses=2, rate=25e3))
    np.testing.assert_allclose(found["t"], 5.0 / (200.0 * np.pi), rtol=1e-6)
    rises = np.flatnonzero(np.diff(found["k"].values) > 0)
    assert np.diff(rises) / 25e3 == pytest.approx(1 / 200.0, abs=1 / 25e3) and len(rises) == 20
    assert set(np.unique(found["k"])) == {0.0, 1.0}


def test_signals_of_one_rate_share_their_time_and_others_have_their_own(known_run):
    one = of(known_run, Proximity(name="a"), Torque(name="b"), settle=0.3)
    assert one["a"].dims == one["b"].dims == ("time",)
    assert float(one["time"][0]) == pytest.approx(0.03, abs=2.1e-5)
    two = of(known_run, Proximity(name="a", rate=5e3), Accelerometer(name="b", rate=51.2e3))
    assert two["a"].dims == ("time_5000Hz",) and two["b"].dims == ("time_51200Hz",)
    step = np.diff(two["time_51200Hz"].values)
    np.testing.assert_allclose(step, 1 / 51.2e3, rtol=1e-9)


def test_noise_is_each_sensor_s_own_and_comes_again(known_run):
    noisy = {"noise": 1e-9, "place": "cage"}
    both = of(known_run, Proximity(name="a", **noisy), Proximity(name="b", **noisy))
    assert float(abs(both["a"] - both["b"]).max()) > 1e-8
    again = of(known_run, Proximity(name="b", **noisy))
    assert (again["b"].values == both["b"].values).all()
    other = of(known_run, Proximity(name="b", seed=1, **noisy))
    assert (other["b"].values != both["b"].values).any()


@pytest.mark.parametrize("rate", [25e3, 51.2e3])
def test_signal_to_noise_follows_the_density(known_run, rate):
    """A band's noise power is density^2 times its width; twice the density is four times the power,
    6.02 dB, whatever resonance and filters stand before it. A tone of 5 m/s^2 has 12.5."""
    ds, density, width = known_run.copy(), 0.01, 400.0
    tone = 5.0 * np.sin(2 * np.pi * 3e3 * ds["time_hf"].values)
    ds["outer_acceleration"] = ds["outer_acceleration"] + np.stack([tone, 0.0 * tone], 1)

    def measured(noise):
        chain = {"rate": rate, "resonance": 60e3, "damping_ratio": 0.1, "low_pass": 10e3}
        return of(ds, Accelerometer(name="a", noise=noise, **chain))["a"].values

    def power(x, low, high):
        lines, frequency = np.abs(np.fft.rfft(x)) ** 2, np.fft.rfftfreq(len(x), 1 / rate)
        return 2.0 * lines[(frequency >= low) & (frequency < high)].sum() / len(x) ** 2

    quiet = measured(0.0)
    one, two = measured(density) - quiet, measured(2 * density) - quiet
    assert np.mean(two**2) / np.mean(one**2) == pytest.approx(4.0, rel=1e-9)
    for low, high in ((0.0, 0.5 * rate), (2e3, 10e3), (4e3, 4e3 + 2 * width)):
        lines = (high - low) * len(one) / rate  # each an independent draw
        assert power(one, low, high) == pytest.approx(
            density**2 * (high - low), rel=4.0 / np.sqrt(lines)
        )
    band = (3e3 - width / 2, 3e3 + width / 2)
    to_noise = [10 * np.log10(power(quiet, *band) / power(x, *band)) for x in (one, two)]
    assert to_noise[0] - to_noise[1] == pytest.approx(6.02, abs=0.01)
    gain = 1.0 / np.hypot(1 - 0.05**2, 0.2 * 0.05) / np.sqrt(1 + 0.3**8)  # of the chain at 3 kHz
    wanted = 10 * np.log10(12.5 * gain**2 / (density**2 * width))
    assert to_noise[0] == pytest.approx(wanted, abs=10 * np.log10(1 + 4 / np.sqrt(40)))


def test_a_sensor_out_of_its_range_is_said(known_run):
    """y goes up to 50 um; above 45 um it is for acos(35/40)/pi of the time."""
    found = of(known_run, Proximity(name="p", place="cage", range=45e-6))
    (warning,) = clipped(found)
    share = np.arccos(35 / 40) / np.pi
    assert found["p"].attrs["clipped"] == pytest.approx(share, rel=0.1)
    assert "'p' stands at the end of its range of 4.5e-05 m in 16 %" in warning.text
    assert not list(clipped(of(known_run, Proximity(name="p", place="cage", range=55e-6))))


def test_severity_of_every_signal(known_run):
    ds = known_run.copy()
    t = ds["time_hf"].values
    since = t % (1.0 / 400.0)
    blows = np.exp(-since / 1e-4) * np.sin(2 * np.pi * 9e3 * since)
    ds["outer_acceleration"] = ds["outer_acceleration"] + blows[:, None]
    found = of(ds, Accelerometer(name="a", rate=50e3, noise=1e-4), Tacho(name="k"))
    lines = {"FTF": 44.0, "2 BSF": 900.0, "BPFO": 400.0, "BPFI": 1300.0}
    rows = {row.key: row for row in sensor_rows(found, lines)}
    assert rows["sensor_a_envelope_bpfo"].value > 20 * rows["sensor_a_envelope_floor"].value
    assert rows["sensor_a_envelope_bpfi"].value < 0.1 * rows["sensor_a_envelope_bpfo"].value
    assert rows["sensor_a_kurtosis"].value > 10.0
    assert rows["sensor_a_rms"].value == pytest.approx(float(found["a"].std()), rel=1e-9)
    assert rows["sensor_a_rms"].full_text.endswith("m/s^2")
    assert not [key for key in rows if key.startswith("sensor_k")]


def test_a_signal_of_few_samples_has_no_severity(known_run):
    short = known_run.isel(time=slice(40), time_hf=slice(160))
    slow, fine = Torque(name="t", rate=1e3, range=1.0), Accelerometer(name="a", noise=1.0)
    found = of(short, slow, fine, settle=0.3)
    assert {row.key.split("_")[1] for row in sensor_rows(found, {k: 99.0 for k in LINES})} == {"a"}


def test_no_sensors_and_a_cage_that_is_not_there(known_run):
    with pytest.raises(InputError, match=r"has no sensors; give \[\[sensors\]\]"):
        of(known_run)
    with pytest.raises(InputError, match="'p' is on the cage, and the run's bearing has none"):
        signals_of(known_run, [Proximity(name="p", place="cage")])
    with pytest.raises(InputError, match="holds 5 samples of what the sensor 'p' sees"):
        of(known_run.isel(time=slice(5)), Proximity(name="p"))
