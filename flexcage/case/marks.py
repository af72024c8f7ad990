"""What makers write after a designation, as in "6205-2RS C3", "NU 210 ECP" or "7010 CD/P4A": seals,
shields, the clearance, the cage, tolerances."""

from __future__ import annotations

from collections.abc import Container
from dataclasses import dataclass, replace
from functools import cache

from flexcage.case.catalogues import rows
from flexcage.core.errors import InputError
from flexcage.geometry.full_complement import CAGED, FILLED
from flexcage.geometry.inference import ClearanceGroup, Outline

_GROUPS = ("C2", "CN", "C3", "C4", "C5")
_NORMAL = "CN"
_FULL = ("V", "CV", "VH")  # without a cage


@dataclass(frozen=True, kw_only=True)
class Marked:
    """A designation in parts: the bare one, and the marks after it."""

    bare: str
    marks: tuple[str, ...]

    def applied(self, outline: Outline) -> Outline:
        """The bare bearing's outline with its marks, the clearance that they name, and what is left
        out of the rest; InputError if such bearings have no groups of clearance."""
        known = _meanings()
        group = next((mark for mark in self.marks if mark in _GROUPS), None)
        full = outline.complement == CAGED and any(mark in _FULL for mark in self.marks)
        return replace(
            outline,
            designation="-".join((self.bare, *self.marks)),
            clearance=None if group is None else _clearance(outline, group),
            complement=FILLED if full else outline.complement,
            left_out=(
                *outline.left_out,
                *(f"{m}: {known[m]}." for m in self.marks if m in known),
            ),
        )


def split(name: str, known: Container[str]) -> Marked | None:
    """Parts of a designation in capitals without blanks, dashes and strokes, whose bare form is
    ``known``; None if it is none of them, or something else follows."""
    for at in range(1, len(name)):
        if name[:at] in known and (marks := _marks_in(name[at:])):
            return Marked(bare=name[:at], marks=marks)
    return None


def _marks_in(text: str) -> tuple[str, ...]:
    """The marks that make up a text, long ones first where it can be read in two ways; none if
    something else is in it."""
    for mark in sorted((*_meanings(), *_GROUPS), key=len, reverse=True):
        if text == mark:
            return (mark,)
        if text.startswith(mark) and (more := _marks_in(text[len(mark) :])):
            return (mark, *more)
    return ()


def _clearance(outline: Outline, group: str) -> ClearanceGroup:
    bore = 1e3 * outline.bore
    for row in rows("clearance"):
        if row["type"] == outline.type and float(row["over_mm"]) < bore <= float(row["to_mm"]):
            (least, largest), normal = _limits(row[group]), _limits(row[_NORMAL])
            more = (least + largest - sum(normal)) / 2.0
            return ClearanceGroup(name=group, least=least, largest=largest, more=more)
    raise InputError(
        f"'{group}' names a group of radial clearance, and flexcage knows none of bearings of type "
        f"'{outline.type}' with a bore of {bore:g} mm: leave it out.",
        where="designation",
        value=group,
    )


def _limits(text: str) -> tuple[float, float]:
    """Least and largest [m] of an entry such as "5-20", in um."""
    least, largest = (1e-6 * float(part) for part in text.split("-"))
    return least, largest


@cache
def _meanings() -> dict[str, str]:
    """What every mark means, and what there is instead, where flexcage has no such thing."""
    return {
        row["mark"]: f"{row['meaning']}, {row['instead'] or 'left out: flexcage has none'}"
        for row in rows("marks")
    }
