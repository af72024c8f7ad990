"""What this machine has and lacks: every finding with its remedy, one command where there is one.

Off-screen rendering is probed in another process: VTK without EGL, X or OSMesa does not raise,
it kills the process.
"""

from __future__ import annotations

import importlib.metadata
import importlib.util
import os
import platform
import shutil
import subprocess
import sys
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from math import isinf

from flexcage.core.cache import cache_root, check_writable
from flexcage.core.errors import install, is_full
from flexcage.core.kernel_files import damaged, kernel_cache_dir
from flexcage.core.memory import total_memory
from flexcage.core.trust import distrusted

APT_RENDER = "sudo apt-get install -y libegl1 libgl1 libosmesa6 libxrender1"
APT_GMSH = (
    "sudo apt-get install -y libglu1-mesa libgl1 libxrender1 libxcursor1 libxfixes3 libxext6 "
    "libxft2 libfontconfig1 libxinerama1 libx11-6 libgomp1"
)
WINDOW_VARIABLE = "VTK_DEFAULT_OPENGL_WINDOW"
WINDOWS = ("default", "vtkEGLRenderWindow", "vtkOSOpenGLRenderWindow")
_PROBE_SECONDS = 60
_MINIMUM_MEMORY = 4e9
_CACHE_SPACE = 400e6  # bytes: kernels of both kinds of bearings (measured: 165 MB), some cages

# Draws one triangle and looks at the picture: a window that opens and draws nothing is no use.
_RENDER_PROBE = """
from vtkmodules.vtkCommonCore import vtkUnsignedCharArray
from vtkmodules.vtkFiltersSources import vtkConeSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow
import vtkmodules.vtkRenderingOpenGL2
window = vtkRenderWindow()
window.SetOffScreenRendering(1)
window.SetSize(32, 32)
renderer = vtkRenderer()
cone = vtkConeSource()
mapper = vtkPolyDataMapper()
mapper.SetInputConnection(cone.GetOutputPort())
actor = vtkActor()
actor.SetMapper(mapper)
renderer.AddActor(actor)
window.AddRenderer(renderer)
window.Render()
pixels = vtkUnsignedCharArray()
window.GetPixelData(0, 0, 31, 31, 0, pixels, 0)
drawn = any(pixels.GetValue(i) for i in range(pixels.GetNumberOfValues()))
print("drawn" if drawn else "empty", window.GetClassName())
"""


@dataclass(frozen=True)
class Checked:
    """One thing looked at: whether it is fine, what was found, and the remedy if it is not.

    ``needed`` is False for what makes things faster or gives pictures, True for what a run needs.
    """

    name: str
    ok: bool
    detail: str
    remedy: str = ""
    needed: bool = True


@dataclass(frozen=True)
class CheckOutcome:
    """How a probe in another process ended: ``code`` is negative for a signal."""

    code: int
    out: str
    err: str


def run_python(source: str, *, env: dict[str, str] | None = None) -> CheckOutcome:
    """Run a few lines of Python in a process of their own."""
    try:
        done = subprocess.run(
            [sys.executable, "-c", source],
            capture_output=True,
            text=True,
            timeout=_PROBE_SECONDS,
            env={**os.environ, **(env or {})},
            check=False,
        )
    except subprocess.TimeoutExpired:
        return CheckOutcome(124, "", f"no answer within {_PROBE_SECONDS} s")
    return CheckOutcome(done.returncode, done.stdout, done.stderr)


@cache
def offscreen_backend() -> str | None:
    """How VTK can draw off screen here: "default", a window class to force, or None if it cannot.

    Costs a second or two the first time in a process.
    """
    if importlib.util.find_spec("vtkmodules") is None:
        return None
    already = os.environ.get(WINDOW_VARIABLE)
    for window in (already,) if already else WINDOWS:
        env = {} if window == "default" else {WINDOW_VARIABLE: window}
        if run_python(_RENDER_PROBE, env=env).out.startswith("drawn"):
            return window
    return None


def probe() -> list[Checked]:
    """Look at all that flexcage needs or can use on this machine."""
    looks: tuple[Callable[[], Checked], ...] = (
        _python,
        _gmsh,
        _rendering,
        _solver,
        _cache_folder,
        _kernel_cache,
        _cores,
        _memory,
    )
    return [look() for look in looks]


