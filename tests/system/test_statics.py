"""The static solution: derivatives, balances, and closed forms written out once more."""

from dataclasses import replace
from math import cos, pi, radians, sin

import numpy as np
import pytest
from scipy.optimize import brentq
from solved_bearings import solve_bearing

from flexcage.bearings import statics_of
from flexcage.case.presets import load_preset
from flexcage.contacts.spec import Contacts, PairSpec
from flexcage.core.errors import InputError, RunFailed
from flexcage.geometry.hertz import series_stiffness
from flexcage.geometry.rollers import RollerProfile
from flexcage.system.spec import Load
from flexcage.system.statics.options import StaticOptions

RPM = pi / 30.0
BALLS, STEEP = load_preset("7010C-PA66").bearing, load_preset("7603025").bearing
DEEP, ROLLERS = load_preset("15x37x10").bearing, load_preset("N1013").bearing
ALL = {"angular": BALLS, "steep": STEEP, "deep groove": DEEP, "rollers": ROLLERS}


def elements(bearing, speed=8000.0 * RPM, **options):
    how = StaticOptions(**options)
    return statics_of(bearing)(bearing, speed=speed, contacts=Contacts(), options=how)


def pressed(e, bearing):
    """Displacements v (Z, 3) and places w (Z, 2) with contacts of all kinds, some open."""
    rng = np.random.default_rng(3)
    Z = len(e.azimuth)
    v = np.stack([rng.uniform(-10e-6, 40e-6, Z), rng.uniform(-20e-6, 40e-6, Z),
                  rng.uniform(-2e-4, 2e-4, Z)], axis=1)  # fmt: skip
    w = e.guesses(v)[1] + rng.uniform(-4e-6, 4e-6, (Z, 2))
    return v, w


@pytest.mark.parametrize("name", ALL)
@pytest.mark.parametrize("share", [0.0, 1.0])
def test_tangents_are_the_slopes_of_forces(name, share):
    e = elements(ALL[name])
    v, w = pressed(e, ALL[name])
    r, h = e.respond(v, w, share), 1e-10
    assert (np.abs(r.ring_v).max(axis=(1, 2)) > 0.0).sum() > 3
    for k in range(5):
        step_v, step_w = np.zeros(3), np.zeros(2)
        (step_v if k < 3 else step_w)[k % 3] = h
        up = e.respond(v + step_v, w + step_w, share)
        down = e.respond(v - step_v, w - step_w, share)
        for quantity, slope_v, slope_w in (
            ("ring", r.ring_v, r.ring_w), ("unbalance", r.unbalance_v, r.unbalance_w),
        ):  # fmt: skip
            slope = slope_v[:, :, k] if k < 3 else slope_w[:, :, k - 3]
            found = (getattr(up, quantity) - getattr(down, quantity)) / (2.0 * h)
            # where a contact opens within the difference the slope of d^(10/9) is not defined
            scale = np.abs(slope).max()
            assert np.quantile(np.abs(found - slope), 0.95) <= 2e-4 * scale


@pytest.mark.parametrize("name", ALL)
def test_forces_are_the_slopes_of_the_energy(name):
    e = elements(ALL[name])
    v, w = pressed(e, ALL[name])
    r, h = e.respond(v, w, 0.0), 1e-9
    for k in range(5):
        step_v, step_w = np.zeros(3), np.zeros(2)
        (step_v if k < 3 else step_w)[k % 3] = h
        up, down = (e.respond(v + s * step_v, w + s * step_w, 0.0).energy for s in (1.0, -1.0))
        force = r.ring[:, k] if k < 3 else r.unbalance[:, k - 3]
        assert (up - down) / (2.0 * h) == pytest.approx(force, abs=1e-3 * np.abs(force).max())


