"""Materials with their sources. Values are room-temperature, isotropic, linear elastic."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from types import MappingProxyType
from typing import ClassVar

from flexcage.core.registry import add_sourced
from flexcage.core.spec import option, quantity

_OWN = (
    'give its values: {name = "...", youngs_modulus = "... GPa", poisson_ratio = ...,'
    ' density = "... kg/m^3"}'
)
# names of other norms and tongues: what flexcage has, or that it has none
_OTHER_NAMES = MappingProxyType({
    r"((AISI|SAE|ASTM|A) ?)?E?[ -]?52100|100 ?Cr ?6|SUJ ?-?2|1\.3505|EN ?31|ShKh ?15|"
    r"(bearing|chrom(e|ium)).?steel": "'GCr15' is this steel",
    r"(DC|DD|FeP)0?[1-6]\d?|SPC[CDE]|St ?1[234]|(AISI|SAE)? ?10(08|10)|(low|mild).?carbon.*|"
    r"(sheet|strip|mild).?steel": "'steel' is sheet steel of this class",
    r"(G-?|Z)?CuZn.*|H?Pb ?59-?1|CW6\d\d[A-Z]|MS ?58|C3[5-8]\d00|(?!brass$).*brass.*|messing":
    "'brass' is leaded brass, CuZn40Pb",
    r"SiN|(beta.?)?silicon.?nitride|SSN": "'Si3N4' is silicon nitride",
    r"ZrO|zirconi(a|um).*|(3?Y-?)?TZP": "'ZrO2' is zirconia",
    r".*ceramics?": "'Si3N4' and 'ZrO2' are the ceramics of rolling elements",
    r".*bronze.*|CuSn.*|.*alumini?um.*|titan.*|Ti-?6.*|stainless.*|AISI ?(304|316|440).*|X\d+Cr.*|"
    r"POM|PTFE|PPS.*|phenol.*|tufnol|cast.?iron|GG.*|GJS.*": _OWN,
})  # fmt: skip

OILED_ASSEMBLY = 0.01  # assumption: damping ratio of a machined metal part in an oiled assembly


@dataclass(frozen=True, kw_only=True)
class Material:
    """An isotropic linear elastic material."""

    elsewhere: ClassVar[Mapping[str, str]] = _OTHER_NAMES

    name: str = option(doc="name of the material")
    youngs_modulus: float = quantity("GPa", doc="Young's modulus", above=0.0)
    poisson_ratio: float = option(doc="Poisson's ratio", minimum=0.0, maximum=0.499)
    density: float = quantity("kg/m^3", doc="density", above=0.0)
    proof_stress: float = quantity("MPa", float("inf"), doc="0.2 % proof stress", above=0.0)
    source: str = option("", doc="where the values come from")
    loss_factor: float = option(
        0.0, doc="loss factor (tan delta); metals have less than 0.001", minimum=0.0, maximum=1.0,
    )  # fmt: skip
    expansion: float | None = quantity(
        "1/K", None, doc="coefficient of thermal expansion, for fits", above=0.0, hashed=False
    )

    @property
    def modal_damping(self) -> float:
        """Modal damping ratio of a part in an oiled assembly: half of the loss factor, and what
        joints and oil take, which is all there is of a metal's."""
        return OILED_ASSEMBLY + 0.5 * self.loss_factor

    @property
    def plane_strain_modulus(self) -> float:
        """E/(1 - nu^2) [Pa]."""
        return self.youngs_modulus / (1.0 - self.poisson_ratio**2)

    @property
    def compliance(self) -> float:
        """(1 - nu^2)/E [1/Pa]: its part in a contact with another body."""
        return (1.0 - self.poisson_ratio**2) / self.youngs_modulus


def contact_modulus(one: Material, other: Material) -> float:
    """E' of two bodies in contact, 2/((1 - nu_1^2)/E_1 + (1 - nu_2^2)/E_2) [Pa]."""
    return 2.0 / (one.compliance + other.compliance)


# Metals: Cremer and Heckl, Structure-Borne Sound (1988), as the help of SOLIDWORKS tabulates them
# ("Viscous damping ratios"): iron 0.0002 to 0.0006, brass below 0.001. Dry polymers: no measured
# value was found in public; 0.04 GPa over E is a rule after M. F. Ashby's charts.
_LOSS = "an assumption, 0.04 GPa/E after M. F. Ashby, Materials Selection in Mechanical Design"

