"""Cages and their defects: frozen specs, and what follows from their dimensions alone."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import pi, sin
from typing import ClassVar

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.spec import option, quantity
from flexcage.core.units import describe
from flexcage.geometry.cage import Cage, cages_of

_SHARPEST = 1e-4  # fillet, of the pocket's smaller side; smaller ones are lost in its mesh
GUIDANCE = ("roller", "inner", "outer")
ROLLER_CAGES = cages_of("roller")


@dataclass(frozen=True, kw_only=True)
class WindowCage(Cage):
    """A machined window cage: a hollow cylinder with one rectangular pocket per roller.

    Pocket walls are planes: the crossbeam faces parallel to the pocket's radial mid-plane at
    +-pocket_width/2, the side-beam faces normal to the bearing axis at +-pocket_length/2.
    """

    cage_type: ClassVar[str] = "window"
    altered: ClassVar[str] = "Deformed"

    type: str = option("window", doc="kind of cage", choices=ROLLER_CAGES, former="window")
    pocket_width: float = quantity("mm", doc="circumferential pocket width Cq", above=0.0)
    pocket_length: float = quantity("mm", doc="axial pocket length Cp", above=0.0)
    fillet_radius: float = quantity(
        "mm",
        0.5e-3,
        doc="pocket corner fillet radius",
        above=0.0,
        assumption="not given; a corner as cutters leave it: without one, root stress is singular",
    )
    guidance: str = option("roller", doc="what guides the cage radially", choices=GUIDANCE)

    @property
    def fillet(self) -> float:
        return self.fillet_radius

    @property
    def pocket_size(self) -> float:
        return self.pocket_width

    def thinnest(self, pitch_diameter: float, pocket_count: int) -> float:
        beam = pi * pitch_diameter / pocket_count - self.pocket_width
        return min(0.5 * (self.outside_diameter - self.bore), beam)

    def parts(self, pitch_diameter: float, pocket_count: int) -> dict[str, float]:
        return {
            "crossbeams": self.bore * sin(pi / pocket_count) - self.pocket_width,
            "side beams": self.side_beam_width,
            "wall": 0.5 * (self.outside_diameter - self.bore),
        }

    @property
    def side_beam_width(self) -> float:
        return 0.5 * (self.width - self.pocket_length)


@dataclass(frozen=True, kw_only=True)
class CrossbeamDefect:
    """Crossbeam k (between pockets k-1 and k) displaced; > 0 narrows pocket k-1, widens pocket k.

    ``displacement`` is the change of pocket width at the pitch radius, mid-pocket. ``bent``: the
    deflection of a clamped-clamped beam under a uniform load, w(s) = 16 s^2 (1-s)^2 with s from 0
    to 1 along the crossbeam; ``shifted``: the beam as a whole, blended to zero in the side beams.
    """

    tag: ClassVar[str] = "crossbeam"

    crossbeam: int = option(doc="crossbeam number, 0 .. Z-1", minimum=0)
    displacement: float = quantity("mm", doc="delta_q")
    shape: str = option("bent", doc="bent or shifted as a whole", choices=("bent", "shifted"))


@dataclass(frozen=True, kw_only=True)
class SideBeamDefect:
    """One side beam of a pocket displaced along the axis; > 0 lengthens the pocket (delta_p)."""

    tag: ClassVar[str] = "side_beam"

    pocket: int = option(doc="pocket number, 0 .. Z-1", minimum=0)
    side: str = option("+x", doc="which of the two side beams", choices=("+x", "-x"))
    displacement: float = quantity("mm", doc="delta_p")


Defect = CrossbeamDefect | SideBeamDefect


def crossbeam_shape(defect: CrossbeamDefect, x: np.ndarray, pocket_length: float) -> np.ndarray:
    """Shape (0..1) of a crossbeam defect at axial positions x [m] from mid-pocket: 1 at x = 0."""
    s = np.clip(np.asarray(x, float) / pocket_length + 0.5, 0.0, 1.0)
    if defect.shape == "shifted":
        return np.ones_like(s)
    return 16.0 * s**2 * (1.0 - s) ** 2


def side_beam_shape(t: np.ndarray, pocket_width: float) -> np.ndarray:
    """Shape (0..1) of a side-beam defect at tangential positions t [m] from mid-pocket: 1 at 0.

    The same clamped-clamped deflection as a bent crossbeam, over the pocket's width.
    """
    s = np.clip(np.asarray(t, float) / pocket_width + 0.5, 0.0, 1.0)
    return 16.0 * s**2 * (1.0 - s) ** 2


def pocket_changes(
    defects: Sequence[Defect], *, pocket_count: int
) -> tuple[np.ndarray, np.ndarray]:
    """Change of every pocket's width and length (Z,) [m] at the pitch radius, mid-pocket."""
    width, length = np.zeros(pocket_count), np.zeros(pocket_count)
    for defect in defects:
        if isinstance(defect, CrossbeamDefect):
            width[(defect.crossbeam - 1) % pocket_count] -= defect.displacement
            width[defect.crossbeam] += defect.displacement
        else:
            length[defect.pocket] += defect.displacement
    return width, length