@pytest.mark.parametrize("name", ALL)
def test_stiffness_is_the_slope_of_the_load(name):
    """A little more load, in every direction that is borne, moves the ring by its inverse."""
    bearing = ALL[name]
    rolls = bearing is ROLLERS
    load = Load(axial=0.0 if rolls else 800.0, radial=300.0, direction=0.3, tilt="free")
    speed = 8000.0 * RPM
    found = solve_bearing(bearing, load=load, speed=speed)
    borne = slice(1 if rolls else 0, 5)
    K = found.stiffness[borne, borne]
    assert np.linalg.eigvals(K).real.min() > 0.0
    force = found.load[borne]
    for k, size in enumerate([0.02, 0.02, 0.02, 2e-5, 2e-5][borne]):
        moved = []
        for sign in (1.0, -1.0):
            new = force.copy()
            new[k] += sign * size
            full = np.concatenate([[0.0], new]) if rolls else new
            changed = Load(
                axial=full[0], radial=float(np.hypot(*full[1:3])),
                direction=float(np.arctan2(full[2], full[1])), moment_y=full[3], moment_z=full[4],
                tilt="free",
            )  # fmt: skip
            moved.append(solve_bearing(bearing, load=changed, speed=speed).displacement[borne])
        slope = (moved[0] - moved[1]) / (2.0 * size)
        back = K @ slope
        unit = np.zeros(len(force))
        unit[k] = 1.0
        lever = np.array([1.0, 1.0, 1.0, 0.02, 0.02])[borne]
        assert back / lever == pytest.approx(unit / lever, abs=2e-3 / lever[k])


def test_stiffness_is_symmetric_without_friction():
    for bearing in ALL.values():
        rolls = bearing is ROLLERS
        load = Load(axial=0.0 if rolls else 900.0, radial=300.0, direction=1.0)
        K = solve_bearing(bearing, load=load).stiffness
        lever = np.array([1.0, 1.0, 1.0, 0.02, 0.02])
        scaled = K / np.outer(lever, lever)
        assert np.abs(scaled - scaled.T).max() < 1e-9 * np.abs(scaled).max()


def test_work_of_the_load_is_stored():
    """Loading step by step: the sum of force times displacement is what the contacts store."""
    steps = np.linspace(0.0, 1.0, 41)[1:] ** 2
    options = StaticOptions(gyroscopic="none")
    e = elements(STEEP, speed=0.0)
    work, last, force = 0.0, np.zeros(5), np.zeros(5)
    for share in steps:
        load = Load(axial=2000.0 * share, radial=500.0 * share)
        s = solve_bearing(STEEP, load=load, options=options)
        work += 0.5 * (s.load + force) @ (s.displacement - last)
        last, force = s.displacement, s.load
    series = series_stiffness(*(c.stiffness for c in STEEP.contacts))
    stored = 0.4 * (s.elements.force[:, 0] ** (5.0 / 3.0)).sum() * series ** (-2.0 / 3.0)
    assert work == pytest.approx(stored, rel=2e-3)
    assert e.conservative


@pytest.mark.parametrize("angle", [12.0, 25.0, 40.0])
@pytest.mark.parametrize("force", [50.0, 4000.0])
def test_axial_load_has_a_closed_form(angle, force):
    """Harris: Fa = Z K A^1.5 sin(a) (cos(a0)/cos(a) - 1)^1.5, dx = A sin(a - a0)/cos(a)."""
    bearing = replace(BALLS, contact_angle=radians(angle))
    K, A, a0 = (
        series_stiffness(*(c.stiffness for c in bearing.contacts)), bearing.groove_distance,
        radians(angle),
    )  # fmt: skip

    def excess(a):
        squeeze = max(cos(a0) / cos(a) - 1.0, 0.0)
        return bearing.ball_count * K * (A * squeeze) ** 1.5 * sin(a) - force

    a = brentq(excess, a0, 1.4)
    s = solve_bearing(bearing, load=Load(axial=force))
    assert s.elements.angle == pytest.approx(np.full((18, 2), a), rel=1e-9)
    assert s.displacement[0] == pytest.approx(A * sin(a - a0) / cos(a), rel=1e-9)
    assert s.largest_force == pytest.approx(force / (bearing.ball_count * sin(a)), rel=1e-9)


def test_radial_load_without_clearance_is_sjoevalls():
    """Q_max = 4.37 F/Z for many balls (NSK catalogue), without clearance and axial load."""
    many = replace(DEEP, radial_clearance=0.0, ball_diameter=1e-3, ball_count=60,
                   inner_groove_radius=0.52e-3, outer_groove_radius=0.52e-3,
                   inner_shoulder=None, outer_shoulder=None)  # fmt: skip
    s = solve_bearing(many, load=Load(radial=60.0))
    assert s.largest_force == pytest.approx(4.37 * 60.0 / 60, rel=2e-3)


