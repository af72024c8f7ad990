"""An accelerometer at a node of an elastic housing: closed forms, direct integration, refusals."""

from __future__ import annotations

import dataclasses

import numpy as np
import pytest
import xarray
from scipy.integrate import solve_ivp
from scipy.linalg import eigh

from flexcage.core.errors import InputError
from flexcage.modes.exchange.body import MODAL, ReducedBody
from flexcage.modes.exchange.formats import write_body
from flexcage.results.signals import housing
from flexcage.results.signals.housing import SensedHousing
from flexcage.spec import Accelerometer, Mount

RADIUS, WIDTH = 40e-3, 16e-3
RING = (0.3, 4e-4, 2.2e-4)  # kg, kg m^2 about x and across
ZETA = 0.03


def path_of(body, folder, *, node=9):
    file = write_body(body, folder / "housing.npz")
    sensor = Accelerometer(name="foot", place="housing", node=node, housing_damping=ZETA)
    return path_in(Mount(body=str(file), seat=""), sensor)


def path_in(mount, sensor):
    """That of a sensor; a check before the run refuses what it would refuse."""
    housing = SensedHousing.of(mount, diameter=2 * RADIUS, width=WIDTH, ring=RING)
    housing.check(sensor)
    (found,) = housing.paths([sensor])
    return found


def two_masses():
    """The seat's one node (3 kg on 2e8 N/m along y), and 0.5 kg on 4e7 N/m behind it, which has no
    coordinates of its own but moves by its shape; all else is stiff."""
    stiffness, mass = np.diag([1e12] * 6 + [4e7]), np.diag([3.0] * 3 + [1e-3] * 3 + [0.5])
    stiffness[1, 1] = 2e8 + 4e7
    stiffness[1, 6] = stiffness[6, 1] = -4e7
    shapes = np.zeros((2, 3, 7))
    shapes[0, range(3), range(3)] = 1.0
    shapes[1, 1, 6] = 1.0
    dofs = [(0, k) for k in range(6)] + [(MODAL, 0)]
    nodes = np.array([[0.0, 0.0, 0.0], [0.0, 0.1, 0.0]])
    return ReducedBody(stiffness=stiffness, mass=mass, nodes=nodes, dofs=np.array(dofs),
                       shapes=shapes, numbers=np.array([4, 9]))  # fmt: skip


def test_two_masses_in_a_row_have_the_gain_of_textbooks(tmp_path):
    """(K - w^2 M + j w C)^-1 with the damping of each mode, in closed form of the two modes."""
    found = path_of(two_masses(), tmp_path)
    M = np.diag([3.0 + RING[0], 0.5])
    K = np.array([[2.4e8, -4e7], [-4e7, 4e7]])
    trace, det = np.trace(np.linalg.solve(M, K)), np.linalg.det(K) / np.linalg.det(M)
    square = 0.5 * (trace + np.array([-1.0, 1.0]) * np.sqrt(trace**2 - 4.0 * det))
    np.testing.assert_allclose(found.frequency.min(), np.sqrt(square[0]) / (2 * np.pi), rtol=1e-9)
    f = np.linspace(10.0, 4e3, 50)
    w, own = 2 * np.pi * f, np.sqrt(square)
    expected = 0.0
    for s, w_i in zip(square, own):
        ratio = (K[0, 0] - s * M[0, 0]) / 4e7  # of the second mass over the first
        modal = M[0, 0] + M[1, 1] * ratio**2
        expected = expected - w**2 * ratio / modal / (s - w**2 + 2j * ZETA * w_i * w)
    np.testing.assert_allclose(found.gains(f)[:, 1], expected, rtol=1e-4)
    assert abs(found.gains(f)[:, [0, 2, 3, 4, 5]]).max() < 1e-9 * abs(expected).max()


def seat_of_nodes(seed=3, massless=False):
    """Eight nodes round the seat and one beside it, held and coupled at random."""
    rng = np.random.default_rng(seed)
    turn = np.arange(4) * np.pi / 2
    round_it = np.column_stack([0 * turn, RADIUS * np.cos(turn), RADIUS * np.sin(turn)])
    seat = np.concatenate([round_it + [x, 0, 0] for x in (-5e-3, 5e-3)])
    nodes = np.concatenate([seat, [[0.0, RADIUS, 1e-3]]])
    mixed = rng.normal(size=(27, 27))
    stiffness = 2e7 * (np.eye(27) + mixed @ mixed.T / 27.0)
    mass = 0.1 * np.eye(27)
    if massless:
        mass[24, 24] = 0.0
    dofs = [(n, k) for n in range(9) for k in range(3)]
    return ReducedBody(stiffness=stiffness, mass=mass, nodes=nodes, dofs=np.array(dofs),
                       numbers=np.arange(1, 10))  # fmt: skip


def recorded(rate=50e3, n=1000):
    """Forces and moments that begin at rest and end so."""
    t = np.arange(n) / rate
    rng = np.random.default_rng(0)
    window = np.sin(np.pi * t / t[-1]) ** 2
    waves = [
        a * np.sin(2 * np.pi * f * t + p) for a, f, p in rng.random((6, 3)) * [300.0, 4e3, 6.0]
    ]
    loads = window[:, None] * np.stack(waves, axis=1) * [1, 1, 1, 0.02, 0.02, 0.02]
    own = {k: (("time", "axis"), v) for k, v in
           (("outer_force", loads[:, :3]), ("outer_moment", loads[:, 3:]))}  # fmt: skip
    return xarray.Dataset(own, {"time": t}), t, loads


