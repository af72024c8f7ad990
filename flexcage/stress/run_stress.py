"""Stress of a flexible cage over one run: histories, whole fields, life, loads of rivets."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.binding import expect
from flexcage.core.cache import cached_arrays
from flexcage.core.errors import InputError
from flexcage.core.threads import one_blas_thread
from flexcage.core.timing import Stages
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.reduction import CageReduction
from flexcage.results.figures.stress import Stressed
from flexcage.results.metrics import carrier_angle, element, settled
from flexcage.results.signals.spec import StrainGauge
from flexcage.results.slip import BearingNumbers
from flexcage.results.statistics import element_passes
from flexcage.results.store import MemoryRunStore
from flexcage.stress.between import StoredSteps
from flexcage.stress.counting import require_pylife
from flexcage.stress.fatigue import Fatigue, chosen_places, counted_stress, place_fatigue
from flexcage.stress.fields import StressFields, TensorFields
from flexcage.stress.gauges import gauge_fields
from flexcage.stress.history import StressHistory, histories_at, stress_bound, stress_history
from flexcage.stress.loads import LandLoads, cage_loads
from flexcage.stress.mirrored import (
    Across,
    MirroredForces,
    mirrored_fields,
    mirrored_loads,
    mirrored_solid,
)
from flexcage.stress.operators import von_mises
from flexcage.stress.places import StressPlaces, in_words
from flexcage.stress.recovery import STRESS_VERSION, StressRecovery
from flexcage.stress.rivets import Joints, RivetFields, Rivets, rivet_loads
from flexcage.stress.series import as_time, samples_near
from flexcage.stress.sn_curves import SNCurve, check_curve, sn_curve

if TYPE_CHECKING:
    import xarray


@dataclass(frozen=True)
class StressField:
    """Displacement and stress of the whole cage at one instant, cage frame."""

    time: float  # [s]
    displacement: np.ndarray  # (n_nodes, 3) [m], at the FE model's nodes
    stress: np.ndarray  # (n_points, 6) [Pa] at mesh vertices: xx, yy, zz, xy, yz, xz

    @property
    def von_mises(self) -> np.ndarray:
        """Equivalent stress (n_points,) [Pa]."""
        return von_mises(self.stress)


def recovery_of(cage: CageReduction, places: StressPlaces) -> StressRecovery:
    """Stress recovery of a flexible cage, whose type has these ``places``; what it costs to prepare
    is kept in the cache."""

    def keep(name: str, make: Callable[[], dict[str, np.ndarray]]) -> dict[str, np.ndarray]:
        return cached_arrays("stress", f"{cage.version}-{STRESS_VERSION}-{name}", make)

    def make() -> StressRecovery:
        return StressRecovery(
            cage.model,
            cage.shown,
            cage.interface,
            places=places,
            solver=cage.solver,
            keep=keep,
        )

    return cage.once("recovery", make)


@dataclass(eq=False)
class RunStress:
    """Stress of a run's flexible cage, by mode acceleration.

    ``settle`` is the share of the run that is left out of figures; ``inner_land`` says whether land
    forces act on the cage's inner land. ``places`` are those of the cage's type. ``stages`` takes
    the time of the history. Where each row of elements has a cage, ``dataset`` is that of cage
    ``k`` (``results.each_cage``); the second one, and ``mesh``, are mirror images of ``cage``.
    """

    cage: CageReduction
    places: StressPlaces
    mesh: CageMesh
    dataset: xarray.Dataset
    store: MemoryRunStore
    numbers: BearingNumbers
    settle: float
    inner_land: bool
    stages: Stages
    k: int = 0

    @cached_property
    def recovery(self) -> StressRecovery:
        return recovery_of(self.cage, self.places)

    @cached_property
    def history(self) -> StressHistory:
        """Equivalent stress at named places, peaks, and the envelope over all samples."""
        return self.stages("stress", self._history)

    @one_blas_thread
    def _history(self) -> StressHistory:
        return stress_history(
            StressFields(self.recovery),
            *self._moved_and_pushed(self.dataset),
            settled=self._first_settled,
            between=self._between,
            progress=self.stages.progress,
        )

    @property
    def peak_time(self) -> float:
        """Time [s] of the largest equivalent stress of the settled part."""
        h = self.history
        between = float(h.peak_time[h.peak_sample])
        at_sample = float(self.dataset["time"].values[h.peak_sample])
        return at_sample if np.isnan(between) else between

    @property
    def peak_place(self) -> str:
        """Name of the followed place in which the peak is, or nothing."""
        h = self.history
        vertex = h.peak_vertex[h.peak_sample]
        for name, vertices in self.recovery.roots.items():
            if vertex in vertices:
                return in_words(name)
        return ""

    @one_blas_thread
    def at(self, time: float | str | None = None) -> StressField:
        """Stress of the whole cage at the sample, or the step kept between samples, nearest to
        ``time``; by default at the largest peak. InputError for a time outside the run."""
        t = self.dataset["time"].values
        wanted = self.peak_time if time is None else as_time(time)
        index = int(samples_near(t, [wanted])[0])
        instant = float(t[index])
        loads = cage_loads(self.dataset, index, inner=self.inner_land)
        if self._across is not None:
            loads = mirrored_loads(loads, self._across)
        step = self._between.nearest(wanted, index)
        if step is not None and abs(step.time[0] - wanted) < abs(instant - wanted):
            instant, loads = float(step.time[0]), step.cage_loads(loads.angular_velocity)
        u = self.recovery.displacement(loads)
        stress = self.recovery.stress(u, loads)
        if self._across is not None:
            u, stress = mirrored_fields(u, stress)
        return StressField(instant, u, stress)

    @property
    def solid(self) -> tuple[np.ndarray, np.ndarray]:
        """Nodes (N, 3) [m] and tetrahedra (n, 4 or 10) of the cage's finite elements."""
        model = self.cage.model
        if self._across is None:
            return model.nodes, model.cells
        return mirrored_solid(model.nodes, model.cells)

    @property
    def _across(self) -> Across | None:
        """How stations of the cage are those of its mirror image, if it is one."""
        return self.cage.interface.across if self.k else None

    @one_blas_thread
    def may_exceed(self, stress: float) -> bool:
        """Whether the equivalent stress may exceed ``stress`` [Pa], by a bound on it."""
        bound = stress_bound(
            StressFields(self.recovery),
            *self._moved_and_pushed(self.dataset),
            between=self._between,
        )
        return not bound <= stress

    @one_blas_thread
    def fatigue(self, place: str | None, curve: SNCurve | None, *, material: str) -> Fatigue:
        """Damage and life at named places, or at one, over the settled part; by default with the
        S-N curve of the ``material``."""
        if isinstance(place, SNCurve):
            raise InputError("fatigue takes a curve by its name, run.fatigue(curve=...).")
        require_pylife()
        used = sn_curve(material) if curve is None else curve
        expect(used, SNCurve, "curve")
        check_curve(used, "curve")
        fields = TensorFields(self.recovery)
        ds = settled(self.dataset, self.settle)
        places = chosen_places(place, tuple(fields.places))
        first = self.dataset.sizes["time"] - ds.sizes["time"]
        samples, histories = histories_at(
            fields, *self._moved_and_pushed(ds), places=places, between=self._between.since(first)
        )
        stresses = {}
        for name, tensors in histories:
            counted = counted_stress(tensors, used.mean_stress_sensitivity)
            stresses[name] = (int(fields.vertices[fields.places[name][counted.point]]), counted)
        windows, t = element_passes(ds, self.numbers), ds["time"].values
        turns = abs(float(np.ptp(carrier_angle(ds)))) / (2.0 * np.pi)
        time = float(t[-1] - t[0])
        turn = time / turns if turns else float("nan")
        step = time / (len(t) - 1)
        found = place_fatigue(stresses, used, windows, samples=samples, step=step, turn=turn)
        return replace(found, cage=material)

    @one_blas_thread
    def rivets(self, *, diameter: float) -> Rivets:
        """What rivets of a ``diameter`` [m] bear."""
        joints = Joints(
            self.recovery.model, self.mesh.pocket_count, 0.5 * self.numbers.pitch_diameter
        )
        return rivet_loads(
            RivetFields(self.recovery, joints),
            *self._moved_and_pushed(self.dataset),
            time=self.dataset["time"].values,
            diameter=diameter,
            settled=self._first_settled,
            between=self._between,
        )

    @one_blas_thread
    def strains(self, gauges: Sequence[StrainGauge], radius: float) -> np.ndarray:
        """Strains (n_gauges, nt) [1] of gauges at the samples; ``radius`` [m] of the middle of the
        cage's wall. InputError for a gauge beside the cage's surface."""
        fields = gauge_fields(self.recovery, gauges, radius)
        return fields.strains(*self._moved_and_pushed(self.dataset))

    @property
    def figures(self) -> Stressed:
        """What figures of a summary are taken from."""
        h = self.history
        k = h.peak_sample
        x, y, z = self.mesh.points[h.peak_vertex[k]] * 1e3
        place = f"t = {self.peak_time * 1e3:.3f} ms at ({x:.1f}, {y:.1f}, {z:.1f}) mm, cage frame"
        part = self.dataset.isel(time=slice(h.settled, None))
        return Stressed(
            element=element(self.dataset),
            kind=self.places.kind,
            peak=float(h.peak[k]),
            peak_place=place,
            at_sample=h.at_sample[h.settled :],
            start=float(h.peak[: h.settled].max(initial=0.0)),
            places=h.places[h.settled :],
            place_names=tuple(map(in_words, h.place_names)),
            windows=element_passes(part, self.numbers),
        )

    @property
    def _first_settled(self) -> int:
        """First sample of the settled part."""
        return int(self.settle * self.dataset.sizes["time"])

    @property
    def _between(self) -> StoredSteps:
        """Steps between samples, anew: what is read of them is not kept for the run's life."""
        return StoredSteps(
            self.store, self.dataset["time"].values, inner=self.inner_land, k=self.k,
            across=self._across,
        )  # fmt: skip

    def _moved_and_pushed(self, ds: xarray.Dataset) -> tuple[Any, Any, LandLoads | None]:
        """Modal coordinates, station forces and land forces of samples: what histories want.

        Read from disk slice by slice: a second of a roller bearing has 0.4 GB of station forces.
        """
        land = LandLoads(ds, inner=self.inner_land)
        pushed: Any = ds["station_force"]
        if self._across is not None:
            pushed = MirroredForces(pushed, self._across)
        return ds["modal_coordinates"], pushed, land or None
