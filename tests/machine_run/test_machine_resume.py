"""A machine's run that stopped goes on as if it had not, bit by bit; another machine is refused."""

import shutil

import numpy as np
import pytest
from turning_machines import spindle

from flexcage import load_run
from flexcage.cli import main
from flexcage.core import sources
from flexcage.core.errors import InputError
from flexcage.machine import load_machine
from flexcage.machine_run import load_machine_run, simulate_machine
from flexcage.results.store import RunStore
from flexcage.run import seams

NAMES = ("front", "rear")


def machine(**changes):
    """One that turns for three blocks of 1 ms."""
    return load_machine(spindle(duration=3, unbalance=5), overrides=changes)


def stopped(out, block, *, before):
    """A run that Ctrl-C stops when all bearings have so many more blocks: ``before`` the shaft's
    store counts the last of them, or just after."""
    write = RunStore.write_block

    def stop(store, index, *args, **more):
        last = store.path.name == "shaft.zarr" and index == block - 1
        if last and before:
            raise KeyboardInterrupt
        write(store, index, *args, **more)
        if last:
            raise KeyboardInterrupt

    with pytest.MonkeyPatch.context() as patch, pytest.raises(KeyboardInterrupt):
        patch.setattr(RunStore, "write_block", stop)
        simulate_machine(machine(), out=out, stress=False)
    return out


@pytest.fixture(scope="module")
def unbroken(tmp_path_factory):
    return simulate_machine(machine(), out=tmp_path_factory.mktemp("whole"), stress=False)


@pytest.fixture(scope="module")
def half(tmp_path_factory):
    """Stopped between the bearings' second block and the shaft's."""
    return stopped(tmp_path_factory.mktemp("half"), 2, before=True)


def copied(folder, tmp_path):
    return shutil.copytree(folder, tmp_path / "copy")


def assert_the_same(ours, theirs):
    """Shaft, bearings, their steps and events, bit by bit."""
    for name in theirs.shaft.variables:
        np.testing.assert_array_equal(ours.shaft[name].values, theirs.shaft[name].values, name)
    for bearing in NAMES:
        a, b = ours[bearing], theirs[bearing]
        for name in b.dataset.variables:
            np.testing.assert_array_equal(a.dataset[name].values, b.dataset[name].values, name)
        for table in ("steps", "events"):
            ones, others = (getattr(run.store, table)() for run in (a, b))
            for column in others:
                np.testing.assert_array_equal(ones[column], others[column], column)
    assert ours.summary.to_dict() == theirs.summary.to_dict()


def test_a_machine_that_goes_on_is_the_unbroken_one(tmp_path, half, unbroken, caplog):
    """It was stopped when its bearings had one block more than its shaft."""
    folder = copied(half, tmp_path)
    stores = [RunStore.open(folder / name) for name in ("shaft.zarr", "front/results.zarr")]
    assert [store.blocks for store in stores] == [1, 2]
    part = load_machine_run(folder)
    assert part.shaft.sizes["time"] == 50 and np.isfinite(part.shaft["force"].values).all()
    assert f"flexcage run {folder / 'machine.toml'} -o {folder} --resume" in caplog.text
    resumed = simulate_machine(machine(), out=folder, resume=True, stress=False)
    assert_the_same(resumed, unbroken)
    assert_the_same(load_machine_run(folder), unbroken)


def test_a_stored_machine_goes_on_from_its_own_file_on_the_command_line(
    tmp_path, half, unbroken, capsys
):
    folder = copied(half, tmp_path)
    command = ["run", str(folder / "machine.toml"), "-o", str(folder), "--no-images"]
    assert main(command) == 2
    assert "--resume goes on with it, --force writes it anew" in capsys.readouterr().err
    assert main([*command, "--resume"]) == 0
    assert_the_same(load_machine_run(folder), unbroken)
    assert main([*command, "--resume"]) == 0  # a finished run stays as it is
    assert_the_same(load_machine_run(folder), unbroken)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        ({"drive.speed": "9000 rpm"}, r"drive.speed is 9000 rpm, was 8000 rpm"),
        ({"bearings.rear.axial_offset": "5 um"}, r"bearings.rear.axial_offset is 5 um, was 4 um"),
        ({"bearings.front.lubricant.viscosity": "0.1 Pa*s"}, r"bearings.front.lubricant"),
        ({"bearings.front.cage.model": "flexible"}, r"bearings.front.cage.model is flexible"),
        ({"solver.duration": "5 ms"}, r"solver.duration is 0.005 s, was 0.003 s"),
    ],
)
def test_another_machine_is_not_gone_on_with(half, change, said):
    with pytest.raises(InputError, match=rf"differs from the one of the run in .* \(.*{said}"):
        simulate_machine(machine(**change), out=half, resume=True)


def test_names_and_speeds_of_a_diagram_do_not_count(tmp_path, half):
    folder = copied(half, tmp_path)
    renamed = machine(name="other", **{"whirl.points": 5})
    assert simulate_machine(renamed, out=folder, resume=True, stress=False).record


def test_a_stored_machine_is_the_one_that_was_run(tmp_path, unbroken):
    """An edit of machine.toml afterwards changes no figure."""
    folder = copied(unbroken.folder, tmp_path)
    text = (folder / "machine.toml").read_text()
    assert "8000 rpm" in text
    (folder / "machine.toml").write_text(text.replace("8000 rpm", "4000 rpm"))
    again = load_machine_run(folder)
    assert again.machine == unbroken.machine
    assert again.summary.to_dict() == unbroken.summary.to_dict()


def test_other_physics_goes_on_only_when_asked(tmp_path, half, monkeypatch):
    folder = copied(half, tmp_path)
    monkeypatch.setattr(seams, "physics", lambda: "0123456789abcdef")
    with pytest.raises(InputError, match="whose sources of physics differ"):
        simulate_machine(machine(), out=folder, resume=True)
    run = simulate_machine(machine(), out=folder, resume=True, other_version=True, stress=False)
    assert any("other sources of physics" in text for text in run.summary.warnings)
    assert sources.physics() != "0123456789abcdef"


def test_a_bearing_of_a_machine_does_not_go_on_alone(half):
    front = load_run(half / "front")
    with pytest.raises(InputError, match=r"that of a bearing in a machine.*machine.toml -o"):
        from flexcage import simulate

        simulate(front.case, out=half / "front", resume=True)


def test_what_has_not_begun_begins(tmp_path, half, unbroken):
    """Stopped before the shaft's store was made; and where there is nothing at all."""
    with pytest.raises(InputError, match="no machine.toml.*nothing to resume"):
        simulate_machine(machine(), out=tmp_path / "none", resume=True)
    folder = copied(half, tmp_path)
    shutil.rmtree(folder / "shaft.zarr")
    with pytest.raises(InputError, match="shaft.zarr is damaged: it is gone"):
        simulate_machine(machine(), out=folder, resume=True)
    for name in NAMES:
        shutil.rmtree(folder / name / "results.zarr")
    begun = simulate_machine(machine(), out=folder, resume=True, stress=False)
    assert_the_same(begun, unbroken)


def test_a_bearing_s_store_of_another_length_is_told(tmp_path, half, unbroken):
    folder = copied(half, tmp_path)
    shutil.rmtree(folder / "rear" / "results.zarr")
    shutil.copytree(unbroken.folder / "rear" / "results.zarr", folder / "rear" / "results.zarr")
    with pytest.raises(InputError, match="holds 3 blocks, but the shaft's 1"):
        simulate_machine(machine(), out=folder, resume=True)
