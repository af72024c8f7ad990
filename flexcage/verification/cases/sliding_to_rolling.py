"""Rollers that slide along the outer race without spin until they roll."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from flexcage.system.start import find_start
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.n1013 import FRICTIONLESS, NO_OIL, bearing_of, march, n1013

MU = 0.1
# the cage weighs a millionth of the rollers, so that it neither drives nor brakes them
ALONE = {
    **FRICTIONLESS,
    **NO_OIL,
    "contacts.race.friction.law": "step_coulomb",
    "contacts.race.friction.static": MU,
    "contacts.race.friction.dynamic": MU,
    "contacts.race.friction.v_static": "1 mm/s",
    "contacts.race.friction.v_dynamic": "2 mm/s",
    "contacts.land.kind": "none",
    "load.radial": "0 N",
    "load.gravity": "0 m/s^2",
    "bearing.radial_clearance": "40 um",
    "cage.model": "rigid",
    "solver.duration": "20 ms",
}
LIGHT = 0.01  # kg/m^3
CREEP = Tolerance(5e-4, "the law creeps below 1 mm/s of 11.7 m/s; contact depth, 0.1 um of 41 mm")


def rows() -> Iterator[Row]:
    case = n1013(ALONE).replace("cage.material.density", LIGHT)
    bearing = bearing_of(case)
    start = find_start(bearing, limit_force=1.0)
    layout, y, yd = bearing.layout, start.y.copy(), start.yd.copy()
    u, rate = layout.u(y)["rollers"], layout.q(yd)["rollers"]
    u[:, 3] = 0.0  # no spin in space
    rate[:, 5] = -rate[:, 2]
    ds = march(case, bearing, y, yd)
    speed = ds["roller_velocity"].sel(cyl="psi").values
    spin = -ds["roller_omega"].sel(spin_axis="axial").values
    radius, time = float(ds["roller_position"].sel(cyl="r")[0, 0]), ds["time"].values
    first, size = float(u[0, 2]), 0.5 * case.bearing.roller_diameter
    rolling = radius / (2.0 * MU * first)  # when first/(1 + mu first t/r) is 2/3 of the first
    for share in (0.25, 0.5, 0.75):
        at = int(np.argmin(np.abs(time - share * rolling)))
        expected = first / (1.0 + MU * first * time[at] / radius)
        name = f"speed at {share:.0%} of the sliding"
        yield Row(name, "m/s", expected, speed[at].mean(), CREEP)
        name = f"surface speed of spin at {share:.0%} of the sliding"
        yield Row(name, "m/s", 2.0 * (first - expected), size * spin[at].mean(), CREEP)
    yield Row("speed when it rolls", "m/s", first / 1.5, speed[-1].mean(), CREEP)
    yield Row("surface speed of spin then", "m/s", first / 1.5, size * spin[-1].mean(), CREEP)
    lost = -float(ds["work"].sel(channel="race_friction")[-1])
    mass = case.bearing.roller_count * case.bearing.roller_mass
    yield Row("energy lost to friction", "J", mass * first**2 / 6.0, lost, CREEP)


CASE = KnownAnswer(
    name="sliding_to_rolling",
    title="A cylinder that slides until it rolls",
    source="closed form: dv/dt = -mu N/m with N = m v^2/r of a roller that runs along a race of "
    "radius r, so v = v0/(1 + mu v0 t/r), down to 2/3 v0 as on a plane",
    checks="All 22 rollers start at the epicyclic speed of 6000 rpm without spin and without load, "
    "friction 0.1 on the outer race: speed and spin on the way, at the end, and the energy lost.",
    rows=rows,
    quick=False,
)
