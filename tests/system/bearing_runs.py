"""A bearing of given specs, a moving state for it, and runs of it that hand back what happened."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.bearings.cylindrical_roller.motion import MOTION
from flexcage.bearings.cylindrical_roller.spot import RollerSpot
from flexcage.bearings.cylindrical_roller.start import geometric_guess, rolling_velocities
from flexcage.case.presets import load_preset
from flexcage.solve import bdf, runge_kutta
from flexcage.solve.integrators import INTEGRATORS
from flexcage.system.constraints import names_of
from flexcage.system.data import POWERS
from flexcage.system.layout import Layout, bodies_of_bearing
from flexcage.system.problem import BearingSystem, new_samples
from flexcage.system.scales import work_weights
from flexcage.system.spec import Drive, Load, Mount

N1013 = load_preset("N1013").bearing
#: On the edge of which roller 0 stands, on the inner race.
PIT = RollerSpot(size=1e-3, depth=50e-6, angle=np.pi + 0.115)
#: What makes an N1013 another design; ribs of both rings are 1.95 mm high.
NU = {"design": "NU", "rib_diameter": 86.6e-3}
NUP = {**NU, "design": "NUP", "counter_rib_diameter": 78.4e-3, "counter_rib_gap": 8.03e-3}
BETWEEN_RIBS = Load(radial=1000.0, axial=440.0)


def unbalanced(bearing, elements):
    """Sum (2,) [N] of the forces on all bodies across the axis after a residual, over that of their
    sizes, with elements at places (Z, ...) r, x, azimuth."""
    work = bearing.data.work.scratch
    cos, sin = np.cos(elements[:, 2]), np.sin(elements[:, 2])
    along = work.wrenches[:, 1] * cos - work.wrenches[:, 2] * sin
    across = work.wrenches[:, 1] * sin + work.wrenches[:, 2] * cos
    pushed = bearing.layout.border(work.border)
    bodies = sum(pushed[name][1:3] for name in ("inner", "outer", "cage"))
    return (bodies + [along.sum(), across.sum()]) / np.abs(work.wrenches[:, :3]).sum()


def wrenches(bearing, y):
    """Forces and moments about the origin (Z, 3) in space of all elements."""
    bearing.residual(0.0, y, np.zeros_like(y), mode=2)
    own, q = bearing.data.work.scratch.wrenches.copy(), bearing.layout.q(y)["elements"]
    c, s = np.cos(q[:, 2]), np.sin(q[:, 2])

    def in_space(a):
        return np.stack([a[:, 0], c * a[:, 1] - s * a[:, 2], s * a[:, 1] + c * a[:, 2]], axis=1)

    place = np.stack([q[:, 0], q[:, 1] * c, q[:, 1] * s], axis=1)
    force = in_space(own[:, :3])
    return force, in_space(own[:, 3:]) + np.cross(place, force)


def assembled(model, contacts, constraints=()) -> BearingSystem:
    held = names_of(constraints)
    bodies = bodies_of_bearing(model.cage.mff.shape[0])
    layout = Layout(len(model.bodies.radius), bodies, held)
    return BearingSystem(MOTION, N1013, model, contacts, layout, constraints=constraints)


def rolling_start(bearing):
    """(y, y') of the geometric guess at the speeds of pure rolling."""
    y = geometric_guess(bearing.data.model, bearing.layout)
    return y, rolling_velocities(bearing.data.model, bearing.layout, y)


@dataclass
class History:
    """States on a grid, their reports, integrals of power, and the solver's log."""

    time: np.ndarray
    y: np.ndarray
    yd: np.ndarray
    samples: object
    work: np.ndarray
    log: np.ndarray
    outcome: int
    state: object

    def power(self, name):
        return self.work[:, POWERS.index(name)]


def march(bearing, y0, yd0, *, duration, rate=100e3, tolerance=1e-8, max_order=2, h_max=5e-5,
          method="bdf"):  # fmt: skip
    """Integrate and sample at ``rate``; every sample is a main one."""
    layout = bearing.layout
    times = np.arange(1, int(round(duration * rate)) + 1) / rate
    n, quads = len(times), np.zeros((int(round(duration * rate)), len(POWERS)))
    samples = new_samples(n, 1, bearing.data.work.report)
    bearing.data = bearing.data._replace(samples=samples)
    bearing.args = bearing.arguments(bearing.data, bearing.laws)
    integrator = INTEGRATORS[method]
    weight = bearing.error_weights(tolerance)
    state = integrator.new_state(
        0.0,
        y0,
        yd0,
        weight=weight,
        h0=1e-8,
        quad_weight=work_weights(bearing.data.model, tolerance),
        modes=bearing.modes,
    )
    if method == "bdf":
        options = bdf.BDFOptions(max_order, h_max, 1e-14, 0.3, 10**9)
    else:
        options = runge_kutta.RungeKuttaOptions(h_max, 1e-14, 10**9)
    ys, yds = np.zeros((n, layout.size)), np.zeros((n, layout.size))
    log = np.zeros((400_000, 5))
    outcome, done, rows = bearing.advance(
        integrator, state, options, times[-1], times, ys, yds, 0, log, quads
    )
    assert done == n or outcome != bdf.DONE
    return History(
        times[:done], ys[:done], yds[:done], samples, quads[:done], log[:rows], outcome, state
    )


#: An inner ring that is free axially and in tilt, on springs and dampers.
SOFT = Load(
    radial=1000.0, axial=300.0, moment_y=0.5, moment_z=-1.0, misalignment=1e-4, tilt="free",
    axial_stiffness=3e7, axial_damping=500.0, tilt_stiffness=2e3, tilt_damping=0.05,
)  # fmt: skip

#: Named specs and disturbances of a bearing in which something of every kind touches.
STATES = {
    "light": ({}, {}),
    "on the edge of a roller's pit": ({"bearing": {"roller_spot": PIT}}, {}),
    "every pocket loaded": ({}, {"press": 110e-6, "skew": 3e-4}),
    "ends in the ribs": ({}, {"axial": 20e-6, "skew": 1e-4}),
    "ends in the outer ribs": (
        {"bearing": NU, "mount": Mount(kind="bushing", mass=1.0)},
        {"axial": 20e-6, "skew": 1e-4},
    ),
    "ends in the ribs of both rings": (
        {"bearing": NUP, "load": BETWEEN_RIBS},
        {"axial": 1e-6, "skew": 1e-4},
    ),
    "bushing": ({"mount": Mount(kind="bushing", mass=1.0)}, {"press": 105e-6}),
    "housing": ({"mount": Mount(kind="contact", mass=1.0, clearance=1e-6)}, {"press": 105e-6}),
    "shaft": ({"drive": Drive(kind="shaft")}, {"press": 105e-6}),
    "compliant shaft": ({"load": SOFT}, {"press": 105e-6, "ring": 2e-5}),
    "flexible": ({"flexible": {"modes": 6}}, {"press": 101e-6}),
    "flexible, soft walls": ({"flexible": {"modes": 6, "soft": True}}, {"press": 104e-6}),
}


def disturbed(bearing, *, press=0.0, skew=1e-5, axial=8e-6, modal=1e-6, ring=0.0, seed=0):
    """A state in motion: ring pushed in, and displaced along its axis and in tilt by ``ring``,
    rollers pressed into crossbeams by ``press`` - 100 um."""
    rng = np.random.default_rng(seed)
    y, yd = rolling_start(bearing)
    q, u = bearing.layout.q(y), bearing.layout.u(y)
    q["inner"][1] = 13e-6
    q["inner"][[0, 3, 4]] += ring * np.array([1.0, -4.0, 3.0])
    u["inner"][[0, 4, 5]] += ring * np.array([5e2, 3e3, 4e3])
    rollers = q["elements"]
    rollers[:, 1] += 1e-7 * rng.standard_normal(22)
    rollers[:, 2] += press * rng.choice([-1, 1], 22) / rollers[:, 1]
    rollers[:, 3:5] = skew * rng.standard_normal((22, 2))
    rollers[:, 0] = axial * rng.standard_normal(22)
    u["elements"][:] += np.array([0.01, 0.01, 0.05, 20, 1, 1]) * rng.standard_normal((22, 6))
    u["cage"][:] += 0.02 * rng.standard_normal(3)
    u["omega"][:] += np.array([1.0, 0.3, 0.3]) * rng.standard_normal(3)
    if bearing.layout.modes:
        q["modes"][:] = modal * rng.standard_normal(bearing.layout.modes)
        u["modes"][:] = 1e-3 * rng.standard_normal(bearing.layout.modes)
    power = np.zeros(len(POWERS))
    bearing.function("residual")(0.0, y, yd, bearing.args, np.zeros(len(y)), power)
    bearing.function("note")(0.0, y, bearing.args)  # onset speeds
    return y, yd, rng
