"""A signal on trial before its spectrum: is it sampled evenly, in seconds, with a number each time?

A Fourier transform knows no instants: of a record with gaps it makes lines at wrong frequencies.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.errors import InputError

if TYPE_CHECKING:
    import xarray

GRID = "time"  # or a name that begins with it, as "time_hf"
FEWEST = 8  # samples of a spectrum
_OFF = 0.25  # of the distance of samples, that one may lie off its even instant: clocks that jitter


def grid_of(signal: xarray.DataArray) -> str:
    """The dimension that is time; InputError for what has none, or is no DataArray."""
    import xarray as xr

    if not isinstance(signal, xr.DataArray):
        raise InputError(
            "A spectrum needs an xarray.DataArray with instants in seconds, as xarray.DataArray("
            f"values, dims='time', coords={{'time': t}}); this is of type {type(signal).__name__}.",
            where="signal",
        )
    found = next((str(d) for d in signal.dims if d == GRID or str(d).startswith(f"{GRID}_")), None)
    if found is None:
        raise InputError(f"A spectrum needs a time dimension; this array has {signal.dims}.")
    return found


def series(signal: xarray.DataArray) -> tuple[np.ndarray, float]:
    """Values with time last (..., n), and samples a second [Hz].

    Raises InputError for fewer than ``FEWEST`` samples, instants that are no even ones in seconds,
    and values that are no real numbers.
    """
    grid = grid_of(signal)
    t = _instants(signal, grid)
    values = np.moveaxis(np.asarray(signal.values), signal.dims.index(grid), -1)
    if values.dtype.kind not in "biuf":
        raise InputError(
            f"The signal holds {values.dtype} values, but a spectrum needs real numbers.",
            where="signal",
        )
    odd = ~np.isfinite(values).reshape(-1, len(t)).all(axis=0)
    if odd.any():
        raise InputError(
            f"The signal has no number at {int(odd.sum()):,} of its {len(t):,} instants, the first "
            f"at {t[np.argmax(odd)]:g} s; fill them (signal.interpolate_na), or take a part.",
            where="signal",
        )
    return values.astype(float), (len(t) - 1) / float(t[-1] - t[0])


def _instants(signal: xarray.DataArray, grid: str) -> np.ndarray:
    if grid not in signal.coords:
        raise InputError(
            f"The signal does not say when its samples are; give it the coordinate '{grid}' in "
            "seconds.",
            where=grid,
        )
    t: np.ndarray = signal[grid].values
    if len(t) < FEWEST:
        raise InputError(f"A spectrum needs {FEWEST} samples or more; there are {len(t)}.")
    if t.dtype.kind not in "iuf" or not np.isfinite(t).all():
        raise InputError(
            f"The signal's '{grid}' is of {t.dtype} values, but should be finite numbers of "
            "seconds.",
            where=grid,
        )
    steps = np.diff(t.astype(float))
    step = float(t[-1] - t[0]) / (len(t) - 1)
    if not step > 0.0 or (steps <= 0.0).any():
        raise InputError(
            f"The signal's '{grid}' does not rise from sample to sample; sort it.", where=grid
        )
    if np.abs(t - t[0] - step * np.arange(len(t))).max() > _OFF * step:
        usual = float(np.median(steps))
        k = int(np.argmax(np.abs(steps - usual)))
        raise InputError(
            f"The signal is not sampled evenly: {steps[k]:.4g} s lie between the samples at "
            f"{t[k]:g} s and {t[k + 1]:g} s, and {usual:.4g} s between most; bring it to even "
            f"instants (signal.interp), or take a part without gaps.",
            where=grid,
            value=float(steps[k]),
        )
    return t
