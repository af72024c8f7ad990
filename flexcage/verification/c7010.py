"""The 7010C of the chapter in motion: cases with a rigid cage, and runs from chosen states."""

from __future__ import annotations

from collections.abc import Mapping
from functools import cache
from math import pi
from typing import Any

import numpy as np

from flexcage.bearings import recording_of
from flexcage.case import Case, load_case
from flexcage.compiling import build_bearing
from flexcage.integrate.integration import Integration
from flexcage.integrate.recorded import new_store
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.stages import cage_mesh
from flexcage.system.begun import Start
from flexcage.system.problem import Bearing

RPM = pi / 30.0
BASE = {
    "bearing": {"preset": "7010C-PI"},
    "cage": {"model": "rigid"},
    "mesh": {"fineness": "coarse"},
    "load": {"axial": "100 N", "gravity": "0 m/s^2"},
    "output": {"rate": "50 kHz", "vibration_rate": "50 kHz"},
}
SMOOTH = {f"contacts.{place}.friction.law": "none" for place in ("race", "pocket", "land")}
ELASTIC = {f"contacts.{place}.normal.law": "elastic" for place in ("race", "pocket", "land")}
NO_OIL = {"lubricant.rolling_resistance": "none", "lubricant.oil_fraction": 0.0}


def c7010(*tables: Mapping[str, object]) -> Case:
    """The preset with a rigid cage; ``tables`` map dotted paths to text, later ones win."""
    return load_case(BASE, overrides={k: v for t in tables for k, v in t.items()})


@cache
def _mesh(pocket: float) -> CageMesh:
    return cage_mesh(c7010().replace("cage.pocket_diameter", pocket))


def bearing_of(case: Case) -> Bearing:
    """The case's bearing, ready to be integrated."""
    return build_bearing(case, _mesh(2.0 * case.its_cage.pocket_reach), None)


def balls_on_outer(bearing: Bearing) -> tuple[np.ndarray, np.ndarray]:
    """y and y' at rest: balls just touch the outer groove's bottom, in the middle of their pockets;
    the inner groove is opposite, clear of them by half of the radial clearance."""
    model, layout = bearing.data.model, bearing.layout
    y = np.zeros(layout.size)
    q = layout.q(y)
    q["elements"][:, 0] = q["cage"][0] = model.outer.axial
    q["elements"][:, 1] = model.outer.centre + model.outer.radius - model.bodies.radius
    q["elements"][:, 2] = 2.0 * pi * np.arange(layout.elements) / layout.elements
    q["inner"][0] = model.outer.axial - model.inner.axial
    q["quaternion"][0] = 1.0
    return y, np.zeros_like(y)


def march(case: Case, bearing: Bearing, y: np.ndarray, yd: np.ndarray) -> Any:
    """Integrate a bearing from a chosen state for the case's duration; its dataset (xarray)."""
    start = Start(y, yd, (), 0.0, 0.0, np.zeros_like(bearing.data.work.report.station))
    recording = recording_of(case.bearing)
    store = new_store(
        None, bearing, recording, duration=case.solver.duration, output=case.output, attrs={}
    )
    Integration(bearing, recording, start, store, solver=case.solver, output=case.output).march()
    return store.dataset()
