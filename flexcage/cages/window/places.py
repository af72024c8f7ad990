"""Places of window cages: the corners of their pockets, ``pocket{k}_root_{front|rear}{+x|-x}``."""

from __future__ import annotations

import numpy as np

from flexcage.fem.model import FEModel
from flexcage.modes.basis import FACES, CageInterface
from flexcage.modes.pockets import face_group
from flexcage.stress.fillets import Fillet, Keeping, corner_fillets, find_fillets, rounded
from flexcage.stress.places import PlaceKind, StressPlaces

# faces that meet in each corner of a pocket, and its signs of x and psi
_CORNERS: dict[str, tuple[str, str, int, int]] = {
    "front+x": ("front", "side+x", 1, 1),
    "front-x": ("front", "side-x", -1, 1),
    "rear+x": ("rear", "side+x", 1, -1),
    "rear-x": ("rear", "side-x", -1, -1),
}


def _corners(model: FEModel, pocket_count: int) -> dict[str, np.ndarray]:
    """The fillet at each pocket corner; of a mesh without fillet groups the edges there at which a
    crossbeam and a side face meet."""
    places: dict[str, np.ndarray] = {}
    fillets = corner_fillets(model, pocket_count)
    for pocket in range(pocket_count):
        for corner, (beam, side, along, across) in _CORNERS.items():
            if rounded(model, pocket):
                fillet = fillets.get((pocket, along, across), np.empty(0, int))
                vertices = np.unique(fillet)
            else:
                crossbeam = model.group(f"pocket{pocket}_{beam}")
                vertices = np.intersect1d(crossbeam, model.group(f"pocket{pocket}_{side}"))
            if len(vertices):
                places[f"pocket{pocket}_root_{corner}"] = vertices
    return places


def _plane_faces(model: FEModel, pocket_count: int) -> np.ndarray:
    """Vertices of the pockets' walls less those on fillets, or corner edges without fillets."""
    names = [face_group(k, f) for k in range(pocket_count) for f in range(len(FACES))]
    faces = np.concatenate([model.group(name).ravel() for name in names])
    corners = list(_corners(model, pocket_count).values())
    return np.setdiff1d(faces, np.concatenate(corners)) if corners else np.unique(faces)


def _fillets(
    model: FEModel, interface: CageInterface, pocket_count: int, keep: Keeping
) -> list[Fillet]:
    return find_fillets(model, interface.stations, pocket_count, keep=keep)


WINDOW_PLACES = StressPlaces(
    roots=_corners,
    contact_zone=_plane_faces,
    kind=PlaceKind(
        "pocket corner",
        "pocket corners",
        "corners",
        "flat pocket walls",
        "vertices of the flat pocket walls off the fillets",
    ),
    fillets=_fillets,
)
