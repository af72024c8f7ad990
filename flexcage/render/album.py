"""All pictures of one run, with fixed file names and cameras, so that runs lie side by side.

The mesh's picture alone turns to what it marks, the first defect. A ``Look`` turns all pictures of
the cage, and fixes the range of stress and the factor of deformation, which else follow the run.
``register_picture`` adds a user's own to every album.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.binding import did_you_mean
from flexcage.core.errors import FlexcageError, InputError, RunFailed, mistake_in
from flexcage.core.garbage import few_collections
from flexcage.core.progress import Silent
from flexcage.core.registry import add, check_free
from flexcage.mesh.cage_mesh import CageMesh
from flexcage.modes.basis import ModeBasis
from flexcage.render import sheet
from flexcage.render.look import Look
from flexcage.results import spectra
from flexcage.results.metrics import settled
from flexcage.results.registry import NEIGHBOURS
from flexcage.results.slip import BearingNumbers

if TYPE_CHECKING:
    import xarray

    from flexcage.stress.places import PlaceKind

#: Pictures of every run, and those of a flexible cage; ``spectra`` of a run long enough for them.
_OF_MOTION = ("mesh", "bearing", "orbit", "histories", "spectra")
_OF_CAGE = ("mesh", "orbit")  # of these
_OF_STRESS = ("modes", "stress_peak", "stress_pocket", "stress_envelope", "deformation")
_UNSTRESSED = ("mesh", "orbit", "spectra")  # that are the same with and without stress
FORMATS = ("png", "svg", "pdf")  # of curves; scenes are .png


@dataclass(frozen=True)
class Drawing:
    """One picture: ``draw(path)`` writes the file of this name and ending."""

    name: str
    ending: str
    draw: Callable[[Path], Any]


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
    mesh: CageMesh | None  # None: no cage
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
        if not self.defects or self.mesh is None:
            return 0
        return int(self.defects[0].pockets(self.mesh.pocket_count)[0])


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
    taken = dict.fromkeys((*_OF_MOTION, *_OF_STRESS))
    check_free(taken, name, what="picture")
    add(PICTURES, name, (draw, needs_stress), what="picture")


def picture_names(*, caged: bool = True, flexible: bool, resolved: bool) -> list[str]:
    """Names of the pictures of a run: with a cage, that is ``flexible``, its spectra
    ``resolved``."""
    names = [name for name in _OF_MOTION if resolved or name != "spectra"]
    names = [name for name in names if caged or name not in _OF_CAGE]
    names += _OF_STRESS if flexible else ()
    return [
        *names,
        *(n for n, (_, needs_stress) in PICTURES.items() if flexible or not needs_stress),
    ]


#: Pictures, the animation included, that change with each value of a ``Look``.
_LOOKS = {
    "view": ("mesh", "stress_peak", "stress_envelope", "deformation", "stress"),
    "stress_limit": ("stress_peak", "stress_pocket", "stress_envelope", "stress"),
    "scale": ("stress_peak", "deformation", "stress"),
}


def changed_by(look: Iterable[str], names: Sequence[str]) -> list[str]:
    """Those of ``names`` that change with these values of a ``Look``."""
    changed = {name for value in look for name in _LOOKS[value]}
    return [name for name in names if name in changed]


def need_stress(only: Sequence[str]) -> bool:
    """Whether pictures of these names, or all without any, show a flexible cage's stress."""
    return not only or not set(only) <= set(_UNSTRESSED)


def check_names(only: Sequence[str], known: Sequence[str]) -> None:
    """InputError for a picture that a run has not."""
    for name in only:
        if name not in known:
            parts = [part for part in re.split("[,; ]+", name) if part in known]
            near = (
                f"name each by itself: {' '.join(parts)}; "
                if len(parts) > 1
                else _near(name, known)
            )
            raise InputError(
                f"The run has no picture '{name}'; {near}its pictures are {', '.join(known)}.",
                where="only",
                value=name,
            )


