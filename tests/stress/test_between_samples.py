"""Stress at the solver's steps between samples."""

import numpy as np
import pytest
from stress_cage import POCKETS

from flexcage.results.layout import make_layout
from flexcage.results.store import LOADS, MemoryRunStore
from flexcage.stress.between import Loads, StoredSteps, no_steps, together
from flexcage.stress.fields import StressFields, TensorFields
from flexcage.stress.history import histories_at, stress_history

SAMPLES, DT = 6, 1e-3
T = DT * np.arange(1, SAMPLES + 1)


def loads(samples, times, scale, seed=3):
    """Normal forces of one pocket at steps, and the modes that bear them quasi-statically."""
    forces = np.zeros((len(times), POCKETS, 4, 7, 3))
    rng = np.random.default_rng(seed)
    forces[:, 2, 0, :, 2] = rng.random((len(times), 7)) * np.asarray(scale)[:, None]
    forces[:, 4, 3, :, 0] = -rng.random((len(times), 7))
    return Loads(
        np.asarray(samples), np.asarray(times), np.zeros((len(times), 0)), forces,
        np.zeros((len(times), 2, 24, 3)),
    )  # fmt: skip


def with_modes(recovery, given):
    push = np.einsum("tkfsa,kfsan->tn", given.stations, recovery.interface.modes)
    modes = np.linalg.solve(recovery.basis.stiffness, push.T).T
    return Loads(given.sample, given.time, modes, given.stations, given.lands)


@pytest.fixture(scope="module")
def at_samples(recovery):
    return with_modes(recovery, loads(np.arange(SAMPLES), T, np.ones(SAMPLES)))


@pytest.fixture(scope="module")
def at_steps(recovery):
    """Two before the first sample, none before the second, one small one, three, one, none."""
    samples = np.array([0, 0, 2, 3, 3, 3, 4])
    times = np.array([0.2, 0.7, 2.5, 3.1, 3.4, 3.9, 4.5]) * DT
    return with_modes(recovery, loads(samples, times, [2, 5, 0.1, 4, 9, 3, 0.2], seed=4))


def steps_of(given):
    """The steps as a run gives them."""

    def steps(first, end):
        inside = (given.sample >= first) & (given.sample < end)
        return given.only(inside) if inside.any() else None

    return steps


def test_a_history_with_steps_is_the_largest_of_both(recovery, at_samples, at_steps):
    """Against a history whose samples are all of these instants."""
    fields, a = StressFields(recovery), at_samples
    every = together([at_samples, at_steps])
    full = stress_history(fields, every.modes, every.stations)
    ours = stress_history(fields, a.modes, a.stations, between=steps_of(at_steps), settled=1)
    plain = stress_history(fields, a.modes, a.stations)
    np.testing.assert_allclose(ours.at_sample, plain.peak, rtol=1e-6)
    assert np.isnan(plain.peak_time).all()
    for k in range(SAMPLES):
        own = every.sample == k
        best = np.flatnonzero(own)[np.argmax(full.peak[own])]
        assert ours.peak[k] == pytest.approx(full.peak[best], rel=1e-6)
        assert ours.peak_vertex[k] == full.peak_vertex[best]
        at_step = best >= SAMPLES
        assert np.isnan(ours.peak_time[k]) != at_step
        if at_step:
            assert ours.peak_time[k] == every.time[best]
        np.testing.assert_allclose(ours.places[k], full.places[own].max(axis=0), rtol=0.01)
    assert np.isfinite(ours.peak_time).sum() == 2
    late = every.only(every.sample > 0)  # settled from sample 1 on
    wanted = stress_history(fields, late.modes, late.stations)
    assert (ours.envelope <= wanted.envelope * 1.00001).all()
    assert (ours.envelope >= stress_history(fields, a.modes[1:], a.stations[1:]).envelope).all()
    for i, vertices in enumerate(fields.places.values()):
        largest = ours.envelope[np.isin(fields.surface, vertices)].max()
        assert largest == pytest.approx(wanted.places[:, i].max(), rel=0.01)
        assert largest == pytest.approx(ours.places[1:, i].max(), rel=1e-5)


