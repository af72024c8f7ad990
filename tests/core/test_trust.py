"""A cache that others may write to is not read: its kernels are code, kept in pickles."""

import logging
import os
import pickle
import stat
from pathlib import Path

import numpy as np
import pytest

from flexcage.core import cache, environment, trust
from flexcage.core.kernel_files import KernelFolder, damaged, write_whole
from flexcage.core.trust import distrusted, make_private

pytestmark = pytest.mark.skipif(os.name != "posix", reason="permissions are of another kind")


@pytest.fixture(autouse=True)
def quiet(monkeypatch):
    monkeypatch.setattr(cache, "_reported", set())


@pytest.fixture
def folder(tmp_path, monkeypatch) -> Path:
    """A cache of this user's, as it is made."""
    path = tmp_path / "cache"
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(path))
    make_private(path / "kernels")
    assert not distrusted(path / "kernels")
    return path


def of_another(monkeypatch, *paths: Path) -> None:
    """Let paths belong to another user."""
    own = Path.lstat

    def lstat(path):
        found = own(path)
        if path not in paths:
            return found
        values = list(found)
        values[4] = os.geteuid() + 1000
        return os.stat_result(values)

    monkeypatch.setattr(Path, "lstat", lstat)


def test_what_is_made_is_for_this_user_alone(folder):
    umask = os.umask(0)
    try:
        make_private(folder / "kernels" / "deep" / "deeper")
    finally:
        os.umask(umask)
    for path in (folder, folder / "kernels", folder / "kernels" / "deep" / "deeper"):
        assert stat.S_IMODE(path.stat().st_mode) == 0o700, path


def test_a_folder_of_another_user_is_not_trusted(folder, monkeypatch):
    of_another(monkeypatch, folder)
    said = distrusted(folder / "kernels")
    assert said.startswith(f"'{folder}' belongs to another user (number {os.geteuid() + 1000})")


def test_a_parent_of_another_user_is_not_trusted(folder, monkeypatch):
    of_another(monkeypatch, folder.parent)
    assert f"'{folder.parent}' belongs to another user" in distrusted(folder)


@pytest.mark.parametrize("mode", [0o777, 0o757, 0o1777])
@pytest.mark.parametrize("part", ["", "kernels"])
def test_a_folder_that_others_may_write_is_not_trusted(folder, mode, part):
    (folder / part).chmod(mode)
    said = distrusted(folder / part)
    assert said.startswith(f"other users may write to '{folder / part}'")
    assert (f"chmod go-w '{folder / part}'" in said) == (mode < 0o1000)  # not of such as /tmp
    (folder / part).chmod(mode & ~0o022)
    assert not distrusted(folder / part)


def test_a_group_of_others_may_not_write_and_one_s_own_may(folder, monkeypatch):
    folder.chmod(0o770)
    monkeypatch.setattr(trust, "_alone_in", lambda group: False)
    assert "other users may write" in distrusted(folder)
    monkeypatch.setattr(trust, "_alone_in", lambda group: True)
    assert not distrusted(folder)


def test_a_parent_as_tmp_is_trusted_and_one_without_the_sticky_bit_is_not(folder, tmp_path):
    tmp_path.chmod(0o1777)
    assert not distrusted(folder)
    tmp_path.chmod(0o777)
    assert f"write to '{tmp_path}'" in distrusted(folder)
    tmp_path.chmod(0o700)


def test_what_a_link_leads_to_is_looked_at(folder, tmp_path):
    (tmp_path / "link").symlink_to(folder)
    assert not distrusted(tmp_path / "link" / "kernels")
    folder.chmod(0o777)
    assert "other users may write" in distrusted(tmp_path / "link" / "kernels")


def test_a_link_of_another_user_is_not_followed(folder, tmp_path, monkeypatch):
    link = tmp_path / "link"
    link.symlink_to(folder)
    of_another(monkeypatch, link)
    assert f"'{link}' belongs to another user" in distrusted(link / "kernels")


def test_kernels_are_then_kept_in_a_temporary_folder_and_it_is_told_once(folder, caplog):
    folder.chmod(0o777)
    kernels = KernelFolder(folder / "kernels")
    with caplog.at_level(logging.WARNING):
        places = kernels.places, kernels.places
    assert places[0] == places[1] and len(places[0]) == 1
    assert not places[0][0].is_relative_to(folder)
    assert stat.S_IMODE(places[0][0].stat().st_mode) == 0o700
    (record,) = caplog.records
    assert "is not used: other users may write" in record.getMessage()
    assert "FLEXCAGE_CACHE_DIR" in record.getMessage()


def test_arrays_of_others_are_not_taken(folder, caplog):
    def make():
        return {"a": np.array([1.0])}

    cache.cached_arrays("modes", "k", make)
    np.savez(folder / "arrays" / "modes" / "k.npz", a=np.array([2.0]))
    assert cache.cached_arrays("modes", "k", make)["a"] == 2.0  # as it lies there
    folder.chmod(0o777)
    assert cache.cached_arrays("modes", "k", make)["a"] == 1.0
    assert "is not used" in caplog.text


class Harmful:
    """What writes a file when it is unpickled."""

    def __init__(self, mark):
        self.mark = mark

    def __reduce__(self):
        return open, (str(self.mark), "w")


@pytest.mark.parametrize("mode", [0o777, 0o700])
def test_the_doctor_loads_no_pickle(folder, tmp_path, mode):
    """Neither of a foreign cache, which it names, nor of the user's own."""
    mark = tmp_path / "mark"
    content = pickle.dumps(Harmful(mark))
    write_whole(folder / "kernels" / "f.g-1.kernel", content)
    (folder / "kernels" / "f.g-2.kernel").write_bytes(content)
    folder.chmod(mode)
    findings = {finding.name: finding for finding in (
        environment._cache_folder(), environment._kernel_cache()
    )}  # fmt: skip
    assert not mark.exists()
    if mode == 0o777:
        for finding in findings.values():
            assert not finding.ok and "other users may write" in finding.detail
            assert finding.remedy == "set FLEXCAGE_CACHE_DIR to a folder of your own"
    else:
        assert [path.name for path in damaged(folder / "kernels")] == ["f.g-2.kernel"]
    assert not mark.exists()
