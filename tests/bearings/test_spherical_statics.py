"""The static solution of spherical roller bearings: closed forms, and solvers in ``barrels``."""

from dataclasses import replace
from math import cos, pi, sin, sqrt, tan

import numpy as np
import pytest
from barrels import Centres, energy_of, rotated
from grains import inertia_of
from scipy.integrate import quad
from scipy.optimize import brentq, minimize
from spherical_bearings import BEARING, TIGHT

from flexcage.bearings import statics_of
from flexcage.contacts.spec import Contacts
from flexcage.core.errors import InputError
from flexcage.geometry.hertz import PointContact
from flexcage.system.spec import Load
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.solve import solve_bearing

RPM = pi / 30.0
HELD = StaticOptions(tilt="held")
# races that fit the barrels all but exactly: lines of contact
LINES = replace(TIGHT, barrel_radius=(1.0 - 1e-7) * TIGHT.sphere_radius,
                inner_groove_radius=TIGHT.sphere_radius)  # fmt: skip


def solved(bearing=BEARING, *, speed=0.0, options=None, contacts=None, **load):
    return solve_bearing(
        bearing, statics_of(bearing), load=Load(**load), speed=speed, options=options,
        contacts=contacts,
    )  # fmt: skip


def rows_of_barrels(bearing=BEARING, speed=0.0):
    return statics_of(bearing)(bearing, speed=speed, contacts=Contacts(), options=StaticOptions())


def test_forces_of_barrels_are_slopes_of_their_energy_and_tangents_those_of_forces():
    rows = rows_of_barrels(speed=6000 * RPM)
    rng, count, h = np.random.default_rng(3), 32, 1e-9
    v = np.stack([rng.uniform(-30e-6, 60e-6, count), rng.uniform(0.0, 40e-6, count),
                  rng.uniform(-2e-4, 2e-4, count)], axis=1)  # fmt: skip
    w = rows.guesses(v)[1] + rng.uniform(-4e-6, 4e-6, (count, 3))
    r = rows.respond(v, w, 0.0)
    for k in range(6):
        step_v, step_w = np.zeros(3), np.zeros(3)
        (step_v if k < 3 else step_w)[k % 3] = h
        up, down = (rows.respond(v + s * step_v, w + s * step_w, 0.0) for s in (1.0, -1.0))
        force = r.ring[:, k] if k < 3 else r.unbalance[:, k - 3]
        found = (up.energy - down.energy) / (2.0 * h)
        assert found == pytest.approx(force, abs=1e-3 * np.abs(force).max())
        for name, slope_v, slope_w in (
            ("ring", r.ring_v, r.ring_w), ("unbalance", r.unbalance_v, r.unbalance_w),
        ):  # fmt: skip
            slope = slope_v[:, :, k] if k < 3 else slope_w[:, :, k - 3]
            found = (getattr(up, name) - getattr(down, name)) / (2.0 * h)
            # where a slice opens within the difference the slope of d^(10/9) is not defined
            assert np.quantile(np.abs(found - slope), 0.95) <= 2e-3 * np.abs(slope).max()


@pytest.mark.parametrize(
    ("bearing", "load", "near"),
    [
        (TIGHT, (40.0, 150.0), 1e-3), (BEARING, (0.0, 5000.0), 3e-3),
        (BEARING, (1500.0, 4000.0), 0.01), (BEARING, (-2500.0, 2000.0), 0.013),
    ],
)  # fmt: skip
def test_springs_between_centres_find_the_same_place(bearing, load, near):
    """The static solution leaves out that an axial displacement of 0.1 mm turns lines of contact by
    0.08 degrees: 0.7 % of that displacement, and of forces."""
    s = solved(bearing, axial=load[0], radial=load[1], direction=0.3)
    other = Centres(bearing, Contacts().race.slices)
    due = np.array([load[0], load[1] * cos(0.3), load[1] * sin(0.3)])
    u = other.solved(due, np.eye(3), s.displacement[:3] * 1.1 + 1e-7)
    assert u == pytest.approx(s.displacement[:3], rel=near, abs=3e-8)
    forces, lines = other.forces(u, np.eye(3))
    assert s.elements.force[:, 0] == pytest.approx(forces, rel=near, abs=near * forces.max())
    angles = np.degrees(np.arcsin(lines[:, 0]))
    loaded = forces > 100.0
    assert np.degrees(s.elements.angle[loaded, 1]) == pytest.approx(angles[loaded], abs=0.1)


