"""Elements of another material than the rings: which contact feels which, by closed forms; and
nothing changes, to the bit, where the material is the same."""

from __future__ import annotations

from dataclasses import replace
from math import pi

import numpy as np
import pytest

import flexcage
from flexcage import solve_static, stages
from flexcage.bearings.ball.model import pocket_contact
from flexcage.case.description import grounds, in_words
from flexcage.case.plausibility import implausible_values
from flexcage.case.unread import not_used
from flexcage.geometry.film import Oil
from flexcage.geometry.materials import MATERIALS

NAMES = ("n1013", "nu210", "c7010")
CASES = {
    name: flexcage.load_case(f"examples/{name}.toml")
    .replace("cage.model", "rigid")
    .replace("bearing.material", "GCr15")
    for name in NAMES
}
HYBRID = {n: case.replace("bearing.element_material", "Si3N4") for n, case in CASES.items()}
#: E' [Pa] by hand: 2/(0.91/206 GPa + 0.9271/310 GPa), and E/(1 - nu^2) of either alone
ON_RACE, STEEL, CERAMIC = 2.699740e11, 2.263736e11, 3.343760e11
#: Parts of a model whose law knows the elements, and those that know the rings.
OF_ELEMENTS = {
    "n1013": {"inner", "outer", "rib", "neighbours", "pocket"},
    "nu210": {"inner", "outer", "outer_rib", "neighbours", "pocket"},
    "c7010": {"inner", "outer", "neighbours", "pocket"},
}
OF_RINGS = {
    "n1013": {"inner", "outer", "rib", "land"},
    "nu210": {"inner", "outer", "outer_rib", "land"},
    "c7010": {"inner", "outer", "land"},
}


def model_of(case):
    return stages.bearing_to_compile(case).data.model


def laws(model):
    places = {name: getattr(part, "normal", None) for name, part in model._asdict().items()}
    return {k: np.array(v) for k, v in places.items() if v is not None}


def arrays(part):
    """All numbers of a model's part, in order."""
    if isinstance(part, tuple):
        return [a for item in part for a in arrays(item)]
    return [np.asarray(part)]


@pytest.mark.parametrize("name", NAMES)
def test_the_same_material_given_twice_changes_no_bit(name):
    default, twice = CASES[name], CASES[name].replace("bearing.element_material", "GCr15")
    assert default.bearing.element_material is None
    for one, other in zip(arrays(model_of(default)), arrays(model_of(twice)), strict=True):
        assert one.tobytes() == other.tobytes()
    one, other = solve_static(default), solve_static(twice)
    assert one.elements.force.tobytes() == other.elements.force.tobytes()
    assert one.film.central.tobytes() == other.film.central.tobytes()


@pytest.mark.parametrize("name", NAMES)
def test_each_contact_feels_the_bodies_that_touch_there(name):
    """The land is the cage's on a ring; neighbours are elements; pockets are cage and element."""
    plain, case = laws(model_of(HYBRID[name])), HYBRID[name]
    for path, parts in (
        ("bearing.element_material.youngs_modulus", OF_ELEMENTS[name]),
        ("bearing.material.youngs_modulus", OF_RINGS[name]),
    ):
        other = laws(model_of(case.replace(path, 250e9)))
        moved = {k for k in plain if not np.array_equal(plain[k], other[k])}
        assert parts <= moved <= parts | {"rib", "outer_rib"}


@pytest.mark.parametrize("name", NAMES)
def test_masses_are_those_of_their_own_material(name):
    steel, hybrid = CASES[name].bearing, HYBRID[name].bearing
    assert hybrid.element_mass / steel.element_mass == pytest.approx(3200.0 / 7850.0)
    assert hybrid.inner_ring_mass == steel.inner_ring_mass
    assert hybrid.outer_ring_inertia == steel.outer_ring_inertia
    one, other = (model_of(c[name]).bodies.element for c in (CASES, HYBRID))
    assert other / one == pytest.approx(3200.0 / 7850.0)


def test_a_ball_of_silicon_nitride_has_its_mass():
    ball = HYBRID["c7010"].bearing
    assert ball.ball_mass == pytest.approx(3200.0 * pi / 6.0 * 9.525e-3**3, rel=1e-12)


