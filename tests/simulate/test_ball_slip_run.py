"""A 6205 at 10,000 rpm whose axial load turns the contact angles: its balls nearly roll."""

from __future__ import annotations

import pytest

from flexcage.case import load_case
from flexcage.simulate import simulate

B6205 = """
name = "6205"
[bearing]
type = "deep_groove_ball"
designation = "6205"
bore = "25 mm"
outside_diameter = "52 mm"
width = "15 mm"
pitch_diameter = "39.04 mm"
ball_diameter = "7.938 mm"
ball_count = 9
radial_clearance = "10 um"
inner_groove_radius = "4.088 mm"
outer_groove_radius = "4.168 mm"
[cage]
model = "rigid"
bore = "36.5 mm"
outside_diameter = "41.6 mm"
width = "12 mm"
pocket_diameter = "8.2 mm"
material = "PA66"
[mesh]
fineness = "coarse"
[drive]
speed = "10000 rpm"
[load]
radial = "500 N"
[solver]
duration = "26 ms"
"""


@pytest.mark.parametrize(
    ("axial", "reference", "nominal_slip"),
    [("200 N", 4015.9, -0.0097), ("1000 N", 4034.1, -0.0149)],
)
def test_slip_under_axial_load_is_what_curved_contacts_make(axial, reference, nominal_slip):
    """The nominal angle of 0 would have 1 to 1.5 % of slip. What is left by the actual angles is
    0.1 % or less off the slip that the grooves' curvature makes of rolling balls."""
    run = simulate(load_case(B6205, overrides={"load.axial": axial}))
    s = run.summary
    rpm = 3.141592653589793 / 30
    assert s["epicyclic_speed_nominal"] == pytest.approx(3983.35 * rpm, rel=1e-5)
    assert s["epicyclic_speed"] == pytest.approx(reference * rpm, rel=3e-4)
    assert s["cage_slip_ratio_nominal"] == pytest.approx(nominal_slip, abs=5e-4)
    assert -0.003 < s["cage_slip_ratio"] < -0.001
    assert -0.007 < s["slip_loaded"] < -0.002
    assert s["slip_loaded"] == pytest.approx(s["slip_curvature"], abs=1.5e-3)
    assert "balls roll" in s.row("slip_loaded").note
    assert s.row("cage_slip_ratio").note.startswith("the grooves' curvature alone makes -0.")


def test_without_axial_load_both_references_are_one():
    s = simulate(load_case(B6205)).summary
    assert s["epicyclic_speed"] == pytest.approx(s["epicyclic_speed_nominal"], rel=1e-9)
    assert 0.0 < s["cage_slip_ratio"] < 0.01, "unloaded balls hold the cage back"
    assert abs(s["slip_loaded"]) < 0.005
