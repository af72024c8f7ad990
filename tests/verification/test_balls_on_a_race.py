"""Balls that strike the outer groove, and balls that slide along it until they roll.

All balls of a 7010C fly at 0.5 m/s against the bottom of the outer groove and come back. All balls
orbit at 200 rad/s without spin and without load, friction 0.1 on the outer race: speed and spin on
the way and at the end. Balls pressed on the inner race by 255 N turn as if they rolled at 13.37
m/s: what the oil of 20 mPa s does to them.

Source: closed form: depth (5 m v^2/(4 K))^(2/5) of an elastic Hertz impact; along a race of radius
r, with N = m v^2/r, a sphere's v = v0/(1 + mu v0 t/r), down to 5/7 v0; rolling resistance of L.
Houpert as in `rolling_resistance`, which takes 2 F u from ball and race.
"""

from __future__ import annotations

from collections.abc import Iterator
from math import cos, radians

import numpy as np
from c7010_states import balls_on_outer, bearing_of
from known_rows import check
from marching import march

from flexcage.compiling import build_bearing
from flexcage.core.errors import RunFailed
from flexcage.stages import cage_mesh
from flexcage.system.data import POWERS
from flexcage.verification import Row, Tolerance
from flexcage.verification.runs import ELASTIC, NO_OIL, SMOOTH, c7010

SPEED, GAP = 0.5, 2e-6  # m/s outwards, m
FLIGHT = {
    "drive.speed": "0 rpm",
    "load.axial": "0 N",
    "solver.duration": "80 us",
    "solver.tolerance": "0.00001 um",
    "output.rate": "5 MHz",
    "output.vibration_rate": "5 MHz",
}
MU, ORBIT = 0.1, 200.0  # friction of the outer race; rad/s of the balls' orbit
SLIDE = {
    "drive.speed": "0 rpm",
    "load.axial": "0 N",
    "contacts.race.friction.law": "step_coulomb",
    "contacts.race.friction.static": MU,
    "contacts.race.friction.dynamic": MU,
    "contacts.race.friction.v_static": "0.001 m/s",
    "contacts.race.friction.v_dynamic": "0.002 m/s",
    "contacts.pocket.friction.law": "none",
    "cage.material.density": "1e-3 kg/m^3",  # or it would push the balls along
    "solver.duration": "25 ms",
    "output.rate": "20 kHz",
    "output.vibration_rate": "20 kHz",
}
OILED = {
    "bearing.preset": "7010C-PA66",
    "drive.speed": "0 rpm",
    "load.axial": "0 N",
    "lubricant.viscosity": "0.02 Pa*s",
    "lubricant.pressure_coefficient": "20 1/GPa",
}
PRESSED, ROLLING = 255.0, 13.37  # N on the inner race, m/s of entrainment
RADIUS = 4.365e-3 * (1.0 - 8.73 / 64.94 * cos(radians(15.0)))  # of ball and inner race [m]
FORCE = 0.1435  # N, Houpert's on one surface
PRINTED = Tolerance(1e-4, "printed to four digits")
STEPS = Tolerance(1e-3, "the solver's step and tolerance in a contact of 40 us")
CREEP = Tolerance(2e-3, "friction of 1 mm/s creep, and differential slip across the groove")


def impact_rows() -> Iterator[Row]:
    for e in (1.0, 0.7):
        law = ELASTIC if e == 1.0 else {"contacts.race.normal.restitution": e}
        case = c7010(SMOOTH, NO_OIL, FLIGHT, law)
        bearing = bearing_of(case)
        y, yd = balls_on_outer(bearing)
        bearing.layout.q(y)["elements"][:, 1] -= GAP
        for part in (bearing.layout.u(y), bearing.layout.q(yd)):
            part["elements"][:, 1] = SPEED
        ds = march(case, bearing, y, yd).isel(element=0)
        back = -float(ds["element_velocity"].sel(cyl="r").min())  # before it meets the inner race
        yield Row(f"restitution {e:g}: speed back", "m/s", e * SPEED, back, STEPS)
        if e == 1.0:
            model = bearing.data.model
            K, mass = model.outer.normal[0], model.bodies.element[0]
            depth = (1.25 * mass * SPEED**2 / K) ** 0.4
            force = ds["race_force"].sel(race="outer").values
            yield Row("elastic: largest force", "N", K * depth**1.5, float(force.max()), STEPS)


def sliding_rows() -> Iterator[Row]:
    case = c7010(NO_OIL, SLIDE)
    bearing = bearing_of(case)
    y, yd = balls_on_outer(bearing)
    u, rate = bearing.layout.u(y), bearing.layout.q(yd)
    radius = float(bearing.layout.q(y)["elements"][0, 1])
    first = radius * ORBIT
    u["elements"][:, 2], rate["elements"][:, 2] = first, ORBIT
    u["omega"][0], rate["quaternion"][1] = ORBIT, 0.5 * ORBIT
    ds = march(case, bearing, y, yd)
    if float(ds["race_force"].sel(race="inner").max()) > 0.0:
        raise RunFailed("a ball touched the inner race: the closed form is not tried")
    speed = ds["element_velocity"].sel(cyl="psi").mean("element").values
    spin = -ds["element_omega"].sel(spin_axis="axial").mean("element").values
    time, size = ds["time"].values, 0.5 * case.bearing.element_diameter
    rolling = 0.4 * radius / (MU * first)  # when first/(1 + mu first t/r) is 5/7 of the first
    for share in (0.25, 0.5, 0.75):
        at = int(np.argmin(np.abs(time - share * rolling)))
        expected = first / (1.0 + MU * first * time[at] / radius)
        yield Row(f"speed at {share:.0%} of the sliding", "m/s", expected, speed[at], CREEP)
        yield Row(f"surface speed of spin at {share:.0%} of the sliding", "m/s",
                  2.5 * (first - expected), size * spin[at], CREEP)  # fmt: skip
    yield Row("speed when it rolls", "m/s", first / 1.4, speed[-1], CREEP)
    yield Row("surface speed of spin then", "m/s", first / 1.4, size * spin[-1], CREEP)


def resistance_rows() -> Iterator[Row]:
    """Balls pressed on the inner race that turn on the spot, without friction: oil alone acts."""
    case = c7010(SMOOTH, ELASTIC, OILED)
    bearing = build_bearing(case, cage_mesh(case), None)
    model, layout = bearing.data.model, bearing.layout
    y, yd = balls_on_outer(bearing)
    depth = (PRESSED / model.inner.normal[0]) ** (2.0 / 3.0)
    bottom = model.inner.centre - model.inner.radius
    layout.q(y)["elements"][:, 1] = bottom + model.bodies.radius - depth
    for part in (layout.u(y), layout.q(yd)):
        part["elements"][:, 3] = ROLLING / RADIUS
    moment = layout.u(bearing.residual(0.0, y, yd, 2))["elements"][0, 3]
    yield Row("moment of rolling resistance on a ball", "N mm",
              2e3 * FORCE * RADIUS, 1e3 * float(moment), PRINTED)  # fmt: skip
    power = dict(zip(POWERS, bearing.data.work.report.power))["rolling_resistance"]
    lost = -float(power) / len(model.bodies.radius)
    yield Row("power that a ball and its race lose", "W", 2.0 * FORCE * ROLLING, lost, PRINTED)


def test_impacts():
    check(impact_rows())


def test_sliding_until_they_roll():
    check(sliding_rows())


def test_rolling_resistance():
    check(resistance_rows())
