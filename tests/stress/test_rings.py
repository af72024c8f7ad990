"""Stress and displacement of rings that bend."""

from functools import cache

import numpy as np
import pytest

from flexcage.bearings import sections_of, statics_of
from flexcage.case.presets import load_preset
from flexcage.fem.revolved import Revolved
from flexcage.geometry.materials import MATERIALS
from flexcage.geometry.ring import OuterRing
from flexcage.mesh.section import mesh_section
from flexcage.stress.rings import _stress, ring_field
from flexcage.system.spec import Load
from flexcage.system.statics.rings import Rings
from flexcage.system.statics.solve import solve_bearing

STEEL = MATERIALS["steel"]


@cache
def field():
    bearing = load_preset("N1013").bearing
    outer = OuterRing(
        ring="flexible", seat="arcs", supports=(1.0, -1.0, 2.5), support_arc=np.radians(20.0)
    )
    rings = Rings(outer=outer, sections=sections_of(bearing))
    solution = solve_bearing(bearing, statics_of(bearing), load=Load(radial=5e3), rings=rings)
    return ring_field(solution.rings[0])


def at(azimuth):
    return int(np.argmin(np.abs((field().station - azimuth + np.pi) % (2.0 * np.pi) - np.pi)))


def test_race_moves_as_the_solution_says():
    """The mean over the rollers' length, at rollers far from any force, is their deflection."""
    found, ring = field(), field().ring
    nodes = ring.seated.reduction.model.edge_nodes("race")
    x = ring.seated.reduction.model.nodes[nodes, 0]
    order = np.argsort(x)
    far = [k for k in range(len(ring.azimuth)) if abs(ring.azimuth[k] - np.pi) < 0.6]
    assert far and not ring.force[far].any()
    for k in far:
        radial = found.displacement[at(ring.azimuth[k])][nodes, 1][order]
        mean = np.trapezoid(radial, x[order]) / np.ptp(x)
        assert mean == pytest.approx(ring.deflection[k, 1], rel=0.02)


def test_hoop_stress_balances_the_bending_of_the_ring():
    """A cut through the ring at two places far from forces: no force but from what lies between.

    On the far side nothing presses, so that the cuts' forces along y and z balance.
    """
    found = field()
    model = found.model
    cut = [at(np.pi - 0.35), at(np.pi + 0.35)]
    corners = model.nodes[model.cells[:, :3]]
    area = 0.5 * np.abs(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]))
    total = np.zeros(3)
    for sign, k in zip((-1.0, 1.0), cut):
        s, psi = found.stress[k], found.station[k]
        # the midpoint rule of quadratic triangles, exact for what is quadratic
        hoop, shear, axial = (
            float((s[model.cells[:, 3:], c].mean(axis=1) * area).sum()) for c in (2, 4, 5)
        )
        along = np.array([0.0, -np.sin(psi), np.cos(psi)])
        radial = np.array([0.0, np.cos(psi), np.sin(psi)])
        total += sign * (hoop * along + shear * radial + axial * np.array([1.0, 0.0, 0.0]))
    size = np.abs(found.stress[cut[0]][:, 2]).mean() * area.sum()
    assert np.abs(total).max() < 0.03 * size


def test_stress_of_a_uniform_pull_is_exact():
    mesh = mesh_section([(0.0, 0.02), (0.01, 0.02), (0.01, 0.024), (0.0, 0.024)], ["a"] * 4,
                        lambda x, r: 2e-3)  # fmt: skip
    model = Revolved(mesh, STEEL)
    x, r = model.nodes.T
    stress = _stress(model, np.stack([x, -STEEL.poisson_ratio * r, 0.0 * r], axis=1), 0)
    expected = np.array([STEEL.youngs_modulus, 0.0, 0.0, 0.0, 0.0, 0.0])
    assert stress == pytest.approx(np.tile(expected, (len(x), 1)), abs=1.0)


def test_quadrangles_close_the_ring():
    found = field()
    faces = found.quadrangles()
    edges = np.sort(np.concatenate([faces[:, [k, (k + 1) % 4]] for k in range(4)]), axis=1)
    _, count = np.unique(edges, axis=0, return_counts=True)
    assert (count == 2).all()
    # outward faces: the divergence theorem gives the ring's volume
    a, b, c, d = np.moveaxis(found.points().reshape(-1, 3)[faces], 1, 0)
    volume = (np.cross(c - a, d - b) * (a + b + c + d)).sum() / 24.0
    bearing = load_preset("N1013").bearing
    area = 0.25 * np.pi * (bearing.outside_diameter**2 - bearing.outer_race_diameter**2)
    assert volume == pytest.approx(area * bearing.width, rel=1e-3)
