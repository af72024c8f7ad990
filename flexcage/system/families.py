"""What a bearing type supplies to the equations of motion, found by the type of its model."""

from __future__ import annotations

from collections import namedtuple
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

from flexcage.modes.basis import FACES
from flexcage.system.ball_model import BallModel, ball_work
from flexcage.system.ball_residual import evaluate as evaluate_balls
from flexcage.system.data import Work
from flexcage.system.layout import Layout
from flexcage.system.model import Model, roller_work
from flexcage.system.residual import evaluate as evaluate_rollers
from flexcage.system.roller_pockets import roller_pockets
from flexcage.system.rows import shared_rows


def parts_type(name: str, model: type) -> Any:
    """Type of the references to a bearing's groups of arrays, as the compiled functions get them.

    The kernels' cache finds it again by its name in this module.
    """
    own: Any = model
    groups = (
        *own._fields, "memory", *Work._fields, "matrix", "events", "samples", "between",
        "rates", "constraints",
    )  # fmt: skip
    return namedtuple(name, groups, module=__name__)


RollerParts = parts_type("RollerParts", Model)
BallParts = parts_type("BallParts", BallModel)


@dataclass(frozen=True)
class Family:
    """One kind of rolling elements in motion.

    ``evaluate(t, y, yd, d, law, out, mode)`` is the residual in plain Python, which ``problem``
    compiles for a ``d`` of type ``parts``; ``new_work(model, layout)`` its workspaces. It calls
    the functions ``apart``, of the same arguments, as values: they are compiled on their own, by
    another process at the same time, and follow the laws in ``law``; the longest first. ``faces``
    names the faces of a pocket, ``ribs`` what else an element touches besides its races.
    ``implicit``: does mode TANGENT fill it, so that implicit integrators may be used?
    """

    name: str
    element: str  # in words
    evaluate: Callable[..., None]
    apart: tuple[Callable[..., None], ...]
    parts: Any
    new_work: Callable[[Any, Layout], Work]
    faces: tuple[str, ...]
    ribs: tuple[str, ...]
    implicit: bool

    @property
    def places(self) -> tuple[str, ...]:
        """Names of all contact places of an element and of the lands, in the order of events."""
        return ("inner race", "outer race", *self.faces, *self.ribs, "land -x", "land +x")


FAMILIES: dict[type, Family] = {
    Model: Family(
        name="cylindrical_roller",
        element="roller",
        evaluate=evaluate_rollers,
        apart=(roller_pockets, shared_rows),
        parts=RollerParts,
        new_work=roller_work,
        faces=FACES,
        ribs=("rib +x", "rib -x"),
        implicit=True,
    ),
    BallModel: Family(
        name="ball",
        element="ball",
        evaluate=evaluate_balls,
        apart=(shared_rows,),
        parts=BallParts,
        new_work=ball_work,
        faces=("pocket",),
        ribs=(),
        implicit=False,
    ),
}


def family_of(model: Any) -> Family:
    """The family of a bearing's model."""
    return FAMILIES[type(model)]
