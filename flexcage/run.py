"""A run: what was asked, what happened, and what can be asked of it afterwards."""

from __future__ import annotations

import dataclasses
import logging
import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.cages import cage_type_of
from flexcage.case import Case, words
from flexcage.case.checks import land_beside_shoulder, not_reached
from flexcage.core import html
from flexcage.core.binding import Binder, check_spec, expect
from flexcage.core.cache import cached_arrays
from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.core.progress import Silent
from flexcage.core.threads import one_blas_thread
from flexcage.core.timing import Stages
from flexcage.core.warning import RunWarning
from flexcage.geometry.ribbon_cage import RibbonCage
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.quality import report_mesh
from flexcage.mesh.series import write_series
from flexcage.modes.reduction import CageReduction
from flexcage.modes.table import ModeTable
from flexcage.results import mode_file
from flexcage.results.edges import Edge, groove_edges
from flexcage.results.figures import pass_peak, summarise
from flexcage.results.film import film_rows, film_thickness
from flexcage.results.metrics import BearingNumbers, SlipRange, cage_angle, settled
from flexcage.results.statistics import roller_passes
from flexcage.results.store import MemoryRunStore
from flexcage.results.summary import Row, Summary, figure, statistic
from flexcage.results.warnings import (
    AT_END,
    AT_START,
    Outcome,
    Setup,
    from_attrs,
    warnings_of,
)
from flexcage.solve.contract import Effort
from flexcage.stress.between import Between
from flexcage.stress.counting import require_pylife
from flexcage.stress.fatigue import Fatigue, chosen_places, counted_stress, place_fatigue
from flexcage.stress.fields import StressFields, TensorFields
from flexcage.stress.history import StressHistory, histories_at, stress_bound, stress_history
from flexcage.stress.loads import LandForces, cage_loads
from flexcage.stress.midpoints import at_nodes, largest_at_nodes
from flexcage.stress.operators import von_mises
from flexcage.stress.places import in_words as place_in_words
from flexcage.stress.recovery import STRESS_VERSION, CageLoads, StressRecovery
from flexcage.stress.rivets import Joints, RivetFields, Rivets, rivet_loads
from flexcage.stress.series import as_time, frames, samples_near
from flexcage.stress.sn_curves import SNCurve, sn_curve
from flexcage.stress.wear import Wear, wear
from flexcage.stress.wear_laws import WearLaw, wear_law
from flexcage.system.bodies import loads_over, unbalance_of
from flexcage.system.start import Start

if TYPE_CHECKING:
    import xarray

    from flexcage.render.album import Scene, StressPictures
    from flexcage.render.look import Look
    from flexcage.report.run_page import RunAccount

log = logging.getLogger(__name__)

# measured on pinched pockets of an N1013, in tests/verification/test_pinch.py
_FAR = (
    "of a push's deflection of its own pocket, what others would feel of it beyond the modes; "
    "changes an N1013's pinch forces by under 0.5 %"
)
_NO_TIME = 1e-3  # s: a stage that is shorter had nothing to do
_RARE = ("explicit_steps", "jacobians", "factorisations", "failed_newton")  # by method
_ABOUT_PEAK = 4e-4  # s before and after the largest stress: what animations and VTU series show


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


