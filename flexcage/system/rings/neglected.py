"""What of a ring's bending its ribs and lands do not follow in a run, and when that matters.

They follow the modes of their ring (``sections``), and else the seat. What races yield beside that
is left out: a warning says so where it is more than a tenth of a clearance. A film takes its ring
as round.
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from flexcage.contacts.land import FILM, NONE, LandData
from flexcage.contacts.ring_waves import RADIALLY
from flexcage.core.units import mm
from flexcage.system.data import OUTER_RACE
from flexcage.system.rings.moving import SIDES, MovingRings

MATTERS = 0.1  # of a clearance
_ROUND = 2  # waves around a ring from which on it is no longer round


def neglected_deflection(moving: MovingRings) -> np.ndarray:
    """Deflections (2, Z, 2) of both races at their ports, at the start, that ribs and lands leave
    out."""
    found = np.zeros_like(moving.data.given)
    for bent in moving.start.rings:
        side = SIDES.index(bent.side)
        found[side] = bent.deflection @ bent.seated.to_v
        if (made := moving.coordinates[side]) is not None:
            found[side] -= (made.waves(bent.azimuth) * made.at_start) @ made.shape
    return found


def neglected_at_lands(moving: MovingRings, land: LandData) -> Iterator[str]:
    """Sentences on a cage's lands."""
    if land.kind == NONE:
        return
    side = 0 if land.inner else OUTER_RACE
    way = moving.start.rings[0].seated.to_v.argmax(axis=0) if moving.start.rings else ()
    radial = [k for k, port in enumerate(way) if port == RADIALLY]
    least = float(np.abs(neglected_deflection(moving)[side][:, radial]).max(initial=0.0))
    if least > MATTERS * land.clearance:
        yield _sentence(SIDES[side], "lands", least, land.clearance)
    oval = _out_of_round(moving, side)
    if land.kind == FILM and oval > MATTERS * land.clearance:
        yield (
            f"the film on the cage's lands takes the {SIDES[side]} ring as round, but at the start "
            f"it is out of round by {mm(oval)}, {oval / land.clearance:.0%} of their clearance; "
            'contacts.land.kind = "dry" follows its shape.'
        )


def neglected_at_ribs(moving: MovingRings, side: int, height: float, play: float) -> Iterator[str]:
    """Sentences on the ribs of a ring (``side``), which roller ends touch at a ``height`` [m] above
    its race; ``play`` [m] of a roller between both."""
    (tilt,) = np.abs(neglected_deflection(moving)[side][:, 1:]).max(axis=0, initial=0.0)
    if tilt * height > MATTERS * play:
        yield _sentence(SIDES[side], "ribs", float(tilt * height), play)


def _out_of_round(moving: MovingRings, side: int) -> float:
    """By how much at the most a ring's radius differs from a circle's at the start [m]."""
    if (made := moving.coordinates[side]) is None:
        return 0.0
    crest = np.abs(made.section[:, RADIALLY] * made.at_start)
    return float(crest[made.harmonic >= _ROUND].sum())


def _sentence(side: str, what: str, moved: float, clearance: float) -> str:
    return (
        f"the {what} of the {side} ring follow its low modes or its seat, not its race: in a run "
        f"they leave out up to {mm(moved)} by which the race bends beside that at the start, "
        f"{moved / clearance:.0%} of the {what}' clearance."
    )
