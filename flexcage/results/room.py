"""Room on the disk that a run's results will take: said before it begins."""

from __future__ import annotations

import logging
import shutil
from pathlib import Path

import numpy as np

from flexcage.core.errors import EnvironmentLacks
from flexcage.core.memory import in_bytes
from flexcage.results.layout import Layout

log = logging.getLogger(__name__)

_WORTH_SAYING = 100e6  # bytes; a run of 0.1 s of motion has half of it
# share of their size in memory that results take on disk, measured on an N1013 at 6000 rpm, and
# for its modes and the loads at steps between samples what a flexible cage adds
_RIGID, _FLEXIBLE = 0.06, 0.095
_SURELY = 0.5  # of an estimate, for runs differ


def expected_rate(layout: Layout, rate: float, vibration_rate: float) -> float:
    """Bytes on disk for a second of bearing time, by what a layout records."""
    found = 0.0
    for v in layout.variables:
        sample = np.prod(layout.shape(v)[1:], dtype=float) * np.dtype(v.dtype).itemsize
        found += sample * (rate if v.dims[0] == "time" else vibration_rate)
    flexible = any("mode" in v.dims for v in layout.variables)
    return found * (_FLEXIBLE if flexible else _RIGID)


def announce(folder: Path, rate: float, duration: float) -> None:
    """Say how much room results will take in ``folder`` at ``rate`` [bytes/s] for ``duration`` [s].

    Warns where it may not be enough, and raises EnvironmentLacks where it cannot be.
    """
    size = rate * duration
    place = next(path for path in (folder, *folder.resolve().parents) if path.exists())
    free = float(shutil.disk_usage(place).free)
    text = (
        f"the results need about {in_bytes(size)} ({in_bytes(rate)} for a second of bearing time), "
        f"and '{folder}' has {in_bytes(free)} left"
    )
    remedy = "shorten solver.duration, lower output.rate, or name a folder on another disk"
    if _SURELY * size > free:
        raise EnvironmentLacks(f"{text[0].upper()}{text[1:]}: {remedy}.")
    if size > free:
        log.warning("%s, which may be too little: %s", text, remedy)
    elif size > _WORTH_SAYING:
        log.info("%s", text)
