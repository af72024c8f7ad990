"""Beams of solid elements: bent, vibrating, and spun across their length.

Quadratic tetrahedra in bending: a cantilever's deflection, a free beam's first frequency, and what
spin across its length adds to the square of that frequency.

Source: beam theory of Bernoulli and of S. P. Timoshenko; R. V. Southwell and F. Gough, ARC R&M 766
(1921): stiffening of a spinning beam by its tension, integrated here.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace

import numpy as np
from known_rows import check
from scipy.integrate import quad
from solids import box

from flexcage.fem.free import FreeBodySolver
from flexcage.fem.linear import linear_solver
from flexcage.fem.modal import free_modes
from flexcage.fem.model import assemble
from flexcage.geometry.materials import Material
from flexcage.modes.stiffening import spin_stiffness
from flexcage.verification import Row, Tolerance

# no Poisson's ratio: a clamp that stops the contraction stiffens a beam
E, RHO = 207e9, 7800.0
STEEL = Material(name="beam steel", youngs_modulus=E, poisson_ratio=0.0, density=RHO)
FIRST = 4.730040744862704  # root of cos x cosh x = 1
LENGTH, SIDE = 100e-3, 2e-3
SHEAR = Tolerance(2e-3, "a section that may warp, where Timoshenko's shear factor is 5/6")
SLENDER = Tolerance(3e-3, "shear and rotary inertia, which Bernoulli's beam lacks: -0.2 %")
TENSION = Tolerance(5e-3, "the slender beam's shape for the solid's; 32 elements along")


def cantilever_row() -> Row:
    length, width, height, force = 40e-3, 3e-3, 4e-3, 10.0
    model = assemble(box((length, width, height), (20, 2, 2)), STEEL)
    end = model.face_weights(model.group("x1"), lambda p: np.ones((1, len(p)))).toarray()[0]
    load = np.zeros((len(model.nodes), 3))
    load[:, 2] = force * end / end.sum()
    free = np.repeat(model.nodes[:, 0] > 1e-9, 3)
    moved = np.zeros(model.n_dof)
    moved[free] = linear_solver(model.K[free][:, free]).solve(load.ravel()[free])
    tip = (end / end.sum()) @ moved.reshape(-1, 3)[:, 2]
    bending = force * length**3 / (3.0 * E * width * height**3 / 12.0)
    shear = force * length / (5.0 / 6.0 * 0.5 * E * width * height)
    return Row("cantilever's tip under 10 N", "um", 1e6 * (bending + shear), 1e6 * tip, SHEAR)


def southwell() -> float:
    """W^2 int T w'^2/int rho A w^2 at W = 1 rad/s, T = rho A (l^2/4 - y^2)/2, w the first shape."""
    k, half = FIRST / LENGTH, 0.5 * LENGTH
    ratio = np.cos(k * half) / np.cosh(k * half)

    def shape(y: float) -> float:
        return np.cos(k * y) + ratio * np.cosh(k * y)

    def slope(y: float) -> float:
        return k * (-np.sin(k * y) + ratio * np.sinh(k * y))

    pulled = quad(lambda y: 0.5 * (half**2 - y**2) * slope(y) ** 2, -half, half)[0]
    return pulled / quad(lambda y: shape(y) ** 2, -half, half)[0]


def free_rows() -> Iterator[Row]:
    mesh = box((LENGTH, SIDE, SIDE), (32, 1, 1))
    along_y = (mesh.points - [0.5 * LENGTH, 0.5 * SIDE, 0.5 * SIDE])[:, [1, 0, 2]] * [1, -1, 1]
    model = assemble(replace(mesh, points=along_y), STEEL)
    solver = FreeBodySolver(model)
    omega2, shapes = free_modes(solver, 2)
    expected = (FIRST / LENGTH) ** 2 * np.sqrt(E * SIDE**2 / (12.0 * RHO)) / (2.0 * np.pi)
    for name, found in zip(("", ", other plane"), np.sqrt(omega2) / (2.0 * np.pi)):
        yield Row(f"first frequency of a free beam{name}", "Hz", expected, found, SLENDER)
    nodal = shapes.reshape(-1, 3, 2)
    moved = model.mass_times(shapes).reshape(nodal.shape)
    # equal frequencies: any mixture of flapping along the spin's axis and of bending across it
    flapping = np.linalg.eigh(nodal[:, 0].T @ moved[:, 0])[1][:, 1]
    found = flapping @ spin_stiffness(solver, nodal) @ flapping
    yield Row("Southwell coefficient of flapping", "", southwell(), found, TENSION)


def test_a_cantilever():
    check([cantilever_row()])


def test_a_free_beam_and_its_stiffening_by_spin():
    check(free_rows())
