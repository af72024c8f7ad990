"""The seats of a machine's one housing: how they yield together."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from flexcage.core.errors import InputError
from flexcage.machine.machine import Machine

#: Displacements (5,) that are of a kind: turns over an arm of 50 mm.
SCALES = np.array([1.0, 1.0, 1.0, 20.0, 20.0])


@dataclass(frozen=True, eq=False)
class HousingSeats:
    """The seats of n bearings in one housing, each in its bearing's own axes."""

    there: tuple[int, ...]  # numbers of the bearings
    slides: tuple[bool, ...]  # which of their outer rings slide along x
    springs: np.ndarray  # (n,) stiffness of springs before those
    compliance: np.ndarray  # (5 n, 5 n)

    @property
    def stiffness(self) -> np.ndarray:
        """(5 n, 5 n) over the motions of all rings; of one that slides, its spring's along x."""
        held = ~np.array([slide and way == 0 for slide in self.slides for way in range(5)])
        scales = np.outer(*2 * [np.tile(SCALES, len(self.there))[held]])
        whole = np.zeros((len(held), len(held)))
        whole[np.ix_(held, held)] = (
            np.linalg.inv(self.compliance[np.ix_(held, held)] / scales) / scales
        )
        whole[~held, ~held] = self.springs[list(self.slides)]
        return whole

    def alone(self, n: int) -> np.ndarray:
        """Stiffness (5, 5) of one seat, with no force on the others."""
        found, slides = np.zeros((5, 5)), self.slides[n]
        kept, own = slice(1 if slides else 0, 5), slice(5 * n, 5 * n + 5)
        found[kept, kept] = np.linalg.inv(self.compliance[own, own][kept, kept])
        if slides:
            found[0, 0] = self.springs[n]
        return found


def turned(compliance: np.ndarray, signs: np.ndarray, *, floats: bool) -> np.ndarray:
    """Compliance (5, 5) of a seat in axes to which motions turn by ``signs`` (5,); none along x
    for a ring that ``floats``."""
    found = np.outer(signs, signs) * compliance
    if floats:
        found[0, :] = found[:, 0] = 0.0
    return found


def housing_seats(machine: Machine) -> HousingSeats | None:
    """Those of the bearings without a seat of their own in the machine's housing; None if it has no
    housing. InputError if they are none, or have no nodes in it."""
    housing = machine.housing
    if not housing.body:
        return None
    from flexcage.system.seat import seats_compliance  # with readers of files, which few need

    mounts = [b.case.mount for b in machine.bearings]
    there = tuple(k for k, m in enumerate(mounts) if not m.body and m.kind == "fixed")
    if not there:
        raise InputError(
            "housing.body is given, but every bearing has a [bearings.mount] of its own; leave one "
            "of both out.",
            where="housing.body",
        )
    sit = [machine.bearings[k] for k in there]
    places = [
        (b.place.position, b.case.bearing.outside_diameter, b.case.bearing.width) for b in sit
    ]
    signs = np.concatenate([b.place.mirror for b in sit])
    found = seats_compliance(housing, places, tie=housing.seat_tie, where="housing.body")
    return HousingSeats(
        there, tuple(b.place.floats for b in sit),
        np.array([b.place.spring_stiffness for b in sit]), np.outer(signs, signs) * found,
    )  # fmt: skip
