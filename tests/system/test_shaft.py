"""A rotor in its bearings: one bearing is its own run, books of rotor and bearings close."""

from dataclasses import replace

import numpy as np
import pytest

from flexcage import load_case
from flexcage.compiling import build_bearing
from flexcage.core.timing import Stages
from flexcage.solve.integrators import INTEGRATORS
from flexcage.solve.options import SolverOptions
from flexcage.stages import assembled_start, made_cage
from flexcage.system.data import POWERS
from flexcage.system.shaft.data import DAMPED, LOADS, TO_BEARINGS, WEIGHT, stiff_rotor
from flexcage.system.shaft.problem import MachineSystem, begun, release, shaft_data

NP = len(POWERS)
SPEED = 6000.0 * np.pi / 30.0
GRAVITY = np.array([0.0, 9.80665, 0.0])


def case_of(**changes):
    """A 7010C with a rigid cage, whose inner ring is free to tilt."""
    table = {
        "bearing": {"preset": "7010C-PI"}, "cage": {"model": "rigid"},
        "drive": {"speed": "6000 rpm"},
        "load": {"axial": "150 N", "radial": "100 N", "tilt": "free"},
    }  # fmt: skip
    return load_case(table, overrides=changes)


def bearing_of(case):
    """A bearing and its start."""
    mesh, cage = made_cage(case, Stages(None))
    bearing = build_bearing(case, mesh, cage)
    return bearing, assembled_start(case, bearing)


def advanced(system, y, end, samples=20):
    """States and works at equal times up to ``end`` [s]."""
    method = INTEGRATORS["explicit"]
    state = method.new_state(
        0.0, y, np.zeros_like(y), weight=system.error_weights(1e-9), h0=1e-7,
        quad_weight=system.work_weights(1e-9), modes=system.modes,
    )  # fmt: skip
    times = np.linspace(0.0, end, samples + 1)[1:]
    ys, quads = np.zeros((samples, len(y))), np.zeros((samples, system.quads))
    options = method.options(SolverOptions())
    outcome, filled, _ = system.advance(
        method, state, options, end, times, ys, np.zeros_like(ys), 0, np.zeros((100_000, 5)), quads
    )
    assert (outcome, filled) == (0, samples)
    return ys, quads


def test_a_machine_of_one_bearing_is_the_bearings_run():
    """The shaft's mass moves with the inner ring: as part of it, or as a rotor of its own."""
    case = case_of(**{"load.shaft_mass": "0.7 kg"})
    bearing, start = bearing_of(case)
    alone, works = advanced(bearing, start.y, 2e-3)
    inside, start = bearing_of(case)
    inside.data.model.inner_ring.inertia[0] -= 0.7
    release(inside)
    rotor = stiff_rotor(
        place=[0.0], inertia=[0.7, 0.0, 0.0], gravity=GRAVITY, load=[150.0, 100.0, 0.0, 0.0, 0.0]
    )
    machine = MachineSystem([inside], shaft_data([inside], rotor, samples=20))
    pose = bearing.layout.q(start.y)["inner"][:5]
    ys, quads = advanced(machine, begun(machine, [start], pose), 2e-3)
    found, size = ys[:, : bearing.size], bearing.size
    for views in (bearing.layout.q, bearing.layout.u):
        for name, values in views(alone).items():
            miss = np.abs(views(found)[name] - values)
            assert miss.max(initial=0.0) <= 1e-10 * max(np.abs(values).max(initial=0.0), 1e-6), name
    np.testing.assert_allclose(ys[:, size : size + 5], views_of_ring(bearing, alone), atol=1e-15)
    # what the rotor does to the ring is the bearing's load less the rotor's own inertia
    moved = quads[:, NP + LOADS] + quads[:, NP + WEIGHT] + quads[:, NP + TO_BEARINGS]
    speeds = ys[:, size + 5 : size + 8]
    kinetic = 0.35 * (speeds**2).sum(axis=1)
    np.testing.assert_allclose(moved, kinetic, atol=1e-5 * kinetic.max())


