"""Four-point contact bearings: geometry, checks, ratings, and the static solution against closed
forms."""

from dataclasses import replace
from math import acos, cos, hypot, pi, radians, sin

import numpy as np
import pytest
from qj208 import INSIDE, QJ208, solved
from scipy.optimize import brentq

from flexcage.bearings import bending_of, sections_of, statics_of
from flexcage.bearings.ball.angular_contact import AngularContactBallBearing
from flexcage.bearings.four_point.inference import INFERENCE
from flexcage.case import catalogue
from flexcage.contacts.spec import Contacts
from flexcage.core.errors import InputError
from flexcage.geometry.inference import ranked
from flexcage.system.spec import Load
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.solve import solve_bearing

RPM = pi / 30.0
SPLIT = replace(QJ208, outer_shim=0.0)  # a split inner ring, one arc in the outer one
ANGULAR = AngularContactBallBearing(**INSIDE, contact_angle=radians(35.0))


def test_a_ball_rests_on_both_arcs_at_the_shim_angle_and_touches_as_the_clearances_say():
    """Distances in the plane of a section, from the drawing of both rings' arcs."""
    half, b = 0.5 * QJ208.ball_diameter, QJ208
    (i, j), (o, p) = b.arcs("inner"), b.arcs("outer")
    inner, outer = b.inner_groove_radius - half, b.outer_groove_radius - half
    assert i == -j == 0.5 * b.inner_shim and o == -p == -0.5 * b.outer_shim
    # at rest in the outer race, then the inner ring comes down by half of the radial clearance
    ball = (outer**2 - o**2) ** 0.5
    apart = b.groove_offset[1] + 0.5 * b.clearance
    assert hypot(i, apart - ball) == pytest.approx(inner, rel=1e-12)
    np.testing.assert_allclose(np.sin(b.shim_angles), [i / inner, -o / outer], rtol=1e-12)
    # or is pushed along: one arc of each ring, as far apart as their radii leave
    pushed = hypot(i - o + 0.5 * b.axial_clearance, b.groove_offset[1])
    assert pushed == pytest.approx(b.groove_distance, rel=1e-12)
    assert acos(b.groove_offset[1] / b.groove_distance) == pytest.approx(radians(35.0))


def test_contact_angle_and_clearance_say_the_same():
    other = replace(QJ208, contact_angle=None, radial_clearance=QJ208.clearance)
    assert other.free_contact_angle == pytest.approx(radians(35.0), rel=1e-12)
    tighter = replace(other, radial_clearance=-20e-6)
    assert tighter.axial_clearance < 0.0 and tighter.clearance == -20e-6
    assert "the axial clearance is 72.75 µm" in QJ208.in_words()


@pytest.mark.parametrize(
    ("changes", "where", "said"),
    [
        ({"inner_shim": 0.0, "outer_shim": 0.0}, "inner_shim", "are both 0"),
        ({"outer_shim": 0.7e-3}, "outer_shim", "is 0.7 mm, but no ball touches both arcs"),
        ({"contact_angle": None}, "contact_angle", "neither contact_angle nor radial_clearance"),
        ({"radial_clearance": 5e-6}, "radial_clearance", "makes it 46.46 um in these arcs"),
        ({"inner_shoulder": 0.8e-3}, "inner_shoulder", "ends the race at 28.64 deg"),
        ({"ball_count": 16}, "ball_count", "at most 14 fit"),
    ],
)
def test_impossible_arcs_are_refused_in_a_sentence(changes, where, said):
    with pytest.raises(InputError, match=said) as caught:
        replace(QJ208, **changes).check()
    assert caught.value.where == f"bearing.{where}"


def test_it_is_rated_as_two_rows():
    one = ANGULAR
    assert QJ208.static_rating == pytest.approx(2.0 * one.static_rating, rel=1e-12)
    assert QJ208.dynamic_rating == pytest.approx(2.0**0.7 * one.dynamic_rating, rel=1e-12)
    low, high = QJ208.equivalent_load(1e3, 900.0), QJ208.equivalent_load(1e3, 2e3)
    assert low.load == pytest.approx(1e3 + 0.66 * 900.0, rel=7e-3)  # makers round
    assert high.load == pytest.approx(0.6 * 1e3 + 1.07 * 2e3, rel=7e-3)


