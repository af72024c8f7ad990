"""A case that is finished at once: its row, and its recording, of numbers that its hash makes.

All else of a study is as it is: plan, shards, folders, merge, tables.
"""

from __future__ import annotations

from time import process_time

import numpy as np
import pyarrow as pa

from flexcage.core.warning import RunWarning
from flexcage.study.case_row import CaseRow
from flexcage.study.dataset.folder import DatasetFolder
from flexcage.study.dataset.recording import Recording, parquet
from flexcage.study.folder import Folder
from flexcage.study.outputs import StudyFigure
from flexcage.study.work import Order

SAMPLES, RATE = 12_000, 12_000.0  # of a recording: a second
FIGURES = 150  # of a row, about as many as a run has
calls: list[str] = []  # hashes of the cases that were computed in this process
seconds = [0.0]  # of processor time that they took


def fake_do_case(order: Order, *prepared: object) -> str:
    """As ``study.work.do_case``."""
    calls.append(order.hash)
    begin = process_time()
    folder, part = Folder(order.folder), Folder(order.folder).part(order.hash)
    part.mkdir(parents=True, exist_ok=True)
    row = _row(order)
    folder.write_row(part, row)
    if order.keeper is not None and not order.keeper.has():
        DatasetFolder(order.keeper.folder).add(order.hash, _recording(order))
    folder.finish(order.hash)
    seconds[0] += process_time() - begin
    return "done"


def _numbers(order: Order, count: int) -> np.ndarray:
    return np.random.default_rng(int(order.hash, 16)).standard_normal(count)


def _row(order: Order) -> CaseRow:
    values = _numbers(order, FIGURES)
    figures = {f"figure_{k}": StudyFigure(float(v), "m", "um") for k, v in enumerate(values)}
    figures["cage_speed"] = StudyFigure(float(values[0]), "rad/s", "rpm")
    warnings = (RunWarning("short", "it is short"),)
    return CaseRow(order.hash, 1.0, figures, warnings, order.values, order.origin)


def _recording(order: Order) -> Recording:
    name, samples = order.hash, _numbers(order, SAMPLES).astype(np.float32)
    file = f"part-{name}.parquet"
    table = pa.table({"signal_id": [f"{name}/a"], "signal": [samples]})
    row = {
        "dataset": order.keeper.name, "signal_id": f"{name}/a", "recording_id": name,
        "channel": "a", "fault_type": "normal", "fault_severity": "none",
        "quantity": "acceleration", "unit": "m/s^2", "fs": RATE, "n_samples": SAMPLES,
        "signal_file": file, "signal_row_group": 0, "signal_row": 0,
    }  # fmt: skip
    truth = {"recording_id": name, "bearing_id": name[:2], "load_group": name[:1], "seed": 1}
    truth |= {f"figure.{k}": float(v) for k, v in enumerate(_numbers(order, FIGURES))}
    files = {
        f"signals/{file}": parquet(table),
        f"truth/{name}.parquet": parquet(pa.table({"time": samples})),
    }
    return Recording(files, [row], truth)