MATERIALS: dict[str, Material] = {
    m.name: m
    for m in (
        Material(
            name="GCr15",
            youngs_modulus=206e9,
            poisson_ratio=0.3,
            density=7850.0,
            proof_stress=1700e6,
            source="GCr15/SAE 52100 handbook values; hardened proof stress is an assumption",
        ),
        Material(
            name="Si3N4",
            youngs_modulus=310e9,
            poisson_ratio=0.27,
            density=3200.0,
            source="silicon nitride of rolling elements: SKF, Rolling bearings, hybrid bearings "
            "(E, density); Poisson's ratio of hot-pressed Si3N4: Lily Bearing, Ceramic materials "
            "and their properties (E 310 GPa, density 3290 kg/m^3 there)",
        ),
        Material(
            name="ZrO2",
            youngs_modulus=205e9,
            poisson_ratio=0.3,
            density=6040.0,
            source="zirconia with yttria: Lily Bearing, Ceramic materials and their properties (E "
            "200 and 210 GPa in two tables, the middle taken; density); Poisson's ratio is an "
            "assumption",
        ),
        Material(
            name="steel",
            youngs_modulus=206e9,
            poisson_ratio=0.3,
            density=7850.0,
            proof_stress=200e6,
            source="low-carbon strip steel of pressed cages (DC04/SPCC class), handbook E, nu and "
            "density; proof stress is an assumption: annealed strip, which pressing hardens",
        ),
        Material(
            name="brass",
            youngs_modulus=105e9,
            poisson_ratio=0.34,
            density=8500.0,
            proof_stress=160e6,
            source="ZCuZn40Pb/HPb59-1 class; proof stress 120-200 MPa cast, middle taken",
        ),
        Material(
            name="PA66",
            youngs_modulus=2.83e9,
            poisson_ratio=0.4,
            density=1140.0,
            proof_stress=60e6,
            loss_factor=0.014,
            source="Symmetry 2025, 17(10), 1761 (E, nu, rho); proof stress: dry nylon 66 handbook; "
            f"loss factor: {_LOSS}",
        ),
        Material(
            name="PEEK",
            youngs_modulus=3.7e9,
            poisson_ratio=0.4,
            density=1300.0,
            proof_stress=97e6,
            loss_factor=0.011,
            source=f"unfilled PEEK, makers' data sheets (Victrex 450G class); loss factor: {_LOSS}",
        ),
        Material(
            name="polyimide",
            youngs_modulus=2.62e9,
            poisson_ratio=0.34,
            density=1120.0,
            proof_stress=70e6,
            loss_factor=0.015,
            source="7010C cage paper (E, nu, rho); proof stress is an assumption; "
            f"loss factor: {_LOSS}",
        ),
    )
}


# Polyamides of injection-moulded cages by their share of glass fibre, at 23 degrees C, dry as
# moulded and conditioned (equilibrium in air of 50 % humidity): modulus [GPa] and strength [MPa]
# of both, density. Warm, moist polyamide is softer than any of these.
_A3K = "BASF, Ultramid A3K (ISO 527: tensile modulus, yield stress)"
_CLASS = "an assumption, of the class of {}, whose sheet was not at hand: compare your own grade's"
_PA46 = (
    "3300 MPa dry and density: NETZSCH Analyzing and Testing, Properties of polymers, PA46; the "
    "rest " + _CLASS.format("DSM's Stanyl TW341")
)
_BETWEEN = (
    "an assumption: between PA46 and PA46-GF30 as PA66-GF25 is between PA66 A3K and PA66-GF30; "
    "compare your own grade's"
)
_POLYAMIDES = (
    ("PA66 A3K", 0.4, (3.0, 85.0), (1.1, 50.0), 1130.0, _A3K),
    ("PA66-GF25", 0.38, (8.6, 175.0), (6.5, 120.0), 1320.0, _CLASS.format("BASF's Ultramid A3WG5")),
    ("PA66-GF30", 0.37, (10.0, 190.0), (7.2, 130.0), 1360.0, _CLASS.format("Ultramid A3WG6")),
    ("PA46", 0.4, (3.3, 100.0), (1.0, 55.0), 1180.0, _PA46),
    ("PA46-GF25", 0.38, (8.7, 195.0), (5.4, 110.0), 1370.0, _BETWEEN),
    ("PA46-GF30", 0.37, (10.0, 210.0), (6.0, 120.0), 1410.0, _CLASS.format("Stanyl TW200F6")),
)


def _polyamides() -> dict[str, Material]:
    """Two materials of each: as moulded, and "... conditioned"."""
    made = {}
    for grade, poisson, dry, moist, density, source in _POLYAMIDES:
        for state, (modulus, strength) in (("", dry), (" conditioned", moist)):
            made[grade + state] = Material(
                name=grade + state, youngs_modulus=modulus * 1e9, poisson_ratio=poisson,
                density=density, proof_stress=strength * 1e6, loss_factor=round(0.04 / modulus, 4),
                source=f"23 degrees C,{state or ' dry'}: {source}; Poisson's ratio: an assumption; "
                f"loss factor: {_LOSS}",
            )  # fmt: skip
    return made


MATERIALS.update(_polyamides())

#: Coefficients of thermal expansion [1/K] and where they come from, apart from the other sources:
#: only fits read them.
EXPANSIONS: Mapping[str, tuple[float, str]] = MappingProxyType({
    "GCr15": (12e-6, "SKF, Rolling bearings, materials for bearing rings and rolling elements"),
    "steel": (12e-6, "EN 1993-1-1, 3.2.6, structural steel up to 100 degrees C"),
    "Si3N4": (3e-6, "SKF, Rolling bearings, bearing grade silicon nitride"),
    "ZrO2": (10.5e-6, "an assumption, of the class of 3Y-TZP (makers' sheets: 10 to 11e-6 1/K)"),
})  # fmt: skip
for _name, (_expansion, _) in EXPANSIONS.items():
    MATERIALS[_name] = replace(MATERIALS[_name], expansion=_expansion)


def register_material(material: Material) -> Material:
    """Add a material: cases may then give it by its name (``cage.material = "..."``); returns it.

    SI units. Raises InputError for a name that is taken, a value out of its bounds, or a material
    without its ``source``.
    """
    return add_sourced(
        MATERIALS, material.name, material, what="material", where="material",
        unsourced=f"Material '{material.name}' has no source; say where its values come from.",
    )  # fmt: skip
