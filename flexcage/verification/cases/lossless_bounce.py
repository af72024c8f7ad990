"""A cage thrown between turning rollers, without any loss: its energy stays."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from flexcage.core.errors import RunFailed
from flexcage.system.start import find_start
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.n1013 import LOSSLESS, bearing_of, march, n1013, throw_cage

SPEED, DIRECTION = 0.3, 0.4  # m/s, rad
IMPACTS = 10  # at least, of more than 1 N
TIGHT = {
    "solver.duration": "2 ms",
    "solver.tolerance": "0.00001 um",
    "solver.max_step": "5 us",
    "output.rate": "100 kHz",
    "output.vibration_rate": "200 kHz",
}
DRIFT = Tolerance(
    1e-3, "share of the throw's energy, demanded; falls with solver.tolerance", absolute=True
)
DRIVE = Tolerance(1e-6, "share of the throw's energy; nothing brakes the ring", absolute=True)


def rows() -> Iterator[Row]:
    for model in ("rigid", "flexible"):
        for land in ("none", "dry"):
            yield from thrown_rows(model, land)


def thrown_rows(model: str, land: str) -> Iterator[Row]:
    case = n1013(LOSSLESS, TIGHT, {"cage.model": model, "contacts.land.kind": land})
    bearing = bearing_of(case)
    start = find_start(bearing, limit_force=2e4)
    y, yd = start.y.copy(), start.yd.copy()
    throw_cage(bearing, y, yd, SPEED, DIRECTION)
    ds = march(case, bearing, y, yd)
    pressed = ds["pocket_force"].values > 1.0
    impacts = np.count_nonzero(pressed[1:] & ~pressed[:-1])
    if impacts < IMPACTS:
        raise RunFailed(f"the cage struck pockets only {impacts} times: energy was hardly tried")
    thrown = 0.5 * bearing.data.model.cage.mass * SPEED**2
    load = 1000.0 * ds["inner_position"].sel(axis="y")
    total = (ds["energy"].sum("energy_kind") - load).values
    name = f"{model} cage, {'dry lands' if land == 'dry' else 'no lands'}"
    drift = np.abs(total - total[0]).max() / thrown
    yield Row(f"{name}: energy lost or gained", "", 0.0, float(drift), DRIFT)
    driven = np.abs(ds["work"].sel(channel="drive").values).max() / thrown
    yield Row(f"{name}: work of the drive", "", 0.0, float(driven), DRIVE)


CASE = KnownAnswer(
    name="lossless_bounce",
    title="A cage that bounces without losses",
    source="conservation of energy: kinetic, strain and contact energy less the work of the load",
    checks="Elastic contacts without friction, no oil, no modal damping: a cage thrown at 0.3 m/s "
    "between rollers that turn at 6000 rpm under 1000 N strikes them ten times or more in 2 ms.",
    rows=rows,
    quick=False,
)
