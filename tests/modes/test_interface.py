"""Stations on pocket faces: work, geometry and offsets against the mesh itself."""

import numpy as np
import pytest
from modes_cage import CAGE, DEFECTS, POCKETS, cage_mesh

from flexcage.cages.window.defects import CrossbeamDefect
from flexcage.cages.window.interface import cage_interface, rigid_interface, station_weights
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.modes.pockets import NORMALS, pocket_frame, pocket_loads
from flexcage.modes.table import mode_table


@pytest.fixture(scope="module")
def interface(solver, basis):
    return cage_interface(solver.model, basis, pocket_count=POCKETS, cage=CAGE)


def test_stations_lie_where_they_say(solver, interface):
    """Means of the nodes' own positions: the station's coordinate, on the pocket's wall."""
    at = (interface.weights @ solver.model.nodes).reshape(POCKETS, 4, -1, 3)
    half = np.array([CAGE.pocket_width, CAGE.pocket_width, CAGE.pocket_length, CAGE.pocket_length])
    for pocket in range(POCKETS):
        local = at[pocket] @ pocket_frame(pocket, POCKETS).T
        np.testing.assert_allclose(local[:2, :, 0], interface.stations[:2], atol=6e-5)
        np.testing.assert_allclose(local[2:, :, 2], interface.stations[2:], atol=6e-5)
        outward = np.einsum("fsa,fa->fs", local, NORMALS)
        np.testing.assert_allclose(outward, np.tile(half[:, None] / 2, (1, 7)), atol=1e-9)


def test_equal_station_forces_are_the_uniform_load(solver, interface):
    n_stations = interface.stations.shape[1]
    uniform = pocket_loads(solver.model, 3, POCKETS)[:, :8:2]
    rows = interface.weights.toarray().reshape(POCKETS, 4, n_stations, -1)
    for face in range(4):
        normal = NORMALS[face] @ pocket_frame(3, POCKETS)
        spread = np.outer(rows[3, face].mean(axis=0), normal).ravel()
        np.testing.assert_allclose(spread, uniform[:, face], atol=0.03 * uniform.max())
        assert np.outer(rows[3, face].sum(axis=0), normal).sum(axis=0) == pytest.approx(
            n_stations * normal
        )


def test_station_displacements_are_work_conjugate(solver, basis, interface):
    """Station forces do the same work on a mode as the nodal forces they are spread into."""
    rng = np.random.default_rng(0)
    forces = rng.normal(size=(POCKETS, 4, 7, 3))
    frames = np.stack([pocket_frame(k, POCKETS) for k in range(POCKETS)])
    nodal = interface.weights.T @ np.einsum("kfsa,kab->kfsb", forces, frames).reshape(-1, 3)
    np.testing.assert_allclose(
        np.einsum("kfsa,kfsan->n", forces, interface.modes),
        np.einsum("na,nam->m", nodal, basis.shapes),
        rtol=1e-9,
    )


def test_drive_point_through_stations_is_the_full_one(solver, basis, interface):
    """A uniform face load through stations, modes and residuals against the full mesh."""
    loads = pocket_loads(solver.model, 6, POCKETS)
    full = np.diag(loads.T @ solver.solve(loads))
    for face in range(4):
        share = np.full(7, 1.0 / 7.0)
        modal = np.einsum("s,san,a->n", share, interface.modes[6, face], NORMALS[face])
        pull = share @ interface.residual[6, face]
        drive = modal @ np.linalg.solve(basis.stiffness, modal)
        drive += pull @ interface.compliance[6] @ pull
        assert drive == pytest.approx(full[2 * face], rel=5e-3)


def test_offsets_are_what_the_mesh_shows(solver):
    """The morphed mesh's faces moved at their stations as the analytic shapes say.

    Offsets are points of the shapes, a station's weights average over its hat: hence many
    stations here, so that both are the same but for the mesh's own coarseness.
    """
    moved = assemble(cage_mesh(DEFECTS, fineness="fine"), MATERIALS["brass"], order=1)
    sound = assemble(cage_mesh(fineness="fine"), MATERIALS["brass"], order=1)
    rigid = rigid_interface(CAGE, pocket_count=POCKETS, defects=DEFECTS, n_stations=21)
    weights = station_weights(sound, rigid.stations, POCKETS)
    shift = (weights @ (moved.points - sound.points)).reshape(POCKETS, 4, 21, 3)
    frames = np.stack([pocket_frame(k, POCKETS) for k in range(POCKETS)])
    outward = np.einsum("kfsb,kab,fa->kfs", shift, frames, NORMALS)
    at_stations = np.stack(
        [
            [np.interp(rigid.stations[f], rigid.offset_at[f], face[f]) for f in range(4)]
            for face in rigid.offset
        ]
    )
    np.testing.assert_allclose(outward, at_stations, atol=0.06 * 0.3e-3)
    assert np.abs(rigid.offset[2, 0]).max() == pytest.approx(0.2e-3)
    assert rigid.offset[2, 0].min() < 0.0 < rigid.offset[3, 1].max()  # pocket 2 narrows, 3 widens
    assert rigid.offset[5, 3].min() == pytest.approx(-0.3e-3)  # the side beam comes in


def test_a_whole_shift_offsets_every_station():
    shifted = CrossbeamDefect(crossbeam=0, displacement=0.1e-3, shape="shifted")
    rigid = rigid_interface(CAGE, pocket_count=POCKETS, defects=(shifted, shifted))
    np.testing.assert_allclose(rigid.offset[POCKETS - 1, 0], -0.2e-3)
    np.testing.assert_allclose(rigid.offset[0, 1], 0.2e-3)


def test_rigid_and_flexible_interfaces_agree_in_geometry(interface):
    rigid = rigid_interface(CAGE, pocket_count=POCKETS)
    np.testing.assert_array_equal(rigid.stations, interface.stations)
    assert rigid.modes.shape == (*interface.modes.shape[:4], 0)
    assert rigid.residual.shape == interface.residual.shape
    assert rigid.land.shape[:3] == interface.land.shape[:3]
    assert rigid.patch_half_width == interface.patch_half_width and not rigid.compliance.any()


def test_land_stations_breathe_with_the_centrifugal_mode(basis, interface):
    """The static centrifugal shape moves every land station outwards alike (12 into 24)."""
    breathing = interface.land[:, :, 1, basis.kind.index("centrifugal")]
    breathing = breathing * np.sign(breathing.sum())
    assert breathing.min() > 0.0
    np.testing.assert_allclose(breathing[:, 2:], breathing[:, :-2], rtol=1e-3)


def test_mode_table_shows_no_effective_mass_and_all_of_the_deflection(solver, basis):
    table = mode_table(solver.model, basis, pocket_count=POCKETS)
    assert table.effective_mass.max() < 1e-18 * solver.model.mass**0
    np.testing.assert_allclose(table.share.sum(axis=0) + table.residual_share, 1.0)
    text = str(table)
    assert f"{basis.frequencies[0]:.1f}" in text and "centrifugal" in text
    assert len(table.columns()["frequency"]) == basis.size


def test_lands_may_be_left_out(solver, basis):
    without = cage_interface(solver.model, basis, pocket_count=POCKETS, cage=CAGE, n_land=0)
    assert without.land.shape == (2, 0, 3, basis.size) and without.land_weights.shape[0] == 0
