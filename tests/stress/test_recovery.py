"""Mode acceleration and superposed histories against full finite-element solutions."""

import numpy as np
import pytest
from stress_cage import CAGE, POCKETS, make_recovery

from flexcage.cages.window.interface import rigid_interface
from flexcage.core.errors import InputError
from flexcage.modes.spec import ModesSpec
from flexcage.stress.fields import StressFields
from flexcage.stress.history import stress_history
from flexcage.stress.operators import von_mises
from flexcage.stress.recovery import CageLoads, StressRecovery


def station_forces(seed=0, samples=None):
    """Random forces at a few stations, friction included."""
    rng = np.random.default_rng(seed)
    shape = (POCKETS, 4, 7, 3)
    one = rng.normal(size=shape) * (rng.random(shape[:3]) < 0.1)[..., None]
    if samples is None:
        return one
    return one[None] * rng.normal(size=(samples, POCKETS, 1, 1, 1))


def normal_forces(samples):
    forces = station_forces(samples=samples)
    forces[..., :2, :, 0:2] = 0.0  # crossbeam faces: psi alone
    forces[..., 2:, :, 1:] = 0.0  # side beams: x alone
    return forces


def quasi_static(recovery, forces):
    """Modal coordinates (n,) of a body at rest under station forces."""
    work = np.einsum("kfsa,kfsan->n", forces, recovery.interface.modes)
    return np.linalg.solve(recovery.basis.stiffness, work)


def full_static(recovery, forces):
    """Full-mesh answer of nodal loads formed station by station, not by the recovery."""
    interface = recovery.interface
    load = np.zeros((len(recovery.model.nodes), 3))
    rows = interface.weights.toarray().reshape(POCKETS, 4, 7, -1)
    for pocket, face, station in np.argwhere(np.any(forces != 0.0, axis=-1)):
        angle = 2.0 * np.pi * pocket / POCKETS
        x, r, psi = forces[pocket, face, station]
        c, s = np.cos(angle), np.sin(angle)
        load += np.outer(rows[pocket, face, station], [x, r * c - psi * s, r * s + psi * c])
    return recovery.solver.solve(load.reshape(-1, 1)).reshape(-1, 3)


def stress_under(recovery, forces):
    """Equivalent stress at all vertices under station forces, by ``full_static``."""
    moved = full_static(recovery, forces)
    return von_mises(recovery.stress(moved, CageLoads(station_forces=forces)))


