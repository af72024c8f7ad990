"""The N1013 of the chapter, ready to be integrated, and states that no case can ask for."""

from __future__ import annotations

from functools import cache

import numpy as np

from flexcage.case import Case
from flexcage.compiling import build_bearing
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.reduction import CageReduction
from flexcage.modes.spec import ModesSpec
from flexcage.stages import cage_mesh, cage_reduction
from flexcage.system.problem import BearingSystem
from flexcage.verification.runs import n1013


def cage_of(case: Case) -> tuple[CageMesh, CageReduction]:
    """Mesh and flexible reduction of a case's cage, made once for all cases with that cage."""
    plain = _plain(case, case.modes)
    return _mesh(_plain(case)), _reduction(plain)


def bearing_of(case: Case) -> BearingSystem:
    """The case's bearing, ready to be integrated."""
    flexible = case.cage_model == "flexible"
    return build_bearing(case, _mesh(_plain(case)), cage_of(case)[1] if flexible else None)


def _plain(case: Case, modes: ModesSpec | None = None) -> Case:
    """A case with the same cage, and nothing else that differs from the preset."""
    return Case(
        bearing=case.bearing, cage=case.cage, defects=case.all_defects, mesh=case.mesh,
        modes=modes or ModesSpec(), contacts=n1013().contacts,
    )  # fmt: skip


@cache
def _mesh(plain: Case) -> CageMesh:
    return cage_mesh(plain)


@cache
def _reduction(plain: Case) -> CageReduction:
    reduction = cage_reduction(plain, _mesh(plain.replace("modes", ModesSpec())))
    assert reduction is not None
    return reduction


def state_at_rest(bearing: BearingSystem) -> tuple[np.ndarray, np.ndarray]:
    """y and y' with every roller in the middle of its pocket and of the races, nothing moving."""
    model, layout = bearing.data.model, bearing.layout
    y = np.zeros(layout.size)
    q = layout.q(y)
    q["elements"][:, 1] = 0.5 * (model.inner.radius + model.outer.radius)
    q["elements"][:, 2] = 2.0 * np.pi * np.arange(layout.elements) / layout.elements
    q["quaternion"][0] = 1.0
    return y, np.zeros_like(y)


def throw_cage(
    bearing: BearingSystem, y: np.ndarray, yd: np.ndarray, speed: float, direction: float
) -> None:
    """Give the cage a speed [m/s] across the axis, at an azimuth [rad]."""
    for part in (bearing.layout.u(y)["cage"], bearing.layout.q(yd)["cage"]):
        part[1:] = speed * np.cos(direction), speed * np.sin(direction)
