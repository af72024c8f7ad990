"""Losses of barrels: what the drive puts in is what places lose, and what a run dissipates."""

import pytest
from barrel_parts import TEXT, barrels
from bearing_runs import march
from tapered_parts import DRY, LIGHT, begun

from flexcage.bearings import losses_of
from flexcage.cli import main
from flexcage.static import solve_static
from flexcage.system.statics.options import AT_START

RADIAL = {"load.axial": 0.0, "drive.speed": "1500 rpm"}


def lost(case):
    solution, b = solve_static(case, options=AT_START), case.mounted.bearing
    made = losses_of(b)(b, solution, contacts=case.contacts, lubricant=case.lubricant)
    return made, solution


@pytest.mark.parametrize(
    "values", [{}, RADIAL, {"load.axial": "3 kN"}, {"drive.speed": "-2000 rpm"}, DRY]
)
def test_places_of_barrels_lose_what_the_drive_puts_in(values):
    found, solution = lost(barrels(**values)[0])
    assert found.torque * solution.speed == pytest.approx(found.total, rel=1e-6)
    assert set(found.places) == {"inner race", "outer race", "drag"}
    assert found.places["inner race"] > 0.0 and found.places["outer race"] > 0.0


@pytest.mark.parametrize("values, share", [(RADIAL, 0.06), ({}, 0.05), ({**RADIAL, **DRY}, 0.1)])
def test_a_run_of_barrels_dissipates_what_static_losses_say(values, share):
    """Before barrels have skewed far, which static losses leave out; sliding alone in the end."""
    case, bearing = barrels(**LIGHT, **values)
    found, _ = lost(case)
    h = march(bearing, *begun(case, bearing), duration=1e-3, method="explicit", tolerance=1e-8)
    parts = ("race_friction", "rolling_resistance", "drag")
    run = [-(h.power(name)[-1] - h.power(name)[50]) / (h.time[-1] - h.time[50]) for name in parts]
    assert sum(run) == pytest.approx(found.total, rel=share)
    assert run[1] == pytest.approx(found.rolling.sum(), rel=0.04, abs=1e-12)


def test_closer_osculation_slides_more():
    """Lines are longer then, and slices further from those that roll."""
    changes = {**DRY, **RADIAL, "bearing.radial_clearance": 0.0}
    wide, close = (
        lost(barrels(**changes, **{"bearing.barrel_radius": f"{radius} mm"})[0])[0].sliding.sum()
        for radius in (34.5, 35.9)
    )
    assert close > 1.3 * wide


OIL = """
[life]
viscosity_40 = "100 mm^2/s"
viscosity_100 = "11 mm^2/s"
temperature = "40 degC"

[heat]
"""


def test_spherical_bearings_warm_up(tmp_path, capsys):
    case = tmp_path / "22208.toml"
    case.write_text(TEXT.replace('speed = "4100 rpm"', 'speed = "2000 rpm"') + OIL, "utf-8")
    assert main(["warm", str(case)]) == 0
    assert "Settled after" in capsys.readouterr().out
