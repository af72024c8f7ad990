"""Cages and their defects: frozen specs, and what follows from their dimensions alone."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.core.spec import option, quantity
from flexcage.geometry.materials import MATERIALS, Material

GUIDANCE = ("roller", "inner", "outer")


@dataclass(frozen=True, kw_only=True)
class WindowCage:
    """A machined window cage: a hollow cylinder with one rectangular pocket per roller.

    Pocket walls are planes: the crossbeam faces parallel to the pocket's radial mid-plane at
    +-pocket_width/2, the side-beam faces normal to the bearing axis at +-pocket_length/2.
    """

    material: Material = option(MATERIALS["brass"], doc="cage material (a name or its values)")
    bore: float = quantity("mm", doc="inside diameter", above=0.0)
    outside_diameter: float = quantity("mm", doc="outside diameter", above=0.0)
    width: float = quantity("mm", doc="axial width", above=0.0)
    pocket_width: float = quantity("mm", doc="circumferential pocket width Cq", above=0.0)
    pocket_length: float = quantity("mm", doc="axial pocket length Cp", above=0.0)
    fillet_radius: float = quantity(
        "mm", 0.5e-3, doc="pocket corner fillet radius", above=0.0, assumption="not in the paper"
    )
    guidance: str = option("roller", doc="what guides the cage radially", choices=GUIDANCE)
    unbalance: float = quantity("g*mm", 0.0, doc="mass-radius product of an unbalance", minimum=0.0)
    unbalance_phase: float = quantity("deg", 0.0, doc="azimuth of the unbalance from pocket 0")

    @property
    def mean_radius(self) -> float:
        return 0.25 * (self.bore + self.outside_diameter)

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

    crossbeam: int = option(doc="crossbeam number, 0 .. Z-1", minimum=0)
    displacement: float = quantity("mm", doc="delta_q")
    shape: str = option("bent", doc="bent or shifted as a whole", choices=("bent", "shifted"))


@dataclass(frozen=True, kw_only=True)
class SideBeamDefect:
    """One side beam of a pocket displaced along the axis; > 0 lengthens the pocket (delta_p)."""

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
