"""Outer rings of a turning machine on seats that yield: in one housing, in housings of their own
that are turned with their bearing, and before springs."""

import numpy as np
import pytest
import scipy.linalg as la
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from flexcage.compiling import build_bearing
from flexcage.contacts.evaluation import REPORT
from flexcage.core.timing import Stages
from flexcage.machine import load_machine
from flexcage.machine.motion import as_it_begins, case_in_motion, starting_point
from flexcage.machine.moving_seats import MovingSeats
from flexcage.machine.solve import solve_machine
from flexcage.machine_run import simulate_machine
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.formats import write_body
from flexcage.stages import made_cage
from flexcage.system.start import find_start

PLACES = {"front": 0.1, "rear": 0.16}  # m
FIVE = [0, 1, 2, 4, 5]  # x, y, z and turns about y and z, of six
LATE = 5e-6  # s: half of outer_ring.relaxation
TURN = np.array([-1.0, 1.0, -1.0, -1.0, 1.0, -1.0])  # half a turn about y, of forces and moments


def compliance_of_both(*, coupled):
    """Displacements (12, 12) of two seats in the machine's axes under forces there."""
    rng = np.random.default_rng(5)
    size = np.array([1e-8, 1e-8, 1e-8, 3e-6, 3e-6, 3e-6] * 2)
    mixed = rng.normal(size=(12, 12))
    whole = np.eye(12) + 0.1 * mixed @ mixed.T / 12.0
    if not coupled:
        whole[:6, 6:] = whole[6:, :6] = 0.0
    return np.sqrt(np.outer(size, size)) * whole


def body(compliance, places, file):
    """A housing with a node of six coordinates in the centre of each seat."""
    nodes = np.array([[x, 0.0, 0.0] for x in places])
    dofs = np.array([(n, k) for n in range(len(places)) for k in range(6)])
    mass = np.eye(len(compliance))
    made = ReducedBody(stiffness=np.linalg.inv(compliance), mass=mass, nodes=nodes, dofs=dofs)
    return {"body": str(write_body(made, file))}


def machine(rpm, ms, *, weight=0.0, housing=None, mounts=None, **rear):
    """A DB pair whose rear bearing faces -x, with values of its own; ``weight`` [m/s^2] acts on
    outer rings too, which the static solution leaves out."""
    rows = [
        {"name": name, "preset": "7010C-PI", "position": f"{1e3 * x} mm", "facing": faces,
         "cage": {"model": "rigid"}, "axial_offset": "10 um"}
        | ({"mount": mounts[name]} if mounts else {})
        for (name, x), faces in zip(PLACES.items(), ("+x", "-x"), strict=True)
    ]  # fmt: skip
    rows[1] |= rear
    return load_machine({
        "drive": {"speed": f"{rpm} rpm"},
        "gravity": {"acceleration": f"{weight} m/s^2"},
        "shaft": {"kind": "rigid", "sections": [{"length": "250 mm", "diameter": "50 mm"}],
                  "loads": [{"position": "20 mm", "force": ["150 N", "400 N", "-100 N"]}]},
        **({"housing": housing} if housing else {}),
        "bearings": rows,
        "solver": {"duration": f"{ms} ms"},
        "output": {"block": 50, "rate": "200 kHz"},
    })  # fmt: skip


def moved(run):
    """Displacements (n, 12) of both outer rings in the machine's axes."""
    found = []
    for name in PLACES:
        ds = run[name].dataset
        turns = Rotation.from_quat(ds["outer_quaternion"].values[:, [1, 2, 3, 0]]).as_rotvec()
        own = np.concatenate([ds["outer_position"].values, turns], axis=1)
        found.append(own * (TURN if name == "rear" else 1.0))
    return np.concatenate(found, axis=1)


def pressed(run):
    """Forces and moments (n, 12) of elements on both outer rings in the machine's axes."""
    found = []
    for name in PLACES:
        ds = run[name].dataset
        own = np.concatenate([ds["outer_force"].values, ds["outer_moment"].values], axis=1)
        found.append(own * (TURN if name == "rear" else 1.0))
    return np.concatenate(found, axis=1)


def static_places(run):
    """Displacements (12,) of both rings in the static solution, in the machine's axes."""
    found = np.zeros(12)
    for k, seated in enumerate(run.machine.bearings):
        own = run.solution[seated.place.name].solution.outer * seated.place.mirror
        found[6 * k + np.array(FIVE)] = own
    return found


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """A run in one housing."""
    file = tmp_path_factory.mktemp("housing") / "both.npz"
    housing = body(compliance_of_both(coupled=True), PLACES.values(), file)
    return simulate_machine(machine(8000, 4, weight=9.81, housing=housing), stress=False)


