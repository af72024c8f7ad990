"""The static solution of tapered rollers: closed forms, and a solver that knows nothing of levers.

That solver places rollers and inner ring in the plane of each roller by rotation matrices, measures
how deep their points lie in cones, and lets scipy find the least energy.
"""

from dataclasses import dataclass, replace
from math import cos, pi, sin, tan

import numpy as np
import pytest
from grains import inertia_of
from scipy.optimize import minimize
from tapered_bearings import BEARING

from flexcage.bearings import statics_of
from flexcage.contacts.spec import Contacts
from flexcage.core.errors import InputError
from flexcage.geometry.rollers import RollerProfile
from flexcage.spec import RollerBearing
from flexcage.system.spec import Load
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.solve import solve_bearing

RPM = pi / 30.0
STRAIGHT = replace(BEARING, profile=RollerProfile(kind="straight"))
STIFF_RIB = replace(Contacts(), rib=replace(
    Contacts().rib, normal=replace(Contacts().rib.normal, stiffness_factor=1e4)))  # fmt: skip


def elements(bearing=BEARING, speed=0.0, contacts=None):
    return statics_of(bearing)(
        bearing, speed=speed, contacts=contacts or Contacts(), options=StaticOptions()
    )


def solved(bearing=BEARING, *, speed=0.0, contacts=None, options=None, **load):
    return solve_bearing(
        bearing, statics_of(bearing), load=Load(**load), speed=speed, contacts=contacts,
        options=options,
    )  # fmt: skip


def pressed(e):
    rng = np.random.default_rng(3)
    Z = len(e.azimuth)
    v = np.stack([rng.uniform(0.0, 40e-6, Z), rng.uniform(-20e-6, 20e-6, Z),
                  rng.uniform(-2e-4, 2e-4, Z)], axis=1)  # fmt: skip
    return v, e.guesses(v)[1] + rng.uniform(-4e-6, 4e-6, (Z, 3))


def test_forces_of_tapered_rollers_are_slopes_of_their_energy_and_tangents_those_of_forces():
    e = elements(speed=6000 * RPM)
    v, w = pressed(e)
    r, h = e.respond(v, w, 0.0), 1e-9
    assert (e.rib_forces(v, w) > 0.0).sum() > 3
    for k in range(6):
        step_v, step_w = np.zeros(3), np.zeros(3)
        (step_v if k < 3 else step_w)[k % 3] = h
        up, down = (e.respond(v + s * step_v, w + s * step_w, 0.0) for s in (1.0, -1.0))
        force = r.ring[:, k] if k < 3 else r.unbalance[:, k - 3]
        found = (up.energy - down.energy) / (2.0 * h)
        assert found == pytest.approx(force, abs=1e-3 * np.abs(force).max())
        for name, slope_v, slope_w in (
            ("ring", r.ring_v, r.ring_w), ("unbalance", r.unbalance_v, r.unbalance_w),
        ):  # fmt: skip
            slope = slope_v[:, :, k] if k < 3 else slope_w[:, :, k - 3]
            found = (getattr(up, name) - getattr(down, name)) / (2.0 * h)
            # where a contact opens within the difference the slope of d^(10/9) is not defined
            assert np.quantile(np.abs(found - slope), 0.95) <= 2e-3 * np.abs(slope).max()


@pytest.mark.parametrize("bearing", [BEARING, replace(BEARING, end_radius=30e-3)])
def test_pure_axial_load_is_that_of_a_wedge(bearing):
    """Z rollers share it alike: Q_o = F/(Z sin(alpha)). Along and across a roller's axis,
    R cos(eta) = (Q_i + Q_o) sin(eps) and (Q_o - Q_i) cos(eps) = R sin(eta)."""
    s, b = solved(bearing, axial=3000.0), bearing
    e, eps, eta = s.elements, b.half_angle, b.rib_angle
    outer = 3000.0 / (17 * sin(b.contact_angle))
    both = tan(eta) * tan(eps)
    inner = outer * (1.0 - both) / (1.0 + both)
    rib = (inner + outer) * sin(eps) / cos(eta)
    assert e.force == pytest.approx(np.tile([inner, outer], (17, 1)), rel=1e-9)
    assert e.axial == pytest.approx(rib * cos(b.axis_angle - eta), rel=1e-9)
    # and the inner ring's own balance: its race and its rib bear the load
    assert 17 * inner * sin(b.race_angles[0]) + e.axial.sum() == pytest.approx(3000.0)


