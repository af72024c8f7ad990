"""A conical cage for tests, of a bearing of a 30205's kind with few rollers, and its meshes."""

from math import radians

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.conical.cage import ConicalCage
from flexcage.mesh.options import MeshOptions
from flexcage.spec import TaperedRollerBearing

MM = 1e-3
ROLLERS = TaperedRollerBearing(
    bore=12 * MM, outside_diameter=37 * MM, width=16 * MM, inner_width=15 * MM,
    outer_width=13 * MM, contact_angle=radians(15.0), pitch_diameter=25 * MM,
    roller_diameter=6 * MM, roller_length=9 * MM, effective_length=8.4 * MM, roller_count=10,
    rib_height=1.2 * MM, end_radius=50 * MM,
)  # fmt: skip
COUNT = ROLLERS.roller_count
CONE = ConicalCage(
    cone_angle=ROLLERS.axis_angle, pitch_diameter=25 * MM, offset=1.65 * MM, thickness=0.9 * MM,
    small_rim=1.6 * MM, large_rim=2.0 * MM, pocket_length=9.3 * MM, pocket_width_small=5.0 * MM,
    pocket_width_large=6.05 * MM, flank_angle=radians(28.0), fillet_radius=0.3 * MM,
)  # fmt: skip


def cone_mesh(*defects, cage=CONE, count=COUNT, fineness="coarse"):
    return build_cage_mesh(
        cage, pocket_count=count, pitch_diameter=cage.pitch_diameter, defects=defects,
        options=MeshOptions(fineness=fineness),
    )  # fmt: skip
