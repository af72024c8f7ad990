"""Workers, schedulers and clients that die in the middle: nothing finished is lost or done twice.

Cases take 4 ms of bearing time, of which a block of 1 ms at a time is made safe.
"""

import json
import os
import signal
import subprocess
from concurrent.futures import ThreadPoolExecutor

import pandas as pd
import pytest
from dask_processes import (
    PATIENCE,
    begun,
    dask_cluster,
    kill_family,
    start,
    wait_for,
    when_written,
    without_warnings,
    worker_of,
)
from study_cases import short_study, study_file

from flexcage.core.errors import RunFailed
from flexcage.simulate import simulate
from flexcage.study.axes import Grid
from flexcage.study.results import StudyResults
from flexcage.study.run import run_study

LOADS = ["500 N", "1000 N", "1500 N", "2000 N"]
OUTPUTS = ("race_force_inner", "pocket_force.max")
PIPES = {"stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
MINE = """
from flexcage.results.registry import Variable, register

twice = Variable("twice_the_speed", ("time",), "rad/s", "twice the speed of the inner ring")
register(twice, lambda arrays, bearing: 2.0 * arrays["inner_speed"])
"""


@pytest.fixture(scope="module")
def cluster(tmp_path_factory):
    """Address of a scheduler with two workers, all processes of their own; the scheduler's."""
    with dask_cluster(tmp_path_factory.mktemp("dask")) as found:
        yield found


def study_of(speed):
    case = short_study(duration="4 ms").case.replace("drive.speed", speed)
    return type(short_study())(case=case, axes=[Grid("load.radial", LOADS)], outputs=OUTPUTS)


def test_a_worker_killed_in_the_middle_of_a_case(cluster, tmp_path):
    import distributed

    out = tmp_path / "study"
    with ThreadPoolExecutor(1) as aside:
        future = aside.submit(run_study, study_of("6000 rpm"), out=out, scheduler=cluster[0])
        with distributed.Client(cluster[0], set_as_default=False) as watcher:
            watcher.wait_for_workers(2)
            pids = list(watcher.run(os.getpid).values())
        part = wait_for(lambda: begun(out))[0]
        victim, born = part.stem, (part / "results.zarr" / "zarr.json").stat().st_mtime_ns
        finished = when_written(out)
        os.kill(worker_of(part.with_suffix(".lock"), pids), signal.SIGKILL)
        results = future.result(timeout=PATIENCE)

    assert list(results.table["state"]) == ["done"] * len(LOADS)
    assert finished.items() <= when_written(out).items()
    # the other worker went on with what was safe, and came to what an unbroken run gives
    assert (out / "cases" / victim / "results.zarr" / "zarr.json").stat().st_mtime_ns == born
    row = next(row for row in results.rows if row.planned.hash == victim)
    unbroken = simulate(results.plan.case(row.planned), out=tmp_path / "unbroken").summary
    assert row.figures["race_force_inner"].value == unbroken["race_force_inner"]


def test_a_lost_scheduler_ends_the_study_with_a_sentence_and_resume_goes_on(cluster, tmp_path):
    out = tmp_path / "study"
    with ThreadPoolExecutor(1) as aside:
        study = study_of("5000 rpm")
        future = aside.submit(run_study, study, out=out, scheduler=cluster[0])
        wait_for(lambda: when_written(out))
        kill_family(cluster[1])
        with pytest.raises(RunFailed, match="lost; what is finished is kept"):
            future.result(timeout=PATIENCE)
    lost = pd.read_parquet(out / "table.parquet")
    assert len(lost) == len(LOADS) and (lost["state"] == "done").any()

    finished = when_written(out)
    results = run_study(StudyResults(out).study, out=out, workers=1)
    assert list(results.table["state"]) == ["done"] * len(LOADS)
    assert finished and finished.items() <= when_written(out).items()
    for row in results.rows:
        case = results.plan.case(row.planned)
        unbroken = simulate(case, out=tmp_path / row.planned.hash).summary
        assert row.figures["race_force_inner"].value == unbroken["race_force_inner"]


def test_ctrl_c_stops_at_once_and_resume_goes_on(tmp_path):
    """Through the command line, on a cluster of this machine that it makes and ends itself.

    The workers compute a variable that they know from the user's own file alone.
    """
    import psutil

    (tmp_path / "mine.py").write_text(MINE)
    use = 'use = ["mine.py"]\n[[axes]]\npath = "load.radial"\nvalues = '
    outputs = ("inner_speed", "twice_the_speed.mean")
    file = study_file(tmp_path, use + str(LOADS[:3]), duration="4 ms", outputs=outputs)
    out = tmp_path / "out"
    command = ("flexcage.cli", "study")
    client = start(*command, "run", file, "-o", out, "--workers", 1, **PIPES)
    wait_for(lambda: when_written(out) or client.poll() is not None)
    children = psutil.Process(client.pid).children(recursive=True)
    os.killpg(client.pid, signal.SIGINT)
    said, complained = client.communicate(timeout=PATIENCE)
    assert (client.returncode, said) == (130, ""), complained
    mine = str(tmp_path / "mine.py")
    assert f"'flexcage study resume {out} --use {mine}' goes on" in complained
    assert without_warnings(complained).count("\n") == 1, complained
    assert not psutil.wait_procs(children, timeout=20)[1]

    finished = when_written(out)
    stopped = pd.read_parquet(out / "table.parquet")
    assert set(stopped.loc[stopped["state"] == "done", "hash"]) == set(finished)
    resumed = start(*command, "resume", out, "--use", mine, "--workers", 1, **PIPES)
    said, complained = resumed.communicate(timeout=PATIENCE)
    assert resumed.returncode == 0, complained
    assert "3 cases: 3 done, 0 failed, 0 open" in said
    assert finished.items() <= when_written(out).items()
    table = pd.read_parquet(out / "table.parquet")
    speed, twice = (table[f"{name} [rad/s]"] for name in outputs)
    assert twice.to_numpy() == pytest.approx(2.0 * speed.to_numpy())


COUNTED = """
from flexcage.modes import free_free
from flexcage.modes.registry import register_basis

def build(solver, **options):
    with open({file!r}, "a") as file:
        file.write("built\\n")
    return free_free.build(solver, **options)

register_basis("counted", build)
"""


@pytest.mark.slow
def test_modes_that_cases_share_are_made_once(tmp_path):
    from flexcage.core.kernel_files import kernel_cache_dir

    count = tmp_path / "count"
    (tmp_path / "mine.py").write_text(COUNTED.format(file=str(count)))
    axes = [
        f'[[axes]]\npath = "{path}"\nvalues = {values}'
        for path, values in (
            ("load.radial", LOADS[:2]),
            ("cage.pocket_width", ["8.2 mm", "8.3 mm"]),
            ("modes.kind", ["counted"]),
            ("cage.model", ["flexible"]),
        )
    ]
    file, out = study_file(tmp_path, 'use = ["mine.py"]', *axes), tmp_path / "out"
    caches = {"FLEXCAGE_CACHE_DIR": str(tmp_path), "NUMBA_CACHE_DIR": str(kernel_cache_dir())}
    command = ("flexcage.cli", "study", "run", file, "-o", out, "--workers", 2)
    client = start(*command, env={**os.environ, **caches}, **PIPES)
    said, complained = client.communicate(timeout=PATIENCE)
    assert client.returncode == 0, complained
    assert "4 cases: 4 done" in said
    assert count.read_text().split() == ["built"] * 2


@pytest.mark.slow
def test_a_case_that_kills_every_worker_is_a_row(tmp_path):
    deadly = MINE.replace("2.0 * arrays", "os.kill(os.getpid(), 9) or arrays")
    (tmp_path / "mine.py").write_text(f"import os\n{deadly}")
    outputs = ("cage_speed", "twice_the_speed.mean")
    file, out = study_file(tmp_path, 'use = ["mine.py"]', outputs=outputs), tmp_path / "out"
    client = start("flexcage.cli", "study", "run", file, "-o", out, "--workers", 1, **PIPES)
    said, _ = client.communicate(timeout=PATIENCE)
    assert client.returncode == 1
    assert "1 failed: its worker did not bring it back: KilledWorker" in said
    (failure,) = (out / "failed").glob("*.json")
    assert not json.loads(failure.read_text())["final"]  # the next machine may have more memory


@pytest.mark.slow
def test_the_machine_switched_off(tmp_path):
    axis = f'[[axes]]\npath = "load.radial"\nvalues = {LOADS}'
    file, out = study_file(tmp_path, axis, duration="4 ms"), tmp_path / "out"
    client = start("flexcage.cli", "study", "run", file, "-o", out, "--workers", 2, **PIPES)
    wait_for(lambda: when_written(out))
    kill_family(client)
    finished = when_written(out)
    results = run_study(StudyResults(out).study, out=out, workers=2)
    assert results.count("done") == len(LOADS)
    assert finished.items() <= when_written(out).items()
