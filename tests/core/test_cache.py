"""The cache: made once, whole or not at all, small enough, and never in the way of a result."""

import os
import subprocess
import sys

import numpy as np
import pytest

from flexcage.core.cache import cache_info, cached_arrays, clear_cache


@pytest.fixture(autouse=True)
def folder(tmp_path, monkeypatch):
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "cache"))
    return tmp_path / "cache"


class Maker:
    def __init__(self, size=3):
        self.calls, self.size = 0, size

    def __call__(self):
        self.calls += 1
        return {"x": np.arange(float(self.size)), "n": np.int64(self.calls)}


def test_is_made_once():
    make = Maker()
    first, second = (cached_arrays("modes", "k", make) for _ in range(2))
    assert make.calls == 1
    assert first.keys() == second.keys()
    assert all(np.array_equal(first[k], second[k]) for k in first)


def test_only_what_is_asked_for_is_read(folder):
    make = Maker(5000)
    assert cached_arrays("modes", "k", make, only=["n"]).keys() == {"x", "n"}  # was made
    assert cached_arrays("modes", "k", make, only=["n"]).keys() == {"n"}
    assert cached_arrays("modes", "k", make).keys() == {"x", "n"} and make.calls == 1
    again = cached_arrays("modes", "k", make, only=["x", "added later"])
    assert again["n"] == make.calls == 2


def test_key_and_kind_count():
    make = Maker()
    for kind, key in (("modes", "a"), ("modes", "b"), ("mesh", "a")):
        cached_arrays(kind, key, make)
    assert make.calls == 3
    assert cache_info().entries == {"modes": 2, "mesh": 1}


@pytest.mark.parametrize("damage", ["empty", "half", "text", "flipped"])
def test_a_broken_entry_is_made_anew(folder, damage):
    make = Maker(5000)
    cached_arrays("modes", "k", make)
    (entry,) = folder.rglob("*.npz")
    data = bytearray(entry.read_bytes())
    data[len(data) // 2] ^= 0xFF
    broken = {"empty": b"", "half": data[: len(data) // 2], "text": b"hello", "flipped": data}
    entry.write_bytes(bytes(broken[damage]))
    again = cached_arrays("modes", "k", make)
    assert make.calls == 2
    assert np.array_equal(again["x"], np.arange(5000.0))
    cached_arrays("modes", "k", make)
    assert make.calls == 2


def test_a_failing_maker_leaves_nothing(folder):
    def fail():
        raise ValueError("no")

    with pytest.raises(ValueError):
        cached_arrays("modes", "k", fail)
    assert not list(folder.rglob("*.npz")) and not list(folder.rglob("*.tmp"))
    assert cached_arrays("modes", "k", Maker())["n"] == 1


def test_least_recently_used_go_first(folder, monkeypatch):
    make = Maker(10_000)  # about 80 kB
    for i, key in enumerate("abc"):
        cached_arrays("modes", key, make)
        os.utime(folder / "arrays" / "modes" / f"{key}.npz", (i, i))
    cached_arrays("modes", "a", make)  # now the latest used
    monkeypatch.setenv("FLEXCAGE_CACHE_LIMIT_GB", str(2.5 * 80e3 / 1e9))
    cached_arrays("modes", "d", make)
    assert sorted(p.stem for p in folder.rglob("*.npz")) == ["a", "d"]


def test_a_folder_that_cannot_be_used_costs_only_time(tmp_path, monkeypatch, caplog):
    (tmp_path / "file").write_text("in the way")
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "file"))
    make = Maker()
    assert cached_arrays("modes", "k", make)["n"] == 1
    assert cached_arrays("modes", "k", make)["n"] == 2
    assert caplog.text.count("cannot be written") == 1


def test_a_full_disk_costs_only_time(monkeypatch, folder):
    def full(*args, **kwargs):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    assert cached_arrays("modes", "k", Maker())["n"] == 1
    assert not list(folder.rglob("*.npz")) and not list(folder.rglob("*.tmp"))


_WORKER = """
import sys, time
import numpy as np
from flexcage.core.cache import cached_arrays
def make():
    open(sys.argv[1], "a").write("made\\n")
    time.sleep(0.3)
    return {"x": np.arange(1000.0)}
print(cached_arrays("modes", "shared", make)["x"].sum())
"""


def test_processes_share_one_making(tmp_path):
    log = tmp_path / "log"
    command = [sys.executable, "-c", _WORKER, str(log)]
    workers = [subprocess.Popen(command, stdout=subprocess.PIPE, text=True) for _ in range(3)]
    sums = [w.communicate(timeout=60)[0].strip() for w in workers]
    assert sums == ["499500.0"] * 3
    assert log.read_text().count("made") == 1


def test_clear_frees_what_info_counts():
    cached_arrays("modes", "k", Maker(1000))
    size = cache_info().size
    assert size > 8000 and "1 modes" in str(cache_info())
    assert clear_cache() == size
    assert cache_info().size == 0


@pytest.mark.parametrize("text", ["4GB", "-1", "inf", "nan"])
def test_a_limit_that_is_none_is_told_and_four_gigabytes_hold(monkeypatch, caplog, text):
    from flexcage.core import cache

    monkeypatch.setattr(cache, "_reported", set())
    monkeypatch.setenv("FLEXCAGE_CACHE_LIMIT_GB", text)
    assert cache.cache_limit() == cache.cache_limit() == 4_000_000_000
    assert caplog.text.count(f"FLEXCAGE_CACHE_LIMIT_GB is '{text}', but should be a number") == 1
    monkeypatch.setenv("FLEXCAGE_CACHE_LIMIT_GB", "0.5")
    assert cache.cache_limit() == 500_000_000 and len(caplog.records) == 1
