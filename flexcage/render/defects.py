"""What pictures show of a defect, by its spec: where it is, what it changed, and its label."""

from __future__ import annotations

from collections.abc import Sequence
from functools import singledispatch
from math import pi
from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.geometry.ball_cage_defects import (
    DisplacedPocket,
    ElongatedPocket,
    EnlargedPocket,
    MissingRivet,
    WebCrack,
)
from flexcage.geometry.cages import CrossbeamDefect, SideBeamDefect
from flexcage.render import sheet

SMALLER, LARGER, MOVED = sheet.VERMILION, sheet.BLUE, sheet.PURPLE
CRACK = sheet.VERMILION
Key = tuple[str, str, str]  # kind of mark, colour, text


def _unknown(defect: Any) -> InputError:
    return InputError(f"There is no picture of a {type(defect).__name__}.", where="defects")


@singledispatch
def pitches(defect: Any) -> float:
    """Place of a defect around the cage, counted in pockets."""
    raise _unknown(defect)


@singledispatch
def pockets_of(defect: Any, count: int) -> list[int]:
    """Pockets that a defect touches, of ``count``; the one behind a beam or web first."""
    raise _unknown(defect)


@singledispatch
def label_of(defect: Any) -> str:
    """A defect and its size, in a few words."""
    raise _unknown(defect)


@singledispatch
def changes_of(defect: Any, count: int) -> dict[tuple[int, str], float]:
    """(pocket, what of it) -> change of size [m]; 0 for a pocket's "place"."""
    raise _unknown(defect)


@singledispatch
def keys_of(defect: Any) -> list[Key]:
    """Legend of the marks of this kind of defects; patches count where their colour is used."""
    raise _unknown(defect)


@singledispatch
def way_of(defect: Any, count: int) -> tuple[float, np.ndarray] | None:
    """Where wall or beam went: axial place over the cage's half width, and the unit direction."""
    return None


def azimuth_of(defect: Any, count: int) -> float:
    """Azimuth of a defect [rad]."""
    return 2.0 * pi * pitches(defect) / count


def pocket_colours(defects: Sequence[Any], count: int) -> dict[int, str]:
    """Colour of every pocket that a defect changed, by its largest change of size by all."""
    total: dict[tuple[int, str], float] = {}
    for defect in defects:
        for key, change in changes_of(defect, count).items():
            total[key] = total.get(key, 0.0) + change
    largest: dict[int, float] = {}
    for (pocket, what), size in total.items():
        if (size or what == "place") and abs(size) >= abs(largest.get(pocket, 0.0)):
            largest[pocket] = size
    return {k: LARGER if size > 0.0 else SMALLER if size else MOVED for k, size in largest.items()}


def _around(azimuth: float) -> np.ndarray:
    """Unit vector towards larger azimuth."""
    return np.array([0.0, -np.sin(azimuth), np.cos(azimuth)])


def _mm(size: float) -> str:
    return f"{size * 1e3:+.3g} mm".replace("-", "−")


_RIM = "rim without the defect"
_OF_WINDOWS: list[Key] = [
    ("patch", SMALLER, "pocket made narrower or shorter"),
    ("patch", LARGER, "pocket made wider or longer"),
    ("dashes", sheet.BLACK, f"{_RIM}; arrow: way of the beam"),
]
_OF_HOLES: list[Key] = [
    ("patch", SMALLER, "pocket made smaller"),
    ("patch", LARGER, "pocket made larger"),
    ("dashes", sheet.BLACK, _RIM),
]


def legend(defects: Sequence[Any], count: int) -> list[Key]:
    """Legend of all marks of some defects, patches first, in one order for all pictures."""
    used = set(pocket_colours(defects, count).values())
    found = {key[:2]: key for defect in defects for key in keys_of(defect)}
    rows = [found.pop(("patch", c), None) for c in (SMALLER, LARGER, MOVED) if c in used]
    rest = sorted((key for key in found.values() if key[0] != "patch"), reverse=True)
    return [*filter(None, rows), *rest]


@pitches.register
def _(defect: CrossbeamDefect) -> float:
    return defect.crossbeam - 0.5


@pockets_of.register
def _(defect: CrossbeamDefect, count: int) -> list[int]:
    return [(defect.crossbeam - 1) % count, defect.crossbeam]


@label_of.register
def _(defect: CrossbeamDefect) -> str:
    return f"crossbeam {defect.crossbeam} {defect.shape}, $δ_q$ = {_mm(defect.displacement)}"


@changes_of.register
def _(defect: CrossbeamDefect, count: int) -> dict[tuple[int, str], float]:
    before, after = pockets_of(defect, count)
    return {(before, "front"): -defect.displacement, (after, "rear"): defect.displacement}


