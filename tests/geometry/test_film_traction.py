"""Traction of a lubricant's film: its patch, its two compliances, and the law that a case gets."""

from __future__ import annotations

from math import exp, pi, sqrt

import pytest

import flexcage
from flexcage.case import load_case
from flexcage.case.presets import load_preset
from flexcage.core.errors import InputError
from flexcage.geometry.film import Oil, creep_speed

OIL = Oil(0.01, 2e-8)
CASE = {"bearing": {"preset": "7010C-PI"}, "drive": {"speed": "4000 rpm"},
        "load": {"axial": "100 N"}}  # fmt: skip


@pytest.mark.parametrize("race", [0, 1])
def test_mean_pressure_over_the_patch_is_the_load(race):
    ball = load_preset("7010C-PI").bearing
    contact = ball.contacts[race]
    a, b = contact.semi_axes(20.0)
    mean, half = ball.contact_patch(20.0, 1.5 * 20.0 / (pi * a * b), race)
    assert half == pytest.approx(b) and mean * pi * a * b == pytest.approx(20.0)
    roller = load_preset("N1013").bearing
    load, E = 300.0 / roller.effective_length, roller.material.plane_strain_modulus
    R = 0.5 * roller.roller_diameter * roller.inner_race_radius
    R /= 0.5 * roller.roller_diameter + roller.inner_race_radius
    mean, half = roller.contact_patch(300.0, sqrt(load * E / (2.0 * pi * R)), race)
    assert half == pytest.approx(sqrt(8.0 * load * R / (pi * E)))  # Johnson, Contact Mechanics 4.3
    assert mean * 2.0 * half == pytest.approx(load)


def test_a_film_creeps_viscously_and_elastically():
    known = {"limit": 0.05, "film": 0.3e-6, "half_length": 0.1e-3, "oil": OIL}
    thin = creep_speed(**known, pressure=2e8, speed=0.0, shear_modulus=5e7)
    assert thin == pytest.approx(0.05 * 2e8 * 0.3e-6 / (0.01 * exp(4.0)))
    stiff = creep_speed(**known, pressure=1.5e9, speed=10.0, shear_modulus=5e7)
    assert stiff == pytest.approx(0.05 * 1.5e9 * 0.3e-6 * 10.0 / (5e7 * 0.1e-3), rel=1e-6)
    both = creep_speed(**known, pressure=2e8, speed=10.0, shear_modulus=5e7)
    assert both - thin == pytest.approx(stiff * 2.0 / 15.0, rel=1e-6)


def test_a_case_takes_the_law_of_its_film_and_runs_with_it():
    case = load_case(CASE, overrides={"cage.model": "rigid", "mesh.fineness": "coarse"})
    law = flexcage.ehl_traction(case, limit=0.05)
    assert law.limit == 0.05 and 1e-3 < law.creep_speed < 1.0
    softer = flexcage.ehl_traction(case, limit=0.05, shear_modulus=25e6)
    assert law.creep_speed < softer.creep_speed < 2.0 * law.creep_speed
    case = case.replace("contacts.race.friction", law).replace("solver.duration", "2 ms")
    again = load_case(case.to_toml())
    assert again.contacts.race.friction == law
    summary = flexcage.simulate(case).summary
    assert summary["energy_audit"] == "passed" and abs(summary["cage_slip_ratio"]) < 0.02


def test_the_film_is_that_of_the_first_speed():
    table = {"drive.times": ["0 s", "1 s"], "drive.speeds": ["1000 rpm", "2000 rpm"]}
    of_table = flexcage.ehl_traction(load_case(CASE, overrides=table))
    assert of_table == flexcage.ehl_traction(load_case(CASE, overrides={"drive.speed": "1000 rpm"}))


def test_standing_still_has_no_film():
    with pytest.raises(InputError, match="stands still at the start .drive.speed.: without motion"):
        flexcage.ehl_traction(load_case(CASE, overrides={"drive.speed": "0 rpm"}))
