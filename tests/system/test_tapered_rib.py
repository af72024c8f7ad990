"""Tapered rollers' ends on ribs: slopes of their wrench, where friction follows load and place."""

from __future__ import annotations

import numpy as np
import pytest
from bearing_runs import march
from tapered_parts import COULOMB, DRY, LIGHT, begun, frames, tapered

from flexcage.bearings.tapered_roller.recording import overlaps
from flexcage.contacts.laws import STIFFNESS
from flexcage.contacts.state import Q_SKEW, Q_TILT
from flexcage.core.errors import InputError
from flexcage.system.data import POWERS

ROLLER = 3


SMALL = {"bearing.small_rib_height": "1.2 mm", "bearing.small_rib_play": "0.2 mm"}
ENDS = {"end": 1, "small_end": 0}  # and their places in arrays of ribs


def on_the_rib_alone(end, depth, **laws):
    """The bearing as at a run's start, without races; roller 3 pressed into a rib by about
    ``depth`` [m], askew, with velocities of its own."""
    case, bearing = tapered(**DRY, **LIGHT, **laws, **SMALL, **{"drive.speed": "2000 rpm"})
    y, yd = begun(case, bearing)
    bare = {name: getattr(bearing.data.model, name) for name in ("inner", "outer")}
    for side in bare.values():
        side.normal[STIFFNESS] = 0.0
    q, u, spec = bearing.layout.q(y), bearing.layout.u(y)["elements"], bearing.spec
    now = overlaps(bearing.data.model, bearing.layout, y[None])[0, ROLLER, ENDS[end] - 2]
    way = np.array([np.cos(spec.axis_angle), -np.sin(spec.axis_angle)])
    way /= (1.0, -1.0)[ENDS[end]] * np.cos((spec.small_rib_angle, spec.rib_angle)[ENDS[end]])
    q["elements"][ROLLER, :2] += (depth - now) * way
    q["elements"][ROLLER, Q_SKEW] += 3e-4
    u[ROLLER] += (0.01, -0.02, 0.05, 10.0, 3.0, -2.0)
    power = np.zeros(len(POWERS))
    bearing.function("residual")(0.0, y, yd, bearing.args, np.zeros(len(y)), power)
    bearing.function("note")(0.0, y, bearing.args)
    return bearing, y, yd


def wrench(bearing, y, yd):
    bearing.residual(0.0, y, yd, mode=2)
    return bearing.data.work.scratch.wrenches[ROLLER].copy()


def made_slopes(bearing, end, y, yd):
    """What the rib adds to the matrix: minus the slopes (2, 6, 6) of roller 3's wrench over its own
    displacement and velocity, turned into the axes of the orbital frame."""
    normal, found = getattr(bearing.data.model, end).normal, []
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


@pytest.mark.parametrize("end", ENDS)
@pytest.mark.parametrize("depth", [1e-7, 1e-6, 6e-6])
@pytest.mark.parametrize("law", [{}, COULOMB])
def test_slopes_of_the_wrench_at_a_rib(end, depth, law):
    """Of all loads, light ones too: friction follows the force, the sliding that changes where the
    end leans to another place of the rib, and directions."""
    bearing, y, yd = on_the_rib_alone(end, depth, **law)
    force = np.linalg.norm(wrench(bearing, y, yd)[:3])
    assert 1.0 < force < 5e4 and bearing.data.work.report.rib[ROLLER, ENDS[end]] > 1.0
    arm = np.diag([1.0, 1.0, 1.0, 1e2, 1e2, 1e2])  # of moments, by which they count as forces
    made, due = made_slopes(bearing, end, y, yd), due_slopes(bearing, y, yd)
    for ours, found in zip(arm @ made @ arm, arm @ due @ arm, strict=True):
        assert np.abs(ours - found).max() < 1e-5 * np.abs(found).max()


def test_a_roller_that_bears_nothing_stops_at_the_small_rib():
    """The ring stands off, so that no race holds roller 3, which moves towards the apex: it goes as
    far as its play, strikes the rib and comes back."""
    case, bearing = tapered(**DRY, **LIGHT, **SMALL, **{
        "drive.speed": 0.0, "load.axial": "1 N", "load.radial": 0.0,
    })  # fmt: skip
    y, yd = begun(case, bearing)
    layout, spec = bearing.layout, bearing.spec
    q, u, qd = layout.q(y), layout.u(y), layout.q(yd)
    way = np.array([np.cos(spec.axis_angle), -np.sin(spec.axis_angle)])
    q["inner"][0] -= 0.2e-3
    q["elements"][:, :2] -= 0.1e-3 * way + np.array([0.0, 6e-6])
    u["elements"][ROLLER, :2] = qd["elements"][ROLLER, :2] = 0.3 * way
    begins = q["elements"][ROLLER, :2] @ way
    room = -overlaps(bearing.data.model, layout, y[None])[0, ROLLER, -2] / np.cos(
        spec.small_rib_angle
    )
    h = march(bearing, y, yd, duration=2e-3, method="explicit", rate=500e3)
    gone = layout.q(h.y)["elements"][:, ROLLER, :2] @ way - begins
    forces = h.samples.rib[: len(h.time), ROLLER]
    assert room > 50e-6 and gone.max() == pytest.approx(room, abs=4e-6)
    struck = np.flatnonzero(forces[:, 0] > 0.0)
    assert forces[:, 0].max() > 10.0
    assert (h.samples.race[: struck[-1], ROLLER, :, 0] == 0.0).all() and np.ptp(struck) < len(
        struck
    )
    speed = layout.u(h.y)["elements"][struck[-1] + 1, ROLLER, :2] @ way
    # the blow's line passes the centre of mass by an arm, and turns the roller
    across, model = np.sin(spec.small_rib_angle), bearing.data.model
    arm, along = model.small_end.place * across, np.sqrt(1.0 - across**2)
    light = along**2 / (1.0 + spec.element_mass * arm**2 / spec.roller_inertia[1])
    restitution = case.contacts.rib.normal.restitution
    assert speed == pytest.approx(0.3 * (1.0 - (1.0 + restitution) * light), abs=0.03)


def test_small_ribs_that_cannot_be_are_refused():
    for key, value, words in (
        ("small_rib_height", "0.5 mm", "twice the chamfer of the rollers' ends"),
        ("small_rib_play", "2 mm", "a tenth of the rollers' length"),
    ):
        with pytest.raises(InputError, match=words):
            tapered(**{**SMALL, f"bearing.{key}": value})