def test_an_axial_load_closes_rollers_as_their_compliances_say():
    """Straight rollers, all slices alike but for tilt: with the rib all but rigid and rollers held
    by three forces through one point, the ring's way is that of two line contacts."""
    s = solved(STRAIGHT, axial=3000.0, contacts=STIFF_RIB)
    b, e = STRAIGHT, s.elements
    moment = elements(b, contacts=STIFF_RIB)
    line = (
        moment.stiffness[0] * 41 if len(moment.stiffness) == 83 else moment.stiffness[:-1].sum() / 2
    )
    depth = (e.force[0] / line) ** 0.9
    # energy of the ring's way: F x = sum of forces times depths, n/(n+1) of it stored alike
    worked = (e.force[0] * depth).sum() * 17
    assert 3000.0 * s.displacement[0] == pytest.approx(worked, rel=2e-3)


@dataclass
class Placed:
    """One roller in its plane: energies of points in cones, by rotations and distances."""

    bearing: object
    slices: int
    line: float
    point: float

    def __post_init__(self):
        b = self.bearing
        beta, half = b.axis_angle, 0.5 * b.effective_length
        self.x = (np.arange(self.slices) + 0.5) / self.slices * 2.0 * half - half
        self.drop = b.profile.drop(self.x, diameter=b.roller_diameter, length=2.0 * half)
        self.frame = np.array([[cos(beta), sin(beta)], [-sin(beta), cos(beta)]])  # columns s, t
        self.apex = 0.5 * b.pitch_diameter / tan(beta)

    def on_cone(self, points, half_angle):
        """Distance outwards (n,) of points (2, n) in (x, r) from a cone about the axis."""
        return points[1] * cos(half_angle) - (self.apex - points[0]) * sin(half_angle)

    def energy(self, ring, roller, push):
        b = self.bearing
        s, t, turn = roller
        tilt = self.frame @ rotation(turn / (0.5 * b.effective_length)) @ np.eye(2)
        middle = np.array([0.0, b.pitch_radius]) + self.frame @ [s, t]
        radius = 0.5 * b.roller_diameter - self.x * tan(b.half_angle)
        bottom, top = (
            middle[:, None] + tilt @ np.stack([self.x, sign * radius]) for sign in (-1.0, 1.0)
        )
        back = rotation(ring[2]).T
        seen = back @ (bottom - np.array(ring[:2])[:, None])  # in the ring's own frame
        inner = np.maximum(-self.on_cone(seen, b.race_angles[0]) - self.drop, 0.0)
        outer = np.maximum(self.on_cone(top, b.contact_angle) - self.drop, 0.0)
        # the sphere's centre over the rib's straight generatrix
        place = -0.5 * b.roller_length + b.end_radius
        centre = back @ (middle + tilt @ [place, 0.0] - np.array(ring[:2]))
        normal = self.frame @ [cos(b.rib_angle), sin(b.rib_angle)]
        on_rib = np.array([0.0, b.pitch_radius]) + self.frame @ list(b.rib_place)
        rib = max(b.end_radius - normal @ (centre - on_rib), 0.0)
        stored = self.line / self.slices * (inner ** (19 / 9) + outer ** (19 / 9)).sum() * 9 / 19
        return stored + 0.4 * self.point * rib**2.5 - float(push @ roller)

    def settled(self, ring, push):
        """Least energy at a place of the ring, and the roller there."""
        best = minimize(
            lambda um: 1e6 * self.energy(ring, 1e-6 * um, push), np.zeros(3), method="Nelder-Mead",
            options={"xatol": 1e-7, "fatol": 1e-13, "maxiter": 4000},
        )  # fmt: skip
        return 1e-6 * best.x


def rotation(angle):
    return np.array([[cos(angle), -sin(angle)], [sin(angle), cos(angle)]])


@pytest.mark.parametrize(
    ("speed", "load"),
    [
        (0.0, {"axial": 800.0, "radial": 1000.0}),
        (0.0, {"axial": 500.0, "radial": 1500.0, "misalignment": 3e-4}),
        (9000.0, {"axial": 400.0, "radial": 500.0}),
    ],
)
def test_combined_loads_against_another_solver(speed, load):
    """At the ring's place, every roller finds the same rest, and all of them bear the load."""
    b, options = BEARING, StaticOptions(tilt="held")
    s = solved(b, speed=speed * RPM, options=options, **load)
    e = elements(b, speed=speed * RPM)
    n = (len(e.stiffness) - 1) // 2
    placed = Placed(b, n, e.stiffness[0] * n, e.stiffness[-1])
    total, h, u = np.zeros(3), 1e-9, s.displacement
    for k, psi in enumerate(e.azimuth):
        ring = np.array(
            [u[0], u[1] * cos(psi) + u[2] * sin(psi), u[4] * cos(psi) - u[3] * sin(psi)]
        )
        roller = placed.settled(ring, e.push)
        for j in range(2):  # force of the ring on it: slopes where it rests
            step = np.eye(3)[j] * h
            up, down = (placed.energy(ring + sign * step, roller, e.push) for sign in (1.0, -1.0))
            total[j] += (up - down) / (2.0 * h) * (cos(psi) if j else 1.0)
        loose = minimum_moved(placed, ring, roller, e.push)
        assert loose >= -1e-9
        assert s.elements.force[k, 1] == pytest.approx(
            outer_force(placed, ring, roller), rel=3e-3, abs=1.0
        )
    assert total[0] == pytest.approx(load["axial"], rel=3e-3)
    assert total[1] == pytest.approx(load["radial"], rel=3e-3)


