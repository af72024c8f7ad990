"""Reduced rings: thin rings in closed form, a layer on a rigid base, the half-space taken away."""

from functools import cache

import numpy as np
import pytest
from scipy.integrate import quad

from flexcage.fem.revolved import Revolved
from flexcage.geometry.materials import MATERIALS
from flexcage.geometry.ring import Raceway, RingSection
from flexcage.mesh.section import mesh_section
from flexcage.modes.half_space import line_compliance, spot_compliance
from flexcage.modes.ring import RingSeat, natural_frequencies, reduce_ring

STEEL = MATERIALS["steel"]
E, NU, RHO = STEEL.youngs_modulus, STEEL.poisson_ratio, STEEL.density
FREE = RingSeat(rigidly=False)
RADIUS, SIDE = 0.05, 0.001  # a thin ring: h/R = 0.02, square section
I, AREA = SIDE**4 / 12.0, SIDE**2


def plain(radius, wall, width, *, extent, line):
    """An outer ring with a cylindrical race at ``radius``."""
    half = 0.5 * width
    outline = [
        (-half, radius + wall), (-half, radius), (-extent, radius), (extent, radius),
        (half, radius), (half, radius + wall),
    ]  # fmt: skip
    names = ("", "", "race", "", "", "seat")
    if extent == half or not line:  # the race from end to end
        del outline[2:4]
        names = ("", "race", "", "seat")
    raceway = Raceway(place=(0.0, radius), normal=(0.0, 1.0), extent=extent, line=line)
    return RingSection(tuple(outline), names, raceway, wall)


@cache
def thin():
    section = plain(RADIUS - 0.5 * SIDE, SIDE, SIDE, extent=0.5 * SIDE, line=True)
    return reduce_ring(section, STEEL, FREE)


@pytest.mark.parametrize("n", range(2, 9))
def test_thin_ring_vibrates_as_in_closed_form(n):
    # S. S. Rao, Vibration of Continuous Systems, 9; J = 0.1406 h^4 of a square (Timoshenko)
    found = natural_frequencies(thin().model, FREE, n, 2)
    scale = E * I / (RHO * AREA * RADIUS**4) * n**2 * (n**2 - 1) ** 2
    twisted = E * I / (E / (2.0 * (1.0 + NU)) * 0.1406 * SIDE**4)
    expected = np.sqrt([scale / (n**2 + twisted), scale / (n**2 + 1)])
    assert found == pytest.approx(np.sort(expected), rel=0.01)


def test_thin_ring_under_two_opposite_forces():
    # S. Timoshenko, Strength of Materials II: the diameter shrinks by (pi/4 - 2/pi) P R^3/(E I)
    ring = thin()
    each = ring.local + ring.between(np.array(np.pi))
    expected = (np.pi / 4.0 - 2.0 / np.pi) * RADIUS**3 / (E * I)
    assert 2.0 * each[0, 0] == pytest.approx(expected, rel=0.01)


def test_rigid_motions_cost_nothing_and_have_the_rings_mass():
    model = thin().model
    volume = 2.0 * np.pi * RADIUS * AREA
    for n in (0, 1):
        rigid = model.rigid_motions(n)
        left = np.abs(model.stiffness(n) @ rigid).max()
        assert left < 1e-12 * np.abs(model.stiffness(n)).max()
        # integral of cos^2 + sin^2 of a translation is that of the volume
        mass = rigid[:, 0] @ model.mass(n) @ rigid[:, 0]
        assert mass == pytest.approx(RHO * volume, rel=1e-6)


def test_constant_strain_is_exact():
    """Stretched along its axis, with the contraction that goes with it, a ring bears E A strain."""
    mesh = mesh_section([(0.0, 0.02), (0.01, 0.02), (0.01, 0.024), (0.0, 0.024)], ["a"] * 4,
                        lambda x, r: 2e-3)  # fmt: skip
    model = Revolved(mesh, STEEL)
    x, r = model.nodes.T
    field = np.stack([x, -NU * r, 0.0 * r], axis=1).ravel()
    area = np.pi * (0.024**2 - 0.02**2)
    assert field @ model.stiffness(0) @ field == pytest.approx(E * area * 0.01, rel=1e-10)


