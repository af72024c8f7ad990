"""Run folders that a stranger, or an editor, has changed: nothing runs, nothing large is made,
nothing elsewhere is touched, and one sentence says what is wrong."""

import hashlib
import io
import json
import pickle
import shutil
import zipfile
from pathlib import Path

import numpy as np
import pytest
from numcodecs import blosc

from flexcage.core.arrays import read_arrays
from flexcage.core.errors import InputError, RunFailed
from flexcage.core.reading import json_of
from flexcage.results import shards
from flexcage.results.cage_file import cage_file, cage_record, find_cage, read_cage, write_cage
from flexcage.results.commit import _own_checksum
from flexcage.results.metadata import metadata_checksum, read_layout
from flexcage.results.store import RunStore

N, BLOCK = 40, 20
VARS = ["inner_angle", "cage_position"]


class Harmful:
    """What writes a file when it is unpickled."""

    def __init__(self, mark):
        self.mark = mark

    def __reduce__(self):
        return open, (str(self.mark), "w")


@pytest.fixture(autouse=True)
def old_numcodecs(monkeypatch):
    """As an older one, which decodes pickles."""
    monkeypatch.setattr("numcodecs.pickles.ALLOW_UNSAFE_PICKLE_DECODE", True, raising=False)


@pytest.fixture
def run(tmp_path) -> Path:
    path = tmp_path / "run"
    coords = {"time": (1 + np.arange(N)) / 50e3, "axis": np.array(["x", "y", "z"])}
    store = RunStore.create(
        path, coords=coords, variables=VARS, n_time=N, block=BLOCK, attrs={"case": "text"}
    )
    for k in range(2):
        at = np.arange(20.0) + 20 * k
        store.write_block(
            k,
            {"inner_angle": at, "cage_position": np.tile(at[:, None], 3)},
            checkpoint={"y": at},
            tables={"steps": {"t": at}},
        )
    return path


@pytest.fixture
def cage(tmp_path) -> Path:
    from types import MappingProxyType

    from flexcage.mesh.cage_mesh import CageMesh

    groups = MappingProxyType({"end+x": np.array([[0, 1, 2]])})
    tets = np.array([[0, 1, 2, 3], [1, 2, 3, 4]])
    points = np.random.default_rng(0).random((5, 3))
    mesh = CageMesh(points, tets, groups, 1, MappingProxyType({"source": "built"}))
    sparse = {"data": [1.0], "indices": [2], "indptr": [0, 1], "shape": [1, 3]}
    interface = {f"weights.{name}": np.array(value) for name, value in sparse.items()}
    record = cage_record(mesh, {"interface": interface})
    return write_cage(tmp_path / "cage.zip", cage_file(record))


def edit(path: Path, change) -> None:
    """Change a JSON file by a function of its value."""
    value = json.loads(path.read_text())
    path.write_text(json.dumps(change(value) or value))


def sealed(run: Path) -> None:
    """Write the checksums anew, as one would who means harm."""
    commit = json.loads((run / "_run/commit.json").read_text())
    commit.pop("checksum")
    commit["metadata"] = metadata_checksum(run, read_layout(run))
    commit["checksum"] = _own_checksum(commit)
    (run / "_run/commit.json").write_text(json.dumps(commit))


def sealed_commit(run: Path, **changes) -> None:
    commit = json.loads((run / "_run/commit.json").read_text())
    commit = {**commit, **changes}
    commit.pop("checksum")
    (run / "_run/commit.json").write_text(json.dumps({**commit, "checksum": _own_checksum(commit)}))


def layout_of(run: Path, change) -> None:
    """Change the layout in a run's attributes."""

    def changed(root):
        layout = json.loads(root["attributes"]["layout"])
        change(layout)
        root["attributes"]["layout"] = json.dumps(layout)

    edit(run / "zarr.json", changed)


# --- what an editor changes ----------------------------------------------------------------------


def _case_text(run):
    edit(run / "zarr.json", lambda root: root["attributes"].update(run='{"case": "other"}'))


def _labels(run):
    edit(run / "axis/zarr.json", lambda node: node["attributes"].update(long_name="another"))


def _positions(run):
    def turned(layout):
        layout["coords"]["axis"]["values"] = ["z", "y", "x"]

    layout_of(run, turned)


