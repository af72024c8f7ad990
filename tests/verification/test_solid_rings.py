"""The same ring and others in solid elements: modes, stiffening by spin, growth and stress.

Quadratic tetrahedra, free modes, geometric stiffness of the spinning body in the floating frame,
and stress operators on the steel ring of ``test_spinning_ring.py`` (without Poisson's ratio where
the closed form is a beam's), on side rings of cages of an N1013 and of 7010C, and on an annulus of
the N1013's.

Source: thin ring: closed forms as in ``test_spinning_ring.py``; R. D. Blevins, Formulas for Natural
Frequency and Mode Shape (1979), rings out of plane; rotating thick ring in plane stress: S. P.
Timoshenko and J. N. Goodier, Theory of Elasticity, section 32.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from known_rows import check
from solids import ring
from thin_ring import LINEAR, REST, RPM, STIFFENED, frequencies

from flexcage.bodies.floating_frame import flexible_body
from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import FEModel, assemble
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.modes.ritz import centrifugal_load, centrifugal_mode
from flexcage.modes.stiffening import spin_stiffness
from flexcage.stress.operators import VertexStress
from flexcage.verification import Row, Tolerance

STEEL = Material(name="ring steel", youngs_modulus=207e9, poisson_ratio=0.3, density=7800.0)
BEAM = replace(STEEL, poisson_ratio=0.0)  # beam theory has no anticlastic bending
BRASS = MATERIALS["brass"]
MODES = 10
# radius [mm]: growth [um] and hoop stress [MPa] in plane stress
STEEL_10000 = {49.0: (5.19558, 21.9487), 51.0: (5.13368, 20.8367)}
CAGE_2709 = {39.0: (0.4652, 1.2526), 43.5: (0.4484, 1.0824)}
THIN = Tolerance(1e-3, "shear and rotary inertia, which a thin ring lacks: (n h/R)^2/12 and more")
THIN_SHORT_WAVES = Tolerance(5e-3, THIN.why)
TORSION = Tolerance(5e-3, "torsion of a slender rectangle, approximate")
SPUN = Tolerance(1e-3, "a thin ring's closed form or a Galerkin ring's; 96 straight facets around")
# side rings of cages: mean radius, radial and axial width [mm], material; frequencies [Hz] in and
# out of the plane
PA66 = replace(MATERIALS["PA66"], density=1150.0)  # the reference's
OF_PA66 = (32.47, 4.5, 2.5)
SIDES = (
    ("N1013", (41.25, 5.0, 2.6), BRASS, (1273.2, 662.5)),
    ("7010C, PA66", OF_PA66, PA66, (825.4, 455.3)),
    ("7010C, polyimide", (32.5, 4.5, 2.5), MATERIALS["polyimide"], (803.3, 445.1)),
)
PA66_GROWTH = {3000.0: 1.373, 20_000.0: 61.0}  # um, at the middle
CAGE = Tolerance(1e-2, "shear, rotary inertia and width, which a thin ring lacks: h/R to 0.14")
FACETS = Tolerance(2.5e-3, "96 straight facets around; plane stress, where the ring has a width")


def steel_ring(material: Material) -> FEModel:
    return assemble(ring(49e-3, 51e-3, 10e-3, (2, 2, 96))[0], material)


def side_ring(sizes: tuple[float, float, float], material: Material) -> FEModel:
    """A ring of mean radius, radial and axial width [mm]."""
    radius, height, width = sizes
    inner, outer = (1e-3 * (radius + side * height) for side in (-0.5, 0.5))
    return assemble(ring(inner, outer, 1e-3 * width, (2, 2, 96))[0], material)


def nearest(values: np.ndarray, target: float) -> float:
    return float(values[np.argmin(np.abs(values - target))])


def vibration_rows() -> Iterator[Row]:
    model = steel_ring(BEAM)
    solver = FreeBodySolver(model)
    omega2, shapes = free_modes(solver, MODES)
    found = np.sqrt(omega2) / (2.0 * np.pi)
    for n, expected in REST.items():
        tolerance = THIN if n < 4 else THIN_SHORT_WAVES
        yield Row(f"f_{n} at rest", "Hz", expected, nearest(found, expected), tolerance)
    shape = centrifugal_mode(solver, shapes)
    breathing = np.sqrt(shape @ (model.K @ shape)) / (2.0 * np.pi)
    yield Row("breathing, of the centrifugal shape", "Hz", 16397.9, breathing, THIN)
    nodal = shapes.reshape(-1, 3, MODES)
    for what, table, geometric in (
        ("", STIFFENED, spin_stiffness(solver, nodal)),
        (" without stiffening", LINEAR, None),
    ):
        body = flexible_body(
            model.nodes, model.mass_scalar, nodal, np.diag(omega2), geometric=geometric
        )
        for (rpm, n), pair in table.items():
            spun = frequencies(body, rpm * RPM)
            for which, expected in zip(("higher", "lower"), pair):
                name = f"{which} f_{n} at {rpm} rpm{what}"
                yield Row(name, "Hz", expected, nearest(spun, expected), SPUN)


def out_of_plane_rows() -> Iterator[Row]:
    found = np.sqrt(free_modes(FreeBodySolver(steel_ring(STEEL)), 6)[0]) / (2.0 * np.pi)
    yield Row("out of plane, n = 2", "Hz", 1195.08, nearest(found, 1195.08), TORSION)
    for cage, sizes, material, expected in SIDES:
        side = FreeBodySolver(side_ring(sizes, material))
        found = np.sqrt(free_modes(side, 6)[0]) / (2.0 * np.pi)
        for name, reference in zip(("in plane", "out of plane"), expected):
            value = nearest(found, reference)
            yield Row(f"side ring of {cage}, {name}, n = 2", "Hz", reference, value, CAGE)


def spun(model: FEModel, rpm: float) -> np.ndarray:
    """Displacements (N, 3) [m] of a free body that spins."""
    solver = FreeBodySolver(model)
    load = (rpm * RPM) ** 2 * centrifugal_load(solver)
    return solver.solve(load[:, None]).reshape(-1, 3)


def growth(model: FEModel, moved: np.ndarray, radius: float) -> float:
    """Mean radial displacement [um] of the mesh's points at a radius [mm]."""
    at = np.hypot(*model.points[:, 1:].T)
    radial = np.einsum("na,na->n", moved[: len(at), 1:], model.points[:, 1:]) / at
    return 1e6 * float(radial[np.abs(1e3 * at - radius) < 1e-4].mean())


