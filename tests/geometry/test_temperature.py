"""Moduli of cages over temperature: as the sources have them, at room temperature to the bit."""

import re
from dataclasses import replace
from math import exp, log
from pathlib import Path

import pytest
from crown_cage import crown

from flexcage.core.errors import InputError
from flexcage.geometry.materials import MATERIALS
from flexcage.geometry.temperature import (
    MODULUS_CURVES,
    ModulusCurve,
    beyond_service,
    material_at,
    register_modulus_curve,
)
from flexcage.stages import flexible_cage


def celsius(t):
    return t + 273.15


def test_room_temperature_changes_no_bit():
    for name, material in MATERIALS.items():
        assert material_at(material, None) is material
        if name in MODULUS_CURVES:
            assert material_at(material, celsius(23.0)) == material


def test_every_material_of_cages_but_polyimide_has_a_curve_with_a_source():
    elements = {"Si3N4", "ZrO2"}  # ceramics of rolling elements, whose modulus hardly falls
    assert set(MATERIALS) - set(MODULUS_CURVES) - elements == {"polyimide"}
    for curve in MODULUS_CURVES.values():
        assert curve.source and list(curve.ratios) == sorted(curve.ratios, reverse=True)
        assert curve.temperatures[0] < curve.service < curve.temperatures[-1] + 1.0


@pytest.mark.parametrize(
    ("name", "temperature", "modulus"),
    [
        ("PA66", 121.0, 0.54e9),
        ("PA66 A3K conditioned", 77.0, 1.1e9 * 0.565 / 1.21),
        ("PEEK", 150.0, 3.7e9 * 4.3 / 5.7),
        ("steel", 204.0, 206e9 * 27.7 / 29.5),
        ("brass", 149.0, 105e9 * 14.4 / 15.0),
        # half way between two points: the mean of the logarithms
        ("PA66", 50.0, exp(0.5 * (log(2.83e9) + log(0.69e9)))),
    ],
)
def test_modulus_at_a_temperature(name, temperature, modulus):
    warm = material_at(MATERIALS[name], celsius(temperature))
    assert warm.youngs_modulus == pytest.approx(modulus, rel=1e-12)
    assert warm.density == MATERIALS[name].density
    if MODULUS_CURVES[name].polymer:  # tan delta goes with 1/E
        product = warm.loss_factor * warm.youngs_modulus
        assert product == pytest.approx(
            MATERIALS[name].loss_factor * MATERIALS[name].youngs_modulus
        )
    else:
        assert warm.loss_factor == MATERIALS[name].loss_factor


def test_the_table_of_the_page_is_what_is_computed():
    """``flexcage/cages/README.md``, two digits or more."""
    text = (Path(__file__).parents[2] / "flexcage" / "cages" / "README.md").read_text("utf-8")
    rows = re.findall(
        r"^\| ((?:PA|PEEK|steel)[^|]*)\|([^|]*)\|([^|]*)\|([^|]*)\|", text, flags=re.M
    )
    assert len(rows) == 6
    for names, *columns in rows:
        grade, *state = (name.strip() for name in names.split(";"))
        other = {"A3K conditioned": "PA66 A3K conditioned", "brass": "brass"}
        grades = [grade, *(other.get(s, f"{grade} {s}") for s in state)]
        for t, cells in zip((23.0, 80.0, 120.0), columns, strict=True):
            for name, cell in zip(grades, cells.split(";"), strict=True):
                warm = material_at(MATERIALS[name], celsius(t)).youngs_modulus
                assert 1e-9 * warm == pytest.approx(float(cell), rel=0.012), (name, t)


@pytest.mark.parametrize("temperature", [60.0, 120.0])
def test_glass_fibres_and_dryness_keep_stiffness(temperature):
    moduli = [
        material_at(MATERIALS[name], celsius(temperature)).youngs_modulus
        for name in ("PA66-GF30", "PA66-GF30 conditioned", "PA66 A3K", "PA66 A3K conditioned")
    ]
    assert moduli == sorted(moduli, reverse=True)


