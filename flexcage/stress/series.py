"""The cage's stress at chosen samples, as frames of a series of files."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from flexcage.core.errors import InputError
from flexcage.mesh.series import Frame
from flexcage.stress.operators import von_mises


def samples_near(t: np.ndarray, times: Sequence[float]) -> np.ndarray:
    """Samples (n,) of the rising ``t`` [s] that lie nearest to ``times`` [s], each once.

    Raises InputError for a time that is more than a step outside.
    """
    step = float(np.diff(t).max(initial=0.0)) * (1.0 + 1e-9)
    for time in times:
        if not t[0] - step <= time <= t[-1] + step:
            raise InputError(
                f"There is no sample at {time * 1e3:g} ms; the run has {t[0] * 1e3:g} to "
                f"{t[-1] * 1e3:g} ms.",
                where="times",
                value=time,
            )
    return t[np.unique([int(np.abs(t - time).argmin()) for time in times])]


def frames(
    times: np.ndarray,
    field_at: Callable[[float], tuple[np.ndarray, np.ndarray]],
    told: Callable[[], None],
) -> Iterator[Frame]:
    """Fields of every instant [s] by name, at the mesh's vertices.

    ``field_at(time)`` gives displacements (N, 3) [m] at nodes, vertices first, and stresses
    (n_points, 6) [Pa]; ``told`` hears of every frame.
    """
    for time in times:
        displacement, stress = field_at(float(time))
        yield (
            float(time),
            {
                "displacement": displacement[: len(stress)],
                "von_mises": von_mises(stress),
                "stress": stress,
            },
        )
        told()
