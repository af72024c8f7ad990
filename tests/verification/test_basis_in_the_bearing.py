"""The default basis against the fully dynamic one, in a running bearing.

An N1013 at 6000 rpm and 1000 N, coarse mesh, 20 ms of which the last 14 count; sound and with one
crossbeam bent by 0.2 mm. Three runs each, told apart by a tenth of the tolerance: a motion is
chaotic, so only statistics compare. Means and standard deviations over the runs, and the ratio:

    quantity                  sound: default, dynamic, ratio     bent: default, dynamic, ratio
    cage speed, rad/s      281.930+-.003 281.929+-.002 1.000  282.181+-.011 282.174+-.004 1.000
    sum of pocket forces, N   18.84+-.09    18.88+-.27 0.998     20.43+-.14    20.23+-.13 1.010
    in contact, mean, N        3.86+-.03     3.89+-.05 0.993      3.41+-.06     3.26+-.13 1.047
    in contact, rms, N         6.71+-.05     6.74+-.05 0.997      6.06+-.08     5.83+-.15 1.038
    largest force, N            90.+-14.     95.5+-6.4 0.946      86.6+-4.0     88.3+-3.1 0.981
    contact peaks, mean, N     5.76+-.20     5.80+-.03 0.994      5.13+-.03     4.96+-.20 1.033
    contact peaks, 99 %, N     47.8+-1.6     48.5+-1.5 0.985      45.1+-1.1     45.8+-0.9 0.983
    contacts per ms            88.0+-3.9     86.6+-0.8 1.017      99.4+-1.0     96.9+-4.4 1.026
    duration, mean, us         55.5+-2.2     56.1+-0.3 0.990      60.3+-0.9     64.2+-0.6 0.939
    duration, median, us          40+-0         40+-0  1.000        42+-3         43+-3   0.962
    duration, 90 %, us            65+-0         65+-0  1.000        73+-3         78+-5   0.942
    root stress, mean, MPa     8.54+-.05     8.65+-.10 0.986      8.87+-.04     8.87+-.06 1.000
    root stress, 99 %, MPa     17.6+-0.7     17.6+-0.6 0.999      17.2+-0.8     17.7+-0.5 0.975
    root stress, largest, MPa  19.4+-0.7     18.8+-0.6 1.031      18.3+-0.8     18.9+-0.7 0.967
    steps                          2867          4058  0.71           2856          4149  0.69
    CPU of the march, s             1.1           4.4  0.26            1.1           4.1  0.28

Before modes swung exactly (``solve.oscillators``), mean peaks were 0.96 and 0.94 of the reference:
steps of 5 us took a tenth of a crossbeam mode's swing each, in the default basis, and those of the
reference, seven times as short, did not.

Without inertia of the crossbeams' own bending (``modes.crossbeams = false``: 25 dynamic modes, to
12 kHz) motion, loads and root stress are as near, but single contacts are not: their 99 % peaks are
1.24 times the reference's (sound), and contacts last 1.6 times as long on average, because a wall
without inertia stays with its roller where one that rings breaks a push into blows.
"""

from __future__ import annotations

import time
from functools import cache

import numpy as np
import pytest
from verification_bearing import bearing_of, bent, cage_of, log, march, n1013

from flexcage.results.metrics import settled
from flexcage.solve import bdf
from flexcage.stress.fields import StressFields
from flexcage.stress.history import stress_history
from flexcage.stress.loads import land_station_forces
from flexcage.stress.recovery import StressRecovery
from flexcage.system.start import find_start

TOUCH = 1e-3  # N: what counts as contact
TOLERANCES = ("0.009 um", "0.01 um", "0.011 um")  # each gives another chaotic motion
pytestmark = pytest.mark.slow
DEFECTS = {"sound": [], "bent": bent("0.2 mm")}


def contacts(force: np.ndarray, step: float) -> tuple[np.ndarray, np.ndarray]:
    """Durations [s] and peaks [N] of all contacts in forces (time, pocket, face)."""
    force = force.reshape(len(force), -1)
    off = np.zeros((1, force.shape[1]), np.int8)
    change = np.diff(np.concatenate([off, (force > TOUCH).astype(np.int8), off]), axis=0).T
    (face, first), (_, end) = np.nonzero(change == 1), np.nonzero(change == -1)
    peaks = np.array([force[i:j, k].max() for k, i, j in zip(face, first, end)])
    return (end - first) * step, peaks


