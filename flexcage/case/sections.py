"""Sections of a case, unchecked, in the groups that stages, checks and words read.

``Case`` and ``StaticCase`` are all of them with their checks, texts and hashes.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Mapping
from copy import copy
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar, Self

from flexcage.case.fitted import in_operation, mounting_of
from flexcage.contacts.spec import Contacts, LandSpec, Lubricant
from flexcage.core.errors import InputError
from flexcage.core.spec import option
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.cage import Cage
from flexcage.geometry.defect import CageDefect, defect_spec
from flexcage.geometry.fits.mounting import Mounting
from flexcage.geometry.fits.spec import Fit
from flexcage.geometry.heat.spec import Heat
from flexcage.geometry.life.spec import Life
from flexcage.geometry.other_kinds import SURROUNDINGS
from flexcage.geometry.ring import InnerRing, OuterRing
from flexcage.mesh.options import MeshOptions
from flexcage.modes.spec import ModesSpec
from flexcage.results.options import OutputOptions
from flexcage.results.signals.spec import Sensor
from flexcage.solve.options import SolverOptions
from flexcage.system.spec import Constraint, Drive, Limits, Load, Mount, StartOptions
from flexcage.system.statics.options import StaticOptions

NO_CAGE = "none"  # full complement
CAGE_MODELS = ("flexible", "rigid", NO_CAGE)
OF_CAGE = ("cage", "defects", "mesh", "modes")  # sections that go with a cage


def _mount() -> Any:
    return option(Mount(), doc="what holds the outer ring")


def _constraints() -> Any:
    return option((), doc="what holds or moves rings and cage besides, any number")


def _modes() -> Any:
    return option(ModesSpec(), doc="the cage's modes")


@dataclass(frozen=True, kw_only=True)
class NamedSections:
    """What a case is called, and where it comes from."""

    name: str = option("case", doc="name, for titles and folders")
    description: str = option("", doc="what this case is for")
    preset: str = option("", doc="preset that the case started from")


@dataclass(frozen=True, kw_only=True)
class LoadedSections:
    """A bearing under load, turning."""

    bearing: Bearing = option(doc="the bearing")
    fit: Fit = option(Fit(), doc="how the bearing sits on its shaft and in its housing, how warm")
    contacts: Contacts = option(Contacts(), doc="contact laws, place by place")
    lubricant: Lubricant = option(Lubricant(), doc="the lubricant")
    drive: Drive = option(Drive(speed=0.0), doc="what turns the inner ring")
    load: Load = option(Load(), doc="what loads the inner ring")

    @property
    def speed(self) -> float:
        """Speed of the inner ring [rad/s] at the start."""
        return self.drive.at_start

    @cached_property
    def mounting(self) -> Mounting | None:
        """What fits, warmth and speed leave of the clearance; None where [fit] says nothing."""
        return mounting_of(self.bearing, self.fit, self.drive) if self.fit.given else None

    @cached_property
    def mounted(self) -> Self:
        """The same in operation, with the bearing and the load as [fit] leaves them; itself where
        that says nothing. A run and a static solution are of this one."""
        if self.mounting is None:
            return self
        bearing, load = in_operation(self.bearing, self.load, self.mounting)
        new = copy(self)
        for name, value in {"bearing": bearing, "load": load, "fit": Fit()}.items():
            object.__setattr__(new, name, value)
        new.__dict__.update(mounted=new, mounting=None)
        return new


@dataclass(frozen=True, kw_only=True)
class RingSections(LoadedSections):
    """The same with its rings: how they bend, and what holds the outer one."""

    inner_ring: InnerRing = option(InnerRing(), doc="how the inner ring bends, if it does")
    outer_ring: OuterRing = option(OuterRing(), doc="how the outer ring bends, if it does")
    mount: Mount = _mount()

    @property
    def rings_bend(self) -> bool:
        """Does a ring bend?"""
        return self.inner_ring.bends or self.outer_ring.bends


@dataclass(frozen=True, kw_only=True)
class StaticSections(RingSections, NamedSections):
    """Bearing, contacts, load, speed and options, of which a static solution is made."""

    life: Life = option(Life(), doc="how life is quoted, and of which load spectrum")
    heat: Heat = option(Heat(), doc="how heat leaves the bearing, for temperatures that settle")
    static: StaticOptions = option(StaticOptions(), doc="how a static solution is meant")
    given: tuple[str, ...] | None = dataclasses.field(
        default=None, compare=False,
        metadata={"hidden": True, "doc": "paths of values that the user gave, not of defaults"},
    )  # fmt: skip

    elsewhere: ClassVar[Mapping[str, str]] = SURROUNDINGS
    _in_motion = False  # does it read all of [mount], or the housing's body alone?


@dataclass(frozen=True, kw_only=True, repr=False)
class PocketSections:
    """A cage in its bearing: where its pockets are, and how they are deformed."""

    bearing: Bearing = option(doc="the bearing")
    cage: Cage | None = option(None, doc="the cage")
    defects: tuple[CageDefect, ...] = option((), doc="deformations of the cage, any number")
    seed: int = option(0, doc="seed of everything random in a bearing: sizes, places", minimum=0)

    @property
    def its_cage(self) -> Cage:
        """The cage. Raises InputError where there is none."""
        if self.cage is None:
            raise InputError(
                "The bearing has no cage: cage.model is 'none'; give a [cage] with the model "
                "'flexible' or 'rigid'.",
                where="cage.model",
                value=NO_CAGE,
            )
        return self.cage

    @property
    def all_defects(self) -> tuple[CageDefect, ...]:
        """Defects that the case names, and those that make its pockets' spacing uneven; none
        without a cage."""
        if self.cage is None:
            return ()
        uneven = defect_spec(self.cage).by_chance(self.cage, self.bearing.total_elements, self.seed)
        return (*self.defects, *uneven)


@dataclass(frozen=True, kw_only=True, repr=False)
class MeshSections(PocketSections):
    """The same, to be meshed."""

    mesh: MeshOptions = option(MeshOptions(), doc="the cage's mesh")

    @property
    def cage_shape(self) -> dict[str, Any]:
        """What ``cages.build.build_cage_mesh`` asks for, by name."""
        return {
            "cage": self.its_cage,
            "pocket_count": self.bearing.element_count,
            "pitch_diameter": self.bearing.pitch_diameter,
            "defects": self.all_defects,
            "options": self.mesh,
            "places": self.bearing.row_places,
        }


@dataclass(frozen=True, kw_only=True, repr=False)
class ModesSections(MeshSections):
    """The same, to be reduced to modes."""

    modes: ModesSpec = _modes()


@dataclass(frozen=True, kw_only=True, repr=False)
class CageSections(ModesSections):
    """The same, if it is flexible."""

    cage_model: str = option(
        "flexible", choices=CAGE_MODELS,
        doc="how the cage is modelled; none: a full complement, without a cage",
    )  # fmt: skip

    @property
    def riveted(self) -> bool:
        """Whether its cage is flexible and held together by rivets, whose loads are then known."""
        return self.cage_model == "flexible" and self.its_cage.riveted


@dataclass(frozen=True, kw_only=True, repr=False)
class MotionSections(PocketSections, RingSections):
    """What moves and what acts on it, and how often it is looked at."""

    modes: ModesSpec = _modes()
    constraints: tuple[Constraint, ...] = _constraints()
    output: OutputOptions = option(OutputOptions(), doc="what is kept of a run")


@dataclass(frozen=True, kw_only=True, repr=False)
class StartSections(LoadedSections):
    """How a bearing in motion begins."""

    mount: Mount = _mount()
    constraints: tuple[Constraint, ...] = _constraints()
    start: StartOptions = option(StartOptions(), doc="how the start departs from equilibrium")
    limits: Limits = option(Limits(), doc="limits beyond which a start is refused")


@dataclass(frozen=True, kw_only=True, repr=False)
class CaseSections(MotionSections, StartSections, CageSections, StaticSections):
    """All of them, the integrator, and what sensors see."""

    drive: Drive = option(Drive(), doc="what turns the inner ring")
    solver: SolverOptions = option(SolverOptions(), doc="the integrator")
    sensors: tuple[Sensor, ...] = option((), doc="sensors whose signals a run gives, any number")

    _in_motion = True

    @property
    def land(self) -> LandSpec:
        """The cage's land, with the clearance and width that the dimensions leave where the case
        gives none; as given without a cage."""
        if self.cage is None:
            return self.contacts.land.on(None)
        return self.contacts.land.on(self.mounted.bearing.land(self.cage))

    @property
    def held_in_words(self) -> str:
        """How the inner ring is held in a run, in words."""
        return self.load.held_in_words(axially=self.load.frees_axially(self.bearing))