@pytest.mark.parametrize("gyroscopic", ["outer_race", "shared", "none"])
def test_every_ball_is_in_equilibrium(gyroscopic):
    """Balance written out from loads, angles and inertia alone, and that of the whole ring."""
    load = Load(axial=600.0, radial=150.0, direction=0.4)
    options = StaticOptions(gyroscopic=gyroscopic, tilt="held")
    s = solve_bearing(BALLS, load=load, speed=12000.0 * RPM, options=options)
    e, shares = s.elements, {"outer_race": (0, 2), "shared": (1, 1), "none": (0, 0)}[gyroscopic]
    friction = np.outer(e.gyroscopic, shares) / BALLS.ball_diameter
    Q, (si, so), (ci, co) = e.force, np.sin(e.angle).T, np.cos(e.angle).T
    axial = Q[:, 0] * si - friction[:, 0] * ci
    radial = Q[:, 0] * ci + friction[:, 0] * si
    assert axial == pytest.approx(Q[:, 1] * so - friction[:, 1] * co, abs=1e-7)
    assert radial + e.centrifugal == pytest.approx(Q[:, 1] * co + friction[:, 1] * so, abs=1e-7)
    assert axial.sum() == pytest.approx(600.0, rel=1e-9)
    assert (radial * np.cos(e.azimuth)).sum() == pytest.approx(150.0 * cos(0.4), rel=1e-8)
    assert (radial * np.sin(e.azimuth)).sum() == pytest.approx(150.0 * sin(0.4), rel=1e-8)
    assert e.friction[:, 1] == pytest.approx(friction[:, 1] / Q[:, 1])
    turning = BALLS.ball_mass * 0.5 * BALLS.pitch_diameter * e.orbital_speed**2
    assert e.centrifugal == pytest.approx(turning, rel=1e-3)


def test_the_load_turned_by_a_pitch_turns_everything():
    pitch = 2.0 * pi / 18
    load = {"axial": 500.0, "radial": 200.0}
    first = solve_bearing(BALLS, load=Load(**load), speed=9000 * RPM)
    turned = solve_bearing(BALLS, load=Load(**load, direction=pitch), speed=9000 * RPM)
    assert np.roll(first.elements.force, 1, axis=0) == pytest.approx(turned.elements.force)
    c, s = cos(pitch), sin(pitch)
    for k in (1, 3):
        rotated = np.array([[c, -s], [s, c]]) @ first.displacement[k : k + 2]
        assert turned.displacement[k : k + 2] == pytest.approx(rotated, rel=1e-7)
    assert turned.displacement[0] == pytest.approx(first.displacement[0], rel=1e-9)


def test_deep_groove_bears_axial_load_both_ways():
    one, other = (
        solve_bearing(DEEP, load=Load(axial=f, radial=100.0), speed=9000 * RPM)
        for f in (300.0, -300.0)
    )
    assert one.displacement[0] == pytest.approx(-other.displacement[0], rel=1e-9)
    assert one.elements.angle == pytest.approx(-other.elements.angle, rel=1e-7)


def test_unloaded_balls_lie_in_the_outer_groove():
    """At speed, and where nothing else holds them: the outer force is the centrifugal one."""
    loose = replace(DEEP, radial_clearance=30e-6)
    s = solve_bearing(loose, load=Load(radial=500.0), speed=9000 * RPM)
    free = s.elements.force[:, 0] == 0.0
    assert 2 <= free.sum() < 7
    assert s.elements.force[free, 1] == pytest.approx(s.elements.centrifugal[free], rel=1e-9)
    assert np.isnan(s.elements.angle[free, 0]).all()
    assert np.abs(s.elements.angle[free, 1]).max() < 1e-9


def test_preload_shares_loads_more_evenly():
    forces = [
        solve_bearing(replace(DEEP, radial_clearance=c), load=Load(radial=200.0)).elements.force
        for c in (10e-6, -25e-6)
    ]
    assert (forces[0] > 0.0).all(axis=1).sum() < (forces[1] > 0.0).all(axis=1).sum() == 7


