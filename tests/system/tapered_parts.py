"""A tapered roller bearing 30205 in motion without a cage, and states of it for tests."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path

import numpy as np
from flexible_parts import shapes_at
from scipy import sparse
from scipy.spatial.transform import Rotation

from flexcage.bearings import motion_of
from flexcage.bearings.tapered_roller.recording import overlaps
from flexcage.bodies.floating_frame import flexible_body
from flexcage.cages.conical.interface import rigid_conical_interface
from flexcage.cages.conical.proposal import propose_conical_cage
from flexcage.cages.conical.walls import pocket_walls
from flexcage.case import load_case
from flexcage.modes.pockets import pocket_frames
from flexcage.stages import assembled_start, bearing_in_motion
from flexcage.system.layout import Layout, bodies_of_bearing
from flexcage.system.problem import BearingSystem

TEXT = (Path(__file__).parents[2] / "examples/30205.toml").read_text("utf-8")
PLACES = ("race", "rib", "pocket", "side")
FRICTIONLESS = {f"contacts.{place}.friction.law": "none" for place in PLACES}
ELASTIC = {f"contacts.{place}.normal.law": "elastic" for place in PLACES}
DRY = {"lubricant.rolling_resistance": "none", "lubricant.oil_fraction": 0.0}
LIGHT = {"load.gravity": 0.0}
# of one coefficient from slow sliding on
COULOMB = {
    f"contacts.{place}.friction.{key}": value
    for place in PLACES
    for key, value in {
        "law": "step_coulomb", "static": 0.05, "dynamic": 0.05, "v_static": "1e-4 m/s",
        "v_dynamic": "2e-4 m/s",
    }.items()
}  # fmt: skip
CASE = load_case(TEXT + '\n[cage]\nmodel = "none"\n')


def tapered(**changes):
    """The case with keys changed, and its bearing in motion."""
    case = CASE.replace(changes) if changes else CASE
    return case, bearing_in_motion(case, None, None)


def caged(*, modes=6, soft=True, **changes):
    """The bearing with a conical cage of usual proportions, and synthetic modes of it."""
    case = CASE.replace(changes) if changes else CASE
    cage = propose_conical_cage(case.mounted.bearing).cage
    return case, in_cage(case, cage, *soft_cage(case.mounted.bearing, cage, modes, soft))


def in_cage(case, cage, body, interface):
    """The bearing of a case, in motion in a cage."""
    spec, motion = case.mounted.bearing, motion_of(case.bearing)
    model = motion.build_model(
        spec, cage, body, interface, contacts=case.contacts, lubricant=case.lubricant,
        drive=case.drive, load=case.load, mount=case.mount,
    )  # fmt: skip
    layout = Layout(spec.total_elements, bodies_of_bearing(body.modes))
    return BearingSystem(motion, spec, model, case.contacts, layout)


def soft_cage(spec, cage, modes, soft):
    """A ring of points of the cage's size, and the interface of its pockets."""
    angle, r = 2.0 * np.pi * np.arange(60) / 60, cage.mean_radius
    points = np.concatenate([
        np.stack([np.full(60, x), r * np.cos(angle), r * np.sin(angle)], axis=1)
        for x in (-6e-3, 0.0, 5e-3)
    ])  # fmt: skip
    mass = 0.012
    each = sparse.diags(np.full(len(points), mass / len(points))).tocsr()
    shapes = shapes_at(points, modes=modes)
    m = np.einsum("aik,ail->kl", shapes, shapes) * mass / len(points)
    w = 2 * np.pi * 1500.0 * (1.0 + 0.8 * np.arange(modes))
    stiffness, damping = np.outer(w, w) * m, 2 * 0.01 * np.sqrt(np.outer(w, w)) * m
    body = flexible_body(points, each, shapes, stiffness, damping)
    return body, pocket_interface(spec, cage, modes, soft)


def pocket_interface(spec, cage, modes, soft):
    """The interface of a sound cage with the shapes of ``soft_cage`` at its stations."""
    count, walls = spec.roller_count, pocket_walls(cage)
    made = rigid_conical_interface(cage, pocket_count=count)
    at, frames = made.stations, pocket_frames(count)
    middle = np.array([0.0, 0.5 * cage.pitch_diameter, 0.0])
    phi = np.zeros((*made.modes.shape[:4], modes))
    residual, compliance = made.residual.copy(), made.compliance.copy()
    for z in range(count):
        for f in range(4):
            own = walls.middle[f] + np.multiply.outer(at[f], walls.along[f])
            places = (middle + own @ cage.axes) @ frames[z]
            phi[z, f] = np.einsum("ij,sjm->sim", frames[z], shapes_at(places, modes=modes))
    if soft:
        for f in range(4):
            x = at[f] / at[f, -1]
            residual[:, f, :, 2 * f], residual[:, f, :, 2 * f + 1] = 1.0, x
            residual[:, f, :, 8 + f] = 1.5 * x**2 - 0.5
        compliance[:] = np.diag([2e-8, 1e-8] * 4 + [6e-9] * 4)
    return replace(made, modes=phi, residual=residual, compliance=compliance,
                   land=np.zeros((*made.land.shape[:3], modes)))  # fmt: skip