def _units(run):
    edit(run / "cage_position/zarr.json", lambda node: node["attributes"].update(units="mm"))


def _fewer(run):
    edit(run / "_run/commit.json", lambda commit: commit.update(n_time=30))


def _instants(run):
    other = np.arange(N, dtype=float).tobytes()
    packed = blosc.compress(other, b"zstd", 2, blosc.SHUFFLE, 1 << 20)
    (run / "time/c/0").write_bytes(shards.with_checksum(packed))


@pytest.mark.parametrize("change", [_case_text, _labels, _positions, _units, _fewer, _instants])
def test_what_gives_numbers_their_meaning_is_not_changed_unseen(run, change):
    assert RunStore.open(run).n_time == N
    change(run)
    said = (
        r"run is damaged: it has .*(commit|zarr)\.json.* changed afterwards; .*run the case again"
    )
    with pytest.raises(InputError, match=said):
        RunStore.open(run)


@pytest.mark.parametrize("name", [".DS_Store", "Thumbs.db", "desktop.ini", "._0"])
def test_files_that_a_file_manager_leaves_are_no_damage(run, name):
    for folder in (run, *(f for f in run.rglob("*") if f.is_dir())):
        (folder / name).write_bytes(b"\0\0\0\1Bud1")
    store = RunStore.open(run)
    np.testing.assert_array_equal(store.dataset()["inner_angle"], np.arange(40.0))


def test_a_checkpoint_that_is_missing_or_another_is_told(run):
    store, other = RunStore.open(run), io.BytesIO()
    assert store.checkpoint()["y"][0] == 20.0
    np.savez(other, y=np.arange(20.0))
    file = run / "_run/checkpoint-000002.npz"
    file.write_bytes(other.getvalue())
    with pytest.raises(InputError, match="holds _run/checkpoint-000002.npz, which was changed"):
        store.checkpoint()
    file.unlink()
    with pytest.raises(InputError, match="lacks _run/checkpoint-000002.npz; bring it back"):
        store.checkpoint()


def test_a_file_beside_the_results_is_vouched_for_before_and_after_a_kill(run):
    store = RunStore.open(run)
    assert not store.vouches_for("summary.json", b"one")
    store.vouch_for("summary.json", b"one")
    store.vouch_for("summary.json", b"two")  # and killed before it wrote the file
    again = RunStore.open(run)
    assert again.vouches_for("summary.json", b"one") and again.vouches_for("summary.json", b"two")
    again.vouch_for("summary.json", b"three")
    assert not RunStore.open(run).vouches_for("summary.json", b"one")


# --- names and sizes -----------------------------------------------------------------------------


@pytest.mark.parametrize("name", ["../elsewhere", "/etc", "a/b", "..", "_run", "time"])
def test_a_variable_s_name_leads_nowhere_else(run, name):
    def other(layout):
        layout["variables"][0]["name"] = name

    layout_of(run, other)
    with pytest.raises(InputError, match="name|twice"):
        RunStore.open(run)
    assert not (run.parent / "elsewhere").exists()


def test_a_checkpoint_s_name_leads_nowhere_else(run):
    victim = run.parent / "mine.npz"
    victim.write_bytes(b"mine")
    sealed_commit(run, checkpoint="../../mine.npz")
    with pytest.raises(InputError, match=r"commit\.json that was changed"):
        RunStore.open(run)
    assert victim.read_bytes() == b"mine"


def test_a_cage_s_name_leads_nowhere_else(run):
    with pytest.raises(InputError, match="folder"):
        find_cage(run, "../../../etc/passwd")


def _huge_run(run):
    def grown(layout):
        layout["n_time"] = 10**12

    layout_of(run, grown)
    edit(run / "time/zarr.json", lambda node: node.update(shape=[10**12]))
    for name, rest in (("inner_angle", []), ("cage_position", [3])):
        edit(run / f"{name}/zarr.json", lambda node, r=rest: node.update(shape=[10**12, *r]))


def _huge_block(run):
    def grown(layout):
        layout["n_time"] = layout["block"] = 10**12

    layout_of(run, grown)


def _huge_chunk(run):
    def grown(node):
        node["shape"] = node["chunk_grid"]["configuration"]["chunk_shape"] = [10**13]

    edit(run / "time/zarr.json", grown)


