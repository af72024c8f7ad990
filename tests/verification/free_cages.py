"""Momentum of cages that nothing holds."""

from __future__ import annotations

from typing import Any

import numpy as np
from free_motion import momentum_by_nodes
from scipy.spatial.transform import Rotation

from flexcage.modes.reduction import CageReduction
from flexcage.system.problem import BearingSystem
from flexcage.verification import Tolerance

TURNED = Tolerance(
    2e-7, "share of the first; falls with solver.tolerance, 1e-5 at 0.001 um", absolute=True
)


def of_rigid_cage(bearing: BearingSystem, ds: Any) -> tuple[np.ndarray, np.ndarray]:
    """Momentum across the axis (time, 2) [kg m/s] and angular momentum about it (time,) of a rigid
    cage."""
    cage = bearing.data.model.cage
    at, v = (ds[f"cage_{what}"].values[:, 1:] for what in ("position", "velocity"))
    inertia = np.trace(cage.G0) * np.eye(3) - cage.G0
    attitude = Rotation.from_quat(ds["cage_quaternion"].values, scalar_first=True)
    own = attitude.apply(ds["cage_omega"].values @ inertia)[:, 0]
    return cage.mass * v, cage.mass * (at[:, 0] * v[:, 1] - at[:, 1] * v[:, 0]) + own


def of_flexible_cage(cage: CageReduction, ds: Any) -> tuple[np.ndarray, np.ndarray]:
    """The same of a flexible cage, from its mesh."""
    model, shapes = cage.model, cage.basis.shapes
    linear, angular = momentum_by_nodes(ds, model.nodes, shapes, model.mass_scalar)
    return linear[:, 1:], angular[:, 0]