def test_tensors_follow_steps_and_samples_in_time(recovery, at_samples, at_steps):
    fields = TensorFields(recovery)
    name, a = next(iter(fields.places)), at_samples
    samples, histories = histories_at(
        fields, a.modes, a.stations, places=[name], between=steps_of(at_steps)
    )
    tensors = dict(histories)[name]
    every = together([at_samples, at_steps])
    order = np.argsort(every.time)
    np.testing.assert_array_equal(samples, every.sample[order])
    _, plain = histories_at(fields, every.modes, every.stations, places=[name])
    expected = dict(plain)[name][..., order]
    np.testing.assert_allclose(tensors, expected, rtol=1e-5, atol=1e-6 * np.abs(expected).max())


def table(times, faces, land=0.0):
    """A block's table: at each time these (pocket, face, force along psi) are touched."""
    rows = [row for own in faces for row in own]
    force = np.zeros((len(rows), 7, 3), np.float32)
    force[:, 3, 2] = [row[2] for row in rows]
    return {
        "time": np.array(times),
        "modes": np.arange(2.0 * len(times)).reshape(-1, 2),
        "land": np.full((len(times), 5, 2), land, np.float32),
        "touched": np.array([len(own) for own in faces], np.int16),
        "face": np.array([row[:2] for row in rows], np.int16).reshape(-1, 2),
        "force": force,
    }


@pytest.fixture
def store():
    """Blocks of three samples, 1 ms apart; steps in the first and the second."""
    layout = make_layout(
        coords={"time": T, "pocket": np.arange(4)}, variables=["pocket_force"], n_time=SAMPLES,
        n_time_hf=0, block=3, block_hf=None, attrs={},
    )  # fmt: skip
    made = MemoryRunStore(layout)
    # the second step of the first block is a sample
    first = table([0.4e-3, 1e-3, 2.2e-3], [[(1, 0, 5.0), (3, 2, 7.0)], [(0, 0, 1.0)], []], 2.0)
    second = table([3.5e-3, 5.1e-3], [[(2, 1, 3.0)], [(0, 3, 4.0), (1, 1, 6.0)]])
    force = {"pocket_force": np.zeros((3, 4, 4))}
    for k, own in enumerate((first, second)):
        made.write_block(k, force, tables={LOADS: own})
    return made


def test_steps_are_read_across_blocks(store):
    found = StoredSteps(store, T, inner=True)(0, SAMPLES)
    np.testing.assert_array_equal(found.sample, [0, 2, 3, 5])
    np.testing.assert_array_equal(found.time, [0.4e-3, 2.2e-3, 3.5e-3, 5.1e-3])
    np.testing.assert_array_equal(found.modes[:, 0], [0.0, 4.0, 0.0, 2.0])
    expected = np.zeros((4, 4, 4, 7, 3))
    for step, pocket, face, force in ((0, 1, 0, 5), (0, 3, 2, 7), (2, 2, 1, 3), (3, 0, 3, 4),
                                      (3, 1, 1, 6)):  # fmt: skip
        expected[step, pocket, face, 3, 2] = force
    np.testing.assert_array_equal(found.stations, expected)
    assert (found.lands[:2, 0, :, 1:] == 2.0).all() and not found.lands[:, 1].any()
    outer = StoredSteps(store, T, inner=False)(0, 3).lands
    assert (outer[:, 1, :, 1:] == 2.0).all() and not outer[:, 0].any()


@pytest.mark.parametrize(("first", "end", "samples"), [(2, 4, [2, 3]), (1, 2, []), (4, 6, [5])])
def test_steps_of_some_samples(store, first, end, samples):
    found = StoredSteps(store, T, inner=True)(first, end)
    assert ([] if found is None else list(found.sample)) == samples
    since = StoredSteps(store, T, inner=True).since(1)(first - 1, end - 1)
    assert ([] if since is None else list(since.sample + 1)) == samples


@pytest.mark.parametrize(
    ("time", "sample", "nearest"), [(2.4e-3, 1, 2.2e-3), (2.9e-3, 2, 3.5e-3), (5.9e-3, 5, 5.1e-3)]
)
def test_the_nearest_step(store, time, sample, nearest):
    assert StoredSteps(store, T, inner=True).nearest(time, sample).time == [nearest]


def test_a_run_without_steps(store):
    """That of a rigid cage."""
    plain = MemoryRunStore(store.layout)
    for k in range(2):
        plain.write_block(k, {"pocket_force": np.zeros((3, 4, 4))})
    assert StoredSteps(plain, T, inner=True)(0, SAMPLES) is None and no_steps(0, 1) is None
    assert StoredSteps(plain, T, inner=True).nearest(1e-3, 0) is None
