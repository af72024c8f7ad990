"""Where a run goes wrong: its hardest contact, and one that is deeper than any law holds."""

from __future__ import annotations

from typing import Any

import numpy as np

from flexcage.integrate.recording import Recording
from flexcage.system.problem import BearingSystem

# assumption: an overlap of this share of an element's radius is no contact any more. Ten static
# ratings, the largest load that a case may have, press an N1013's rollers in by less than a tenth.
DEEPEST = 0.25
AHEAD = 1e-9 * 2.0 ** np.arange(17)  # [s] after the last good point, where a fault is looked for


def runaway(
    bearing: BearingSystem, recording: Recording[Any], y: np.ndarray
) -> tuple[int, str, str] | None:
    """The first of the states ``y`` (n, size) in which a contact is too deep, which it is, and what
    to look at."""
    model = bearing.data.model
    share = recording.overlaps(model, bearing.layout, y) / model.bodies.radius[:, None]
    bad = np.flatnonzero((share > DEEPEST).any(axis=(1, 2)))
    if not len(bad):
        return None
    first = int(bad[0])
    number, place = np.unravel_index(int(np.argmax(share[first])), share.shape[1:])
    depth = share[first, number, place] * model.bodies.radius[number] * 1e3
    element = f"{bearing.spec.element} {number}"
    if place >= bearing.data.work.report.contact.shape[1]:
        what = f"the cage came off, {element} is {depth:.2g} mm outside its pocket"
        return first, what, recording.remedy(model)
    what = f"{element} lies {depth:.2g} mm deep in its {_place(bearing, int(place))}"
    return first, f"a contact ran away: {what}", "look at loads and contact stiffness"


def first_undefined(bearing: BearingSystem, t: float, y: np.ndarray, yd: np.ndarray) -> str:
    """The contact whose force is the first that is no finite number if the motion goes on as at
    (t, y); the hardest one if none is."""
    for ahead in AHEAD:
        if not np.isfinite(_forces(bearing, t + ahead, y + ahead * yd, yd)).all():
            return hardest(bearing, t + ahead, y + ahead * yd, yd)
    return hardest(bearing, t, y, yd)


def hardest(bearing: BearingSystem, t: float, y: np.ndarray, yd: np.ndarray) -> str:
    """The contact of an element with the largest normal force, or one that is not a number."""
    force = _forces(bearing, t, y, yd)
    rank = np.where(np.isnan(force), np.inf, force)
    number, place = np.unravel_index(int(np.argmax(rank)), rank.shape)
    where = f"{bearing.spec.element} {number} on its {_place(bearing, int(place))}"
    return f"{where} with {force[number, place]:.3g} N"


def _forces(bearing: BearingSystem, t: float, y: np.ndarray, yd: np.ndarray) -> np.ndarray:
    """Normal forces (Z, places) [N] on every element."""
    bearing.residual(t, y, yd, mode=2)
    report = bearing.data.work.report
    return np.concatenate([report.race[:, :, 0], report.pocket_normal, report.rib], axis=1)


def _place(bearing: BearingSystem, index: int) -> str:
    name, faces = bearing.places[index], bearing.motion.faces
    return f"pocket's face {name}" if name in faces and len(faces) > 1 else name
