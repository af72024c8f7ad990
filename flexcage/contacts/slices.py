"""Buffers over the slices (or points) of one contact, and the laws applied to all of them at once.

All buffers lie in one record, at distances that the compiler knows, so that it can prove them
apart and turn loops over slices into vector instructions; multiples of eight slices fill those.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from flexcage.core.jit import VECTORISED, as_array, part

MOST = 64  # slices, or points, of one contact
_NAMES = (
    "d",  # penetration
    "v",  # its rate
    "N",  # normal force
    "Nd",  # dN/dd
    "Nv",  # dN/dv
    "Ne",  # its elastic part, at zero rate
    "u",  # sliding speed
    "g",  # mu/u
    "dg",  # d(mu/u)/du
    "still",  # zeros: rates for elastic forces
    "t1",  # components of the sliding velocity
    "t2",
    "n1",  # components of the normal on the roller, in F
    "n2",
    "n3",
    "w1",  # velocity of the wall under a slice (x, r, psi)
    "w2",
    "w3",
)
RECORD = np.dtype([(name, np.float64, MOST) for name in _NAMES], align=True)


class Slices(NamedTuple):
    """The record, in an array of one (numba hands over arrays, not single records)."""

    row: np.ndarray  # (1,) of RECORD


def new_slices() -> Slices:
    return Slices(np.zeros(1, RECORD).view(np.recarray))


@part
def normal_forces(law, n, sl, p):
    """Forces sl.N, their elastic part sl.Ne and their slopes sl.Nd, sl.Nv at penetrations sl.d and
    rates sl.v."""
    law(
        n, as_array(sl.d), as_array(sl.v), p, as_array(sl.N), as_array(sl.Ne), as_array(sl.Nd),
        as_array(sl.Nv),
    )  # fmt: skip


@part
def elastic_forces(law, n, sl, p):
    """The same without rates."""
    law(
        n, as_array(sl.d), as_array(sl.still), p, as_array(sl.N), as_array(sl.Ne), as_array(sl.Nd),
        as_array(sl.Nv),
    )  # fmt: skip


@part
def friction_factors(law, n, sl, p):
    """sl.g = mu/u and its slope sl.dg at sliding speeds sl.u."""
    law(n, as_array(sl.u), p, as_array(sl.g), as_array(sl.dg))


@part(fastmath=VECTORISED)
def largest(n, values):
    """Largest of the first n values."""
    most = values[0]
    for k in range(1, n):
        most = max(most, values[k])
    return most


@part(fastmath=VECTORISED)
def friction_power(n, sl):
    """Power that friction takes from the slices [W], negative."""
    power = 0.0
    for k in range(n):
        power -= sl.N[k] * sl.g[k] * sl.u[k] ** 2
    return power


@part(fastmath=VECTORISED)
def stored_and_damped(n, sl, exponent):
    """Elastic energy of the slices [J], and the power that damping takes from them [W].

    ``exponent`` of the elastic force.
    """
    energy = power = 0.0
    for k in range(n):
        energy += sl.Ne[k] * max(sl.d[k], 0.0)
        power -= (sl.N[k] - sl.Ne[k]) * sl.v[k]
    return energy / (exponent + 1.0), power
