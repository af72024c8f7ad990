"""Rings that bend at an instant of a run, as the static solution has them: for stress, pictures."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from flexcage.results.metrics import settled
from flexcage.static import draw_ring
from flexcage.stress.series import samples_near
from flexcage.system.rings.moving import SIDES
from flexcage.system.statics.rings import BentRing, SeatedRing

if TYPE_CHECKING:
    from flexcage.case import Case
    from flexcage.run.record import RunRecord


def rings_at(run: RunRecord, time: float | str | None) -> tuple[float, tuple[BentRing, ...]]:
    """Time [s] of the sample nearest to ``time``, by default that of the largest deflection of the
    settled part, and the rings then."""
    seated, ds = run.seated_rings, run.dataset
    t = ds["time"].values
    deflection = np.abs(ds["ring_deflection"].values[..., :2]).max(axis=(1, 2, 3))
    if time is None:
        first = settled(ds, run.case.output.settle)["time"].values[0]
        k = int(np.argmax(np.where(t >= first, deflection, -1.0)))
    else:
        k = int(samples_near(t, [time])[0])
    azimuth = ds["element_position"].values[k, :, 2]
    load, moved = ds["ring_load"].values[k], ds["ring_deflection"].values[k]
    found = []
    for ring in seated:
        side = SIDES.index(ring.side)
        placed = replace(ring, azimuth=azimuth)
        force = load[:, side] @ ring.to_v
        pressed = ds["support_force"].values[k] if len(ring.support) else np.empty(0)
        found.append(BentRing(placed, force, moved[:, side], pressed, _bears(ring, pressed)))
    return float(t[k]), tuple(found)


def _bears(ring: SeatedRing, pressed: np.ndarray) -> np.ndarray:
    """Supports (S,) that say where the ring as a whole lies: those that press, or all if these
    leave it free to move, as it may be for a moment."""
    bears = pressed != 0.0
    held = np.stack([np.cos(ring.support[bears]), np.sin(ring.support[bears])])
    return bears if np.linalg.matrix_rank(held, tol=1e-6) == 2 else np.ones_like(bears)


def ring_pictures(case: Case) -> list[str]:
    """Names of the pictures of a case's rings that bend."""
    bends = (("inner", case.inner_ring), ("outer", case.outer_ring))
    return [f"{side}_ring" for side, ring in bends if ring.bends]


def draw_rings(run: RunRecord, folder: Path, names: Sequence[str]) -> list[Path]:
    """Pictures of these names of the rings that bend, when they yield most."""
    time, rings = rings_at(run, None)
    when, case = f"at {1e3 * time:.2f} ms", run.case.name
    drawn = [ring for ring in rings if f"{ring.side}_ring" in names]
    return [
        draw_ring(ring, folder / f"{ring.side}_ring.png", when=when, name=case) for ring in drawn
    ]