class Run:
    """One simulation, finished or not: ``dataset``, ``summary``, ``stress(...)``, ``draw(...)``."""

    def __init__(
        self,
        case: Case,
        store: MemoryRunStore,
        folder: Path | None,
        mesh: CageMesh,
        cage: CageReduction | None,
        start: Start | None = None,
        stages: Stages | None = None,
        edited: tuple[RunWarning, ...] = (),
    ) -> None:
        self.case, self.store, self.folder = case, store, folder
        self.mesh, self.cage, self.start = mesh, cage, start
        self.stages = stages if stages is not None else Stages()
        self.effort: Effort | None = None  # of the integration, if this process did it
        self.edited = edited  # a warning, if the folder's case.toml was changed after the run

    def __repr__(self) -> str:
        return f"Run({self.case.name!r}: {self._size()})"

    def _size(self) -> str:
        where = f" in {self.folder}" if self.folder else ""
        return f"{self.store.n_time:,} samples{where}"

    def _repr_html_(self) -> str:
        """For notebooks: warnings and the figures that matter most."""
        title = f"Run {self.case.name}: {self._size()}"
        edited = html.bullets(f"Warning: {warning.text}" for warning in self.edited)
        return html.block(title, edited, self.summary_at_end.brief_html())

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """All recorded variables, labelled, with units (an xarray.Dataset)."""
        return self.store.dataset()

    @cached_property
    def events(self) -> xarray.Dataset:
        """Contacts that closed or opened: time [s], roller or ball, place, closed (an
        xarray.Dataset)."""
        from flexcage.results.events import contact_events

        return contact_events(self.store.events(), self.store.layout.attrs)

    @property
    def steps(self) -> dict[str, np.ndarray]:
        """The solver's steps: time and step [s], order, Newton iterations, error over tolerance."""
        return self.store.steps()

    @property
    def numbers(self) -> BearingNumbers:
        b = self.case.bearing
        return BearingNumbers(
            pitch_diameter=b.pitch_diameter,
            roller_diameter=b.element_diameter,
            roller_count=b.element_count,
            contact_angle=b.nominal_contact_angle,
            rolling_heights=b.rolling_heights,
        )

    @cached_property
    def film_thickness(self) -> xarray.DataArray:
        """Lubricant's film [m] at every element and race, central and least (an xarray.DataArray):
        isothermal, fully flooded, by the recorded forces and speeds."""
        return film_thickness(self.dataset, self.case.bearing, self.case.lubricant.oil)

    @cached_property
    def summary(self) -> Summary:
        """Figures of the run: speeds, slip, motion, forces, stress, energy, solver, times."""
        if self.cage is None or "stress_peak" in self.summary_at_end:
            return self.summary_at_end
        return self._with_stress(self.summary_at_end)

    @cached_property
    def summary_at_end(self) -> Summary:
        """The summary as the run's end made it: one in a study may have left its stress out."""
        if self.folder and (self.folder / "summary.json").exists():
            stored = Summary.read(self.folder / "summary.json")
            return stored if stored.warnings is not None else self._warned(stored)
        return self._summarise()

    @property
    def warnings(self) -> tuple[RunWarning, ...]:
        """What the reader of the run's figures must know, from its start and from its results."""
        return (*self.edited, *(self.summary_at_end.warnings or ()))

    @cached_property
    def recovery(self) -> StressRecovery:
        """Stress recovery of the flexible cage; InputError for a rigid one."""
        if self.cage is None:
            raise InputError("a rigid cage has no stress; run the case with cage.model = flexible")
        return _recovery_of(self.cage)

    @cached_property
    def mode_table(self) -> ModeTable:
        """Number, kind, frequency and effective masses of the flexible cage's dynamic modes."""
        if self.cage is None:
            raise InputError("a rigid cage has no modes; run the case with cage.model = flexible")
        return self.cage.table

    @cached_property
    def stress_history(self) -> StressHistory:
        """Equivalent stress at named places, peaks, and the envelope over all samples."""
        return self.stages("stress", self._stress_history)

    @one_blas_thread
    def _stress_history(self) -> StressHistory:
        ds = self.dataset
        return stress_history(
            StressFields(self.recovery),
            *self._moved_and_pushed(ds),
            settled=self._first_settled,
            between=self._between,
            progress=self.stages.progress,
        )

    @property
    def _first_settled(self) -> int:
        """First sample of the settled part."""
        return int(self.case.output.settle * self.dataset.sizes["time"])

    @property
    def _between(self) -> Between:
        """Steps between samples, anew: what is read of them is not kept for the run's life."""
        return Between(self.store, self.dataset["time"].values, inner=self._inner_land)

    @property
    def _inner_land(self) -> bool:
        """Whether what land forces there are act on the cage's inner land."""
        return self.case.cage.guidance != "outer"

    def _moved_and_pushed(self, ds: xarray.Dataset) -> tuple[Any, Any, LandForces | None]:
        """Modal coordinates, station forces and land forces of samples: what histories want.

        Read from disk slice by slice: a second of a roller bearing has 0.4 GB of station forces.
        """
        land = LandForces(ds, inner=self._inner_land)
        return ds["modal_coordinates"], ds["station_force"], land or None

    @one_blas_thread
    def fatigue(self, place: str | None = None, *, curve: SNCurve | None = None) -> Fatigue:
        """Damage and life of the cage at its named places, or at one of them, over the settled part
        (``stress.fatigue`` says what is counted); by default with the S-N curve of its material.

        Raises InputError for a rigid cage, a place that is not there, or a material without a
        published curve, and EnvironmentLacks without pyLife (the extra ``fatigue``).
        """
        if isinstance(place, SNCurve):
            raise InputError("fatigue takes a curve by its name, run.fatigue(curve=...).")
        recovery = self.recovery  # refuses a rigid cage
        require_pylife()
        used = sn_curve(self.case.cage.material.name) if curve is None else curve
        expect(used, SNCurve, "curve")
        check_spec(used, "curve")
        fields = TensorFields(recovery)
        ds = settled(self.dataset, self.case.output.settle)
        places = chosen_places(place, tuple(fields.places))
        first = self.dataset.sizes["time"] - ds.sizes["time"]
        samples, histories = histories_at(
            fields, *self._moved_and_pushed(ds), places=places,
            between=self._between.since(first),
        )  # fmt: skip
        stresses = {}
        for name, tensors in histories:
            counted = counted_stress(tensors, used.mean_stress_sensitivity)
            stresses[name] = (int(fields.vertices[fields.places[name][counted.point]]), counted)
        windows, t = roller_passes(ds, self.numbers), ds["time"].values
        turns = abs(float(np.ptp(cage_angle(ds)))) / (2.0 * np.pi)
        time = float(t[-1] - t[0])
        turn = time / turns if turns else float("nan")
        step = time / (len(t) - 1)
        return place_fatigue(stresses, used, windows, samples=samples, step=step, turn=turn)

    def wear(self, law: WearLaw | None = None) -> Wear:
        """Rates of wear of pockets and land over the settled part by Archard's law; by default
        with the dry coefficient of the cage's material. InputError for a material without one."""
        case = self.case
        used = wear_law(case.cage.material.name) if law is None else law
        expect(used, WearLaw, "law")
        check_spec(used, "law")
        ds = settled(self.dataset, case.output.settle)
        windows = roller_passes(ds, self.numbers)
        return wear(ds, case.bearing, case.cage, case.land, used, windows)

    @cached_property
    def rivets(self) -> Rivets:
        """What the rivets of a ribbon cage bear (``stress.rivets.Rivets``): ``dataset``, ``table``;
        InputError for any other cage, and for a rigid one."""
        return self.stages("rivets", self._rivets)

    @one_blas_thread
    def _rivets(self) -> Rivets:
        recovery, cage = self.recovery, self.case.cage  # refuses a rigid cage
        if not isinstance(cage, RibbonCage):
            raise InputError(
                "The run's cage has no rivets; ribbon cages have (cage.type = 'ribbon').",
                where="cage.type",
            )
        ds = self.dataset
        joints = Joints(
            recovery.model, self.mesh.pocket_count, 0.5 * self.case.bearing.pitch_diameter
        )
        return rivet_loads(
            RivetFields(recovery, joints),
            *self._moved_and_pushed(ds),
            time=ds["time"].values,
            diameter=cage.rivet_diameter,
            settled=self._first_settled,
            between=self._between,
        )

    @one_blas_thread
    def stress(self, *, time: float | str | None = None) -> StressField:
        """Stress of the whole cage at ``time``, in seconds or a text with its unit, by mode
        acceleration.

        At the nearest sample, or step of the solver that is kept between samples. Default: the
        largest peak of the settled part. Raises InputError for a rigid cage or a time outside the
        run.
        """
        self.recovery  # noqa: B018  (refuses a rigid cage)
        t = self.dataset["time"].values
        wanted = self.peak_time if time is None else as_time(time)
        index = int(samples_near(t, [wanted])[0])
        instant, loads = float(t[index]), self._loads_at(index)
        step = self._between.nearest(wanted, index)
        if step is not None and abs(step.time[0] - wanted) < abs(instant - wanted):
            instant, loads = float(step.time[0]), step.cage_loads(loads.angular_velocity)
        u = self.recovery.displacement(loads)
        return StressField(instant, u, self.recovery.stress(u, loads))

    def _loads_at(self, index: int) -> CageLoads:
        return cage_loads(self.dataset, index, inner=self._inner_land)

    @property
    def peak_time(self) -> float:
        """Time [s] of the largest equivalent stress of the settled part."""
        h = self.stress_history
        between = float(h.peak_time[h.peak_sample])
        at_sample = float(self.dataset["time"].values[h.peak_sample])
        return at_sample if np.isnan(between) else between

    def write_vtu(
        self,
        folder: str | Path,
        *,
        times: Sequence[float | str] | None = None,
    ) -> Path:
        """Write the cage's motion and stress as a .vtu series for ParaView; the path of its .pvd.

        At the samples nearest to ``times``, in seconds or texts with their unit, or all within
        0.4 ms of the largest peak of stress, and that itself:
        ``displacement`` [m], ``von_mises`` [Pa] and ``stress`` [Pa] (xx, yy, zz, xy, yz, xz) at
        the vertices of the cage as it is without stress, cage frame. Raises InputError for a rigid
        cage, a time outside the run, or a folder that holds files.
        """
        self.recovery  # noqa: B018  (refuses a rigid cage)
        t = self.dataset["time"].values
        if times is None:
            near = t[np.abs(t - self.peak_time) < _ABOUT_PEAK]
            chosen = np.union1d(near, self.peak_time)
        else:
            chosen = t[samples_near(t, times)]

        def field_at(time: float) -> tuple[np.ndarray, np.ndarray]:
            field = self.stress(time=time)
            return field.displacement, field.stress

        with self.stages.progress(len(chosen), "VTU") as bar:
            series = frames(chosen, field_at, bar.advance)
            return write_series(folder, "cage", self.mesh.points, self.mesh.tets, series)

    def draw(
        self,
        folder: str | Path,
        *,
        animate: bool = False,
        view: float | str | None = None,
        stress_limit: float | str | None = None,
        scale: float | None = None,
    ) -> list[Path]:
        """Draw every picture of the run into ``folder``; paths of the files.

        ``view``, an azimuth of the cage [rad], is turned to the viewer in pictures of the cage;
        ``stress_limit`` [Pa] ends the colours of stress, and deformation is drawn ``scale`` times:
        the same for several runs, their pictures can be laid side by side. Text carries units. Not
        given, the view is from pocket 0, that of the mesh from its first defect, and the other two
        follow the run (``render.Look``).
        """
        from flexcage.render.look import Look

        given = {"view": view, "stress_limit": stress_limit, "scale": scale}
        look = Binder(si=True).bind(Look, given, "")
        paths = self.stages("pictures", self._draw, Path(folder), animate, look)
        if self.effort is not None:
            self.tell_times()
        return paths

    def _draw(self, folder: Path, animate: bool, look: Look) -> list[Path]:
        from flexcage.render.album import draw_album

        scene = self.scene(animate=animate)
        return draw_album(scene, folder, animate=animate, look=look, progress=self.stages.progress)

    def tell_times(self) -> None:
        """Bring the wall times of a run just computed up to now in its summary, the stored one
        included."""
        self.summary = self.summary.with_section("Wall time", self._time_rows())
        if self.folder:
            self.summary.write(self.folder)

    def report(self, path: str | Path, *, progress: Callable[..., Any] | None = None) -> Path:
        """Write the run's report, one HTML file that needs no other; returns its path.

        The run's pictures are drawn if its folder has none; where this machine cannot draw, the
        page says why. ``progress`` is a context like ``core.progress.Progress``. Raises InputError
        if ``path`` cannot be written.
        """
        from flexcage.report.page import write_page
        from flexcage.report.run_page import run_page

        if self.store.n_time < 2:
            raise InputError(
                "The run holds fewer than two samples, too few to report on; 'flexcage run "
                "--resume' goes on with it.",
                where="run",
            )
        with TemporaryDirectory() as spare, (progress or Silent)(2, "report") as bar:
            images, lacking = self._images(Path(spare))
            bar.advance()
            return write_page(run_page(self._account(images, lacking)), path)

    def _images(self, spare: Path) -> tuple[list[Path], str]:
        """The run's pictures, and why there are none; drawn into ``spare`` if it has no folder."""
        folder = self.folder / "images" if self.folder else spare
        images = sorted(folder.glob("*.png"))
        try:
            drawn = images or self.draw(folder if os.access(folder.parent, os.W_OK) else spare)
        except EnvironmentLacks as exc:
            return [], str(exc)
        return [path for path in drawn if path.suffix == ".png"], ""

    def _account(self, images: list[Path], no_images: str) -> RunAccount:
        from flexcage.report.run_page import RunAccount

        case = self.case
        command = words.run_command("case.toml")
        return RunAccount(
            scene=self.scene(),
            summary=self.summary,
            numbers=self.numbers,
            statement=words.in_words(case),
            warnings=[warning.text for warning in self.warnings],
            steps=self.steps,
            settings=words.settings(case),
            assumptions=words.assumed(case),
            sources=words.grounds(case),
            case_text=case.to_toml(),
            commands=f"{command} -o runs/again\nflexcage report runs/again",
            images=images,
            no_images=no_images,
            folder=self.folder,
            hash=case.hash,
        )  # fmt: skip

    def scene(self, *, animate: bool = False) -> Scene:
        """What pictures and reports show of the run; ``animate`` adds an animation's frames."""
        from flexcage.render.album import Scene

        case, load = self.case, self.case.load
        radial, axial = loads_over(load, self.dataset["time"].values).T
        return Scene(
            name=case.name,
            dataset=self.dataset,
            bearing=case.bearing,
            mesh=self.mesh,
            defects=case.defects,
            loads=np.stack(
                [axial, radial * np.cos(load.direction), radial * np.sin(load.direction)], axis=1
            ),
            clearance=case.land.clearance if case.bearing.land(case.cage) else None,
            guide="outer" if case.cage.guidance == "outer" else "inner",
            settle=case.output.settle,
            stress=self._stress_pictures(animate) if self.cage is not None else None,
        )

    def _stress_pictures(self, animate: bool) -> StressPictures:
        from flexcage.render.album import StressPictures

        history, peak = self.stress_history, self.stress()
        envelope = np.zeros(len(self.mesh.points))
        envelope[history.surface] = history.envelope
        assert self.cage is not None
        model = self.cage.model
        frames = []
        if animate:
            t = self.dataset["time"].values
            near = np.abs(t - peak.time) < _ABOUT_PEAK
            for instant in t[near]:
                field = self.stress(time=instant)
                frames.append((field.time, field.displacement, at_nodes(model, field.stress)))
        return StressPictures(
            nodes=model.nodes,
            cells=model.cells,
            basis=self.cage.shown,
            time=peak.time,
            displacement=peak.displacement,
            von_mises=at_nodes(model, peak.stress),
            envelope=largest_at_nodes(model, envelope, history.edges, history.middles),
            peak_vertex=int(history.peak_vertex[history.peak_sample]),
            peak_place=self._peak_place(),
            settled=history.settled,
            roots=history.places,
            root_names=history.place_names,
            root_kind=self.recovery.places.kind,
            frames=frames,
        )

    def _peak_place(self) -> str:
        """Name of the followed place in which the peak is, or nothing."""
        h = self.stress_history
        vertex = h.peak_vertex[h.peak_sample]
        for name, vertices in self.recovery.roots.items():
            if vertex in vertices:
                return place_in_words(name)
        return ""

    def finish(self, effort: Effort, *, stress: bool = True) -> Run:
        """Complete a run that has come to its end: summary, stored beside the results, with what
        the integration took; without ``stress``, this is left out where it surely stays below
        the proof stress."""
        self.effort = effort
        self.summary_at_end = self._summarise(stress=stress)
        if self.folder:
            self.summary_at_end.write(self.folder)
            if self.cage is not None:
                mode_file.write_modes(self.mode_table, self.folder / mode_file.FILE)
        return self

    @cached_property
    def _groove_edges(self) -> list[Edge]:
        return groove_edges(self.case.bearing, self.dataset)

    def _summarise(self, *, stress: bool = True) -> Summary:
        case, friction = self.case, self.case.contacts.race.friction
        summary = summarise(
            self.dataset,
            self.numbers,
            settle=case.output.settle,
            slip_range=SlipRange(friction.creeps_below, friction.rises_below),
            events=self.events,
        )
        part = settled(self.dataset, case.output.settle)
        if film := film_rows(part, case.bearing, case.lubricant.oil):
            summary = summary.with_section("Lubricant's film", film)
        if self._groove_edges:
            rows = [edge.row for edge in self._groove_edges]
            summary = summary.with_section("Grooves", rows)
        summary = summary.with_section("Support", [figure("inner_held", case.held_in_words)])
        summary = summary.with_section("Cage", self._cage_rows())
        if self.cage is not None and (stress or self._may_yield):
            summary = self._with_stress(summary)
        if self.effort is not None:
            summary = summary.with_section("Solver", self._solver_rows(self.effort))
        return self._warned(summary.with_section("Wall time", self._time_rows()))

    def _with_stress(self, summary: Summary) -> Summary:
        """The summary with stress behind the cage's figures."""
        summary = summary.with_section("Equivalent stress", self.stress_rows(), after="Cage")
        if not self.case.riveted:
            return summary
        return summary.with_section("Rivets", self.rivets.rows(), after="Equivalent stress")

    @property
    @one_blas_thread
    def _may_yield(self) -> bool:
        """Whether the cage's stress may exceed the proof stress, by a bound on it."""
        bound = stress_bound(
            StressFields(self.recovery),
            *self._moved_and_pushed(self.dataset),
            between=self._between,
        )
        return not bound <= self.case.cage.material.proof_stress

    def _warned(self, summary: Summary) -> Summary:
        """The summary with its warnings."""
        case = self.case
        outcome = Outcome(
            summary=summary,
            dataset=self.dataset,
            bearing=case.bearing,
            cage=case.cage,
            land=case.land,
            duration=case.solver.duration,
            settle=case.output.settle,
            edges=tuple(self._groove_edges),
        )
        known = from_attrs(self.dataset.attrs)
        return dataclasses.replace(summary, warnings=(*known, *warnings_of(AT_END, outcome)))

    def _time_rows(self) -> list[Row]:
        rows = [figure(f"wall_{k}", v, idle=v < _NO_TIME) for k, v in self.stages.items()]
        return [*rows, figure("wall_total", self.stages.total)]

    def _cage_rows(self) -> list[Row]:
        case = self.case
        report = report_mesh(self.mesh, density=case.cage.material.density)
        mass, centre, note = report.volume * case.cage.material.density, report.mass_centre, ""
        if case.cage.unbalance:
            added, place = unbalance_of(case.cage)
            centre = (mass * centre + added * place) / (mass + added)
            mass += added
            note = f"{added * 1e3:.4g} g of them make the unbalance, at the cage's mean radius"
        shift = float(np.linalg.norm(centre))
        rows = [
            figure("cage_mass", mass, note),
            figure("cage_centre_shift", shift),
        ]
        if self.cage is not None:
            basis = self.cage.shown
            where = mode_file.FILE if self.folder else "run.mode_table"
            rows.append(figure("mode_count", basis.size, f"table: {where}"))
            rows.append(figure("first_frequency", basis.frequencies[0]))
            if basis.residual is not None:
                rows.append(figure("far_coupling", basis.residual.far_coupling, _FAR))
        if self.start is not None and self.start.pinched:
            rows.append(
                figure(
                    "pinch_force",
                    self.start.pinch_force,
                    f"pockets {', '.join(map(str, self.start.pinched))}",
                )
            )
        return rows

    def stress_rows(self) -> list[Row]:
        """Figures of the summary's section "Equivalent stress"; InputError for a rigid cage."""
        h = self.stress_history
        k = h.peak_sample
        roots = h.places[h.settled :].max(axis=0)
        root = int(np.argmax(roots))
        when = self.peak_time * 1e3
        at = self.mesh.points[h.peak_vertex[k]] * 1e3
        place = f"t = {when:.3f} ms at ({at[0]:.1f}, {at[1]:.1f}, {at[2]:.1f}) mm, cage frame"
        part = self.dataset.isel(time=slice(h.settled, None))
        windows, peak = roller_passes(part, self.numbers), h.at_sample[h.settled :]
        kind = self.recovery.places.kind
        corner = windows.peak(h.places[h.settled :].max(axis=1))
        return [
            figure(
                "stress_peak",
                float(h.peak[k]),
                f"{place}; {kind.left_out} are never searched",
                walls=kind.walls,
            ),
            statistic("stress_mean_peak", windows.mean(peak)),
            statistic(
                "stress_root_pass_peak",
                corner,
                pass_peak(self.case.bearing.element),
                place=f"a {kind.one}",
            ),
            figure(
                "stress_root",
                float(roots[root]),
                place_in_words(h.place_names[root]),
                place=f"a {kind.one}",
            ),
            figure("stress_start", float(h.peak[: h.settled].max(initial=0.0))),
        ]

    def _solver_rows(self, effort: Effort) -> list[Row]:
        counts, stable_step = effort
        rows = [figure(k, n, idle=not n and k in _RARE) for k, n in counts.items()]
        if np.isfinite(stable_step):
            note = "least over the run, by the spectral radius"
            rows.append(figure("stable_step", stable_step, note))
        return rows


