"""Data sets of signals: rows, truth and splits of a study's runs; what is damaged or wrong."""

from __future__ import annotations

import json
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pyarrow.parquet as pq
import pytest
from study_cases import short_case

from flexcage.case import load_case
from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.core.hashing import sealed
from flexcage.study.dataset.build import build_dataset, write_index
from flexcage.study.dataset.check import check_dataset
from flexcage.study.dataset.folder import DatasetFolder, Settings
from flexcage.study.dataset.labels import Fault, fault_of, level_of, severity_of
from flexcage.study.dataset.splits import leaks, split, splits_of

SENSORS = [
    {"type": "accelerometer", "name": "casing", "rate": "50 kHz", "noise": "0.01 m/s^2/Hz^0.5"},
    {"type": "tacho", "name": "key"},
]  # fmt: skip
POINTS = """
[[axes]]
type = "list"
name = "fault"
points = [
  { label = "sound" },
  { label = "spall", "bearing.outer_spall.length" = "1 mm", "load.radial" = "1500 N" },
  { label = "small", "bearing.outer_spall.length" = "0.4 mm", "load.radial" = "2000 N" },
]
"""
EDGES = Settings(edges=(0.6e-3,), title="Small spalls")


def study_in(folder: Path, axes: str = POINTS, *, sensors=SENSORS, keep="runs", **changes) -> Path:
    folder.mkdir(exist_ok=True)
    case = short_case(**{"solver.duration": "1 ms", "output.settle": 0.0, **changes})
    case = load_case({**case.to_table(), "sensors": sensors})
    (folder / "case.toml").write_text(case.to_toml())
    path = folder / "study.toml"
    outputs = 'outputs = ["cage_speed"]'
    path.write_text(f'name = "s"\ncase = "case.toml"\n{outputs}\nkeep = "{keep}"\n{axes}')
    return path


@pytest.fixture(scope="module")
def built(tmp_path_factory):
    folder = tmp_path_factory.mktemp("dataset")
    build_dataset(study_in(folder / "in"), folder / "small", settings=EDGES, workers=1)
    return folder / "small"


@pytest.fixture
def copy(built, tmp_path):
    """A copy without the runs."""
    return Path(shutil.copytree(built, tmp_path / "small", ignore=lambda *_: ["study"]))


def table(folder, name):
    return pq.read_table(folder / name).to_pylist()


def test_every_case_is_a_recording_with_its_labels(built):
    rows = table(built, "metadata.parquet")
    assert len(rows) == 6 and {row["dataset"] for row in rows} == {"small"}
    casing = {row["native_label"]: row for row in rows if row["channel"] == "casing"}
    assert [casing[k]["fault_type"] for k in ("sound", "spall", "small")] == [
        "normal", "outer", "outer"
    ]  # fmt: skip
    assert [casing[k]["fault_severity_level"] for k in ("sound", "spall", "small")] == [0, 2, 1]
    assert casing["spall"]["fault_severity"] == "above 0.6 mm"
    assert casing["sound"]["fault_location"] == "none" and not casing["sound"]["sensor_at_fault"]
    assert casing["spall"]["bpfo"] == pytest.approx(11 * (1 - 8 / 82.5))
    assert (casing["spall"]["load"], casing["spall"]["fs"]) == (1500.0, 50e3)
    assert len({row["bearing_id"] for row in rows}) == 3
    for row in rows:
        file = pq.ParquetFile(built / "signals" / row["signal_file"])
        found = file.read_row_group(row["signal_row_group"]).to_pylist()[row["signal_row"]]
        assert found["signal_id"] == row["signal_id"] and len(found["signal"]) == row["n_samples"]


def test_the_truth_is_what_the_runs_have(built):
    from flexcage import load_run

    rows = {row["recording_id"]: row for row in table(built, "truth.parquet")}
    for recording, row in rows.items():
        run = load_run(built / "study" / "cases" / recording)
        race = run.dataset["race_force"].sel(race="outer").values
        assert row["outer_race_force_max"] == pytest.approx(race.max(), rel=1e-6)
        assert row["figure.cage_speed"] == pytest.approx(run.summary["cage_speed"], rel=1e-9)
        assert row["audit"] == run.summary["energy_audit"]
        hidden = pq.read_table(built / "truth" / f"{recording}.parquet").to_pandas()
        np.testing.assert_allclose(hidden["outer_race_force"], race.max(axis=1), rtol=1e-6)
        if row["fault_type"] == "outer":  # the spall is where the most loaded roller begins
            psi = run.dataset["element_position"].sel(cyl="psi").values
            near = np.abs(np.angle(np.exp(1j * psi))).argmin(axis=1)
            own = race[np.arange(len(psi)), near]
            np.testing.assert_allclose(hidden["defect_force"], own, rtol=1e-6)
    assert len({row["noise_seed"] for row in rows.values()}) == 3
    assert not any(name.startswith("figure.wall") for name in next(iter(rows.values())))


