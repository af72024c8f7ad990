"""The short-bearing film of a cage land.

Radial and tangential force at four eccentricities (20 mPa s, land 3 mm wide, 0.1 mm of clearance, 5
m/s), and wedge, squeeze and drag against quadrature of the pressure. The squeeze is the full
film's; a film that bears no tension would give the printed share of it.

Source: short bearing of F. W. Ocvirk, NACA TN 2808 (1952), half-Sommerfeld, as used for cage lands
by Gupta and by Ghaisas; table from an independent program; pressure integrated here.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pytest
from known_rows import check
from scipy.integrate import quad

from flexcage.contacts import laws
from flexcage.verification import Row, Tolerance

ETA, LENGTH, CLEARANCE, RADIUS = 0.02, 3e-3, 1e-4, 0.05
SURFACE = 5.0  # m/s, sum of both surfaces' speeds
SUM, DIFFERENCE = SURFACE / RADIUS, 20.0  # rad/s
SQUEEZE = 0.03  # m/s
# eccentricity ratio: radial and tangential force [N]
TABLE = {
    0.1: (-0.002755, 0.021528), 0.3: (-0.029344, 0.073285), 0.5: (-0.12, 0.163242),
    0.8: (-1.33333, 0.785398),
}  # fmt: skip
# share of the full film's squeeze force that its half under pressure alone gives
HALF_FILM = {0.1: 0.625, 0.3: 0.829, 0.5: 0.942, 0.8: 0.996}
DIGITS = Tolerance(5.1e-4, "printed to three digits", absolute=True)
PRINTED = Tolerance(2e-4, "printed to 1e-6 N, of 0.003 N and more")
QUADRATURE = Tolerance(1e-8, "quadrature of the pressure to 1e-8")


def film(
    eps: float, *, direction: float = 0.0, rate: tuple[float, float] = (0.0, 0.0)
) -> tuple[float, float, float]:
    """Both components of the force [N] and the moment [N m] at an eccentricity ratio.

    ``direction`` [rad] is that of the eccentricity and ``rate`` [m/s] its rate, both components.
    """
    e = eps * CLEARANCE
    eccentricity = e * np.cos(direction), e * np.sin(direction)
    oil = laws.LandFilm(ETA, LENGTH, RADIUS, CLEARANCE)
    return laws.short_bearing(oil, eccentricity, rate, SUM, DIFFERENCE)


def load_per_angle(angle: float, eps: float, wedge: float, squeeze: float) -> float:
    """Ocvirk's pressure -(L^2/4 - z^2)/(2 h^3) [6 eta U h'/R + 12 eta dh/dt], summed over z and
    times R; the angle runs from the widest gap."""
    h = CLEARANCE * (1.0 + eps * np.cos(angle))
    slope = -CLEARANCE * eps * np.sin(angle) / RADIUS
    push = 6.0 * ETA * wedge * slope + 12.0 * ETA * squeeze * np.cos(angle)
    return -(LENGTH**3) / (12.0 * h**3) * push * RADIUS


def table_rows() -> Iterator[Row]:
    for eps, forces in TABLE.items():
        for name, expected, value in zip(("radial", "tangential"), forces, film(eps)):
            yield Row(f"{name} force at {eps} C", "N", expected, value, PRINTED)


def quadrature_rows(eps: float) -> Iterator[Row]:
    found = film(eps)
    precise = {"epsabs": 0.0, "epsrel": 1e-10, "limit": 200}
    radial = quad(lambda a: load_per_angle(a, eps, SURFACE, 0.0) * np.cos(a), 0, np.pi, **precise)
    across = quad(lambda a: load_per_angle(a, eps, SURFACE, 0.0) * np.sin(a), 0, np.pi, **precise)
    yield Row(f"radial force, integrated, at {eps} C", "N", -abs(radial[0]), found[0], QUADRATURE)
    yield Row(f"tangential, integrated, at {eps} C", "N", abs(across[0]), found[1], QUADRATURE)
    whole = quad(
        lambda a: load_per_angle(a, eps, 0.0, SQUEEZE) * np.cos(a), 0, 2 * np.pi, **precise
    )
    squeezed = film(eps, rate=(SQUEEZE, 0.0))[0] - found[0]
    yield Row(f"squeeze at 30 mm/s, integrated, at {eps} C", "N", whole[0], squeezed, QUADRATURE)
    half = quad(
        lambda a: load_per_angle(a, eps, 0.0, SQUEEZE) * np.cos(a), 0.5 * np.pi, 1.5 * np.pi,
        **precise,
    )  # fmt: skip
    share = float(half[0] / squeezed)
    name = f"squeeze of the half under pressure over the film's, at {eps} C"
    yield Row(name, "", HALF_FILM[eps], share, DIGITS)
    drag = quad(lambda a: 1.0 / (1.0 + eps * np.cos(a)), 0, 2 * np.pi, **precise)[0]
    moment = ETA * DIFFERENCE * RADIUS**3 * LENGTH / CLEARANCE * drag
    yield Row(f"moment, integrated, at {eps} C", "N mm", 1e3 * moment, 1e3 * found[2], QUADRATURE)


def test_forces_of_the_table():
    check(table_rows())


@pytest.mark.parametrize("eps", TABLE)
def test_wedge_squeeze_and_drag_by_quadrature(eps):
    check(quadrature_rows(eps))


def test_land_film_whirling_at_half_speed_carries_nothing():
    eps, whirl = 0.4, 50.0  # half of the sum of speeds
    out = film(eps, rate=(0.0, whirl * eps * 1e-4))
    np.testing.assert_allclose(out[:2], 0.0, atol=1e-12)
    faster = film(eps, rate=(0.0, 2 * whirl * eps * 1e-4))
    assert faster[1] == pytest.approx(-film(eps)[1])  # damps a whirl above half speed
    assert faster[0] == pytest.approx(film(eps)[0])


def test_land_film_turns_with_its_eccentricity():
    still = film(0.5, rate=(0.01, -0.02))
    c, s = np.cos(0.7), np.sin(0.7)
    turned = film(0.5, direction=0.7, rate=(0.01 * c + 0.02 * s, 0.01 * s - 0.02 * c))
    np.testing.assert_allclose(
        turned, [c * still[0] - s * still[1], s * still[0] + c * still[1], still[2]], rtol=1e-12
    )
