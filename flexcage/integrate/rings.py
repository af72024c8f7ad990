"""What a run records of rings that bend."""

from __future__ import annotations

import numpy as np

from flexcage.system.bending import POINTS, RingsData
from flexcage.system.data import OUTER_RACE
from flexcage.system.problem import Bearing
from flexcage.system.swinging import deflect


def ring_records(bearing: Bearing, y: np.ndarray) -> dict[str, np.ndarray]:
    """Loads on races and their deflections (n, Z, 2, 3), axially, radially and in tilt, in states
    (n, size), and forces (n, S) of supports on the outer ring."""
    layout, rings = bearing.layout, bearing.data.model.rings
    force = layout.ring_forces(y)
    psi = layout.q(y)["elements"][..., 2]
    shape = (len(y), layout.elements, 2, 3)
    load, deflection = np.zeros(shape), np.zeros(shape)
    for side in np.flatnonzero(rings.bends):
        load[:, :, side, rings.way] = force[:, side]
        deflection[:, :, side, rings.way] = _deflections(rings, int(side), psi, force[:, side])
    if not layout.ring_modes:
        return {"ring_load": load, "ring_deflection": deflection}
    outer, press = _swung(bearing, y)
    if rings.bends[OUTER_RACE]:
        deflection[:, :, OUTER_RACE, rings.way] = outer
    found = {"ring_load": load, "ring_deflection": deflection}
    if len(bearing.data.model.swings.azimuth):
        found["support_force"] = press
    return found


def _swung(bearing: Bearing, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Deflections (n, Z, 2) of an outer race that swings, and forces (n, S) of its supports."""
    layout, model = bearing.layout, bearing.data.model
    rings, swings, count = model.rings, model.swings, len(y)
    own = rings.half_space[OUTER_RACE]
    found = np.zeros((count, layout.elements, 2))
    press = np.zeros((count, len(swings.press)))
    for k, state in enumerate(y):
        q, s = layout.q(state)["elements"], layout.ring_forces(state)
        deflect(q.ravel(), s.ravel(), layout.ring_coordinates(state)[0], rings, swings)
        x, z = s[OUTER_RACE].T
        at_once = np.stack([own[0] * x + own[1] * z, own[1] * x + own[2] * z], axis=1)
        found[k] = rings.deflection[OUTER_RACE] - at_once
        press[k] = swings.press
    return found, press


def _deflections(rings: RingsData, side: int, psi: np.ndarray, force: np.ndarray) -> np.ndarray:
    """Deflections (n, Z, 2) of a race at its ports, under forces (n, Z, 2) of elements at azimuths
    psi (n, Z)."""
    place = (psi[:, :, None] - psi[:, None]) % (2.0 * np.pi) * POINTS / (2.0 * np.pi)
    around = np.vstack([rings.table[side], rings.table[side, :1]])
    own = rings.own[side] - rings.half_space[side]
    count = psi.shape[1]
    found = np.zeros_like(force)
    for k, (a, b) in enumerate(((0, 0), (0, 1), (1, 1))):
        between = np.interp(place, np.arange(POINTS + 1), around[:, k])
        between[:, np.arange(count), np.arange(count)] = own[k]
        found[..., a] += np.einsum("nij,nj->ni", between, force[..., b])
        if a != b:
            found[..., b] += np.einsum("nij,nj->ni", between, force[..., a])
    return found
