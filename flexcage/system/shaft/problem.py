"""A rotor and its bearings as one problem for an explicit integrator."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property
from typing import Any

import numba
import numpy as np
from numba import types

from flexcage.core.jit import boxed
from flexcage.core.kernel_values import KernelType
from flexcage.solve.oscillators import Oscillators
from flexcage.system.data import MASS, POWERS, TRANSVERSE
from flexcage.system.integrable import COUNT, REAL, VECTOR, Integrable
from flexcage.system.problem import BearingSystem
from flexcage.system.scales import ERROR_RATE, work_weights
from flexcage.system.shaft import motion
from flexcage.system.shaft.data import RIGID_ROTOR, SHAFT_POWERS, ShaftData, no_modes, workspace

_NONE, _FLAG = types.void, types.boolean
OTHER_WAY = np.array([-1.0, 1.0, -1.0, 1.0, -1.0])  # of x, y, z, skew, tilt: half a turn about y
#: What the explicit method asks of a machine: a function, its result and its arguments.
MACHINE: dict[str, tuple[Callable[..., Any], tuple[Any, ...]]] = {
    "rates": (motion.rates, (_NONE, REAL, VECTOR, VECTOR, None, VECTOR)),
    "note": (motion.note, (_NONE, REAL, VECTOR, None)),
    "wanted": (motion.wanted, (_FLAG, COUNT, None)),
    "sample": (motion.sample, (_NONE, COUNT, REAL, VECTOR, VECTOR, None)),
}
_OF_BEARING = ("rates", "note", "sample", "wanted")  # in the order of ``motion``'s places


class MachineSystem(Integrable):
    """Bearings whose inner rings are parts of one rotor, ready to be integrated explicitly."""

    def __init__(self, bearings: Sequence[BearingSystem], shaft: ShaftData) -> None:
        """``shaft`` by ``shaft_data``, of the same bearings."""
        super().__init__()
        self.bearings, self.shaft = tuple(bearings), shaft
        self.quads = len(bearings) * len(POWERS) + len(SHAFT_POWERS)
        own = tuple(
            types.Tuple((*(KernelType(b.signature(name)) for name in _OF_BEARING), b.data_type))
            for b in bearings
        )
        self.data_type = types.Tuple((types.Tuple(own), numba.typeof(boxed(shaft))))

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
        return own, boxed(self.shaft)

    @cached_property
    def modes(self) -> Oscillators:
        """The modes of all cages that swing by themselves."""
        each = [(b.modes, int(first)) for b, first in zip(self.bearings, self.shaft.first)]
        return Oscillators(
            np.concatenate([modes.place + first for modes, first in each], axis=1),
            np.concatenate([modes.decay for modes, _ in each]),
            np.concatenate([modes.frequency for modes, _ in each]),
        )

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


def shaft_data(
    bearings: Sequence[BearingSystem], *, place: Sequence[float], reversed_: Sequence[bool],
    inertia: Sequence[float], gravity: np.ndarray, load: np.ndarray,
    unbalance: np.ndarray | None = None, phase: np.ndarray | None = None,
    modes: dict[str, np.ndarray] | None = None,
) -> ShaftData:  # fmt: skip
    """The arrays of a rotor: ``place`` (b,) of its bearings from its centre of mass [m], which of
    them face the other way (``ShaftData.sign``),
    ``inertia`` mass, axial and transverse inertia without inner rings, ``load`` (5 + n) generalised
    forces, ``unbalance`` and ``phase`` (2, 5 + n), ``modes`` by ``no_modes``'s names."""
    count = len(bearings)
    modes = modes or no_modes(count)
    n = len(modes["stiffness"])
    sizes = [b.layout.size for b in bearings]
    first = np.concatenate([[0], np.cumsum(sizes)]).astype(np.int64)
    at = [b.layout.places for b in bearings]
    rings = [b.data.model.inner_ring.inertia for b in bearings]
    sign = np.where(np.array(reversed_)[:, None], OTHER_WAY, 1.0)
    drive, way = bearings[0].data.model.bodies, sign[0, 0]
    z = np.zeros((2, RIGID_ROTOR + n))
    return ShaftData(
        first=first,
        inner_q=first[:-1] + [a.inner_q for a in at],
        inner_u=first[:-1] + [a.inner_u for a in at],
        lam=first[:-1] + [a.lam for a in at],
        ring=np.array([[i[MASS], i[TRANSVERSE]] for i in rings]),
        place=np.array(place, float), inertia=np.array(inertia, float), gravity=gravity,
        load=np.array(load, float), unbalance=z if unbalance is None else unbalance,
        phase=z if phase is None else phase, sign=sign, speed=drive.speed * [[1.0], [way]],
        angle=way * drive.angle, wave=drive.waves[0] * [1.0, 1.0, way, 1.0],
        **modes, **workspace(count, n),
    )  # fmt: skip
