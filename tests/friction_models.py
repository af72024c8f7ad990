"""Frictional torque of bearings as catalogues have it: two published models, in N mm.

Loads in N, dimensions in mm, speed n in 1/min, kinematic viscosity nu in mm^2/s. Both are fits to
measurements of whole bearings. Their constants are quoted from memory of the books named; the forms
of SKF's were compared with the catalogue's page.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import exp, radians, sin, sqrt, tan


@dataclass(frozen=True)
class Size:
    """Bore, outside diameter and their mean."""

    d: float
    D: float

    @property
    def mean(self) -> float:
        return 0.5 * (self.d + self.D)


def skf(
    size: Size, rolling: float, sliding: float, *, n: float, nu: float, kz: float, smooth: float
) -> tuple[float, float]:
    """M_rr and M_sl of SKF's model (Rolling bearings, catalogue 10000 EN, friction) from the loads'
    variables G_rr and G_sl, for an oil bath of low level: inlet shear heating, replenishment, and
    the sliding friction between 0.12 (boundary) and ``smooth`` (full film). Without drag and
    seals."""
    heating = 1.0 / (1.0 + 1.84e-9 * (n * size.mean) ** 1.28 * nu**0.64)
    kept = exp(-3e-8 * nu * n * (size.d + size.D) * sqrt(kz / (2.0 * (size.D - size.d))))
    boundary = exp(-2.6e-8 * (n * nu) ** 1.4 * size.mean)
    friction = boundary * 0.12 + (1.0 - boundary) * smooth
    return heating * kept * rolling * (nu * n) ** 0.6, friction * sliding


def skf_deep_groove_62(
    size: Size, radial: float, axial: float, static: float, *, n: float, nu: float
) -> tuple[float, float]:
    """Series 62: R1 = 3.9e-7, R2 = 1.7, S1 = 3.23e-3, S2 = 36.5."""
    dm = size.mean
    if axial == 0.0:
        rolling = 3.9e-7 * dm**1.96 * radial**0.54
        sliding = 3.23e-3 * dm**-0.26 * radial ** (5.0 / 3.0)
    else:
        angle = sin(radians(24.6 * (axial / static) ** 0.24))
        rolling = 3.9e-7 * dm**1.96 * (radial + 1.7 / angle * axial) ** 0.54
        sliding = 3.23e-3 * dm**-0.145 * (
            radial**5 + 36.5 * dm**1.5 / angle * axial**4) ** (1.0 / 3.0)  # fmt: skip
    return skf(size, rolling, sliding, n=n, nu=nu, kz=3.1, smooth=0.05)


def skf_cylindrical_2(
    size: Size, radial: float, axial: float, *, n: float, nu: float
) -> tuple[float, float]:
    """Series 2 with a cage: R1 = 1.09e-6, S1 = 0.16, S2 = 0.0015."""
    dm = size.mean
    rolling = 1.09e-6 * dm**2.41 * radial**0.31
    sliding = 0.16 * dm**0.9 * axial + 0.0015 * dm * radial
    return skf(size, rolling, sliding, n=n, nu=nu, kz=5.1, smooth=0.02)


def palmgren(
    size: Size, load: float, *, f0: float, f1: float, n: float, nu: float
) -> tuple[float, float]:
    """M_0 of the oil and M_1 of the load (A. Palmgren; T. A. Harris, Rolling Bearing Analysis)."""
    dm = size.mean
    return 1e-7 * f0 * (nu * n) ** (2.0 / 3.0) * dm**3, f1 * load * dm


def palmgren_angular(
    size: Size, radial: float, axial: float, static: float, *, angle: float, n: float, nu: float
) -> tuple[float, float]:
    """Angular contact balls in an oil bath: f0 = 2, f1 = 0.001 (P/C0)^0.33, P = 0.9 Fa cot a - 0.1
    Fr; in oil mist f0 = 1."""
    load = max(0.9 * axial / tan(angle) - 0.1 * radial, radial)
    f1 = 0.001 * (load / static) ** 0.33
    return palmgren(size, load, f0=2.0, f1=f1, n=n, nu=nu)
