"""A shaft in spherical roller bearings stands on two points: the lever rule, and no moments."""

from pathlib import Path

import pytest

import flexcage

MOTOR = Path(__file__).parents[2] / "examples/motor.toml"


def test_spherical_roller_bearings_bear_a_shaft_as_two_points_do(tmp_path):
    text = MOTOR.read_text("utf-8").replace('"6306"', '"22206"')
    text = text.replace('"NU 206"', '"22206"\naxial_seat = "floating"')
    (tmp_path / "motor.toml").write_text(text, "utf-8")
    solution = flexcage.solve_machine(flexcage.load_machine(tmp_path / "motor.toml"))
    shaft, fixed, floating = solution.shaft, solution["fixed"], solution["floating"]
    middles = 0.5 * (shaft.places[1:] + shaft.places[:-1])
    weights = [(18.0, 0.180)]
    weights += [(b.mass_per_length * b.length, x) for b, x in zip(shaft.beams, middles)]
    moment = sum(9.80665 * mass * (x - fixed.position) for mass, x in weights)
    moment += 1200.0 * (0.400 - fixed.position)
    due = moment / (floating.position - fixed.position)
    assert floating.force[1] == pytest.approx(due, rel=1e-7)
    for bearing in (fixed, floating):
        assert abs(bearing.force[3:]).max() < 1e-6
