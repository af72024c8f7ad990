"""Files are written beside their place and renamed; no name and no link leads out of a folder."""

import os
import stat
from pathlib import Path

import pytest

from flexcage.core.errors import InputError
from flexcage.core.locks import LOCK, check_free, held
from flexcage.core.writing import (
    SPARE,
    check_name,
    check_own,
    folder_in,
    holds_others,
    replace,
    unusable,
    write_text,
    written,
)

pytestmark = pytest.mark.skipif(os.name != "posix", reason="links want rights on Windows")

OUTSIDE = ["../x", "..", "a/b", "/etc/passwd", "a\\b", "C:x", "", " ", ". .", "a\nb", "a\0b"]


@pytest.fixture
def victim(tmp_path: Path) -> Path:
    """A file elsewhere, which must stay as it is."""
    path = tmp_path / "elsewhere.txt"
    path.write_text("mine")
    return path


@pytest.fixture
def run(tmp_path: Path) -> Path:
    path = tmp_path / "run"
    path.mkdir()
    return path


@pytest.mark.parametrize("name", [*OUTSIDE, "n" * 201])
def test_a_name_that_leads_elsewhere_is_refused(name, run):
    with pytest.raises(InputError, match="The case's name is .* folder"):
        check_name(name, "The case's name")
    with pytest.raises(InputError):
        folder_in(run, "images", name)
    assert not any((run.parent).glob("x"))


@pytest.mark.parametrize("name", ["N1013", "höher, weiter", "a.b", ".hidden", "n" * 200])
def test_a_name_that_a_folder_can_have_is_not(name, run):
    assert not unusable(name) and check_name(name, "It") == name
    assert folder_in(run, name, "images").is_dir()


@pytest.mark.parametrize("linked", ["page.html", "page.html.new"])
def test_writing_replaces_a_link_and_not_what_it_points_to(linked, run, victim):
    (run / linked).symlink_to(victim)
    replace(run / "page.html", b"ours")
    assert victim.read_text() == "mine"
    assert (run / "page.html").read_text() == "ours" and not (run / "page.html").is_symlink()
    assert [p.name for p in run.iterdir()] == ["page.html"]


def test_a_library_writes_beside_and_its_file_is_renamed(run, victim):
    (run / "orbit.png").symlink_to(victim)
    with written(run / "orbit.png") as path:
        assert path.name == "orbit.png" and path.parent.parent == run
        path.write_text("ours")
        assert victim.read_text() == "mine"
        assert list(run.glob("*.png")) == [run / "orbit.png"]  # no picture yet
    assert (run / "orbit.png").read_text() == "ours" and victim.read_text() == "mine"
    assert not (run / "orbit.png").is_symlink()


def test_what_is_written_can_be_read_by_those_who_could_before(run):
    umask = os.umask(0o022)
    try:
        replace(run / "a", b"")
        with written(run / "b") as path:
            path.write_text("")
    finally:
        os.umask(umask)
    assert [stat.S_IMODE((run / name).stat().st_mode) for name in "ab"] == [0o644, 0o644]


def test_of_an_error_nothing_is_left_and_the_old_file_stays(run, monkeypatch):
    write_text(run / "page.html", "old")

    def full(_handle: int) -> None:
        raise OSError(28, "No space left on device")

    with pytest.raises(ZeroDivisionError), written(run / "page.html") as path:
        path.write_text("half")
        raise ZeroDivisionError
    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(OSError, match="No space"):
        replace(run / "page.html", b"half")
    with pytest.raises(OSError, match="No space"), written(run / "page.html") as path:
        path.write_text("half")
    assert [p.name for p in run.iterdir()] == ["page.html"]
    assert (run / "page.html").read_text() == "old"


def test_a_folder_holds_others_than_those_that_are_known(run):
    assert not holds_others(run, ()) and not holds_others(run / "nothing here", ())
    (run / f"{SPARE}abc").mkdir()
    (run / LOCK).write_text("")
    assert not holds_others(run, (LOCK,)) and holds_others(run, ())


def test_links_and_devices_inside_a_folder_are_told(run, victim):
    (run / "images" / "deep").mkdir(parents=True)
    (run / "images" / "orbit.png").write_text("")
    check_own(run, run / "nothing here")
    (run / "images" / "deep" / "a.png").symlink_to(victim)
    with pytest.raises(InputError, match=r"a\.png' is a link to '.*elsewhere\.txt'.*remove"):
        check_own(run)
    (run / "images" / "deep" / "a.png").unlink()
    os.mkfifo(run / "pipe")
    with pytest.raises(InputError, match="pipe' is neither a file nor a folder"):
        check_own(run)


def test_a_folder_is_not_made_behind_a_link(run, tmp_path):
    (tmp_path / "other").mkdir()
    (run / "images").symlink_to(tmp_path / "other")
    with pytest.raises(InputError, match="images' is a link to"):
        folder_in(run, "images", "deep")
    assert not any((tmp_path / "other").iterdir())


def test_a_lock_is_not_written_through_a_link(run, victim):
    (run / LOCK).symlink_to(victim)
    with pytest.raises(InputError, match="is a link to"), held(run):
        pass
    with pytest.raises(InputError, match="is a link to"):
        check_free(run)
    assert victim.read_text() == "mine"


def test_a_folder_that_is_a_link_itself_is_the_user_s_own_choice(run, tmp_path):
    (tmp_path / "runs").symlink_to(run)
    with held(tmp_path / "runs"):
        replace(tmp_path / "runs" / "a", b"1")
        folder_in(tmp_path / "runs", "images")
    assert sorted(p.name for p in run.iterdir()) == ["a", "images"]
