"""Data sets that keep no runs, and their shards: recorded as cases finish, whatever is killed."""

from __future__ import annotations

import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import replace

import numpy as np
import pyarrow.parquet as pq
import pytest
from fake_case import fake_do_case
from test_dataset import EDGES, POINTS, study_in

from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.study import cluster, desk, sharded, work
from flexcage.study.dataset.check import check_dataset
from flexcage.study.dataset.folder import DatasetFolder
from flexcage.study.dataset.keeping import RecordingKeeper
from flexcage.study.dataset.recording import Recording
from flexcage.study.dataset.sharded import build_shard, merge_dataset
from flexcage.study.folder import SHARDS, Folder
from flexcage.study.origin import Origin


def kept_nothing(folder, axes=POINTS, **changes):
    """The study without a word of what it keeps."""
    path = study_in(folder, axes, **changes)
    path.write_text(path.read_text().replace('keep = "runs"\n', ""))
    return path


@pytest.fixture(scope="module")
def shards(tmp_path_factory):
    """A study's file, and a data set of two shards that is not merged."""
    top = tmp_path_factory.mktemp("shards")
    path = kept_nothing(top / "in")
    for k in (1, 2):
        build_shard(path, top / "small", f"{k}/2", settings=EDGES, workers=1)
    return path, top / "small"


@pytest.fixture
def two(shards, tmp_path):
    return shards[0], shutil.copytree(shards[1], tmp_path / "small")


@pytest.fixture
def computed(monkeypatch):
    """Hashes of the cases that were simulated."""
    found, simulate = [], work.simulate
    monkeypatch.setattr(work, "simulate", lambda c, **k: found.append(c.hash) or simulate(c, **k))
    return found


def test_no_run_stays_and_figures_do(two):
    path, out = two
    folder, missing = merge_dataset(out)
    assert not missing and not check_dataset(out).faults and not (out / SHARDS).exists()
    cases = [p for p in (out / "study" / "cases").iterdir() if p.is_dir()]
    assert len(cases) == 3 and len(folder.records()) == 3
    for case in cases:
        assert {p.name for p in case.iterdir()} == {"case.toml", "row.json", "zarr.json"}
    assert (out / "study" / "table.csv").is_file()
    rows = pq.read_table(out / "metadata.parquet").to_pylist()
    assert {row["dataset"] for row in rows} == {"small"}  # of the whole, not of the shard
    assert main(["dataset", "check", str(out)]) == 0


def test_what_is_recorded_is_not_computed_again(two, computed):
    path, out = two
    merge_dataset(out)
    shutil.rmtree(out / "study" / "cases")
    for k in (1, 2):
        build_shard(path, out, f"{k}/2", workers=1)
    assert not computed
    record = next((out / "records").iterdir())
    record.unlink()
    for k in (1, 2):
        build_shard(path, out, f"{k}/2", workers=1)
    assert computed == [record.stem]
    assert not merge_dataset(out)[1] and not check_dataset(out).faults


@pytest.mark.parametrize("when", ["before", "after"])
def test_a_kill_about_the_recording_of_a_case(two, computed, monkeypatch, when):
    """Before, the case is computed again; after, it only gets its name."""
    path, out = two
    one = out / SHARDS / "1-of-2"
    name = next(Folder(one / "study").finished())
    shutil.rmtree(one / "study" / "cases" / name)
    (one / "records" / f"{name}.json").unlink()
    keep = RecordingKeeper.keep

    def killed(self, run, row):
        if when == "after":
            keep(self, run, row)
        raise KeyboardInterrupt

    monkeypatch.setattr(RecordingKeeper, "keep", killed)
    with pytest.raises(KeyboardInterrupt):
        build_shard(path, out, "1/2", workers=1)
    monkeypatch.setattr(RecordingKeeper, "keep", keep)
    state = build_shard(path, out, "1/2", workers=1)
    assert computed == [name] * (2 if when == "before" else 1) and state.open == 0
    assert not merge_dataset(out)[1] and not check_dataset(out).faults


