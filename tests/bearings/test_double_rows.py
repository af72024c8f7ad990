"""Two rows between the same rings: equilibrium, ratings and lives, against a solver of its own,
single rows, closed forms and the standard's tables."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from scipy.optimize import brentq, minimize

import flexcage
from flexcage.bearings import statics_of
from flexcage.bearings.ball.ratings import static_factor
from flexcage.bearings.double_row_ball.rules import self_aligning_factor
from flexcage.case import catalogue
from flexcage.case.new import new_case
from flexcage.case.static import StaticCase
from flexcage.cli import main
from flexcage.contacts.spec import Contacts
from flexcage.render import section_picture
from flexcage.spec import (
    AngularContactBallBearing,
    DoubleRowAngularContactBallBearing,
    DoubleRowRollerBearing,
    Drive,
    Load,
    RollerBearing,
    SelfAligningBallBearing,
    StaticOptions,
)

MM, UM = 1e-3, 1e-6
BALLS = dict(
    bore=25 * MM, outside_diameter=52 * MM, width=20.6 * MM, pitch_diameter=38.5 * MM,
    ball_diameter=7.938 * MM, ball_count=9, inner_groove_radius=4.1 * MM,
    outer_groove_radius=4.2 * MM, contact_angle=np.radians(30.0),
)  # fmt: skip
PAIR = DoubleRowAngularContactBallBearing(**BALLS, row_distance=9.5 * MM)
SINGLE = AngularContactBallBearing(**BALLS)
ALIGNING = SelfAligningBallBearing(
    bore=25 * MM, outside_diameter=52 * MM, width=15 * MM, pitch_diameter=38.5 * MM,
    ball_diameter=7.5 * MM, ball_count=12, inner_groove_radius=3.975 * MM, row_distance=7 * MM,
)  # fmt: skip
ROLLERS = dict(
    bore=50 * MM, outside_diameter=80 * MM, width=23 * MM, inner_race_diameter=58 * MM,
    outer_race_diameter=72 * MM, roller_diameter=7 * MM, roller_length=7 * MM,
    effective_length=6.4 * MM, roller_count=22, rib_diameter=60 * MM, rib_gap=7.05 * MM,
)  # fmt: skip
TWO_OF_ROLLERS = DoubleRowRollerBearing(**ROLLERS, row_distance=9 * MM)


def solved(bearing, speed=0.0, *, tilt="free", **load):
    case = StaticCase(bearing=bearing, load=Load(**load, tilt=tilt), drive=Drive(speed=speed))
    return flexcage.solve_static(case)


def minimised(bearing, *, clearance, load):
    """Displacement (5,) of the inner ring at the least energy of all contacts, by scipy. Grooves
    are tori: of how their centres move, what is along the axis and the radius counts."""
    b, angle = bearing, bearing.contact_angle
    grooves = (b.inner_groove_radius, b.outer_groove_radius)
    reach = [radius - 0.5 * b.ball_diameter for radius in grooves]
    along = np.array([np.sin(angle), np.cos(angle)])
    stiff = [c.stiffness for c in SINGLE.contacts]
    points = []
    for x, sense in ((-0.5 * b.row_distance, 1.0), (0.5 * b.row_distance, -1.0)):
        for k in range(b.ball_count):
            psi = 2.0 * np.pi * k / b.ball_count + (sense < 0.0) * np.pi / b.ball_count
            e = np.array([0.0, np.cos(psi), np.sin(psi)])
            ball = np.array([x, 0.0, 0.0]) + 0.5 * b.pitch_diameter * e
            out = sense * along[0] * np.array([1.0, 0.0, 0.0]) + along[1] * e
            back = 0.5 * clearance * sense * np.array([1.0, 0.0, 0.0])
            points.append((ball + reach[0] * out - back, ball - reach[1] * out, e, ball))

    def energy(z):
        u, own = z[:5] * UM, z[5:].reshape(-1, 2) * UM
        turn = np.array([0.0, *u[3:] * 1e3])
        total, sloped = -np.asarray(load) @ u, []
        gradient = -np.asarray(load, float)
        for (inner, outer, e, ball), (dx, dr) in zip(points, own):
            round_ = np.array([0.0, -e[2], e[1]])
            centre = ball + dx * np.array([1.0, 0.0, 0.0]) + dr * e
            moved = inner + np.array([u[0], u[1], u[2]]) + np.cross(turn, inner)
            pulls = []
            for line, length, k in zip((moved - centre, centre - outer), reach, stiff):
                line = line - (line @ round_) * round_
                far = np.linalg.norm(line)
                depth = max(far - length, 0.0)
                total += 0.4 * k * depth**2.5
                pulls.append(k * depth**1.5 * line / far)
            gradient[:3] += pulls[0]
            gradient[3:] += np.cross(inner, pulls[0])[1:] * 1e3
            rest = pulls[1] - pulls[0]
            sloped += [rest[0], rest @ e]
        return total / UM, np.concatenate([gradient, sloped])

    start = np.zeros(5 + 2 * len(points))
    start[0], start[1] = 3.0, 10.0
    done = minimize(energy, start, jac=True, method="BFGS", options={"gtol": 1e-6, "maxiter": 4000})
    return done.x[:5] * np.array([UM, UM, UM, UM * 1e3, UM * 1e3])


@pytest.mark.parametrize("clearance", [0.0, 10.0 * UM, -6.0 * UM])
def test_a_solver_of_its_own_finds_the_same_place(clearance):
    pair = replace(PAIR, axial_clearance=clearance)
    load = np.array([400.0, 2000.0, 0.0, 0.0, 5.0])
    found = solved(pair, axial=400.0, radial=2000.0, moment_z=5.0).displacement
    weights = np.array([*load[:3], *load[3:] * 1e3])
    other = minimised(pair, clearance=clearance, load=weights)
    assert other == pytest.approx(found, rel=5e-4, abs=2e-9)


def test_forces_are_those_of_an_energy():
    bearing = replace(PAIR, axial_clearance=-4.0 * UM, arrangement="face_to_face")
    rows = statics_of(bearing)(
        bearing, speed=0.0, contacts=Contacts(), options=StaticOptions(dynamic_rating=1.0)
    )
    rng = np.random.default_rng(1)
    v = rng.uniform(-1, 1, (18, 3)) * np.array([5e-6, 5e-6, 2e-4]) + np.array([0, 1e-5, 0])
    w = rows.guesses(v)[1] + rng.uniform(-1e-6, 1e-6, (18, 2))
    found, step = rows.respond(v, w, 0.0), 1e-9
    for k, scale in enumerate((1.0, 1.0, 100.0)):
        more, less = (np.array(v), np.array(v))
        more[:, k] += scale * step
        less[:, k] -= scale * step
        up, down = rows.respond(more, w, 0.0), rows.respond(less, w, 0.0)
        span = 2.0 * scale * step
        size = np.abs(found.ring[:, k]).max()
        assert found.ring[:, k] == pytest.approx((up.energy - down.energy) / span, abs=1e-4 * size)
        stiff = (up.ring - down.ring) / span
        assert found.ring_v[:, :, k] == pytest.approx(stiff, abs=1e-5 * np.abs(stiff).max())
        moved = (up.unbalance - down.unbalance) / span
        assert found.unbalance_v[:, :, k] == pytest.approx(moved, abs=1e-5 * np.abs(moved).max())


def test_one_row_bears_an_axial_load_as_if_it_were_alone():
    alone, pair = solved(SINGLE, axial=800.0), solved(PAIR, axial=800.0)
    other = solved(PAIR, axial=-800.0)
    assert pair.displacement[0] == pytest.approx(alone.displacement[0], rel=1e-9)
    assert pair.elements.force[:9] == pytest.approx(alone.elements.force, rel=1e-9)
    assert not pair.elements.force[9:].any()
    assert other.displacement[0] == pytest.approx(-alone.displacement[0], rel=1e-9)
    assert other.elements.angle[9:] == pytest.approx(-alone.elements.angle, rel=1e-9)


def test_clearance_is_play_between_both_senses():
    pair = replace(PAIR, axial_clearance=12.0 * UM)
    plus, minus = (solved(pair, axial=sign * 1e-3).displacement[0] for sign in (1.0, -1.0))
    assert plus - minus == pytest.approx(12.0 * UM, rel=2e-3)


def test_a_preload_twice_as_stiff():
    """Two rows that press each other have twice the axial stiffness of one under the same force."""
    pair = replace(PAIR, axial_clearance=-8.0 * UM)
    force = brentq(lambda f: solved(SINGLE, axial=f).displacement[0] - 4.0 * UM, 10.0, 1e3)
    alone = solved(SINGLE, axial=force)
    found = solved(pair, axial=0.1)
    assert found.stiffness[0, 0] == pytest.approx(2.0 * alone.stiffness[0, 0], rel=1e-3)
    assert found.elements.force[0, 0] == pytest.approx(alone.elements.force[0, 0], rel=1e-3)


def test_tilt_stiffness_goes_with_the_distance_of_the_pressure_centres():
    """A row yields to a tilt about the point where its lines of contact meet the axis; about the
    bearing's middle that is the radial stiffness times the distance squared."""
    found, radial = {}, 0.0
    for arrangement in ("back_to_back", "face_to_face"):
        pair = replace(PAIR, axial_clearance=-8.0 * UM, arrangement=arrangement)
        stiffness = solved(pair, axial=0.1).stiffness
        found[arrangement], radial = stiffness[3, 3], stiffness[1, 1]
    angle = solved(replace(PAIR, axial_clearance=-8.0 * UM), axial=0.1).elements.angle[0, 0]
    arm = 0.5 * PAIR.pitch_diameter * np.tan(angle)
    for arrangement, sign in (("back_to_back", 1.0), ("face_to_face", -1.0)):
        distance = arm + sign * 0.5 * PAIR.row_distance
        assert found[arrangement] == pytest.approx(radial * distance**2, rel=0.05)


