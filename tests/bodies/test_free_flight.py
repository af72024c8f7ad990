"""Flexible body in a floating frame: particles, energy, and choices that change no flight."""

from __future__ import annotations

import numpy as np
import pytest
from free_motion import Tumbler, free_body, launch, tumbler
from scipy import sparse
from scipy.spatial.transform import Rotation

from flexcage.bodies.floating_frame import (
    FlexibleBody,
    flexible_body,
    frame_work,
    inertia_terms,
    marked,
    mass_matrix,
    scalar_mass,
    with_point_mass,
)
from flexcage.core.errors import InputError

SPIN_STIFFNESS = np.array([[3.0, 1, 0, 0], [1, 2, 0, -1], [0, 0, 4, 0], [0, -1, 0, 5]])


def kinetic_energy(M, v_body, w, qd):
    u = np.concatenate([v_body, w, qd])
    return 0.5 * u @ M @ u


@pytest.fixture(scope="module")
def flight():
    """The tight run of the case with mean-axis shapes: tumbler, data, mass, states."""
    flyer, d, mass = tumbler("free")
    return flyer, d, mass, flyer.fly(launch(flyer, d), d["time"][:51])


def rigid_part(d):
    """Translations and rotations (3, 12) taken from the free shapes to clamp the face."""
    gone = d["shapes_free"] - d["shapes_clamped"]
    points = d["nodes"]
    field = np.zeros((len(points), 3, 6))
    for j in range(3):
        field[:, :, j] = np.eye(3)[j]
        field[:, :, 3 + j] = np.cross(np.eye(3)[j], points)
    coefficients = np.linalg.lstsq(field.reshape(-1, 6), gone.reshape(-1, 12), rcond=None)[0]
    assert np.abs(field @ coefficients - gone).max() < 1e-9 * np.abs(gone).max()
    return coefficients[:3], coefficients[3:]


def fly_clamped(scale, d):
    """The flight with the frame tied to an end face, 5 ms; loads and modes ``scale`` times as big.

    The frames differ by a rotation linear in q, so both bases span the same motions to first
    order in q only; the start is carried over to that order, and answers differ as scale^2.
    """
    flyer, _, _ = tumbler("clamped")
    shift, turn = rigid_part(d)
    q, qd = scale * d["modal_start"], scale * d["modal_rate_start"]
    w = np.sqrt(scale) * d["angular_velocity"]
    A = Rotation.from_rotvec(turn @ q).as_matrix()
    start = flyer.start(
        x=shift @ q, rotation=turn @ q, q=q, qd=qd,
        v=d["velocity"] + np.cross(w, shift @ q) + shift @ qd, w=A.T @ (w + turn @ qd),
    )  # fmt: skip
    return flyer, flyer.fly(start, d["time"][:51:5])


def test_frame_tied_to_an_end_face_flies_the_same_way(flight):
    free, d, _, _ = flight
    seen, apart = d["observed"], []
    for scale in (0.1, 0.01):
        y0 = free.start(v=d["velocity"], w=np.sqrt(scale) * d["angular_velocity"],
                        q=scale * d["modal_start"], qd=scale * d["modal_rate_start"])  # fmt: skip
        flyer, states = fly_clamped(scale, d)
        assert np.abs(flyer.data.C).max() > 1e-3  # the coupling that this basis is there to try
        x = [flyer.nodes(y, d["nodes"][seen], d["shapes_clamped"][seen])[0] for y in states]
        other = free.fly(y0, d["time"][:51:5])
        ref = [free.nodes(y, d["nodes"][seen], d["shapes_free"][seen])[0] for y in other]
        apart.append(np.abs(np.array(x) - np.array(ref)).max())
    # deformations are 64 and 6.4 um; a coupling left out would be a share of them at any scale
    assert apart[1] < 1e-8 and apart[0] / apart[1] == pytest.approx(100.0, rel=0.1)


def test_turning_the_start_turns_the_flight(flight):
    flyer, d, _, states = flight
    turn = Rotation.from_rotvec([0.7, -1.9, 0.4])
    y0 = launch(flyer, d)
    y0[3:6] = turn.apply(y0[3:6])
    y0[6:10] = turn.as_quat(scalar_first=True)
    there = flyer.fly(y0, d["time"][:51:10])
    seen = d["observed"]
    for y, before in zip(there, states[:51:10]):
        here = flyer.nodes(before, d["nodes"][seen], d["shapes_free"][seen])[0]
        got = flyer.nodes(y, d["nodes"][seen], d["shapes_free"][seen])[0]
        np.testing.assert_allclose(got, turn.apply(here), atol=1e-11)


def particles(n_modes=4, count=30, seed=3, geometric=None):
    """Point masses with random shapes: a body whose every inertia term is a sum over points."""
    rng = np.random.default_rng(seed)
    points, m = rng.normal(size=(count, 3)), rng.uniform(0.5, 1.5, count)
    shapes = 0.3 * rng.normal(size=(count, 3, n_modes))
    body = flexible_body(
        points, sparse.diags(m).tocsr(), shapes, np.eye(n_modes), geometric=geometric
    )
    return body, points, m, shapes, rng


