"""The sensors of a case: where each sits, and what its measuring chain does to what it sees."""

from __future__ import annotations

import re
from collections.abc import Mapping
from dataclasses import dataclass
from math import degrees
from typing import ClassVar

from flexcage.core.spec import GIVEN, option, quantity

#: Kinds of sensors, and the spec that each brings along.
SENSORS: dict[str, type | None] = {}

OUTER, INNER, CAGE, HOUSING = "outer_ring", "inner_ring", "cage", "housing"
_WORD = re.compile(r"[A-Za-z]\w*")
_ELSEWHERE = {
    "shaft|inner": "the shaft moves with the inner ring: take 'inner_ring'",
    "outer": "take 'outer_ring'",
    "housing.+|mount|casing|body": "take 'housing' with a node of mount.body, or 'outer_ring', "
    "which moves with its seat there",
}


@dataclass(frozen=True, kw_only=True)
class Sensor:
    """One sensor and its measuring chain; ``type`` picks one of the kinds below.

    What it sees passes a resonance, a high-pass and a low-pass filter, is sampled at ``rate``
    behind an anti-aliasing filter, gets noise, and is read as one of 2^``bits`` steps of its range.
    """

    type: str = option(doc="kind of sensor", choices=SENSORS)
    name: str = option(doc="name of its signal: letters, digits and underscores")
    rate: float = quantity(
        "kHz", 0.0, doc="samples a second; 0: as the run records what it sees", minimum=0.0
    )
    anti_alias: bool = option(
        True, doc="a linear-phase filter, 80 dB down from half the rate on, before the samples",
        when={"rate": GIVEN},
    )  # fmt: skip
    resonance: float = quantity(
        "kHz", 0.0, doc="its own frequency as a mass on a spring; 0: none", minimum=0.0
    )
    damping_ratio: float = option(
        0.02, doc="damping of the resonance over critical", minimum=1e-4, maximum=2.0,
        when={"resonance": GIVEN},
    )  # fmt: skip
    high_pass: float = quantity(
        "Hz", 0.0, doc="lower end of its band (Butterworth, order 2); 0: none", minimum=0.0
    )
    low_pass: float = quantity(
        "kHz", 0.0, doc="upper end of its band (Butterworth, order 4); 0: none", minimum=0.0
    )
    bits: int = option(0, doc="of its converter over the range; 0: none", minimum=0, maximum=32)
    seed: int = option(0, doc="seed of its noise", minimum=0)

    #: What is measured and in which SI unit; where it sits; how fine its noise is and how far it
    #: reads (0: none): values of the kinds that have them.
    measures: ClassVar[tuple[str, str]] = ("", "")
    place: ClassVar[str] = OUTER
    noise: ClassVar[float] = 0.0
    range: ClassVar[float] = 0.0
    by_motion: ClassVar[bool] = True

    @property
    def quantity(self) -> str:
        """What it measures."""
        return self.measures[0]

    @property
    def unit(self) -> str:
        """SI unit of its signal."""
        return self.measures[1]

    @property
    def towards(self) -> str:
        """Azimuth [deg] that it reads along, as text, or a word."""
        direction = getattr(self, "direction", None)
        if getattr(self, "axial", False):
            return "axial"
        return "none" if direction is None else f"{degrees(direction):g}"

    @property
    def named_well(self) -> bool:
        """Is its name a word that tables and MATLAB can have?"""
        return _WORD.fullmatch(self.name) is not None and not self.name.startswith("time")


def _direction() -> float:
    return quantity("deg", 0.0, doc="azimuth that it reads along, from y towards z")  # type: ignore


def _noise(unit: str) -> float:
    return quantity(  # type: ignore[no-any-return]
        f"{unit}/Hz^0.5", 0.0, doc="density of its noise", minimum=0.0
    )


def _range(unit: str) -> float:
    return quantity(  # type: ignore[no-any-return]
        unit, 0.0, doc="it reads up to this, either way; 0: without end", minimum=0.0
    )


def _axial() -> bool:
    return option(False, doc="does it read along the bearing axis?")  # type: ignore[no-any-return]


@dataclass(frozen=True, kw_only=True)
class Accelerometer(Sensor):
    """Acceleration of the outer ring at the vibration rate, of a node of the elastic housing
    ``mount.body``, or of the cage's centre along axes that turn with it (azimuth 0: pocket 0)."""

    type: str = option("accelerometer", doc="kind of sensor", choices=SENSORS)
    place: str = option(  # type: ignore[misc]
        OUTER, doc="what it sits on", choices=(OUTER, CAGE, HOUSING), elsewhere=_ELSEWHERE
    )
    node: int = option(
        0, doc="number of its node in the file of mount.body", minimum=0,
        when={"place": (HOUSING,)},
    )  # fmt: skip
    housing_damping: float = option(
        0.02, doc="damping of each of the housing's modes over critical", minimum=1e-3,
        maximum=1.0, assumption="bolted housings have 0.01 to 0.05", when={"place": (HOUSING,)},
    )  # fmt: skip
    direction: float = _direction()
    axial: bool = _axial()
    noise: float = _noise("m/s^2")  # type: ignore[misc]
    range: float = _range("m/s^2")  # type: ignore[misc]

    measures: ClassVar[tuple[str, str]] = ("acceleration", "m/s^2")


