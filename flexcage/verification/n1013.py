"""The N1013 of the chapter: cases on the coarse mesh, their stages, and runs from chosen states."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any

import numpy as np

from flexcage.bearings import recording_of
from flexcage.case import Case, load_case
from flexcage.compiling import build_bearing
from flexcage.integrate.integration import Integration
from flexcage.integrate.recorded import new_store
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.reduction import CageReduction
from flexcage.modes.spec import ModesSpec
from flexcage.stages import cage_mesh, cage_reduction
from flexcage.system.begun import Start
from flexcage.system.problem import Bearing

BASE = {
    "bearing": {"preset": "N1013"},
    "mesh": {"fineness": "coarse"},
    "load": {"radial": "1000 N"},
}
FRICTIONLESS = {
    f"contacts.{place}.friction.law": "none" for place in ("race", "pocket", "side", "rib", "land")
}
NO_OIL = {"lubricant.rolling_resistance": "none", "lubricant.oil_fraction": 0.0}
LOSSLESS = {
    **FRICTIONLESS,
    **NO_OIL,
    **{f"contacts.{p}.normal.law": "elastic" for p in ("race", "pocket", "side", "rib", "land")},
    "modes.damping": 0.0,
    "load.gravity": "0 m/s^2",
}


def n1013(*tables: Mapping[str, object], **sections: object) -> Case:
    """The preset with a sound cage; ``tables`` map dotted paths to text, later ones win."""
    return load_case({**BASE, **sections}, overrides={k: v for t in tables for k, v in t.items()})


def cage_of(case: Case) -> tuple[CageMesh, CageReduction]:
    """Mesh and flexible reduction of a case's cage, made once for all cases with that cage."""
    plain = _plain(case, case.modes)
    return _mesh(_plain(case)), _reduction(plain)


def bearing_of(case: Case) -> Bearing:
    """The case's bearing, ready to be integrated."""
    flexible = case.cage_model == "flexible"
    return build_bearing(case, _mesh(_plain(case)), cage_of(case)[1] if flexible else None)


def _plain(case: Case, modes: ModesSpec | None = None) -> Case:
    """A case with the same cage, and nothing else that differs from the preset."""
    return Case(
        bearing=case.bearing, cage=case.cage, defects=case.all_defects, mesh=case.mesh,
        modes=modes or ModesSpec(), contacts=n1013().contacts,
    )  # fmt: skip


@cache
def _mesh(plain: Case) -> CageMesh:
    return cage_mesh(plain)


@cache
def _reduction(plain: Case) -> CageReduction:
    reduction = cage_reduction(plain, _mesh(plain.replace("modes", ModesSpec())))
    assert reduction is not None
    return reduction


def state_at_rest(bearing: Bearing) -> tuple[np.ndarray, np.ndarray]:
    """y and y' with every roller in the middle of its pocket and of the races, nothing moving."""
    model, layout = bearing.data.model, bearing.layout
    y = np.zeros(layout.size)
    q = layout.q(y)
    q["elements"][:, 1] = 0.5 * (model.inner.radius + model.outer.radius)
    q["elements"][:, 2] = 2.0 * np.pi * np.arange(layout.elements) / layout.elements
    q["quaternion"][0] = 1.0
    return y, np.zeros_like(y)


def throw_cage(
    bearing: Bearing, y: np.ndarray, yd: np.ndarray, speed: float, direction: float
) -> None:
    """Give the cage a speed [m/s] across the axis, at an azimuth [rad]."""
    for part in (bearing.layout.u(y)["cage"], bearing.layout.q(yd)["cage"]):
        part[1:] = speed * np.cos(direction), speed * np.sin(direction)


def march(
    case: Case,
    bearing: Bearing,
    y: np.ndarray,
    yd: np.ndarray,
    *,
    also: Callable[[Integration], Any] | None = None,
) -> Any:
    """Integrate a bearing from a chosen state for the case's duration; its dataset (xarray).

    ``also(integration)`` is called before the first step.
    """
    Z, stations = bearing.layout.elements, bearing.data.model.pocket.phi.shape[2]
    start = Start(y, yd, (), 0.0, 0.0, np.zeros((Z, 4, stations, 3)))
    recording = recording_of(case.bearing)
    store = new_store(
        None, bearing, recording, duration=case.solver.duration, output=case.output, attrs={}
    )
    integration = Integration(
        bearing, recording, start, store, solver=case.solver, output=case.output
    )
    if also is not None:
        also(integration)
    integration.march()
    return store.dataset()