def test_every_inertia_term_against_particles():
    """M a + h = sum over particles of J^T m r'', with r'' from the kinematics of a moving frame."""
    body, points, m, shapes, rng = particles()
    v, w, q, qd = rng.normal(size=3), rng.normal(size=3), rng.normal(size=4), rng.normal(size=4)
    a, alpha, qdd = rng.normal(size=3), rng.normal(size=3), rng.normal(size=4)
    work = frame_work(4)
    inertia_terms(body.data, w, q, qd, work)
    got = mass_matrix(body.data, work) @ np.concatenate([a, alpha, qdd]) + work.h
    p, u = points + shapes @ q, shapes @ qd
    acc = a + np.cross(alpha, p) + np.cross(w, np.cross(w, p)) + 2 * np.cross(w, u) + shapes @ qdd
    force = m[:, None] * acc
    expected = np.concatenate(
        [force.sum(0), np.cross(p, force).sum(0), np.einsum("ac,acm->m", force, shapes)]
    )
    np.testing.assert_allclose(got, expected, rtol=1e-12, atol=1e-12)
    np.testing.assert_allclose(
        mass_matrix(body.data, work), mass_matrix(body.data, work).T, atol=1e-12
    )
    speed = v + np.cross(w, p) + u
    energy = 0.5 * np.sum(m[:, None] * speed**2)
    assert kinetic_energy(mass_matrix(body.data, work), v, w, qd) == pytest.approx(
        energy, rel=1e-12
    )


@pytest.mark.parametrize("stiffened", [False, True])
def test_velocity_terms_do_no_work(stiffened):
    """d/dt of the kinetic energy is u . (M a + h): the gyroscopic part of h gives nothing."""
    body, _, _, _, rng = particles(geometric=SPIN_STIFFNESS if stiffened else None)
    w, q, qd = rng.normal(size=3), rng.normal(size=4), rng.normal(size=4)
    v, a = rng.normal(size=3), rng.normal(size=10)
    work = frame_work(4)
    inertia_terms(body.data, w, q, qd, work)
    # v holds space velocity in body axes: d/dt (A^T v) = A^T v' - w x A^T v
    power = np.concatenate([v, w, qd]) @ (mass_matrix(body.data, work) @ a + work.h)

    def energy(t):
        moved = frame_work(4)
        qt, qdt, wt = q + t * qd, qd + t * a[6:], w + t * a[3:6]
        inertia_terms(body.data, wt, qt, qdt, moved)
        return kinetic_energy(
            mass_matrix(body.data, moved), v + t * (a[:3] - np.cross(w, v)), wt, qdt
        )

    assert (energy(1e-6) - energy(-1e-6)) / 2e-6 == pytest.approx(power, rel=1e-7)


def test_geometric_stiffness_keeps_energy_and_angular_momentum():
    """A tumbling body whose inertia about x falls by q^T G q: all of it in one Lagrangian."""
    body, _, m, _, rng = particles(geometric=SPIN_STIFFNESS)
    body = FlexibleBody(body.data._replace(kff=200.0 * np.eye(4)))
    flyer = Tumbler(body)
    y0 = flyer.start(w=(1.5, 0.3, -0.2), q=0.2 * rng.normal(size=4), qd=rng.normal(size=4))
    seen = []
    for y in flyer.fly(y0, np.linspace(0.0, 5.0, 6)):
        x, v, quat, w, q, qd = flyer.split(y)
        A = Rotation.from_quat(quat, scalar_first=True).as_matrix()
        inertia_terms(body.data, w, q, qd, flyer.work)
        momenta = mass_matrix(body.data, flyer.work) @ np.concatenate([A.T @ v, w, qd])
        energy = (
            kinetic_energy(mass_matrix(body.data, flyer.work), A.T @ v, w, qd)
            + 0.5 * q @ body.data.kff @ q
        )
        linear = A @ momenta[:3]
        seen.append([energy, *linear, *(A @ momenta[3:6] + np.cross(x, linear))])
    without = Tumbler(FlexibleBody(body.data._replace(gff=np.zeros((0, 0)))))
    assert np.abs(without.fly(y0, np.array([0.0, 5.0]))[-1] - y).max() > 0.01
    np.testing.assert_allclose(seen, [seen[0]] * 6, rtol=1e-8, atol=1e-8)


def test_mass_properties_of_the_mesh():
    d, mass = free_body()
    body = flexible_body(d["nodes"], mass, d["shapes_free"], d["stiffness_free"])
    assert np.abs(body.centre_of_mass).max() < 1e-12
    turn = np.stack([np.cross(e, d["nodes"]) for e in np.eye(3)])
    np.testing.assert_allclose(
        body.inertia, np.einsum("iac,jac->ij", turn, np.stack([mass @ t for t in turn])), atol=1e-16
    )
    np.testing.assert_allclose(body.data.mff, np.eye(12), atol=1e-9)  # mass-normalised
    assert "12 modes" in repr(body)


def test_point_mass_is_a_particle_more():
    body, points, m, shapes, _ = particles(n_modes=1)
    heavier = with_point_mass(body, 0.7, np.array([0.1, -2.0, 0.3]))
    bigger = flexible_body(
        np.vstack([points, [0.1, -2.0, 0.3]]), sparse.diags(np.append(m, 0.7)).tocsr(),
        np.concatenate([shapes, np.zeros((1, 3, 1))]), np.eye(1),
    )  # fmt: skip
    for a, b in zip(heavier.data, bigger.data):
        np.testing.assert_allclose(a, b, atol=1e-12)


def test_mass_matrix_of_three_directions_or_of_one():
    d, mass = free_body()
    three = sparse.kron(mass, sparse.eye(3)).tocsr()
    assert abs(scalar_mass(three, 405) - mass).max() < 1e-18
    with pytest.raises(InputError, match="same value in x, y and z"):
        scalar_mass(sparse.kron(mass, sparse.diags([1.0, 1.0, 2.0])).tocsr(), 405)


def test_matrices_that_are_replaced_are_looked_at_anew():
    """Kernels take matrices marked as diagonal by their diagonals alone."""
    body = particles()[0].data
    own = body._replace(mff=np.eye(4), kff=np.eye(4), dff=np.zeros((4, 4)))
    assert marked(own).plain == 1
    assert marked(marked(own)._replace(kff=np.ones((4, 4)))).plain == 0
