"""How a variable over time becomes one number, and variables that follow from recorded ones."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from math import sqrt
from types import MappingProxyType
from typing import TYPE_CHECKING

import numpy as np
from scipy.special import stdtrit

from flexcage.results import metrics
from flexcage.results.bootstrap import CONFIDENCE
from flexcage.results.each_cage import one_cage
from flexcage.results.registry import TIME, Variable
from flexcage.results.slip import BearingNumbers, element_slip_ratio
from flexcage.results.statistics import Record, Windows

if TYPE_CHECKING:
    import xarray

FEWEST_TURNS = 5  # of the cage, below which their spread gives no margin
LINE = 2  # bins of a Hann window's spectrum on either side of a line that belong to it


@dataclass(frozen=True)
class Reducer:
    """``value`` of samples (n, ...) evenly taken every ``step`` seconds, in ``unit`` (None: the
    variable's). ``record`` gives it by windows of a roller pass, from which its margin follows;
    ``by_turns`` says that its values of single turns of the cage do; ``of_turns``, that it is the
    mean of these values. ``series`` says that it needs one series (n,).
    """

    value: Callable[[np.ndarray, float], float]
    unit: str | None = None
    record: Callable[[Windows, np.ndarray], Record] | None = None
    series: bool = False
    by_turns: bool = False
    of_turns: bool = False

    def over_turns(self, x: np.ndarray, step: float, turns: int) -> float:
        """The value of ``x`` (n, ...), which holds ``turns`` of the cage (at least one)."""
        if not self.of_turns:
            return self.value(x, step)
        parts = np.array_split(x, max(turns, 1))
        return float(np.mean([self.value(part, step) for part in parts]))

    def margin_by_turns(self, x: np.ndarray, step: float, turns: int) -> float:
        """Half the width of the 95 % interval by Student's t over the values of single turns of
        ``x`` (n, ...), which holds ``turns`` of them; NaN for fewer than ``FEWEST_TURNS``.
        """
        if turns < FEWEST_TURNS:
            return float("nan")
        values = np.array([self.value(part, step) for part in np.array_split(x, turns)])
        t = float(stdtrit(turns - 1, 0.5 * (1.0 + CONFIDENCE)))
        return t * float(values.std(ddof=1)) / sqrt(turns)


def kurtosis(x: np.ndarray) -> float:
    """Fourth central moment over the square of the variance: 3 for a Gaussian signal, more for
    one with spikes."""
    away = np.asarray(x, float) - np.mean(x, dtype=float)
    return float(np.mean(away**4) / np.mean(away**2) ** 2)


def crest_factor(x: np.ndarray) -> float:
    """Largest departure from the mean over the standard deviation."""
    away = np.asarray(x, float) - np.mean(x, dtype=float)
    return float(np.abs(away).max() / away.std())


def main_line(x: np.ndarray, step: float) -> tuple[float, float]:
    """Frequency [Hz] of the strongest line of ``x`` (n,), and its share of the variance (0 .. 1).

    A pure sine has the share 1, noise about (2 LINE + 1)/n times a few.
    """
    frequency, power = _power(x, step)
    top = 1 + int(np.argmax(power[1:]))
    line = power[max(top - LINE, 1) : top + LINE + 1]
    return float(frequency[top]), float(line.sum() / power[1:].sum())


def mean_frequency(x: np.ndarray, step: float) -> float:
    """Centre of gravity of the power spectrum of ``x`` (n,) [Hz]."""
    frequency, power = _power(x, step)
    return float(frequency @ power / power.sum())


def _power(x: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies [Hz] and power of ``x`` (n,) about its mean, under a Hann window."""
    away = np.asarray(x, float) - np.mean(x, dtype=float)
    spectrum = np.fft.rfft(away * np.hanning(len(away)))
    return np.fft.rfftfreq(len(away), step), np.abs(spectrum) ** 2


def _over_rest(windows: Windows, x: np.ndarray) -> Record:
    return windows.mean(np.asarray(x, float).reshape(len(x), -1).mean(axis=1))


def _ripple(x: np.ndarray, step: float) -> float:
    return float(np.std(x) / abs(np.mean(x)))


REDUCTIONS: Mapping[str, Reducer] = MappingProxyType(
    {
        "mean": Reducer(lambda x, step: float(np.mean(x)), record=_over_rest),
        "min": Reducer(lambda x, step: float(np.min(x))),
        "max": Reducer(lambda x, step: float(np.max(x))),
        "turn_max": Reducer(lambda x, step: float(np.max(x)), by_turns=True, of_turns=True),
        "range": Reducer(lambda x, step: float(np.ptp(x))),
        "std": Reducer(lambda x, step: float(np.std(x)), by_turns=True),
        "rms": Reducer(lambda x, step: float(np.sqrt(np.mean(np.square(x)))), by_turns=True),
        "ripple": Reducer(_ripple, "1", lambda w, x: w.deviation(np.asarray(x, float)), True),
        "kurtosis": Reducer(lambda x, step: kurtosis(x), "1", series=True, by_turns=True),
        "crest": Reducer(lambda x, step: crest_factor(x), "1", series=True),
        "frequency": Reducer(lambda x, step: main_line(x, step)[0], "Hz", series=True),
        "line_share": Reducer(lambda x, step: main_line(x, step)[1], "1", series=True),
        "mean_frequency": Reducer(mean_frequency, "Hz", series=True, by_turns=True),
    }
)


@dataclass(frozen=True)
class Derived:
    """A variable that follows from recorded ones: what it is, and how it is computed."""

    variable: Variable
    compute: Callable[[xarray.Dataset, BearingNumbers], xarray.DataArray]


def _over_time(values: np.ndarray, ds: xarray.Dataset) -> xarray.DataArray:
    import xarray as xr

    return xr.DataArray(values, dims=(TIME,), coords={TIME: ds[TIME]})


#: Variables that a study may reduce beside the recorded ones, by name.
DERIVED: Mapping[str, Derived] = MappingProxyType(
    {
        "element_slip_ratio": Derived(
            Variable(
                "element_slip_ratio",
                (TIME, "element"),
                "1",
                "slip ratio (n_th - n)/n_th of an element, as the summary takes it",
            ),
            element_slip_ratio,
        ),
        "cage_whirl_radius": Derived(
            Variable(
                "cage_whirl_radius",
                (TIME,),
                "m",
                "distance of the cage centre from its orbit's mean",
                of_cage=True,
            ),
            lambda ds, bearing: _over_time(metrics.whirl_radius(one_cage(ds, 0)), ds),
        ),
        "cage_radial_displacement": Derived(
            Variable(
                "cage_radial_displacement",
                (TIME,),
                "m",
                "distance of the cage centre from the outer ring's axis",
                of_cage=True,
            ),
            lambda ds, bearing: _over_time(metrics.whirl_radius(one_cage(ds, 0), about="axis"), ds),
        ),
    }
)