def test_a_self_aligning_bearing_does_not_resist_tilts():
    straight = solved(ALIGNING, radial=1000.0, axial=100.0, tilt="held")
    tilted = solved(ALIGNING, radial=1000.0, axial=100.0, tilt="held", misalignment=2e-3)
    assert tilted.elements.force == pytest.approx(straight.elements.force, rel=0.02, abs=2.0)
    arm = 0.5 * ALIGNING.pitch_diameter
    assert straight.stiffness[3, 3] < 1e-3 * straight.stiffness[1, 1] * arm**2


def test_its_play_is_the_radial_clearance():
    # in both rows a ball stands under the load
    straight = replace(ALIGNING, staggered=False, row_distance=7.6 * MM, width=16 * MM)
    loose = replace(straight, radial_clearance=20.0 * UM)
    tight, found = solved(straight, radial=0.2), solved(loose, radial=0.2)
    assert found.displacement[1] - tight.displacement[1] == pytest.approx(10.0 * UM, rel=0.01)


def test_two_rows_of_rollers_share_a_radial_load():
    alone = RollerBearing(**ROLLERS)
    half, both = (
        solved(alone, radial=5e3),
        solved(replace(TWO_OF_ROLLERS, staggered=False), radial=1e4),
    )
    assert both.displacement[1] == pytest.approx(half.displacement[1], rel=1e-9)
    assert both.elements.force[:22] == pytest.approx(half.elements.force, rel=1e-9)
    assert both.elements.force[22:] == pytest.approx(half.elements.force, rel=1e-9)


