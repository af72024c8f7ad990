"""A run: what was asked, what happened, and what can be asked of it afterwards."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Sequence
from functools import cached_property
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.cages import cage_type_of, riveted_cages
from flexcage.case import Case
from flexcage.core import html
from flexcage.core.binding import Binder, check_spec, expect, path_of
from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.core.output_folders import check_no_file
from flexcage.core.progress import Silent
from flexcage.core.timing import Stages
from flexcage.core.units import parse
from flexcage.core.warning import RunWarning
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.series import write_series
from flexcage.modes.reduction import CageReduction
from flexcage.modes.table import ModeTable
from flexcage.results import mode_file
from flexcage.results.edges import Edge, groove_edges
from flexcage.results.film import film_thickness
from flexcage.results.metrics import BearingNumbers, settled
from flexcage.results.statistics import element_passes
from flexcage.results.store import MemoryRunStore
from flexcage.results.summary import SUMMARY, Row, Summary
from flexcage.run.rings import rings_at, seated_rings
from flexcage.run.summary import summary_of, timed, warned, with_stress
from flexcage.solve.contract import Effort
from flexcage.stress.fatigue import Fatigue
from flexcage.stress.history import StressHistory
from flexcage.stress.recovery import StressRecovery
from flexcage.stress.rivets import Rivets
from flexcage.stress.run_stress import RunStress, StressField
from flexcage.stress.series import ABOUT_PEAK, frames, samples_near
from flexcage.stress.sn_curves import SNCurve
from flexcage.stress.wear import Wear, wear
from flexcage.stress.wear_laws import WearLaw, wear_law
from flexcage.system.start import Start
from flexcage.system.statics.rings import BentRing, SeatedRing

if TYPE_CHECKING:
    import xarray

    from flexcage.mesh.riveted_joint import JointMesh
    from flexcage.render.album import Scene
    from flexcage.stress.riveted_joint import Fits

log = logging.getLogger(__name__)


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
        return BearingNumbers.of(self.case.bearing)

    @cached_property
    def film_thickness(self) -> xarray.DataArray:
        """Lubricant's film [m] at every element and race, central and least (an xarray.DataArray):
        isothermal, fully flooded, by the recorded forces and speeds."""
        return film_thickness(self.dataset, self.case.bearing, self.case.lubricant.oil)

    @cached_property
    def groove_edges(self) -> list[Edge]:
        """Contact ellipses at the edges of grooves: the worst at each; none without grooves."""
        return groove_edges(self.case.bearing, self.dataset)

    @cached_property
    def summary(self) -> Summary:
        """Figures of the run: speeds, slip, motion, forces, stress, energy, solver, times."""
        if self.cage is None or "stress_peak" in self.summary_at_end:
            return self.summary_at_end
        return with_stress(self.summary_at_end, self)

    @cached_property
    def summary_at_end(self) -> Summary:
        """The summary as the run's end made it: one in a study may have left its stress out."""
        if self.folder and (self.folder / SUMMARY).exists():
            stored = Summary.read(self.folder / SUMMARY, vouched=self.store.vouches_for)
            return stored if stored.warnings is not None else warned(stored, self)
        return summary_of(self)

    @property
    def warnings(self) -> tuple[RunWarning, ...]:
        """What the reader of the run's figures must know, from its start and from its results."""
        return (*self.edited, *(self.summary_at_end.warnings or ()))

    @cached_property
    def cage_stress(self) -> RunStress:
        """Stress of the flexible cage over the run; InputError for a rigid one."""
        if self.cage is None:
            raise InputError("a rigid cage has no stress; run the case with cage.model = flexible")
        return RunStress(
            cage=self.cage,
            places=cage_type_of(self.case.cage).places(),
            mesh=self.mesh,
            dataset=self.dataset,
            store=self.store,
            numbers=self.numbers,
            settle=self.case.output.settle,
            inner_land=self.case.cage.land_ring == "inner",
            stages=self.stages,
        )

    @property
    def recovery(self) -> StressRecovery:
        """Stress recovery of the flexible cage; InputError for a rigid one."""
        return self.cage_stress.recovery

    @cached_property
    def mode_table(self) -> ModeTable:
        """Number, kind, frequency and effective masses of the flexible cage's dynamic modes."""
        if self.cage is None:
            raise InputError("a rigid cage has no modes; run the case with cage.model = flexible")
        return self.cage.table

    @property
    def stress_history(self) -> StressHistory:
        """Equivalent stress at named places, peaks, and the envelope over all samples."""
        return self.cage_stress.history

    def fatigue(self, place: str | None = None, *, curve: SNCurve | None = None) -> Fatigue:
        """Damage and life of the cage at its named places, or at one of them, over the settled part
        (``stress.fatigue`` says what is counted); by default with the S-N curve of its material.

        Raises InputError for a rigid cage, a place that is not there, or a material without a
        published curve, and EnvironmentLacks without pyLife (the extra ``fatigue``).
        """
        return self.cage_stress.fatigue(place, curve, material=self.case.cage.material.name)

    def wear(self, law: WearLaw | None = None) -> Wear:
        """Rates of wear of pockets and land over the settled part by Archard's law; by default
        with the dry coefficient of the cage's material. InputError for a material without one."""
        case = self.case
        used = wear_law(case.cage.material.name) if law is None else law
        expect(used, WearLaw, "law")
        check_spec(used, "law")
        ds = settled(self.dataset, case.output.settle)
        windows = element_passes(ds, self.numbers)
        return wear(ds, case.bearing, case.cage, case.land, used, windows)

    @cached_property
    def rivets(self) -> Rivets:
        """What the rivets of a riveted cage bear (``stress.rivets.Rivets``): ``dataset`` and
        ``table``; InputError for any other cage, and for a rigid one."""
        stress, cage = self.cage_stress, self.case.cage  # refuses a rigid cage
        if not cage.riveted:
            riveted, chosen = riveted_cages()
            raise InputError(
                f"The run's cage has no rivets; {riveted} have ({chosen}).",
                where="cage.type",
            )
        return self.stages("rivets", stress.rivets, diameter=cage.rivet_diameter)

    def rivet_joint(
        self, *plays: float | str, clamp: float | str = "100 N", friction: float = 0.15,
        root_radius: float | str = "0.1 mm", mesh: JointMesh | None = None,
    ) -> Fits:  # fmt: skip
        """The joint of the most stressed rivet, with contact and friction, through its cycle of
        loads: once for every play of the shank over its diameter (m, or a text with its unit;
        negative for interference; without any, 0). ``clamp`` of the heads, friction and the radius
        of the heads' roots are assumptions (``stress.riveted_joint``).

        Takes about a minute a play. InputError for a cage without rivets, and for a rigid one.
        """
        from flexcage.stress.riveted_joint import fits_of

        rivets, case = self.rivets, self.case
        root = _si(root_radius, "mm", "root_radius")
        cage, bearing = case.cage, case.bearing
        return self.stages(
            "rivet_joint", fits_of, rivets,
            cage.rivet_joint(bearing.pitch_diameter, bearing.element_count, root),
            cage.warm_material,
            [_si(play, "um", "play") for play in plays or (0.0,)],
            clamp=_si(clamp, "N", "clamp"), friction=friction, mesh=mesh,
        )  # fmt: skip

    def stress(self, *, time: float | str | None = None) -> StressField:
        """Stress of the whole cage at ``time``, in seconds or a text with its unit, by mode
        acceleration.

        At the nearest sample, or step of the solver that is kept between samples. Default: the
        largest peak of the settled part. Raises InputError for a rigid cage or a time outside the
        run.
        """
        return self.cage_stress.at(time)

    @property
    def peak_time(self) -> float:
        """Time [s] of the largest equivalent stress of the settled part."""
        return self.cage_stress.peak_time

    @cached_property
    def seated_rings(self) -> tuple[SeatedRing, ...]:
        """The rings that bend, on their seats; InputError if both are rigid."""
        return self.stages("rings", seated_rings, self)

    def rings(self, *, time: float | str | None = None) -> tuple[BentRing, ...]:
        """The rings that bend, at the sample nearest to ``time``, in seconds or a text with its
        unit; default: when they yield most in the settled part.

        As those of a static solution: ``stress.rings.ring_field`` gives their stress,
        ``static.draw_ring`` their picture. Raises InputError if both are rigid, or for a time
        outside the run.
        """
        return rings_at(self, time)[1]

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
            near = t[np.abs(t - self.peak_time) < ABOUT_PEAK]
            chosen = np.union1d(near, self.peak_time)
        else:
            chosen = t[samples_near(t, times)]

        def field_at(time: float) -> tuple[np.ndarray, np.ndarray]:
            field = self.stress(time=time)
            return field.displacement, field.stress

        with self.stages.progress(len(chosen), "VTU") as bar:
            series = frames(chosen, field_at, bar.advance)
            return write_series(folder, "cage", self.mesh.points, self.mesh.tets, series)

    def write_table(
        self, path: str | Path, variables: Sequence[str] | str | None = None, *, force: bool = False
    ) -> list[Path]:
        """Write variables over time as a table (.csv, .parquet) or as matrices (.mat) for other
        programs; paths of the files, one for each time axis where there are several.

        Takes those of ``dataset``, and ``stress``, ``stress_peak``, ``film_thickness``, ``events``
        and ``steps``; by default the states of rings and cage (``results.export``). Raises
        InputError for a variable that the run does not have, another ending, or a file that is
        there, unless ``force`` is given.
        """
        from flexcage.run.tables import write_table

        return write_table(self, path_of(path, "path"), variables, force=force)

    def draw(
        self,
        folder: str | Path,
        *,
        animate: bool = False,
        view: float | str | None = None,
        stress_limit: float | str | None = None,
        scale: float | None = None,
        only: Sequence[str] = (),
        format: str = "png",
    ) -> list[Path]:
        """Draw every picture of the run into ``folder``, or ``only`` those of these names
        (``picture_names``); paths of the files.

        ``view``, an azimuth of the cage [rad], is turned to the viewer in pictures of the cage;
        ``stress_limit`` [Pa] ends the colours of stress, and deformation is drawn ``scale`` times:
        the same for several runs, their pictures can be laid side by side. Text carries units. Not
        given, the view is from pocket 0, that of the mesh from its first defect, and the other two
        follow the run (``render.Look``). ``format`` "svg" or "pdf" makes vector graphics of curves
        (orbit, histories, spectra); scenes stay .png. InputError for a name that is none.
        """
        from flexcage.render.album import check_format
        from flexcage.render.look import Look
        from flexcage.run.pictures import draw_pictures

        check_format(format)
        folder = path_of(folder, "folder")
        check_no_file(folder)
        names = [only] if isinstance(only, str) else list(only)
        given = {"view": view, "stress_limit": stress_limit, "scale": scale}
        look = Binder(si=True).bind(Look, given, "")
        paths = self.stages(
            "pictures", draw_pictures, self, folder, animate=animate, look=look, only=names,
            format=format,
        )  # fmt: skip
        if self.effort is not None:
            self.tell_times()
        return paths

    @property
    def picture_names(self) -> list[str]:
        """Names of the run's pictures."""
        from flexcage.run.pictures import picture_names_of

        return picture_names_of(self)

    def tell_times(self) -> None:
        """Bring the wall times of a run just computed up to now in its summary, the stored one
        included."""
        self.summary = timed(self.summary, self)
        self._write_summary(self.summary)

    def _write_summary(self, summary: Summary) -> None:
        """Store it, for a run that has a folder; RunFailed if that is gone."""
        if self.folder:
            self.store.check_there()
            self.store.vouch_for(SUMMARY, summary.content)
            summary.write(self.folder)

    def report(self, path: str | Path, *, progress: Callable[..., Any] | None = None) -> Path:
        """Write the run's report, one HTML file that needs no other; returns its path.

        The run's pictures are drawn if its folder has none; where this machine cannot draw, the
        page says why. ``progress`` is a context like ``core.progress.Progress``. Raises InputError
        if ``path`` cannot be written.
        """
        from flexcage.report.page import write_page
        from flexcage.report.run_page import run_page
        from flexcage.run.pictures import account_of

        if self.store.n_time < 2:
            raise InputError(
                "The run holds fewer than two samples, too few to report on; 'flexcage run "
                "--resume' goes on with it.",
                where="run",
            )
        with TemporaryDirectory() as spare, (progress or Silent)(2, "report") as bar:
            images, lacking = self._images(Path(spare))
            bar.advance()
            return write_page(run_page(account_of(self, images, lacking)), path)

    def _images(self, spare: Path) -> tuple[list[Path], str]:
        """The run's pictures, and why there are none; drawn into ``spare`` if it has no folder."""
        folder = self.folder / "images" if self.folder else spare
        images = sorted(folder.glob("*.png"))
        lacking = [name for name in self.picture_names if folder / f"{name}.png" not in images]
        try:
            if lacking:
                into = folder if os.access(folder.parent, os.W_OK) else spare
                drawn = self.draw(into, only=lacking)
                images += [path for path in drawn if path.suffix == ".png"]
        except EnvironmentLacks as exc:
            return images, "" if images else str(exc)
        return images, ""

    def scene(self, *, animate: bool = False) -> Scene:
        """What pictures and reports show of the run; ``animate`` adds an animation's frames."""
        from flexcage.run.pictures import scene_of

        return scene_of(self, animate=animate)

    def finish(self, effort: Effort, *, stress: bool = True) -> Run:
        """Complete a run that has come to its end: summary, stored beside the results, with what
        the integration took; without ``stress``, this is left out where it surely stays below
        the proof stress."""
        self.effort = effort
        self.store.check_there()
        self.summary_at_end = summary_of(self, stress=stress)
        self._write_summary(self.summary_at_end)
        if self.folder:
            if self.cage is not None:
                mode_file.write_modes(self.mode_table, self.folder / mode_file.FILE)
        return self

    def stress_rows(self) -> list[Row]:
        """Figures of the cage's stress; InputError for a rigid cage."""
        return self.cage_stress.rows(element=self.case.bearing.element)


def _si(value: float | str, unit: str, where: str) -> float:
    """A number in SI as it is, or a text with its unit."""
    return value if isinstance(value, (int, float)) else parse(value, unit, where=where)
