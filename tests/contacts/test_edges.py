"""How far an element sinks into a spall: the mean over the contact's width, and its slope."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import quad

from flexcage.contacts.uneven import spall_depth, spread
from flexcage.core.jit import kernel

MIDDLE, RADIUS, EFFECTIVE = 0.4, 40e-3, 4e-3  # rad, m, m
BEND = RADIUS**2 / (2.0 * EFFECTIVE)


@kernel
def sunk(spall, phi, out):
    out[0], out[1] = spall_depth(spall, phi)


def found(spall, phi):
    out = np.zeros(2)
    sunk(spall, phi, out)
    return out


def at_a_line(spall, phi):
    """(l - x)^2/(2 R) beside an edge, up to the depth."""
    half, middle, depth, bend, _ = spall
    return min(bend * max(half - abs(phi - middle), 0.0) ** 2, depth)


@pytest.mark.parametrize("length", [0.06e-3, 0.3e-3, 1.2e-3])
@pytest.mark.parametrize("depth", [3e-6, 200e-6])
def test_an_edge_is_felt_over_the_width_of_the_contact(length, depth):
    felt = 70e-6 / RADIUS
    spall = np.array([0.5 * length / RADIUS, MIDDLE, depth, BEND, felt])
    reach = spall[0] + felt
    for off in np.linspace(-1.1 * reach, 1.1 * reach, 41):
        phi, corners = MIDDLE + off, MIDDLE + np.array([-spall[0], 0.0, spall[0]])
        wall = min(np.sqrt(depth / BEND), spall[0])
        corners = np.concatenate([corners, MIDDLE + (spall[0] - wall) * np.array([-1.0, 1.0])])
        mean = quad(lambda x: at_a_line(spall, x), phi - felt, phi + felt, points=corners,
                    epsabs=1e-20, epsrel=1e-10)[0] / (2.0 * felt)  # fmt: skip
        value, slope = found(spall, phi)
        assert value == pytest.approx(mean, rel=1e-8, abs=1e-16)
        h = 1e-7
        difference = (found(spall, phi + h)[0] - found(spall, phi - h)[0]) / (2.0 * h)
        assert slope == pytest.approx(difference, rel=1e-4, abs=1e-8)
        assert found(spall, phi + 2.0 * np.pi)[0] == pytest.approx(value, rel=1e-9, abs=1e-18)


def test_the_slope_has_no_jump():
    """Neither at the edges, nor in the middle, nor where the element reaches the bottom: the force
    along the race is this slope times the load."""
    for depth in (3e-6, 200e-6):
        spall = np.array([0.25e-3 / RADIUS, MIDDLE, depth, BEND, 70e-6 / RADIUS])
        slope = [found(spall, phi)[1] for phi in MIDDLE + np.linspace(-0.012, 0.012, 20001)]
        assert np.abs(np.diff(slope)).max() < 2e-3 * np.ptp(slope)


def test_the_width_is_that_of_a_contact_at_1_gpa():
    """Half width 4 p R/E' of a line contact under its largest pressure p (Johnson 4.43, 4.45)."""
    modulus, pressure = 206e9 / (1.0 - 0.3**2), 1e9
    load = np.pi * EFFECTIVE * pressure**2 / (0.5 * modulus)  # N/m
    half = np.sqrt(4.0 * load * EFFECTIVE / (np.pi * 0.5 * modulus))
    assert spread(EFFECTIVE, modulus) == pytest.approx(half, rel=1e-12)
