"""Places of crown cages: where their sections are thin or bend.

``pocket{k}_ring`` is the ring under the pocket, its thinnest section;
``pocket{k}_bar_{front|rear}`` the foot of the bar beside it, on the lands;
``pocket{k}_claw_{front|rear}`` the claw's outside with its root on the bar;
``pocket{k}_tip_{front|rear}`` its tip.
"""

from __future__ import annotations

import numpy as np

from flexcage.cages.round_pocket.places import round_walls
from flexcage.fem.model import FEModel
from flexcage.modes.lands import LANDS
from flexcage.modes.pockets import pocket_frame
from flexcage.stress.places import PlaceKind, StressPlaces

_UNDER = 0.5  # of the pocket's radius: half the breadth of the ring under it


def _sections(model: FEModel, pocket_count: int) -> dict[str, np.ndarray]:
    surface = np.setdiff1d(model.surface, round_walls(model, pocket_count))
    tips = np.isin(surface, model.group("end+x"))
    lands = np.isin(surface, np.concatenate([model.group(name).ravel() for name in LANDS]))
    behind = np.isin(surface, model.group("end-x"))
    places: dict[str, np.ndarray] = {}
    for pocket in range(pocket_count):
        x, r, t = (model.points[surface] @ pocket_frame(pocket, pocket_count).T).T
        radius = -float(model.points[np.unique(model.group(f"pocket{pocket}_wall")), 0].min())
        own = np.abs(np.arctan2(t, r)) < np.pi / pocket_count * (1.0 + 1e-9)
        narrow = np.abs(t) < _UNDER * radius
        places[f"pocket{pocket}_ring"] = surface[own & narrow & (x < -_UNDER * radius)]
        parts = {"bar": lands & ~narrow & (x < 0.0), "claw": ~lands & ~behind & ~tips, "tip": tips}
        for side, sign in (("front", 1.0), ("rear", -1.0)):
            for part, on in parts.items():
                places[f"pocket{pocket}_{part}_{side}"] = surface[own & on & (sign * t > 0.0)]
    return places


CROWN_PLACES = StressPlaces(
    roots=_sections,
    contact_zone=round_walls,
    kind=PlaceKind(
        "ring, bar or claw",
        "ring, bars, claws and tips",
        "rings, bars and claws",
        "pocket walls",
        "vertices of the pockets' walls off their edges with the lands",
    ),
)
