"""A shaft as another program reduced it: a free body with nodes on the axis.

Its stations are the nodes on the axis that have x, y, z and turns about y and z; other coordinates,
as fixed-interface modes, come with it. The spin is prescribed, so turns about x are held, and what
hangs on them alone is left out.

Gyroscopic moments are those of the file's matrix G; or, where the nodes turn about x, of the polar
inertia that each of them has there: with M the mass matrix and e a unit turn of the whole about x,
I_k = (M e)_k, which add up to the body's own. Sections then count as turning with the nearest
station, an assumption that is exact for a rigid body.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np
import scipy.sparse as sp
from scipy.sparse.csgraph import connected_components

from flexcage.core.errors import InputError
from flexcage.core.units import mm
from flexcage.machine.beams import DOFS
from flexcage.machine.shaft import ShaftModel
from flexcage.machine.spec import Gravity, Shaft
from flexcage.modes.exchange.body import ReducedBody
from flexcage.modes.exchange.checks import check_free
from flexcage.modes.exchange.formats import read_body
from flexcage.modes.exchange.systems import SYSTEMS, nearest_system

WHERE = "shaft.body"
_FIVE, _SPIN = [0, 1, 2, 4, 5], 3  # components of a station, and the turn about x
_OFF = 1e-4  # of the shaft's length: so near to the axis, or to a place, a node stands there
_BEYOND = 0.02  # of the length, that a node may stand off the shaft's ends
_UNLIKE = 0.01  # by which a round body's matrices may differ across, as meshes make them
_COUPLED = 1e-6  # of two coordinates' sizes: less couples nothing
_SKEW = 1e-6  # of the largest entry
_SLOWEST, _FASTEST = 30.0, 2e5  # m/s of sound along a shaft, with wheels or of ceramics (assumed)
_RATES = 2.0 * np.pi * np.array([200.0, 2000.0])  # rad/s at which both planes are compared
_QUARTER = np.array([[1, 0, 0, 0, 0], [0, 0, -1, 0, 0], [0, 1, 0, 0, 0],
                     [0, 0, 0, 0, -1], [0, 0, 0, 1, 0]])  # of a turn about x  # fmt: skip


@dataclass(frozen=True, eq=False)
class BodyShaft(ShaftModel):
    """A shaft of c coordinates: those of its stations at ``places``, then its other ones."""

    matrices: tuple[np.ndarray, np.ndarray, np.ndarray]  # stiffness, mass, gyroscopic (c, c)
    unit: np.ndarray  # (c, 5) coordinates of rigid motions about x = 0

    @cached_property
    def made(self) -> np.ndarray:
        """Coordinates (c, m) of the motions."""
        return self.unit if self.rigid else np.eye(len(self.unit))

    @cached_property
    def motions(self) -> np.ndarray:
        """Displacements (5 n, m) of the stations."""
        return self.made[: DOFS * len(self.places)]

    def rigid_about(self, centre: float) -> np.ndarray:
        """Coordinates (c, 5) of a rigid shaft that moves with, and turns about, a place [m]."""
        found = self.unit.copy()
        found[:, 4] -= centre * self.unit[:, 1]
        found[:, 3] += centre * self.unit[:, 2]
        return found

    @property
    def _own(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        return self.matrices

    def _weight(self, gravity: Gravity) -> np.ndarray:
        return np.asarray(self.matrices[1] @ self.unit[:, :3] @ gravity.vector)

    def load(self, gravity: Gravity) -> np.ndarray:
        """Generalised forces (c,) of loads and weight."""
        found, points = self._weight(gravity), self.point_loads(gravity)
        found[: len(points)] += points
        return found

    def by_node(self, gravity: Gravity) -> np.ndarray:
        """Forces and moments (k, 5) of loads and weight, to tell their size."""
        weight = np.pad(self.unit[:, :3].T @ self._weight(gravity), (0, 2))
        return np.vstack([self.point_loads(gravity).reshape(-1, DOFS), weight])

    def node_weights(self, gravity: Gravity) -> np.ndarray:
        """Weight (5 n,) at the stations, which together is that of the body."""
        return self._weight(gravity)[: DOFS * len(self.places)]

    def own_compliance(self, position: float) -> np.ndarray:
        """Nothing (5, 5): only stations and what lies beyond the last ones are told of."""
        return np.zeros((DOFS, DOFS))

    def at(self, position: float) -> np.ndarray:
        """Displacement (5, 5 n) at a station, or beyond the last ones, which move it rigidly."""
        k = self.node(position)
        arm = position - self.places[k]
        inside = self.places[0] < position < self.places[-1]
        if inside and abs(arm) > _OFF * self.spec.whole_length:
            raise InputError(
                f"{self.spec.body} has no node on the axis at {mm(position)}; the nearest is at "
                f"{mm(float(self.places[k]))}.",
                where="position", value=position,
            )  # fmt: skip
        found = np.zeros((DOFS, DOFS * len(self.places)))
        found[:, DOFS * k : DOFS * (k + 1)] = np.eye(DOFS)
        if not inside:
            found[1, DOFS * k + 4], found[2, DOFS * k + 3] = arm, -arm
        return found


def read_shaft(spec: Shaft, positions: Sequence[float]) -> BodyShaft:
    """The shaft of a file, with stations at ``positions`` [m] of bearings, at loads and discs.

    InputError for a body that is held, has no mass, is not round, or lacks a station.
    """
    body = read_body(spec.body, nodes=spec.body_nodes, units=spec.body_units, where=WHERE)
    check_free(body, where=WHERE)
    stations = _stations(body, spec)
    _check_places(body, spec, positions, stations)
    rows = np.array([_row(body, node, c) for node in stations for c in _FIVE])
    spins = np.flatnonzero((body.dofs[:, 1] == _SPIN) & (body.dofs[:, 0] >= 0))
    stiffness, mass = body.dense()
    kept = np.concatenate([rows, _further(body, (stiffness, mass), rows, spins)])
    gyroscopic = _gyroscopic(body, mass, stations, kept)
    assert body.rigid is not None
    unit = body.rigid[:, _FIVE][kept]
    found = BodyShaft(
        spec, body.nodes[stations, 0], (),
        (stiffness[np.ix_(kept, kept)], mass[np.ix_(kept, kept)], gyroscopic), unit,
    )  # fmt: skip
    _check_round(body, found)
    _check_speed(body, found)
    return found


def _row(body: ReducedBody, node: int, component: int) -> int:
    found = np.flatnonzero((body.dofs == (node, component)).all(axis=1))
    return int(found[0]) if len(found) else -1


def _stations(body: ReducedBody, spec: Shaft) -> np.ndarray:
    """Nodes (n,) on the axis that have five coordinates, from left to right."""
    length, chosen = spec.whole_length, body.boundary
    _check_extent(body, spec, chosen)
    on_axis = [n for n in chosen if np.hypot(*body.nodes[n, 1:]) <= _OFF * length]
    found = [n for n in on_axis if all(_row(body, n, c) >= 0 for c in _FIVE)]
    if len(found) < 2:
        raise InputError(
            f"{body.source}: {len(found)} of its {len(chosen)} nodes with coordinates of their own "
            "stand on the axis and move along x, y, z and turn about y and z, but a shaft needs "
            "two or more; keep nodes on its axis (y = z = 0), to which its sections are tied, with "
            "all six components.",
            where=WHERE, value=len(found),
        )  # fmt: skip
    order = np.argsort(body.nodes[found, 0], kind="stable")
    return np.array(found)[order]


def _check_extent(body: ReducedBody, spec: Shaft, chosen: np.ndarray) -> None:
    """The nodes lie along the shaft, in its units."""
    length, x = spec.whole_length, body.nodes[chosen, 0]
    reach = float(np.abs(x).max(initial=0.0))
    inside = len(x) and x.min() >= -_BEYOND * length and x.max() <= (1.0 + _BEYOND) * length
    if inside and reach > 0.1 * length:
        return
    unit = (
        nearest_system(SYSTEMS[spec.body_units].length * length / reach, within=0.3)
        if reach
        else ""
    )
    remedy = "write it in the machine's axes, x from the shaft's left end"
    if unit and unit != spec.body_units:
        remedy = f'set shaft.body_units = "{unit}"'
    raise InputError(
        f"{body.source}: its nodes reach from x = {mm(float(x.min(initial=0.0)))} to "
        f"{mm(float(x.max(initial=0.0)))}, but the shaft from 0 to {mm(length)}; {remedy}.",
        where=WHERE, value=reach,
    )  # fmt: skip


def _check_places(
    body: ReducedBody, spec: Shaft, positions: Sequence[float], stations: np.ndarray
) -> None:
    """Bearings, discs and loads stand at stations."""
    wanted = [("a bearing", x) for x in positions]
    wanted += [(f"shaft.discs.{k}", d.position) for k, d in enumerate(spec.discs)]
    wanted += [(f"shaft.loads.{k}", p.position) for k, p in enumerate(spec.loads)]
    places = body.nodes[stations, 0]
    for what, x in wanted:
        nearest = float(places[np.argmin(np.abs(places - x))])
        if abs(nearest - x) > _OFF * spec.whole_length:
            raise InputError(
                f"{body.source}: {what} stands at {mm(x)}, but no node on the axis does (the "
                f"nearest is at {mm(nearest)}); keep one there in the reduction.",
                where=WHERE, value=x,
            )  # fmt: skip


def _further(
    body: ReducedBody, both: tuple[np.ndarray, np.ndarray], rows: np.ndarray, spins: np.ndarray
) -> np.ndarray:
    """Coordinates beside those of stations, without turns about x and what hangs on these alone.
    InputError where they move a station across the axis."""
    link = np.zeros(both[0].shape, bool)
    for matrix in both:
        size = np.sqrt(np.maximum(np.diag(matrix), 0.0))
        link |= np.abs(matrix) > _COUPLED * np.outer(size, size)
    if len(spins) and (np.abs(both[0][np.ix_(spins, rows)])
                       > _UNLIKE * np.sqrt(np.outer(*(np.diag(both[0])[i] for i in (spins, rows))))
                       ).any():  # fmt: skip
        raise _not_round(body, "it bends as it is twisted")
    others = np.setdiff1d(np.arange(body.size), np.concatenate([rows, spins]))
    free = np.concatenate([rows, others])
    _, group = connected_components(sp.csr_matrix(link[np.ix_(free, free)]), directed=False)
    held = np.isin(group, np.unique(group[: len(rows)]))
    return np.asarray(free[len(rows) :][held[len(rows) :]])


def _gyroscopic(
    body: ReducedBody, mass: np.ndarray, stations: np.ndarray, kept: np.ndarray
) -> np.ndarray:
    """Gyroscopic matrix (c, c) at 1 rad/s over the coordinates kept: the file's, or of stations."""
    if body.gyroscopic is not None:
        given = body.gyroscopic
        return _checked(body, given.toarray() if sp.issparse(given) else np.asarray(given), kept)
    assert body.rigid is not None
    pull = mass @ body.rigid[:, _SPIN]
    own = np.array([_row(body, node, _SPIN) for node in stations])
    polar = np.where(own >= 0, pull[own], 0.0)
    whole = float(body.rigid[:, _SPIN] @ pull)
    if not whole > 0.0 or abs(polar.sum() - whole) > _UNLIKE * whole:
        raise InputError(
            f"{body.source}: its nodes on the axis do not tell its polar inertia, of which "
            "gyroscopic moments come; keep their turns about x in the reduction, or give the "
            "gyroscopic matrix as G.",
            where=WHERE, value=whole,
        )  # fmt: skip
    found = np.zeros((len(kept), len(kept)))
    about_y = DOFS * np.arange(len(stations)) + 3
    found[about_y, about_y + 1], found[about_y + 1, about_y] = polar, -polar
    return found


