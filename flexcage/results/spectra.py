"""Spectra of result variables."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from flexcage.core.errors import InputError

if TYPE_CHECKING:
    import xarray

GRIDS = ("time", "time_hf")


def amplitude_spectrum(
    signal: xarray.DataArray, *, window: str = "hann", detrend: bool = True
) -> xarray.DataArray:
    """One-sided amplitude spectrum: a line of a sine of amplitude A reads A (on a bin's centre).

    ``signal`` has one of the time grids as a dimension, evenly sampled [s]; the result has
    ``frequency`` [Hz] in its place. ``detrend`` takes the mean off first.
    """
    import xarray as xr
    from scipy.signal import get_window

    dim = next((d for d in GRIDS if d in signal.dims), None)
    if dim is None:
        raise InputError(f"A spectrum needs a time dimension; this array has {signal.dims}.")
    t = signal[dim].values
    if len(t) < 8:
        raise InputError(f"A spectrum needs 8 samples or more; there are {len(t)}.")
    step = (t[-1] - t[0]) / (len(t) - 1)
    axis = signal.dims.index(dim)
    x = np.moveaxis(np.asarray(signal.values, float), axis, -1)
    if detrend:
        x = x - x.mean(axis=-1, keepdims=True)
    w = get_window(window, len(t))
    amplitude = 2.0 * np.abs(np.fft.rfft(x * w, axis=-1)) / w.sum()
    amplitude[..., 0] *= 0.5
    others = [d for d in signal.dims if d != dim]
    frequency = xr.Variable(
        "frequency", np.fft.rfftfreq(len(t), step), {"units": "Hz", "long_name": "frequency"}
    )
    coords = {d: signal[d] for d in others if d in signal.coords}
    out = xr.DataArray(
        amplitude,
        dims=(*others, "frequency"),
        coords={**coords, "frequency": frequency},
        name=signal.name,
        attrs={**signal.attrs, "long_name": f"amplitude of {signal.attrs.get('long_name', '')}"},
    )
    return out.transpose(*(d if d != dim else "frequency" for d in signal.dims))
