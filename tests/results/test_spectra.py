"""Spectra of signals whose power and lines are known, and the frequencies of known bearings."""

from __future__ import annotations

import re
from math import radians
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest
import xarray as xr

from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.results import metrics, spectra
from flexcage.results.features import cage_motion_features
from flexcage.results.slip import BearingNumbers
from flexcage.results.spectra import (
    SIGNALS,
    amplitude_spectrum,
    bearing_frequencies,
    envelope,
    envelope_spectrum,
    own_frequencies,
    resolves,
    run_frequencies,
    run_resolution,
    spectral_density,
    vibration_figures,
)
from flexcage.verification.cases.kinematics import TABLE

RPM = np.pi / 30.0
RATE = 20e3


def signal(values: np.ndarray, unit: str = "m") -> xr.DataArray:
    t = np.arange(len(values)) / RATE
    return xr.DataArray(values, dims=("time",), coords={"time": t}, attrs={"units": unit})


def numbers_of(preset: str) -> BearingNumbers:
    b = load_preset(preset).bearing
    return BearingNumbers(
        pitch_diameter=b.pitch_diameter, element_diameter=b.element_diameter,
        element_count=b.element_count, contact_angle=b.nominal_contact_angle,
    )  # fmt: skip


def small(diameter: float, pitch: float, count: int, angle: float = 0.0) -> BearingNumbers:
    return BearingNumbers(
        pitch_diameter=pitch * 1e-3, element_diameter=diameter * 1e-3, element_count=count,
        contact_angle=radians(angle),
    )  # fmt: skip


@pytest.mark.parametrize(
    ("bearing", "name", "sense"),
    [
        (numbers_of("N1013"), "N1013", 1),
        (numbers_of("7010C-PI"), "7010C at 4000", 1),
        (numbers_of("7010C-PI"), "7010C at 10000", -1),
        (small(6.47, 26.0, 7), "6203", 1),
        (small(5.55, 42.4, 17, 60.0), "7603025", 1),
    ],
    ids=["N1013", "7010C", "7010C backwards", "6203", "thrust"],
)
def test_frequencies_of_known_bearings(bearing, name, sense):
    """To all digits of the table of `flexcage verify kinematics`."""
    *_, rpm, cage, _, outer, inner, element = TABLE[name]
    lines = bearing_frequencies(bearing, sense * rpm * RPM)
    assert list(lines) == ["FTF", "shaft", "BSF", "2 BSF", "BPFO", "BPFI"]
    assert 60.0 * lines["FTF"] == pytest.approx(cage, abs=6e-5)
    assert lines["shaft"] == pytest.approx(abs(rpm) / 60.0)
    assert lines["BPFO"] == pytest.approx(outer, abs=6e-5)
    assert lines["BPFI"] == pytest.approx(inner, abs=6e-5)
    assert lines["BSF"] == pytest.approx(element, abs=6e-5)
    assert lines["2 BSF"] == 2.0 * lines["BSF"]


def test_an_outer_ring_that_turns_along_lets_nothing_pass():
    lines = bearing_frequencies(numbers_of("N1013"), 100.0, 100.0)
    assert lines["FTF"] == pytest.approx(lines["shaft"])
    assert [lines[name] for name in ("BPFO", "BPFI", "BSF")] == pytest.approx([0.0] * 3, abs=1e-12)


def record(values=None, time=None, dim="time", coords=True):
    t = np.arange(400) / RATE if time is None else time
    values = np.sin(2000.0 * np.arange(len(t)) / RATE) if values is None else values
    return xr.DataArray(values, dims=(dim,), coords={dim: t} if coords else None)


def uneven(change):
    t = np.arange(400) / RATE
    return record(time=change(t))


