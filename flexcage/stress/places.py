"""Named places of a cage at which stress is followed, and the zones that a peak leaves out."""

from __future__ import annotations

import numpy as np

from flexcage.fem.model import FEModel
from flexcage.modes.basis import FACES
from flexcage.modes.pockets import face_group, pocket_frame

CORNERS = ("front+x", "front-x", "rear+x", "rear-x")


def root_places(model: FEModel, pocket_count: int) -> dict[str, np.ndarray]:
    """Vertices of ``pocket{k}_root_{front|rear}{+x|-x}``: the fillet at each pocket corner.

    A mesh without fillet groups has the edges there at which a crossbeam and a side face meet.
    """
    places: dict[str, np.ndarray] = {}
    for pocket in range(pocket_count):
        for corner in CORNERS:
            beam, side = corner[:-2], corner[-2:]
            vertices = _fillet_vertices(model, pocket, pocket_count, beam, side)
            if len(vertices):
                places[f"pocket{pocket}_root_{corner}"] = vertices
    return places


def _fillet_vertices(
    model: FEModel, pocket: int, pocket_count: int, beam: str, side: str
) -> np.ndarray:
    fillet = model.groups.get(f"pocket{pocket}_fillet")
    if fillet is None or not len(fillet):
        crossbeam = model.group(f"pocket{pocket}_{beam}")
        return np.intersect1d(crossbeam, model.group(f"pocket{pocket}_side{side}"))
    vertices = np.unique(fillet)
    along, _, across = (model.points[vertices] @ pocket_frame(pocket, pocket_count).T).T
    ahead = across > 0.0 if beam == "front" else across < 0.0
    right = along > 0.0 if side == "+x" else along < 0.0
    return vertices[ahead & right]


def contact_zone(model: FEModel, pocket_count: int) -> np.ndarray:
    """Vertices of the pocket faces less those on fillets (or corner edges, without fillets).

    There the spread contact force acts; the stress right under it is that of the contact law,
    not of the mesh, so peaks leave these vertices out.
    """
    names = [face_group(k, f) for k in range(pocket_count) for f in range(len(FACES))]
    faces = np.concatenate([model.group(name).ravel() for name in names])
    corners = list(root_places(model, pocket_count).values())
    return np.setdiff1d(faces, np.concatenate(corners)) if corners else np.unique(faces)


def in_words(name: str) -> str:
    """A place's name as a reader wants it: "pocket5_root_rear+x" is pocket 5, corner rear +x."""
    pocket, _, corner = name.partition("_root_")
    corner = corner.replace("+", " +").replace("-", " -")
    return f"{pocket.replace('pocket', 'pocket ')}, corner {corner}" if corner else name
