"""A tapered roller bearing 30205 in motion without a cage, and states of it for tests."""

from __future__ import annotations

from pathlib import Path

import numpy as np
from scipy.spatial.transform import Rotation

from flexcage.case import load_case
from flexcage.stages import assembled_start, bearing_in_motion

TEXT = (Path(__file__).parents[2] / "examples/30205.toml").read_text("utf-8")
PLACES = ("race", "rib")
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
    return float(bearing.data.work.report.energy[2])


def frames(q):
    """Rows (Z, 3, 3) of the orbital frames in space, and rows of the rollers' axes in those."""
    c, s, one, zero = np.cos(q[:, 2]), np.sin(q[:, 2]), np.ones(len(q)), np.zeros(len(q))
    orbital = np.array([[one, zero, zero], [zero, c, s], [zero, -s, c]]).transpose(2, 0, 1)
    axes = Rotation.from_euler("YZ", q[:, 3:5]).as_matrix().transpose(0, 2, 1)
    return orbital, axes


def pushed(bearing, y):
    """Forces and moments about the origin on all rollers (Z, 3) and both rings (3,), in space."""
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
    return found
