"""Fixtures of the picture tests."""

from __future__ import annotations

import pytest
from ring_with_pockets import ring_mesh

from flexcage.core.environment import offscreen_backend
from flexcage.mesh.cage_mesh import CageMesh


@pytest.fixture(scope="session")
def ring() -> CageMesh:
    return ring_mesh()


@pytest.fixture
def canvas():
    if offscreen_backend() is None:
        pytest.skip("nothing to draw with on this machine")
