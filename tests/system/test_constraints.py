"""Constraints beyond drive and load: on the equations without them, closed forms, both methods."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import pytest
from bearing_runs import STATES, disturbed, march, rolling_start
from test_rates import rates

from flexcage.bodies.floating_frame import rigid_body
from flexcage.contacts.spec import Contacts, NormalLaw, PairSpec
from flexcage.core.errors import InputError
from flexcage.core.spec import quantity
from flexcage.system import constraints
from flexcage.system.constraints import names_of, register_constraint
from flexcage.system.spec import CageCentre, CageSpeed, CageTilt, Constraint, InnerPath, Load

RPM = np.pi / 30


@dataclass(frozen=True, kw_only=True)
class Rod(Constraint):
    """The cage's origin keeps its distance from the axis; nonlinear in the coordinates."""

    type: str = "rod"
    length: float = quantity("um", 40e-6, doc="length", above=0.0)


def rod(t, y, at, p, G, g, h):
    q, u, b = at.cage_q + 1, at.cage_u + 1, at.cage_b + 1
    distance = (y[q] * y[q] + y[q + 1] * y[q + 1]) ** 0.5
    g[0] = distance - p[0]
    G[0, b], G[0, b + 1] = y[q] / distance, y[q + 1] / distance
    h[0] = G[0, b] * y[u] + G[0, b + 1] * y[u + 1]


@dataclass(frozen=True, kw_only=True)
class Governor(Constraint):
    """The cage's speed rises with the square of the inner ring's sideways velocity."""

    type: str = "governor"
    gain: float = quantity("s/m^2", 3e3, doc="gain")


def governor(t, y, at, p, G, g, h):
    sideways = y[at.inner_u + 1]
    h[0] = y[at.cage_u + 3] - 270.0 - 50.0 * t - p[0] * sideways**2
    G[0, at.cage_b + 3], G[0, at.inner_b + 1] = 1.0, -2.0 * p[0] * sideways


def spacer(t, y, at, p, G, g, h):
    """Both rings' centres keep 12 um between them along y."""
    g[0] = y[at.inner_q + 1] - y[at.outer_q + 1] - 12e-6
    h[0] = y[at.inner_u + 1] - y[at.outer_u + 1]
    G[0, at.inner_b + 1], G[0, at.outer_b + 1] = 1.0, -1.0


@dataclass(frozen=True, kw_only=True)
class Spacer(Constraint):
    type: str = "spacer"


@pytest.fixture(scope="module", autouse=True)
def kinds():
    """Kinds from outside, of either level, most of them not linear."""
    before = dict(constraints.KINDS), dict(constraints.specs.CONSTRAINTS)
    register_constraint("rod", rod, level="position", spec=Rod)
    register_constraint("governor", governor, level="velocity", spec=Governor)
    register_constraint("spacer", spacer, level="position", spec=Spacer)
    yield
    for table, saved in zip((constraints.KINDS, constraints.specs.CONSTRAINTS), before):
        table.clear()
        table.update(saved)


HELD = {
    "cage speed": (CageSpeed(speed=280.0),),
    "gear": (CageSpeed(ratio=0.46),),
    "cage centre": (CageCentre(y=30e-6, z=-20e-6),),
    "cage tilt": (CageTilt(),),
    "inner path": (InnerPath(y=10e-6, radius=2e-6, speed=900.0, phase=0.3),),
    "rod": (Rod(),),
    "governor": (Governor(),),
    "spacer": (Spacer(),),
    "several": (Rod(), CageSpeed(ratio=0.46), InnerPath(y=10e-6, radius=2e-6, speed=900.0)),
}


def brought(bearing, y):
    """y moved onto the constraints, and y'."""
    for _ in range(8):
        yd, _ = rates(bearing, 0.0, y)
    return y, yd


def missed(bearing, t, y):
    """g and h of all constraints."""
    held = bearing.data.constraints
    G, g, h = np.zeros_like(held.G), np.zeros_like(held.g), np.zeros_like(held.h)
    bearing.laws[-2](t, y, bearing.layout.places, held.p, G, g, h)
    return g, h


