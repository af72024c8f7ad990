"""What a run writes as tables for other programs: its dataset, and what follows from it."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from flexcage.results import export
from flexcage.results.registry import TIME

if TYPE_CHECKING:
    import xarray

    from flexcage.run.record import RunRecord

#: What columns of the solver's steps are called in a table, and units.
_STEPS = {"time": ("step_time", "s"), "step": ("step_size", "s")}


def write_table(
    run: RunRecord, path: Path, variables: Sequence[str] | str | None = None, *, force: bool = False
) -> list[Path]:
    """Write variables of a run, see ``Run.write_table``."""
    export.check_ending(path)  # before anything is computed
    variables = [variables] if isinstance(variables, str) else variables
    ds, names = _tabled(run, variables)
    return export.write_table(ds, path, names, force=force)


def _tabled(run: RunRecord, names: Sequence[str] | None) -> tuple[xarray.Dataset, list[str] | None]:
    """A dataset that holds variables of a run by these names, and what they are called in it."""
    ds = run.dataset
    if names is None:
        return ds, None
    found: list[str] = []
    for name in names:
        if name in ds.variables:
            found.append(name)
            continue
        export.check_there(name, [*map(str, ds.data_vars), *EXTRA_TABLES])
        more = EXTRA_TABLES[name](run)
        ds = ds.assign(more)
        found += more
    return ds, found


def _stress(run: RunRecord) -> dict[str, Any]:
    import xarray

    history = run.stress_history
    attrs = {"units": "Pa", "long_name": "largest equivalent stress since the sample before"}
    names = {"place": list(history.place_names)}
    return {"stress": xarray.DataArray(history.places, names, (TIME, "place"), attrs=attrs)}


def _stress_peak(run: RunRecord) -> dict[str, Any]:
    attrs = {"units": "Pa", "long_name": "largest equivalent stress of the cage off flat walls"}
    return {"stress_peak": (TIME, run.stress_history.peak, attrs)}


def _film(run: RunRecord) -> dict[str, Any]:
    return {"film_thickness": run.film_thickness}


def _events(run: RunRecord) -> dict[str, Any]:
    return {f"event_{name}": v.variable for name, v in run.events.data_vars.items()}


def _steps(run: RunRecord) -> dict[str, Any]:
    found = {}
    for column, values in run.steps.items():
        name, unit = _STEPS.get(column, (f"step_{column}", "1"))
        found[name] = ("step", values, {"units": unit})
    return found


#: What a run has beside its dataset, by name: the variables that it becomes.
EXTRA_TABLES: Mapping[str, Callable[[RunRecord], dict[str, Any]]] = {
    "stress": _stress,
    "stress_peak": _stress_peak,
    "film_thickness": _film,
    "events": _events,
    "steps": _steps,
}
