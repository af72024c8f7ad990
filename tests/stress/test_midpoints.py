"""Stress in the middles of edges, against closed forms and against the full history."""

import numpy as np
import pytest
from stress_cage import POCKETS
from test_recovery import normal_forces, quasi_static

from flexcage.stress.fields import StressFields
from flexcage.stress.history import stress_history
from flexcage.stress.midpoints import at_nodes, edges_across, largest_at_nodes


def test_bending_leaves_the_neutral_axis_without_stress(recovery):
    """Stress that is linear across the ring's section: right at every node, nothing half-way."""
    model = recovery.model
    height = model.nodes[:, 0] - 1e-3
    stress = np.zeros((len(model.points), 6))
    stress[:, 0] = 1e9 * height[: len(model.points)]
    values = at_nodes(model, stress)
    np.testing.assert_allclose(values, 1e9 * np.abs(height), atol=1e-3)


def test_edges_across_a_face_have_both_ends_on_its_rims(recovery):
    """The coarse cage's end faces are one element wide: edges go from bore to outside."""
    model = recovery.model
    edges = edges_across(model)
    ends = model.points[edges]
    end = np.abs(model.points[:, 0]).max()
    on_end = np.isclose(np.abs(ends[..., 0]), end).all(axis=1)
    r = np.hypot(ends[..., 1], ends[..., 2])
    low, high = np.hypot(*model.points[:, 1:].T).min(), np.hypot(*model.points[:, 1:].T).max()
    through = np.isclose(r.min(axis=1), low) & np.isclose(r.max(axis=1), high)
    assert (on_end & through).sum() >= 2 * POCKETS, "the zigzag of both end faces"
    assert not (on_end & np.isclose(np.ptp(r, axis=1), 0.0)).any(), "rims themselves are none"
    surface = np.sort(np.concatenate([model.surface[:, p] for p in ([0, 1], [1, 2], [0, 2])]), 1)
    found = set(map(tuple, np.sort(edges, 1).tolist()))
    assert found <= set(map(tuple, surface.tolist())) and len(found) == len(edges)


def test_the_envelope_in_the_middles_is_the_largest_of_all_instants(recovery):
    """Of deviators averaged at every sample by itself; the mean of the ends' envelopes would be
    far more where a face bends."""
    forces = normal_forces(4)
    q = np.stack([quasi_static(recovery, f) for f in forces])
    fields = StressFields(recovery)
    history = stress_history(fields, q, forces, settled=1)
    sums = fields.modes @ q.T.astype(np.float32)
    sums += fields.forces @ fields.reduced_forces(forces).T.astype(np.float32)
    parts = sums.reshape(5, -1, len(q))
    one, two = np.searchsorted(fields.vertices, history.edges.T)
    full = np.linalg.norm(0.5 * (parts[:, one] + parts[:, two]), axis=0)
    np.testing.assert_allclose(history.middles, full[:, 1:].max(axis=1), rtol=1e-4)
    vertices = np.zeros(len(recovery.model.points))
    vertices[history.surface] = history.envelope
    plain = vertices[history.edges].mean(axis=1)
    assert (history.middles <= 1.0001 * plain).all()
    assert np.median(history.middles / plain) < 0.9
    values = largest_at_nodes(recovery.model, vertices, history.edges, history.middles)
    np.testing.assert_array_equal(values[: len(vertices)], vertices)
    at = recovery.model.edge_nodes(history.edges)
    np.testing.assert_array_equal(values[at], history.middles)
    others = np.setdiff1d(np.arange(len(vertices), len(values)), at)
    ends = vertices[recovery.model.edges[others - len(vertices)]]
    np.testing.assert_allclose(values[others], ends.mean(axis=1))


def test_linear_elements_have_no_middles(recovery):
    from dataclasses import replace

    linear = replace(recovery.model, order=1, edges=np.empty((0, 2), int))
    assert edges_across(linear).shape == (0, 2)
    stress = np.ones((len(linear.points), 6))
    assert at_nodes(linear, stress) == pytest.approx(3.0)