@pytest.mark.parametrize(
    "pair, alone, power, weibull",
    [(PAIR, SINGLE, 0.7, 10 / 9), (TWO_OF_ROLLERS, RollerBearing(**ROLLERS), 7 / 9, 9 / 8)],
)
def test_ratings_and_lives_of_two_rows(pair, alone, power, weibull):
    assert pair.static_rating == pytest.approx(2.0 * alone.static_rating)
    assert pair.dynamic_rating == pytest.approx(2.0**power * alone.dynamic_rating)
    if alone is SINGLE:  # of an axial load one row bears all
        half, both, share = solved(alone, axial=1e3), solved(pair, axial=1e3), 1.0
    else:
        half, both = solved(alone, radial=1e3), solved(pair, radial=2e3)
        share = 2.0 ** (-1.0 / weibull)
    due = share * half.ratings.reference_life
    assert both.ratings.reference_life == pytest.approx(due, rel=1e-3)


# ISO 281:2007, table 2, self-aligning ball bearings
ALIGNING_FACTORS = {
    0.05: 17.3, 0.06: 18.6, 0.07: 19.9, 0.08: 21.1, 0.09: 22.3, 0.10: 23.4, 0.12: 25.6, 0.14: 27.7,
    0.16: 29.7, 0.18: 31.7, 0.20: 33.5, 0.22: 35.2, 0.24: 36.8, 0.26: 38.2, 0.28: 39.4, 0.30: 40.3,
    0.32: 40.9, 0.34: 41.2, 0.36: 41.3, 0.38: 41.0, 0.40: 40.4,
}  # fmt: skip


