"""Barrels in motion: slopes of one energy, balances, the static solution, free misalignment, pure
rolling, and skew."""

from __future__ import annotations

from math import sin

import numpy as np
import pytest
from barrel_parts import barrels, settled, together, turned_about_the_middle
from bearing_runs import march
from leaning_rollers import (
    check_balance,
    check_energy,
    check_integrators,
    check_power,
    check_slopes,
    miss_of_rollers,
    stir,
)
from scipy.optimize import brentq
from scipy.spatial.transform import Rotation
from tapered_parts import (
    DRY,
    ELASTIC,
    FRICTIONLESS,
    LIGHT,
    begun,
    frames,
    pushed,
)

from flexcage.contacts.laws import iso_line_stiffness
from flexcage.static import solve_static
from flexcage.system.data import NEIGHBOUR_FRICTION, RACE_FRICTION
from flexcage.system.statics.options import AT_START

PAIRS = ((3, 4), (15, 0), (20, 21), (31, 16))
DEGREE = np.radians(1.0)
SLOW = {"load.axial": 0.0, "drive.speed": "500 rpm"}  # without gyroscopic moments to speak of


def test_forces_on_barrels_and_rings_are_slopes_of_one_energy():
    """On x, r, azimuth, skew and tilt of every barrel and on both rings, tilts too."""
    _, bearing = barrels(**FRICTIONLESS, **ELASTIC, **DRY, **LIGHT)
    y, lever = together(bearing, settled(bearing), PAIRS), bearing.spec.pitch_radius
    pushed(bearing, y)
    report = bearing.data.work.report
    assert (report.race[:, :, 0] > 10.0).sum(axis=0).min() > 8
    assert (report.pocket_normal[[i for i, _ in PAIRS], 0] > 10.0).all()
    rollers = (0, 3, 4, 8, 15, 16, 20, 21, 29)
    check_slopes(bearing, y, rollers, arm=4e-3, of_moments=lambda force, moment: force * lever)


def test_the_sphere_bears_no_moment_about_its_middle():
    _, bearing = barrels(**FRICTIONLESS, **ELASTIC, **DRY, **LIGHT)
    y = settled(bearing)
    pushed(bearing, y)
    outer = bearing.layout.border(bearing.data.work.scratch.border)["outer"]
    assert np.abs(outer[:3]).max() > 100.0
    assert np.abs(outer[3:]).max() < 1e-12 * np.abs(outer[:3]).max()


def test_an_inner_ring_may_be_turned_by_a_degree_and_nothing_changes():
    """Rotation of any axis about the bearing's middle, the barrels with it."""
    _, bearing = barrels(**FRICTIONLESS, **ELASTIC, **DRY, **LIGHT)
    y = settled(bearing)
    pushed(bearing, y)
    force = bearing.data.work.report.race[:, :, 0].copy()
    for axis in ((0.0, 1.0, 0.0), (0.0, 0.6, -0.8), (0.3, 0.0, 0.9)):
        turn = Rotation.from_rotvec(DEGREE * np.array(axis))
        pushed(bearing, turned_about_the_middle(bearing, y, turn))
        found = bearing.data.work.report.race[:, :, 0]
        np.testing.assert_allclose(found, force, atol=1e-9 * force.max())


def test_a_misaligned_bearing_starts_with_the_forces_of_a_level_one():
    """Under a load along the axis of the tilt, which is as radial then as before."""
    forces = []
    for tilt in (0.0, DEGREE):
        case, bearing = barrels(
            **FRICTIONLESS, **ELASTIC, **DRY, **LIGHT,
            **{"load.axial": 0.0, "load.direction": "90 deg", "load.misalignment": tilt},
        )  # fmt: skip
        y, yd = begun(case, bearing)
        bearing.residual(0.0, y, yd, mode=2)
        forces.append(bearing.data.work.report.race[:, :, 0].copy())
    level, tilted = forces
    np.testing.assert_allclose(tilted, level, atol=1e-4 * level.max())


def test_all_forces_on_barrels_balance():
    """Friction, damping and rolling resistance included, about any point."""
    _, bearing = barrels(**{"lubricant.oil_fraction": 0.0}, **LIGHT)
    y = together(bearing, settled(bearing), PAIRS)
    stir(bearing, y)
    found = pushed(bearing, y)
    power = bearing.data.work.report.power
    for place in (RACE_FRICTION, NEIGHBOUR_FRICTION):
        assert power[place] < -0.1
    check_balance(found)


def test_power_is_what_contacts_of_barrels_say():
    """What forces do on all velocities is what contacts lose and take from their energy."""
    _, bearing = barrels(**LIGHT)
    check_power(bearing, together(bearing, settled(bearing), PAIRS))


def test_barrels_start_at_their_static_solution():
    """In balance where they truly touch. The static solution is linear in displacements: of loaded
    barrels forces are within 0.3 % of the largest."""
    case, bearing = barrels(**FRICTIONLESS, **ELASTIC, **DRY, **LIGHT)
    y, yd = begun(case, bearing)
    rows = bearing.layout.u(bearing.residual(0.0, y, yd, mode=2))
    report, solution = bearing.data.work.report, solve_static(case, options=AT_START)
    most = solution.elements.force.max()
    np.testing.assert_allclose(report.race[:, :, 0], solution.elements.force, atol=3e-3 * most)
    assert np.abs(rows["elements"][:, :2]).max() < 1e-6 * most
    assert np.abs(rows["elements"][:, 5]).max() < 1e-6 * most * bearing.spec.effective_length
    assert np.abs(rows["inner"][:3]).max() < 1e-6 * most


