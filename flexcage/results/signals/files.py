"""Signals to files that people's tools read: CSV, Parquet, MAT, WAV, and UFF 58.

All hold unit, place and rate of every signal beside its values, which are in SI. CSV, Parquet and
WAV have one rate a file: of signals of several rates each rate has a file of its own, named by it.
"""

from __future__ import annotations

import importlib.util
import io
import json
import struct
from collections.abc import Callable, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from flexcage.core.errors import InputError, package_lacks
from flexcage.results.export import check_new, frame_to_parquet, mat_names, put, ready

if TYPE_CHECKING:
    import pandas
    import xarray

_MARK = "# "  # before what a CSV file says of its signals
_WHOLE = 1e-6  # Hz, by which a rate is off a whole number at most
_TIME_RESPONSE = 1  # function type of UFF 58
#: UFF's number of what is measured, by quantity; 0: unknown to it.
_SPECIFIC = {"acceleration": 12, "displacement": 8, "strain": 3}
#: UFF's numbers of directions that are along an axis, by what ``attrs`` say.
_AXES = {"axial": 1, "0": 2, "90": 3, "180": -2, "-180": -2, "270": -3, "-90": -3}


def write_signals(ds: xarray.Dataset, path: Path, *, force: bool = False) -> list[Path]:
    """Write a run's signals to ``path``, by its ending; paths of the files.

    Raises InputError for another ending, a file that is there unless ``force`` is given, and for a
    rate that a WAV file cannot have; EnvironmentLacks where a package is missing.
    """
    check_ending(path)
    write = _WRITERS[path.suffix]
    parts = [ds] if path.suffix in _TOGETHER else _by_rate(ds)
    paths = [path] if len(parts) == 1 else [_of_rate(path, part) for part in parts]
    check_new(paths, force)
    for part, file in zip(parts, paths):
        write(part, ready(file))
    return paths


def check_ending(path: Path) -> None:
    """Refuse a file of signals of another ending."""
    if path.suffix not in _WRITERS:
        *first, last = _WRITERS
        raise InputError(
            f"'{path}' should end in {', '.join(first)} or {last}.", where="path", value=str(path)
        )


def _by_rate(ds: xarray.Dataset) -> list[xarray.Dataset]:
    """Signals of one rate each, in the order of the first of each."""
    dims = dict.fromkeys(str(signal.dims[0]) for signal in ds.data_vars.values())
    return [ds[[n for n, s in ds.data_vars.items() if s.dims == (dim,)]] for dim in dims]


def _of_rate(path: Path, part: xarray.Dataset) -> Path:
    return path.with_name(f"{path.stem}_{_dim(part).removeprefix('time_')}{path.suffix}")


def _dim(part: xarray.Dataset) -> str:
    return str(next(iter(part.data_vars.values())).dims[0])


def _rate(part: xarray.Dataset) -> float:
    return float(next(iter(part.data_vars.values())).attrs["rate"])


def about(ds: xarray.Dataset) -> dict[str, Any]:
    """What files say beside the numbers: attributes of the run, and of every signal."""
    return {
        "run": {k: _plain(v) for k, v in ds.attrs.items()},
        "signals": {
            str(name): {k: _plain(v) for k, v in signal.attrs.items()}
            for name, signal in ds.data_vars.items()
        },
    }


def _plain(value: Any) -> Any:
    return value.item() if isinstance(value, np.generic) else value


def _frame(part: xarray.Dataset) -> pandas.DataFrame:
    """One column a signal, with its unit; the instants first."""
    import pandas as pd

    columns = {"time (s)": part[_dim(part)].values}
    for name, signal in part.data_vars.items():
        columns[f"{name} ({signal.attrs['units']})"] = signal.values
    frame = pd.DataFrame(columns)
    frame.attrs.update(about(part))
    return frame


def _csv(part: xarray.Dataset, path: Path) -> None:
    said = about(part)
    lines = [f"{_MARK}{key}: {value}" for key, value in said["run"].items()]
    for name, attrs in said["signals"].items():
        lines.append(f"{_MARK}{name}: {json.dumps(attrs)}")
    text = "\n".join([*lines, _frame(part).to_csv(index=False)])
    put(path, lambda file: file.write_text(text, "utf-8"))


