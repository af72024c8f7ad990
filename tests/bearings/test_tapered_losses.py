"""Losses of tapered rollers: what the drive puts in is what places lose, and the rib by hand."""

from math import cos, sin

import pytest

from flexcage import load_static
from flexcage.bearings import losses_of
from flexcage.case import catalogue
from flexcage.case.new import new_case
from flexcage.cli import main
from flexcage.geometry.kinematics import epicyclic
from flexcage.static import solve_static
from flexcage.system.statics.options import AT_START

ENTRY = catalogue.find("30205")
TEXT = new_case(ENTRY.outline, ENTRY.source).text
CASE = load_static(TEXT).replace({"drive.speed": "3000 rpm"})
DRY = {"lubricant.rolling_resistance": "none", "lubricant.oil_fraction": 0.0}
# friction of the rib alone matters to it: Coulomb's, of 0.05
COULOMB = {
    "contacts.rib.friction.law": "step_coulomb", "contacts.rib.friction.static": 0.05,
    "contacts.rib.friction.dynamic": 0.05, "contacts.rib.friction.v_static": "1e-5 m/s",
    "contacts.rib.friction.v_dynamic": "2e-5 m/s",
}  # fmt: skip


def lost(case):
    solution = solve_static(case, options=AT_START)
    b = case.mounted.bearing
    made = losses_of(b)(b, solution, contacts=case.contacts, lubricant=case.lubricant)
    return made, solution, b


@pytest.mark.parametrize(
    "values",
    [
        {"load.axial": "1 kN"},
        {"load.axial": "800 N", "load.radial": "2 kN"},
        {"load.axial": "1 kN", "lubricant.viscosity": "0.2 Pa*s"},
        {"load.axial": "1 kN", "drive.speed": "-2000 rpm"},
    ],
)
def test_places_of_tapered_rollers_lose_what_the_drive_puts_in(values):
    found, solution, _ = lost(CASE.replace(values))
    assert found.torque * solution.speed == pytest.approx(found.total, rel=1e-8)
    assert set(found.places) == {"inner race", "outer race", "inner ribs", "drag"}
    assert all(loss > 0.0 for loss in found.places.values())


def test_a_rib_slides_as_far_as_it_stands_above_the_race():
    """Dry, with races that hold: a roller turns relative to the inner ring about its line of
    contact, w = (w_i - w_c) sin(beta)/sin(eps), and where it bears on the rib it slides at w times
    the distance of that place from the line."""
    found, solution, b = lost(CASE.replace({**DRY, **COULOMB, "load.axial": "1 kN"}))
    rolls = epicyclic(
        element_diameter=b.element_diameter, pitch_diameter=b.pitch_diameter,
        element_count=b.element_count, inner_speed=solution.speed,
        contact_angle=b.nominal_contact_angle,
    )  # fmt: skip
    turns = (solution.speed - rolls.cage_speed) * sin(b.axis_angle) / sin(b.half_angle)
    along, across = b.rib_place
    # from the line of contact, which leaves the roller's bottom at mid-length at the half angle
    away = (across + 0.5 * b.roller_diameter) * cos(b.half_angle) - along * sin(b.half_angle)
    away = abs(away)
    force = solution.elements.axial.sum() / cos(b.axis_angle - b.rib_angle)
    assert found.places["inner ribs"] == pytest.approx(0.05 * force * turns * away, rel=0.02)
    assert found.orbit == pytest.approx(rolls.cage_speed, rel=2e-3)
    assert found.places["inner ribs"] > 0.9 * found.total


def test_a_higher_contact_on_the_rib_loses_more():
    low, *_ = lost(CASE.replace({**COULOMB, "load.axial": "1 kN", "bearing.rib_height": "1.4 mm"}))
    high, *_ = lost(CASE.replace({**COULOMB, "load.axial": "1 kN", "bearing.rib_height": "2.8 mm"}))
    assert high.places["inner ribs"] == pytest.approx(2.0 * low.places["inner ribs"], rel=0.1)


OIL = """
[life]
viscosity_40 = "100 mm^2/s"
viscosity_100 = "11 mm^2/s"
temperature = "40 degC"

[heat]
"""


def test_tapered_bearings_warm_up(tmp_path, capsys):
    """``flexcage warm`` takes their losses, the rib's included, and settles."""
    case = tmp_path / "30205.toml"
    case.write_text(TEXT.replace('speed = "6500 rpm"', 'speed = "3000 rpm"') + OIL, "utf-8")
    assert main(["warm", str(case)]) == 0
    said = capsys.readouterr().out
    assert "Settled after" in said and "inner ribs" in said
