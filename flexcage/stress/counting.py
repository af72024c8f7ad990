"""Rainflow counting, mean stress and damage, all by pyLife; no other module imports it.

pyLife is the extra ``fatigue``. It is imported when first needed: it loads pandas and takes some
seconds.
"""

from __future__ import annotations

import importlib.util
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from flexcage.core.errors import package_lacks
from flexcage.stress.sn_curves import SNCurve


@dataclass(frozen=True)
class Loops:
    """Closed stress cycles, all (n,): ends [Pa], and the sample at which each begins."""

    low: np.ndarray
    high: np.ndarray
    sample: np.ndarray

    def __len__(self) -> int:
        return len(self.low)


def require_pylife() -> None:
    """Raise EnvironmentLacks, which says what to install, unless pyLife is there."""
    if importlib.util.find_spec("pylife") is None:
        raise package_lacks("Fatigue is counted", "pyLife", extra="fatigue", pip="pylife")


def count(stress: np.ndarray) -> Loops:
    """Rainflow cycles of one stress history (nt,) [Pa] that repeats itself for ever.

    The history is turned to begin at its largest value and closed with it, so that four-point
    counting leaves exactly one cycle over, that of the whole range (ASTM E1049-85, 5.4.5). Where
    end and beginning of the record meet there may be one cycle that the motion does not have.
    """
    require_pylife()
    import pylife.stress.rainflow as rainflow

    n, first = len(stress), int(np.argmax(stress))
    closed = np.append(np.roll(stress, -first), stress[first]).astype(float)
    detector = rainflow.FourPointDetector(recorder=rainflow.FullRecorder())
    detector.process(closed)
    recorder = detector.recorder
    ends = np.stack([recorder.values_from, recorder.values_to])
    begin = np.asarray(recorder.index_from, int)
    low, high = np.append(ends.min(axis=0), closed.min()), np.append(ends.max(axis=0), closed[0])
    moving = high > low
    return Loops(low[moving], high[moving], ((np.append(begin, 0) + first) % n)[moving])


def corrected_amplitude(low: np.ndarray, high: np.ndarray, sensitivity: float) -> np.ndarray:
    """Amplitudes (n,) [Pa] at R = -1 as bad as cycles from ``low`` to ``high`` (n,) [Pa].

    Haigh diagram of the FKM guideline: slope M = ``sensitivity`` up to R = 0, a third of it
    beyond, and none for cycles of compression alone.
    """
    if not len(low):
        return np.zeros(0)
    require_pylife()
    import pandas as pd
    from pylife.strength.meanstress import HaighDiagram

    cycles = pd.DataFrame({"range": high - low, "mean": 0.5 * (high + low)})
    diagram = HaighDiagram.fkm_goodman(pd.Series({"M": sensitivity}))
    return 0.5 * diagram.transform(cycles, -1.0)["range"].to_numpy()


def damage(amplitude: np.ndarray, curve: SNCurve) -> np.ndarray:
    """Damage (n,) of one cycle each of ``amplitude`` (n,) [Pa] at R = -1, by Miner's elementary
    rule: the line goes on below any endurance limit."""
    if not len(amplitude):
        return np.zeros(0)
    accessor: Any = _woehler(curve).fatigue.miner_elementary()
    return 1.0 / np.asarray(accessor.cycles(amplitude))


def equivalent_amplitude(damages: np.ndarray, curve: SNCurve) -> np.ndarray:
    """Amplitudes (n,) [Pa] at R = -1 whose one cycle does these damages (n,)."""
    accessor: Any = _woehler(curve).fatigue.miner_elementary()
    with np.errstate(divide="ignore"):
        return np.asarray(accessor.load(1.0 / damages))


def _woehler(curve: SNCurve) -> Any:
    """The curve as the series that pyLife's accessors want."""
    require_pylife()
    import pandas as pd
    import pylife.strength.fatigue  # noqa: F401  (registers the accessor)

    return pd.Series({"k_1": curve.slope, "ND": curve.cycles, "SD": curve.amplitude})


def joined(histories: Sequence[Loops]) -> tuple[np.ndarray, np.ndarray]:
    """Ends (n,) of the cycles of several histories, one after the other."""
    return (
        np.concatenate([loops.low for loops in histories]),
        np.concatenate([loops.high for loops in histories]),
    )