def centrifugal_rows(
    name: str, model: FEModel, rpm: float, table: dict[float, tuple[float, float]]
) -> Iterator[Row]:
    """Growth and hoop stress at the walls of a ring that spins."""
    moved = spun(model, rpm)
    _, y, z = model.points.T
    stress = VertexStress(model, np.arange(len(model.points)))(moved)
    hoop = (z**2 * stress[:, 1] + y**2 * stress[:, 2] - 2.0 * y * z * stress[:, 4]) / (y**2 + z**2)
    for at, (grown, tension) in table.items():
        value = growth(model, moved, at)
        yield Row(f"{name}, growth at {at} mm", "um", grown, value, FACETS)
        wall = np.abs(1e3 * np.hypot(y, z) - at) < 1e-4
        value = 1e-6 * hoop[wall].mean()
        yield Row(f"{name}, hoop stress at {at} mm", "MPa", tension, value, FACETS)


def test_vibrations_and_split_frequencies():
    check(vibration_rows())


def test_rings_out_of_their_plane():
    check(out_of_plane_rows())


def test_growth_and_stress_of_a_steel_ring():
    check(centrifugal_rows("steel at 10000 rpm", steel_ring(STEEL), 10_000.0, STEEL_10000))


def test_growth_and_stress_of_an_annulus():
    thin_slice = assemble(ring(39e-3, 43.5e-3, 1e-3, (1, 3, 96))[0], BRASS)
    check(centrifugal_rows("N1013 cage annulus", thin_slice, 2709.09, CAGE_2709))


def test_growth_of_a_side_ring():
    side = side_ring(OF_PA66, PA66)
    for rpm, expected in PA66_GROWTH.items():
        value = growth(side, spun(side, rpm), OF_PA66[0])
        check([Row(f"growth at {rpm:g} rpm", "um", expected, value, CAGE)])
