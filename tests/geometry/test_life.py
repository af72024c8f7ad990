"""Modified rating life: a_1, a_ISO, viscosities and starved films, by what stands behind them."""

from math import log

import pytest

from flexcage.core.errors import InputError
from flexcage.geometry.life.iso281 import (
    BALLS,
    RELIABILITIES,
    ROLLERS,
    fatigue_limit,
    modification,
    reference_viscosity,
    reliability_factor,
    with_additives,
)
from flexcage.geometry.life.oil import starved_share, viscosity_at

RPM = 0.10471975511965977


@pytest.mark.parametrize("percent", RELIABILITIES)
def test_a1_is_the_weibull_of_ISO_TR_1281_2(percent):
    """a_1 = (1 - C) [ln(100/S)/ln(100/90)]^(1/e) + C with e = 1.5 and C = 0.05, the share of the
    life that all bearings reach."""
    due = 0.95 * (log(100.0 / percent) / log(100.0 / 90.0)) ** (2.0 / 3.0) + 0.05
    assert reliability_factor(percent) == pytest.approx(due, abs=0.0055 if percent < 99.9 else 6e-4)


@pytest.mark.parametrize("percent", [94.0, 0.95, 99.5, 50.0])
def test_reliabilities_outside_the_table(percent):
    with pytest.raises(InputError, match="but ISO 281 has a_1 for 90, 95, 96") as caught:
        reliability_factor(percent)
    assert ("in percent" in str(caught.value)) is (percent < 1.0)


@pytest.mark.parametrize("kind", [BALLS, ROLLERS])
@pytest.mark.parametrize("kappa", [0.4, 1.0])
def test_a_iso_has_no_jump_between_its_equations(kind, kappa):
    """The standard's three equations meet: a wrong digit in a constant would part them."""
    below, above = (modification(kind, kappa * (1.0 + s), 0.1) for s in (-1e-9, 1e-9))
    assert below == pytest.approx(above, rel=5e-4)


@pytest.mark.parametrize(
    ("kind", "kappa", "loading", "due"),
    [  # by hand
        (BALLS, 1.75, 0.164, 0.1 * (1.0 - 0.64705**0.83 * 0.164 ** (1 / 3)) ** -9.3),
        (BALLS, 0.2, 0.1, 0.1 * (1.0 - 0.095011**0.83 * 0.1 ** (1 / 3)) ** -9.3),
        (ROLLERS, 2.0, 0.2, 0.1 * (1.0 - 0.410991 * 0.2**0.4) ** -9.185),
        (ROLLERS, 0.6, 0.3, 0.1 * (1.0 - 0.224621 * 0.3**0.4) ** -9.185),
    ],
)
def test_a_iso(kind, kappa, loading, due):
    assert modification(kind, kappa, loading) == pytest.approx(due, rel=2e-4)


def test_a_iso_has_its_limits():
    assert modification(BALLS, 4.0, 5.0) == 50.0 == modification(BALLS, 2.0, 1.0)
    assert modification(BALLS, 1.0, 0.0) == 0.1 == modification(ROLLERS, 0.1, 0.0)
    assert modification(BALLS, 9.0, 0.1) == modification(BALLS, 4.0, 0.1)
    assert modification(BALLS, 0.01, 0.1) == modification(BALLS, 0.1, 0.1)
    assert modification(BALLS, 2.0, 0.3, thrust=True) == modification(BALLS, 2.0, 0.1)


def test_additives_stand_for_viscosity():
    plain, with_them = modification(BALLS, 0.3, 0.3), with_additives(BALLS, 0.3, 0.3, 0.5)
    assert plain < with_them <= 3.0
    assert with_them == min(modification(BALLS, 1.0, 0.3), 3.0)
    assert with_additives(BALLS, 0.3, 0.3, 0.1) == plain  # too dirty
    assert with_additives(BALLS, 2.0, 0.3, 0.5) == modification(BALLS, 2.0, 0.3)


def test_reference_viscosity():
    """4500 n^-0.5 Dpw^-0.5, and 45000 n^-0.83 Dpw^-0.5 below 1000 rpm."""
    assert reference_viscosity(2500.0 * RPM, 64e-3) == pytest.approx(1e-6 * 4500.0 / 50.0 / 8.0)
    assert reference_viscosity(-100.0 * RPM, 100e-3) == pytest.approx(
        1e-6 * 45000.0 / 100.0**0.83 / 10.0
    )


def test_fatigue_limit():
    assert fatigue_limit(BALLS, 22e3, 60e-3) == pytest.approx(1e3)
    assert fatigue_limit(BALLS, 22e3, 400e-3) == pytest.approx(500.0)
    assert fatigue_limit(ROLLERS, 82e3, 90e-3) == pytest.approx(1e4)


@pytest.mark.parametrize(
    ("grade", "at_100", "celsius", "due"),
    [  # mineral oils of viscosity index 95: makers' charts, read to 5 %
        (32.0, 5.36, 70.0, 11.0), (68.0, 8.73, 60.0, 29.0), (100.0, 11.2, 80.0, 19.5),
        (46.0, 6.73, 40.0, 46.0), (46.0, 6.73, 100.0, 6.73),
    ],
)  # fmt: skip
def test_viscosity_over_temperature(grade, at_100, celsius, due):
    found = viscosity_at(celsius + 273.15, 1e-6 * grade, 1e-6 * at_100)
    assert 1e6 * found == pytest.approx(due, rel=0.05)


def test_an_oil_that_thickens():
    with pytest.raises(InputError, match="oils thin with warmth: give less than"):
        viscosity_at(350.0, 10e-6, 20e-6)


def test_starved_film():
    """m* - 1 = 3.06 [(R/b)^2 h/R]^0.58: with R = 6 mm, b = 0.15 mm and h = 0.3 um, 0.08^0.58."""
    flooded = 3.06 * 0.08**0.58

    def share(m):
        return starved_share(m * 0.15e-3, 0.15e-3, 6e-3, 0.3e-6)

    assert share(1.0 + flooded) == pytest.approx(1.0) == share(10.0)
    assert share(1.0 + 0.1 * flooded) == pytest.approx(0.1**0.29)
    assert share(1.0) == 0.0 == share(0.5)