def test_hertz_of_a_steel_race_and_a_ceramic_ball():
    """Q = K d^1.5 with K in proportion to E', pressure to E'^(2/3) and axes to E'^(-1/3)."""
    steel, hybrid = CASES["c7010"].bearing, HYBRID["c7010"].bearing
    for one, other in zip(steel.contacts, hybrid.contacts):
        assert (one.modulus, other.modulus) == pytest.approx((STEEL, ON_RACE), rel=1e-5)
        ratio = ON_RACE / STEEL
        assert other.stiffness / one.stiffness == pytest.approx(ratio, rel=1e-5)
        assert other.pressure(50.0) / one.pressure(50.0) == pytest.approx(
            ratio ** (2 / 3), rel=1e-5
        )
        axes = [c.semi_axes(50.0)[0] for c in (one, other)]
        assert axes[1] / axes[0] == pytest.approx(ratio ** (-1 / 3), rel=1e-5)


@pytest.mark.parametrize("name", ["n1013", "nu210"])
def test_lines_of_rollers_on_races_neighbours_and_ribs(name):
    """K d^n in proportion to E' of the two bodies: race and rib have both, neighbours one."""
    steel, hybrid = laws(model_of(CASES[name])), laws(model_of(HYBRID[name]))
    for place, modulus in (
        ("inner", ON_RACE), ("outer", ON_RACE), ("rib", ON_RACE), ("outer_rib", ON_RACE),
        ("neighbours", CERAMIC),
    ):  # fmt: skip
        if place not in OF_ELEMENTS[name]:
            continue
        assert hybrid[place][0] / steel[place][0] == pytest.approx(modulus / STEEL, rel=1e-5)


def test_neighbours_and_pockets_of_ceramic_balls():
    steel, hybrid = laws(model_of(CASES["c7010"])), laws(model_of(HYBRID["c7010"]))
    assert hybrid["neighbours"][0] / steel["neighbours"][0] == pytest.approx(
        CERAMIC / STEEL, rel=1e-5
    )
    cage, bearing = HYBRID["c7010"].cage, HYBRID["c7010"].bearing
    wall = cage.material.youngs_modulus / (1.0 - cage.material.poisson_ratio**2)
    found = pocket_contact(bearing, cage, 0.5 * cage.pocket_diameter).modulus
    assert found == pytest.approx(2.0 / (1.0 / wall + 1.0 / CERAMIC), rel=1e-5)


def test_the_surface_of_contact_keeps_the_shape_of_the_stiffer_body():
    """A ball of rigid stuff prints itself into the groove; a soft one takes the groove's shape."""
    b = CASES["c7010"].bearing
    ball, groove = 2.0 / b.ball_diameter, 1.0 / b.outer_groove_radius
    hard = replace(MATERIALS["GCr15"], name="hard", youngs_modulus=206e15)
    soft = replace(MATERIALS["GCr15"], name="soft", youngs_modulus=206e3)
    bend = {m.name: replace(b, element_material=m).contact_curvatures[1] for m in (hard, soft)}
    assert bend["hard"] == pytest.approx(ball, rel=1e-5)
    assert bend["soft"] == pytest.approx(groove, rel=1e-5)
    assert b.contact_curvatures[1] == pytest.approx(0.5 * (ball + groove), rel=1e-12)
    ceramic = HYBRID["c7010"].bearing.contact_curvatures[1]
    share = (ceramic - groove) / (ball - groove)  # of the ball: the ring's part of what yields
    assert share == pytest.approx((1.0 / STEEL) / (1.0 / STEEL + 1.0 / CERAMIC), rel=1e-5)


@pytest.mark.parametrize(
    ("name", "central", "least"),
    [("c7010", -0.67 + 0.53 + 0.067, -0.68 + 0.49 + 0.073),
     ("n1013", -0.69 + 0.56 + 0.10, -0.70 + 0.54 + 0.13)],
)  # fmt: skip
def test_films_follow_the_modulus_of_both(name, central, least):
    """U^a G^b W^c of Hamrock, Dowson and Toyoda have E' to the power b - a - c."""
    force, speed, oil = np.array([[50.0, 60.0]]), np.array([[3.0, 4.0]]), Oil(0.02, 2e-8)
    steel, hybrid = (c[name].bearing.race_film(force, speed, oil) for c in (CASES, HYBRID))
    ratio = ON_RACE / STEEL
    assert hybrid.central / steel.central == pytest.approx(ratio**central, rel=1e-5)
    assert hybrid.least / steel.least == pytest.approx(ratio**least, rel=1e-5)


