"""The reduced ball cage: stations, modes and local compliance against the full mesh."""

from __future__ import annotations

import numpy as np
import pytest
from modes_ball_cage import BALL_CAGE, BALL_DEFECTS, POCKETS, ball_mesh
from modes_cage import assert_same_fields

from flexcage.cages.build import reduce_cage, rigid_interface_of
from flexcage.cages.round_pocket.interface import (
    ball_cage_interface,
    indentations,
    mean_indentation,
    rigid_ball_interface,
    wall_normals,
    wall_stations,
)
from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import assemble
from flexcage.fem.symmetry import find_symmetry
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.modes import reduction
from flexcage.modes.pockets import pocket_frame
from flexcage.modes.registry import build_basis
from flexcage.modes.spec import ModesSpec
from flexcage.modes.table import mode_table

MATERIAL = MATERIALS["polyimide"]


class Cage:
    """Model, factored body, basis and interface of the small cage."""

    def __init__(self, defects=(), fineness="coarse", **modes):
        self.defects = defects
        self.model = assemble(ball_mesh(defects, fineness), MATERIAL)
        self.solver = FreeBodySolver(self.model)
        self.basis = build_basis(
            self.model, pocket_count=POCKETS, spec=ModesSpec(**modes), solver=self.solver
        )
        self.interface = ball_cage_interface(
            self.model,
            self.basis,
            pocket_count=POCKETS,
            cage=BALL_CAGE,
            defects=defects,
            solver=self.solver,
        )


@pytest.fixture(scope="module")
def sound():
    return Cage(count=12)


@pytest.fixture(scope="module")
def damaged():
    return Cage(BALL_DEFECTS, count=12)


@pytest.fixture(scope="module")
def finer():
    return Cage(fineness="medium", count=12)


def wall_force(cage, pocket, station):
    """Nodal load (3N, 1) of 1 N at a station along its normal, turned into the cage's frame."""
    row = cage.interface.weights[pocket * 16 + station].toarray()[0]
    turn, theta = 2.0 * np.pi * pocket / POCKETS, 2.0 * np.pi * station / 16
    normal = [np.sin(theta), -np.sin(turn) * np.cos(theta), np.cos(turn) * np.cos(theta)]
    return np.outer(row, normal).reshape(-1, 1)


def test_an_undamaged_cage_is_cyclic(sound, damaged):
    assert find_symmetry(sound.model, POCKETS) is not None
    assert find_symmetry(damaged.model, POCKETS) is None
    local = sound.interface.local
    np.testing.assert_allclose(local, np.tile(local[0], (POCKETS, 1)), rtol=1e-9)
    mirrored = local[0, (8 - np.arange(16)) % 16]  # psi -> -psi, and x -> -x
    np.testing.assert_allclose(local[0], mirrored, rtol=1e-3)
    np.testing.assert_allclose(local[0], local[0, -np.arange(16)], rtol=1e-3)


def test_stations_lie_where_they_say(sound):
    at = (sound.interface.weights @ sound.model.nodes).reshape(POCKETS, 16, 3)
    for k in range(POCKETS):
        local = at[k] @ pocket_frame(k, POCKETS).T
        angle = np.arctan2(local[:, 0], local[:, 2])
        apart = (angle - sound.interface.stations + np.pi) % (2.0 * np.pi) - np.pi
        assert np.abs(apart).max() < 0.06
        np.testing.assert_allclose(np.hypot(local[:, 0], local[:, 2]), 3e-3, rtol=0.04)


def test_stations_of_a_defect_follow_its_wall(damaged):
    at = (damaged.interface.weights @ damaged.model.nodes).reshape(POCKETS, 16, 3)
    outward = np.empty((POCKETS, 16))
    for k in range(POCKETS):
        outward[k] = np.sum(at[k] @ pocket_frame(k, POCKETS).T * damaged.interface.normals, axis=1)
    np.testing.assert_allclose(outward[2], 3.2e-3, rtol=0.04)  # enlarged
    np.testing.assert_allclose(outward[4, [0, 8]], 3.0e-3, rtol=0.02)  # a slot along x
    np.testing.assert_allclose(outward[4, [4, 12]], 3.4e-3, rtol=0.03)
    np.testing.assert_allclose(outward[6, [4, 12]], [3.3e-3, 2.7e-3], rtol=0.03)  # displaced
    np.testing.assert_allclose(outward[6, [0, 8]], [3.2e-3, 2.8e-3], rtol=0.03)


