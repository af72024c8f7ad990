"""Specs of what drives, loads and holds the bearing, as functions of time."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import pi
from typing import ClassVar

import numpy as np

from flexcage.core.body_file import BodyFile
from flexcage.core.spec import ABSENT, GIVEN, option, quantity
from flexcage.core.units import describe
from flexcage.geometry.bearing import Bearing
from flexcage.geometry.other_kinds import SURROUNDINGS

_WAVE = {"wave": ("sine", "triangle", "rectangle")}  # a wave's values are read with a shape
_CHANGES = ({"ramp_to": GIVEN}, {"times": GIVEN})

#: Shapes, and the share of the period that each takes from zero to its amplitude.
WAVES = {"none": 0.0, "sine": 0.0, "triangle": 0.25, "rectangle": 0.01}


@dataclass(frozen=True, kw_only=True)
class Wave:
    """A periodic part of a speed or load: zero at t = 0, then rising to its amplitude.

    ``rectangle`` takes a hundredth of its period from zero to the amplitude: a jump of speed would
    want an infinite torque.
    """

    elsewhere: ClassVar[Mapping[str, str]] = SURROUNDINGS

    wave: str = option("none", doc="shape of a wave", choices=tuple(WAVES))
    wave_period: float = quantity("s", 0.0, doc="its period", minimum=0.0, when=_WAVE)


@dataclass(frozen=True, kw_only=True)
class Drive(Wave):
    """Rotation of the inner ring: prescribed, or through a compliant shaft.

    ``speed`` holds from the start, unless ``ramp_to`` with either ``ramp_time`` or ``acceleration``
    gives a linear ramp that begins at ``ramp_start``, or ``times`` and ``speeds`` give a table
    (linear between points).
    """

    speed: float = quantity(
        "rpm", 6000 * 2 * pi / 60, doc="inner ring speed (negative: reversed)",
        when={"times": ABSENT},
    )  # fmt: skip
    ramp_to: float | None = quantity("rpm", None, doc="speed at the end of a ramp")
    ramp_start: float = quantity(
        "s", 0.0, doc="start of the ramp", minimum=0.0, when={"ramp_to": GIVEN}
    )
    ramp_time: float = quantity("s", 0.0, doc="length of the ramp", minimum=0.0)
    acceleration: float | None = quantity(
        "rad/s^2", None, doc="change of speed per second along the ramp, up or down", above=0.0
    )
    times: tuple[float, ...] = quantity("s", (), doc="table: times")
    speeds: tuple[float, ...] = quantity("rpm", (), doc="table: speeds")
    wave_amplitude: float = quantity("rpm", 0.0, doc="amplitude of the wave")
    kind: str = option("prescribed", doc="how it is driven", choices=("prescribed", "shaft"))
    shaft_stiffness: float = quantity(
        "N*m/rad", 1e4, doc="torsional stiffness", above=0.0, when={"kind": ("shaft",)}
    )
    shaft_damping: float = quantity(
        "N*m*s/rad", 1.0, doc="torsional damping", minimum=0.0, when={"kind": ("shaft",)}
    )

    @property
    def at_start(self) -> float:
        """Speed [rad/s] at t = 0, where a ramp begins at the earliest and a wave is zero."""
        return float(np.interp(0.0, self.times, self.speeds)) if self.times else self.speed

    @property
    def ramp_length(self) -> float:
        """Length of the ramp [s], as given or from its acceleration."""
        if self.ramp_to is None or self.acceleration is None:
            return self.ramp_time
        return abs(self.ramp_to - self.speed) / self.acceleration


@dataclass(frozen=True, kw_only=True)
class Load(Wave):
    """Load on the inner ring, its misalignment, and gravity.

    A ramp or a table is of the load that ``varies`` names, a wave of that which ``wave_of`` names.
    What is held is borne by a reaction; a centre is held where the loads put it at the start.
    A compliant shaft holds the ring by springs and dampers between it and its held axial position
    (``axial_stiffness``), or its misalignment (``tilt_stiffness``, where ``tilt`` is "free").
    """

    radial: float = quantity("N", 0.0, doc="radial load", minimum=0.0)
    direction: float = quantity("deg", 0.0, doc="azimuth of the load, from y towards z")
    axial: float = quantity("N", 0.0, doc="axial load, along +x")
    moment_y: float = quantity("N*m", 0.0, doc="moment about y")
    moment_z: float = quantity("N*m", 0.0, doc="moment about z")
    varies: str = option(
        "radial",
        doc="load that ramps, or that the table gives",
        choices=("radial", "axial"),
        when=_CHANGES,
    )
    ramp_to: float | None = quantity("N", None, doc="load at the end of a ramp")
    ramp_start: float = quantity(
        "s", 0.0, doc="start of the ramp", minimum=0.0, when={"ramp_to": GIVEN}
    )
    ramp_time: float = quantity("s", 0.0, doc="length of the ramp", minimum=0.0)
    times: tuple[float, ...] = quantity("s", (), doc="table: times")
    values: tuple[float, ...] = quantity("N", (), doc="table: loads")
    wave_amplitude: float = quantity("N", 0.0, doc="amplitude of the wave")
    wave_of: str = option(
        "radial", doc="load that has a wave", choices=("radial", "axial"), when=_WAVE
    )
    tilt: str = option(
        "held", doc="is the inner ring held in tilt, or free?", choices=("held", "free")
    )
    axial_stiffness: float = quantity(
        "N/m", 0.0, doc="axial stiffness of the shaft; 0: none", minimum=0.0
    )
    axial_damping: float = quantity("N*s/m", 0.0, doc="axial damping of the shaft", minimum=0.0)
    tilt_stiffness: float = quantity(
        "N*m/rad", 0.0, doc="stiffness of the shaft in tilt; 0: none", minimum=0.0
    )
    tilt_damping: float = quantity(
        "N*m*s/rad", 0.0, doc="damping of the shaft in tilt", minimum=0.0
    )
    centre: str = option(
        "free", doc="does the inner ring's centre move, or is it held?", choices=("free", "held")
    )
    misalignment: float = quantity("mrad", 0.0, doc="tilt about z at which the ring is held")
    gravity: float = quantity("m/s^2", 9.80665, doc="acceleration of gravity", minimum=0.0)
    gravity_direction: float = quantity(
        "deg", 0.0, doc="azimuth of gravity", when={"gravity": GIVEN}
    )
    shaft_mass: float = quantity("kg", 0.0, doc="mass that moves with the inner ring", minimum=0.0)

    @property
    def axial_range(self) -> tuple[float, float]:
        """Least and largest axial load [N] of a run."""
        values = [self.axial]
        if self.varies == "axial":
            values = list(self.values) or [self.axial]
            values += [] if self.ramp_to is None else [self.ramp_to]
        fluctuation = abs(self.wave_amplitude) * (self.wave != "none" and self.wave_of == "axial")
        return min(values) - fluctuation, max(values) + fluctuation

    def frees_axially(self, bearing: Bearing) -> bool:
        """Is the inner ring free along the axis in a run: by a spring of the shaft, or by elements
        that bear the load?"""
        return self.axial_stiffness > 0.0 or bearing.free_axially(any(self.axial_range))

    @property
    def stiffness(self) -> tuple[float, float, float]:
        """Of the shaft: axial [N/m], in tilt about y and z [N m/rad]."""
        return self.axial_stiffness, self.tilt_stiffness, self.tilt_stiffness

    @property
    def damping(self) -> tuple[float, float, float]:
        """Of the shaft: axial [N s/m], in tilt about y and z [N m s/rad]."""
        return self.axial_damping, self.tilt_damping, self.tilt_damping

    def held_in_words(self, *, axially: bool, tilt: str | None = None) -> str:
        """How the inner ring is held: is it free ``axially``, and is its ``tilt`` "free" or "held"
        (by default, as this load says)?"""
        tilt = tilt or self.tilt
        ways = {
            "radial motion": self.centre == "free",
            "axial motion": axially,
            "tilt": tilt == "free",
        }
        angle = describe(self.misalignment, "mrad") if self.misalignment else "0"
        held = [way for way, free in ways.items() if not free]
        if tilt == "held":
            held[-1] = f"tilt {angle} (load.tilt)"
        springs = {
            "axial": describe(self.axial_stiffness, "N/um") if self.axial_stiffness else "",
            "tilt": describe(self.tilt_stiffness, "N*m/rad")
            if self.tilt_stiffness and tilt == "free"
            else "",
        }
        shaft = [f"{way} {stiffness}" for way, stiffness in springs.items() if stiffness]
        parts = [
            f"{word}: {', '.join(named)}"
            for word, named in (
                ("free", [way for way, free in ways.items() if free]),
                ("held", held),
                ("shaft stiffness", shaft),
            )
            if named
        ]
        return "; ".join(parts)

    @property
    def at_start(self) -> tuple[float, float]:
        """Radial and axial load [N] at t = 0, where ramps begin at the earliest and waves are 0."""
        if not self.times:
            return self.radial, self.axial
        value = float(np.interp(0.0, self.times, self.values))
        return (value, self.axial) if self.varies == "radial" else (self.radial, value)


_ELASTIC = ("bushing", "contact")


@dataclass(frozen=True, kw_only=True)
class Mount(BodyFile):
    """How the outer ring is held: fixed, or in a housing.

    ``bushing``: an elastic ring between both, of equal stiffness in y and z, and if the case gives
    these with stiffnesses along the axis and in tilt; else it holds the ring there. ``contact``:
    the ring lies in a bore that is larger by ``clearance``; spring and damper act along the line
    of centres while it touches, and never pull. ``body``: the ring moves with the seat of an
    elastic housing in x, y, z and both tilts (``system.seat``), in a run with its mass.
    """

    elsewhere: ClassVar[Mapping[str, str]] = SURROUNDINGS

    kind: str = option("fixed", doc="outer ring support", choices=("fixed", "bushing", "contact"))
    mass: float = quantity(
        "kg", 0.0, doc="housing mass that moves with the ring", minimum=0.0,
        when=({"body": GIVEN}, {"kind": _ELASTIC}),
    )  # fmt: skip
    stiffness: float = quantity(
        "N/m", 2e8, doc="stiffness of the housing", above=0.0, when={"kind": _ELASTIC}
    )
    damping: float = quantity(
        "N*s/m", 2e3, doc="damping of the housing", minimum=0.0, when={"kind": _ELASTIC}
    )
    axial_stiffness: float = quantity(
        "N/m", 0.0, doc="axial stiffness of a bushing; 0: it holds the ring along the axis",
        minimum=0.0, when={"kind": ("bushing",)},
    )  # fmt: skip
    axial_damping: float = quantity(
        "N*s/m", 0.0, doc="axial damping of the bushing", minimum=0.0,
        when={"axial_stiffness": GIVEN},
    )  # fmt: skip
    tilt_stiffness: float = quantity(
        "N*m/rad", 0.0, doc="stiffness of a bushing in tilt, about y and z; 0: it holds the ring "
        "in tilt",
        minimum=0.0, when={"kind": ("bushing",)},
    )  # fmt: skip
    tilt_damping: float = quantity(
        "N*m*s/rad", 0.0, doc="damping of the bushing in tilt", minimum=0.0,
        when={"tilt_stiffness": GIVEN},
    )  # fmt: skip
    clearance: float = quantity(
        "um", 10e-6, doc="radial clearance of the bore", minimum=0.0, when={"kind": ("contact",)}
    )
    seat: str = option(
        "",
        doc="set of nodes of body_nodes at the ring's seat; by default all nodes of the body that "
        "have coordinates",
        when={"body": GIVEN},
    )
    seat_tie: str = option(
        "rigid",
        doc="'rigid': the seat's nodes move as the ring does (RBE2); 'average': the ring moves as "
        "they do on average (RBE3)",
        choices=("rigid", "average"),
        when={"body": GIVEN},
    )


#: Kinds of constraints, and the spec that each brings along; ``system.constraints`` registers
#: further ones.
CONSTRAINTS: dict[str, type | None] = {}


@dataclass(frozen=True, kw_only=True)
class Constraint:
    """What holds or moves rings and cage beside drive, load and mount: g(q, t) = 0, or
    h(q, u, t) = 0 of velocities; ``type`` picks one of the kinds below."""

    type: str = option(doc="kind of constraint", choices=CONSTRAINTS)


@dataclass(frozen=True, kw_only=True)
class CageSpeed(Constraint):
    """The cage turns about its own axis at ``speed`` + ``ratio`` times the inner ring's speed."""

    type: str = option("cage_speed", doc="kind of constraint", choices=CONSTRAINTS)
    speed: float = quantity("rpm", 0.0, doc="speed of the cage that is given")
    ratio: float = option(
        0.0, doc="share of the inner ring's speed that is added", minimum=-100.0, maximum=100.0
    )