def test_an_inner_ring_tilts_freely():
    """No moment, and the same forces, whatever the tilt; the other solver turns the ring by as
    much through finite angles, and the load with it."""
    straight = solved(radial=5000.0, axial=800.0)
    tilted = solved(radial=5000.0, axial=800.0, options=HELD, misalignment=15e-3)
    assert tilted.elements.force == pytest.approx(straight.elements.force, rel=1e-9, abs=1e-6)
    assert np.abs(tilted.reaction[3:]).max() < 1e-9
    stiffness = straight.stiffness
    arm = 0.5 * BEARING.pitch_diameter
    assert np.abs(stiffness[3:]).max() < 1e-9 * stiffness[1, 1] * arm**2
    other, turn = Centres(BEARING, Contacts().race.slices), rotated(0.0, 15e-3)
    u = other.solved(turn @ [800.0, 5000.0, 0.0], turn, turn @ straight.displacement[:3])
    forces = other.forces(u, turn)[0]
    assert tilted.elements.force[:, 0] == pytest.approx(forces, rel=5e-3, abs=3.0)
    assert solved(radial=5000.0, axial=800.0).displacement[3:] == pytest.approx([0.0, 0.0])


def test_a_radial_load_is_shared_by_both_rows_alike():
    e = solved(TIGHT, radial=6000.0).elements
    first, second = e.force[:16], e.force[16:]
    assert first == pytest.approx(second, rel=1e-9, abs=1e-9)
    loaded = first[:, 0] > 0.0
    assert e.angle[:16][loaded] == pytest.approx(-e.angle[16:][loaded], rel=1e-9)
    borne = (e.force[:, 0] * np.cos(e.azimuth)).sum() * cos(TIGHT.contact_angle)
    assert borne == pytest.approx(6000.0, rel=1e-9)


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_an_axial_load_is_borne_by_one_row(sign):
    """Q = F/(Z sin(alpha)), and the other row has none."""
    e = solved(axial=sign * 3000.0).elements
    loaded, idle = (slice(16, 32), slice(0, 16))[:: int(sign)]
    due = 3000.0 / (16 * sin(BEARING.contact_angle))
    assert e.force[loaded] == pytest.approx(due, rel=1e-9)
    assert not e.force[idle].any()
    assert e.angle[loaded] == pytest.approx(sign * BEARING.contact_angle, rel=1e-9)


def test_play_is_the_radial_clearance():
    """And across the axis it is that over tan(alpha)."""
    loose = replace(TIGHT, radial_clearance=30e-6)
    tight, found = solved(TIGHT, radial=0.2), solved(loose, radial=0.2)
    assert found.displacement[1] - tight.displacement[1] == pytest.approx(15e-6, rel=0.01)
    tight, found = solved(TIGHT, axial=0.2), solved(loose, axial=0.2)
    moved = found.displacement[0] - tight.displacement[0]
    assert moved == pytest.approx(15e-6 / tan(TIGHT.contact_angle), rel=0.01)


def test_lines_of_contact_share_a_radial_load_as_stribeck_has_it():
    """Half of each row bears, Q = Qmax cos(psi)^(10/9); by the integral for many rollers
    Qmax = 4.08 Fr/(i Z cos(alpha))."""
    s = solved(LINES, radial=6000.0)
    psi = s.elements.azimuth
    share = np.maximum(np.cos(psi), 0.0) ** (10 / 9)
    largest = s.elements.force.max()
    assert s.elements.force[:, 0] == pytest.approx(largest * share, rel=2e-3, abs=1e-3 * largest)
    many = quad(lambda a: cos(a) ** (19 / 9), -0.5 * pi, 0.5 * pi)[0] / (2.0 * pi)
    assert 1.0 / many == pytest.approx(4.08, abs=0.01)
    due = 6000.0 / (many * 32 * cos(LINES.contact_angle))
    assert largest == pytest.approx(due, rel=0.01)