@keys_of.register
def _(defect: CrossbeamDefect) -> list[Key]:
    return _OF_WINDOWS


@way_of.register
def _(defect: CrossbeamDefect, count: int) -> tuple[float, np.ndarray]:
    return 0.0, -np.sign(defect.displacement) * _around(azimuth_of(defect, count))


@pitches.register(SideBeamDefect)
@pitches.register(EnlargedPocket)
@pitches.register(ElongatedPocket)
@pitches.register(DisplacedPocket)
def _(defect: Any) -> float:
    return float(defect.pocket)


@pockets_of.register(SideBeamDefect)
@pockets_of.register(EnlargedPocket)
@pockets_of.register(ElongatedPocket)
@pockets_of.register(DisplacedPocket)
def _(defect: Any, count: int) -> list[int]:
    return [defect.pocket]


@label_of.register
def _(defect: SideBeamDefect) -> str:
    side = defect.side.replace("-", "−")
    return f"pocket {defect.pocket}, side beam {side}, $δ_p$ = {_mm(defect.displacement)}"


@changes_of.register
def _(defect: SideBeamDefect, count: int) -> dict[tuple[int, str], float]:
    return {(defect.pocket, f"side{defect.side}"): defect.displacement}


@keys_of.register
def _(defect: SideBeamDefect) -> list[Key]:
    return _OF_WINDOWS


@way_of.register
def _(defect: SideBeamDefect, count: int) -> tuple[float, np.ndarray]:
    sign = 1.0 if defect.side == "+x" else -1.0
    return 0.78 * sign, sign * np.sign(defect.displacement) * np.array([1.0, 0.0, 0.0])


@label_of.register
def _(defect: EnlargedPocket) -> str:
    what = "enlarged" if defect.increase > 0.0 else "made smaller"
    return f"pocket {defect.pocket} {what}, diameter {_mm(defect.increase)}"


@changes_of.register
def _(defect: EnlargedPocket, count: int) -> dict[tuple[int, str], float]:
    return {(defect.pocket, "diameter"): defect.increase}


@keys_of.register
def _(defect: EnlargedPocket) -> list[Key]:
    return _OF_HOLES


@label_of.register
def _(defect: ElongatedPocket) -> str:
    return f"pocket {defect.pocket} elongated, {defect.direction} {_mm(defect.elongation)}"


@changes_of.register
def _(defect: ElongatedPocket, count: int) -> dict[tuple[int, str], float]:
    return {(defect.pocket, defect.direction): defect.elongation}


@keys_of.register
def _(defect: ElongatedPocket) -> list[Key]:
    return _OF_HOLES


@label_of.register
def _(defect: DisplacedPocket) -> str:
    parts = {"axially": defect.axial, "along ψ": defect.circumferential}
    moved = " and ".join(f"{_mm(size)} {way}" for way, size in parts.items() if size)
    return f"pocket {defect.pocket} displaced, {moved or 'by nothing'}"


@changes_of.register
def _(defect: DisplacedPocket, count: int) -> dict[tuple[int, str], float]:
    return {(defect.pocket, "place"): 0.0}


@keys_of.register
def _(defect: DisplacedPocket) -> list[Key]:
    return [
        ("patch", MOVED, "pocket displaced"),
        ("dashes", sheet.BLACK, f"{_RIM}; arrow: way of the pocket"),
    ]


@way_of.register
def _(defect: DisplacedPocket, count: int) -> tuple[float, np.ndarray] | None:
    way = defect.circumferential * _around(azimuth_of(defect, count))
    way[0] = defect.axial
    size = float(np.linalg.norm(way))
    return (-0.3, way / size) if size else None  # below the pocket's name


@pitches.register(WebCrack)
@pitches.register(MissingRivet)
def _(defect: Any) -> float:
    return defect.web - 0.5


@pockets_of.register(WebCrack)
@pockets_of.register(MissingRivet)
def _(defect: Any, count: int) -> list[int]:
    return [(defect.web - 1) % count, defect.web]


@label_of.register
def _(defect: WebCrack) -> str:
    side = defect.side.replace("-", "−")
    return f"web {defect.web} cracked from the end {side}, {100.0 * defect.share:g} % of the width"


@changes_of.register(WebCrack)
@changes_of.register(MissingRivet)
def _(defect: Any, count: int) -> dict[tuple[int, str], float]:
    return {}


@keys_of.register
def _(defect: WebCrack) -> list[Key]:
    return [("line", CRACK, "crack through the whole wall")]


@label_of.register
def _(defect: MissingRivet) -> str:
    return f"web {defect.web} without its rivet"


@keys_of.register
def _(defect: MissingRivet) -> list[Key]:
    return [("line", CRACK, "place of the missing rivet")]
