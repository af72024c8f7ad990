"""A whole bearing whose races grip: cage and rollers take the speeds of pure rolling."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from flexcage.verification.bearings import RPM
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.runs import FRICTIONLESS, NO_OIL, faster, n1013, run_of

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
    ds = run_of(n1013(ROLLING, drive, {"cage.model": model})).dataset
    ds = ds.isel(time=slice(round(0.3 * ds.sizes["time"]), None))
    cage = sense * float(ds["cage_omega"].sel(axis="x").mean())
    spin = -sense * ds["element_omega"].values[:, :, 0]
    loaded = ds["race_force"].values[:, :, 0] > 1.0
    yield Row(f"{name}: cage", "rpm", CAGE / RPM, cage / RPM, ROLLS)
    yield Row(f"{name}: spin, loaded", "rpm", SPIN / RPM, spin[loaded].mean() / RPM, ROLLS)
    yield Row(f"{name}: spin, all", "rpm", SPIN / RPM, spin.mean() / RPM, ROLLS)
    turned = (spin.mean() + cage) / RPM
    yield Row(f"{name}: spin in the cage", "rpm", IN_CAGE / RPM, turned, ROLLS)


def caught_rows() -> Iterator[Row]:
    """The most loaded roller at the end of 4 ms, of which the ring took 1 ms to speed up by 3 %."""
    fine = {"output.vibration_rate": "500 kHz", "output.rate": "500 kHz"}
    ramp = faster(0.97, 6000.0, "1 ms")
    case = n1013(ROLLING, fine, ramp, {"cage.model": "rigid", "solver.duration": "4 ms"})
    ds = run_of(case).dataset
    loaded = int(np.argmax(ds["race_force"].sel(race="inner").mean("time").values))
    end = ds.isel(time=slice(-400, None), element=loaded)
    found = (end["element_velocity"].sel(cyl="psi") / end["element_position"].sel(cyl="r")).mean()
    yield Row("ring speeds up: orbit", "rpm", CAGE / RPM, float(found) / RPM, ROLLS)
    turning = -float(end["element_omega"].sel(spin_axis="axial").mean())
    yield Row("ring speeds up: spin", "rpm", SPIN / RPM, turning / RPM, ROLLS)


def rows() -> Iterator[Row]:
    yield from speed_rows("rigid cage", "rigid", 1.0)
    yield from speed_rows("rigid cage, reversed", "rigid", -1.0)
    yield from speed_rows("flexible cage", "flexible", 1.0)
    yield from caught_rows()


CASE: KnownAnswer = KnownAnswer(
    name="epicyclic_run",
    title="Epicyclic run of an N1013",
    source="speeds of pure rolling as in `kinematics`",
    checks="6000 rpm and 1000 N, traction of 0.3, no resistance and no friction on the cage: cage "
    "and rollers come to the epicyclic speeds, forwards and backwards, with a rigid and a flexible "
    "cage; a loaded roller follows a ring that speeds up by 3 %.",
    rows=rows,
    quick=False,
)
