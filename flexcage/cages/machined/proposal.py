"""A machined cage of usual proportions for a ball bearing."""

from __future__ import annotations

from math import pi, sin
from typing import Any

from flexcage.cages.round_pocket.cage import BallCage
from flexcage.geometry.inference import ProposedCage, rounded

# over the ball's diameter
_CLEARANCE, _MOST_CLEARANCE = 0.03, 0.3e-3  # of a pocket; and at most [m]
_WALL = 0.45  # of the wall, outwards and inwards together
_WEB = 0.04  # of the webs at the bore, at least
_RIM = 0.2  # of a rim beside a pocket
_STEP = 10e-6  # m


def propose_machined_cage(bearing: Any) -> ProposedCage:
    """A hollow cylinder about the pitch circle, whose webs are not cut through at its bore."""
    ball, pitch = bearing.element_diameter, bearing.pitch_diameter
    web = pitch * sin(pi / bearing.element_count) - ball
    pocket = rounded(ball + min(_CLEARANCE * ball, _MOST_CLEARANCE, 0.3 * web), _STEP)
    least = (pocket + _WEB * ball) / sin(pi / bearing.element_count)
    usual = pitch - _WALL * ball
    limited = least > usual
    cage = BallCage(
        bore=rounded(max(least, usual), _STEP),
        outside_diameter=rounded(pitch + _WALL * ball, _STEP),
        width=rounded(pocket + 2.0 * _RIM * ball, _STEP),
        pocket_diameter=pocket,
    )
    usually = f"assumption: {_WALL:g} times the ball's diameter less than the pitch circle"
    return ProposedCage(
        cage=cage,
        reasons={
            "material": "assumption: a usual material of such cages",
            "bore": "assumption: as small as the webs between the pockets allow"
            if limited
            else usually,
            "outside_diameter": f"assumption: {_WALL:g} times the ball's diameter more than "
            "the pitch circle",
            "width": f"assumption: rims {_RIM:g} times the ball's diameter wide",
            "pocket_diameter": f"assumption: {1e3 * (pocket - ball):.2g} mm of clearance",
        },
    )
