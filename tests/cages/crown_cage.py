"""The crown cage of a 6205 that tests share, and its case."""

from __future__ import annotations

from functools import cache

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.crown.cage import CrownCage
from flexcage.case import load_case
from flexcage.mesh.options import MeshOptions

Z, PITCH, MM = 9, 38.5e-3, 1e-3
CAGE = CrownCage(
    bore=34.93 * MM, outside_diameter=42.07 * MM, width=7.7 * MM, pocket_diameter=8.17 * MM,
    throat=7.3 * MM, claw_thickness=1.03 * MM,
)  # fmt: skip
BEARING = {
    "type": "deep_groove_ball", "designation": "6205", "bore": "25 mm",
    "outside_diameter": "52 mm", "width": "15 mm", "pitch_diameter": "38.5 mm",
    "ball_diameter": "7.938 mm", "ball_count": 9, "inner_groove_radius": "4.0881 mm",
    "outer_groove_radius": "4.1675 mm", "inner_shoulder": "1.3495 mm",
    "outer_shoulder": "1.3495 mm", "radial_clearance": "10 um",
}  # fmt: skip
CROWN = {
    "type": "crown", "bore": "34.93 mm", "outside_diameter": "42.07 mm", "width": "7.7 mm",
    "pocket_diameter": "8.17 mm", "throat": "7.3 mm", "claw_thickness": "1.03 mm",
}  # fmt: skip
BASE = {
    "bearing": BEARING, "cage": {**CROWN, "model": "flexible"}, "mesh": {"fineness": "coarse"},
    "drive": {"speed": "9000 rpm"}, "load": {"radial": "300 N"}, "solver": {"duration": "6 ms"},
}  # fmt: skip


def crown(overrides=None, **tables):
    return load_case(BASE | tables, overrides=overrides or {})


@cache
def mesh_of(cage=CAGE, fineness="coarse", defects=()):
    return build_cage_mesh(
        cage, pocket_count=Z, pitch_diameter=PITCH, defects=defects,
        options=MeshOptions(fineness=fineness),
    )  # fmt: skip
