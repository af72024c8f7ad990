"""Tapered rollers' ends on ribs: slopes of their wrench, where friction follows load and place."""

from __future__ import annotations

import numpy as np
import pytest
from tapered_parts import COULOMB, DRY, LIGHT, begun, frames, tapered

from flexcage.contacts.laws import STIFFNESS
from flexcage.contacts.state import Q_SKEW, Q_TILT
from flexcage.system.data import POWERS

ROLLER = 3


def on_the_rib_alone(depth, **laws):
    """The bearing as at a run's start, without races; roller 3 pressed into the rib by about
    ``depth`` [m], askew, with velocities of its own."""
    case, bearing = tapered(**DRY, **LIGHT, **laws, **{"drive.speed": "2000 rpm"})
    y, yd = begun(case, bearing)
    bare = {name: getattr(bearing.data.model, name) for name in ("inner", "outer")}
    for side in bare.values():
        side.normal[STIFFNESS] = 0.0
    q, u, spec = bearing.layout.q(y), bearing.layout.u(y)["elements"], bearing.spec
    bearing.residual(0.0, y, yd, mode=2)
    force = bearing.data.work.report.rib[ROLLER, 1]
    now = (force / bearing.data.model.end.normal[STIFFNESS]) ** (2.0 / 3.0)
    away = (now - depth) / np.cos(spec.rib_angle)
    q["elements"][ROLLER, :2] += away * np.array(
        [np.cos(spec.axis_angle), -np.sin(spec.axis_angle)]
    )
    q["elements"][ROLLER, Q_SKEW] += 3e-4
    u[ROLLER] += (0.01, -0.02, 0.05, 10.0, 3.0, -2.0)
    power = np.zeros(len(POWERS))
    bearing.function("residual")(0.0, y, yd, bearing.args, np.zeros(len(y)), power)
    bearing.function("note")(0.0, y, bearing.args)
    return bearing, y, yd


def wrench(bearing, y, yd):
    bearing.residual(0.0, y, yd, mode=2)
    return bearing.data.work.scratch.wrenches[ROLLER].copy()


def made_slopes(bearing, y, yd):
    """What the rib adds to the matrix: minus the slopes (2, 6, 6) of roller 3's wrench over its own
    displacement and velocity, turned into the axes of the orbital frame."""
    normal, found = bearing.data.model.end.normal, []
    _, axes = frames(bearing.layout.q(y)["elements"])
    to = np.eye(6)
    to[3:, 3:] = axes[ROLLER]
    for stiffness in (normal[STIFFNESS], 0.0):
        normal[STIFFNESS], kept = stiffness, normal[STIFFNESS]
        bearing.residual(0.0, y, yd, mode=1)
        tangent = bearing.data.work.tangent
        found.append([to.T @ M[ROLLER] @ to for M in (tangent.Krr, tangent.Crr)])
        normal[STIFFNESS] = kept
    return np.subtract(*found)


def due_slopes(bearing, y, yd):
    """The same by differences: the ring is displaced the other way, for the orbital frame turns
    with the roller."""
    layout, own = bearing.layout, np.zeros((2, 6, 6))
    orbital, axes = (rows[ROLLER] for rows in frames(layout.q(y)["elements"]))
    tilt = layout.q(y)["elements"][ROLLER, Q_TILT]
    unit = {c: ("inner", slice(3), -orbital[c], 1e-9) for c in range(3)}
    unit |= {4: ("elements", (ROLLER, Q_SKEW), 1.0 / np.cos(tilt), 1e-7)}
    unit |= {5: ("elements", (ROLLER, Q_TILT), 1.0, 1e-7)}

    def slope(view, motion):
        name, index, way, h = motion
        sides = []
        for step in (-h, h):
            moved = y.copy()
            view(moved)[name][index] += step * way
            if motion is unit.get(4):  # about e_r, which turns the roller's axes about its own
                w, turn = layout.u(moved)["elements"][ROLLER], step * np.tan(tilt)
                w[4:] = w[4] + turn * w[5], w[5] - turn * w[4]
            sides.append(wrench(bearing, moved, yd))
        return (sides[0] - sides[1]) / (2.0 * h)

    for c, motion in unit.items():
        own[0, :, c] = slope(layout.q, motion)
    for c, h in enumerate((1e-5, 1e-5, 1e-5, 1e-3, 1e-3, 1e-3)):
        own[1, :, c] = slope(layout.u, ("elements", (ROLLER, c), 1.0, h))
    own[:, :, 3:] = own[:, :, 3:] @ axes
    return own


@pytest.mark.parametrize("depth", [1e-7, 1e-6, 6e-6])
@pytest.mark.parametrize("law", [{}, COULOMB])
def test_slopes_of_the_wrench_at_the_rib(depth, law):
    """Of all loads, light ones too: friction follows the force, the sliding that changes where the
    end leans to another place of the rib, and directions."""
    bearing, y, yd = on_the_rib_alone(depth, **law)
    force = np.linalg.norm(wrench(bearing, y, yd)[:3])
    assert 1.0 < force < 5e4
    arm = np.diag([1.0, 1.0, 1.0, 1e2, 1e2, 1e2])  # of moments, by which they count as forces
    for made, due in zip(made_slopes(bearing, y, yd), due_slopes(bearing, y, yd), strict=True):
        made, due = arm @ made @ arm, arm @ due @ arm
        assert np.abs(made - due).max() < 1e-5 * np.abs(due).max()
