"""Forces of a ball bearing: slopes of one energy, in balance, and the same from any side."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from ball_parts import LAND, PITCH, ball_bearing, contacts_of, pressed
from flexible_parts import shapes_at
from scipy.spatial.transform import Rotation

from flexcage.contacts.spec import FrictionLaw, LandSpec, Lubricant, NormalLaw
from flexcage.system.spec import Mount


def energy(bearing, y):
    bearing.residual(0.0, y, np.zeros_like(y), mode=2)
    return float(bearing.data.work.report.energy[1:].sum())


def slots(interface):
    """Pockets that are no circles any more: slots, shifted, wider."""
    interface.slot[::3, 1] = 20e-6
    interface.slot[1::3, 0] = 15e-6
    interface.centre[::2] = 10e-6, -8e-6
    interface.radius[::4] += 5e-6


def bent_lands(interface):
    """A bore and an outside that the modes bend."""
    angle = 2.0 * np.pi * np.arange(LAND) / LAND
    c, s, zero, one = np.cos(angle), np.sin(angle), 0.0 * angle, 1.0 + 0.0 * angle
    frames = np.array([[one, zero, zero], [zero, c, s], [zero, -s, c]])
    points = PITCH * np.stack([zero, c, s], axis=1)
    shapes = shapes_at(points, modes=interface.modes.shape[-1])
    interface.land[:] = np.einsum("ijs,sjm->sim", frames, shapes)


@pytest.mark.parametrize(
    ("change", "shape", "shoulders"),
    [
        (None, "cylindrical", None), (slots, "cylindrical", None), (None, "spherical", None),
        (slots, "spherical", None), (bent_lands, "spherical", 0.17e-3),
    ],
)  # fmt: skip
def test_forces_are_the_slopes_of_the_energy(change, shape, shoulders):
    """Of balls, ring (tilts too), cage (turned about each axis) and every mode; also of a cage that
    is pressed on the shoulders of both rings."""
    law = LandSpec(normal=NormalLaw(law="elastic"), friction=FrictionLaw(law="none"))
    contacts = replace(contacts_of(), land=law)
    bearing = ball_bearing(change=change, shape=shape, shoulders=shoulders, contacts=contacts)
    layout, y = bearing.layout, pressed(bearing)
    force = -bearing.residual(0.0, y, np.zeros_like(y))
    touching = bearing.data.work.report
    rows = layout.u(force)

    def slope(move, h):
        high, low = y.copy(), y.copy()
        move(layout.q(high), h)
        move(layout.q(low), -h)
        return -(energy(bearing, high) - energy(bearing, low)) / (2.0 * h)

    def turn(axis):
        def move(q, h):
            now = Rotation.from_quat(q["quaternion"], scalar_first=True)
            step = Rotation.from_rotvec(h * np.eye(3)[axis])
            q["quaternion"][:] = (now * step).as_quat(scalar_first=True)

        return move

    def shift(name, *index):
        def move(q, h):
            q[name][index] += h

        return move

    found, expected = [], []
    for i in range(layout.elements):
        r = layout.q(y)["elements"][i, 1]
        found += list(rows["elements"][i, :3] * (1.0, 1.0, r))
        expected += [slope(shift("elements", i, c), (1e-9, 1e-9, 1e-9 / r)[c]) for c in range(3)]
    found += [*rows["inner"][:3], *rows["cage"], *rows["modes"]]
    expected += [slope(shift("inner", c), 1e-9) for c in range(3)]
    expected += [slope(shift("cage", c), 1e-9) for c in range(3)]
    expected += [slope(shift("modes", m), 1e-9) for m in range(layout.modes)]
    scale = np.abs(expected).max()
    np.testing.assert_allclose(found, expected, atol=2e-6 * scale)
    moments = [*rows["inner"][4:6], *rows["omega"]]
    levers = [slope(shift("inner", c), 3e-8) for c in (3, 4)] + [
        slope(turn(a), 3e-8) for a in range(3)
    ]
    np.testing.assert_allclose(moments, levers, atol=2e-6 * np.abs(levers).max())
    energy(bearing, y)
    assert (touching.pocket_normal > 1.0).sum() > 5 and (touching.race[:, :, 0] > 1.0).sum() > 20
    pressed_on = touching.land_touch[:, 0] > 1.0  # at -x and +x of the inner ring, of the outer
    assert pressed_on.reshape(2, 2).any(axis=1).all() == (shoulders is not None)


def test_a_shoulder_and_the_cage_push_each_other_alike():
    """What the contact changes in the rows of cage and rings sums to nothing, and the report has
    the force on the cage."""
    found = []
    for kind in ("dry", "none"):
        contacts = replace(contacts_of(), land=LandSpec(kind=kind))
        bearing = ball_bearing(
            shoulders=0.17e-3, shape="spherical", contacts=contacts,
            mount=Mount(kind="bushing", mass=0.5),
        )  # fmt: skip
        layout, y = bearing.layout, pressed(bearing)
        layout.u(y)["omega"][0] = 100.0
        layout.q(y)["modes"][:] = 0.0
        rows = bearing.residual(0.0, y, np.zeros_like(y), mode=2)
        found.append((layout.u(rows), bearing.data.work.report.land.copy()))
    (with_it, force), (without, none) = found
    push = {name: without[name] - with_it[name] for name in ("cage", "inner", "outer")}
    assert np.linalg.norm(force) > 10.0 and not none.any()
    np.testing.assert_allclose(push["cage"], force, rtol=1e-9)
    inner, outer = push["inner"][:3], push["outer"][:3]
    assert np.linalg.norm(outer) > 1.0
    size = np.linalg.norm(outer) + np.linalg.norm(inner)
    np.testing.assert_allclose(push["cage"] + inner + outer, 0.0, atol=1e-9 * size)


@pytest.mark.parametrize("along", [0, 1], ids=["axial", "circumferential"])
@pytest.mark.parametrize("shape", ["cylindrical", "spherical"])
def test_along_the_straight_part_of_a_slot_a_bent_wall_does_not_push(along, shape):
    """Balls between a slot's rounds, pressed on its straight wall, which the modes have bent."""

    def slot(interface):
        interface.slot[:, along] = 150e-6

    bearing = ball_bearing(change=slot, shape=shape)
    layout, model = bearing.layout, bearing.data.model
    y = pressed(bearing)
    q, Z = layout.q(y), layout.elements
    q["cage"][:], q["quaternion"][:] = 0.0, (1.0, 0.0, 0.0, 0.0)
    beyond = 1.03 * float(model.pocket.radius[0] - model.bodies.radius[0])
    x, t = ((40e-6, beyond), (beyond, 40e-6))[along]
    balls, height = q["elements"], model.pocket.height
    balls[:, 0], balls[:, 1] = x, height
    balls[:, 2] = 2.0 * np.pi * np.arange(Z) / Z + t / height
    rows = layout.u(-bearing.residual(0.0, y, np.zeros_like(y)))["elements"]
    energy(bearing, y)
    assert (bearing.data.work.report.pocket_normal > 1.0).sum() > 8
    component, lever = ((0, 1.0), (2, height))[along]
    for i in range(0, Z, 3):
        high, low = y.copy(), y.copy()
        layout.q(high)["elements"][i, component] += 1e-9 / lever
        layout.q(low)["elements"][i, component] -= 1e-9 / lever
        slope = -(energy(bearing, high) - energy(bearing, low)) / 2e-9
        scale = np.abs(rows[i, :3]).max()
        assert rows[i, component] == pytest.approx(slope, abs=2e-6 * scale)


