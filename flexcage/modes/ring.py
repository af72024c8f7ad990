"""A ring reduced to what its elements and supports feel: compliances, harmonic by harmonic.

Ports are patches of load: two on the raceway, in which an element presses, and one on the seat, on
which a support presses. Around the ring, loads on the race are Gaussian, and those of supports are
even over strips. A port's displacement is the average with the weights of its load.

**Hertz is counted once.** The contact law has the half-space under an element's contact already.
So its compliance under the very patch is taken away from that of the finite elements
(``half_space``). Across the rolling direction the patch is as long as the contact; around the ring
it is a share of the wall's thickness, longer than the contact, so that waves much shorter than the
wall is thick are not needed. What is left changes with the square of that length, and is
extrapolated to none from two patches.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property, lru_cache
from math import ceil, hypot, sqrt

import numpy as np
import scipy.sparse as sp
from scipy.sparse.linalg import splu

from flexcage.core.errors import InputError
from flexcage.fem.linear import linear_solver
from flexcage.fem.revolved import Density, Revolved
from flexcage.geometry.materials import Material
from flexcage.geometry.ring import Raceway, RingSection
from flexcage.mesh.section import mesh_section
from flexcage.modes.half_space import line_compliance, spot_compliance

LEAST_HARMONICS, A_SUPPORT = 8, 3  # of a ring, and for every support
ALONG = 0.18  # standard deviation of a patch around the ring, as a share of the wall
_ELLIPSE = 1.0 / sqrt(5.0)  # standard deviation of Hertz's pressure, as a share of the semi-axis
_CUT = 3.0  # a Gaussian's Fourier coefficients end where they are exp(-_CUT^2/2)
_COARSE = 0.6  # size of triangles, as a share of the wall; at the patch a standard deviation
_SPREAD = 2.0  # standard deviations from the patch up to which they are so fine
_GROWTH = 0.4  # of triangles over the distance from there
_FINE = 0.3  # the same of a ring on supports
_SHALLOW = 4.2  # waves around the ring, times wall/radius, that do not reach through the wall
_NARROW = 10.0  # waves, times the width of a strip [rad], up to which supports are summed
_THIN = 0.02  # share of the wall below which no patch's extent goes


@dataclass(frozen=True)
class RingSeat:
    """How a ring's seat is held: rigidly, by a foundation [N/m^3], or by supports of its own."""

    rigidly: bool = True
    foundation: float = 0.0

    @property
    def free(self) -> bool:
        """Is the ring free but for supports?"""
        return not self.rigidly and self.foundation == 0.0


@dataclass(frozen=True, eq=False)
class RingReduction:
    """Compliances of a ring at its ports; see ``reduce_ring``.

    Ports 0 and 1 are on the race: axial and radial force on a spot, or radial force and moment on a
    line; port 2 is a radial force on the seat. ``compliance`` (N + 1, 3, 3) is of loads with the
    n-th Fourier coefficient 1 around the ring, ``shapes`` (N + 1, 3n, 3) are the displacements
    beneath it. A free ring's loads are balanced by its own inertia; ``rigid`` (3,) is how far a
    unit of radial translation displaces the ports.
    """

    model: Revolved
    raceway: Raceway
    held: RingSeat
    compliance: np.ndarray
    shapes: np.ndarray
    rigid: np.ndarray
    ports: np.ndarray  # (3n, 3) nodal loads
    along: float  # [rad] of a patch on the race
    shallow: float  # compliance of the seat under short waves, times their number
    half_space: np.ndarray  # (2, 2) of the patch on the race
    wider_half_space: np.ndarray  # (2, 2) of one sqrt(2) times as long

    @property
    def harmonics(self) -> np.ndarray:
        return np.arange(len(self.compliance))

    @cached_property
    def local(self) -> np.ndarray:
        """What of the compliance (2, 2) at an element's own contact is the ring's, and not the
        half-space's."""
        half_space = 2.0 * self.half_space - self.wider_half_space
        return self.between(np.array(0.0)) - half_space

    def between(self, azimuth: np.ndarray, *, slope: bool = False) -> np.ndarray:
        """Compliance (2, 2, m) of the race between elements that are angles (m,) apart; or its
        ``slope`` over the angle."""
        return self.series(self.weight, self.compliance[:, :2, :2], azimuth, slope=slope)

    @cached_property
    def weight(self) -> np.ndarray:
        """Weights (N + 1,) of harmonics between two loads on the race, extrapolated to short
        patches."""
        short, wide = (
            spectrum(self.harmonics, length) ** 2 for length in (self.along, sqrt(2.0) * self.along)
        )
        return 2.0 * short - wide

    def between_supports(
        self, azimuth: np.ndarray, width: np.ndarray, of: np.ndarray
    ) -> np.ndarray:
        """Compliance (S, S) of the seat between strips at ``azimuth`` (S,) and of ``width`` (S,)
        [rad]; ``of`` (N + 1,): the seat's in each harmonic, beyond which it is a half-space's."""
        n = np.arange(max(len(of), ceil(_NARROW / width.min())))
        whole = np.append(of, self.shallow / n[len(of) :])
        turn, load = np.multiply.outer(n, azimuth), strip(n[:, None], width)
        even, odd = load * np.cos(turn), load * np.sin(turn)
        return even.T @ (whole[:, None] * even) + odd.T @ (whole[:, None] * odd)

    def series(
        self, weight: np.ndarray, of: np.ndarray, azimuth: np.ndarray, *, slope: bool = False
    ) -> np.ndarray:
        """Sum (i, j, m) over harmonics of weight times ``of`` (N + 1, i, j) times cos n azimuth."""
        n = self.harmonics
        wave = np.cos(np.multiply.outer(n, azimuth))
        if slope:
            wave = np.einsum("n,n...->n...", -n, np.sin(np.multiply.outer(n, azimuth)))
        return np.einsum("n,nij,n...->ij...", weight, of, wave)