def test_a_missing_shard_and_a_conflict(two, tmp_path, capsys):
    path, out = two
    shutil.move(out / SHARDS / "2-of-2", tmp_path / "away")
    assert main(["dataset", "merge", str(out)]) == 1
    assert "Missing: shard 2 of 2; compute it with 'flexcage dataset" in capsys.readouterr().out
    shutil.move(tmp_path / "away", out / SHARDS / "2-of-2")
    assert main(["dataset", "merge", str(out)]) == 0
    name = DatasetFolder(out).records()[0]["hash"]
    shard = DatasetFolder(out / SHARDS / "1-of-2")
    shard.prepare(EDGES)
    shard.add(name, Recording({f"signals/part-{name}.parquet": b"x"}, [], {}))
    with pytest.raises(InputError, match=f"Recording {name} is in .* with other content"):
        merge_dataset(out)


def test_a_planned_data_set_is_not_planned_again(tmp_path, monkeypatch, capsys):
    path, out = kept_nothing(tmp_path / "in"), tmp_path / "o"
    monkeypatch.setattr(desk, "do_case", fake_do_case)
    assert main(["dataset", "plan", str(path), "-o", str(out)]) == 0
    assert "3 cases are planned in" in capsys.readouterr().out
    monkeypatch.setattr(sharded, "make_plan", lambda study: pytest.fail("planned again"))
    for k in (1, 2):
        one = ["dataset", str(path), "-o", str(out), "--workers", "1", "--shard", f"{k}/2"]
        assert main(one) == 0
    assert main(["dataset", "merge", str(out)]) == 0
    assert "3 recordings, 3 signals" in capsys.readouterr().out


@pytest.fixture
def quick(tmp_path, monkeypatch):
    """A study's file, and where its data set is made; its cases are finished at once."""
    monkeypatch.setattr(desk, "do_case", fake_do_case)
    return kept_nothing(tmp_path / "in"), tmp_path / "o"


def test_a_shard_goes_on_that_a_merge_left_there(quick):
    """A case that was killed, or failed, leaves its beginning."""
    path, out = quick
    build_shard(path, out, "1/2", workers=1)
    begun = out / SHARDS / "1-of-2" / "study" / "cases" / "0123456789abcdef.part"
    begun.mkdir()
    (begun / "case.toml").write_text("")
    assert [shard.index for shard in merge_dataset(out)[1]] == [2] and begun.is_dir()
    for k in (1, 2):
        assert build_shard(path, out, f"{k}/2", workers=1).open == 0
    assert not merge_dataset(out)[1]


def test_a_shard_whose_cases_are_recorded_is_not_open(quick):
    path, out = quick
    for k in (1, 2):
        build_shard(path, out, f"{k}/2", workers=1)
    shutil.rmtree(out / SHARDS / "1-of-2" / "study")
    states = [build_shard(path, out, "1/2", workers=1)]
    merge_dataset(out)
    shutil.rmtree(out / "study")
    states += [build_shard(path, out, f"{k}/2", workers=1) for k in (1, 2)]
    assert [(s.done, s.failed, s.open) for s in states] == [(2, 0, 0), (2, 0, 0), (1, 0, 0)]


def test_a_package_that_data_sets_lack_is_named(quick, monkeypatch, capsys):
    path, out = quick
    monkeypatch.setattr(cluster, "find_spec", lambda name: None)
    assert main(["dataset", str(path), "-o", str(out)]) == 1 and not out.exists()
    assert "sources:  pip install '.[study]'" in capsys.readouterr().err


def test_a_merge_looks_once_at_what_is_merged(quick, monkeypatch):
    """Not once a shard: with 1,000 of them all cases would be listed 1,000 times."""
    path, out = quick
    for k in (1, 2, 3):
        build_shard(path, out, f"{k}/3", workers=1)
    looked, finished = [], Folder.finished
    monkeypatch.setattr(Folder, "finished", lambda self: looked.append(self) or finished(self))
    assert not merge_dataset(out)[1]
    assert [f.path for f in looked].count((out / "study").resolve()) == 1


