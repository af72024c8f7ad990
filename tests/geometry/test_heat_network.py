"""Temperatures of bodies between which heat flows: by hand, in balance, and refused sentences."""

from math import erf, pi, sqrt

import numpy as np
import pytest

from flexcage.case import load_static
from flexcage.core.errors import InputError
from flexcage.geometry.heat import correlations
from flexcage.geometry.heat.network import NODES, SHARES, Network, by_body
from flexcage.geometry.heat.spec import Heat

CASE = """
name = "warm"
[bearing]
type = "deep_groove_ball"
bore = "30 mm"
outside_diameter = "62 mm"
width = "16 mm"
pitch_diameter = "46 mm"
ball_diameter = "9.525 mm"
ball_count = 9
inner_groove_radius = "4.9054 mm"
outer_groove_radius = "5.0006 mm"
radial_clearance = "10 um"
[drive]
speed = "{speed}"
[load]
radial = "980 N"
[heat]
{heat}
"""
OIL = """[life]
viscosity_40 = "68 mm^2/s"
viscosity_100 = "8.7 mm^2/s"
temperature = "60 degC"
"""


def case(heat="", *, speed="5400 rpm", oil=OIL):
    return load_static(CASE.format(heat=heat, speed=speed) + oil)


def test_two_bodies_by_hand():
    """100 W into the first, 3 W/K on to the second, 2 W/K from there to 300 K: the second is 50 K
    warmer than what is around, the first 33.3 K more."""
    found = Network({("inner", "shaft"): 3.0, ("shaft", "ambient"): 2.0}, {"ambient": 300.0})
    warm = found.temperatures({"inner": 100.0})
    assert warm == pytest.approx({"inner": 300.0 + 50.0 + 100.0 / 3.0, "shaft": 350.0}, rel=1e-14)


def test_heat_out_is_heat_in_of_any_network():
    rng = np.random.default_rng(3)
    pairs = {(a, b): float(rng.uniform(0.01, 10.0)) for k, a in enumerate(NODES) for b in NODES[:k]}
    pairs |= {("shaft", "ambient"): 0.4, ("housing", "ambient"): 2.0, ("oil", "inlet"): 5.0}
    network = Network(pairs, {"ambient": 290.0, "inlet": 330.0})
    losses = {name: float(rng.uniform(0.0, 50.0)) for name in NODES}
    out = network.out(network.temperatures(losses))
    assert sum(out.values()) == pytest.approx(sum(losses.values()), rel=1e-12)
    assert set(out) == {("shaft", "ambient"), ("housing", "ambient"), ("oil", "inlet")}


def test_a_body_without_a_way_out_is_one_sentence():
    network = Network(
        {("inner", "shaft"): 0.0, ("shaft", "ambient"): 2.0, ("inner", "oil"): 1.0},
        {"ambient": 300.0},
    )
    with pytest.raises(InputError, match="No heat gets out of inner ring, oil: all conductances"):
        network.temperatures({"inner": 1.0})


def test_every_place_heats_bodies_by_shares_of_one():
    for place, shares in SHARES.items():
        assert set(shares) <= set(NODES) and sum(shares.values()) == 1.0, place
    assert by_body({"inner race": 2.0, "seals": 1.0}) == {"inner": 2.0, "elements": 1.0}


def test_seats_give_off_what_the_standard_says():
    """A 6206: A = pi 16 (30 + 62) = 4624 mm^2 at 0.016 W/mm^2 over 50 K; and one so large that the
    density falls to 2^-0.34 of it."""
    bearing = case().bearing
    assert correlations.seat_flow(bearing) == pytest.approx(1.4798, rel=1e-4)

    class Large:
        width, bore, outside_diameter = 0.1, 0.1, 1.0 / pi - 0.1

    assert correlations.seat_flow(Large()) == pytest.approx(0.016 * 2.0**-0.34 * 1e5 / 50.0)


