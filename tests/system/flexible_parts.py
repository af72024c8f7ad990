"""A synthetic flexible cage for the whole bearing: a ring of points with smooth shapes."""

from __future__ import annotations

import numpy as np
from scipy import sparse

from flexcage.bodies.floating_frame import flexible_body
from flexcage.modes.basis import CageInterface

PITCH, STATIONS, LAND = 41.25e-3, 5, 24


def shapes_at(points, *, modes):
    """Smooth fields (N, 3, modes): ovals in the plane and across it, pairs of sine and cosine."""
    angle = np.arctan2(points[:, 2], points[:, 1])
    ex = np.tile([1.0, 0.0, 0.0], (len(points), 1))
    er = np.stack([0 * angle, np.cos(angle), np.sin(angle)], axis=1)
    et = np.stack([0 * angle, -np.sin(angle), np.cos(angle)], axis=1)
    fields = []
    for k in range(modes):
        n, phase = 2 + k // 4, np.pi / 2 * (k % 2)
        c, s = np.cos(n * angle - phase)[:, None], np.sin(n * angle - phase)[:, None]
        fields.append(c * er - s / n * et if k % 4 < 2 else c * ex)
    return np.stack(fields, axis=2) * 3.0 if fields else np.zeros((len(points), 3, 0))


def flexible_cage(*, modes=6, stiffer=1.0, soft=False, mass=0.09):
    """(body, interface) of a cage of the N1013's size; frequencies from about 0.9 kHz."""
    angle = 2 * np.pi * np.arange(60) / 60
    ring = [
        np.stack([np.full(60, x), PITCH * np.cos(angle), PITCH * np.sin(angle)], axis=1)
        for x in (-7e-3, 0.0, 7e-3)
    ]
    points = np.concatenate(ring)
    each = sparse.diags(np.full(len(points), mass / len(points))).tocsr()
    shapes = shapes_at(points, modes=modes)
    m = np.einsum("aik,ail->kl", shapes, shapes) * mass / len(points)
    w = 2 * np.pi * 900.0 * (1.0 + 0.8 * np.arange(modes)) * np.sqrt(stiffer)
    stiffness, damping = np.outer(w, w) * m, 2 * 0.01 * np.sqrt(np.outer(w, w)) * m
    body = flexible_body(points, each, shapes, stiffness, damping)
    return body, _interface(modes, soft)


def _interface(modes, soft):
    at = np.linspace(-4e-3, 4e-3, STATIONS)
    phi = np.zeros((22, 4, STATIONS, 3, modes))
    for z in range(22):
        a = 2 * np.pi * z / 22
        frame = np.array([[1, 0, 0], [0, np.cos(a), np.sin(a)], [0, -np.sin(a), np.cos(a)]])
        for f in range(4):
            side = (1.0 if f % 2 == 0 else -1.0) * 4.1e-3
            local = np.full((STATIONS, 3), PITCH)
            local[:, 0], local[:, 2] = (at, side) if f < 2 else (side, at)
            phi[z, f] = np.einsum("ij,sjm->sim", frame, shapes_at(local @ frame, modes=modes))
    residual, compliance = np.zeros((22, 4, STATIONS, 12)), np.zeros((22, 12, 12))
    if soft:
        for f in range(4):
            residual[:, f, :, 2 * f], residual[:, f, :, 2 * f + 1] = 1.0, at / 4e-3
            residual[:, f, :, 8 + f] = 1.5 * (at / 4e-3) ** 2 - 0.5
        compliance[:] = np.diag([2e-8, 1e-8] * 4 + [6e-9] * 4)
    angle = 2 * np.pi * np.arange(LAND) / LAND
    land = np.zeros((2, LAND, 3, modes))
    er = np.stack([0 * angle, np.cos(angle), np.sin(angle)], axis=1)
    for k, radius in enumerate((39.45e-3, 43.3e-3)):
        land[k, :, 1] = np.einsum("ac,acm->am", er, shapes_at(radius * er, modes=modes))
    return CageInterface(
        stations=np.stack([at] * 4), offset=np.zeros((22, 4, STATIONS)), modes=phi,
        residual=residual, compliance=compliance, patch_half_width=1.9e-3, land=land,
    )  # fmt: skip
