"""The cage's stress at chosen samples, as frames of a series of files."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence

import numpy as np

from flexcage.core.binding import wrong_type
from flexcage.core.errors import InputError
from flexcage.core.units import parse
from flexcage.mesh.series import Frame
from flexcage.stress.operators import von_mises

ABOUT_PEAK = 4e-4  # s before and after the largest stress: what animations and VTU series show


def samples_near(t: np.ndarray, times: Sequence[float | str]) -> np.ndarray:
    """Numbers (n,) of the samples of the rising ``t`` [s] nearest to ``times``, in seconds or texts
    with their unit, each once.

    Raises InputError for what is no list of times, and for a time more than a step outside.
    """
    if isinstance(times, (str, bytes)) or np.ndim(times) != 1 or len(times) == 0:
        raise wrong_type(times, "a list of times, such as [0.01, 0.02]", "times")
    step = float(np.diff(t).max(initial=0.0)) * (1.0 + 1e-9)
    return np.unique([_sample_near(t, step, as_time(time)) for time in times])


def as_time(time: object) -> float:
    """A time [s] from a number (of an array too), or from a text with its unit."""
    number = np.asarray(time)
    if number.ndim == 0 and number.dtype.kind in "iuf":
        return float(number)
    return parse(time, "ms", where="time")


def _sample_near(t: np.ndarray, step: float, time: float) -> int:
    if not t[0] - step <= time <= t[-1] + step:
        raise InputError(
            f"There is no sample at {time * 1e3:g} ms; the run has {t[0] * 1e3:g} to "
            f"{t[-1] * 1e3:g} ms.",
            where="time",
            value=time,
        )
    return int(np.abs(t - time).argmin())


def frames(
    times: np.ndarray,
    field_at: Callable[[float], tuple[np.ndarray, np.ndarray]],
    advance: Callable[[], None],
) -> Iterator[Frame]:
    """Fields of every instant [s] by name, at the mesh's vertices.

    ``field_at(time)`` gives displacements (N, 3) [m] at nodes, vertices first, and stresses
    (n_points, 6) [Pa]; ``advance`` hears of every frame.
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
        advance()
