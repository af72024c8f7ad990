"""The cage's land as a tilted ring meets it: in the ring's frame, where the ring's own land is a
cylinder about x. What acts is brought back to space."""

from __future__ import annotations

from flexcage.contacts.land import LandCage, LandForces, LandRing
from flexcage.core.jit import outlined, part, zero
from flexcage.core.vectors import add_to, column, minus, put, turned, turned_back, xyz

# rows of ``LandWork.seen``: cage, ring, and forces and moments on both; the second stays zero
CENTRE, AT_REST, VELOCITY, SPIN, ON_CAGE, CAGE_MOMENT, ON_RING, RING_MOMENT = range(8)


@part
def is_tilted(axis):
    """Whether a ring's axis is not e_x."""
    return axis[1] != 0.0 or axis[2] != 0.0


@outlined
def seen_from_ring(cage, ring, frame, modal, lw):
    """Cage, ring and forces that are still zero in the ring's ``frame`` (columns, in space), whose
    axis comes first; the ring is at rest there but for its turn."""
    A, v = lw.A, lw.seen
    for k in range(3):
        e = turned_back(frame, column(cage.A, k))
        A[0, k], A[1, k], A[2, k] = e
    put(v[CENTRE], turned_back(frame, minus(xyz(cage.centre), xyz(ring.centre))))
    put(v[VELOCITY], turned_back(frame, minus(xyz(cage.velocity), xyz(ring.velocity))))
    put(v[SPIN], turned_back(frame, xyz(cage.spin)))
    zero(v[ON_CAGE:])
    return (
        LandCage(A, v[CENTRE], v[VELOCITY], v[SPIN], cage.q, cage.qd),
        LandRing(v[AT_REST], v[AT_REST], ring.turn),
        LandForces(v[ON_CAGE], v[CAGE_MOMENT], modal, v[ON_RING], v[RING_MOMENT]),
    )


@outlined
def bring_back(pushed, frame, forces):
    """Add to ``forces`` in space what the ring's frame has."""
    add_to(forces.cage_force, turned(frame, xyz(pushed.cage_force)))
    add_to(forces.cage_moment, turned(frame, xyz(pushed.cage_moment)))
    add_to(forces.ring_force, turned(frame, xyz(pushed.ring_force)))
    add_to(forces.ring_moment, turned(frame, xyz(pushed.ring_moment)))
