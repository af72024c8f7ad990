"""A whole bearing whose races grip: cage and rollers take the speeds of pure rolling."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

import numpy as np

from flexcage.results import metrics
from flexcage.results.slip import cage_speed
from flexcage.simulate import simulate
from flexcage.system.start import find_start
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.n1013 import FRICTIONLESS, NO_OIL, bearing_of, march, n1013

RPM = np.pi / 30.0
CAGE, SPIN, IN_CAGE = 2709.0909 * RPM, 27937.5 * RPM, 30646.59 * RPM
ROLLING = {
    **FRICTIONLESS,
    **NO_OIL,
    "contacts.race.friction.law": "traction",
    "contacts.race.friction.peak": 0.3,
    "contacts.race.friction.high_speed": 0.29,
    "contacts.race.friction.peak_speed": "0.01 m/s",
    "contacts.land.kind": "none",
    "load.gravity": "0 m/s^2",
}
ROLLS = Tolerance(5e-4, "demanded; a regularised law leaves some creep")


def speed_rows(name: str, model: str, sense: float) -> Iterator[Row]:
    """20 ms of a run, the last 14 of which count; rollers with and without load."""
    drive = {"drive.speed": f"{6000 * sense:g} rpm", "solver.duration": "20 ms"}
    run = simulate(n1013(ROLLING, drive, {"cage.model": model}))
    ds = metrics.settled(run.dataset, 0.3)
    cage = sense * cage_speed(ds, run.numbers).mean
    spin = -sense * ds["element_omega"].values[:, :, 0]
    loaded = ds["race_force"].values[:, :, 0] > 1.0
    yield Row(f"{name}: cage", "rpm", CAGE / RPM, cage / RPM, ROLLS)
    yield Row(f"{name}: spin, loaded", "rpm", SPIN / RPM, spin[loaded].mean() / RPM, ROLLS)
    yield Row(f"{name}: spin, all", "rpm", SPIN / RPM, spin.mean() / RPM, ROLLS)
    turned = (spin.mean() + cage) / RPM
    yield Row(f"{name}: spin in the cage", "rpm", IN_CAGE / RPM, turned, ROLLS)


def caught_rows() -> Iterator[Row]:
    """The most loaded roller, started 2 % slow in orbit and 3 % in spin, at the end of 3 ms."""
    fine = {"output.vibration_rate": "500 kHz", "output.rate": "500 kHz"}
    case = n1013(ROLLING, fine, {"cage.model": "rigid", "solver.duration": "3 ms"})
    bearing = bearing_of(case)
    start = find_start(bearing, limit_force=2e4)
    layout, y, yd = bearing.layout, start.y.copy(), start.yd.copy()
    orbit, spin = 0.98 * CAGE, -0.97 * SPIN
    u, rate = layout.u(y)["elements"], layout.q(yd)["elements"]
    u[0, 2], u[0, 3] = orbit * layout.q(y)["elements"][0, 1], spin
    rate[0, 2], rate[0, 5] = orbit, spin - orbit
    end: Any = march(case, bearing, y, yd).isel(time=slice(-400, None), element=0)
    found = (end["element_velocity"].sel(cyl="psi") / end["element_position"].sel(cyl="r")).mean()
    yield Row("started slow: orbit", "rpm", CAGE / RPM, float(found) / RPM, ROLLS)
    turning = -float(end["element_omega"].sel(spin_axis="axial").mean())
    yield Row("started slow: spin", "rpm", SPIN / RPM, turning / RPM, ROLLS)


def rows() -> Iterator[Row]:
    yield from speed_rows("rigid cage", "rigid", 1.0)
    yield from speed_rows("rigid cage, reversed", "rigid", -1.0)
    yield from speed_rows("flexible cage", "flexible", 1.0)
    yield from caught_rows()


CASE = KnownAnswer(
    name="epicyclic_run",
    title="Epicyclic run of an N1013",
    source="speeds of pure rolling as in `kinematics`",
    checks="6000 rpm and 1000 N, traction of 0.3, no resistance and no friction on the cage: cage "
    "and rollers come to the epicyclic speeds, forwards and backwards, with a rigid and a flexible "
    "cage; a roller that starts slow finds them.",
    rows=rows,
    quick=False,
)
