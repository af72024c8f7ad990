"""An elastic housing under the outer ring: how the ring's frame yields with its seat.

The housing is a reduced body, in the bearing's frame, held somewhere to the ground. The outer ring
stays rigid. Its frame moves with the seat's nodes in one of two ways:

- "rigid": the seat follows the ring, x_seat = G u, as a ring that is pressed in (RBE2);
- "average": the ring follows the seat, u = (G^T G)^-1 G^T x_seat, the least-squares rigid motion of
  its nodes, whose forces share out alike (RBE3 with equal weights, of translations).

G are the rigid motions at the nodes. What does not move with the ring is condensed statically,
which is exact at rest (Guyan, AIAA Journal 3 (1965) 380).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy.sparse as sp

from flexcage.core.body_file import BodyFile
from flexcage.core.errors import FlexcageError, InputError
from flexcage.core.units import describe
from flexcage.fem.linear import available_kinds, linear_solver
from flexcage.modes.exchange.body import ReducedBody, rigid_motions
from flexcage.modes.exchange.formats import read_body
from flexcage.modes.exchange.systems import SYSTEMS, nearest_system
from flexcage.system.spec import Mount

WHERE = "mount.body"
_OFF = 0.02  # of the seat's radius, that a node may lie off it: facets of a coarse mesh
_CENTRE = 0.01  # of the seat's radius, that a single node may lie off the bearing's centre
# assumptions, of E B: brackets are a hundred times softer, a solid all round is hardly stiffer
_SOFTEST, _STIFFEST = 5e-3, 30.0
DENSE = 2000  # coordinates, to which matrices are solved dense
_SINGULAR = 1e-11  # of the scaled stiffness's largest eigenvalue
_FIVE = [0, 1, 2, 4, 5]  # x, y, z and tilts about y, z of six motions


@dataclass(frozen=True)
class Seated:
    """A housing with a ring on its seat: coordinates ``tie`` z of the body (n, m), and motions
    ``ring.T`` z of the ring's frame (m, 6): x, y, z and turns about them."""

    body: ReducedBody
    tie: sp.csr_matrix
    ring: np.ndarray

    @property
    def stiffness(self) -> sp.csr_matrix:
        """Stiffness (m, m) on z."""
        return sp.csr_matrix(self.tie.T @ sp.csr_matrix(self.body.stiffness) @ self.tie)


def seated(mount: Mount, *, diameter: float, width: float) -> Seated:
    """The housing ``mount.body`` with the outer ring on its seat, of this ``diameter`` and
    ``width`` [m]. InputError for nodes that are not at the seat."""
    body = read_body(mount.body, nodes=mount.body_nodes, units=mount.body_units, where=WHERE)
    nodes = seat_nodes(body, mount, diameter=diameter, width=width)
    return _tied(body, mount.seat_tie, [(nodes, 0.0, diameter)])


def _tied(body: ReducedBody, tie: str, seats: Sequence[tuple[np.ndarray, float, float]]) -> Seated:
    """The body with rings on its seats: nodes, centre along x and diameter [m] of each."""
    own, motions = [], []
    for nodes, centre, diameter in seats:
        rows = np.flatnonzero(np.isin(body.dofs[:, 0], nodes))
        if tie == "average" and len(nodes) > 1:
            rows = rows[body.dofs[rows, 1] < 3]  # turns of single nodes say nothing of the seat's
        own.append(rows)
        motions.append(_motions(body, rows, centre))
        _check_rank(body, motions[-1], diameter)
    return _TIES[tie](body, own, motions)


def seat_compliance(mount: Mount, *, diameter: float, width: float) -> np.ndarray:
    """Displacements (5,5) [m/N, rad/(N m) ...] of the outer ring's frame under unit forces and
    moments on it: x, y, z and tilts about y, z, at the bearing's centre.

    ``diameter`` and ``width`` [m] of the ring's seat. InputError for a housing that is not held, or
    whose nodes are not at the seat.
    """
    return _compliance(seated(mount, diameter=diameter, width=width), np.array(_FIVE))


def _compliance(housing: Seated, chosen: np.ndarray) -> np.ndarray:
    """Of the frames on the housing, symmetric, for the motions ``chosen`` of them."""
    whole = housing.ring.T @ solved(housing.body, housing.stiffness, housing.ring)
    return np.asarray(0.5 * (whole + whole.T)[np.ix_(chosen, chosen)])


