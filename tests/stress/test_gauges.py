"""Strain gauges: closed forms on bodies, the whole mesh's stress, places that are none."""

from __future__ import annotations

from types import SimpleNamespace

import numpy as np
import pytest
import skfem
from stress_cage import CAGE, POCKETS

from flexcage.cages.build import build_cage_mesh
from flexcage.core.errors import InputError
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.model import assemble
from flexcage.geometry.materials import MATERIALS
from flexcage.mesh.cage_mesh import signed_volumes
from flexcage.mesh.options import MeshOptions
from flexcage.modes.pockets import frames_at, pocket_frames
from flexcage.spec import StrainGauge
from flexcage.stress.gauge_lines import gauge_line, gauge_rows
from flexcage.stress.gauges import gauge_fields
from flexcage.stress.operators import VertexStress
from flexcage.stress.recovery import CageLoads

STEEL = MATERIALS["steel"]
R, H, B = 50e-3, 2e-3, 10e-3  # of a thin ring: mean radius, height, width


@pytest.fixture(scope="module")
def ring():
    """A thin ring of quadratic tetrahedra, 96 round it, one over its height."""
    grid = [np.linspace(0, 1, n + 1) for n in (2, 96, 1)]
    mesh = skfem.MeshTet.init_tensor(*grid)
    x, turn, r = mesh.p
    angle, own = 2.0 * np.pi * turn, R + H * (r - 0.5)
    points = np.column_stack([B * (x - 0.5), own * np.cos(angle), own * np.sin(angle)])
    _, first, back = np.unique(
        np.round(points, 9) + 0.0, axis=0, return_index=True, return_inverse=True
    )
    tets, points = back.ravel()[mesh.t.T], points[first]
    turned = signed_volumes(points, tets) < 0.0
    tets = np.where(turned[:, None], tets[:, [0, 2, 1, 3]], tets)
    return assemble(SimpleNamespace(points=points, tets=tets, groups={}), STEEL, order=2)


def gauge(**values):
    return StrainGauge(name="g", **values)


def strain_of(model, displacement, **values):
    (row,) = gauge_rows(model, [gauge(**values)], POCKETS, R)
    return float(row @ displacement.ravel())


@pytest.mark.parametrize(
    ("place", "way"),
    [
        ({"along": "axial", "azimuth": 0.3}, lambda t: [1.0, 0.0, 0.0]),
        ({"azimuth": 2.0}, lambda t: [0.0, -np.sin(t), np.cos(t)]),
        ({"side": "inside", "azimuth": -1.0}, lambda t: [0.0, -np.sin(t), np.cos(t)]),
        ({"side": "+x", "along": "radial", "azimuth": 1.0}, lambda t: [0.0, np.cos(t), np.sin(t)]),
        ({"side": "-x", "azimuth": 1.0}, lambda t: [0.0, -np.sin(t), np.cos(t)]),
    ],
)
def test_an_even_strain_is_read_in_every_direction(ring, place, way):
    """u = E r: t E t; rigid motions give nothing."""
    rng = np.random.default_rng(2)
    strain = rng.normal(size=(3, 3))
    strain = 1e-4 * (strain + strain.T)
    t = np.array(way(place["azimuth"]))
    found = strain_of(ring, ring.nodes @ strain, grid=0.5e-3, **place)
    assert found == pytest.approx(t @ strain @ t, abs=2e-6)  # facets are chords of 4 degrees
    rigid = ring.rigid_modes.sum(axis=1)
    assert abs(strain_of(ring, rigid, **place)) < 1e-10 * np.abs(rigid).max() / R


def test_a_spinning_ring_stretches_as_in_textbooks(ring):
    """u = rho w^2 R^3/E, so u/r round the outside, and -nu u/R along the axis."""
    spin = 1000.0
    forces = -ring.mass_times(-(spin**2) * ring.nodes * [0.0, 1.0, 1.0])
    moved = FreeBodySolver(ring).solve(forces.reshape(-1, 1))
    hoop = STEEL.density * (spin * R) ** 2 / STEEL.youngs_modulus
    outside = hoop * R / (R + 0.5 * H)
    assert strain_of(ring, moved, azimuth=0.4) == pytest.approx(outside, rel=0.01)
    along = strain_of(ring, moved, azimuth=0.4, along="axial")
    assert along == pytest.approx(-STEEL.poisson_ratio * hoop, rel=0.03)


def test_a_pinched_ring_bends_as_in_textbooks(ring):
    """Two forces F across a diameter: M = F R/2 (2/pi - |sin a|), N = -F/2 |sin a|, a from the
    line of the forces (Timoshenko, Strength of Materials II)."""
    force = 100.0
    load = np.zeros((len(ring.nodes), 3))
    for sign in (1.0, -1.0):
        at = np.flatnonzero(
            np.isclose(ring.nodes[:, 1], sign * (R + 0.5 * H)) & np.isclose(ring.nodes[:, 2], 0.0)
        )
        load[at, 1] = -sign * force / len(at)
    moved = FreeBodySolver(ring).solve(load.reshape(-1, 1))
    inertia, area = B * H**3 / 12.0, B * H
    for a in (0.5, 1.0, np.pi / 2):
        moment = 0.5 * force * R * (2.0 / np.pi - np.sin(a))
        normal = -0.5 * force * np.sin(a) / (STEEL.youngs_modulus * area)
        bent = 0.5 * H * moment / (STEEL.youngs_modulus * inertia)
        outer = strain_of(ring, moved, azimuth=a)
        inner = strain_of(ring, moved, azimuth=a, side="inside")
        scale = 0.5 * H * 0.5 * force * R / (STEEL.youngs_modulus * inertia)
        assert outer == pytest.approx(normal - bent, abs=0.03 * scale)
        assert inner == pytest.approx(normal + bent, abs=0.03 * scale)


