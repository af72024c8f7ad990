"""Ribs of either ring in motion: who is guided by whom, and axial load through rollers."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from bearing_runs import BETWEEN_RIBS, NU, NUP, march
from roller_designs import DESIGNS
from solved_bearings import solve_bearing

from flexcage.system.spec import Drive, Load
from flexcage.system.start import find_start
from flexcage.system.statics.options import StaticOptions

NJ = {**NUP, "design": "NJ"}
STILL = Drive(speed=0.0)


def started(bearing):
    return find_start(bearing, limit_force=2e4)


def report_of(bearing, start):
    bearing.residual(0.0, start.y, start.yd, mode=2)
    return bearing.data.work.report


@pytest.mark.parametrize(
    ("design", "load"),
    [
        (NJ, Load(axial=2200.0, gravity=0.0)),
        (NJ, Load(axial=600.0, radial=3000.0, gravity=0.0)),
        (NUP, Load(axial=-600.0, radial=3000.0, direction=0.4, gravity=0.0)),
        ({**NJ, "design": "NF", "rib_diameter": 78.4e-3, "counter_rib_diameter": 86.6e-3},
         Load(axial=600.0, radial=3000.0, gravity=0.0)),
    ],
)  # fmt: skip
def test_the_start_is_the_static_solution(bearing_of, design, load):
    """Other code, which shares neither unknowns nor contact kernels; angles are small there."""
    bearing = bearing_of(bearing=design, load=load, drive=STILL)
    start = started(bearing)
    report = report_of(bearing, start)
    static = solve_bearing(DESIGNS[design["design"]], load=load, options=StaticOptions())
    way = int(np.sign(load.axial))
    model = bearing.data.model
    outer = report.rib[:, model.outer_rib.column + (0 if way > 0 else 1)]
    inner = report.rib[:, model.rib.column + (1 if way > 0 else 0)]
    assert outer.sum() == pytest.approx(abs(load.axial), rel=1e-3)
    assert inner == pytest.approx(outer, abs=1e-3 * outer.max())
    assert way * outer == pytest.approx(static.elements.axial, abs=0.01 * outer.max())
    forces = report.race[:, :, 0]
    assert forces == pytest.approx(static.elements.force, abs=0.01 * forces.max())
    at = bearing.layout.q(start.y)["inner"][:3]
    assert at == pytest.approx(static.displacement[:3], abs=2e-7)


def test_outer_ribs_guide_the_rollers_of_an_nu(bearing_of):
    """Its inner ring moves along the axis and leaves rollers and cage where they are."""
    load = Load(radial=1000.0, axial=500.0, axial_stiffness=1e6)
    bearing = bearing_of(bearing=NU, load=load)
    start = started(bearing)
    q = bearing.layout.q(start.y)
    assert q["inner"][0] == pytest.approx(5e-4, rel=1e-9)
    assert not q["elements"][:, 0].any() and q["cage"][0] == 0.0
    assert report_of(bearing, start).rib.shape == (22, 2)


@pytest.mark.parametrize("design", [NJ, NUP])
def test_a_run_carries_the_axial_load_through_ribs(bearing_of, design):
    bearing = bearing_of(bearing=design, load=BETWEEN_RIBS)
    start = started(bearing)
    h = march(bearing, start.y, start.yd, duration=3e-3)
    assert h.outcome == 0
    force = h.samples.rib[100:].sum(axis=1).mean(axis=0)  # outer +x, -x, inner +x, -x
    assert force[0] - force[1] == pytest.approx(440.0, rel=0.05)
    assert force[3] - force[2] == pytest.approx(440.0, rel=0.05)
    place = bearing.layout.q(h.y)["inner"][:, 0]
    assert np.ptp(place) < 5e-6 and place.min() > 25e-6
    assert np.abs(bearing.layout.multipliers(h.y)[:, 0]).max() < 1e-6  # nothing else holds it


def test_without_an_axial_load_the_ring_is_held_as_before(bearing_of):
    for design, load, free in (
        (NUP, Load(radial=100.0), 0),
        (NUP, BETWEEN_RIBS, 1),
        (NUP, replace(BETWEEN_RIBS, axial=0.0, varies="axial", ramp_to=50.0, ramp_time=1e-3), 1),
        (NU, Load(radial=100.0), 0),
    ):
        assert bearing_of(bearing=design, load=load).data.model.inner_ring.free[0] == free
