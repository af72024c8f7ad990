"""The store: round trips, blocks, kills, versions, full disks."""

import errno
import json
import math
import os
import shutil
import signal
import subprocess
import sys
import time
import warnings

import numpy as np
import pytest
import xarray as xr

from flexcage.core.errors import InputError, RunFailed
from flexcage.results.registry import (
    LABELS,
    TIME,
    TIME_HF,
    VARIABLES,
    Variable,
    run_dims,
    variable,
)
from flexcage.results.store import RunStore

VARS = ["inner_angle", "cage_position", "pocket_slice_force", "outer_acceleration"]
N, BLOCK, RATIO = 101, 25, 4


def make(path, attrs=None, **kwargs):
    n_hf = RATIO * (N - 1) + 1
    coords = {
        "time": np.arange(N) * 2e-5,
        "time_hf": np.arange(n_hf) * 5e-6,
        "pocket": np.arange(3),
        "slice": np.linspace(-1e-3, 1e-3, 5),
        "pocket_azimuth": (("pocket",), np.arange(3) * 2.0, {"units": "rad"}),
    }
    options = {"coords": coords, "variables": VARS, "n_time": N, "n_time_hf": n_hf}
    return RunStore.create(path, **options, block=BLOCK, attrs=attrs or {"case": "x"}, **kwargs)


def block(store, index, length=None):
    """Values that tell their own index: variable j at sample i is i + j/10."""
    out = []
    for grid in (TIME, TIME_HF):
        start, stop = store.layout.span(index, grid)
        if length is not None:
            stop = min(stop, start + length)
        wanted = [v for v in store.layout.variables if v.dims[0] == grid]
        out.append(
            {
                v.name: np.broadcast_to(
                    (np.arange(start, stop) + VARS.index(v.name) / 10.0).reshape(
                        -1, *[1] * (len(v.dims) - 1)
                    ),
                    (stop - start, *store.layout.shape(v)[1:]),
                )
                for v in wanted
            }
        )
    return out


def check(ds, n):
    assert ds.sizes["time"] == n
    for j, name in enumerate(VARS):
        values = ds[name].values
        expected = np.arange(len(values)) + j / 10.0
        flat = values.reshape(len(values), math.prod(values.shape[1:]))
        assert np.allclose(flat, expected[:, None], rtol=4e-5), name


@pytest.mark.parametrize("where", ["disk", "memory"])
def test_round_trip(where, tmp_path):
    store = make(tmp_path / "r.zarr" if where == "disk" else None)
    assert store.checkpoint() is None and store.steps() == {}
    for i in range(store.layout.n_blocks):
        steps = {"t": np.full(3, i), "order": np.arange(3)}
        state = {"y": np.arange(4.0) + i, "order": 2, "law": "bdf"}
        store.write_block(
            i, *block(store, i), state, {"steps": steps, "events": {"t": np.arange(i)}}
        )
    if where == "disk":
        store = RunStore.open(tmp_path / "r.zarr")
    ds = store.dataset()
    check(ds, N)
    assert store.complete and ds.attrs["complete"] == 1 and ds.attrs["case"] == "x"
    assert ds.sizes["time_hf"] == RATIO * (N - 1) + 1
    assert ds["cage_position"].attrs == VARIABLES["cage_position"].attrs
    assert list(ds["crossbeam_face"].values) == ["front", "rear"]
    assert ds["pocket_azimuth"].dims == ("pocket",)
    assert ds["pocket_slice_force"].dtype == np.float32
    assert np.allclose(ds["revolution"], np.arange(N) / (2 * np.pi))
    state = store.checkpoint()
    assert np.array_equal(state["y"], np.arange(4.0) + store.layout.n_blocks - 1)
    assert str(state["law"]) == "bdf" and int(state["order"]) == 2
    assert len(store.steps()["t"]) == 3 * store.layout.n_blocks
    assert len(store.events()["t"]) == sum(range(store.layout.n_blocks))


def test_readers_trim_to_the_commit_and_a_run_goes_on(tmp_path):
    path = tmp_path / "r.zarr"
    store = make(path)
    assert RunStore.open(path).dataset().sizes["time"] == 0
    store.write_block(0, *block(store, 0), {"i": 0})
    store.write_block(1, *block(store, 1, length=10))
    again = RunStore.open(path)
    ds = again.dataset()
    check(ds, 35)
    assert ds.sizes["time_hf"] == 110 and not again.complete
    assert again.blocks == 1 and int(again.checkpoint()["i"]) == 0
    for i in range(1, again.layout.n_blocks):
        again.write_block(i, *block(again, i), {"i": i})
    check(RunStore.open(path).dataset(), N)
    assert len(list((path / "_run").glob("checkpoint-*"))) == 1


