"""Buffers over the slices (or points) of contacts, and the laws applied to all of them at once.

All buffers lie in one record, at distances that the compiler knows, so that it can prove them
apart and turn loops over slices into vector instructions; multiples of eight slices fill those.
A record holds one contact, or a lot of them one after the other: a law takes little longer for a
lot than for one.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from flexcage.contacts.evaluation import DAMPED, NORMAL, RUBBED, STORED
from flexcage.core.jit import VECTORISED, array_from, part, zero

CAPACITY = 136  # slices of one contact (128 at the most) or of a lot of them: what a near cache
# holds, and no power of two, at which distance buffers share the cache's places
_NAMES = (
    "d",  # penetration
    "v",  # its rate
    "onset",  # speed at which the contact closed
    "N",  # normal force
    "Nd",  # dN/dd
    "Nv",  # dN/dv
    "Ne",  # its elastic part, at zero rate
    "u",  # sliding speed
    "g",  # mu/u
    "dg",  # d(mu/u)/du
    "still",  # zeros: rates and onset speeds for elastic forces
    "t1",  # components of the sliding velocity, two or all three
    "t2",
    "t3",
    "n1",  # components of the normal on the roller, in F
    "n2",
    "n3",
)


class Laws(NamedTuple):
    """The laws of a contact place, as compiled functions."""

    normal: Any
    friction: Any


class Slices(NamedTuple):
    """A record, in an array of one (numba hands over arrays, not single records)."""

    row: np.ndarray  # (1,) of a record


def new_slices() -> Slices:
    record = np.dtype([(name, np.float64, CAPACITY) for name in _NAMES], align=True)
    return Slices(np.zeros(1, record).view(np.recarray))


@part
def normal_forces(law, span, sl, p, onset):
    """Forces sl.N, their elastic part sl.Ne and their slopes sl.Nd, sl.Nv at penetrations sl.d and
    rates sl.v, of the slices of a contact from span[0] to before span[1], which closed at the speed
    ``onset``; p the law's parameters."""
    for k in range(span[0], span[1]):
        sl.onset[k] = onset
    normal_forces_of_lot(law, span, sl, p)


@part
def normal_forces_of_lot(law, span, sl, p):
    """The same of contacts that differ in their onset speeds, which are in sl.onset."""
    a, n = span[0], np.int64(span[1] - span[0])
    law(
        n, array_from(sl.d, a), array_from(sl.v, a), array_from(sl.onset, a), p,
        array_from(sl.N, a), array_from(sl.Ne, a), array_from(sl.Nd, a), array_from(sl.Nv, a),
    )  # fmt: skip


@part
def elastic_forces(law, span, sl, p):
    """The same of one contact without rates."""
    a, n = span[0], np.int64(span[1] - span[0])
    still = array_from(sl.still, a)
    law(
        n, array_from(sl.d, a), still, still, p, array_from(sl.N, a), array_from(sl.Ne, a),
        array_from(sl.Nd, a), array_from(sl.Nv, a),
    )  # fmt: skip


@part
def friction_factors(law, span, sl, p):
    """sl.g = mu/u and its slope sl.dg at sliding speeds sl.u."""
    a, n = span[0], np.int64(span[1] - span[0])
    law(n, array_from(sl.u, a), p, array_from(sl.g, a), array_from(sl.dg, a))


@part(fastmath={*VECTORISED, "nnan"})  # else one comparison waits for the other
def largest(span, values):
    """Largest of the values of a span."""
    most = values[span[0]]
    for k in range(span[0], span[1]):
        most = max(most, values[k])
    return most


@part(fastmath=VECTORISED)
def total(span, values):
    """Sum of the values of a span."""
    x = 0.0
    for k in range(span[0], span[1]):
        x += values[k]
    return x


@part(fastmath=VECTORISED)
def friction_power(span, sl):
    """Power that friction takes from the slices of a span [W], negative."""
    power = 0.0
    for k in range(span[0], span[1]):
        power -= sl.N[k] * sl.g[k] * sl.u[k] ** 2
    return power


@part(fastmath=VECTORISED)
def stored_and_damped(span, sl, exponent):
    """Elastic energy of the slices of a span [J], and the power that damping takes from them [W].

    ``exponent`` of the elastic force.
    """
    energy = power = 0.0
    for k in range(span[0], span[1]):
        energy += sl.Ne[k] * max(sl.d[k], 0.0)
        power -= (sl.N[k] - sl.Ne[k]) * sl.v[k]
    return energy / (exponent + 1.0), power


@part
def begin_sums(span, load, sl, exponent, sums):
    """Sums of a contact under a ``load`` whose slices are a span: of force and powers, and no
    others yet; ``exponent`` of the elastic force."""
    zero(sums)
    sums[NORMAL], sums[RUBBED] = load, friction_power(span, sl)
    sums[STORED], sums[DAMPED] = stored_and_damped(span, sl, exponent)