def spectrum(n: np.ndarray, length: float) -> np.ndarray:
    """Fourier coefficients of a Gaussian of unit area with a standard deviation [rad]; the first
    two are those of a point, so that radial forces keep their resultant."""
    return np.where(n < 2, 1.0, np.exp(-0.5 * (n * length) ** 2))


def strip(n: np.ndarray, width: np.ndarray) -> np.ndarray:
    """Fourier coefficients of an even load of unit area over a strip of a width [rad]; the first
    two are those of a point, so that radial forces keep their resultant."""
    return np.where(n < 2, 1.0, np.sinc(n * width / (2.0 * np.pi)))


@lru_cache(maxsize=8)
def reduce_ring(
    section: RingSection,
    material: Material,
    held: RingSeat,
    *,
    supports: int = 0,
    along: float = ALONG,
) -> RingReduction:
    """Reduction of a ring on a number of ``supports``; ``along``: standard deviation of patches
    around the ring, as a share of the wall. Kept for the next solutions with the same ring: do not
    change its arrays."""
    raceway, length = section.raceway, along * section.wall
    model = Revolved(_mesh(section, length, _FINE if supports else _COARSE), material)
    angle = length / raceway.place[1]
    count = max(LEAST_HARMONICS, A_SUPPORT * supports, ceil(_CUT / angle))
    ports = _ports(model, raceway)
    compliance = np.empty((count + 1, 3, 3))
    shapes = np.empty((count + 1, model.n_dof, 3))
    for n in range(count + 1):
        shapes[n] = _answers(model, held, ports, n)
        compliance[n] = ports.T @ shapes[n]
    shallow = _shallow(model, material)
    if supports:  # triangles are too large for the shortest waves
        short = np.arange(min(ceil(_SHALLOW * raceway.place[1] / section.wall), count), count + 1)
        compliance[short, 2, 2] = shallow / short
    return RingReduction(
        model=model,
        raceway=raceway,
        held=held,
        compliance=compliance,
        shapes=shapes,
        rigid=ports.T @ model.rigid_motions(1)[:, 0],
        ports=ports,
        along=angle,
        shallow=shallow,
        half_space=_half_space(raceway, length, material),
        wider_half_space=_half_space(raceway, sqrt(2.0) * length, material),
    )


def natural_frequencies(model: Revolved, held: RingSeat, n: int, count: int) -> np.ndarray:
    """The lowest ``count`` angular frequencies [rad/s] of a harmonic, of a free ring without its
    rigid motions."""
    return natural_modes(model, held, n, count)[0]


def natural_modes(
    model: Revolved, held: RingSeat, n: int, count: int
) -> tuple[np.ndarray, np.ndarray]:
    """The same with their shapes (3N, count), of unit modal mass; always with the same signs, on
    which coordinates of a run rest."""
    from scipy.sparse.linalg import eigsh

    keep, stiffness = _kept(model, held, n)
    mass = model.mass(n)[keep][:, keep]
    rigid = model.rigid_motions(n).shape[1] if held.free else 0
    shift = -1e-6 * float(stiffness.diagonal().sum() / mass.diagonal().sum())
    first = np.random.default_rng(0).standard_normal(stiffness.shape[0])
    values, vectors = eigsh(stiffness, count + rigid, mass, sigma=shift, v0=first)
    order = np.argsort(values)[rigid:]
    shapes = np.zeros((model.n_dof, count))
    shapes[keep] = vectors[:, order] * np.where(first @ vectors[:, order] < 0.0, -1.0, 1.0)
    return np.sqrt(values[order]), shapes


