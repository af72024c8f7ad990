"""Losses of a static solution: what the drive puts in is what places lose, and rolling by hand."""

from dataclasses import replace

import numpy as np
import pytest

from flexcage.bearings import family, losses_of
from flexcage.case import Case, load_static
from flexcage.core.errors import InputError
from flexcage.geometry.kinematics import epicyclic
from flexcage.static import solve_static
from flexcage.system.statics.options import AT_START


def losses(case):
    solution = solve_static(case, options=AT_START)
    bearing = case.mounted.bearing
    found = losses_of(bearing)(
        bearing, solution, contacts=case.contacts, lubricant=case.lubricant
    )  # fmt: skip
    return found, solution


CASES = {
    "balls, radial load": ("7010C-PI", {"load.axial": "300 N", "load.radial": "500 N"}),
    "balls, axial load, fast": ("7010C-PI", {"load.axial": "300 N", "drive.speed": "15000 rpm"}),
    "balls, backwards": ("7010C-PI", {"load.axial": "300 N", "drive.speed": "-4000 rpm"}),
    "rollers": ("N1013", {"load.radial": "1000 N"}),
    "rollers in thick oil": ("N1013", {"load.radial": "1 kN", "lubricant.viscosity": "0.2 Pa*s"}),
}


@pytest.mark.parametrize(("preset", "values"), CASES.values(), ids=CASES)
def test_the_drive_puts_in_what_places_lose(preset, values):
    found, solution = losses(Case.from_preset(preset).replace(values))
    assert found.torque * solution.speed == pytest.approx(found.total, rel=1e-9)
    assert all(loss > 0.0 for loss in found.places.values())
    races = found.places["inner race"], found.places["outer race"]
    assert found.sliding + found.rolling == pytest.approx(races)


def test_elements_roll_as_kinematics_has_it():
    """Without rolling resistance and drag nothing asks for creep: rollers orbit as if geared, and
    nothing is lost."""
    case = Case.from_preset("N1013").replace(
        {
            "lubricant.rolling_resistance": "none",
            "lubricant.oil_fraction": 0.0,
            "load.radial": "1000 N",
        }
    )
    found, solution = losses(case)
    b = case.bearing
    rolls = epicyclic(
        element_diameter=b.roller_diameter, pitch_diameter=b.pitch_diameter,
        element_count=b.roller_count, inner_speed=solution.speed,
    )  # fmt: skip
    assert found.orbit == pytest.approx(rolls.cage_speed, rel=1e-6)
    assert found.total == pytest.approx(0.0, abs=1e-9)


def test_spin_loses_what_the_ellipse_does_by_hand():
    """Balls under thrust, dry, with Coulomb's friction. Whatever axis a ball turns about, the spins
    of both contacts add up to w sin(a) (their normals are opposite), and strips across an ellipse
    of half axis a lose 3/8 mu Q a per spin (the integral of 3/4 (1 - s^2) |s|). Any other sliding,
    as Heathcote's, comes on top."""
    case = Case.from_preset("7010C-PI").replace(
        {
            "load.axial": "2000 N", "drive.speed": "100 rpm",
            "lubricant.rolling_resistance": "none", "lubricant.oil_fraction": 0.0,
            "contacts.race.friction.law": "step_coulomb", "contacts.race.friction.static": 0.05,
            "contacts.race.friction.dynamic": 0.05, "contacts.race.friction.v_static": "1e-5 m/s",
            "contacts.race.friction.v_dynamic": "2e-5 m/s",
        }
    )  # fmt: skip
    found, solution = losses(case)
    e = solution.elements
    whole = 0.375 * 0.05 * e.force.mean(axis=1) * solution.speed * np.sin(e.angle).mean(axis=1)
    assert (whole * e.across.min(axis=1)).sum() < found.total
    assert found.total < 1.4 * (whole * e.across.max(axis=1)).sum()


def test_thicker_oil_and_more_speed_lose_more():
    case = Case.from_preset("N1013").replace("load.radial", "1000 N")
    thin, solution = losses(case)
    thick, _ = losses(case.replace("lubricant.viscosity", 2.0 * case.lubricant.viscosity))
    assert thick.rolling.sum() > 1.3 * thin.rolling.sum()
    fast, _ = losses(case.replace("drive.speed", 2.0 * case.speed))
    assert fast.torque > thin.torque


RIBS = """
name = "nj"
[bearing]
type = "cylindrical_roller"
design = "NJ"
bore = "30 mm"
outside_diameter = "62 mm"
width = "16 mm"
inner_race_diameter = "37.5 mm"
outer_race_diameter = "55.5 mm"
roller_diameter = "9 mm"
roller_length = "10 mm"
effective_length = "8.67 mm"
roller_count = 13
radial_clearance = "20 um"
rib_diameter = "52.5 mm"
rib_gap = "10.03 mm"
counter_rib_diameter = "41 mm"
counter_rib_gap = "10.05 mm"
[drive]
speed = "3000 rpm"
[load]
radial = "2200 N"
axial = "300 N"
"""


def test_ribs_that_carry_axial_load_rub():
    case = load_static(RIBS)
    found, solution = losses(case)
    assert found.torque * solution.speed == pytest.approx(found.total, rel=1e-9)
    assert found.places["inner ribs"] > 0.0 and found.places["outer ribs"] > 0.0
    # sliding of an end at half the overlap, at 1 to 3 m/s, under 300 N: some watts
    both = found.places["inner ribs"] + found.places["outer ribs"]
    assert 0.05 * 300.0 * 0.5 < both < 0.05 * 300.0 * 6.0


def test_a_family_without_losses_says_so(monkeypatch):
    bearing = Case.from_preset("N1013").bearing
    bare = replace(family.family_of(bearing), losses=None)
    monkeypatch.setattr(family, "family_of", lambda _: bare)
    with pytest.raises(InputError, match="has no losses of a static solution"):
        family.losses_of(bearing)
