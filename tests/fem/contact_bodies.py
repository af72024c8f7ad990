"""Concentric and stacked rings that touch, with known answers."""

from __future__ import annotations

import numpy as np

from flexcage.fem.contact import ContactProblem, Touching
from flexcage.fem.curved import curved_stiffness, face_points
from flexcage.fem.separation import SeparationModel
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.revolved import HalfPlane, RevolvedBodies, revolved

STEEL = MATERIALS["steel"]


def grid(radii, heights, body, first):
    """Vertices and triangles of a grid in the half-plane."""
    r, x = np.meshgrid(radii, heights, indexing="ij")
    vertices = np.stack([r.ravel(), x.ravel()], axis=1)
    number = first + np.arange(r.size).reshape(r.shape)
    a, b, c, d = number[:-1, :-1], number[1:, :-1], number[1:, 1:], number[:-1, 1:]
    triangles = np.concatenate([
        np.stack([v.ravel() for v in t], axis=1) for t in ((a, b, c), (a, c, d))
    ])  # fmt: skip
    return vertices, triangles, np.full(len(triangles), body), number


def sleeve_on_shaft(radii, heights, sectors) -> RevolvedBodies:
    """A shaft of ``radii[0]`` in a sleeve of ``radii[1]``, which share a radius."""
    inner = grid(radii[0], heights, 0, 0)
    outer = grid(radii[1], heights, 1, inner[3].size)
    shared = inner[3][-1]
    swap = np.arange(inner[3].size + outer[3].size)
    swap[outer[3][0]] = shared  # one vertex of the section for both
    curves = {
        "fit": np.stack([shared[:-1], shared[1:]], axis=1),
        "end": np.stack([inner[3][:-1, -1], inner[3][1:, -1]], axis=1),
    }
    section = HalfPlane(
        np.vstack([inner[0], outer[0]]), swap[np.vstack([inner[1], outer[1]])],
        np.concatenate([inner[2], outer[2]]), {}, curves,
    )  # fmt: skip
    return revolved(section, sectors)


def stacked(radii, heights, sectors) -> RevolvedBodies:
    """Two discs on each other at x = 0."""
    lower = grid(radii, -np.asarray(heights)[::-1], 0, 0)
    upper = grid(radii, heights, 1, lower[3].size)
    swap = np.arange(lower[3].size + upper[3].size)
    swap[upper[3][:, 0]] = lower[3][:, -1]
    face, top, base = lower[3][:, -1], upper[3][:, -1], lower[3][:, 0]
    curves = {
        name: np.stack([line[:-1], line[1:]], axis=1)
        for name, line in (("fit", face), ("end", top), ("base", base))
    }
    section = HalfPlane(
        np.vstack([lower[0], upper[0]]), swap[np.vstack([lower[1], upper[1]])],
        np.concatenate([lower[2], upper[2]]), {}, curves,
    )  # fmt: skip
    return revolved(section, sectors)


def problem(bodies: RevolvedBodies, friction: float, held: np.ndarray, penalty=1e16, springs=1.0):
    """The contact of the curve "fit", body 0 first."""
    faces = bodies.faces["fit", 0]
    pair = Touching("fit", faces, bodies.faces["fit", 1], bodies.behind(0, faces), friction)
    K = curved_stiffness(bodies.nodes, bodies.tets, STEEL)
    surfaces = [(faces, bodies.faces["fit", 1])]
    parted = SeparationModel(K, bodies.nodes, bodies.tets, surfaces, held, springs=springs)
    return ContactProblem(parted, [pair], penalty=penalty)


def loads_on(bodies: RevolvedBodies, faces: np.ndarray, traction) -> np.ndarray:
    """Nodal loads (n, 3) of a traction(places) (q, 3) on faces."""
    points = face_points(bodies.nodes, faces)
    return points.shapes.T @ (points.weights[:, None] * traction(points.places))
