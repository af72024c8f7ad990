"""Run folders of other people and versions: read, drawn, reported and resumed without harm."""

import json
import os
import re
import shutil
from pathlib import Path

import pytest
from simulate_cases import Interrupted, n1013

from flexcage.cli import main
from flexcage.core.errors import InputError, RunFailed
from flexcage.results.summary import Summary
from flexcage.run import folder as folders
from flexcage.run import seams
from flexcage.simulate import load_run, simulate

pytestmark = pytest.mark.skipif(os.name != "posix", reason="links want rights on Windows")

BLOCK = 10 / 50e3  # [s]
CASE = n1013(
    {"cage.model": "rigid", "solver.duration": "0.8 ms", "output.block": 10,
     "mesh.fineness": "coarse"}
)  # fmt: skip


def interrupted(out: Path) -> Path:
    with pytest.raises(KeyboardInterrupt):
        simulate(CASE, out=out, progress=Interrupted(2, BLOCK))
    return out


@pytest.fixture(scope="module")
def kept(tmp_path_factory):
    """A run that stopped midway, and one that is complete."""
    new = tmp_path_factory.mktemp
    return {"half": interrupted(new("half")), "whole": simulate(CASE, out=new("whole")).folder}


@pytest.fixture
def half(kept, tmp_path):
    return Path(shutil.copytree(kept["half"], tmp_path / "half"))


@pytest.fixture
def whole(kept, tmp_path):
    return Path(shutil.copytree(kept["whole"], tmp_path / "whole"))


@pytest.fixture
def victim(tmp_path):
    """A file of the user's elsewhere."""
    path = tmp_path / "diary.txt"
    path.write_text("dear diary")
    return path


# --- another physics -----------------------------------------------------------------------------


def test_another_physics_is_not_gone_on_with_unseen(half, monkeypatch, caplog):
    monkeypatch.setattr(seams, "physics", lambda: "another")
    with pytest.raises(InputError, match=r"begun by another state of flexcage .*--other-version"):
        simulate(CASE, out=half, resume=True)
    run = simulate(CASE, out=half, resume=True, other_version=True)
    (seam,) = [w for w in run.warnings if w.key == "other_version"]
    assert re.search(r"From 0\.4 ms on \(sample 20\).*two models", seam.text)
    assert seam.text in caplog.text
    assert seam.text in " ".join((half / "summary.txt").read_text().split())
    again = load_run(half)
    assert seam in again.warnings
    (half / "summary.json").unlink()
    assert seam in load_run(half).warnings  # the results themselves say it
    page = again.report(half / "report.html").read_text()
    assert "two models may meet there" in page


def test_the_same_physics_goes_on_without_a_word(half):
    run = simulate(CASE, out=half, resume=True)
    assert run.store.complete and not [w for w in run.warnings if w.key == "other_version"]
    attrs = run.dataset.attrs
    assert attrs["version"] == seams.__version__ and attrs["physics"] == seams.physics()


def test_the_seam_is_that_of_what_was_added(half, monkeypatch):
    """A kill before the first block of the other version leaves the run without a seam."""

    def killed(*args, **kwargs):
        raise KeyboardInterrupt

    monkeypatch.setattr(seams, "physics", lambda: "another")
    monkeypatch.setattr(folders.RunStore, "write_block", killed)
    with pytest.raises(KeyboardInterrupt):
        simulate(CASE, out=half, resume=True, other_version=True)
    assert load_run(half).store.seams == []


def test_the_option_belongs_to_resume(tmp_path, capsys):
    assert main(["run", "case.toml", "--other-version", "-o", str(tmp_path / "x")]) == 2
    assert capsys.readouterr().err == "flexcage: --other-version belongs to --resume.\n"


# --- what was changed ----------------------------------------------------------------------------


def test_a_digit_in_the_summary_is_told(whole):
    stored = json.loads((whole / "summary.json").read_text())
    rows = next(rows for rows in stored.values() if "cage_speed" in rows)
    rows["cage_speed"]["value"] *= 10.0
    (whole / "summary.json").write_text(json.dumps(stored, indent=2))
    assert Summary.read(whole / "summary.json")["cage_speed"]  # by itself it is a summary
    with pytest.raises(InputError, match=r"summary\.json' .*changed afterwards; delete it, and it"):
        load_run(whole).summary["cage_speed"]
    (whole / "summary.json").unlink()
    assert load_run(whole).summary["cage_speed"] == pytest.approx(
        rows["cage_speed"]["value"] / 10.0
    )


