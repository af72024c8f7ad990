"""Spectra of what a run records, and the frequencies at which its bearing excites them.

``amplitude_spectrum`` reads the amplitude of lines; ``spectral_density`` (Welch's method) shows
noise and lines of a chaotic motion alike, whatever the length of the record.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import ceil
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.errors import InputError
from flexcage.results import metrics
from flexcage.results.each_cage import one_cage
from flexcage.results.evenly import FEWEST, grid_of, series
from flexcage.results.figures.figure import CAGE_SPEED
from flexcage.results.frequencies import bearing_frequencies as bearing_frequencies
from flexcage.results.frequencies import own_frequencies as own_frequencies
from flexcage.results.frequencies import run_frequencies
from flexcage.results.registry import NEIGHBOURS

if TYPE_CHECKING:
    import xarray

    from flexcage.results.slip import BearingNumbers

TURNS = 8  # of the cage in a segment of a run's spectra, if the run is that long
BAND = (2e3, 20e3)  # Hz, of the vibration whose envelope is shown: what sensors and shocks share
FLOOR_TO = 4.0  # times the highest line, up to which the floor of an envelope's spectrum is taken
_PADDING = 27  # samples before the first and after the last, of a filter run both ways
RESOLVED_BINS = 3  # of a Hann window, from which on a line is resolved from the mean and others


@dataclass(frozen=True)
class Signal:
    """One signal of a run: what it is called, and how it follows from the dataset.

    ``of`` gives (time,) or (time, axis2), or None where the run does not record it.
    """

    title: str
    of: Callable[[xarray.Dataset], xarray.DataArray | None]


def _cage_centre(ds: xarray.Dataset) -> xarray.DataArray | None:
    import xarray as xr

    if not metrics.caged(ds):
        return None

    return xr.DataArray(
        metrics.orbit(one_cage(ds, 0)), dims=("time", "axis2"),
        coords={"time": ds["time"], "axis2": ["y", "z"]}, attrs={"units": "m"},
    )  # fmt: skip


def _cage_speed(ds: xarray.Dataset) -> xarray.DataArray | None:
    return metrics.carrier_speed(ds) if metrics.caged(ds) else None


def _orbital_speed(ds: xarray.Dataset) -> xarray.DataArray | None:
    return None if metrics.caged(ds) else metrics.carrier_speed(ds)


def _neighbour_forces(ds: xarray.Dataset) -> xarray.DataArray | None:
    if metrics.caged(ds):
        return None
    return ds[NEIGHBOURS].astype(float).sum("element").assign_attrs(units="N")


def _pocket_forces(ds: xarray.Dataset) -> xarray.DataArray | None:
    if not metrics.caged(ds):
        return None
    return ds["pocket_force"].astype(float).sum(("pocket", "face")).assign_attrs(units="N")


def _outer_ring(ds: xarray.Dataset) -> xarray.DataArray | None:
    return ds.get("outer_acceleration")


def _outer_envelope(ds: xarray.Dataset) -> xarray.DataArray | None:
    vibration = _outer_ring(ds)
    if vibration is None or vibration.sizes["time_hf"] < FEWEST or _reach(vibration) < BAND[1]:
        return None
    return envelope(vibration)


#: Signals whose spectra are shown of every run, by name.
SIGNALS: Mapping[str, Signal] = MappingProxyType(
    {
        "cage_centre": Signal("Cage centre, from the outer ring's", _cage_centre),
        "cage_speed": Signal(CAGE_SPEED, _cage_speed),
        "pocket_forces": Signal("Sum of the pocket forces", _pocket_forces),
        "orbital_speed": Signal("Mean orbital speed of the elements", _orbital_speed),
        "neighbour_forces": Signal("Sum of the forces between neighbours", _neighbour_forces),
        "outer_acceleration": Signal("Acceleration of the outer ring", _outer_ring),
        "outer_envelope": Signal(
            f"Envelope of it, {BAND[0] / 1e3:g} to {BAND[1] / 1e3:g} kHz", _outer_envelope
        ),
    }
)


def run_resolution(ds: xarray.Dataset, bearing: BearingNumbers) -> float:
    """Distance of bins [Hz] that suits a run: an eighth of the cage's frequency, or the inverse of
    the run's length, which is the least there is.

    Raises InputError for a run in which no line of the bearing stands apart.
    """
    length = _length(ds)
    if not resolves(ds, bearing):
        fastest = max(run_frequencies(ds, bearing).values())
        raise InputError(
            f"Spectra want {RESOLVED_BINS} periods of the bearing's fastest line, "
            f"{fastest:.4g} Hz; there are {length * fastest:.2g} in {length * 1e3:.4g} ms: raise "
            "solver.duration.",
            where="solver.duration",
            value=length,
        )
    return max(run_frequencies(ds, bearing)["FTF"] / TURNS, 1.0 / length)


def resolves(ds: xarray.Dataset, bearing: BearingNumbers) -> bool:
    """Whether the run is long enough for any line of its bearing to stand apart."""
    return _length(ds) * max(run_frequencies(ds, bearing).values()) >= RESOLVED_BINS


def _length(ds: xarray.Dataset) -> float:
    return float(ds["time"][-1] - ds["time"][0])


def spectral_density(
    signal: xarray.DataArray, *, resolution: float | None = None, window: str = "hann"
) -> xarray.DataArray:
    """One-sided power spectral density by Welch's method, in squared units per hertz.

    ``signal`` has one of the time grids as a dimension, evenly sampled [s]; the result has
    ``frequency`` [Hz] in its place. Segments of 1/``resolution`` seconds (default: one, the whole
    record) overlap by a half; each has its mean taken off and is multiplied by ``window``, and
    their periodograms are averaged. The integral over frequency is the variance; of a sine of
    amplitude A, A^2/2 lies within two bins of its frequency under a Hann window.
    ``attrs`` hold units, window, ``resolution`` [Hz] between bins and the number of ``segments``.

    Raises InputError for too short a signal and for a resolution that its length cannot give.
    """
    from scipy.signal import welch

    x, rate = series(signal)
    count = x.shape[-1]
    length = count if resolution is None else _segment(resolution, rate, count)
    half = length // 2
    frequency, power = welch(
        x, rate, window, nperseg=length, noverlap=half, detrend="constant", scaling="density"
    )
    units = signal.attrs.get("units", "1")
    attrs = {
        "units": f"({units})^2/Hz", "window": window, "resolution": rate / length,
        "segments": 1 + (count - length) // (length - half),
    }  # fmt: skip
    return _over_frequency(signal, frequency, power, attrs)


def envelope(signal: xarray.DataArray, band: tuple[float, float] = BAND) -> xarray.DataArray:
    """Envelope of what a signal holds in a band [Hz]: the modulus of its analytic signal.

    Shocks that come back at a frequency, as a spall's at BPFO, are lines of the envelope's
    spectrum where the signal's own shows what they make ring. Band-passed both ways by a
    Butterworth filter of order 4. Raises InputError for a band that the sampling cannot hold.
    Source: R. B. Randall and J. Antoni, Mech. Syst. Signal Process. 25 (2011) 485.
    """
    from scipy.signal import butter, hilbert, sosfiltfilt

    low, high = band
    x, rate = series(signal)
    if not 0.0 < low < high < 0.5 * rate:
        raise InputError(
            f"The band {low:g} to {high:g} Hz of an envelope must rise and lie within 0 and "
            f"{0.5 * rate:g} Hz, half the sampling rate.",
            where="band",
            value=band,
        )
    sections = butter(4, (low, high), "bandpass", fs=rate, output="sos")
    padding = min(_PADDING, x.shape[-1] - 1)
    passed = sosfiltfilt(sections, x, axis=-1, padlen=padding)
    values = np.abs(hilbert(passed, axis=-1))
    out = signal.copy(data=np.moveaxis(values, -1, signal.dims.index(grid_of(signal))))
    return out.assign_attrs(long_name=f"envelope of {signal.attrs.get('long_name', '')}")


def _reach(signal: xarray.DataArray) -> float:
    """Half the sampling rate [Hz]."""
    t = signal[grid_of(signal)].values
    return 0.5 * (len(t) - 1) / float(t[-1] - t[0])


def _segment(resolution: float, rate: float, count: int) -> int:
    """Samples of a segment whose bins lie ``resolution`` [Hz] apart."""
    finest, coarsest = rate / count, rate / FEWEST
    if not finest * (1.0 - 1e-9) <= resolution <= coarsest:
        raise InputError(
            f"A resolution of {resolution:g} Hz is out of reach: {count} samples at {rate:g} Hz "
            f"give {finest:.4g} to {coarsest:.4g} Hz.",
            where="resolution",
            value=resolution,
        )
    return min(ceil(rate / resolution * (1.0 - 1e-9)), count)


def amplitude_spectrum(
    signal: xarray.DataArray, *, window: str = "hann", detrend: bool = True
) -> xarray.DataArray:
    """One-sided amplitude spectrum: a line of a sine of amplitude A reads A (on a bin's centre).

    ``signal`` has one of the time grids as a dimension, evenly sampled [s]; the result has
    ``frequency`` [Hz] in its place. ``detrend`` takes the mean off first.
    """
    from scipy.signal import get_window

    x, rate = series(signal)
    if detrend:
        x = x - x.mean(axis=-1, keepdims=True)
    w = get_window(window, x.shape[-1])
    amplitude = 2.0 * np.abs(np.fft.rfft(x * w, axis=-1)) / w.sum()
    amplitude[..., 0] *= 0.5
    attrs = {**signal.attrs, "long_name": f"amplitude of {signal.attrs.get('long_name', '')}"}
    return _over_frequency(signal, np.fft.rfftfreq(x.shape[-1], 1.0 / rate), amplitude, attrs)


def envelope_spectrum(
    signal: xarray.DataArray, band: tuple[float, float] = BAND
) -> xarray.DataArray:
    """Amplitude spectrum of the envelope of what a signal holds in a band [Hz], in its own unit:
    shocks that come back at a frequency are lines there (``own_frequencies`` gives a bearing's).

    ``signal`` as for ``amplitude_spectrum``; InputError for a band that its sampling cannot hold.
    """
    return amplitude_spectrum(envelope(signal, band))


def vibration_figures(
    signal: xarray.DataArray, lines: Mapping[str, float], band: tuple[float, float] = BAND
) -> dict[str, float]:
    """Figures of one vibration signal (time,), by name: ``rms`` about its mean; ``kurtosis`` (3 of
    Gaussian noise, 1.5 of a sine); ``crest``, its largest over ``rms``; ``band rms``, that of what
    it holds in the band [Hz]; of each of ``lines`` [Hz], as ``envelope at BPFO``, the largest
    amplitude of its envelope's spectrum within two bins, and as ``envelope at 3 BPFO`` the root of
    the sum of their squares at 1, 2 and 3 times the line; and as ``envelope floor`` the median of
    that spectrum from its first resolved line up to ``FLOOR_TO`` times the highest of ``lines``.

    A line that the record does not set apart from the mean is NaN; so are multiples beyond it.
    """
    x, _ = series(signal)
    x = x - x.mean()
    rms = float(np.sqrt(np.mean(x**2)))
    own = envelope(signal, band)
    figures = {
        "rms": rms,
        "kurtosis": float(np.mean(x**4)) / rms**4 if rms else float("nan"),
        "crest": float(np.abs(x).max()) / rms if rms else float("nan"),
        "band rms": float(np.sqrt(0.5 * np.mean(own.values**2))),
    }
    spectrum = amplitude_spectrum(own)
    for name, line in lines.items():
        heights = [_height(spectrum, k * line) for k in (1, 2, 3)]
        figures[f"envelope at {name}"] = heights[0]
        figures[f"envelope at 3 {name}"] = float(np.sqrt(np.sum(np.square(heights))))
    frequency = spectrum["frequency"].values
    reach = FLOOR_TO * max(lines.values(), default=frequency[-1])
    within = (frequency >= RESOLVED_BINS * frequency[1]) & (frequency <= reach)
    figures["envelope floor"] = (
        float(np.median(spectrum.values[within])) if within.any() else np.nan
    )
    return figures


def _height(spectrum: xarray.DataArray, line: float) -> float:
    """Largest amplitude within two bins of a line [Hz]; NaN for one that is not resolved."""
    frequency = spectrum["frequency"].values
    if not RESOLVED_BINS * frequency[1] <= line <= frequency[-1]:
        return float("nan")
    return float(spectrum.values[np.abs(frequency - line) <= 2.0 * frequency[1]].max())


def _over_frequency(
    signal: xarray.DataArray, frequency: np.ndarray, values: np.ndarray, attrs: dict
) -> xarray.DataArray:
    """``values`` (..., frequency) with the labels of the signal, frequency in time's place."""
    import xarray as xr

    grid = grid_of(signal)
    others = [d for d in signal.dims if d != grid]
    axis = xr.Variable("frequency", frequency, {"units": "Hz", "long_name": "frequency"})
    out = xr.DataArray(
        values,
        dims=(*others, "frequency"),
        coords={**{d: signal[d] for d in others if d in signal.coords}, "frequency": axis},
        name=signal.name,
        attrs=attrs,
    )
    return out.transpose(*(d if d != grid else "frequency" for d in signal.dims))
