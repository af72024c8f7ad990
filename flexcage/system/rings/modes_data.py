"""The data of a ring's modes and of its supports, as kernels take it (``modes``)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from flexcage.contacts.ring_waves import PLACE, no_waves
from flexcage.core.vectors import RIGID
from flexcage.system.rings.races import POINTS

B1, B2, SLOPE1, SLOPE2 = range(4)  # in ``RingModes.table``: of both ports, and over the azimuth


class RingModes(NamedTuple):
    """Modes of one ring, and its supports; those behind ``holds`` are workspaces."""

    harmonic: np.ndarray  # (M,) n of a mode's wave round the ring
    quarter: np.ndarray  # (M,) COSINE or SINE of ``contacts.ring_waves``
    shape: np.ndarray  # (M, 2) by which it displaces the race at its crest, at both ports
    section: np.ndarray  # (M, 3) and the section as a whole, as ``contacts.ring_waves`` has it
    stiffness: np.ndarray  # (M,) for unit masses
    late: np.ndarray  # (M,) time tau by which its spring damps it
    turning: np.ndarray  # (M, M) P, antisymmetric
    coupling: np.ndarray  # (6, M) inertia that each has in common with the frame's motions
    tilting: np.ndarray  # (6, M) the same in P
    azimuth: np.ndarray  # (S,) of supports
    chi: np.ndarray  # (S, M) by which modes displace the ring outwards at supports
    table: np.ndarray  # (K, POINTS, 4) B of an element so far round the ring from a support
    kind: np.ndarray  # (S,) of the support in ``table``: supports as wide as it
    between: np.ndarray  # (S, S) D
    holds: int  # 1 if supports pull as well
    crest: np.ndarray  # (N + 1, 2, 4) of cosine and sine: displacement and rate at both ports
    load: np.ndarray  # (N + 1, 2, 2) contact forces on them, at both ports
    carried: np.ndarray  # (N + 1, 2, 2, 3) the section's waves; none if the ring has no modes
    borne: np.ndarray  # (N + 1, 2, 3) forces of ribs and lands on them
    wall: np.ndarray  # (3, 3) of the section beside a rib's roller, see ``sections``
    wave: np.ndarray  # (Z, N + 1, 2) cosine and sine of n psi
    moved: np.ndarray  # (Z, 2) displacement of the race by modes, at its ports
    slope: np.ndarray  # (Z, 2) of that over the azimuth
    orbit: np.ndarray  # (Z,) speeds [rad/s] at which elements orbit about the ring's centre
    rate: np.ndarray  # (Z, 2) rate of the displacement, as an element feels it that orbits
    total: np.ndarray  # (Z, 2) of all contact forces on the race, friction too, at its ports
    push: np.ndarray  # (M,) forces of supports on modes
    support_compliance: np.ndarray  # (S, Z, 4) B between supports and races, its slope (table)
    support_displacement: np.ndarray  # (S,) displacement of supports by modes
    free_penetration: np.ndarray  # (S,) what they would be entered by if none pressed
    press: np.ndarray  # (S,) forces on the ring, inwards
    kept: np.ndarray  # (S,) supports that press, those first
    bears: np.ndarray  # (S,) does it press?
    factor: np.ndarray  # (S, S) Cholesky's factor of D, for those that press
    step: np.ndarray  # (S,)


def no_modes(elements: int) -> RingModes:
    """Data of a ring without modes, in the types that kernels take."""
    none = np.zeros(0)
    return modes_of(
        elements, np.zeros(0, np.int64), np.zeros(0, np.int64), np.zeros((0, 2)),
        np.zeros((0, 3)), none, none, np.zeros((0, 0)), np.zeros((RIGID, 0)), np.zeros((RIGID, 0)),
    )  # fmt: skip


def standing(elements: int, made: RingModes, at: np.ndarray) -> RingModes:
    """Data of a ring whose section stays where modes ``at`` (M,) put it, for ribs in the search of
    a start."""
    still = no_modes(elements)
    if not len(at):
        return still
    carried, borne = 0.0 * made.carried, 0.0 * made.borne
    np.add.at(carried[:, :, PLACE], (made.harmonic, made.quarter), made.section * at[:, None])
    return still._replace(carried=carried, borne=borne, wave=0.0 * made.wave)


def modes_of(
    elements: int, harmonic: np.ndarray, quarter: np.ndarray, shape: np.ndarray,
    section: np.ndarray, stiffness: np.ndarray, late: np.ndarray, turning: np.ndarray,
    coupling: np.ndarray, tilting: np.ndarray, *,
    azimuth: np.ndarray | None = None, chi: np.ndarray | None = None,
    table: np.ndarray | None = None, kind: np.ndarray | None = None,
    between: np.ndarray | None = None, holds: bool = False,
) -> RingModes:  # fmt: skip
    """Modes and, if any are given, supports, with room to work."""
    count, held = len(harmonic), 0 if azimuth is None else len(azimuth)
    waves, z, st = int(harmonic.max(initial=0)) + 1, np.zeros, np.ascontiguousarray
    carried, borne = no_waves() if count == 0 else (z((waves, 2, 2, 3)), z((waves, 2, 3)))
    return RingModes(
        harmonic, quarter, st(shape), st(section), st(stiffness), late, st(turning), st(coupling),
        st(tilting),
        z(0) if azimuth is None else azimuth,
        z((held, count)) if chi is None else st(chi),
        z((1, POINTS, 4)) if table is None else st(table),
        z(held, np.int64) if kind is None else kind.astype(np.int64),
        z((held, held)) if between is None else st(between),
        int(holds), z((waves, 2, 4)), z((waves, 2, 2)), carried, borne, z((3, 3)),
        z((elements, waves, 2)),
        z((elements, 2)), z((elements, 2)), z(elements), z((elements, 2)), z((elements, 2)),
        z(count),
        z((held, elements, 4)), z(held), z(held), z(held), z(held, np.int64), z(held, np.int64),
        z((held, held)), z(held),
    )  # fmt: skip