def test_what_is_there_is_not_made_again_and_others_are_added(built, tmp_path):
    out = tmp_path / "small"
    shutil.copytree(built, out)
    before = {p: p.stat().st_mtime_ns for p in (out / "signals").iterdir()}
    sums = (out / "checksums.json").read_bytes()
    build_dataset(study_in(tmp_path / "in"), out, workers=1)
    assert (out / "checksums.json").read_bytes() == sums
    assert {p: p.stat().st_mtime_ns for p in (out / "signals").iterdir()} == before
    more = '[[axes]]\ntype = "grid"\npath = "load.radial"\nvalues = ["700 N"]\n'
    build_dataset(study_in(tmp_path / "more", more), out, workers=1)
    assert len(table(out, "truth.parquet")) == 4 and not check_dataset(out).faults
    assert {p: p.stat().st_mtime_ns for p in before} == before


@pytest.mark.parametrize(
    ("harm", "words"),
    [
        (lambda f: _flip(next((f / "signals").iterdir())), "was changed"),
        (lambda f: next((f / "truth").iterdir()).unlink(), "is not there"),
        (lambda f: (f / "metadata.parquet").unlink(), "'metadata.parquet' is not there"),
        (lambda f: (f / "signals" / "part-x.parquet").write_bytes(b"x"), "is of no recording"),
        (lambda f: _flip(f / "README.md"), "'README.md' was changed"),
    ],
)
def test_a_check_finds_what_was_harmed(copy, harm, words):
    assert check_dataset(copy).text().endswith("all as written, no split leaks")
    harm(copy)
    assert words in check_dataset(copy).text()
    assert main(["dataset", "check", str(copy)]) == 1


def _flip(path):
    content = bytearray(path.read_bytes())
    content[len(content) // 2] ^= 1
    path.write_bytes(bytes(content))


def test_an_edited_record_and_a_newer_schema_are_refused(copy, capsys):
    settings = json.loads((copy / "settings.json").read_text())
    settings.pop("seal")
    (copy / "settings.json").write_text(json.dumps(sealed({**settings, "schema": 3})))
    assert main(["dataset", "check", str(copy)]) == 2
    assert "is of schema 3, and this flexcage knows 2: take a newer" in capsys.readouterr().err
    (copy / "settings.json").write_text(json.dumps(sealed(settings)))
    record = next((copy / "records").iterdir())
    record.write_text(record.read_text().replace("outer", "inner").replace("normal", "inner"))
    with pytest.raises(InputError, match="is not what was written .it was edited"):
        check_dataset(copy)


def test_mistakes_are_one_sentence(built, tmp_path, capsys):
    def said(*args):
        assert main(["dataset", *map(str, args)]) == 2
        return capsys.readouterr().err

    bare = study_in(tmp_path / "a", sensors=[])
    assert "has no sensors; give it [[sensors]]" in said(bare, "-o", tmp_path / "o")
    good = study_in(tmp_path / "c")
    rising = said(good, "-o", tmp_path / "o", "--severity", "2 mm, 1 mm")
    assert "are 2 mm, 1 mm, but should be rising" in rising
    assert "--severity" in said(good, "-o", tmp_path / "o", "--severity", "2")
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "thesis.txt").write_text("x")
    assert "holds files and no data set" in said(good, "-o", tmp_path / "mine")
    assert "thesis.txt" in said(good, "-o", tmp_path / "mine" / "thesis.txt")
    assert "holds no data set" in said("check", tmp_path / "mine")
    assert "severity edges 0.6 mm" in said(good, "-o", built, "--severity", "1 mm")
    assert "check takes the folder of one data set" in said("check")
    assert "holds no shards to merge" in said("merge", built)
    assert "should be I/N" in said(good, "-o", tmp_path / "o", "--shard", "3/2")
    assert not (tmp_path / "o").exists()


def test_a_class_without_cases_is_one_sentence(tmp_path):
    failing = POINTS.replace('"load.radial" = "1500 N"', '"solver.max_steps" = 10')
    with pytest.raises(InputError, match=r"The class 'spall' \(fault\) has no finished case: "):
        build_dataset(study_in(tmp_path / "in", failing), tmp_path / "o", workers=1)
    assert not (tmp_path / "o" / "metadata.parquet").exists()


def test_a_severity_without_recordings_is_one_sentence(copy):
    with pytest.raises(InputError, match="severity 'up to 0.2 mm' has no recording"):
        write_index(DatasetFolder(copy), Settings(edges=(0.2e-3, 0.6e-3)))


def test_faults_of_cases():
    assert fault_of(short_case()) == Fault(())
    both = short_case(**{"bearing.outer_spall.length": "1 mm", "bearing.roller_spot.size": "2 mm"})
    assert fault_of(both).name == "outer+rolling_element" and fault_of(both).size == 2e-3
    assert fault_of(both).place == "test_bearing+test_bearing"
    assert fault_of(short_case(**{"cage.unbalance": "3 g*mm"})) == Fault(("cage",))
    bent = {"type": "crossbeam", "crossbeam": 5, "displacement": "0.2 mm"}
    found = fault_of(load_case({**short_case().to_table(), "defects": [bent]}))
    assert found.kinds == ("cage",) and found.size == pytest.approx(0.2e-3)
    assert [level_of(Fault(("inner",), s), (1e-3, 2e-3)) for s in (1e-3, 1.1e-3, 3e-3)] == [1, 2, 3]
    assert severity_of(Fault(("cage",)), (1e-3,)) == "not graded"