def at_poles(bearing):
    """Balls within and near the polar zones of spherical pockets, and pressed into them."""
    y = pressed(bearing)
    q = bearing.layout.q(y)
    model = bearing.data.model
    play = model.pocket.radius - model.bodies.radius
    way = np.append(0.0, np.linspace(-0.45, 0.45, bearing.layout.elements - 1))
    q["cage"][:], q["quaternion"][:] = 0.0, (1.0, 0.0, 0.0, 0.0)
    balls = q["elements"]
    balls[:, 0] = 1.03 * play * np.sin(way) * 0.6 + model.pocket.shift[:, 0]
    balls[:, 1] = model.pocket.height + 1.03 * play * np.cos(way)
    balls[:, 2] = 2.0 * np.pi * np.arange(bearing.layout.elements) / bearing.layout.elements
    balls[:, 2] += 1.03 * play * np.sin(way) * 0.8 / balls[:, 1]
    return y


def at_rims(bearing):
    """Balls on rims at outside and bore, at open sides, where both meet, and straight into one."""
    y = pressed(bearing)
    q, model = bearing.layout.q(y), bearing.data.model
    wall, ball = model.pocket.radius[0], model.bodies.radius[0]
    high, low = model.pocket.rims[0]
    side = model.pocket.sides[0, 0]
    q["cage"][:], q["quaternion"][:] = 0.0, (1.0, 0.0, 0.0, 0.0)
    touched = [  # sines of latitude along x and r of the wall that the ball is pressed on
        (0.3, high), (-0.5, -low), (0.0, high), (side, 0.1), (-side, -0.3), (side, high),
        (-side, -low), (side, -low), (0.2, 0.1), (0.05, high), (0.0, -low),
    ]  # fmt: skip
    seats = {5: 1e-6, 9: 0.0, 10: 2e-6}  # nearly straight, across by so much
    for i in range(bearing.layout.elements):
        x, r = touched[i % len(touched)]
        t = np.sqrt(max(1.0 - x**2 - r**2, 0.0)) * (-1.0) ** i
        on_wall = wall * np.array([x, r, t])
        inside = on_wall - ball * beyond_rim(on_wall, i) / 1.0002
        if i in seats:  # into a round rim from straight above or below
            sine = high if i % 2 else -low
            way = np.sqrt(ball**2 * 0.9996 - wall**2 * (1.0 - sine**2))
            inside = np.array([seats[i], wall * sine - np.sign(sine) * way, 0.0])
        ball_at = inside + (model.pocket.shift[i, 0], model.pocket.height, 0.0)
        y_, z_ = ball_at[1], ball_at[2] + model.pocket.shift[i, 1]
        q["elements"][i, :2] = ball_at[0], np.hypot(y_, z_)
        q["elements"][i, 2] = 2.0 * np.pi * i / bearing.layout.elements + np.arctan2(z_, y_)
    return y