def layer(nu):
    """Integral of L(s) - 1 over s, of a layer bonded to a rigid base: E. K. Dimitriadis et al.,
    Biophys. J. 82 (2002) 2798, after R. S. Chadwick; Johnson 5.8."""

    def short(s):
        if s > 20.0:
            return 0.0
        top = (3.0 - 4.0 * nu) * np.sinh(2.0 * s) - 2.0 * s
        bottom = (3.0 - 4.0 * nu) * np.cosh(2.0 * s) + 2.0 * s**2 + 5.0 - 12.0 * nu + 8.0 * nu**2
        return top / bottom - 1.0

    return quad(short, 0.0, 30.0, limit=200)[0]


def test_what_is_left_of_a_layer_on_a_rigid_base():
    """On a base so near, a large ring yields less than the half-space, by a known amount."""
    wall = 0.004
    ring = reduce_ring(plain(0.2, wall, 0.04, extent=0.001, line=False), STEEL, RingSeat())
    expected = (1.0 - NU**2) / (np.pi * E * wall) * layer(NU)
    assert expected < 0.0
    assert ring.local[1, 1] == pytest.approx(expected, rel=0.02)


@pytest.mark.parametrize("line", (False, True))
def test_what_is_left_hardly_depends_on_the_patch(line):
    section = plain(0.03, 0.006, 0.02, extent=0.006 if line else 0.001, line=line)
    found = [reduce_ring(section, STEEL, RingSeat(), along=a) for a in (0.27, 0.18)]
    port = 0 if line else 1
    local = [ring.local[port, port] for ring in found]
    whole = found[1].half_space[port, port] + abs(local[1])
    assert local[0] == pytest.approx(local[1], rel=0.03)
    assert abs(local[0] - local[1]) < 0.01 * whole


def test_half_space_under_a_round_spot():
    """The mean displacement of a Gaussian spot under its own load: (1 - nu^2)/(2 sqrt(pi) E s)."""
    normal, _ = spot_compliance(1e-3, 1e-3, STEEL)
    assert normal == pytest.approx((1.0 - NU**2) / (2.0 * np.sqrt(np.pi) * E * 1e-3), rel=1e-9)


def test_half_space_between_pairs_of_points_of_a_line():
    half, deviation, count = 5e-3, 1e-3, 400_000
    rng = np.random.default_rng(1)
    x = rng.uniform(-half, half, (2, count))
    apart = np.hypot(x[0] - x[1], rng.normal(0.0, np.sqrt(2.0) * deviation, count))
    point = (1.0 - NU**2) / (np.pi * E * apart)
    even, linear = line_compliance(half, deviation, STEEL)
    assert even == pytest.approx(np.mean(point), rel=0.01)
    assert linear == pytest.approx(np.mean(x[0] * x[1] * point) / (half**2 / 3.0) ** 2, rel=0.02)


def test_foundation_that_is_stiff_is_a_rigid_seat():
    section = plain(0.03, 0.006, 0.02, extent=0.006, line=True)
    rigid, firm = (reduce_ring(section, STEEL, held)
                   for held in (RingSeat(), RingSeat(rigidly=False, foundation=1e18)))  # fmt: skip
    assert firm.local == pytest.approx(rigid.local, rel=1e-4, abs=1e-12)


def test_soft_foundation_carries_the_ring():
    """A ring that hardly bends goes down on its foundation by F/(k area/2), per translation."""
    section = plain(0.03, 0.006, 0.02, extent=0.006, line=True)
    stiffness = 1e9
    ring = reduce_ring(section, STEEL, RingSeat(rigidly=False, foundation=stiffness))
    area = 2.0 * np.pi * 0.036 * 0.02
    expected = 1.0 / (stiffness * area)
    # a foundation alike in all directions carries a translation by all of its area
    assert ring.compliance[1, 0, 0] == pytest.approx(expected, rel=0.01)
