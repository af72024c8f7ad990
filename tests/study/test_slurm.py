"""The SLURM script of examples/studies.md, as printed, on a SLURM of one node with two cores."""

import subprocess
import sys
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

import pandas as pd
import pytest
from dask_processes import PATIENCE, begun, kill_family, wait_for, when_written, worker_of
from slurm_node import one_node_slurm, said, what_is_lacking
from study_cases import study_file

from flexcage.core.kernel_files import kernel_cache_dir
from flexcage.study.run import run_study
from flexcage.study.spec import load_study

pytestmark = pytest.mark.slow
PAGE = Path(__file__).parents[2] / "examples" / "studies.md"
LOADS = [f"{load} N" for load in range(500, 4500, 500)]
OUTPUTS = ("race_force_inner", "pocket_force.max")


@pytest.fixture(scope="module")
def slurm():
    """Environment in which SLURM's commands, and those of dask-jobqueue, find the node."""
    pytest.importorskip("dask_jobqueue", reason="pip install dask-jobqueue")
    if lacking := what_is_lacking():
        pytest.skip(lacking)
    try:
        with one_node_slurm(cores=2) as environment:
            yield {
                **environment,
                "DASK_JOBQUEUE__SLURM__INTERFACE": "lo",
                "NUMBA_CACHE_DIR": str(kernel_cache_dir()),  # compiled kernels that there may be
            }
    except RuntimeError as exc:
        pytest.skip(str(exc))


def script_of_the_page(shared: Path, jobs: int = 100) -> str:
    """The script with ``shared`` in place of /shared, and with so many jobs."""
    blocks = PAGE.read_text("utf-8").split("```python\n")[1:]
    (block,) = (b.split("```")[0] for b in blocks if "SLURMCluster(" in b)
    return block.replace("/shared", str(shared)).replace("100", str(jobs))


def job_of(lock: Path) -> str:
    """Job whose worker holds the lock of a case, and so computes it."""
    import psutil

    jobs = {}
    for process in psutil.process_iter():
        try:
            jobs[process.pid] = process.environ().get("SLURM_JOB_ID")
        except psutil.Error:
            continue
    return jobs[worker_of(lock, [pid for pid, job in jobs.items() if job])]


def cancel(slurm: dict[str, str], *what: str) -> None:
    subprocess.run(["scancel", *what], env=slurm, check=True)


def created(run: Path) -> int:
    """When the results of a run were begun."""
    return (run / "results.zarr" / "zarr.json").stat().st_mtime_ns


def table_of(out: Path) -> pd.DataFrame:
    return pd.read_parquet(out / "table.parquet").drop(columns="seconds")


@contextmanager
def running(script: Path, slurm: dict[str, str]) -> Iterator[subprocess.Popen]:
    """Process of the script, with what it says in a file beside it; killed at the end."""
    with open(script.with_suffix(".said"), "a") as output:
        process = subprocess.Popen(
            [sys.executable, script], cwd=script.parent, env=slurm, stdout=output, stderr=output
        )
    try:
        yield process
    finally:
        kill_family(process)


def test_a_cancelled_job_and_a_killed_script_lose_nothing(slurm, tmp_path):
    """The table is that of an unbroken run on this machine's cores, to the bit."""
    axis = f'[[axes]]\npath = "load.radial"\nvalues = {LOADS}'
    study = study_file(tmp_path, axis, duration="4 ms", outputs=OUTPUTS)
    script, out = tmp_path / "script.py", tmp_path / "study"
    script.write_text(script_of_the_page(tmp_path, jobs=1))
    with running(script, slurm):
        part = wait_for(lambda: begun(out))[0]
        victim, born = part.stem, created(part)
        cancel(slurm, job_of(part.with_suffix(".lock")))
        wait_for(lambda: victim in when_written(out))  # by another job, that takes its place
        assert created(out / "cases" / victim) == born  # and went on with its blocks
        wait_for(lambda: begun(out))
    cancel(slurm, "--name", "dask-worker")  # as the page says
    before = when_written(out)
    assert 1 <= len(before) < len(LOADS)

    script.write_text(script_of_the_page(tmp_path))
    with running(script, slurm) as process:
        assert process.wait(PATIENCE) == 0, script.with_suffix(".said").read_text()
    assert before.items() <= when_written(out).items()
    wait_for(lambda: not said("squeue", "--noheader", env=slurm))
    run_study(load_study(study), out=tmp_path / "here", workers=2)
    pd.testing.assert_frame_equal(table_of(out), table_of(tmp_path / "here"), check_exact=True)
