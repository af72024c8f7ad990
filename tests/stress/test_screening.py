"""Bounds on stress, by which few points are evaluated, against all points evaluated."""

import numpy as np
import pytest
from stress_cage import POCKETS

from flexcage.stress.between import Loads
from flexcage.stress.fields import StressFields
from flexcage.stress.history import stress_bound, stress_history
from flexcage.stress.screening import Screen

SIZES, PARTS, COLUMNS, INSTANTS = (7, 40, 1, 25), 5, 60, 30


def operators(rng, shapes):
    """Fields (n, parts, columns) of groups: of a few shapes each, and a hundredth of noise."""
    groups = [
        rng.standard_normal((n * PARTS, shapes)) @ rng.standard_normal((shapes, COLUMNS))
        for n in SIZES
    ]
    fields = np.concatenate(groups).reshape(-1, PARTS, COLUMNS)
    return (fields + 0.01 * rng.standard_normal(fields.shape)).astype(np.float32)


def screen_of(fields, typical):
    def rows(points, columns):
        chosen = fields[points].reshape(-1, COLUMNS).copy()
        return chosen if columns is None else chosen[:, columns]

    return Screen(rows, SIZES, typical)


def every_stress(fields, loads):
    """Of every point and instant (n, nt), in double precision."""
    return np.linalg.norm(np.einsum("npc,tc->npt", fields.astype(float), loads), axis=1)


@pytest.mark.parametrize("shapes", [3, 12, 50])
@pytest.mark.parametrize("scale", [1e-9, 1.0, 1e9])
def test_bounds_hold_whatever_the_loads(shapes, scale):
    """For loads like the typical ones, for any others, for one at a time, and for none."""
    rng = np.random.default_rng(shapes)
    fields = operators(rng, shapes)
    typical = scale * rng.standard_normal((INSTANTS, 4)) @ rng.standard_normal((4, COLUMNS))
    other = scale * rng.standard_normal((INSTANTS, COLUMNS)) * (rng.random(COLUMNS) < 0.3)
    screen = screen_of(fields, typical.astype(np.float32))
    for given in (typical, other, 1e3 * other, scale * np.eye(COLUMNS), 0.0 * typical):
        loads = given.astype(np.float32)
        low, high = screen.bounds(loads)
        full = every_stress(fields, loads)
        assert (low <= full).all() and (full <= high).all()
        some = np.array([0, 6, 9, 46, 47, 60, 72])
        for ours, of_all in zip(screen.bounds(loads, some), (low, high)):
            np.testing.assert_allclose(ours, of_all[some], rtol=1e-4, atol=1e-5 * high.max())
        np.testing.assert_allclose(
            screen.stress(some, loads), full[some], rtol=1e-4, atol=1e-6 * full.max()
        )


def test_no_points_have_no_stress():
    """Where no bound reaches what stands already, nothing is left to evaluate."""
    rng = np.random.default_rng(4)
    fields, loads = operators(rng, 3), rng.standard_normal((INSTANTS, COLUMNS)).astype(np.float32)
    assert screen_of(fields, loads).stress(np.zeros(0, int), loads).shape == (0, INSTANTS)


def test_bounds_are_narrow_where_shapes_are_few():
    rng = np.random.default_rng(1)
    fields = operators(rng, 3)
    loads = rng.standard_normal((INSTANTS, COLUMNS)).astype(np.float32)
    low, high = screen_of(fields, loads).bounds(loads)
    assert np.median(high - low) < 0.2 * np.median(every_stress(fields, loads))