def check_cage(cage: WindowCage, *, pocket_count: int) -> None:
    """Refuse a cage whose dimensions leave no body: thickness, side beams, crossbeams, fillets."""
    chord = cage.bore * sin(pi / pocket_count)  # between neighbouring pockets' planes, at the bore
    half_window = 0.5 * min(cage.pocket_width, cage.pocket_length)
    if cage.outside_diameter <= cage.bore:
        what = f"must exceed its bore, {_mm(cage.bore)}"
        where = "outside_diameter"
    elif cage.pocket_length >= cage.width:
        what = f"leaves no side beams in a cage {_mm(cage.width)} wide"
        where = "pocket_length"
    elif cage.pocket_width >= chord:
        what = (
            f"makes the {pocket_count} crossbeams thinner than zero at the bore; it must be less "
            f"than {_mm(chord)}"
        )
        where = "pocket_width"
    elif cage.fillet_radius >= half_window:
        what = f"is too big; it must be less than half of the pocket's side, {_mm(half_window)}"
        where = "fillet_radius"
    elif cage.fillet_radius < 2.0 * _SHARPEST * half_window:
        what = f"is a sharp corner; it must be at least {_mm(2.0 * _SHARPEST * half_window)}"
        where = "fillet_radius"
    else:
        return
    value = getattr(cage, where)
    raise InputError(f"cage.{where}, {_mm(value)}, {what}.", where=f"cage.{where}", value=value)


def check_defects(defects: Sequence[Defect], cage: WindowCage, *, pocket_count: int) -> None:
    """Refuse a defect of a pocket or crossbeam that is not there, or that leaves the pocket."""
    for i, defect in enumerate(defects):
        _check_defect(defect, cage, pocket_count, f"defects.{i}")
    width, length = pocket_changes(defects, pocket_count=pocket_count)
    for what, sizes in (
        ("width", cage.pocket_width + width),
        ("length", cage.pocket_length + length),
    ):
        k = int(np.argmin(sizes))
        if sizes[k] <= 0.0:
            raise InputError(
                f"The defects together leave pocket {k} a {what} of {_mm(sizes[k])}; it must be "
                "greater than zero.",
                where="defects",
                value=float(sizes[k]),
            )


def _check_defect(defect: Defect, cage: WindowCage, pocket_count: int, where: str) -> None:
    if isinstance(defect, CrossbeamDefect):
        name, number, limit = "crossbeam", defect.crossbeam, 0.5 * cage.pocket_width
        reason = "half of the pocket's width"
    else:
        name, number = "pocket", defect.pocket
        limit, reason = min(0.5 * cage.pocket_length, cage.side_beam_width), "the side beam's width"
        if limit < cage.side_beam_width:
            reason = "half of the pocket's length"
    if not 0 <= number < pocket_count:
        raise InputError(
            f"{where}.{name} is {number}, but the cage's {name}s are numbered 0 to "
            f"{pocket_count - 1}.",
            where=f"{where}.{name}",
            value=number,
        )
    if not abs(defect.displacement) < limit:
        raise InputError(
            f"{where}.displacement is {_mm(defect.displacement)}, which leaves the pocket; it must "
            f"stay below {_mm(limit)}, {reason}.",
            where=f"{where}.displacement",
            value=defect.displacement,
        )


def _mm(value: float) -> str:
    return describe(value, "mm")