def test_weights_spread_a_force_without_loss(sound):
    rows = np.asarray(sound.interface.weights.sum(axis=1)).ravel()
    np.testing.assert_allclose(rows, 1.0, rtol=1e-12)
    rng = np.random.default_rng(3)
    forces = rng.normal(size=(POCKETS, 16, 3))
    frames = np.stack([pocket_frame(k, POCKETS) for k in range(POCKETS)])
    nodal = sound.interface.weights.T @ np.einsum("ksa,kab->ksb", forces, frames).reshape(-1, 3)
    np.testing.assert_allclose(
        np.einsum("ksa,ksan->n", forces, sound.interface.modes),
        np.einsum("na,nam->m", nodal, sound.basis.shapes),
        rtol=1e-8,
    )


@pytest.mark.parametrize("which", ["sound", "damaged"])
def test_deflection_at_a_wall_is_the_full_mesh_one(request, which):
    """Modes, local compliance and the patch's own indentation together, within 2 %."""
    cage = request.getfixturevalue(which)
    interface = cage.interface
    shown = indentations(BALL_CAGE, interface, interface.stations)
    for pocket, station in ((0, 0), (2, 3), (4, 4), (4, 8), (6, 15), (7, 0)):
        load = wall_force(cage, pocket, station)
        full = (load.T @ cage.solver.solve(load)).item()
        modal = interface.modes[pocket, station].T @ interface.normals[station]
        ours = modal @ np.linalg.solve(cage.basis.stiffness, modal)
        ours += interface.local[pocket, station] + shown[pocket, station]
        assert ours == pytest.approx(full, rel=0.02)


@pytest.mark.parametrize("station", [0.0, 0.5, 2.0, 2.5, 4.0, 9.3])
def test_a_patch_of_its_own_between_stations(finer, station):
    """A pressure that falls off over 2 mm by 3 mm at mid-height, on the full mesh.

    What is left is the wall's edges, which a half-space has not.
    """
    model, interface = finer.model, finer.interface
    theta = 2.0 * np.pi * station / 16

    def pressure(points):
        x, y, t = points.T
        along = 3e-3 * ((np.arctan2(x, t) - theta + np.pi) % (2.0 * np.pi) - np.pi)
        high = np.hypot(y, t) - 11.5e-3
        lobes = (1.5 - np.abs(along) / 1e-3, 1.5 - np.abs(high) / 1.5e-3)
        return (np.clip(lobes[0], 0.0, 1.0) * np.clip(lobes[1], 0.0, 1.0))[None]

    spread = model.face_weights(model.group("pocket0_wall"), pressure).toarray()[0]
    normal = np.array([np.sin(theta), 0.0, np.cos(theta)])
    load = np.outer(spread / spread.sum(), normal).reshape(-1, 1)
    full = (load.T @ finer.solver.solve(load)).item()
    first, share = int(station), station % 1.0
    pair = [first, (first + 1) % 16]
    modal = normal @ np.tensordot([1.0 - share, share], interface.modes[0, pair], axes=1)
    ours = modal @ np.linalg.solve(finer.basis.stiffness, modal)
    ours += [1.0 - share, share] @ interface.local[0, pair]
    ours += mean_indentation(MATERIAL, 2e-3, 3e-3)
    assert ours == pytest.approx(full, rel=0.04)


def test_a_pinched_cage_gives_way_as_the_full_mesh(sound):
    """Opposite pockets pulled apart: what the modes miss of the ring's ovalising is local."""
    interface = sound.interface
    loads = wall_force(sound, 0, 0) - wall_force(sound, 4, 0)
    full = (loads.T @ sound.solver.solve(loads)).item()
    forces = np.zeros((POCKETS, 16, 3))
    forces[0, 0, 2], forces[4, 0, 2] = 1.0, -1.0
    work = np.einsum("ksa,ksan->n", forces, interface.modes)
    ours = work @ np.linalg.solve(sound.basis.stiffness, work)
    shown = indentations(BALL_CAGE, interface, interface.stations)
    ours += interface.local[[0, 4], 0].sum() + shown[[0, 4], 0].sum()
    assert ours == pytest.approx(full, rel=0.02)


