"""A rivet, two sheets and their holes under the loads of a run: contact, friction, peaks of stress.

The joint is clamped and fitted first, then loaded as ``cycle`` says (largest, least, largest), as
friction remembers. What goes from half to half acts on the sheets' cut edges: on each sheet a
traction that varies linearly over both of its edges, statically the same as the rivet's force and
moment (``stress.rivets``), so that what passes along a half without the rivet is left out. Linear
elastic: where a peak is higher than the yield stress, use ``stress.notch``.

Clamping is a head-to-head distance too short for the sheets, found for the force that is asked for.
"""

from __future__ import annotations

import logging
from collections.abc import Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from math import pi

import numpy as np

from flexcage.core.errors import InputError
from flexcage.core.units import mm
from flexcage.fem.contact import ContactProblem, ContactState, NoBalance, Touching
from flexcage.fem.curved import curved_stiffness, curved_stress, face_points
from flexcage.fem.separation import SeparationModel
from flexcage.geometry.materials import Material
from flexcage.geometry.riveted_joint import JointShape
from flexcage.mesh.riveted_joint import (
    CONTACTS,
    LOWER,
    RIVET,
    ROOTS,
    UPPER,
    JointMesh,
    RevolvedBodies,
    joint_bodies,
)
from flexcage.stress.notch import READINGS, SOFT_STEELS, CyclicSteel, NotchLife, notch_life
from flexcage.stress.operators import von_mises
from flexcage.stress.rivets import Rivets, nominal_stress

log = logging.getLogger(__name__)

PENALTY = 10.0  # contact stiffness over Young's modulus and the shank's radius
_SPRINGS = 1e-9  # of the contact's stiffness on the shank's section, over all nodes
_OFF_EDGE = 0.05e-3  # [m] from the head's edge, where the stress under it is taken
_CLAMPED = 0.02  # of the clamping force, within which it is met
_TRIES = 4
_STEPS = (1, 4, 16)  # in which a load is put on, where fewer find no balance

#: Places whose peaks are reported, and what they are called.
PLACES = {
    "root": "root of the heads",
    "eave": "under the edge of the heads",
    "hole": "edge of the holes",
    "shank": "shank",
}


@dataclass(frozen=True, kw_only=True)
class Fit:
    """How the rivet sits: ``play`` of the shank in its holes over the diameter [m], negative for
    interference; ``clamp`` [N] of the heads; Coulomb ``friction``. All three are assumptions."""

    play: float = 0.0
    clamp: float = 100.0
    friction: float = 0.15

    def __post_init__(self) -> None:
        if not self.clamp > 0.0:
            raise InputError(
                f"clamp is {self.clamp:g} N, but must be greater than 0: nothing else holds the "
                "sheets together.", where="clamp", value=self.clamp,
            )  # fmt: skip
        if not 0.0 <= self.friction < 1.0:
            raise InputError(
                f"friction is {self.friction:g}, but must be from 0 to less than 1.",
                where="friction", value=self.friction,
            )  # fmt: skip


@dataclass(frozen=True, eq=False)
class Peak:
    """The largest equivalent stress [Pa] at a place of the joint, and where (x, y, z) [m]."""

    place: str
    stress: float
    at: np.ndarray


@dataclass(frozen=True, eq=False)
class JointState:
    """One state of the joint: displacement (n, 3) [m], stress (n, 6) [Pa] at nodes, contact."""

    name: str
    load: np.ndarray  # (6,) [N, N m] of the half at x < 0 on the other
    state: ContactState
    stress: np.ndarray
    clamp: float  # [N] that the heads press with, the mean of both
    forces: Mapping[str, np.ndarray]  # force and moment (6,) on the second body of each contact

    @cached_property
    def equivalent(self) -> np.ndarray:
        """Von Mises' stress (n,) [Pa] at nodes."""
        return von_mises(self.stress)


