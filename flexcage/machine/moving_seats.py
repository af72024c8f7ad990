"""How the outer rings of a turning machine are held, each in the frame of its bearing's run: in one
housing, in housings of their own, and before springs along which they slide."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from flexcage.machine.housing import turned
from flexcage.machine.machine import Machine, SeatedBearing
from flexcage.machine.motion import FROM_MIRROR, slides, starting_point
from flexcage.machine.solution import MachineSolution
from flexcage.system.begun import Start
from flexcage.system.bodies import YIELDS
from flexcage.system.problem import BearingSystem
from flexcage.system.rings.low_modes import DAMPED
from flexcage.system.shaft.housing import HousingData, housing_data
from flexcage.system.shaft.problem import OTHER_WAY, let_slide
from flexcage.system.statics.yielding import compliance_of


@dataclass(frozen=True, eq=False)
class MovingSeats:
    """The seats of a machine's outer rings, which begin where the static ``solution`` has them."""

    machine: Machine
    solution: MachineSolution

    @cached_property
    def _between(self) -> np.ndarray | None:
        """Stiffness (b, b, 5, 5) that the housing has between all bearings, zero for those that sit
        elsewhere, and along x for rings that slide; None if there is no housing."""
        seats = self.solution.housing
        if seats is None:
            return None
        many, sit = len(self.machine.bearings), list(seats.there)
        turned = np.concatenate([_mirror(self.machine.bearings[k]) for k in sit])
        whole = np.outer(turned, turned) * seats.stiffness
        found = np.zeros((many, many, 5, 5))
        blocks = whole.reshape(len(sit), 5, len(sit), 5).transpose(0, 2, 1, 3)
        found[np.ix_(sit, sit)] = blocks
        for k in sit:
            if self.machine.bearings[k].place.floats:  # its spring is the ring's own
                found[k, k, 0, 0] = 0.0
        return found

    @cached_property
    def _places(self) -> np.ndarray:
        """Where (b, 5) the outer rings stand in the static solution."""
        return np.array([starting_point(own).outer for own in self.solution.bearings])

    def compliance(self, k: int) -> np.ndarray | None:
        """Of bearing k's seat (5, 5) while the other rings stand, zero where it is held or slides;
        None: as its case's mount says."""
        seated = self.machine.bearings[k]
        own = np.zeros((5, 5)) if self._between is None else self._between[k, k]
        if own.any():
            return _inverse(own)
        mount = seated.case.mount
        if not mount.body or not (seated.place.reversed or seated.place.floats):
            return None
        found = compliance_of(mount, seated.case.bearing)
        assert found is not None  # of a body
        signs = OTHER_WAY if seated.place.reversed else np.ones(5)  # of the machine's axes
        return turned(found, signs, floats=seated.place.floats)

    def begin(self, k: int, bearing: BearingSystem) -> None:
        """Before its start is sought: let the springs of bearing k's seat rest where the other
        rings of its housing leave it; along x the start is moved there afterwards."""
        if self._between is None:
            return
        pushed = np.einsum("cij,cj->i", self._others(k), self._places)
        bearing.data.model.outer_ring.rest[YIELDS] = -_inverse(self._between[k, k]) @ pushed
        bearing.data.model.outer_ring.rest[0] = 0.0

    def _others(self, k: int) -> np.ndarray:
        assert self._between is not None
        return self._between[k] * (np.arange(len(self._between)) != k)[:, None, None]

    def release(self, k: int, bearing: BearingSystem) -> None:
        """Once the start is found: bearing k's outer ring feels the other rings as they move, and
        slides if it is to."""
        if self._between is not None:
            bearing.data.model.outer_ring.rest[:] = 0.0
        seated = self.machine.bearings[k]
        if slides(seated):
            place, at = seated.place, float(self._places[k, 0])
            force = place.spring_force + place.spring_stiffness * at
            let_slide(bearing, force=force, stiffness=place.spring_stiffness, place=at)

    def moved(self, k: int, bearing: BearingSystem, start: Start) -> Start:
        """The start with a bearing whose ring slides, or sits in the housing, where the static
        solution has it along x."""
        if self._between is None and not slides(self.machine.bearings[k]):
            return start
        y = start.y.copy()
        q = bearing.layout.q(y)
        way = self._places[k, 0] - q["outer"][0]
        for name in ("inner", "outer", "cage"):
            if name in q:
                q[name][0] += way
        q["elements"][:, 0] += way
        return replace(start, y=y)

    def housing(self, bearings: Sequence[BearingSystem]) -> HousingData | None:
        """What the kernels know of the housing; None if there is none."""
        if self._between is None:
            return None
        late = [DAMPED * b.case.outer_ring.relaxation for b in self.machine.bearings]
        return housing_data(bearings, self._between, late)


def _mirror(seated: SeatedBearing) -> np.ndarray:
    """Signs (5,) from a bearing's own axes of the static solution to those of its run."""
    return FROM_MIRROR if seated.place.reversed else np.ones(5)


def _inverse(matrix: np.ndarray) -> np.ndarray:
    """Inverse (5, 5) of a symmetric matrix over the rows that are not zero; there it is zero."""
    own, found = np.flatnonzero(np.diag(matrix)), np.zeros((5, 5))
    found[np.ix_(own, own)] = np.linalg.inv(matrix[np.ix_(own, own)])
    return found