def test_the_standards_table_of_self_aligning_bearings():
    for gamma, printed in ALIGNING_FACTORS.items():
        assert self_aligning_factor(gamma) == pytest.approx(printed, abs=0.0505)


# ISO 281:2007, table 3, two rows: contact angle, Y1, X2, Y2, e
ANGULAR = [
    (20, 1.09, 0.70, 1.63, 0.57), (25, 0.92, 0.67, 1.41, 0.68), (30, 0.78, 0.63, 1.24, 0.80),
    (35, 0.66, 0.60, 1.07, 0.95), (40, 0.55, 0.57, 0.93, 1.14), (45, 0.47, 0.54, 0.81, 1.34),
]  # fmt: skip


@pytest.mark.parametrize("angle, below, x, y, limit", ANGULAR)
def test_the_standards_factors_of_two_rows(angle, below, x, y, limit):
    pair = replace(PAIR, contact_angle=np.radians(angle))
    little = pair.equivalent_load(1000.0, 1000.0 * limit * 0.99)
    much = pair.equivalent_load(1000.0, 1000.0 * limit * 1.01)
    assert (little.radial_factor, much.radial_factor) == pytest.approx((1.0, x), abs=6e-3)
    assert (little.axial_factor, much.axial_factor) == pytest.approx((below, y), abs=8e-3)


# the same table, 15 degrees: f0 i Fa/C0r, Y1, Y2, e
SLIGHT = [(0.357, 1.57, 2.28, 0.40), (1.43, 1.34, 1.93, 0.47), (5.35, 1.12, 1.63, 0.56)]


@pytest.mark.parametrize("relative, below, y, limit", SLIGHT)
def test_factors_of_slight_angles_go_by_the_load_of_both_rows(relative, below, y, limit):
    pair = replace(PAIR, contact_angle=np.radians(15))
    f0 = static_factor(pair.gamma, 0.52, 0.53) / 5.0
    axial = relative * pair.static_rating / (f0 * 2)
    little, much = (pair.equivalent_load(axial / (limit * k), axial) for k in (0.9, 1.1))
    assert much.radial_factor == pytest.approx(0.72, abs=6e-3)
    assert (little.axial_factor, much.axial_factor) == pytest.approx((below, y), rel=0.03)


