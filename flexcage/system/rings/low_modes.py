"""Which modes a ring has in a run, and which of its deflection is left without mass.

Those up to a frequency, with cosine and sine round the ring, and the translation of a ring that
nothing holds but supports. The compliance of the rest is what the static solution's has beside
theirs. So a run at rest is the static solution, wherever the line between both is drawn.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import block_diag

from flexcage.contacts.ring_waves import COSINE, SINE
from flexcage.fem.revolved import PSI, R, Revolved, X
from flexcage.modes.ring import RingReduction, natural_modes, spectrum, strip
from flexcage.system.rings.modes import RingModes, modes_of
from flexcage.system.rings.races import POINTS
from flexcage.system.statics.rings import BentRing, SeatedRing

CARRIED = 2.0 * np.pi * 16e3  # [rad/s] modes below have mass; higher ones, on the contacts of
# all elements, would swing faster than elements do between rigid rings
DAMPED = 0.5  # of ``relaxation``: by which a mode's spring damps it
_FAINT = 1e-3  # of a port's compliance in a harmonic, that a mode must make to count
_BATCH = 4  # modes of a harmonic that are looked for at a time
_RACE, _SEAT = slice(0, 2), 2  # ports of a reduction


@dataclass(frozen=True, eq=False)
class Coordinates:
    """Modes of unit mass, each with cosine or sine: wave, shape at the race's ports, at supports'
    ports, stiffness, how a turning ring couples them, and where they stand at the start."""

    harmonic: np.ndarray  # (M,)
    quarter: np.ndarray  # (M,)
    shape: np.ndarray  # (M, 2)
    section: np.ndarray  # (M, 3) of the section as a whole: axially, radially, in tilt
    chi: np.ndarray  # (S, M) at supports
    stiffness: np.ndarray  # (M,)
    turning: np.ndarray  # (M, M), antisymmetric
    at_start: np.ndarray  # (M,)

    def waves(self, azimuth: np.ndarray) -> np.ndarray:
        """Waves (m, M) at azimuths (m,)."""
        turn = np.multiply.outer(azimuth, self.harmonic)
        return np.where(self.quarter == COSINE, np.cos(turn), np.sin(turn))


@dataclass(frozen=True, eq=False)
class LowModes:
    """Shapes of a ring's modes, each for cosine and sine: harmonic (m,), frequency (m,) [rad/s], of
    its translation 0, shapes (m, 3) at the ports, of unit modal mass, motions (m, 3) of the section
    as a whole: axially at the ring's axis, radially in its middle plane, in tilt; and ``turning``
    (m, m): the momentum of one in how another changes round the ring."""

    harmonic: np.ndarray
    frequency: np.ndarray
    shape: np.ndarray
    section: np.ndarray
    turning: np.ndarray

    def compliance(self, harmonics: int) -> np.ndarray:
        """Their share (N + 1, 3, 3) of the compliance."""
        found = np.zeros((harmonics, 3, 3))
        for n, w, shape in zip(self.harmonic, self.frequency, self.shape):
            if w > 0.0:
                found[n] += np.outer(shape, shape) / w**2
        return found


def low_modes(ring: RingReduction, below: float = CARRIED, *, least: int = 0) -> LowModes:
    """Modes below a frequency [rad/s] that yield to what presses on the ring, of harmonics from the
    ``least`` on. Those from 2 on have no inertia in common with the motions of a seat."""
    found, turning = [], []
    if ring.held.free:
        across = ring.model.rigid_motions(1)[:, 0]
        mass = float(across @ (ring.model.mass(1) @ across))
        found = [(1, 0.0, ring.rigid / np.sqrt(mass), np.array([0.0, 1.0, 0.0]) / np.sqrt(mass))]
        turning = [np.zeros((1, 1))]  # it is the same all round
    whole = _section_motions(ring.model)
    for n in ring.harmonics[least:]:
        frequency, shapes = _below(ring, int(n), below)
        at_ports = ring.ports.T @ shapes
        share = (at_ports / frequency) ** 2 / np.diag(ring.compliance[n])[:, None]
        counts = share.max(axis=0) > _FAINT
        own = whole @ shapes[:, counts]
        found += [
            (int(n), w, s, m) for w, s, m in zip(frequency[counts], at_ports.T[counts], own.T)
        ]
        turning.append(_turning(ring.model, int(n), shapes[:, counts]))
        if n > 1 and not len(frequency):
            break
    if not found:
        return LowModes(
            np.zeros(0, int), np.zeros(0), np.zeros((0, 3)), np.zeros((0, 3)), np.zeros((0, 0))
        )
    harmonic, w, shape, section = (np.array(column) for column in zip(*found))
    return LowModes(harmonic, w, shape, section, block_diag(*turning))


def _turning(model: Revolved, n: int, shapes: np.ndarray) -> np.ndarray:
    """Momentum (k, k) of shapes (3N, k) in how they change round the ring, of harmonic n: the
    vector u = (U_x cos, U_r cos, U_psi sin) changes by -(n U_x, n U_r + U_psi, n U_psi + U_r), of
    the same turned by a quarter of a wave, in every radian."""
    x, r, psi = (shapes[way::3] for way in (X, R, PSI))
    changes = np.empty_like(shapes)
    changes[X::3], changes[R::3], changes[PSI::3] = n * x, n * r + psi, n * psi + r
    return shapes.T @ (model.mass(n) @ changes)


def _section_motions(model: Revolved) -> np.ndarray:
    """What of displacements (3N,) is a motion of the section as a rigid one: axially at the ring's
    axis, radially, in tilt; fitted by least squares, weighted with mass. (3, 3N)."""
    x, r = model.nodes.T
    motion = np.zeros((len(x), 3, 3))
    motion[:, X, 0], motion[:, R, 1], motion[:, X, 2], motion[:, R, 2] = 1.0, 1.0, -r, x
    motions = motion.reshape(-1, 3)
    weighted = model.mass(1) @ motions
    return np.linalg.solve(motions.T @ weighted, weighted.T)


def _below(ring: RingReduction, n: int, below: float) -> tuple[np.ndarray, np.ndarray]:
    """Frequencies and shapes of a harmonic's modes below a frequency."""
    count = _BATCH
    while True:
        frequency, shapes = natural_modes(ring.model, ring.held, n, count)
        if frequency[-1] >= below:
            low = frequency < below
            return frequency[low], shapes[:, low]
        count += _BATCH


