"""Named places of a cage at which stress is followed, and the zones that a peak leaves out."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np

from flexcage.fem.model import FEModel
from flexcage.mesh.cage_mesh import POCKET_GROUPS, WALL_GROUPS, pocket_groups
from flexcage.modes.basis import FACES
from flexcage.modes.lands import LANDS
from flexcage.modes.pockets import face_group, pocket_frame

# faces that meet in each corner of a pocket, and its signs of x and psi
_CORNERS: dict[str, tuple[str, str, int, int]] = {
    "front+x": ("front", "side+x", 1, 1),
    "front-x": ("front", "side-x", -1, 1),
    "rear+x": ("rear", "side+x", 1, -1),
    "rear-x": ("rear", "side-x", -1, -1),
}
CORNERS = tuple(_CORNERS)
SECTIONS = ("waist_front", "rim+x", "waist_rear", "rim-x")  # by quarters of a turn from +psi


def root_places(model: FEModel, pocket_count: int) -> dict[str, np.ndarray]:
    """Vertices of every named place.

    Window cages: ``pocket{k}_root_{front|rear}{+x|-x}``, the fillet at each pocket corner; a mesh
    without fillet groups has the edges there at which a crossbeam and a side face meet. Round
    pockets: ``pocket{k}_waist_{front|rear}`` and ``pocket{k}_rim{+x|-x}``, the surface of the
    thinnest sections, towards the next pockets and towards the ends.
    """
    return _PLACES[pocket_groups(model.groups)](model, pocket_count)


def _corners(model: FEModel, pocket_count: int) -> dict[str, np.ndarray]:
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


def _sections(model: FEModel, pocket_count: int) -> dict[str, np.ndarray]:
    """Surface vertices of a sector in an eighth of a turn about the pocket's axis each."""
    surface = np.setdiff1d(model.surface, contact_zone(model, pocket_count))
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


def rounded(model: FEModel, pocket: int) -> bool:
    """Has the mesh a group of the fillets at this pocket's corners?"""
    return bool(len(model.groups.get(f"pocket{pocket}_fillet", ())))


def corner_fillets(model: FEModel, pocket_count: int) -> dict[tuple[int, int, int], np.ndarray]:
    """Triangles (n, 3) of the fillet at every pocket corner, by pocket and signs of x and psi; none
    where a mesh has no fillet groups."""
    found: dict[tuple[int, int, int], np.ndarray] = {}
    for pocket in range(pocket_count):
        if not rounded(model, pocket):
            continue
        fillet = model.groups[f"pocket{pocket}_fillet"]
        along, _, across = (
            model.points[fillet].mean(axis=1) @ pocket_frame(pocket, pocket_count).T
        ).T
        for _, _, right, ahead in _CORNERS.values():
            own = (along * right > 0.0) & (across * ahead > 0.0)
            if own.any():
                found[pocket, right, ahead] = fillet[own]
    return found


def contact_zone(model: FEModel, pocket_count: int) -> np.ndarray:
    """Vertices of the pockets' walls less those on fillets (or corner edges, without fillets).

    Round pockets: less those on the edges with the lands. There the spread contact force acts; the
    stress right under it is that of the contact law, not of the mesh, so peaks leave these vertices
    out: all of them at all times, wherever the contacts are.
    """
    return _ZONES[pocket_groups(model.groups)](model, pocket_count)


def _plane_faces(model: FEModel, pocket_count: int) -> np.ndarray:
    names = [face_group(k, f) for k in range(pocket_count) for f in range(len(FACES))]
    faces = np.concatenate([model.group(name).ravel() for name in names])
    corners = list(_corners(model, pocket_count).values())
    return np.setdiff1d(faces, np.concatenate(corners)) if corners else np.unique(faces)


def _round_walls(model: FEModel, pocket_count: int) -> np.ndarray:
    walls = [model.group(f"pocket{k}_wall").ravel() for k in range(pocket_count)]
    edges = [model.group(name).ravel() for name in LANDS]
    return np.setdiff1d(np.concatenate(walls), np.concatenate(edges))


_PLACES = {POCKET_GROUPS: _corners, WALL_GROUPS: _sections}
_ZONES = {POCKET_GROUPS: _plane_faces, WALL_GROUPS: _round_walls}


@dataclass(frozen=True)
class PlaceKind:
    """What the places at which a cage's stress is followed are called."""

    one: str
    many: str
    short: str  # many of them, in few words
    walls: str  # what the search for a peak leaves out, in few words
    left_out: str  # the same, exactly: see ``contact_zone``


_KINDS = {
    POCKET_GROUPS: PlaceKind(
        "pocket corner",
        "pocket corners",
        "corners",
        "flat pocket walls",
        "vertices of the flat pocket walls off the fillets",
    ),
    WALL_GROUPS: PlaceKind(
        "waist or rim",
        "waists and rims of pockets",
        "waists and rims",
        "pocket walls",
        "vertices of the pockets' walls off their edges",
    ),
}


def place_kind(groups: Iterable[str]) -> PlaceKind:
    """What the places of a cage whose mesh has these groups are called."""
    return _KINDS[pocket_groups(groups)]


def in_words(name: str) -> str:
    """A place's name as a reader wants it: "pocket5_root_rear+x" is pocket 5, corner rear +x."""
    pocket, _, place = name.partition("_")
    place = place.replace("root_", "corner ").replace("_", " ")
    place = place.replace("+x", " +x").replace("-x", " -x")
    return f"{pocket.replace('pocket', 'pocket ')}, {place}" if place else name