def test_a_rolling_contact_exchanges_what_two_half_spaces_do():
    """Two half-spaces 1 K apart that touch for a time t: half of the difference diffuses into
    each, and the heat in one is that under the error function's profile."""
    bearing, speed, half, across = case().bearing, 4.0, 1e-4, 1e-3
    heat = Heat()
    flat = correlations.Contacts(
        np.full((1, 2), across), np.full((1, 2), half), np.zeros((1, 2)), np.full((1, 2), speed),
        elliptical=False,
    )  # fmt: skip
    rho_c = bearing.material.density * heat.ring_capacity
    diffusivity, t = heat.ring_conductivity / rho_c, 2.0 * half / speed
    x = np.linspace(0.0, 12.0 * sqrt(diffusivity * t), 20001)
    profile = 0.5 * (1.0 - np.array([erf(v / sqrt(4.0 * diffusivity * t)) for v in x]))
    per_area = rho_c * np.trapezoid(profile, x)
    expected = per_area * speed * 2.0 * across
    found = correlations.rolling_conductances(flat, heat, bearing)
    assert found == pytest.approx([expected] * 2, rel=1e-5)


def test_a_film_resists_and_an_ellipse_is_narrower():
    bearing = case().bearing
    one = {"across": np.full((1, 2), 1e-3), "along": np.full((1, 2), 1e-4),
           "speed": np.full((1, 2), 4.0)}  # fmt: skip
    bare = correlations.Contacts(**one, film=np.zeros((1, 2)), elliptical=False)
    thick = correlations.Contacts(**one, film=np.full((1, 2), 1e-3), elliptical=False)
    round_ = correlations.Contacts(**one, film=np.zeros((1, 2)), elliptical=True)
    g = [correlations.rolling_conductances(c, Heat(), bearing)[0] for c in (bare, thick, round_)]
    assert g[1] == pytest.approx(0.14 * 4e-7 / 1e-3, rel=1e-3)  # k A/h alone
    s = np.linspace(-1.0, 1.0, 200001)
    assert g[2] / g[0] == pytest.approx(np.trapezoid((1.0 - s * s) ** 0.25, s) / 2.0, rel=1e-5)


def test_water_along_a_plate():
    """Re = 1e5, Pr = 7: Nu = 0.332 sqrt(1e5) 7^(1/3) = 200.8 (Pohlhausen, the local value)."""
    oil = correlations.OilState(viscosity=1e-6, density=1000.0)
    water = Heat(oil_conductivity=0.6, oil_capacity=4200.0)
    assert oil.prandtl(water) == pytest.approx(7.0)
    assert correlations.plate(1.0, 0.1, oil, water) == pytest.approx(200.83 * 6.0, rel=1e-4)


@pytest.mark.parametrize(
    ("heat", "said"),
    [
        ('shaft_ambient = "0 W/K"\nhousing_ambient = "0 W/K"', "so no heat leaves the bearing"),
        ('oil_inlet = "40 degC"', "heat.oil_inlet is 40 degC, but no oil flows"),
        ('ambient = "160 degC"', "heat.oil_limit is 150 degC, but heat.ambient is 160 degC"),
        ('housing_ambient = "-1 W/K"', "heat.housing_ambient is -1 W/K"),
        ('housing_ambient = "2 N/m"', "heat.housing_ambient is '2 N/m'"),
        ('viscosity_40 = "68 mm^2/s"', "life.viscosity_40"),
        ('tolerance = "1 degC"', "heat.tolerance"),
        ('losses = "dynamic"', "heat.losses 'dynamic' is not known"),
    ],
)
def test_impossible_heat_is_one_sentence(heat, said):
    with pytest.raises(InputError) as found:
        case(heat)
    assert said in str(found.value) and str(found.value).count("\n") == 0


def test_heat_needs_an_oil_and_a_speed():
    with pytest.raises(InputError, match="Temperatures need the oil's viscosity over temperature"):
        case('ambient = "30 degC"', oil="")
    with pytest.raises(InputError, match="stands still at the start"):
        case('ambient = "30 degC"', speed="0 rpm")


def test_heat_needs_to_know_how_bodies_grow():
    own = 'material = {name = "alloy", youngs_modulus = "200 GPa", poisson_ratio = 0.3, '
    own += 'density = "7800 kg/m^3"}'
    with pytest.raises(InputError, match="no thermal expansion of alloy is known; give bearing.m"):
        load_static(CASE.format(heat="", speed="5400 rpm").replace(
            "[drive]", f"{own}\n[drive]").replace("[heat]", "[heat]\nseal_torque = '1 N*mm'") + OIL
        )  # fmt: skip


def test_a_case_with_heat_reads_back():
    warm = case('housing_ambient = "2.5 W/K"\noil_flow = "0.2 l/min"\noil_inlet = "40 degC"')
    assert warm.heat.oil_flow == pytest.approx(0.2e-3 / 60.0)
    assert load_static(warm.to_toml()) == warm
    assert "heat" not in case("").to_table()
