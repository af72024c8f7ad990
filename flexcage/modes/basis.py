"""What a reduction delivers: dynamic modes, residual flexibility, and the cage's interface."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import ClassVar, Protocol

import numpy as np
import scipy.sparse as sp

from flexcage.mesh.rows import RowFrame

FACES = ("front", "rear", "side+x", "side-x")  # face numbers 0..3 of a pocket, everywhere


@dataclass(frozen=True)
class ResidualFlexibility:
    """Quasi-static residual vectors of the pocket faces, stiffness-orthogonal to the modes.

    Vector j = pocket * per_pocket + local; local 2f is the uniform, 2f+1 the linear, and, with 12 a
    pocket in place of 8, 8+f the quadratic load on face f.
    Coordinates a [m, mean outward displacement of the own face] obey stiffness a = Psi^T F with
    ``stiffness`` Psi^T K Psi. ``compliance`` holds the inverses of its pocket blocks: the answer
    with the coupling between pockets cut, exact for the own displacement of a pocket.
    ``far_coupling`` is the largest ratio, over pockets and even loads, of the residual deflection
    that a load makes in another pocket (cut) to the whole one, modes and all, in its own.
    """

    # (n_nodes, 3, n_residual) displacement [m] per unit coordinate; None where only a run's folder
    # was read, which does not keep them
    shapes: np.ndarray | None
    stiffness: np.ndarray  # (n_residual, n_residual)
    compliance: np.ndarray  # (Z, per_pocket, per_pocket)
    far_coupling: float


@dataclass(frozen=True)
class BodyFit:
    """How a basis from elsewhere fits the cage's own elements.

    ``stiffness``: a mode's, over that of its shape in the elements, the one farthest from 1.
    ``carried``: the part of the static deflection under a force on a pocket's wall that modes and
    residual vectors hold, the least over the mode table's forces. ``compliance`` [m/N] is the whole
    deflection under the first of them. ``mass``: a mode's, over that of its shape in the elements,
    the one farthest from 1.
    """

    stiffness: float
    carried: float
    compliance: float
    mass: float = 1.0


@dataclass(frozen=True)
class ModeBasis:
    """Dynamic modes of a free body: r = r_i + A (s + shapes . q_f).

    ``kind[i]`` names mode i ("free", "centrifugal", "crossbeam", "land", "attachment",
    "constraint").
    ``stiffness`` and ``mass`` are the reduced matrices (n, n); for a mass-orthonormal basis
    of eigenmodes they are diag(omega^2) and 1. ``geometric`` is the geometric stiffness of the
    dynamic modes per squared spin about x, or None: the stiffness does not grow with spin.
    ``fit`` is that of a basis from elsewhere.
    """

    name: str
    shapes: np.ndarray  # (n_nodes, 3, n)
    stiffness: np.ndarray  # (n, n)
    mass: np.ndarray  # (n, n)
    frequencies: np.ndarray  # (n,) Hz: sqrt(k_ii/m_ii)/2pi
    kind: tuple[str, ...]
    residual: ResidualFlexibility | None = None
    geometric: np.ndarray | None = None  # (n, n)
    fit: BodyFit | None = None

    @property
    def size(self) -> int:
        return self.shapes.shape[2]


class ContactInterface(Protocol):
    """What every cage's interface has: stations on F faces of Z pockets, and the lands'.

    ``single`` and ``even`` list, face by face, components (0: x, 1: r, 2: psi) of contact forces.
    A force along the former acts at its station alone; of those along the latter the resultant
    counts, spread evenly over the face.
    """

    single: ClassVar[tuple[tuple[int, ...], ...]]
    even: ClassVar[tuple[tuple[int, ...], ...]]

    @property
    def modes(self) -> np.ndarray:
        """Dynamic modes at the stations: (Z, F, n_st, 3, n), without F where there is one face."""

    @property
    def land(self) -> np.ndarray:
        """(2, n_land, 3, n) the same on inner and outer land."""

    @property
    def weights(self) -> sp.csr_matrix | None:
        """(Z*F*n_st, n_nodes): station <- nodal displacement."""

    @property
    def land_weights(self) -> sp.csr_matrix | None:
        """(2*n_land, n_nodes), the same for land stations."""


@dataclass(frozen=True)
class CageInterface:
    """Where contacts touch the cage: a few stations on every pocket face, and what moves there.

    A station's displacement is a weighted mean of nodal displacements of its face (hat function
    along the face times the consistent area weights); a force on it is spread with the same
    weights, so that work is conserved. Components are (x, r, psi) in the pocket's frame
    (azimuth 2 pi k/Z, cage frame). Station coordinate: axial x on crossbeam faces (0, 1),
    tangential t on side-beam faces (2, 3), both from mid-pocket [m].

    ``offset`` is the stress-free displacement of the face along its outward normal (away from the
    pocket's centre: + widens the pocket), from defects, at the points ``offset_at`` along the face
    (evenly spaced; the stations if None).
    """

    single: ClassVar[tuple[tuple[int, ...], ...]] = ((2,), (2,), (0,), (0,))  # the faces' normals
    even: ClassVar[tuple[tuple[int, ...], ...]] = ((0, 1), (0, 1), (1, 2), (1, 2))  # tangents
    per_pocket: ClassVar[tuple[str, ...]] = (
        "offset", "modes", "residual", "compliance", "weights"
    )  # fmt: skip

    stations: np.ndarray  # (4, n_st) station coordinates [m]
    offset: np.ndarray  # (Z, 4, n_o) [m]
    modes: np.ndarray  # (Z, 4, n_st, 3, n) dynamic modes at stations
    residual: np.ndarray  # (Z, 4, n_st, 12) outward displacement by the pocket's own vectors
    compliance: np.ndarray  # (Z, 12, 12) of the residual coordinates; zeros for a rigid cage
    patch_half_width: float  # half-width [m] of the strip over which a station's force is spread
    land: np.ndarray  # (2, n_land, 3, n): radial-frame modes on the inner/outer land ring stations
    offset_at: np.ndarray | None = None  # (4, n_o) [m]
    weights: sp.csr_matrix | None = None  # (Z*4*n_st, n_nodes): station <- nodal displacement
    land_weights: sp.csr_matrix | None = None  # (2*n_land, n_nodes), the same for land stations

    def in_row(self, frame: RowFrame) -> CageInterface:
        """That of a row's pockets with components along the cage's x; what counts along a pocket,
        and the sides of a pocket, stay in the row's frame."""
        return replace(self, modes=self.modes * np.array([frame.sign, 1.0, 1.0])[:, None])