@pytest.mark.parametrize("count", [1, 2, 3, 7, 40])
def test_splits_part_groups_and_no_group_is_parted(count):
    truth = [
        {"recording_id": f"r{i}", "bearing_id": f"b{i % count}", "load_group": f"{i % 3} N",
         "seed": i % 2}
        for i in range(3 * count)
    ]  # fmt: skip
    rows = splits_of(truth)
    assert not leaks(rows, truth)
    sides = set(split([f"b{i}" for i in range(count)]).values())
    wanted = {1: {"train"}, 2: {"train", "test"}}.get(count, {"train", "validation", "test"})
    assert sides == wanted
    rows[0]["by_bearing"] = "elsewhere"
    assert (leaks(rows, truth) != []) == (3 * count > count)


KILLED = """
import sys
from flexcage.study.dataset.folder import DatasetFolder, Settings
from flexcage.study.dataset.build import write_index
from flexcage.study.dataset.recording import Recording
import pyarrow as pa
from flexcage.study.dataset.recording import parquet

folder = DatasetFolder(sys.argv[1])
with folder.held():
    folder.prepare(Settings())
    print("begun", flush=True)
    for k in range(60):
        name = f"{k:016x}"
        if folder.has(name):
            continue
        table = pa.table({"signal_id": [f"{name}/a"], "signal": [[float(k)] * 2000]})
        row = {"dataset": "d", "signal_id": f"{name}/a", "recording_id": name, "channel": "a",
               "fault_type": "normal", "fault_severity": "none", "quantity": "acceleration",
               "unit": "m/s^2", "fs": 1e3, "n_samples": 2000, "signal_file": f"part-{name}.parquet",
               "signal_row_group": 0, "signal_row": 0}
        truth = {"recording_id": name, "bearing_id": str(k % 9), "load_group": "1", "seed": k}
        files = {f"signals/part-{name}.parquet": parquet(table),
                 f"truth/{name}.parquet": parquet(table)}
        folder.add(name, Recording(files, [row], truth))
        write_index(folder, Settings())
print("done", flush=True)
"""


@pytest.mark.slow
def test_nothing_is_lost_or_half_written_by_twenty_kills(tmp_path):
    """Killed at any moment, then finished: as if it had never been."""
    rng = np.random.default_rng(1)

    def begun(out):
        child = subprocess.Popen(
            [sys.executable, "-c", KILLED, str(out)], stdout=subprocess.PIPE, text=True
        )
        assert child.stdout is not None and child.stdout.readline() == "begun\n"
        return child

    had = 0
    for _ in range(20):
        child = begun(tmp_path / "d")
        time.sleep(rng.uniform(0.0, 0.15))
        child.send_signal(signal.SIGKILL)
        child.wait()
        there = len(DatasetFolder(tmp_path / "d").records())  # each is whole
        assert there >= had
        had = there
    for out in ("d", "e"):
        child = begun(tmp_path / out)
        assert child.communicate(timeout=300)[0] == "done\n"
        assert not check_dataset(tmp_path / out).faults
    own, other = (DatasetFolder(tmp_path / out).checksums() for out in ("d", "e"))
    differ = {k for k in own if own[k] != other[k]}
    assert set(own) == set(other) and differ <= {"README.md", "manifest.json", "croissant.json"}


def test_bearing_datasets_reads_it(built):
    bearing_datasets = pytest.importorskip("bearing_datasets")
    from bearing_datasets.schema import validate

    found = bearing_datasets.open("small", root=built.parent)
    rows = found.metadata()
    validate(rows, found.manifest["columns"])
    casing = rows[rows["channel"] == "casing"].iloc[0]
    assert len(found.signal(casing["signal_id"])) == casing["n_samples"]
    in_g = found.signal(casing["signal_id"], unit="g")
    np.testing.assert_allclose(in_g * 9.80665, found.signal(casing["signal_id"]), rtol=1e-5)


def test_croissant_is_valid(built):
    mlcroissant = pytest.importorskip("mlcroissant")
    found = mlcroissant.Dataset(str(built / "croissant.json"))
    assert not found.metadata.ctx.issues.errors
    assert len(list(found.records("signals"))) == 6


def test_the_example_is_a_study_that_a_data_set_takes():
    from flexcage.study.plan import make_plan
    from flexcage.study.spec import load_study

    study = load_study(Path(__file__).parents[2] / "examples" / "signals_study.toml")
    plan = make_plan(study)
    kinds = [fault_of(plan.case(planned)).name for planned in plan.cases]
    assert sorted(set(kinds)) == ["cage", "inner", "normal", "outer", "rolling_element"]
    assert len(kinds) == 12 and len(study.case.sensors) == 5
