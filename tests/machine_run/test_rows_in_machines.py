"""Bearings of two rows on the shaft of a machine that runs, facing either way."""

from __future__ import annotations

import pytest

from flexcage.machine import load_machine
from flexcage.machine_run import simulate_machine

MACHINE = """
name = "rows"
[drive]
speed = "3000 rpm"
[shaft]
kind = "rigid"
[[shaft.sections]]
length = "200 mm"
diameter = "25 mm"
[[shaft.loads]]
position = "20 mm"
force = ["0 N", "800 N", "300 N"]
[[bearings]]
name = "front"
designation = "3205"
position = "50 mm"
facing = "{facing}"
cage.model = "none"
[[bearings]]
name = "rear"
designation = "NN3005"
position = "150 mm"
facing = "-x"
cage.model = "none"
[solver]
duration = "2 ms"
[output]
block = 50
"""


@pytest.mark.parametrize("facing", ["+x", "-x"])
def test_rows_on_a_shaft_bear_what_the_static_solution_says(facing):
    """From the first step on: elements of both rows begin where the static solution has them."""
    run = simulate_machine(load_machine(MACHINE.format(facing=facing)), stress=False)
    front, rear = (run.summary.bearings[name] for name in ("front", "rear"))
    for figures in (front, rear):
        assert figures.radial == pytest.approx(figures.static_radial, rel=0.01)
        assert abs(figures.axial) < 1.0 and abs(figures.static_axial) < 1e-6
    assert front.radial > 1000.0 and rear.radial > 200.0
    for name in ("front", "rear"):
        assert run[name].summary["energy_audit"] == "passed"
        assert sorted(set(run[name].dataset["row"].values)) == [0, 1]
    assert run.summary.missed < 1e-4


@pytest.mark.slow
@pytest.mark.parametrize("facing", ["+x", "-x"])
def test_spherical_bearings_carry_a_shaft_that_turns(facing):
    """Its tilts are held by both together, as neither resists them."""
    text = MACHINE.replace("3205", "22208").replace("NN3005", "22208").replace("25 mm", "40 mm")
    text = text.replace('"150 mm"', '"150 mm"\naxial_seat = "floating"').replace(
        '"none"', '"rigid"'
    )
    run = simulate_machine(load_machine(text.format(facing=facing)), stress=False)
    for figures in run.summary.bearings.values():
        assert figures.radial == pytest.approx(figures.static_radial, rel=0.02)
        assert abs(figures.axial) < 10.0
    assert all(run[name].summary["energy_audit"] == "passed" for name in ("front", "rear"))
    assert run.summary.missed < 1e-4