def test_both_rings_swing_on_the_housing_as_ten_linear_equations_say(whole):
    """M o'' + D K o' + K o = f, from rest at the static solution, with the elements' forces f that
    the run has; by an independent integration."""
    both = np.array([*FIVE, *(6 + k for k in FIVE)])
    K = np.linalg.inv(compliance_of_both(coupled=True)[np.ix_(both, both)])
    bearing = whole["front"].case.bearing
    m, (_, turn) = bearing.outer_ring_mass, bearing.outer_ring_inertia
    M = np.tile([m, m, m, turn, turn], 2)
    n, step = 10, 5e-6
    A = np.block([[np.zeros((n, n)), np.eye(n)], [-K / M[:, None], -LATE * K / M[:, None]]])
    found = moved(whole)[:, both]
    weight = np.tile([0.0, 9.81 * m, 0.0, 0.0, 0.0], 2)
    forces = pressed(whole)[:, both]
    times = step * np.arange(len(found) + 1)
    f = CubicSpline(times[1:], forces + weight)
    fine = 4
    exact = la.expm(A * step / fine)
    given = np.linalg.solve(A, exact - np.eye(2 * n))
    state, places = np.concatenate([static_places(whole)[both], np.zeros(n)]), []
    for t in times[:-1]:
        for k in range(fine):
            push = f(t + (k + 0.5) * step / fine) / M
            state = exact @ state + given @ np.concatenate([np.zeros(n), push])
        places.append(state[:n])
    miss = np.abs(np.array(places) - found).max(axis=0)
    swing = np.ptp(found, axis=0)
    assert (miss < 0.01 * swing).all(), miss / swing
    alone = np.linalg.inv(K)[:5, :5] @ forces[-1, :5]  # if seats did not couple
    assert np.abs(alone - found[-1, :5]).max() > 100.0 * miss[:5].max()


def test_what_all_hold_is_what_was_put_in(whole):
    """Energy of bearings, housing and shaft, and all work: nothing is lost between seats."""
    stored = whole.shaft["energy"].values.copy()
    done = whole.shaft["work"].sum("channel").values.copy()
    handed = np.zeros(len(done))
    for name in PLACES:
        ds = whole[name].dataset
        assert whole[name].summary["energy_audit"] == "passed"
        stored += ds["energy"].sum("energy_kind").values
        done += ds["work"].sum("channel").values
        handed += ds["work"].sel(channel="load").values
    gap = (stored - stored[0]) - (done - done[0])
    assert np.abs(gap).max() < 1e-4 * np.ptp(done)
    # what the housing hands on sums up to nothing: loads of all are what the shaft gives
    given = whole.shaft["work"].sel(channel="to_bearings").values
    np.testing.assert_allclose(handed, -given, atol=1e-9 * np.abs(handed).max() + 1e-15)


def test_the_housing_holds_half_of_k_o_squared(whole):
    both = np.array([*FIVE, *(6 + k for k in FIVE)])
    K = np.linalg.inv(compliance_of_both(coupled=True)[np.ix_(both, both)])
    o = moved(whole)[:, both]
    held = sum(whole[name].dataset["energy"].sel(energy_kind="mount").values for name in PLACES)
    np.testing.assert_allclose(held, 0.5 * np.einsum("ti,ij,tj->t", o, K, o), rtol=1e-6)


SLIDES = {"axial_seat": "floating", "spring_force": "120 N", "axial_offset": "0 um"}


@pytest.mark.parametrize("rear", [{}, SLIDES], ids=["fixed", "slides"])
def test_rings_in_one_housing_stay_where_the_static_solution_has_them(rear, tmp_path):
    """At a turn a second, on average over 2 ms."""
    housing = body(compliance_of_both(coupled=True), PLACES.values(), tmp_path / "both.npz")
    run = simulate_machine(machine(60, 2, housing=housing, **rear), stress=False)
    wanted, found = static_places(run), moved(run)
    for ways in (slice(0, 3), slice(4, 6), slice(6, 9), slice(10, 12)):
        size = np.abs(wanted[ways]).max()
        assert np.abs(found[:, ways].mean(axis=0) - wanted[ways]).max() < 4e-3 * size, ways


@pytest.mark.parametrize("rear", [{}, SLIDES], ids=["fixed", "slides"])
def test_a_housing_whose_seats_do_not_couple_is_one_for_each(rear, tmp_path):
    """The rear bearing faces -x; its own housing is written in the machine's axes, too."""
    apart = compliance_of_both(coupled=False)
    housing = body(apart, PLACES.values(), tmp_path / "both.npz")
    mounts = {
        name: body(apart[own, own], [0.0], tmp_path / f"{name}.npz")
        for name, own in (("front", slice(0, 6)), ("rear", slice(6, 12)))
    }
    one = simulate_machine(machine(3000, 1, housing=housing, **rear), stress=False)
    two = simulate_machine(machine(3000, 1, mounts=mounts, **rear), stress=False)
    for found, wanted in ((moved(one), moved(two)), (pressed(one), pressed(two))):
        np.testing.assert_allclose(found, wanted, atol=1e-10 * np.abs(wanted).max(axis=0).max())
    wanted = static_places(two)
    for ways in (slice(0, 3), slice(4, 6), slice(6, 9), slice(10, 12)):
        begun = moved(two)[0, ways]
        np.testing.assert_allclose(begun, wanted[ways], atol=1e-3 * np.abs(wanted[ways]).max())


