"""One recording of a data set: the signals of one case, its rows, and the truth behind it."""

from __future__ import annotations

import hashlib
import json
from collections.abc import Mapping
from dataclasses import dataclass
from io import BytesIO
from math import isfinite, pi
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.case import Case
from flexcage.results.each_cage import one_cage
from flexcage.results.features import cage_motion_features, orbit_class
from flexcage.results.figures.effort import is_wall_time
from flexcage.results.frequencies import bearing_frequencies
from flexcage.results.metrics import pocket_peaks, settled
from flexcage.study.case_row import CaseRow
from flexcage.study.dataset import labels
from flexcage.study.plan import Planned

if TYPE_CHECKING:
    import xarray

    from flexcage.run import Run

#: The schema's unit of each SI unit of a signal, and its place of a sensor.
_UNITS = {"m/s^2": "m/s^2", "m": "m", "N m": "Nm", "1": "normalized"}
_NONE_OF_ITS_OWN = {"strain": ("unknown", "unknown")}  # quantities that the schema has no word for
_MOUNTED = {
    "outer_ring": "outer_ring", "inner_ring": "shaft", "cage": "none", "housing": "pedestal",
}  # fmt: skip
_AXES = {
    "axial": "axial", "0": "y", "90": "z", "180": "y", "270": "z", "none": "none",
    "circumferential": "tangential",
}  # fmt: skip
TRUTH_VARIABLES = ("outer_race_force", "inner_race_force", "defect_force")


@dataclass(frozen=True)
class Recording:
    """Files of a recording by path in the data set, rows of the metadata table, and its truth."""

    files: Mapping[str, bytes]
    rows: list[dict[str, Any]]
    truth: dict[str, Any]


def recording_of(run: Run, planned: Planned, row: CaseRow, name: str, edges: tuple) -> Recording:
    """What a data set called ``name`` keeps of a finished case; ``edges`` [m] part severities."""
    case = run.case
    signals = run.signals_of(labels.with_own_noise(case))
    file = f"part-{case.hash}.parquet"
    arrays = {str(n): s.values.astype(np.float32) for n, s in signals.data_vars.items()}
    files = {
        f"signals/{file}": _signals_file(case.hash, arrays),
        f"truth/{case.hash}.parquet": _hidden_file(hidden(run)),
    }
    shared = _of_case(case, run, planned, name, edges)
    rows = [
        {**shared, **channel_row(case, str(n), s, file, k)}
        for k, (n, s) in enumerate(signals.data_vars.items())
    ]
    return Recording(files, rows, _truth(case, run, planned, row, shared))


def _of_case(case: Case, run: Run, planned: Planned, name: str, edges: tuple) -> dict[str, Any]:
    """What the rows of all channels of a recording share."""
    fault, load = labels.fault_of(case), case.load
    level = labels.level_of(fault, edges)
    orders = bearing_frequencies(run.numbers, 2.0 * pi)
    own = ", ".join(planned.point.labels.values()) or str(planned.point)
    return {
        "dataset": name, "recording_id": case.hash, "native_label": own,
        "fault_type": fault.name, "fault_location": fault.place,
        "sensor_location": labels.PLACE, "sensor_at_fault": bool(fault.kinds),
        "speed_rpm": float(abs(run.dataset["inner_speed"]).mean()) * 30.0 / pi,
        "speed_profile": labels.speed_profile(case),
        "load": float(np.hypot(load.radial, load.axial)), "load_unit": "N",
        "operating_condition": labels.condition(case),
        "fault_origin": "artificial" if fault.kinds else "none",
        "fault_size_mm": 1e3 * fault.size,
        "fault_severity": labels.severity_of(fault, edges), "fault_severity_level": level,
        "bearing_id": labels.bearing_id(case),
        "bearing_model": case.bearing.designation or "unknown",
        "bpfo": orders["BPFO"], "bpfi": orders["BPFI"], "bsf": orders["BSF"], "ftf": orders["FTF"],
        "repetition": planned.repetition,
    }  # fmt: skip


def channel_row(
    case: Case, channel: str, signal: xarray.DataArray, file: str, k: int
) -> dict[str, Any]:
    """What the metadata table says of a channel, whose samples are row ``k`` of a file."""
    attrs = signal.attrs
    own = (attrs["quantity"], _UNITS[attrs["units"]])
    quantity, unit = _NONE_OF_ITS_OWN.get(attrs["quantity"], own)
    return {
        "signal_id": f"{case.hash}/{channel}", "channel": channel, "fs": float(attrs["rate"]),
        "n_samples": int(signal.size), "quantity": quantity, "unit": unit, "sensitivity": "none",
        "axis": _AXES.get(str(attrs["direction"]), "radial"),
        "sensor_mounting": _MOUNTED[attrs["place"]], "signal_file": file, "signal_row_group": 0,
        "signal_row": k,
    }  # fmt: skip


