"""A run that stopped goes on as if it had not, bit by bit; what was computed is kept."""

import shutil
from concurrent.futures import ThreadPoolExecutor

import numpy as np
import pytest
from simulate_cases import Interrupted, bent, n1013

from flexcage.cli import main
from flexcage.core.errors import InputError, RunFailed
from flexcage.core.locks import held, is_held
from flexcage.integrate import recorded, recorder
from flexcage.results.registry import VARIABLES
from flexcage.results.store import RunStore
from flexcage.run.folder import write_case
from flexcage.simulate import load_run, simulate

BLOCK = 50 / 50e3  # [s]


def case_of(model, **sections):
    return n1013(
        {"cage.model": model, "solver.duration": "5 ms"}, defects=bent("0.2 mm"), **sections
    )


@pytest.fixture(scope="module")
def unbroken(tmp_path_factory):
    new = tmp_path_factory.mktemp
    return {model: simulate(case_of(model), out=new(model)) for model in ("rigid", "flexible")}


def assert_same(ours, theirs):
    """Datasets, steps and events of two runs, bit by bit."""
    a, b = ours.dataset, theirs.dataset
    assert set(a.variables) == set(b.variables)
    for name in a.variables:
        np.testing.assert_array_equal(a[name].values, b[name].values, err_msg=name)
    for table in ("steps", "events"):
        ones, others = (getattr(run.store, table)() for run in (ours, theirs))
        for column in ones:
            np.testing.assert_array_equal(ones[column], others[column], err_msg=column)
    for block in range(ours.store.blocks):
        ones, others = (run.store.loads(block) for run in (ours, theirs))
        assert set(ones) == set(others)
        for column in ones:
            np.testing.assert_array_equal(ones[column], others[column], err_msg=column)


def test_a_run_that_goes_on_is_read_as_one(tmp_path, caplog):
    with pytest.raises(KeyboardInterrupt):
        simulate(case_of("rigid"), out=tmp_path, progress=Interrupted(2, BLOCK))
    with held(tmp_path), ThreadPoolExecutor() as others:
        assert others.submit(is_held, tmp_path).result() and not is_held(tmp_path)
        others.submit(load_run, tmp_path).result()
    assert "is still being computed: this is of its first 2 ms of 5 ms; wait" in caplog.text
    assert not is_held(tmp_path)


@pytest.mark.parametrize(("model", "blocks"), [("rigid", 2), ("flexible", 1), ("flexible", 4)])
def test_a_resumed_run_is_the_unbroken_one(tmp_path, unbroken, model, blocks, caplog):
    case = case_of(model)
    with pytest.raises(KeyboardInterrupt):
        simulate(case, out=tmp_path, progress=Interrupted(blocks, BLOCK))
    kept = RunStore.open(tmp_path / "results.zarr")
    assert kept.blocks == blocks and not kept.complete
    half = load_run(tmp_path).dataset
    assert f"the run in '{tmp_path}' was stopped: this is of its first {blocks:g} ms of 5 ms" in (
        caplog.text
    )
    assert half.sizes["time"] == 50 * blocks and np.isfinite(half["element_position"].values).all()
    watch = Interrupted(10**6, BLOCK)
    resumed = simulate(case, out=tmp_path, resume=True, progress=watch)
    assert watch.begun == pytest.approx(blocks * BLOCK)
    assert_same(resumed, unbroken[model])


def test_a_run_on_disk_is_the_one_in_memory_as_it_is_rounded(unbroken):
    stored, memory = unbroken["flexible"], simulate(case_of("flexible"))
    for name, values in memory.dataset.data_vars.items():
        rounded = VARIABLES[name].rounded(values.values)
        np.testing.assert_array_equal(stored.dataset[name].values, rounded, err_msg=name)
    for table in ("steps", "events"):
        ones, others = (getattr(run.store, table)() for run in (stored, memory))
        for column in ones:
            np.testing.assert_array_equal(ones[column], others[column], err_msg=column)


def test_a_loaded_run_is_the_one_that_was_written(unbroken):
    stored = unbroken["flexible"]
    again = load_run(stored.folder)
    assert_same(again, stored)
    assert again.summary["cage_speed"] == stored.summary["cage_speed"]


def test_resuming_a_finished_run_changes_nothing(tmp_path, unbroken):
    simulate(case_of("rigid"), out=tmp_path)
    assert_same(simulate(case_of("rigid"), out=tmp_path, resume=True), unbroken["rigid"])


def test_another_case_is_not_resumed(tmp_path):
    with pytest.raises(KeyboardInterrupt):
        simulate(case_of("rigid"), out=tmp_path, progress=Interrupted(1, BLOCK))
    with pytest.raises(InputError, match="differs"):
        simulate(case_of("rigid").replace("load.radial", 900.0), out=tmp_path, resume=True)
    renamed = case_of("rigid").replace("name", "the same physics")
    assert simulate(renamed, out=tmp_path, resume=True).store.complete


