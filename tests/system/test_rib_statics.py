"""Axial load through ribs at rest: derivatives, balances, closed forms, and who carries none."""

from dataclasses import replace

import numpy as np
import pytest
from roller_designs import DESIGNS, INNER, NF, NJ, NU, NUP, OUTER, N
from scipy.optimize import brentq
from solved_bearings import solve_bearing

from flexcage.bearings import statics_of
from flexcage.contacts.spec import Contacts, NormalLaw, PairSpec
from flexcage.core.errors import InputError
from flexcage.geometry.rollers import RollerProfile
from flexcage.system.spec import Load
from flexcage.system.statics.equilibrium import nearest, settle
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.solve import posed

# where ribs bear on a roller's end, from its axis: halfway between rib and 0.9 of its radius
LOW, HIGH = 0.5 * (0.5 * INNER - 41.25e-3 - 3.6e-3), 0.5 * (0.5 * OUTER - 41.25e-3 + 3.6e-3)


def elements(bearing):
    return statics_of(bearing)(bearing, speed=0.0, contacts=Contacts(), options=StaticOptions())


def states(e, bearing):
    """Rings and rollers displaced so that ribs and races of many press, towards either side."""
    rng, Z = np.random.default_rng(5), bearing.roller_count
    v = np.stack([rng.uniform(-60e-6, 60e-6, Z), rng.uniform(-20e-6, 40e-6, Z),
                  rng.uniform(-2e-4, 2e-4, Z)], axis=1)  # fmt: skip
    return v, e.guesses(v)[1] + rng.uniform(-4e-6, 4e-6, (Z, 2))


@pytest.mark.parametrize("name", ["NJ", "NUP", "NF"])
def test_forces_and_tangents_are_slopes(name):
    bearing = DESIGNS[name]
    e = elements(bearing)
    v, w = states(e, bearing)
    r, h = e.respond(v, w, 0.0), 1e-10
    pressed = np.abs(e.loads(v, w).axial) > 0.0
    assert 3 < pressed.sum() < bearing.roller_count
    lever = np.array([1.0, 1.0, 40e-3, 1.0, 1.0])
    for k in range(5):
        step = np.zeros(5)
        step[k] = h / lever[k]
        up, down = (e.respond(v + s * step[:3], w + s * step[3:], 0.0) for s in (1.0, -1.0))
        force = np.column_stack([r.ring, r.unbalance])
        found = (up.energy - down.energy) / (2.0 * h)
        assert found == pytest.approx(force[:, k] / lever[k], abs=1e-4 * np.abs(r.ring).max())
        slope = np.column_stack(
            [
                r.ring_v[:, :, k] if k < 3 else r.ring_w[:, :, k - 3],
                r.unbalance_v[:, :, k] if k < 3 else r.unbalance_w[:, :, k - 3],
            ]
        )
        ahead = np.column_stack([up.ring, up.unbalance])
        found = (ahead - np.column_stack([down.ring, down.unbalance])) / (2.0 * h)
        off = np.abs(found * lever[k] - slope) / np.array([1.0, 1.0, 40e-3, 1.0, 1.0])
        assert np.quantile(off, 0.95) <= 1e-4 * np.abs(r.ring_v[:, 0, 0]).max() * lever[k]


@pytest.mark.parametrize("kind", ["straight", "logarithmic"])
@pytest.mark.parametrize("clearance", [0.0, 20e-6])
def test_pure_axial_load_has_a_closed_form(kind, clearance):
    """Every roller carries Fa/Z, and its slices the couple of both ribs, Fa/Z times the difference
    of their heights: each race bears one end, by k d^(10/9)."""
    bearing = replace(NJ, profile=RollerProfile(kind=kind), radial_clearance=clearance)
    force = 2200.0
    s = solve_bearing(bearing, load=Load(axial=force))
    assert s.elements.axial == pytest.approx(np.full(22, force / 22), rel=1e-9)
    n, length = Contacts().race.slices, bearing.effective_length
    x = (np.arange(n) + 0.5) * length / n - 0.5 * length
    # ISO/TS 16281: 35948 Lwe^(8/9) of both races in series, so that each has 2^(10/9) of it
    one = 2.0 ** (10 / 9) * 35948.0 * (1e3 * length) ** (8 / 9) * 1e3 ** (10 / 9) / n
    drop = bearing.profile.drop(x, diameter=bearing.roller_diameter, length=length)

    def forces(angle):
        return one * np.maximum(angle * x - 0.25 * clearance - drop, 0.0) ** (10 / 9)

    couple = force / 22 * (HIGH - LOW)
    angle = brentq(lambda a: 2.0 * (forces(a) * x).sum() - couple, 0.0, 0.02, xtol=1e-15)
    q = forces(angle)
    assert q.sum() > 10.0
    assert s.elements.force == pytest.approx(np.full((22, 2), q.sum()), rel=1e-6)
    tight = bearing.rib_gap + bearing.counter_rib_gap - 2.0 * bearing.roller_length
    ribs = s.displacement[0] - 0.5 * tight - angle * (HIGH - LOW)  # what both are pressed in
    assert force / 22 / ribs == pytest.approx(0.5 * rib_stiffness(bearing), rel=1e-6)
    assert s.displacement[1:] == pytest.approx(np.zeros(4), abs=1e-12)


