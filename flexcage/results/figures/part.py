"""What figures of a run's motion and forces share: its settled part, each value computed once."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import InputError
from flexcage.results import metrics
from flexcage.results.audit import EnergyAudit, energy_audit
from flexcage.results.contact_activity import ContactSeries, contact_series
from flexcage.results.each_cage import cage_count, one_cage, own_events
from flexcage.results.figures.figure import CAGED, FULL, Figure, FigureTable
from flexcage.results.frequencies import SOUGHT, own_frequencies, run_frequencies
from flexcage.results.registry import NEIGHBOURS
from flexcage.results.slip import (
    BallRolling,
    BearingNumbers,
    MeanSpeed,
    SlipRange,
    at_own_angles,
    element_slip_ratio,
    element_spin,
    loaded_zone,
    rolling_by_curvature,
    speed_over,
)
from flexcage.results.statistics import Record, Windows, element_passes

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class OwnFigures:
    """What the summary of one family's bearings says beside what all do: figures of its own, which
    close their sections; how the section of its elements' ``slip`` is called, and which figures
    stand there in which order; and what the note on their ``sliding`` says."""

    tables: tuple[FigureTable[Any], ...]
    slip_title: str
    slip: tuple[str, ...]
    sliding: str

    @property
    def figures(self) -> Mapping[str, Figure]:
        """Its own figures by name."""
        return {key: figure for table in self.tables for key, figure in table.figures.items()}


@dataclass(frozen=True, eq=False)
class SettledRun:
    """A run, whose first ``settle`` of its duration figures leave out, and its bearing.

    ``events`` are the run's contacts that closed or opened; without them contacts are counted at
    samples. ``slip_range`` has sliding speeds of the friction law at races.
    """

    run: xarray.Dataset
    bearing: BearingNumbers
    settle: float = 0.3
    slip_range: SlipRange = SlipRange()
    events: xarray.Dataset | None = None

    @cached_property
    def each(self) -> tuple[SettledRun, ...]:
        """The same of each cage, with the elements in it; itself where there is one, or none."""
        count = cage_count(self.run)
        if count == 1:
            return (self,)
        return tuple(
            replace(self, run=one_cage(self.run, k), events=own_events(self.events, self.run, k))
            for k in range(count)
        )

    @cached_property
    def words(self) -> Mapping[str, str]:
        """Words of titles."""
        walls = "Pocket faces" if self.caged and self.ds.sizes["face"] > 1 else "Pockets"
        return {"element": self.element, "Element": self.element.capitalize(), "Faces": walls}

    @property
    def lacks(self) -> str:
        """What it has not of what figures need."""
        return FULL if self.caged else CAGED

    @cached_property
    def ds(self) -> xarray.Dataset:
        """Its settled part. InputError for a share that leaves none."""
        if not 0.0 <= self.settle < 1.0:
            raise InputError(
                f"settle must lie in 0 ... 1, not {self.settle}.", where="output.settle"
            )
        return metrics.settled(self.run, self.settle)

    @cached_property
    def caged(self) -> bool:
        """Has its bearing a cage?"""
        return metrics.caged(self.run)

    @cached_property
    def element(self) -> str:
        """Its rolling elements, in words: "roller", "ball"."""
        return metrics.element(self.run)

    @cached_property
    def of_family(self) -> OwnFigures:
        """What its family adds."""
        found: OwnFigures = metrics.family(self.run).figures()
        return found

    @property
    def pass_peak(self) -> str:
        """What the peak of a pass is, in words."""
        return pass_peak(self.element)

    @cached_property
    def windows(self) -> Windows:
        """Windows of a roller's pass of the settled part: ``windows.mean(values)`` has an interval
        (``results.statistics``)."""
        return element_passes(self.ds, self.bearing)

    @cached_property
    def whole(self) -> xarray.Dataset:
        """Whole turns of the cage in the settled part, or without one of the elements."""
        return metrics.whole_revolutions(self.ds)

    @cached_property
    def whole_windows(self) -> Windows:
        """Windows of these turns."""
        return element_passes(self.whole, self.bearing)

    # --- speeds

    @cached_property
    def own(self) -> BearingNumbers:
        """Its bearing, with the mean contact angles of loaded balls."""
        return at_own_angles(self.whole, self.bearing)

    @cached_property
    def inner_speed(self) -> float:
        """Mean speed of the inner ring [rad/s]."""
        return float(self.ds["inner_speed"].mean())

    @cached_property
    def speed(self) -> MeanSpeed:
        """Mean speed of the cage over whole turns, or without one of the elements' orbits."""
        return speed_over(self.whole, self.own)

    @cached_property
    def omega(self) -> np.ndarray:
        """That speed over time [rad/s], whole turns."""
        return metrics.carrier_speed(self.whole).values

    def slip(self, bearing: BearingNumbers) -> Record:
        """Slip ratio of the cage, or without one of the elements' orbits, against pure rolling."""
        ideal = self.whole["inner_speed"].values * bearing.kinematics(1.0).cage_speed
        return self.whole_windows.ratio(ideal - self.omega, ideal)

    @cached_property
    def rolling(self) -> BallRolling | None:
        """What the grooves' curvature makes of balls that roll."""
        return rolling_by_curvature(self.whole, self.own)

    @cached_property
    def spin(self) -> float:
        """Mean speed of the elements about their own axes [rad/s]."""
        return float(element_spin(self.ds).mean())

    @cached_property
    def frequencies(self) -> dict[str, float]:
        """Passing frequencies [Hz] by the mean speeds of whole turns, by name."""
        return own_frequencies(self.whole, self.bearing)

    @cached_property
    def nominal_frequencies(self) -> dict[str, float]:
        """Those of pure rolling at the nominal contact angle."""
        return run_frequencies(self.whole, self.bearing, own=False)

    @cached_property
    def vibration(self) -> tuple[str, Mapping[str, float]] | None:
        """The axis along which the outer ring's acceleration is larger, and its figures by name
        (``spectra.vibration_figures``); None of a run with too few samples, or none of the band."""
        from flexcage.results.spectra import SIGNALS, vibration_figures

        if SIGNALS["outer_envelope"].of(self.ds) is None:
            return None
        signal = self.ds["outer_acceleration"]
        axis = str(signal.std("time_hf").idxmax("axis2").values)
        lines = {name: line for name, line in self.frequencies.items() if name in SOUGHT}
        return axis, vibration_figures(signal.sel(axis2=axis), lines)

    # --- slip of elements, whole turns

    @cached_property
    def zone(self) -> np.ndarray:
        """Where the inner race carries an element (time, element)."""
        return loaded_zone(self.whole).transpose("time", "element").values

    @cached_property
    def sliding(self) -> np.ndarray:
        """Sliding speeds at both races (time, element, race) [m/s]."""
        return np.abs(self.whole["race_slip"].transpose("time", "element", "race").values)

    @cached_property
    def element_slip(self) -> tuple[Record, Record]:
        """Slip ratio of loaded and of unloaded elements, against pure rolling at ``own``."""
        ratio = element_slip_ratio(self.whole, self.own)
        return self.over(ratio, self.zone), self.over(ratio, ~self.zone)

    @cached_property
    def sliding_loaded(self) -> tuple[float, float]:
        """Mean sliding speeds [m/s] of loaded elements at inner and outer race."""
        return self._mean_sliding(self.zone)

    @cached_property
    def sliding_unloaded(self) -> tuple[float, float]:
        """Those of unloaded ones."""
        return self._mean_sliding(~self.zone)

    def _mean_sliding(self, where: np.ndarray) -> tuple[float, float]:
        if not where.any():
            return float("nan"), float("nan")
        inner, outer = (float(self.sliding[..., k][where].mean()) for k in range(2))
        return inner, outer

    def over(self, values: xarray.DataArray, where: np.ndarray) -> Record:
        """Mean of values where a mask holds (time, element)."""
        array = values.transpose("time", "element").values
        return self.whole_windows.ratio(np.where(where, array, 0.0).sum(axis=1), where.sum(axis=1))

    # --- motion of the cage

    @cached_property
    def about_mean(self) -> metrics.Whirl:
        """Whirl of its centre about the orbit's mean, whole turns."""
        return metrics.whirl(self.whole, about="mean")

    @cached_property
    def about_axis(self) -> metrics.Whirl:
        """Whirl of its centre about the outer ring's axis, whole turns."""
        return metrics.whirl(self.whole, about="axis")

    @cached_property
    def tilt(self) -> np.ndarray:
        """Tilt of its axis (time,) [rad]."""
        return metrics.tilt(self.ds).sel(component="total").values

    @cached_property
    def rate(self) -> str:
        """Samples a second, in words."""
        return f"{metrics.sampling_rate(self.ds) / 1e3:g} kHz"

    # --- forces

    @cached_property
    def pockets(self) -> metrics.PocketForces:
        """Normal forces on pocket faces: mean, peak and its place."""
        return metrics.pocket_forces(self.ds)

    @cached_property
    def pocket_series(self) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """Their sum, how many are in contact, and the largest, over time."""
        return metrics.pocket_force_series(self.ds)

    @cached_property
    def race_peaks(self) -> Mapping[str, float]:
        """Largest normal force of each race on an element [N]."""
        peaks = self.ds["race_force"].max("time")
        return {race: float(peaks.sel(race=race).max()) for race in ("inner", "outer")}

    @cached_property
    def contacts(self) -> ContactSeries:
        """Contacts of the cage that begin, and free flight, over time."""
        return contact_series(self.ds, self.events)

    @cached_property
    def neighbours(self) -> np.ndarray:
        """Normal forces of the next elements (time, element) [N]."""
        return self.ds[NEIGHBOURS].transpose("time", "element").values.astype(float)

    @cached_property
    def drive(self) -> np.ndarray | None:
        """Power of the drive over time [W]; None of a run that does not record it."""
        if "work" not in self.ds:
            return None
        return np.gradient(self.ds["work"].sel(channel="drive").values, self.ds["time"].values)

    def of_axes(self, name: str) -> np.ndarray:
        """A vector over time, axis by axis (3, time)."""
        return self.ds[name].transpose("axis", "time").values.astype(float)

    @cached_property
    def audit(self) -> EnergyAudit:
        """Energy audit of the whole run."""
        return energy_audit(self.run)


def pass_peak(element: str) -> str:
    """What the peak of a pass is, in words."""
    return f"mean of the largest in each {element} pass"
