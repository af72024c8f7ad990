"""A quarter of one sector of a ball cage: a hollow cylinder with round pockets, radially bored.

Meshed in the coordinates of ``sector``, (x, radius/stretch, t): lands and cuts are planes there and
the pocket's wall is a circular cylinder about the radius, so that every vertex of it lies exactly
on it once turned back. The wall is a regular grid: edges along its arc are counted, not sized.
"""

from __future__ import annotations

from math import pi, sin
from typing import Any

import numpy as np

from flexcage.cages.round_pocket.cage import BallCage
from flexcage.core.errors import RunFailed
from flexcage.mesh.gmsh_session import gmsh_model
from flexcage.mesh.joint import set_joint, spread_evenly
from flexcage.mesh.options import MeshOptions
from flexcage.mesh.sector import (
    MM,
    RING_SURFACES,
    Quarter,
    SizePlan,
    generate,
    mesh_arrays,
    named_surfaces,
    only_cylinder,
    section_prism,
    set_sizes,
    surface_of_ring,
)

# of the sector's length scale (cube root of its volume): size, size at the pocket's wall; growth
# of the size with distance; edges along a quarter of the wall; stretch along the radius
_NAMED = {
    "coarse": (0.8, 0.24, 0.6, 5, 2.0),
    "medium": (0.5, 0.16, 0.5, 7, 1.8),
    "fine": (0.28, 0.09, 0.4, 12, 1.5),
    "paper": (0.1, 0.035, 0.2, 24, 1.5),
}
SURFACES = (*RING_SURFACES, "wall")


def ball_size_plan(cage: BallCage, pocket_count: int, options: MeshOptions) -> SizePlan:
    """Sizes that a named fineness, or the user's own sizes, mean on this cage."""
    outer, inner = 0.5 * cage.outside_diameter, 0.5 * cage.bore
    ring = pi * (outer**2 - inner**2) * cage.width
    hole = 0.25 * pi * cage.pocket_diameter**2 * (outer - inner)
    scale = (ring / pocket_count - hole) ** (1.0 / 3.0)
    far, near, growth, arcs, stretch = _NAMED[options.fineness]
    size, at_wall = far * scale, near * scale
    if options.size is not None:
        size, at_wall = options.size, near / far * options.size
        arcs = max(4, round(0.25 * pi * cage.pocket_diameter / (1.3 * options.size)))
    arc = 0.25 * pi * cage.pocket_diameter / arcs
    radial = max(2, round((outer - inner) / (stretch * arc)))
    return SizePlan(size, at_wall, growth, arcs, radial, stretch)


def mesh_ball_quarter(
    cage: BallCage, *, pocket_count: int, options: MeshOptions, tips: tuple[float, ...] = (),
    joint: bool = False,
) -> Quarter:  # fmt: skip
    """Mesh the quarter sector; ``tips`` [m] are axial places of lines of edges in its psi cut.
    ``joint``: with ends that meet another half's (``mesh.joint``)."""
    plan = ball_size_plan(cage, pocket_count, options)
    with gmsh_model("flexcage quarter sector of a ball cage") as gmsh:
        _shape(gmsh, cage, pocket_count, plan.stretch, tips)
        set_sizes(gmsh, plan, only_cylinder(gmsh, "pocket wall"))
        if joint:
            set_joint(gmsh, plan, 0.5 * cage.width)
        generate(gmsh, plan)
        points, tets, faces = mesh_arrays(gmsh, plan.stretch)
    surfaces = named_surfaces(
        faces, points, lambda on: _surface_name(on, cage, pocket_count), SURFACES
    )
    if joint:
        points = spread_evenly(points, np.unique(surfaces["end"]), pocket_count)
    points[np.unique(surfaces["cut_x"]), 0] = 0.0  # exact, so that mirror images coincide
    points[np.unique(surfaces["cut_z"]), 2] = 0.0
    return Quarter(points, tets, surfaces, plan)


def _shape(
    gmsh: Any, cage: BallCage, pocket_count: int, stretch: float, tips: tuple[float, ...]
) -> None:
    """Quarter of the annular sector, less the pocket, in (x, radius/stretch, t) [mm]."""
    occ = gmsh.model.occ
    inner, outer = 0.5 * cage.bore / MM, 0.5 * cage.outside_diameter / MM
    slope = sin(pi / pocket_count)
    body = section_prism(occ, (inner, outer), slope, 0.5 * cage.width / MM, stretch)
    bore = occ.addCylinder(
        0.0, 0.5 * inner / stretch, 0.0, 0.0, outer / stretch, 0.0, 0.5 * cage.pocket_diameter / MM
    )
    occ.cut(body, [(3, bore)])
    lines = []
    for tip in tips:
        ends = [occ.addPoint(tip / MM, r / stretch, slope * r) for r in (inner, outer)]
        lines.append((1, occ.addLine(*ends)))
    if lines:
        occ.fragment(occ.getEntities(3), lines)
    occ.synchronize()
    if len(gmsh.model.getEntities(3)) != 1:
        raise RunFailed("the pocket cuts the cage's sector into several pieces")


def _surface_name(points: np.ndarray, cage: BallCage, pocket_count: int) -> str:
    """Which surface of the quarter all these points lie on."""
    wall = np.hypot(points[:, 0], points[:, 2]) - 0.5 * cage.pocket_diameter
    name = surface_of_ring(points, cage, pocket_count, {"wall": wall})
    if name is None:
        raise RunFailed("a surface of the quarter sector is none that belongs there")
    return name
