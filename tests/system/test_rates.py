"""The equations with their constraints eliminated, against the equations with them."""

from __future__ import annotations

import numpy as np
import pytest
from bearing_runs import SOFT, STATES, disturbed, march, rolling_start
from scipy import sparse

from flexcage.bodies.floating_frame import (
    flexible_body,
    frame_work,
    inertia_terms,
    marked,
    mass_matrix,
)
from flexcage.contacts.spec import Contacts, NormalLaw, PairSpec
from flexcage.core.rotation import matrix_from_quaternion
from flexcage.solve.runge_kutta import EXPLICIT_METHOD
from flexcage.system.data import DRIVE, POWERS
from flexcage.system.rates import cage_accelerations, modal_oscillators, new_rates_work
from flexcage.system.spec import Drive, Load


def rates(bearing, t, y):
    """y' and powers; held coordinates and multipliers are put into y."""
    yd, power = np.empty_like(y), np.empty(len(POWERS))
    bearing.function("rates")(t, y, yd, bearing.args, power)
    return yd, power


@pytest.mark.parametrize("name", STATES)
def test_rates_leave_no_residual(bearing_of, name):
    """F(t, y, y') = 0 in every row, constraints and cage's mass matrix among them."""
    specs, state = STATES[name]
    bearing = bearing_of(**{"load": Load(radial=1000.0), **specs})
    y, _, _ = disturbed(bearing, **state)
    layout = bearing.layout
    held = [k for k in (0, 4, 5) if not bearing.data.model.inner_ring.free[k]]
    layout.u(y)["inner"][held] = 1e-3  # they are held at zero, whatever y says
    yd, power = rates(bearing, 0.0, y)
    left = bearing.residual(0.0, y, yd, mode=2)
    scale = np.ones_like(left)
    force = 0.01 * np.abs(layout.u(bearing.residual(0.0, y, 0.0 * yd))["elements"]).max()
    scale[layout.n_q : layout.n_q + layout.n_u] = force  # momentum rows are in newtons
    assert np.abs(left / scale).max() < 1e-9
    assert not np.any(layout.u(y)["inner"][held])
    again = np.empty(len(power))
    bearing.function("residual")(0.0, y, yd, bearing.args, left, again)
    np.testing.assert_allclose(power, again, rtol=1e-9, atol=1e-9 * np.abs(power).max())
    if name != "shaft":
        drive = layout.multipliers(y)[3] * layout.u(y)["inner"][3]
        assert drive != 0.0 and power[DRIVE] == pytest.approx(drive, rel=1e-12)
    quiet = np.empty_like(y)  # without room for powers, rates are the same
    bearing.function("rates")(0.0, y, quiet, bearing.args, np.empty(0))
    np.testing.assert_array_equal(quiet, yd)


def test_a_drive_that_speeds_up(bearing_of):
    """Its spin is the table's, its acceleration the slope; its torque moves the inertia."""
    drive = Drive(speed=600.0, times=(0.0, 1e-3, 2e-3), speeds=(600.0, 610.0, 580.0))
    bearing = bearing_of(load=Load(radial=1000.0), drive=drive)
    y, _, _ = disturbed(bearing)
    for t, speed, slope in ((0.5e-3, 605.0, 1e4), (1.5e-3, 595.0, -3e4), (3e-3, 580.0, 0.0)):
        yd, _ = rates(bearing, t, y)
        assert bearing.layout.u(y)["inner"][3] == pytest.approx(speed)
        assert bearing.layout.u(yd)["inner"][3] == pytest.approx(slope)
        assert np.abs(bearing.layout.u(bearing.residual(t, y, yd))["inner"]).max() < 1e-9


@pytest.mark.parametrize("name", ["light", "flexible", "shaft", "compliant shaft"])
def test_spectral_radius_against_the_whole_jacobian(bearing_of, name):
    specs, _ = STATES[name]
    bearing = bearing_of(**{"load": Load(radial=1000.0), **specs})
    y, _, _ = disturbed(bearing)
    weight = bearing.error_weights(5e-9)
    tested = np.flatnonzero(weight)
    base, _ = rates(bearing, 0.0, y)
    J = np.empty((len(tested), len(tested)))
    for column, k in enumerate(tested):
        moved = y.copy()
        moved[k] += 1e-3 / weight[k]
        J[:, column] = (rates(bearing, 0.0, moved)[0] - base)[tested] / (1e-3 / weight[k])
    radius = np.abs(np.linalg.eigvals(J)).max()
    step = bearing.stable_step(0.0, y, 0.0 * y)
    assert step == pytest.approx(2.6 / radius, rel=0.1)