def rolling(case, bearing):
    """Orbit and spin in the cage of barrels that roll in their middles: points there stand still on
    the outer race, and move with the inner one."""
    spec = bearing.spec
    inner, outer = (0.5 * d for d in spec.race_diameters)
    orbit = case.drive.speed * inner / (inner + outer)
    return orbit, -orbit * outer / (0.5 * spec.roller_diameter)


def test_barrels_roll_in_their_middles_and_slide_beside_them():
    """The sagittas of barrel and groove, or sphere, say how fast slices slide: with them all radii
    change along the line of contact."""
    case, bearing = barrels(**DRY, **LIGHT, **FRICTIONLESS)
    y, yd = begun(case, bearing)
    orbit, turn = rolling(case, bearing)
    u, q = bearing.layout.u(y)["elements"], bearing.layout.q(y)["elements"]
    np.testing.assert_allclose(u[:, 2] / q[:, 1], orbit, rtol=1e-6)
    np.testing.assert_allclose(u[:, 3] - orbit * np.cos(q[:, 4]), turn, rtol=1e-4)
    bearing.residual(0.0, y, yd, mode=2)
    loaded = bearing.data.work.report.race[:, 0, 0] > 100.0
    sliding = np.abs(bearing.data.work.report.race[loaded][:, :, 4])
    assert sliding.max() < 0.01 * abs(turn) * 0.5 * bearing.spec.roller_diameter


@pytest.mark.parametrize("load", [{}, {"load.axial": "3 kN"}])
def test_newton_matrix_of_barrels(load):
    """Left out: how forces turn with geometry, and how friction follows a light contact."""
    case, bearing = barrels(**load)
    assert miss_of_rollers(case, bearing) < 0.2


def test_energy_balance_of_barrels():
    """What is stored changes by what powers brought; loaded barrels keep to pure rolling."""
    case, bearing = barrels()
    h, last = check_energy(case, bearing)
    orbit, _ = rolling(case, bearing)
    loaded = h.samples.race[-1, :, 0, 0] > 300.0
    assert loaded.sum() > 3
    assert last[loaded] == pytest.approx(orbit, rel=3e-3)


def test_both_integrators_move_barrels_alike():
    check_integrators(barrels, 0.2e-3)


def spread(bearing, race, force, n=2000):
    """Mean of x^2 [m^2] over the load of a level barrel's line on a race: the depth is a parabola,
    and the force goes with its power 10/9."""
    spec, half = bearing.spec, 0.5 * bearing.spec.effective_length
    x = half * (2.0 * (np.arange(n) + 0.5) / n - 1.0)
    sagitta = 0.5 * x**2 / spec.profile_radii[race]
    line = iso_line_stiffness(2.0 * half, spec.race_modulus)

    def load(depth):
        return np.maximum(depth - sagitta, 0.0) ** (10.0 / 9.0) * line / n

    share = load(brentq(lambda d: load(d).sum() - force, 0.0, 1e-4, xtol=1e-15)) / force
    return float(share @ x**2)


def test_friction_on_lines_of_contact_turns_barrels_askew():
    """On the line of contact the inner ring turns by (w - w_c) sin(alpha), the outer one by
    -w_c sin(alpha), in a barrel's eyes. Friction in proportion to sliding, k u, has moments of
    k Q <x^2> times that, which leaves about w sin(alpha) Dwe cos(alpha)/Dpw: ends at the bearing's
    middle lead (on such moments: Kellstroem, ASME 79-Lub-23; Kleckner and Pirvics, J. Lubr. Tech.
    104 (1982) 99)."""
    slope, moments = 1e-3, []
    law = {"law": "ehl", "limit": 10.0, "creep_speed": 10.0 / slope}
    for friction in (law, {"law": "none"}):
        given = {f"contacts.race.friction.{key}": value for key, value in friction.items()}
        case, bearing = barrels(**DRY, **LIGHT, **ELASTIC, **given, **SLOW)
        y, _ = begun(case, bearing)
        spec, (_, axes) = bearing.spec, frames(bearing.layout.q(y)["elements"])
        pushed(bearing, y)
        work, force = bearing.data.work.scratch, bearing.data.work.report.race[:, :, 0].copy()
        moments.append(np.einsum("zi,zi->z", axes[:, 1], work.wrenches[:, 3:]))
    found, (orbit, _) = moments[0] - moments[1], rolling(case, bearing)
    turns = np.array([case.drive.speed - orbit, -orbit]) * sin(spec.contact_angle)
    assert turns.sum() == pytest.approx(case.drive.speed * sin(spec.contact_angle) * spec.gamma)
    for i, way in ((0, -1.0), (1, -1.0), (16, 1.0)):
        squares = [spread(bearing, k, force[i, k]) for k in (0, 1)]
        due = way * slope * (turns * force[i]) @ squares
        assert force[i].min() > 500.0
        assert found[i] == pytest.approx(due, rel=0.02)


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_loaded_barrels_run_askew(sense):
    """Their ends at the bearing's middle lead, in either sense of rotation."""
    case, bearing = barrels(**{"load.axial": 0.0, "drive.speed": f"{2000.0 * sense} rpm"})
    h = march(bearing, *begun(case, bearing), duration=3e-3, method="explicit", tolerance=1e-8)
    assert h.outcome == 0
    outwards = np.repeat([-1.0, 1.0], bearing.spec.roller_count)
    loaded = h.samples.race[-1, :, 0, 0] > 300.0
    skew = sense * outwards * bearing.layout.q(h.y)["elements"][-1, :, 3]
    assert loaded.sum() > 4 and (skew[loaded] > 1e-3).all()
