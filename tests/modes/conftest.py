"""The small cage of ``modes_cage``, sound and with defects: factored, and reduced by Ritz."""

from __future__ import annotations

import pytest
from modes_cage import DEFECTS, POCKETS, cage_mesh

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.modes.registry import build_basis
from flexcage.modes.spec import ModesSpec


@pytest.fixture(scope="session")
def solver():
    return FreeBodySolver(assemble(cage_mesh(), MATERIALS["brass"]))


@pytest.fixture(scope="session")
def damaged_solver():
    return FreeBodySolver(assemble(cage_mesh(DEFECTS), MATERIALS["brass"]))


@pytest.fixture(scope="session")
def basis(solver):
    return build_basis(solver.model, pocket_count=POCKETS, spec=ModesSpec(), solver=solver)


@pytest.fixture(scope="session")
def damaged_basis(damaged_solver):
    return build_basis(
        damaged_solver.model, pocket_count=POCKETS, spec=ModesSpec(), solver=damaged_solver
    )