def test_more_modes_leave_less_to_the_local_compliance(sound):
    more = ball_cage_interface(
        sound.model,
        build_basis(
            sound.model, pocket_count=POCKETS, spec=ModesSpec(count=40), solver=sound.solver
        ),
        pocket_count=POCKETS,
        cage=BALL_CAGE,
        solver=sound.solver,
    )
    assert np.all(more.local <= sound.interface.local * (1.0 + 1e-9))
    assert np.all(more.local > 0.0) and more.local.max() < sound.interface.local.max()


def test_local_compliance_does_not_depend_on_the_mesh(sound, finer):
    """The part that would, the indentation under a concentrated force, is spread and taken out."""
    np.testing.assert_allclose(finer.interface.local[0], sound.interface.local[0], rtol=0.1)


def test_a_slot_makes_its_sides_softer_and_a_crack_its_web(sound, damaged):
    change = damaged.interface.local / sound.interface.local
    assert change[4, 0] > 1.05 and change[4, 8] > 1.05  # a longer crossing beside the slot
    assert change[0, 1] > 1.05 and change[1, 7] > 1.05  # both sides of web 1, towards its crack
    np.testing.assert_allclose(change[3, 4], 1.0, atol=0.1)


@pytest.mark.parametrize(
    ("aspect", "m"),
    [(1, 0.95), (1.5, 0.94), (2, 0.92), (3, 0.88), (5, 0.82), (10, 0.71), (100, 0.37)],
)
def test_mean_indentation_is_the_tabulated_one(aspect, m):
    """Timoshenko and Goodier, Theory of Elasticity, 3rd ed. 1970, art. 139."""
    steel = Material(name="steel", youngs_modulus=2e11, poisson_ratio=0.3, density=7800.0)
    mean = mean_indentation(steel, 1e-3, aspect * 1e-3)
    assert mean * 2e11 / 0.91 * np.sqrt(aspect * 1e-6) == pytest.approx(m, abs=0.006)


@pytest.mark.parametrize("height", [1.0, 2.3, 5.0])
def test_a_hat_indents_as_the_even_patch_that_stands_for_it(height):
    """Work of a hat's own pressure by the sum over strips pressed evenly, two by two."""
    plain = Material(name="plain", youngs_modulus=1.0, poisson_ratio=0.0, density=1.0)
    n = 240
    width = 2.0 / n  # strips of a hat of base -1 .. 1
    middles = -1.0 + width * (np.arange(n) + 0.5)
    share = (1.0 - np.abs(middles)) / np.sum(1.0 - np.abs(middles))

    def double(w):  # integral over two equal strips' distance: second difference of W(w)
        return mean_indentation(plain, w, height) * w**2 if w else 0.0

    gaps = np.arange(n)
    w = np.array([double(k * width) for k in range(n + 1)])
    kernel = np.empty(n)
    kernel[0] = w[1]
    kernel[1:] = 0.5 * (w[gaps[1:] + 1] - 2.0 * w[gaps[1:]] + w[gaps[1:] - 1])
    apart = np.abs(gaps[:, None] - gaps[None])
    exact = share @ (kernel[apart] / width**2) @ share
    assert mean_indentation(plain, np.sqrt(2.0), height) == pytest.approx(exact, rel=6e-3)


def test_a_rigid_cage_has_the_same_walls(damaged):
    rigid = rigid_ball_interface(BALL_CAGE, pocket_count=POCKETS, defects=BALL_DEFECTS)
    for name in ("stations", "centre", "radius", "slot"):
        np.testing.assert_array_equal(getattr(rigid, name), getattr(damaged.interface, name))
    assert rigid.modes.shape == (POCKETS, 16, 3, 0) and rigid.land.shape == (2, 24, 3, 0)
    assert not rigid.local.any() and rigid.weights is None
    np.testing.assert_allclose(rigid.normals[4], [1.0, 0.0, 0.0], atol=1e-15)
    np.testing.assert_allclose(wall_normals(wall_stations(4))[3], [-1.0, 0.0, 0.0], atol=1e-15)