def _near(name: str, known: Sequence[str]) -> str:
    hint = did_you_mean(name, known, "")
    return f"{hint}; " if hint.startswith("the nearest") else ""


def check_format(name: str) -> None:
    """InputError for a format that curves cannot have."""
    if name not in FORMATS:
        raise InputError(
            f"The format of pictures is '{name}', but must be {', '.join(FORMATS[:-1])} or "
            f"{FORMATS[-1]}.",
            where="format",
            value=name,
        )


def draw_album(
    scene: Scene,
    folder: Path,
    *,
    animate: bool = False,
    look: Look | None = None,
    only: Sequence[str] = (),
    format: str = "png",
    progress: Callable[..., Any] = Silent,
) -> list[Path]:
    """Draw all pictures into ``folder``, or ``only`` those of these names, and animations if they
    are asked for; their paths.

    Curves are drawn in ``format`` ("svg" and "pdf" are vector graphics), scenes as .png.
    ``progress`` is a context like ``core.progress.Progress``.
    """
    folder.mkdir(parents=True, exist_ok=True)
    look = look or Look()
    drawings = [*_geometry(scene, look), *_motion(scene, format)]
    if scene.stress is not None:
        drawings += _stress(scene, scene.stress, look)
    for name, (draw, needs_stress) in PICTURES.items():
        if scene.stress is not None or not needs_stress:
            drawings.append(Drawing(name, "png", partial(_draw_own, name, draw, scene)))
    drawings = [drawing for drawing in drawings if not only or drawing.name in only]
    if animate:
        drawings += _animations(scene, look)
    paths: list[Path] = []
    with progress(len(drawings), "pictures") as bar, few_collections():
        for drawing in drawings:
            paths.append(drawing.draw(folder / f"{drawing.name}.{drawing.ending}"))
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


def _geometry(scene: Scene, look: Look) -> Iterator[Drawing]:
    from flexcage.render.mesh_pictures import mesh_picture
    from flexcage.render.mode_pictures import mode_sheet

    if scene.mesh is not None:
        yield Drawing("mesh", "png", partial(
            mesh_picture, scene.mesh, defects=scene.defects, azimuth=look.view, note=scene.label,
        ))  # fmt: skip
    if scene.stress is not None:
        s, b = scene.stress, scene.stress.basis
        yield Drawing("modes", "png", partial(
            mode_sheet, s.nodes, s.cells, b.shapes, b.frequencies, b.kind, note=scene.label,
        ))  # fmt: skip


def _motion(scene: Scene, format: str) -> Iterator[Drawing]:
    from flexcage.render.bearing_pictures import bearing_picture
    from flexcage.render.curves import histories, orbit
    from flexcage.render.spectra import spectra_picture

    b, ds = scene.bearing, scene.dataset
    numbers = BearingNumbers.of(b)
    index = _shown_sample(scene)
    yield Drawing("bearing", "png", partial(
        bearing_picture, ds, b, index, **_cage_of(scene),
        load=tuple(scene.loads[index, 1:]), axial=float(scene.loads[index, 0]), note=scene.label,
    ))  # fmt: skip
    if scene.mesh is not None:
        yield Drawing("orbit", format, partial(
            orbit, ds, clearance=scene.clearance, guide=scene.guide, settle=scene.settle,
            note=scene.label,
        ))  # fmt: skip
    yield Drawing("histories", format, partial(
        histories, ds, bearing=numbers, root_stress=_root_stress(scene), loads=scene.loads,
        element=scene.followed, settle=scene.settle, note=scene.label,
    ))  # fmt: skip
    if spectra.resolves(settled(ds, scene.settle), numbers):
        yield Drawing("spectra", format, partial(
            spectra_picture, ds, bearing=numbers, settle=scene.settle, note=scene.label,
        ))  # fmt: skip


def _cage_of(scene: Scene) -> dict[str, Any]:
    """The cage's mesh, as pictures of the bearing take it; nothing without a cage."""
    if scene.mesh is None:
        return {}
    return {"cage_points": scene.mesh.points, "cage_tets": scene.mesh.tets}


