"""Forces of a four-point contact bearing in motion: slopes of one energy, in balance, those of its
static solution, and those of an angular contact bearing where one arc a race bears."""

from __future__ import annotations

from dataclasses import fields

import numpy as np
import pytest
from ball_parts import ball_bearing, contacts_of, four_point, pressed

from flexcage.bearings.ball.angular_contact import AngularContactBallBearing
from flexcage.bearings.ball.bearing import BallBearing

RUBBING = contacts_of("restitution", "step_coulomb")


def loaded(**how):
    """A bearing, y with its balls pressed into the arcs, and the rows of the residual at rest."""
    bearing = ball_bearing(modes=0, **{**four_point(), **how})
    y = pressed(bearing)
    return bearing, y, bearing.residual(0.0, y, np.zeros_like(y), mode=2)


@pytest.mark.parametrize("shims", [(0.15e-3, 0.2e-3), (0.2e-3, 0.0)], ids=["four", "three"])
def test_forces_of_all_arcs_are_the_slopes_of_the_energy(shims):
    """Along random motions of balls and ring together, tilts too."""
    bearing, y, rows = loaded(**four_point(clearance=-40e-6, shims=shims))
    layout, rng = bearing.layout, np.random.default_rng(2)
    arcs = bearing.data.work.report.rib[:, 1:].copy()
    assert ((arcs > 1.0).sum(axis=1) == (4 if shims[1] else 3)).sum() >= layout.elements // 2
    force, r = layout.u(-rows), layout.q(y)["elements"][:, 1]

    def energy(at):
        bearing.residual(0.0, at, np.zeros_like(at), mode=2)
        return float(bearing.data.work.report.energy[1:].sum())

    for _ in range(8):
        step = np.zeros_like(y)
        q = layout.q(step)
        q["elements"][:, :3] = rng.standard_normal((layout.elements, 3)) * 1e-9
        q["elements"][:, 2] /= r
        q["inner"][:5] = rng.standard_normal(5) * np.array([1e-9, 1e-9, 1e-9, 3e-8, 3e-8])
        slope = -0.5 * (energy(y + step) - energy(y - step))
        work = (
            force["elements"][:, :3] * q["elements"][:, :3] * np.stack([r**0, r**0, r], 1)
        ).sum()
        work += force["inner"][:3] @ q["inner"][:3] + force["inner"][4:6] @ q["inner"][3:5]
        scale = np.abs(force["elements"]).max() * 1e-9 * layout.elements
        assert slope == pytest.approx(work, abs=3e-6 * scale)


def test_balls_and_rings_push_each_other_alike():
    """With friction and spin: forces of balls, inner and outer ring sum to nothing."""
    bearing = ball_bearing(modes=0, contacts=RUBBING, **four_point())
    y, layout = pressed(bearing, push=0.0), bearing.layout
    layout.q(y)["cage"][:] = 0.0
    rng = np.random.default_rng(4)
    layout.u(y)["elements"][:, 3:] = rng.standard_normal((layout.elements, 3)) * 100.0
    layout.u(y)["inner"][3] = 50.0
    rows = bearing.residual(0.0, y, np.zeros_like(y), mode=2)
    work = bearing.data.work
    psi = layout.q(y)["elements"][:, 2]
    x, radial, around = work.scratch.wrenches[:, :3].T
    balls = np.array([
        x.sum(), (radial * np.cos(psi) - around * np.sin(psi)).sum(),
        (radial * np.sin(psi) + around * np.cos(psi)).sum(),
    ])  # fmt: skip
    cage = -layout.u(rows)["cage"]
    total = balls - layout.u(rows)["inner"][:3] + work.report.outer_wrench[:3] + cage
    assert np.abs(around).max() > 1.0
    np.testing.assert_allclose(total, 0.0, atol=1e-9 * np.abs(work.report.race[:, :, 0]).sum())


def test_where_one_arc_bears_it_is_an_angular_contact_bearing():
    """The same residual and report, to rounding, at balls and rings of equal places."""
    four = four_point(clearance=80e-6)
    spec = four["spec"]
    own = {f.name: getattr(spec, f.name) for f in fields(BallBearing) if f.name != "type"}
    angular = AngularContactBallBearing(**own, contact_angle=spec.free_contact_angle)
    found = []
    for how in (four, {"spec": angular}):
        bearing = ball_bearing(modes=0, contacts=RUBBING, **how)
        y = pressed(bearing)
        q, Z = bearing.layout.q(y), bearing.layout.elements
        model, rng = bearing.data.model, np.random.default_rng(6)
        q["inner"][:3] = 12e-6, 3e-6, -2e-6
        q["inner"][3:5] = (
            0.0  # a tilt would move arcs that stand elsewhere along the axis otherwise
        )
        if how is four:
            q["inner"][0] += 0.5 * spec.axial_clearance
        depth = rng.uniform(4e-6, 8e-6, Z)
        reach = model.outer.radius - model.bodies.radius + depth
        angle = spec.free_contact_angle + rng.uniform(-1e-3, 1e-3, Z)
        q["elements"][:, 0] = model.outer.axial + reach * np.sin(angle)
        q["elements"][:, 1] = model.outer.centre + reach * np.cos(angle)
        q["cage"][0] += q["elements"][:, 0].mean() - q["cage"][0]
        bearing.layout.u(y)["elements"][:, 3:] = rng.standard_normal((Z, 3)) * 50.0
        rows = bearing.residual(0.0, y, np.zeros_like(y), mode=2)
        report = bearing.data.work.report
        found.append((bearing.layout.u(rows), report.race.copy(), report.rib.copy()))
    (rows, race, rib), (due_rows, due_race, _) = found
    assert (rib[:, [1, 3]] > 0.0).any(axis=0).all() and not rib[:, [2, 4]].any()
    np.testing.assert_allclose(race[..., 0], due_race[..., 0], rtol=1e-6, atol=1e-4)
    most = np.abs(due_rows["elements"]).max()
    np.testing.assert_allclose(rows["elements"], due_rows["elements"], atol=1e-6 * most)
