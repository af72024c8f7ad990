"""What a run records of rings that bend."""

from __future__ import annotations

import numpy as np

from flexcage.system.problem import BearingSystem
from flexcage.system.rings.modes import deflect
from flexcage.system.rings.modes_data import RingModes
from flexcage.system.rings.moving import SIDES
from flexcage.system.rings.races import POINTS, RacesData


def ring_records(bearing: BearingSystem, y: np.ndarray) -> dict[str, np.ndarray]:
    """Loads on races and their deflections (n, Z, 2, 3), axially, radially and in tilt, in states
    (n, size), and forces (n, S) of supports on the outer ring."""
    layout, rings = bearing.layout, bearing.data.model.rings
    force = layout.ring_forces(y)
    psi = layout.q(y)["elements"][..., 2]
    shape = (len(y), layout.elements, 2, 3)
    load, deflection = np.zeros(shape), np.zeros(shape)
    for side in np.flatnonzero(rings.bends).tolist():
        load[:, :, side, rings.way] = force[:, side]
        deflection[:, :, side, rings.way] = _deflections(rings, side, psi, force[:, side])
    found = {"ring_load": load, "ring_deflection": deflection}
    for side, modes in enumerate((bearing.data.model.inner_modes, bearing.data.model.outer_modes)):
        if not len(modes.push):
            continue
        moved, press = _by_modes(bearing, side, modes, y)
        if rings.bends[side]:
            deflection[:, :, side, rings.way] = moved
        if len(modes.azimuth):
            found["support_force"] = press
    return found


def _by_modes(
    bearing: BearingSystem, side: int, modes: RingModes, y: np.ndarray
) -> tuple[np.ndarray, np.ndarray]:
    """Deflections (n, Z, 2) of the race of a ring with modes, and forces (n, S) of its supports."""
    layout, races = bearing.layout, bearing.data.model.rings
    own = races.half_space[side]
    found = np.zeros((len(y), layout.elements, 2))
    press = np.zeros((len(y), len(modes.press)))
    for k, state in enumerate(y):
        q, s = layout.q(state), layout.ring_forces(state)
        ring, a = q[SIDES[side]], q[f"{SIDES[side]}_modes"]
        deflect(side, q["elements"].ravel(), s.ravel(), ring, a, races, modes)
        x, z = s[side].T
        at_once = np.stack([own[0] * x + own[1] * z, own[1] * x + own[2] * z], axis=1)
        found[k] = races.deflection[side] - at_once
        press[k] = modes.press
    return found, press


def _deflections(rings: RacesData, side: int, psi: np.ndarray, force: np.ndarray) -> np.ndarray:
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
