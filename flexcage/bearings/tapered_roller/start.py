"""The start of a tapered roller bearing's run: its static solution, with the rollers rolling.

The static solution places ring and rollers without friction, centrifugal forces and gyroscopic
moments included; rollers that bear nothing on the inner race lie on the outer one and on the rib.
It is linear in displacements and leaves out skew: so Newton's method then brings rollers and rings
to equilibrium where they truly touch, still without friction, which holds rollers along the orbit.
All orbit and turn as cones with one apex do in pure rolling; the cage goes round with them, its
pockets' middles where the rollers' are, and its modes where rotation holds them.
"""

from __future__ import annotations

from copy import copy
from math import cos, pi, sin

import numpy as np

from flexcage.bearings.cylindrical_roller.frictionless import (
    Frictionless,
    HeldMotions,
    Roll,
    advance_y,
    equilibrate,
    has_pits,
    stop_cage,
    without_pits,
)
from flexcage.bearings.tapered_roller.bearing import TaperedRollerBearing
from flexcage.bearings.tapered_roller.model import TaperedModel
from flexcage.bearings.tapered_roller.statics import TaperedRollers, meeting
from flexcage.contacts.laws import STIFFNESS
from flexcage.system.begun import Advance, Start, StaticStart
from flexcage.system.layout import Layout
from flexcage.system.problem import BearingSystem
from flexcage.system.start import strained_by_rotation
from flexcage.system.statics.equilibrium import Problem, nearest, settle
from flexcage.system.statics.slices import rolling_of
from flexcage.system.statics.solution import StaticSolution

_BALANCED = 1e-3  # of the load: what may stay unbalanced without a word


def tapered_start(
    bearing: BearingSystem, *, limit_force: float, statics: StaticStart | None, advance: Advance
) -> Start:
    """The static solution, which has to be given, with rollers that roll; no force is limited."""
    assert statics is not None, "tapered rollers start at their static solution"
    assert isinstance(bearing.spec, TaperedRollerBearing)
    solution, spec = statics(), bearing.spec
    model, layout = bearing.data.model, bearing.layout

    def rolling(y: np.ndarray) -> np.ndarray:
        return rolling_cones(model, layout, spec, y)

    y, residual = _balanced(bearing, placed(bearing, spec, solution), rolling)
    yd = rolling(y)
    if layout.modes:
        spin = float(layout.u(y)["omega"][0])
        layout.q(y)["modes"][:] = strained_by_rotation(model.cage, spin)
    station = np.zeros_like(bearing.data.work.report.station)
    return Start(y, yd, (), 0.0, residual, station, (*solution.warnings, *said_of(residual)))


def _balanced(bearing: BearingSystem, y: np.ndarray, rolling: Roll) -> tuple[np.ndarray, float]:
    """``balanced``, and where nothing is on spalls or on spots of rollers, on even ones."""
    found, residual = balanced(bearing, y, rolling, skews=True)
    if residual < _BALANCED or not has_pits(bearing.data.model):
        return found, residual
    even = copy(bearing)
    even.data = bearing.data._replace(model=without_pits(bearing.data.model))
    return balanced(even, y, rolling, skews=True)


def balanced(
    bearing: BearingSystem, y: np.ndarray, rolling: Roll, *, skews: bool
) -> tuple[np.ndarray, float]:
    """y with rollers and rings in equilibrium, without friction, at the velocities of pure
    ``rolling``; what is left unbalanced, as a share of the load. Friction holds rollers along the
    orbit and in spin, and unless it ``skews``, in skew."""
    model, layout = bearing.data.model, bearing.layout
    system, found = Frictionless(bearing, model.pocket.offset), y.copy()
    along = np.zeros((layout.elements, 6), bool)
    along[:, 2 : 4 if skews else 5] = True
    held = HeldMotions(along, np.full(6, layout.has_cage))

    def roll(y: np.ndarray) -> np.ndarray:
        return stop_cage(layout, y, rolling(y))

    residual = equilibrate(
        system, found, roll(found), held, roll, lambda y, step: advance_y(system, y, step)
    )
    return found, residual