def test_frequencies_settle_with_the_mesh(sound, finer):
    """The first three pairs of a cyclic body; the wall's chords are the larger part of this."""
    coarse, medium = (cage.basis.frequencies[:6] for cage in (sound, finer))
    np.testing.assert_allclose(coarse, medium, rtol=0.012)
    np.testing.assert_allclose(medium[::2], medium[1::2], rtol=1e-6)


@pytest.mark.slow
def test_frequencies_settle_further_with_a_fine_mesh(sound, finer):
    """Chords of the curved wall leave too much of it: 1.2 % and 0.9 % above the fine mesh's."""
    solver = FreeBodySolver(assemble(ball_mesh(fineness="fine"), MATERIAL))
    fine = np.sqrt(free_modes(solver, 6)[0][:6]) / (2.0 * np.pi)
    np.testing.assert_allclose(finer.basis.frequencies[:6], fine, rtol=0.01)
    misses = [np.abs(c.basis.frequencies[:6] / fine - 1.0).max() for c in (sound, finer)]
    assert misses[1] < 0.8 * misses[0]


def test_rigid_motion_and_inertia_of_the_model(sound):
    """Kinetic energy of a turn about each axis by the points of a fine cloud in the body."""
    n = 120
    x = (np.arange(n) + 0.5) / n * 12e-3 - 6e-3
    psi = (np.arange(8 * n) + 0.5) / (8 * n) * 2.0 * np.pi
    r = 10e-3 + (np.arange(24) + 0.5) / 24 * 3e-3
    x, psi, r = np.meshgrid(x, psi, r, indexing="ij")
    nearest = np.round(psi / (0.25 * np.pi)) * 0.25 * np.pi
    inside = np.hypot(x, r * np.sin(psi - nearest)) > 3e-3
    cell = 12e-3 / n * 2.0 * np.pi / (8 * n) * 3e-3 / 24 * r * inside * MATERIAL.density
    mass, polar = cell.sum(), (cell * r**2).sum()
    across = 0.5 * polar + (cell * x**2).sum()
    assert sound.model.mass == pytest.approx(mass, rel=5e-3)
    np.testing.assert_allclose(np.diag(sound.model.inertia), [polar, across, across], rtol=5e-3)
    rigid = sound.model.rigid_modes
    assert np.abs(sound.model.K @ rigid).max() < 1e-9 * abs(sound.model.K).max() * rigid.max()
    cross = rigid.T @ sound.model.mass_times(sound.basis.shapes.reshape(len(rigid), -1))
    assert np.abs(cross).max() < 1e-8


def test_reduction_keeps_its_interface_on_disk(monkeypatch, tmp_path):
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path))
    mesh, spec = ball_mesh(BALL_DEFECTS), ModesSpec(count=4)
    built = reduce_cage(mesh, cage=BALL_CAGE, defects=BALL_DEFECTS, spec=spec)
    assert built.basis.kind == ("free",) * 4 + ("centrifugal",) and built.basis.residual is None

    def never(*args, **kwargs):
        raise AssertionError("made again")

    monkeypatch.setattr(reduction, "assemble", never)
    stored = reduce_cage(mesh, cage=BALL_CAGE, defects=BALL_DEFECTS, spec=spec)
    assert_same_fields(stored.interface, built.interface)
    assert stored.interface.modes.shape == (POCKETS, 16, 3, 5)


def test_the_mode_table_knows_round_pockets(sound):
    table = mode_table(sound.model, sound.basis, pocket_count=POCKETS)
    np.testing.assert_allclose(table.share.sum(axis=0), 1.0)
    assert table.effective_mass.max() < 1e-15 * sound.model.mass
    assert "web" in str(table) and "share_rim" in table.columns()


def test_bases_of_a_ball_cage(sound):
    def basis(**spec):
        spec = ModesSpec(count=6, **spec)
        return build_basis(sound.model, pocket_count=POCKETS, spec=spec, solver=sound.solver)

    free = basis(kind="free_free")
    assert free.kind == ("free",) * 6 and free.name == "free_free"
    lands = basis(land=True)
    assert "land" in lands.kind and lands.residual is None
    with pytest.raises(InputError, match="takes one of ritz, free_free"):
        basis(kind="craig_bampton")
    with pytest.raises(InputError, match="attachment vectors of pocket faces"):
        basis(dynamic="all")
    with pytest.raises(InputError, match="A str is no cage of a known type"):
        rigid_interface_of("cage", pocket_count=8)
