"""Specs of a machine: the shaft, what it carries and bears, and where its bearings stand.

x runs along the shaft from its left end, where x = 0; y and z are across it. Signs of forces and
moments are those of these axes, and all act on the shaft.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from math import pi
from types import MappingProxyType
from typing import Any, ClassVar

import numpy as np

from flexcage.core.body_file import BodyFile
from flexcage.core.spec import GIVEN, option, quantity
from flexcage.geometry.materials import MATERIALS, Material

FACINGS = ("+x", "-x")
SEATS = ("fixed", "floating")
#: How gravity acts on a shaft: across it, or along it.
ALONG = ("across", "+x", "-x")

_PLACES = MappingProxyType({
    r"x|place|at|station|location|coordinate": "it is position, from the shaft's left end",
})  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class ShaftSection:
    """A cylinder of the shaft; sections follow one another from x = 0."""

    elsewhere: ClassVar[Mapping[str, str]] = {
        r"(inner|hole)_?diameter|d_?i|hole": "the bore of a hollow shaft is bore",
        r"(outer|outside)_?diameter|d_?[oae]": "it is diameter",
        r"radius": "give its diameter",
        r"position|x|start|end": "sections follow one another, each with its length",
    }

    length: float = quantity("mm", doc="length of the section", above=0.0)
    diameter: float = quantity("mm", doc="outside diameter", above=0.0)
    bore: float = quantity("mm", 0.0, doc="bore of a hollow shaft", minimum=0.0)
    material: Material | None = option(None, doc="material (default: shaft.material)")

    @property
    def area(self) -> float:
        """[m^2]."""
        return 0.25 * pi * (self.diameter**2 - self.bore**2)

    @property
    def second_moment(self) -> float:
        """About a diameter [m^4]."""
        return pi / 64.0 * (self.diameter**4 - self.bore**4)


@dataclass(frozen=True, kw_only=True)
class Disc:
    """A rigid part on the shaft: wheel, rotor, impeller. It has a mass and moments of inertia, or a
    diameter and a width from which these follow; it does not stiffen the shaft."""

    elsewhere: ClassVar[Mapping[str, str]] = {
        **_PLACES,
        r"inertia|j|i_?[pd]": "give polar_inertia and diametral_inertia",
    }

    name: str = option("", doc="name, for tables and pictures")
    position: float = quantity("mm", doc="its centre, from the shaft's left end", minimum=0.0)
    mass: float | None = quantity("kg", None, doc="mass, in place of dimensions", minimum=0.0)
    polar_inertia: float = quantity(
        "kg*m^2", 0.0, doc="moment of inertia about the shaft's axis", minimum=0.0,
        when={"mass": GIVEN},
    )  # fmt: skip
    diametral_inertia: float = quantity(
        "kg*m^2", 0.0, doc="moment of inertia about a diameter through its centre", minimum=0.0,
        when={"mass": GIVEN},
    )  # fmt: skip
    diameter: float | None = quantity("mm", None, doc="outside diameter", above=0.0)
    width: float | None = quantity("mm", None, doc="width", above=0.0)
    bore: float = quantity(
        "mm", 0.0, doc="bore, the shaft's diameter", minimum=0.0, when={"diameter": GIVEN}
    )
    material: Material = option(MATERIALS["steel"], doc="material", when={"diameter": GIVEN})
    unbalance: float = quantity(
        "g*mm", 0.0, doc="mass times eccentricity, for the unbalance response", minimum=0.0
    )
    azimuth: float = quantity(
        "deg", 0.0, doc="azimuth of the unbalance, from y towards z, as the shaft stands at t = 0",
        when={"unbalance": GIVEN},
    )  # fmt: skip

    @property
    def inertia(self) -> tuple[float, float, float]:
        """Mass [kg], polar and diametral moment of inertia [kg m^2]."""
        if self.mass is not None or self.diameter is None or self.width is None:
            return self.mass or 0.0, self.polar_inertia, self.diametral_inertia
        mass = self.material.density * 0.25 * pi * (self.diameter**2 - self.bore**2) * self.width
        squares = 0.25 * (self.diameter**2 + self.bore**2)
        return mass, 0.5 * mass * squares, mass * (3.0 * squares + self.width**2) / 12.0


@dataclass(frozen=True, kw_only=True)
class ShaftLoad:
    """A force and moments on the shaft that stand still in space, as of a gear or a belt."""

    elsewhere: ClassVar[Mapping[str, str]] = {
        **_PLACES,
        r"radial|axial|f[xyz]|[xyz]": 'forces are force = ["... N", "... N", "... N"], along x, y '
        "and z",
        r"moment_[yz]|m[yz]": 'moments are moment = ["... N*m", "... N*m"], about y and z',
        r"unbalance": "an unbalance is one of [[shaft.discs]]: unbalance, azimuth",
        r"torque": "the static solution has no torsion; leave it out",
    }

    name: str = option("", doc="name, for tables and pictures")
    position: float = quantity("mm", doc="where it acts, from the shaft's left end", minimum=0.0)
    force: tuple[float, float, float] = quantity("N", (0.0, 0.0, 0.0), doc="force along x, y and z")
    moment: tuple[float, float] = quantity("N*m", (0.0, 0.0), doc="moment about y and z")

    @property
    def vector(self) -> np.ndarray:
        """Forces and moments (5,)."""
        return np.array([*self.force, *self.moment])


@dataclass(frozen=True, kw_only=True)
class Shaft(BodyFile):
    """A shaft of cylinders end to end, or a body that another program reduced, with what it carries
    and bears.

    An elastic shaft bends and stretches as Timoshenko's beams or its body do; it is not twisted. A
    rigid one keeps its weight, or has none where only its length is given. A body is free, in the
    machine's axes, with nodes on the axis where bearings, discs and loads are.
    """

    elsewhere: ClassVar[Mapping[str, str]] = {
        r"disks?|wheels?|gears?|rotors?|masses": "discs are [[shaft.discs]]",
        r"forces?|gear_?loads?": "loads are [[shaft.loads]]",
        r"bearings?": "bearings stand beside the shaft, as [[bearings]]",
        r"diameter|bore": "the shaft's diameters are those of [[shaft.sections]]",
        r"speed|rpm": "the shaft's speed is drive.speed",
        r"gravity.*": "gravity is a section of its own, [gravity]",
    }

    kind: str = option("elastic", doc="does the shaft bend?", choices=("elastic", "rigid"))
    length: float | None = quantity(
        "mm", None, doc="length of a shaft without sections: a rigid one, or a body", above=0.0
    )
    material: Material = option(
        MATERIALS["steel"], doc="material of sections that name none of their own"
    )
    sections: tuple[ShaftSection, ...] = option((), doc="cylinders from left to right")
    discs: tuple[Disc, ...] = option((), doc="rigid parts on the shaft")
    loads: tuple[ShaftLoad, ...] = option((), doc="forces and moments on the shaft")
    elements: int = option(
        40, doc="beam elements along the shaft, at least", minimum=4, maximum=1000,
        when={"kind": ("elastic",)},
    )  # fmt: skip

    @property
    def whole_length(self) -> float:
        """[m]; 0 where nothing says it."""
        return sum(s.length for s in self.sections) or (self.length or 0.0)


@dataclass(frozen=True, kw_only=True)
class Gravity:
    """Gravity on shaft and discs."""

    acceleration: float = quantity(
        "m/s^2", 9.80665, doc="acceleration of gravity; 0: none", minimum=0.0
    )
    along: str = option(
        "across", doc="does it act across the shaft, or along it?", choices=ALONG,
        when={"acceleration": GIVEN},
    )  # fmt: skip
    direction: float = quantity(
        "deg", 0.0, doc="azimuth in which it acts, from y towards z", when={"along": ("across",)}
    )

    @property
    def vector(self) -> np.ndarray:
        """Acceleration (3,) [m/s^2]."""
        if self.along != "across":
            return np.array([self.acceleration * float(f"{self.along[0]}1"), 0.0, 0.0])
        turn = np.array([0.0, np.cos(self.direction), np.sin(self.direction)])
        return self.acceleration * turn


def _source(doc: str, *, file: bool = False) -> Any:
    """A value that says where a bearing's others come from; those count, not this one."""
    return field(default="", compare=False, metadata=option("", doc=doc, file=file).metadata)