@pytest.mark.parametrize("merging", [True, False])
def test_shards_of_other_physics_are_merged_if_asked(quick, capsys, merging):
    path, out = quick
    for k in (1, 2):
        build_shard(path, out, f"{k}/2", workers=1)
    shard = Folder(out / SHARDS / "1-of-2" / "study")
    name = next(shard.finished())
    row = replace(shard.row(name), origin=Origin("0.0.1", "f" * 16))
    shard.write_row(shard.case(name), row)
    command = ["dataset", "merge", str(out)] if merging else ["dataset", str(path), "-o", str(out)]
    assert main(command) == 2 and "--other-version" in capsys.readouterr().err
    assert main([*command, "--other-version"]) == 0
    assert "3 recordings, 3 signals" in capsys.readouterr().out


def test_a_class_without_cases_is_refused_by_the_merge(tmp_path):
    failing = POINTS.replace('"load.radial" = "1500 N"', '"solver.max_steps" = 10')
    path = kept_nothing(tmp_path / "in", failing)
    for k in (1, 2, 3):
        build_shard(path, tmp_path / "o", f"{k}/3", workers=1)
    with pytest.raises(InputError, match=r"The class 'spall' \(fault\) has no finished case: "):
        merge_dataset(tmp_path / "o")


def test_a_recording_of_a_run_in_memory_is_that_of_a_stored_one(two, tmp_path):
    _, out = two
    path = study_in(tmp_path / "in")
    kept = tmp_path / "kept"
    build_shard(path, kept, "1/1", settings=EDGES, workers=1)
    merge_dataset(out)
    stored, _ = merge_dataset(kept)
    assert len(list((kept / "study" / "cases").glob("*/results.zarr"))) == 3
    for record in stored.records():
        for file in record["files"]:
            ours, theirs = (pq.read_table(f / file).to_pandas() for f in (out, stored.path))
            if file.startswith("signals"):
                for a, b in zip(ours["signal"], theirs["signal"]):
                    np.testing.assert_allclose(a, b, rtol=1e-6, atol=1e-6 * np.abs(b).max())
            else:
                np.testing.assert_allclose(ours, theirs, rtol=1e-6, atol=1e-9)


LONGER = '[[axes]]\npath = "load.radial"\nvalues = [{}]\n'


@pytest.mark.slow
def test_a_build_without_runs_survives_kills(tmp_path):
    """Killed at any moment, a build goes on and touches no recording that is there."""
    axis = LONGER.format(", ".join(f'"{500 + 10 * k} N"' for k in range(20)))
    path, out = kept_nothing(tmp_path / "in", axis), tmp_path / "d"
    command = [sys.executable, "-m", "flexcage", "dataset", str(path), "-o", str(out)]
    rng, before = np.random.default_rng(3), {}
    shard = out / SHARDS / "1-of-1"
    for _ in range(20):
        child = subprocess.Popen([*command, "--shard", "1/1", "--workers", "1"])
        begun = time.monotonic()
        while time.monotonic() - begun < 60.0 and len(list(shard.glob("records/*.json"))) <= len(
            before
        ):
            time.sleep(0.05)
        time.sleep(rng.uniform(0.0, 0.6))
        child.send_signal(signal.SIGKILL)
        child.wait()
        now = {p: os.stat(p).st_mtime_ns for p in shard.glob("records/*.json")}
        assert all(now[p] == stamp for p, stamp in before.items())
        before = now
        if child.returncode == 0 or len(before) == 20:
            break
    assert subprocess.call([*command, "--shard", "1/1", "--workers", "1"]) == 0
    assert main(["dataset", "merge", str(out)]) == 0
    assert len(DatasetFolder(out).records()) == 20 and not check_dataset(out).faults
