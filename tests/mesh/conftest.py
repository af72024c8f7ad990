"""The N1013 cage of the presets, and its meshes, each built once."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache

import pytest

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.window.cage import WindowCage
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.options import MeshOptions

PITCH_DIAMETER = 82.5e-3
POCKETS = 22
CAGE = WindowCage(
    bore=78.9e-3,
    outside_diameter=86.6e-3,
    width=16e-3,
    pocket_width=8.2e-3,
    pocket_length=8.25e-3,
    fillet_radius=0.5e-3,
)


@dataclass(frozen=True)
class Maker:
    """Builds meshes of the N1013 cage; ``cage`` and ``pitch_radius`` are what they are made of."""

    cage: WindowCage = CAGE
    pocket_count: int = POCKETS
    pitch_diameter: float = PITCH_DIAMETER
    pitch_radius: float = 0.5 * PITCH_DIAMETER

    def __call__(self, *defects, **options) -> CageMesh:
        return _built(defects, MeshOptions(**options))


@cache
def _built(defects, options) -> CageMesh:
    return build_cage_mesh(
        CAGE, pocket_count=POCKETS, pitch_diameter=PITCH_DIAMETER, defects=defects, options=options
    )


@pytest.fixture(scope="session")
def n1013() -> Maker:
    return Maker()
