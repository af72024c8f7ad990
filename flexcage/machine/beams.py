"""A beam of Timoshenko's between two nodes, exact for loads at its ends.

A node has five motions: x, y, z and the turns about y and z. Shape functions: J. S. Przemieniecki,
Theory of Matrix Structural Analysis (1968), 5.6 and 11.3, with the shear parameter
phi = 12 E I/(kappa G A L^2); H. D. Nelson, J. Mech. Design 102 (1980) 793 for the gyroscopic terms.
The shear coefficient kappa is G. R. Cowper's (J. Appl. Mech. 33 (1966) 335).
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.geometry.materials import Material
from flexcage.machine.spec import ShaftSection

DOFS = 5  # of a node
_POINTS, _WEIGHTS = np.polynomial.legendre.leggauss(4)  # exact to x^7: squares of cubics
_IN_XY = np.array([1, 4, 6, 9])  # y and turn about z of both nodes
_IN_XZ = np.array([2, 3, 7, 8])  # z and turn about y, which turns z the other way
_TURNED = np.array([1.0, -1.0, 1.0, -1.0])
_AXIAL = np.array([0, 5])


@dataclass(frozen=True)
class Beam:
    """A piece of a section: ``length`` [m], its section and material."""

    length: float
    section: ShaftSection
    material: Material

    @property
    def mass_per_length(self) -> float:
        return self.material.density * self.section.area

    @property
    def shear_stiffness(self) -> float:
        """kappa G A [N]."""
        nu = self.material.poisson_ratio
        m = (self.section.bore / self.section.diameter) ** 2
        kappa = 6.0 * (1.0 + nu) * (1.0 + m) ** 2
        kappa /= (7.0 + 6.0 * nu) * (1.0 + m) ** 2 + (20.0 + 12.0 * nu) * m
        modulus = 0.5 * self.material.youngs_modulus / (1.0 + nu)
        return kappa * modulus * self.section.area

    @property
    def bending_stiffness(self) -> float:
        """E I [N m^2]."""
        return self.material.youngs_modulus * self.section.second_moment

    @property
    def shear(self) -> float:
        """phi."""
        return 12.0 * self.bending_stiffness / (self.shear_stiffness * self.length**2)

    def shapes(self, s: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Deflection, turn, and their slopes (n, 4) along x at shares s (n,) of the length, for
        deflection and turn of both ends."""
        L, p, one = self.length, self.shear, np.ones_like(s)
        moved = np.stack([
            1.0 + p * (1.0 - s) - 3.0 * s**2 + 2.0 * s**3,
            L * (s - 2.0 * s**2 + s**3 + 0.5 * p * (s - s**2)),
            p * s + 3.0 * s**2 - 2.0 * s**3,
            L * (s**3 - s**2 - 0.5 * p * (s - s**2)),
        ], axis=1)  # fmt: skip
        slope = np.stack([
            -p - 6.0 * s + 6.0 * s**2,
            L * (1.0 - 4.0 * s + 3.0 * s**2 + 0.5 * p * (1.0 - 2.0 * s)),
            p + 6.0 * s - 6.0 * s**2,
            L * (3.0 * s**2 - 2.0 * s - 0.5 * p * (1.0 - 2.0 * s)),
        ], axis=1)  # fmt: skip
        turned = np.stack([
            6.0 * (s**2 - s) / L,
            1.0 - 4.0 * s + 3.0 * s**2 + p * (1.0 - s),
            6.0 * (s - s**2) / L,
            3.0 * s**2 - 2.0 * s + p * s,
        ], axis=1)  # fmt: skip
        bent = np.stack(
            [6.0 * (2.0 * s - one) / L, 6.0 * s - 4.0 - p, 6.0 * (one - 2.0 * s) / L,
             6.0 * s - 2.0 + p], axis=1,
        )  # fmt: skip
        whole = 1.0 + p
        return moved / whole, turned / whole, slope / (L * whole), bent / (L * whole)

    def _integrals(self) -> tuple[np.ndarray, np.ndarray, np.ndarray, np.ndarray]:
        """Matrices (4, 4): stiffness, mass of translation, of turning for unit inertia per length,
        and the deflections' integral (4,)."""
        s, w = 0.5 * (_POINTS + 1.0), 0.5 * self.length * _WEIGHTS
        moved, turned, slope, bent = self.shapes(s)
        sheared = slope - turned
        stiffness = self.bending_stiffness * np.einsum("n,na,nb->ab", w, bent, bent)
        stiffness += self.shear_stiffness * np.einsum("n,na,nb->ab", w, sheared, sheared)
        moving = self.mass_per_length * np.einsum("n,na,nb->ab", w, moved, moved)
        return stiffness, moving, np.einsum("n,na,nb->ab", w, turned, turned), w @ moved

    def matrices(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Stiffness, mass and gyroscopic matrix (10, 10) of both nodes; the last one for a shaft
        that turns by 1 rad/s."""
        bending, moving, turning, _ = self._integrals()
        inertia = self.material.density * self.section.second_moment
        K, M, G = (np.zeros((2 * DOFS, 2 * DOFS)) for _ in range(3))
        line = self.material.youngs_modulus * self.section.area / self.length
        K[np.ix_(_AXIAL, _AXIAL)] = line * np.array([[1.0, -1.0], [-1.0, 1.0]])
        rod = self.mass_per_length * self.length / 6.0
        M[np.ix_(_AXIAL, _AXIAL)] = rod * np.array([[2.0, 1.0], [1.0, 2.0]])
        signs = np.outer(_TURNED, _TURNED)
        for own, turn in ((_IN_XY, np.ones((4, 4))), (_IN_XZ, signs)):
            K[np.ix_(own, own)] = turn * bending
            M[np.ix_(own, own)] = turn * (moving + inertia * turning)
        # turns about y are minus the slopes of z: I_p w (turn z)' acts about y, minus about z
        cross = 2.0 * inertia * turning * -_TURNED[:, None]
        G[np.ix_(_IN_XZ, _IN_XY)] = cross
        G[np.ix_(_IN_XY, _IN_XZ)] = -cross.T
        return K, M, G

    def weight(self, gravity: np.ndarray) -> np.ndarray:
        """Forces and moments (10,) at both nodes of gravity (3,) [m/s^2] along the beam."""
        *_, spread = self._integrals()
        force = np.zeros(2 * DOFS)
        force[_AXIAL] = 0.5 * self.mass_per_length * self.length * gravity[0]
        force[_IN_XY] = self.mass_per_length * gravity[1] * spread
        force[_IN_XZ] = self.mass_per_length * gravity[2] * spread * _TURNED
        return force
