"""Places of cages with round pockets: the surface of the thinnest sections.

``pocket{k}_waist_{front|rear}`` is towards the next pockets, ``pocket{k}_rim{+x|-x}`` towards the
ends.
"""

from __future__ import annotations

import numpy as np

from flexcage.fem.model import FEModel
from flexcage.modes.lands import LANDS
from flexcage.modes.pockets import pocket_frame
from flexcage.stress.places import PlaceKind, StressPlaces

SECTIONS = ("waist_front", "rim+x", "waist_rear", "rim-x")  # by quarters of a turn from +psi


def _sections(model: FEModel, pocket_count: int) -> dict[str, np.ndarray]:
    """Surface vertices of a sector in an eighth of a turn about the pocket's axis each."""
    surface = np.setdiff1d(model.surface, round_walls(model, pocket_count))
    places: dict[str, np.ndarray] = {}
    for pocket in range(pocket_count):
        x, r, t = (model.points[surface] @ pocket_frame(pocket, pocket_count).T).T
        wall = model.points[np.unique(model.group(f"pocket{pocket}_wall")), 0]
        angle = np.arctan2(x - 0.5 * (wall.max() + wall.min()), t)
        own = np.abs(np.arctan2(t, r)) < np.pi / pocket_count * (1.0 + 1e-9)
        for name, middle in zip(SECTIONS, 0.5 * np.pi * np.arange(4)):
            near = np.abs((angle - middle + np.pi) % (2.0 * np.pi) - np.pi) < np.pi / 8.0
            places[f"pocket{pocket}_{name}"] = surface[own & near]
    return places


def round_walls(model: FEModel, pocket_count: int) -> np.ndarray:
    """Vertices of the pockets' walls less those on the edges with the lands."""
    walls = [model.group(f"pocket{k}_wall").ravel() for k in range(pocket_count)]
    edges = [model.group(name).ravel() for name in LANDS]
    return np.setdiff1d(np.concatenate(walls), np.concatenate(edges))


ROUND_PLACES = StressPlaces(
    roots=_sections,
    contact_zone=round_walls,
    kind=PlaceKind(
        "waist or rim",
        "waists and rims of pockets",
        "waists and rims",
        "pocket walls",
        "vertices of the pockets' walls off their edges",
    ),
)
