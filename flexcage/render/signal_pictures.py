"""A sensor's signal as a diagnostician looks at it, with the hidden force that a run knows."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.render import sheet
from flexcage.results.evenly import grid_of, series
from flexcage.results.frequencies import SOUGHT
from flexcage.results.spectra import BAND, amplitude_spectrum, envelope_spectrum

if TYPE_CHECKING:
    import xarray

_LEFT, _WIDTH, _HEIGHT, _BETWEEN, _TOP = 140, 1240, 220, 118, 150
_BAR = 16  # of the spectrogram's colours, beside it
_SPAN = 25e-3  # s of the signal that are shown
_REACH = 0.4  # of the rate, up to which spectra are shown
_SLICE = 64  # samples of a column of the spectrogram
_FINER = 4  # times as many rows, by zeros
_DECIBELS = 60.0
_COLOURS = (sheet.GREEN, sheet.PURPLE, sheet.VERMILION, sheet.INK)  # of lines, as ``SOUGHT``


def signal_picture(
    signal: xarray.DataArray,
    path: str | Path,
    *,
    lines: Mapping[str, float],
    force: xarray.DataArray | None = None,
    band: tuple[float, float] = BAND,
    title: str = "Signal of a sensor",
) -> Path:
    """Signal over time, ``force`` (time,) or (time, element) [N] under it, spectrogram, amplitude
    spectrum, and spectrum of the envelope of the ``band`` [Hz], with the ``lines`` [Hz] marked
    where defects show.

    ``signal`` is one of ``run.signals``. InputError for a band that its rate cannot hold.
    """
    x, rate = series(signal)
    t, unit = signal[grid_of(signal)].values, str(signal.attrs["units"]).replace("^2", "²")
    band = (band[0], min(band[1], _REACH * rate))
    begin = max(t[0], t[-1] - _SPAN)
    hidden = [_force] if force is not None else []
    panels = [_over_time, *hidden, _spectrogram, _spectrum, _envelope]
    facts = {
        "signal": signal, "x": x, "t": t, "rate": rate, "unit": unit, "begin": begin,
        "force": force, "band": band, "lines": lines,
    }  # fmt: skip
    with sheet.style():
        height = _TOP + len(panels) * (_HEIGHT + _BETWEEN) - 30
        figure = sheet.new_figure(_LEFT + _WIDTH + 120, height)
        subtitle = f"{signal.attrs['long_name']}, {rate / 1e3:g} kHz"
        sheet.heading(figure, title, subtitle)
        for i, draw in enumerate(panels):
            top = _TOP + i * (_HEIGHT + _BETWEEN)
            draw(sheet.axes_at(figure, (_LEFT, top, _WIDTH, _HEIGHT)), facts)
        return sheet.save(figure, path)


def _titled(ax: Any, title: str, **labels: Any) -> None:
    ax.set_title(title, loc="left")
    ax.set(**labels)


def _in_time(ax: Any, of: Mapping[str, Any], title: str, unit: str) -> None:
    limits = (1e3 * of["begin"], 1e3 * of["t"][-1])
    _titled(ax, title, xlabel="time [ms]", ylabel=unit, xlim=limits)


def _over_time(ax: Any, of: Mapping[str, Any]) -> None:
    shown = of["t"] >= of["begin"]
    ax.plot(1e3 * of["t"][shown], of["x"][shown], color=sheet.BLUE, lw=0.7)
    _in_time(ax, of, "Signal", of["unit"])


def _force(ax: Any, of: Mapping[str, Any]) -> None:
    part = of["force"].sel(time=slice(of["begin"], of["t"][-1]))
    each = part.transpose("time", ...).values.reshape(part.sizes["time"], -1).T
    for i, values in enumerate(each):
        colour = sheet.CYCLE[(i + 1) % len(sheet.CYCLE)]
        ax.plot(1e3 * part["time"].values, values, color=colour, lw=0.9)
    _in_time(ax, of, f"Hidden under it: {part.attrs.get('long_name', 'force')}", "N")
    ax.set_ylim(bottom=min(0.0, float(each.min())))


def _spectrum(ax: Any, of: Mapping[str, Any]) -> None:
    found = amplitude_spectrum(of["signal"])
    frequency = found["frequency"].values
    shown = (frequency > 0.0) & (frequency <= _REACH * of["rate"])
    ax.plot(frequency[shown] / 1e3, found.values[shown], color=sheet.BLUE, lw=0.7)
    top = float(found.values[shown].max())
    _titled(ax, "Amplitude spectrum", xlabel="frequency [kHz]", ylabel=of["unit"], yscale="log")
    ax.set(xlim=(0.0, _REACH * of["rate"] / 1e3), ylim=(1e-5 * top, 2.0 * top))


def _envelope(ax: Any, of: Mapping[str, Any]) -> None:
    found = envelope_spectrum(of["signal"], of["band"])
    frequency, values = found["frequency"].values, found.values
    reach = 3.4 * max(of["lines"][name] for name in SOUGHT)
    shown = (frequency > 0.0) & (frequency <= reach)
    for name, colour in zip(SOUGHT, _COLOURS):
        for k in (1, 2, 3):
            ax.axvline(
                k * of["lines"][name], color=colour, lw=0.9, ls=(0, (4, 3)), zorder=1,
                label=f"{name} {of['lines'][name]:,.1f} Hz" if k == 1 else None,
            )  # fmt: skip
    ax.plot(frequency[shown], values[shown], color=sheet.BLUE, lw=0.9)
    low, high = (f / 1e3 for f in of["band"])
    title = f"Envelope spectrum, {low:g} to {high:g} kHz"
    _titled(ax, title, xlabel="frequency [Hz]; dashed: 1, 2, 3 times", ylabel=of["unit"])
    ax.set(xlim=(0.0, reach), ylim=(0.0, 1.1 * float(values[shown].max())))
    ax.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.1, ncols=4,
              columnspacing=1.2, handlelength=1.6)  # fmt: skip


def _spectrogram(ax: Any, of: Mapping[str, Any]) -> None:
    from scipy.signal import ShortTimeFFT
    from scipy.signal.windows import hann

    size = min(_SLICE, len(of["x"]) // 2)
    hop = max(size // 16, 1)
    transform = ShortTimeFFT(hann(size, sym=False), hop, of["rate"], mfft=_FINER * size)
    power = transform.spectrogram(of["x"] - of["x"].mean())
    level = 10.0 * np.log10(np.maximum(power, 1e-30))
    top = float(level[_FINER:].max())  # beside what only drifts
    span = transform.extent(len(of["x"]))
    extent = (1e3 * (of["t"][0] + span[0]), 1e3 * (of["t"][0] + span[1]),
              span[2] / 1e3, span[3] / 1e3)  # fmt: skip
    shown = ax.imshow(level - top, origin="lower", aspect="auto", extent=extent, cmap="viridis",
                      vmin=-_DECIBELS, vmax=0.0)  # fmt: skip
    ax.grid(False)
    _in_time(ax, of, "Spectrogram", "kHz")
    ax.set_ylim(0.0, _REACH * of["rate"] / 1e3)
    beside = ax.inset_axes((1.0 + _BAR / _WIDTH, 0.0, _BAR / _WIDTH, 1.0))
    ax.figure.colorbar(shown, cax=beside, label="dB of the highest")