def test_tilt_held_is_what_its_reaction_brings_about():
    """A moment set free at the tilt that it was the reaction of changes nothing."""
    load = {"axial": 900.0, "radial": 250.0}
    held = solve_bearing(
        BALLS, load=Load(**load, misalignment=2e-4), options=StaticOptions(tilt="held")
    )
    assert held.displacement[3:].tolist() == [0.0, 2e-4]
    moments = dict(zip(("moment_y", "moment_z"), held.reaction[3:].tolist()))
    free = solve_bearing(BALLS, load=Load(**load, **moments, tilt="free"))
    assert free.displacement == pytest.approx(held.displacement, rel=1e-7, abs=1e-15)


def test_tilted_rollers_by_a_direct_sum():
    """Straight rollers, tilt held: both races in series, slice by slice, without any unknowns."""
    straight = replace(ROLLERS, profile=RollerProfile(kind="straight"), radial_clearance=0.0)
    tilt, n = 1e-4, 16
    s = solve_bearing(
        straight, load=Load(radial=2000.0, misalignment=tilt), options=StaticOptions(tilt="held"),
        contacts=Contacts(race=PairSpec(slices=n)),
    )  # fmt: skip
    places = ((np.arange(n) + 0.5) / n - 0.5) * straight.effective_length
    psi = s.elements.azimuth[:, None]
    approach = s.displacement[1] * np.cos(psi) + places * tilt * np.cos(psi)
    stiffness = 35948.0 * 7.3 ** (8.0 / 9.0) * 1e3 ** (10.0 / 9.0) / n
    q = stiffness * np.maximum(approach, 0.0) ** (10.0 / 9.0)
    assert s.elements.force[:, 0] == pytest.approx(q.sum(axis=1), abs=1e-4 * 2000.0)
    assert (q * np.cos(psi)).sum() == pytest.approx(2000.0, rel=1e-4)
    moment = (q * places * np.cos(psi)).sum()
    assert s.reaction[4] == pytest.approx(moment, rel=1e-3) and moment > 0.0


def test_life_of_rollers_under_one_load_each():
    """Without clearance ISO/TS 16281 comes to (C/(0.83 F))^4 but for the stress riser at the ends
    of a straight profile, 1 - 0.01/ln(1.985 |2 k - n - 1|/(2 n - 2)), in its mean of power 4.5."""
    snug = replace(ROLLERS, radial_clearance=0.0, profile=RollerProfile(kind="straight"))
    place = np.abs(2.0 * np.arange(1, 17) - 17.0) / 30.0
    riser = np.mean((1.0 - 0.01 / np.log(1.985 * place)) ** 4.5) ** (8.0 / 9.0)
    for load in (2e3, 8e3):
        r = solve_bearing(snug, load=Load(radial=load)).ratings
        assert r.life == pytest.approx((r.dynamic / load) ** (10.0 / 3.0))
        expected = (r.dynamic / (0.83 * load)) ** 4.0 / riser
        assert r.reference_life == pytest.approx(expected, rel=0.05)


def test_life_of_balls_under_radial_load():
    snug = replace(DEEP, radial_clearance=0.0)
    r = solve_bearing(snug, load=Load(radial=300.0)).ratings
    assert r.reference_life / r.life == pytest.approx(1.0, abs=0.1)
    rated = solve_bearing(
        snug, load=Load(radial=300.0), options=StaticOptions(dynamic_rating=2.0 * r.dynamic)
    ).ratings
    assert rated.life == pytest.approx(8.0 * r.life)
    assert rated.reference_life == pytest.approx(8.0 * r.reference_life)


REFUSED = [
    (BALLS, {}, {}, ["bears no load"]),
    (ROLLERS, {"axial": 10.0, "radial": 10.0}, {}, ["load.axial is 10 N", "design N"]),
    (BALLS, {"axial": 9.0, "moment_z": 1.0}, {"tilt": "held"}, ["moment_z is 1 N*m", "reactions"]),
    (BALLS, {"axial": 9.0, "moment_z": 1.0}, {}, ["load.tilt is 'held'", 'load.tilt = "free"']),
    (BALLS, {"axial": 9.0, "misalignment": 1e-3}, {"tilt": "free"}, ["is 1 mrad", "'free'"]),
    (BALLS, {"axial": 9.0, "tilt_stiffness": 1e3}, {"tilt": "held"}, ["1000 N*m/rad", "'held'"]),
]


