"""A run's folder is complete: read, drawn and resumed from it alone, with the same numbers."""

import json
import os
import shutil
import subprocess
import sys
from dataclasses import replace

import numpy as np
import pytest
from simulate_cases import Interrupted, bent, n1013
from test_resume import BLOCK, assert_same

from flexcage.core.errors import InputError
from flexcage.mesh.io import write_mesh
from flexcage.modes import reduction
from flexcage.results.cage_file import read_cage
from flexcage.simulate import load_run, simulate
from flexcage.stress.loads import cage_loads
from flexcage.stress.recovery import StressRecovery

CASE = n1013({"solver.duration": "3 ms"}, defects=bent("0.2 mm"))


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return simulate(CASE, out=tmp_path_factory.mktemp("runs") / "bent")


@pytest.fixture
def bare(monkeypatch, tmp_path):
    take_all(monkeypatch, tmp_path)


def take_all(monkeypatch, tmp_path):
    """Leave a machine with an empty cache, without gmsh, on which no modes can be found."""
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "empty"))
    monkeypatch.setitem(sys.modules, "gmsh", None)
    monkeypatch.setattr(reduction, "build_basis", _never)


def _never(*args, **kwargs):
    raise AssertionError("modes were made anew")


def numbers(run):
    """What a run answers, from all that it reads of its cage."""
    history, at = run.stress_history, run.stress(time=0.0021)
    return {
        "peak": history.peak,
        "places": history.places,
        "von_mises": at.von_mises,
        "displacement": at.displacement,
        "frequency": run.mode_table.frequency,
        "share": run.mode_table.share,
        "residual_share": run.mode_table.residual_share,
        "points": run.mesh.points,
    }


def test_a_run_is_read_from_its_folder_alone(run, bare):
    """Bit by bit, without cache, gmsh or a solution of the modes."""
    ours, theirs = numbers(run), numbers(load_run(run.folder))
    for name, value in ours.items():
        np.testing.assert_array_equal(theirs[name], value, err_msg=name)


def test_pictures_pages_and_series_come_from_the_folder_alone(run, bare, tmp_path):
    stored = load_run(run.folder)
    assert stored.scene(animate=True).stress.basis.size == run.cage.shown.size
    assert (stored.write_vtu(tmp_path / "vtu", times=["1 ms"])).is_file()
    assert stored.summary["stress_peak"] == run.summary["stress_peak"]


READ = """
import json, sys, flexcage
run = flexcage.load_run(sys.argv[1])
field = run.stress(time=0.0021)
print(json.dumps([float(field.von_mises.max()), float(run.stress_history.peak.max())]))
"""


@pytest.mark.parametrize("processor", ["Haswell", pytest.param("Nehalem", marks=pytest.mark.slow)])
def test_another_processor_reads_the_same_stress(run, tmp_path, processor):
    """BLAS kernels of another processor, with an empty cache: only rounding differs, of peaks of
    all steps the one to single precision."""
    text = subprocess.run(
        [sys.executable, "-c", READ, str(run.folder)],
        env={
            **os.environ,
            "OPENBLAS_CORETYPE": processor,
            "FLEXCAGE_CACHE_DIR": str(tmp_path / processor),
        },
        check=True, capture_output=True, text=True,
    ).stdout  # fmt: skip
    ours = [run.stress(time=0.0021).von_mises.max(), run.stress_history.peak.max()]
    at, peak = json.loads(text.splitlines()[-1])
    assert at == pytest.approx(ours[0], rel=1e-9) and peak == pytest.approx(ours[1], rel=2e-7)


def test_rounded_shapes_are_precise_enough(run):
    """Stress with shapes of 24 bits and of full precision differs by hundreds of pascals."""
    cage = run.cage
    exact = StressRecovery(
        cage.model, cage.basis, cage.interface, places=run.recovery.places, solver=cage.solver
    )
    loads = cage_loads(run.dataset, 100, inner=run.case.cage.guidance != "outer")
    ours, theirs = (r.stress(r.displacement(loads), loads) for r in (run.recovery, exact))
    far, peak = np.abs(ours - theirs).max(), run.stress_history.peak.max()
    assert 0.0 < far < 1e-4 * np.abs(theirs).max() and far < 2e-5 * peak


