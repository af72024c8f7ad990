"""A riveted ribbon cage of usual proportions for a deep groove ball bearing."""

from __future__ import annotations

from typing import Any

from flexcage.cages.ribbon.cage import RibbonCage
from flexcage.geometry.inference import ProposedCage, rounded

# over the ball's diameter
_POCKET, _SHEET, _RIVET = 1.05, 0.1, 0.15
_WALL = 0.5  # of the strip, broad
_STEP = 10e-6  # m


def propose_ribbon_cage(bearing: Any) -> ProposedCage:
    """A strip half as broad as a ball, in the middle between the shoulders, pressed to pockets that
    close over the balls."""
    ball, pitch = bearing.element_diameter, bearing.pitch_diameter
    pocket, sheet = rounded(_POCKET * ball, _STEP), rounded(_SHEET * ball, _STEP)
    cage = RibbonCage(
        bore=rounded(pitch - _WALL * ball, _STEP),
        outside_diameter=rounded(pitch + _WALL * ball, _STEP),
        width=pocket + 2.0 * sheet,
        pocket_diameter=pocket,
        thickness=sheet,
        rivet_diameter=rounded(_RIVET * ball, _STEP),
    )
    of_ball = "assumption: {:g} times the ball's diameter".format
    return ProposedCage(
        cage=cage,
        reasons={
            "material": "assumption: pressed cages of this type are of steel sheet",
            "bore": f"assumption: a strip {_WALL:g} times the ball's diameter broad",
            "outside_diameter": "assumption: likewise, about the pitch circle",
            "width": "assumption: pocket and two sheets, so that pockets close over the balls",
            "pocket_diameter": of_ball(_POCKET),
            "thickness": of_ball(_SHEET),
            "rivet_diameter": of_ball(_RIVET),
        },
    )