def test_eigenmodes_swing_by_themselves(bearing_of):
    """A cage that touches nothing: to the first order, the known equation is all that a mode does;
    whatever mixes modes leaves nothing that could be known."""
    bearing = bearing_of(flexible={"modes": 6})
    layout, modes, body = bearing.layout, bearing.modes, bearing.data.model.cage
    mixed = marked(body._replace(kff=body.kff + 1.0))
    assert len(modal_oscillators(mixed, layout).decay) == 0
    hertz = 900.0 * (1.0 + 0.8 * np.arange(6))
    np.testing.assert_allclose(
        np.hypot(modes.frequency, modes.decay) / (2.0 * np.pi), hertz, rtol=1e-9
    )
    y, _ = rolling_start(bearing)
    layout.u(y)["omega"][:] = 0.0
    still = layout.u(rates(bearing, 0.0, y)[0])["modes"].copy()
    rng = np.random.default_rng(5)
    layout.q(y)["modes"][:] = 1e-8 * rng.standard_normal(6)
    layout.u(y)["modes"][:] = 1e-4 * rng.standard_normal(6)
    moved = rates(bearing, 0.0, y)[0]
    left = layout.u(moved)["modes"] - still
    q, u = y[modes.place[0]], y[modes.place[1]]
    np.testing.assert_array_equal(q, layout.q(y)["modes"])
    np.testing.assert_array_equal(u, layout.u(y)["modes"])
    own = -(modes.frequency**2 + modes.decay**2) * q - 2.0 * modes.decay * u
    np.testing.assert_allclose(left, own, atol=1e-4 * np.abs(own).max())


@pytest.mark.parametrize("specs", [{}, {"load": SOFT}, {"flexible": {"modes": 6}}])
def test_both_methods_go_the_same_way(bearing_of, specs):
    """A loaded bearing that rings after its start, each method at a tight tolerance. Laws without
    damping, which depend on no remembered onset."""
    elastic = PairSpec(normal=NormalLaw(law="elastic"))
    contacts = Contacts(race=elastic, pocket=elastic, side=elastic, rib=elastic)
    outs = {}
    for method, h_max in (("bdf", 4e-8), ("explicit", 1e-7)):
        bearing = bearing_of(**{"load": Load(radial=1000.0), "contacts": contacts, **specs})
        y, yd = rolling_start(bearing)
        bearing.layout.q(y)["inner"][1] = 20e-6
        outs[method] = march(
            bearing, y, yd, duration=0.2e-3, tolerance=1e-13, h_max=h_max, method=method
        )
    bdf, explicit = outs["bdf"], outs["explicit"]
    weight = bearing.error_weights(1e-9)
    assert (
        np.abs((bdf.y - explicit.y) * weight).max() < 3.0
    )  # nanometres, or as much in other units
    np.testing.assert_allclose(bdf.work, explicit.work, atol=1e-4 * np.abs(bdf.work).max())


@pytest.mark.parametrize("eigenmodes", [True, False])
def test_accelerations_of_a_flexible_cage_against_its_whole_mass_matrix(eigenmodes):
    """The modes eliminated by their own inverse: one by one where they are orthogonal."""
    rng = np.random.default_rng(4)
    points, mass, n = rng.normal(size=(40, 3)), rng.uniform(0.5, 1.5, 40), 5
    shapes = rng.normal(size=(40, 3, n))
    if eigenmodes:
        modal = np.einsum("a,aik,ail->kl", mass, shapes, shapes)
        shapes = shapes @ np.linalg.inv(np.linalg.cholesky(modal)).T
    body = flexible_body(points, sparse.diags(mass).tocsr(), shapes, np.eye(n)).data
    assert body.plain == eigenmodes
    frame, work, A = frame_work(n), new_rates_work(body.mff), np.empty((3, 3))
    matrix_from_quaternion(np.array([0.8, 0.0, 0.6, 0.0]), A)
    inertia_terms(body, rng.normal(size=3), 0.1 * rng.normal(size=n), rng.normal(size=n), frame)
    force = rng.normal(size=6 + n)
    expected = np.linalg.solve(
        mass_matrix(body, frame), np.concatenate([A.T @ force[:3], force[3:]])
    )
    expected[:3] = A @ expected[:3]
    cage_accelerations(frame.rigid, frame.coupled, body.plain, A, force, work)
    np.testing.assert_allclose(force, expected, rtol=1e-9)


def test_bearings_of_a_kind_share_their_compiled_functions(bearing_of):
    """Compiled code is never freed: a worker that simulates case after case would grow."""
    one, other = bearing_of(), bearing_of(load=Load(radial=2000.0))
    assert one.evaluate is other.evaluate and one.separate == other.separate
    assert one.functions(EXPLICIT_METHOD) == other.functions(EXPLICIT_METHOD)
