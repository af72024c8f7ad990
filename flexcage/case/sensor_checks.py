"""Do the sensors of a case fit the case and themselves? One sentence each."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from flexcage.case.read import read_case
from flexcage.case.sections import CaseSections
from flexcage.core.binding import Binder, check_spec, expect, path_of
from flexcage.core.errors import InputError
from flexcage.core.spec import option
from flexcage.core.units import describe
from flexcage.geometry.cage import Cage
from flexcage.results.registry import TIME_HF
from flexcage.results.signals.chain import ratio
from flexcage.results.signals.sources import grid_of
from flexcage.results.signals.spec import (
    ALONG,
    CAGE,
    HOUSING,
    OF_A_CHAIN,
    OUTER,
    Laser,
    Sensor,
    StrainGauge,
    Tacho,
)

Finding = tuple[str, str]  # where, sentence


def checked_sensors(case: CaseSections, sensors: Sequence[Sensor]) -> tuple[Sensor, ...]:
    """Sensors for a run of the case; InputError for the first thing wrong with them."""
    given = (sensors,) if isinstance(sensors, Sensor) else tuple(sensors)
    for i, sensor in enumerate(given):
        expect(sensor, Sensor, f"sensors.{i}", "flexcage.spec has Accelerometer and the like")
        check_spec(sensor, f"sensors.{i}")
    for where, sentence in find_in_sensors(case, given):
        raise InputError(sentence, where=where)
    return given


def load_sensors(path: str | Path) -> tuple[Sensor, ...]:
    """The [[sensors]] of a TOML file, which may be a case or hold nothing else. InputError for a
    file without any."""
    table, _ = read_case(path_of(path, "sensors"))
    listed = table.get("sensors", [])
    if not listed:
        raise InputError(
            f"'{path}' has no [[sensors]]; give some, as in examples/signals.md.", where="sensors"
        )
    found: tuple[Sensor, ...] = Binder().bind(_Listed, {"sensors": listed}, "").sensors
    return found


@dataclass(frozen=True, kw_only=True)
class _Listed:
    """Sensors alone."""

    sensors: tuple[Sensor, ...] = option(doc="sensors")


def find_in_sensors(
    case: CaseSections, sensors: Sequence[Sensor] | None = None
) -> Iterator[Finding]:
    """What is wrong with the case's sensors, or with others for it."""
    names: list[str] = []
    for i, sensor in enumerate(case.sensors if sensors is None else sensors):
        where = f"sensors.{i}"
        if not sensor.named_well:
            yield (
                f"{where}.name",
                f"{where}.name is '{sensor.name}', but should be a word of letters, digits and "
                "underscores that does not begin with 'time'.",
            )
        if sensor.name in names:
            yield (
                f"{where}.name",
                f"{where}.name is '{sensor.name}', as that of sensors.{names.index(sensor.name)}; "
                "give each sensor a name of its own.",
            )
        names.append(sensor.name)
        yield from _in_place(case, sensor, where)
        yield from _in_rates(case, sensor, where)
        yield from _in_chain(sensor, where)


def _in_place(case: CaseSections, sensor: Sensor, where: str) -> Iterator[Finding]:
    if sensor.place == CAGE and case.cages > 1:
        yield (
            f"{where}.place",
            f"{where} is on the cage, but each row has one (cage.rows is 'each'); leave it out.",
        )
    if sensor.place == CAGE and case.cage is None:
        yield (
            where,
            f"{where} ('{sensor.name}') is on the cage, but the bearing has none: cage.model is "
            "'none'; leave the sensor out, or give it another place.",
        )
    if sensor.place == OUTER and sensor.type == "accelerometer" and getattr(sensor, "axial", False):
        yield (
            f"{where}.axial",
            f"{where} ('{sensor.name}') reads along the axis, but the outer ring's acceleration is "
            "recorded across it; give a direction instead.",
        )
    if sensor.place == HOUSING:
        yield from _on_housing(case, sensor, where)
    if isinstance(sensor, StrainGauge) and case.cage is not None:
        yield from _on_surface(case, sensor, case.cage, where)
    if isinstance(sensor, Laser) and case.cage is not None:
        half = 0.5 * case.cage.width
        if abs(sensor.plane) > half:
            yield (
                f"{where}.plane",
                f"{where}.plane is {describe(sensor.plane, 'mm')}, but the cage ends at "
                f"{describe(half, 'mm')}; give a plane on the cage.",
            )


