"""What a recording is of: fault, severity, bearing, speed and load, as ``bearing-datasets`` names
them."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, pi

from flexcage.case import Case
from flexcage.core.hashing import content_hash

PLACE = "test_bearing"  # where faults and sensors are, of the schema's places
NORMAL, CAGE = "normal", "cage"
_SPOTS = ("ball_spot", "roller_spot")  # keys of bearings
_SPALLS = {"inner": "inner_spall", "outer": "outer_spall"}
_PER_TURN = 30.0 / pi


@dataclass(frozen=True)
class Fault:
    """Faults of a case, of the schema's kinds, and the size [m] of the largest; 0: none has."""

    kinds: tuple[str, ...]
    size: float = 0.0

    @property
    def name(self) -> str:
        """Kinds joined by "+", or "normal"."""
        return "+".join(self.kinds) or NORMAL

    @property
    def place(self) -> str:
        """A place for every kind, or "none"."""
        return "+".join(PLACE for _ in self.kinds) or "none"


def fault_of(case: Case) -> Fault:
    """Faults of races, of an element, and of the cage: defects and unbalance."""
    found: dict[str, float] = {}
    for kind, key in _SPALLS.items():
        if (length := getattr(getattr(case.bearing, key, None), "length", 0.0)) > 0.0:
            found[kind] = length
    for key in _SPOTS:
        if (size := getattr(getattr(case.bearing, key, None), "size", 0.0)) > 0.0:
            found["rolling_element"] = size
    if case.cage is not None and (case.defects or case.cage.unbalance > 0.0):
        found[CAGE] = max((defect.extent(case.cage) for defect in case.defects), default=0.0)
    return Fault(tuple(found), max(found.values(), default=0.0))


def cage_faults(case: Case) -> str:
    """Kinds of the cage's faults as cases name them, joined by "+"; "none" of a sound one."""
    if case.cage is None:
        return "none"
    kinds = [defect.type for defect in case.defects]
    kinds += ["unbalance"] if case.cage.unbalance > 0.0 else []
    return "+".join(dict.fromkeys(kinds)) or "none"


def level_of(fault: Fault, edges: Sequence[float]) -> int:
    """Severity: 0 of a sound bearing; then 1 up to the first of rising ``edges`` [m], and so on; 1
    without edges, and of a fault without a size."""
    if not fault.kinds:
        return 0
    return 1 + sum(fault.size > edge for edge in edges)


def severity_of(fault: Fault, edges: Sequence[float]) -> str:
    """The severity of a fault in words, as the schema has them."""
    if not fault.kinds:
        return "none"
    if not edges or not fault.size:
        return "not graded"
    return severity_words(level_of(fault, edges), edges)


def severity_words(level: int, edges: Sequence[float]) -> str:
    """The range of sizes that a severity from 1 on holds."""
    ends = [f"{1e3 * edge:.4g} mm" for edge in edges]
    if level == 1:
        return f"up to {ends[0]}"
    return f"above {ends[-1]}" if level > len(ends) else f"{ends[level - 2]} to {ends[level - 1]}"


def bearing_id(case: Case) -> str:
    """Name of the physical bearing: the same for equal geometry, whatever drives and loads it."""
    made = content_hash(case.bearing, case.fit, case.cage, case.defects, case.seed)
    return f"{case.bearing.designation or 'bearing'}_{made[:8]}"


def load_words(case: Case) -> str:
    """The load in a few words, by which records are grouped."""
    load = case.load
    words = f"{load.radial:.4g} N radial, {load.axial:.4g} N axial"
    if (moment := hypot(load.moment_y, load.moment_z)) > 0.0:
        words += f", {moment:.4g} N m"
    changes = load.ramp_to is not None or bool(load.times) or load.wave != "none"
    return f"{words}, varying" if changes else words


def speed_profile(case: Case) -> str:
    """Of the schema's profiles: constant, increasing, decreasing or varying."""
    drive = case.drive
    if drive.times or drive.wave != "none":
        return "varying"
    if drive.ramp_to is None or drive.ramp_to == drive.speed:
        return "constant"
    return "increasing" if abs(drive.ramp_to) > abs(drive.speed) else "decreasing"


def condition(case: Case) -> str:
    """Speed and load in a few words: the operating regime."""
    return f"{case.speed * _PER_TURN:.5g} rpm, {load_words(case)}"


def noise_of(case: Case) -> int:
    """A seed that no other case has: so that no two recordings share their noise."""
    return int(case.hash[:7], 16)


def with_own_noise(case: Case) -> tuple:
    """The case's sensors with seeds of this case alone."""
    return tuple(
        dataclasses.replace(sensor, seed=sensor.seed + noise_of(case)) for sensor in case.sensors
    )
