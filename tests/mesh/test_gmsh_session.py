"""gmsh's manners: what it lacks is named, and it is never left open."""

from __future__ import annotations

import importlib
import threading

import pytest

from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.mesh import gmsh_session
from flexcage.mesh.gmsh_session import gmsh_model


@pytest.mark.parametrize(
    ("error", "remedy"),
    [
        (OSError("libGLU.so.1: cannot open shared object file"), "sudo apt-get install -y libglu1"),
        (ModuleNotFoundError("No module named 'gmsh'"), "pip install gmsh"),
    ],
)
def test_missing_gmsh_or_library_names_the_command(monkeypatch, n1013, error, remedy):
    real = importlib.import_module

    def broken(name, *args):
        if name == "gmsh":
            raise error
        return real(name, *args)

    monkeypatch.setattr(gmsh_session.importlib, "import_module", broken)
    with pytest.raises(EnvironmentLacks, match=remedy):
        n1013(size=7.7e-3)


def test_gmsh_is_closed_after_an_error_of_its_own():
    gmsh = pytest.importorskip("gmsh")
    with pytest.raises(InputError, match="could not mesh"), gmsh_model("broken") as opened:
        opened.model.occ.addBox(0, 0, 0, 0, 0, 0)
    assert not gmsh.isInitialized()
    with pytest.raises(KeyError), gmsh_model("broken"):
        raise KeyError("not gmsh's")
    assert not gmsh.isInitialized()


def test_a_users_own_gmsh_session_survives(n1013):
    gmsh = pytest.importorskip("gmsh")
    gmsh.initialize(interruptible=False)
    try:
        gmsh.model.add("mine")
        n1013(size=6.1e-3)
        assert gmsh.isInitialized() and "mine" in gmsh.model.list()
    finally:
        gmsh.finalize()


def test_meshing_in_a_worker_thread_is_quiet(n1013, capfd):
    result = []
    thread = threading.Thread(target=lambda: result.append(n1013(size=6.3e-3)))
    thread.start()
    thread.join()
    assert result and result[0].volume > 0.0
    captured = capfd.readouterr()
    assert captured.out == "" and captured.err == ""
