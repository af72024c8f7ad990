"""The signals of a run's sensors, labelled: values, and what a reader of them must know."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from types import MappingProxyType
from typing import TYPE_CHECKING, Any
from zlib import crc32

import numpy as np

from flexcage.core.errors import InputError
from flexcage.results.evenly import FEWEST
from flexcage.results.signals.chain import measured, ratio
from flexcage.results.signals.sources import grid_of, seen
from flexcage.results.signals.spec import Sensor, Tacho

if TYPE_CHECKING:
    import xarray

    from flexcage.geometry.cage import Cage


def signals_of(
    ds: xarray.Dataset,
    sensors: Sequence[Sensor],
    *,
    cage: Cage | None = None,
    settle: float = 0.0,
    attrs: Mapping[str, Any] | None = None,
    computed: Mapping[str, np.ndarray] = MappingProxyType({}),
) -> xarray.Dataset:
    """Signals of the sensors of a run, by their names, without the share ``settle`` of its start.

    All of one rate have the dimension ``time`` [s, of the run]; of several rates each has its own,
    as ``time_48000Hz``. ``computed`` are values, by name, of sensors that see more than the dataset
    has, on the grid of ``sources.grid_of``. ``attrs`` of a signal: ``units``, ``quantity``,
    ``place``, ``direction`` [deg] or in a word, ``rate`` [Hz], and the share of samples at the end
    of its range, ``clipped``.
    InputError for no sensors, and for a run too short for a signal.
    """
    import xarray

    if not sensors:
        raise InputError(
            "The case has no sensors; give [[sensors]], as in examples/signals.md, or those of "
            "another file (--sensors FILE; in Python, run.signals_of).",
            where="sensors",
        )
    found = {s.name: _signal(ds, s, cage, settle, computed.get(s.name)) for s in sensors}
    several = len({(t[0], len(t), rate) for t, rate, _ in found.values()}) > 1
    variables, coords = {}, {}
    for sensor in sensors:
        t, rate, values = found[sensor.name]
        dim = f"time_{rate:.10g}Hz".replace(".", "p") if several else "time"
        coords[dim] = (dim, t, {"units": "s", "long_name": "time of the run"})
        variables[sensor.name] = (dim, values, _attrs(sensor, rate, values))
    return xarray.Dataset(variables, coords, dict(attrs or {}))


def _signal(
    ds: xarray.Dataset,
    sensor: Sensor,
    cage: Cage | None,
    settle: float,
    computed: np.ndarray | None,
) -> tuple[np.ndarray, float, np.ndarray]:
    """Instants (m,), rate [Hz] and values (m,) of a signal, of values (n,) ``computed`` on the
    run's grid, or of what the sensor sees in the dataset."""
    grid = grid_of(sensor)
    t = ds[grid].values
    if len(t) < FEWEST:
        raise InputError(
            f"The run holds {len(t)} samples of what the sensor '{sensor.name}' sees, too few for "
            "a signal; raise solver.duration.",
            where="solver.duration",
            value=len(t),
        )
    rate = float(f"{(len(t) - 1) / (t[-1] - t[0]):.12g}")
    own = sensor.rate or rate
    source = seen(ds, sensor, cage) if computed is None else computed
    count = int((len(t) - 1) * ratio(rate, own)) + 1
    instants = t[0] + np.arange(count) / own
    if isinstance(sensor, Tacho):
        values = (np.interp(instants, t, source) % 1.0 < 0.5).astype(float)
    else:
        values = measured(source, rate, sensor, crc32(sensor.name.encode()))
    begin = int(np.searchsorted(instants, t[0] + settle * (t[-1] - t[0]) - 1e-12))
    begin = min(begin, count - 1)  # one sample at least
    return instants[begin:], own, values[begin:]


def _attrs(sensor: Sensor, rate: float, values: np.ndarray) -> dict[str, Any]:
    attrs = {
        "units": sensor.unit, "quantity": sensor.quantity, "sensor": sensor.type,
        "place": sensor.place, "direction": sensor.towards, "rate": rate,
        "long_name": f"{sensor.quantity}, {sensor.type} at {sensor.place.replace('_', ' ')}",
        "noise": sensor.noise, "range": sensor.range, "bits": sensor.bits, "seed": sensor.seed,
    }  # fmt: skip
    if sensor.range:
        step = 2.0 * sensor.range / 2**sensor.bits if sensor.bits else 0.0
        attrs["clipped"] = float(np.mean((values >= sensor.range - 1.5 * step)
                                         | (values <= -sensor.range)))  # fmt: skip
    return attrs
