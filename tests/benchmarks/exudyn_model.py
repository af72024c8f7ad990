"""The planar bearing of ``planar_case`` in Exudyn, built from flexcage's own arrays and state.

flexcage's y, z and rotation about x are Exudyn's x, y and rotation about z. Bodies are rigid, each
with three coordinates: rollers, inner ring and cage; the outer ring is ground. The inner ring keeps
its speed by an inertia that no torque here changes, in place of flexcage's constraint. All contacts
are ``ObjectContactSphereSphere``, which Exudyn computes in C++ and which in a plane is one of
circles: a roller on the inner race and in the hollow outer one, the ring in the hollow land of the
cage, and a roller on a pocket's face, which is a circle of ``FLAT`` radius and stands off a plane
by 3e-11 m over a quarter of a millimetre. (``ContactCurveCircles`` has straight segments, but only
a linear law; ``GeneralContact`` has no hollow bodies.)

Laws are the same: F = K d^n (1 + chi d'), by Exudyn's impact model 2, whose chi is
(1 - e^2)/(e v) for e < 1/3 at a least impact speed v, here one that no impact reaches; friction in
proportion to sliding up to a speed, and Coulomb's beyond. What differs is where friction acts: in
the middle of the overlap in Exudyn; in flexcage on the surface of the roller or of the land.
flexcage clips forces at zero, Exudyn does not; none here gets there.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from time import process_time
from typing import Any

import numpy as np
from planar_case import Planar
from settled import Forces

FLAT = 1e3  # [m]
NEVER = 10.0  # [m/s] faster than any impact
NEWTON = (1e-4, 1e-3)  # tolerances of implicit methods; at its defaults, 1e-8 and 1e-10, it fails
HEAVY = 1e9  # [kg m^2] inertia of a ring that no torque slows down


@dataclass(frozen=True)
class Motion:
    """Samples of an integration by Exudyn, and its processor time [s].

    Bodies are the rollers, then inner ring and cage; their coordinates y, z [m] and angle [rad].
    Forces [N] as ``Planar.forces_in_space`` has them.
    """

    q: np.ndarray  # (n, Z + 2, 3)
    u: np.ndarray  # (n, Z + 2, 3)
    modes: np.ndarray  # (n, m) modal coordinates of the cage, as flexcage has them
    forces: Forces
    cpu: float


class ExudynBearing:
    """A planar bearing in Exudyn, at flexcage's settled state.

    ``stiffness`` multiplies the races' (to see that a comparison notices). ``surface``: radii of
    roller and race are shifted, their gap the same, so that friction acts on the roller's surface
    at the overlap of the start. ``sensors``: which motion is recorded, of all bodies and contacts
    or of the cage alone.
    """

    def __init__(
        self, planar: Planar, *, stiffness: float = 1.0, surface: bool = False, sensors: str = "all"
    ) -> None:
        import exudyn as exu

        exu.config.printToConsole = False
        self.exu, self.planar, self._surface = exu, planar, surface
        self.system = exu.SystemContainer().AddSystem()
        self._place: dict[Any, np.ndarray] = {}
        model, y = planar.bearing.data.model, planar.restore()[0]
        self.start, speed = coordinates(planar, y)
        b, cage = model.bodies, model.cage
        inertias = [tuple(b.element[:2])] * len(b.radius)
        inertias += [
            (model.inner_ring.inertia[0], HEAVY),
            (cage.mass, cage.G0[1, 1] + cage.G0[2, 2]),
        ]
        forces = np.outer([mass for mass, _ in inertias], b.gravity[1:])
        forces[-2] += b.load[1, 0] * b.load_direction
        bodies = list(map(self._body, inertias[:-1], self.start, speed))
        centres = [self._at(body, q[:2]) for (_, body), q in zip(bodies, self.start, strict=False)]
        self.walls, self.modal = self._walls(), None
        node, middle, faces = self._cage(inertias[-1], speed[-1])
        self.nodes = [*(node for node, _ in bodies), node]
        centres.append(middle)
        for marker, force in zip(centres, forces, strict=True):
            self.system.AddLoad(
                {"loadType": "ForceVector", "markerNumber": marker, "loadVector": [*force, 0.0]}
            )
        self.contacts = self._contacts(centres, faces, stiffness)
        self._sense = self._sensors(sensors)
        self.system.Assemble()

    def _body(self, inertia: tuple[float, float], q: np.ndarray, u: np.ndarray) -> tuple[Any, Any]:
        node = self.system.AddNode(
            {"nodeType": "RigidBody2D", "referenceCoordinates": list(q),
             "initialVelocities": list(u)}
        )  # fmt: skip
        mass, about = inertia
        body = {"objectType": "RigidBody2D", "mass": mass, "inertia": about, "nodeNumber": node}
        return node, self.system.AddObject(body)

    def _at(self, body: Any, place: np.ndarray, local: Sequence[float] = (0.0, 0.0)) -> Any:
        """Marker of a body at ``local``, which is at ``place`` in space."""
        marker = self.system.AddMarker(
            {"markerType": "BodyRigid", "bodyNumber": body, "localPosition": [*local, 0.0]}
        )
        self._place[marker] = np.asarray(place)
        return marker

    def _walls(self) -> np.ndarray:
        """Centres (Z, 2, 2) of the circles that stand for pocket faces, in the cage's frame."""
        data = self.planar.bearing.data.model.pocket
        along = data.azimuth[:, None]
        across = np.stack([-along[..., 1], along[..., 0]], axis=-1)
        r = np.hypot(*(self.start[: len(along), :2] - self.start[-1, :2]).T)
        off = np.array([1.0, -1.0]) * (data.half[0] + FLAT)
        return r[:, None, None] * along + off[:, None] * across

    def _cage(self, inertia: tuple[float, float], speed: np.ndarray) -> tuple[Any, Any, list[Any]]:
        """The cage's node, and markers of its centre and of every pocket's front and rear."""
        node, body = self._body(inertia, self.start[-1], speed)
        faces = [self._at(body, self._in_space(at), at) for at in self.walls.reshape(-1, 2)]
        return node, self._at(body, self.start[-1, :2]), faces

    def _in_space(self, local: np.ndarray) -> np.ndarray:
        y, z, turn = self.start[-1]
        c, s = np.cos(turn), np.sin(turn)
        return np.array([y + c * local[0] - s * local[1], z + s * local[0] + c * local[1]])

    def _contacts(
        self, centres: Sequence[Any], faces: Sequence[Any], stiffness: float
    ) -> list[Any]:
        """Every roller's inner and outer race, every roller's front and rear face, the land."""
        model = self.planar.bearing.data.model
        ring, radii = centres[-2], model.bodies.radius
        ground = self._at(self.system.AddObject({"objectType": "Ground"}), np.zeros(2))
        found = []
        for i, Rw in enumerate(radii):
            for j, (race, other) in enumerate(((model.inner, ring), (model.outer, ground))):
                law = _law(race.normal, len(race.s), race.friction)
                law["contactStiffness"] *= stiffness
                gap = self._gap(centres[i], other, (Rw, race.radius), j == 1)
                shift = 0.5 * max(-gap, 0.0) if self._surface else 0.0
                pair = (Rw + shift, race.radius - race.sign * shift)
                found.append(self._touch(centres[i], other, pair, j == 1, law))
        for k, wall in enumerate(faces):
            i, f = divmod(k, 2)
            law = _law(model.pocket.normal[0], len(model.pocket.s), model.pocket.friction[0])
            found.append(self._touch(centres[i], wall, (radii[i], FLAT), False, law))
        rib = model.land.radius - model.land.clearance
        law = _law(model.land.normal, len(model.land.x), model.land.friction)
        found.append(self._touch(ring, centres[-1], (rib, model.land.radius), True, law))
        return found

    def _gap(self, one: Any, other: Any, radii: Sequence[float], hollow: bool) -> float:
        apart = float(np.linalg.norm(self._place[one] - self._place[other]))
        return radii[1] - radii[0] - apart if hollow else apart - radii[0] - radii[1]

    def _touch(self, one, other, radii, hollow: bool, law: dict[str, Any]) -> Any:
        gap = self._gap(one, other, radii, hollow)
        memory = self.system.AddNode(
            {"nodeType": "GenericData", "numberOfDataCoordinates": 4,
             "initialCoordinates": [gap, 0.0, 0.0, 0.0]}
        )  # fmt: skip
        return self.system.AddObject(
            {"objectType": "ContactSphereSphere", "markerNumbers": [one, other],
             "nodeNumber": memory, "spheresRadii": list(radii), "isHollowSphere1": hollow, **law}
        )  # fmt: skip

    def _sensors(self, which: str) -> dict[str, list[Any]]:
        kinds = self.exu.OutputVariableType

        def sensor(kind: str, what: str, number: Any, variable: Any) -> Any:
            return self.system.AddSensor(
                {"sensorType": kind, what: number, "outputVariableType": variable,
                 "writeToFile": False, "storeInternal": True}
            )  # fmt: skip

        if which == "cage":
            return {"q": [sensor("Node", "nodeNumber", self.nodes[-1], kinds.Coordinates)]}
        modal = [] if self.modal is None else [self.modal]
        return {
            "modes": [sensor("Node", "nodeNumber", n, kinds.Coordinates) for n in modal],
            "q": [sensor("Node", "nodeNumber", n, kinds.Coordinates) for n in self.nodes],
            "u": [sensor("Node", "nodeNumber", n, kinds.Coordinates_t) for n in self.nodes],
            "force": [sensor("Object", "objectNumber", n, kinds.Force) for n in self.contacts],
        }

    def _solve(self, duration: float, method: str, step: float, every: float) -> float:
        """Integrate by constant steps from the settled state; the processor time [s]."""
        settings = self.exu.SimulationSettings()
        time = settings.timeIntegration
        time.numberOfSteps, time.endTime, time.verboseMode = round(duration / step), duration, 0
        time.adaptiveStep = time.discontinuous.useRecommendedStepSize = False
        time.explicit.computeEndOfStepAccelerations = False
        time.newton.relativeTolerance, time.newton.absoluteTolerance = NEWTON
        time.newton.useModifiedNewton = True
        settings.solution.file.write = False
        settings.solution.sensors.writePeriod = every
        begin = process_time()
        if not self.system.SolveDynamic(settings, getattr(self.exu.DynamicSolverType, method)):
            raise RuntimeError(f"Exudyn's {method} with a step of {step} failed")
        return process_time() - begin

    def _read(self, name: str, times: np.ndarray) -> np.ndarray:
        """What sensors stored at these times (n, sensors, 1 + components)."""
        stored = [self.system.GetSensorStoredData(s) for s in self._sense[name]]
        if name in "qu":  # a flexible cage's node has z and three angles
            stored[-1] = stored[-1][:, [0, 1, 2, -1]]
        rows = np.stack(stored, axis=1)
        return rows[np.argmin(np.abs(rows[:, 0, :1] - times), axis=0)]

    def cage_path(self, times: np.ndarray, *, method: str, step: float) -> tuple[float, np.ndarray]:
        """Processor time [s] and the cage's y, z, angle (n, 3) at times that steps reach."""
        cpu = self._solve(times[-1], method, step, times[1] - times[0])
        return cpu, self._read("q", times)[:, -1, 1:] + self.start[-1]

    def run(self, times: np.ndarray, *, method: str, step: float) -> Motion:
        """Integrate from the settled state up to the last of even ``times`` that steps reach."""
        cpu = self._solve(times[-1], method, step, times[1] - times[0])
        q, u, force = (self._read(name, times) for name in ("q", "u", "force"))
        Z, n = len(self.nodes) - 2, len(times)
        on_first = force[..., 1:3]  # of every contact's two bodies
        races, faces = on_first[:, : 2 * Z], on_first[:, 2 * Z : 4 * Z]
        pairs = [f.reshape(n, Z, 2, 2) for f in (races, faces)]
        forces = Forces(np.concatenate(pairs, axis=2), -on_first[:, -1:])
        modes = np.zeros((n, 0)) if self.modal is None else self._read("modes", times)[:, 0, 1:]
        return Motion(q[..., 1:] + self.start, u[..., 1:], modes, forces, cpu)


