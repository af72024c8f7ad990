"""What a run recorded, and what follows of it: films, stress, life, wear, rivets, bent rings."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Self

import numpy as np

from flexcage.cages import cage_type_of, riveted_cages
from flexcage.case import Case
from flexcage.core.binding import check_spec, expect, path_of
from flexcage.core.errors import InputError
from flexcage.core.output_folders import check_no_file
from flexcage.core.timing import Stages
from flexcage.core.units import parse
from flexcage.core.warning import RunWarning
from flexcage.geometry.bearing import Bearing
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.mesh.rows import mirror_image
from flexcage.mesh.series import write_series
from flexcage.modes.reduction import CageReduction
from flexcage.modes.table import ModeTable
from flexcage.results.each_cage import cage_count, check_cage, one_cage, own_events
from flexcage.results.edges import Edge, groove_edges
from flexcage.results.film import film_thickness
from flexcage.results.metrics import settled
from flexcage.results.signals.spec import Sensor
from flexcage.results.slip import BearingNumbers
from flexcage.results.statistics import element_passes
from flexcage.results.store import MemoryRunStore
from flexcage.solve.contract import Effort
from flexcage.stages import bent_rings
from flexcage.static import solve_static
from flexcage.stress.fatigue import Fatigue
from flexcage.stress.history import StressHistory
from flexcage.stress.recovery import StressRecovery
from flexcage.stress.rivets import Rivets
from flexcage.stress.run_stress import RunStress, StressField
from flexcage.stress.series import ABOUT_PEAK, frames, samples_near
from flexcage.stress.sn_curves import SNCurve
from flexcage.stress.wear import Wear, wear
from flexcage.stress.wear_laws import WearLaw, wear_law
from flexcage.system.begun import Start
from flexcage.system.statics.rated import Lives
from flexcage.system.statics.rings import SeatedRing

if TYPE_CHECKING:
    import xarray

    from flexcage.mesh.riveted_joint import JointMesh
    from flexcage.stress.riveted_joint import Fits


class RunRecord:
    """One simulation, finished or not, without its summary: ``dataset``, ``stress(...)``."""

    def __init__(
        self,
        case: Case,
        store: MemoryRunStore,
        folder: Path | None,
        mesh: CageMesh | None,
        cage: CageReduction | None,
        start: Start | None = None,
        stages: Stages | None = None,
        edited: tuple[RunWarning, ...] = (),
        row: int | None = None,
    ) -> None:
        """``row``: the part of it that is of this row and its cage, where each row has one."""
        self.case, self.store, self.folder, self._row = case, store, folder, row
        self._mesh, self.cage, self.start = mesh, cage, start
        self.stages = stages if stages is not None else Stages()
        self.effort: Effort | None = None  # of the integration, if this process did it
        self.edited = edited  # a warning, if the folder's case.toml was changed after the run

    def __repr__(self) -> str:
        return f"{type(self).__name__}({self.case.name!r}: {self._size()})"

    def _size(self) -> str:
        where = f" in {self.folder}" if self.folder else ""
        return f"{self.store.n_time:,} samples{where}"

    @property
    def mesh(self) -> CageMesh:
        """The cage's mesh. Raises InputError where the bearing has no cage."""
        if self._mesh is None:
            self.case.its_cage  # noqa: B018  (says so)
        assert self._mesh is not None
        return mirror_image(self._mesh) if self._row else self._mesh

    @cached_property
    def dataset(self) -> xarray.Dataset:
        """All recorded variables, labelled, with units (an xarray.Dataset)."""
        whole = self.store.dataset()
        return whole if self._row is None else one_cage(whole, self._row)

    def row(self, k: int) -> Self:
        """The run with the elements of row k and their cage alone, where each row has a cage: what
        it says of motion, stress and wear is that of this cage, its pictures too. Energies, works
        and rings stay the whole bearing's. InputError for a row that is not there, or without a
        cage of its own."""
        if cage_count(self.dataset) == 1:
            raise InputError(
                "The rows of the run's bearing have no cages of their own; the run itself says all "
                "of its cage.",
                where="row", value=k,
            )  # fmt: skip
        check_cage(self.dataset, k)
        return type(self)(
            self.case, self.store, None, self._mesh, self.cage, self.start, self.stages, row=k
        )

    @cached_property
    def rows(self) -> tuple[Self, ...]:
        """Its rows, where each has a cage, as ``row`` gives them; else itself."""
        count = cage_count(self.dataset)
        return (self,) if count == 1 else tuple(self.row(k) for k in range(count))

    @cached_property
    def signals(self) -> xarray.Dataset:
        """Signals of the case's [[sensors]], by name, of the settled part (an xarray.Dataset).
        Raises InputError for a case without sensors."""
        return self.signals_of(self.case.sensors)

    def signals_of(self, sensors: Sequence[Sensor]) -> xarray.Dataset:
        """Signals of these sensors, whatever the case has (``results.signals``)."""
        from flexcage.run.sensors import run_signals

        return run_signals(self.case, self.dataset, self.numbers, sensors, lambda: self.cage_stress)

    @cached_property
    def events(self) -> xarray.Dataset:
        """Contacts that closed or opened: time [s], roller or ball, place, closed (an
        xarray.Dataset)."""
        from flexcage.results.events import contact_events

        events = contact_events(self.store.events(), self.store.layout.attrs)
        if self._row is None:
            return events
        own = own_events(events, self.store.dataset(), self._row)
        assert own is not None
        return own

    @property
    def steps(self) -> dict[str, np.ndarray]:
        """The solver's steps: time and step [s], order, Newton iterations, error over tolerance."""
        return self.store.steps()

    @property
    def bearing(self) -> Bearing:
        """The bearing that ran: as the case has it, or as its [fit] leaves it."""
        return self.case.mounted.bearing

    @cached_property
    def lives(self) -> Lives | None:
        """Lives as the case's [life] asks, of the static solution at the start; None without."""
        return solve_static(self.case).lives if self.case.life.given else None

    @property
    def numbers(self) -> BearingNumbers:
        return BearingNumbers.of(self.bearing)

    @cached_property
    def film_thickness(self) -> xarray.DataArray:
        """Lubricant's film [m] at every element and race, central and least (an xarray.DataArray):
        isothermal, fully flooded, by the recorded forces and speeds."""
        return film_thickness(self.dataset, self.bearing, self.case.lubricant.oil)

    @cached_property
    def groove_edges(self) -> list[Edge]:
        """Contact ellipses at the edges of grooves: the worst at each; none without grooves."""
        return groove_edges(self.bearing, self.dataset)

    @cached_property
    def cage_stress(self) -> RunStress:
        """Stress of the flexible cage over the run; InputError for a rigid one."""
        used = self.case.its_cage
        if self.cage is None:
            raise InputError("a rigid cage has no stress; run the case with cage.model = flexible")
        if len(self.rows) > 1:
            raise InputError(
                "Each row of the run's bearing has a cage; take one of them: run.row(0) is the run "
                "of the row at -x, and has its stress.",
                where="row",
            )
        return RunStress(
            cage=self.cage,
            places=cage_type_of(used).places(),
            mesh=self.mesh,
            dataset=self.dataset,
            store=self.store,
            numbers=self.numbers,
            settle=self.case.output.settle,
            inner_land=used.land_ring == "inner",
            stages=self.stages,
            k=self._row or 0,
        )

    @property
    def recovery(self) -> StressRecovery:
        """Stress recovery of the flexible cage; InputError for a rigid one."""
        return self.cage_stress.recovery

    @cached_property
    def mode_table(self) -> ModeTable:
        """Number, kind, frequency and effective masses of the flexible cage's dynamic modes."""
        self.case.its_cage  # noqa: B018  (says so where there is none)
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
        return self.cage_stress.fatigue(place, curve, material=self.case.its_cage.material.name)

    def wear(self, law: WearLaw | None = None) -> Wear:
        """Rates of wear of pockets and land over the settled part by Archard's law; by default
        with the dry coefficient of the cage's material. InputError for a material without one."""
        case = self.case
        used = wear_law(case.its_cage.material.name) if law is None else law
        expect(used, WearLaw, "law")
        check_spec(used, "law")
        ds = settled(self.dataset, case.output.settle)
        windows = element_passes(ds, self.numbers)
        return wear(ds, self.bearing, case.its_cage, case.land, used, windows)

    @cached_property
    def rivets(self) -> Rivets:
        """What the rivets of a riveted cage bear (``stress.rivets.Rivets``): ``dataset`` and
        ``table``; InputError for any other cage, and for a rigid one."""
        stress, cage = self.cage_stress, self.case.its_cage  # refuses a rigid cage
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
        cage, bearing = case.its_cage, self.bearing
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
        """The rings that bend, on their seats, reduced again; InputError if both are rigid."""
        if "ring_load" not in self.dataset:
            raise InputError(
                "both rings of the run are rigid; run the case with outer_ring.ring or "
                "inner_ring.ring = 'flexible'",
                where="outer_ring.ring",
            )
        bent = self.stages("rings", bent_rings, self.case)
        return tuple(ring.seated for ring in bent)

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
        folder = path_of(folder, "folder")
        check_no_file(folder)
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


def _si(value: float | str, unit: str, where: str) -> float:
    """A number in SI as it is, or a text with its unit."""
    return value if isinstance(value, (int, float)) else parse(value, unit, where=where)