def test_plain_xarray_reads_the_folder_quietly(tmp_path):
    store = make(tmp_path / "r.zarr")
    store.write_block(0, *block(store, 0))
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        ds = xr.open_zarr(tmp_path / "r.zarr", chunks=None)
    assert ds["cage_position"].attrs["units"] == "m"
    assert np.isnan(ds["inner_angle"].values[BLOCK:]).all()


@pytest.mark.parametrize("engine", ["netcdf4", "scipy"])
@pytest.mark.parametrize("source", ["store", "run"])
def test_a_stored_run_goes_to_netcdf_with_its_labels(tmp_path, source, engine):
    path = tmp_path / "r.zarr"
    store = make(path, attrs={"case": "speed = '6000 rpm' # µ", "places": ["inner race", "rib"]})
    for k in range(store.layout.n_blocks):
        store.write_block(k, *block(store, k))
    ds = xr.open_zarr(path, chunks=None) if source == "store" else RunStore.open(path).dataset()
    ds.to_netcdf(tmp_path / "r.nc", engine=engine)
    with xr.open_dataset(tmp_path / "r.nc", engine=engine) as back:
        force = back["pocket_slice_force"]
        assert force.sel(crossbeam_face="rear", pocket=2, slice=5e-4).dims == ("time",)
        assert back["axis"].values.tolist() == ["x", "y", "z"]
        assert back["pocket"].values.tolist() == [0, 1, 2]
        assert back["pocket_azimuth"].values.tolist() == [0.0, 2.0, 4.0]
        assert "pocket_azimuth" in back.coords and back["pocket_azimuth"].attrs["units"] == "rad"
        assert np.array_equal(back["cage_position"], ds["cage_position"])
        run = back.attrs if source == "run" else json.loads(back.attrs["run"])
        assert run["case"] == "speed = '6000 rpm' # µ"
        places = json.loads(run["places"]) if source == "run" else run["places"]
        assert places == ["inner race", "rib"]


def test_wrong_blocks_are_refused(tmp_path):
    store = make(None)
    main, fine = block(store, 0)
    with pytest.raises(ValueError, match="out of order"):
        store.write_block(1, main, fine)
    with pytest.raises(ValueError, match="missing"):
        store.write_block(0, {}, fine)
    with pytest.raises(ValueError, match="shape"):
        store.write_block(0, {**main, "inner_angle": np.zeros((2, 2))}, fine)


def test_sentences_for_paths_and_versions(tmp_path):
    path = tmp_path / "r.zarr"
    with pytest.raises(InputError, match="holds no run"):
        RunStore.open(path)
    make(path)
    with pytest.raises(InputError, match="exists already"):
        make(path)
    make(path, overwrite=True)
    commit = path / "_run" / "commit.json"
    stored = json.loads(commit.read_text())
    for other, said in (({**stored, "format": 1}, "1"), ({}, "None"), ([1], "None")):
        commit.write_text(json.dumps(other))
        with pytest.raises(InputError, match=f"format {said}, .*reads format 6: open it with"):
            RunStore.open(path)
    (tmp_path / "file").write_text("")
    with pytest.raises(InputError, match="cannot be written"):
        make(tmp_path / "file" / "r.zarr")


@pytest.mark.parametrize(
    ("lost", "words"),
    [
        ("cage_position", "lacks the array 'cage_position'"),
        ("cage_position/c", "lacks samples of the array 'cage_position'"),
        ("pocket_slice_force/c/0", "lacks samples of the array 'pocket_slice_force'"),
        ("outer_acceleration/c/0", "lacks samples of the array 'outer_acceleration'"),
        ("time", "lacks the instants 'time'"),
        ("_run/events", "lacks events of its blocks"),
    ],
)
def test_a_damaged_run_is_refused_when_it_is_opened(tmp_path, lost, words):
    path = tmp_path / "r.zarr"
    store = make(path)
    for k in range(2):
        store.write_block(k, *block(store, k), {"i": k})
    assert RunStore.open(path).blocks == 2  # of five: blocks to come are not missed
    shutil.rmtree(path / lost)
    with pytest.raises(InputError, match=f"r.zarr is damaged: it {words}; .* run the case again"):
        RunStore.open(path)


