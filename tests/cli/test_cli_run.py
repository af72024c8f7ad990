"""Commands call the corridor with what was asked, and failures end with the right exit code."""

import errno
import math
import re
import sys
import types
from pathlib import Path

import pytest

from flexcage import cli
from flexcage.cli.settings import parse_setting
from flexcage.core.errors import EnvironmentLacks, RunFailed
from flexcage.core.timing import Stages
from flexcage.results.row import SummaryRow
from flexcage.results.summary import Section, Summary

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "n1013.toml")


class FakeRun:
    summary = Summary(
        (Section("Speeds", (SummaryRow("cage_speed", "Cage speed", 283.7, "rpm"),)),), ()
    )

    def __init__(self):
        self.drawn, self.stages, self.told, self.look = [], Stages(), [], {}

    def report_times(self):
        self.told.append(self.stages.total)

    def draw(self, folder, *, animate=False, **look):
        self.drawn.append((Path(folder), animate))
        self.look = look
        self.stages["pictures"] = 1.25


@pytest.fixture
def corridor(monkeypatch, tmp_path):
    """A corridor that records its calls, or raises what the test sets."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.delenv("FLEXCAGE_DEBUG", raising=False)
    module = types.ModuleType("flexcage.simulate")
    module.calls, module.error, module.run = [], None, FakeRun()

    def simulate(case, *, out=None, resume=False, other_version=False, progress=None):
        if module.error:
            if module.keeps:
                (Path(out) / "results.zarr").mkdir()
            raise module.error
        module.calls.append((case, out, resume))
        return module.run

    module.simulate, module.keeps = simulate, False
    module.load_run = lambda path, progress=None: module.run
    monkeypatch.setitem(sys.modules, "flexcage.simulate", module)
    return module


def test_run(corridor, capsys):
    argv = ["run", EXAMPLE, "-o", "out", "--cage", "rigid", "--animate"]
    argv += ["--set", "load.radial=2 kN", "--set", "bearing.roller_count=21"]
    argv += ["--set", "bearing.effective_length=7.64 mm"]
    assert cli.main(argv) == 0
    ((case, out, resume),) = corridor.calls
    assert case.cage_model == "rigid" and case.load.radial == 2000.0
    assert case.bearing.roller_count == 21 and not resume
    assert out == Path("out")
    assert corridor.run.drawn == [(Path("out/images"), True)]
    shown = capsys.readouterr().out
    assert "2,709.1  rpm" in shown and re.search(
        r"Pictures took 1\.2 s, all of it \d+\.\d s", shown
    )
    assert 0.0 < corridor.run.told[0] <= corridor.run.stages.total  # from the command's beginning


def test_run_without_images_in_the_default_folder(corridor):
    assert cli.main(["run", EXAMPLE, "--no-images"]) == 0
    assert corridor.calls[0][1] == Path("runs/n1013")
    assert corridor.run.drawn == []


def test_resume(corridor, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out" / "case.toml").touch()
    assert cli.main(["run", EXAMPLE, "-o", "out", "--resume"]) == 0
    assert corridor.calls[0][2] is True


@pytest.mark.parametrize(
    ("error", "code", "words"),
    [
        (RunFailed("The solver cannot go on at 12 ms."), 1, "cannot go on at 12 ms."),
        (EnvironmentLacks("No EGL; install it"), 1, "No EGL; install it."),
        (OSError(errno.ENOSPC, "No space left on device", "x.zarr"), 1, "disk is full at 'x.zarr'"),
        (OSError(errno.EIO, "Input/output error"), 1, "Input/output error"),
        (MemoryError(), 1, "too little memory"),
        (ZeroDivisionError("division by zero"), 1, "FLEXCAGE_DEBUG=1"),
        (KeyboardInterrupt(), 130, "Stopped."),
    ],
)
def test_failures_in_the_middle(corridor, capsys, error, code, words):
    corridor.error = error
    assert cli.main(["run", EXAMPLE, "-o", "out"]) == code
    err = capsys.readouterr().err
    assert err.startswith("flexcage: ") and err.count("\n") == 1 and words in err


def test_ctrl_c_says_what_is_kept(corridor, capsys):
    corridor.error, corridor.keeps = KeyboardInterrupt(), True
    assert cli.main(["run", EXAMPLE, "-o", "out"]) == 130
    err = capsys.readouterr().err
    assert "kept in 'out'" in err and "--resume" in err


def test_debug_shows_the_traceback(corridor, monkeypatch):
    monkeypatch.setenv("FLEXCAGE_DEBUG", "1")
    corridor.error = ZeroDivisionError("division by zero")
    with pytest.raises(ZeroDivisionError):
        cli.main(["run", EXAMPLE, "-o", "out"])


def test_render(corridor, tmp_path):
    (tmp_path / "out" / "results.zarr").mkdir(parents=True)
    assert cli.main(["render", "out"]) == 0
    assert cli.main(["render", "out", "-o", "elsewhere", "--animate"]) == 0
    assert corridor.run.drawn == [(Path("out/images"), False), (Path("elsewhere"), True)]


@pytest.mark.parametrize("command", [["render", "out"], ["run", EXAMPLE, "-o", "new"]])
def test_how_pictures_look(corridor, tmp_path, command):
    (tmp_path / "out" / "results.zarr").mkdir(parents=True)
    given = ["--view", "-30 deg", "--stress-limit", "25 MPa", "--scale", "50"]
    assert cli.main([*command, *given]) == 0
    assert corridor.run.look == pytest.approx(
        {"view": -math.pi / 6.0, "stress_limit": 25e6, "scale": 50.0}
    )


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        (["--view", "120"], "--view is 120 without a unit; write it with one, such as '120 deg'."),
        (["--view", "400 deg"], "--view is 400 deg, but must be 360 deg or less."),
        (["--stress-limit", "0 MPa"], "--stress-limit is 0 MPa, but must be greater than 0 MPa."),
        (["--stress-limit", "25 mm"], "--stress-limit is '25 mm', but 'mm' is of another kind"),
        (["--scale", "50 x"], "--scale is '50 x', but should be a number, such as 50."),
        (["--scale", "nan"], "--scale is nan, but must be a number."),
    ],
)
def test_a_look_that_cannot_be_is_refused_before_the_run(corridor, capsys, wrong, words):
    assert cli.main(["run", EXAMPLE, "-o", "new", *wrong]) == 2
    err = capsys.readouterr().err
    assert err.startswith(f"flexcage: {words}") and err.count("\n") == 1
    assert not corridor.calls


def test_presets_show_assumptions_and_ratings(capsys):
    assert cli.main(["presets"]) == 0
    assert "N1013" in capsys.readouterr().out
    assert cli.main(["presets", "N1013"]) == 0
    shown = capsys.readouterr().out
    line = next(x for x in shown.splitlines() if "cage.pocket_width" in x)
    assert "8.2 mm" in line and "assumption:" in line
    line = next(x for x in shown.splitlines() if "contacts.race.friction.peak " in x)
    assert "0.05" in line and "assumption: mineral oils" in line
    line = next(x for x in shown.splitlines() if "lubricant.viscosity" in x)
    assert "0.01 Pa*s" in line and "assumption: ISO 3448" in line
    assert "51.05 kN" in shown and "41.03 kN" in shown


def test_cache(corridor, capsys):
    assert cli.main(["cache"]) == 0
    assert "no entries" in capsys.readouterr().out
    assert cli.main(["cache", "--clear"]) == 0
    assert "freed" in capsys.readouterr().out


def test_doctor_fails_only_for_what_a_run_needs(monkeypatch, capsys):
    from flexcage.core import environment
    from flexcage.core.environment import Checked

    picture = Checked("rendering", False, "no EGL", "apt-get x", needed=False)
    gmsh = Checked("gmsh", False, "libGLU", "apt-get y")
    monkeypatch.setattr(environment, "probe", lambda: [picture])
    assert cli.main(["doctor"]) == 0
    assert "remedy: apt-get x" in capsys.readouterr().out
    monkeypatch.setattr(environment, "probe", lambda: [picture, gmsh])
    assert cli.main(["doctor"]) == 1


def test_version(capsys):
    with pytest.raises(SystemExit) as caught:
        cli.main(["--version"])
    assert caught.value.code == 0
    assert capsys.readouterr().out.startswith("flexcage ")


@pytest.mark.parametrize(
    ("text", "expected"),
    [
        ("cage.pocket_width=8.25 mm", ("cage.pocket_width", "8.25 mm")),
        ("bearing.roller_count=21", ("bearing.roller_count", 21)),
        ("modes.land = false", ("modes.land", False)),
        ("cage.material=PEEK", ("cage.material", "PEEK")),
        ("drive.times=['0 s', '1 s']", ("drive.times", ["0 s", "1 s"])),
        ("name=a=b", ("name", "a=b")),
    ],
)
def test_settings(text, expected):
    assert parse_setting(text) == expected


def test_modes_prints_its_table_and_stores_it(monkeypatch, tmp_path, capsys):
    from types import SimpleNamespace

    import numpy as np

    from flexcage import stages
    from flexcage.modes.table import ModeTable

    table = ModeTable(
        frequency=np.array([869.1, 1605.4]),
        kind=("free", "centrifugal"),
        effective_mass=np.array([[0.0, 0.0, 0.0], [2e-3, 0.0, 1e-4]]),
        share=np.array([[0.6, 0.5], [0.2, 0.1]]),
        residual_share=np.array([0.2, 0.4]),
    )
    cage = SimpleNamespace(body=None, table=table)
    monkeypatch.setattr(stages, "flexible_cage", lambda case: cage)
    monkeypatch.chdir(tmp_path)
    assert cli.main(["modes", EXAMPLE]) == 0
    shown = capsys.readouterr().out
    assert "eff. mass" in shown and "2.0e+00 g" in shown and "n1013_modes.csv" in shown
    lines = (tmp_path / "n1013_modes.csv").read_text("utf-8").splitlines()
    assert lines[0].startswith("number,") and len(lines) == 3
    assert dict(zip(lines[0].split(","), lines[2].split(",")))["effective_mass_x [kg]"] == "0.002"
    assert cli.main(["modes", EXAMPLE]) == 2 and "exists already" in capsys.readouterr().err
    assert cli.main(["modes", EXAMPLE, "-o", "t.txt"]) == 2
