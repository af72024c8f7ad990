"""A quarter of one sector of a window cage by gmsh's OpenCASCADE kernel.

In the coordinates of ``sector``, (x, radius/stretch, t), the pocket walls are planes and the fillet
is a cylinder, so that vertices lie exactly on every surface once turned back. Elements become
longer along the radius, along which the stress of a fillet varies slowly: those saved there refine
its arc.
"""

from __future__ import annotations

from math import ceil, pi, sin
from typing import Any

import numpy as np

from flexcage.cages.window.cage import WindowCage
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
    only_cylinder,
    section_prism,
    set_sizes,
    surface_of_ring,
    x_extent,
)

# of the sector's length scale (cube root of its volume): size, size at the fillet; growth of the
# size with distance; edges along a fillet's quarter arc; stretch along the radius. Chosen for
# the N1013's node counts, and medium for the root stress of three cages (tests/README.md).
_NAMED = {
    "coarse": (1.031, 1.031, 1.0, 1, 1.0),
    "medium": (0.55, 0.11, 4.0, 4, 1.35),
    "fine": (0.24, 0.1, 2.0, 5, 1.35),
    "paper": (0.0703, 0.0580, 0.4, 3, 1.0),
}
SURFACES = (*RING_SURFACES, "beam", "side")


def size_plan(cage: WindowCage, pocket_count: int, options: MeshOptions) -> SizePlan:
    """Sizes that a named fineness, or the user's own sizes, mean on this cage."""
    outer, inner = 0.5 * cage.outside_diameter, 0.5 * cage.bore
    ring = pi * (outer**2 - inner**2) * cage.width
    window = cage.pocket_width * cage.pocket_length * (outer - inner)
    scale = (ring / pocket_count - window) ** (1.0 / 3.0)
    far, near, growth, arcs, stretch = _NAMED[options.fineness]
    size, near_fillet = far * scale, near * scale
    if options.size is not None:
        size, near_fillet = options.size, near / far * options.size
    if options.fillet_size is not None:
        arcs = max(1, ceil(0.5 * pi * cage.fillet_radius / options.fillet_size - 1e-9))
        near_fillet = min(near_fillet, 3.0 * options.fillet_size)  # keeps slivers off the arc
        growth = min(growth, 1.0)  # steeper, a finer arc would not bring a better root stress
    radial = max(1, round((outer - inner) / near_fillet))
    return SizePlan(size, near_fillet, growth, arcs, radial, stretch)


def mesh_quarter(
    cage: WindowCage, *, pocket_count: int, options: MeshOptions, joint: bool = False
) -> Quarter:
    """Mesh the quarter sector; lengths go to gmsh in mm, where OpenCASCADE's tolerances fit.
    ``joint``: with ends that meet another half's (``mesh.joint``)."""
    plan = size_plan(cage, pocket_count, options)
    with gmsh_model("flexcage quarter sector") as gmsh:
        _shape(gmsh, cage, pocket_count, plan.stretch)
        fillet = _fillet_surface(gmsh, cage)
        set_sizes(gmsh, plan, fillet)
        if joint:
            set_joint(gmsh, plan, 0.5 * cage.width)
        generate(gmsh, plan)
        points, tets, faces = mesh_arrays(gmsh, plan.stretch)
    surfaces = {
        _surface_name(points[np.unique(triangles)], cage, pocket_count): triangles
        for triangles in faces
    }
    if set(surfaces) != {*SURFACES, "fillet"} or len(faces) != len(surfaces):
        raise RunFailed(f"the quarter sector has unexpected surfaces: {sorted(surfaces)}")
    if joint:
        points = spread_evenly(points, np.unique(surfaces["end"]), pocket_count)
    points[np.unique(surfaces["cut_x"]), 0] = 0.0  # exact, so that mirror images coincide
    points[np.unique(surfaces["cut_z"]), 2] = 0.0
    return Quarter(points, tets, surfaces, plan)


def _shape(gmsh: Any, cage: WindowCage, pocket_count: int, stretch: float) -> None:
    """Quarter of the annular sector, less the filleted window, in (x, radius/stretch, t) [mm]."""
    occ = gmsh.model.occ
    inner, outer = 0.5 * cage.bore / MM, 0.5 * cage.outside_diameter / MM
    width, length, tangential = cage.width / MM, cage.pocket_length / MM, cage.pocket_width / MM
    slope = sin(pi / pocket_count)
    body = section_prism(occ, (inner, outer), slope, 0.5 * width, stretch)
    window = occ.addRectangle(
        -0.5 * length, -0.5 * tangential, 0.0, length, tangential,
        roundedRadius=cage.fillet_radius / MM,
    )  # fmt: skip
    occ.rotate([(2, window)], 0, 0, 0, 1, 0, 0, 0.5 * pi)
    occ.translate([(2, window)], 0.0, 0.5 * inner / stretch, 0.0)
    prism = occ.extrude([(2, window)], 0.0, outer / stretch, 0.0)
    occ.cut(body, [e for e in prism if e[0] == 3])
    occ.synchronize()
    if len(gmsh.model.getEntities(3)) != 1:
        raise RunFailed("the pocket cuts the cage's sector into several pieces")


def _fillet_surface(gmsh: Any, cage: WindowCage) -> int:
    """Tag of the fillet: the one cylinder whose axial extent is its radius."""
    radius = cage.fillet_radius / MM

    def is_fillet(tag: int) -> bool:
        return abs(x_extent(gmsh, 2, tag) - radius) < 1e-3 * radius

    return only_cylinder(gmsh, "fillet surface", is_fillet)


def _surface_name(points: np.ndarray, cage: WindowCage, pocket_count: int) -> str:
    """Which surface of the quarter all these points lie on."""
    own = {
        "beam": points[:, 2] - 0.5 * cage.pocket_width,
        "side": points[:, 0] - 0.5 * cage.pocket_length,
    }
    return surface_of_ring(points, cage, pocket_count, own) or "fillet"
