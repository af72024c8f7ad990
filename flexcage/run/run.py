"""A run: what was asked, what happened, and what can be asked of it afterwards."""

from __future__ import annotations

import logging
import os
from collections.abc import Callable, Sequence
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Any

from flexcage.core.binding import Binder, path_of
from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.core.output_folders import check_no_file
from flexcage.core.progress import Silent
from flexcage.results import mode_file
from flexcage.run.rings import rings_at
from flexcage.run.summarised import SummarisedRun
from flexcage.run.summary import summary_of
from flexcage.solve.contract import Effort
from flexcage.system.statics.rings import BentRing

if TYPE_CHECKING:
    from flexcage.render.album import Scene
    from flexcage.results.signals.spec import Sensor

log = logging.getLogger(__name__)


class Run(SummarisedRun):
    """One simulation, finished or not: ``dataset``, ``summary``, ``stress(...)``, ``draw(...)``."""

    def rings(self, *, time: float | str | None = None) -> tuple[BentRing, ...]:
        """The rings that bend, at the sample nearest to ``time``, in seconds or a text with its
        unit; default: when they yield most in the settled part.

        As those of a static solution: ``stress.rings.ring_field`` gives their stress,
        ``static.draw_ring`` their picture. Raises InputError if both are rigid, or for a time
        outside the run.
        """
        return rings_at(self, time)[1]

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

    def write_signals(
        self, path: str | Path, sensors: Sequence[Sensor] | None = None, *, force: bool = False
    ) -> list[Path]:
        """Write the signals of the case's [[sensors]], or of other ``sensors``, as .csv, .parquet,
        .mat, .wav or .uff; paths of the files, in .csv, .parquet and .wav one for each rate.

        Values are in SI; unit, place and rate stand beside them (``results.signals.files``).
        Raises InputError for a case without sensors, another ending, or a file that is there,
        unless ``force`` is given; EnvironmentLacks without pyuff.
        """
        from flexcage.results.signals.files import check_ending, write_signals

        path = path_of(path, "path")
        check_ending(path)
        signals = self.signals if sensors is None else self.signals_of(sensors)
        return write_signals(signals, path, force=force)

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
            self.report_times()
        return paths

    @property
    def picture_names(self) -> list[str]:
        """Names of the run's pictures."""
        from flexcage.run.pictures import picture_names_of

        return picture_names_of(self)

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