def _law(p: np.ndarray, parts: int, friction: np.ndarray) -> dict[str, Any]:
    """Exudyn's numbers of flexcage's ``restitution`` in ``parts`` equal slices, and of its ramp."""
    x = NEVER * p[2] / p[3]  # = (1 - e^2)/e
    return {
        "contactStiffness": parts * p[0],
        "contactStiffnessExponent": p[1],
        "impactModel": 2,
        "restitutionCoefficient": float(0.5 * (np.sqrt(x * x + 4.0) - x)),
        "minimumImpactVelocity": NEVER,
        "dynamicFriction": friction[1],
        "frictionProportionalZone": friction[3],
    }


def coordinates(planar: Planar, y: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """y, z, angle of rollers, inner ring and cage (..., Z + 2, 3) in flexcage's y, and rates.

    A roller's angle is the integral of its angular velocity: its spin and its azimuth.
    """
    layout = planar.bearing.layout
    q, u = layout.q(y), layout.u(y)
    r, psi, spin = (q["elements"][..., k] for k in (1, 2, 5))
    vr, vp, w = (u["elements"][..., k] for k in (1, 2, 3))
    c, s = np.cos(psi), np.sin(psi)
    turn = 2.0 * np.arctan2(q["quaternion"][..., 1], q["quaternion"][..., 0])
    rollers = np.stack([r * c, r * s, psi + spin], axis=-1)
    rates = np.stack([vr * c - vp * s, vr * s + vp * c, w], axis=-1)
    ring = np.concatenate([q["inner"][..., 1:3], q["inner"][..., 5:]], axis=-1)
    cage = np.concatenate([q["cage"][..., 1:], turn[..., None]], axis=-1)
    turning = np.concatenate([u["cage"][..., 1:], u["omega"][..., :1]], axis=-1)
    return (
        np.concatenate([rollers, ring[..., None, :], cage[..., None, :]], axis=-2),
        np.concatenate([rates, u["inner"][..., None, 1:4], turning[..., None, :]], axis=-2),
    )
