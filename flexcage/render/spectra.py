"""Spectra of a run, with the frequencies at which its bearing excites them marked."""

from __future__ import annotations

from collections.abc import Mapping
from math import pi
from pathlib import Path
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.render import sheet
from flexcage.results import metrics
from flexcage.results.slip import BearingNumbers, at_own_angles
from flexcage.results.spectra import (
    RESOLVED_BINS,
    SIGNALS,
    own_frequencies,
    run_frequencies,
    run_resolution,
    spectral_density,
)

if TYPE_CHECKING:
    import xarray

_LEFT, _WIDTH, _HEIGHT, _BETWEEN, _TOP = 140, 1240, 240, 34, 190
_PANEL, _COLUMN = 300, 26  # pixels beside the panels for what they show, and its characters
_NAMES = 118  # pixels from one name of a line to the next
_REACH = 3.0  # frequencies shown, over the fastest line
_DECADES = 6.0  # shown at most
#: Units as shown, and the factor from SI, by the unit of a signal.
_SHOWN = {"m": ("µm", 1e6), "rad/s": ("rpm", 30.0 / pi)}


def spectra_picture(
    ds: xarray.Dataset,
    path: str | Path,
    *,
    bearing: BearingNumbers,
    settle: float = 0.0,
    title: str = "Spectra",
    note: str = "",
) -> Path:
    """Amplitude spectral densities of a run's signals over frequency, one panel a signal.

    The bearing's frequencies without slip stand at the run's mean inner speed and, of balls, mean
    contact angles (``at_own_angles``), those that its
    length sets apart from the mean. ``settle`` leaves the start out. Raises InputError for a run
    too short for any of them.
    """
    part = metrics.settled(ds, settle)
    bearing = at_own_angles(part, bearing)
    resolution = run_resolution(part, bearing)
    lines = run_frequencies(part, bearing)
    marked = {name: f for name, f in lines.items() if f >= RESOLVED_BINS * resolution}
    found = {signal.title: signal.of(part) for signal in SIGNALS.values()}
    shown = {
        name: spectral_density(series, resolution=resolution)
        for name, series in found.items() if series is not None
    }  # fmt: skip
    reach = min(_REACH * max(lines.values()), *(float(d["frequency"][-1]) for d in shown.values()))
    with sheet.style():
        height = _TOP + len(shown) * (_HEIGHT + _BETWEEN) + 84
        figure = sheet.new_figure(_LEFT + _WIDTH + _PANEL, height)
        sheet.heading(figure, title, _facts(part, next(iter(shown.values())), note))
        for i, (name, density) in enumerate(shown.items()):
            rect = (_LEFT, _TOP + i * (_HEIGHT + _BETWEEN), _WIDTH, _HEIGHT)
            ax = sheet.axes_at(figure, rect)
            _panel(ax, density, name, reach)
            for frequency in marked.values():
                ax.axvline(frequency, color=sheet.FAINT, lw=0.8, ls=(0, (4, 3)), zorder=1)
            ax.yaxis.set_label_coords((40.0 - _LEFT) / _WIDTH, 0.5)
            if i == 0:
                _name_lines(ax, marked, reach)
            if i < len(shown) - 1:
                ax.tick_params(labelbottom=False)
        below = sheet.join(["frequency [Hz]", _unmarked(lines, marked, resolution)])
        ax.set_xlabel("\n".join(filter(None, (below, _angles(part, bearing), _own(part, bearing)))))
        return sheet.save(figure, path)


def _facts(ds: xarray.Dataset, density: xarray.DataArray, note: str) -> str:
    t, speed = ds["time"].values * 1e3, np.abs(ds["inner_speed"].values) * 30.0 / pi
    segments = int(density.attrs["segments"])
    steady = np.ptp(speed) < 0.01 * speed.mean()
    span = "" if steady else f", which runs from {speed.min():,.0f} to {speed.max():,.0f}"
    return sheet.join([
        note,
        f"t = {t[0]:.1f} … {t[-1]:.1f} ms",
        f"{segments} segment{'s' if segments > 1 else ''}, Hann window, mean taken off",
        f"bins {density.attrs['resolution']:.3g} Hz apart",
        f"lines without slip at {speed.mean():,.0f} rpm{span}",
    ])  # fmt: skip


