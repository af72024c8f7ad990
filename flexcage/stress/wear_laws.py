"""Wear coefficients of cage materials against bearing steel with their sources.

J. F. Archard, J. Appl. Phys. 24 (1953) 981: worn volume = k * normal force * sliding distance. The
coefficients are those of dry sliding. A lubricant lowers them by orders of magnitude, and by how
much depends on its film: a lubricated cage needs a coefficient of its own.
"""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.core.errors import InputError
from flexcage.core.registry import add_sourced
from flexcage.core.spec import option, quantity

# m^3/(N m), ten times what the softest solid loses to an abrasive: mm^3 that were given as m^3
_MOST = 1e-10


@dataclass(frozen=True, kw_only=True)
class WearLaw:
    """Archard's law for one material: ``coefficient`` k [m^3/(N m)] (1 mm^3/(N m) is 1e-9)."""

    material: str = option(doc="name of the material that wears")
    coefficient: float = quantity(
        "mm^3/(N*m)", doc="worn volume by force and distance", minimum=0.0, maximum=_MOST
    )
    source: str = option("", doc="where the value comes from")
    assumption: str = option("", doc="what no source gives")


#: By the name of the cage's material.
WEAR_LAWS: dict[str, WearLaw] = {
    law.material: law
    for law in (
        WearLaw(
            material="brass",
            coefficient=6.4e-13,
            source="J. F. Archard and W. Hirst, Proc. R. Soc. A 236 (1956) 397: leaded 60/40 brass "
            "on tool steel, dry, K = 6e-4, by its hardness of 95 kgf/mm^2",
            assumption="dry: an upper bound for a lubricated cage",
        ),
        WearLaw(
            material="PA66",
            coefficient=1.61e-15,
            source="Quadrant Nylon 101 (extruded PA66) on steel, dry, QTM 55010: 161e-8 mm^3/(N m)",
            assumption="dry: an upper bound for a lubricated cage",
        ),
    )
}


def register_wear_law(law: WearLaw) -> WearLaw:
    """Add a material's law: runs and studies with that material then use it; returns it.

    Raises InputError for a material that has one, a value out of its bounds, or a law without its
    ``source``.
    """
    lacking = f"The wear law of '{law.material}' has no source; say where its value comes from."
    return add_sourced(
        WEAR_LAWS, law.material, law, what="wear law", where="wear_law", unsourced=lacking
    )


def wear_law(material: str) -> WearLaw:
    """The law of a material; InputError where none is known."""
    if material in WEAR_LAWS:
        return WEAR_LAWS[material]
    raise InputError(
        f"No published wear coefficient of {material} on steel is known here (there are "
        f"{', '.join(WEAR_LAWS)}); give your own, flexcage wear RUN --coefficient "
        "'1e-8 mm^3/(N*m)' or run.wear(flexcage.spec.WearLaw(...)), or register it with "
        "flexcage.register.wear_law.",
        where="law",
        value=material,
    )