@dataclass(frozen=True, eq=False)
class JointResult:
    """The joint through its cycle: ``instants`` "clamped", "largest", "least" and "again"."""

    shape: JointShape
    fit: Fit
    bodies: RevolvedBodies
    problem: ContactProblem
    instants: Mapping[str, JointState]
    places: Mapping[str, np.ndarray]  # nodes

    def peaks(self, instant: str = "again") -> list[Peak]:
        """The peak at every place, the largest first."""
        stress = self.instants[instant].equivalent
        found = []
        for place, nodes in self.places.items():
            worst = nodes[np.argmax(stress[nodes])]
            found.append(Peak(place, float(stress[worst]), self.bodies.nodes[worst]))
        return sorted(found, key=lambda peak: -peak.stress)

    def range_at(self, place: str = "root") -> tuple[float, float, int]:
        """Over the cycle "least" to "again": the largest range of a normal stress at a place, its
        largest value there [Pa], and the node.

        The plane is that on which the difference of both stresses has its largest normal part.
        """
        nodes = self.places[place]
        low, high = (_tensors(self.instants[k].stress[nodes]) for k in ("least", "again"))
        values, vectors = np.linalg.eigh(high - low)
        worst = np.unravel_index(int(np.argmax(np.abs(values))), values.shape)
        normal = vectors[worst[0], :, worst[1]]
        ends = [float(normal @ t[worst[0]] @ normal) for t in (low, high)]
        return float(abs(values[worst])), max(ends), int(nodes[worst[0]])

    @property
    def nominal_range(self) -> float:
        """The range dS [Pa] of the nominal equivalent stress between "least" and "again": that of a
        shank that bears the difference of both loads alone."""
        difference = self.instants["again"].load - self.instants["least"].load
        return nominal_stress(difference, self.shape.shank_diameter)

    @property
    def K_t(self) -> float:
        """dsigma/dS at the roots of the heads."""
        return self.range_at("root")[0] / self.nominal_range

    def lives(
        self, steels: Sequence[CyclicSteel] = SOFT_STEELS, place: str = "root"
    ) -> list[NotchLife]:
        """The cycle at a place by the modified Neuber rule, for every steel and both readings."""
        stress, highest, _ = self.range_at(place)
        K_t = stress / self.nominal_range
        return [
            notch_life(self.nominal_range, K_t, steel, elastic_highest=highest, reading=reading)
            for steel in steels for reading in READINGS
        ]  # fmt: skip

    @property
    def largest_pressure(self) -> dict[str, float]:
        """Largest contact pressure [Pa] of every pair over the cycle."""
        return {
            name: max(float(i.state.pressure[part].max()) for i in self.instants.values())
            for name, part in self.problem.part.items()
        }

    @property
    def slip(self) -> dict[str, float]:
        """Largest slip [m] of every pair between "least" and "again", where they touch."""
        a, b = (self.instants[k].state for k in ("least", "again"))
        size = np.linalg.norm(b.slipped - a.slipped, axis=1)
        size = np.where((a.pressure > 0.0) & (b.pressure > 0.0), size, 0.0)
        return {name: float(size[part].max()) for name, part in self.problem.part.items()}

    def table(self) -> str:
        """Peaks, contact pressures and slip as lines of text."""
        play = self.fit.play
        kind = "interference" if play < 0.0 else "play"
        clamp = self.instants["clamped"].clamp
        lines = [
            f"{kind} {abs(play) * 1e6:.3g} um over the diameter, clamped by {clamp:.3g} N, "
            f"friction {self.fit.friction:g}, root radius {mm(self.shape.root_radius)}",
            "place                          clamped   largest     least     again   MPa",
        ]
        for place, words in PLACES.items():
            row = [
                f"{i.equivalent[self.places[place]].max() / 1e6:9.1f}"
                for i in self.instants.values()
            ]
            lines.append(f"{words:<28}" + " ".join(row))
        for name, pressure in self.largest_pressure.items():
            lines.append(
                f"{name:<12} pressure up to {pressure / 1e6:.0f} MPa, slip up to "
                f"{self.slip[name] * 1e6:.3g} um"
            )
        return "\n".join(lines)

    __str__ = table


