"""Where a run goes wrong: its hardest contact, and one that is deeper than any law holds."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from flexcage.modes.basis import FACES
from flexcage.system.problem import Bearing

# places of contacts, in order; a land is the cage's and names no roller
PLACES = ("inner race", "outer race", *FACES, "rib +x", "rib -x", "land -x", "land +x")
# assumption: an overlap of this share of a roller's radius is no contact any more. Ten static
# ratings, the largest load that a case may have, press an N1013's rollers in by less than a tenth.
DEEPEST = 0.25


def overlaps(bearing: Bearing, y: np.ndarray) -> np.ndarray:
    """Depths (n, Z, 4) [m] of rollers in the inner and outer race and in the front and rear wall
    of their pockets, negative when apart, in states ``y`` (n, size).

    Bodies are as they were made, without waves and deflection; a wall lies where it is widest.
    """
    model, q = bearing.data.model, bearing.layout.q(y)
    radius, (cos, sin) = model.bodies.radius, model.pocket.azimuth.T
    r, psi = q["rollers"][..., 1], q["rollers"][..., 2]
    at = np.stack([r * np.cos(psi), r * np.sin(psi)], axis=-1)
    from_inner, from_outer = (
        np.linalg.norm(at - centre[:, None], axis=-1) for centre in (q["inner"][:, 1:3], q["outer"])
    )
    frames = Rotation.from_quat(q["quaternion"], scalar_first=True).as_matrix()
    seen = np.einsum("nzc,ncd->nzd", at - q["cage"][:, None, 1:], frames[:, 1:, 1:])
    ahead = seen[..., 1] * cos - seen[..., 0] * sin
    wall = model.pocket.half[0] + np.maximum(model.pocket.offset[:, :2].max(axis=2), 0.0)
    return np.stack(
        [
            model.inner.radius + radius - from_inner,
            from_outer + radius - model.outer.radius,
            ahead + radius - wall[:, 0],
            -ahead + radius - wall[:, 1],
        ],
        axis=-1,
    )


def runaway(bearing: Bearing, y: np.ndarray) -> tuple[int, str] | None:
    """The first of the states ``y`` (n, size) in which a contact is too deep, and which it is."""
    share = overlaps(bearing, y) / bearing.data.model.bodies.radius[:, None]
    bad = np.flatnonzero((share > DEEPEST).any(axis=(1, 2)))
    if not len(bad):
        return None
    first = int(bad[0])
    roller, place = np.unravel_index(int(np.argmax(share[first])), share.shape[1:])
    depth = share[first, roller, place] * bearing.data.model.bodies.radius[roller]
    return first, f"roller {roller} lies {depth * 1e3:.2g} mm deep in its {_place(int(place))}"


def hardest(bearing: Bearing, t: float, y: np.ndarray, yd: np.ndarray) -> str:
    """The contact of a roller with the largest normal force, or one that is not a number."""
    bearing.residual(t, y, yd, mode=2)
    report = bearing.data.work.report
    force = np.concatenate([report.race[:, :, 0], report.pocket_normal, report.rib], axis=1)
    rank = np.where(np.isnan(force), np.inf, force)
    roller, place = np.unravel_index(int(np.argmax(rank)), rank.shape)
    return f"roller {roller} on its {_place(int(place))} with {force[roller, place]:.3g} N"


def _place(index: int) -> str:
    return f"pocket's face {PLACES[index]}" if PLACES[index] in FACES else PLACES[index]
