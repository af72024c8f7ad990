"""What laws owe their callers, and their limits; known answers are in test_known_*.py."""

from __future__ import annotations

import numpy as np
import pytest
from law_checks import check_friction_law, check_normal_law
from law_values import friction, normal, rolling, strike
from scipy.integrate import quad
from scipy.optimize import brentq

from flexcage.case.presets import load_preset
from flexcage.contacts import laws
from flexcage.contacts.spec import FRICTION_LAWS as FRICTION_SPECS
from flexcage.contacts.spec import (
    EhlTraction,
    FrictionLaw,
    Lubricant,
    NormalLaw,
    OwnImpact,
)
from flexcage.core.jit import kernel

HERTZ_BALL = 8.69343e9  # N/m^1.5, ball of a 7010C
LINE = 454517.4944 * 1e3 ** (10.0 / 9.0)  # N/m^(10/9), N1013 roller on one race


@pytest.mark.parametrize("e", [0.01, 0.02, 0.031, 0.999, 1 - 1e-7, 1.0])
def test_exact_dissipation_at_its_ends(e):
    lam = laws.exact_dissipation(e)
    # ln[(1+lam)/(1-lam e)] = lam (1+e), multiplied out so that nothing cancels near 1/e
    assert (1.0 - lam * e) * np.exp(lam * (1.0 + e)) == pytest.approx(
        1.0 + lam, abs=2e-13 * np.exp(lam * (1.0 + e)) + 1e-9
    )
    assert lam >= 0.0
    assert e > 0.99 or lam > 30.0


NORMAL_SPECS = {
    "elastic": NormalLaw(law="elastic"),
    "restitution": NormalLaw(law="restitution", restitution=0.6),
    "impact_step": NormalLaw(law="impact_step", damping=800.0, full_damping_depth=1e-5),
    "impact": OwnImpact(damping=800.0),
    "lankarani_nikravesh": NormalLaw(law="lankarani_nikravesh", restitution=0.6),
}


@pytest.mark.parametrize("name", sorted(laws.NORMAL_LAWS))
@pytest.mark.parametrize(("k", "n"), [(HERTZ_BALL, 1.5), (LINE / 15, 10 / 9), (3e8, 1.0)])
def test_every_normal_law(name, k, n):
    p = laws.normal_parameters(NORMAL_SPECS[name], k, n)
    check_normal_law(laws.NORMAL_LAWS[name], p)


@pytest.mark.parametrize("name", sorted(laws.FRICTION_LAWS))
def test_every_friction_law(name):
    spec = (FRICTION_SPECS[name] or FrictionLaw)(law=name)
    top = max(spec.static, spec.dynamic, spec.peak)
    check_friction_law(laws.FRICTION_LAWS[name], laws.friction_parameters(spec), top=top)


@kernel(laws.NORMAL_SIGNATURE)
def stiffening(n, d, v, onset, p, F, Fe, Fd, Fv):
    """A user's law: linear at touch, exponential later, no damping."""
    for k in range(n):
        F[k] = Fe[k] = Fd[k] = Fv[k] = 0.0
        if d[k] > 0.0:
            e = np.exp(d[k] / 1e-5)
            F[k] = Fe[k] = p[0] * 1e-5 * (e - 1.0)
            Fd[k] = p[0] * e


@kernel(laws.FRICTION_SIGNATURE)
def arctangent(n, u, p, g, dg):
    """A user's friction: 2/pi atan(u/v_static)."""
    a = 2.0 * p[1] / np.pi
    for k in range(n):
        x = u[k] / p[2]
        if x < 1e-4:
            g[k], dg[k] = a / p[2], -2.0 * a * x / (3.0 * p[2] ** 2)
        else:
            g[k] = a * np.arctan(x) / u[k]
            dg[k] = (a / (p[2] * (1.0 + x * x)) - g[k]) / u[k]


def test_a_law_of_ones_own_is_held_to_the_same():
    check_normal_law(stiffening, laws.normal_parameters(NormalLaw(law="stiffening"), 4e7, 1.0))
    spec = FrictionLaw(law="arctangent", dynamic=0.08)
    check_friction_law(arctangent, laws.friction_parameters(spec), top=0.08)