def test_lines_of_contact_share_combined_loads_as_sjoevall_has_it():
    """Q = Qmax (1 - (1 - cos psi)/(2 zone))^(10/9) with a zone of each row's own."""
    s = solved(LINES, radial=4000.0, axial=600.0)
    e, u, total = s.elements, s.displacement, np.zeros(2)
    for part, sense in ((slice(0, 16), -1.0), (slice(16, 32), 1.0)):
        psi = e.azimuth[part]
        zone = 0.5 * (1.0 + sense * u[0] * tan(LINES.contact_angle) / u[1])
        share = np.maximum(1.0 - (1.0 - np.cos(psi)) / (2.0 * zone), 0.0) ** (10 / 9)
        largest = e.force[part].max()
        assert e.force[part, 1] == pytest.approx(largest * share, rel=0.01, abs=0.01 * largest)
        total += largest * np.array([(share * np.cos(psi)).sum(), sense * share.sum()])
    angle = LINES.contact_angle
    assert total * [cos(angle), sin(angle)] == pytest.approx([4000.0, 600.0], rel=5e-3)


def test_little_loads_are_those_of_arcs_on_arcs():
    """Slices within d of a parabola bear in sum d^(10/9 + 1/2), so that a row's share is
    cos(psi)^(29/18)."""
    fine = replace(Contacts(), race=replace(Contacts().race, slices=400))
    s = solved(TIGHT, radial=60.0, contacts=fine)
    share = np.maximum(np.cos(s.elements.azimuth), 0.0) ** (29 / 18)
    largest = s.elements.force.max()
    assert s.elements.force[:, 0] == pytest.approx(largest * share, rel=0.02, abs=0.01 * largest)


@pytest.mark.parametrize("race", [0, 1])
@pytest.mark.parametrize("load", [100.0, 400.0])
def test_slices_bear_about_as_the_ellipse_of_hertz_does(race, load):
    """Until it reaches the barrel's ends, at 0.8 kN of a 22208: approach within 9 %, pressure
    within 7 %; slices reach 10 to 17 % further."""
    fine = Centres(BEARING, 2000)
    rho, across = BEARING.profile_radii[race], BEARING.curvature_radii[race]
    contact = PointContact(rolling=across, transverse=rho, modulus=BEARING.race_modulus)
    radius = (BEARING.inner_groove_radius, BEARING.sphere_radius)[race]
    depth = brentq(lambda d: fine.on_race(radius, d) - load, 1e-9, 1e-4, xtol=1e-15)
    assert depth == pytest.approx((load / contact.stiffness) ** (2 / 3), rel=0.09)
    reach = sqrt(2.0 * rho * depth)
    assert 1.09 < reach / contact.semi_axes(load)[0] < 1.18
    assert reach < 0.5 * BEARING.effective_length
    per_length = fine.line * 2000 / BEARING.effective_length * depth ** (10 / 9)
    pressure = sqrt(per_length * 0.5 * BEARING.race_modulus / (pi * across))
    assert pressure == pytest.approx(contact.pressure(load), rel=0.07)


def test_the_ellipse_truncates_under_a_moderate_load():
    contact = PointContact(
        rolling=BEARING.curvature_radii[0], transverse=BEARING.profile_radii[0],
        modulus=BEARING.race_modulus,
    )  # fmt: skip
    half = 0.5 * BEARING.effective_length
    load = brentq(lambda q: contact.semi_axes(q)[0] - half, 1.0, 1e4)
    assert load == pytest.approx(800.0, rel=0.02)
    largest = 5.0 * BEARING.static_rating / (32 * cos(BEARING.contact_angle))  # at C0, ISO 76
    assert load < 0.06 * largest
    e = solved(radial=5000.0).elements
    assert e.force.max() > load and np.nanmax(e.across) == pytest.approx(half)


