"""Loads of rivets against the balance of a cage's halves."""

import numpy as np
import pytest

from flexcage.cages.build import build_cage_mesh
from flexcage.cages.ribbon.defects import MissingRivet
from flexcage.case.presets import load_preset
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.mesh.options import MeshOptions
from flexcage.modes.pockets import pocket_frame
from flexcage.stress.rivets import Joints, Rivets, _figures, _labelled

POCKETS, PITCH_RADIUS = 7, 13e-3
PULL = np.array([3.0, -1.0, 2.0])  # N


@pytest.fixture(scope="module", params=[(), (MissingRivet(web=2),)], ids=["sound", "rivet 2 lacks"])
def cage(request):
    preset = load_preset("15x37x10").cage
    mesh = build_cage_mesh(
        preset, pocket_count=POCKETS, pitch_diameter=2.0 * PITCH_RADIUS, defects=request.param,
        options=MeshOptions(fineness="coarse"),
    )  # fmt: skip
    solver = FreeBodySolver(assemble(mesh, preset.material))
    return solver, Joints(solver.model, POCKETS, PITCH_RADIUS)


def far_from_the_middle(model, sign):
    """A vertex of one half, off all joints."""
    return int(np.argmax(sign * model.points[:, 0] + 0.1 * model.points[:, 1]))


def loads_of(joints, displacement):
    """Sum of all joints' forces, and of their moments about the bearing's centre, cage frame."""
    force, moment = np.zeros(3), np.zeros(3)
    for web, parts in zip(joints.webs, joints(displacement.reshape(-1, 3, 1))[:, 0]):
        frame = pocket_frame(web - 0.5, POCKETS)
        own, middle = parts[:3] @ frame, PITCH_RADIUS * frame[1]
        force += own
        moment += parts[3:] @ frame + np.cross(middle, own)
    return force, moment


def test_joints_are_where_rivets_are(cage):
    solver, joints = cage
    lacking = len(joints.webs) < POCKETS
    assert list(joints.webs) == [k for k in range(POCKETS) if not (lacking and k == 2)]


def test_halves_pulled_apart_hang_on_their_rivets(cage):
    """One half is pulled, the other back: what pulls a half is in balance with its rivets."""
    solver, joints = cage
    ahead, behind = (far_from_the_middle(solver.model, sign) for sign in (1.0, -1.0))
    load = np.zeros((len(solver.model.nodes), 3))
    load[ahead] += PULL
    load[behind] -= PULL
    # the couple of both is taken by the body's inertia, of which a half has one half
    force, moment = loads_of(joints, solver.solve(load.reshape(-1, 1)))
    half, halves = balance(solver.model, load)
    np.testing.assert_allclose(force, half - PULL, atol=1e-6)
    np.testing.assert_allclose(
        moment, halves - np.cross(solver.model.nodes[ahead], PULL), atol=1e-8
    )


def balance(model, load):
    """Inertia force and moment about the centre (3,) of the half at x > 0 under these loads: of the
    nodes there, and of one half of those that both halves share."""
    rigid = model.rigid_modes
    acceleration = (rigid @ (rigid.T @ load.ravel())).reshape(-1, 3)
    inertia = model.mass_times(acceleration.ravel()).reshape(-1, 3)
    ahead = model.points[model.tets].mean(axis=1)[:, 0] > 0.0
    share = np.zeros(len(model.nodes))
    share[model.cells[ahead]] += 0.5
    share[np.setdiff1d(model.cells[ahead], model.cells[~ahead])] += 0.5
    own = share[:, None] * inertia
    return own.sum(axis=0), np.cross(model.nodes, own).sum(axis=0)


def test_a_half_is_dragged_along_by_rivets(cage):
    """One half alone is pushed: through the rivets go the forces that move the other."""
    solver, joints = cage
    load = np.zeros((len(solver.model.nodes), 3))
    load[far_from_the_middle(solver.model, 1.0), 0] = 1.0
    force, _ = loads_of(joints, solver.solve(load.reshape(-1, 1)))
    half, _ = balance(solver.model, load)
    np.testing.assert_allclose(force, half - [1.0, 0.0, 0.0], atol=1e-7)
    assert force[0] == pytest.approx(-0.5, abs=0.1)  # tilting moves both halves, too


def test_a_shank_in_tension_bending_and_torsion():
    """1 N on a shank of 1 mm is 4/pi MPa; a moment of 1 N mm bends by 32/pi MPa."""
    parts = np.zeros((6, 4))
    parts[0, :2] = -1.0, 1.0  # drawn, pressed
    parts[4, 2] = 1e-3
    parts[3, 3] = -1e-3
    found = dict(_figures(parts, 1e-3))
    np.testing.assert_allclose(found["tension"], [1.0, -1.0, 0.0, 0.0])
    np.testing.assert_allclose(
        found["stress"] / 1e6 * np.pi, [4.0, 0.0, 32.0, 16.0 * np.sqrt(3.0)], rtol=1e-12
    )


def test_the_cycle_of_the_most_stressed_rivet():
    """One of two rivets is pushed to and fro; between samples its load was a tenth larger."""
    d, turn = 1.2e-3, np.array([0.0, 1.0, 0.2, -0.6, 0.0])
    loads = {3: np.outer(turn, [-2.0, 5.0, 0.0, 0.0, 0.0, 1e-3]), 5: np.full((5, 6), 1e-3)}
    own = []
    for parts in loads.values():
        most = _figures(parts.T, d)
        most = {name: 1.1 * values for name, values in most.items()}
        own.append({"force": parts[:, :3], "moment": parts[:, 3:], **most})
    rivets = Rivets(_labelled(own, np.arange(5.0), np.array([3, 5])), d)
    rivet, largest, least = rivets.cycle()
    assert rivet == 3
    assert np.allclose(largest, 1.1 * loads[3][1]) and np.allclose(least, loads[3][3])
