"""Displacement and stress of rings that bend, from their harmonics.

The harmonics that answer every element's force are added up with the forces of a static solution.
Under its element a race bears a patch of load that is as long across the rolling direction as the
contact and a share of the wall along it: stress is that of the ring away from the contacts, beneath
which Hertz's own is not resolved.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from flexcage.fem.model import lame
from flexcage.fem.revolved import PSI, R, Revolved, X
from flexcage.modes.ring import spectrum, strip
from flexcage.stress.operators import von_mises
from flexcage.system.statics.rings import BentRing

_STEP = 2.0  # stations of a field for every wave of the highest harmonic that counts
_FEWEST = 180
_MOST = 720


@dataclass(frozen=True, eq=False)
class RingField:
    """Displacement and stress of one ring at stations around it.

    ``displacement`` (m, N, 3) [m]: axial, radial, along psi; ``stress`` (m, N, 6) [Pa]: xx, rr,
    psi psi, x r, r psi, x psi, both at the nodes of the section, at azimuths ``station`` (m,).
    """

    ring: BentRing
    station: np.ndarray
    displacement: np.ndarray
    stress: np.ndarray

    @cached_property
    def von_mises(self) -> np.ndarray:
        """Equivalent stress (m, N) [Pa]."""
        return von_mises(self.stress)

    @property
    def model(self) -> Revolved:
        return self.ring.seated.reduction.model

    def points(self, scale: float = 0.0) -> np.ndarray:
        """Places (m, N, 3) in space, displaced ``scale`` times."""
        moved = scale * self.displacement
        x, r = self.model.nodes.T
        cos, sin = np.cos(self.station)[:, None], np.sin(self.station)[:, None]
        radial, along = r + moved[..., R], moved[..., PSI]
        return np.stack(
            [x + moved[..., X], radial * cos - along * sin, radial * sin + along * cos], axis=-1
        )

    def quadrangles(self) -> np.ndarray:
        """Points (k, 4) of the surface's quadrangles, numbered station by station."""
        border = self.model.border
        count, nodes = len(self.station), len(self.model.nodes)
        here = nodes * np.arange(count)[:, None, None] + border
        there = np.roll(here, -1, axis=0)
        return np.stack([here[..., 0], here[..., 1], there[..., 1], there[..., 0]], -1).reshape(
            -1, 4
        )


def ring_field(ring: BentRing, *, stations: int | None = None) -> RingField:
    """Field of a ring of a static solution, at evenly spaced ``stations``."""
    reduction, seated = ring.seated.reduction, ring.seated
    n = reduction.harmonics
    count = stations or int(np.clip(_STEP * len(n), _FEWEST, _MOST))
    station = 2.0 * np.pi * np.arange(count) / count
    along, across = (np.zeros((len(n), 3)) for _ in range(2))  # cos and sin series of all loads
    for series, wave in ((along, np.cos), (across, np.sin)):
        on_race = spectrum(n, reduction.along)[:, None]
        series[:, :2] = on_race * (wave(np.multiply.outer(n, ring.azimuth)) @ ring.force)
        if len(ring.bears):
            on_seat = strip(n[:, None], seated.width)
            series[:, 2] = (
                on_seat * wave(np.multiply.outer(n, seated.support))
            ) @ -ring.support_force
    model = reduction.model
    displacement = np.zeros((count, model.n_dof // 3, 3))
    stress = np.zeros((count, model.n_dof // 3, 6))
    moved = _translation(ring)
    for k in n:
        amplitudes = [reduction.shapes[k] @ series[k] for series in (along, across)]
        if k == 1:
            amplitudes = [a + t * model.rigid_motions(1)[:, 0] for a, t in zip(amplitudes, moved)]
        cos, sin = np.cos(k * station), np.sin(k * station)
        for amplitude, even, odd in ((amplitudes[0], cos, sin), (amplitudes[1], sin, -cos)):
            u = amplitude.reshape(-1, 3)
            waves = np.stack([even, even, odd], axis=-1)
            displacement += waves[:, None, :] * u
            waves = np.stack([even] * 4 + [odd] * 2, axis=-1)
            stress += waves[:, None, :] * _stress(model, u, int(k))
    return RingField(ring, station, displacement, stress)


def _translation(ring: BentRing) -> np.ndarray:
    """Rigid translation (2,) along y and z of a ring on supports."""
    if not len(ring.bears):
        return np.zeros(2)
    return ring.seated.translation(ring.force, ring.bears)


def _stress(model: Revolved, u: np.ndarray, n: int) -> np.ndarray:
    """Stress (N, 6) of displacements (N, 3) of a harmonic, at nodes: the mean of triangles."""
    along_x, along_r = model.nodal_gradients
    r = model.nodes[:, 1]
    dx, dr = along_x @ u, along_r @ u
    strain = np.stack(
        [
            dx[:, X],
            dr[:, R],
            (u[:, R] + n * u[:, PSI]) / r,
            dr[:, X] + dx[:, R],
            dr[:, PSI] - (n * u[:, R] + u[:, PSI]) / r,
            dx[:, PSI] - n * u[:, X] / r,
        ],
        axis=-1,
    )
    first, shear = lame(model.material)
    stress = shear * strain
    stress[:, :3] *= 2.0
    stress[:, :3] += first * strain[:, :3].sum(axis=1, keepdims=True)
    return stress