def test_barrels_at_speed_rest_where_their_energy_is_least():
    """Inertia presses a barrel on the sphere, and along that towards the bearing's middle."""
    speed, load = 9000 * RPM, {"axial": 200.0, "radial": 1500.0}
    s = solved(speed=speed, **load)
    rows = rows_of_barrels(speed=speed)
    push = rows.rows[1].elements.push
    u, total = s.displacement, np.zeros(2)
    for k in range(16, 32):
        psi = s.elements.azimuth[k]
        ring = np.array([u[0], u[1] * cos(psi) + u[2] * sin(psi), 0.0])

        def at(um, ring=ring):
            return 1e6 * energy_of(BEARING, ring, 1e-6 * um, push)[0]

        best = minimize(at, np.zeros(3), method="Nelder-Mead",
                        options={"xatol": 1e-7, "fatol": 1e-13, "maxiter": 6000})  # fmt: skip
        found = energy_of(BEARING, ring, 1e-6 * best.x, push)[1]
        assert s.elements.force[k] == pytest.approx(found, rel=0.01, abs=2.0)
        total += found
    assert total[1] > total[0] + 15 * rows.rows[1].elements.centrifugal


def test_what_speed_exerts_on_barrels_is_the_inertia_of_every_grain():
    """A barrel cut into grains that turn about its axis while that goes round: less mass times
    acceleration, by second differences of where rotations take each grain."""
    b, speed = BEARING, 8000 * RPM
    e = rows_of_barrels(speed=speed).rows[1].elements
    n = 24
    x = (np.arange(n) + 0.5) / n * b.roller_length - 0.5 * b.roller_length
    share, turn = (np.arange(n) + 0.5) / n, 2.0 * pi * np.arange(12) / 12
    X, S, T = (a.ravel() for a in np.meshgrid(x, share, turn, indexing="ij"))
    R = 0.5 * b.roller_diameter - b.barrel_radius + np.sqrt(b.barrel_radius**2 - X**2)
    mass = R**2 * S
    mass *= b.element_mass / mass.sum()
    own = np.stack([X, R * S * np.cos(T), R * S * np.sin(T)])  # along s, t, and e_psi
    push, moment = inertia_of(own, mass, b.contact_angle, b.pitch_radius, e.rolling)
    moment /= 0.5 * b.effective_length
    assert push == pytest.approx(e.push[:2], rel=2e-3)
    assert moment == pytest.approx(e.push[2], rel=5e-3)


def test_lives_of_spherical_rollers_stand_to_the_standards():
    """Half of the rollers loaded in both rows, ISO 281's case: L10r of unstressed ends is that of
    the same bearing with lines of contact, to what their numbers of rollers make."""
    s = solved(LINES, radial=8000.0, speed=1000 * RPM)
    assert s.ratings.equivalent_load == pytest.approx(8000.0)
    assert 1.3 < s.ratings.reference_life / s.ratings.life < 2.2
    barrels = solved(TIGHT, radial=8000.0, speed=1000 * RPM)  # whose ends bear less
    assert barrels.ratings.reference_life > s.ratings.reference_life


def test_frequencies_of_spherical_rollers_are_those_of_pure_rolling():
    s, b = solved(radial=4000.0, axial=500.0, speed=3000 * RPM), BEARING
    cage = 25.0 * (1.0 - b.gamma)
    for found in (s.frequencies, s.nominal_frequencies):
        assert found["FTF"] == pytest.approx(cage)
        assert found["BPFO"] == pytest.approx(16 * cage)
        assert found["BPFI"] == pytest.approx(16 * (50.0 - cage))


def test_moments_on_a_spherical_roller_bearing_are_refused():
    said = "load.moment_z is 5 N\\*m, but a spherical roller .* the shaft's load.tilt_stiffness"
    with pytest.raises(InputError, match=said):
        solved(radial=1e3, moment_z=5.0)
    shaft = solved(radial=1e3, moment_z=5.0, tilt="free", tilt_stiffness=1e4)
    assert shaft.displacement[4] == pytest.approx(5.0 / 1e4, rel=1e-6)


def test_halves_of_the_slices_change_little():
    few, many = (
        solved(radial=5000.0, contacts=replace(Contacts(), race=replace(Contacts().race, slices=n)))
        for n in (20, 80)
    )
    assert few.displacement[1] == pytest.approx(many.displacement[1], rel=5e-3)
    assert few.largest_force == pytest.approx(many.largest_force, rel=5e-3)