def _parquet(part: xarray.Dataset, path: Path) -> None:
    frame_to_parquet(_frame(part), path)  # pandas keeps the frame's attributes


def _mat(ds: xarray.Dataset, path: Path) -> None:
    from scipy.io import savemat

    said, names = about(ds), mat_names(map(str, ds.data_vars))
    stored: dict[str, Any] = {"about": _fields(said["run"])}
    for valid, (name, signal) in zip(names, ds.data_vars.items()):
        first = float(signal[signal.dims[0]][0])
        own = {"name": str(name), "data": signal.values, "start": first}
        stored[valid] = {**_fields(said["signals"][str(name)]), **own}
    put(path, lambda file: savemat(file, stored, do_compression=True, oned_as="column"))


def _fields(attrs: Mapping[str, Any]) -> dict[str, Any]:
    """Attributes under names that fields of MATLAB may have."""
    return dict(zip(mat_names(attrs), attrs.values()))


def _wav(part: xarray.Dataset, path: Path) -> None:
    """Channels of 32-bit floats in SI; what they are, as JSON in the comment of its INFO chunk."""
    from scipy.io import wavfile

    rate = _rate(part)
    if abs(rate - round(rate)) > _WHOLE:
        raise InputError(
            f"The signals have {rate:g} samples a second, but a .wav file has whole numbers of "
            "them; give the sensors another rate, or write .mat or .csv.",
            where="rate",
            value=rate,
        )
    channels = np.stack([s.values for s in part.data_vars.values()], axis=1)
    buffer = io.BytesIO()
    wavfile.write(buffer, round(rate), channels.astype(np.float32))
    content = _commented(buffer.getvalue(), json.dumps(about(part)))
    put(path, lambda file: file.write_bytes(content))


def _commented(content: bytes, comment: str) -> bytes:
    """A WAV file with a comment (chunk LIST, type INFO, entry ICMT) behind its samples."""
    text = comment.encode() + b"\0"
    text += b"\0" * (len(text) % 2)
    info = b"INFO" + b"ICMT" + struct.pack("<I", len(text)) + text
    content += b"LIST" + struct.pack("<I", len(info)) + info
    return content[:4] + struct.pack("<I", len(content) - 8) + content[8:]


def _uff(ds: xarray.Dataset, path: Path) -> None:
    """One function of type 58 a signal: its time response at a node numbered as the signal."""
    if importlib.util.find_spec("pyuff") is None:
        raise package_lacks("A .uff file is written", "pyuff", extra="signals")
    import pyuff

    said = ds.attrs
    sets = []
    for k, (name, signal) in enumerate(ds.data_vars.items(), 1):
        t, attrs = signal[signal.dims[0]].values, signal.attrs
        sets.append(
            pyuff.prepare_58(
                binary=0, id1=str(name)[:80], id2=str(attrs["long_name"])[:80],
                id3=f"flexcage {said.get('flexcage', '')}"[:80], id4=str(said.get("case", ""))[:80],
                id5=f"direction {attrs['direction']}"[:80], func_type=_TIME_RESPONSE, ver_num=0,
                load_case_id=0, rsp_ent_name=str(attrs["place"])[:10], rsp_node=k,
                rsp_dir=_AXES.get(str(attrs["direction"]), 0), ref_ent_name="NONE", ref_node=0,
                ref_dir=0, ord_data_type=4, num_pts=len(t), abscissa_spacing=1,
                abscissa_min=float(t[0]), abscissa_inc=1.0 / attrs["rate"], z_axis_value=0.0,
                abscissa_spec_data_type=17, abscissa_axis_units_lab="s",
                ordinate_spec_data_type=_SPECIFIC.get(attrs["quantity"], 0),
                ordinate_axis_units_lab=str(attrs["units"]), orddenom_spec_data_type=0,
                z_axis_spec_data_type=0, data=signal.values, x=t,
            )
        )  # fmt: skip
    put(path, lambda file: pyuff.UFF(str(file)).write_sets(sets, "overwrite"))


_WRITERS: Mapping[str, Callable[[xarray.Dataset, Path], None]] = {
    ".csv": _csv, ".parquet": _parquet, ".mat": _mat, ".wav": _wav, ".uff": _uff,
}  # fmt: skip
_TOGETHER = (".mat", ".uff")  # hold signals of any rates
