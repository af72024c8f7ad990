"""Equivalent stress in the middles of edges, with which a surface is drawn as it is.

Between two vertices of a quadratic element the stress is linear, but the equivalent stress is not:
where a face bends, its rims bear most and its middle next to nothing. A face one element wide has
no vertex there, only the middles of its edges.
"""

from __future__ import annotations

from math import cos, radians

import numpy as np

from flexcage.fem.model import FEModel
from flexcage.fem.sectors import edge_keys
from flexcage.stress.operators import von_mises

SHARP = radians(35.0)  # faces that meet at more than this have a rim between them


def at_nodes(model: FEModel, stress: np.ndarray) -> np.ndarray:
    """Equivalent stress (N,) [Pa] at all nodes of the model, of stresses (n_points, 6) at its
    vertices: in the middle of an edge that of the mean of its ends."""
    middles = 0.5 * (stress[model.edges[:, 0]] + stress[model.edges[:, 1]])
    return np.concatenate([von_mises(stress), von_mises(middles)])


def largest_at_nodes(
    model: FEModel, largest: np.ndarray, edges: np.ndarray, middles: np.ndarray
) -> np.ndarray:
    """Largest equivalent stresses (N,) [Pa] at all nodes, of those at the vertices (n_points,) and
    in the middles of ``edges`` (n, 2); elsewhere the mean of an edge's ends."""
    values = np.concatenate([largest, largest[model.edges].mean(axis=1)])
    if len(edges):
        values[model.edge_nodes(edges)] = middles
    return values


def edges_across(model: FEModel) -> np.ndarray:
    """Edges (n, 2) that cross a face of the body from rim to rim: no vertex lies between."""
    if model.order == 1:
        return np.empty((0, 2), int)
    triangles = model.surface
    around = np.sort(np.concatenate([triangles[:, p] for p in ([0, 1], [1, 2], [0, 2])]), axis=1)
    order = np.argsort(edge_keys(around, len(model.points)), kind="stable")
    edges = around[order[::2]]  # each is on two triangles
    one, two = order[::2] % len(triangles), order[1::2] % len(triangles)
    normal = _outward(model, triangles)
    flat = (normal[one] * normal[two]).sum(axis=1) > cos(SHARP)
    on_rim = np.zeros(len(model.points), bool)
    on_rim[edges[~flat]] = True
    return edges[flat & on_rim[edges].all(axis=1)]


def _outward(model: FEModel, triangles: np.ndarray) -> np.ndarray:
    """Outward unit normals (n, 3) of the model's boundary triangles."""
    corners = model.points[triangles]
    normal = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    inside = model.points[model.tets[model.surface_cells[0]]].mean(axis=1)
    away = ((corners.mean(axis=1) - inside) * normal).sum(axis=1)
    return normal * (np.sign(away) / np.linalg.norm(normal, axis=1))[:, None]
