"""Room on the disk that results will take: said before they are computed."""

from __future__ import annotations

import logging
import shutil
from pathlib import Path

import numpy as np

from flexcage.core.errors import EnvironmentLacks
from flexcage.core.memory import in_bytes
from flexcage.results.layout import StoreLayout

log = logging.getLogger(__name__)

_WORTH_SAYING = 100e6  # bytes; a run of 0.1 s of motion has half of it
# share of their size in memory that variables take on disk: of each element, those along its
# contacts, of which few are loaded, those of rings and cage, and accelerations. Measured on
# an N1013 at 600 and 6000 rpm, a 7010C and a 6205, within a factor of 1.5 of their folders
_OF_ELEMENTS, _ALONG, _OF_BODIES, _FINE = 0.23, 0.013, 0.45, 0.37
_ALONG_DIMS = {"slice", "station", "end_point", "land_station", "residual"}
# bytes for a second of bearing time: steps and events, and the loads of a flexible cage between
# samples; and of each run: summary, tables and cage
_STEPS = {False: 5e6, True: 25e6}
_FIXED_SIZE = {False: 0.25e6, True: 1.5e6}
_SURELY = 0.5  # of an estimate, for runs differ


def expected_rate(
    layout: StoreLayout, rate: float, vibration_rate: float, *, flexible: bool
) -> float:
    """Bytes on disk for a second of bearing time, by what a layout records; modes may be left out
    of it, which take little."""
    found = _STEPS[flexible]
    for v in layout.variables:
        sample = np.prod(layout.shape(v)[1:], dtype=float) * np.dtype(v.dtype).itemsize
        found += _share(v.dims) * sample * (rate if v.dims[0] == "time" else vibration_rate)
    return found


def _share(dims: tuple[str, ...]) -> float:
    """Which part of a variable's size in memory is on disk."""
    if dims[0] != "time":
        return _FINE
    if _ALONG_DIMS.intersection(dims):
        return _ALONG
    return _OF_ELEMENTS if {"element", "pocket"}.intersection(dims) else _OF_BODIES


def expected_size(rate: float, duration: float, *, flexible: bool) -> float:
    """Bytes of a run's folder, without pictures, at ``rate`` [bytes/s] for ``duration`` [s]."""
    return rate * duration + _FIXED_SIZE[flexible]


def free_bytes(folder: Path) -> float:
    """Bytes that are free where a folder is, or will be."""
    place = next(path for path in (folder, *folder.resolve().parents) if path.exists())
    return float(shutil.disk_usage(place).free)


def announce(folder: Path, size: float, what: str, remedy: str, *, quiet: bool = False) -> None:
    """Say that ``what``, as "the results need", takes ``size`` bytes in ``folder``; ``remedy`` says
    what would be enough.

    Warns where it may not fit, and raises EnvironmentLacks where it cannot; ``quiet``: does that
    alone.
    """
    free = free_bytes(folder)
    text = f"{what} about {in_bytes(size)}, and '{folder}' has {in_bytes(free)} left"
    if _SURELY * size > free:
        raise EnvironmentLacks(f"{text[0].upper()}{text[1:]}: {remedy}.")
    if quiet:
        return
    if size > free:
        log.warning("%s, which may be too little: %s", text, remedy)
    elif size > _WORTH_SAYING:
        log.info("%s", text)