@pytest.mark.parametrize("name", HELD)
@pytest.mark.parametrize(
    "state", ["light", "flexible, soft walls", "shaft", "compliant shaft", "bushing"]
)
def test_rates_leave_no_residual_and_stay_on_the_constraints(bearing_of, state, name):
    """F(t, y, y') = 0 with the multipliers that the explicit form finds; g and h are zero, and
    stay so to the second order along y'."""
    specs, moving = STATES[state]
    bearing = bearing_of(**{"load": Load(radial=1000.0), **specs}, constraints=HELD[name])
    y, _, _ = disturbed(bearing, **moving)
    bearing.layout.q(y)["cage"][1:] += 30e-6
    y, yd = brought(bearing, y)
    layout = bearing.layout
    left = bearing.residual(0.0, y, yd)
    force = 0.01 * np.abs(layout.u(bearing.residual(0.0, y, 0.0 * yd))["elements"]).max()
    left[layout.n_q : layout.n_q + layout.n_u] /= force
    assert np.abs(left).max() < 1e-9
    untouched = (state, name) == ("light", "cage tilt")  # a cage that nothing tilts
    assert np.any(layout.multipliers(y)[4:]) or untouched
    off = []
    for step in (4e-8, 2e-8):
        g, h = missed(bearing, step, y + step * yd)
        off.append(max(np.abs(g).max() * 1e5, np.abs(h).max()))
    assert off[0] < 1e-12 or off[0] / off[1] == pytest.approx(4.0, rel=0.05)


@pytest.mark.parametrize("name", ["gear", "rod", "governor", "spacer", "several"])
def test_both_methods_go_the_same_way(bearing_of, name):
    """Each at a tight tolerance, in what moves, what is borne and what work is done; energies close
    in either. Laws without damping, which depend on no remembered onset."""
    elastic = PairSpec(normal=NormalLaw(law="elastic"))
    contacts = Contacts(race=elastic, pocket=elastic, side=elastic, rib=elastic)
    outs = {}
    for method, h_max in (("bdf", 4e-8), ("explicit", 1e-7)):
        bearing = bearing_of(
            load=Load(radial=1000.0), contacts=contacts, flexible={"modes": 6},
            constraints=HELD[name],
        )  # fmt: skip
        y, yd = rolling_start(bearing)
        bearing.layout.q(y)["inner"][1] = 12e-6
        bearing.layout.q(y)["cage"][1:] = 30e-6
        bearing.layout.u(y)["inner"][1] = 5e-3
        bearing.layout.u(y)["cage"][1:] = 0.8, -0.5  # it reaches rollers on the way
        y, yd = brought(bearing, y)
        h = march(bearing, y, yd, duration=0.2e-3, tolerance=1e-13, h_max=h_max, method=method)
        outs[method] = h
        for t, state in zip(h.time, h.y, strict=True):
            g, rate = missed(bearing, t, state)
            assert np.abs(g).max() < 1e-13 and np.abs(rate).max() < 1e-8
        assert name in ("rod", "several") or h.samples.pocket_normal.any()
        gained = np.ptp(h.samples.energy[: len(h.y)].sum(axis=1) - h.work.sum(axis=1))
        assert gained < 1e-4 * np.ptp(h.work, axis=0).max()
    bdf, explicit = outs["bdf"], outs["explicit"]
    weight = bearing.error_weights(1e-9)
    assert np.abs((bdf.y - explicit.y) * weight).max() < 3.0
    ours, theirs = (bearing.layout.multipliers(h.y)[:, 3:] for h in (bdf, explicit))
    np.testing.assert_allclose(ours, theirs, atol=2e-3 * np.abs(theirs).max())
    np.testing.assert_allclose(bdf.work, explicit.work, atol=1e-4 * np.abs(bdf.work).max())


def alone(bearing_of, **specs):
    """A bearing without load, gravity and rolling losses, its cage a heavy body in the middle."""
    return bearing_of(load=Load(radial=0.0, gravity=0.0), **specs)


@pytest.mark.parametrize("method", ["bdf", "explicit"])
def test_a_cage_on_a_rod_circles_at_its_speed(bearing_of, method):
    """Nothing else pulls: azimuth v t/R, tension m v^2/R (towards the middle: negative)."""
    mass, v, R = 0.2, 0.05, 40e-6
    body = rigid_body(mass, np.zeros(3), 1e-4 * np.eye(3))
    bearing = alone(bearing_of, body=body, constraints=(Rod(),))
    y, yd = rolling_start(bearing)
    bearing.layout.q(y)["cage"][1] = R
    bearing.layout.u(y)["cage"][2] = v
    y, yd = brought(bearing, y)
    h = march(bearing, y, yd, duration=1e-3, tolerance=1e-12, method=method, h_max=1e-6)
    assert not h.samples.pocket_normal.any()
    azimuth = v * h.time / R
    circle = R * np.stack([np.cos(azimuth), np.sin(azimuth)], axis=1)
    np.testing.assert_allclose(bearing.layout.q(h.y)["cage"][:, 1:], circle, atol=1e-10)
    tension = bearing.layout.multipliers(h.y)[10:, 4]
    np.testing.assert_allclose(tension, -mass * v**2 / R, rtol=1e-4)


