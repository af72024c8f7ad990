"""Rollers, rings and cage brought to equilibrium without friction: Newton's method on the momentum
rows, in the metric of the mass matrix.

Each is an implicit Euler step from rest, whose length grows as it succeeds. What friction would
hold is held (``HeldMotions``).
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from flexcage.contacts import laws
from flexcage.contacts.evaluation import REPORT, RESIDUAL, TANGENT
from flexcage.contacts.land import DRY, NONE
from flexcage.contacts.pocket_wall import with_offset
from flexcage.contacts.state import U_SKEW, U_TILT
from flexcage.contacts.uneven import is_uneven
from flexcage.core.errors import RunFailed
from flexcage.core.vectors import RIGID
from flexcage.system.constraints import OFF, no_rows
from flexcage.system.layout import Layout
from flexcage.system.newton import assemble, newton_step
from flexcage.system.problem import BearingSystem

_SMALL = 1e-7  # of the load: where an equilibrium is accepted
_STEPS = 400
_HOLD = 1e12  # stiffness that holds a coordinate, far above that of any contact
# longest step of centres [m], and of a roller's tilt and skew [rad], by which its ends move by some
# 0.4 um: one that is hardly loaded resists so little that longer ones may swing over for ever
_SHIFT, _TURN = 1e-5, 1e-4

Roll = Callable[[np.ndarray], np.ndarray]  # sets the velocities in y of an equilibrium; gives y'
Move = Callable[[np.ndarray, np.ndarray], None]  # moves y by a step, in place


@dataclass(frozen=True)
class HeldMotions:
    """Motions that friction holds while the bearing is brought to equilibrium without it."""

    # (Z, 6) along the orbit; sideways and in skew unless pinched; in spin on the edges of a spot
    rollers: np.ndarray
    cage: np.ndarray  # (6,) where a pinch holds the cage: all but those along which it squeezes


class Frictionless:
    """The bearing without friction, damping, drag, rolling resistance and gravity, and without
    films; ``lands``: with the cage's dry lands, which a free cage is to keep off by itself."""

    def __init__(self, bearing: BearingSystem, offset: np.ndarray, *, lands: bool = False) -> None:
        model = bearing.data.model
        land = min(model.land.kind, DRY) if lands else NONE
        still = model._replace(
            bodies=model.bodies._replace(gravity=np.zeros(3), drag=np.zeros(2)),
            inner_ring=model.inner_ring._replace(damping=np.zeros((6, 6))),
            **{
                name: side._replace(rolling=np.zeros(2))
                for name, side in model._asdict().items()
                if hasattr(side, "rolling")
            },
            land=model.land._replace(kind=land),
            pocket=with_offset(model.pocket, offset),
        )
        self.bearing = bearing
        free = bearing.data.constraints
        free = free._replace(level=np.full(len(free.level), float(OFF)))
        self.data = bearing.data._replace(model=still, constraints=free)
        own = (laws.elastic,) * 5 + (laws.no_friction,) * 5 + (no_rows, bearing.laws[-1])
        self.args = bearing.arguments(self.data, own)
        self.out = np.zeros(bearing.layout.size)

    def residual(self, y: np.ndarray, yd: np.ndarray) -> np.ndarray:
        self._evaluate(y, yd, RESIDUAL)
        return self.out.copy()

    def _evaluate(self, y: np.ndarray, yd: np.ndarray, mode: int) -> None:
        self.bearing.evaluate(0.0, y, yd, self.args[0], self.args[1], self.out, mode)

    def report(self, y: np.ndarray, yd: np.ndarray) -> Any:
        self._evaluate(y, yd, REPORT)
        return self.data.work.report

    def step(self, y, yd, r, alpha: float, held: HeldMotions) -> np.ndarray:
        """Displacement step dq of the implicit Euler step 1/alpha from rest."""
        tangent, at = self.data.work.tangent, self.data.places
        self._evaluate(y, yd, TANGENT)
        roller, row = np.nonzero(held.rollers)
        tangent.Krr[roller, row, row] += _HOLD
        for k in range(at.cages):
            row = at.cage_b + k * (RIGID + at.modes) + np.flatnonzero(held.cage)
            tangent.Kbb[row, row] += _HOLD
        if not assemble(alpha, self.data.model.bodies, at, tangent, self.data.matrix):
            raise RunFailed("the start's equilibrium has a singular matrix; is a body massless?")
        r = r.copy()
        newton_step(alpha, y, r, at, tangent, self.data.matrix)
        return r


