"""Rollers that slide along the outer race without spin until they roll.

The friction law on a plane (1 m/s, mu 0.1). In a bearing all 22 rollers start at the epicyclic
speed of 6000 rpm without spin and without load, friction 0.1 on the outer race: speed and spin on
the way, at the end, and the energy lost.

Source: closed form on a plane: sliding ends at v0/(3 mu g), 2/3 v0 (cylinder), 2 v0/(7 mu g), 5/7
v0 (sphere). Along a race of radius r, with N = m v^2/r: v = v0/(1 + mu v0 t/r), down to 2/3 v0.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
from known_rows import check
from law_values import coefficient
from marching import march
from n1013_states import bearing_of
from scipy.integrate import solve_ivp

from flexcage.contacts import laws
from flexcage.contacts.spec import FrictionLaw
from flexcage.system.start import find_start
from flexcage.verification import Row, Tolerance
from flexcage.verification.runs import FRICTIONLESS, NO_OIL, n1013

MU, GRAVITY = 0.1, 9.80665
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
LAW = Tolerance(4e-6, "printed to 1e-6; the law creeps below 1 um/s of 1 m/s")
CREEP = Tolerance(5e-4, "the law creeps below 1 mm/s of 11.7 m/s; contact depth, 0.1 um of 41 mm")


def end_of_sliding(inertia: float) -> tuple[float, float]:
    """Time [s] and speed [m/s] at which a round body on a plane stops sliding.

    It starts at 1 m/s without spin; ``inertia`` over m R^2. The friction law reaches its full
    coefficient at 1 um/s.
    """
    spec = FrictionLaw(law="step_coulomb", static=MU, dynamic=MU, v_static=1e-6, v_dynamic=2e-6)
    p = laws.friction_parameters(spec)

    def slide(t: float, y: np.ndarray) -> float:
        return y[0] - y[1] - 2e-6

    slide.terminal = True  # type: ignore[attr-defined]

    def rate(t: float, y: np.ndarray) -> list[float]:
        push = GRAVITY * float(coefficient(laws.step_coulomb, p, [max(y[0] - y[1], 0.0)])[0])
        return [-push, push / inertia]

    out = solve_ivp(rate, (0.0, 1.0), [1.0, 0.0], rtol=1e-10, atol=1e-12, events=slide)
    return float(out.t[-1]), float(out.y[0, -1])


def plane_rows() -> Iterator[Row]:
    for body, inertia, time, speed in (
        ("cylinder", 0.5, 0.339905, 2.0 / 3.0),
        ("sphere", 0.4, 0.291347, 5.0 / 7.0),
    ):
        found = end_of_sliding(inertia)
        yield Row(f"{body} on a plane, time of sliding", "s", time, found[0], LAW)
        yield Row(f"{body} on a plane, speed then", "m/s", speed, found[1], LAW)


def race_rows() -> Iterator[Row]:
    case = n1013(ALONE).replace("cage.material.density", LIGHT)
    bearing = bearing_of(case)
    start = find_start(bearing, limit_force=1.0)
    layout, y, yd = bearing.layout, start.y.copy(), start.yd.copy()
    u, rate = layout.u(y)["elements"], layout.q(yd)["elements"]
    u[:, 3] = 0.0  # no spin in space
    rate[:, 5] = -rate[:, 2]
    ds = march(case, bearing, y, yd)
    speed = ds["element_velocity"].sel(cyl="psi").values
    spin = -ds["element_omega"].sel(spin_axis="axial").values
    radius, time = float(ds["element_position"].sel(cyl="r")[0, 0]), ds["time"].values
    first, size = float(u[0, 2]), 0.5 * case.bearing.element_diameter
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
    mass = case.bearing.element_count * case.bearing.element_mass
    yield Row("energy lost to friction", "J", mass * first**2 / 6.0, lost, CREEP)


def test_bodies_on_a_plane():
    check(plane_rows())


def test_rollers_on_a_race():
    check(race_rows())
