"""A rotor and its bearings as one problem for an explicit integrator."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import fields
from functools import cached_property
from typing import Any

import numba
import numpy as np
from numba import types

from flexcage.core.jit import boxed
from flexcage.core.kernel_values import KernelType
from flexcage.solve import runge_kutta
from flexcage.solve.oscillators import Oscillators
from flexcage.system.begun import Start
from flexcage.system.data import MASS, OF_AXIAL, OF_LOAD, OF_SPEED, POWERS, TRANSVERSE
from flexcage.system.integrable import COUNT, REAL, VECTOR, Integrable
from flexcage.system.problem import BearingSystem
from flexcage.system.scales import ERROR_RATE, work_weights
from flexcage.system.shaft import motion
from flexcage.system.shaft.data import RIGID_ROTOR, SHAFT_POWERS, Rotor, ShaftData, workspace
from flexcage.system.shaft.housing import HousingData, no_housing
from flexcage.system.time_functions import AMPLITUDE

SOFT = 1e-3  # m, by which a spring of constant force is pressed (an assumption)
_NONE, _FLAG = types.void, types.boolean
OTHER_WAY = np.array([-1.0, 1.0, -1.0, 1.0, -1.0])  # of x, y, z, skew, tilt: half a turn about y
#: What the explicit method asks of a machine: a function, its result and its arguments.
MACHINE: dict[str, tuple[Callable[..., Any], tuple[Any, ...]]] = {
    "rates": (motion.rates, (_NONE, REAL, VECTOR, VECTOR, None, VECTOR)),
    "note": (motion.note, (_NONE, REAL, VECTOR, None)),
    "wanted": (motion.wanted, (_FLAG, COUNT, None)),
    "sample": (motion.sample, (_NONE, COUNT, REAL, VECTOR, VECTOR, None)),
}
_OF_ROTOR = [field.name for field in fields(Rotor) if field.name != "reversed"]
_OF_BEARING = ("rates", "note", "sample", "wanted")  # in the order of ``motion``'s places


class MachineSystem(Integrable):
    """Bearings whose inner rings are parts of one rotor, ready to be integrated explicitly."""

    def __init__(
        self, bearings: Sequence[BearingSystem], shaft: ShaftData,
        housing: HousingData | None = None,
    ) -> None:  # fmt: skip
        """``shaft`` by ``shaft_data``, of the same bearings, as ``housing`` by ``housing_data`` if
        one holds several of their outer rings."""
        super().__init__()
        self.bearings, self.shaft = tuple(bearings), shaft
        self.housing = housing or no_housing()
        self.quads = len(bearings) * len(POWERS) + len(SHAFT_POWERS)
        own = tuple(
            types.Tuple((*(KernelType(b.signature(name)) for name in _OF_BEARING), b.data_type))
            for b in bearings
        )
        held = (numba.typeof(boxed(group)) for group in (shaft, self.housing))
        self.data_type = types.Tuple((types.Tuple(own), *held))

    @property
    def size(self) -> int:
        """So many unknowns."""
        return int(self.shaft.first[-1]) + 2 * (RIGID_ROTOR + len(self.shaft.stiffness))

    def cheaper(self, step: float, least: float) -> str:
        """Explicit steps: a machine has no others."""
        return "explicit"

    @cached_property
    def args(self) -> tuple:
        """What the compiled functions take as their data."""
        own = tuple((*(b.function(name) for name in _OF_BEARING), b.args) for b in self.bearings)
        return own, boxed(self.shaft), boxed(self.housing)

    @cached_property
    def modes(self) -> Oscillators:
        """The modes of all cages that swing by themselves."""
        each = [(b.modes, int(first)) for b, first in zip(self.bearings, self.shaft.first)]
        return Oscillators(
            np.concatenate([modes.place + first for modes, first in each], axis=1),
            np.concatenate([modes.decay for modes, _ in each]),
            np.concatenate([modes.frequency for modes, _ in each]),
        )

    def prepare(self) -> None:
        """Compile what a run needs, or read it from disk."""
        method, y = runge_kutta.EXPLICIT_METHOD, np.zeros(self.size)
        state = method.new_state(
            0.0, y, y, weight=y, h0=1.0, quad_weight=np.zeros(self.quads), modes=self.modes
        )
        self.functions(method)
        self.advance_of(method, state, runge_kutta.RungeKuttaOptions(1.0, 0.0, 1))
        self.radius_of(state)

    def source(self, name: str) -> Callable[..., Any]:
        """The function that ``MACHINE`` names."""
        return MACHINE[name][0]

    def types_of(self, name: str) -> tuple[Any, ...]:
        """numba's types of its result and its arguments; None: the data."""
        return MACHINE[name][1]

    def error_weights(self, length: float, *, implicit: bool = False) -> np.ndarray:
        """1/(allowed local error) of y for a position error of ``length`` [m]; 0: not tested, as
        inner rings are, which the rotor sets."""
        s, found = self.shaft, np.zeros(self.size)
        lever = np.full(RIGID_ROTOR, np.inf)
        for k, bearing in enumerate(self.bearings):
            own = bearing.error_weights(length)
            q, u = bearing.layout.q(own)["inner"], bearing.layout.u(own)["inner"]
            pitch = bearing.data.model.bodies.pitch
            lever = np.minimum(lever, [np.inf, 1.0, 1.0, 1.0 / pitch, 1.0 / pitch])
            q[:5] = u[:3] = u[4:] = 0.0
            found[s.first[k] : s.first[k + 1]] = own
        most = np.abs(s.shape[:, :3]).max(axis=(0, 1)) if len(s.stiffness) else np.zeros(0)
        allowed = length * np.concatenate([lever, 1.0 / np.maximum(most, 1e-12)])
        weights = np.concatenate([1.0 / allowed, 1.0 / (allowed * ERROR_RATE)])
        found[s.first[-1] :] = weights
        return found

    def work_weights(self, length: float) -> np.ndarray:
        """1/(allowed local error) of the work of every power for a position error of ``length``."""
        own = [work_weights(b.data.model, length) for b in self.bearings]
        return np.concatenate([*own, np.zeros(len(SHAFT_POWERS))])

    def corners(self, begin: float, end: float) -> np.ndarray:
        """Times in [begin, end) at which the drive's slope jumps."""
        return np.unique(np.concatenate([b.corners(begin, end) for b in self.bearings]))


