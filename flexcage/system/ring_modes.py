"""What an outer ring on supports or a soft foundation has of mass in a run.

Modes of the ring up to a frequency swing (``swinging``), with cosine and sine round it, and so does
the translation of a ring that nothing holds but supports. The compliance of the rest is what the
static solution's has beside theirs. So a run at rest is the static solution, wherever the line
between both is drawn.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from flexcage.contacts.ring_waves import COSINE, SINE
from flexcage.fem.revolved import R, Revolved, X
from flexcage.modes.ring import RingReduction, natural_modes, spectrum, strip
from flexcage.system.bending import POINTS
from flexcage.system.statics.rings import BentRing, SeatedRing
from flexcage.system.swinging import Swings, swings_of

CARRIED = 2.0 * np.pi * 16e3  # [rad/s] modes below have mass; higher ones, on the contacts of
# all elements, would swing faster than elements do between rigid rings
DAMPED = 0.5  # of ``relaxation``: by which a coordinate's spring damps it
_FAINT = 1e-3  # of a port's compliance in a harmonic, that a mode must make to count
_BATCH = 4  # modes of a harmonic that are looked for at a time
_RACE, _SEAT = slice(0, 2), 2  # ports of a reduction


@dataclass(frozen=True, eq=False)
class Coordinates:
    """Coordinates of unit mass: wave, shape at the race's ports, at supports' ports, stiffness, and
    where they stand at the start."""

    harmonic: np.ndarray  # (M,)
    quarter: np.ndarray  # (M,)
    shape: np.ndarray  # (M, 2)
    section: np.ndarray  # (M, 3) of the section as a whole: axially, radially, in tilt
    chi: np.ndarray  # (S, M) at supports
    stiffness: np.ndarray  # (M, M)
    at_start: np.ndarray  # (M,)

    def waves(self, azimuth: np.ndarray) -> np.ndarray:
        """Waves (m, M) at azimuths (m,)."""
        turn = np.multiply.outer(azimuth, self.harmonic)
        return np.where(self.quarter == COSINE, np.cos(turn), np.sin(turn))


@dataclass(frozen=True, eq=False)
class LowModes:
    """Modes of a ring that swing: harmonic (m,), frequency (m,) [rad/s], of its translation 0,
    shapes (m, 3) at the ports, of unit modal mass, and motions (m, 3) of the section as a whole:
    axially at the ring's axis, radially in its middle plane, in tilt."""

    harmonic: np.ndarray
    frequency: np.ndarray
    shape: np.ndarray
    section: np.ndarray

    def compliance(self, harmonics: int) -> np.ndarray:
        """Their share (N + 1, 3, 3) of the compliance."""
        found = np.zeros((harmonics, 3, 3))
        for n, w, shape in zip(self.harmonic, self.frequency, self.shape):
            if w > 0.0:
                found[n] += np.outer(shape, shape) / w**2
        return found


def low_modes(ring: RingReduction, below: float = CARRIED) -> LowModes:
    """Modes below a frequency [rad/s] that yield to what presses on the ring."""
    found = []
    if ring.held.free:
        across = ring.model.rigid_motions(1)[:, 0]
        mass = float(across @ (ring.model.mass(1) @ across))
        found = [(1, 0.0, ring.rigid / np.sqrt(mass), np.array([0.0, 1.0, 0.0]) / np.sqrt(mass))]
    whole = _section_motions(ring.model)
    for n in ring.harmonics:
        frequency, shapes = _below(ring, int(n), below)
        at_ports = ring.ports.T @ shapes
        share = (at_ports / frequency) ** 2 / np.diag(ring.compliance[n])[:, None]
        counts = share.max(axis=0) > _FAINT
        own = whole @ shapes[:, counts]
        found += [
            (int(n), w, s, m) for w, s, m in zip(frequency[counts], at_ports.T[counts], own.T)
        ]
        if n > 1 and not len(frequency):
            break
    return LowModes(*(np.array(column) for column in zip(*found)))


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
    """Compliance (N + 1, 3, 3) without that of modes that swing."""
    return ring.compliance - modes.compliance(len(ring.compliance))


def ring_coordinates(bent: BentRing, modes: LowModes) -> Coordinates:
    """Coordinates of a ring on supports that rests as the static solution has it."""
    seated, harmonic = bent.seated, np.repeat(modes.harmonic, 2)
    quarter = np.tile([COSINE, SINE], len(modes.harmonic))
    there = (harmonic > 0) | (quarter == COSINE)
    harmonic, quarter = harmonic[there], quarter[there]
    shape, w = np.repeat(modes.shape, 2, axis=0)[there], np.repeat(modes.frequency, 2)[there]
    g = np.sqrt(seated.reduction.weight[harmonic])
    made = Coordinates(
        harmonic, quarter, g[:, None] * shape[:, _RACE],
        np.repeat(modes.section, 2, axis=0)[there], np.empty((0, len(w))), np.diag(w**2), 0.0 * w,
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
    """Times (M,) [s] by which coordinates' springs damp them."""
    return np.full(len(made.harmonic), DAMPED * relaxation)


def swings_of_ring(
    seated: SeatedRing, modes: LowModes, made: Coordinates, relaxation: float
) -> Swings:
    """Data of a ring for kernels, with its supports if it has any."""
    if not len(seated.support):
        return swings_of(
            len(seated.azimuth), made.harmonic, made.quarter, made.shape, made.section,
            made.stiffness, late_of(made, relaxation),
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
    return swings_of(
        len(seated.azimuth), made.harmonic, made.quarter, made.shape, made.section, made.stiffness,
        late_of(made, relaxation), azimuth=seated.support,
        chi=made.chi, table=np.stack(table), kind=kind,
        between=ring.between_supports(seated.support, seated.width, rest[:, _SEAT, _SEAT]),
        holds=not seated.presses_only,
    )  # fmt: skip