def _bomb(run):
    """A Blosc buffer of the right length that claims 2 GB."""
    packed = bytearray(blosc.compress(np.arange(N) / 50e3, b"zstd", 2, blosc.SHUFFLE, 1 << 20))
    packed[4:8] = (2**31 - 100).to_bytes(4, "little")
    (run / "time/c/0").write_bytes(shards.with_checksum(bytes(packed)))


def _negative(run):
    layout_of(run, lambda layout: layout.update(n_time=-1))


def _deep(run):
    (run / "zarr.json").write_text("[" * 100_000 + "]" * 100_000)


@pytest.mark.parametrize("change", [_huge_run, _huge_block, _huge_chunk, _bomb, _negative, _deep])
def test_sizes_are_compared_with_what_is_there(run, change, monkeypatch):
    change(run)

    def large(shape, *args, **kwargs):
        raise AssertionError(f"{shape} was made")

    for maker in ("empty", "zeros", "full"):
        monkeypatch.setattr(np, maker, large)
    with pytest.raises(InputError, match="cannot be opened|damaged"):
        RunStore.open(run)


def test_a_chunk_that_claims_more_than_it_holds_is_refused(run):
    packed = bytearray(blosc.compress(np.zeros(60, np.float32), b"zstd", 2, blosc.SHUFFLE, 1 << 20))
    packed[4:8] = (2**31 - 100).to_bytes(4, "little")
    store = RunStore.open(run)
    variable = next(v for v in store.layout.variables if v.name == "cage_position")
    store._chunks(variable).write(1, shards.with_checksum(bytes(packed)))
    with pytest.raises(
        InputError, match="samples of the array 'cage_position' that cannot be read"
    ):
        RunStore.open(run).dataset().load()


