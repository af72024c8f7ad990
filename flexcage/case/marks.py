"""What prefixes and marks of a designation, as in "6205-2RS C3", "NU 210 ECP" or "7010 CD/HCP4A",
say of a bearing: seals, the clearance, the cage, the material of its elements, tolerances."""

from __future__ import annotations

from dataclasses import replace
from typing import Any

from flexcage.case.catalogues import clearance_limits
from flexcage.case.designation import Designation, meanings, prefixes
from flexcage.core.errors import InputError
from flexcage.geometry.bearing import BEARING_TYPES
from flexcage.geometry.full_complement import CAGED, FILLED
from flexcage.geometry.inference import ClearanceGroup, MarkedCage, Outline

_NORMAL = "CN"
_FULL = ("V", "CV", "VH")  # without a cage
_NONE = "left out: flexcage has none"
_USED = "as the case here has it"
_RATED = (
    "the ratings here are the named catalogue's: give the maker's with --dynamic and --static",
    "the ratings are given",
)


def applied(outline: Outline, designation: Designation) -> Outline:
    """The outline of a bare bearing with what its designation's prefix and marks say: clearance,
    cage, and material of the elements; the rest is named in ``left_out``. InputError if such
    bearings have no groups of clearance."""
    marks, group = designation.marks, designation.clearance_class
    full = outline.complement == CAGED and any(mark in _FULL for mark in marks)
    said = [prefixes()[designation.prefix]] if designation.prefix else []
    known = [*said, *(meanings()[mark] for mark in marks if mark in meanings())]
    elements = [row for row in known if row["element_material"]]
    return replace(
        outline,
        designation=str(designation),
        clearance=None if group is None else _clearance(outline, group),
        complement=FILLED if full else outline.complement,
        cage=next((cage for row in known if (cage := _cage(outline, row))), None),
        element_material=elements[0]["element_material"] if elements else None,
        left_out=(
            *outline.left_out,
            *(_sentence(outline, row) for row in known),
            *(f"{mark}: not known to flexcage, and left out." for mark in designation.unknown),
        ),
    )


def rated_by_user(outline: Outline) -> Outline:
    """An outline with ratings that a user gives, as its sentences on marks have it."""
    told = tuple(text.replace(*_RATED) for text in outline.left_out)
    return replace(outline, left_out=told)


def _sentence(outline: Outline, row: dict[str, str]) -> str:
    name = row.get("mark") or row["prefix"]
    instead = _USED if _cage(outline, row) else row["instead"] or _NONE
    return f"{name}: {row['meaning']}, {instead}."


def _cage(outline: Outline, row: dict[str, str]) -> MarkedCage | None:
    """The cage that a mark names, if flexcage has such a one for bearings of this type."""
    spec: Any = BEARING_TYPES[outline.type]
    kind = row.get("ball_cage" if spec.element == "ball" else "roller_cage", "")
    if outline.type == "angular_contact_ball":
        kind = _ON_SHOULDERS.get(kind, kind)
    if not kind:
        return None
    return MarkedCage(
        mark=row["mark"], meaning=row["meaning"], type=kind, material=row["cage_material"]
    )


# in the place of cages of deep groove ball bearings alone; none of a pressed one
_ON_SHOULDERS = {"crown": "machined", "ribbon": ""}


def _clearance(outline: Outline, group: str) -> ClearanceGroup:
    limits = clearance_limits(outline.type, outline.bore, group)
    normal = clearance_limits(outline.type, outline.bore, _NORMAL)
    if limits is None or normal is None:
        raise InputError(
            f"'{group}' names a group of radial clearance, and flexcage knows none of bearings of "
            f"type '{outline.type}' with a bore of {1e3 * outline.bore:g} mm: leave it out.",
            where="designation",
            value=group,
        )
    return ClearanceGroup(
        name=group, least=limits[0], largest=limits[1], more=0.5 * (sum(limits) - sum(normal))
    )