def with_rollers(design, rpm, ms, *, housing=None, force=0, facing="+x", stiffness=0):
    """A ball bearing and, 100 mm away, a roller bearing whose outer ring may slide."""
    sprung = {"spring_force": f"{force} N", "spring_stiffness": f"{stiffness} N/um"}
    rows = [
        {"name": "front", "designation": "7206C" if force else "6206", "position": "100 mm",
         "facing": "-x" if facing == "+x" else "+x", "cage": {"model": "rigid"}},
        {"name": "rear", "designation": design, "position": "160 mm", "facing": facing,
         "cage": {"model": "rigid"},
         **({"axial_seat": "floating", **sprung} if force else {})},
    ]  # fmt: skip
    return load_machine({
        "drive": {"speed": f"{rpm} rpm"},
        "gravity": {"acceleration": "0 m/s^2"},
        "shaft": {"kind": "rigid", "sections": [{"length": "250 mm", "diameter": "30 mm"}],
                  "loads": [{"position": "130 mm", "force": ["0 N", "1400 N", "-300 N"]}]},
        **({"housing": housing} if housing else {}),
        "bearings": rows,
        "solver": {"duration": f"{ms} ms"},
        "output": {"block": 50},
    })  # fmt: skip


@pytest.mark.parametrize("facing", ["+x", "-x"])
def test_a_roller_bearing_begins_in_balance_with_its_spring(facing):
    """Its outer ring, held while rollers find their places, is then moved to where the static
    solution has it; ribs press it with the spring's force."""
    rollers = with_rollers("NJ 206", 3000, 1, force=100, facing=facing, stiffness=2)
    solution = solve_machine(as_it_begins(rollers))
    seats, own = MovingSeats(rollers, solution), solution["rear"]
    case = case_in_motion(rollers, rollers.bearings[1], own)
    mesh, cage = made_cage(case, Stages(None))
    bearing = build_bearing(case, mesh, cage, seat=seats.compliance(1))
    seats.begin(1, bearing)
    start = find_start(bearing, limit_force=case.limits.assembly_force)
    seats.release(1, bearing)
    start = seats.moved(1, bearing, start)
    q, wanted = bearing.layout.q(start.y), starting_point(own)
    assert q["outer"][0] == pytest.approx(wanted.outer[0], abs=1e-15)
    assert q["inner"][0] == pytest.approx(wanted.displacement[0], abs=2e-6)  # without its tilt
    ring = bearing.data.model.outer_ring
    sprung = ring.stiffness[0, 0] * (q["outer"][0] - ring.rest[0])
    assert sprung == pytest.approx(own.solution.load[0], rel=1e-9)
    bearing.residual(0.0, start.y, start.yd, REPORT)
    assert bearing.data.work.report.outer_wrench[0] == pytest.approx(sprung, rel=0.02)


@pytest.mark.slow
@pytest.mark.parametrize(("design", "facing"), [("NJ 206", "-x"), ("NUP 206", "+x")])
def test_a_spring_presses_a_roller_bearing_that_turns(design, facing):
    run = simulate_machine(with_rollers(design, 3000, 6, force=150, facing=facing), stress=False)
    way = 1.0 if facing == "+x" else -1.0
    rear, front = (run.summary.bearings[name] for name in ("rear", "front"))
    assert way * rear.axial == pytest.approx(150.0, rel=0.02)
    assert rear.axial == pytest.approx(-front.axial, rel=0.02)
    slid = run["rear"].dataset["outer_position"].sel(axis="x").values
    at = run.solution["rear"].solution.outer[0]
    assert slid[0] == pytest.approx(at, abs=1e-7)
    assert slid.mean() == pytest.approx(at, abs=2e-6)  # rollers tilt as they did not at first
    assert np.ptp(slid) > 1e-8
    assert all(run[name].summary["energy_audit"] == "passed" for name in PLACES)


@pytest.mark.slow
def test_rollers_in_one_housing_with_balls_stay_where_the_static_solution_has_them(tmp_path):
    housing = body(compliance_of_both(coupled=True), PLACES.values(), tmp_path / "both.npz")
    rollers = with_rollers("NU 206", 60, 2, housing=housing, facing="-x")
    run = simulate_machine(rollers, stress=False)
    wanted, found = static_places(run), moved(run)
    for ways in (slice(0, 3), slice(4, 6), slice(6, 9), slice(10, 12)):
        size = np.abs(wanted[ways]).max()
        assert np.abs(found[:, ways] - wanted[ways]).max() < 0.01 * size, ways
