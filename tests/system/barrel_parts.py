"""A spherical roller bearing 22208 in motion, with a cage and without one, and states of it for
tests."""

from __future__ import annotations

from dataclasses import replace
from functools import partial
from pathlib import Path

import numpy as np
from flexible_parts import shapes_at
from scipy.spatial.transform import Rotation
from tapered_parts import frames, in_cage, soft_cage
from tapered_parts import in_pockets as in_one_row
from tapered_parts import pocket_interface as one_row

from flexcage.bearings.spherical_roller.recording import overlaps
from flexcage.bearings.spherical_roller.start import barrels_in_space, in_frames
from flexcage.cages.barrel.proposal import propose_barrel_cage
from flexcage.cages.conical.walls import pocket_walls
from flexcage.case import load_case
from flexcage.modes.pockets import frames_at
from flexcage.stages import bearing_in_motion

TEXT = (Path(__file__).parents[2] / "examples/22208.toml").read_text("utf-8")
LEVEL = {"load.misalignment": 0.0}
CASE = load_case(TEXT + '\n[cage]\nmodel = "none"\n').replace(LEVEL)


def barrels(**changes):
    """The case with keys changed, and its bearing in motion."""
    case = CASE.replace(changes) if changes else CASE
    return case, bearing_in_motion(case, None, None)


def settled(bearing, seed=4):
    """y at rest: barrels pressed on both races, here and there, askew and tilted."""
    layout, spec = bearing.layout, bearing.spec
    y, rng, Z = np.zeros(layout.size), np.random.default_rng(seed), layout.elements
    own = rng.uniform(-1.0, 1.0, (Z, 3)) * (6e-6, 4e-6, 1e-6) + (0.0, 7e-6, 0.0)
    q, near = layout.q(y), spec.element_azimuths
    q["elements"][:, :5] = in_frames(*barrels_in_space(spec, own), near)
    q["elements"][:, 3] = 1e-3 * rng.uniform(-1.0, 1.0, Z)
    q["inner"][:5] = 4e-6, 24e-6, -5e-6, 1e-4, -2e-4
    q["outer"][:5] = -3e-6, 2e-6, 3e-6, -5e-5, 8e-5
    return y


def together(bearing, y, pairs, depth=4e-6):
    """Turn barrels of pairs towards each other until they overlap by about ``depth`` [m]."""
    q, radius = bearing.layout.q(y)["elements"], 0.5 * bearing.spec.roller_diameter
    for i, j in pairs:
        whole = 0.0 if j > i else 2.0 * np.pi
        middle = 0.5 * (q[i, 2] + q[j, 2] + whole)
        half = np.arcsin((radius - 0.5 * depth) / bearing.spec.pitch_radius)
        q[i, 2], q[j, 2] = middle - half, middle + half - whole
    return y


def turned_about_the_middle(bearing, y, turn):
    """y with barrels and inner ring turned about the middle of the outer ring."""
    layout, found = bearing.layout, y.copy()
    q, at = layout.q(y), layout.q(found)
    orbital, axes = frames(q["elements"])
    rollers, middle = q["elements"], q["outer"][:3]
    place = rollers[:, :1] * orbital[:, 0] + rollers[:, 1:2] * orbital[:, 1] - middle
    axis = np.einsum("zi,zij->zj", axes[:, 0], orbital)
    moved = turn.apply(place) + middle, turn.apply(axis)
    at["elements"][:, :5] = in_frames(*moved, rollers[:, 2])
    at["inner"][:3] = turn.apply(q["inner"][:3] - middle) + middle
    skew, tilt = (turn * Rotation.from_euler("YZ", q["inner"][3:5])).as_euler("YZX")[:2]
    at["inner"][3:5] = skew, tilt
    return found


def caged(*, modes=6, soft=True, **changes):
    """The bearing with a cage of usual proportions, and synthetic modes of it."""
    case = CASE.replace(changes) if changes else CASE
    spec = case.mounted.bearing
    cage = propose_barrel_cage(spec).cage
    body, _ = soft_cage(spec, cage, modes, soft)
    return case, in_cage(case, cage, body, pocket_interface(spec, cage, modes, soft))


def pocket_interface(spec, cage, modes, soft):
    """The interface of both rows' pockets with the shapes of ``soft_cage`` at their stations."""
    halves = []
    for row in spec.row_places:
        made = one_row(spec, cage, modes, soft)
        at, walls = made.stations, pocket_walls(cage)
        turned = frames_at(
            row.turned + 2.0 * np.pi * np.arange(spec.roller_count) / spec.roller_count
        )
        middle = np.array([row.place, 0.5 * cage.pitch_diameter, 0.0])
        for z, frame in enumerate(turned):
            for f in range(4):
                own = walls.middle[f] + np.multiply.outer(at[f], walls.along[f])
                places = (middle + (own @ cage.axes) * (row.sense, 1.0, 1.0)) @ frame
                shape = shapes_at(places, modes=modes)
                made.modes[z, f] = np.einsum("ij,sjm->sim", frame, shape)
        halves.append(made)
    names = ("offset", "modes", "residual", "compliance")
    both = {n: np.concatenate([getattr(h, n) for h in halves]) for n in names}
    return replace(halves[0], **both)


in_pockets = partial(in_one_row, overlaps=overlaps)
