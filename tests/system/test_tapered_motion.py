"""Tapered rollers in motion: slopes of one energy, balances, the static solution, pure rolling of
cones, and what the large rib does."""

from __future__ import annotations

from math import cos, sin, tan

import numpy as np
import pytest
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
from tapered_parts import (
    COULOMB,
    DRY,
    ELASTIC,
    FRICTIONLESS,
    LIGHT,
    begun,
    caged,
    pressed,
    pushed,
    tapered,
    together,
)

from flexcage.stages import assembled_start
from flexcage.static import solve_static
from flexcage.system.data import NEIGHBOUR_FRICTION, RACE_FRICTION, RIB_FRICTION
from flexcage.system.statics.options import AT_START

PAIRS = ((3, 4), (9, 10), (16, 0))
LARGE_RIB = 1
TILTING = {"load.tilt": "free", "load.tilt_stiffness": "20 kN m/rad"}


def test_forces_on_tapered_rollers_and_rings_are_slopes_of_one_energy():
    """On x, r, azimuth, skew and tilt of every roller and on both rings, tilts too."""
    _, bearing = tapered(**FRICTIONLESS, **ELASTIC, **DRY, **LIGHT)
    y = together(bearing, pressed(bearing), PAIRS)
    pushed(bearing, y)
    report = bearing.data.work.report
    assert (report.race[:, :, 0] > 10.0).sum() > 12 and (report.rib[:, LARGE_RIB] > 1.0).sum() > 4
    assert (report.pocket_normal[[i for i, _ in PAIRS], 0] > 10.0).all()
    rollers = (0, 3, 4, 8, 10, 16)
    check_slopes(bearing, y, rollers, arm=5e-3, of_moments=lambda force, moment: moment)


def test_all_forces_on_tapered_rollers_balance():
    """Friction, damping and rolling resistance included, about any point."""
    _, bearing = tapered(**{"lubricant.oil_fraction": 0.0}, **LIGHT)
    y = together(bearing, pressed(bearing), PAIRS)
    stir(bearing, y)
    found = pushed(bearing, y)
    power = bearing.data.work.report.power
    for place in (RACE_FRICTION, RIB_FRICTION, NEIGHBOUR_FRICTION):
        assert power[place] < -0.1
    check_balance(found)


def test_power_is_what_contacts_of_tapered_rollers_say():
    """What forces do on all velocities is what contacts lose and take from their energy."""
    _, bearing = tapered(**LIGHT)
    check_power(bearing, together(bearing, pressed(bearing), PAIRS))


@pytest.mark.parametrize("tilt, share", [(0.0, 2e-4), (1e-3, 1e-3), (3e-3, 5e-3)])
def test_a_tapered_bearing_starts_at_its_static_solution(tilt, share):
    """Forces of races and rib of exact cones are those of the static solution, which is linear and
    has no skew, within what it leaves out; rollers and the ring balance in all but friction's."""
    case, bearing = tapered(
        **FRICTIONLESS, **ELASTIC, **DRY, **LIGHT,
        **{"drive.speed": "6000 rpm", "load.misalignment": tilt},
    )  # fmt: skip
    start = assembled_start(case, bearing)
    rows = bearing.layout.u(bearing.residual(0.0, start.y, start.yd, mode=2))
    report, solution = bearing.data.work.report, solve_static(case, options=AT_START)
    e, spec = solution.elements, bearing.spec
    most = e.force.max()
    assert report.race[:, :, 0] == pytest.approx(e.force, abs=share * most)
    along = report.rib[:, LARGE_RIB] * cos(spec.axis_angle - spec.rib_angle)
    assert along == pytest.approx(e.axial, abs=max(2e-3, 15.0 * share) * e.axial.max())
    assert np.abs(rows["elements"][:, :2]).max() < 1e-6 * most
    assert np.abs(rows["elements"][:, 3:]).max() < 1e-6 * most * spec.effective_length
    assert np.abs(rows["elements"][:, 2]).max() < 5e-4 * most
    assert np.abs(rows["inner"][:3]).max() < 1e-6 * 3000.0
    border = bearing.layout.border(bearing.data.work.scratch.border)["inner"]
    held = border[3:][[1, 2]] + solution.reaction[3:]
    assert np.abs(held).max() < max(2e-3, 2.0 * share) * 3000.0 * spec.pitch_radius
    assert start.residual < 1e-6 and not start.warnings


@pytest.mark.parametrize("changes", [TILTING, {"drive.speed": 0.0}, {"load.radial": "4.5 kN"}])
def test_tapered_rollers_find_their_balance_at_the_start(changes):
    """In pockets too, with rings that stand, that are free to tilt, and whose load leaves half of
    the rollers unloaded."""
    case, bearing = caged(**{"load.misalignment": 2e-3, "load.axial": "2 kN"} | changes)
    start = assembled_start(case, bearing)
    assert start.residual < 1e-6 and not start.warnings