def _checked(body: ReducedBody, given: np.ndarray, kept: np.ndarray) -> np.ndarray:
    """A file's gyroscopic matrix; InputError unless it is skew and of a spin about +x."""
    largest = max(float(np.abs(given).max(initial=0.0)), 1e-300)
    if not np.isfinite(given).all() or np.abs(given + given.T).max() > _SKEW * largest:
        raise InputError(
            f"{body.source}: the gyroscopic matrix G is not skew-symmetric; write that of "
            "M q'' + w G q' + K q = f for a spin w about +x.",
            where=WHERE,
        )
    assert body.rigid is not None
    if body.rigid[:, 4] @ given @ body.rigid[:, 5] < 0.0:
        raise InputError(
            f"{body.source}: the gyroscopic matrix G is that of a spin about -x; change its sign.",
            where=WHERE,
        )
    return given[np.ix_(kept, kept)]


def _check_round(body: ReducedBody, shaft: BodyShaft) -> None:
    """The stations answer alike in both planes: K and M, condensed to them by Guyan, and
    K + s^2 M, in which all coordinates count."""
    stiffness, mass, _ = shaft.matrices
    many = DOFS * len(shaft.places)
    tie = _following(stiffness, many)
    seen = [("stiffness", tie.T @ stiffness @ tie), ("inertia", tie.T @ mass @ tie)]
    for rate in _RATES:
        whole = stiffness + rate**2 * mass
        seen.append(("inertia", (whole @ _following(whole, many))[:many]))
    turn = np.kron(np.eye(len(shaft.places)), _QUARTER)
    for what, found in seen:
        size = np.sqrt(np.maximum(np.diag(found), 1e-300))
        across = np.maximum(size, np.abs(turn) @ size)
        apart = np.abs(turn.T @ found @ turn - found) / np.outer(across, across)
        if apart.max() > _UNLIKE:
            raise _not_round(body, f"its {what} across y and z differs by {apart.max():.1%}")


