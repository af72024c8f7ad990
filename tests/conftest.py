"""What tests of several rooms share: the N1013 with a rigid cage, and its kernels' arrays; and
kernels that are compiled once for all processes of ``pytest -n``."""

from __future__ import annotations

import os
import subprocess
import sys
from collections import Counter
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest


def rigid_interface(pockets: int, *, stations: int = 7, land: int = 24):
    """Interface of a cage without modes: flat walls, no compliance."""
    from flexcage.modes.basis import CageInterface

    z = np.zeros
    return CageInterface(
        stations=np.stack([np.linspace(-4e-3, 4e-3, stations)] * 4),
        offset=z((pockets, 4, stations)),
        modes=z((pockets, 4, stations, 3, 0)),
        residual=z((pockets, 4, stations, 12)),
        compliance=z((pockets, 12, 12)),
        patch_half_width=1.9e-3,
        land=z((2, land, 3, 0)),
    )


def hollow_cylinder(cage):
    """Rigid body of the cage taken as a hollow cylinder without pockets."""
    from flexcage.bodies.floating_frame import rigid_body

    ro, ri, b = 0.5 * cage.outside_diameter, 0.5 * cage.bore, cage.width
    mass = cage.material.density * np.pi * (ro**2 - ri**2) * b * 0.6
    around = 0.25 * mass * (ro**2 + ri**2)
    return rigid_body(mass, np.zeros(3), np.diag([mass * b * b / 12.0, around, around]))


@pytest.fixture(scope="session")
def n1013():
    """Bearing and cage of the preset."""
    from flexcage.case.presets import load_preset

    preset = load_preset("N1013")
    return preset.bearing, preset.cage


@pytest.fixture(scope="session")
def build_parts(n1013):
    """build_parts(...) -> model of the N1013; keywords replace specs or their values."""
    from flexcage.bearings.cylindrical_roller.model import build_roller_model
    from flexcage.contacts.spec import Contacts, Lubricant
    from flexcage.system.spec import Drive, Load, Mount

    def build(
        *, bearing=None, cage=None, body=None, interface=None, contacts=None, lubricant=None,
        drive=None, load=None, mount=None,
    ):  # fmt: skip
        b, c = replace(n1013[0], **(bearing or {})), replace(n1013[1], **(cage or {}))
        return build_roller_model(
            b, c, body or hollow_cylinder(c), interface or rigid_interface(b.roller_count),
            contacts=contacts or Contacts(), lubricant=lubricant or Lubricant(),
            drive=drive or Drive(), load=load or Load(), mount=mount or Mount(),
        )  # fmt: skip

    return build


@pytest.fixture(autouse=True)
def wide_terminal(monkeypatch):
    """Tests read what is printed, not how it wraps; those of widths set their own."""
    monkeypatch.setenv("COLUMNS", "1000")


def pytest_configure(config):
    # numba calls functions passed as values experimental
    config.addinivalue_line("filterwarnings", "ignore:First-class function type feature")


COMPILE = """
import sys
from flexcage.case import load_case
from flexcage.study.work import compile_kernels
compile_kernels(load_case(sys.argv[1]))
"""


def pytest_sessionstart(session):
    """Compile the kernels before processes start that would each do so, with BLAS on one thread."""
    option, worker = session.config.option, hasattr(session.config, "workerinput")
    if worker or option.collectonly or not getattr(option, "numprocesses", None):
        return
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    examples = session.config.rootpath / "examples"
    begun = [
        subprocess.Popen([sys.executable, "-c", COMPILE, str(examples / f"{name}.toml")])
        for name in ("n1013", "c7010")
    ]
    if any([process.wait() for process in begun]):
        raise pytest.UsageError("The kernels do not compile.")


def pytest_terminal_summary(terminalreporter):
    """Seconds that each room's tests took, the longest first; of several processes, the sum."""
    seconds: Counter[str] = Counter()
    for reports in terminalreporter.stats.values():
        for report in reports:
            if isinstance(report, pytest.TestReport):
                seconds[Path(report.nodeid.partition("::")[0]).parent.name] += report.duration
    if len(seconds) > 1:
        terminalreporter.section("seconds by room")
        for room, taken in seconds.most_common():
            terminalreporter.write_line(f"{taken:7.1f}  {room}")
