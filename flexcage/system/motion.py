"""What a bearing family supplies to the equations of motion: one value, a ``Motion``."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Any, Generic, Protocol, TypeVar

import numpy as np

from flexcage.bodies.floating_frame import BodyData
from flexcage.contacts.land import LandData
from flexcage.contacts.spec import Contacts, Lubricant
from flexcage.core.errors import InputError
from flexcage.system.begun import Advance, Start, StaticStart
from flexcage.system.data import Bodies, RingBody, Work
from flexcage.system.layout import Layout
from flexcage.system.spec import Drive, Load, Mount


class Model(Protocol):
    """Everything constant that the residual reads: a NamedTuple of a family's own type.

    These are what all families have. Kernels get each field as a group of arrays of its own. Of
    ``pocket`` others read ``phi`` and ``phi_max``, the modes at the pockets' stations, too.
    """

    @property
    def bodies(self) -> Bodies: ...
    @property
    def inner_ring(self) -> RingBody: ...
    @property
    def outer_ring(self) -> RingBody: ...
    @property
    def cage(self) -> BodyData: ...
    @property
    def land(self) -> LandData: ...
    @property
    def pocket(self) -> Any: ...


M = TypeVar("M", bound=Model)
Built = TypeVar("Built", bound=Model, covariant=True)
Assembled = TypeVar("Assembled", contravariant=True)  # a ``problem.BearingSystem``


class BuildModel(Protocol[Built]):
    """The model of a bearing from its specs, its cage's body and what moves in the pockets; without
    a cage all three are None."""

    def __call__(
        self, bearing: Any, cage: Any, body: Any, interface: Any, *, contacts: Contacts,
        lubricant: Lubricant, drive: Drive, load: Load, mount: Mount, seed: int = 0,
    ) -> Built: ...  # fmt: skip


class FindStart(Protocol[Assembled]):
    """Assembles a bearing and brings it to equilibrium at the drive's first speed."""

    def __call__(
        self,
        bearing: Assembled,
        *,
        limit_force: float,
        statics: StaticStart | None,
        advance: Advance,
    ) -> Start: ...


def parts_type(name: str, model: type, module: str) -> Any:
    """Type of the references to a bearing's groups of arrays, as the compiled functions get them.

    ``name`` is that of the variable in the ``module`` (``__name__``) that it is assigned to: the
    kernels' cache finds it there.
    """
    own: Any = model
    groups = (
        *own._fields, "memory", *Work._fields, "matrix", "events", "samples", "between",
        "rates", "constraints", "places", "second",
    )  # fmt: skip
    return namedtuple(name, groups, module=module)


def bending_model(name: str, model: type, module: str) -> Any:
    """Type of a family's model with the data of races that yield (``rings.races.RacesData``), as
    ``rings``, and of both rings' modes (``rings.modes.RingModes``), as ``inner_modes`` and
    ``outer_modes``; arguments as those of ``parts_type``."""
    own: Any = model
    return namedtuple(name, (*own._fields, "rings", "inner_modes", "outer_modes"), module=module)


@dataclass(frozen=True, kw_only=True)
class BendingMotion:
    """How a family's elements move between rings that bend: kernels of their own, so that others
    pay nothing, over a model of type ``model`` (``bending_model``)."""

    motion: Motion[Any]
    model: Any


@dataclass(frozen=True, kw_only=True)
class Motion(Generic[M]):
    """Rolling elements of one family in motion.

    ``evaluate(t, y, yd, d, law, out, mode)`` is the residual in plain Python, which ``problem``
    compiles for a ``d`` of type ``parts``; ``new_work`` makes its workspaces. It calls the
    functions ``separate``, of the same arguments, as values: they are compiled on their own, by
    another process at the same time, and follow the laws in ``law``; the longest first. ``faces``
    names the faces of a pocket; ``uncaged`` has both of a bearing without a cage, where next
    elements may stand for faces (None: it always has one). ``ribs`` names what else an element may
    touch besides its races: a bearing has the first of them, as many as ``new_work`` makes room
    for.
    ``linearise(t, y, yd, data)`` fills the tangent, in plain Python that is compiled when an
    implicit method asks for it; None: mode TANGENT of ``evaluate`` does.
    """

    build_model: BuildModel[M]
    parts: Any  # made by ``parts_type``
    new_work: Callable[[M, Layout], Work]
    evaluate: Callable[..., None]
    separate: tuple[Callable[..., None], ...]
    faces: tuple[str, ...]
    ribs: tuple[str, ...]
    start: FindStart[Any]
    error_weights: Callable[[M, Layout, float], np.ndarray]  # see ``scales.shared_weights``
    linearise: Callable[..., None] | None = None
    uncaged: tuple[tuple[Callable[..., None], ...], tuple[str, ...]] | None = None
    implicit_share: float = 0.0  # "auto" takes implicit steps below this many solver.stable_step
    implicit_weights: Callable[[M, Layout, float], np.ndarray] | None = None  # None: error_weights

    @property
    def without_cage(self) -> Motion[M]:
        """The same of bearings without a cage. "auto" takes explicit steps: Newton's matrix lacks
        how neighbours couple, and implicit ones are short while they touch."""
        if self.uncaged is None:
            raise InputError(
                "The motion of such bearings is not computed without a cage: cage.model is 'none'; "
                "take 'rigid' or 'flexible'.",
                where="cage.model",
                value="none",
            )
        separate, faces = self.uncaged
        return replace(self, separate=separate, faces=faces, implicit_share=0.0)

    def places(self, ribs: int) -> tuple[str, ...]:
        """Names of all contact places of an element with so many ribs and of the lands, in the
        order of events."""
        return ("inner race", "outer race", *self.faces, *self.ribs[:ribs], "land -x", "land +x")
