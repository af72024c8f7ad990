"""Modes and interfaces of common cages of two rows against their whole meshes."""

from __future__ import annotations

import numpy as np
import pytest
from common_cages import COMMON, MM, places_of, pocket_places, reduced

from flexcage.cages.build import rigid_interface_of
from flexcage.cages.cage_type import cage_type_of
from flexcage.cages.conical.walls import pocket_walls
from flexcage.cages.window.defects import CrossbeamDefect
from flexcage.modes.rows import pocket_axes
from flexcage.stress.operators import von_mises
from flexcage.stress.recovery import CageLoads, StressRecovery

KINDS = tuple(COMMON)


def in_pockets(cage, kind, forces):
    """Nodal loads (3N, 1) of forces (2Z, F, n_st, 3) at stations, and their work on the modes."""
    made, count = cage.interface, 2 * COMMON[kind][1]
    spread = np.einsum("kfsa,kab->kfsb", forces, pocket_axes(cage.model, count)).reshape(-1, 3)
    modes = made.modes.reshape(*forces.shape, -1)
    return (made.weights.T @ spread).reshape(-1, 1), np.einsum("kfsa,kfsan->n", forces, modes)


def stations_of(cage, kind):
    made, count = cage.interface, 2 * COMMON[kind][1]
    return (count, len(made.single), made.weights.shape[0] // (count * len(made.single)), 3)


@pytest.mark.parametrize("kind", KINDS)
def test_modes_at_stations_of_both_rows_are_those_of_the_mesh(kind):
    cage, rng = reduced(kind), np.random.default_rng(1)
    forces = rng.standard_normal(stations_of(cage, kind))
    nodal, modal = in_pockets(cage, kind, forces)
    direct = cage.basis.shapes.reshape(-1, cage.basis.size).T @ nodal[:, 0]
    np.testing.assert_allclose(modal, direct, atol=1e-12 * np.abs(direct).max())


@pytest.mark.parametrize("kind", KINDS)
def test_stations_lie_in_the_pockets_that_they_are_of(kind):
    cage, count = reduced(kind), COMMON[kind][1]
    shape = stations_of(cage, kind)
    at = (cage.interface.weights @ cage.model.nodes).reshape(shape)
    for pocket in (0, count - 1, count, 2 * count - 1):
        x, r, t = pocket_places(at[pocket].reshape(-1, 3), kind, pocket).T
        assert np.abs(x).max() < 5.2 * MM and np.abs(t).max() < 5.5 * MM
        assert r == pytest.approx(0.5 * COMMON[kind][2], rel=0.15)
        if shape[1] == 1:  # station j is at its angle from +psi towards the cage's +x
            angle = np.arctan2(x - x.mean() * (kind == "window"), t)
            off = np.angle(np.exp(1j * (angle - cage.interface.stations)))
            assert np.median(np.abs(off)) < 0.1
        else:
            front, rear = t.reshape(shape[1], -1)[:2]
            assert (front > 0.0).all() and (rear < 0.0).all()


@pytest.mark.parametrize("kind", ["window", "barrel"])
def test_a_pocket_of_either_row_yields_through_stations_as_in_full(kind):
    cage, count = reduced(kind), COMMON[kind][1]
    made, shape = cage.interface, stations_of(reduced(kind), kind)
    for pocket in (4, count + 4):
        for face in range(4):
            forces = np.zeros(shape)
            forces[pocket, face] = normal_of(kind, pocket, face) / shape[2]
            nodal, modal = in_pockets(cage, kind, forces)
            full = (nodal.T @ cage.solver.solve(nodal)).item()
            pull = made.residual[pocket, face].mean(axis=0)
            soft = modal @ np.linalg.solve(cage.basis.stiffness, modal)
            assert soft + pull @ made.compliance[pocket] @ pull == pytest.approx(full, rel=0.03)


def normal_of(kind, pocket, face):
    """A face's normal as (x, r, psi), x of the cage."""
    cage, count = COMMON[kind][:2]
    if kind == "window":
        return np.array([[0, 0, 1], [0, 0, -1], [1, 0, 0], [-1, 0, 0]], float)[face]
    own = pocket_walls(cage).normal[face] @ cage.axes
    return own * ((-1.0 if pocket < count else 1.0), 1.0, 1.0)


@pytest.mark.parametrize("kind", ["machined", "crown"])
def test_a_ball_s_pocket_of_either_row_yields_as_much(kind):
    """The local compliance: both rows together are their own mirror image."""
    made, count = reduced(kind).interface, COMMON[kind][1]
    ahead = np.arange(len(made.stations))
    mirrored = -ahead % len(ahead)
    np.testing.assert_allclose(made.local[0], made.local[count][mirrored], rtol=2e-2)
    assert made.centre[:, 0] == pytest.approx(
        np.repeat([-0.5, 0.5], count) * COMMON[kind][3], abs=1e-12
    )


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["window", "barrel"])
def test_two_bases_of_a_common_cage_span_the_same(kind):
    """Craig and Bampton's and the default one: the same low frequencies, the same compliance."""
    one, other = reduced(kind), reduced(kind, method="craig_bampton")
    low = np.sort(one.basis.frequencies)[:8]
    assert np.sort(other.basis.frequencies)[:8] == pytest.approx(low, rel=5e-3)
    forces = np.zeros(stations_of(one, kind))
    forces[COMMON[kind][1] + 2, 0] = normal_of(kind, COMMON[kind][1], 0) / forces.shape[2]
    nodal, modal = in_pockets(other, kind, forces)
    full = (nodal.T @ other.solver.solve(nodal)).item()
    assert modal @ np.linalg.solve(other.basis.stiffness, modal) == pytest.approx(full, rel=0.03)


def test_offsets_of_either_row_are_those_of_its_defects():
    cage, count, *_ = COMMON["window"]
    defects = (CrossbeamDefect(crossbeam=count + 3, displacement=0.1 * MM),)
    made = rigid_interface_of(cage, pocket_count=count, defects=defects, places=places_of("window"))
    pockets = np.unique(np.nonzero(made.offset)[0])
    assert pockets.tolist() == [count + 2, count + 3] and len(made.offset) == 2 * count
    assert made.offset[count + 2, 0].min() == pytest.approx(-0.1 * MM, rel=1e-2)


@pytest.mark.parametrize("kind", ["window", "barrel"])
def test_stress_of_the_second_row_is_that_of_the_first(kind):
    """Rows in line: the mirror image of a load makes the mirror image of its stress."""
    cage = reduced(kind, staggered=False)
    count, shape = COMMON[kind][1], stations_of(cage, kind)
    recovery = StressRecovery(
        cage.model, cage.basis, cage.interface, places=cage_type_of(cage.cage).places()
    )
    peaks = []
    for pocket in (2, count + 2):
        forces = np.zeros(shape)
        forces[pocket, 0] = 10.0 * normal_of(kind, pocket, 0) / shape[2]
        loads = CageLoads(station_forces=forces)
        stress = von_mises(recovery.stress(recovery.displacement(loads), loads))
        peaks.append({
            name.split("_", 1)[1]: stress[vertices].max()
            for name, vertices in recovery.roots.items() if name.startswith(f"pocket{pocket}_")
        })  # fmt: skip
    swapped = {"window": str.maketrans("+-", "-+"), "barrel": {}}[kind]
    assert len(peaks[0]) == 4 and len(recovery.fillets) == 8 * count
    for name, peak in peaks[0].items():
        assert peaks[1][name.translate(swapped)] == pytest.approx(peak, rel=1e-3)