def seats_compliance(
    file: BodyFile, places: Sequence[tuple[float, float, float]], *, tie: str, where: str
) -> np.ndarray:
    """Displacements (5 b, 5 b) of the frames of b outer rings in one housing under unit forces and
    moments on them: ``places`` (centre along x, diameter, width) [m], in the housing's axes; the
    nodes of a seat are those that lie there. ``tie`` as ``Mount.seat_tie``, for all of them.

    InputError for a housing that is not held, or a place where it has no seat.
    """
    body = read_body(file.body, nodes=file.body_nodes, units=file.body_units, where=where)
    seats = [
        (_nodes_at(body, centre, 0.5 * diameter, width, where), centre, diameter)
        for centre, diameter, width in places
    ]
    five = (6 * np.arange(len(places))[:, None] + _FIVE).ravel()
    return _compliance(_tied(body, tie, seats), five)


def _nodes_at(
    body: ReducedBody, centre: float, radius: float, width: float, where: str
) -> np.ndarray:
    """Nodes of the body on a seat round x, or the one in its centre."""
    chosen = body.boundary
    x, r = body.nodes[chosen, 0] - centre, np.hypot(*body.nodes[chosen, 1:].T)
    alone = chosen[(np.abs(x) < _CENTRE * radius) & (r < _CENTRE * radius)]
    if len(alone):
        return alone[:1]
    found = chosen[(np.abs(r - radius) <= _OFF * radius)
                   & (np.abs(x) <= 0.5 * width + _OFF * radius)]  # fmt: skip
    if not len(found):
        raise InputError(
            f"{body.source}: no node with coordinates of its own lies on the bearing's seat at "
            f"x = {1e3 * centre:.4g} mm, radius {1e3 * radius:.4g} mm; write the housing in the "
            "machine's axes, x from the shaft's left end, and keep the seats' nodes, or check "
            f"{where}_units.",
            where=where,
        )
    return found


def implausible_seat(compliance: np.ndarray, mount: Mount, *, modulus: float, width: float) -> str:
    """A sentence on a seat of ``mount.body`` that is far softer or stiffer across the axis than a
    solid of this modulus [Pa] as wide as the bearing, E B; "" for a usual one."""
    stiffness = 2.0 / float(compliance[1, 1] + compliance[2, 2])
    share = stiffness / (modulus * width)
    if _SOFTEST <= share <= _STIFFEST:
        return ""
    return (
        f"the seat of mount.body bears {describe(stiffness, 'N/um')} across the axis, {share:.2g} "
        "times what a solid of the rings' steel as wide as the bearing does: are its stiffness and "
        f"its nodes in mount.body_units '{mount.body_units}'?"
    )


def seat_nodes(body: ReducedBody, mount: Mount, *, diameter: float, width: float) -> np.ndarray:
    """Nodes (m,) of the body at the seat: of the set that the mount names, else all with
    coordinates; or one in the bearing's centre, with six, to which another program tied the seat.
    """
    chosen = body.boundary
    if mount.seat:
        sets = {name.lower(): found for name, found in body.interface.items()}
        if mount.seat.lower() not in sets:
            known = ", ".join(sorted(sets)) or "no sets of nodes"
            raise InputError(
                f"mount.seat is '{mount.seat}', but {mount.body_nodes or mount.body} has {known}.",
                where="mount.seat",
                value=mount.seat,
            )
        chosen = np.intersect1d(chosen, sets[mount.seat.lower()])
    if not len(chosen):
        raise InputError(
            f"{body.source}: no node of the seat has coordinates of its own; keep them in the "
            "reduction.",
            where=WHERE,
        )
    radius = 0.5 * diameter
    if len(chosen) == 1 and np.linalg.norm(body.nodes[chosen[0]]) < _CENTRE * radius:
        return chosen
    _check_places(body, chosen, mount, radius, width)
    return chosen


