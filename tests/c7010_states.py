"""The 7010C of the chapter, ready to be integrated, and a state that no case can ask for."""

from __future__ import annotations

from functools import cache
from math import pi

import numpy as np

from flexcage.case import Case
from flexcage.compiling import build_bearing
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.stages import cage_mesh
from flexcage.system.problem import BearingSystem
from flexcage.verification.runs import c7010


@cache
def _mesh(pocket: float) -> CageMesh:
    return cage_mesh(c7010().replace("cage.pocket_diameter", pocket))


def bearing_of(case: Case) -> BearingSystem:
    """The case's bearing, ready to be integrated."""
    return build_bearing(case, _mesh(2.0 * case.its_cage.pocket_reach), None)


def balls_on_outer(bearing: BearingSystem) -> tuple[np.ndarray, np.ndarray]:
    """y and y' at rest: balls just touch the outer groove's bottom, in the middle of their pockets;
    the inner groove is opposite, clear of them by half of the radial clearance."""
    model, layout = bearing.data.model, bearing.layout
    y = np.zeros(layout.size)
    q = layout.q(y)
    q["elements"][:, 0] = q["cage"][0] = model.outer.axial
    q["elements"][:, 1] = model.outer.centre + model.outer.radius - model.bodies.radius
    q["elements"][:, 2] = 2.0 * pi * np.arange(layout.elements) / layout.elements
    q["inner"][0] = model.outer.axial - model.inner.axial
    q["quaternion"][0] = 1.0
    return y, np.zeros_like(y)