PLACES = {
    "beam": {"crossbeam": 4, "along": "axial"},
    "beam_inside": {"crossbeam": 4, "along": "axial", "side": "inside"},
    "rim": {"azimuth": 0.2, "plane": 6.5e-3},
    "end": {"side": "-x", "azimuth": 0.5, "grid": 2e-3},
}


def loads(recovery, seed=1):
    rng = np.random.default_rng(seed)
    shape = (POCKETS, 4, 7, 3)
    stations = 20.0 * rng.normal(size=shape) * (rng.random(shape[:3]) < 0.1)[..., None]
    land = np.zeros((2, 24, 3))
    land[1, 3:6, 1:] = rng.normal(size=(3, 2))
    q = 1e-6 * rng.normal(size=recovery.basis.size) / (1 + np.arange(recovery.basis.size))
    return CageLoads(station_forces=stations, land_forces=land, modal_coordinates=q)


@pytest.mark.parametrize("which", ["recovery", "damaged", "free_only"])
def test_gauges_read_what_the_whole_mesh_does(request, which):
    """Any forces, friction and lands included, and any modal coordinates, not in balance."""
    recovery = request.getfixturevalue(which)
    gauges = [StrainGauge(name=name, **place) for name, place in PLACES.items()]
    fields = gauge_fields(recovery, gauges, CAGE.mean_radius)
    rows = gauge_rows(recovery.model, gauges, POCKETS, CAGE.mean_radius)
    for seed in (1, 2):
        own = loads(recovery, seed)
        moved = recovery.displacement(own)
        found = fields.strains(
            own.modal_coordinates[None], own.station_forces[None], own.land_forces[None]
        )
        expected = rows @ moved.ravel()
        np.testing.assert_allclose(found[:, 0], expected, atol=1e-6 * np.abs(expected).max())


@pytest.fixture(scope="module")
def bent_beam():
    """A fine mesh under even pressures on crossbeam 4 and opposite: model, displacement, stress."""
    mesh = build_cage_mesh(
        CAGE, pocket_count=POCKETS, pitch_diameter=43.5e-3, defects=(),
        options=MeshOptions(fineness="fine"),
    )  # fmt: skip
    model = assemble(mesh, MATERIALS["brass"])
    load = np.zeros((len(model.nodes), 3))
    for pocket, force in ((3, 30.0), (9, 10.0)):
        wall = model.group(f"pocket{pocket}_front")
        even = model.face_weights(wall, lambda at: np.ones((1, len(at)))).toarray()[0]
        load += np.outer(force * even / even.sum(), pocket_frames(POCKETS)[pocket, 2])
    moved = FreeBodySolver(model).solve(load.reshape(-1, 1)).reshape(-1, 3)
    stress = np.zeros((len(model.points), 6))
    outside = np.unique(model.surface)
    stress[outside] = VertexStress(model, outside)(moved)
    return model, moved, stress


@pytest.mark.parametrize(
    "place",
    [
        {"crossbeam": 4, "azimuth": 0.05, "along": "axial", "grid": 2e-3},
        {"azimuth": np.pi / 2, "plane": 6.5e-3, "grid": 2e-3},
        {"side": "+x", "azimuth": np.pi / 2, "grid": 2e-3},
    ],
    ids=["crossbeam", "side beam", "end"],
)
def test_gauges_obey_hooke_s_law(bent_beam, place):
    """By the smoothed stress of the same surface: e = (s - nu s_across)/E, and s/E where the beam
    bends alone."""
    model, moved, stress = bent_beam
    line = gauge_line(model, gauge(**place), POCKETS, CAGE.mean_radius)
    frames = frames_at(np.arctan2(line.points[:, 2], line.points[:, 1]))
    tensor = _on_line(model, stress, line)[:, [[0, 3, 5], [3, 1, 4], [5, 4, 2]]]
    normal = np.einsum("nai,nij,naj->an", frames, tensor, frames).mean(axis=1)  # x, r, psi
    own = 0 if place.get("along") == "axial" else 2
    E, nu = model.material.youngs_modulus, model.material.poisson_ratio
    strain = ((1.0 + nu) * normal[own] - nu * normal.sum()) / E
    found = float(line.row(model) @ moved.ravel())
    assert found == pytest.approx(strain, rel=0.02)
    assert found == pytest.approx(normal[own] / E, rel=0.05)


def _on_line(model, stress, line):
    corners = model.surface[line.triangles]
    return np.einsum("nk,nkc->nc", line.barycentric, stress[corners])


@pytest.mark.parametrize(
    ("place", "words"),
    [
        ({"azimuth": 0.0}, "the cage has a pocket or ends there"),
        ({"azimuth": 0.0, "plane": 9e-3}, "the cage has a pocket or ends there"),
        ({"crossbeam": 4, "grid": 9e-3}, "the cage has a pocket"),
        ({"side": "+x", "azimuth": 0.0, "radius": 30e-3}, "does not lie on the cage's surface"),
    ],
)
def test_a_gauge_beside_the_surface_is_one_sentence(recovery, place, words):
    with pytest.raises(InputError, match=words):
        gauge_line(recovery.model, gauge(**place), POCKETS, CAGE.mean_radius)
