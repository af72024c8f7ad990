"""Neuber's rule and lives against values worked out elsewhere."""

from math import inf

import pytest

from flexcage.core.errors import InputError
from flexcage.stress.notch import (
    READINGS,
    SOFT_STEELS,
    CyclicSteel,
    neuber,
    notch_factor,
    notch_life,
    reversals,
    uniform_law,
)

SAMPLE = CyclicSteel(
    name="sample", modulus=192e9, strength=500e6, hardening=900e6, exponent=0.18,
    fatigue_strength=827e6, b=-0.11, fatigue_ductility=0.95, c=-0.64, source="a sample",
)  # fmt: skip


@pytest.mark.parametrize(
    "factor, stress, strain", [(2.0, 371.284e6, 0.00224446), (3.0, 483.930e6, 0.00387453)]
)
def test_neuber_of_a_sample(factor, stress, strain):
    """Values of an independent program for a range of 200 MPa, E 192 GPa, K' 900 MPa, n' 0.18."""
    found = neuber(200e6, factor, SAMPLE)
    assert found == (pytest.approx(stress, rel=2e-6), pytest.approx(strain, rel=3e-6))
    assert found[0] * found[1] == pytest.approx((factor * 200e6) ** 2 / 192e9, rel=1e-9)


def test_readings_of_the_factor():
    assert notch_factor(2.0, 200e6, 500e6) == pytest.approx(1.5157, abs=1e-4)
    assert notch_factor(3.0, 200e6, 500e6) == pytest.approx(1.9332, abs=1e-4)
    assert notch_factor(2.0, 200e6, 500e6, "linear") == pytest.approx(1.6)
    assert notch_factor(3.0, 200e6, 500e6, "linear") == pytest.approx(2.2)
    for reading in READINGS:
        assert notch_factor(2.5, 0.0, 500e6, reading) == pytest.approx(2.5)
        assert notch_factor(2.5, 500e6, 500e6, reading) == pytest.approx(1.0)


def test_neuber_agrees_with_pylife():
    """pyLife's first loading with the shape factor much above 1 is Neuber's rule; a range is twice
    an amplitude."""
    law = pytest.importorskip("pylife.materiallaws.notch_approximation_law")
    for elastic in (150e6, 400e6, 900e6):
        theirs = law.ExtendedNeuber(192e3, 900.0, 0.18, K_p=1.0)
        stress = float(theirs.stress(elastic / 1e6, rtol=1e-10, tol=1e-10))
        # at K_p = 1 pyLife's nominal strain is plastic too: sigma eps = L (L/E + (L/K')^(1/n'))
        nominal = elastic * (elastic / 192e9 + (elastic / 900e6) ** (1 / 0.18))
        ours = 0.5 * neuber(2.0 * (nominal * 192e9) ** 0.5, 1.0, SAMPLE)[0]
        assert ours == pytest.approx(stress * 1e6, rel=1e-4)


def test_lives_of_sae_1015():
    """Lives of the strain-life curve come back; SWT and Morrow agree with it without mean stress,
    as far as K', n' and the curve's own constants belong together."""
    steel = SOFT_STEELS[0]
    assert steel.strain_amplitude(2e4) == pytest.approx(
        827.37e6 / 206.84e9 * 2e4**-0.11 + 0.95 * 2e4**-0.64, rel=1e-4
    )
    amplitude = steel.strain_amplitude(2e4)
    assert reversals(1.0, 2.0 * amplitude, steel, mean_stress="morrow") == pytest.approx(2e4)
    top = steel.fatigue_strength * 2e4**steel.b
    assert reversals(0.0, 2.0 * amplitude, steel, highest=top) == pytest.approx(2e4)
    # its hardening follows from its strain-life curve within the digits of the table
    implied = steel.fatigue_strength / steel.fatigue_ductility ** (steel.b / steel.c)
    assert implied == pytest.approx(steel.hardening, rel=0.15)


def test_mean_stress_shortens_lives():
    steel = uniform_law(400e6)
    for way in ("swt", "morrow"):
        lives = [
            reversals(400e6, 0.003, steel, highest=top, mean_stress=way)
            for top in (100e6, 200e6, 300e6)
        ]
        assert lives[0] > lives[1] > lives[2]
    assert reversals(400e6, 0.003, steel, highest=-1e6) == inf


def test_small_ranges_are_elastic_and_last():
    for steel in SOFT_STEELS:
        life = notch_life(20e6, 2.0, steel, elastic_highest=50e6)
        assert life.elastic and life.swt > 2e9
        assert life.stress == pytest.approx(life.K_f * 20e6, rel=1e-3)
        hard = notch_life(200e6, 10.0, steel, elastic_highest=900e6, reading="linear")
        assert not hard.elastic and hard.swt < 1e6 and "beyond yield" in str(hard)


@pytest.mark.parametrize(
    "make, words",
    [
        (lambda: notch_factor(2.0, 600e6, 500e6), "of 0 to the tensile strength"),
        (lambda: notch_factor(2.0, 1e6, 500e6, "third"), "no reading 'third'"),
        (lambda: notch_factor(-2.0, 1e6, 500e6), "K_t is -2"),
        (lambda: neuber(1e6, 0.0, SAMPLE), "factor is 0"),
        (lambda: reversals(1e6, 1e-3, SAMPLE, mean_stress="x"), "choose from swt, morrow"),
        (lambda: uniform_law(50e6), "from 200 to 2500 MPa"),
    ],
)
def test_mistakes(make, words):
    with pytest.raises(InputError, match=words):
        make()
