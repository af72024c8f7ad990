"""One writer at a time in a run's folder, and none that a kill makes useless."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest

from flexcage import cli, load_case
from flexcage.core.errors import InputError
from flexcage.core.locks import LOCK, held
from flexcage.simulate import simulate

CASE = """
bearing = { preset = "N1013" }
cage = { model = "rigid" }
mesh = { fineness = "coarse" }
load = { radial = "1000 N" }
output = { block = 50 }
solver = { duration = "0.2 ms" }
"""
HOLD = """
import sys
from pathlib import Path
from flexcage.core.locks import held
with held(Path(sys.argv[1])):
    print("held", flush=True)
    sys.stdin.read()
"""


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(CASE)
    return tmp_path


@pytest.fixture
def writer(here):
    """A process that holds the folder of a finished run."""
    simulate(load_case(here / "case.toml"), out=here / "cc")
    process = subprocess.Popen(
        [sys.executable, "-c", HOLD, str(here / "cc")], stdin=subprocess.PIPE,
        stdout=subprocess.PIPE, text=True,
    )  # fmt: skip
    assert process.stdout.readline() == "held\n"
    yield process
    process.kill()
    process.communicate()


def run(*options: str) -> int:
    return cli.main(["run", "case.toml", "-o", "cc", "--no-images", *options])


@pytest.mark.parametrize("option", [[], ["--force"], ["--resume"]])
def test_a_folder_that_another_process_writes_is_left_alone(writer, here, capsys, option):
    before = sorted(here.rglob("*"))
    assert run(*option) == 2
    err = capsys.readouterr().err
    assert err.count("\n") == 1 and f"process {writer.pid} on " in err and "-o" in err
    assert sorted(here.rglob("*")) == before
    with pytest.raises(InputError, match=f"process {writer.pid}"):
        simulate(load_case(here / "case.toml"), out=here / "cc")


def test_what_another_process_writes_inside_is_not_emptied(writer, here, capsys):
    (here / "outer").mkdir()
    (here / "outer" / "compare.json").touch()
    with held(here / "outer" / "rigid"):
        pass
    inner = here / "outer" / "flexible"
    with subprocess.Popen(
        [sys.executable, "-c", HOLD, str(inner)], stdin=subprocess.PIPE, stdout=subprocess.PIPE
    ) as other:
        other.stdout.readline()
        assert cli.main(["static", "case.toml", "-o", "outer", "--force"]) == 2
        assert f"process {other.pid} on " in capsys.readouterr().err
        other.stdin.close()
    assert (here / "outer" / "compare.json").exists()


def test_the_lock_of_a_killed_process_holds_nothing(writer, here):
    os.kill(writer.pid, signal.SIGKILL)
    writer.wait()
    assert (here / "cc" / LOCK).exists()
    assert run("--force") == 0
    assert not (here / "cc" / LOCK).exists()


def test_of_two_new_runs_at_once_one_is_computed(here):
    command = [sys.executable, "-m", "flexcage.cli", "run", "case.toml", "-o", "cc", "--no-images"]
    both = [
        subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
        for _ in range(2)
    ]
    said = [process.communicate()[1] for process in both]
    assert sorted(process.returncode for process in both) == [0, 2], said
    refused = said[0] if both[0].returncode else said[1]
    assert refused.count("\n") == 1 and ("Another process" in refused or "exists" in refused)
    assert run("--resume") == 0


@pytest.mark.parametrize("left", [["case.toml.new"], [LOCK], [LOCK, "case.toml.new"]])
@pytest.mark.parametrize("option", [[], ["--force"], ["--resume"]])
def test_what_a_kill_at_the_very_beginning_leaves_is_no_obstacle(here, left, option):
    (here / "cc").mkdir()
    for name in left:
        (here / "cc" / name).write_text("half a ca")
    assert run(*option) == 0
    assert (here / "cc" / "summary.json").exists()


def test_there_is_still_nothing_to_resume_where_there_is_nothing(here, capsys):
    (here / "cc").mkdir()
    assert run("--resume") == 2 and "nothing to resume" in capsys.readouterr().err
    (here / "cc").rmdir()
    assert run("--resume") == 2 and "nothing to resume" in capsys.readouterr().err
    with pytest.raises(InputError, match="nothing to resume"):
        simulate(load_case(here / "case.toml"), out=Path("cc"), resume=True)
    assert not (here / "cc").exists()


@pytest.mark.parametrize("name", ["out.txt", "flex.npz", "page.html", "table.csv", "OUT.JSON"])
def test_a_folder_is_not_named_as_a_file(tmp_path, name):
    """What was asked for as a file became a folder of that name, in silence."""
    from flexcage.core.output_folders import check_no_file

    with pytest.raises(InputError, match=f"{name}' is named as a file; name a folder .*, as '"):
        check_no_file(tmp_path / name)
    check_no_file(tmp_path / "load.1000")  # a folder's name may have a point
    (tmp_path / name).mkdir()
    check_no_file(tmp_path / name)
