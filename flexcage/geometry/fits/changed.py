"""What a mounting changes inside a bearing."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Changed:
    """What changes inside a bearing: growth [m] of the diameters of races and elements, thermal
    strains of both rings, and the radial clearance [m] before and that is left."""

    inner_race: float
    outer_race: float
    element: float
    inner_strain: float
    outer_strain: float
    initial: float
    clearance: float
