"""What a bearing family is: one value, composed of what each floor asks for."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, cast

from flexcage.core.errors import InputError
from flexcage.core.registry import check_free
from flexcage.core.wings import FAMILIES
from flexcage.geometry.bearing import BEARING_TYPES, Bearing, Rules, name_of

if TYPE_CHECKING:
    from flexcage.geometry.inference import Inference
    from flexcage.geometry.ring import SectionsOf
    from flexcage.integrate.recording import Recording
    from flexcage.render.shapes import ShapesOf
    from flexcage.results.figures.part import OwnFigures
    from flexcage.results.registry import OwnVariables
    from flexcage.results.slip import ElementSpeed
    from flexcage.stress.rubbing import Rub
    from flexcage.system.motion import BendingMotion, Motion
    from flexcage.system.statics.elements import ElementsOf
    from flexcage.system.statics.losses import LossesOf


@dataclass(frozen=True, kw_only=True)
class Family:
    """Bearings whose rolling elements move by the same equations.

    ``types``: the specs of its types of bearing, which bring dimensions, checks, ratings and films
    with them; ``other_designs`` maps patterns of names that are no types here to what there is
    instead. All else is heavy: functions without arguments that import what they return. None
    where a family has nothing of the kind: no static solution (``statics``), or neither equations
    of motion (``motion``) nor a record of them (``recording``), no pictures (``shapes``), no rule
    by which ``flexcage new`` infers internal geometry (``inside``), no rings that bend (``rings``),
    none that bend in a run (``bending``), no losses of a static solution (``losses``).
    """

    name: str
    types: tuple[type[Bearing], ...]
    rules: Rules[Any]  # is one possible, what is it rated for, where does its cage face rings
    statics: Callable[[], ElementsOf] | None
    motion: Callable[[], Motion[Any]] | None
    recording: Callable[[], Recording[Any]] | None
    variables: Callable[[], OwnVariables] | None  # that its runs record beside the common ones
    speed: Callable[[], ElementSpeed] | None  # how its elements turn about their axes, and slip
    figures: Callable[[], OwnFigures] | None  # of its runs' summaries beside the common ones
    rubbing: Callable[[], Rub] | None  # of its elements in their pockets, for wear
    shapes: Callable[[], ShapesOf] | None  # profiles of rings and elements, for pictures
    inside: Callable[[], Inference] | None  # inferred from a catalogue's ratings
    rings: Callable[[], SectionsOf] | None = None  # sections of rings that bend
    bending: Callable[[], BendingMotion] | None = None  # motion between rings that bend
    losses: Callable[[], LossesOf] | None = None  # of static solutions
    # name of the family whose elements it has, and which it may import, with what that is built on
    built_on: str = ""
    other_designs: Mapping[str, str] = field(default_factory=dict)
    catalogue: str = ""  # package of its own tables, beside those of ``case.catalogues``

    @property
    def element(self) -> str:
        """Its rolling elements, in words."""
        return self.types[0].element


def register_family(family: Family) -> Family:
    """Add a user's own family; InputError if its name, or that of one of its types, is taken."""
    for spec in family.types:
        check_free(BEARING_TYPES, name_of(spec), what="bearing type")
    return FAMILIES.add(family)


def family_of(bearing: Bearing | type[Bearing]) -> Family:
    """The family of a bearing, or of a spec; InputError if its spec names none that there is."""
    if bearing.family not in FAMILIES:
        raise InputError(
            f"{bearing.kind.capitalize()}s are of the family '{bearing.family}', which is not "
            "registered; flexcage.register.bearing_family adds one.",
            where="bearing.type",
        )
    return cast(Family, FAMILIES[bearing.family])


def in_motion(spec: type[Bearing]) -> bool:
    """Are there equations of motion for bearings of this spec?"""
    return family_of(spec).motion is not None


def statics_of(bearing: Bearing) -> ElementsOf:
    """What makes a bearing's elements for its static solution; InputError without one."""
    statics = family_of(bearing).statics
    if statics is None:
        raise _lacking(bearing, "static solution")
    return statics()


def losses_of(bearing: Bearing) -> LossesOf:
    """What finds the losses of a bearing's static solution; InputError without it."""
    losses = family_of(bearing).losses
    if losses is None:
        raise _lacking(bearing, "losses of a static solution")
    return losses()


def sections_of(bearing: Bearing) -> SectionsOf | None:
    """What makes the sections of a bearing's rings; None of a family whose rings do not bend."""
    rings = family_of(bearing).rings
    return None if rings is None else rings()


def motion_of(bearing: Bearing) -> Motion[Any]:
    """What moves a bearing's elements; InputError without equations of motion."""
    motion = family_of(bearing).motion
    if motion is None:
        raise _lacking(bearing, "equations of motion")
    return motion()


def bending_of(bearing: Bearing) -> BendingMotion:
    """What moves a bearing's elements between rings that bend; InputError without it."""
    bending = family_of(bearing).bending
    if bending is None:
        raise InputError(
            f"rings of a {bearing.kind} do not bend in a run: its family '{bearing.family}' has no "
            "such equations of motion; leave out inner_ring.ring and outer_ring.ring, or take "
            "'flexcage static'",
            where="outer_ring.ring",
        )
    return bending()


def recording_of(bearing: Bearing) -> Recording[Any]:
    """What runs of a bearing record; InputError without equations of motion."""
    recording = family_of(bearing).recording
    if recording is None:
        raise _lacking(bearing, "record of a run")
    return recording()


def inference_of(spec: type[Bearing]) -> Inference:
    """What infers the internal geometry of bearings of a spec; InputError without it."""
    inside = family_of(spec).inside
    if inside is None or name_of(spec) not in inside().cages:
        raise InputError(
            f"The internal geometry of a {spec.kind} is not inferred from ratings; give its "
            "dimensions in a case.",
            where="bearing.type",
        )
    return inside()


def _lacking(bearing: Bearing, what: str) -> InputError:
    return InputError(
        f"The family '{bearing.family}' of bearing.type '{bearing.type}' has no {what}.",
        where="bearing.type",
        value=bearing.type,
    )