@pytest.mark.parametrize("how", ["cut", "empty", "changed"])
@pytest.mark.parametrize(
    ("file", "words"),
    [
        ("cage_position/c/0/0", "samples of the array 'cage_position' that"),
        ("outer_acceleration/c/0/0", "samples of the array 'outer_acceleration' that"),
        ("_run/steps/0", "steps of block 1 that"),
        ("_run/checkpoint-000002.npz", "_run/checkpoint-000002.npz, which"),
    ],
)
def test_a_damaged_file_of_a_run_gets_a_sentence_when_it_is_read(tmp_path, file, words, how):
    path = tmp_path / "r.zarr"
    store = make(path)
    for k in range(2):
        store.write_block(
            k, *block(store, k), {"i": np.arange(9)}, {"steps": {"t": np.arange(9.0)}}
        )
    content = bytearray((path / file).read_bytes())
    place = len(content) - 20  # within the last block
    if how == "changed":
        content[place] ^= 0xFF
    else:
        del content[place if how == "cut" else 0 :]
    (path / file).write_bytes(content)
    lacks = how == "empty" and "checkpoint" not in file  # seen on opening: no block is there
    words = words.removesuffix(" that").replace("block 1", "its blocks") if lacks else words
    said = f"lacks {words}" if lacks else f"holds {words} cannot be read"
    with pytest.raises(InputError, match=f"r.zarr is damaged: it {said}; "):
        again = RunStore.open(path)
        again.dataset().load(), again.steps(), again.checkpoint()


def test_a_damaged_index_gets_a_sentence(tmp_path):
    path = tmp_path / "r.zarr"
    store = make(path)
    store.write_block(0, *block(store, 0), {"i": 0})
    for file in ("_run/events/0", "cage_position/c/0/0"):
        content = bytearray((path / file).read_bytes())
        content[3] ^= 0xFF
        (path / file).write_bytes(content)
        with pytest.raises(InputError, match="is damaged: it holds .* that cannot be read"):
            RunStore.open(path)


def test_files_hold_many_blocks_and_are_taken_up_in_turn(tmp_path, monkeypatch):
    from flexcage.results import metadata

    monkeypatch.setattr(metadata, "SLOTS", 2)
    path = tmp_path / "r.zarr"
    store = make(path)
    for k in range(store.layout.n_blocks):
        store = RunStore.open(path)
        store.write_block(k, *block(store, k), {"i": k}, {"steps": {"t": np.full(2, k)}})
    again = RunStore.open(path)
    check(again.dataset(), N)
    assert list(again.steps()["t"]) == [0, 0, 1, 1, 2, 2, 3, 3, 4, 4]
    assert sorted(p.name for p in (path / "cage_position" / "c").iterdir()) == ["0", "1", "2"]
    assert sorted(p.name for p in (path / "_run" / "steps").iterdir()) == ["0", "1", "2"]
    with xr.open_zarr(path, chunks=None) as plain:
        assert np.array_equal(plain["pocket_slice_force"], again.dataset()["pocket_slice_force"])


