"""Losses of balls on up to four arcs in the static solution.

As ``ball.losses`` has them, with a contact on every arc that bears: a ball on both arcs of a race
slides on them, as it cannot roll on two circles of different radii.
"""

from __future__ import annotations

import numpy as np

from flexcage.bearings.ball.losses import Touch, ball_losses
from flexcage.bearings.four_point.bearing import FourPointContactBearing
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.system.statics.losses import Losses
from flexcage.system.statics.state import StaticState

_NAMES = (("inner", ("-x", "+x")), ("outer", ("+x", "-x")))  # of arcs, as ``statics`` has them


def four_point_losses(
    bearing: FourPointContactBearing, solution: StaticState, *, contacts: Contacts,
    lubricant: Lubricant,
) -> Losses:  # fmt: skip
    """Losses of a four-point contact bearing's static solution."""
    return ball_losses(bearing, solution, contacts=contacts, lubricant=lubricant, touches=on_arcs)


def on_arcs(b: FourPointContactBearing, solution: StaticState, k: int) -> list[Touch]:
    """Where ball ``k`` touches arcs. The solution has the angle of each race's arc that bears most;
    that of the other one follows from the shim, by which the arcs' centres are apart (a tilt's part
    in that, 1e-3 of it, is left out)."""
    e, found = solution.elements, []
    assert e.arcs is not None
    for race, (ring, sides) in enumerate(_NAMES):
        places = b.arcs(ring)
        names = [f"{ring} {side}" for side in sides] if len(places) == 2 else [ring]
        forces = np.array([e.arcs[name][k] for name in names])
        most, angle = int(forces.argmax()), float(e.angle[k, race])
        depth = (float(forces[most]) / b.contacts[race].stiffness) ** (2.0 / 3.0)
        line = (b.lengths[race] + depth) * np.array([np.sin(angle), np.cos(angle)])
        sign = 1.0 if race == 0 else -1.0  # from the ball to the centre, or from that
        for place, force in zip(places, forces):
            x = line[0] + sign * (place - places[most])
            if force > 0.0:
                found.append((race, float(force), float(np.arctan2(x, line[1]))))
    return found
