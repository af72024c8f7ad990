"""S-N curves of cage materials with their sources, and a place for a user's own.

A curve is a straight line in log S and log N at R = -1, without an endurance limit: N = cycles
(amplitude/S)^slope. What its source does not give is called an assumption. A material without a
published curve has none here.
"""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.core.binding import check_spec
from flexcage.core.errors import InputError
from flexcage.core.registry import add_sourced
from flexcage.core.spec import option, quantity
from flexcage.core.units import describe

_LEAST = 1e5  # Pa, below any solid's strength: megapascals that were given as pascals


@dataclass(frozen=True, kw_only=True)
class SNCurve:
    """Stress amplitude that a material endures for ``cycles`` at R = -1, and its slope."""

    material: str = option(doc="name of the material")
    amplitude: float = quantity("MPa", doc="stress amplitude endured at R = -1", minimum=_LEAST)
    cycles: float = option(doc="cycles for which it is endured", minimum=1.0)
    slope: float = option(doc="k of N = cycles (amplitude/S)^k", minimum=1.0)
    tensile_strength: float = quantity("MPa", doc="tensile strength", minimum=_LEAST)
    mean_stress: float | None = option(
        None, doc="mean stress sensitivity M; by default Goodman's", minimum=0.0
    )
    survival: float = option(0.5, doc="probability of survival", minimum=0.0, maximum=1.0)
    source: str = option("", doc="where the values come from")
    assumption: str = option("", doc="what no source gives")

    @property
    def mean_stress_sensitivity(self) -> float:
        """M between R = -inf and 0: as given, or that of Goodman's line, amplitude over tensile
        strength."""
        if self.mean_stress is not None:
            return self.mean_stress
        return self.amplitude / self.tensile_strength


#: By the name of the cage's material.
SN_CURVES: dict[str, SNCurve] = {
    curve.material: curve
    for curve in (
        SNCurve(
            material="brass",
            amplitude=370e6 / 3.0,
            cycles=1e8,
            slope=11.6,
            tensile_strength=370e6,
            source="tensile strength of CuZn39Pb3 (UNS C38500), hot rolled: makeitfrom.com",
            assumption="a third of the tensile strength at 1e8 cycles, a rule of thumb of copper "
            "alloys (measured: 138 MPa at 1e8 cycles for half-hard rod of UNS C36000, tensile "
            "strength 395 MPa, Copper Development Association's data by AZoM); slope of the line "
            "from there to 0.9 of the tensile strength at 1e3 cycles",
        ),
        SNCurve(
            material="PA66",
            amplitude=35.0e6,
            cycles=1e7,
            slope=29.6,
            tensile_strength=82.7e6,
            source="least squares through ASTM D671 at 30 Hz, unfilled nylon 6/6, 1e4 to 1e7 "
            "cycles: 6500, 5900, 5300, 5200 psi (Plasco, Fatigue endurance of reinforced "
            "thermoplastics); Toray's Amilan data give 35 MPa dry, 21 MPa with 2.5 % of water; "
            "tensile strength: Quadrant Nylon 101 (ASTM D638)",
            assumption="dry, room temperature, no heating by its own hysteresis; Goodman's line",
        ),
        SNCurve(
            material="steel",
            amplitude=0.45 * 270e6,
            cycles=1e6,
            slope=5.0,
            tensile_strength=270e6,
            mean_stress=0.0,  # 0.35e-3 Rm/MPa - 0.1 < 0
            survival=0.975,
            source="FKM guideline, Analytical strength assessment (2012): 0.45 of the tensile "
            "strength at 1e6 cycles, slope 5, M = 0.35e-3 Rm/MPa - 0.1 and not below 0; least "
            "tensile strength of annealed DC04: EN 10139",
            assumption="as annealed: what pressing hardens is left out; no endurance limit",
        ),
    )
}


def check_curve(curve: SNCurve, where: str) -> None:
    """Raise InputError for values out of their bounds, or that contradict each other."""
    check_spec(curve, where)
    if curve.mean_stress is None and curve.amplitude > curve.tensile_strength:
        raise InputError(
            f"{where}.tensile_strength is {describe(curve.tensile_strength, 'MPa')}, less than the "
            f"amplitude of {describe(curve.amplitude, 'MPa')}, so that Goodman's line says nothing "
            "of mean stress; give mean_stress as well, or correct one of them.",
            where=f"{where}.tensile_strength",
            value=curve.tensile_strength,
        )


def register_sn_curve(curve: SNCurve) -> SNCurve:
    """Add a material's curve: runs and studies with that material then use it; returns it.

    SI units. Raises InputError for a material that has one, a value out of its bounds, or a curve
    without its ``source``.
    """
    check_curve(curve, "sn_curve")
    lacking = f"The S-N curve of '{curve.material}' has no source; say where its values come from."
    return add_sourced(
        SN_CURVES, curve.material, curve, what="S-N curve", where="sn_curve", unsourced=lacking
    )


def of_other(material: str, cage: str) -> list[str]:
    """A line for results whose values are of another material than the cage; none if of the
    same."""
    same = not cage or material == cage
    return [] if same else [f"the values are of {material}, and the cage is of {cage}"]


def sn_curve(material: str) -> SNCurve:
    """The curve of a material; InputError where none is known."""
    if material in SN_CURVES:
        return SN_CURVES[material]
    raise InputError(
        f"No published S-N curve of {material} is known here (there are {', '.join(SN_CURVES)}); "
        "give your own, run.fatigue(curve=flexcage.spec.SNCurve(...)), or register it with "
        "flexcage.register.sn_curve.",
        where="curve",
        value=material,
    )
