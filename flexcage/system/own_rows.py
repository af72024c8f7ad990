"""A constraint's rows on trial: parameters that they were not given, slopes that are not those of
what they hold. A body that G leaves out would bear nothing of the constraint's force.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.probing import check_reading, zero_padded
from flexcage.system.layout import Places

_STEP = 1e-4  # of a velocity, or of 1 m/s and 1 rad/s, over which a difference is taken
_OFF = 1e-3  # of a row's largest slope, by which one may be off


def check_rows(kind: Any, name: str, given: np.ndarray, at: Places, y: np.ndarray) -> None:
    """Raise InputError for rows of a kind that read beyond the parameters ``given``, or whose G is
    not dh/du at y."""
    m = len(kind.labels)

    def rows(p: np.ndarray, state: np.ndarray) -> tuple[np.ndarray, ...]:
        G, g, h = np.zeros((m, at.border)), np.zeros(m), np.zeros(m)
        kind.rows(0.0, state, at, p, G, g, h)
        return G, g, h

    check_reading(f"Constraint '{name}'", lambda p: rows(p, y), given, where=name)
    p = zero_padded(given)
    G, differences = rows(p, y)[0], np.zeros((m, at.border))
    for k in range(at.border):
        step = _STEP * max(abs(y[at.bodies_u + k]), 1.0)
        moved = np.zeros(len(y))
        moved[at.bodies_u + k] = step
        differences[:, k] = (rows(p, y + moved)[2] - rows(p, y - moved)[2]) / (2.0 * step)
    most = np.abs(differences).max(axis=1, keepdims=True)
    off = np.abs(G - differences)
    if not np.isfinite(off).all() or (off <= _OFF * most).all():
        return  # what is no number is told of later
    row, column = np.unravel_index(np.argmax(off / np.maximum(most, 1e-300)), off.shape)
    body = max((b for b in ("inner", "outer", "cage") if getattr(at, f"{b}_b") <= column),
               key=lambda b: getattr(at, f"{b}_b"))  # fmt: skip
    raise InputError(
        f"Constraint '{name}' gives G[{row}, at.{body}_b + {column - getattr(at, f'{body}_b')}] = "
        f"{G[row, column]:.4g}, but differences of h[{row}] in that velocity give "
        f"{differences[row, column]:.4g}; G is dh/du, of every body that h reads.",
        where=name,
        value=float(G[row, column]),
    )
