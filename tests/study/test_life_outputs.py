"""Fatigue and wear as outputs of a study: what is lacking is said before anything runs."""

import importlib.util
import re

import numpy as np
import pytest
from study_cases import short_case, short_study

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.results.metrics import settled
from flexcage.results.row import SHOWN
from flexcage.simulate import simulate
from flexcage.stress.loads import cage_loads
from flexcage.study.axes import Grid
from flexcage.study.outputs import LATE_FIGURES, beyond_summary, figures_of
from flexcage.study.plan import make_plan

FLEXIBLE = Grid("cage.model", ["flexible"])
FIGURES = tuple(name for name in LATE_FIGURES if name.startswith(("fatigue_", "wear_")))


def test_no_summary_holds_them_and_a_plan_takes_them():
    outputs = ("cage_speed", *FIGURES, "pocket_force.max")
    make_plan(short_study(FLEXIBLE, outputs=outputs))
    assert beyond_summary(outputs) == outputs[1:]


def test_fatigue_needs_a_flexible_cage():
    with pytest.raises(InputError, match="'fatigue_life' needs a flexible cage"):
        make_plan(short_study(outputs=("fatigue_life",)))


def test_materials_without_data_are_refused():
    materials = Grid("cage.material", ["brass", "polyimide"])
    for name, words in (("fatigue_life", "S-N curve"), ("wear_depth_rate", "wear coefficient")):
        with pytest.raises(InputError, match=f"No published {words} of polyimide"):
            make_plan(short_study(FLEXIBLE, materials, outputs=(name,)))


def test_without_pylife_fatigue_is_refused_and_wear_is_not(monkeypatch):
    find = importlib.util.find_spec
    monkeypatch.setattr(
        importlib.util, "find_spec", lambda name, *a: None if name == "pylife" else find(name, *a)
    )
    make_plan(short_study(outputs=("wear_depth_rate",)))
    with pytest.raises(EnvironmentLacks, match="pyLife"):
        make_plan(short_study(FLEXIBLE, outputs=("fatigue_damage_rate",)))


def test_figures_are_those_of_the_run():
    pushed = {"start.push": "200 mm/s", "solver.duration": "2 ms"}
    run = simulate(short_case(**{"cage.model": "flexible", **pushed}))
    figures = figures_of(run, FIGURES)
    worst, worn = run.fatigue().worst, run.wear()
    assert figures["fatigue_damage_rate"].value == worst.damage_rate > 0.0
    assert figures["fatigue_life"].value == pytest.approx(3600.0 * worst.life_hours)
    assert figures["wear_volume_rate"].value == worn.volume_rate > 0.0
    assert figures["wear_depth_rate"].value == worn.depth_rate
    for figure in map(figures.get, FIGURES):
        assert SHOWN[figure.shown][0] == figure.unit
    check_place(run, worst)


def check_place(run, worst):
    """The counted stress is that of the full mesh: on its plane, at a point that is nearest to its
    vertex, within its range at any time, and from end to end of it."""
    times = settled(run.dataset, run.case.output.settle)["time"].values
    x, y, z = worst.normal
    weights = np.array([x * x, y * y, z * z, 2 * x * y, 2 * y * z, 2 * x * z])
    stress_at = run.recovery.stress_at(np.arange(len(run.mesh.points)))
    found = []
    for index in run.dataset.indexes["time"].get_indexer(times):
        loads = cage_loads(run.dataset, index, inner=run.case.cage.guidance != "outer")
        moved = run.recovery.displacement(loads)[..., None]
        at_points = stress_at(moved, loads.station_forces[..., None])[:, 0]
        found.append(at_points[stress_at.owner == worst.vertex] @ weights)
    ends = np.stack([np.min(found, axis=0), np.max(found, axis=0)])
    low, high = worst.largest  # steps between samples count too: samples reach one end, or nearly
    slack = 2e-3 * np.abs(worst.largest) + 1e4
    within = (ends[0] > low - slack[0]) & (ends[1] < high + slack[1])
    assert (within & (np.ptp(ends, axis=0) > 0.95 * (high - low))).any()
    assert run.fatigue(worst.place).worst.largest == worst.largest
    with pytest.raises(InputError, match=re.escape(f"nearest known one is '{worst.place}'")):
        run.fatigue(worst.place + "x")
