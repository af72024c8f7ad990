"""Young's modulus of a cage over its temperature, with sources.

A curve gives ratios to the modulus at room temperature, 23 degrees C. Between its points the
logarithm of the modulus is linear in temperature, which is an assumption. A material without a
curve here has none: nothing is guessed for it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.registry import add_sourced
from flexcage.core.spec import option, quantity
from flexcage.core.units import describe
from flexcage.geometry.materials import Material

ROOM = 296.15  # K


@dataclass(frozen=True, kw_only=True)
class ModulusCurve:
    """Modulus of a material over temperature, as ratios to that at room temperature."""

    material: str = option(doc="name of the material")
    temperatures: tuple[float, ...] = quantity("degC", doc="rising temperatures", above=0.0)
    ratios: tuple[float, ...] = option(doc="modulus over that at 23 degC", minimum=1e-6)
    service: float = quantity("degC", doc="temperature up to which cages are used", above=0.0)
    polymer: bool = option(True, doc="does its loss factor rise as its modulus falls?")
    source: str = option("", doc="where the values come from")

    def at(self, temperature: float) -> float:
        """Modulus at a temperature [K] over that at room temperature.

        Raises InputError outside the curve.
        """
        least, greatest = self.temperatures[0], self.temperatures[-1]
        if not least <= temperature <= greatest:
            raise InputError(
                f"cage.temperature is {describe(temperature, 'degC')}, but the modulus of "
                f"{self.material} is known from {describe(least, 'degC')} to "
                f"{describe(greatest, 'degC')}.",
                where="cage.temperature",
                value=temperature,
            )
        logs = np.interp(temperature, self.temperatures, np.log(self.ratios))
        return float(np.exp(logs))


def material_at(material: Material, temperature: float | None) -> Material:
    """A cage's material at a temperature [K]: modulus, and loss factor of a polymer; None: as it
    is given. Density, Poisson's ratio and strength stay.

    The loss factor of a polymer goes with 1/E, as that of its room temperature does
    (``geometry.materials``). Raises InputError for a material without a curve, and outside it.
    """
    if temperature is None:
        return material
    curve = MODULUS_CURVES.get(material.name)
    if curve is None:
        raise InputError(
            f"cage.temperature is {describe(temperature, 'degC')}, but no modulus of "
            f"{material.name} over temperature is known; leave it out, and give "
            "cage.material.youngs_modulus at that temperature.",
            where="cage.temperature",
            value=temperature,
        )
    ratio = curve.at(temperature)
    loss = min(material.loss_factor / ratio, 1.0) if curve.polymer else material.loss_factor
    return replace(material, youngs_modulus=material.youngs_modulus * ratio, loss_factor=loss)


def beyond_service(material: Material, temperature: float | None) -> str:
    """A sentence on a cage that is warmer than such cages are used; empty if it is not."""
    curve = MODULUS_CURVES.get(material.name)
    if temperature is None or curve is None or temperature <= curve.service:
        return ""
    return (
        f"The cage is at {describe(temperature, 'degC')}, where cages of {material.name} are used "
        f"up to {describe(curve.service, 'degC')}: it ages and creeps, which no run follows"
    )


_LIMITS = (
    "greatest temperatures: SKF, Rolling bearings, cage materials (steel 300, brass 250, PA66 in "
    "mild lubricants 120, PA46 15 more, PEEK at high speed 150 degrees C)"
)
_ASSUMED = "an assumption, quoted from memory, as the sheet was not at hand: {}; " + _LIMITS
_ASME = "ASME B31.1-1995, modulus of elasticity of {} over temperature; " + _LIMITS
# assumption: modulus of a fibre-filled polyamide as a power of its matrix's. PA46-GF30 dry and
# conditioned, 10 and 6 GPa at 3.3 and 1.0 GPa of the matrix, has this one
_FIBRES = 0.43
# degrees C, and modulus in any unit, the second at room temperature
_ZYTEL = (
    "flexural modulus of DuPont's Zytel 101 at -40, 23, 77 and 121 degrees C (ASTM D790), which at "
    "23 is that on the sheet of Zytel 103HSL, 2.8 GPa dry and 1.2 conditioned"
)
_STANYL = "tensile modulus of DSM's Stanyl TW341 at 23, 120 and 160 degrees C"
_PA66 = (-40.0, 23.0, 77.0, 121.0)
_PA46 = (-40.0, 23.0, 80.0, 120.0, 160.0)
_METALS = (-73.0, 23.0, 93.0, 149.0, 204.0, 260.0, 316.0)
_MATRICES = {  # dry, conditioned, greatest temperature in service, what it is from
    "PA66": (_PA66, (3.24, 2.83, 0.69, 0.54), (3.45, 1.21, 0.565, 0.415), 120.0, _ZYTEL),
    "PA46": (_PA46, (3.6, 3.3, 1.2, 0.8, 0.65), (3.6, 1.0, 0.75, 0.6, 0.5), 135.0, _STANYL),
}
_GRADES = {  # of the matrix, and the power
    "PA66 A3K": ("PA66", 1.0),
    "PA66-GF25": ("PA66", _FIBRES),
    "PA66-GF30": ("PA66", _FIBRES),
    "PA46": ("PA46", 1.0),
    "PA46-GF25": ("PA46", _FIBRES),
    "PA46-GF30": ("PA46", _FIBRES),
}


def _curve(
    material: str, celsius: tuple[float, ...], moduli: tuple[float, ...], service: float,
    source: str, *, power: float = 1.0, polymer: bool = True,
) -> ModulusCurve:  # fmt: skip
    at_23 = moduli[celsius.index(23.0)]
    return ModulusCurve(
        material=material, temperatures=tuple(round(t + 273.15, 2) for t in celsius),
        ratios=tuple((m / at_23) ** power for m in moduli), service=service + 273.15,
        polymer=polymer, source=source,
    )  # fmt: skip


def _polyamides() -> list[ModulusCurve]:
    curves = []
    for grade, (matrix, power) in {"PA66": ("PA66", 1.0), **_GRADES}.items():
        celsius, *states, service, source = _MATRICES[matrix]
        filled = "" if power == 1.0 else f", to the power {power:g} for glass fibres"
        for state, moduli in zip(("", " conditioned"), states, strict=True):
            if grade == "PA66" and state:
                continue  # no such material
            note = _ASSUMED.format(f"{source}{state}{filled}")
            curves.append(_curve(grade + state, celsius, moduli, service, note, power=power))
    return curves


#: By the name of the cage's material.
MODULUS_CURVES: dict[str, ModulusCurve] = {
    curve.material: curve
    for curve in (
        _curve(
            "steel", _METALS, (30.2, 29.5, 28.8, 28.3, 27.7, 27.3, 26.7), 300.0,
            _ASME.format("carbon steel, C to 0.3 %"), polymer=False,
        ),
        _curve(
            "GCr15", _METALS, (30.0, 29.3, 28.6, 28.1, 27.5, 27.1, 26.5), 300.0,
            _ASME.format("carbon steel, C from 0.3 %"), polymer=False,
        ),
        _curve(
            "brass", _METALS, (15.4, 15.0, 14.6, 14.4, 14.1, 13.8, 13.4), 250.0,
            _ASSUMED.format(
                "naval brass C46400 in ASME B31.3, table C-6 (up to 149 degrees C within 0.7 % of "
                "what ASME B31.1-1995 has of the leaded red brass C83600)"
            ),
            polymer=False,
        ),
        _curve(
            "PEEK", (-40.0, 23.0, 60.0, 90.0, 120.0, 150.0, 160.0, 200.0, 250.0),
            (5.985, 5.7, 5.3, 5.2, 5.1, 4.3, 1.6, 0.68, 0.4), 150.0,
            "LATI, LATIGRAY 88-10-01 CX 30, a PEEK with a mineral filler: tensile modulus at 23, "
            "60, 90, 120 and 150 degrees C (ISO 527); -40 and from 160 on, above the glass "
            f"transition, an assumption of the class of unfilled PEEK; {_LIMITS}",
        ),
        *_polyamides(),
    )
}  # fmt: skip


def register_modulus_curve(curve: ModulusCurve) -> ModulusCurve:
    """Add a material's curve: cages of it may then have a ``temperature``; returns it.

    Temperatures in K, rising, with one ratio each. Raises InputError for a material that has a
    curve, a value out of its bounds, or a curve without its ``source``.
    """
    rising = all(a < b for a, b in zip(curve.temperatures, curve.temperatures[1:], strict=False))
    if not rising or len(curve.temperatures) != len(curve.ratios) or not curve.ratios:
        raise InputError(
            f"The modulus curve of '{curve.material}' has {len(curve.temperatures)} temperatures "
            f"and {len(curve.ratios)} ratios, but needs rising temperatures with a ratio each.",
            where="modulus_curve.temperatures",
        )
    return add_sourced(
        MODULUS_CURVES, curve.material, curve, what="modulus curve", where="modulus_curve",
        unsourced=f"The modulus curve of '{curve.material}' has no source; say where it comes "
        "from.",
    )  # fmt: skip
