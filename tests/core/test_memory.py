"""Memory of the machine and of control groups, from files as Linux has them."""

from __future__ import annotations

import pytest

from flexcage.core import memory

GB = 2**30


@pytest.fixture
def groups(tmp_path, monkeypatch):
    """A machine of 64 GB with 40 GB free, and control groups to fill."""
    monkeypatch.setattr(memory, "_machine", {"MemTotal": 64.0 * GB, "MemAvailable": 40.0 * GB}.get)
    monkeypatch.setattr(memory, "_GROUPS", tmp_path)
    monkeypatch.setattr(memory, "_OF_PROCESS", tmp_path / "of_process")
    return tmp_path


def put(folder, **files):
    folder.mkdir(parents=True, exist_ok=True)
    for name, value in files.items():
        (folder / name.replace("__", ".")).write_text(f"{value}\n")


def test_a_machine_without_groups(groups):
    assert (memory.total_memory(), memory.free_memory()) == (64 * GB, 40 * GB)


def test_groups_without_limits(groups):
    put(groups, of_process="0::/user.slice")
    put(groups / "user.slice", memory__max="max", memory__current=GB)
    assert (memory.total_memory(), memory.free_memory()) == (64 * GB, 40 * GB)


def test_the_least_limit_on_the_way_up_holds(groups):
    """The job's own is 16 GB, its parent's 12 GB with 5 GB used, 2 of them files that can go."""
    put(groups, of_process="0::/slurm/job7/step")
    put(groups / "slurm/job7/step", memory__max="max", memory__current=GB)
    put(groups / "slurm/job7", memory__max=16 * GB, memory__current=5 * GB)
    put(groups / "slurm", memory__max=12 * GB, memory__current=5 * GB,
        memory__stat=f"anon 7\ninactive_file {2 * GB}")  # fmt: skip
    assert (memory.total_memory(), memory.free_memory()) == (12 * GB, 9 * GB)


def test_a_container_sees_its_own_limit_at_the_root(groups):
    put(groups, of_process="0::/", memory__max=4 * GB, memory__current=3 * GB)
    assert (memory.total_memory(), memory.free_memory()) == (4 * GB, 1 * GB)


def test_groups_of_version_one(groups):
    put(groups, of_process="9:cpu:/x\n4:memory:/docker/abc")
    put(groups / "memory", memory__limit_in_bytes=2**63 - 4096)
    put(groups / "memory/docker/abc", memory__limit_in_bytes=8 * GB,
        memory__usage_in_bytes=3 * GB, memory__stat=f"total_inactive_file {GB}")  # fmt: skip
    assert (memory.total_memory(), memory.free_memory()) == (8 * GB, 6 * GB)


def test_this_machine_has_some():
    assert 1e8 < memory.free_memory() <= memory.total_memory() < 1e15