def _kept(model: Revolved, held: RingSeat, n: int) -> tuple[np.ndarray, sp.csc_matrix]:
    """Degrees of freedom that the seat leaves free, and their stiffness."""
    keep = np.ones(model.n_dof, bool)
    stiffness = model.stiffness(n)
    if held.rigidly:
        keep.reshape(-1, 3)[model.edge_nodes("seat")] = False
    elif held.foundation > 0.0:
        stiffness = stiffness + held.foundation * model.foundation("seat", n)
    free = np.flatnonzero(keep)
    return free, stiffness[free][:, free].tocsc()


def _answers(model: Revolved, held: RingSeat, loads: np.ndarray, n: int) -> np.ndarray:
    """Displacements (3N, k) under loads of harmonic n; of a free ring with the inertia of its rigid
    motions, to which they are orthogonal in mass."""
    free, stiffness = _kept(model, held, n)
    found = np.zeros_like(loads)
    rigid = model.rigid_motions(n)
    if held.free and rigid.shape[1]:
        border = sp.csc_matrix(model.mass(n) @ rigid)
        scale = stiffness.diagonal().mean() / abs(border).max()
        whole = sp.bmat([[stiffness, scale * border], [scale * border.T, None]], format="csc")
        padded = np.vstack([loads, np.zeros((rigid.shape[1], loads.shape[1]))])
        found[:] = splu(whole).solve(padded)[: len(loads)]
    else:
        found[free] = linear_solver(stiffness).solve(loads[free])
    return found


def _ports(model: Revolved, raceway: Raceway) -> np.ndarray:
    """Nodal loads (3N, 3) of the ports."""
    if raceway.line:
        half = raceway.extent
        over = [
            model.line_load("race", (0.0, 1.0), lambda x, r: 0.5 / half + 0.0 * x),
            model.line_load("race", (0.0, 1.0), lambda x, r: 1.5 * x / half**3),
        ]
    else:
        density = _gaussian(raceway, _ELLIPSE * raceway.extent)
        whole = model.edge_length("race", density)
        over = [model.line_load("race", way, density) / whole for way in ((1.0, 0.0), (0.0, 1.0))]
    width = model.edge_length("seat", lambda x, r: 1.0 + 0.0 * x)
    seat = model.line_load("seat", (0.0, 1.0), lambda x, r: 1.0 / width + 0.0 * x)
    return np.stack([*over, seat], axis=1)


def _shallow(model: Revolved, material: Material) -> float:
    """Compliance of the seat under a wave far shorter than the wall is thick, in plane strain,
    times the number of waves around the ring: K. L. Johnson, Contact Mechanics, equation 13.12."""
    width = model.edge_length("seat", lambda x, r: 1.0 + 0.0 * x)
    return 2.0 * (1.0 - material.poisson_ratio**2) / (np.pi * material.youngs_modulus * width)


def _gaussian(raceway: Raceway, deviation: float) -> Density:
    """Density along the race's edge about the contact's middle; its integral is not yet 1."""
    x0, r0 = raceway.place

    def density(x: np.ndarray, r: np.ndarray) -> np.ndarray:
        return np.exp(-0.5 * ((x - x0) ** 2 + (r - r0) ** 2) / deviation**2)

    return density


def _half_space(raceway: Raceway, length: float, material: Material) -> np.ndarray:
    """Compliance (2, 2) of the half-space at the ports of the race."""
    if raceway.line:
        return np.diag(line_compliance(raceway.extent, length, material))
    normal, shear = spot_compliance(_ELLIPSE * raceway.extent, length, material)
    n = np.array(raceway.normal)
    t = np.array([n[1], -n[0]])
    return normal * np.outer(n, n) + shear * np.outer(t, t)


def _mesh(section: RingSection, length: float, coarse: float):
    """Triangles, fine where elements press; elsewhere ``coarse`` times the wall."""
    raceway, wall = section.raceway, section.wall
    if not wall > 0.0:
        raise InputError(
            f"a ring whose race lies {-1e3 * wall:.3g} mm beyond its seat cannot bend; give a seat "
            "that leaves a wall",
            where="ring",
        )
    extent = max(raceway.extent * (1.0 if raceway.line else _ELLIPSE), _THIN * wall)

    def size(x: float, r: float) -> float:
        away = hypot(x - raceway.place[0], r - raceway.place[1])
        near = [s + _GROWTH * max(away - _SPREAD * s, 0.0) for s in (length, extent)]
        return min(coarse * wall, *near)

    return mesh_section(section.outline, section.names, size)
