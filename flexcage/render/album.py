"""All pictures of one run, with fixed file names and cameras, so that runs lie side by side.

The mesh's picture alone turns to what it marks, the first defect. A ``Look`` turns all pictures of
the cage, and fixes the range of stress and the factor of deformation, which else follow the run.
``register_picture`` adds a user's own to every album.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import FlexcageError, RunFailed, mistake_in
from flexcage.core.garbage import few_collections
from flexcage.core.progress import Silent
from flexcage.core.registry import add, check_free
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.basis import ModeBasis
from flexcage.render import sheet
from flexcage.render.look import Look
from flexcage.results import spectra
from flexcage.results.metrics import BearingNumbers, settled

if TYPE_CHECKING:
    import xarray

    from flexcage.stress.places import PlaceKind

Drawing = partial[Path]  # draws one picture, and gives its path

_FILES = (
    "mesh", "modes", "bearing", "orbit", "histories", "spectra", "stress_peak", "stress_envelope",
    "deformation",
)  # fmt: skip


@dataclass(frozen=True, kw_only=True)
class StressPictures:
    """What the stress pictures of a flexible cage show."""

    nodes: np.ndarray  # (N, 3) FE nodes [m]
    cells: np.ndarray  # (n, 4 or 10) their tetrahedra; with 10 nodes, edges' middles are drawn
    basis: ModeBasis
    time: float  # of the peak [s]
    displacement: np.ndarray  # (N, 3) [m] at that time
    von_mises: np.ndarray  # (N,) [Pa] at that time
    envelope: np.ndarray  # (N,) [Pa] largest over the run
    peak_vertex: int  # a node
    peak_place: str  # its name
    settled: int  # first sample of the envelope
    roots: np.ndarray  # (nt, places) [Pa]
    root_names: Sequence[str]
    root_kind: PlaceKind
    frames: Sequence[tuple[float, np.ndarray, np.ndarray]] = ()  # time, displacement, stress


@dataclass(frozen=True, kw_only=True)
class Scene:
    """One run as the pictures need it."""

    name: str
    dataset: xarray.Dataset
    bearing: Any  # its spec
    mesh: CageMesh
    defects: Sequence[Any]
    loads: np.ndarray  # (time, 3) F_x, F_y, F_z [N] on the inner ring
    clearance: float | None  # radial land clearance [m], where there is a land
    guide: str  # the land's ring, "inner" or "outer"
    settle: float
    stress: StressPictures | None = None

    @property
    def label(self) -> str:
        """Its name as headings show it."""
        return sheet.label(self.name)

    @property
    def followed(self) -> int:
        """Number of the element whose history is shown: that of the first damaged pocket, or 0."""
        return self.defects[0].pockets(self.mesh.pocket_count)[0] if self.defects else 0


#: Pictures registered from outside by name, with whether they need a flexible cage's stress.
PICTURES: dict[str, tuple[Callable[[Scene, Path], Path], bool]] = {}


def register_picture(
    name: str, draw: Callable[[Scene, Path], Path], *, needs_stress: bool = False
) -> None:
    """Add a picture: every album then has ``name.png``, drawn by ``draw(scene, path)``.

    ``draw`` takes a ``Scene`` (dataset, bearing, mesh, defects and, for a flexible cage,
    ``stress``) and the path to write to, and returns the path it wrote. ``needs_stress`` leaves
    the picture out for a rigid cage. Raises InputError for a name that is taken.
    """
    taken = dict.fromkeys(_FILES)
    check_free(taken, name, what="picture")
    add(PICTURES, name, (draw, needs_stress), what="picture")


def draw_album(
    scene: Scene,
    folder: Path,
    *,
    animate: bool = False,
    look: Look | None = None,
    progress: Callable[..., Any] = Silent,
) -> list[Path]:
    """Draw all pictures into ``folder``; their paths. ``progress`` is a context like
    ``core.progress.Progress``."""
    folder.mkdir(parents=True, exist_ok=True)
    look = look or Look()
    drawings = [*_geometry(scene, folder, look), *_motion(scene, folder)]
    if scene.stress is not None:
        drawings += _stress(scene, scene.stress, folder, look)
    for name, (draw, needs_stress) in PICTURES.items():
        if scene.stress is not None or not needs_stress:
            drawings.append(partial(_draw_own, name, draw, scene, folder / f"{name}.png"))
    if animate:
        drawings += _animations(scene, folder, look)
    paths: list[Path] = []
    with progress(len(drawings), "pictures") as bar, few_collections():
        for drawing in drawings:
            paths.append(drawing())
            bar.advance()
    return paths


def _draw_own(name: str, draw: Callable[[Scene, Path], Path], scene: Scene, path: Path) -> Path:
    """A picture registered from outside; a mistake in its function is told as the user's."""
    try:
        if path.is_symlink():
            path.unlink()  # not written through
        return Path(draw(scene, path))
    except FlexcageError:
        raise
    except Exception as exc:
        raise RunFailed(
            f"the registered picture '{name}' could not be drawn: {mistake_in(draw, exc)}; "
            "what was computed and drawn before is kept"
        ) from exc