def test_mode_acceleration_is_the_full_static_answer(recovery):
    forces = station_forces()
    moved = recovery.displacement(CageLoads(station_forces=forces))
    expected = full_static(recovery, forces)
    np.testing.assert_allclose(moved, expected, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("which", ["recovery", "damaged", "free_only"])
def test_history_equals_the_full_answer(request, which):
    """Normal forces at any stations: the superposed peak and envelope within 1e-4 of full FE."""
    recovery = request.getfixturevalue(which)
    forces = normal_forces(3)
    q = np.stack([quasi_static(recovery, f) for f in forces])
    fields = StressFields(recovery)
    history = stress_history(fields, q, forces)
    full = np.stack([stress_under(recovery, f) for f in forces])
    searched = fields.surface[fields.searched]
    np.testing.assert_allclose(history.peak, full[:, searched].max(axis=1), rtol=1e-4)
    np.testing.assert_allclose(history.envelope, full[:, fields.surface].max(axis=0), rtol=1e-3)
    for i, vertices in enumerate(fields.places.values()):
        np.testing.assert_allclose(history.places[:, i], full[:, vertices].max(axis=1), rtol=1e-3)
    assert full[history.peak_sample, history.peak_vertex[history.peak_sample]] == pytest.approx(
        full[:, searched].max(), rel=1e-4
    )
    assert "peak equivalent stress" in history.summary()


def test_evenly_spread_friction_is_exact_in_a_history(recovery):
    forces = np.zeros((1, POCKETS, 4, 7, 3))
    forces[0, 2, 0, :, 2], forces[0, 2, 0, :, 1], forces[0, 4, 3, :, 2] = 1.0, -0.1, 0.2
    q = quasi_static(recovery, forces[0])[None]
    history = stress_history(StressFields(recovery), q, forces)
    full = stress_under(recovery, forces[0])
    np.testing.assert_allclose(history.envelope, full[history.surface], rtol=1e-3)


def test_land_forces_enter_both_ways_alike(recovery):
    land = np.zeros((2, 24, 3))
    land[1, 3], land[0, 10] = [0.0, -5.0, 0.3], [1.0, 2.0, 0.0]
    none = np.zeros((POCKETS, 4, 7, 3))
    loads = CageLoads(station_forces=none, land_forces=land)
    full = von_mises(recovery.stress(recovery.displacement(loads), loads))
    work = np.einsum("lja,ljan->n", land, recovery.interface.land)
    q = np.linalg.solve(recovery.basis.stiffness, work)[None]
    history = stress_history(StressFields(recovery), q, none[None], land[None])
    np.testing.assert_allclose(history.envelope, full[history.surface], rtol=2e-3)


def test_a_bearing_without_lands_has_no_force_there(recovery):
    forces = np.zeros((POCKETS, 4, 7, 3))
    forces[2, 0, :, 2] = 1.0
    found = [
        recovery.displacement(CageLoads(station_forces=forces, land_forces=land))
        for land in (None, np.zeros((2, 0, 3)))
    ]
    np.testing.assert_array_equal(*found)


def test_a_freely_vibrating_mode_is_recovered_from_its_acceleration(recovery):
    """No force, qddot = -omega^2 q and D qdot = 0 give back Phi q."""
    basis = recovery.basis
    q = np.zeros(basis.size)
    q[:5] = [1e-6, -2e-6, 0.5e-6, 1e-7, 3e-7]
    omega2 = np.diag(basis.stiffness)
    none = np.zeros((POCKETS, 4, 7, 3))
    loads = CageLoads(station_forces=none, modal_acceleration=-omega2 * q)
    expected = basis.shapes @ q
    moved = recovery.displacement(loads)
    np.testing.assert_allclose(moved, expected, atol=1e-8 * np.abs(expected).max())
    half = CageLoads(
        station_forces=none, modal_acceleration=-0.5 * omega2 * q, modal_damping=-0.5 * omega2 * q
    )
    np.testing.assert_allclose(recovery.displacement(half), expected, atol=1e-13)


def test_a_rigidly_accelerated_cage_feels_its_forces_less_inertia(recovery):
    """Adding M times any rigid motion (gravity, thrust) to the loads changes nothing."""
    forces = station_forces(3)
    loads = recovery.nodal_forces(CageLoads(station_forces=forces)).reshape(-1, 1)
    model = recovery.model
    pushed = loads + model.mass_times(model.rigid_modes) @ np.full((6, 1), 50.0)
    ours = recovery.displacement(CageLoads(station_forces=forces)).reshape(-1, 1)
    np.testing.assert_allclose(recovery.solver.solve(pushed), ours, atol=1e-9 * np.abs(ours).max())


def test_spin_stresses_the_cage_as_a_ring(recovery):
    """Outside the pockets' rows the side rings carry rho w^2 r^2 and the crossbeams' load."""
    none = np.zeros((POCKETS, 4, 7, 3))
    spin = 283.7
    loads = CageLoads(station_forces=none, angular_velocity=[spin, 0, 0])
    model = recovery.model
    ends = np.unique(np.concatenate([model.group("end+x"), model.group("end-x")]))
    stress = von_mises(recovery.stress(recovery.displacement(loads), loads))[ends].mean()
    ring = model.material.density * (spin * 21.75e-3) ** 2
    assert 1.0 < stress / ring < 2.5


def test_bases_agree_on_the_stress(recovery):
    """A fully dynamic basis has the same static stress fields."""
    other = make_recovery((), ModesSpec(dynamic="all", count=12))
    forces = normal_forces(2)
    answers = []
    for one in (recovery, other):
        q = np.stack([quasi_static(one, f) for f in forces])
        answers.append(stress_history(StressFields(one), q, forces).envelope)
    np.testing.assert_allclose(answers[0], answers[1], rtol=2e-3)


def test_places_lie_at_the_pocket_corners(recovery):
    places = recovery.roots
    assert len(places) == 4 * POCKETS
    vertices = recovery.model.points[places["pocket3_root_front+x"]]
    angle = 2.0 * np.pi * 3 / POCKETS
    across = vertices @ [0.0, -np.sin(angle), np.cos(angle)]
    assert np.all(across > 3.0e-3 - 1e-9) and np.all(vertices[:, 0] > 3.6e-3)
    zone = recovery.contact_zone
    assert len(zone) and not np.intersect1d(zone, np.concatenate(list(places.values()))).size


def test_a_rigid_cage_is_refused(recovery):
    rigid = rigid_interface(CAGE, pocket_count=POCKETS)
    with pytest.raises(InputError, match="no stress"):
        StressRecovery(recovery.model, recovery.basis, rigid, places=recovery.places)
