"""Static solutions of needle roller bearings: long rollers in slices, and the wall of a drawn cup
as an elastic ring in its housing."""

from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from needle_rollers import CUP
from scipy.optimize import brentq

from flexcage.bearings import sections_of, statics_of
from flexcage.bearings.cylindrical_roller.bearing import RollerProfile
from flexcage.contacts.spec import Contacts
from flexcage.geometry.ring import OuterRing
from flexcage.modes.ring import RingSeat, reduce_ring
from flexcage.system.spec import Load
from flexcage.system.statics.rings import Rings
from flexcage.system.statics.solve import solve_bearing

LONG = replace(CUP, width=20e-3, roller_length=15.8e-3, effective_length=15.4e-3, rib_gap=18.2e-3)
# lips that hardly are: a plain cylinder of 16 x 1 mm
PLAIN = replace(CUP, roller_length=15.9e-3, effective_length=15.88e-3, rib_gap=15.98e-3,
                rib_diameter=23.98e-3)  # fmt: skip


def solved(bearing, *, slices=16, ring=None, **load):
    contacts = Contacts()
    contacts = replace(contacts, race=replace(contacts.race, slices=slices))
    rings = Rings(outer=ring, sections=sections_of(bearing)) if ring else None
    how = {"contacts": contacts, "rings": rings}
    return solve_bearing(bearing, statics_of(bearing), load=Load(radial=1500.0, **load), **how)


@pytest.mark.parametrize("load", [200.0, 1500.0, 4000.0])
def test_straight_needles_share_the_load_as_line_contacts_in_series(load):
    """ISO/TS 16281 without a profile: Q = c (delta cos psi - Pd/2)^(10/9) on each needle, with
    c = 35948 Lwe^(8/9) N and mm of two steel contacts; summed to the load by a root finder."""
    bearing = replace(CUP, profile=RollerProfile(kind="straight"))
    psi = 2.0 * np.pi * np.arange(22) / 22

    def forces(shift):
        depth = np.maximum(shift * np.cos(psi) - 10e-3, 0.0)  # mm, of 20 um
        return 35948.0 * 11.4 ** (8.0 / 9.0) * depth ** (10.0 / 9.0)

    shift = brentq(lambda d: forces(d) @ np.cos(psi) - load, 0.01, 0.1, xtol=1e-14)
    found = solve_bearing(bearing, statics_of(bearing), load=Load(radial=load))
    assert found.displacement[1] == pytest.approx(1e-3 * shift, rel=2e-3)
    assert found.elements.force[:, 0] == pytest.approx(forces(shift), abs=2e-3 * load)


@pytest.mark.parametrize(("tilt", "error"), [(0.0, 0.005), (1e-3, 0.012), (2e-3, 0.025)])
def test_sixteen_slices_are_enough_for_needles_eight_times_as_long_as_thick(tilt, error):
    """Against 240 slices: displacement, largest force and pressure within 0.5 % of aligned
    needles of 2 x 15.8 mm, 1.2 % at 1 mrad and 2.5 % at 2 mrad, where a third of them bears."""
    few, many = (solved(LONG, slices=n, misalignment=tilt) for n in (16, 240))
    assert few.displacement[1] == pytest.approx(many.displacement[1], rel=error)
    for key in ("force", "pressure"):
        a, b = (getattr(s.elements, key)[:, 0].max() for s in (few, many))
        assert a == pytest.approx(b, rel=error)


def closed_form(n, foundation):
    """Radial displacement in waves n under a unit force on a thin ring on a foundation [N/m^3] that
    holds it radially and along: bent without stretching, u_t = -u_r/n (as in Timoshenko, Strength
    of Materials II, for waves of a ring)."""
    modulus, nu = CUP.material.youngs_modulus, CUP.material.poisson_ratio
    radius, wall, width, seat = 12.5e-3, 1e-3, 16e-3, 13e-3
    bending = modulus / (1.0 - nu**2) * width * wall**3 / 12.0
    held = foundation * width * seat
    if n == 1:
        return 1.0 / (2.0 * np.pi * held)
    bent = bending * (n**2 - 1) ** 2 / radius**3
    return 1.0 / (np.pi * (bent + held * (1.0 + 1.0 / n**2)))


@cache
def reduced(bearing, foundation):
    section = sections_of(bearing)(bearing, angle=(0, 0), across=(0, 0), seat=(20e-3, 26e-3))[1]
    return reduce_ring(section, bearing.material, RingSeat(False, foundation)).compliance[:, 0, 0]


@pytest.mark.parametrize("foundation", [1e10, 1e11])
def test_the_wall_of_a_cup_bends_as_a_thin_ring(foundation):
    """Within 6 %: the ring solver's cup is also compressed under the load, and of finite width."""
    found = reduced(PLAIN, foundation)
    for n in range(1, 6):
        assert found[n] == pytest.approx(closed_form(n, foundation), rel=0.06)


def test_lips_stiffen_a_cup():
    """Lips of 0.9 mm halve its ovalisation, and leave the seat that holds it as it is."""
    with_lips, plain = reduced(CUP, 1e10), reduced(PLAIN, 1e10)
    assert with_lips[1] == pytest.approx(plain[1], rel=0.01)
    assert 0.4 < with_lips[2] / plain[2] < 0.6


def on_foundation(stiffness):
    return solved(CUP, ring=OuterRing(ring="flexible", seat="foundation", foundation=stiffness))


@pytest.mark.slow
def test_a_soft_housing_widens_the_loaded_zone():
    """Of 22 needles 5 bear in a rigid housing, 7 and 9 in ones of 1 and 0.1 N/um per mm2."""
    rigid, firm, soft = solved(CUP), on_foundation(1e12), on_foundation(1e11)
    loaded = [int((s.elements.force[:, 0] > 0.0).sum()) for s in (rigid, firm, soft)]
    assert loaded == [5, 7, 9]
    peaks = [s.largest_force for s in (rigid, firm, soft)]
    assert peaks[0] > 1.3 * peaks[1] > 1.3 * 1.3 * peaks[2]
    for s in (rigid, firm, soft):
        force = s.elements.force[:, 0]
        assert force @ np.cos(s.elements.azimuth) == pytest.approx(1500.0, rel=1e-6)
