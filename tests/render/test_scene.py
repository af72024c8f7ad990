"""Surfaces of tetrahedra and fixed views, against closed forms."""

import numpy as np
import pytest
from ring_with_pockets import quadratic

from flexcage.render.scene import Layer, ring_size, ring_view, surface_of
from flexcage.render.stage import shoot


def enclosed_volume(points, triangles):
    a, b, c = (points[triangles[:, i]] for i in range(3))
    return float(np.einsum("ij,ij->i", a, np.cross(b, c)).sum() / 6.0)


def test_surface_is_closed_outward_and_encloses_the_volume(ring):
    surface = surface_of(ring.tets)
    assert enclosed_volume(ring.points, surface.triangles) == pytest.approx(ring.volume, rel=1e-12)
    ends = np.sort(np.concatenate([surface.triangles[:, e] for e in ([0, 1], [1, 2], [2, 0])]), 1)
    _, count = np.unique(ends, axis=0, return_counts=True)
    assert (count % 2 == 0).all()


def test_quadratic_surface_passes_through_mid_nodes(ring):
    nodes, cells = quadratic(ring.points, ring.tets)
    linear, full = surface_of(ring.tets), surface_of(cells)
    assert len(full.triangles) == 4 * len(linear.triangles)
    assert enclosed_volume(nodes, full.triangles) == pytest.approx(ring.volume, rel=1e-12)
    n_edges = len(linear.triangles) * 3 // 2
    assert len(full.used) == len(linear.used) + n_edges


def test_quadratic_surface_follows_a_curved_field(ring):
    """Mid nodes moved out radially add volume; linear triangles without them would not see it."""
    nodes, cells = quadratic(ring.points, ring.tets)
    bulged = nodes.copy()
    bulged[len(ring.points) :, 1:] *= 1.001
    full = surface_of(cells)
    assert enclosed_volume(bulged, full.triangles) > 1.0005 * ring.volume


def test_a_surface_is_divided_only_where_its_values_are_curved(ring):
    """It stays closed and passes through the mid nodes of curved edges; others stay whole."""
    nodes, cells = quadratic(ring.points, ring.tets)
    values = np.abs(nodes[:, 1] - 1e-3) + nodes[:, 0]  # curved across a plane alone
    full, part = surface_of(cells), surface_of(cells, values, within=1e-6)
    linear = surface_of(ring.tets)
    assert (
        len(linear.triangles)
        < len(part.triangles)
        < 0.2 * len(full.triangles) + len(linear.triangles)
    )
    assert enclosed_volume(nodes, part.triangles) == pytest.approx(ring.volume, rel=1e-12)
    ends = np.sort(np.concatenate([part.triangles[:, e] for e in ([0, 1], [1, 2], [2, 0])]), 1)
    _, count = np.unique(ends, axis=0, return_counts=True)
    assert (count % 2 == 0).all(), "no gap between a divided triangle and its neighbour"
    mids = np.setdiff1d(part.used, linear.used)
    assert len(mids) and (np.abs(nodes[mids, 1] - 1e-3) < 4e-3).all()
    again = surface_of(cells, values, within=-1.0)
    assert np.array_equal(np.sort(again.triangles, 0), np.sort(full.triangles, 0))
    assert len(surface_of(cells, values, within=1.0).triangles) == len(linear.triangles)


def test_view_is_fixed_by_the_ring_and_keeps_it_in_the_picture(ring, canvas):
    radius, width = ring_size(ring.points)
    assert (radius, width) == pytest.approx((43e-3, 16e-3))
    moved = ring.points + np.random.default_rng(1).uniform(-1e-4, 1e-4, ring.points.shape) * 0.3
    assert ring_size(moved)[0] - radius <= 0.5e-3 + 1e-12
    view = ring_view(radius, width, aspect=4 / 3, azimuth=0.7)
    body = surface_of(ring.tets).polydata(ring.points)
    picture = shoot([Layer(body, colour="black", lit=False)], view, (400, 300))
    assert picture.pixels.shape == (300, 400, 3)
    dark = np.argwhere(picture.pixels.max(axis=2) < 60)[:, ::-1]
    assert len(dark) > 5000, "the ring is drawn"
    assert dark.min() > 4 and (dark.max(axis=0) < (396, 296)).all(), "and nothing of it is cut"
    spots = picture.place(ring.points)
    assert np.allclose(spots.min(axis=0), dark.min(axis=0), atol=2.0)
    assert np.allclose(spots.max(axis=0), dark.max(axis=0), atol=2.0)


def test_hidden_places_are_known(ring, canvas):
    radius, width = ring_size(ring.points)
    view = ring_view(radius, width, aspect=4 / 3, elevation=20.0)
    body = surface_of(ring.tets).polydata(ring.points)
    picture = shoot([Layer(body, colour="grey")], view, (800, 600))
    beam = np.pi / 12  # the crossbeam after pocket 0
    outside = np.array([0.0, 43e-3 * np.cos(beam), 43e-3 * np.sin(beam)])
    inside = outside * 39 / 43
    assert picture.sees(outside) and picture.shows(outside, slack=1e-3)
    assert not picture.sees(inside)
    assert not picture.shows(np.array([0.0, 20e-3, 0.0]))