def test_a_solver_that_runs_out_of_steps_keeps_what_it_has(tmp_path):
    """It stops in the middle of a block; samples before are there, and the sentence says why."""
    case = case_of("rigid").replace({"solver.max_steps": 500, "solver.method": "bdf"})
    with pytest.raises(RunFailed, match=r"stopped at t = .* ms: solver.max_steps") as failure:
        simulate(case, out=tmp_path)
    assert "kept" in str(failure.value)
    run = load_run(tmp_path)
    samples = run.dataset.sizes["time"]
    assert 0 < samples < 250 and samples % 50
    assert not run.store.complete and run.dataset.attrs["complete"] == 0
    for name, values in run.dataset.data_vars.items():
        assert np.isfinite(values.values).all(), name
    steps = run.store.steps()["time"]
    assert 400 < len(steps) <= 500  # less those of a first block that was done again
    assert run.dataset["time"].values[-1] <= steps[-1]
    assert run.summary["inner_speed"] == pytest.approx(6000 * np.pi / 30)


def test_a_smallest_step_that_is_too_large_ends_with_a_sentence(tmp_path):
    case = case_of("rigid").replace(
        si=False, **{"solver.min_step": "0.09 us", "solver.tolerance": "1e-6 um"}
    )
    with pytest.raises(RunFailed, match="solver.min_step"):
        simulate(case, out=tmp_path)
    assert RunStore.open(tmp_path / "results.zarr").n_time < 250


def test_a_run_that_lacks_what_is_recorded_now_is_not_resumed(tmp_path, monkeypatch):
    variables_of = recorded.variables_of
    older = [name for name in variables_of("cylindrical_roller") if name != "pocket_peak"]
    monkeypatch.setattr(recorded, "variables_of", lambda family: older)
    arrays = recorder.recorded
    monkeypatch.setattr(
        recorder, "recorded",
        lambda *a: {k: v for k, v in arrays(*a).items() if k != "pocket_peak"},
    )  # fmt: skip
    with pytest.raises(KeyboardInterrupt):
        simulate(case_of("rigid"), out=tmp_path, progress=Interrupted(1, BLOCK))
    monkeypatch.undo()
    with pytest.raises(InputError, match="another flexcage: it holds no 'pocket_peak'"):
        simulate(case_of("rigid"), out=tmp_path, resume=True)
    assert load_run(tmp_path).summary["pocket_force_peak"] > 0.0  # of its samples


def test_a_checkpoint_of_another_flexcage_is_refused(tmp_path, monkeypatch):
    with pytest.raises(KeyboardInterrupt):
        simulate(case_of("rigid"), out=tmp_path, progress=Interrupted(1, BLOCK))
    whole = RunStore.checkpoint
    monkeypatch.setattr(
        RunStore,
        "checkpoint",
        lambda store: {**whole(store), "memory_deflection": np.zeros((22, 8))},
    )
    with pytest.raises(InputError, match=r"holds \(22, 8\) of 'memory_deflection'"):
        simulate(case_of("rigid"), out=tmp_path, resume=True)


def test_a_run_killed_before_its_first_block_begins_anew(tmp_path, unbroken, caplog):
    """Whatever it left: the case alone, or arrays that no commit counts."""
    for left in ((), ("zarr.json",)):
        folder = tmp_path / f"left{len(left)}"
        write_case(folder, case_of("rigid"))
        for name in left:
            (folder / "results.zarr").mkdir()
            (folder / "results.zarr" / name).write_text("{")
        assert_same(simulate(case_of("rigid"), out=folder, resume=True), unbroken["rigid"])
        assert "begins anew" in caplog.text


def test_blocks_without_the_file_that_counts_them_are_kept(tmp_path):
    simulate(case_of("rigid"), out=tmp_path)
    (tmp_path / "results.zarr" / "_run" / "commit.json").unlink()
    before = sorted(tmp_path.rglob("*"))
    with pytest.raises(InputError, match=r"damaged: it holds blocks, but lacks _run/commit.json"):
        simulate(case_of("rigid"), out=tmp_path, resume=True)
    assert sorted(tmp_path.rglob("*")) == before


def test_a_run_of_another_format_is_refused_wherever_it_is_read(tmp_path, capsys):
    """Before its case is read, which another flexcage may have written with other words."""
    case, folder = tmp_path / "case.toml", tmp_path / "run"
    case.write_text(case_of("rigid").to_toml(), encoding="utf-8")
    simulate(case_of("rigid"), out=folder)
    commit = folder / "results.zarr" / "_run" / "commit.json"
    commit.write_text(commit.read_text("utf-8").replace('"format": 6', '"format": 3'), "utf-8")
    (folder / "case.toml").write_text("[bearing]\nformer_word = 1\n", encoding="utf-8")
    other = shutil.copytree(folder, tmp_path / "other")
    for command in (
        ["run", str(case), "-o", str(folder), "--resume"],
        ["render", str(folder)],
        ["report", str(folder)],
        ["compare", str(folder), str(other), "-o", str(tmp_path / "both")],
    ):
        assert main(command) == 2
        assert "is stored in format 3, and this flexcage" in capsys.readouterr().err


def test_nothing_is_resumed_where_no_run_was(tmp_path):
    (tmp_path / "results.zarr").mkdir()
    (tmp_path / "results.zarr" / "mine").write_text("kept")
    with pytest.raises(InputError, match="is not the folder of a run"):
        simulate(case_of("rigid"), out=tmp_path, resume=True)
    assert (tmp_path / "results.zarr" / "mine").exists()
