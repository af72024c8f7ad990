"""Two bearings on a rigid shaft: closed forms, and A. B. Jones's equations solved on their own."""

from __future__ import annotations

import sys
from pathlib import Path

import numpy as np
import pytest
from machines import load, pair
from scipy.optimize import brentq

sys.path.insert(0, str(Path(__file__).parents[1] / "system"))
from jones import Balls, Solid, solve

from flexcage.machine.solve import solve_machine

STEEL = Solid(206e9, 0.3, 7850.0)
RPM = np.pi / 30.0


def balls_of(bearing, angle=None):
    return Balls(
        bearing.element_count, bearing.ball_diameter, bearing.pitch_diameter,
        (bearing.inner_conformity, bearing.outer_conformity),
        bearing.free_contact_angle if angle is None else angle, STEEL, STEEL,
    )  # fmt: skip


def axial_force(b, shift):
    """Of a bearing pressed in by so much at rest: Hertz contacts in series along one line."""
    if shift <= 0.0:
        return 0.0
    distance = (sum(b.conformity) - 1.0) * b.diameter
    x, r = distance * np.sin(b.angle) + shift, distance * np.cos(b.angle)
    soft = sum(b.stiffness(outer) ** (-2.0 / 3.0) for outer in (False, True))
    squeeze = np.hypot(x, r) - distance
    return b.count * (squeeze / soft) ** 1.5 * x / np.hypot(x, r)


@pytest.mark.parametrize("faces", [("+x", "-x"), ("-x", "+x"), ("+x", "+x")])
def test_preload_and_push_share_as_closed_forms_say(faces):
    """DB, DF and DT at rest: offsets of 8 um, and a push of 400 N along x."""
    m = pair(faces, axial_offset="8 um", loads=[load(0, 400, 0, 0)])
    found = solve_machine(m)
    b = balls_of(m.bearings[0].case.bearing)
    signs = [1.0 if face == "+x" else -1.0 for face in faces]

    def left(u):
        return sum(s * axial_force(b, 8e-6 + s * u) for s in signs) - 400.0

    u = brentq(left, -1e-4, 1e-4, xtol=1e-16)
    assert found.displacement[0, 0] == pytest.approx(u, rel=1e-8)
    for name, s in zip("AB", signs):
        assert found[name].force[0] == pytest.approx(-s * axial_force(b, 8e-6 + s * u), rel=1e-8)
        assert found[name].solution.load[0] >= 0.0  # in its own axes it is pressed in


@pytest.mark.parametrize("faces", [("+x", "-x"), ("-x", "+x")])
def test_a_preload_force_is_what_both_bear_at_rest(faces):
    found = solve_machine(pair(faces, preload_force="250 N"))
    assert abs(found["A"].force[0]) == pytest.approx(250.0, rel=1e-8)
    assert found["A"].force == pytest.approx(-found["B"].force * [1, 1, 1, 1, 1], abs=1e-6)


@pytest.mark.parametrize(("push", "across"), [(0.0, 0.0), (350.0, 0.0), (0.0, 300.0)])
def test_load_sharing_of_a_pair_is_that_of_jones(push, across):
    """At 12,000 rpm: the forces that each bears move it by as much in Jones's equations. A load
    across acts in the middle, so that neither is tilted."""
    m = pair(axial_offset="10 um", rpm=12000, loads=[load(108, push, across, 0)])
    found = solve_machine(m)
    b, u = balls_of(m.bearings[0].case.bearing), found.displacement[0]
    for name, s in (("A", 1.0), ("B", -1.0)):
        own = found[name]
        alone = solve(b, speed=12000 * RPM, axial=-s * own.force[0], radial=-own.force[1])
        assert alone.displacement[0] == pytest.approx(10e-6 + s * u[0], rel=1e-6)
        assert alone.displacement[1] == pytest.approx(u[1], rel=1e-6, abs=1e-12)
        assert own.solution.elements.force == pytest.approx(alone.force, rel=1e-5)
    assert found["A"].force[0] + found["B"].force[0] == pytest.approx(-push, abs=1e-6)
    assert abs(u[3:]).max() < 1e-12


def test_back_to_back_resists_tilting_more_than_face_to_face():
    db, df = (
        solve_machine(pair(faces, preload_force="250 N")).compliance_at(0.108)[4, 4]
        for faces in (("+x", "-x"), ("-x", "+x"))
    )
    assert df > 1.2 * db


def test_two_bearings_without_clearance_share_a_load_in_the_middle():
    """F = K Sum (d cos psi)^1.5 cos psi over the loaded half of each."""
    bearing = {"radial_clearance": "0 um"}
    place = {"preset": "15x37x10", "apart": 100.0, "bearing": bearing}
    loads = [load(150, 0, 600, 0)]
    m = pair(loads=loads, axial_seat="floating", **place)
    found = solve_machine(m)
    b = balls_of(m.bearings[0].case.bearing, 0.0)
    soft = sum(b.stiffness(outer) ** (-2.0 / 3.0) for outer in (False, True))
    psi = 2.0 * np.pi * np.arange(b.count) / b.count
    pressed = np.maximum(np.cos(psi), 0.0)
    wanted = (300.0 / (soft**-1.5 * (pressed**2.5).sum())) ** (2.0 / 3.0)
    assert found["A"].displacement[1] == pytest.approx(wanted, rel=1e-6)
    assert found["B"].force[1] == pytest.approx(-300.0, rel=1e-9)


def test_the_lever_rule_holds_with_the_moments_of_the_bearings():
    m = pair(apart=120.0, axial_offset="10 um", rpm=6000,
             loads=[load(40, 150, 500, -200), load(280, -50, 0, 300)])  # fmt: skip
    found = solve_machine(m)
    total = sum(b.force[:3] for b in found.bearings)
    assert total == pytest.approx([-100.0, -500.0, -100.0], abs=1e-6)
    about_z = sum(b.position * b.force[1] + b.force[4] for b in found.bearings)
    about_y = sum(-b.position * b.force[2] + b.force[3] for b in found.bearings)
    assert about_z == pytest.approx(-0.04 * 500.0, abs=1e-7)
    assert about_y == pytest.approx(0.04 * -200.0 + 0.28 * 300.0, abs=1e-7)
    # overhangs: the part to the right bears the loads of that to the left
    left, right = (int(np.argmin(np.abs(found.sections.position - x))) for x in (0.1, 0.28))
    assert found.sections.force[left, 4] == pytest.approx(0.06 * 500.0, rel=1e-6)
    assert found.sections.force[right] == pytest.approx([-50.0, 0.0, 300.0, 0.0, 0.0], abs=1e-6)