def _check_places(
    body: ReducedBody, chosen: np.ndarray, mount: Mount, radius: float, width: float
) -> None:
    places = body.nodes[chosen]
    own = np.hypot(places[:, 1], places[:, 2])
    off = np.maximum(np.abs(own - radius), np.abs(places[:, 0]) - 0.5 * width)
    worst = int(np.argmax(off))
    if off[worst] <= _OFF * radius:
        return
    unit = nearest_system(SYSTEMS[mount.body_units].length * radius / float(np.median(own)))
    remedy = (
        f'set mount.body_units = "{unit}"'
        if unit and unit != mount.body_units
        else "name the seat's nodes as mount.seat, and write the housing in the bearing's frame, "
        "with x along its axis"
    )
    number = chosen[worst] + 1 if body.numbers is None else body.numbers[chosen[worst]]
    raise InputError(
        f"{body.source}: node {number} lies {1e3 * own[worst]:.4g} mm from the axis at x = "
        f"{1e3 * places[worst, 0]:.4g} mm, but the outer ring's seat has a radius of "
        f"{1e3 * radius:.4g} mm and reaches x = {500 * width:.4g} mm on either side; {remedy}.",
        where=WHERE,
        value=float(off[worst]),
    )


def _motions(body: ReducedBody, own: np.ndarray, centre: float = 0.0) -> np.ndarray:
    """What coordinates ``own`` (m,) do in unit rigid motions about the bearing's centre (m, 6),
    which lies so far along x."""
    every = np.zeros((len(body.nodes), 6, 6))
    every[:, :3] = rigid_motions(body.nodes - np.array([centre, 0.0, 0.0]))
    every[:, 3:, 3:] = np.eye(3)
    node, component = body.dofs[own].T
    return every[node, component]


def _check_rank(body: ReducedBody, motions: np.ndarray, diameter: float) -> None:
    scaled = motions * ([1.0] * 3 + [2.0 / diameter] * 3)
    values = np.linalg.svd(scaled, compute_uv=False)
    if len(values) < 6 or values[-1] < 1e-6 * values[0]:
        raise InputError(
            f"{body.source}: the seat's {len(motions)} coordinates do not tell where the outer "
            "ring is: give three nodes or more that lie around it, with x, y and z each, or one in "
            "the centre with six.",
            where=WHERE,
            value=len(motions),
        )


def _following(
    body: ReducedBody, own: Sequence[np.ndarray], motions: Sequence[np.ndarray]
) -> Seated:
    """Rings that their seats follow."""
    rest, many = np.setdiff1d(np.arange(body.size), np.concatenate(own)), 6 * len(own)
    columns = np.concatenate([*(np.repeat(rows, 6) for rows in own), rest])
    rings = [np.tile(6 * k + np.arange(6), len(rows)) for k, rows in enumerate(own)]
    rows = np.concatenate([*rings, many + np.arange(len(rest))])
    values = np.concatenate([*(m.ravel() for m in motions), np.ones(len(rest))])
    tie = sp.csr_matrix((values, (columns, rows)), shape=(body.size, many + len(rest)))
    return Seated(body, tie, np.eye(many + len(rest), many))


def _averaged(
    body: ReducedBody, own: Sequence[np.ndarray], motions: Sequence[np.ndarray]
) -> Seated:
    """Rings that follow their seats' mean rigid motions."""
    share = np.zeros((body.size, 6 * len(own)))
    for k, (rows, moves) in enumerate(zip(own, motions)):
        share[rows, 6 * k : 6 * k + 6] = moves @ np.linalg.inv(moves.T @ moves)
    return Seated(body, sp.identity(body.size, format="csr"), share)


_TIES = {"rigid": _following, "average": _averaged}


def solved(body: ReducedBody, stiffness: Any, loads: np.ndarray) -> np.ndarray:
    """Displacements (n, k) under loads (n, k); InputError where nothing holds the body."""
    try:
        if body.size > DENSE:
            return linear_solver(stiffness, kind=available_kinds()[0]).solve(loads)
        dense = stiffness.toarray()
        size = np.sqrt(np.maximum(np.diag(dense), 0.0))
        if not (size > 0.0).all():
            raise np.linalg.LinAlgError
        scaled = dense / np.outer(size, size)
        if np.linalg.eigvalsh(scaled)[0] < _SINGULAR * len(scaled):
            raise np.linalg.LinAlgError
        return np.linalg.solve(scaled, loads / size[:, None]) / size[:, None]
    except (np.linalg.LinAlgError, FlexcageError):
        raise InputError(
            f"{body.source}: the stiffness matrix is singular: nothing holds the housing to the "
            "ground; hold its feet or bolts when it is reduced.",
            where=WHERE,
        ) from None