@dataclass(frozen=True, kw_only=True)
class CageCentre(Constraint):
    """The cage's frame stays with its origin at (y, z): it neither whirls nor rides on a land."""

    type: str = option("cage_centre", doc="kind of constraint", choices=CONSTRAINTS)
    y: float = quantity("um", 0.0, doc="where along y")
    z: float = quantity("um", 0.0, doc="where along z")


@dataclass(frozen=True, kw_only=True)
class InnerPath(Constraint):
    """The inner ring's centre moves on a circle about (y, z), as a rotor that whirls would have
    it: at azimuth ``phase`` at t = 0, from y towards z, and on at ``speed``."""

    type: str = option("inner_path", doc="kind of constraint", choices=CONSTRAINTS)
    y: float = quantity("um", 0.0, doc="centre of the circle along y")
    z: float = quantity("um", 0.0, doc="centre of the circle along z")
    radius: float = quantity("um", 0.0, doc="radius of the circle", minimum=0.0)
    speed: float = quantity("rpm", 0.0, doc="speed along it (negative: from z towards y)")
    phase: float = quantity("deg", 0.0, doc="azimuth at t = 0")


@dataclass(frozen=True, kw_only=True)
class CageTilt(Constraint):
    """The cage's axis stays parallel to the bearing's: three translations and one rotation are left
    to it. (Of a flexible cage, the axis of its frame.)"""

    type: str = option("cage_tilt", doc="kind of constraint", choices=CONSTRAINTS)


CONSTRAINTS.update(
    cage_speed=CageSpeed, cage_centre=CageCentre, cage_tilt=CageTilt, inner_path=InnerPath
)


MOST_PUSH = 10.0  # m/s, a hundred times the speeds of cages within their clearances


@dataclass(frozen=True, kw_only=True)
class StartOptions:
    """How the start departs from equilibrium: the cage moves off in a random direction.

    A speed, unlike an offset, leaves every contact as the equilibrium found it, so that it suits
    a pinched cage as well. ``seed`` picks the azimuth; rolling elements and rings stay the same.
    """

    push: float = quantity(
        "mm/s", 0.0, doc="speed of the cage centre at the start", minimum=0.0, maximum=MOST_PUSH
    )
    seed: int = option(
        0, doc="seed of the push's azimuth, uniform over the circle", minimum=0,
        when={"push": GIVEN},
    )  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class Limits:
    """Limits beyond which a start is refused rather than warned about."""

    stress: float | None = quantity(
        "MPa",
        None,
        doc="greatest stress of a cage by rollers that it pinches when assembled",
        above=0.0,
    )
    assembly_force: float = quantity("N", 2e4, doc="greatest pinch force", above=0.0)