def outer_force(placed, ring, roller):
    b = placed.bearing
    middle = np.array([0.0, b.pitch_radius]) + placed.frame @ roller[:2]
    tilt = placed.frame @ rotation(roller[2] / (0.5 * b.effective_length))
    radius = 0.5 * b.roller_diameter - placed.x * tan(b.half_angle)
    top = middle[:, None] + tilt @ np.stack([placed.x, radius])
    depth = np.maximum(placed.on_cone(top, b.contact_angle) - placed.drop, 0.0)
    return placed.line / placed.slices * (depth ** (10 / 9)).sum()


def minimum_moved(placed, ring, roller, push):
    """How much lower the energy is nearby [J]: nothing, at a minimum."""
    rng = np.random.default_rng(1)
    here = placed.energy(ring, roller, push)
    return min(
        placed.energy(ring, roller + rng.normal(size=3) * 1e-8, push) - here for _ in range(20)
    )


def test_load_is_shared_as_sjoevall_has_it():
    """With stiff ribs a roller is two line contacts in series, pressed by how far the ring moves
    along the contact's normal: Q = Qmax (1 - (1 - cos psi)/(2 load zone))^(10/9), and radial and
    axial loads are sums of it over the rollers."""
    b = STRAIGHT
    s = solved(b, axial=900.0, radial=1500.0, contacts=STIFF_RIB)
    psi, u = s.elements.azimuth, s.displacement
    zone = 0.5 * (1.0 + u[0] * tan(b.contact_angle) / u[1])
    share = np.maximum(1.0 - (1.0 - np.cos(psi)) / (2.0 * zone), 0.0) ** (10 / 9)
    sums = share.sum(), (share * np.cos(psi)).sum()
    assert 1500.0 * tan(b.contact_angle) / 900.0 == pytest.approx(sums[1] / sums[0], rel=5e-3)
    largest = 900.0 / (sin(b.contact_angle) * sums[0])
    assert s.elements.force[:, 1] == pytest.approx(largest * share, rel=0.01, abs=0.01 * largest)


def test_what_speed_exerts_is_the_inertia_of_every_grain():
    """A roller cut into grains that turn about its axis while that goes round: less mass times
    acceleration, by second differences of where rotations take each grain."""
    b, speed = BEARING, 8000 * RPM
    e, found = elements(b, speed), b.roller
    n = 24
    x = (np.arange(n) + 0.5) / n * b.roller_length - 0.5 * b.roller_length
    share, turn = (np.arange(n) + 0.5) / n, 2.0 * pi * np.arange(12) / 12
    X, S, T = (a.ravel() for a in np.meshgrid(x, share, turn, indexing="ij"))
    R = np.array([found.radius(at) for at in X])
    mass = b.rolling_material.density * R**2 * S
    mass *= b.roller.volume / (R**2 * S).sum()
    own = np.stack([X, R * S * np.cos(T), R * S * np.sin(T)])  # along s, t, and e_psi
    push, moment = inertia_of(own, mass, b.axis_angle, b.pitch_radius, e.rolling)
    moment /= 0.5 * b.effective_length
    assert push == pytest.approx(e.push[:2], rel=2e-3)
    assert moment == pytest.approx(e.push[2], rel=5e-3)
    assert e.gyroscopic < 0.0 < e.centrifugal


