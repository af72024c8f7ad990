"""A 7010C ball bearing of given specs with a synthetic flexible cage, for the tests of motion."""

from __future__ import annotations

from dataclasses import fields, replace

import numpy as np
from flexible_parts import shapes_at
from scipy import sparse

from flexcage.bearings.ball.bearing import BallBearing
from flexcage.bearings.ball.motion import MOTION
from flexcage.bearings.four_point import FourPointContactBearing
from flexcage.bearings.four_point.motion import MOTION as FOUR_POINT
from flexcage.bodies.floating_frame import flexible_body
from flexcage.cages.round_pocket.interface import BallCageInterface, wall_stations
from flexcage.case.presets import load_preset
from flexcage.contacts.spec import Contacts, FrictionLaw, Lubricant, NormalLaw, PairSpec
from flexcage.system.layout import Layout, bodies_of_bearing
from flexcage.system.problem import BearingSystem
from flexcage.system.spec import Drive, Load, Mount

PITCH, LAND = 32.5e-3, 24
DRY = Lubricant(rolling_resistance="none", oil_fraction=0.0)


def contacts_of(normal="elastic", friction="none"):
    """The same normal and friction law at every place."""
    pair = PairSpec(normal=NormalLaw(law=normal), friction=FrictionLaw(law=friction), slices=8)
    return Contacts(race=pair, pocket=pair)


def ball_cage(preset, *, modes=6, soft=3e-8):
    """(body, interface) of a cage of that size with smooth shapes; ``soft`` [m/N] beyond them."""
    Z, radius = preset.bearing.ball_count, 0.5 * preset.cage.pocket_diameter
    angle = 2 * np.pi * np.arange(60) / 60
    ring = [
        np.stack([np.full(60, x), PITCH * np.cos(angle), PITCH * np.sin(angle)], axis=1)
        for x in (-8e-3, 0.0, 8e-3)
    ]
    points = np.concatenate(ring)
    mass = 13.4e-3
    each = sparse.diags(np.full(len(points), mass / len(points))).tocsr()
    shapes = shapes_at(points, modes=modes)
    m = np.einsum("aik,ail->kl", shapes, shapes) * mass / len(points)
    w = 2 * np.pi * 700.0 * (1.0 + 0.7 * np.arange(modes))
    body = flexible_body(
        points, each, shapes, np.outer(w, w) * m, 0.01 * np.sqrt(np.outer(w, w)) * m
    )
    theta = wall_stations()
    phi = np.zeros((Z, len(theta), 3, modes))
    for z in range(Z):
        a = 2 * np.pi * z / Z
        frame = np.array([[1, 0, 0], [0, np.cos(a), np.sin(a)], [0, -np.sin(a), np.cos(a)]])
        local = np.stack([np.sin(theta), 0 * theta, np.cos(theta)], axis=1) * radius
        local[:, 1] = PITCH
        phi[z] = np.einsum("ij,sjm->sim", frame, shapes_at(local @ frame, modes=modes))
    local = np.full((Z, len(theta)), soft) * (1.0 + 0.3 * np.cos(2 * theta))
    interface = BallCageInterface(
        stations=theta, modes=phi, local=local, centre=np.zeros((Z, 2)),
        radius=np.full(Z, radius), slot=np.zeros((Z, 2)), land=np.zeros((2, LAND, 3, modes)),
        offset=np.zeros((Z, len(theta), 3)),
    )  # fmt: skip
    return body, interface


def ball_bearing(
    *, contacts=None, load=None, speed=0.0, mount=None, lubricant=DRY, modes=6, change=None,
    shape="cylindrical", shoulders=None, spec=None, motion=MOTION,
):  # fmt: skip
    """A ``BearingSystem`` of the preset 7010C-PI; ``change(interface)`` alters the cage's walls,
    ``shoulders`` [m] the gaps that the rings' shoulders leave the cage; ``spec`` and ``motion``: of
    another bearing of that size."""
    preset = load_preset("7010C-PI")
    cage, spec = replace(preset.cage, pocket_shape=shape), spec or preset.bearing
    if shoulders is not None:
        wall = 0.25 * (cage.outside_diameter - cage.bore)
        height = 0.5 * spec.ball_diameter - wall - shoulders
        spec = replace(spec, inner_shoulder=height, outer_shoulder=height)
    body, interface = ball_cage(preset, modes=modes)
    if change is not None:
        change(interface)
    contacts = contacts or contacts_of()
    model = motion.build_model(
        spec, cage, body, interface, contacts=contacts, lubricant=lubricant,
        drive=Drive(speed=speed), load=load or Load(gravity=0.0, tilt="free"),
        mount=mount or Mount(),
    )  # fmt: skip
    layout = Layout(preset.bearing.ball_count, bodies_of_bearing(body.modes))
    return BearingSystem(motion, spec, model, contacts, layout)


def four_point(*, clearance=-10e-6, shims=(0.15e-3, 0.2e-3)):
    """What ``ball_bearing`` takes for a four-point contact bearing of its balls and grooves."""
    own = {f.name: getattr(load_preset("7010C-PI").bearing, f.name) for f in fields(BallBearing)}
    own |= {"type": "four_point_contact", "inner_shim": shims[0], "outer_shim": shims[1]}
    return {
        "spec": FourPointContactBearing(**own, radial_clearance=clearance), "motion": FOUR_POINT,
    }  # fmt: skip


def pressed(bearing, *, seed=0, push=0.28e-3):
    """y at rest with balls pressed into races and pockets, the cage displaced, turned and bent."""
    rng = np.random.default_rng(seed)
    model, layout = bearing.data.model, bearing.layout
    y = np.zeros(layout.size)
    q = layout.q(y)
    Z = layout.elements
    gap = (
        0.5 * (model.inner.axial + model.outer.axial),
        0.5 * (model.inner.centre + model.outer.centre),
    )
    q["inner"][:3] = np.array([8e-6, 3e-6, -2e-6])
    q["inner"][3:5] = 2e-5, -1e-5
    balls = q["elements"]
    balls[:, 0] = gap[0] + 4e-6 + 3e-6 * rng.standard_normal(Z)
    balls[:, 1] = gap[1] + 3e-6 * rng.standard_normal(Z)
    balls[:, 2] = 2 * np.pi * np.arange(Z) / Z + 1e-5 * rng.standard_normal(Z)
    direction = rng.uniform(0, 2 * np.pi, Z)
    balls[:, 2] += push * np.cos(direction) / PITCH * 0.5
    q["cage"][:] = 0.2e-3, 0.15e-3, -0.1e-3
    spin = np.array([1.0, 1e-3, 2e-3, -1e-3])
    q["quaternion"][:] = spin / np.linalg.norm(spin)
    q["modes"][:] = 2e-6 * rng.standard_normal(layout.modes)
    return y
