"""Frictional torque of three bearings beside published models; nothing here is fitted to them.

pytest tests/verification/test_friction_torque.py -s    prints the table of examples/heat.md
"""

import re
from math import radians
from pathlib import Path

import pytest
from friction_models import (
    Size,
    palmgren,
    palmgren_angular,
    skf_cylindrical_2,
    skf_deep_groove_62,
)

from flexcage.bearings import losses_of
from flexcage.case import load_static
from flexcage.static import solve_static

PAGE = Path(__file__).parents[2] / "examples" / "heat.md"
NU = 20.0  # mm^2/s
DENSITY = 860.0
OIL = {"viscosity": f"{1e-6 * NU * DENSITY} Pa*s", "density": f"{DENSITY} kg/m^3"}
BALL_6206 = {
    "type": "deep_groove_ball", "bore": "30 mm", "outside_diameter": "62 mm", "width": "16 mm",
    "pitch_diameter": "46 mm", "ball_diameter": "9.525 mm", "ball_count": 9,
    "inner_groove_radius": "4.9054 mm", "outer_groove_radius": "5.0006 mm",
    "radial_clearance": "10 um",
}  # fmt: skip
NU_206 = {
    "type": "cylindrical_roller", "bore": "30 mm", "outside_diameter": "62 mm", "width": "16 mm",
    "inner_race_diameter": "37.5 mm", "outer_race_diameter": "55.5 mm", "roller_diameter": "9 mm",
    "roller_length": "10 mm", "effective_length": "8.67 mm", "roller_count": 13,
    "radial_clearance": "20 um", "design": "NU", "rib_diameter": "52.5 mm", "rib_gap": "10.03 mm",
}  # fmt: skip
C7010 = {"preset": "7010C-PI"}


def torque(bearing, rpm, **load):
    """Own rolling and sliding torque, and that of drag [N mm]."""
    table = {
        "bearing": bearing, "lubricant": OIL, "drive": {"speed": f"{rpm} rpm"},
        "load": {name: f"{value} N" for name, value in load.items()},
    }  # fmt: skip
    case = load_static(table)
    solution = solve_static(case)
    found = losses_of(case.bearing)(
        case.bearing, solution, contacts=case.contacts, lubricant=case.lubricant
    )
    speed = solution.speed / 1e3
    return found.rolling.sum() / speed, found.sliding.sum() / speed, found.places["drag"] / speed


def rows():
    """Of every case: its name, own parts, and the model's two parts."""
    small, seven = Size(30.0, 62.0), Size(50.0, 80.0)
    for rpm, radial, axial in ((1500, 980, 0), (3000, 980, 0), (6000, 980, 0), (3000, 980, 400)):
        load = {"radial": radial, **({"axial": axial} if axial else {})}
        yield (
            f"6206, {rpm} rpm, Fr {radial} N" + (f", Fa {axial} N" if axial else ""), "SKF",
            torque(BALL_6206, rpm, **load),
            skf_deep_groove_62(small, radial, axial, 11300.0, n=rpm, nu=NU),
        )  # fmt: skip
    for rpm, radial in ((1500, 2200), (3000, 2200), (6000, 2200)):
        own = torque(NU_206, rpm, radial=radial)
        name = f"NU 206, {rpm} rpm, Fr {radial} N"
        yield name, "SKF", own, skf_cylindrical_2(small, radial, 0.0, n=rpm, nu=NU)
        yield name, "Palmgren", own, palmgren(small, radial, f0=2.0, f1=3e-4, n=rpm, nu=NU)
    for rpm in (3000, 10000):
        yield (
            f"7010C, {rpm} rpm, Fa 500 N", "Palmgren", torque(C7010, rpm, axial=500),
            palmgren_angular(seven, 0.0, 500.0, 21900.0, angle=radians(15.0), n=rpm, nu=NU),
        )  # fmt: skip


def printed(row):
    name, model, own, other = row
    ratio = sum(own) / sum(other)
    cells = (f"{v:.1f}" for v in (own[0], own[1] + own[2], sum(own), *other, sum(other)))
    return f"| {name} | {model} | {' | '.join(cells)} | {ratio:.2f} |"


@pytest.fixture(scope="module")
def table():
    return list(rows())


def test_torque_is_of_the_models_order(table):
    """Isothermal flooded films, and no cage: within a factor of the fits to whole bearings; what
    lies beyond would be a slip, not a model's difference."""
    for row in table:
        print("\n" + printed(row), end="")
        _, _, own, other = row
        assert 0.3 < sum(own) / sum(other) < 2.0, row[0]


def test_the_page_has_these_numbers(table):
    """examples/heat.md prints the table of this file."""
    text = PAGE.read_text("utf-8")
    for row in table:
        assert printed(row) in text, printed(row)
    assert len(re.findall(r"^\| (6206|NU 206|7010C), ", text, re.MULTILINE)) == len(table)