def _geometry(scene: Scene, folder: Path, look: Look) -> list[Drawing]:
    from flexcage.render.mesh_pictures import mesh_picture
    from flexcage.render.mode_pictures import mode_sheet

    drawings = [
        partial(
            mesh_picture,
            scene.mesh,
            folder / "mesh.png",
            defects=scene.defects,
            azimuth=look.view,
            note=scene.label,
        )
    ]
    if scene.stress is not None:
        b = scene.stress.basis
        drawings.append(
            partial(
                mode_sheet,
                scene.stress.nodes,
                scene.stress.cells,
                b.shapes,
                b.frequencies,
                b.kind,
                folder / "modes.png",
                note=scene.label,
            )
        )
    return drawings


def _motion(scene: Scene, folder: Path) -> list[Drawing]:
    from flexcage.render.bearing_pictures import bearing_picture
    from flexcage.render.curves import histories, orbit
    from flexcage.render.spectra import spectra_picture

    b, ds = scene.bearing, scene.dataset
    numbers = BearingNumbers.of(b)
    root = None
    if scene.stress is not None:
        import xarray

        root = xarray.DataArray(
            scene.stress.roots,
            dims=("time", "place"),
            coords={"time": ds["time"], "place": list(scene.stress.root_names)},
            attrs={
                "units": "Pa",
                "long_name": f"equivalent stress at {scene.stress.root_kind.many}",
            },
        )
    first = ds.sizes["time"] - settled(ds, scene.settle).sizes["time"]
    pushed = ds["pocket_force"].sum(["pocket", "face"]).values
    busiest = first + int(np.argmax(pushed[first:]))
    index = busiest if scene.stress is None else int(
        np.abs(ds["time"].values - scene.stress.time).argmin()
    )  # fmt: skip
    drawings = [
        partial(
            bearing_picture, ds, b, index, folder / "bearing.png", cage_points=scene.mesh.points,
            cage_tets=scene.mesh.tets, load=tuple(scene.loads[index, 1:]),
            axial=float(scene.loads[index, 0]), note=scene.label,
        ),
        partial(
            orbit, ds, folder / "orbit.png", clearance=scene.clearance, guide=scene.guide,
            settle=scene.settle, note=scene.label,
        ),
        partial(
            histories, ds, folder / "histories.png", bearing=numbers, root_stress=root,
            loads=scene.loads, element=scene.followed, settle=scene.settle, note=scene.label,
        ),
    ]  # fmt: skip
    if spectra.resolves(settled(ds, scene.settle), numbers):
        drawings.append(
            partial(
                spectra_picture, ds, folder / "spectra.png", bearing=numbers, settle=scene.settle,
                note=scene.label,
            )
        )  # fmt: skip
    return drawings


def _stress(scene: Scene, s: StressPictures, folder: Path, look: Look) -> list[Drawing]:
    from flexcage.render.stress_pictures import (
        deformation_picture,
        envelope_picture,
        stress_picture,
    )

    ds, count = scene.dataset, scene.mesh.pocket_count
    t = ds["time"].values
    return [
        partial(
            stress_picture, s.nodes, s.cells, s.displacement, s.von_mises,
            folder / "stress_peak.png", time=s.time, peak_label=s.peak_place,
            peak_node=s.peak_vertex, scale=look.scale, limit=look.stress_limit,
            pocket_count=count, azimuth=look.azimuth, note=scene.label,
        ),
        partial(
            envelope_picture, s.nodes, s.cells, s.envelope, folder / "stress_envelope.png",
            span=(t[s.settled], t[-1]), peak_label=s.peak_place, peak_node=s.peak_vertex,
            limit=look.stress_limit, pocket_count=count, azimuth=look.azimuth, note=scene.label,
        ),
        partial(
            deformation_picture, s.nodes, s.cells, s.displacement, folder / "deformation.png",
            time=s.time, scale=look.scale, pocket_count=count, azimuth=look.azimuth,
            note=scene.label,
        ),
    ]  # fmt: skip


def _animations(scene: Scene, folder: Path, look: Look) -> list[Drawing]:
    from flexcage.render.animations import animate_bearing, animate_stress

    drawings = [
        partial(
            animate_bearing, scene.dataset, scene.bearing, folder / "bearing.gif", frames=40,
            cage_points=scene.mesh.points, cage_tets=scene.mesh.tets, loads=scene.loads,
            note=scene.label,
        )
    ]  # fmt: skip
    if scene.stress is not None and scene.stress.frames:
        times, shifts, stresses = zip(*scene.stress.frames, strict=True)
        drawings.append(
            partial(
                animate_stress,
                scene.stress.nodes,
                scene.stress.cells,
                shifts,
                stresses,
                times,
                folder / "stress.gif",
                pocket_count=scene.mesh.pocket_count,
                azimuth=look.azimuth,
                limit=look.stress_limit,
                scale=look.scale,
                note=scene.label,
            )
        )
    return drawings
