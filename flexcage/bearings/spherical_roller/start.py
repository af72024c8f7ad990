"""The start of a spherical roller bearing's run: its static solution, with the barrels rolling.

The static solution places ring and barrels without friction, centrifugal forces and gyroscopic
moments included. It is linear in displacements: so Newton's method then brings barrels and rings
to equilibrium where they truly touch, still without friction, which holds barrels along the orbit
and in skew. Barrels keep their places towards an inner ring that tilts, with which they turn
about the sphere's centre: so they orbit, and turn about their axes, as in pure rolling about the
tilted axis, and the cage with them.
"""

from __future__ import annotations

from math import cos, sin

import numpy as np
from scipy.spatial.transform import Rotation

from flexcage.bearings.spherical_roller.bearing import SphericalRollerBearing
from flexcage.bearings.spherical_roller.model import SphericalModel
from flexcage.bearings.spherical_roller.statics import barrel_rows, settled_in
from flexcage.bearings.tapered_roller.start import balanced, said_of
from flexcage.contacts.laws import STIFFNESS
from flexcage.system.begun import Advance, Start, StaticStart
from flexcage.system.problem import BearingSystem
from flexcage.system.statics.slices import rolling_of
from flexcage.system.statics.solution import StaticSolution

LOOSE = (
    "Without a cage nothing keeps barrels that bear nothing from turning ever further askew, in "
    "milliseconds; give a [cage], or look at the run's beginning alone."
)
_SOON = 1e-6  # s, over which velocities are differenced


def spherical_start(
    bearing: BearingSystem, *, limit_force: float, statics: StaticStart | None, advance: Advance
) -> Start:
    """The static solution, which has to be given, with barrels that roll; no force is limited."""
    assert statics is not None, "barrels start at their static solution"
    assert isinstance(bearing.spec, SphericalRollerBearing)
    solution, spec, layout = statics(), bearing.spec, bearing.layout
    turn = Rotation.from_euler("YZ", solution.displacement[3:])
    place, axis = barrels_in_space(spec, settled_barrels(bearing.data.model, spec, solution, turn))
    y = np.zeros(layout.size)
    q = layout.q(y)
    place = turn.apply(place) + solution.outer[:3]
    q["elements"][:, :5] = in_frames(place, turn.apply(axis), spec.element_azimuths)
    q["inner"][:5], q["outer"][:5] = solution.displacement, solution.outer
    if layout.has_cage:
        q["quaternion"][:] = turn.as_quat(scalar_first=True)
        q["cage"][:] = solution.outer[:3]

    def rolling(y: np.ndarray) -> np.ndarray:
        return rolling_barrels(bearing, y, turn)

    y, residual = balanced(bearing, y, rolling, skews=False)
    yd = rolling(y)
    station = np.zeros_like(bearing.data.work.report.station)
    warnings = (*solution.warnings, *said_of(residual), *(() if layout.has_cage else (LOOSE,)))
    return Start(y, yd, (), 0.0, residual, station, warnings)


def settled_barrels(
    model: SphericalModel, spec: SphericalRollerBearing, solution: StaticSolution, turn: Rotation
) -> np.ndarray:
    """Coordinates w (2Z, 3) of the barrels of a static solution, as ``statics`` has them, seen from
    an inner ring that is turned."""
    n, v = len(model.inner.s), np.zeros(5)
    v[:3] = turn.apply(solution.displacement[:3] - solution.outer[:3], inverse=True)
    stiffness = [model.inner.normal[STIFFNESS], model.outer.normal[STIFFNESS]]
    rows = barrel_rows(spec, np.repeat(stiffness, n), speed=solution.speed)
    return settled_in(rows, v, solution.load)


def barrels_in_space(
    spec: SphericalRollerBearing, own: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Middles (2Z, 3) [m] and axes (2Z, 3), towards +x, of barrels with the coordinates w (2Z, 3)
    of ``statics``."""
    angle, psi = spec.contact_angle, spec.element_azimuths
    along, across, lean = own.T
    sense = np.repeat([row.sense for row in spec.row_places], spec.roller_count)
    middle = np.repeat([row.place for row in spec.row_places], spec.roller_count)
    x = middle + sense * (along * cos(angle) + across * sin(angle))
    r = spec.pitch_radius - along * sin(angle) + across * cos(angle)
    tilt = sense * (lean / (0.5 * spec.effective_length) - angle)
    out = np.stack([np.zeros_like(psi), np.cos(psi), np.sin(psi)])
    e_x = np.array([1.0, 0.0, 0.0])[:, None]
    return (x * e_x + r * out).T, (np.cos(tilt) * e_x + np.sin(tilt) * out).T


def in_frames(place: np.ndarray, axis: np.ndarray, near: np.ndarray) -> np.ndarray:
    """Coordinates x, r, psi, skew, tilt (Z, 5) of rollers with middles and axes (Z, 3) in space;
    azimuths are those next to ``near`` (Z,)."""
    off = np.arctan2(place[:, 2], place[:, 1]) - near
    psi = near + (off + np.pi) % (2.0 * np.pi) - np.pi
    c, s = np.cos(psi), np.sin(psi)
    up, ahead = c * axis[:, 1] + s * axis[:, 2], c * axis[:, 2] - s * axis[:, 1]
    away = np.hypot(place[:, 1], place[:, 2])
    return np.stack([place[:, 0], away, psi, np.arctan2(-ahead, axis[:, 0]), np.arcsin(up)], axis=1)


def rolling_barrels(bearing: BearingSystem, y: np.ndarray, turn: Rotation) -> np.ndarray:
    """Set velocities in y: barrels that orbit about an axis that is turned, and turn about their
    own, as in pure rolling; returns y'."""
    layout, yd = bearing.layout, np.zeros_like(y)
    q, u, qd = layout.q(y)["elements"], layout.u(y), layout.q(yd)["elements"]
    speed = float(np.interp(0.0, *bearing.data.model.bodies.speed))
    rolling = rolling_of(bearing.spec, speed, None)
    orbit = rolling.cage_speed * turn.apply([1.0, 0.0, 0.0])
    u["elements"][:] = _velocities(q, orbit, rolling.element_spin_in_cage)
    u["inner"][3] = speed
    if layout.has_cage:
        u["omega"][0] = rolling.cage_speed
    yd[: layout.n_q] = -bearing.residual(0.0, y, yd)[: layout.n_q]
    later, before = (
        _velocities(q + h * qd, orbit, rolling.element_spin_in_cage) for h in (_SOON, -_SOON)
    )
    layout.u(yd)["elements"][:] = (later - before) / (2.0 * _SOON)
    return yd


def _velocities(q: np.ndarray, orbit: np.ndarray, spin: float) -> np.ndarray:
    """Velocities (Z, 6) of rollers at q (Z, 6) that go round at ``orbit`` (3,) [rad/s], and turn
    about their axes at a ``spin`` [rad/s] besides."""
    around = Rotation.from_euler("X", q[:, 2, None]).apply(
        np.tile(orbit, (len(q), 1)), inverse=True
    )
    centre = np.stack([q[:, 0], q[:, 1], np.zeros(len(q))], axis=1)
    turning = Rotation.from_euler("YZ", q[:, 3:5]).apply(around, inverse=True)
    return np.hstack([np.cross(around, centre), turning + [spin, 0.0, 0.0]])
