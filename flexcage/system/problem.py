"""The bearing as a problem for integrators: compiled functions over one tuple of data.

``data`` is (Parts, laws, evaluate), the last of the laws ``Motion.separate``: evaluated through
function values, the residual is compiled once, not again inside each of the functions, and its
pieces at the same time.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import cached_property, partial
from math import ceil
from typing import TYPE_CHECKING, Any, NamedTuple

import numba
import numpy as np
from numba import types

from flexcage.bodies.floating_frame import BodyData, marked, mirrored
from flexcage.contacts import laws
from flexcage.contacts.evaluation import RESIDUAL
from flexcage.contacts.land import NONE
from flexcage.contacts.spec import Contacts
from flexcage.core.garbage import uncollected
from flexcage.core.jit import FieldsType, boxed, compiled
from flexcage.core.kernel_values import KernelType
from flexcage.geometry.bearing import Bearing as BearingSpec
from flexcage.solve import runge_kutta
from flexcage.solve.bordered import Bordered, new_bordered
from flexcage.solve.oscillators import Oscillators
from flexcage.system import newton, rates, sampling
from flexcage.system.constraint_equations import apply_constraints, no_constraints
from flexcage.system.constraints import ALL_ROWS_TYPE, Constraints, constraints_of, units_of
from flexcage.system.data import POWERS, Memory, Report, Work, new_memory
from flexcage.system.integrable import COUNT, REAL, VECTOR, Integrable
from flexcage.system.layout import RING, Layout, Places
from flexcage.system.motion import Motion
from flexcage.system.rates import RatesWork, modal_oscillators, new_rates_work
from flexcage.system.scales import work_weights
from flexcage.system.spec import Constraint
from flexcage.system.time_functions import corners

if TYPE_CHECKING:
    from flexcage.system.rings.moving import MovingRings

LEAST_INTERVAL = 2e-6  # [s] at the least, between steps that are kept for the cage's stress
_NONE, _FLAG = types.void, types.boolean
#: What integrators may ask of a problem: a function, its result and its arguments; None: ``data``.
PROBLEM: dict[str, tuple[Callable[..., Any], tuple[Any, ...]]] = {
    "residual": (newton.residual, (_NONE, REAL, VECTOR, VECTOR, None, VECTOR, VECTOR)),
    "linearise": (newton.linearise, (_NONE, REAL, VECTOR, VECTOR, None)),
    "factor": (newton.factor, (_FLAG, REAL, None)),
    "backsolve": (newton.backsolve, (_NONE, REAL, VECTOR, VECTOR, None)),
    "observe": (sampling.observe, (_NONE, COUNT, REAL, VECTOR, VECTOR, None)),
    "rates": (rates.rates, (_NONE, REAL, VECTOR, VECTOR, None, VECTOR)),
    "powers": (sampling.powers, (COUNT, REAL, VECTOR, None, VECTOR)),
    "settle": (sampling.settle, (_NONE, REAL, VECTOR, None)),
    "note": (sampling.note, (_NONE, REAL, VECTOR, None)),
    "wanted": (sampling.wanted, (_FLAG, COUNT, None)),
    "sample": (rates.sample, (_NONE, COUNT, REAL, VECTOR, VECTOR, None)),
}


class Events(NamedTuple):
    """Contact changes: a buffer of (time, element or -1, place, 1 closed, 0 opened), its fill."""

    rows: np.ndarray  # (n, 4)
    fill: np.ndarray  # (1,)
    closed: np.ndarray  # (Z, places) contact flags at the last accepted step
    land: np.ndarray  # (cages LANDS,) the same for the cages' lands
    force: np.ndarray  # (2, 3) of the last two accepted steps: time, force on the outer ring
    pocket_force: np.ndarray  # (Z, faces) normal forces in pockets at the last accepted step
    pocket_force_before: np.ndarray  # (Z, faces) at the step before that
    pocket_force_peak: np.ndarray  # (Z, faces) the largest since the last sample, between steps too


class SampleBuffers(NamedTuple):
    """One block of reports on the sampling grid; every ``stride``-th fine sample is a main one."""

    stride: int
    race: np.ndarray  # (n, Z, 2, 9), and so on: the report's arrays
    pocket_normal: np.ndarray
    pocket_friction: np.ndarray
    slice_normal: np.ndarray
    slice_friction: np.ndarray
    point_normal: np.ndarray
    point_friction: np.ndarray
    station: np.ndarray
    residual: np.ndarray
    rib: np.ndarray
    land: np.ndarray
    land_station: np.ndarray
    energy: np.ndarray
    outer_wrench: np.ndarray
    pocket_peak: np.ndarray  # (n, Z, faces) largest since the sample before, at and between steps
    force: np.ndarray  # (n * stride, 2) on the outer ring, fine grid


class BetweenSamples(NamedTuple):
    """What moves and pushes a flexible cage at accepted steps, one block of them; forces on the
    faces of pockets that are touched, one row a face. Full, it keeps the first ones."""

    time: np.ndarray  # (n,)
    modes: np.ndarray  # (n, nm), one cage after the other, likewise stations of lands
    land: np.ndarray  # (n, nl, 2)
    touched: np.ndarray  # (n,) rows of each step
    face: np.ndarray  # (n Z, 2) its pocket and its number there
    force: np.ndarray  # (n Z, nst, 3)
    fill: np.ndarray  # (2,) steps and rows so far
    clock: np.ndarray  # (2,) [s] steps before the first are too close, after the second too late
    spacing: np.ndarray  # (2,) [s] least time between steps, and how long after a touch


class BearingData(NamedTuple):
    model: Any
    memory: Memory
    work: Work
    matrix: Bordered
    events: Events
    samples: SampleBuffers
    between: BetweenSamples
    rates: RatesWork
    constraints: Constraints
    places: Places
    second: BodyData  # the cage of the second row, if each has one: the first one's mirror image


def parts(kind: Any, data: BearingData) -> Any:
    """References to the groups of arrays of a bearing, as the compiled functions receive them:
    of the type ``Motion.parts``."""
    groups = (
        *data.model, data.memory, *data.work, data.matrix, data.events, data.samples,
        data.between, data.rates, data.constraints, data.places, data.second,
    )  # fmt: skip
    return kind(*(boxed(group) for group in groups))


def new_samples(n: int, stride: int, report: Report) -> SampleBuffers:
    """Room for n reports."""
    reported = [name for name in SampleBuffers._fields if name in Report._fields]
    kept = {name: np.zeros((n, *getattr(report, name).shape)) for name in reported}
    peak = np.zeros((n, *report.pocket_normal.shape))
    return SampleBuffers(stride=stride, **kept, pocket_peak=peak, force=np.zeros((n * stride, 2)))


def new_between(n: int, interval: float, modes: int, report: Report) -> BetweenSamples:
    """Room for the steps of a block of n samples, ``interval`` [s] apart, in which an element
    touches one face on average; none without modes."""
    least = min(LEAST_INTERVAL, 0.1 * interval)
    steps = n * ceil(interval / least) if modes else 0
    rows, z, small = steps * len(report.station), np.zeros, np.float32
    return BetweenSamples(
        z(steps), z((steps, modes)), z((steps, *report.land_station.shape), small),
        z(steps, np.int64), z((rows, 2), np.int64), z((rows, *report.station.shape[2:]), small),
        z(2, np.int64), np.full(2, -np.inf), np.array([least, interval]),
    )  # fmt: skip


def law_functions(contacts: Contacts) -> tuple:
    """The ten law functions: normal (race, pocket, side, rib, land), then friction."""
    places = (contacts.race, contacts.pocket, contacts.side, contacts.rib, contacts.land)
    return tuple(laws.NORMAL_LAWS[p.normal.law] for p in places) + tuple(
        laws.FRICTION_LAWS[p.friction.law] for p in places
    )


def _low(model: Any, layout: Layout) -> int:
    """Columns of the border with which all elements are coupled, those that touch no pocket too."""
    at = layout.places
    rings = bool(model.outer_ring.free.any()) or at.inner_modes + at.outer_modes > 0
    return at.cage_b if rings else at.inner_b + RING


def _evaluation(bearing: Any, law: Any) -> Any:
    """numba's signature of ``Motion.evaluate``, of ``Motion.separate``, and of what puts
    constraints into them."""
    return types.void(REAL, VECTOR, VECTOR, bearing, law, VECTOR, COUNT)


class BearingSystem(Integrable):
    """A bearing ready to be integrated: its data, and functions that are compiled when needed."""

    quads = len(POWERS)

    def __init__(
        self, motion: Motion[Any], spec: BearingSpec, model: Any, contacts: Contacts,
        layout: Layout, *, constraints: Sequence[Constraint] = (), block: int = 250,
        stride: int = 4, interval: float = 20e-6, rings: MovingRings | None = None,
        seat: np.ndarray | None = None,
    ) -> None:  # fmt: skip
        """``motion`` moves bearings of the ``spec``'s family; ``layout.held`` holds the
        ``constraints.names_of`` the constraints; ``rings`` are those that bend, ``seat`` (5, 5) is
        the compliance of the outer ring's, if it yields."""
        super().__init__()
        model = model._replace(cage=marked(model.cage))
        self.motion, self.spec, self.layout, self.rings = motion, spec, layout, rings
        self.seat = seat
        self.reaction_units = units_of(constraints)
        work = self.motion.new_work(model, layout)
        held, rows = constraints_of(constraints, model, layout)
        self.data = BearingData(
            model, new_memory(work.report), work,
            new_bordered(
                layout.elements, layout.n_border, _low(model, layout), work.tangent.active
            ),
            Events(
                np.zeros((200_000, 4)), np.zeros(1, np.int64),
                np.zeros_like(work.report.contact),
                np.zeros(len(work.report.land_touch), np.int64), np.zeros((2, 3)),
                *(np.zeros_like(work.report.pocket_normal) for _ in range(3)),
            ),
            new_samples(block, stride, work.report),
            new_between(block, interval, layout.cages * layout.modes, work.report),
            new_rates_work(model.cage.mff),
            held,
            layout.places,
            mirrored(model.cage) if layout.cages > 1 else model.cage,
        )  # fmt: skip
        bearing = numba.typeof(parts(motion.parts, self.data))
        signature = _evaluation(bearing, ALL_ROWS_TYPE)
        enforcing = compiled(apply_constraints if constraints else no_constraints, signature)
        self.laws = (*law_functions(contacts), rows, enforcing)
        own_laws = (
            *(laws.NORMAL_TYPE,) * 5, *(laws.FRICTION_TYPE,) * 5, ALL_ROWS_TYPE,
            KernelType(signature),
        )  # fmt: skip
        self._separate_signature = _evaluation(bearing, types.Tuple(own_laws))
        separate = (KernelType(self._separate_signature),) * len(self.motion.separate)
        law_type = types.Tuple((*own_laws, *separate))
        self._evaluation = _evaluation(bearing, law_type)
        self.data_type = types.Tuple((bearing, law_type, KernelType(self._evaluation)))

    @cached_property
    def evaluate(self) -> Any:
        """The family's residual, compiled; most of what there is to compile."""
        return compiled(self.motion.evaluate, self._evaluation)

    @cached_property
    def modes(self) -> Oscillators:
        """Which unknowns are linear oscillators but for what drives them."""
        return modal_oscillators(self.data.model.cage, self.layout)

    @property
    def places(self) -> tuple[str, ...]:
        """Names of all contact places of an element and of the lands, in the order of events."""
        found = self.motion.places(self.data.work.report.rib.shape[1])
        lands, other = found[-2:], self.data.model.land.other_kind != NONE
        on_other = tuple(f"{land}, other ring" for land in lands)
        if self.layout.cages > 1:
            of_second = tuple(f"{land}, second cage" for land in (*lands, *on_other))
            return (*found, *on_other, *of_second)
        return (*found, *on_other) if other else found

    @property
    def separate(self) -> tuple[Any, ...]:
        """What the residual calls as values, compiled."""
        return tuple(
            compiled(function, self._separate_signature) for function in self.motion.separate
        )

    @cached_property
    def args(self) -> tuple:
        """What the compiled functions take as their data."""
        return self.arguments(self.data, self.laws)

    def pieces(self) -> list[Callable[[], object]]:
        """What a run by the explicit method needs compiled, one call each, the longest first."""
        data = self.data
        groups = (data.work.tangent, data.matrix, data.model.bodies, data.places)
        tangent, matrix, bodies, at = (FieldsType(numba.typeof(group)) for group in groups)
        method, none = runge_kutta.EXPLICIT_METHOD, np.zeros(1)
        state = method.new_state(
            0.0, none, none, weight=none, h0=1.0, quad_weight=none, modes=self.modes
        )

        def kernel_for(kernel: Any, *arguments: Any) -> None:
            with uncollected():
                kernel.compile(arguments)

        return [
            *(
                partial(compiled, function, self._separate_signature)
                for function in self.motion.separate
            ),
            lambda: self.evaluate,
            lambda: self.advance_of(method, state, runge_kutta.RungeKuttaOptions(1.0, 0.0, 1)),
            lambda: kernel_for(newton.newton_step, REAL, VECTOR, VECTOR, at, tangent, matrix),
            lambda: kernel_for(newton.assemble, REAL, bodies, at, tangent, matrix),
            *(partial(self.function, name) for name in method.functions),
            lambda: self.radius_of(state),
        ]

    def source(self, name: str) -> Callable[..., Any]:
        """The function that ``PROBLEM`` names, as this bearing's family has it."""
        own = self.motion.linearise if name == "linearise" else None
        return own or PROBLEM[name][0]

    def types_of(self, name: str) -> tuple[Any, ...]:
        """numba's types of its result and its arguments; None: the data."""
        return PROBLEM[name][1]

    def arguments(self, data: BearingData, law: tuple) -> tuple:
        """What the compiled functions take as their data."""
        return parts(self.motion.parts, data), (*law, *self.separate), self.evaluate

    def residual(self, t: float, y: np.ndarray, yd: np.ndarray, mode: int = RESIDUAL) -> np.ndarray:
        """F(t, y, y'), a new array; TANGENT also fills the tangent, REPORT the report."""
        out = np.zeros(self.layout.size)
        self.evaluate(t, y, yd, self.args[0], self.args[1], out, mode)
        return out

    def error_weights(self, length: float, *, implicit: bool = False) -> np.ndarray:
        """1/(allowed local error) of y for a position error of ``length`` [m]; 0: not tested.

        ``implicit``: those of methods that stability does not bound.
        """
        own = self.motion.implicit_weights if implicit else None
        return (own or self.motion.error_weights)(self.data.model, self.layout, length)

    @property
    def size(self) -> int:
        """So many unknowns."""
        return self.layout.size

    def work_weights(self, length: float) -> np.ndarray:
        """1/(allowed local error) of the work of every power for a position error of ``length``."""
        return work_weights(self.data.model, length)

    def cheaper(self, step: float, least: float) -> str:
        """The integrator that "auto" takes where explicit steps up to ``step`` [s] are stable;
        ``least`` is ``solver.stable_step``."""
        if self.data.model.inner_ring.stands:  # a held centre has no implicit equation
            return "explicit"
        return "bdf" if step < self.motion.implicit_share * least else "explicit"

    def corners(self, begin: float, end: float) -> np.ndarray:
        """Times in [begin, end) at which the drive's or a load's slope jumps, and y' with it."""
        b = self.data.model.bodies
        return corners((b.speed, b.load, b.axial), b.waves, begin, end)