def test_a_search_finds_what_evaluating_everything_finds(damaged):
    """More than a block of samples of moving contacts and free vibration, on pockets and lands."""
    rng, count, settled = np.random.default_rng(2), 300, 40
    fields = StressFields(damaged)
    forces = np.zeros((count, POCKETS, 4, 7, 3))
    for k in range(count):
        pocket = (k // 25) % POCKETS
        forces[k, pocket, k % 4, :, 2 if k % 4 < 2 else 0] = rng.random(7) * rng.exponential()
    land = np.zeros((count, 2, 24, 3))
    land[::3, 1, 5, 1] = rng.random(100)
    q = rng.standard_normal((count, damaged.basis.size))
    q /= np.sqrt(np.diag(damaged.basis.stiffness))
    ours = stress_history(fields, q, forces, land, settled=settled)

    tables = [t.astype(float) for t in (fields.modes, fields.forces, fields.land_forces)]
    loads = [q, fields.reduced_forces(forces), land.reshape(count, -1)]
    parts = sum(t @ x.astype(np.float32).T for t, x in zip(tables, loads))
    parts = parts.reshape(5, -1, count)
    values = fields.largest(np.linalg.norm(parts, axis=0))
    one, two = np.searchsorted(fields.vertices, fields.edges.T)
    middles = np.linalg.norm(0.5 * (parts[:, one] + parts[:, two]), axis=0)
    searched = values[fields.searched]
    for found, wanted in (
        (ours.peak, searched.max(axis=0)),
        (ours.at_sample, searched.max(axis=0)),
        (ours.envelope, values[:, settled:].max(axis=1)),
        (ours.middles, middles[:, settled:].max(axis=1)),
    ):
        np.testing.assert_allclose(found, wanted, rtol=5e-6)
    at = np.searchsorted(fields.surface, ours.peak_vertex)
    np.testing.assert_allclose(values[at, np.arange(count)], searched.max(axis=0), rtol=5e-6)
    for i, vertices in enumerate(fields.places.values()):
        own = values[np.searchsorted(fields.surface, vertices)]
        np.testing.assert_allclose(ours.places[:, i], own.max(axis=0), rtol=5e-6)


@pytest.mark.parametrize("lands", [True, False])
def test_no_peak_passes_the_bound_of_a_run(damaged, lands):
    """Random loads at samples and at steps between them, each of which alone may make the peak."""
    rng, count = np.random.default_rng(5), 270
    fields = StressFields(damaged)

    def loads(n, scale):
        q = scale * rng.standard_normal((n, damaged.basis.size))
        q /= np.sqrt(np.diag(damaged.basis.stiffness))
        forces = rng.standard_normal((n, POCKETS, 4, 7, 3)) * (rng.random((n, 1, 1, 1, 1)) < 0.5)
        land = rng.standard_normal((n, 2, 24, 3)) * (rng.random((n, 1, 1, 1)) < 0.1)
        return q, forces, land

    q, forces, land = loads(count, 1.0)
    for scale in (0.1, 10.0):  # the peak is at a sample, and at a step
        after = np.arange(5, count, 9)
        steps = Loads(after, np.full(len(after), 0.5), *loads(len(after), scale))

        def between(first, end, steps=steps):
            return steps.only((steps.sample >= first) & (steps.sample < end))

        arguments = fields, q, forces, land if lands else None
        history = stress_history(*arguments, between=between)
        bound = stress_bound(*arguments, between=between)
        assert history.peak.max() <= bound < 30.0 * history.peak.max()
        at_samples = stress_bound(*arguments)
        assert history.at_sample.max() <= at_samples
        assert (at_samples < bound) == (scale > 1.0)


def test_the_bound_of_one_load_is_its_stress(damaged):
    """A mode, a force in a pocket and one on a land, each alone."""
    fields = StressFields(damaged)
    for k in range(3):
        q, forces = np.zeros((2, damaged.basis.size)), np.zeros((2, POCKETS, 4, 7, 3))
        land = np.zeros((2, 2, 24, 3))
        (q[1], forces[1, 2, 0, 3], land[1, 1, 5])[k][-1] = 7.0
        peak = stress_history(fields, q, forces, land).peak.max()
        assert peak > 0.0
        assert stress_bound(fields, q, forces, land) == pytest.approx(peak, rel=2e-5)
