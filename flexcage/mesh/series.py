"""Fields on a mesh over time as files for ParaView: one .vtu an instant, and a .pvd that names all.

ParaView opens the .pvd as one animated data set.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from pathlib import Path

import numpy as np

from flexcage.core.binding import path_of
from flexcage.core.errors import InputError, unwritable
from flexcage.core.writing import write_text

Frame = tuple[float, Mapping[str, np.ndarray]]  # time [s]; name to values (n_points, ...)


def write_series(
    folder: str | Path,
    name: str,
    points: np.ndarray,
    tets: np.ndarray,
    frames: Iterable[Frame],
) -> Path:
    """Write ``name_0000.vtu`` ... and ``name.pvd`` into ``folder``; the path of the .pvd.

    ``points`` (n, 3) [m] and ``tets`` (m, 4) are the same in all; every frame brings its time [s]
    and its fields at the points. Raises InputError for a folder that holds files or cannot be
    written. The .pvd is written last: a series that stopped half-way has none.
    """
    import meshio

    folder = new_folder(folder)
    written: list[tuple[float, str]] = []
    for time, fields in frames:
        file = f"{name}_{len(written):04d}.vtu"
        data = {key: np.asarray(values, np.float32) for key, values in fields.items()}
        meshio.write(folder / file, meshio.Mesh(points, [("tetra", tets)], point_data=data))
        written.append((time, file))
    path = folder / f"{name}.pvd"
    write_text(path, _collection(written))
    return path


def new_folder(folder: str | Path) -> Path:
    """An empty folder, made if it is not there; InputError otherwise."""
    folder = path_of(folder, "folder")
    try:
        folder.mkdir(parents=True, exist_ok=True)
        full = any(folder.iterdir())
    except OSError as exc:
        raise unwritable(f"The folder '{folder}'", exc, path=folder) from exc
    if full:
        raise InputError(
            f"The output folder '{folder}' exists already; name another.",
            where="folder",
            value=str(folder),
        )
    return folder


def _collection(written: list[tuple[float, str]]) -> str:
    """The .pvd's text: instants [s] and their files."""
    sets = "".join(
        f'    <DataSet timestep="{time:.9g}" group="" part="0" file="{file}"/>\n'
        for time, file in written
    )
    return (
        '<?xml version="1.0"?>\n'
        '<VTKFile type="Collection" version="0.1" byte_order="LittleEndian">\n'
        f"  <Collection>\n{sets}  </Collection>\n</VTKFile>\n"
    )