def said_of(residual: float) -> tuple[str, ...]:
    """A sentence on what is left unbalanced; none if it is little."""
    if residual < _BALANCED:
        return ()
    return (
        f"The run starts out of balance by {residual:.1%} of the load: no equilibrium of the "
        "rollers was found near the static solution; leave out the run's beginning.",
    )


def settled_rollers(
    model: TaperedModel, spec: TaperedRollerBearing, solution: StaticSolution
) -> np.ndarray:
    """Coordinates w (Z, 3) of the rollers of a static solution, as ``statics`` has them."""
    n, v = len(model.inner.s), solution.displacement - solution.outer
    stiffness = [model.inner.normal[STIFFNESS], model.outer.normal[STIFFNESS]]
    rollers = TaperedRollers(
        bearing=spec, meeting=meeting(spec, n),
        stiffness=np.array([*np.repeat(stiffness, n), model.end.normal[STIFFNESS]]),
        rolling=rolling_of(spec, solution.speed, None), rating=spec.dynamic_rating,
    )  # fmt: skip
    problem = Problem(rollers, solution.load, np.zeros(5, bool), v, np.zeros(5))
    at = problem.at_azimuths @ v
    return settle(problem, at, nearest(problem, at, None, 0.0), 0.0)[0]


def placed(
    bearing: BearingSystem, spec: TaperedRollerBearing, solution: StaticSolution
) -> np.ndarray:
    """y with rings and rollers where the static solution has them."""
    layout, beta = bearing.layout, spec.axis_angle
    y = np.zeros(layout.size)
    q = layout.q(y)
    along, across, lean = settled_rollers(bearing.data.model, spec, solution).T
    tilt, psi = lean / (0.5 * spec.effective_length) - beta, solution.elements.azimuth
    x = along * cos(beta) + across * sin(beta)
    r = spec.pitch_radius - along * sin(beta) + across * cos(beta)
    outer_x, *radial, skew, turn = solution.outer  # rollers go with the outer race
    turned = turn * np.cos(psi) - skew * np.sin(psi)
    x, r = x + outer_x - r * turned, r + radial @ np.stack([np.cos(psi), np.sin(psi)]) + x * turned
    tilt = tilt + turned
    q["elements"][:, 0] = x + spec.roller.centre * np.cos(tilt)
    q["elements"][:, 1] = r + spec.roller.centre * np.sin(tilt)
    q["elements"][:, 2], q["elements"][:, 4] = 2.0 * pi * np.arange(len(psi)) / len(psi), tilt
    q["inner"][:5], q["outer"][:5] = solution.displacement, solution.outer
    if layout.has_cage:
        q["cage"][0], q["quaternion"][0] = x.mean(), 1.0
    return y


def rolling_cones(
    model: TaperedModel, layout: Layout, spec: TaperedRollerBearing, y: np.ndarray
) -> np.ndarray:
    """Set velocities in y: rollers that orbit and turn about their axes as in pure rolling; returns
    y' (accelerations zero)."""
    yd = np.zeros_like(y)
    q, u, qd = layout.q(y)["elements"], layout.u(y), layout.q(yd)["elements"]
    speed = float(np.interp(0.0, *model.bodies.speed))
    rolling = rolling_of(spec, speed, None)
    orbit, turn = rolling.cage_speed, rolling.element_spin_in_cage
    skew, tilt = q[:, 3], q[:, 4]
    u["elements"][:, 2] = q[:, 1] * orbit
    u["elements"][:, 3] = turn + orbit * np.cos(skew) * np.cos(tilt)
    u["elements"][:, 4] = -orbit * np.cos(skew) * np.sin(tilt)  # they keep skew and tilt
    u["elements"][:, 5] = orbit * np.sin(skew)
    qd[:, 2], qd[:, 5] = orbit, turn
    u["inner"][3] = layout.q(yd)["inner"][5] = speed
    if layout.has_cage:
        u["omega"][0], layout.q(yd)["quaternion"][1] = orbit, 0.5 * orbit
    return yd