@pytest.mark.parametrize(
    "edit",
    [
        ('fineness = "coarse"', 'fineness = "medium"', "mesh.fineness is medium, was coarse"),
        ('displacement = "0.2 mm"', 'displacement = "0.1 mm"', "defects.0.displacement"),
        ("[mesh]", "[mesh", "is no case any more"),
    ],
)
def test_an_edited_case_is_named_and_ignored(run, tmp_path, caplog, edit):
    before, after, told = edit
    folder = tmp_path / "copy"
    shutil.copytree(run.folder, folder)
    text = (folder / "case.toml").read_text()
    assert before in text
    (folder / "case.toml").write_text(text.replace(before, after, 1))
    other = load_run(folder)
    assert other.case == run.case
    (record,) = [r for r in caplog.records if "after the run" in r.message]
    assert told in record.message and "ignored" in record.message
    assert [w.key for w in other.warnings][0] == "edited" and told in other.warnings[0].text
    np.testing.assert_array_equal(
        other.stress(time=0.0021).von_mises, run.stress(time=0.0021).von_mises
    )


def test_an_edited_case_is_not_resumed(run, tmp_path):
    """The case that is resumed must be the one of the results, whatever case.toml says now."""
    folder = tmp_path / "copy"
    shutil.copytree(run.folder, folder)
    other = CASE.replace("cage.material", "steel")
    (folder / "case.toml").write_text(other.to_toml())
    with pytest.raises(InputError, match=r"differs from the one of the run .*cage.material"):
        simulate(other, out=folder, resume=True)


def test_a_run_is_resumed_with_its_own_modes(run, tmp_path, monkeypatch):
    """Where nothing but its folder is left it is still the unbroken run."""
    folder = tmp_path / "half"
    with pytest.raises(KeyboardInterrupt):
        simulate(CASE, out=folder, progress=Interrupted(2, BLOCK))
    take_all(monkeypatch, tmp_path)
    resumed = simulate(CASE, out=folder, resume=True)
    assert_same(resumed, run)
    np.testing.assert_array_equal(resumed.stress_history.peak, run.stress_history.peak)


def test_a_mesh_file_that_is_gone_is_not_missed(run, tmp_path, monkeypatch):
    """Loading and resuming want the mesh of the folder, not the file that it came from."""
    file = write_mesh(run.mesh, tmp_path / "own.msh")
    case = CASE.replace({"mesh.file": str(file), "solver.duration": "2 ms"})
    folder = tmp_path / "run"
    with pytest.raises(KeyboardInterrupt):
        simulate(case, out=folder, progress=Interrupted(1, BLOCK))
    file.unlink()
    monkeypatch.setattr(reduction, "build_basis", _never)
    assert load_run(folder).stress(time="0.5 ms").von_mises.max() > 0.0
    again = simulate(
        CASE.replace({"mesh.file": str(file), "solver.duration": "2 ms"}), out=folder, resume=True
    )
    assert again.dataset.sizes["time"] == 100


def test_a_run_that_keeps_no_cage_makes_it_anew_and_compares(tmp_path, monkeypatch):
    case = CASE.replace({"output.keep_cage": False, "solver.duration": "1 ms"})
    kept = simulate(case, out=tmp_path)
    assert (tmp_path / "cage.zip").stat().st_size < 1e6
    again = load_run(tmp_path)
    np.testing.assert_array_equal(
        again.stress(time="0.5 ms").von_mises, kept.stress(time="0.5 ms").von_mises
    )
    made = reduction.build_basis

    def other(*args, **kwargs):
        basis = made(*args, **kwargs)
        return replace(basis, shapes=-basis.shapes)

    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "empty"))
    monkeypatch.setattr(reduction, "build_basis", other)
    with pytest.raises(InputError, match="did not keep its cage .* one made anew is another"):
        load_run(tmp_path)


def test_the_cage_of_another_run_is_refused(run, tmp_path):
    folder = tmp_path / "copy"
    shutil.copytree(run.folder, folder)
    rigid = simulate(
        CASE.replace({"cage.model": "rigid", "solver.duration": "1 ms"}), out=tmp_path / "rigid"
    )
    shutil.copy(rigid.folder / "cage.zip", folder / "cage.zip")
    with pytest.raises(InputError, match="is the cage of another run"):
        load_run(folder)
    (folder / "cage.zip").unlink()
    with pytest.raises(InputError, match="lacks its cage"):
        load_run(folder)


def test_the_file_of_a_coarse_cage_is_small(run):
    path = run.folder / "cage.zip"
    assert path.stat().st_size < 10e6
    assert read_cage(path).digest == run.store.layout.attrs["cage"]
