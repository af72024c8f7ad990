"""What a user may ask of a cage's mesh."""

from __future__ import annotations

from dataclasses import dataclass

from flexcage.core.spec import ABSENT, GIVEN, option, quantity

_BUILT = {"file": ABSENT}
FINENESS = ("coarse", "medium", "fine", "paper")


@dataclass(frozen=True, kw_only=True)
class MeshOptions:
    """Fineness by name, or by size; or a mesh file of the user's own.

    A named fineness gives about the same number of elements a pocket whatever the cage's size:
    on the N1013 cage 12,000 (coarse), 36,000 (medium) and 89,000 (fine) nodes when quadratic,
    and 88,000 vertices with 375,000 linear tetrahedra (paper, the density of a published study);
    on the 7010C's polyimide cage 20,000, 36,000 and 93,000 nodes, and 63,000 vertices.
    A file is used as it is: defects are not applied to it but must be in it.
    """

    fineness: str = option("medium", doc="element size by name", choices=FINENESS, when=_BUILT)
    size: float | None = quantity(
        "mm",
        None,
        doc="element size away from the fillets, instead of the named one",
        above=0.0,
        when=_BUILT,
    )
    fillet_size: float | None = quantity(
        "mm",
        None,
        doc="edge length along a fillet's arc, instead of the named one",
        above=0.0,
        when=_BUILT,
    )
    order: int = option(2, doc="element order of the displacements: 1 or 2", minimum=1, maximum=2)
    file: str = option(
        "", doc="a mesh file (.msh, .inp, .cdb, .vtu) to read instead of building one", file=True
    )
    file_unit: str = option(
        "m", doc="unit of length in that file", choices=("m", "mm"), when={"file": GIVEN}
    )
