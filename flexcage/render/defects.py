"""Colours of a cage's defects, and the legend of their marks."""

from __future__ import annotations

from collections.abc import Sequence
from math import pi

from flexcage.geometry.defect import CageDefect, Meaning
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.rows import frame_of
from flexcage.render import sheet

COLOURS: dict[Meaning, str] = {
    "smaller": sheet.VERMILION,
    "larger": sheet.BLUE,
    "moved": sheet.PURPLE,
    "crack": sheet.VERMILION,
    "sound": sheet.BLACK,
}
SMALLER, LARGER, MOVED = COLOURS["smaller"], COLOURS["larger"], COLOURS["moved"]
Key = tuple[str, str, str]  # kind of mark, colour, text


def azimuth_of(defect: CageDefect, mesh: CageMesh) -> float:
    """Azimuth of a defect [rad] of a mesh."""
    count = mesh.pocket_count
    return frame_of(mesh.info, defect.number, count).turned + 2.0 * pi * defect.place / count


def pocket_colours(defects: Sequence[CageDefect], count: int) -> dict[int, str]:
    """Colour of every pocket that a defect changed, by its largest change of size by all."""
    total: dict[tuple[int, str], float] = {}
    for defect in defects:
        for key, change in defect.changes(count).items():
            total[key] = total.get(key, 0.0) + change
    largest: dict[int, float] = {}
    for (pocket, what), size in total.items():
        if (size or what == "place") and abs(size) >= abs(largest.get(pocket, 0.0)):
            largest[pocket] = size
    return {k: LARGER if size > 0.0 else SMALLER if size else MOVED for k, size in largest.items()}


def legend(defects: Sequence[CageDefect], count: int) -> list[Key]:
    """Legend of all marks of some defects, patches first, in one order for all pictures."""
    used = set(pocket_colours(defects, count).values())
    keys = [(mark.kind, COLOURS[mark.meaning], mark.text) for d in defects for mark in d.legend]
    found = {key[:2]: key for key in keys}
    rows = [found.pop(("patch", c), None) for c in (SMALLER, LARGER, MOVED) if c in used]
    rest = sorted((key for key in found.values() if key[0] != "patch"), reverse=True)
    return [*filter(None, rows), *rest]