def test_centrifugal_force_presses_on_cup_and_rib():
    """At speed, rollers that the inner ring leaves alone rest on the outer race and the rib."""
    s = solved(speed=15000 * RPM, axial=240.0, radial=500.0)
    free = s.elements.force[:, 0] == 0.0
    assert 3 < free.sum() < 14
    b, e = BEARING, elements(speed=15000 * RPM)
    push, eps, eta = e.push, b.half_angle, b.rib_angle
    # along the roller's axis and across it: the rib R, the cup Q
    balance = [[-sin(eps), cos(eta)], [-cos(eps), sin(eta)]]
    outer, rib = np.linalg.solve(balance, -push[:2])
    assert s.elements.force[free, 1] == pytest.approx(outer, rel=1e-6)
    assert s.elements.axial[free] == pytest.approx(rib * cos(b.axis_angle - eta), rel=1e-6)


def test_small_angles_tend_to_a_cylindrical_roller_bearing():
    """Hardly tapered rollers, held axially, bear a radial load as cylinders without clearance."""
    b = replace(STRAIGHT, contact_angle=1e-3, end_radius=0.1)
    cylinders = RollerBearing(
        bore=b.bore, outside_diameter=b.outside_diameter, width=b.width,
        inner_race_diameter=b.pitch_diameter - b.roller_diameter,
        outer_race_diameter=b.pitch_diameter + b.roller_diameter,
        roller_diameter=b.roller_diameter, roller_length=b.roller_length,
        effective_length=b.effective_length, roller_count=17, rib_diameter=36e-3,
        rib_gap=9.53e-3, profile=b.profile,
    )  # fmt: skip
    e, other = (
        elements(b),
        solve_bearing(cylinders, statics_of(cylinders), load=Load(radial=2000.0)),
    )
    psi, moved = e.azimuth, other.displacement[1]
    v = np.stack([0.0 * psi, moved * np.cos(psi), 0.0 * psi], axis=1)
    w = np.column_stack([0.0 * psi, 0.5 * np.maximum(v[:, 1], 0.0), 0.0 * psi])
    assert e.loads(v, w).force[:, 0] == pytest.approx(other.elements.force[:, 0], rel=2e-3, abs=1.0)
    assert b.static_rating == pytest.approx(cylinders.static_rating, rel=1e-3)


def test_lives_stand_to_ratings_as_those_of_cylindrical_rollers():
    """Half of the rollers loaded, ISO 281's case: L10r of unstressed ends is that of the same
    bearing with cylinders, to what their numbers of rollers make."""
    b = STRAIGHT
    s = solved(b, radial=3000.0, axial=1.22 * 3000.0 * tan(b.contact_angle), speed=1000 * RPM)
    assert s.loaded == 9 and s.ratings.equivalent_load == 3000.0
    assert 1.4 < s.ratings.reference_life / s.ratings.life < 2.0
    half = solved(b, radial=1500.0, axial=0.61 * 3000.0 * tan(b.contact_angle), speed=1000 * RPM)
    assert half.ratings.life / s.ratings.life == pytest.approx(2.0 ** (10 / 3))


def test_frequencies_are_those_of_cones_that_roll():
    """Races of half angles alpha_i and alpha_o: the cage turns at sin(alpha_i)/(sin(alpha_i) +
    sin(alpha_o)) of the inner ring's speed."""
    s, b = solved(axial=2000.0, radial=1500.0, speed=3000 * RPM), BEARING
    inner, outer = map(sin, b.race_angles)
    cage = 50.0 * inner / (inner + outer)
    rolls = (50.0 - cage) * inner / sin(b.half_angle)
    for found in (s.frequencies, s.nominal_frequencies):
        assert found["FTF"] == pytest.approx(cage)
        assert found["BPFO"] == pytest.approx(17 * cage)
        assert found["BSF"] == pytest.approx(rolls)


def test_too_little_axial_load_for_the_radial_one_is_told():
    with pytest.raises(InputError, match="the bearing cannot bear this load"):
        solved(axial=0.0, radial=2000.0)


def test_at_speed_a_least_axial_load_keeps_rollers_on_the_inner_race():
    """Below it the rollers, thrown into the cup and out of it against the rib, push the ring off:
    Q sin(alpha) = R cos(beta - eta), F_c = Q cos(alpha) + R sin(beta - eta), F = Z Q sin(alpha)."""
    b, speed = BEARING, 12000 * RPM
    e, rib = elements(speed=speed), BEARING.axis_angle - BEARING.rib_angle
    outer = e.centrifugal / (cos(b.contact_angle) + sin(b.contact_angle) * tan(rib))
    least = 17 * outer * sin(b.contact_angle)
    assert 30.0 < least < 100.0
    found = solved(axial=1.02 * least, speed=speed)
    assert 0.0 < found.elements.force[:, 0].max() < 0.05 * outer
    with pytest.raises(InputError, match="axial load towards"):
        solved(axial=0.98 * least, speed=speed)
