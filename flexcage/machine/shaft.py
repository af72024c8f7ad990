"""The shaft as nodes and beams: matrices, what acts on it, and what its sections bear."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from math import ceil

import numpy as np

from flexcage.machine.beams import DOFS, Beam
from flexcage.machine.spec import Gravity, Shaft, ShaftSection

_SAME = 1e-9  # m: places closer together are one node


@dataclass(frozen=True, eq=False)
class ShaftModel:
    """A shaft with nodes at ``places`` (n,) [m] and a beam between neighbours; no beams if it is
    rigid without sections.

    Vectors (5 n,) are x, y, z and turns about y, z of node after node. Its matrices are those of
    its c coordinates, of which these are the first; beams have no others. ``motions`` (5 n, m) are
    those that it can make, all of them or the five of a rigid body, and ``made`` (c, m) their
    coordinates.
    """

    spec: Shaft
    places: np.ndarray
    beams: tuple[Beam, ...]

    @property
    def rigid(self) -> bool:
        return self.spec.kind == "rigid"

    @property
    def ends(self) -> tuple[float, float]:
        """Its first and its last place [m]."""
        return float(self.places[0]), float(self.places[-1])

    @property
    def reach(self) -> tuple[float, float]:
        """From where to where [m] it is, by its length and its places."""
        left, right = self.ends
        return min(left, 0.0), max(right, self.spec.whole_length)

    def node(self, position: float) -> int:
        """The node at a place [m] where one was made."""
        return int(np.argmin(np.abs(self.places - position)))

    def dofs(self, position: float) -> np.ndarray:
        """Rows (5,) of the node at a place."""
        return DOFS * self.node(position) + np.arange(DOFS)

    @cached_property
    def motions(self) -> np.ndarray:
        return self.rigid_about(0.0) if self.rigid else np.eye(DOFS * len(self.places))

    @property
    def made(self) -> np.ndarray:
        """Coordinates (c, m) of the motions."""
        return self.motions

    def rigid_about(self, centre: float) -> np.ndarray:
        """Coordinates (c, 5) of a rigid shaft that moves with, and turns about, a place [m]."""
        found = np.tile(np.eye(DOFS), (len(self.places), 1))
        found[1::DOFS, 4] = self.places - centre  # a turn about z lifts y
        found[2::DOFS, 3] = centre - self.places
        return found

    @cached_property
    def _own(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        size = DOFS * len(self.places)
        whole = np.zeros((3, size, size))
        for k, beam in enumerate(self.beams):
            own = slice(DOFS * k, DOFS * (k + 2))
            for matrix, part in zip(whole, beam.matrices()):
                matrix[own, own] += part
        return whole[0], whole[1], whole[2]

    @cached_property
    def stiffness(self) -> np.ndarray:
        """(c, c); zero of a rigid shaft."""
        return 0.0 * self._own[0] if self.rigid else self._own[0]

    @cached_property
    def mass(self) -> np.ndarray:
        """(c, c), with discs."""
        found = self._own[1].copy()
        for disc in self.spec.discs:
            mass, _, diametral = disc.inertia
            own = self.dofs(disc.position)
            found[own, own] += [mass, mass, mass, diametral, diametral]
        return found

    @cached_property
    def gyroscopic(self) -> np.ndarray:
        """(c, c) for 1 rad/s, with discs."""
        found = self._own[2].copy()
        for disc in self.spec.discs:
            y, z = self.dofs(disc.position)[3:]
            found[y, z] += disc.inertia[1]
            found[z, y] -= disc.inertia[1]
        return found

    def load(self, gravity: Gravity) -> np.ndarray:
        """Generalised forces (c,) of loads and weight."""
        pull = gravity.vector
        found = np.zeros(DOFS * len(self.places))
        for k, beam in enumerate(self.beams):
            found[DOFS * k : DOFS * (k + 2)] += beam.weight(pull)
        return found + self.point_loads(gravity)

    def point_loads(self, gravity: Gravity) -> np.ndarray:
        """Forces and moments (5 n,) at nodes, without the weight of the sections."""
        found = np.zeros(DOFS * len(self.places))
        for disc in self.spec.discs:
            found[self.dofs(disc.position)[:3]] += disc.inertia[0] * gravity.vector
        for load in self.spec.loads:
            found[self.dofs(load.position)] += load.vector
        return found

    def by_node(self, gravity: Gravity) -> np.ndarray:
        """Forces and moments (k, 5) of loads and weight, of node after node, to tell their size."""
        return self.load(gravity).reshape(-1, DOFS)

    def node_weights(self, gravity: Gravity) -> np.ndarray:
        """Weight (5 n,) that acts at nodes, beside that of beams and discs."""
        return np.zeros(DOFS * len(self.places))

    def own_compliance(self, position: float) -> np.ndarray:
        """Compliance (5, 5) at a place [m] with all nodes held: of the beam there between its
        ends; zero at nodes, and of a rigid shaft."""
        k = int(np.clip(np.searchsorted(self.places, position) - 1, 0, len(self.places) - 2))
        parts = position - self.places[k], self.places[k + 1] - position
        if self.rigid or min(parts) < _SAME:
            return np.zeros((DOFS, DOFS))
        left, right = (replace(self.beams[k], length=L).matrices()[0] for L in parts)
        found: np.ndarray = np.linalg.inv(left[DOFS:, DOFS:] + right[:DOFS, :DOFS])
        return found

    def at(self, position: float) -> np.ndarray:
        """Displacement (5, 5 n) at any place [m] from the nodes' displacements."""
        k = int(np.clip(np.searchsorted(self.places, position) - 1, 0, len(self.places) - 2))
        share = (position - self.places[k]) / (self.places[k + 1] - self.places[k])
        found = np.zeros((DOFS, DOFS * len(self.places)))
        own = DOFS * k + np.arange(2 * DOFS)
        if self.beams:
            moved, turned, *_ = self.beams[k].shapes(np.array([share]))
            turn = np.array([1.0, -1.0, 1.0, -1.0])
            found[1, own[[1, 4, 6, 9]]], found[4, own[[1, 4, 6, 9]]] = moved[0], turned[0]
            found[2, own[[2, 3, 7, 8]]] = turn * moved[0]
            found[3, own[[2, 3, 7, 8]]] = -turn * turned[0]
            found[0, own[[0, 5]]] = 1.0 - share, share
            return found
        near = np.zeros((DOFS, DOFS))  # of a rigid body, from the node to the left
        near[1, 4] = position - self.places[k]
        near[2, 3] = -near[1, 4]
        found[:, own[:DOFS]] = np.eye(DOFS) + near
        return found

    def borne(self, reactions: np.ndarray, gravity: Gravity) -> SectionForces:
        """What sections bear under the point forces (5 n,) of bearings, loads and discs, and the
        weight of the beams."""
        given = self.point_loads(gravity) + self.node_weights(gravity)
        force = (reactions + given).reshape(-1, DOFS)
        pull, left, found = gravity.vector, np.zeros(DOFS), []
        for k, place in enumerate(self.places):
            if k:
                arm = place - self.places[k - 1]
                weight = (
                    self.beams[k - 1].mass_per_length * arm * pull if self.beams else 0.0 * pull
                )
                left = _moved(left, arm) + _moved(np.array([*weight, 0.0, 0.0]), 0.5 * arm)
                found.append((place, *(-left)))
            left = left + force[k]
            if k + 1 < len(self.places):
                found.append((place, *(-left)))
        table = np.array(found)
        return SectionForces(table[:, 0], table[:, 1:], self._stresses(table[:, 1:]))

    def _stresses(self, borne: np.ndarray) -> np.ndarray:
        """Largest normal stress (2 e,) [Pa] at both ends of every beam."""
        if not self.beams:
            return np.zeros(len(borne))
        area, modulus = (
            np.repeat([value(b.section) for b in self.beams], 2) for value in (_area, _modulus)
        )
        return np.abs(borne[:, 0]) / area + np.hypot(borne[:, 3], borne[:, 4]) / modulus


