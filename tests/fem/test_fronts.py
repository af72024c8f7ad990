"""Elimination by dense fronts and its order, against dense linear algebra."""

import numpy as np
import pytest
import scipy.sparse as sp
from solids import box

from flexcage.core.errors import RunFailed
from flexcage.fem.dissection import dissect
from flexcage.fem.fronts import Elimination
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS

LEFT = 15  # unknowns that are not eliminated


@pytest.fixture(scope="module")
def ordered():
    """A stiff sparse matrix in an order of elimination, and its blocks but for what is left."""
    model = assemble(box((8e-3, 3e-3, 2e-3), (8, 3, 2)), MATERIALS["brass"])
    matrix = (model.K + 1e10 * sp.kron(model.mass_scalar, sp.eye(3))).tocsr()
    middles = model.points[model.tets].mean(axis=1)
    blocks = dissect(middles, model.cells, np.arange(LEFT // 3, len(model.nodes)))
    nodes = np.concatenate([LEFT // 3 + np.concatenate(blocks), np.arange(LEFT // 3)])
    order = (3 * nodes[:, None] + np.arange(3)).ravel()
    return sp.csr_matrix(matrix[order][:, order]), [3 * len(block) for block in blocks]


def test_separators_part_what_they_should():
    model = assemble(box((8e-3, 3e-3, 2e-3), (8, 3, 2)), MATERIALS["brass"])
    every = np.arange(len(model.nodes))
    blocks = dissect(model.points[model.tets].mean(axis=1), model.cells, every)
    np.testing.assert_array_equal(np.sort(np.concatenate(blocks)), np.arange(len(model.nodes)))
    last = blocks[-1]  # without it the body falls apart
    rest = np.setdiff1d(np.arange(len(model.nodes)), last)
    pieces, _ = sp.csgraph.connected_components(model.mass_scalar[rest][:, rest])
    assert len(last) < 0.1 * len(model.nodes) and pieces == 2


def test_elimination_is_the_dense_solution(ordered):
    matrix, blocks = ordered
    dense, n = matrix.toarray(), sum(blocks)
    extra = np.diag(np.arange(1.0, 5.0)) * dense[0, 0]
    more = (np.array([1, 7, n - 1, n + 2]), extra)
    dense[np.ix_(more[0], more[0])] += extra
    elimination = Elimination(matrix, blocks, [more])
    inner = np.linalg.solve(dense[:n, :n], dense[:n, n:])
    expected = -dense[n:, :n] @ inner
    expected[2, 2] += extra[3, 3]
    np.testing.assert_allclose(elimination.schur, expected, atol=1e-12 * dense.max())
    loads = np.random.default_rng(0).normal(size=(len(dense), 4))
    loads[:n, 2:] = 0.0
    fields, left = loads.copy(), np.random.default_rng(1).normal(size=(LEFT, 4)) / dense.max()
    elimination.condense(fields)
    np.testing.assert_allclose(fields[n:], loads[n:] - inner.T @ loads[:n], atol=1e-10)
    fields[n:] = left
    elimination.expand(fields, 2)
    answer = np.linalg.solve(dense[:n, :n], loads[:n] - dense[:n, n:] @ left)
    np.testing.assert_allclose(fields[:n], answer, atol=1e-10 * np.abs(answer).max())


def test_a_matrix_that_is_not_positive_is_refused(ordered):
    matrix, blocks = ordered
    with pytest.raises(RunFailed, match="not positive definite"):
        Elimination(sp.csr_matrix(-matrix), blocks)