@pytest.mark.parametrize("angle", [20.0, 25.0, 30.0, 35.0, 40.0, 45.0])
def test_factors_of_two_rows_meet_at_their_limit(angle):
    """X Fr + Y Fa on both sides of Fa/Fr = e, to the rounding of the standard's table."""
    b = replace(QJ208, contact_angle=radians(angle))
    ratios = np.linspace(0.4, 1.5, 2201)
    loads = np.array([b.equivalent_load(1.0, ratio).load for ratio in ratios])
    assert np.abs(np.diff(loads)).max() < 0.013


@pytest.mark.parametrize("speed", [0.0, 6000.0 * RPM])
def test_axial_load_finds_an_angular_contact_bearing_behind_half_the_clearance(speed):
    ours, theirs = (
        solve_bearing(b, statics_of(b), load=Load(axial=2e3, radial=0.0), speed=speed)
        for b in (QJ208, ANGULAR)
    )
    way = ours.displacement[0] - theirs.displacement[0]
    assert way == pytest.approx(0.5 * QJ208.axial_clearance, rel=1e-7)
    for name in ("force", "angle", "pressure", "centrifugal", "gyroscopic", "orbital_speed"):
        found, due = (getattr(s.elements, name) for s in (ours, theirs))
        np.testing.assert_allclose(found, due, rtol=1e-7)
    np.testing.assert_allclose(ours.stiffness[0, 0], theirs.stiffness[0, 0], rtol=1e-6)
    assert ours.ratings.reference_life == pytest.approx(theirs.ratings.reference_life, rel=1e-6)
    arcs = ours.elements.arcs
    assert not arcs["inner +x"].any() and not arcs["outer -x"].any()


def test_the_other_way_it_bears_as_well():
    ours, back = solved(axial=2e3), solved(axial=-2e3)
    np.testing.assert_allclose(back.displacement[0], -ours.displacement[0], rtol=1e-9)
    for ring in ("inner", "outer"):
        here, there = ours.elements.arcs, back.elements.arcs
        np.testing.assert_allclose(here[f"{ring} -x"], there[f"{ring} +x"], rtol=1e-9, atol=1e-9)


def test_axial_load_in_closed_form():
    """Two points a ball: cos(a)/cos(a_f) = A/(A + d), Z Q sin(a) = Fa (Harris, 7)."""
    soft = sum(c.stiffness ** (-2.0 / 3.0) for c in QJ208.contacts)
    A, free, each = QJ208.groove_distance, radians(35.0), 5e3 / QJ208.ball_count

    def left(angle):
        depth = A * (cos(free) / cos(angle) - 1.0)
        return (max(depth, 0.0) / soft) ** 1.5 * sin(angle) - each

    angle = brentq(left, free, radians(50.0), xtol=1e-14)
    found = solved(axial=5e3)
    np.testing.assert_allclose(found.elements.angle, angle, rtol=1e-9)
    np.testing.assert_allclose(found.elements.force, each / sin(angle), rtol=1e-9)


@pytest.mark.parametrize("bearing", [QJ208, SPLIT], ids=["four", "three"])
def test_radial_load_is_borne_by_all_arcs_alike(bearing):
    """A ball midway, pressed by u cos(psi) less half the clearance: where its centre stands both
    races push alike; found here for each ball by itself, and summed."""
    load, rest = 3e3, []
    for shim, length in zip(bearing.shims, bearing.lengths):
        rest.append((0.5 * shim, length))

    def push(race, out):  # N along the radius, the arcs' circle ``out`` from the ball's centre
        (half, length), stiffness = rest[race], bearing.contacts[race].stiffness
        reach = hypot(half, out)
        arcs = 2.0 if half else 1.0
        return arcs * stiffness * max(reach - length, 0.0) ** 1.5 * out / reach

    def of_ball(apart):
        h = bearing.groove_offset[1] + apart
        low, high = 0.5 * h - 0.2e-3, 0.5 * h + 0.2e-3
        at = brentq(lambda r: push(1, r) - push(0, h - r), low, high, xtol=1e-16)
        return push(1, at), at, h - at

    psi = 2.0 * pi * np.arange(bearing.ball_count) / bearing.ball_count

    def borne(u):
        return sum(of_ball(u * cos(p))[0] * cos(p) for p in psi) - load

    u = brentq(borne, 0.0, 0.2e-3, xtol=1e-15)
    found = solved(bearing, radial=load)
    assert found.displacement[1] == pytest.approx(u, rel=1e-8)
    assert abs(found.displacement[0]) < 1e-12
    arcs = found.elements.arcs
    np.testing.assert_allclose(arcs["inner -x"], arcs["inner +x"], rtol=1e-9, atol=1e-7)
    for k, p in enumerate(psi):
        radial, at, _ = of_ball(u * cos(p))
        half = rest[1][0]
        due = radial * hypot(half, at) / at / (2.0 if half else 1.0)
        assert found.elements.force[k, 1] == pytest.approx(due, rel=1e-7, abs=1e-6)
    assert (bearing is SPLIT) == ("outer" in arcs)


