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
from flexcage.contacts.state import U_SKEW, U_TILT
from flexcage.core.vectors import RIGID
from flexcage.fem.revolved import PSI, R, Revolved, X
from flexcage.modes.ring import RingReduction, natural_modes, spectrum, strip
from flexcage.system.data import AXIAL, MASS, TRANSVERSE, RingBody
from flexcage.system.rings.modes_data import RingModes, modes_of
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
    ports, stiffness, and where they stand at the start. What couples their inertia: with each other
    where the ring turns, and with the motions of its frame, in the order of its velocities, at rest
    (``coupling``) and where it turns (``tilting``); ``inertia`` is that of the whole ring."""

    harmonic: np.ndarray  # (M,)
    quarter: np.ndarray  # (M,)
    shape: np.ndarray  # (M, 2)
    section: np.ndarray  # (M, 3) of the section as a whole: axially, radially, in tilt
    chi: np.ndarray  # (S, M) at supports
    stiffness: np.ndarray  # (M,)
    turning: np.ndarray  # (M, M), antisymmetric
    coupling: np.ndarray  # (6, M)
    tilting: np.ndarray  # (6, M)
    inertia: np.ndarray  # (3,) mass, axial and transverse inertia
    at_start: np.ndarray  # (M,)

    def waves(self, azimuth: np.ndarray) -> np.ndarray:
        """Waves (m, M) at azimuths (m,)."""
        turn = np.multiply.outer(azimuth, self.harmonic)
        return np.where(self.quarter == COSINE, np.cos(turn), np.sin(turn))


@dataclass(frozen=True, eq=False)
class LowModes:
    """Shapes of a ring's modes, each for cosine and sine: harmonic (m,), frequency (m,) [rad/s], of
    its translation 0, shapes (m, 3) at the ports, of unit modal mass, and motions (m, 3) of the
    section as a whole: axially at the ring's axis, radially in its middle plane, in tilt. Products
    of inertia: ``turning`` (m, m) of one with how another changes round the ring, ``moved`` (m, 2)
    with the translation of the same harmonic and with a tilt, ``tilting`` (m,) with how a tilt
    changes round the ring."""

    harmonic: np.ndarray
    frequency: np.ndarray
    shape: np.ndarray
    section: np.ndarray
    moved: np.ndarray
    tilting: np.ndarray
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
    ``least`` on."""
    found, turning, whole = [], [], _section_motions(ring.model)
    for n in ring.harmonics[least:]:
        frequency, shapes = _below(ring, int(n), below)
        at_ports = ring.ports.T @ shapes
        share = (at_ports / frequency) ** 2 / np.diag(ring.compliance[n])[:, None]
        counts = share.max(axis=0) > _FAINT
        kept, w = shapes[:, counts], frequency[counts]
        if ring.held.free and n == 1:
            kept, w = np.hstack([_translation(ring.model), kept]), np.append(0.0, w)
        found += _columns(ring, int(n), w, kept, whole)
        turning.append(kept.T @ (ring.model.mass(n) @ _round_the_ring(int(n), kept)))
        if n > 1 and not len(frequency):
            break
    n, w, shape, section, moved, tilting = (
        np.array([each[k] for each in found]).reshape(-1, *size)
        for k, size in enumerate(((), (), (3,), (3,), (2,), ()))
    )
    return LowModes(n.astype(int), w, shape, section, moved, tilting, block_diag(*turning))


def _translation(model: Revolved) -> np.ndarray:
    """A ring's translation across its axis (3N, 1), of unit modal mass."""
    across = model.rigid_motions(1)[:, :1]
    return across / np.sqrt(across.T @ (model.mass(1) @ across))


def _columns(
    ring: RingReduction, n: int, w: np.ndarray, shapes: np.ndarray, whole: np.ndarray
) -> list[tuple]:
    """What ``LowModes`` has of each of the shapes (3N, k) of harmonic n; ``whole`` (3, 3N) gives
    the motions of the section as a whole."""
    rigid = ring.model.rigid_motions(n)
    weighted = ring.model.mass(n) @ shapes
    moved, tilting = np.zeros((shapes.shape[1], 2)), np.zeros(shapes.shape[1])
    if n == 0:
        moved[:, 0] = rigid[:, 0] @ weighted
    elif n == 1:
        moved = (rigid.T @ weighted).T
        tilting = _round_the_ring(1, rigid[:, 1:])[:, 0] @ weighted
    at_ports, own = ring.ports.T @ shapes, whole @ shapes
    return [(n, *each) for each in zip(w, at_ports.T, own.T, moved, tilting)]


def _round_the_ring(n: int, shapes: np.ndarray) -> np.ndarray:
    """How shapes (3N, k) of harmonic n change round the ring: the vector (U_x cos n psi, U_r cos n
    psi, U_psi sin n psi) in every radian by -(n U_x, n U_r + U_psi, n U_psi + U_r) of the same
    turned by a quarter of a wave."""
    x, r, psi = (shapes[way::3] for way in (X, R, PSI))
    changes = np.empty_like(shapes)
    changes[X::3], changes[R::3], changes[PSI::3] = n * x, n * r + psi, n * psi + r
    return changes


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