def in_pockets(bearing, y, depth=3e-6, overlaps=overlaps):
    """Rollers pressed into bars before and behind them in turn, and into the ends of pockets, by
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


def begun(case, bearing):
    start = assembled_start(case, bearing)
    return start.y, start.yd


def pressed(bearing, seed=4):
    """y at rest: rollers pressed on races, rib and next ones, here and there, askew and tilted."""
    layout, spec = bearing.layout, bearing.spec
    y, rng, Z = np.zeros(layout.size), np.random.default_rng(seed), layout.elements
    q, beta, middle = layout.q(y), spec.axis_angle, spec.roller.centre
    rollers = q["elements"]
    lean = 2e-4 * rng.uniform(-1.0, 1.0, Z)
    along, across = rng.uniform(-6e-6, 1e-6, Z), rng.uniform(-4e-6, 4e-6, Z)
    rollers[:, 4] = lean - beta
    rollers[:, 3] = 3e-4 * rng.uniform(-1.0, 1.0, Z)
    rollers[:, 0] = along * np.cos(beta) + across * np.sin(beta) + middle * np.cos(rollers[:, 4])
    rollers[:, 1] = spec.pitch_radius - along * np.sin(beta) + across * np.cos(beta)
    rollers[:, 1] += middle * np.sin(rollers[:, 4])
    rollers[:, 2] = 2.0 * np.pi * np.arange(Z) / Z
    q["inner"][:5] = 12e-6, 4e-6, -3e-6, 1e-4, -2e-4
    q["outer"][:5] = -3e-6, 2e-6, 3e-6, -5e-5, 8e-5
    return y


def together(bearing, y, pairs, depth=4e-6):
    """Turn rollers of pairs towards each other until they overlap by ``depth`` [m]."""
    layout, spec = bearing.layout, bearing.spec
    q = layout.q(y)["elements"]
    eps, beta = spec.half_angle, spec.axis_angle
    touch = 2.0 * np.arcsin(np.sin(eps) / np.sin(beta))  # of the azimuths of cones that touch
    for i, j in pairs:
        middle = 0.5 * (q[i, 2] + q[j, 2] + (0.0 if j > i else 2.0 * np.pi))
        half = 0.5 * (touch - depth / spec.pitch_radius)
        q[i, 2], q[j, 2] = middle - half, middle + half - (0.0 if j > i else 2.0 * np.pi)
    return y


def energy(bearing, y):
    bearing.residual(0.0, y, np.zeros_like(y), mode=2)
    return float(bearing.data.work.report.energy[1:3].sum())


def frames(q):
    """Rows (Z, 3, 3) of the orbital frames in space, and rows of the rollers' axes in those."""
    c, s, one, zero = np.cos(q[:, 2]), np.sin(q[:, 2]), np.ones(len(q)), np.zeros(len(q))
    orbital = np.array([[one, zero, zero], [zero, c, s], [zero, -s, c]]).transpose(2, 0, 1)
    axes = Rotation.from_euler("YZ", q[:, 3:5]).as_matrix().transpose(0, 2, 1)
    return orbital, axes


def pushed(bearing, y):
    """Forces and moments about the origin on all rollers (Z, 3), on both rings (3,) and on the cage
    (3,), if there is one, in space."""
    bearing.residual(0.0, y, np.zeros_like(y), mode=2)
    work, q = bearing.data.work.scratch, bearing.layout.q(y)
    rollers, (orbital, _) = q["elements"], frames(q["elements"])
    force = np.einsum("zij,zi->zj", orbital, work.wrenches[:, :3])
    moment = np.einsum("zij,zi->zj", orbital, work.wrenches[:, 3:])
    place = rollers[:, :1] * orbital[:, 0] + rollers[:, 1:2] * orbital[:, 1]
    found = [(force, moment + np.cross(place, force))]
    border = bearing.layout.border(work.border)
    for name in ("inner", "outer"):
        f, m = border[name][:3].copy(), border[name][3:].copy()
        found.append((f, m + np.cross(q[name][:3], f)))
    if "cage" in border:
        f, m = border["cage"].copy(), work.A @ border["omega"]
        found.append((f, m + np.cross(q["cage"], f)))
    return found
