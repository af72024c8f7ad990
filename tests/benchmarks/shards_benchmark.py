"""What a data set in 1,000 shards asks of disk and processor: fake cases, all else as it is."""

from __future__ import annotations

import os
import tempfile
import time
from collections.abc import Callable
from pathlib import Path
from statistics import median
from typing import Any

import fake_case
from dataset_benchmark import SENSOR

from flexcage.case import Case, load_case
from flexcage.study import desk
from flexcage.study.axes import LatinHypercube
from flexcage.study.dataset.check import check_dataset
from flexcage.study.dataset.sharded import build_shard, merge_dataset, plan_dataset
from flexcage.study.folder import SHARDS
from flexcage.study.spec import Study

QUICK: dict[str, Any] = {"shards": 3, "cases": 6}  # whether it runs
KB, MB = 1e3, 1e6


def measure(case: Case, *, shards: int = 1000, cases: int = 2000) -> dict[str, Any]:
    """Figures by name, as README.md describes them."""
    plain = desk.do_case
    desk.do_case = fake_case.fake_do_case
    try:
        with tempfile.TemporaryDirectory() as top:
            return _measured(_study(case, cases), Path(top), shards)
    finally:
        desk.do_case = plain


def _study(case: Case, count: int) -> Study:
    base = load_case({**case.replace("cage.model", "rigid").to_table(), "sensors": [SENSOR]})
    ranges = {"load.radial": ("500 N", "1500 N"), "drive.speed": ("4000 rpm", "8000 rpm")}
    axis = LatinHypercube(ranges, count)
    return Study(case=base, axes=(axis,), outputs=("cage_speed",), keep="figures")


def _measured(study: Study, top: Path, count: int) -> dict[str, Any]:
    source, out, cases = top / "study.toml", top / "data", len(study.axes[0].expand())
    source.write_text(study.to_toml())
    planning = _seconds(lambda: plan_dataset(source, out))
    plan = (out / "study" / "plan.json").stat().st_size
    spent, fake_case.seconds[0] = [], 0.0
    for k in range(1, count + 1):
        begin = time.process_time()
        build_shard(source, out, f"{k}/{count}", workers=1)
        spent.append(time.process_time() - begin)
    fake = fake_case.seconds[0] / cases
    files = [p for p in (out / SHARDS).rglob("*") if p.is_file()]
    size = sum(p.stat().st_size for p in files)
    wall = time.perf_counter()
    merging = _seconds(lambda: merge_dataset(out))
    wall = time.perf_counter() - wall
    verdict = check_dataset(out)
    assert not verdict.faults and verdict.recordings == cases
    return {
        "shards": count, "cases": cases,
        "plan_ms_per_case": round(1e3 * planning / cases, 2),
        "plan_bytes_per_case": round(plan / cases),
        "shard_cpu_ms": round(1e3 * median(spent)), "fake_case_cpu_ms": round(1e3 * fake, 1),
        "files_per_case": round(len(files) / cases, 1), "kb_per_case": round(size / cases / KB, 1),
        "files": len(files), "mb": round(size / MB, 1),
        "merge_cpu_ms_per_case": round(1e3 * merging / cases, 2),
        "merge_wall_s": round(wall, 1),
        "files_merged": sum(p.is_file() for p in out.rglob("*")),
        "load_average": round(os.getloadavg()[0], 1),
    }  # fmt: skip


def _seconds(call: Callable[[], Any]) -> float:
    begin = time.process_time()
    call()
    return time.process_time() - begin