@dataclass(frozen=True, kw_only=True)
class Proximity(Sensor):
    """Displacement of the centre of the inner ring or of the cage as a probe on the outer ring sees
    it, or of the outer ring in space."""

    type: str = option("proximity", doc="kind of sensor", choices=SENSORS)
    place: str = option(  # type: ignore[misc]
        INNER, doc="what it looks at", choices=(INNER, OUTER, CAGE), elsewhere=_ELSEWHERE
    )
    direction: float = _direction()
    axial: bool = _axial()
    noise: float = _noise("um")  # type: ignore[misc]
    range: float = _range("um")  # type: ignore[misc]

    measures: ClassVar[tuple[str, str]] = ("displacement", "m")


@dataclass(frozen=True, kw_only=True)
class Laser(Sensor):
    """Distance to the cage's outside, from its reading of a centred cage: in a plane beside the
    cage's middle it sees tilt as well (``results.instrument``)."""

    type: str = option("laser", doc="kind of sensor", choices=SENSORS)
    direction: float = _direction()
    plane: float = quantity("mm", 0.0, doc="axial place of the beam, from the bearing's middle")
    spot: float = quantity("mm", 0.0, doc="width of its spot round the cage", minimum=0.0)
    noise: float = _noise("um")  # type: ignore[misc]
    range: float = _range("um")  # type: ignore[misc]

    measures: ClassVar[tuple[str, str]] = ("displacement", "m")
    place: ClassVar[str] = CAGE
    axial: ClassVar[bool] = False


#: Sides of a cage that a strain gauge may be on, and directions in which it may lie there.
ROUND, ENDS = ("outside", "inside"), ("+x", "-x")
ALONG: Mapping[str, tuple[str, ...]] = {
    **dict.fromkeys(ROUND, ("axial", "circumferential")),
    **dict.fromkeys(ENDS, ("circumferential", "radial")),
}


@dataclass(frozen=True, kw_only=True)
class StrainGauge(Sensor):
    """Strain of a flexible cage's surface, averaged along a line: the change of its length over
    its length (``stress.gauges``). It turns with the cage."""

    type: str = option("strain_gauge", doc="kind of sensor", choices=SENSORS)
    crossbeam: int | None = option(
        None, doc="crossbeam or web from whose middle its azimuth counts, between the pockets k-1 "
        "and k; by default from pocket 0",
        minimum=0,
    )  # fmt: skip
    azimuth: float = quantity("deg", 0.0, doc="where it is round the cage")
    side: str = option("outside", doc="surface that it is on", choices=tuple(ALONG))
    plane: float = quantity(
        "mm", 0.0, doc="axial place, from the elements' middle plane", when={"side": ROUND}
    )
    radius: float = quantity(
        "mm", 0.0, doc="distance from the cage's axis; 0: the middle between bore and outside",
        minimum=0.0, when={"side": ENDS},
    )  # fmt: skip
    along: str = option(
        "circumferential", doc="direction of its grid; on the outside or inside axial is along a "
        "crossbeam",
        choices=("axial", "circumferential", "radial"),
    )  # fmt: skip
    grid: float = quantity(
        "mm", 1e-3, doc="length of its grid, over which strain is averaged", above=0.0,
        assumption="foil gauges for small parts are 0.3 to 3 mm long",
    )  # fmt: skip
    noise: float = _noise("um/m")  # type: ignore[misc]
    range: float = _range("um/m")  # type: ignore[misc]

    measures: ClassVar[tuple[str, str]] = ("strain", "1")
    place: ClassVar[str] = CAGE

    @property
    def towards(self) -> str:
        """Direction of its grid."""
        return self.along


@dataclass(frozen=True, kw_only=True)
class Torque(Sensor):
    """Torque of the drive: its power over the inner ring's speed."""

    type: str = option("torque", doc="kind of sensor", choices=SENSORS)
    noise: float = _noise("N*mm")  # type: ignore[misc]
    range: float = _range("N*mm")  # type: ignore[misc]

    measures: ClassVar[tuple[str, str]] = ("torque", "N m")
    place: ClassVar[str] = INNER


@dataclass(frozen=True, kw_only=True)
class Tacho(Sensor):
    """Pulses of the inner ring: 1 in the first half of each, then 0. Filters, noise and bits are
    not for it."""

    type: str = option("tacho", doc="kind of sensor", choices=SENSORS)
    pulses: int = option(1, doc="pulses a turn", minimum=1, maximum=100_000)

    measures: ClassVar[tuple[str, str]] = ("tachometer", "1")
    place: ClassVar[str] = INNER


SENSORS.update(
    accelerometer=Accelerometer, proximity=Proximity, laser=Laser, strain_gauge=StrainGauge,
    torque=Torque, tacho=Tacho,
)  # fmt: skip

#: Keys of a measuring chain, which pulses do not pass.
OF_A_CHAIN: Mapping[str, object] = {
    "resonance": 0.0, "high_pass": 0.0, "low_pass": 0.0, "bits": 0, "anti_alias": True,
}  # fmt: skip