def test_a_users_modulus_is_scaled():
    own = replace(MATERIALS["PA66"], youngs_modulus=2e9)
    assert material_at(own, celsius(121.0)).youngs_modulus == pytest.approx(2e9 * 0.54 / 2.83)


@pytest.mark.parametrize(
    ("overrides", "words"),
    [
        ({"cage.temperature": "150 degC"}, "of PA66 is known from -40 degC to 121 degC"),
        (
            {"cage.temperature": "80 degC", "cage.material": "polyimide"},
            "no modulus of polyimide over temperature is known; leave it out",
        ),
        ({"cage.temperature": "-300 degC"}, "below absolute zero, -273.15 degC"),
        ({"cage.temperature": "80"}, "is 80 without a unit"),
        ({"cage.temperature": "80 C"}, "is 'degC' meant"),
        ({"cage.temperature": "1e4 degC"}, "must be 9726.85 degC or less"),
    ],
)
def test_what_cannot_be_is_one_sentence(overrides, words):
    with pytest.raises(InputError, match=words) as caught:
        crown(overrides)
    assert caught.value.where == "cage.temperature" and "\n" not in str(caught.value)


def test_a_body_of_ones_own_has_its_own_temperature(tmp_path):
    (tmp_path / "body.npz").write_bytes(b"1")
    with pytest.raises(InputError, match="modes.body brings the stiffness"):
        crown({"cage.temperature": "100 degC", "modes.body": str(tmp_path / "body.npz")})


def test_the_case_carries_it():
    case = crown()
    warm = crown({"cage.temperature": "120 °C"})
    assert warm.to_table()["cage"]["temperature"] == "120 degC"
    assert "temperature" not in case.to_table()["cage"]
    assert warm.hash != case.hash == crown({"cage.temperature": "none"}).hash
    assert warm.hash != crown({"cage.temperature": "100 degC"}).hash


def test_a_warning_beyond_service():
    assert not beyond_service(MATERIALS["PA66"], celsius(120.0))
    assert not beyond_service(MATERIALS["PA66"], None)
    assert "up to 120 degC" in beyond_service(MATERIALS["PA66"], celsius(121.0))
    assert "up to 250 degC" in beyond_service(MATERIALS["brass"], celsius(300.0))


def test_a_curve_of_ones_own():
    fields = {"material": "mine", "service": celsius(90.0), "source": "a sheet"}
    temperatures = (celsius(23.0), celsius(100.0))
    with pytest.raises(InputError, match="2 temperatures and 1 ratios"):
        register_modulus_curve(ModulusCurve(temperatures=temperatures, ratios=(1.0,), **fields))
    with pytest.raises(InputError, match="no source"):
        nameless = fields | {"source": ""}
        register_modulus_curve(
            ModulusCurve(temperatures=temperatures, ratios=(1.0, 0.5), **nameless)
        )
    register_modulus_curve(ModulusCurve(temperatures=temperatures, ratios=(1.0, 0.5), **fields))
    try:
        mine = replace(MATERIALS["PA66"], name="mine")
        assert material_at(mine, celsius(100.0)).youngs_modulus == pytest.approx(1.415e9)
    finally:
        del MODULUS_CURVES["mine"]


def test_frequencies_of_a_warm_cage():
    """All frequencies of the modal basis go with the root of the modulus; its damping is the
    warm material's."""
    cages = {}
    for text in ("", "121 degC"):
        case = crown({"modes.count": 6} | ({"cage.temperature": text} if text else {}))
        cages[text] = flexible_cage(case)
    cold, warm = (cage.table.frequency for cage in cages.values())
    assert warm == pytest.approx((0.54 / 2.83) ** 0.5 * cold, rel=1e-6)
    assert case.modes.damped_as(case.cage.warm_material).damping == pytest.approx(
        0.01 + 0.5 * 0.014 * 2.83 / 0.54
    )
