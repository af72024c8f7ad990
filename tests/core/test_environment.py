"""The doctor: a probe that dies does not take this process along, and every lack has a remedy."""

import importlib.util
import os

import pytest

from flexcage.core import environment
from flexcage.core.environment import CheckOutcome, offscreen_backend, probe
from flexcage.core.errors import EnvironmentLacks
from flexcage.core.offscreen import opening_window


@pytest.fixture(autouse=True)
def fresh(monkeypatch, tmp_path):
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: object())
    monkeypatch.delenv("VTK_DEFAULT_OPENGL_WINDOW", raising=False)
    offscreen_backend.cache_clear()
    yield
    offscreen_backend.cache_clear()


def pretend(monkeypatch, works):
    """A machine on which only the window classes in ``works`` draw; others crash."""

    def run(source, *, env=None):
        window = (env or {}).get("VTK_DEFAULT_OPENGL_WINDOW", "default")
        return CheckOutcome(0, "drawn x\n", "") if window in works else CheckOutcome(-11, "", "")

    monkeypatch.setattr(environment, "run_python", run)


@pytest.mark.parametrize("window", ["default", "vtkEGLRenderWindow", "vtkOSOpenGLRenderWindow"])
def test_takes_the_first_window_that_draws(monkeypatch, window):
    pretend(monkeypatch, {window})
    assert offscreen_backend() == window
    with opening_window():
        pass
    forced = os.environ.pop("VTK_DEFAULT_OPENGL_WINDOW", "default")
    assert forced == window


def test_without_any_the_remedy_is_one_command(monkeypatch):
    pretend(monkeypatch, set())
    with pytest.raises(EnvironmentLacks, match="apt-get install -y libegl1"):
        with opening_window():
            pass
    finding = next(f for f in probe() if f.name == "rendering")
    assert not finding.ok and not finding.needed and "apt-get" in finding.remedy


def test_what_drew_once_is_not_looked_for_again(monkeypatch):
    pretend(monkeypatch, {"vtkEGLRenderWindow"})
    with opening_window():
        pass
    monkeypatch.delenv("VTK_DEFAULT_OPENGL_WINDOW")
    offscreen_backend.cache_clear()
    pretend(monkeypatch, set())
    with opening_window():
        assert os.environ["VTK_DEFAULT_OPENGL_WINDOW"] == "vtkEGLRenderWindow"


def test_after_a_crash_of_the_window_it_is_looked_for_again(monkeypatch):
    """A window that kills its process leaves the block early, as an error does here."""
    pretend(monkeypatch, {"default"})
    with opening_window():
        pass
    with pytest.raises(KeyboardInterrupt), opening_window():
        raise KeyboardInterrupt
    offscreen_backend.cache_clear()
    pretend(monkeypatch, set())
    with pytest.raises(EnvironmentLacks), opening_window():
        pass


@pytest.mark.parametrize("name", ["DISPLAY", "LIBGL_ALWAYS_SOFTWARE"])
def test_in_another_environment_it_is_looked_for(monkeypatch, name):
    pretend(monkeypatch, {"default"})
    with opening_window():
        pass
    monkeypatch.setenv(name, "1")
    offscreen_backend.cache_clear()
    pretend(monkeypatch, set())
    with pytest.raises(EnvironmentLacks), opening_window():
        pass


def test_a_probe_that_is_killed_is_survived():
    died = environment.run_python("import os; os.kill(os.getpid(), 11)")
    assert died.code == -11


def test_missing_library_of_gmsh_gets_a_command(monkeypatch):
    error = "Traceback\nOSError: libGLU.so.1: cannot open shared object file"
    monkeypatch.setattr(environment, "run_python", lambda s, env=None: CheckOutcome(1, "", error))
    finding = environment._gmsh()
    assert not finding.ok and "libGLU.so.1" in finding.detail and "libglu1-mesa" in finding.remedy


def test_every_lack_has_a_remedy(monkeypatch, tmp_path):
    pretend(monkeypatch, set())
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "file"))
    monkeypatch.setattr(importlib.util, "find_spec", lambda name: None)
    findings = probe()
    assert {f.name for f in findings if not f.ok} >= {
        "gmsh",
        "rendering",
        "linear solver",
        "cache folder",
    }
    assert all(f.remedy for f in findings if not f.ok)
