"""Rings that bend, between their seats and the rolling elements, in the static solution.

Each ring is a compliance between its elements (``modes.ring``), for supports here and there with
the supports' forces solved for. Supports that only press let go where they would pull, one set of
them after the other. Forces on the outer race are those on the inner one and the elements'
centrifugal forces.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, field, replace
from functools import cached_property
from math import ceil
from typing import Any

import numpy as np
from scipy.optimize import nnls

from flexcage.core.errors import InputError, RunFailed
from flexcage.core.units import mm
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.ring import (
    FlexibleRing,
    InnerRing,
    OuterRing,
    RingSection,
    SectionsOf,
)
from flexcage.modes.ring import RingReduction, RingSeat, reduce_ring, spectrum, strip
from flexcage.system.statics.elements import ElementLoads
from flexcage.system.statics.equilibrium import Bending, Posture, Problem, balance

_SETS = 60  # of supports that are tried
_STRIPS, _A_WALL = 8, 1.5  # of an arc, and for every thickness of the wall in its length
_PULL = 1e-9  # of the largest force of a support: what counts as none
_HEAVY, _MISSED = 1e4, 1e-3  # weight of the balance beside compliance; what of it may be missed
_LEAST_WALL = 0.01  # of the race's radius: thinner rings want thousands of harmonics
_CHANGE = 1e-8  # of the load: by which centrifugal forces may change from step to step
TO_V = {  # how a ring's ports are displacements v: axial, radial, tilt
    False: np.array([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]),
    True: np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]),
}


@dataclass(frozen=True)
class Rings:
    """What is asked of both rings, and their sections, which the bearing's family supplies.

    ``heavier``: how many times the load that is balanced is the one after whose contacts races are
    pressed, the heaviest of a run.
    """

    inner: InnerRing = InnerRing()
    outer: OuterRing = OuterRing()
    sections: SectionsOf | None = None
    heavier: float = 1.0

    @property
    def bend(self) -> bool:
        return self.inner.bends or self.outer.bends

    def sections_of(self, bearing: Bearing, loads: ElementLoads) -> tuple[RingSection, RingSection]:
        """Sections of both rings, pressed where and how contacts under ``loads`` do."""
        if self.sections is None:
            raise InputError(
                f"rings of a {bearing.kind} do not bend: its family '{bearing.family}' gives no "
                "sections of its rings; leave out inner_ring.ring and outer_ring.ring",
                where="outer_ring.ring" if self.outer.bends else "inner_ring.ring",
            )
        default = bearing.bore, bearing.outside_diameter
        seat = tuple(float(s.diameter or d) for s, d in zip((self.inner, self.outer), default))
        angle, across = zip(*(_pressed(loads, k, self.heavier) for k in range(2)))
        return self.sections(bearing, angle=angle, across=across, seat=seat)  # type: ignore[arg-type]


@dataclass(frozen=True, eq=False)
class SeatedRing:
    """One ring on its seat: compliances between races at ``azimuth`` (Z,) and supports.

    A support that presses over an arc is a row of strips, each with a force of its own: the middles
    ``support`` (S,), ``width`` (S,) [rad], and ``of_support`` (S,), the number of the support.
    """

    side: str
    reduction: RingReduction
    azimuth: np.ndarray
    support: np.ndarray = field(default_factory=lambda: np.empty(0))
    width: np.ndarray = field(default_factory=lambda: np.empty(0))
    of_support: np.ndarray = field(default_factory=lambda: np.empty(0, int))
    presses_only: bool = False

    @property
    def _ports(self) -> int:
        return 2 * len(self.azimuth)

    @cached_property
    def race(self) -> np.ndarray:
        """Compliance (2 Z, 2 Z) between elements, supports left out."""
        difference = self.azimuth[:, None] - self.azimuth
        whole = self.reduction.between(difference)
        own = np.arange(len(self.azimuth))
        whole[:, :, own, own] = self.reduction.local[:, :, None]
        return whole.transpose(2, 0, 3, 1).reshape(self._ports, self._ports)

    @cached_property
    def bordered(self) -> tuple[np.ndarray, np.ndarray]:
        """Matrix (S + 2, S + 2) of supports' forces and translation along y and z, and how both
        displace the race (2 Z, S + 2)."""
        r, n = self.reduction, self.reduction.harmonics
        on_seat, on_race = strip(n[:, None], self.width), spectrum(n, r.along)
        c, count = r.compliance, len(self.support)
        across = np.cos(np.multiply.outer(n, self.azimuth[:, None] - self.support))
        whole = np.zeros((count + 2, count + 2))
        whole[:count, :count] = r.between_supports(self.support, self.width, c[:, 2, 2])
        whole[:count, count:] = r.rigid[2] * _radial(self.support)
        whole[count:, :count] = whole[:count, count:].T
        cross = np.empty((len(self.azimuth), 2, count + 2))
        cross[..., :count] = np.einsum(
            "ns,n,ni,nzs->zis", on_seat, on_race, c[:, :2, 2], across, optimize=True
        )
        moved = np.multiply.outer(_radial(self.azimuth), r.rigid[:2] * on_race[1])
        cross[..., count:] = moved.transpose(0, 2, 1)
        return whole, cross.reshape(self._ports, count + 2)

    def compliance(self, bears: np.ndarray) -> np.ndarray:
        """Compliance (2 Z, 2 Z) between elements where supports ``bears`` (S,) hold the ring."""
        if not len(self.support):
            return self.race
        whole, cross = self._kept(bears)
        return self.race - cross @ np.linalg.solve(whole, cross.T)

    def supported(self, force: np.ndarray, bears: np.ndarray) -> np.ndarray:
        """Radial forces (S,) with which supports press on the ring, inwards, under forces (Z, 2) on
        its race."""
        press = np.zeros(len(bears))
        press[bears] = -self._answer(force, bears)[:-2]
        return press

    def translation(self, force: np.ndarray, bears: np.ndarray) -> np.ndarray:
        """Displacement (2,) along y and z of the ring as a whole, under the same."""
        return self._answer(force, bears)[-2:]

    def _answer(self, force: np.ndarray, bears: np.ndarray) -> np.ndarray:
        """Forces of the supports that bear, and the ring's translation."""
        whole, cross = self._kept(bears)
        return -np.linalg.solve(whole, cross.T @ force.ravel())

    def _kept(self, bears: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        keep = np.append(bears, [True, True])
        whole, cross = self.bordered
        if np.linalg.matrix_rank(_radial(self.support[bears]), tol=1e-6) < 2:
            raise self.flies()
        return whole[np.ix_(keep, keep)], cross[:, keep]

    def flies(self) -> InputError:
        """The error of a ring whose supports do not hold it."""
        return InputError(
            f"the supports of the {self.side} ring that still bear leave it free to move "
            "across the axis; give supports on both sides of the load (outer_ring.supports)",
            where=f"{self.side}_ring.supports",
        )

    @property
    def to_v(self) -> np.ndarray:
        """Displacements v (3, 2) of the two ports of an element."""
        return TO_V[self.reduction.raceway.line]

    @property
    def felt(self) -> np.ndarray:
        """How v (3, 2), which is that of the section's place on the bearing's axis, changes with
        the ports: a section that tilts about its race is displaced there along the axis. Ribs feel
        that, and the moment of a force on them about the race is small."""
        felt = self.to_v.copy()
        if self.reduction.raceway.line:
            felt[0, 1] = self.reduction.raceway.place[1]
        return felt


@dataclass(frozen=True, eq=False)
class BentRing:
    """A ring in equilibrium.

    ``force`` (Z, 2): of elements on the ports of the race (axial and radial, or radial and moment);
    ``deflection`` (Z, 3): of the race from where the seat has it, axially, radially [m], in tilt
    [rad]; without what the contact law counts. ``support_force`` (S,) [N] presses on the ring.
    """

    seated: SeatedRing
    force: np.ndarray
    deflection: np.ndarray
    support_force: np.ndarray
    bears: np.ndarray  # (S,) bool

    @property
    def side(self) -> str:
        return self.seated.side

    @property
    def azimuth(self) -> np.ndarray:
        """Azimuths (Z,) [rad] of the elements."""
        return self.seated.azimuth

    def figures(self) -> dict[str, Any]:
        """Plain values: deflections of the race at the elements, and what supports bear."""
        found = {
            "harmonics": len(self.seated.reduction.compliance) - 1,
            "deflection": self.deflection,
        }
        if len(self.bears):
            found.update(support=self.seated.support, support_force=self.support_force)
        return found


@dataclass(frozen=True, eq=False)
class BendingRings:
    """Both rings beside the elements, with the supports that bear, for one step of the search."""

    rings: tuple[SeatedRing, ...]
    bears: tuple[np.ndarray, ...]

    def bending(self, thrown: np.ndarray) -> Bending:
        """How races yield; ``thrown`` (Z,): the elements' centrifugal forces [N]."""
        count = len(thrown)
        total, offset = np.zeros((3 * count, 3 * count)), np.zeros((count, 3))
        for ring, bears in zip(self.rings, self.bears):
            own, felt = ring.compliance(bears), ring.felt
            blocks = own.reshape(count, 2, count, 2)
            whole = np.einsum("ai,yizj,bj->yazb", felt, blocks, felt).reshape(3 * count, 3 * count)
            total += whole
            if ring.side == "outer":
                offset += (whole @ _outwards(thrown).ravel()).reshape(count, 3)
        return Bending(0.5 * (total + total.T), offset)

    def bent(self, force: np.ndarray, thrown: np.ndarray) -> tuple[BentRing, ...]:
        """The rings under forces (Z, 3) that the inner ring exerts along v."""
        found = []
        for ring, bears in zip(self.rings, self.bears):
            on_race = (force + _outwards(thrown) if ring.side == "outer" else -force) @ ring.felt
            yields = ring.compliance(bears) @ on_race.ravel()
            pressed = np.empty(0)
            if len(bears):
                pressed = ring.supported(on_race, bears)
            found.append(
                BentRing(ring, on_race, yields.reshape(-1, 2) @ ring.to_v.T, pressed, bears)
            )
        return tuple(found)

    def next(self, bent: tuple[BentRing, ...]) -> BendingRings | None:
        """With the supports that bear under these forces; None if they are as they are."""
        sets = tuple(_that_bear(ring.seated, ring.force, ring.bears) for ring in bent)
        if all(np.array_equal(a, b) for a, b in zip(sets, self.bears)):
            return None
        return BendingRings(self.rings, sets)


def balance_with_rings(
    problem: Problem, bearing: Bearing, rings: Rings, find: Callable[[Problem], Posture] = balance
) -> tuple[Problem, Posture, tuple[BentRing, ...]]:
    """Equilibrium between rings that bend: the problem with them, its posture, and the rings.

    ``find`` balances a problem. Raises InputError and RunFailed as it does, and where supports
    cannot hold the ring.
    """
    elements = problem.elements
    posture = find(problem)
    loads = elements.loads(posture.v, posture.own)
    seated = seated_rings(bearing, rings, elements.azimuth, loads)
    thrown = np.nan_to_num(loads.centrifugal)
    for _ in range(_SETS):
        problem = replace(problem, bending=seated.bending(thrown))
        posture = find(problem)
        bent = seated.bent(posture.response.ring, thrown)
        now = np.nan_to_num(elements.loads(posture.v, posture.own).centrifugal)
        after = seated.next(bent)
        if after is None and np.abs(now - thrown).max() <= _CHANGE * problem.size:
            return problem, posture, bent
        seated, thrown = after or seated, now
    raise _no_supports()


def seated_rings(
    bearing: Bearing, rings: Rings, azimuth: np.ndarray, loads: ElementLoads
) -> BendingRings:
    """The rings that bend, with all supports bearing; ``loads``: of elements between rigid rings,
    whose contact angles and ellipses say where and how rings are pressed."""
    sides: tuple[FlexibleRing, FlexibleRing] = rings.inner, rings.outer
    sections = rings.sections_of(bearing, loads)
    made = []
    for name, spec, section in zip(("inner", "outer"), sides, sections):
        if spec.bends:
            _check_wall(name, spec, section)
            made.append(_seated(name, spec, section, bearing.material, azimuth))
    return BendingRings(tuple(made), tuple(np.ones(len(r.support), bool) for r in made))


def _pressed(loads: ElementLoads, side: int, heavier: float) -> tuple[float, float]:
    """Contact angle [rad] at a race, weighted with forces, and half of the heaviest contact's
    extent [m] under forces so many times larger, by Hertz."""
    force = loads.force[:, side]
    angle = np.nan_to_num(loads.angle[:, side])
    across = float(loads.across[force.argmax(), side])
    return float(force @ angle / force.sum()), across * heavier ** (1.0 / 3.0)


def _seated(
    name: str, spec: FlexibleRing, section: RingSection, material: Any, azimuth: np.ndarray
) -> SeatedRing:
    held = RingSeat(
        rigidly=spec.seat == "rigid",
        foundation=spec.foundation if spec.seat == "foundation" else 0.0,
    )
    supports, arc = spec.held_at, spec.held_over
    reduction = reduce_ring(section, spec.material or material, held, supports=len(supports))
    if not supports:
        return SeatedRing(name, reduction, azimuth)
    presses_only = spec.seat == "arcs"
    edges = (
        0.5 * arc * _strips(arc * section.raceway.place[1] / section.wall if presses_only else 0.0)
    )
    middles, count = 0.5 * (edges[1:] + edges[:-1]), len(supports)
    return SeatedRing(
        name, reduction, azimuth,
        support=np.add.outer(np.array(supports), middles).ravel(),
        width=np.tile(np.diff(edges), count), of_support=np.repeat(range(count), len(middles)),
        presses_only=presses_only,
    )  # fmt: skip


def _strips(walls: float) -> np.ndarray:
    """Edges, from -1 to 1, of the strips of an arc so many ``walls`` of the ring long; one of a
    support that pivots. They are narrow at the arc's ends, where a ring bears that lifts off."""
    count = max(_STRIPS, ceil(walls * _A_WALL)) if walls else 1
    return -np.cos(np.pi * np.arange(count + 1) / count)


def _check_wall(name: str, spec: FlexibleRing, section: RingSection) -> None:
    least = _LEAST_WALL * section.raceway.place[1]
    if section.wall < least:
        what = "outside_diameter" if name == "outer" else "bore"
        of = f"{name}_ring.diameter" if spec.diameter is not None else f"bearing.{what}"
        raise InputError(
            f"{of} leaves the {name} ring a wall of {mm(section.wall)} behind its race; give one "
            f"that leaves {mm(least)} or more.",
            where=of,
        )


def _that_bear(ring: SeatedRing, force: np.ndarray, bears: np.ndarray) -> np.ndarray:
    """The supports (S,) that bear under forces (Z, 2) on the race: none pulls, none is entered.

    Their forces p >= 0 have the least energy p D p/2 - p B f among those that balance the race's,
    which least squares with a heavy weight on the balance find (C. L. Lawson and R. J. Hanson,
    Solving Least Squares Problems, chapter 23).
    """
    if not ring.presses_only:
        return bears
    whole, cross = ring.bordered
    count, driven = len(bears), cross.T @ force.ravel()
    root = np.linalg.cholesky(whole[:count, :count])
    balance = whole[count:, :count]
    heavy = _HEAVY * np.linalg.norm(root) / np.linalg.norm(balance)
    given = np.append(np.linalg.solve(root, driven[:count]), heavy * driven[count:])
    press, _ = nnls(np.vstack([root.T, heavy * balance]), given)
    if np.abs(balance @ press - driven[count:]).max() > _MISSED * np.abs(driven[count:]).max():
        raise ring.flies()
    return press > _PULL * press.max()


def _no_supports() -> RunFailed:
    return RunFailed(
        f"no set of supports of the outer ring was found in {_SETS} attempts of which none pulls "
        "and none is entered; give wider supports, or outer_ring.seat = 'points'"
    )


def _radial(azimuth: np.ndarray) -> np.ndarray:
    """Radial parts (n, 2) of a unit displacement along y and along z."""
    return np.stack([np.cos(azimuth), np.sin(azimuth)], axis=-1)


def _outwards(thrown: np.ndarray) -> np.ndarray:
    """Forces (Z, 3) along v of what is thrown outwards."""
    return np.stack([0.0 * thrown, thrown, 0.0 * thrown], axis=1)
