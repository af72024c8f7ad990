"""Stress and strain at a notch beyond yield by Neuber's rule, its modified form, and lives.

Ranges of a cycle: dS nominal, dsigma and depsilon local. Neuber (H. Neuber, J. Appl. Mech. 28
(1961) 544) has dsigma depsilon = K^2 dS^2/E, with K the elastic factor K_t = dsigma/dS; the
modified rule puts a factor K_f in its place that falls as dS nears the tensile strength. The loop
of a material after Masing is depsilon = dsigma/E + 2 (dsigma/(2 K'))^(1/n') (W. Ramberg and W. R.
Osgood, NACA TN 902, 1943). Lives are reversals to a crack by Coffin, Manson and Basquin, with the
mean stress by K. N. Smith, P. Watson and T. H. Topper (J. Materials 5 (1970) 767), or by
J. Morrow (Fatigue Design Handbook, SAE, 1968).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, isfinite

from scipy.optimize import brentq

from flexcage.core.errors import InputError

_LIVES = (1.0, 1e14)  # reversals that are looked at
#: Two readings of a modified Neuber factor that is K_t at small loads and 1 at the strength.
READINGS: Mapping[str, str] = {
    "power": "K_t^(1 - dS/R_m)",
    "linear": "1 + (K_t - 1)(1 - dS/R_m)",
}
MEAN_STRESS = ("swt", "morrow")


@dataclass(frozen=True, kw_only=True)
class CyclicSteel:
    """A metal under cycles [Pa]: ``strength`` R_m, ``hardening`` K', ``exponent`` n', and its
    strain-life curve sigma_f', b, epsilon_f', c."""

    name: str
    modulus: float
    strength: float
    hardening: float
    exponent: float
    fatigue_strength: float
    b: float
    fatigue_ductility: float
    c: float
    source: str

    @property
    def cyclic_yield(self) -> float:
        """Amplitude of stress [Pa] with a plastic strain of 0.2 %."""
        return float(self.hardening * 0.002**self.exponent)

    def strain_range(self, stress: float) -> float:
        """Range of strain of a loop with this range of stress [Pa]."""
        plastic = 2.0 * (0.5 * stress / self.hardening) ** (1.0 / self.exponent)
        return float(stress / self.modulus + plastic)

    def strain_amplitude(self, reversals: float) -> float:
        """Amplitude of strain that makes a crack after so many reversals, mean stress zero."""
        elastic = self.fatigue_strength / self.modulus * reversals**self.b
        return float(elastic + self.fatigue_ductility * reversals**self.c)


def uniform_law(strength: float, modulus: float = 206e9) -> CyclicSteel:
    """An unalloyed steel of this tensile strength [Pa] by the uniform material law."""
    if not 200e6 <= strength <= 2500e6:
        raise InputError(
            f"The tensile strength is {strength / 1e6:g} MPa, but the uniform material law is of "
            "steels from 200 to 2500 MPa.", where="strength", value=strength,
        )  # fmt: skip
    psi = min(1.0, 1.375 - 125.0 * strength / modulus)
    return CyclicSteel(
        name=f"steel of {strength / 1e6:g} MPa by the uniform material law", modulus=modulus,
        strength=strength, hardening=1.65 * strength, exponent=0.15,
        fatigue_strength=1.5 * strength, b=-0.087, fatigue_ductility=0.59 * psi, c=-0.58,
        source="A. Baeumel and T. Seeger, Materials Data for Cyclic Loading, Suppl. 1, Elsevier, "
        "1990",
    )  # fmt: skip


_KSI = 6.894757e6
#: Soft steels of about 0.15 % carbon, as ML15 is: a range, not the cage's own values.
SOFT_STEELS: tuple[CyclicSteel, ...] = (
    CyclicSteel(
        name="SAE 1015, normalized, 80 HB", modulus=30e3 * _KSI, strength=60.0 * _KSI,
        hardening=137.0 * _KSI, exponent=0.22, fatigue_strength=120.0 * _KSI, b=-0.11,
        fatigue_ductility=0.95, c=-0.64,
        source="MIT 2.002 Mechanics and Materials II, example problem of 28 April 2004 (steels of "
        "SAE J1099)",
    ),
    uniform_law(375e6),
    uniform_law(500e6),
)  # fmt: skip


def notch_factor(K_t: float, nominal: float, strength: float, reading: str = "power") -> float:
    """K_f at a nominal range [Pa] and a tensile strength [Pa], by a reading of ``READINGS``."""
    if reading not in READINGS:
        raise InputError(
            f"There is no reading '{reading}'; choose from {', '.join(READINGS)}.",
            where="reading", value=reading,
        )  # fmt: skip
    if not 0.0 <= nominal <= strength:
        raise InputError(
            f"The nominal range is {nominal / 1e6:.4g} MPa, but the modified Neuber rule is of 0 "
            f"to the tensile strength, {strength / 1e6:.4g} MPa.", where="nominal", value=nominal,
        )  # fmt: skip
    _positive(K_t, "K_t")
    left = 1.0 - nominal / strength
    return float(K_t**left if reading == "power" else 1.0 + (K_t - 1.0) * left)


def neuber(nominal: float, factor: float, steel: CyclicSteel) -> tuple[float, float]:
    """Local ranges of stress [Pa] and strain of a nominal range [Pa] at a notch of that factor."""
    _positive(factor, "factor")
    if nominal == 0.0:
        return 0.0, 0.0
    elastic = factor * abs(nominal)
    energy = elastic**2 / steel.modulus
    stress = brentq(
        lambda s: s * steel.strain_range(s) - energy, 0.0, elastic * (1.0 + 1e-9), xtol=1e-6
    )
    return float(stress), steel.strain_range(float(stress))


def reversals(
    stress: float, strain: float, steel: CyclicSteel, *, highest: float | None = None,
    mean_stress: str = "swt",
) -> float:  # fmt: skip
    """Reversals to a crack of a cycle with these ranges of stress [Pa] and strain, whose highest
    stress [Pa] is half the range if not given; infinite beyond 1e14, and, by Smith, Watson and
    Topper, of a cycle without tension."""
    if mean_stress not in MEAN_STRESS:
        raise InputError(
            f"There is no mean stress correction '{mean_stress}'; choose from "
            f"{', '.join(MEAN_STRESS)}.", where="mean_stress", value=mean_stress,
        )  # fmt: skip
    top = 0.5 * stress if highest is None else highest
    if mean_stress == "swt":
        if top <= 0.0:
            return inf
        wanted = top * 0.5 * strain

        def excess(n: float) -> float:
            return steel.fatigue_strength * n**steel.b * steel.strain_amplitude(n) - wanted
    else:
        mean = top - 0.5 * stress

        def excess(n: float) -> float:
            elastic = (steel.fatigue_strength - mean) / steel.modulus * n**steel.b
            return elastic + steel.fatigue_ductility * n**steel.c - 0.5 * strain

    low, high = _LIVES
    if excess(high) >= 0.0:
        return inf
    if excess(low) <= 0.0:
        return low
    return float(brentq(excess, low, high, rtol=1e-10))


@dataclass(frozen=True, eq=False)
class NotchLife:
    """A notch of a joint or a cage under one cycle, by one steel and one reading."""

    steel: CyclicSteel
    reading: str
    nominal: float  # range [Pa]
    K_t: float
    K_f: float
    stress: float  # local ranges [Pa], -
    strain: float
    highest: float  # local stress [Pa]
    swt: float  # reversals
    morrow: float

    @property
    def elastic(self) -> bool:
        """Whether the cycle stays within the cyclic yield stress."""
        return 0.5 * self.stress < self.steel.cyclic_yield

    def __str__(self) -> str:
        lives = (
            f"{n / 2.0:.3g} cycles" if isfinite(n) else "no crack" for n in (self.swt, self.morrow)
        )
        state = "elastic" if self.elastic else "beyond yield"
        return (
            f"{self.steel.name}, {self.reading}: dS {self.nominal / 1e6:.3g} MPa, K_t "
            f"{self.K_t:.3g}, K_f {self.K_f:.3g}, local range {self.stress / 1e6:.4g} MPa "
            f"({state}), up to {self.highest / 1e6:.4g} MPa; SWT {next(lives)}, "
            f"Morrow {next(lives)}"
        )


def notch_life(
    nominal: float, K_t: float, steel: CyclicSteel, *, elastic_highest: float,
    reading: str = "power",
) -> NotchLife:  # fmt: skip
    """Ranges and lives at a notch of K_t = dsigma/dS under a nominal range dS [Pa].

    ``elastic_highest`` [Pa] is the highest stress of the cycle by linear elasticity, clamping and
    fits included; beyond yield the cycle's highest stress follows the first loading by Neuber's
    rule.
    """
    K_f = notch_factor(K_t, nominal, steel.strength, reading)
    stress, strain = neuber(nominal, K_f, steel)
    highest = elastic_highest
    if elastic_highest > 0.0:  # the first loading follows the curve of amplitudes
        highest = 0.5 * neuber(2.0 * elastic_highest, 1.0, steel)[0]
    lives = {
        way: reversals(stress, strain, steel, highest=highest, mean_stress=way)
        for way in MEAN_STRESS
    }  # fmt: skip
    return NotchLife(
        steel, reading, nominal, K_t, K_f, stress, strain, highest, lives["swt"], lives["morrow"]
    )  # fmt: skip


def _positive(value: float, name: str) -> None:
    if not (value > 0.0 and isfinite(value)):
        raise InputError(
            f"{name} is {value:g}, but must be greater than 0.", where=name, value=value
        )