def _python() -> Checked:
    version = platform.python_version()
    ok = sys.version_info >= (3, 11)
    return Checked("python", ok, version, "" if ok else "install Python 3.11 or later")


def _gmsh() -> Checked:
    done = run_python("import gmsh; print(gmsh.__version__)")
    if done.code == 0:
        return Checked("gmsh", True, done.out.strip())
    reason = done.err.strip().splitlines()[-1] if done.err.strip() else f"exit {done.code}"
    remedy = "pip install gmsh" if "No module named" in reason else APT_GMSH
    return Checked("gmsh", False, reason, remedy)


def _rendering() -> Checked:
    if importlib.util.find_spec("vtkmodules") is None:
        return Checked("rendering", False, "VTK is missing", "pip install pyvista", needed=False)
    window = offscreen_backend()
    if window is None:
        return Checked("rendering", False, "no way to draw off screen", APT_RENDER, needed=False)
    return Checked("rendering", True, f"VTK {_version('vtk')}, {window} window", needed=False)


def _solver() -> Checked:
    packages = {"pypardiso": "PARDISO", "cvxopt": "CHOLMOD", "sksparse": "CHOLMOD"}
    found = [f"{name} ({p})" for p, name in packages.items() if importlib.util.find_spec(p)]
    if found:
        return Checked("linear solver", True, ", ".join(found) + ", SciPy", needed=False)
    return Checked(
        "linear solver",
        False,
        "SciPy's SuperLU only: fine meshes from files take several times as long",
        install("fast"),
        needed=False,
    )


def _cache_folder() -> Checked:
    folder = cache_root()
    if reason := distrusted(folder):
        remedy = "set FLEXCAGE_CACHE_DIR to a folder of your own"
        return Checked("cache folder", False, f"{folder}: {reason}", remedy, needed=False)
    try:
        check_writable(folder)
    except OSError as exc:
        reason = f"{folder} cannot be written: {(exc.strerror or str(exc)).lower()}"
        remedy = f"set FLEXCAGE_CACHE_DIR to a folder that can be written{_free_space_hint(exc)}"
        return Checked("cache folder", False, reason, remedy, needed=False)
    free = shutil.disk_usage(folder).free
    if free < _CACHE_SPACE:
        detail = f"{folder} has {free / 1e6:.0f} MB left; kernels and modes want more"
        remedy = f"make room there for {_CACHE_SPACE / 1e6:.0f} MB, or set FLEXCAGE_CACHE_DIR"
        return Checked("cache folder", False, detail, remedy, needed=False)
    return Checked("cache folder", True, str(folder), needed=False)


def _free_space_hint(error: OSError) -> str:
    return ", or make room there" if is_full(error) else ""


def _kernel_cache() -> Checked:
    """Compiled kernels that cannot be read."""
    folder = kernel_cache_dir()
    if reason := distrusted(folder):
        detail = f"{folder}: {reason}; kernels are compiled anew in every run"
        remedy = "set FLEXCAGE_CACHE_DIR to a folder of your own"
        return Checked("kernel cache", False, detail, remedy, needed=False)
    bad = damaged(folder)
    if not bad:
        return Checked("kernel cache", True, str(folder), needed=False)
    more = f" and {len(bad) - 1} more" if len(bad) > 1 else ""
    detail = f"{bad[0]}{more} cannot be read; a run compiles such a kernel anew"
    remedy = "flexcage cache --clear, which removes all that the cache holds"
    return Checked("kernel cache", False, detail, remedy, needed=False)


def _cores() -> Checked:
    affinity = getattr(os, "sched_getaffinity", None)
    count = len(affinity(0)) if affinity else os.cpu_count() or 1
    return Checked("cores", True, f"{count}", needed=False)


def _memory() -> Checked:
    total = total_memory()
    if isinf(total):
        return Checked("memory", True, "unknown", needed=False)
    ok = total >= _MINIMUM_MEMORY
    remedy = "" if ok else "take mesh.fineness = 'coarse'; the medium mesh may want up to 4 GB"
    return Checked("memory", ok, f"{total / 1e9:.1f} GB", remedy, needed=False)


def _version(package: str) -> str:
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return "of unknown version"