@pytest.mark.parametrize("method", ["bdf", "explicit"])
def test_a_cage_that_cannot_tilt_bears_the_moment_of_its_couple(bearing_of, method):
    """A body with a product P = int x y dm of mass, unbalanced dynamically: w x (I w) is -P W^2
    about the body's z, which turns with it."""
    couple = 2e-6
    second = 1e-4 * np.eye(3)
    second[0, 1] = second[1, 0] = couple
    body = rigid_body(0.2, np.zeros(3), second)
    bearing = alone(bearing_of, body=body, constraints=(CageTilt(),))
    y, yd = brought(bearing, rolling_start(bearing)[0])
    h = march(bearing, y, yd, duration=1e-3, tolerance=1e-12, method=method, h_max=1e-6)
    assert not h.samples.pocket_normal.any()
    speed = bearing.layout.u(h.y)["omega"][:, 0]
    turned = speed[0] * h.time
    moment = couple * speed[0] ** 2 * np.stack([np.sin(turned), -np.cos(turned)], axis=1)
    borne = bearing.layout.multipliers(h.y)[:, 4:]
    np.testing.assert_allclose(borne[10:], moment[10:], atol=1e-3 * np.abs(moment).max())


@pytest.mark.parametrize("method", ["bdf", "explicit"])
def test_a_held_cage_throws_its_unbalance(bearing_of, method):
    """A body whose centre of mass is 0.1 mm off its origin, held there: m e W^2 that turns."""
    mass, e = 0.2, 1e-4
    body = rigid_body(mass, np.array([0.0, e, 0.0]), 1e-4 * np.eye(3))
    bearing = alone(bearing_of, body=body, constraints=(CageCentre(),))
    y, yd = brought(bearing, rolling_start(bearing)[0])
    h = march(bearing, y, yd, duration=1e-3, tolerance=1e-12, method=method, h_max=1e-6)
    assert not h.samples.pocket_normal.any()
    speed = bearing.layout.u(h.y)["omega"][:, 0]
    turned = speed[0] * h.time
    pull = mass * e * speed[0] ** 2 * np.stack([np.cos(turned), np.sin(turned)], axis=1)
    borne = bearing.layout.multipliers(h.y)[:, 4:]
    np.testing.assert_allclose(borne[10:], -pull[10:], atol=1e-3 * np.abs(pull).max())


@pytest.mark.parametrize("method", ["bdf", "explicit"])
def test_a_ring_on_its_path(bearing_of, method):
    """Within its clearance, so that the path bears the load and the ring's inertia alone."""
    radius, speed, load = 2e-6, 2000.0, 300.0
    bearing = bearing_of(
        load=Load(radial=load, gravity=0.0),
        constraints=(InnerPath(radius=radius, speed=speed, phase=0.5),),
    )
    y, yd = brought(bearing, rolling_start(bearing)[0])
    h = march(bearing, y, yd, duration=1e-3, tolerance=1e-12, method=method, h_max=1e-6)
    assert not h.samples.race[:, :, 0, 0].any()
    at = speed * h.time + 0.5
    along = np.stack([np.cos(at), np.sin(at)], axis=1)
    np.testing.assert_allclose(bearing.layout.q(h.y)["inner"][:, 1:3], radius * along, atol=1e-11)
    mass = bearing.data.model.inner_ring.inertia[0]
    expected = -mass * radius * speed**2 * along - load * np.array([1.0, 0.0])
    np.testing.assert_allclose(bearing.layout.multipliers(h.y)[10:, 4:], expected[10:], rtol=1e-3)


def test_a_geared_cage_is_driven_by_the_ring(bearing_of):
    """What the gear does to the ring is borne by the drive: no work is done by the gear itself."""
    bearing = bearing_of(load=Load(radial=1000.0), constraints=(CageSpeed(ratio=0.47),))
    y, yd = rolling_start(bearing)
    y, yd = brought(bearing, y)
    h = march(bearing, y, yd, duration=0.5e-3, rate=1e6, method="explicit", h_max=1e-6)
    drive, gear = bearing.layout.multipliers(h.y)[:, 3:].T
    speed = bearing.layout.u(h.y)["inner"][0, 3]
    assert np.abs(h.power("constraints")).max() < 1e-9 * h.power("drive").max()
    assert np.abs(gear).mean() > 0.1  # N m: a cage that is 4 % ahead of its rollers pushes them
    assert h.power("drive")[-1] == pytest.approx(np.trapezoid(drive, h.time) * speed, rel=0.05)


