"""Signals of a run's sensors: those that see what the run recorded, strain gauges on its cage, and
accelerometers on its elastic housing."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

import numpy as np

from flexcage._version import __version__
from flexcage.case import Case
from flexcage.case.sensor_checks import checked_sensors
from flexcage.modes.reduction import CageReduction
from flexcage.results.frequencies import own_frequencies
from flexcage.results.metrics import settled
from flexcage.results.signals.signals import signals_of
from flexcage.results.signals.spec import HOUSING, Accelerometer, Sensor, StrainGauge
from flexcage.stress.gauge_lines import gauge_rows

if TYPE_CHECKING:
    import xarray

    from flexcage.results.signals.housing import SensedHousing
    from flexcage.results.slip import BearingNumbers
    from flexcage.stress.run_stress import RunStress


def check_places(case: Case, cage: CageReduction | None) -> None:
    """InputError for a strain gauge that does not lie on the ``cage``, or an accelerometer on a
    node that the housing has not: before a run, rather than after it."""
    gauges = _gauges(case.sensors)
    if gauges and cage is not None:
        count = cage.pockets
        gauge_rows(cage.model, gauges, count, case.its_cage.mean_radius)
    if on_housing := _on_housing(case.sensors):
        housing = _housing(case)
        for sensor in on_housing:
            housing.check(sensor)


def run_signals(
    case: Case, ds: xarray.Dataset, numbers: BearingNumbers, sensors: Sequence[Sensor],
    stress: Callable[[], RunStress],
) -> xarray.Dataset:  # fmt: skip
    """Signals of these sensors in a run of the case, whatever sensors the case has
    (``results.signals``); ``stress`` gives that of its cage."""
    sensors = checked_sensors(case, sensors)
    rpm = float(ds["inner_speed"].mean()) * 30.0 / np.pi
    lines = own_frequencies(settled(ds, case.output.settle), numbers)
    attrs = {
        "case": case.name, "hash": case.hash, "bearing": case.mounted.bearing.designation,
        "flexcage": __version__, "speed (rpm)": rpm,
        **{f"{k} (Hz)": v for k, v in lines.items()},
    }  # fmt: skip
    computed = {}
    if on_housing := _on_housing(sensors):
        paths = _housing(case).paths(on_housing)
        computed = {s.name: path.acceleration(ds) for s, path in zip(on_housing, paths)}
    if gauges := _gauges(sensors):
        strains = stress().strains(gauges, case.its_cage.mean_radius)
        computed |= {gauge.name: own for gauge, own in zip(gauges, strains)}
    return signals_of(
        ds, sensors, cage=case.cage, settle=case.output.settle, attrs=attrs, computed=computed
    )


def _gauges(sensors: Sequence[Sensor]) -> list[StrainGauge]:
    return [sensor for sensor in sensors if isinstance(sensor, StrainGauge)]


def _on_housing(sensors: Sequence[Sensor]) -> list[Accelerometer]:
    return [s for s in sensors if isinstance(s, Accelerometer) and s.place == HOUSING]


def _housing(case: Case) -> SensedHousing:
    from flexcage.results.signals.housing import SensedHousing  # with readers of files

    bearing = case.mounted.bearing
    return SensedHousing.of(
        case.mount, diameter=bearing.outside_diameter, width=bearing.width,
        ring=(bearing.outer_ring_mass, *bearing.outer_ring_inertia),
    )  # fmt: skip