@pytest.mark.parametrize(
    "bearing, changes, said",
    [
        (PAIR, {"row_distance": 4 * MM}, "so the balls of both rows overlap; give"),
        (PAIR, {"row_distance": 15 * MM}, "so balls reach out of a bearing 20.6 mm wide; give"),
        (PAIR, {"contact_angle": np.radians(50.0)}, "up to 45 deg alone"),
        (ALIGNING, {"inner_groove_radius": 3.7 * MM}, "must be greater than the ball's radius"),
        (TWO_OF_ROLLERS, {"row_distance": 6 * MM}, "rollers of both rows overlap"),
    ],
)
def test_impossible_rows(bearing, changes, said):
    with pytest.raises(flexcage.InputError, match=said):
        replace(bearing, **changes).check()


def test_the_example_bears_its_moment_with_both_rows():
    case = flexcage.load_static(Path(__file__).parents[2] / "examples/3205_static.toml")
    found = flexcage.solve_static(case)
    assert found.ratings.static == pytest.approx(14.2e3, rel=0.01)
    assert found.ratings.dynamic == pytest.approx(20.6e3, rel=0.01)
    radial = (found.elements.force[:, 0] * np.cos(found.elements.angle[:, 0])) @ np.cos(
        found.elements.azimuth
    )
    assert radial == pytest.approx(-2e3 * -1.0, rel=1e-3)


@pytest.mark.parametrize("name", ["3204", "3205 A", "3206-2RS", "5207", "3208", "3209", "3210"])
def test_a_designation_becomes_two_rows(name, tmp_path, capsys):
    assert main(["new", name, "-o", str(tmp_path / "case.toml")]) == 0
    case = flexcage.load_static(tmp_path / "case.toml")
    assert case.bearing.type == PAIR.type and "[cage]" not in case.to_toml()
    found = flexcage.solve_static(case)
    assert 1.0 <= found.ratings.dynamic / case.bearing.dynamic_rating <= 1.0 + 1e-9
    assert found.loaded >= case.bearing.ball_count  # of an axial load, one row
    said = " ".join(capsys.readouterr().out.split())
    assert "balls of" in said


def test_a_3205_has_nine_balls_of_five_sixteenths_a_row():
    entry = catalogue.find("3205")
    bearing = new_case(entry.outline, entry.source).chosen.bearing
    assert (bearing.ball_count, bearing.ball_diameter) == (9, pytest.approx(7.938e-3, abs=1e-6))


def test_a_3210_may_have_the_balls_of_a_3209():
    """SKF rates both alike: so many of the same size on another circle."""
    three, ten = (
        new_case(entry.outline, entry.source)
        for entry in (catalogue.find("3209"), catalogue.find("3210"))
    )
    b = three.chosen.bearing
    like = [(c.bearing.ball_count, c.bearing.ball_diameter) for c in ten.candidates]
    assert (b.ball_count, b.ball_diameter) in like


def test_a_moment_is_refused_where_nothing_resists_a_tilt():
    said = "load.moment_z is 5 N\\*m, but a self-aligning .* give the shaft's load.tilt_stiffness"
    with pytest.raises(flexcage.InputError, match=said):
        solved(ALIGNING, radial=1e3, moment_z=5.0)
    assert solved(ALIGNING, radial=1e3, moment_z=5.0, tilt_stiffness=1e4).displacement[4] != 0.0


@pytest.mark.parametrize("designation", ["3205", "NN3010", "1205"])
def test_static_solutions_are_drawn_with_a_section(designation, tmp_path, capsys):
    case = tmp_path / "case.toml"
    assert main(["new", designation, "-o", str(case)]) == 0
    assert main(["static", str(case), "-o", str(tmp_path / "out")]) == 0
    assert (tmp_path / "out/section.png").stat().st_size > 20_000
    assert "limits" not in capsys.readouterr().err


@pytest.mark.parametrize("bearing", [PAIR, TWO_OF_ROLLERS], ids=["balls", "rollers"])
def test_a_section_of_two_rows_is_drawn(bearing, tmp_path):
    assert section_picture(bearing, tmp_path / "section.png").stat().st_size > 20_000