def test_a_killed_write_leaves_the_index_before_or_after(tmp_path, monkeypatch):
    """Killed at any write of a chunk or an index, also as a file begins or is written again."""
    from flexcage.results import shards

    real = shards._write_all

    class Killed(BaseException):
        pass

    for lives in range(5):
        chunks, left = shards.Chunks(tmp_path / str(lives), 3), [lives]

        def write(stream, content, left=left):
            if not left[0]:
                real(stream, content[: len(content) // 2] if len(content) < 20 else b"")
                raise Killed
            left[0] -= 1
            real(stream, content)

        with monkeypatch.context() as patch, pytest.raises(Killed):
            patch.setattr(shards, "_write_all", write)
            for content in (b"first", b"again"):
                chunks.write(0, content)
        assert chunks.read([0, 1]) == [None if lives < 3 else b"first", None]
        chunks.write(0, b"at last")
        chunks.write(2, b"third")
        assert chunks.read([2, 0, 1, 5]) == [b"third", b"at last", None, None]
        assert chunks.holds(1) and not chunks.holds(2) and not chunks.holds(4)


@pytest.mark.parametrize(
    "key",
    [
        {"time": slice(10, 90)}, {"time": slice(70, 20, -7)}, {"time": 33}, {"time": slice(5, 5)},
        {"time": [80, 3, 3, 51]}, {"time": slice(24, 26), "slice": [4, 0], "pocket": 1},
        {"time": np.array([], int)}, {"slice": slice(1, 4, 2)},
    ],
    ids=str,
)  # fmt: skip
def test_parts_are_read_as_of_the_whole(tmp_path, key):
    store = make(tmp_path / "r.zarr")
    rng = np.random.default_rng(2)
    for k in range(store.layout.n_blocks):
        parts = [{n: rng.normal(size=a.shape) for n, a in part.items()} for part in block(store, k)]
        store.write_block(k, *parts)
    whole = store.dataset().load()["pocket_slice_force"]
    part = RunStore.open(tmp_path / "r.zarr").dataset()["pocket_slice_force"].isel(key)
    assert np.array_equal(part, whole.isel(key)) and part.shape == whole.isel(key).shape


def test_precision_on_disk_is_that_of_the_registry(tmp_path):
    """Errors by variable, in shares of the largest value that is rounded with it; and not more
    digits than are told. Types of datasets are those of the registry."""
    from flexcage.results.registry import rounded

    rng = np.random.default_rng(3)
    groups = {53: 0.0, 38: 2.0**-38, 24: 2.0**-24, 20: 2.0**-20, 15: 2.0**-15}
    for v in VARIABLES.values():
        shape = (50, *range(2, len(v.dims) + 1))
        values = rng.normal(size=shape) * 10.0 ** rng.uniform(-9, 3, size=shape)
        largest = np.abs(values)
        if v.together:
            largest = largest.max(axis=tuple(range(-v.together, 0)), keepdims=True)
        kept = v.rounded(values)
        assert kept.dtype == v.stored and v.stored == ("float64" if v.bits > 24 else "float32")
        error = (np.abs(kept - values) / largest).max()
        single = 2.0**-24 if v.stored == "float32" else 0.0
        assert error <= max(groups[v.bits], single) + single, (v.name, error)
        assert error >= 0.1 * groups[v.bits], (v.name, "could be stored in fewer digits")
    whole = {"inner_angle", "inner_speed", "cage_quaternion", "cage_omega", "energy", "work"}
    assert {n for n, v in VARIABLES.items() if v.bits == 53} == whole
    assert not rounded(np.zeros((2, 3)), "float32", 15, 1).any()
    stores = make(tmp_path / "r.zarr"), make(None)
    for store in stores:
        store.write_block(0, *[{n: a / 3.0 for n, a in p.items()} for p in block(store, 0)])
    disk, memory = (s.dataset() for s in stores)
    for name in VARS:
        assert disk[name].dtype == memory[name].dtype == VARIABLES[name].dtype
        kept = VARIABLES[name].rounded(memory[name].values)
        assert np.array_equal(disk[name], kept)
        assert np.array_equal(kept, memory[name]) == (VARIABLES[name].bits == 53)


def test_a_checkpoint_is_kept_to_the_last_bit(tmp_path):
    store, state = make(tmp_path / "r.zarr"), np.random.default_rng(4).normal(size=100)
    store.write_block(0, *block(store, 0), {"y": state})
    assert np.array_equal(RunStore.open(tmp_path / "r.zarr").checkpoint()["y"], state)


@pytest.mark.parametrize("step", ["array", "checkpoint", "commit"])
def test_a_full_disk_keeps_what_was_committed(tmp_path, monkeypatch, step):
    from flexcage.results import commit as commits
    from flexcage.results import store as module

    path = tmp_path / "r.zarr"
    store = make(path)
    store.write_block(0, *block(store, 0), {"i": 0})

    def full(*args, **kwargs):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    if step == "array":
        monkeypatch.setattr(module.Chunks, "write", full)
    else:
        real = module.replace

        def some(target, content):
            if step in target.name:
                full()
            real(target, content)

        monkeypatch.setattr(commits, "replace", some)
        monkeypatch.setattr(module, "replace", some)
    with pytest.raises(RunFailed, match="disk is full; the first 25 samples are kept"):
        store.write_block(1, *block(store, 1), {"i": 1})
    monkeypatch.undo()
    again = RunStore.open(path)
    check(again.dataset(), 25)
    assert int(again.checkpoint()["i"]) == 0
    again.write_block(1, *block(again, 1), {"i": 1})
    check(RunStore.open(path).dataset(), 50)


WRITER = """
import sys
sys.path.insert(0, {here!r})
import test_run_store as t
t.BLOCK, t.N = 5, 2001
store = t.make({path!r})
print("ready", flush=True)
for i in range(store.layout.n_blocks):
    store.write_block(i, *t.block(store, i), {{"i": i}}, {{"steps": {{"t": [float(i)]}}}})
"""


def test_killed_at_random_moments_and_readable(tmp_path):
    rng = np.random.default_rng(5)
    here = os.path.dirname(__file__)
    seen = []
    for k in range(5):
        path = tmp_path / f"{k}.zarr"
        code = WRITER.format(here=here, path=str(path))
        process = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
        assert process.stdout.readline().strip() == b"ready"
        time.sleep(rng.uniform(0.05, 0.6))
        process.send_signal(signal.SIGKILL)
        process.wait()
        process.stdout.close()
        store = RunStore.open(path)
        ds = store.dataset()
        check(ds, store.n_time)
        assert store.n_time % 5 == 0 and store.n_time < 2001
        assert len(store.steps().get("t", ())) == store.blocks
        if store.blocks:
            assert int(store.checkpoint()["i"]) == store.blocks - 1
        store.write_block(store.blocks, *_next(store))
        check(RunStore.open(path).dataset(), store.n_time)
        seen.append(store.n_time)
    assert len(set(seen)) > 1, "the kills came at different moments"


def _next(store):
    return block(store, store.blocks)


def test_registry_is_complete():
    """Every variable has a unit, a name, time first, and labels or a run-dependent dimension."""
    free = run_dims()
    for name, v in VARIABLES.items():
        assert v.name == name and v.unit and len(v.long_name) > 8
        assert v.dims[0] in (TIME, TIME_HF)
        assert set(v.dims[1:]) <= set(LABELS) | free, name
        assert v.dtype in ("float64", "float32")
    text = " ".join(VARIABLES)
    for papers_plot in ("position", "omega", "slip", "pocket_slice", "energy", "multiplier"):
        assert papers_plot in text
    with pytest.raises(InputError, match="'cage_position'"):
        variable("cage_positon")


def test_a_variable_from_elsewhere(monkeypatch):
    from flexcage.results import registry

    monkeypatch.setattr(registry, "COMPUTED", dict(registry.COMPUTED))
    for table in (registry.VARIABLES, registry.LABELS):
        monkeypatch.setattr(table, "_added", {})

    def compute(arrays, bearing):
        return np.full(len(arrays["inner_angle"]), 300.0)

    oil = Variable("oil_temperature", ("time",), "K", "temperature of the oil")
    assert registry.register(oil, compute) is oil
    assert registry.variable("oil_temperature").unit == "K"
    zones = Variable("zone_temperature", ("time", "zone"), "K", "temperature by zone")
    registry.register(zones, compute, labels={"zone": ("load", "rest")})
    for wrong, labels, words in (
        (oil, {}, "'oil_temperature' exists already"),
        (Variable("frozen", ("element",), "K", "no time"), {}, "must be 'time'"),
        (Variable("fine", ("time_hf",), "K", "another grid"), {}, "must be 'time'"),
        (Variable("two words", ("time",), "K", "no name"), {}, "one word"),
        (Variable("spots", ("time", "spot"), "K", "no labels"), {}, "needs labels"),
        (Variable("axes", ("time", "axis"), "K", "labels"), {"axis": "abc"}, "labels already"),
    ):
        with pytest.raises(InputError, match=words):
            registry.register(wrong, compute, labels=labels)


class Harmful:
    """What writes a file when it is unpickled."""

    def __init__(self, mark):
        self.mark = mark

    def __reduce__(self):
        return open, (str(self.mark), "w")


@pytest.mark.parametrize("inlined", [False, True], ids=["format 2", "format 2 within 3"])
def test_a_store_with_pickles_runs_no_code(tmp_path, monkeypatch, inlined):
    """An array of Zarr's format 2 may be coded by pickle, also one that the metadata of a group of
    format 3 brings along; numcodecs decoded it until lately."""
    import pickle

    monkeypatch.setattr("numcodecs.pickles.ALLOW_UNSAFE_PICKLE_DECODE", True, raising=False)
    run, mark = tmp_path / "run", tmp_path / "mark"
    make(run).write_block(0, *block(make(None), 0))
    filters = [{"id": "vlen-utf8"}, {"id": "pickle", "protocol": 5}]
    old = {
        "zarr_format": 2, "shape": [N], "chunks": [N], "dtype": "|O", "fill_value": None,
        "order": "C", "compressor": None, "filters": filters,
    }  # fmt: skip
    root = json.loads((run / "zarr.json").read_text())
    if inlined:
        root["consolidated_metadata"]["metadata"]["time"] = {**old, "attributes": {}}
        (run / "zarr.json").write_text(json.dumps(root))
    else:
        (run / "zarr.json").unlink()
        (run / ".zgroup").write_text(json.dumps({"zarr_format": 2}))
        (run / ".zattrs").write_text(json.dumps(root["attributes"]))
        (run / "time" / ".zarray").write_text(json.dumps(old))
    (run / "time" / "0").write_bytes(pickle.dumps(Harmful(mark)))
    with pytest.raises(InputError):
        RunStore.open(run)
    assert not mark.exists()