def _recovery_of(cage: CageReduction) -> StressRecovery:
    """Stress recovery of a flexible cage; what it costs to prepare is kept in the cache."""

    def keep(name: str, make: Callable[[], dict[str, np.ndarray]]) -> dict[str, np.ndarray]:
        return cached_arrays("stress", f"{cage.version}-{STRESS_VERSION}-{name}", make)

    def make() -> StressRecovery:
        return StressRecovery(
            cage.model,
            cage.shown,
            cage.interface,
            places=cage_type_of(cage.cage).places(),
            solver=cage.solver,
            keep=keep,
        )

    return cage.once("recovery", make)


def warnings_at_start(
    case: Case, mesh: CageMesh, cage: CageReduction | None, start: Start
) -> tuple[RunWarning, ...]:
    """What must be known of a run before it begins, logged too; InputError for a cage that its
    assembly alone stresses more than the case allows."""
    setup = Setup(
        bearing=case.bearing,
        cage=case.cage,
        land=case.land,
        mesh=mesh,
        flexible=cage is not None,
        basis=case.modes.kind,
        attached=cage is None or bool(np.any(getattr(cage.interface, "compliance", True))),
        pinched=start.pinched,
        pinch_force=start.pinch_force,
        statics=start.warnings,
    )
    said = [("not_reached", s) for s in not_reached(case)]
    said += [("land_clearance", s) for s in land_beside_shoulder(case)]
    found = (
        *(RunWarning(*each) for each in said),
        *warnings_of(AT_START, setup),
        *_assembly_stress(case, mesh, cage, start),
    )
    for warning in found:
        log.warning(warning.text)
    return found


@one_blas_thread
def _assembly_stress(
    case: Case, mesh: CageMesh, cage: CageReduction | None, start: Start
) -> list[RunWarning]:
    if cage is None or not start.pinched:
        return []
    recovery = _recovery_of(cage)
    loads = CageLoads(station_forces=start.station)
    stress = von_mises(recovery.stress(recovery.displacement(loads), loads))
    stress[recovery.contact_zone] = 0.0
    peak, material = float(stress.max()), case.cage.material
    text = f"Assembling the bearing stresses the cage to {peak / 1e6:.0f} MPa"
    limit = case.limits.stress
    if limit is not None and peak > limit:
        raise InputError(
            f"{text}, more than limits.stress ({limit / 1e6:.0f} MPa); make the defect "
            "smaller, the pocket larger, or raise the limit",
            where="defects",
            value=peak,
        )
    if peak <= material.proof_stress:
        return []
    proof = f"the proof stress of {material.name} ({material.proof_stress / 1e6:.0f} MPa)"
    return [RunWarning("assembly_stress", f"{text}, more than {proof}: it would yield.")]


__all__ = [
    "Run",
    "StressField",
    "warnings_at_start",
]
