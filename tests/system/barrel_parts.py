"""A spherical roller bearing 22208 in motion, with a cage and without one, and states of it for
tests."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from flexible_parts import shapes_at
from scipy.spatial.transform import Rotation
from tapered_parts import frames, soft_cage
from tapered_parts import pocket_interface as one_row

from flexcage.bearings import motion_of
from flexcage.bearings.spherical_roller.recording import overlaps
from flexcage.bearings.spherical_roller.start import barrels_in_space, in_frames
from flexcage.cages.barrel.proposal import propose_barrel_cage
from flexcage.cages.conical.walls import pocket_walls
from flexcage.case import load_case
from flexcage.modes.pockets import frames_at
from flexcage.stages import bearing_in_motion
from flexcage.system.layout import Layout, bodies_of_bearing
from flexcage.system.problem import BearingSystem

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
    spec, motion = case.mounted.bearing, motion_of(case.bearing)
    cage = propose_barrel_cage(spec).cage
    body, _ = soft_cage(spec, cage, modes, soft)
    model = motion.build_model(
        spec, cage, body, pocket_interface(spec, cage, modes, soft), contacts=case.contacts,
        lubricant=case.lubricant, drive=case.drive, load=case.load, mount=case.mount,
    )  # fmt: skip
    layout = Layout(spec.total_elements, bodies_of_bearing(modes))
    return case, BearingSystem(motion, spec, model, case.contacts, layout)


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


def in_pockets(bearing, y, depth=3e-6):
    """Barrels pressed into bars before and behind them in turn, and into the ends of pockets, by
    about ``depth`` [m]; the cage is off the middle, askew and strained."""
    layout, model = bearing.layout, bearing.data.model
    q, rng = layout.q(y), np.random.default_rng(11)
    q["cage"][:] = (
        (2.0 * depth + model.pocket.half[1] - model.pocket.half_roller)
        / np.cos(bearing.spec.axis_angle),
        4e-6,
        -3e-6,
    )
    q["quaternion"][:] = Rotation.from_rotvec([2e-4, 1e-4, -1e-4]).as_quat(scalar_first=True)
    q["modes"][:] = 4e-7 * rng.standard_normal(layout.modes)
    for _ in range(3):
        found = overlaps(model, layout, y[None])[0]
        for i in range(layout.elements):
            f = i % 2
            across = model.frames.axes[f, 2, 2] * q["elements"][i, 1]
            q["elements"][i, 2] += (1.0, -1.0)[f] * (depth - found[i, 2 + f]) / across
    return y
