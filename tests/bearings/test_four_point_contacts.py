"""Which contacts of a four-point contact bearing carry, over load and speed: against a solver of
its own (``least_energy``), and where contacts open and close against equations written out."""

from dataclasses import replace
from math import cos, hypot, pi, sin

import numpy as np
import pytest
from least_energy import LeastEnergy
from qj208 import QJ208, solved
from scipy.optimize import brentq, fsolve

from flexcage.bearings import statics_of
from flexcage.system.spec import Load
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.solve import solve_bearing

RPM = pi / 30.0
SPLIT = replace(QJ208, outer_shim=0.0)
PRELOADED = replace(QJ208, contact_angle=None, radial_clearance=-6e-6)
NAMES = {
    ("inner", 1.0): "inner -x", ("inner", -1.0): "inner +x", ("outer", 1.0): "outer +x",
    ("outer", -1.0): "outer -x", ("outer", 0.0): "outer",
}  # fmt: skip


def both(bearing, load, cage_speed=0.0):
    """Our solution with a prescribed cage speed, and the least energy."""
    ours = solve_bearing(
        bearing, statics_of(bearing), speed=2.4 * cage_speed,
        load=Load(axial=load[0], radial=load[1], moment_z=load[4], tilt="free"),
        options=StaticOptions(gyroscopic="none", cage_speed=cage_speed),
    )  # fmt: skip
    return ours, LeastEnergy(bearing, np.array(load), cage_speed).solved()


@pytest.mark.parametrize("bearing", [QJ208, SPLIT, PRELOADED], ids=["four", "three", "preload"])
@pytest.mark.parametrize("speed", [0.0, 8000.0 * RPM])
@pytest.mark.parametrize(
    "load", [(2e3, 0.0), (500.0, 3e3), (2e3, 2e3), (1e3, 3e3, 15.0)],
    ids=["axial", "radial", "both", "moment"],
)  # fmt: skip
def test_all_contacts_agree_with_the_least_energy(bearing, load, speed):
    axial, radial, *moment = load
    ours, (ring, forces) = both(bearing, (axial, radial, 0.0, 0.0, *(moment or [0.0])), speed)
    np.testing.assert_allclose(ours.displacement[:3], ring[:3], atol=2e-10)
    np.testing.assert_allclose(ours.displacement[3:], ring[3:], atol=1e-8)
    most = ours.elements.force.max()
    for key, due in forces.items():
        np.testing.assert_allclose(ours.elements.arcs[NAMES[key]], due, atol=1e-4 * most)


def of_two(axial, omega):
    """A ball on one arc a race under its share of an axial load: forces and angles at both, by
    Harris' equations; Jones' orbit under outer-race control."""
    b, each = QJ208, axial / QJ208.ball_count
    stiff, lengths = [c.stiffness for c in b.contacts], b.lengths

    def left(z):
        q_i, q_o, a_i, a_o = each * np.exp(z[0]), each * np.exp(z[1]), z[2], z[3]
        reach = [length + (q / k) ** (2 / 3) for length, q, k in zip(lengths, (q_i, q_o), stiff)]
        share = b.ball_diameter / b.pitch_diameter
        orbit = omega * (1.0 - share * cos(a_i)) / (1.0 + cos(a_i - a_o))
        radius = b.outer_groove_centre[1] + reach[1] * cos(a_o)
        away = b.ball_mass * radius * orbit**2
        return [
            q_i * sin(a_i) / each - 1.0,
            q_o * sin(a_o) / each - 1.0,
            (q_o * cos(a_o) - q_i * cos(a_i) - away) / each,
            1e6 * (reach[0] * cos(a_i) + reach[1] * cos(a_o) - b.groove_offset[1]),
        ]

    z, _, ok, text = fsolve(left, [0.55, 0.55, 0.62, 0.6], full_output=True)
    assert ok == 1, text
    return each * np.exp(z[1]), z[3]


def gap(axial, omega):
    """Of such a ball from the outer race's other arc [m]."""
    force, angle = of_two(axial, omega)
    reach = QJ208.lengths[1] + (force / QJ208.contacts[1].stiffness) ** (2 / 3)
    across = reach * sin(angle) - QJ208.outer_shim
    return QJ208.lengths[1] - hypot(across, reach * cos(angle))


@pytest.mark.parametrize("axial", [500.0, 2e3])
def test_speed_lays_balls_on_the_other_outer_arc_where_two_contacts_reach_it(axial):
    """From two contacts to three: where the ball on two touches the other arc."""
    speed = brentq(lambda omega: gap(axial, omega), 100.0, 3000.0, xtol=1e-9)
    for share, there in ((0.999, False), (1.001, True)):
        found = solved(axial=axial, speed=share * speed, gyroscopic="none")
        arcs = found.elements.arcs
        assert (arcs["outer -x"] > 0.0).all() == there == (arcs["outer -x"] > 0.0).any()
        assert not arcs["inner +x"].any()


def inner_arcs(speed):
    """Forces of ball 0 on both inner arcs of a preloaded bearing, by us and by the least energy."""
    ours, (_, forces) = both(PRELOADED, (200.0, 0.0, 0.0, 0.0, 0.0), speed)
    names = ("inner -x", "inner +x")
    return [ours.elements.arcs[n][0] for n in names], [forces["inner", s][0] for s in (1.0, -1.0)]


def test_speed_lifts_balls_off_the_other_inner_arc():
    """The lesser of both opens as the least energy has it; then one is left, with the load."""
    ours, due = np.array([inner_arcs(s) for s in (0.0, 300.0, 600.0, 900.0, 1500.0)]).swapaxes(0, 1)
    np.testing.assert_allclose(ours, due, atol=0.02)
    assert (np.diff(ours[:, 1]) <= 0.0).all() and (ours[:3, 1] > 10.0).all()
    assert (ours[3:, 1] == 0.0).all() and (ours[3:, 0] > 20.0).all()


@pytest.mark.parametrize("speed", [0.0, 9000.0 * RPM])
def test_more_axial_load_takes_balls_from_four_contacts_to_two(speed):
    """Numbers of contacts of balls, over axial load beside 2 kN radially."""
    count, both_inner = [], []
    for axial in (0.0, 200.0, 1e3, 3e3, 6e3):
        arcs = solved(axial=axial, radial=2e3, speed=speed).elements.arcs
        count.append(np.sum([f > 0.0 for f in arcs.values()], axis=0))
        both_inner.append(np.sum((arcs["inner -x"] > 0.0) & (arcs["inner +x"] > 0.0)))
    assert count[0].max() == 4 and (count[-1] == 2).all()
    assert both_inner[0] >= 3 and (np.diff(both_inner) <= 0).all()


def test_gyroscopic_moment_is_that_of_two_contacts_and_none_of_four_alike():
    two, four = solved(axial=2e3, speed=900.0), solved(radial=3e3, speed=900.0)
    assert (two.elements.gyroscopic > 0.0).all()
    np.testing.assert_allclose(four.elements.gyroscopic, 0.0, atol=1e-9)
    share = QJ208.ball_diameter / QJ208.pitch_diameter
    inner, outer = np.abs(four.elements.angle[0])
    orbit = 900.0 * (1.0 - share * cos(inner)) / (1.0 + cos(inner - outer))
    assert four.elements.orbital_speed[0] == pytest.approx(orbit, rel=1e-9)