class RivetedJoint:
    """The bodies of a joint of one material, ready for fits and loads."""

    def __init__(
        self, shape: JointShape, material: Material, *, mesh: JointMesh | None = None
    ) -> None:
        self.shape, self.material = shape, material
        self.bodies = joint_bodies(shape, mesh)
        self.penalty = PENALTY * material.youngs_modulus / (0.5 * shape.shank_diameter)

    def problem(self, friction: float) -> ContactProblem:
        """The contact problem with this coefficient of friction everywhere."""
        b = self.bodies
        pairs = [
            Touching(
                name, b.faces[name, one], b.faces[name, other],
                b.behind(one, b.faces[name, one]), friction,
            )
            for name, (one, other) in CONTACTS.items()
        ]  # fmt: skip
        return ContactProblem(self.parted, pairs, penalty=self.penalty)

    @cached_property
    def parted(self) -> SeparationModel:
        """The bodies, with all but what their surfaces do against each other eliminated."""
        b = self.bodies
        surfaces = [(b.faces[n, one], b.faces[n, other]) for n, (one, other) in CONTACTS.items()]
        section = 0.25 * pi * self.shape.shank_diameter**2
        springs = _SPRINGS * self.penalty * section / len(b.nodes)
        K = curved_stiffness(b.nodes, b.tets, self.material)
        return SeparationModel(K, b.nodes, b.tets, surfaces, self.held, springs=springs)

    @cached_property
    def held(self) -> np.ndarray:
        """Degrees of freedom (6,) that hold the lower sheet; balanced loads leave them no force."""
        own = self.bodies.faces["end_lower", LOWER]
        nodes = np.unique(own[:, :3])
        places = self.bodies.nodes[nodes]
        out = []
        corners = ((-1, 1, 1, (0, 1, 2)), (-1, 1, -1, (0, 1)), (-1, -1, 1, (0,)))
        for x, y, z, axes in corners:
            node = nodes[np.argmax(places @ np.array([x, y, z]))]
            out += [3 * int(node) + axis for axis in axes]
        return np.array(out)

    def loads(self, load: np.ndarray) -> np.ndarray:
        """Nodal loads (n, 3) [N] on the cut edges, of the force and moment (6,) with which the half
        at x < 0 acts on the other through the rivet; components (x, y, z) about its middle."""
        out = np.zeros_like(self.bodies.nodes)
        for name, body, sign in (("end_lower", LOWER, 1.0), ("end_upper", UPPER, -1.0)):
            faces = self._cut(name, body)
            points = face_points(self.bodies.nodes, faces)
            arms = np.concatenate(
                [np.tile(np.eye(3), (len(points.weights), 1, 1)), _cross_matrices(points.places)],
                axis=1,
            )  # (q, 6, 3)
            gram = np.einsum("q,qia,qja->ij", points.weights, arms, arms)
            shares = np.linalg.solve(gram, sign * np.asarray(load, float))
            traction = np.einsum("qia,i->qa", arms, shares)
            out += points.shapes.T @ (points.weights[:, None] * traction)
        return out

    def _cut(self, name: str, body: int) -> np.ndarray:
        """The faces of a sheet's two cut edges, at both ends of the strip along z."""
        faces = self.bodies.faces[name, body]
        z = np.abs(self.bodies.nodes[faces[:, :3], 2])
        return faces[(z > (0.5 - 1e-6) * self.shape.length).all(axis=1)]

    def cycle(self, largest: np.ndarray, least: np.ndarray, fit: Fit) -> JointResult:
        """Clamp and fit the joint, then load it: largest, least, largest; loads (6,) as in
        ``loads``."""
        problem = self.problem(fit.friction)
        gaps, state = self._clamped(problem, fit)
        instants = {"clamped": self._instant("clamped", np.zeros(6), problem, state)}
        before = np.zeros(6)
        for name, load in (("largest", largest), ("least", least), ("again", largest)):
            load = np.asarray(load, float)
            state = self._loaded(problem, gaps, state, before, load)
            instants[name], before = self._instant(name, load, problem, state), load
            log.info("riveted joint, play %.3g um: %s", 1e6 * fit.play, name)
        return JointResult(self.shape, fit, self.bodies, problem, instants, self.places)

    def _loaded(
        self, problem: ContactProblem, gaps: np.ndarray, state: ContactState,
        before: np.ndarray, load: np.ndarray,
    ) -> ContactState:  # fmt: skip
        """The state under ``load``, from that under the load ``before``, in as few steps as find
        balance."""
        loads = [self.loads(before), self.loads(load)]

        def in_steps(steps: int) -> ContactState:
            found = state
            for k in range(1, steps + 1):
                part = loads[0] + (k / steps) * (loads[1] - loads[0]) if k < steps else loads[1]
                found = problem.solve(part, gaps, found)
            return found

        for steps in _STEPS[:-1]:
            with suppress(NoBalance):
                return in_steps(steps)
        return in_steps(_STEPS[-1])

    def _clamped(self, problem: ContactProblem, fit: Fit) -> tuple[np.ndarray, ContactState]:
        """Gaps at the start, and the state before any load, at the clamping force asked for."""
        radial = 0.5 * fit.play
        area, grip = 0.25 * pi * self.shape.shank_diameter**2, 2.0 * self.shape.thickness
        short = fit.clamp * grip / (self.material.youngs_modulus * area)
        nothing = np.zeros_like(self.bodies.nodes)
        for _ in range(_TRIES):
            gaps = problem.gaps({
                "hole_lower": radial, "hole_upper": radial,
                "head_lower": -0.5 * short, "head_upper": -0.5 * short,
            })  # fmt: skip
            state = problem.solve(nothing, gaps, problem.at_rest())
            reached = _heads(problem.resultants(state, np.zeros(3)))
            if abs(reached - fit.clamp) <= _CLAMPED * fit.clamp:
                break
            short *= fit.clamp / max(reached, 0.1 * fit.clamp)
        return gaps, state

    def _instant(
        self, name: str, load: np.ndarray, problem: ContactProblem, state: ContactState
    ) -> JointState:
        b = self.bodies
        stress = curved_stress(b.nodes, b.tets, self.material, state.moved)
        forces = problem.resultants(state, np.zeros(3))
        return JointState(name, load, state, stress, _heads(forces), forces)

    @cached_property
    def places(self) -> dict[str, np.ndarray]:
        """Nodes of every place of ``PLACES``."""
        b, s = self.bodies, self.shape
        roots = np.unique(np.concatenate([b.faces[name, RIVET] for name in ROOTS]))
        radius = np.hypot(b.nodes[:, 1], b.nodes[:, 2])
        seats = np.unique(np.concatenate([
            b.faces[name, body] for name in ("head_lower", "head_upper")
            for body in (RIVET, LOWER, UPPER) if (name, body) in b.faces
        ]))  # fmt: skip
        edge = 0.5 * s.head_diameter - radius[seats]
        eave = seats[(edge > 0.5 * _OFF_EDGE) & (edge < 4.0 * _OFF_EDGE)]
        holes = np.unique(np.concatenate([
            b.faces[f"{what}_{side}", body]
            for what in ("hole", "edge") for side, body in (("lower", LOWER), ("upper", UPPER))
        ]))  # fmt: skip
        shank = np.unique(np.concatenate([b.faces[n, RIVET] for n in ("hole_lower", "hole_upper")]))
        return {"root": roots, "eave": eave, "hole": holes, "shank": shank}