def views_of_ring(bearing, ys):
    return bearing.layout.q(ys)["inner"][:, :5]


def pair(modes=0, samples=40):
    """A DB pair 40 mm apart on a rotor of 1.2 kg with a load and moments; with a bending mode."""
    cases = [case_of(), case_of(**{"drive.speed": "-6000 rpm"})]
    made = [bearing_of(case) for case in cases]
    for bearing, _ in made:
        release(bearing)
    load = [0.0, 200.0, 50.0, 0.3, 1.0]
    rotor = stiff_rotor(
        place=[-0.02, 0.02], reversed=[False, True], offset=[0.0, 0.0],
        inertia=[1.2, 5e-4, 1e-3], gravity=GRAVITY, load=load,
    )  # fmt: skip
    if modes:
        rng = np.random.default_rng(3)
        turn, gyro = 0.02 * rng.standard_normal((modes, 2)), rng.standard_normal((modes, modes))
        z = np.zeros((2, 5 + modes))
        rotor = replace(
            rotor, load=np.array([*load, *(30.0 * rng.standard_normal(modes))]),
            unbalance=z, phase=z, shape=rng.standard_normal((2, 5, modes)),
            stiffness=(2.0 * np.pi * np.array([900.0, 1500.0])[:modes]) ** 2,
            damping=np.full(modes, 100.0), gyro=0.05 * (gyro - gyro.T), gyro_turn=turn,
        )  # fmt: skip
    bearings = [bearing for bearing, _ in made]
    machine = MachineSystem(bearings, shaft_data(bearings, rotor, samples=samples))
    pose = np.zeros(5 + modes)
    pose[1] = bearings[0].layout.q(made[0][1].y)["inner"][1]
    return machine, begun(machine, [start for _, start in made], pose)


@pytest.mark.parametrize("modes", [0, 2])
def test_energy_of_the_rotor_is_what_loads_weight_and_bearings_do(modes):
    """Rings on their places of an elastic rotor included; of a bent one to second order."""
    machine, y = pair(modes)
    ys, quads = advanced(machine, y, 4e-3, 40)
    at, s = int(machine.shaft.first[-1]), machine.shaft
    half = at + 5 + modes
    q, v = ys[:, at:half], ys[:, half:]
    stored = 0.6 * (v[:, :3] ** 2).sum(axis=1) + 0.5e-3 * (v[:, 3:5] ** 2).sum(axis=1)
    stored += 0.5 * (v[:, 5:] ** 2 + s.stiffness * q[:, 5:] ** 2).sum(axis=1)
    done = quads[:, 2 * NP :].sum(axis=1)
    moved = np.abs(quads[:, 2 * NP + LOADS]).max()
    np.testing.assert_allclose(stored - stored[0], done - done[0], atol=1e-5 * moved)
    assert (quads[-1, 2 * NP + DAMPED] < 0.0) == bool(modes)


def test_two_bearings_bear_what_loads_the_rotor():
    """Momentum: what loads and weight give in 4 ms the rotor has, or gave to the inner rings."""
    machine, y = pair(samples=800)
    ys, _ = advanced(machine, y, 4e-3, 800)
    at, s = int(machine.shaft.first[-1]), machine.shaft
    main = slice(3, None, 4)  # samples of which the whole report is kept
    given = (s.kept * s.sign).sum(axis=1)[main, :3]  # by the rotor, in its own axes
    momentum = 1.2 * ys[main, at + 5 : at + 8]
    load = np.array([0.0, 200.0, 50.0]) + 1.2 * GRAVITY
    times = 5e-6 * np.arange(4, 801, 4)
    impulse = np.trapezoid(load - given, times, axis=0)
    np.testing.assert_allclose(momentum[-1] - momentum[0], impulse, atol=2e-4 * 4e-3 * 220.0)
