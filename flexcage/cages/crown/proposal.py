"""A crown cage of usual proportions for a deep groove ball bearing."""

from __future__ import annotations

from math import pi, sin
from typing import Any

from flexcage.cages.crown.cage import CrownCage
from flexcage.core.errors import InputError
from flexcage.geometry.inference import ProposedCage, rounded

# over the ball's diameter
_CLEARANCE, _MOST_CLEARANCE = 0.03, 0.3e-3  # of a pocket; and at most [m]
_WALL = 0.45  # of the wall, outwards and inwards together
_THROAT = 0.92
_CLAW, _RING = 0.13, 0.18  # thickness of claws, and of the ring under the pockets
_GAP = 0.06  # between neighbouring claws at their roots, at least
_THINNEST = 0.065  # of claws: thinner ones hold no ball, and take a mesh of hundreds of thousands
_STEP = 10e-6  # m


def propose_crown_cage(bearing: Any) -> ProposedCage:
    """A wall about the pitch circle; claws as thick as usual, or as leave a gap between them."""
    ball, pitch = bearing.element_diameter, bearing.pitch_diameter
    pocket = rounded(ball + min(_CLEARANCE * ball, _MOST_CLEARANCE), _STEP)
    throat = rounded(_THROAT * ball, _STEP)
    half = 0.5 * (pitch * sin(pi / bearing.element_count) - _GAP * ball)
    usual, most = _CLAW * ball, (half - 0.5 * pocket) / 1.5  # claw and root take 1.5 thicknesses
    if most < _THINNEST * ball:
        raise InputError(
            f"the balls stand so close that claws could be {1e3 * max(most, 0.0):.2g} mm thick "
            f"at most, and a crown cage has claws of at least {1e3 * _THINNEST * ball:.2g} mm, "
            f"{_THINNEST:g} times the ball's diameter",
            where="cage.claw_thickness",
            value=most,
        )
    tip = 0.5 * (pocket**2 - throat**2) ** 0.5
    cage = CrownCage(
        bore=rounded(pitch - _WALL * ball, _STEP),
        outside_diameter=rounded(pitch + _WALL * ball, _STEP),
        width=rounded(tip + 0.5 * pocket + _RING * ball, _STEP),
        pocket_diameter=pocket,
        throat=throat,
        claw_thickness=rounded(min(usual, most), _STEP),
    )
    of_ball = "assumption: {:g} times the ball's diameter".format
    return ProposedCage(
        cage=cage,
        reasons={
            "material": "assumption: a usual material of such cages",
            "bore": of_ball(_WALL) + " less than the pitch circle",
            "outside_diameter": of_ball(_WALL) + " more than the pitch circle",
            "width": f"assumption: a ring {_RING:g} times the ball's diameter thick under pockets",
            "pocket_diameter": f"assumption: {1e3 * (pocket - ball):.2g} mm of clearance",
            "throat": of_ball(_THROAT) + ": what the ball snaps through",
            "claw_thickness": of_ball(_CLAW)
            if usual <= most
            else "assumption: as thick as leaves a gap between neighbouring claws",
        },
    )