def test_a_hash_that_is_not_the_case_s_is_told(whole, monkeypatch):
    run = load_run(whole)
    run.store.layout.attrs["hash"] = "0" * 16
    monkeypatch.setattr(folders, "sources", lambda: ())  # other tests load files of the user's own
    monkeypatch.setattr(folders.RunStore, "open", lambda path: run.store)
    with pytest.raises(InputError, match=r"name the case 0000.*run the case again"):
        load_run(whole)


# --- links ---------------------------------------------------------------------------------------

LINKS = ["results.zarr/zarr.json", "results.zarr/_run/commit.json", "images/orbit.png", "cage.zip",
         "summary.json", "results.zarr/time", "case.toml", "figures/mine.csv"]  # fmt: skip


@pytest.mark.parametrize("name", LINKS)
@pytest.mark.parametrize("command", ["render", "report", "resume"])
def test_no_command_follows_a_link(whole, victim, capsys, command, name):
    link = whole / name
    if link.is_dir():
        shutil.rmtree(link)
    link.parent.mkdir(exist_ok=True)
    link.unlink(missing_ok=True)
    link.symlink_to(victim)
    case = victim.with_name("case.toml")
    case.write_text(CASE.to_toml())
    words = {"resume": ["run", str(case), "-o", str(whole), "--resume"]}
    assert main(words.get(command, [command, str(whole)])) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and f"{name}' is a link to" in said and "diary" in said
    assert victim.read_text() == "dear diary"


@pytest.mark.parametrize("name", ["report.html", "report.html.new"])
def test_a_page_is_not_written_through_a_link(whole, victim, name):
    (whole / name).symlink_to(victim)
    assert main(["report", str(whole), "--force"]) == 0
    assert victim.read_text() == "dear diary"
    assert (whole / "report.html").read_text().startswith("<!") and not (
        whole / "report.html"
    ).is_symlink()


def test_pictures_are_not_drawn_into_a_folder_elsewhere(whole, tmp_path, capsys):
    (tmp_path / "other").mkdir()
    (whole / "images").symlink_to(tmp_path / "other")
    assert main(["render", str(whole)]) == 2
    assert "images' is a link to" in capsys.readouterr().err
    assert not any((tmp_path / "other").iterdir())


def test_a_folder_that_is_a_link_is_the_user_s_own_choice(whole, tmp_path):
    (tmp_path / "named").symlink_to(whole)
    assert load_run(tmp_path / "named").store.complete


# --- a folder that goes away, a terminal that cannot show it, a full disk ------------------------


def test_a_run_whose_folder_is_removed_says_so(tmp_path, capsys, monkeypatch):
    from flexcage.results.store import RunStore

    case, write = tmp_path / "case.toml", RunStore.write_block
    case.write_text(CASE.to_toml())

    def and_remove(store, index, *args, **kwargs):
        write(store, index, *args, **kwargs)
        if index == 1:
            shutil.rmtree(tmp_path / "out")

    monkeypatch.setattr(RunStore, "write_block", and_remove)
    assert main(["run", str(case), "-o", str(tmp_path / "out")]) == 1
    said = capsys.readouterr().err.splitlines()[-1]
    assert said.startswith(f"flexcage: The run's folder '{tmp_path / 'out'}' was moved or removed")
    assert not (tmp_path / "out" / "images").exists()


def test_a_run_whose_folder_is_removed_at_its_end_says_so(whole):
    run = load_run(whole)
    shutil.rmtree(whole)
    for what in (run.report_times, lambda: run.draw(whole / "images")):
        with pytest.raises(RunFailed, match="was moved or removed"):
            what()
    assert not whole.exists()


def test_a_terminal_of_few_letters_shows_the_figures(whole, tmp_path):
    import subprocess
    import sys

    done = subprocess.run(
        [sys.executable, "-m", "flexcage", "compare", str(whole), str(shutil.copytree(
            whole, tmp_path / "other")), "-o", str(tmp_path / "compare")],
        env={**os.environ, "PYTHONIOENCODING": "ascii"}, capture_output=True, text=True,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert done.stdout.isascii() and "um" in done.stdout


def test_a_full_disk_leaves_no_part_of_a_page(whole, capsys, monkeypatch):
    run = load_run(whole)
    images = [whole / "images" / "a.png"]
    images[0].parent.mkdir()
    from PIL import Image

    Image.new("RGB", (4, 4)).save(images[0])

    def full(_handle):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(os, "fsync", full)
    with pytest.raises(RunFailed, match="the disk is full"):
        run.report(whole / "report.html")
    assert not list(whole.glob("report*"))