def rib_stiffness(bearing):
    """Flat round punch on a half-space, Johnson 3.36: F/d = 2 a E*, twice in series."""
    material = bearing.material
    modulus = material.youngs_modulus / (1.0 - material.poisson_ratio**2)
    return 2.0 * 0.45 * 0.5 * bearing.roller_diameter * 0.5 * modulus


def test_every_force_has_its_reaction():
    """Load and elements balance in force and moment; ribs take part through their lever."""
    load = Load(axial=600.0, radial=4000.0, direction=0.4, tilt="free")
    s = solve_bearing(NUP, load=load)
    e, psi = s.elements, s.elements.azimuth
    assert e.axial.sum() == pytest.approx(600.0, rel=1e-8)
    assert (e.force[:, 0] * np.cos(psi)).sum() == pytest.approx(4000.0 * np.cos(0.4), rel=1e-8)
    assert (e.force[:, 0] * np.sin(psi)).sum() == pytest.approx(4000.0 * np.sin(0.4), rel=1e-8)
    assert e.force[:, 0] == pytest.approx(e.force[:, 1], abs=1e-6)  # no roller is left over
    assert np.abs(s.displacement[3:]).max() > 1e-5  # ribs on the loaded side tilt the ring
    assert np.abs(s.stiffness - s.stiffness.T).max() < 1e-9 * np.abs(s.stiffness).max()


def test_work_of_a_growing_load_is_stored():
    """From where the first load puts the ring: what load and displacement do is what contacts
    store."""
    shares = np.linspace(0.0, 1.0, 61)[1:] ** 2
    found = [solve_bearing(NUP, load=Load(axial=-800 * s, radial=3000 * s)) for s in shares]
    stored = [energy(NUP, s) for s in (found[0], found[-1])]
    work = sum(
        0.5 * (a.load + b.load) @ (b.displacement - a.displacement)
        for a, b in zip(found, found[1:])
    )
    assert stored[1] > 1e3 * stored[0] > 0.0
    assert work == pytest.approx(stored[1] - stored[0], rel=1e-3)


def energy(bearing, s):
    """Elastic energy [J] of all contacts where a solution has the inner ring."""
    e = elements(bearing)
    load = Load(axial=s.load[0], radial=s.load[1])
    problem = posed(bearing, e, load, StaticOptions())
    v = problem.at_azimuths @ s.displacement
    return settle(problem, v, nearest(problem, v, None, 0.0), 0.0)[1].energy.sum()


def test_designs_are_mirror_images():
    """Turned round, an NJ carries the same load to the other side; an NUP does so by itself."""
    other = replace(NJ, thrust="-x")
    load = {"radial": 3000.0, "direction": 0.3}
    one = solve_bearing(NJ, load=Load(axial=400.0, **load))
    mirrored = solve_bearing(other, load=Load(axial=-400.0, **load))
    sign = np.array([-1.0, 1.0, 1.0])
    assert mirrored.displacement[:3] == pytest.approx(sign * one.displacement[:3], rel=1e-6)
    assert mirrored.elements.axial == pytest.approx(-one.elements.axial, abs=1e-6)
    both = [solve_bearing(NUP, load=Load(axial=f, **load)) for f in (400.0, -400.0)]
    assert both[0].displacement[:3] == pytest.approx(one.displacement[:3], rel=1e-6)
    assert both[1].displacement[:3] == pytest.approx(mirrored.displacement[:3], rel=1e-6)


def test_radial_load_does_not_ask_for_ribs():
    base = solve_bearing(N, load=Load(radial=3000.0))
    for bearing in (NU, NJ, NUP, NF):
        s = solve_bearing(bearing, load=Load(radial=3000.0))
        assert np.array_equal(s.elements.force, base.elements.force)
        assert s.displacement == pytest.approx(base.displacement, abs=1e-15)


def test_the_table_shows_what_ribs_carry():
    s = solve_bearing(NJ, load=Load(axial=2200.0))
    assert "axial, N" in s.table() and s.to_dict()["elements"]["axial"][3] == pytest.approx(100.0)
    plain = solve_bearing(N, load=Load(radial=2200.0))
    assert "axial, N" not in plain.table() and "axial" not in plain.to_dict()["elements"]


@pytest.mark.parametrize(
    ("bearing", "force", "words"),
    [
        (N, 100.0, "the design N has ribs on the inner ring alone.*NJ carries one.*NUP"),
        (NU, 100.0, "the design NU has ribs on the outer ring alone.*NJ carries one.*NUP"),
        (NJ, -100.0, 'this NJ carries axial load towards \\+x alone: bearing.thrust = "-x"'),
        (NF, -100.0, "this NF carries axial load towards \\+x alone.*NUP carries both"),
    ],
)
def test_axial_load_is_refused_with_the_design_that_carries_it(bearing, force, words):
    with pytest.raises(InputError, match=f"load.axial is {force:g} N, but {words}") as caught:
        solve_bearing(bearing, load=Load(axial=force, radial=100.0))
    assert caught.value.where == "load.axial"
    solve_bearing(bearing, load=Load(axial=force, radial=100.0, axial_stiffness=1e8))


def test_a_rib_law_of_ones_own_is_not_passed_over():
    rib = PairSpec(normal=replace(NormalLaw(), law="spring"))
    with pytest.raises(InputError, match="contacts.rib.normal.law is 'spring'"):
        solve_bearing(NJ, load=Load(axial=9.0), contacts=Contacts(rib=rib))
    solve_bearing(N, load=Load(radial=9.0), contacts=Contacts(rib=rib))