@dataclass(frozen=True, kw_only=True)
class BearingPlace:
    """Where a bearing stands on the shaft, which way it bears, and how its outer ring is held
    along the axis."""

    called: ClassVar[str] = "A bearing of the machine"
    elsewhere: ClassVar[Mapping[str, str]] = {
        **_PLACES,
        r"orientation|arrangement|mounting|thrust": 'facing = "+x" or "-x" is the direction of the '
        "shaft's push that it bears",
        r"fixed|floating|locating|non_?locating|float": 'axial_seat = "fixed" or "floating"',
        r"pre_?load|preload_offset|offset|spacer.*|gap": "a preload is axial_offset (of a spacer "
        'or of ground faces), preload_force, or spring_force with axial_seat = "floating"',
        r"drive|speed|load": "the machine has one [drive], and loads are [[shaft.loads]]",
        r"type": "a bearing is named by case, preset or designation, or described in "
        "[bearings.bearing]",
    }

    name: str = option("", doc="name, for tables and files (default: A, B, C ...)")
    case: str = _source("file of its case (.toml)", file=True)
    preset: str = _source("preset that it is, in place of a case")
    designation: str = _source(
        "designation of the catalogue, in place of a case, as `flexcage new` reads it"
    )
    position: float = quantity(
        "mm", doc="plane of its ball centres, or middle of its rollers, from the shaft's left end",
        minimum=0.0,
    )  # fmt: skip
    facing: str = option(
        "+x", choices=FACINGS,
        doc="direction of the shaft's push that it bears: of an angular contact bearing, of a "
        "single rib",
    )  # fmt: skip
    axial_offset: float = quantity(
        "um", 0.0, doc="how far its inner ring is pressed towards facing before the machine is "
        "loaded, as spacers or ground faces make it; > 0 preloads, < 0 leaves play",
    )  # fmt: skip
    preload_force: float | None = quantity(
        "N", None, doc="axial force that its offset makes in it alone, at rest and unmounted, in "
        "place of axial_offset", minimum=0.0,
    )  # fmt: skip
    axial_seat: str = option(
        "fixed", choices=SEATS, doc="is its outer ring held along the axis, or does it slide?"
    )
    spring_force: float = quantity(
        "N", 0.0, doc="force of a spring that presses a floating outer ring against its elements",
        minimum=0.0, when={"axial_seat": ("floating",)},
    )  # fmt: skip
    spring_stiffness: float = quantity(
        "N/um", 0.0, doc="stiffness of that spring; 0: its force is constant", minimum=0.0,
        when={"spring_force": GIVEN},
    )  # fmt: skip
    damping: float = quantity(
        "N*s/m", 0.0, doc="radial damping, for the unbalance response", minimum=0.0
    )

    @property
    def reversed(self) -> bool:
        """Does it face -x?"""
        return self.facing == "-x"

    @property
    def floats(self) -> bool:
        """May its outer ring slide along the axis?"""
        return self.axial_seat == "floating"

    @property
    def mirror(self) -> np.ndarray:
        """Signs (5,) of x, y, z and tilts in the bearing's own axes: one that faces -x is seen in
        a mirror across the axis, which turns x and both tilts round."""
        sign = -1.0 if self.reversed else 1.0
        return np.array([sign, 1.0, 1.0, sign, sign])