def residual_compliance(ring: RingReduction, modes: LowModes) -> np.ndarray:
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
    coupling, tilting = _with_frame(modes)
    made = Coordinates(
        harmonic, quarter, g[:, None] * shape[:, _RACE],
        np.repeat(modes.section, 2, axis=0)[there], np.empty((0, len(w))), w**2,
        np.kron(modes.turning, [[0.0, 1.0], [-1.0, 0.0]])[np.ix_(there, there)],
        coupling[:, there], tilting[:, there], _inertia(seated.reduction.model), 0.0 * w,
    )  # fmt: skip
    on_seat = strip(harmonic, seated.width[:, None]) * shape[:, _SEAT]
    made = replace(made, chi=made.waves(seated.support) * on_seat)
    push = ((made.waves(bent.azimuth).T @ bent.force) * made.shape).sum(axis=1)
    if len(bent.bears):
        push -= made.chi.T @ bent.support_force
    at_start = np.where(w > 0.0, push / np.maximum(w, 1.0) ** 2, 0.0)
    if seated.reduction.held.free:
        moved = seated.translation(bent.force, bent.bears)  # along y and z
        own = modes.shape[modes.frequency == 0.0, _SEAT]
        at_start[w == 0.0] = moved * seated.reduction.rigid[_SEAT] / own
    return replace(made, at_start=at_start)


def _with_frame(modes: LowModes) -> tuple[np.ndarray, np.ndarray]:
    """Products of inertia (6, 2 m) of modes, with cosine and sine, and motions of the ring's frame
    in the order of its velocities: at rest, and of a ring that turns."""
    coupling, tilting = np.zeros((2, RIGID, len(modes.harmonic), 2))
    even, once = modes.harmonic == 0, modes.harmonic == 1
    across, tilt = modes.moved.T
    coupling[0, even, COSINE] = across[even]
    coupling[1, once, COSINE] = coupling[2, once, SINE] = across[once]
    coupling[U_TILT, once, COSINE], coupling[U_SKEW, once, SINE] = tilt[once], -tilt[once]
    tilting[U_SKEW, once, COSINE] = tilting[U_TILT, once, SINE] = modes.tilting[once]
    return coupling.reshape(RIGID, -1), tilting.reshape(RIGID, -1)


def _inertia(model: Revolved) -> np.ndarray:
    """Mass, axial and transverse inertia (3,) of a ring about its centre."""
    (axial, spin), (_, tilt) = (model.rigid_motions(n).T for n in (0, 1))
    return np.array([x @ (model.mass(n) @ x) for n, x in ((0, axial), (0, spin), (1, tilt))])


def ring_with_modes(ring: RingBody, given: np.ndarray, made: Coordinates) -> RingBody:
    """A ring with modes. Where these have inertia in common with its frame, that of its finite
    elements takes the place of the one ``given`` (3,), which is in it."""
    inertia, count = ring.inertia, made.coupling.shape[1]
    if made.coupling.any():
        inertia = inertia - given + made.inertia
    mass = np.eye(RIGID + count)
    mass[:RIGID, RIGID:], mass[RIGID:, :RIGID] = made.coupling, made.coupling.T
    own = np.arange(RIGID)
    mass[own, own] = inertia[[MASS, MASS, MASS, AXIAL, TRANSVERSE, TRANSVERSE]]
    free = np.append(ring.free * ((own > 2) | (not ring.stands)), np.ones(count)) > 0
    inverse = np.zeros_like(mass)
    inverse[np.ix_(free, free)] = np.linalg.inv(mass[np.ix_(free, free)])
    return ring._replace(
        inertia=inertia, coupling=made.coupling, inverse=inverse, spare=np.zeros(len(mass))
    )


def late_of(made: Coordinates, relaxation: float) -> np.ndarray:
    """Times (M,) [s] by which the modes' springs damp them."""
    return np.full(len(made.harmonic), DAMPED * relaxation)


def modes_of_ring(
    seated: SeatedRing, modes: LowModes, made: Coordinates, relaxation: float
) -> RingModes:
    """Data of a ring for kernels, with its supports if it has any."""
    own = (
        len(seated.azimuth), made.harmonic, made.quarter, made.shape, made.section, made.stiffness,
        late_of(made, relaxation), made.turning, made.coupling, made.tilting,
    )  # fmt: skip
    if not len(seated.support):
        return modes_of(*own)
    ring, azimuth = seated.reduction, 2.0 * np.pi * np.arange(POINTS) / POINTS
    n, rest = ring.harmonics, residual_compliance(ring, modes)
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
        *own, azimuth=seated.support, chi=made.chi, table=np.stack(table), kind=kind,
        between=ring.between_supports(seated.support, seated.width, rest[:, _SEAT, _SEAT]),
        holds=not seated.presses_only,
    )  # fmt: skip
