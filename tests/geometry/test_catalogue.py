"""Ratings against ISO 281's own table and against catalogues."""

import pytest

from flexcage.geometry.catalogue import dynamic_rating, geometry_factor, static_rating
from flexcage.geometry.presets import load_preset, preset_names

# ISO 281:2007, factor f_c of radial roller bearings against Dwe cos(alpha)/Dpw
ISO_281_FC = {
    0.01: 52.1,
    0.02: 60.8,
    0.03: 66.5,
    0.04: 70.7,
    0.05: 74.1,
    0.06: 76.9,
    0.07: 79.2,
    0.08: 81.2,
    0.09: 82.8,
    0.10: 84.2,
    0.12: 86.4,
    0.14: 87.7,
    0.16: 88.5,
    0.18: 88.8,
    0.20: 88.7,
    0.22: 88.2,
    0.24: 87.5,
    0.26: 86.4,
    0.28: 85.2,
    0.30: 83.8,
}


@pytest.mark.parametrize("gamma", ISO_281_FC)
def test_geometry_factor_is_that_of_the_standard(gamma):
    assert geometry_factor(gamma) == pytest.approx(ISO_281_FC[gamma], abs=0.05)


def test_geometry_factor_of_the_n1013():
    assert geometry_factor(8.0 / 82.5) == pytest.approx(83.8, abs=0.05)


@pytest.mark.parametrize("name", preset_names())
def test_presets_have_the_ratings_of_the_catalogue(name):
    preset = load_preset(name)
    assert static_rating(preset.bearing) == pytest.approx(preset.static_rating, rel=0.01)
    assert dynamic_rating(preset.bearing) == pytest.approx(preset.dynamic_rating, rel=0.01)


def test_n1013_is_within_one_per_cent_of_51_and_41_kn():
    bearing = load_preset("N1013").bearing
    assert static_rating(bearing) == pytest.approx(51.0e3, rel=0.01)
    assert dynamic_rating(bearing) == pytest.approx(41.0e3, rel=0.01)
