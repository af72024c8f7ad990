"""Free bodies of modes, as free-free reduction writes them: any basis, rounding, lumped masses."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
import scipy.sparse as sp
from exchange_bodies import box, full
from modes_cage import POCKETS, cage_mesh
from scipy.linalg import eigh

from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.modes.exchange.body import MODAL, ReducedBody
from flexcage.modes.exchange.cage import body_of
from flexcage.modes.exchange.checks import check_body, check_free, elastic_modes
from flexcage.modes.registry import basis_of_body, build_basis
from flexcage.modes.spec import ModesSpec

COUNT = 40
ROUNDING = (-0.05, 0.01, 0.0, 0.05, -0.02, 0.03)  # squared frequencies of rigid modes, a solver's
RNG = np.random.default_rng(7)
TURN = np.linalg.qr(RNG.standard_normal((COUNT, COUNT)))[0]
SCALE = np.diag(10.0 ** RNG.uniform(-3.0, 3.0, COUNT))


@pytest.fixture(scope="module")
def model():
    return box()


@pytest.fixture(scope="module")
def modes(model):
    """Squared frequencies (40,) and mass-normalised modes (3N, 40) of a free block: its first
    elastic one is at 61.6 kHz."""
    values, shapes = eigh(*full(model).dense())
    return values[:COUNT], shapes[:, :COUNT]


def in_basis(model, values, shapes, turn):
    """The body of modes in the basis ``turn`` of its coordinates, matrices as one would write."""
    return ReducedBody(
        stiffness=turn.T @ np.diag(values) @ turn,
        mass=turn.T @ turn,
        nodes=model.nodes,
        dofs=np.tile([MODAL, 0], (COUNT, 1)),
        shapes=(shapes @ turn).reshape(-1, 3, COUNT),
        source="block.npz",
    )


def checked(body):
    check_body(body, where="body")
    check_free(body, where="body")
    return elastic_modes(body, where="body")[0]


BASES = {"plain": np.eye(COUNT), "turned": TURN, "of any length": SCALE}


@pytest.mark.parametrize("name", BASES)
def test_free_modes_are_accepted_in_any_basis(model, modes, name):
    values, shapes = modes
    rounded = np.concatenate([ROUNDING, values[6:]])
    found = checked(in_basis(model, rounded, shapes, BASES[name]))
    np.testing.assert_allclose(found, values[6:], rtol=1e-8)


def test_free_modes_in_single_precision(model, modes):
    """As binary OUTPUT4 files of one word a number hold them."""
    values, shapes = modes
    body = in_basis(model, np.concatenate([ROUNDING, values[6:]]), shapes, TURN)
    short = {
        n: getattr(body, n).astype(np.float32).astype(float)
        for n in ("stiffness", "mass", "shapes")
    }
    np.testing.assert_allclose(checked(dataclasses.replace(body, **short)), values[6:], rtol=1e-5)


@pytest.mark.parametrize("name", BASES)
def test_a_negative_mode_is_told_with_its_own_ratio(model, modes, name):
    values, shapes = modes
    values = np.where(np.arange(COUNT) == 10, -values, values)
    body = in_basis(model, values, shapes, BASES[name])
    ratio = values[10] / values[-1]
    assert -0.1 < ratio < -0.05
    with pytest.raises(InputError, match=f"1 of its 40 .* down to {ratio:.1e} of the largest"):
        check_body(body, where="body")


@pytest.mark.parametrize("name", BASES)
def test_modes_on_springs_are_held(model, modes, name):
    """A body that bounces at 1 kHz, 60 times slower than its first elastic mode."""
    values, shapes = modes
    values = np.concatenate([np.full(6, (2e3 * np.pi) ** 2), values[6:]])
    with pytest.raises(
        InputError, match=r"frequency of 1e\+03 Hz, and its lowest elastic .* 6.156"
    ):
        check_free(in_basis(model, values, shapes, BASES[name]), where="body")


@pytest.mark.parametrize("sign", ["whole", "one"])
def test_a_sparse_stiffness_of_negative_sign_is_told(model, sign):
    body = full(model)
    turned = sp.diags_array(np.where(np.arange(body.size) == 5, -1.0, 1.0))
    stiffness = -sp.csr_matrix(body.stiffness)
    words = "stiffness matrix is not positive semi-definite: its whole diagonal is negative"
    if sign == "one":
        stiffness = sp.csr_matrix(body.stiffness @ turned + turned @ body.stiffness)
        words = "1 of the 81 numbers on its diagonal are negative, the lowest, .*, in row 6"
    with pytest.raises(InputError, match=words):
        check_body(dataclasses.replace(body, stiffness=stiffness), where="body")


# --- lumped masses -------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def linear():
    return FreeBodySolver(assemble(cage_mesh(), MATERIALS["brass"], order=1))


@pytest.fixture(scope="module")
def free(linear):
    """Sixty free modes of the cage with consistent masses."""
    solver, spec = linear, ModesSpec(kind="free_free", count=60)
    basis = build_basis(solver.model, pocket_count=POCKETS, spec=spec, solver=solver)
    return dataclasses.replace(body_of(basis, solver.model), kind=(), source="cage.npz")


def lumped(body, model):
    """The same modes weighed by the row sums of the consistent mass."""
    masses = np.asarray(model.mass_scalar.sum(axis=1)).ravel()
    flat = body.shapes.reshape(len(masses), -1)
    weighed = (masses[:, None] * flat).reshape(model.n_dof, -1)
    return dataclasses.replace(body, mass=body.shapes.reshape(model.n_dof, -1).T @ weighed)


def test_lumped_masses_are_accepted_with_their_number(linear, free):
    """The farthest mode's ratio by dense algebra beside what the basis tells."""
    body = lumped(free, linear.model)
    values, turns = eigh(body.dense()[0], body.mass)
    flat = free.shapes.reshape(linear.model.n_dof, -1) @ turns
    ratio = 1.0 / np.einsum("ij,ij->j", flat, linear.model.mass_times(flat))
    wanted = ratio[np.argmax(np.abs(ratio - 1.0))]
    assert abs(wanted - 1.0) > 0.02, "beyond what was refused"
    back = basis_of_body(body, linear, pocket_count=POCKETS, spec=ModesSpec(dynamic="all"))
    assert back.fit.mass == pytest.approx(wanted, rel=1e-9)
    np.testing.assert_allclose((2 * np.pi * back.frequencies) ** 2, values, rtol=1e-9)


def test_another_density_is_no_lumped_mass(linear, free):
    """All modes of a file without rigid motions, whose mass would tell."""
    with pytest.raises(InputError, match="the mass of mode .* give cage.material the body's dens"):
        heavy = dataclasses.replace(free, mass=0.93 * free.mass)
        basis_of_body(heavy, linear, pocket_count=POCKETS, spec=ModesSpec())
