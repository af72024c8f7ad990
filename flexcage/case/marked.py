"""What marks of a designation change in what is inferred: the cage, and the elements' material."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from flexcage.geometry.inference import Candidate, MarkedCage, Outline, ProposedCage
from flexcage.geometry.materials import MATERIALS


def of_mark(proposed: ProposedCage, marked: MarkedCage) -> ProposedCage:
    """A cage of the material that a mark of the designation names."""
    said = f"given: {marked.mark}, {marked.meaning}"
    if "GF" in marked.material:
        said += "; the share of glass is an assumption"
    return replace(
        proposed,
        cage=replace(proposed.cage, material=MATERIALS[marked.material]),
        reasons={**proposed.reasons, "material": said},
    )


def unmarked(outline: Outline, marked: MarkedCage, *, caged: bool = True) -> Outline:
    """An outline without the cage that a mark names, as it has no place; the sentence says so, and
    whether there is another (``caged``)."""
    instead = "cage is of a common form" if caged else "case is without one"
    told = tuple(
        f"{marked.mark}: {marked.meaning}; none of usual proportions has a place here, so that the "
        f"{instead}."
        if text.startswith(f"{marked.mark}: ")
        else text
        for text in outline.left_out
    )
    return replace(outline, cage=None, left_out=told)


def rolling(candidate: Candidate) -> Candidate:
    """A candidate with elements of the material that the designation names."""
    name = candidate.outline.element_material
    if name is None:
        return candidate
    changes: dict[str, Any] = {"element_material": MATERIALS[name]}
    reasons = {**candidate.reasons, "element_material": "given: by the designation"}
    bearing = replace(candidate.bearing, **changes)
    return replace(candidate, bearing=bearing, reasons=reasons)
