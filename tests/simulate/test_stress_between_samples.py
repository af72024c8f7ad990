"""Stress of a run at the solver's steps between samples."""

import shutil

import numpy as np
import pytest
from simulate_cases import bent, n1013

from flexcage.results.store import SIDE
from flexcage.simulate import load_run, simulate
from flexcage.stress.between import StoredSteps

RATE = 50e3
BLOCK = 250 / RATE  # [s]
SETTLED = 0.3


def case_at(rate, **more):
    """The same steps of the solver at any rate: blocks end at the same times."""
    return n1013(
        {"solver.duration": "15 ms", "output.vibration_rate": "400 kHz",
         "output.rate": f"{rate / 1e3} kHz", "output.block": round(BLOCK * rate), **more},
        defects=bent("0.2 mm"),
    )  # fmt: skip


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return simulate(case_at(RATE), out=tmp_path_factory.mktemp("run"))


@pytest.fixture(scope="module")
def dense():
    """Sampled eight times as often, and without steps between."""
    return simulate(case_at(8 * RATE))


def pass_peaks(history, rate):
    """Largest stress at any place in windows of 1 ms, about a roller pass."""
    largest = history.places.max(axis=1)[int(SETTLED * len(history.places)) :]
    window = round(1e-3 * rate)
    return largest[: len(largest) // window * window].reshape(-1, window).max(axis=1)


def land_blows(dense):
    """Whether the largest stress in the window of each pass is that of a hard blow on the land: one
    lasts 7 us, as long as a step, and not all of its stress is seen at one."""
    force = np.linalg.norm(dense.dataset["land_force"].values, axis=1)
    largest = dense.stress_history.places.max(axis=1)
    first, window = int(SETTLED * len(force)), round(8e-3 * RATE)
    force, largest = (
        x[first : first + (len(x) - first) // window * window].reshape(-1, window)
        for x in (force, largest)
    )
    return force[np.arange(len(force)), largest.argmax(axis=1)] > 100.0


def test_steps_between_samples_see_the_peaks(run, dense):
    """Samples at 400 kHz miss none; those at 50 kHz alone read 2 to 10 % low, by the blows that a
    machine's rounding leads to."""
    at_rate = dense.dataset["cage_position"].values[7::8]
    np.testing.assert_allclose(run.dataset["cage_position"].values, at_rate, rtol=1e-7, atol=1e-15)
    wanted = pass_peaks(dense.stress_history, 8 * RATE)
    with_steps = pass_peaks(run.stress_history, RATE)
    blow = land_blows(dense)
    assert (~blow).sum() >= 5
    np.testing.assert_allclose(with_steps[~blow].mean(), wanted[~blow].mean(), rtol=0.01)
    np.testing.assert_allclose(with_steps[~blow], wanted[~blow], rtol=0.04)
    assert (with_steps[blow] > 0.8 * wanted[blow]).all() and (with_steps < 1.001 * wanted).all()
    samples_alone = pass_peaks(_without_steps(run), RATE)
    assert samples_alone.mean() < 0.98 * wanted.mean() and (samples_alone < 1.001 * wanted).all()
    h = run.stress_history
    assert (h.places.max(axis=1) <= h.peak * 1.00001).all()  # places are searched for the peak


def test_few_samples_see_the_same_peaks(dense):
    """At 10 kHz as well: steps are kept by their own distance, not by that of samples."""
    wanted = pass_peaks(dense.stress_history, 8 * RATE)
    found = pass_peaks(simulate(case_at(RATE / 5)).stress_history, RATE / 5)
    blow = land_blows(dense)
    np.testing.assert_allclose(found[~blow].mean(), wanted[~blow].mean(), rtol=0.015)
    np.testing.assert_allclose(found[~blow], wanted[~blow], rtol=0.05)
    assert (found[blow] > 0.8 * wanted[blow]).all()


def _without_steps(run):
    run = load_run(run.folder)
    run.store.loads = lambda block: {}
    return run.stress_history


def test_forces_at_steps_are_those_of_the_peaks(run):
    """``pocket_peak`` is found by other code: from steps less than 2 us apart too, and from the
    parabola through three of them."""
    ds = run.dataset
    steps = StoredSteps(run.store, ds["time"].values, inner=True)(0, ds.sizes["time"])
    assert len(steps) > 500 and np.diff(steps.time).min() > 0.099 / RATE
    normal = np.zeros((ds.sizes["time"], 22, 2))
    at_step = np.stack([steps.stations[..., face, :, 2].sum(-1) * sign
                        for face, sign in ((0, 1.0), (1, -1.0))], axis=-1)  # fmt: skip
    np.maximum.at(normal, steps.sample, at_step)
    peak = ds["pocket_peak"].values[:, :, :2]
    assert (normal <= peak * 1.0001 + 1e-3).all()
    sampled = ds["pocket_force"].values[:, :, :2]
    beside = np.maximum(sampled, np.roll(sampled, 1, axis=0))
    clear = (peak > 1.2 * beside) & (peak > 2.0)  # between samples
    clear[[0, -1]] = False
    assert clear.sum() > 20
    # steps past a sample, and before the last one, are among those of a peak
    near = np.max([np.roll(normal, shift, axis=0) for shift in (-1, 0, 1)], axis=0)
    share = (near / np.maximum(peak, 1e-9))[clear]
    assert share.min() > 0.8 and 0.95 < np.minimum(share, 1.0).mean() < 0.995


def test_the_stress_of_a_step_is_that_of_the_history(run):
    h, t = run.stress_history, run.dataset["time"].values
    between = np.flatnonzero(np.isfinite(h.peak_time))
    k = between[np.argmax(h.peak[between])]
    assert t[k - 1] < h.peak_time[k] < t[k] and h.peak[k] > h.at_sample[k]
    field = run.stress(time=h.peak_time[k])
    assert field.time == h.peak_time[k]
    spin = 1.02  # the history leaves out the mean stress of spinning, under 0.1 MPa
    assert field.von_mises[h.peak_vertex[k]] == pytest.approx(h.peak[k], rel=spin - 1.0)
    assert run.stress(time=t[k]).time == t[k]
    peak = run.stress()
    assert peak.time == run.peak_time
    assert f"t = {run.peak_time * 1e3:.3f} ms" in run.summary.row("stress_peak").note
    pvd = run.write_vtu(run.folder / "vtu").read_text("utf-8")
    assert f'timestep="{run.peak_time:.9g}"' in pvd or f"{run.peak_time!r}" in pvd


def test_a_run_of_an_earlier_flexcage_has_samples_alone(run, tmp_path):
    folder = tmp_path / "old"
    shutil.copytree(run.folder, folder)
    shutil.rmtree(folder / "results.zarr" / SIDE / "loads")
    old = load_run(folder).stress_history
    assert np.isnan(old.peak_time).all()
    np.testing.assert_array_equal(old.peak, old.at_sample)
    np.testing.assert_array_equal(old.at_sample, run.stress_history.at_sample)