def left_over(ring: RingReduction, modes: LowModes) -> np.ndarray:
    """Compliance (N + 1, 3, 3) without that of modes."""
    return ring.compliance - modes.compliance(len(ring.compliance))


def ring_coordinates(bent: BentRing, modes: LowModes) -> Coordinates:
    """Coordinates of a ring that rests as the static solution has it."""
    seated, harmonic = bent.seated, np.repeat(modes.harmonic, 2)
    quarter = np.tile([COSINE, SINE], len(modes.harmonic))
    there = (harmonic > 0) | (quarter == COSINE)
    harmonic, quarter = harmonic[there], quarter[there]
    shape, w = np.repeat(modes.shape, 2, axis=0)[there], np.repeat(modes.frequency, 2)[there]
    g = np.sqrt(seated.reduction.weight[harmonic])
    made = Coordinates(
        harmonic, quarter, g[:, None] * shape[:, _RACE],
        np.repeat(modes.section, 2, axis=0)[there], np.empty((0, len(w))), w**2,
        np.kron(modes.turning, [[0.0, 1.0], [-1.0, 0.0]])[np.ix_(there, there)], 0.0 * w,
    )  # fmt: skip
    on_seat = strip(harmonic, seated.width[:, None]) * shape[:, _SEAT]
    made = replace(made, chi=made.waves(seated.support) * on_seat)
    push = ((made.waves(bent.azimuth).T @ bent.force) * made.shape).sum(axis=1)
    if len(bent.bears):
        push -= made.chi.T @ bent.support_force
    at_start = np.where(w > 0.0, push / np.maximum(w, 1.0) ** 2, 0.0)
    if seated.reduction.held.free:
        moved = seated.translation(bent.force, bent.bears)  # along y and z
        at_start[w == 0.0] = moved * seated.reduction.rigid[_SEAT] / modes.shape[0, _SEAT]
    return replace(made, at_start=at_start)


def late_of(made: Coordinates, relaxation: float) -> np.ndarray:
    """Times (M,) [s] by which the modes' springs damp them."""
    return np.full(len(made.harmonic), DAMPED * relaxation)


def modes_of_ring(
    seated: SeatedRing, modes: LowModes, made: Coordinates, relaxation: float
) -> RingModes:
    """Data of a ring for kernels, with its supports if it has any."""
    if not len(seated.support):
        return modes_of(
            len(seated.azimuth), made.harmonic, made.quarter, made.shape, made.section,
            made.stiffness, late_of(made, relaxation), made.turning,
        )  # fmt: skip
    ring, azimuth = seated.reduction, 2.0 * np.pi * np.arange(POINTS) / POINTS
    n, rest = ring.harmonics, left_over(ring, modes)
    # race and support: the whole, less what modes have of it with the race's extrapolated weight
    both = spectrum(n, ring.along)[:, None] * ring.compliance[:, _RACE, _SEAT]
    both -= np.sqrt(ring.weight)[:, None] * (ring.compliance - rest)[:, _RACE, _SEAT]
    width, kind = np.unique(seated.width.round(12), return_inverse=True)
    table = [
        np.hstack([
            ring.series(strip(n, w), both[:, :, None], azimuth, slope=slope)[:, 0].T
            for slope in (False, True)
        ])
        for w in width
    ]  # fmt: skip
    return modes_of(
        len(seated.azimuth), made.harmonic, made.quarter, made.shape, made.section, made.stiffness,
        late_of(made, relaxation), made.turning, azimuth=seated.support,
        chi=made.chi, table=np.stack(table), kind=kind,
        between=ring.between_supports(seated.support, seated.width, rest[:, _SEAT, _SEAT]),
        holds=not seated.presses_only,
    )  # fmt: skip