def _angles(ds: xarray.Dataset, bearing: BearingNumbers) -> str:
    """At which contact angles lines stand, and where the nominal one would have two of them."""
    if bearing.own_angles is None:
        return ""
    nominal = run_frequencies(ds, bearing, own=False)
    inner, outer = (angle * 180.0 / pi for angle in bearing.own_angles)
    return (
        f"lines are at mean contact angles of {inner:.1f}° and {outer:.1f}°; at the nominal "
        f"{bearing.contact_angle * 180.0 / pi:.4g}°: FTF {nominal['FTF']:,.1f}, "
        f"BPFO {nominal['BPFO']:,.1f} Hz"
    )


def _own(ds: xarray.Dataset, bearing: BearingNumbers) -> str:
    """Where the run's own speeds have the lines."""
    own = own_frequencies(ds, bearing)
    lines = [f"{name} {own[name]:,.1f}" for name in ("FTF", "BSF", "BPFO", "BPFI")]
    return f"with slip, by the run's own mean speeds: {', '.join(lines)} Hz"


def _panel(ax: Any, density: xarray.DataArray, name: str, reach: float) -> None:
    power_unit = density.attrs["units"].removesuffix("^2/Hz").strip("()")
    unit, factor = _SHOWN.get(power_unit, (power_unit.replace("^2", "²"), 1.0))
    part = density.isel(frequency=slice(1, None))
    part = part.isel(frequency=part["frequency"].values <= reach)
    values = np.sqrt(part.values).reshape(part.sizes["frequency"], -1) * factor
    labels = part["axis2"].values if "axis2" in part.dims else [""]
    for column, label, colour in zip(values.T, labels, (sheet.BLUE, sheet.ORANGE)):
        ax.plot(part["frequency"], column, color=colour, lw=1.1, label=label or "amplitude")
    top = float(values.max())
    if top > 0.0:
        ax.set_yscale("log")
        ax.set_ylim(max(0.5 * values.min(), top * 10.0**-_DECADES), 2.0 * top)
    ax.set(xlim=(0.0, reach), ylabel=f"{unit}/√Hz")
    ax.legend(
        loc="upper left", bbox_to_anchor=(1.01, 1.0), borderaxespad=0.0, alignment="left",
        title=fill(name, _COLUMN), title_fontproperties={"weight": "bold", "size": 8.5},
    )  # fmt: skip


def _name_lines(ax: Any, lines: Mapping[str, float], reach: float) -> None:
    """Names and frequencies above the panel, moved apart where lines are close to each other."""
    ordered = sorted(lines.items(), key=lambda line: line[1])
    at = np.array([f for _, f in ordered])
    gap = _NAMES * reach / _WIDTH
    places = spread(at, gap, low=0.0, high=reach)
    across = ax.get_xaxis_transform()
    for (name, frequency), place in zip(ordered, places):
        ax.plot(
            [frequency, frequency, place], [1.0, 1.03, 1.13], transform=across, clip_on=False,
            color=sheet.FAINT, lw=0.8,
        )  # fmt: skip
        ax.text(
            place, 1.15, f"{name}\n{frequency:,.1f} Hz", transform=across, ha="center",
            va="bottom", fontsize=8.5, linespacing=1.15,
        )  # fmt: skip


def spread(at: np.ndarray, gap: float, *, low: float, high: float) -> np.ndarray:
    """Places nearest to rising ``at`` (n,), at least ``gap`` apart, in ``low`` to ``high`` if they
    fit there."""
    from scipy.optimize import isotonic_regression

    steps = gap * np.arange(len(at))
    if not len(at):
        return steps
    free = isotonic_regression(at - steps).x
    return np.clip(free, low, max(high - steps[-1], low)) + steps


def _unmarked(lines: Mapping[str, float], marked: Mapping[str, float], resolution: float) -> str:
    """Which lines a run of this length does not set apart, in words."""
    names = [f"{name} {f:.1f} Hz" for name, f in lines.items() if name not in marked]
    if not names:
        return ""
    least = f"{RESOLVED_BINS * resolution:.0f} Hz"
    return f"a run this short tells lines from {least} on; not marked: {', '.join(names)}"
