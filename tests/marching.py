"""Runs of bearings from states that no case can ask for."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from flexcage.bearings import recording_of
from flexcage.case import Case
from flexcage.integrate.integration import Integration, integration_of
from flexcage.integrate.recorded import new_store
from flexcage.system.begun import Start
from flexcage.system.problem import BearingSystem


def march(
    case: Case,
    bearing: BearingSystem,
    y: np.ndarray,
    yd: np.ndarray,
    *,
    also: Callable[[Integration], Any] | None = None,
) -> Any:
    """Integrate a bearing from a chosen state for the case's duration; its dataset (xarray).

    ``also(integration)`` is called before the first step.
    """
    start = Start(y, yd, (), 0.0, 0.0, np.zeros_like(bearing.data.work.report.station))
    recording = recording_of(case.bearing)
    store = new_store(
        None, bearing, recording, duration=case.solver.duration, output=case.output, attrs={}
    )
    integration = integration_of(
        bearing, recording, start, store, solver=case.solver, output=case.output
    )
    if also is not None:
        also(integration)
    integration.march()
    return store.dataset()