@pytest.mark.parametrize(("bearing", "load", "options", "words"), REFUSED)
def test_loads_that_do_not_fit(bearing, load, options, words):
    with pytest.raises(InputError) as caught:
        solve_bearing(bearing, load=Load(**load), options=StaticOptions(**options))
    assert all(word in str(caught.value) for word in words), str(caught.value)


def test_a_ring_that_falls_out_is_said_to():
    held = StaticOptions(tilt="held")
    for load in (Load(axial=-100.0), Load(radial=100.0)):
        with pytest.raises(InputError, match="cannot bear this load.*axial load"):
            solve_bearing(BALLS, load=load, options=held)
    # with clearance, a little axial load is borne at a smaller contact angle
    s = solve_bearing(BALLS, load=Load(axial=10.0, radial=100.0), options=held)
    assert 0.0 < np.nanmin(s.elements.angle) < 0.5 * BALLS.contact_angle
    assert np.nanmax(np.tan(s.elements.angle)) > 10.0 / 100.0 / 1.3


def test_too_little_axial_load_is_blamed_at_speed(recwarn):
    """Of 60 degree contacts a radial load needs more than its own size along the axis."""
    held = StaticOptions(tilt="held")
    with pytest.raises(RunFailed, match="the axial load too small for the radial one"):
        load = Load(axial=0.0, radial=3000.0)
        solve_bearing(STEEP, load=load, speed=4000.0 * RPM, options=held)
    standing = solve_bearing(STEEP, load=Load(axial=1.0, radial=50.0), options=held)
    assert (standing.elements.force[:, 0] > 0.0).sum() == 1  # others lie anywhere in their grooves
    assert not [w for w in recwarn if w.category is RuntimeWarning]  # of NumPy's, on the way


def test_an_ellipse_over_the_grooves_edge_is_warned_of():
    shallow = replace(BALLS, inner_shoulder=0.4e-3)
    s = solve_bearing(shallow, load=Load(axial=3000.0))
    (text,) = s.warnings
    angle, half = s.elements.angle[0, 0], s.elements.across[0, 0] / BALLS.inner_groove_radius
    over = np.degrees(angle + half - np.arccos(1.0 - 0.4 / 4.58))
    assert f"edge by {over:.2g} deg" in text and f"{s.largest_force:.4g} N" in text
    assert f"{np.degrees(angle):.4g} deg" in text and "inner groove" in text
    assert not solve_bearing(BALLS, load=Load(axial=3000.0)).warnings
    assert not solve_bearing(replace(BALLS, inner_shoulder=None), load=Load(axial=3e3)).warnings


def test_pressure_beyond_the_static_rating_is_warned_of():
    (text,) = solve_bearing(replace(DEEP, inner_shoulder=None, outer_shoulder=None),
                            load=Load(radial=9000.0)).warnings  # fmt: skip
    assert "4200 MPa" in text


@pytest.mark.parametrize(
    ("bearing", "load", "by"),
    [(ROLLERS, Load(radial=9.0), "rollers on races by ISO/TS 16281"),
     (BALLS, Load(axial=300.0), "balls on races by Hertz")],
)  # fmt: skip
def test_a_race_law_of_ones_own_is_not_passed_over(bearing, load, by):
    from flexcage.contacts.spec import NormalLaw, OwnImpact

    for law in (replace(NormalLaw(), law="spring"), OwnImpact(damping=1e4)):
        with pytest.raises(InputError, match=f"law is '{law.law}', but a static solution has {by}"):
            solve_bearing(bearing, load=load, contacts=Contacts(race=PairSpec(normal=law)))
    same = PairSpec(normal=NormalLaw(law="lankarani_nikravesh"))
    found = solve_bearing(bearing, load=load, contacts=Contacts(race=same))
    assert (found.displacement == solve_bearing(bearing, load=load).displacement).all()