def beyond_rim(on_wall, i):
    """Unit direction a little off the sphere's normal, towards the pocket's middle."""
    n = on_wall / np.linalg.norm(on_wall)
    away = n + 0.02 * np.array([n[0], n[1], 0.0])
    return away / np.linalg.norm(away)


def bent(interface):
    """Stations that are not where the sphere has them."""
    interface.offset[:] = 2e-6 * np.random.default_rng(7).standard_normal(interface.offset.shape)


@pytest.mark.parametrize(
    ("rims", "sides", "place", "change"),
    [
        ((2.0, 2.0), (2.0, 2.0), at_poles, None),
        ((0.42, 0.55), (0.7, 0.7), at_rims, None),
        ((0.42, 0.55), (0.45, 2.0), at_rims, bent),
    ],
    ids=["poles", "rims", "claws"],
)
def test_forces_on_spheres_are_slopes_of_the_energy_too(rims, sides, place, change):
    """Of balls, cage and modes: near the poles of whole spheres, where the stations' motion fades
    into their mean, and finite at the pole itself; on rims at which a wall ends, on both sides or
    on one; on walls that are bent without stress."""
    bearing = ball_bearing(shape="spherical", change=change)
    bearing.data.model.pocket.rims[:] = rims
    bearing.data.model.pocket.sides[:] = sides
    layout, y = bearing.layout, place(bearing)
    rows = layout.u(-bearing.residual(0.0, y, np.zeros_like(y)))

    def slope(name, *index, h=1e-9):
        high, low = y.copy(), y.copy()
        layout.q(high)[name][index] += h
        layout.q(low)[name][index] -= h
        return -(energy(bearing, high) - energy(bearing, low)) / (2.0 * h)

    balls = [
        slope("elements", i, c, h=1e-9 / (1.0, 1.0, PITCH)[c]) for i in range(layout.elements)
        for c in range(3)
    ]  # fmt: skip
    others = [slope("cage", c) for c in range(3)] + [slope("modes", m) for m in range(layout.modes)]
    lever = (1.0, 1.0, PITCH)
    found = [*(rows["elements"][:, :3] * lever).ravel(), *rows["cage"], *rows["modes"]]
    found[2 : 3 * layout.elements : 3] *= layout.q(y)["elements"][:, 1] / PITCH
    scale = np.abs([*balls, *others]).max()
    np.testing.assert_allclose(found, [*balls, *others], atol=3e-6 * scale)
    energy(bearing, y)
    touching = bearing.data.work.report.pocket_normal[:, 0] > 1.0
    assert touching[0] and touching.sum() > 8