@pytest.mark.parametrize("share", [0.0, 1.0])
@pytest.mark.parametrize("bearing", [QJ208, SPLIT], ids=["four", "three"])
def test_tangents_of_all_arcs_are_the_slopes_of_forces(bearing, share):
    e = statics_of(bearing)(
        bearing, speed=9000.0 * RPM, contacts=Contacts(), options=StaticOptions()
    )
    rng, Z = np.random.default_rng(5), bearing.ball_count
    v = rng.uniform(-1.0, 1.0, (Z, 3)) * [20e-6, 20e-6, 2e-4] + [
        0.0,
        0.5 * bearing.clearance + 22e-6,
        0.0,
    ]
    w = e.guesses(v)[-1] + rng.uniform(-4e-6, 4e-6, (Z, 2)) + [0.0, 8e-6]
    r, h = e.respond(v, w, share), 1e-10
    bearing_arcs = np.concatenate(e.arc_forces(v, w)) > 0.0
    assert (bearing_arcs.sum(axis=0) >= 3).any() and not bearing_arcs.all()
    energy = np.zeros((Z, 5))
    for k in range(5):
        step = np.zeros(5)
        step[k] = h
        up, down = (e.respond(v + s * step[:3], w + s * step[3:], share) for s in (1.0, -1.0))
        energy[:, k] = (up.energy - down.energy) / (2.0 * h)
        for name, slope in (
            ("ring", np.concatenate([r.ring_v, r.ring_w], axis=2)),
            ("unbalance", np.concatenate([r.unbalance_v, r.unbalance_w], axis=2)),
        ):
            found = (getattr(up, name) - getattr(down, name)) / (2.0 * h)
            error = np.abs(found - slope[:, :, k])
            assert np.quantile(error, 0.95) <= 2e-4 * np.abs(slope[:, :, k]).max()
    if share == 0.0:
        forces = np.concatenate([r.ring, r.unbalance], axis=1)
        np.testing.assert_allclose(energy, forces, atol=2e-4 * np.abs(forces).max())


def test_stiffness_is_the_slope_of_the_load_where_four_arcs_bear():
    base, step = dict(radial=3e3, axial=300.0), 1.0
    at = solved(speed=6000.0 * RPM, **base)
    assert (at.elements.arcs["inner +x"] > 0.0).any()
    for key, k in (("axial", 0), ("radial", 1)):
        up, down = (
            solved(speed=6000.0 * RPM, **{**base, key: base[key] + s * step}) for s in (1.0, -1.0)
        )
        moved = (up.displacement - down.displacement)[:3] / (2.0 * step)
        force = at.stiffness[:3, :3] @ moved
        due = np.eye(3)[k]
        np.testing.assert_allclose(force, due, atol=2e-4)


def test_the_table_names_every_arc():
    """In a line for each ball, and in JSON."""
    found = solved(radial=3e3, axial=300.0)
    heads = str(found).split("element", 1)[1]
    for name in ("inner -x", "inner +x", "outer -x", "outer +x"):
        assert name in found.to_dict()["elements"]["arcs"]
    assert heads.count("+x, N") + heads.count("-x, N") == 4
    assert "both of the arc of a race that bears most" in " ".join(str(found).split())


@pytest.mark.parametrize("number", "206 207 208 209 210 308 309 310".split())
def test_two_rows_rate_balls_of_the_catalogue_s_size(number):
    """The inside that is inferred has the catalogue's C0 within 1.5 % and C within 4 %."""
    outline = catalogue.find(f"QJ{number}").outline
    chosen = ranked(INFERENCE.candidates(outline))[0]
    assert abs(chosen.static_error) < 0.015 and 0.96 < chosen.makers_factor < 1.04
    bearing = chosen.bearing
    assert bearing.axial_clearance == pytest.approx(60e-6, abs=0.5e-6)
    inner, outer = bearing.shim_angles
    assert inner == pytest.approx(outer, abs=1e-3) and inner < radians(35.0)


def test_what_it_has_not_is_refused_in_a_sentence():
    with pytest.raises(InputError, match="rings of a four-point contact ball bearing do not bend"):
        bending_of(QJ208)
    assert sections_of(QJ208) is None
