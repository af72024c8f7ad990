"""Runs of bearings without a cage, from case to page."""

from __future__ import annotations

import numpy as np
import pytest
from simulate_cases import Interrupted

from flexcage import Study, load_run, run_study, simulate
from flexcage.bearings import recording_of
from flexcage.case import load_case
from flexcage.core.errors import InputError
from flexcage.integrate.recorded import recorded_names
from flexcage.results.features import cage_motion_features
from flexcage.results.instrument import of_run
from flexcage.results.registry import VARIABLES, Variable
from flexcage.stages import bearing_to_compile
from flexcage.study import work
from flexcage.study.axes import Grid
from flexcage.study.compare import compare

BALLS = {
    "name": "full",
    "bearing": {"preset": "7010C-PI", "ball_count": 21},
    "cage": {"model": "none"},
    "drive": {"speed": "4000 rpm"},
    "load": {"radial": "300 N", "axial": "40 N"},
    "solver": {"duration": "4 ms"},
    "output": {"block": 20},
}


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return simulate(load_case(BALLS), out=tmp_path_factory.mktemp("run") / "full")


def test_its_folder_has_no_cage_and_reads_back(run):
    assert not (run.folder / "cage.zip").exists()
    again = load_run(run.folder)
    names = set(again.dataset.data_vars)
    assert "neighbour_force" in names and "race_force" in names
    assert not [n for n in names if n.startswith(("cage_", "pocket_", "land_", "station_"))]
    assert again.summary["orbital_speed"] == run.summary["orbital_speed"]


def test_figures_refer_to_the_mean_orbit_of_the_balls(run):
    """From the recorded azimuths, not speeds: the mean of all balls, over the settled time."""
    summary, ds = run.summary, run.dataset
    keys = {row.key for row in summary}
    assert {"orbital_speed", "orbital_slip_ratio", "neighbour_force_peak", "largest_gap"} <= keys
    assert not {"cage_speed", "cage_slip_ratio", "whirl_radius", "pocket_force_mean"} & keys
    t = ds["time"].values
    late = t >= summary["settled_at"] * (1.0 - 1e-9)
    psi = ds["element_position"].sel(cyl="psi").mean("element").values[late]
    turned = (psi[-1] - psi[0]) / (t[late][-1] - t[late][0])
    assert summary["orbital_speed"] == pytest.approx(turned, rel=1e-6)
    assert summary["energy_audit"] == "passed"


def test_what_is_only_of_cages_is_refused_in_a_sentence(run):
    for ask in (run.stress, run.fatigue, run.wear, lambda: run.mode_table, lambda: run.mesh):
        with pytest.raises(InputError, match="The bearing has no cage"):
            ask()
    for measure in (cage_motion_features, of_run):
        with pytest.raises(InputError, match="bearing has no cage.*neighbour_force"):
            measure(run.dataset)
    with pytest.raises(InputError, match="the run's bearing has no cage"):
        run.write_table(run.folder / "x.csv", "cage_position")


def test_its_page_tells_of_neighbours_and_not_of_a_cage(run):
    assert {"mesh", "orbit", "modes"}.isdisjoint(run.picture_names)
    text = run.report(run.folder / "page.html").read_text("utf-8")
    assert "It has no cage" in text and "Balls&#39; orbital speed" in text.replace("'", "&#39;")
    assert "Force between neighbouring balls" in text and "Pocket force" not in text


def test_a_resumed_run_is_the_unbroken_one(run, tmp_path):
    with pytest.raises(KeyboardInterrupt):
        simulate(run.case, out=tmp_path / "run", progress=Interrupted(2, 1e-3))
    resumed = simulate(run.case, out=tmp_path / "run", resume=True)
    for name in ("element_position", "inner_position", "neighbour_force", "work"):
        np.testing.assert_array_equal(resumed.dataset[name].values, run.dataset[name].values)


def study(case, path, values, *outputs):
    axis = Grid(path=path, values=values)
    return Study(name="full", case=load_case(case), axes=(axis,), outputs=outputs)


def test_a_study_sets_a_cage_beside_none(tmp_path):
    caged = {**BALLS, "cage": {"model": "rigid"}, "bearing": {"preset": "7010C-PI"}}
    found = run_study(
        study(
            caged, "cage.model", ("rigid", "none"),
            "cage_slip_ratio", "orbital_slip_ratio", "pocket_force.max", "race_force.max",
        ),
        out=tmp_path / "study", workers=1,
    ).table  # fmt: skip
    lacks = {name.split(" ")[0]: found[name].isna().tolist() for name in found}
    assert lacks.items() >= {
        "cage_slip_ratio": [False, True], "orbital_slip_ratio": [True, False],
        "pocket_force.max": [False, True], "race_force.max": [False, False],
    }.items()  # fmt: skip


@pytest.mark.parametrize(
    ("model", "output", "why"),
    [
        ("rigid", "orbital_slip_ratio", "'orbital_slip_ratio' is of a full complement"),
        ("none", "cage_slip_ratio", "'cage_slip_ratio' is of a cage"),
        ("none", "pocket_force.max", "'pocket_force.max' is of a cage"),
    ],
)
def test_a_study_refuses_what_none_of_its_cases_has(tmp_path, model, output, why):
    case = {**BALLS, "cage": {"model": model}, "bearing": {"preset": "7010C-PI"}}
    asked = study(case, "load.radial", ("300 N", "400 N"), output)
    with pytest.raises(InputError, match=why):
        run_study(asked, out=tmp_path / "study", workers=1)


def test_variables_of_ones_own_on_pockets_are_left_out(monkeypatch):
    mine = Variable("mine", ("time", "pocket"), "N", "a force in every pocket")
    monkeypatch.setitem(VARIABLES._added, "mine", mine)
    for model, has in (("rigid", True), ("none", False)):
        case = load_case({**BALLS, "bearing": {"preset": "7010C-PI"}, "cage": {"model": model}})
        bearing = bearing_to_compile(case)
        assert ("mine" in recorded_names(bearing, recording_of(case.bearing))) == has


def test_workers_compile_its_kernels_by_a_run_of_two_samples(monkeypatch):
    """Not by one with a rigid cage, as those of other cases."""
    ran = []
    monkeypatch.setattr(work.kernel_marks, "kernels_cached", lambda what: False)
    monkeypatch.setattr(work, "simulate", ran.append)
    work.compile_kernels(load_case(BALLS))
    (case,) = ran
    assert case.cage is None and case.solver.duration * case.output.rate == pytest.approx(2.0)


def test_two_runs_without_a_cage_are_compared(run, tmp_path):
    other = simulate(run.case.replace("load.radial", 200.0), out=tmp_path / "other")
    found = compare(run.folder, other.folder, out=tmp_path / "compare")
    assert "orbital_speed" in [pair.key for pair in found.leading]
    assert (tmp_path / "compare" / "report.html").is_file()
    assert not (tmp_path / "compare" / "forces.png").exists()