WRONG = {
    "rows lost": (lambda: uneven(lambda t: np.delete(t, slice(100, 120))), "not sampled evenly"),
    "one row lost": (lambda: uneven(lambda t: np.delete(t, 200)), "0.0001 s lie between.*5e-05 s"),
    "random": (lambda: uneven(lambda t: np.sort(t[-1] * np.random.default_rng(0).random(400))),
               "not sampled evenly"),
    "backwards": (lambda: uneven(lambda t: t[::-1]), "does not rise from sample to sample"),
    "no instants": (lambda: record(coords=False), "give it the coordinate 'time' in seconds"),
    "dates": (lambda: uneven(lambda t: (1e9 * t).astype("datetime64[ns]")), "of datetime64"),
    "a lost value": (lambda: record(np.where(np.arange(400) == 7, np.nan, 1.0)),
                     "no number at 1 of its 400 instants, the first at 0.00035 s"),
    "complex": (lambda: record(np.ones(400) + 1j), "holds complex128 values"),
    "array": (lambda: np.ones(400), "needs an xarray.DataArray.*type ndarray"),
    "other name": (lambda: record(dim="t"), "needs a time dimension"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG)
@pytest.mark.parametrize(
    "of",
    [
        amplitude_spectrum,
        spectral_density,
        lambda s: envelope(s, (2e3, 8e3)),
        lambda s: vibration_figures(s, {}, (2e3, 8e3)),
    ],
)
def test_a_record_of_which_no_spectrum_can_be_is_refused(name, of):
    """Rows that a logger lost shift every line, and in silence."""
    make, words = WRONG[name]
    with pytest.raises(InputError, match=words):
        of(make())


def test_a_clock_that_jitters_is_taken():
    t = np.arange(400) / RATE + 5e-6 * np.random.default_rng(1).uniform(-1.0, 1.0, 400)
    assert float(amplitude_spectrum(record(time=t)).max()) == pytest.approx(1.0, abs=0.2)


def test_frequencies_of_a_bearing_itself():
    bearing = load_preset("N1013").bearing
    assert bearing_frequencies(bearing, 600.0) == bearing_frequencies(numbers_of("N1013"), 600.0)


def test_parseval():
    """Without a window, power over frequency is the variance, to rounding."""
    x = signal(np.random.default_rng(1).normal(3.0, 2.0, 5001))
    density = spectral_density(x, window="boxcar")
    assert density.attrs["segments"] == 1 and density.attrs["units"] == "(m)^2/Hz"
    total = float(density.sum()) * density.attrs["resolution"]
    assert total == pytest.approx(float(x.values.var()), rel=1e-12)


def test_the_level_of_white_noise():
    """Of standard deviation 2 at 20 kHz: 4/10 kHz at every frequency, on average."""
    x = signal(np.random.default_rng(2).normal(0.0, 2.0, 200_000))
    density = spectral_density(x, resolution=100.0)
    assert (density.attrs["segments"], density.attrs["resolution"]) == (1999, 100.0)
    inner = density.sel(frequency=slice(500, 9500))
    assert float(inner.mean()) == pytest.approx(4.0 / 10e3, rel=0.01)
    assert float(inner.std()) < 0.05 * float(inner.mean())


@pytest.mark.parametrize("frequency", [440.0, 443.7])
@pytest.mark.parametrize("resolution", [None, 10.0])
def test_a_sine_has_its_power_at_its_frequency(frequency, resolution):
    """Amplitude 3 in two bins on either side, wherever it lies between bins."""
    t = np.arange(10_000) / RATE
    density = spectral_density(
        signal(7.0 + 3.0 * np.sin(2 * np.pi * frequency * t)), resolution=resolution
    )
    step = density.attrs["resolution"]
    assert float(density.idxmax("frequency")) == pytest.approx(frequency, abs=0.5 * step + 1e-9)
    line = density.sel(frequency=slice(frequency - 3 * step, frequency + 3 * step))
    assert np.sqrt(2.0 * float(line.sum()) * step) == pytest.approx(3.0, rel=2e-3)


def test_the_envelope_of_a_swelling_tone():
    """3 (1 + cos/2) times a tone in the band, beside a loud one below it and one above."""
    t = np.arange(20_000) / RATE
    swell = 3.0 * (1.0 + 0.5 * np.cos(2 * np.pi * 90 * t))
    others = 40.0 * np.sin(2 * np.pi * 50 * t) + 9.0 * np.sin(2 * np.pi * 9e3 * t)
    x = signal(swell * np.sin(2 * np.pi * 4e3 * t) + others, "m/s^2")
    found = envelope(x, (2e3, 6e3))
    assert found.attrs["units"] == "m/s^2"
    inside = slice(2000, -2000)  # a filter does not know what was before
    np.testing.assert_allclose(found.values[inside], swell[inside], rtol=0.02)
    assert float(spectral_density(found).idxmax("frequency")) == pytest.approx(90.0, abs=0.5)
    pair = xr.concat([x, 2.0 * x], "axis2").transpose("time", "axis2")
    both = envelope(pair, (2e3, 6e3))
    assert both.dims == ("time", "axis2")
    np.testing.assert_allclose(both.isel(axis2=1), 2.0 * found, rtol=1e-9)


def blows(rate: float, count: int = 40_000) -> np.ndarray:
    """Bursts of a 4 kHz ringing, ``rate`` of them a second."""
    since = (np.arange(count) / RATE) % (1.0 / rate)
    return np.exp(-since / 1e-3) * np.sin(2 * np.pi * 4e3 * since)


def test_blows_are_lines_of_the_envelopes_spectrum():
    """The ringing hides them in the signal's own spectrum; of a swelling tone a line reads what it
    swells by."""
    x = signal(blows(107.0), "m/s^2")
    found = envelope_spectrum(x, (2e3, 8e3))
    assert found.attrs["units"] == "m/s^2" and found.dims == ("frequency",)
    for multiple in (1, 2, 3):
        near = found.sel(frequency=slice(107.0 * multiple - 40, 107.0 * multiple + 40))
        assert float(near.idxmax("frequency")) == pytest.approx(107.0 * multiple, abs=0.5)
    own = amplitude_spectrum(x).sel(frequency=slice(60.0, 150.0))
    assert float(own.max()) < 0.1 * float(found.sel(frequency=slice(60.0, 150.0)).max())
    t = np.arange(40_000) / RATE
    tone = signal(3.0 * (1.0 + 0.5 * np.cos(2 * np.pi * 90 * t)) * np.sin(2 * np.pi * 4e3 * t))
    line = envelope_spectrum(tone, (2e3, 6e3)).sel(frequency=90.0, method="nearest")
    assert float(line) == pytest.approx(1.5, rel=0.01)


def test_figures_of_vibrations():
    t = np.arange(40_000) / RATE
    lines = {"BPFO": 107.0, "BPFI": 163.0, "FTF": 0.6}
    sine = vibration_figures(signal(7.0 + 2.0 * np.sin(2 * np.pi * 500 * t)), lines, (2e3, 8e3))
    assert sine["rms"] == pytest.approx(np.sqrt(2.0)) and sine["crest"] == pytest.approx(np.sqrt(2))
    assert sine["kurtosis"] == pytest.approx(1.5)
    noise = np.random.default_rng(1).normal(size=len(t))
    quiet = vibration_figures(signal(0.05 * noise), lines, (2e3, 8e3))
    assert quiet["kurtosis"] == pytest.approx(3.0, abs=0.1)
    struck = vibration_figures(signal(blows(107.0) + 0.05 * noise), lines, (2e3, 8e3))
    assert struck["kurtosis"] > 6.0 and struck["crest"] > quiet["crest"]
    assert struck["envelope at BPFO"] > 10.0 * struck["envelope at BPFI"]
    assert struck["envelope at BPFO"] > 10.0 * quiet["envelope at BPFO"]
    assert np.isnan(struck["envelope at FTF"])  # slower than the record can tell


def test_the_call_of_the_page(known_run, bearing):
    """As printed, on a run whose outer ring is struck at its BPFO."""
    page = Path(spectra.__file__).with_name("README.md").read_text("utf-8")
    code = next(c for c in re.findall(r"```python\n(.*?)```", page, re.S) if "envelope_spec" in c)
    lines = own_frequencies(known_run, bearing)
    t = known_run["time_hf"].values
    since = t % (1.0 / lines["BPFO"])
    struck = np.exp(-since / 1e-4) * np.sin(2 * np.pi * 9e3 * since)
    ds = known_run.copy()
    ds["outer_acceleration"] = ds["outer_acceleration"] + struck[:, None]
    names: dict = {"run": SimpleNamespace(dataset=ds, numbers=bearing)}
    exec(code, names)
    spectrum, figures = names["spectrum"], names["figures"]
    top = float(spectrum.sel(frequency=slice(200.0, 1400.0)).idxmax("frequency"))
    assert top == pytest.approx(lines["BPFO"], abs=float(spectrum["frequency"][1]))
    assert figures["envelope at BPFO"] > 5.0 * figures["envelope at BPFI"]


@pytest.mark.parametrize("band", [(0.0, 5e3), (2e3, 20e3), (5e3, 2e3), (float("nan"), 5e3)])
def test_a_band_out_of_reach_is_one_sentence(band):
    with pytest.raises(InputError, match=r"within 0 and 10000 Hz, half the sampling rate"):
        envelope(signal(np.zeros(1000)), band)


def test_components_keep_their_names():
    t = np.arange(2000) / RATE
    pair = xr.DataArray(
        np.stack([np.sin(2 * np.pi * 500 * t), np.cos(2 * np.pi * 900 * t)], axis=1),
        dims=("time", "axis2"), coords={"time": t, "axis2": ["y", "z"]},
    )  # fmt: skip
    density = spectral_density(pair)
    assert density.dims == ("frequency", "axis2")
    assert density.idxmax("frequency").values.tolist() == [500.0, 900.0]


def test_a_resolution_out_of_reach_is_one_sentence():
    x = signal(np.zeros(1000))
    for resolution in (19.0, 3e3, 0.0, -5.0, float("nan")):
        with pytest.raises(InputError, match=r"out of reach.* 20 to 2500 Hz"):
            spectral_density(x, resolution=resolution)


def test_signals_of_a_run_with_a_known_orbit(known_run, bearing):
    """40 um of whirl at 0.98 of the cage's ideal frequency; the pocket forces step once."""
    resolution = run_resolution(known_run, bearing)
    assert resolution == pytest.approx(1.0 / 0.1)
    assert run_frequencies(known_run, bearing)["BPFO"] == pytest.approx(993.3333, abs=1e-4)
    shown = {
        name: spectral_density(signal, resolution=resolution)
        for name, found in SIGNALS.items()
        if (signal := found.of(known_run)) is not None
    }
    assert set(SIGNALS) - set(shown) == {"orbital_speed", "neighbour_forces"}  # of no cage
    centre, step = shown["cage_centre"], shown["cage_centre"].attrs["resolution"]
    whirling = 0.98 * 2709.0909 / 60.0
    assert centre.attrs["units"] == "(m)^2/Hz"
    for axis in "yz":
        line = centre.sel(axis2=axis)
        assert float(line.idxmax("frequency")) == pytest.approx(whirling, abs=step)
        power = float(line.sel(frequency=slice(1.0, whirling + 3 * step)).sum()) * step
        assert np.sqrt(2.0 * power) == pytest.approx(40e-6, rel=0.02)
    assert float(shown["pocket_forces"].idxmax("frequency")) <= 2 * step
    assert shown["outer_acceleration"].attrs["resolution"] == pytest.approx(step, rel=1e-3)
    for name in ("outer_acceleration", "outer_envelope"):
        assert SIGNALS[name].of(known_run.drop_dims("time_hf")) is None


def test_a_run_too_short_for_any_line(known_run, bearing):
    short = known_run.isel(time=slice(100))
    assert resolves(known_run, bearing) and not resolves(short, bearing)
    with pytest.raises(InputError, match=r"1207 Hz; there are 2.4 in 1.98 ms: raise solver"):
        run_resolution(short, bearing)


def test_features_of_a_known_motion(known_run):
    """Synchronous whirl, 11 N at most and about 3 N on average, a centre that goes on evenly."""
    ds = known_run.copy(deep=True)
    ds["cage_position"][:] -= [0.0, 10e-6, -20e-6]
    ds["cage_velocity"][:, 1] = 1.0 + 0.3 * np.sin(2 * np.pi * 100 * ds["time"].values)
    features = cage_motion_features(ds)
    assert features.velocity_deviation == pytest.approx(0.3 / np.sqrt(2), rel=1e-3)
    assert features.whirl_speed_ratio == pytest.approx(1.0, abs=1e-6)
    assert features.pocket_force_ratio == pytest.approx(11.0 * 2501 / (2500 * 3 + 8))
    assert features.vector.tolist() == [
        features.velocity_deviation, features.whirl_speed_ratio, features.pocket_force_ratio,
    ]  # fmt: skip


def test_a_centre_at_rest_has_no_deviation(known_run):
    """Nor has a run whose samples are too slow or too few for the filter."""
    assert np.isnan(metrics.velocity_deviation(known_run))
    moving = known_run.copy(deep=True)
    moving["cage_velocity"][:, 1] = 1.0
    assert metrics.velocity_deviation(moving) == 0.0
    assert metrics.velocity_deviation(moving, low_pass=2e3) == pytest.approx(0.0, abs=1e-9)
    assert np.isnan(metrics.velocity_deviation(moving, low_pass=24e3))
    assert np.isnan(metrics.velocity_deviation(moving.isel(time=slice(10)), low_pass=2e3))