def test_pressures_of_rollers_and_lives_of_balls_follow_in_statics():
    """Hertz's line: pressure over half width is E'/(4 R), Johnson 4.43 and 4.45. Balls at speed
    press less on the outer race, so that the life of ISO/TS 16281 is longer."""
    at_rest = {"drive.speed": 0.0}
    ratios = []
    for cases in (CASES, HYBRID):
        elements = solve_static(cases["n1013"].replace(at_rest)).elements
        loaded = elements.force[:, 0].argmax()
        ratios.append(elements.pressure[loaded] / elements.along[loaded])
    assert ratios[1] / ratios[0] == pytest.approx(ON_RACE / STEEL, rel=1e-5)
    fast = {"drive.speed": 1500.0}
    steel, hybrid = (solve_static(c["c7010"].replace(fast)).ratings for c in (CASES, HYBRID))
    assert hybrid.reference_life > 1.5 * steel.reference_life


@pytest.mark.parametrize(("name", "most"), [("c7010", 4.2e9), ("n1013", 4.0e9)])
def test_a_static_rating_presses_as_hard_as_with_steel_elements(name, most):
    """The largest pressure of static solutions is the same under loads that are to each other as
    C0 is: of straight rollers without clearance, which share any load alike, and of balls but for
    the contact angle, which rises with the deflection."""
    rated, pressure = [], []
    still = {"drive.speed": 0.0}
    if name == "n1013":
        still |= {"bearing.radial_clearance": 0.0, "bearing.profile.kind": "straight"}
    for cases in (CASES, HYBRID):
        case = cases[name].replace(still)
        rating = solve_static(case).ratings.static
        at = "load.axial" if name == "c7010" else "load.radial"
        pressed = solve_static(case.replace({at: 0.05 * rating}))
        rated.append(rating)
        pressure.append(pressed.elements.pressure.max())
    assert rated[1] / rated[0] == pytest.approx((STEEL / ON_RACE) ** (2 if name == "c7010" else 1))
    assert pressure[1] / pressure[0] == pytest.approx(1.0, rel=0.02)
    assert pressure[0] < most


def test_words_sources_and_warnings_name_the_elements():
    case = HYBRID["c7010"]
    assert "18 balls of 9.525 mm of Si3N4" in in_words(case)[0].replace("\N{NO-BREAK SPACE}", " ")
    assert "SKF" in grounds(case)["Si3N4"] and "GCr15" in grounds(case)
    ((key, text),) = implausible_values(case)
    assert key == "other_steel" and "C is that of steel balls" in text
    assert "ISO 20056-2" in text
    assert not list(implausible_values(CASES["c7010"]))
    lost = case.replace("bearing.element_material.proof_stress", 1e9)
    assert "bearing.element_material.proof_stress (" in next(not_used(lost))
    odd = case.replace("bearing.element_material.density", 3.2)
    assert any("is 3200 kg/m^3 meant?" in text for _, text in implausible_values(odd))


@pytest.mark.parametrize(
    ("value", "said"),
    [("SiN", "'Si3N4' is silicon nitride"), ("zirconia", "'ZrO2' is zirconia"),
     ("ceramic", "the ceramics of rolling elements")],
)  # fmt: skip
def test_other_names_of_ceramics_are_answered(value, said):
    with pytest.raises(
        flexcage.InputError, match=f"element_material '{value}' is not known.*{said}"
    ):
        CASES["c7010"].replace("bearing.element_material", value)


def test_keys_that_people_look_for_name_the_key():
    with pytest.raises(flexcage.InputError, match="is bearing.element_material"):
        flexcage.load_case({"bearing": {"preset": "N1013", "roller_material": "Si3N4"}})
