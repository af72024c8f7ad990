"""One elastic housing under several bearings, as another program reduced it."""

from __future__ import annotations

import numpy as np
import pytest
from machines import load

from flexcage import load_machine, solve_machine
from flexcage.core.errors import InputError
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.formats import write_body

PLACES = (0.1, 0.16)  # m, of the bearings
FIVE = [0, 1, 2, 4, 5]


def around(centre):
    """Eight nodes of a seat: two rings of four."""
    turn = np.arange(4) * np.pi / 2
    ring = np.column_stack([0.0 * turn, 0.04 * np.cos(turn), 0.04 * np.sin(turn)])
    return np.concatenate([ring + [centre + x, 0.0, 0.0] for x in (-5e-3, 5e-3)])


@pytest.fixture(scope="module", params=["centres", "nodes around"])
def housing(request, tmp_path_factory):
    """A housing whose two seats move together, and the compliance (10, 10) of both frames."""
    rng = np.random.default_rng(5)
    size = np.array([1e-8, 1e-8, 1e-8, 3e-6, 3e-6, 3e-6] * 2)
    mixed = rng.normal(size=(12, 12))
    whole = np.eye(12) + 0.1 * mixed @ mixed.T / 12.0
    compliance = np.sqrt(np.outer(size, size)) * whole  # of both frames, six each
    if request.param == "centres":
        nodes = np.array([[x, 0.0, 0.0] for x in PLACES])
        stiffness = np.linalg.inv(compliance)
        dofs = [(n, k) for n in range(2) for k in range(6)]
    else:
        nodes = np.concatenate([around(x) for x in PLACES])
        moves = np.zeros((48, 12))  # of the nodes, from the frames'
        for n, (x, y, z) in enumerate(nodes):
            k, arm = n // 8, x - PLACES[n // 8]
            turns = np.array([[0, z, -y], [-z, 0, arm], [y, -arm, 0]])
            moves[3 * n : 3 * n + 3, 6 * k : 6 * k + 6] = np.column_stack([np.eye(3), turns])
        back = np.linalg.pinv(moves)
        # what a seat's nodes do beside moving with its frame is stiff and costs its own
        stiffness = back.T @ np.linalg.inv(compliance) @ back
        stiffness += 1e9 * (np.eye(48) - moves @ back)
        dofs = [(n, k) for n in range(16) for k in range(3)]
    body = ReducedBody(stiffness=stiffness, mass=np.eye(len(stiffness)), nodes=nodes,
                       dofs=np.array(dofs))  # fmt: skip
    folder = tmp_path_factory.mktemp("housing")
    write_body(body, folder / "housing.npz")
    both = np.array([*FIVE, *(6 + k for k in FIVE)])
    return folder, compliance[np.ix_(both, both)]


def machine(folder, **more):
    rows = [{"name": n, "preset": "7010C-PI", "position": f"{1e3 * x} mm", "facing": f,
             "axial_offset": "30 um"} for n, x, f in zip("AB", PLACES, ("+x", "-x"))]  # fmt: skip
    rows[1] |= more
    return {
        "drive": {"speed": "3000 rpm"},
        "gravity": {"acceleration": "0 m/s^2"},
        "shaft": {"sections": [{"length": "250 mm", "diameter": "50 mm"}],
                  "loads": [load(20, 150, 400, -100)]},
        "housing": {"body": str(folder / "housing.npz")},
        "bearings": rows,
    }  # fmt: skip


@pytest.mark.parametrize("tie", ["rigid", "average"])
def test_both_rings_move_as_the_housing_says(housing, tie):
    folder, compliance = housing
    table = machine(folder)
    table["housing"]["seat_tie"] = tie
    found = solve_machine(load_machine(table))
    signs = {"A": np.ones(5), "B": np.array([-1.0, 1.0, 1.0, -1.0, -1.0])}
    force = np.concatenate([signs[b.name] * b.solution.load for b in found.bearings])
    moved = np.concatenate([signs[b.name] * b.solution.outer for b in found.bearings])
    assert moved == pytest.approx(compliance @ force, rel=1e-6, abs=1e-14)
    alone = compliance[5:, 5:] @ force[5:]
    assert np.abs(moved[5:] - alone)[:3].max() > 0.01 * np.abs(alone[:3]).max()  # seats do couple


def test_a_ring_that_slides_in_the_housing_bears_its_spring(housing):
    folder, compliance = housing
    sliding = {"axial_seat": "floating", "spring_force": "200 N", "axial_offset": "0 um"}
    found = solve_machine(load_machine(machine(folder, **sliding)))
    assert found["B"].force[0] == pytest.approx(200.0, rel=1e-9)
    signs = np.concatenate([np.ones(5), [-1.0, 1.0, 1.0, -1.0, -1.0]])
    force = signs * np.concatenate([b.solution.load for b in found.bearings])
    force[5] = 0.0  # the spring is not the housing's
    moved = signs * np.concatenate([b.solution.outer for b in found.bearings])
    kept = np.arange(10) != 5
    assert moved[kept] == pytest.approx((compliance @ force)[kept], rel=1e-6, abs=1e-14)


def test_stiffness_there_is_the_slope_of_loads(housing):
    """Of the whole, seats included."""
    folder, _ = housing
    solved = solve_machine(load_machine(machine(folder)))
    moved = []
    for sign in (0.5, -0.5):
        table = machine(folder)
        table["shaft"]["loads"].append(load(20, 0, sign, 0))
        moved.append(solve_machine(load_machine(table)).deflection(0.02))
    assert moved[0] - moved[1] == pytest.approx(solved.compliance_at(0.02)[:, 1], rel=1e-3)


def test_a_machine_with_a_housing_reads_back(housing):
    folder, _ = housing
    m = load_machine(machine(folder))
    assert load_machine(m.to_toml()) == m and m.housing.body.endswith("housing.npz")


def test_mistakes(housing):
    folder, _ = housing
    with pytest.raises(InputError, match="no node with coordinates of its own lies on the bearing"):
        solve_machine(load_machine(machine(folder, position="200 mm")))
    own = {"mount": {"kind": "bushing"}}
    rows = machine(folder, **own)
    rows["bearings"][0] |= own
    with pytest.raises(InputError, match="every bearing has a"):
        solve_machine(load_machine(rows))
