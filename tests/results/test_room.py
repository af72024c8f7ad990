"""Room on the disk: said before a run, and a run that cannot fit is refused."""

import logging
import shutil

import pytest

from flexcage import cli
from flexcage.core.errors import EnvironmentLacks
from flexcage.results import room

CASE = """
bearing = { preset = "N1013" }
cage = { model = "rigid" }
mesh = { fineness = "coarse" }
load = { radial = "1000 N" }
solver = { duration = "10 ms" }
"""


@pytest.fixture
def free(monkeypatch):
    """free(bytes): the disk has so many left."""

    def left(amount: float) -> None:
        usage = shutil.disk_usage(".")._replace(free=amount)
        monkeypatch.setattr(shutil, "disk_usage", lambda path: usage)

    return left


def test_a_long_run_is_announced_in_one_line(tmp_path, free, caplog):
    free(5e12)
    with caplog.at_level(logging.INFO, logger="flexcage"):
        room.announce(tmp_path / "new", 4e8, 10.0)
    (line,) = caplog.messages
    assert "about 4 GB (400 MB for a second" in line and "5 TB left" in line and "new'" in line


def test_a_short_run_is_not(tmp_path, free, caplog):
    free(5e12)
    with caplog.at_level(logging.INFO, logger="flexcage"):
        room.announce(tmp_path, 4e8, 0.01)
    assert not caplog.messages


def test_a_run_that_may_not_fit_is_warned_of(tmp_path, free, caplog):
    free(3e9)
    room.announce(tmp_path, 4e8, 10.0)
    (record,) = caplog.records
    assert record.levelno == logging.WARNING and "solver.duration" in record.getMessage()


def test_a_run_that_cannot_fit_is_refused(tmp_path, free):
    free(1e9)
    with pytest.raises(EnvironmentLacks, match="1 GB left: shorten solver.duration"):
        room.announce(tmp_path, 4e8, 10.0)


def test_the_estimate_is_that_of_a_run(tmp_path, monkeypatch):
    """Within a factor of two of what lies on the disk; a refused run leaves no folder."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(CASE)
    told = []
    monkeypatch.setattr(
        room, "announce", lambda folder, rate, duration: told.append((rate, duration))
    )
    assert cli.main(["run", "case.toml", "-o", "out", "--no-images"]) == 0
    ((rate, duration),) = told
    store = (tmp_path / "out" / "results.zarr").rglob("*")
    size = sum(path.stat().st_size for path in store if path.is_file())
    assert duration == pytest.approx(0.01) and 0.5 < rate * duration / size < 2.0


def test_a_refused_run_leaves_no_folder(tmp_path, monkeypatch, capsys, free):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(CASE)
    free(1e5)
    assert cli.main(["run", "case.toml", "-o", "out", "--no-images"]) == 1
    warned, err = capsys.readouterr().err.splitlines()
    assert warned.startswith("warning: The run is short") and "'out' has 0 MB left" in err
    assert not (tmp_path / "out").exists()
