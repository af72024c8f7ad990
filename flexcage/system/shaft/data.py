"""The arrays by which kernels know a rotor and the bearings on it.

A rotor has a frame that does not spin with it, as a ring's: the centre (x, y, z) of its mass in
space, skew and tilt; and, if it is elastic, modes of unit mass in bending, free at both ends. Its
spin is prescribed. Its unknowns follow those of all bearings in y: q (5 + n), then u (5 + n), which
are v (3), the angular velocities about its second and third axis, and the rates of its modes.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

RIGID_ROTOR = 5  # coordinates of the frame: x, y, z, skew, tilt
#: Powers beside those of the bearings: what loads and gravity do on the rotor, its modes' damping,
#: and what goes into the inner rings.
SHAFT_POWERS = ("load", "gravity", "damping", "to_bearings")
LOADS, WEIGHT, DAMPED, TO_BEARINGS = range(4)


class ShaftData(NamedTuple):
    """A rotor with n modes on b bearings; N = 5 + n."""

    first: np.ndarray  # (b + 1,) where the unknowns of each bearing begin in y; last: the rotor's
    inner_q: np.ndarray  # (b,) places of each inner ring's first coordinate in y
    inner_u: np.ndarray  # (b,) and of its first velocity
    lam: np.ndarray  # (b,) and of the multipliers of what holds it
    ring: np.ndarray  # (b, 2) mass and transverse inertia of each inner ring
    place: np.ndarray  # (b,) of each bearing along the axis, from the centre of mass [m]
    # (b, 5) signs of an inner ring's coordinates in its bearing's frame over those in the rotor's:
    # 1, or (-1, 1, -1, 1, -1) of a bearing that faces the other way, turned by half a turn about y
    sign: np.ndarray
    # (b,) by how much each inner ring is pressed along its bearing's x, as spacers or fits make it
    offset: np.ndarray
    shape: np.ndarray  # (b, 5, n) modes there: displacements in space, skew and tilt
    inertia: np.ndarray  # (3,) of the rotor alone: mass, axial and transverse inertia
    stiffness: np.ndarray  # (n,) of the modes: w^2
    damping: np.ndarray  # (n,) 2 zeta w
    gyro: np.ndarray  # (n, n) skew: of the modes at unit spin
    gyro_turn: np.ndarray  # (n, 2) the same with the frame's two turns
    gravity: np.ndarray  # (3,)
    load: np.ndarray  # (N,) generalised forces of constant loads, in a rotor that is straight
    unbalance: np.ndarray  # (2, N) of unit forces along y and z, times masses and eccentricities
    phase: np.ndarray  # (2, N) the same for those a quarter of a turn ahead
    speed: np.ndarray  # (2, m) table of time and speed
    angle: np.ndarray  # (m,) angle at the table's times
    wave: np.ndarray  # (4,) of the speed
    # workspace
    axes: np.ndarray  # (3, 3) rows in space: the rotor's axis, its second and third
    reach: np.ndarray  # (b, 5, N) from the rotor's velocities to those of inner rings
    apart: np.ndarray  # (b, 5) accelerations of the rings while the rotor's velocities stay
    borne: np.ndarray  # (b, 5) forces on each inner ring, without the rotor's
    given: np.ndarray  # (b, 5) the rotor's forces on each inner ring, found
    matrix: np.ndarray  # (N, N)
    pivot: np.ndarray  # (N,)
    x: np.ndarray  # (N,) accelerations
    pushed: np.ndarray  # (N,) generalised forces of loads and unbalance
    kept: np.ndarray  # (samples, b, 5) the rotor's forces at the samples of a block


@dataclass(frozen=True, kw_only=True)
class Rotor:
    """A rotor in its b bearings, with n modes; generalised forces are those on its 5 + n
    velocities, of a rotor that is straight."""

    place: np.ndarray  # (b,) of the bearings along the axis, from its centre of mass [m]
    reversed: np.ndarray  # (b,) booleans: which of them face the other way
    offset: np.ndarray  # (b,) by how much they are pressed in, along their own x [m]
    inertia: np.ndarray  # (3,) mass, axial and transverse inertia, without inner rings
    gravity: np.ndarray  # (3,)
    load: np.ndarray  # (5 + n,) of what does not change
    unbalance: np.ndarray  # (2, 5 + n) at 1 rad/s, of forces along y and along z
    phase: np.ndarray  # (2, 5 + n) the same of those that are a quarter of a turn ahead
    shape: np.ndarray  # (b, 5, n) displacements, and skew and tilt, of the modes in the bearings
    stiffness: np.ndarray  # (n,) [1/s^2]
    damping: np.ndarray  # (n,) [1/s]
    gyro: np.ndarray  # (n, n) at 1 rad/s
    gyro_turn: np.ndarray  # (n, 2)


def stiff_rotor(
    *, place: Sequence[float], inertia: Sequence[float], gravity: np.ndarray, load: np.ndarray,
    reversed: Sequence[bool] = (), offset: Sequence[float] = (),
) -> Rotor:  # fmt: skip
    """A rotor without modes, in balance."""
    z, count = np.zeros, len(place)
    return Rotor(
        place=np.array(place, float), reversed=np.array(reversed or [False] * count),
        offset=np.array(offset or [0.0] * count), inertia=np.array(inertia, float),
        gravity=gravity, load=np.array(load, float), unbalance=z((2, RIGID_ROTOR)),
        phase=z((2, RIGID_ROTOR)), shape=z((count, RIGID_ROTOR, 0)), stiffness=z(0), damping=z(0),
        gyro=z((0, 0)), gyro_turn=z((0, 2)),
    )  # fmt: skip


def workspace(bearings: int, modes: int, samples: int) -> dict[str, np.ndarray]:
    """The fields that the kernels write, for blocks of so many samples."""
    z, n = np.zeros, RIGID_ROTOR + modes
    return {
        "axes": z((3, 3)), "reach": z((bearings, RIGID_ROTOR, n)),
        "apart": z((bearings, RIGID_ROTOR)), "borne": z((bearings, RIGID_ROTOR)),
        "given": z((bearings, RIGID_ROTOR)), "matrix": z((n, n)), "pivot": z(n, np.int64),
        "x": z(n), "pushed": z(n), "kept": z((samples, bearings, RIGID_ROTOR)),
    }  # fmt: skip