def _truth(
    case: Case, run: Run, planned: Planned, row: CaseRow, shared: Mapping[str, Any]
) -> dict[str, Any]:
    """The truth of a recording: what made it, and every figure of its run in SI."""
    part = settled(run.dataset, case.output.settle)
    forces = hidden(run)
    found: dict[str, Any] = {
        "recording_id": case.hash, "fault_type": shared["fault_type"],
        "fault_size_mm": shared["fault_size_mm"], "bearing_id": shared["bearing_id"],
        "load_group": labels.load_words(case), "seed": case.start.seed,
        "bearing_seed": case.seed, "noise_seed": labels.noise_of(case),
        "cage_faults": labels.cage_faults(case), "defects": _defects(case),
        "values": json.dumps(dict(planned.point.values), default=str),
        "audit": str(row.figures["energy_audit"].value) if "energy_audit" in row.figures else "",
        "warnings": " ".join(warning.text for warning in row.warnings),
        "version": row.origin.version, "physics": row.origin.physics,
    }  # fmt: skip
    for name in TRUTH_VARIABLES:
        values = forces[name]
        found[f"{name}_mean"], found[f"{name}_max"] = float(values.mean()), float(values.max())
    if case.cage is not None:
        part = one_cage(part, 0)  # of several cages that at -x, as in a summary
        features = cage_motion_features(part)
        found["whirl_speed_ratio"] = features.whirl_speed_ratio
        found["motion"] = _motion(features.whirl_speed_ratio)
        orbit = orbit_class(part)
        found["motion_class"] = "not known" if orbit is None else orbit.kind
    for name, figure in row.figures.items():
        number = isinstance(figure.value, (int, float)) and not isinstance(figure.value, bool)
        if number and not is_wall_time(name) and isfinite(float(figure.value or 0.0)):
            found[f"figure.{name}"] = float(figure.value or 0.0)
    return found


def _motion(whirl: float) -> str:
    """Class of the cage's motion by its net whirl over its own turns."""
    if not isfinite(whirl):
        return "at rest"
    if abs(whirl - 1.0) < 0.2:
        return "synchronous whirl"
    if abs(whirl) < 0.2:
        return "no net whirl"
    return "backward whirl" if whirl < 0.0 else "whirl"


def _defects(case: Case) -> str:
    """What is wrong with the bearing, as JSON of the case's own keys."""
    table = case.to_table()
    keys = ("outer_spall", "inner_spall", "ball_spot", "roller_spot")
    found = {k: table["bearing"][k] for k in keys if k in table["bearing"]}
    cage = {k: v for k, v in table.get("cage", {}).items() if k.startswith("unbalance")}
    return json.dumps({**found, **cage, "defects": table.get("defects", [])})


def hidden(run: Run) -> dict[str, np.ndarray]:
    """What no sensor sees, over the settled part: by name (time,), SI.

    Largest force of each race on any element, and the force at the fault: of a spall that on the
    element nearest to its middle, of a spot the larger on its element, of a cage's fault, and of a
    sound bearing, the largest on a pocket face, or without a cage on a race.
    """
    ds = settled(run.dataset, run.case.output.settle)
    race = ds["race_force"].transpose("time", "element", "race").values.astype(float)
    found = {
        "time": ds["time"].values, "outer_race_force": race[..., 1].max(axis=1),
        "inner_race_force": race[..., 0].max(axis=1),
        "defect_force": _at_fault(run.case, ds, race), "inner_speed": ds["inner_speed"].values,
    }  # fmt: skip
    if run.case.cage is not None:
        ds = one_cage(ds, 0)
        found["cage_speed"] = ds["cage_omega"].sel(axis="x").values
        for axis in "yz":
            offset = ds["cage_position"].sel(axis=axis) - ds["outer_position"].sel(axis=axis)
            found[f"cage_{axis}"] = offset.values
    return found


def _at_fault(case: Case, ds: xarray.Dataset, race: np.ndarray) -> np.ndarray:
    bearing: Any = case.bearing
    kinds = labels.fault_of(case).kinds
    psi = ds["element_position"].sel(cyl="psi").transpose("time", "element").values
    for kind, side in (("outer", 1), ("inner", 0)):
        if kind in kinds:
            at = getattr(bearing, f"{kind}_spall").azimuth
            at = at + (ds["inner_angle"].values[:, None] if side == 0 else 0.0)
            near = np.abs(np.angle(np.exp(1j * (psi - at)))).argmin(axis=1)
            return np.asarray(race[np.arange(len(psi)), near, side])
    if "rolling_element" in kinds:
        spot = getattr(bearing, "ball_spot", None) or bearing.roller_spot
        k = spot.ball if hasattr(spot, "ball") else spot.roller
        return np.asarray(race[:, k].max(axis=1))
    if case.cage is not None:
        return pocket_peaks(ds).values.astype(float).max(axis=(1, 2))
    return np.asarray(race.max(axis=(1, 2)))


def _signals_file(recording: str, arrays: Mapping[str, np.ndarray]) -> bytes:
    """A Parquet file with a row a signal, in one row group: its id and its samples."""
    import pyarrow as pa

    offsets = np.concatenate([[0], np.cumsum([len(a) for a in arrays.values()])]).astype(np.int32)
    values = pa.array(np.concatenate(list(arrays.values())))
    table = pa.table({
        "signal_id": [f"{recording}/{name}" for name in arrays],
        "signal": pa.ListArray.from_arrays(pa.array(offsets), values),
    })  # fmt: skip
    return parquet(table, rows=len(arrays))


def _hidden_file(columns: Mapping[str, np.ndarray]) -> bytes:
    import pyarrow as pa

    single = {k: v if k == "time" else v.astype(np.float32) for k, v in columns.items()}
    return parquet(pa.table(single))


def parquet(table: Any, rows: int | None = None) -> bytes:
    """A table as a Parquet file, ``rows`` of it a row group."""
    import pyarrow.parquet as pq

    buffer = BytesIO()
    pq.write_table(table, buffer, compression="zstd", row_group_size=rows)
    return buffer.getvalue()


def digest(content: bytes) -> str:
    """SHA-256 of a file's content."""
    return hashlib.sha256(content).hexdigest()