def shaft_data(bearings: Sequence[BearingSystem], rotor: Rotor, *, samples: int = 0) -> ShaftData:
    """The arrays of a rotor and of where its bearings are in y, for blocks of so many samples."""
    count, n = len(bearings), len(rotor.stiffness)
    sizes = [b.layout.size for b in bearings]
    first = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
    at = [b.layout.places for b in bearings]
    rings = [b.data.model.inner_ring.inertia for b in bearings]
    sign = np.where(rotor.reversed[:, None], OTHER_WAY, 1.0)
    drive, way = bearings[0].data.model.bodies, sign[0, 0]
    own = {name: getattr(rotor, name) for name in _OF_ROTOR}
    return ShaftData(
        first=first,
        inner_q=first[:-1] + [a.inner_q for a in at],
        inner_u=first[:-1] + [a.inner_u for a in at],
        lam=first[:-1] + [a.lam for a in at],
        ring=np.array([[i[MASS], i[TRANSVERSE]] for i in rings]),
        sign=sign, speed=drive.speed * [[1.0], [way]], angle=way * drive.angle,
        wave=drive.waves[OF_SPEED] * [1.0, 1.0, way, 1.0], **own,
        **workspace(count, n, samples),
    )  # fmt: skip


def release(bearing: BearingSystem) -> None:
    """Take off the inner ring what loads it and holds it to the ground, which a rotor does from now
    on; its speed stays prescribed. Written into the bearing's own arrays."""
    ring, bodies = bearing.data.model.inner_ring, bearing.data.model.bodies
    ring.free[:] = [1, 1, 1, 0, 1, 1]
    ring.stiffness[:] = ring.damping[:] = 0.0
    bodies.load[1], bodies.axial[1], bodies.moments[:] = 0.0, 0.0, 0.0
    bodies.waves[OF_LOAD, AMPLITUDE] = bodies.waves[OF_AXIAL, AMPLITUDE] = 0.0


def let_slide(bearing: BearingSystem, *, force: float, stiffness: float, place: float) -> None:
    """Let the outer ring slide along its axis before a spring that presses it towards -x with
    ``force`` [N] where it stands at ``place`` [m], and with as much more a metre towards +x as its
    ``stiffness`` [N/m]; a constant force is a spring's so soft that it hardly changes. Its seat
    holds it along the axis no more. Written into the bearing's own arrays."""
    ring = bearing.data.model.outer_ring
    soft = stiffness or force / SOFT
    for held in (ring.stiffness, ring.damping):
        held[0, :] = held[:, 0] = 0.0
    ring.free[0] = 1
    ring.stiffness[0, 0] = soft
    ring.rest[0] = place - (force / soft if soft else 0.0)


def begun(machine: MachineSystem, starts: Sequence[Start], pose: np.ndarray) -> np.ndarray:
    """y of a machine whose bearings begin as ``starts`` say, with the rotor at rest at ``pose``
    (5 + n,)."""
    return np.concatenate([*(start.y for start in starts), pose, np.zeros_like(pose)])
