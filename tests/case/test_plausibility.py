"""Values far from any solid or any bearing are computed as they are, and questioned once each, in
statics and runs alike, with the slip of a unit that they probably are."""

from __future__ import annotations

import warnings
from types import SimpleNamespace

import pytest

import flexcage
from flexcage.case.plausibility import implausible_values
from flexcage.contacts.laws import pocket_line_law
from flexcage.core.errors import InputError
from flexcage.geometry.materials import MATERIALS
from flexcage.results.warnings_at_end import AT_END

GPA = 1e9
ROLLERS, BALLS = (flexcage.load_case(f"examples/{n}.toml") for n in ("n1013", "c7010"))
ODD = [
    (ROLLERS, "cage.material.youngs_modulus", 3.7e6, "is 3.7 GPa meant?"),
    (ROLLERS, "cage.material.youngs_modulus", 105e12, "is 105 GPa meant?"),
    (BALLS, "cage.material.youngs_modulus", 3e6, "is 3 GPa meant?"),
    (BALLS, "bearing.material.youngs_modulus", 210e6, "is 210 GPa meant?"),
    (ROLLERS, "bearing.material.youngs_modulus", 1e6, "is 1 GPa meant?"),
    (ROLLERS, "cage.material.density", 8.5, "is 8500 kg/m^3 meant?"),
    (BALLS, "bearing.material.density", 7.85e6, "is 7850 kg/m^3 meant?"),
    (ROLLERS, "cage.material.poisson_ratio", 0.034, "is 0.34 meant?"),
    (ROLLERS, "cage.material.proof_stress", 160e3, "is 160 MPa meant?"),
    (ROLLERS, "lubricant.viscosity", 68.0, "is 68 mPa*s meant?"),
    (BALLS, "lubricant.viscosity", 2e-5, "is 20 mPa*s meant?"),
    (ROLLERS, "lubricant.pressure_coefficient", 2e-11, "is 20 1/GPa meant?"),
    (ROLLERS, "lubricant.density", 0.86, "is 860 kg/m^3 meant?"),
    (ROLLERS, "contacts.pocket.friction.dynamic", 8.0, "is 0.08 meant?"),
    (ROLLERS, "contacts.race.friction.peak", 5.0, "is 0.05 meant?"),
    (BALLS, "load.gravity", 9810.0, "is 9.81 m/s^2 meant?"),
]  # fmt: skip


@pytest.mark.parametrize(("case", "path", "value", "said"), ODD)
def test_a_constant_far_from_any_solid_is_questioned_once(case, path, value, said):
    found = [
        text for key, text in implausible_values(case.replace({path: value})) if key == "odd_value"
    ]
    assert len(found) == 1
    assert found[0].startswith(f"{path} is ")
    assert found[0].endswith(said)


def test_friction_at_rest_below_that_of_sliding_is_questioned_where_both_are_read():
    pocket = "contacts.pocket.friction"
    odd = {f"{pocket}.static": 0.05, f"{pocket}.dynamic": 0.2}
    ((key, text),) = implausible_values(ROLLERS.replace(odd))
    assert key == "odd_value" and text.startswith(f"{pocket}.static is 0.05, below its dynamic, 0")
    for law in ("ramp_coulomb", "none"):
        assert not list(implausible_values(ROLLERS.replace({f"{pocket}.law": law, **odd})))


def test_a_cage_whose_speed_is_held_at_none_is_questioned():
    held = flexcage.spec.CageSpeed
    ((_, text),) = implausible_values(ROLLERS.replace("constraints", (held(),)))
    assert text.startswith("constraints.0 (cage_speed) has neither speed nor ratio, and holds")
    assert not list(implausible_values(ROLLERS.replace("constraints", (held(ratio=0.4),))))


@pytest.mark.parametrize("name", sorted(MATERIALS))
def test_no_material_of_the_table_is_questioned(name):
    case = ROLLERS.replace({"cage.material": MATERIALS[name]})
    assert list(implausible_values(case)) == []


def test_a_ring_that_bends_is_a_body_too():
    odd = flexcage.spec.Material(name="odd", youngs_modulus=2e8, poisson_ratio=0.3, density=7850.0)
    case = ROLLERS.replace({"inner_ring.ring": "flexible", "inner_ring.material": odd})
    first, second = (text for _, text in implausible_values(case))
    assert first.startswith("inner_ring.material.youngs_modulus is 0.2 GPa, below")
    assert second == (
        "inner_ring.material (odd) makes the ring bend as it says, but contacts with the ring, and "
        "their films, have the moduli of bearing.material (GCr15)."
    )


def test_waves_of_a_millimetre_are_questioned():
    ((key, text),) = implausible_values(ROLLERS.replace("bearing.inner_waviness", 1e-3))
    assert text == (
        "bearing.inner_waviness is 1000 um, for rollers of 8 mm: waves of ground races have 0.01 "
        "to 5 um."
    )
    assert not list(implausible_values(ROLLERS.replace("bearing.inner_waviness", 20e-6)))


def test_statics_say_so_in_their_table():
    case = flexcage.load_static("examples/nu210.toml")
    soft = case.replace({"bearing.material.youngs_modulus": 1.9 * GPA})
    assert "but bearing.material is GCr15, with 1.9 GPa" in flexcage.solve_static(soft).table()
    odd = case.replace({"bearing.inner_waviness": 1e-3})
    assert "Warning: bearing.inner_waviness is 1000 um" in flexcage.solve_static(odd).table()
    assert "Warning" not in flexcage.solve_static(case).table()


def test_bodies_too_soft_for_a_line_contact_are_refused_in_a_sentence():
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        with pytest.raises(InputError, match="are cage.material.youngs_modulus and bearing") as exc:
            pocket_line_law(
                radius=4e-3, length=7.3e-3, roller=(206 * GPA, 0.3), wall=(3.7e6, 0.4), depth=1e-3
            )
    assert exc.value.where == "cage.material.youngs_modulus"


@pytest.mark.parametrize(
    ("case", "allowed"),
    [(ROLLERS, 5.0 / 22), (BALLS, None)],
)
def test_forces_beyond_the_static_rating_are_warned_of(case, allowed):
    """ISO 76: the most loaded element bears 5 C0r/(Z cos(alpha))."""
    from math import cos, radians

    b = case.bearing
    share = allowed or 5.0 / b.element_count / cos(radians(15.0))
    limit = share * b.static_rating
    (check,) = (c for c in AT_END if c.__name__ == "_overloaded")

    def said(force):
        outcome = SimpleNamespace(
            bearing=b, element=b.element, number=lambda k: force if k[-5:] == "inner" else 0.0
        )
        return [w.text for w in check(outcome)]

    assert said(0.99 * limit) == []
    assert "23 times what the static rating allows one" in said(23.0 * limit)[0]


@pytest.mark.parametrize(
    ("text", "said"),
    [
        ('preset = "N1013"\nroller_count = 30', "0.0472958 mm at their thinnest, for rollers of 8"),
        ('preset = "7010C-PI"\ncontact_angle = "0.26 deg"', "is 0.26 rad meant?"),
    ],
)
def test_a_bearing_that_nobody_makes_is_questioned(text, said):
    found = [text for _, text in implausible_values(flexcage.load_case(f"[bearing]\n{text}\n"))]
    assert len(found) == 1 and said in found[0]


@pytest.mark.parametrize("name", flexcage.preset_names())
def test_no_preset_is_questioned(name):
    assert not list(implausible_values(flexcage.load_case(f'[bearing]\npreset = "{name}"\n')))