def test_names_and_numbers():
    specs = (CageCentre(), Rod(), Rod(length=1e-6))
    assert names_of(specs) == ("cage_centre_y", "cage_centre_z", "rod", "rod_2")


def test_names_that_clash():
    for name, others, words in (
        ("moment_y", (), "constraints.0 is called 'moment_y' in results"),
        ("cage_centre_z", (CageCentre(),), "constraints.1 is called 'cage_centre_z'"),
    ):
        register_constraint(name, spacer, level="position")
        with pytest.raises(InputError, match=words):
            names_of((*others, constraints.specs.CONSTRAINTS[name]()))


@pytest.mark.parametrize(
    "name, options, words",
    [
        ("rod", {"level": "position"}, "'rod' exists already"),
        ("bar", {"level": "force"}, "level of constraint 'bar' is 'force'"),
        ("bar", {"level": "position", "spec": Rod}, "whose type defaults to 'bar'"),
        (
            "bar",
            {"level": "position", "spec": "Bar"},
            "must be a dataclass derived from Constraint",
        ),
        ("bar", {"level": "position", "unit": "kN"}, "unit of constraint 'bar' is 'kN'"),
        ("bar", {"level": "position", "labels": ()}, r"labels of constraint 'bar' are \(\)"),
        ("bar", {"level": "position", "labels": "yz"}, "labels of constraint 'bar' are 'yz'"),
    ],
)
def test_kinds_that_are_refused(name, options, words):
    with pytest.raises(InputError, match=words):
        register_constraint(name, rod, **options)


def test_rows_that_cannot_be_compiled():
    with pytest.raises(InputError, match=r"constraint 'short' cannot be compiled .* \(t, y, at, p"):
        register_constraint("short", lambda t, q: None, level="position")
    assert "short" not in constraints.KINDS
    with pytest.raises(InputError, match="'lost' cannot be compiled .* name 'no_such_name'"):
        register_constraint("lost", unnamed, level="position")


def unnamed(t, y, at, p, G, g, h):
    g[0] = no_such_name  # noqa: F821


def two(t, y, at, p, G, g, h):
    for k in range(1, 3):
        g[k - 1], h[k - 1] = y[at.cage_q + k], y[at.cage_u + k]
        G[k - 1, at.cage_b + k] = 1.0


def flat(t, y, at, p, G, g, h):
    g[0] = 1.0


@pytest.mark.parametrize(
    "rows, options, words",
    [
        (two, {}, "fills more rows than the 1 that its labels name"),
        (two, {"labels": ("a", "b", "c")}, "has no slope G at the start.* every label have its"),
        (flat, {}, "has no slope G at the start"),
        (two, {"labels": "ab", "parameters": lambda s: range(11)}, "must be numbers, at most 10"),
        (two, {"labels": "ab", "parameters": lambda s: ("left",)}, r"are \('left',\), but must"),
    ],
)
def test_rows_and_parameters_that_do_not_fit(bearing_of, rows, options, words):
    name = f"own{abs(hash(words))}"
    if "labels" in options:
        options = {**options, "labels": tuple(options["labels"])}
    register_constraint(name, rows, level="position", **options)
    specs = (constraints.specs.CONSTRAINTS[name](),)
    with pytest.raises(InputError, match=words):
        bearing = bearing_of(load=Load(radial=1000.0), constraints=specs)
        y = np.zeros(bearing.layout.size)
        constraints.check_independent(specs, bearing.data.constraints, bearing.layout, y)


def test_a_kind_without_values(bearing_of):
    def level(t, y, at, p, G, g, h):  # the cage stays where it is along the axis
        g[0], h[0], G[0, at.cage_b] = y[at.cage_q], y[at.cage_u], 1.0

    register_constraint("level", level, level="position")
    own = constraints.specs.CONSTRAINTS["level"]()
    bearing = bearing_of(load=Load(radial=1000.0), constraints=(own,))
    y, _ = brought(bearing, disturbed(bearing, axial=15e-6)[0])
    assert bearing.layout.reactions[-1] == "level" and bearing.layout.q(y)["cage"][0] == 0.0