@dataclass(frozen=True, eq=False)
class SectionForces:
    """What the part of the shaft to the right exerts on that to the left, at both ends of every
    beam: ``position`` (m,), ``force`` (m, 5) with moments about y and z, and the largest nominal
    stress (m,) [Pa], of bending and normal force, without notches; zero without sections."""

    position: np.ndarray
    force: np.ndarray
    stress: np.ndarray

    @property
    def bending(self) -> np.ndarray:
        """Bending moment (m,) [N m], of both planes together."""
        return np.hypot(self.force[:, 3], self.force[:, 4])


def _area(section: ShaftSection) -> float:
    return section.area


def _modulus(section: ShaftSection) -> float:
    return 2.0 * section.second_moment / section.diameter


def _moved(force: np.ndarray, arm: float) -> np.ndarray:
    """Forces and moments (5,) as seen from a place so much further along the shaft."""
    moved = force.copy()
    moved[4] -= arm * force[1]
    moved[3] += arm * force[2]
    return moved


def build_shaft(spec: Shaft, positions: list[float]) -> ShaftModel:
    """Model of a shaft of beams with nodes at ``positions`` [m] of bearings, at loads and discs."""
    ends = np.concatenate([[0.0], np.cumsum([s.length for s in spec.sections])])
    if not spec.sections:
        ends = np.array([0.0, spec.whole_length])
    wanted = [*positions, *(d.position for d in spec.discs), *(p.position for p in spec.loads)]
    breaks = np.unique(np.concatenate([ends, np.clip(wanted, ends[0], ends[-1])]))
    for end in ends:  # a section ends where it ends, whatever stands beside it
        breaks[np.abs(breaks - end) < _SAME] = end
    breaks = np.unique(breaks)
    breaks = breaks[np.concatenate([[True], np.diff(breaks) > _SAME])]
    longest = (ends[-1] - ends[0]) / spec.elements
    places, beams = [breaks[0]], []
    for left, right in zip(breaks, breaks[1:]):
        count = max(ceil((right - left) / longest - 1e-9), 1) if spec.sections else 1
        places += list(np.linspace(left, right, count + 1)[1:])
        if spec.sections:
            k = int(np.searchsorted(ends, 0.5 * (left + right))) - 1
            section = spec.sections[k]
            piece = Beam((right - left) / count, section, section.material or spec.material)
            beams += [piece] * count
    return ShaftModel(spec, np.array(places), tuple(beams))