def test_a_table_that_claims_more_than_it_holds_is_refused(run):
    zeros = blosc.compress(np.zeros(10**8, np.uint8), b"zstd", 9, blosc.SHUFFLE, 1 << 20)
    about = {f"c{k}": ["<f8", [10**8 // 8]] for k in range(20)}
    parts = {name: np.frombuffer(zeros, np.uint8) for name in about}
    buffer = io.BytesIO()
    np.savez(buffer, columns=np.array(json.dumps(about)), **parts)
    RunStore.open(run)._tables_of("steps").write(1, buffer.getvalue())
    with pytest.raises(InputError, match="holds steps of block 1 that cannot be read"):
        RunStore.open(run).steps()


# --- metadata that run code ----------------------------------------------------------------------

PICKLED = {
    "zarr_format": 2, "shape": [N], "chunks": [N], "dtype": "|O", "fill_value": None,
    "order": "C", "compressor": None,
    "filters": [{"id": "vlen-utf8"}, {"id": "pickle", "protocol": 5}],
}  # fmt: skip


def test_consolidated_metadata_are_not_believed(run, tmp_path):
    """A pickle in place of the instants, by what the group says of them."""
    mark = tmp_path / "mark"

    def lies(root):
        root["consolidated_metadata"]["metadata"]["time"] = {**PICKLED, "attributes": {}}

    edit(run / "zarr.json", lies)
    (run / "time" / "0").write_bytes(pickle.dumps(Harmful(mark)))
    sealed(run)
    assert RunStore.open(run).dataset()["time"].values[0] == 1 / 50e3
    assert not mark.exists()


@pytest.mark.parametrize(
    "change",
    [
        {"codecs": [{"name": "numcodecs.pickle", "configuration": {}}]},
        {"codecs": [{"name": "bytes"}, {"name": "gzip"}]},
        {"codecs": []},
        {"codecs": [{"name": "bytes"}, {"name": "blosc"}, {"name": "blosc"}]},
        {"data_type": "|O"},
        {"data_type": {"name": "variable_length_bytes"}},
        {"data_type": "string"},
        {"zarr_format": 2},
        {"node_type": "group"},
        {"storage_transformers": [{"name": "x"}]},
        {"fill_value": "cmFt"},
        {"chunk_grid": {"name": "rectilinear", "configuration": {}}},
        {"must_run": {"name": "x"}},
    ],
)  # fmt: skip
def test_only_types_and_codecs_of_flexcage_pass(run, change):
    edit(run / "time/zarr.json", lambda node: node.update(change))
    with pytest.raises(InputError, match="cannot be opened"):
        RunStore.open(run)


def rewritten(path: Path, changes: dict[str, bytes], **how) -> None:
    """A zip file with other members."""
    with zipfile.ZipFile(path) as old:
        members = {name: old.read(name) for name in old.namelist()}
    with zipfile.ZipFile(path, "w", **how) as new:
        for name, content in {**members, **changes}.items():
            new.writestr(name, content)


def test_a_cage_does_not_reach_a_pickle(cage, tmp_path):
    mark = tmp_path / "mark"
    with zipfile.ZipFile(cage) as archive:
        root = json.loads(archive.read("mesh/zarr.json"))
    root["consolidated_metadata"] = {
        "kind": "inline", "must_understand": False,
        "metadata": {"points": {**PICKLED, "shape": [5], "chunks": [5], "attributes": {}}},
    }  # fmt: skip
    rewritten(
        cage, {"mesh/zarr.json": json.dumps(root).encode(),
               "mesh/points/0": pickle.dumps(Harmful(mark))}
    )  # fmt: skip
    with pytest.raises(InputError, match=r"speaks for other nodes.*bring it back"):
        read_cage(cage)
    assert not mark.exists()


@pytest.mark.parametrize(
    "name", ["../../x", "/x", "mesh/.zarray", ".zgroup", "mesh/../../x", "mesh/a/b/zarr.json"]
)
def test_a_cage_s_members_have_its_own_names(cage, name):
    rewritten(cage, {name: b'{"zarr_format": 3, "node_type": "array"}'})
    with pytest.raises(InputError, match="cannot be read"):
        read_cage(cage)


def test_a_cage_that_is_packed_is_no_bomb(cage):
    with zipfile.ZipFile(cage) as old:
        node = json.loads(old.read("mesh/points/zarr.json"))
    rewritten(cage, {"mesh/points/c/9/9": b"\0" * 10**8}, compression=zipfile.ZIP_DEFLATED)
    with pytest.raises(InputError, match="is packed"):
        read_cage(cage)
    node["shape"] = node["chunk_grid"]["configuration"]["chunk_shape"] = [10**9, 300]
    rewritten(cage, {"mesh/points/zarr.json": json.dumps(node).encode()})
    with pytest.raises(InputError, match="cannot be read"):
        read_cage(cage)


def test_a_cage_of_many_empty_chunks_is_no_bomb(cage):
    with zipfile.ZipFile(cage) as old:
        node = json.loads(old.read("mesh/points/zarr.json"))
        members = {n: old.read(n) for n in old.namelist() if "points/c" not in n}
    node["shape"] = [10**12, 3]
    members["mesh/points/zarr.json"] = json.dumps(node).encode()
    with zipfile.ZipFile(cage, "w") as new:
        for name, content in members.items():
            new.writestr(name, content)
    with pytest.raises(InputError, match=r"cannot be read .*claims to hold"):
        read_cage(cage)


def test_indices_of_a_cage_point_at_what_is_there(cage):
    record = read_cage(cage)
    interface = {**record.groups["interface"], "weights.indices": np.array([2_000_000_000])}
    mesh = {**record.groups["mesh"], "tets": np.array([[0, 1, 2, -7]], np.int32)}
    for groups in ({"interface": interface}, {"mesh": mesh}):
        spoiled = type(record)({**record.groups, **groups}, record.digest)
        with pytest.raises(InputError, match="cannot be read"):
            read_cage(write_cage(cage, cage_file(spoiled)))


def test_a_cage_that_was_changed_is_told(cage):
    """Also where all checksums of its arrays are right."""
    record = read_cage(cage)
    mesh = {**record.groups["mesh"], "points": 2.0 * record.groups["mesh"]["points"]}
    other = write_cage(
        cage.with_name("other.zip"),
        cage_file(type(record)({**record.groups, "mesh": mesh}, record.digest)),
    )
    with zipfile.ZipFile(other) as archive:
        points = {n: archive.read(n) for n in archive.namelist() if n.startswith("mesh/points/")}
    rewritten(cage, points)
    with pytest.raises(InputError, match="it was changed afterwards"):
        read_cage(cage)


# --- archives of arrays --------------------------------------------------------------------------


def npz(**members: bytes) -> io.BytesIO:
    buffer = io.BytesIO()
    with zipfile.ZipFile(buffer, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in members.items():
            archive.writestr(f"{name}.npy", content)
    buffer.seek(0)
    return buffer


def npy(shape, dtype="<f8", content=b"") -> bytes:
    header = f"{{'descr': {dtype!r}, 'fortran_order': False, 'shape': {shape}, }}".encode()
    header += b" " * (63 - (len(header) + 10) % 64) + b"\n"
    return b"\x93NUMPY\x01\x00" + len(header).to_bytes(2, "little") + header + content


@pytest.mark.parametrize(
    "content",
    [
        npy((10**12,)),
        npy((3,), content=bytes(16)),
        npy((1,), content=bytes(16)),
        npy((-1,), content=bytes(8)),
        npy((1,), "|O", b"12345678"),
        npy((1,), [("a", "<f8")], bytes(8)),
        npy((0,), "<m8[s]"),
        b"\x93NUMPY\x03\x00" + bytes(60),
        b"\x80\x04\x95",
        b"",
    ],
)
def test_an_archive_holds_what_it_claims_and_no_objects(content):
    with pytest.raises(ValueError, match="."):
        read_arrays(npz(a=content))


def test_an_archive_of_objects_runs_no_code(tmp_path):
    mark = tmp_path / "mark"
    np.savez(tmp_path / "a.npz", a=np.array([Harmful(mark)], dtype=object))
    with pytest.raises(ValueError, match="object"):
        read_arrays(tmp_path / "a.npz")
    assert not mark.exists()


def test_archives_of_numbers_and_texts_come_back(tmp_path):
    arrays = {
        "a": np.arange(6.0).reshape(2, 3), "f": np.asfortranarray(np.eye(3)), "t": np.array("ö"),
        "e": np.empty((0, 3)), "b": np.array(True), "c": np.array([1j]),
    }  # fmt: skip
    for write in (np.savez, np.savez_compressed):
        write(tmp_path / "a.npz", **arrays)
        found = read_arrays(tmp_path / "a.npz", wanted=lambda name: name != "c")
        assert list(found) == list("aft") + ["e", "b"]
        for name, value in found.items():
            np.testing.assert_array_equal(value, arrays[name])


def test_json_that_is_too_deep_is_a_value_error():
    with pytest.raises(ValueError, match="too deep"):
        json_of("[" * 200_000)


# --- a folder that goes away ---------------------------------------------------------------------


@pytest.mark.parametrize("how", ["removed", "moved", "another"])
def test_a_run_does_not_go_on_in_a_folder_that_is_no_longer_there(run, tmp_path, how):
    store = RunStore.create(
        tmp_path / "deep" / "results.zarr",
        coords={"time": (1 + np.arange(N)) / 50e3}, variables=["inner_angle"], n_time=N,
        block=BLOCK, attrs={},
    )  # fmt: skip
    store.write_block(0, {"inner_angle": np.zeros(20)}, checkpoint={"y": np.zeros(1)})
    if how == "removed":
        shutil.rmtree(tmp_path / "deep")
    else:
        (tmp_path / "deep").rename(tmp_path / "away")
    if how == "another":
        shutil.copytree(tmp_path / "away", tmp_path / "deep")
    before = _content(tmp_path / "deep")
    with pytest.raises(RunFailed, match=r"folder '.*deep' was moved or removed .*--resume"):
        store.write_block(1, {"inner_angle": np.zeros(20)}, checkpoint={"y": np.zeros(1)})
    assert _content(tmp_path / "deep") == before
    if how == "moved":
        assert RunStore.open(tmp_path / "away/results.zarr").blocks == 1


def _content(folder: Path) -> dict[str, str]:
    files = (path for path in folder.rglob("*") if path.is_file())
    return {str(path): hashlib.sha256(path.read_bytes()).hexdigest() for path in files}


@pytest.mark.parametrize("file", ["zarr.json", "time/zarr.json"])
def test_a_run_copied_without_all_its_files_says_what_to_do(run, file):
    (run / file).unlink()
    with pytest.raises(InputError, match="bring it back from a copy, or run the case") as caught:
        RunStore.open(run)
    assert "Errno" not in str(caught.value)