def has_pits(model: Any) -> bool:
    """Have races spalls, or rollers spots?"""
    spalls = model.inner.spall[0] > 0.0 or model.outer.spall[0] > 0.0
    return bool(spalls or model.spot.has.any())


def without_pits(model: Any) -> Any:
    """The model with neither spalls of races nor spots of rollers."""
    spot = model.spot._replace(has=0 * model.spot.has)
    return model._replace(spot=spot, inner=_even(model.inner), outer=_even(model.outer))


def _even(side: Any) -> Any:
    """The race without its spall."""
    spall = 0.0 * side.spall
    return side._replace(spall=spall, uneven=is_uneven(side.wave, spall))


def stop_cage(layout: Layout, y: np.ndarray, yd: np.ndarray) -> np.ndarray:
    """y' with the cage at rest, in y too: nothing elastic holds its unbalance."""
    if layout.has_cage:
        layout.u(y)["omega"][:], layout.q(yd)["quaternion"][:] = 0.0, 0.0
    return yd


def axial_load(model: Any) -> float:
    """The axial load at the start [N]."""
    return float(np.interp(0.0, *model.bodies.axial))


def load_of(model: Any) -> float:
    """The load at the start [N], by which unbalanced forces are measured."""
    return max(float(np.interp(0.0, *model.bodies.load)), abs(axial_load(model)), 1.0)


def _measure(
    layout: Layout, r: np.ndarray, lever: float, held: HeldMotions, free: np.ndarray
) -> float:
    """Largest unbalanced force [N] (moments over a lever) of the rows that are free; ``free`` (3,):
    is the inner ring free axially, in skew, in tilt?"""
    u = {k: v.copy() for k, v in layout.u(r).items()}
    u["elements"][:, 3:] /= lever
    u["inner"][[0, 4, 5]] *= free  # the others are constrained: their multipliers balance them
    u["inner"][3] = 0.0
    u["inner"][4:] /= lever
    u["outer"][3:] /= lever
    names = ["elements", "inner", "outer"]
    if held.cage.any():  # nothing holds a free cage
        u["omega"] /= 10.0 * lever
        names = list(u)
    return max(float(np.abs(u[k]).max()) for k in names if u[k].size)


def free_motions(model: Any) -> np.ndarray:
    """(3,) Is the inner ring free axially, in skew, in tilt?"""
    free: np.ndarray = model.inner_ring.free[[0, U_SKEW, U_TILT]]
    return free


def advance_y(system: Frictionless, y: np.ndarray, step: np.ndarray) -> None:
    """Move y by a step: coordinates, and multipliers of what the inner ring is free in."""
    layout, free = system.bearing.layout, free_motions(system.data.model)
    nq, loose = layout.n_q, layout.n_q + layout.n_u + np.flatnonzero(free)
    y[:nq] += step[:nq]
    y[loose] += step[loose]
    if layout.has_cage:
        for quaternion in np.atleast_2d(layout.q(y)["quaternion"]):
            quaternion /= np.linalg.norm(quaternion)


def _share(layout: Layout, step: np.ndarray) -> float:
    """Of a step: as much as is not too long."""
    dq = layout.q(step)
    centres = dq["elements"][:, :2], dq["inner"][:3], dq["outer"][:3]
    shift = max(np.abs(moved).max() for moved in centres)
    turn = np.abs(dq["elements"][:, 3:5]).max()
    return float(min(1.0, _SHIFT / max(shift, 1e-30), _TURN / max(turn, 1e-30)))


def equilibrate(
    system: Frictionless, y: np.ndarray, yd: np.ndarray, held: HeldMotions, roll: Roll, move: Move
) -> float:
    """Bring y, and with it y', to equilibrium in place; the residual reached, as a share of the
    load."""
    model, layout = system.data.model, system.bearing.layout
    load, lever = load_of(model), float(model.bodies.radius.mean())
    alpha, last = 1e5, np.inf
    for _ in range(_STEPS):
        r = system.residual(y, yd)
        rows = layout.u(r)
        rows["elements"][held.rollers] = 0.0
        if held.cage.any():
            rows["cage"][..., held.cage[:3]], rows["omega"][..., held.cage[3:]] = 0.0, 0.0
        size = _measure(layout, r, lever, held, free_motions(model)) / load
        if size < _SMALL:
            break
        alpha = max(alpha * 0.5, 500.0) if size <= 3.0 * last else min(alpha * 10.0, 1e6)
        last = size
        step = system.step(y, yd, r, alpha, held)
        move(y, step * _share(layout, step))
        yd[:] = roll(y)
    return size
