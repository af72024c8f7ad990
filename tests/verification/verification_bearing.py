"""The N1013 of this folder: the chapter's, with defects, states and measures of these tests."""

from __future__ import annotations

import logging

import numpy as np
from marching import march
from n1013_states import bearing_of, cage_of, state_at_rest
from scipy.interpolate import CubicHermiteSpline

from flexcage.system.layout import Layout
from flexcage.verification.runs import FRICTIONLESS, NO_OIL, n1013

__all__ = [
    "FRICTIONLESS",
    "NO_OIL",
    "bearing_of",
    "bent",
    "cage_of",
    "log",
    "march",
    "n1013",
    "pushed",
    "relative_error",
    "state_at_rest",
    "station_reading",
    "with_modes",
]

log = logging.getLogger("verification")


def bent(displacement: str, *, crossbeam: int = 5, shape: str = "bent") -> list[dict]:
    """One displaced crossbeam (delta_q), as a case's text has it."""
    return [
        {
            "type": "crossbeam",
            "crossbeam": crossbeam,
            "displacement": displacement,
            "shape": shape,
        }
    ]


def station_reading(stations: np.ndarray, along: np.ndarray) -> np.ndarray:
    """What points along a face read of its stations (points, stations): cubics through them with
    the slopes of their neighbours, straight on beyond the outer ones."""
    unit = np.eye(len(stations))
    curve = CubicHermiteSpline(stations, unit, np.gradient(unit, stations, axis=0))
    inside = np.clip(along, stations[0], stations[-1])
    return curve(inside) + (along - inside)[:, None] * curve(inside, 1)


def pushed(displacement: str, *, pocket: int = 5, side: str = "+x") -> list[dict]:
    """One displaced side beam (delta_p)."""
    return [{"type": "side_beam", "pocket": pocket, "side": side, "displacement": displacement}]


def relative_error(ours: np.ndarray, theirs: np.ndarray) -> float:
    """Root of summed squared differences over that of the reference."""
    return float(np.sqrt(np.sum((ours - theirs) ** 2) / np.sum(theirs**2)))


def with_modes(small: Layout, large: Layout, y: np.ndarray) -> np.ndarray:
    """A rigid state in the layout of a flexible one, modes at rest."""
    out = np.zeros(large.size)
    for view in ("q", "u"):
        for name, values in getattr(large, view)(out).items():
            if name != "modes":
                values[:] = getattr(small, view)(y)[name]
    out[large.n_q + large.n_u :] = y[small.n_q + small.n_u :]
    return out
