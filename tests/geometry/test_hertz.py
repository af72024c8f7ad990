"""Elliptical contact against its limits, and against displacements integrated from its pressure."""

from math import pi

import numpy as np
import pytest

from flexcage.geometry.hertz import PointContact, axis_ratio, load_at_pressure, series_stiffness

E = 2.2857e11  # Pa, E' of steel on steel


def test_sphere_on_a_plane():
    """Hertz: a = (3 Q R/(4 E*))^(1/3), approach a^2/R, pressure 3 Q/(2 pi a^2)."""
    radius, load, star = 5e-3, 120.0, 0.5 * E
    contact = PointContact(radius, radius, E)
    a = (0.75 * load * radius / star) ** (1.0 / 3.0)
    assert contact.ratio == 1.0
    assert contact.semi_axes(load) == pytest.approx((a, a), rel=1e-12)
    approach = (load / contact.stiffness) ** (2.0 / 3.0)
    assert approach == pytest.approx(a**2 / radius, rel=1e-12)
    assert contact.pressure(load) == pytest.approx(1.5 * load / (pi * a**2), rel=1e-12)
    assert contact.stiffness == pytest.approx(4.0 / 3.0 * star * np.sqrt(radius), rel=1e-12)


def test_nearly_round_ellipses_join_the_circle():
    """kappa ~ (radii)^(2/3) near 1 (Johnson 4.33), without loss of digits."""
    for eps in (1e-3, 1e-6, 1e-9):
        assert axis_ratio(1.0 + eps) - 1.0 == pytest.approx(2.0 / 3.0 * eps, rel=2e-3)


def test_a_long_ellipse_is_a_line_in_its_middle():
    """b = 2 p R/E* of a cylinder on a plane, with the pressure in the ellipse's middle."""
    contact = PointContact(4e-3, 4e3, E)
    load = 1e4
    _, b = contact.semi_axes(load)
    assert b == pytest.approx(2.0 * contact.pressure(load) * 4e-3 / (0.5 * E), rel=1e-4)


@pytest.mark.parametrize("radii", [1.5, 20.0])
def test_displacements_under_its_pressure_fit_both_bodies(radii):
    """Boussinesq's displacement under the ellipsoidal pressure is delta - x^2/2 r_x - y^2/2 r_y.

    In polar coordinates about the point of displacement the kernel's 1/r cancels.
    """
    rolling, load = 4e-3, 200.0
    contact = PointContact(rolling, radii * rolling, E)
    a, b = (float(x) for x in contact.semi_axes(load))
    peak = float(contact.pressure(load))

    def displacement(x: float, y: float) -> float:
        """x along a; the pressure's square is a quadratic in r, so its integral is closed."""
        angle = (np.arange(4000) + 0.5) * pi / 2000
        c, s = np.cos(angle), np.sin(angle)
        A = c**2 / a**2 + s**2 / b**2
        B = x * c / a**2 + y * s / b**2
        C = 1.0 - x**2 / a**2 - y**2 / b**2
        root = np.sqrt(A * C + B**2)
        # integral of sqrt(C - 2 B r - A r^2) from 0 to its zero
        along = 0.5 * (
            (A * C + B**2) / A**1.5 * (pi / 2 - np.arcsin(B / root)) - B * np.sqrt(C) / A
        )
        return peak * 2.0 / (pi * E) * float(along.mean() * 2.0 * pi)

    delta = (load / contact.stiffness) ** (2.0 / 3.0)
    for x, y in ((0.0, 0.0), (0.6 * a, 0.0), (0.0, 0.7 * b), (0.4 * a, -0.5 * b)):
        gap = x**2 / (2.0 * radii * rolling) + y**2 / (2.0 * rolling)
        assert displacement(x, y) == pytest.approx(delta - gap, rel=1e-6)


def test_axes_follow_the_longer_radius():
    long, short = PointContact(1e-3, 5e-3, E).semi_axes(10.0)
    assert PointContact(5e-3, 1e-3, E).semi_axes(10.0) == pytest.approx((short, long))
    assert long > short


def test_pressure_and_load_are_inverse():
    contact = PointContact(4e-3, 8e-2, E)
    assert contact.pressure(load_at_pressure(contact, 4.2e9)) == pytest.approx(4.2e9, rel=1e-12)
    assert contact.pressure(np.zeros(2)).tolist() == [0.0, 0.0]


def test_two_contacts_in_turn():
    """Approaches add under one load."""
    one, other, load = 3e10, 2e10, 50.0
    both = (load / series_stiffness(one, other)) ** (2 / 3)
    assert both == pytest.approx((load / one) ** (2 / 3) + (load / other) ** (2 / 3), rel=1e-12)
