"""Crown (snap) cages of deep groove ball bearings."""

from __future__ import annotations

from flexcage.cages.cage_type import CageType
from flexcage.cages.crown import slots
from flexcage.cages.crown.cage import CrownCage
from flexcage.cages.crown.defects import (
    BentClaw,
    ClawDefect,
    CrackedClaw,
    CrownDefect,
    MissingClaw,
    WornPocket,
)

# specs that ``flexcage.spec`` shows
__all__ = [
    "BentClaw",
    "ClawDefect",
    "CrackedClaw",
    "CrownCage",
    "CrownDefect",
    "MissingClaw",
    "WornPocket",
]

CAGE_TYPE = CageType(
    name="crown",
    spec=CrownCage,
    holds=("ball",),
    mesh=lambda: slots.mesh,
    interfaces=lambda: slots.interfaces,
    places=lambda: slots.places,
    proposal=lambda: slots.proposal,
    defect_spec=CrownDefect,
    defects=(BentClaw, CrackedClaw, MissingClaw, WornPocket),
    joins=True,
)