@dataclass(frozen=True, kw_only=True)
class Housing(BodyFile):
    """One elastic body with the seats of several bearings, in the machine's axes and held to the
    ground: every bearing without a [bearings.mount] of its own sits in it, where its nodes are."""

    elsewhere: ClassVar[Mapping[str, str]] = {
        r"stiffness|kind|mass|damping": "a seat of given stiffness is [bearings.mount] with kind = "
        '"bushing"',
    }

    seat_tie: str = option(
        "rigid", choices=("rigid", "average"), when={"body": GIVEN},
        doc="'rigid': a seat's nodes move as its ring does (RBE2); 'average': the ring moves as "
        "they do on average (RBE3)",
    )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Whirl:
    """Speeds over which the linearised machine is told: natural frequencies and unbalance."""

    highest: float | None = quantity(
        "rpm", None, doc="highest speed of the Campbell diagram and of the unbalance response "
        "(default: one and a half times drive.speed)", above=0.0,
    )  # fmt: skip
    stiffness: str = option(
        "here", choices=("here", "each_speed"),
        doc="the bearings' stiffness at the machine's speed, or solved anew at each",
    )  # fmt: skip
    points: int = option(31, doc="speeds from rest to there", minimum=2, maximum=2000)
    modes: int = option(6, doc="natural frequencies that are told", minimum=1, maximum=40)