def _shown_sample(scene: Scene) -> int:
    """The sample at which the bearing is shown: of the largest stress, or of the largest forces on
    pockets, or without a cage between neighbours."""
    ds = scene.dataset
    if scene.stress is not None:
        return int(np.abs(ds["time"].values - scene.stress.time).argmin())
    first = ds.sizes["time"] - settled(ds, scene.settle).sizes["time"]
    if scene.mesh is None:
        pushed = ds[NEIGHBOURS].sum("element").values
    else:
        pushed = ds["pocket_force"].sum(["pocket", "face"]).values
    return first + int(np.argmax(pushed[first:]))


def _root_stress(scene: Scene) -> xarray.DataArray | None:
    """Stress (time, place) [Pa] at the roots of a flexible cage."""
    if scene.stress is None:
        return None
    import xarray

    return xarray.DataArray(
        scene.stress.roots,
        dims=("time", "place"),
        coords={"time": scene.dataset["time"], "place": list(scene.stress.root_names)},
        attrs={"units": "Pa", "long_name": f"equivalent stress at {scene.stress.root_kind.many}"},
    )


def _stress(scene: Scene, s: StressPictures, look: Look) -> Iterator[Drawing]:
    from flexcage.render.bearing_pictures import instant
    from flexcage.render.pocket_pictures import nearest_pocket, pocket_picture
    from flexcage.render.stress_pictures import (
        deformation_picture,
        envelope_picture,
        stress_picture,
    )

    assert scene.mesh is not None, "stress is that of a cage"
    t = scene.dataset["time"].values
    seen: dict[str, Any] = {
        "pocket_count": scene.mesh.pocket_count, "azimuth": look.azimuth, "note": scene.label,
    }  # fmt: skip
    peak: dict[str, Any] = {
        "peak_label": s.peak_place, "peak_node": s.peak_vertex, "limit": look.stress_limit
    }  # fmt: skip
    yield Drawing("stress_peak", "png", partial(
        stress_picture, s.nodes, s.cells, s.displacement, s.von_mises, time=s.time,
        scale=look.scale, **peak, **seen,
    ))  # fmt: skip
    yield Drawing("stress_pocket", "png", partial(
        pocket_picture, s.nodes, s.cells, s.displacement, s.von_mises,
        shown=instant(scene.dataset, int(np.argmin(np.abs(t - s.time)))), bearing=scene.bearing,
        pitch_radius=float(scene.dataset["element_position"][0].sel(cyl="r").mean()),
        pocket=nearest_pocket(s.nodes[s.peak_vertex], scene.bearing),
        limit=look.stress_limit, note=scene.label,
    ))  # fmt: skip
    yield Drawing("stress_envelope", "png", partial(
        envelope_picture, s.nodes, s.cells, s.envelope, span=(t[s.settled], t[-1]), **peak, **seen,
    ))  # fmt: skip
    yield Drawing("deformation", "png", partial(
        deformation_picture, s.nodes, s.cells, s.displacement, time=s.time, scale=look.scale,
        **seen,
    ))  # fmt: skip


def _animations(scene: Scene, look: Look) -> Iterator[Drawing]:
    from flexcage.render.animations import animate_bearing, animate_stress

    s = scene.stress
    yield Drawing("bearing", "gif", partial(
        animate_bearing, scene.dataset, scene.bearing, frames=40, loads=scene.loads,
        note=scene.label, **_cage_of(scene),
    ))  # fmt: skip
    if s is not None and scene.mesh is not None and s.frames:
        times, shifts, stresses = zip(*s.frames, strict=True)
        yield Drawing("stress", "gif", partial(
            animate_stress, s.nodes, s.cells, shifts, stresses, times,
            pocket_count=scene.mesh.pocket_count, azimuth=look.azimuth, limit=look.stress_limit,
            scale=look.scale, note=scene.label,
        ))  # fmt: skip
