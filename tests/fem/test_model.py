import dataclasses
import pickle

import numpy as np
import pytest
import skfem
from skfem.models.elasticity import lame_parameters, linear_elasticity
from solids import box

from flexcage.core.errors import InputError
from flexcage.fem.linear import linear_solver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.cage_mesh import CageMesh

BRASS = MATERIALS["brass"]


def distorted_box() -> CageMesh:
    mesh = box((2e-3, 1e-3, 1.5e-3), (3, 2, 3))
    points = mesh.points.copy()
    inside = np.all((points > 1e-9) & (points < np.array([2e-3, 1e-3, 1.5e-3]) - 1e-9), axis=1)
    points[inside] += np.random.default_rng(3).uniform(-1e-4, 1e-4, (inside.sum(), 3))
    return CageMesh(points, mesh.tets, mesh.groups)


@pytest.mark.parametrize("order", [1, 2])
def test_patch_test_reproduces_a_constant_strain(order):
    model = assemble(distorted_box(), BRASS, order=order)
    gradient = np.random.default_rng(0).normal(size=(3, 3)) * 1e-3
    exact = (model.nodes @ gradient.T).ravel()
    upper = model.points.max(axis=0)
    on_wall = np.any((model.nodes < 1e-9) | (model.nodes > upper - 1e-9), axis=1)
    held = np.repeat(on_wall, 3)
    free = ~held
    assert free.any()
    rhs = -(model.K[free][:, held] @ exact[held])
    inner = linear_solver(model.K[free][:, free]).solve(rhs)
    np.testing.assert_allclose(inner, exact[free], atol=1e-11 * np.abs(exact).max())


@pytest.mark.parametrize("order", [1, 2])
def test_matrices_equal_scikit_fems(order):
    mesh = distorted_box()
    model = assemble(mesh, BRASS, order=order)
    scalar = skfem.ElementTetP1() if order == 1 else skfem.ElementTetP2()
    fe_mesh = skfem.MeshTet(mesh.points.T.copy(), mesh.tets.T.copy())
    basis = skfem.Basis(fe_mesh, skfem.ElementVector(scalar), intorder=4)
    expected = linear_elasticity(
        *lame_parameters(BRASS.youngs_modulus, BRASS.poisson_ratio)
    ).assemble(basis)
    # the vector element interleaves components per vertex and edge: match dofs by place
    dofs = np.full(model.n_dof, -1)
    for component in range(3):
        own = np.concatenate(
            [basis.nodal_dofs[component]] + ([basis.edge_dofs[component]] if order == 2 else [])
        )
        dofs[component::3] = own
    expected = expected.tocsr()[dofs][:, dofs]
    assert abs(model.K - expected).max() < 1e-12 * abs(expected).max()


@pytest.mark.parametrize("order", [1, 2])
def test_mass_centre_and_inertia_of_a_box(order):
    a, b, c = 2e-3, 1e-3, 1.5e-3
    model = assemble(distorted_box(), BRASS, order=order)
    mass = BRASS.density * a * b * c
    assert model.mass == pytest.approx(mass, rel=1e-13)
    np.testing.assert_allclose(model.centre, [a / 2, b / 2, c / 2], rtol=1e-12)
    expected = mass / 12.0 * np.diag([b * b + c * c, a * a + c * c, a * a + b * b])
    np.testing.assert_allclose(model.inertia, expected, atol=1e-12 * expected.max())


def test_rigid_motions_make_no_force():
    model = assemble(distorted_box(), BRASS)
    force = model.K @ model.rigid_modes
    scale = abs(model.K).max() * np.abs(model.rigid_modes).max()
    assert np.abs(force).max() < 1e-13 * scale
    gram = model.rigid_modes.T @ model.mass_times(model.rigid_modes)
    np.testing.assert_allclose(gram, np.eye(6), atol=1e-12)


def test_modulus_scales_stiffness_only():
    mesh = distorted_box()
    soft = assemble(mesh, BRASS)
    stiff = assemble(mesh, dataclasses.replace(BRASS, youngs_modulus=1e4 * BRASS.youngs_modulus))
    assert abs(stiff.K - 1e4 * soft.K).max() < 1e-12 * abs(stiff.K).max()
    assert abs(stiff.mass_scalar - soft.mass_scalar).max() == 0.0


@pytest.mark.parametrize("order", [1, 2])
def test_face_weights_integrate_displacements_over_a_face(order):
    model = assemble(distorted_box(), BRASS, order=order)
    face = model.group("x1")
    weights = model.face_weights(face, lambda p: np.stack([np.ones(len(p)), p[:, 1]]))
    b, c = 1e-3, 1.5e-3
    np.testing.assert_allclose(weights @ np.ones(len(model.nodes)), [b * c, b * b * c / 2])
    field = 3.0 * model.nodes[:, 1] + model.nodes[:, 2]
    expected = [b * c * (1.5 * b + 0.5 * c), c * b**3 + b * b * c * c / 4]
    np.testing.assert_allclose(weights @ field, expected)


def test_bad_input_is_one_sentence():
    mesh = box((1e-3, 1e-3, 1e-3), (1, 1, 1))
    with pytest.raises(InputError, match="order 3 is not 1 or 2"):
        assemble(mesh, BRASS, order=3)
    flat = CageMesh(mesh.points * [1.0, 1.0, 0.0], mesh.tets, mesh.groups)
    with pytest.raises(InputError, match="is flat"):
        assemble(flat, BRASS)
    with pytest.raises(InputError, match="no surface group 'lid'"):
        assemble(mesh, BRASS).group("lid")


def test_a_model_survives_pickling():
    model = assemble(box((1e-3, 1e-3, 1e-3), (1, 1, 1)), BRASS)
    again = pickle.loads(pickle.dumps(model))
    assert abs(again.K - model.K).max() == 0.0 and set(again.groups) == set(model.groups)


def test_nodes_have_the_same_numbers_whatever_scikit_fem_numbers_edges(monkeypatch):
    """Vertices first, then edges by their vertices: a stored shape refers to these numbers."""
    mesh = distorted_box()
    usual = assemble(mesh, BRASS)
    assert (np.diff(usual.edges[:, 0]) >= 0).all()
    made = skfem.Basis

    class Other(made):
        """A scikit-fem that numbers edges backwards."""

        def __init__(self, fe_mesh, *args, **kwargs):
            super().__init__(fe_mesh, *args, **kwargs)
            last, vertices = self.N - 1, fe_mesh.nvertices
            dofs = self.element_dofs.copy()
            self.other_dofs = np.where(dofs >= vertices, last + vertices - dofs, dofs)

        def __getattribute__(self, name):
            if name == "element_dofs" and "other_dofs" in self.__dict__:
                return self.other_dofs
            if name == "doflocs" and "other_dofs" in self.__dict__:
                return super().__getattribute__(name)[:, self.turned]
            return super().__getattribute__(name)

        @property
        def turned(self):
            vertices = self.mesh.nvertices
            return np.append(np.arange(vertices), np.arange(self.N - 1, vertices - 1, -1))

    backwards = skfem.MeshTet.edges.fget
    monkeypatch.setattr(skfem, "Basis", Other)
    monkeypatch.setattr(
        skfem.MeshTet, "edges", property(lambda self: backwards(self)[:, ::-1]), raising=True
    )
    other = assemble(mesh, BRASS)
    np.testing.assert_array_equal(other.edges, usual.edges)
    np.testing.assert_array_equal(other.cells, usual.cells)
    np.testing.assert_array_equal(other.nodes, usual.nodes)
