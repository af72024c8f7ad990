"""A bearing on its place in the machine: its elements, how its outer ring is held, and the frame in
which it sees the shaft."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
import scipy.linalg as la

from flexcage.bearings import statics_of
from flexcage.contacts.spec import Contacts
from flexcage.core.errors import FlexcageError, InputError
from flexcage.geometry.bearing import Bearing
from flexcage.machine.housing import SCALES, HousingSeats, turned
from flexcage.machine.machine import SeatedBearing
from flexcage.system.spec import Load
from flexcage.system.statics.elements import Elements
from flexcage.system.statics.equilibrium import Posture, Problem, posture_at, tangent
from flexcage.system.statics.options import StaticOptions
from flexcage.system.statics.solve import solve_bearing
from flexcage.system.statics.yielding import compliance_of

_HELD = 1e-9  # of a seat's largest compliance: below, it holds


@dataclass(frozen=True, eq=False)
class OuterRing:
    """How an outer ring may move: o = ``ways`` (5, m) p, under a ``stiffness`` (m, m) and a
    ``push`` (m,) of springs, in the bearing's own axes."""

    ways: np.ndarray
    stiffness: np.ndarray
    push: np.ndarray


@dataclass(frozen=True, eq=False)
class Seated:
    """A bearing of the machine at the dofs (5,) ``at`` of the shaft. Its elements feel
    r = mirror u + offset - o, u the shaft's displacement there and o the outer ring's."""

    spec: SeatedBearing
    bearing: Bearing
    at: np.ndarray
    problem: Problem
    offset: float
    outer: OuterRing

    @property
    def elements(self) -> Elements:
        return self.problem.elements

    @property
    def mirror(self) -> np.ndarray:
        return self.spec.place.mirror

    def relative(self, shaft: np.ndarray, outer: np.ndarray) -> np.ndarray:
        """r (5,) from the shaft's vector (5 n,) and the outer ring's coordinates (m,)."""
        found = self.mirror * shaft[self.at] - self.outer.ways @ outer
        found[0] += self.offset
        return found

    def press(self, r: np.ndarray, near: Posture | None, share: float) -> Posture:
        """Elements at r (5,); the energy is that of the elements alone."""
        found = posture_at(self.problem, r, near, share)
        return replace(found, energy=found.energy + float(self.problem.load @ r))

    def tangent(self, posture: Posture) -> np.ndarray:
        """Slopes (5, 5) of what the elements bear over r."""
        return tangent(self.problem, posture)

    def in_series(self, tangent: np.ndarray) -> np.ndarray:
        """Slopes (5, 5) over the shaft's displacement, the outer ring following, in the bearing's
        own axes."""
        ways = self.outer.ways
        if not ways.shape[1]:
            return tangent
        yields = self.outer.stiffness + ways.T @ tangent @ ways
        return tangent - tangent @ ways @ np.linalg.pinv(yields, rcond=1e-14) @ ways.T @ tangent


def seat(spec: SeatedBearing, at: np.ndarray, size: float) -> Seated:
    """A bearing in its place; ``size`` [N] is the magnitude of the machine's loads."""
    case = spec.case.mounted
    bearing = case.bearing
    elements = statics_of(bearing)(
        bearing, speed=case.speed, contacts=case.contacts, options=case.static
    )
    size = max(size, 1e-4 * bearing.static_rating)
    problem = Problem(
        elements, load=np.array([size, 0.0, 0.0, 0.0, 0.0]), free=np.ones(5, bool),
        held=np.zeros(5), spring=np.zeros(5),
    )  # fmt: skip
    return Seated(spec, bearing, at, problem, _offset(spec), _outer_ring(spec))


def _offset(spec: SeatedBearing) -> float:
    """By how much [m] the inner ring is pressed in: as given, of a force, by fits and warmth."""
    place, case = spec.place, spec.case
    offset = place.axial_offset
    if place.preload_force:
        offset = _approach(spec, place.preload_force)
    return offset + ((case.mounting.approach or 0.0) if case.mounting else 0.0)


def _approach(spec: SeatedBearing, force: float) -> float:
    """Axial displacement [m] of the bearing alone, unmounted and at rest, under a force [N]."""
    bearing = spec.case.bearing
    try:
        alone = solve_bearing(
            bearing, statics_of(bearing), load=Load(axial=force), contacts=Contacts(),
            options=StaticOptions(tilt="held"),
        )  # fmt: skip
    except FlexcageError as exc:
        raise InputError(
            f"bearings.{spec.place.name}.preload_force is {force:g} N, but {exc}",
            where=f"bearings.{spec.place.name}.preload_force",
        ) from exc
    return float(alone.displacement[0])


def in_housing(
    seats: HousingSeats | None, bearings: Sequence[Seated]
) -> tuple[list[Seated], np.ndarray]:
    """The bearings, those without a seat of their own in the machine's housing if it has one, and
    the stiffness (P, P) of all seats over the coordinates p of all outer rings."""
    own = [b.outer.stiffness for b in bearings]
    if seats is None:
        return list(bearings), la.block_diag(*own)
    moved = list(bearings)
    for n, k in enumerate(seats.there):
        b, slides = bearings[k], seats.slides[n]
        push = np.array([b.spec.place.spring_force if slides else 0.0, 0.0, 0.0, 0.0, 0.0])
        moved[k] = replace(b, outer=OuterRing(np.eye(5), seats.alone(n), push))
    counts = [m.outer.ways.shape[1] for m in moved]
    return moved, _placed(counts, own, seats.there, seats.stiffness)


def _placed(
    counts: Sequence[int], own: Sequence[np.ndarray], there: Sequence[int], whole: np.ndarray
) -> np.ndarray:
    """Stiffness of all seats: ``whole`` of those in the housing, ``own`` of the others."""
    ends = np.cumsum([0, *counts])
    found = np.zeros((ends[-1], ends[-1]))
    for k, stiffness in enumerate(own):
        if k not in there:
            found[ends[k] : ends[k + 1], ends[k] : ends[k + 1]] = stiffness
    rows = np.concatenate([np.arange(ends[k], ends[k + 1]) for k in there])
    found[np.ix_(rows, rows)] = whole
    return found


def _outer_ring(spec: SeatedBearing) -> OuterRing:
    """What the seat in the housing leaves to the outer ring."""
    place, case = spec.place, spec.case
    compliance = compliance_of(case.mount, case.bearing)
    whole = np.zeros((5, 5)) if compliance is None else compliance
    floats = place.floats
    # a body is written in the machine's axes
    whole = turned(whole, place.mirror if case.mount.body else np.ones(5), floats=floats)
    value, vector = np.linalg.eigh(_scaled(whole))
    soft = value > _HELD * max(float(value.max()), 1e-300)
    ways = SCALES[:, None] * vector[:, soft]
    # o = ways p, p's compliance is diagonal
    stiffness = np.diag(1.0 / value[soft])
    if floats:
        ways = np.column_stack([ways, np.eye(5)[0]])
        stiffness = np.pad(stiffness, (0, 1))
        stiffness[-1, -1] = place.spring_stiffness
    push = np.zeros(ways.shape[1])
    if floats:
        push[-1] = place.spring_force
    return OuterRing(ways, stiffness, push)


def _scaled(compliance: np.ndarray) -> np.ndarray:
    return compliance / np.outer(SCALES, SCALES)
