"""The same ring and others in solid elements: modes, stiffening by spin, growth and stress."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from scipy.linalg import eig

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import FEModel, assemble
from flexcage.geometry.materials import MATERIALS, Material
from flexcage.modes.ritz import centrifugal_load, centrifugal_mode
from flexcage.modes.stiffening import spin_stiffness
from flexcage.stress.operators import VertexStress
from flexcage.verification.cases.spinning_ring import LINEAR, REST, RPM, STIFFENED
from flexcage.verification.known_answer import KnownAnswer, Row, Tolerance
from flexcage.verification.solids import ring

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
SPUN = Tolerance(3e-3, "a thin ring's closed form or a Galerkin ring's; 96 straight facets around")
CAGE = Tolerance(1e-2, "shear and rotary inertia, which a thin ring lacks: h/R is 0.12")
FACETS = Tolerance(2.5e-3, "96 straight facets around; plane stress, where the ring has a width")


def steel_ring(material: Material) -> FEModel:
    return assemble(ring(49e-3, 51e-3, 10e-3, (2, 2, 96))[0], material)


def nearest(values: np.ndarray, target: float) -> float:
    return float(values[np.argmin(np.abs(values - target))])


def spun_frequencies(
    model: FEModel, omega2: np.ndarray, shapes: np.ndarray, geometric: np.ndarray, spin: float
) -> np.ndarray:
    """Frequencies [Hz] of modes (3N, n) in the frame that spins about x at ``spin`` [rad/s]."""
    n = len(omega2)
    nodal = shapes.reshape(-1, 3, n)
    moved = model.mass_times(shapes).reshape(nodal.shape)
    turned = nodal[:, 1].T @ moved[:, 2]
    gyro = 2.0 * spin * (turned.T - turned)
    softening = -np.einsum("nak,nal->kl", nodal[:, 1:], moved[:, 1:])
    stiffness = np.diag(omega2) + spin**2 * (softening + geometric)
    corner = np.zeros((n, n))
    values = eig(np.block([[corner, np.eye(n)], [-stiffness, -gyro]]), right=False).imag
    return values[values > 1.0] / (2.0 * np.pi)


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
    geometric = spin_stiffness(solver, shapes.reshape(-1, 3, MODES))
    for what, table, stiff in (
        ("", STIFFENED, geometric),
        (" without stiffening", LINEAR, 0.0 * geometric),
    ):
        for (rpm, n), pair in table.items():
            spun = spun_frequencies(model, omega2, shapes, stiff, rpm * RPM)
            for which, expected in zip(("higher", "lower"), pair):
                name = f"{which} f_{n} at {rpm} rpm{what}"
                yield Row(name, "Hz", expected, nearest(spun, expected), SPUN)


def out_of_plane_rows() -> Iterator[Row]:
    found = np.sqrt(free_modes(FreeBodySolver(steel_ring(STEEL)), 6)[0]) / (2.0 * np.pi)
    yield Row("out of plane, n = 2", "Hz", 1195.08, nearest(found, 1195.08), TORSION)
    side = assemble(ring(38.75e-3, 43.75e-3, 2.6e-3, (2, 2, 96))[0], BRASS)
    found = np.sqrt(free_modes(FreeBodySolver(side), 6)[0]) / (2.0 * np.pi)
    for name, expected in (("in plane", 1273.2), ("out of plane", 662.5)):
        value = nearest(found, expected)
        yield Row(f"side ring of an N1013 cage, {name}, n = 2", "Hz", expected, value, CAGE)


def centrifugal_rows(
    name: str, model: FEModel, rpm: float, table: dict[float, tuple[float, float]]
) -> Iterator[Row]:
    """Growth and hoop stress at the walls of a ring that spins."""
    solver = FreeBodySolver(model)
    load = (rpm * RPM) ** 2 * centrifugal_load(solver)
    moved = solver.solve(load[:, None]).reshape(-1, 3)
    _, y, z = model.points.T
    radius = np.hypot(y, z)
    stress = VertexStress(model, np.arange(len(model.points)))(moved)
    hoop = (z**2 * stress[:, 1] + y**2 * stress[:, 2] - 2.0 * y * z * stress[:, 4]) / radius**2
    radial = np.einsum("na,na->n", moved[: len(y), 1:], model.points[:, 1:]) / radius
    for at, (growth, tension) in table.items():
        wall = np.abs(1e3 * radius - at) < 1e-4
        value = 1e6 * radial[wall].mean()
        yield Row(f"{name}, growth at {at} mm", "um", growth, value, FACETS)
        value = 1e-6 * hoop[wall].mean()
        yield Row(f"{name}, hoop stress at {at} mm", "MPa", tension, value, FACETS)


def rows() -> Iterator[Row]:
    yield from vibration_rows()
    yield from out_of_plane_rows()
    steel = steel_ring(STEEL)
    yield from centrifugal_rows("steel at 10000 rpm", steel, 10_000.0, STEEL_10000)
    thin_slice = assemble(ring(39e-3, 43.5e-3, 1e-3, (1, 3, 96))[0], BRASS)
    yield from centrifugal_rows("N1013 cage annulus", thin_slice, 2709.09, CAGE_2709)


CASE = KnownAnswer(
    name="solid_ring",
    title="Rings of solid elements, at rest and spinning",
    source="thin ring: closed forms as in `spinning_ring`; R. D. Blevins, Formulas for Natural "
    "Frequency and Mode Shape (1979), rings out of plane; rotating thick ring in plane stress: S. "
    "P. Timoshenko and J. N. Goodier, Theory of Elasticity, section 32",
    checks="Quadratic tetrahedra, free modes, geometric stiffness of the spinning body and stress "
    "operators on the steel ring of `spinning_ring` (without Poisson's ratio where the closed form "
    "is a beam's), on a side ring and on an annulus of the N1013's brass cage.",
    rows=rows,
)