@pytest.mark.parametrize(("peak", "speed", "high"), [(0.07, 0.5, 0.02), (0.05, 0.3, 0.0)])
def test_traction_is_smooth_at_rest_and_has_one_maximum(peak, speed, high):
    p = laws.friction_parameters(
        FrictionLaw(law="traction", peak=peak, peak_speed=speed, high_speed=high)
    )
    u = np.linspace(1e-3, 4.0, 4000) * speed
    mu = friction(laws.traction, p, u)[0] * u
    assert mu.max() == pytest.approx(peak, rel=1e-6)
    assert u[np.argmax(mu)] == pytest.approx(speed, rel=2e-3)
    assert np.count_nonzero(np.diff(np.sign(np.diff(mu)))) == 1
    small = friction(laws.traction, p, [0.0, 1e-6 * speed])[0]
    assert small[0] == pytest.approx(small[1], rel=1e-5)


def test_ehl_traction_rises_by_its_creep_speed_to_its_limit():
    p = laws.friction_parameters(EhlTraction(limit=0.05, creep_speed=0.02))
    u = np.array([1e-9, 0.02, 2.0])
    mu = friction(laws.FRICTION_LAWS["ehl"], p, u)[0] * u
    np.testing.assert_allclose(mu, 0.05 * -np.expm1(-u / 0.02), rtol=1e-6)


def test_rolling_resistance():
    lubricant = Lubricant(viscosity=0.02, pressure_coefficient=2e-8,
                          rolling_resistance="goksem_hargreaves")  # fmt: skip
    radius, length, modulus = 4e-3 * 37.25 / 41.25, 7.3e-3, 206e9 / (1 - 0.09)
    c = laws.rolling_resistance(lubricant, radius, length, modulus)
    assert not rolling(c, [0.0, 12.0], [185.7, 0.0]).any()
    assert (rolling(c, [-12.0, 12.0], 50.0) == rolling(c, 12.0, 50.0) * [-1.0, 1.0]).all()
    blended = Lubricant(viscosity=0.02, rolling_resistance="blended")
    both = laws.rolling_resistance(blended, radius, length, modulus)
    loads = np.array([0.01, 1.0, 100.0, 1e4])
    martin = laws.IVR_CONSTANT * np.sqrt(0.02 * 12.0 * loads * length)
    least = np.minimum(martin, rolling(c, 12.0, loads))
    ratio = rolling(both, 12.0, loads) / least
    assert (0.8 < ratio).all() and (ratio < 1.0).all()
    nothing = laws.rolling_resistance(Lubricant(rolling_resistance="none"), radius, length, modulus)
    assert rolling(nothing, 12.0, 100.0) == 0.0


def test_pocket_line_law_less_the_patch_of_the_mesh():
    """Near a Hertzian less a uniform strip on a half-plane, both in the middle; free corners (the
    section resolved: tests/verification/test_contact_patch.py) take 2 to 3 % from that."""
    roller, wall, w = (1e16, 0.3), (105e9, 0.34), 1.9e-3
    k, n = laws.pocket_line_law(
        radius=4e-3, length=7.3e-3, depth=1.5e-3, patch_half_width=w, roller=roller, wall=wall
    )
    for load in (2.0, 30.0, 100.0):
        q = load / 7.3e-3
        soft = (1 - 0.34**2) / 105e9
        b = np.sqrt(4 * q * 4e-3 * soft / np.pi)
        # Flamant's surface displacement -2 soft/pi int p ln|x - s| ds, each against one datum
        hertz = -quad(lambda s, b: 4 / (np.pi * b) * np.sqrt(1 - (s / b) ** 2) * np.log(s),
                      0, b, args=(b,))[0]  # fmt: skip
        strip = -quad(lambda s: np.log(s) / w, 0, w)[0]
        share = (load / k) ** (1 / n) / (2 * q * soft / np.pi * (hertz - strip))
        assert share == pytest.approx(0.98, abs=0.022)