def rolling(spec, speed):
    """Orbit and spin about the own axis in the cage, by the angles of cones with one apex: points
    of the roller on the outer race's line stand still."""
    inner, outer = spec.race_angles
    orbit = speed * sin(inner) / (sin(inner) + sin(outer))
    return orbit, -orbit * sin(outer) / sin(spec.half_angle)


def test_cones_with_one_apex_roll_without_sliding():
    """Nothing slides anywhere along the lines under a light load."""
    changes = {"load.radial": 0.0, "load.axial": "300 N"}
    case, bearing = tapered(**DRY, **LIGHT, **COULOMB, **changes)
    y, _ = begun(case, bearing)
    spec, u = bearing.spec, bearing.layout.u(y)["elements"]
    orbit, turn = rolling(spec, case.drive.speed)
    assert u[:, 2] / bearing.layout.q(y)["elements"][:, 1] == pytest.approx(orbit, rel=1e-9)
    assert u[:, 3] - orbit * np.cos(spec.axis_angle) == pytest.approx(turn, rel=1e-6)
    bearing.residual(0.0, y, 0.0 * y, mode=2)
    report = bearing.data.work.report
    rolled = abs(turn) * 0.5 * spec.roller_diameter
    force = report.race[:, :, 0].sum()
    assert force > 1.0
    assert abs(report.power[RACE_FRICTION]) < 1e-3 * 0.05 * force * rolled


def test_the_rib_slides_and_loses_power_as_cones_have_it():
    """Relative to the inner ring a roller turns about the line on which it rolls; the rib's contact
    lies above that. Coulomb's friction takes mu Q times the sliding speed."""
    case, bearing = tapered(**COULOMB, **DRY, **LIGHT)
    y, _ = begun(case, bearing)
    bearing.residual(0.0, y, 0.0 * y, mode=2)
    spec, report, speed = bearing.spec, bearing.data.work.report, case.drive.speed
    orbit, _ = rolling(spec, speed)
    about_line = (speed - orbit) * sin(spec.axis_angle) / sin(spec.half_angle)
    along, across = spec.rib_place
    edge = 0.5 * spec.roller_diameter - along * tan(spec.half_angle)
    height = (edge + across) * cos(spec.half_angle)
    force = report.rib[:, LARGE_RIB].sum()
    assert 0.5e-3 < height < 1e-3 and force > 100.0
    due = -0.05 * force * about_line * height
    assert report.power[RIB_FRICTION] == pytest.approx(due, rel=5e-3)
    share = -report.power[RIB_FRICTION] / speed  # of the moment on the inner ring
    assert 0.01 < share < 0.1


@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_rib_friction_turns_large_ends_forwards(sense):
    """The rib runs ahead of the ends and drags them along, so that loaded rollers skew with their
    large ends ahead; without its friction they do not."""
    skews = []
    for law in ("step_coulomb", "none"):
        case, bearing = tapered(
            **DRY, **LIGHT,
            **{"drive.speed": f"{1500.0 * sense} rpm", "contacts.rib.friction.law": law},
        )  # fmt: skip
        h = march(bearing, *begun(case, bearing), duration=1.5e-3, method="explicit",
                  tolerance=1e-8)  # fmt: skip
        assert h.outcome == 0
        q = bearing.layout.q(h.y)["elements"]
        loaded = h.samples.race[-1, :, 0, 0] > 100.0
        skews.append(sense * q[-1, loaded, 3])
    dragged, free = skews
    assert (dragged > 0.0).all() and dragged.mean() > 5.0 * np.abs(free).max()


def test_energy_balance_of_tapered_rollers():
    """What is stored changes by what powers brought; rollers keep to pure rolling."""
    case, bearing = tapered()
    h, last = check_energy(case, bearing)
    orbit, _ = rolling(bearing.spec, case.drive.speed)
    loaded = h.samples.race[-1, :, 0, 0] > 100.0
    assert last[loaded] == pytest.approx(orbit, rel=3e-3)


@pytest.mark.parametrize("load", [{}, {"load.axial": "6 kN"}, {"load.tilt": "free"}])
def test_newton_matrix_of_tapered_rollers(load):
    """Left out: how friction on races follows geometry."""
    case, bearing = tapered(**load, **({"load.radial": "300 N"} if "load.tilt" in load else {}))
    assert miss_of_rollers(case, bearing) < 0.06


@pytest.mark.slow
def test_both_integrators_move_tapered_rollers_alike():
    check_integrators(tapered, 0.5e-3)
