"""Room on the disk: said before a run, and a run that cannot fit is refused."""

import logging
import shutil
import sys

import pytest

from flexcage import cli
from flexcage.case import load_case
from flexcage.core.errors import EnvironmentLacks
from flexcage.results import disk_space
from flexcage.run import cost
from flexcage.run.cost import Cost

CASE = """
bearing = { preset = "N1013" }
mesh = { fineness = "coarse" }
load = { radial = "1000 N" }
output = { block = 100 }
solver = { duration = "30 ms" }
"""


@pytest.fixture(autouse=True)
def no_pace(tmp_path, monkeypatch):
    """No run of before tells of its time."""
    monkeypatch.setattr(cost, "_file", lambda: tmp_path / "pace.json")


@pytest.fixture
def free(monkeypatch):
    """free(bytes): the disk has so many left."""

    def left(amount: float) -> None:
        usage = shutil.disk_usage(".")._replace(free=amount)
        monkeypatch.setattr(shutil, "disk_usage", lambda path: usage)

    return left


def told(folder, duration="10 s", cases=1, **changes):
    found = Cost()
    for _ in range(cases):
        found.counted(load_case(CASE).replace({"solver.duration": duration, **changes}))
    found.announce(folder)
    return found.disk


def test_a_long_run_is_announced_in_one_line(tmp_path, free, caplog):
    free(5e12)
    with caplog.at_level(logging.INFO, logger="flexcage"):
        size = told(tmp_path / "new")
    (line,) = caplog.messages
    assert f"about {size / 1e9:.3g} GB" in line and "5 TB left" in line and "new'" in line
    assert "for a second of bearing time" in line


def test_a_short_run_is_not(tmp_path, free, caplog):
    free(5e12)
    with caplog.at_level(logging.INFO, logger="flexcage"):
        told(tmp_path, "50 ms")
        told(None)  # of which nothing is kept
    assert not caplog.messages


def test_a_run_that_may_not_fit_is_warned_of_with_what_would(tmp_path, free, caplog):
    """Three quarters of what is needed: 0.9 of that are 0.675 of the duration, and of the rate."""
    free(0.75 * room_for())
    told(tmp_path)
    (record,) = caplog.records
    assert record.levelno == logging.WARNING
    said = record.getMessage()
    assert "solver.duration = 6800 ms, or for the whole at output.rate = 34 kHz" in said
    caplog.clear()
    told(tmp_path, "6800 ms")
    assert not [r for r in caplog.records if r.levelno >= logging.WARNING]


def room_for(**changes) -> float:
    found = Cost()
    found.counted(load_case(CASE).replace({"solver.duration": "10 s", **changes}))
    return found.disk


def test_a_run_that_cannot_fit_is_refused(tmp_path, free):
    free(0.1 * room_for())
    with pytest.raises(EnvironmentLacks, match="there is room for solver.duration = 900 ms"):
        told(tmp_path)


def test_a_study_is_counted_whole(tmp_path, free):
    """Of twelve cases that are kept a third fits, less a tenth."""
    free(4.0 * room_for())
    with pytest.raises(EnvironmentLacks, match="12 cases need .* keep = 'figures' .*, 3 fit; or"):
        told(tmp_path, cases=12)


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_the_estimate_is_that_of_a_run(tmp_path, monkeypatch, model):
    """Within a factor of 1.5 of the whole folder, without pictures."""
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(CASE)
    found = []
    monkeypatch.setattr(
        disk_space, "announce", lambda folder, size, *words, **_: found.append(size)
    )
    how = ("-o", "out", "--no-images", "--set", f"cage.model={model}")
    assert cli.main(["run", "case.toml", *how]) == 0
    (size,) = found
    files = (path for path in (tmp_path / "out").rglob("*") if path.is_file())
    assert 1.0 / 1.5 < size / sum(path.stat().st_size for path in files) < 1.5


def test_a_refused_run_leaves_no_folder_and_makes_no_mesh(tmp_path, monkeypatch, capsys, free):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "case.toml").write_text(CASE)
    module = sys.modules["flexcage.simulate"]
    monkeypatch.setattr(module, "made_cage", lambda *_: pytest.fail("a mesh was made"))
    free(1e5)
    assert cli.main(["run", "case.toml", "-o", "out", "--no-images"]) == 1
    *_, err = capsys.readouterr().err.splitlines()
    assert "'out' has 0 MB left" in err
    assert not (tmp_path / "out").exists()