def tied(body, tie):
    """Stiffness, mass, loads and row of the body with the ring, by dense algebra of its own."""
    K, M = (np.asarray(m, float) for m in (body.stiffness, body.mass))
    moves = np.zeros((27, 6))
    for n in range(8):
        x, y, z = body.nodes[n]
        moves[3 * n : 3 * n + 3] = np.column_stack(
            [np.eye(3), [[0, z, -y], [-z, 0, x], [y, -x, 0]]]
        )
    ring = np.diag([RING[0]] * 3 + [RING[1], RING[2], RING[2]])
    if tie == "rigid":
        T = np.zeros((27, 9))
        T[:, :6], T[24:, 6:] = moves, np.eye(3)
        R = np.eye(9, 6)
    else:
        T, R = np.eye(27), moves @ np.linalg.inv(moves.T @ moves)
    return T.T @ K @ T, T.T @ M @ T + R @ ring @ R.T, R, T[24:]


def seated_path(body, folder, **values):
    """Of the body's nodes those of a deck's set "ring" are the seat."""
    file, deck = write_body(body, folder / "housing.npz"), folder / "nodes.inp"
    lines = [f"{i + 1}, " + ", ".join(f"{c:.11g}" for c in p) for i, p in enumerate(body.nodes)]
    deck.write_text("\n".join(["*NODE", *lines, "*NSET, NSET=ring, GENERATE", "1, 8", ""]))
    tie = values.pop("tie", "rigid")
    sensor = Accelerometer(name="foot", place="housing", node=9, housing_damping=ZETA, **values)
    mount = Mount(body=str(file), body_nodes=str(deck), seat="ring", seat_tie=tie)
    return path_in(mount, sensor)


@pytest.mark.parametrize("tie", ["rigid", "average"])
@pytest.mark.parametrize("way", [{"axial": True}, {"direction": 0.7}])
def test_forces_of_a_run_by_direct_integration(tmp_path, tie, way):
    """M a + C v + K x = f, integrated by scipy in time, C with each mode's damping."""
    body = seat_of_nodes()
    ds, t, loads = recorded()
    found = seated_path(body, tmp_path, tie=tie, **way).acceleration(ds)
    K, M, R, node = tied(body, tie)
    square, phi = eigh(K, M)
    C = M @ phi @ np.diag(2 * ZETA * np.sqrt(square)) @ phi.T @ M
    n, inverse = len(K), np.linalg.inv(M)
    between = _fine(t, loads)

    def rate(time, y):
        force = R @ between(time)
        return np.concatenate([y[n:], inverse @ (force - C @ y[n:] - K @ y[:n])])

    done = solve_ivp(rate, (t[0], t[-1]), np.zeros(2 * n), "DOP853", t, rtol=1e-8, atol=1e-13)
    a = np.stack([rate(s, y)[n:] for s, y in zip(t, done.y.T)])
    c, s = np.cos(way.get("direction", 0.0)), np.sin(way.get("direction", 0.0))
    towards = [1.0, 0.0, 0.0] if way.get("axial") else [0.0, c, s]
    expected = a @ node.T @ towards
    np.testing.assert_allclose(found, expected, atol=2e-3 * np.abs(expected).max())


def _fine(t, loads):
    from scipy.interpolate import CubicSpline

    return CubicSpline(t, loads)


def test_a_coordinate_without_mass_and_a_body_too_large_for_all_modes(tmp_path, monkeypatch):
    """Static shares stay whole: at low frequencies the gain is -w^2 times the compliance."""
    f = np.linspace(1.0, 100.0, 40)
    massless = seated_path(seat_of_nodes(massless=True), tmp_path)
    K, M, R, node = tied(seat_of_nodes(massless=True), "rigid")
    row = np.array([0.0, 1.0, 0.0]) @ node
    still = row @ np.linalg.solve(K, R)
    np.testing.assert_allclose(massless.gains(f)[0] / -((2 * np.pi) ** 2), still, rtol=1e-3)
    whole = seated_path(seat_of_nodes(), tmp_path).gains(f)
    monkeypatch.setattr(housing, "DENSE", 3)
    monkeypatch.setattr(housing, "LOWEST", 6)
    lowest = seated_path(seat_of_nodes(), tmp_path).gains(f)
    alike = abs(whole).max(axis=0)
    assert (abs(lowest - whole) < 3e-3 * alike).all()


def test_a_housing_without_mass_and_a_node_that_is_none_are_one_sentence(tmp_path):
    bare = dataclasses.replace(seat_of_nodes(), mass=None)
    with pytest.raises(InputError, match="has no mass matrix, so the accelerometer 'foot'"):
        seated_path(bare, tmp_path)
    with pytest.raises(InputError, match="'foot' is on node 7, but .* it has 4"):
        path_of(two_masses(), tmp_path, node=7)