def test_all_forces_balance():
    """Friction, damping and rolling resistance included: balls, both rings and the cage push each
    other only."""
    bearing = ball_bearing(
        contacts=contacts_of("restitution", "step_coulomb"), lubricant=Lubricant(oil_fraction=0.0)
    )
    layout, y = bearing.layout, pressed(bearing, seed=3)
    rng = np.random.default_rng(1)
    u = layout.u(y)
    u["elements"][:] = rng.standard_normal((layout.elements, 6)) * (0.1, 0.1, 0.1, 50, 50, 50)
    u["inner"][:] = rng.standard_normal(6) * (0.1, 0.1, 0.1, 30, 5, 5)
    u["cage"][:], u["omega"][:] = 0.1 * rng.standard_normal(3), 5.0 * rng.standard_normal(3)
    yd = np.zeros_like(y)
    bearing.residual(0.0, y, yd, mode=2)
    work = bearing.data.work
    q = layout.q(y)
    pushed, report = layout.border(work.scratch.border.copy()), work.report
    psi, r = q["elements"][:, 2], q["elements"][:, 1]
    # what acts on each ball, from its rows without inertia
    rows = layout.u(-bearing.residual(0.0, y, yd))["elements"].copy()
    model = bearing.data.model
    orbit = u["elements"][:, 2] / r
    mass, inertia = model.bodies.element[:2]
    rows[:, 1] -= mass * orbit * u["elements"][:, 2]
    rows[:, 2] += mass * orbit * u["elements"][:, 1]
    rows[:, 4] -= inertia * orbit * u["elements"][:, 5]
    rows[:, 5] += inertia * orbit * u["elements"][:, 4]
    er = np.stack([0 * psi, np.cos(psi), np.sin(psi)], axis=1)
    et = np.stack([0 * psi, -np.sin(psi), np.cos(psi)], axis=1)
    ex = np.tile([1.0, 0.0, 0.0], (len(psi), 1))

    def space(a):
        return a[:, :1] * ex + a[:, 1:2] * er + a[:, 2:] * et

    forces, couples = space(rows[:, :3]), space(rows[:, 3:])
    at = q["elements"][:, :1] * ex + r[:, None] * er
    rings = "inner", "outer"
    total = forces.sum(axis=0) + pushed["cage"] + sum(pushed[name][:3] for name in rings)
    assert np.abs(total).max() < 1e-10 * np.abs(forces).sum()
    A = work.scratch.A
    moment = (np.cross(at, forces) + couples).sum(axis=0)
    for name in rings:
        moment = moment + np.cross(q[name][:3], pushed[name][:3]) + pushed[name][3:]
    moment = moment + np.cross(q["cage"], pushed["cage"]) + A @ pushed["omega"]
    assert np.abs(moment).max() < 1e-9 * np.abs(np.cross(at, forces)).sum()
    assert (report.pocket_friction > 0.0).any() and (report.race[:, :, 0] > 0.0).any(axis=0).all()