def _on_housing(case: CaseSections, sensor: Sensor, where: str) -> Iterator[Finding]:
    if not case.mount.body:
        yield (
            where,
            f"{where} ('{sensor.name}') is on a node of the housing, but the case has none: give "
            "mount.body, or the sensor another place.",
        )
    elif not getattr(sensor, "node", 1):
        yield (
            f"{where}.node",
            f"{where} ('{sensor.name}') is on the housing; give the number of its node there "
            "(node).",
        )


def _on_surface(
    case: CaseSections, gauge: StrainGauge, cage: Cage, where: str
) -> Iterator[Finding]:
    if case.cage_model == "rigid":
        yield (
            where,
            f"{where} ('{gauge.name}') is a strain gauge, but a rigid cage has no strain; run the "
            "case with cage.model = 'flexible', or leave the sensor out.",
        )
    count = case.bearing.element_count
    if gauge.crossbeam is not None and gauge.crossbeam >= count:
        yield (
            f"{where}.crossbeam",
            f"{where}.crossbeam is {gauge.crossbeam}, but the cage's crossbeams are numbered 0 to "
            f"{count - 1}.",
        )
    if gauge.along not in ALONG[gauge.side]:
        yield (
            f"{where}.along",
            f"{where}.along is '{gauge.along}', but a gauge on the side '{gauge.side}' lies "
            f"{' or '.join(ALONG[gauge.side])}.",
        )
    if gauge.radius and not 0.5 * cage.bore <= gauge.radius <= 0.5 * cage.outside_diameter:
        yield (
            f"{where}.radius",
            f"{where}.radius is {describe(gauge.radius, 'mm')}, but the cage reaches from "
            f"{describe(0.5 * cage.bore, 'mm')} to {describe(0.5 * cage.outside_diameter, 'mm')}.",
        )


def _in_rates(case: CaseSections, sensor: Sensor, where: str) -> Iterator[Finding]:
    fine = grid_of(sensor) == TIME_HF
    key = "output.vibration_rate" if fine else "output.rate"
    source = case.output.vibration_rate if fine else case.output.rate
    if sensor.rate > source * (1.0 + 1e-9):
        yield (
            f"{where}.rate",
            f"{where}.rate is {describe(sensor.rate, 'kHz')}, but the run records what it sees at "
            f"{describe(source, 'kHz')}; raise {key}, or give a lower rate.",
        )
        return
    own = sensor.rate or source
    try:
        ratio(source, own)
    except InputError as exc:
        yield f"{where}.rate", f"{where}: {exc}"
        return
    if 2.0 * sensor.low_pass >= own:
        yield (
            f"{where}.rate",
            f"The rate of {where} ('{sensor.name}') is {describe(own, 'kHz')}, which must be more "
            f"than twice its band, that ends at {describe(sensor.low_pass, 'kHz')} (low_pass).",
        )
    for name in ("high_pass", "resonance"):
        value = getattr(sensor, name)
        if 2.0 * value >= source:
            yield (
                f"{where}.{name}",
                f"{where}.{name} is {describe(value, 'kHz')}, but the run records what the sensor "
                f"sees at {describe(source, 'kHz')}, which shows less than half of that; raise "
                f"{key}, or give a lower one.",
            )


def _in_chain(sensor: Sensor, where: str) -> Iterator[Finding]:
    if 0.0 < sensor.low_pass <= sensor.high_pass:
        yield (
            f"{where}.high_pass",
            f"The band of {where} ('{sensor.name}') begins at "
            f"{describe(sensor.high_pass, 'Hz')} (high_pass) and ends at "
            f"{describe(sensor.low_pass, 'Hz')} (low_pass), but must rise.",
        )
    if isinstance(sensor, Tacho):
        idle = next((k for k, v in OF_A_CHAIN.items() if getattr(sensor, k) != v), None)
        if idle:
            yield (
                f"{where}.{idle}",
                f"{where}.{idle} is given, but a tacho's pulses pass no filter and no converter; "
                "leave it out.",
            )
    elif sensor.bits and not sensor.range:
        yield (
            f"{where}.bits",
            f"{where}.bits is {sensor.bits}, but the range that its steps divide is not given; "
            f"give {where}.range.",
        )