def statistics(case, fields: StressFields) -> dict[str, float]:
    """One run, its settled part: what the cage does and bears, and what the run cost."""
    bearing = bearing_of(case)
    start = find_start(bearing, limit_force=case.limits.assembly_force)
    recorders: list = []
    before = time.process_time()
    ds = march(case, bearing, start.y, start.yd, also=recorders.append)
    cost = time.process_time() - before
    ds = settled(ds, case.output.settle)
    force = ds["pocket_force"].transpose("time", "pocket", "face").values.astype(float)
    step = 1.0 / case.output.rate
    duration, peaks = contacts(force, step)
    touching = force[force > TOUCH]
    history = stress_history(
        fields, ds["modal_coordinates"].values, ds["station_force"].values,
        land_station_forces(ds, inner=case.cage.guidance != "outer"),
    )  # fmt: skip
    root = history.places.max(axis=1)
    return {
        "cage speed, rad/s": float(ds["cage_omega"].sel(axis="x").mean()),
        "sum of pocket forces, N": force.sum() / len(force),
        "in contact: mean force, N": touching.mean(),
        "in contact: rms force, N": np.sqrt(np.mean(touching**2)),
        "largest force, N": touching.max(),
        "peaks of contacts: mean, N": peaks.mean(),
        "peaks of contacts: 99 %, N": np.quantile(peaks, 0.99),
        "contacts per ms": 1e-3 * len(peaks) / (len(force) * step),
        "duration: mean, us": 1e6 * duration.mean(),
        "duration: median, us": 1e6 * np.median(duration),
        "duration: 90 %, us": 1e6 * np.quantile(duration, 0.9),
        "root stress: mean, MPa": 1e-6 * root.mean(),
        "root stress: 99 %, MPa": 1e-6 * np.quantile(root, 0.99),
        "root stress: largest, MPa": 1e-6 * root.max(),
        "steps": int(recorders[0].state.count[bdf.STEPS]),
        "CPU, s": cost,
    }


@cache
def sample(defect: str, dynamic: str, crossbeams: bool) -> dict[str, np.ndarray]:
    """Statistics of runs that differ in tolerance alone: name -> one value a run."""
    options = {
        "modes.dynamic": dynamic,
        "modes.crossbeams": crossbeams,
        "solver.duration": "20 ms",
        "output.rate": "200 kHz",
        "output.vibration_rate": "200 kHz",
        "output.settle": 0.3,
    }
    case = n1013(options, defects=DEFECTS[defect])
    _, cage = cage_of(case)
    fields = StressFields(
        StressRecovery(cage.model, cage.basis, cage.interface, solver=cage.solver)
    )
    runs = [statistics(case.replace("solver.tolerance", t), fields) for t in TOLERANCES]
    return {name: np.array([run[name] for run in runs]) for name in runs[0]}


@pytest.fixture(params=DEFECTS)
def both(request):
    """(default, fully dynamic): statistics of the same bearing."""
    return tuple(logged(request.param, dynamic) for dynamic in ("free", "all"))


def logged(defect: str, dynamic: str, crossbeams: bool = True) -> dict[str, np.ndarray]:
    values = sample(defect, dynamic, crossbeams)
    for name, v in values.items():
        log.info("%-5s %-4s %d %-28s %9.3f +- %.3f", defect, dynamic, crossbeams, name, v.mean(),
                 v.std(ddof=1))  # fmt: skip
    return values


def ratio(both, name: str) -> float:
    """Mean over the runs of the first over that of the second."""
    ours, reference = both
    return ours[name].mean() / reference[name].mean()


def test_motion_and_loads_are_the_same(both):
    """What pushes the cage and how fast it turns; within the scatter of the runs."""
    assert ratio(both, "cage speed, rad/s") == pytest.approx(1.0, abs=1e-4)
    assert ratio(both, "sum of pocket forces, N") == pytest.approx(1.0, abs=0.03)


def test_root_stress_is_the_same(both):
    assert ratio(both, "root stress: mean, MPa") == pytest.approx(1.0, abs=0.04)
    assert ratio(both, "root stress: 99 %, MPa") == pytest.approx(1.0, abs=0.07)
    assert ratio(both, "root stress: largest, MPa") == pytest.approx(1.0, abs=0.10)


def test_contacts_are_the_same(both):
    """Crossbeams bend with their own inertia: blows are as hard, as many and as long."""
    assert ratio(both, "peaks of contacts: mean, N") == pytest.approx(1.0, abs=0.06)
    assert ratio(both, "peaks of contacts: 99 %, N") == pytest.approx(1.0, abs=0.10)
    assert ratio(both, "largest force, N") == pytest.approx(1.0, abs=0.15)
    assert ratio(both, "contacts per ms") == pytest.approx(1.0, abs=0.06)
    assert ratio(both, "duration: mean, us") == pytest.approx(1.0, abs=0.12)
    assert ratio(both, "in contact: mean force, N") == pytest.approx(1.0, abs=0.07)
    assert ratio(both, "in contact: rms force, N") == pytest.approx(1.0, abs=0.07)


def test_the_default_takes_fewer_steps(both):
    assert ratio(both, "steps") < 0.85


def test_crossbeams_without_inertia_of_their_own_blow_harder_and_longer():
    """What the crossbeams' shapes are for."""
    found = logged("sound", "free", crossbeams=False), logged("sound", "all")
    assert 1.12 < ratio(found, "peaks of contacts: 99 %, N") < 1.60
    assert 1.3 < ratio(found, "duration: mean, us") < 2.4
