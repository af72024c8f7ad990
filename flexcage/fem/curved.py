"""Curved ten-node tetrahedra: stiffness, stress, and what is integrated over their faces.

Isoparametric; shape functions and points of integration are scikit-fem's. These integrate cubics,
as a patch of curved elements under a uniform stress wants. Nodes 4 ... 9 lie on the edges 01, 12,
02, 03, 13, 23.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy.sparse as sp
from skfem import ElementTetP2, ElementTriP2
from skfem.quadrature import get_quadrature

from flexcage.fem.elements import BlockPattern, element_size
from flexcage.fem.model import lame
from flexcage.geometry.materials import Material

_CHUNK = 4000  # elements at a time: bounds the memory of dense element matrices


def _shapes(element: object, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Values (n_points, n) and reference slopes (n_points, n, dim) of shape functions."""
    parts = [element.lbasis(points, i) for i in range(element_size(element))]  # type: ignore[attr-defined]
    values = np.stack([np.broadcast_to(v, points.shape[1:]) for v, _ in parts], axis=-1)
    slopes = np.stack([np.asarray(s) for _, s in parts], axis=0)  # (n, dim, n_points)
    return values, slopes.transpose(2, 0, 1)


_POINTS, _WEIGHTS = get_quadrature(ElementTetP2, 3)
_FOUR = get_quadrature(ElementTetP2, 2)[0]  # where stress is taken
# at the corners, from values at the four points: linear through them
_OUTWARDS = np.linalg.inv(np.vstack([1.0 - _FOUR.sum(axis=0), _FOUR]).T)


def _gradients(corners: np.ndarray, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Gradients (n, q, 10, 3) of shape functions of elements whose nodes lie at (n, 10, 3), and the
    determinants (n, q) there."""
    slopes = _shapes(ElementTetP2(), points)[1]
    jacobian = np.einsum("qim,eia->eqam", slopes, corners)
    inverse = np.linalg.inv(jacobian)
    return np.einsum("qim,eqma->eqia", slopes, inverse), np.linalg.det(jacobian)


def curved_stiffness(nodes: np.ndarray, tets: np.ndarray, material: Material) -> sp.csr_matrix:
    """Stiffness (3n, 3n) of curved tetrahedra (m, 10), unknowns by node."""
    first, shear = lame(material)
    pattern = BlockPattern(tets, len(nodes))
    blocks = np.empty((len(tets), 10, 10, 3, 3))
    for start in range(0, len(tets), _CHUNK):
        part = slice(start, start + _CHUNK)
        grad, det = _gradients(nodes[tets[part]], _POINTS)
        weighted = grad * (det * _WEIGHTS)[:, :, None, None]
        flat, other = (g.reshape(len(g), len(_WEIGHTS), 30) for g in (grad, weighted))
        dyad = (flat.transpose(0, 2, 1) @ other).reshape(-1, 10, 3, 10, 3)
        dyad = dyad.transpose(0, 1, 3, 2, 4)  # of i, j: d_a N_i d_b N_j
        blocks[part] = first * dyad + shear * dyad.transpose(0, 1, 2, 4, 3)
        trace = shear * np.einsum("eijaa->eij", dyad)
        for axis in range(3):
            blocks[part, ..., axis, axis] += trace
    return pattern.vector(pattern.sum_blocks(blocks))


def curved_volumes(nodes: np.ndarray, tets: np.ndarray) -> np.ndarray:
    """Volumes (m,) [m^3]; a negative determinant at any point makes NaN."""
    det = _gradients(nodes[tets], _POINTS)[1]
    return np.where((det > 0.0).all(axis=1), det @ _WEIGHTS, np.nan)


def curved_stress(
    nodes: np.ndarray, tets: np.ndarray, material: Material, moved: np.ndarray
) -> np.ndarray:
    """Stress (n, 6) [Pa] at nodes, xx, yy, zz, xy, yz, xz, under displacements (n, 3): that of four
    points an element, linear to the nodes, the mean over elements."""
    first, shear = lame(material)
    total, count = np.zeros((len(nodes), 6)), np.zeros(len(nodes))
    for start in range(0, len(tets), _CHUNK):
        part = tets[start : start + _CHUNK]
        grad = _gradients(nodes[part], _FOUR)[0]
        slope = np.einsum("eia,eqib->eqab", moved[part], grad)
        strain = 0.5 * (slope + slope.swapaxes(2, 3))
        stress = 2.0 * shear * strain
        stress += first * np.trace(strain, axis1=2, axis2=3)[..., None, None] * np.eye(3)
        six = np.stack([stress[..., a, b] for a, b in zip((0, 1, 2, 0, 1, 0), (0, 1, 2, 1, 2, 2))],
                       axis=-1)  # fmt: skip
        corner = np.einsum("cq,eqs->ecs", _OUTWARDS, six)
        ends = np.array([(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)])
        ten = np.concatenate([corner, corner[:, ends].mean(axis=2)], axis=1)
        np.add.at(total, part, ten)
        np.add.at(count, part, 1.0)
    return total / np.maximum(count, 1.0)[:, None]


@dataclass(frozen=True, eq=False)
class FacePoints:
    """Points of integration on curved triangles: places (q, 3), unit normals (q, 3) by the
    triangles' sense, weights (q,) [m^2], and displacement there by that of the nodes (q, n)."""

    places: np.ndarray
    normals: np.ndarray
    weights: np.ndarray
    shapes: sp.csr_matrix


def face_points(nodes: np.ndarray, faces: np.ndarray, degree: int = 4) -> FacePoints:
    """Points of integration on triangles of six nodes (m, 6), corners first, then 01, 12, 20."""
    points, weights = get_quadrature(ElementTriP2, degree)
    values, slopes = _shapes(ElementTriP2(), points)  # of scikit-fem's: mids of 01, 12, 02
    corner = nodes[faces]
    places = np.einsum("qi,eia->eqa", values, corner)
    along = np.einsum("qim,eia->eqma", slopes, corner)
    normal = np.cross(along[:, :, 0], along[:, :, 1])
    size = np.linalg.norm(normal, axis=2)
    rows = np.repeat(np.arange(places.shape[0] * places.shape[1]), 6)
    columns = np.repeat(faces, len(weights), axis=0).ravel()
    data = np.tile(values, (len(faces), 1)).ravel()
    shapes = sp.csr_matrix((data, (rows, columns)), (len(rows) // 6, len(nodes)))
    return FacePoints(
        places.reshape(-1, 3), (normal / size[..., None]).reshape(-1, 3),
        (size * weights).ravel(), shapes,
    )  # fmt: skip