def test_preset_slices_share_one_stiffness():
    bearing = load_preset("N1013").bearing
    modulus = bearing.material.plane_strain_modulus
    whole = laws.iso_line_stiffness(bearing.effective_length, modulus)
    p = laws.normal_parameters(NormalLaw(law="elastic"), whole, 10 / 9, parts=15)
    force = normal(laws.elastic, p, np.full(15, 3e-6), np.zeros(15))[0].sum()
    assert force == pytest.approx(whole * 3e-6 ** (10 / 9), rel=1e-12)


def test_an_impact_of_ones_own_is_that_of_adams():
    """By default 1e5 N/mm and an exponent of 2.2: 25 um of penetration give 1e5 * 0.025^2.2 N, and
    10 N s/mm damp from 0.1 mm on (its default as well), whatever geometry and materials are."""
    spec = OwnImpact(damping=1e4, full_damping_depth=1e-4)
    p = laws.normal_parameters(spec, LINE, 10 / 9, parts=15)
    force = normal(laws.impact_step, p, np.full(15, 25e-6), np.zeros(15))[0].sum()
    assert force == pytest.approx(1e5 * 0.025**2.2, rel=1e-12)
    damped = normal(laws.impact_step, p, np.full(15, 0.2e-3), np.full(15, 0.01))[0].sum()
    assert damped == pytest.approx(1e5 * 0.2**2.2 + 1e4 * 0.01, rel=1e-12)
    one = laws.normal_parameters(spec, LINE, 10 / 9)
    _, elastic, _, damping = (x[0] for x in normal(laws.impact_step, one, [0.2e-3], [0.01]))
    assert damping == 1e4 and elastic == pytest.approx(1e5 * 0.2**2.2, rel=1e-12)


@pytest.mark.parametrize(("e", "miss"), [(0.98, 1e-3), (0.9, 0.02), (0.7, 0.1)])
def test_a_body_rebounds_by_lankarani_and_nikravesh_as_theory_has_it(e, miss):
    """A mass that strikes loses (1 - e^2) of its energy to first order: near e = 1 it rebounds at
    e, at small e faster. With chi = 3 (1 - e^2)/4 the exact ratio r of speeds solves
    ln[(1 + chi)/(1 - chi r)] = chi (1 + r)."""
    p = laws.normal_parameters(NormalLaw(law="lankarani_nikravesh", restitution=e), HERTZ_BALL, 1.5)
    chi = 0.75 * (1.0 - e * e)
    r = brentq(lambda r: np.log((1 + chi) / (1 - chi * r)) - chi * (1 + r), 0.1, 1.0)
    found = strike(laws.restitution, p, 2.7173e-3, 0.5).restitution
    assert found == pytest.approx(r, abs=1e-6) and e <= r < e + miss


@pytest.mark.parametrize(
    ("modulus", "ratio", "palmgren"),
    [(206e9, 0.3, 3.847e-5), (310e9, 0.26, 2.722e-5), (105e9, 0.34, 6.877e-5)],
)
def test_a_line_contact_of_any_material_yields_as_palmgren_has_it(modulus, ratio, palmgren):
    """d = 1.36 eta^0.9 Q^0.9/L^0.8 in N and mm, eta = 2 (1 - nu^2)/E, of steel, silicon nitride
    and brass; the standard's contact of steel yields 3.4 % more."""
    k = laws.iso_line_stiffness(10e-3, modulus / (1.0 - ratio**2))
    found = 1e3 * (1000.0 / k) ** 0.9  # mm
    assert found == pytest.approx(1.034 * palmgren * 1000.0**0.9 / 10.0**0.8, rel=2e-3)


def test_the_most_slices_that_a_case_may_ask_for_fit_the_buffers():
    from dataclasses import fields

    from flexcage.contacts.slices import CAPACITY
    from flexcage.contacts.spec import PairSpec

    (slices,) = (f for f in fields(PairSpec) if f.name == "slices")
    assert slices.metadata["maximum"] <= CAPACITY
