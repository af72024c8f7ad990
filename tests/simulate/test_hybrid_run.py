"""A hybrid 7010C beside one of steel at 15,000 rpm: light balls press less on the outer race."""

from __future__ import annotations

from math import pi

import numpy as np
import pytest

from flexcage.case import load_case
from flexcage.simulate import simulate
from flexcage.spec import WearLaw

CASE = {
    "bearing": {"preset": "7010C-PI"},
    "cage": {"model": "rigid"},
    "mesh": {"fineness": "coarse"},
    "drive": {"speed": "15000 rpm"},
    "load": {"axial": "300 N"},
    "solver": {"duration": "4 ms"},
}
DENSITY = {"GCr15": 7850.0, "Si3N4": 3200.0}


@pytest.fixture(scope="module")
def runs():
    """By material of the balls: a run, and its samples of the second half."""
    found = {}
    for name in DENSITY:
        made = {"bearing.material": "GCr15", "bearing.element_material": name}
        run = simulate(load_case(CASE, overrides=made))
        found[name] = run, run.dataset.isel(time=slice(run.dataset.sizes["time"] // 2, None))
    return found


@pytest.mark.parametrize("name", DENSITY)
def test_what_the_outer_race_bears_more_is_the_centrifugal_force(runs, name):
    """Q_o cos(a_o) - Q_i cos(a_i) = m v^2/r, but for tractions that hold the gyroscopic moment, a
    hundredth; by a mass that is worked out here."""
    _, ds = runs[name]
    push = ds["race_force"] * np.cos(ds["contact_angle"])
    more = float((push.sel(race="outer") - push.sel(race="inner")).mean())
    speed, radius = ds["element_velocity"].sel(cyl="psi"), ds["element_position"].sel(cyl="r")
    mass = DENSITY[name] * pi / 6.0 * 9.525e-3**3
    assert more == pytest.approx(mass * float((speed**2 / radius).mean()), rel=0.01)


def test_a_hybrid_bearing_presses_less_on_its_outer_race(runs):
    """Both carry 300 N along the axis; the angles of light balls part less."""
    outer, apart = {}, {}
    for name, (run, ds) in runs.items():
        inner = ds.sel(race="inner")
        axial = inner["race_force"] * np.sin(inner["contact_angle"])
        axial = axial - inner["race_traction_across"] * np.cos(inner["contact_angle"])
        assert float(axial.sum("element").mean()) == pytest.approx(300.0, rel=0.01)
        outer[name] = float(ds["race_force"].sel(race="outer").mean())
        angle = ds["contact_angle"].mean(("time", "element"))
        apart[name] = float(angle.sel(race="inner") - angle.sel(race="outer"))
        told = "C is that of steel balls" in " ".join(map(str, run.warnings))
        assert told == (name == "Si3N4")
    assert outer["Si3N4"] < 0.75 * outer["GCr15"]
    assert apart["Si3N4"] < 0.6 * apart["GCr15"]


def test_wear_says_that_its_coefficient_is_of_steel_elements(runs):
    law = WearLaw(material="polyimide", coefficient=1e-15)
    for name, (run, _) in runs.items():
        against = "the coefficient is against steel, and the elements are of Si3N4"
        assert (against in run.wear(law).table(1.0).replace("\n", " ")) == (name == "Si3N4")
