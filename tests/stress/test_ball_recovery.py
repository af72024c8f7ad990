"""Stress of ball cages: histories and mode acceleration against full finite-element solutions."""

import numpy as np
import pytest
from ball_stress_cage import BALL_CAGE, BALL_DEFECTS, BALL_POCKETS, ball_recovery

from flexcage.cages.round_pocket.interface import rigid_ball_interface
from flexcage.core.errors import InputError
from flexcage.stress.fields import StressFields
from flexcage.stress.history import stress_history
from flexcage.stress.operators import von_mises
from flexcage.stress.places import in_words
from flexcage.stress.recovery import CageLoads, StressRecovery


@pytest.fixture(scope="module")
def sound():
    return ball_recovery(count=8)


@pytest.fixture(scope="module")
def damaged():
    return ball_recovery(BALL_DEFECTS, kind="free_free", count=6)


def forces_of(samples):
    """Random forces (nt, Z, 1, 16, 3) at a few stations, friction included."""
    rng = np.random.default_rng(1)
    one = rng.normal(size=(BALL_POCKETS, 1, 16, 3))
    one *= rng.random((BALL_POCKETS, 1, 16, 1)) < 0.1
    return one[None] * rng.normal(size=(samples, BALL_POCKETS, 1, 1, 1))


def quasi_static(recovery, forces):
    """Modal coordinates (n,) of a body at rest under station forces."""
    work = np.einsum("ksa,ksan->n", forces[:, 0], recovery.interface.modes)
    return np.linalg.solve(recovery.basis.stiffness, work)


def full_static(recovery, forces):
    """Full-mesh answer of nodal loads formed station by station, not by the recovery."""
    load = np.zeros((len(recovery.model.nodes), 3))
    rows = recovery.interface.weights.toarray().reshape(BALL_POCKETS, 16, -1)
    for pocket, _, station in np.argwhere(np.any(forces != 0.0, axis=-1)):
        angle = 2.0 * np.pi * pocket / BALL_POCKETS
        x, r, psi = forces[pocket, 0, station]
        c, s = np.cos(angle), np.sin(angle)
        load += np.outer(rows[pocket, station], [x, r * c - psi * s, r * s + psi * c])
    return recovery.solver.solve(load.reshape(-1, 1)).reshape(-1, 3)


def stress_under(recovery, forces):
    """Equivalent stress at all vertices under station forces, by ``full_static``."""
    moved = full_static(recovery, forces)
    return von_mises(recovery.stress(moved, CageLoads(station_forces=forces)))


def test_mode_acceleration_is_the_full_static_answer(sound):
    forces = forces_of(1)[0]
    moved = sound.displacement(CageLoads(station_forces=forces))
    expected = full_static(sound, forces)
    np.testing.assert_allclose(moved, expected, atol=1e-9 * np.abs(expected).max())


@pytest.mark.parametrize("which", ["sound", "damaged"])
def test_history_equals_the_full_answer(request, which):
    """Any forces at any stations: superposed peaks, places and envelope are those of the mesh."""
    recovery = request.getfixturevalue(which)
    forces = forces_of(3)
    q = np.stack([quasi_static(recovery, f) for f in forces])
    fields = StressFields(recovery)
    history = stress_history(fields, q, forces)
    full = np.stack([stress_under(recovery, f) for f in forces])
    searched = fields.surface[fields.searched]
    np.testing.assert_allclose(history.peak, full[:, searched].max(axis=1), rtol=1e-4)
    np.testing.assert_allclose(history.envelope, full[:, fields.surface].max(axis=0), rtol=2e-3)
    for i, vertices in enumerate(fields.places.values()):
        np.testing.assert_allclose(history.places[:, i], full[:, vertices].max(axis=1), rtol=1e-3)


def test_lands_and_spin_stress_a_ball_cage(sound):
    land = np.zeros((2, 24, 3))
    land[1, 3], land[0, 10] = [0.0, -5.0, 0.3], [1.0, 2.0, 0.0]
    none = np.zeros((BALL_POCKETS, 1, 16, 3))
    full = von_mises(
        sound.stress(sound.displacement(CageLoads(station_forces=none, land_forces=land)))
    )
    work = np.einsum("lja,ljan->n", land, sound.interface.land)
    q = np.linalg.solve(sound.basis.stiffness, work)[None]
    history = stress_history(StressFields(sound), q, none[None], land[None])
    np.testing.assert_allclose(history.envelope, full[history.surface], rtol=3e-3)
    spin = 500.0
    loads = CageLoads(station_forces=none, angular_velocity=np.array([spin, 0.0, 0.0]))
    stress = von_mises(sound.stress(sound.displacement(loads)))
    ends = np.unique(np.concatenate([sound.model.group("end+x"), sound.model.group("end-x")]))
    ring = sound.model.material.density * (spin * 9.5e-3) ** 2
    assert 0.8 < stress[ends].mean() / ring < 2.0


def test_places_are_the_thinnest_sections(sound):
    places = sound.roots
    assert len(places) == 4 * BALL_POCKETS
    zone = sound.contact_zone
    assert len(zone) and not np.intersect1d(zone, np.concatenate(list(places.values()))).size
    angle = 2.0 * np.pi * 3 / BALL_POCKETS
    for name, axis, sign in (
        ("waist_front", 1, 1.0), ("waist_rear", 1, -1.0), ("rim+x", 0, 1.0), ("rim-x", 0, -1.0)
    ):  # fmt: skip
        points = sound.model.points[places[f"pocket3_{name}"]]
        t = points @ [0.0, -np.sin(angle), np.cos(angle)]
        assert len(points) >= 6
        assert np.all(sign * (points[:, 0], t)[axis] > 2.7e-3)
        assert np.abs((points[:, 0], t)[1 - axis]).max() < 6e-3 * np.tan(np.pi / 8) + 1e-9
    radius = np.hypot(*sound.model.points[zone, 1:].T)
    assert radius.min() > 8e-3 + 1e-6 and radius.max() < 11e-3 - 1e-6
    assert in_words("pocket3_waist_front") == "pocket 3, waist front"
    assert in_words("pocket3_rim+x") == "pocket 3, rim +x"
    assert in_words("pocket5_root_rear+x") == "pocket 5, corner rear +x"


def test_a_pushed_web_is_the_most_stressed(sound):
    """A ball on the front wall of pocket 3: of all waists, those of web 4 carry the most."""
    forces = np.zeros((BALL_POCKETS, 1, 16, 3))
    forces[3, 0, 0, 2] = 10.0
    stress = von_mises(sound.stress(sound.displacement(CageLoads(station_forces=forces))))
    places = sound.roots
    waists = {name: stress[at].max() for name, at in places.items() if "waist" in name}
    ranking = sorted(waists, key=waists.get)
    assert set(ranking[-2:]) == {"pocket3_waist_front", "pocket4_waist_rear"}
    assert waists[ranking[-1]] > 1.5 * waists[ranking[-3]]


def test_a_rigid_ball_cage_is_refused(sound):
    rigid = rigid_ball_interface(BALL_CAGE, pocket_count=BALL_POCKETS)
    with pytest.raises(InputError, match="no stress"):
        StressRecovery(sound.model, sound.basis, rigid, places=sound.places)
