"""Needles without a cage in motion: what contacts put on all bodies sums up to nothing."""

import numpy as np
import pytest
from needle_rollers import CUP_CASE
from test_balances import forces_on_bodies

from flexcage.case import load_case
from flexcage.stages import bearing_in_motion
from flexcage.system.data import NEIGHBOUR_FRICTION

NEXT = 2  # place of the contact: behind the races
FULL_CASE = (
    CUP_CASE.replace("roller_count = 22", "roller_count = 34")
    .replace('roller_length = "11.8 mm"', 'roller_length = "13.8 mm"')
    .replace('effective_length = "11.4 mm"', 'effective_length = "13.4 mm"')
    + """gravity = "0 m/s^2"
[cage]
model = "none"
[drive]
speed = "3000 rpm"
[lubricant]
oil_fraction = 0.0
[mount]
kind = "bushing"
mass = "0.1 kg"
"""
)


def in_turmoil(bearing):
    """A state in motion, but with nothing gyroscopic: the shaft pushed into the needles, neighbours
    into each other and the lips, all of them askew and sliding."""
    layout, model, rng = bearing.layout, bearing.data.model, np.random.default_rng(4)
    y, Z, radius = np.zeros(bearing.layout.size), layout.elements, model.bodies.radius
    q, u = layout.q(y), layout.u(y)
    rollers = q["elements"]
    q["inner"][1] = 20e-6
    psi = 2.0 * np.pi * np.arange(Z) / Z
    rollers[:, 1] = model.outer.radius - radius - 8e-6 + 10e-6 * np.cos(psi)
    most = 2.0 * radius / rollers[:, 1]
    pairs = np.arange(0, Z, 2)  # every other needle touches the next one
    rollers[:, 2] = psi
    gap = 2.0 * np.pi / Z - most[pairs]
    rollers[pairs, 2] += gap + 4e-6 / rollers[pairs, 1]
    rollers[:, 3:5] = 2e-4 * rng.standard_normal((Z, 2))
    rollers[:, 0] = 2.01e-4 * rng.choice([-1.0, 1.0], Z)
    orbit, spin = 140.0, -1500.0
    u["elements"][:] = np.array([0.01, 0.01, 0.1, 30.0, 0, 0]) * rng.standard_normal((Z, 6))
    u["elements"][:, 2] += orbit * rollers[:, 1]
    u["elements"][:, 3] += spin
    u["inner"][3] = 314.0
    yd = np.zeros_like(y)
    bearing.residual(0.0, y, yd)
    bearing.function("note")(0.0, y, bearing.args)
    return y, yd


@pytest.fixture(scope="module")
def full():
    return bearing_in_motion(load_case(FULL_CASE), None, None)


def test_forces_of_all_needles_and_rings_sum_to_nothing(full):
    """Third law over the whole bearing: races, lips and neighbours, with friction and damping."""
    y, yd = in_turmoil(full)
    report = full.data.work.report
    full.residual(0.0, y, yd, mode=2)
    assert (report.race[:, :, 0].max(axis=0) > 10.0).all() and report.rib.max() > 1.0
    assert report.contact[:, NEXT].sum() > 10 and report.power[NEIGHBOUR_FRICTION] < -1e-3
    forces, moments = np.moveaxis(forces_on_bodies(full, y, yd), 1, 0)
    size = np.abs(forces).sum(axis=0).max()
    assert len(forces) == 36 and size > 1000.0
    np.testing.assert_allclose(forces.sum(axis=0), 0.0, atol=1e-12 * size)
    turned = np.abs(moments).sum(axis=0).max()
    np.testing.assert_allclose(moments.sum(axis=0), 0.0, atol=1e-6 * turned)
