"""How severe the signals of a run's sensors are, and whether they ran out of range."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from math import isfinite
from typing import TYPE_CHECKING

from flexcage.core.warning import RunWarning
from flexcage.results.evenly import FEWEST
from flexcage.results.figures.figure import Figure, Found
from flexcage.results.frequencies import SOUGHT
from flexcage.results.row import SummaryRow
from flexcage.results.spectra import BAND, vibration_figures

if TYPE_CHECKING:
    import xarray

SENSORS = "Sensors"
MOST_CLIPPED = 1e-3  # of the samples, above which a run has a warning
_REACH = 0.4  # of the rate, up to which a signal is whole
_SHOWN = {"acceleration": "m/s^2", "displacement": "um", "torque": "N mm", "strain": "um/m"}


def sensor_rows(signals: xarray.Dataset, lines: Mapping[str, float]) -> tuple[SummaryRow, ...]:
    """RMS, kurtosis and crest factor of every signal but pulses; of accelerations the RMS in the
    band of envelopes, as far as the rate reaches, and the envelope at those of ``lines`` [Hz] where
    defects show."""
    rows: list[SummaryRow] = []
    for name, signal in signals.items():
        if signal.attrs["quantity"] in _SHOWN and signal.size >= FEWEST:
            rows += _rows(str(name), signal, lines)
    return tuple(rows)


def _rows(name: str, signal: xarray.DataArray, lines: Mapping[str, float]) -> Iterator[SummaryRow]:
    rate, shown = signal.attrs["rate"], _SHOWN[signal.attrs["quantity"]]
    band = (BAND[0], min(BAND[1], _REACH * rate))
    shaken = signal.attrs["quantity"] == "acceleration" and band[1] > 2.0 * band[0]
    wanted = {line: lines[line] for line in SOUGHT} if shaken else {}
    fits = band if shaken else (0.1 * rate, _REACH * rate)
    found = vibration_figures(signal, wanted, fits)
    titles = {"rms": ("RMS", shown), "kurtosis": ("kurtosis", ""), "crest": ("crest factor", "")}
    if shaken:
        titles["band rms"] = (f"RMS, {band[0] / 1e3:g} to {band[1] / 1e3:g} kHz", shown)
        titles["envelope floor"] = ("envelope, floor", shown)
        titles |= {f"envelope at {line}": (f"envelope at {line}", shown) for line in wanted}
    where = str(signal.attrs["long_name"]).partition(", ")[2]
    for key, (title, unit) in titles.items():
        word = key.lower().replace(" at ", "_").replace(" ", "_")
        note = where if key == "rms" else ""
        value = found[key] if isfinite(found[key]) else None
        figure = Figure(
            f"sensor_{name}_{word}", f"{name}, {title}", unit, "", SENSORS, lambda _: None
        )
        yield figure.row(Found(value, note))


def clipped(signals: xarray.Dataset) -> Iterator[RunWarning]:
    """A warning for every sensor that stood at the end of its range."""
    for name, signal in signals.items():
        share = signal.attrs.get("clipped", 0.0)
        if share > MOST_CLIPPED:
            most = float(abs(signal).max())
            yield RunWarning(
                "sensor_range",
                f"The sensor '{name}' stands at the end of its range of {most:.4g} "
                f"{signal.attrs['units']} in {100.0 * share:.2g} % of its samples; raise its "
                "range.",
            )