def _following(matrix: np.ndarray, many: int) -> np.ndarray:
    """Coordinates (c, many) of which the others follow the first without forces of their own."""
    inner = np.linalg.lstsq(matrix[many:, many:], matrix[many:, :many], rcond=None)[0]
    return np.vstack([np.eye(many), -inner])


def _check_speed(body: ReducedBody, shaft: BodyShaft) -> None:
    """Sound runs along it as fast as in shafts: L sqrt(k/m), k its stiffness along x between its
    last stations. Units of mass and time that do not belong together are off by a thousand."""
    stiffness, mass, _ = shaft.matrices
    force = np.zeros(len(stiffness))
    last = DOFS * (len(shaft.places) - 1)
    force[[0, last]] = -1.0, 1.0
    moved = np.linalg.lstsq(stiffness, force, rcond=1e-12)[0]
    yields = max(float(moved[last] - moved[0]), 1e-300)
    weight = float(shaft.unit[:, 0] @ mass @ shaft.unit[:, 0])
    length = float(shaft.places[-1] - shaft.places[0])
    speed = length / np.sqrt(yields * weight)
    if not _SLOWEST < speed < _FASTEST:
        raise InputError(
            f"{body.source}: by its mass of {weight:.3g} kg and its stiffness along x, sound runs "
            f"along it at {speed:.2g} m/s, but in steel at 5000 m/s; check shaft.body_units "
            f"('{shaft.spec.body_units}').",
            where="shaft.body_units", value=speed,
        )  # fmt: skip


def _not_round(body: ReducedBody, how: str) -> InputError:
    return InputError(
        f"{body.source}: the shaft is not round: {how}; a machine's shaft is rotationally "
        "symmetric about x, keyways and flats left out.",
        where=WHERE,
    )