def _heads(forces: Mapping[str, np.ndarray]) -> float:
    """The mean of the forces [N] with which the heads press on the sheets."""
    return float(0.5 * (abs(forces["head_lower"][0]) + abs(forces["head_upper"][0])))


def _tensors(stress: np.ndarray) -> np.ndarray:
    """Tensors (n, 3, 3) of stresses (n, 6): xx, yy, zz, xy, yz, xz."""
    return stress[:, np.array([[0, 3, 5], [3, 1, 4], [5, 4, 2]])]


def _cross_matrices(places: np.ndarray) -> np.ndarray:
    """(q, 3, 3): row i is e_i x place, so that row i . force is component i of the moment."""
    return np.cross(np.eye(3)[None], places[:, None])


@dataclass(frozen=True, eq=False)
class Fits:
    """The joint of one rivet with several fits, through the same cycle."""

    rivet: int
    results: tuple[JointResult, ...]

    def __iter__(self) -> Iterator[JointResult]:
        return iter(self.results)

    def table(self) -> str:
        """Peaks over the fits, and the cycle at the heads' roots."""
        return f"rivet {self.rivet}\n{compared(self.results)}"

    __str__ = table


def fits_of(
    rivets: Rivets, shape: JointShape, material: Material, plays: Sequence[float], *,
    clamp: float, friction: float, mesh: JointMesh | None = None,
) -> Fits:  # fmt: skip
    """The joint of a run's most stressed rivet through its cycle, with these plays [m]."""
    rivet, largest, least = rivets.cycle()
    joint = RivetedJoint(shape, material, mesh=mesh)
    wanted = [Fit(play=play, clamp=clamp, friction=friction) for play in plays]
    return Fits(rivet, tuple(joint.cycle(largest, least, fit) for fit in wanted))


def compared(results: Sequence[JointResult]) -> str:
    """Peaks over several fits, one line each, at the largest load of the cycle."""
    heads = [*PLACES.values(), "range at the root, MPa", "K_t"]
    lines = ["play, um  " + "  ".join(f"{words:>27}" for words in heads)]
    for result in results:
        peaks = {peak.place: peak.stress / 1e6 for peak in result.peaks()}
        cells = [f"{peaks[place]:27.1f}" for place in PLACES]
        cells += [f"{result.range_at()[0] / 1e6:27.1f}", f"{result.K_t:27.2f}"]
        lines.append(f"{result.fit.play * 1e6:8.3g}  " + "  ".join(cells))
    return "\n".join([*lines, "Equivalent stress in MPa at the largest load."])
