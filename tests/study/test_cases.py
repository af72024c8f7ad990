"""One case on a worker: what it leaves in the folder, whatever happens."""

import shutil
from dataclasses import replace

import numpy as np
import pandas
import pytest
import xarray
from study_cases import short_case, short_study, study_file

from flexcage import cli
from flexcage.case import load_case
from flexcage.core.errors import InputError, RunFailed
from flexcage.core.progress import Silent
from flexcage.results.figures.figure import CAGED, FLEXIBLE, LATER, STATISTIC
from flexcage.results.figures.table import FIGURES, marked
from flexcage.results.files import load, save
from flexcage.simulate import load_run, simulate
from flexcage.stages import keep_at_hand
from flexcage.study import run, work
from flexcage.study.axes import Grid, Points
from flexcage.study.folder import Folder
from flexcage.study.origin import Origin
from flexcage.study.outputs import check_outputs, parse_reduction
from flexcage.study.plan import make_plan
from flexcage.study.record import mean_and_half_width
from flexcage.study.results import StudyResults
from flexcage.study.run import run_study
from flexcage.study.spec import Study, load_study
from flexcage.study.work import do_case, order_of


@pytest.fixture
def folder(tmp_path):
    return Folder(tmp_path / "study")


def orders(folder, study, **changes):
    plan = make_plan(study)
    folder.prepare(plan)
    return [replace(order_of(plan, p, folder.path), **changes) for p in plan.cases]


def no_simulation(*args, **kwargs):
    raise AssertionError("a finished case was computed again")


@pytest.mark.filterwarnings("ignore:Object at:UserWarning")  # files beside the groups
def test_a_case_is_computed_once_and_outputs_are_added_from_its_run(folder, monkeypatch):
    axis = Grid("load.radial", ["500 N", "1 kN"])
    for order in orders(folder, short_study(axis)):
        assert do_case(order) == "done"
    assert not folder.running() and not list(folder.cases.glob("*.lock"))
    monkeypatch.setattr(work, "simulate", no_simulation)
    more = short_study(axis, outputs=("race_force[element=0,race=outer].max", "cage_speed"))
    for order in orders(folder, more):
        assert do_case(order) == "done"

    results = StudyResults(folder.path)
    results.write()
    load, force = (results.table.iloc[:, i] for i in (2, 3))
    assert list(results.table.columns[2:4]) == ["load.radial [N]", f"{more.outputs[0]} [N]"]
    assert np.all(np.diff(force) > 0) and np.all(force < load)
    assert results.status().startswith("2 cases: 2 done, 0 failed, 0 open")
    run = results.run(1)
    assert run.case.load.radial == 1000.0
    tree = xarray.open_datatree(folder.cases, engine="zarr", consolidated=False)
    stored = tree[f"{results.rows[1].planned.hash}/results.zarr/race_force"]
    assert float(stored[3:, 0, 1].max()) == pytest.approx(force[1], rel=1e-12)


class OneBlock(Silent):
    """Progress that presses Ctrl-C once a block of 1 ms is written."""

    def to(self, done):
        if self.label == "solving" and done > 1.5e-3:
            raise KeyboardInterrupt


def test_cases_share_the_file_of_their_cage(folder):
    """One file a distinct cage; a case is read where it lies in the study, or with its own copy."""
    axes = (Grid("load.radial", ["500 N", "1 kN"]), Grid("cage.width", ["16.5 mm", "16 mm"]))
    every = orders(folder, short_study(*axes))
    for order in every:
        assert do_case(order) == "done"
    files = sorted((folder.path / "cages").iterdir())
    assert len(every) == 4 and len(files) == 2 and not list(folder.cases.rglob("cage.zip"))
    widths = []
    for order in every:
        mesh = load_run(folder.case(order.hash)).mesh
        widths.append(round(1e3 * float(np.ptp(mesh.points[:, 0])), 6))
    assert sorted(widths) == [16.0, 16.0, 16.5, 16.5]
    alone = folder.path.parent / "alone"
    folder.case(every[0].hash).rename(alone)
    with pytest.raises(InputError, match="a study keeps the cages of its runs"):
        load_run(alone)


def test_cases_with_the_same_cage_derive_from_it_once(folder, monkeypatch):
    """The second case of a worker takes the first one's cage, and gives what it gives alone."""
    case = short_case(**{"cage.model": "flexible", "modes.count": 4})
    axes = (Grid("load.radial", ["500 N", "1 kN"]),)
    study = Study(case=case, axes=axes, outputs=("cage_speed", "stress_peak"))
    first, second = orders(folder, study)
    keep_at_hand(None)
    assert do_case(second) == "done"
    alone = load_run(folder.case(second.hash)).dataset["cage_position"].values
    shutil.rmtree(folder.case(second.hash))
    assert do_case(first) == "done"

    def never(*args, **kwargs):
        raise AssertionError("derived again")

    monkeypatch.setattr("flexcage.run.storing.cage_record", never)
    monkeypatch.setattr("flexcage.stress.run_stress.StressRecovery", never)
    assert do_case(second) == "done"
    beside = load_run(folder.case(second.hash)).dataset["cage_position"].values
    np.testing.assert_array_equal(beside, alone)
    keep_at_hand(None)


def other_format(part):
    commit = part / "results.zarr" / "_run" / "commit.json"
    commit.write_text(commit.read_text().replace('"format": 6', '"format": 3'))


def other_checkpoint(part):
    (file,) = (part / "results.zarr" / "_run").glob("checkpoint-*.npz")
    arrays = load(file)
    save(file, {**arrays, "filter": arrays["filter"][:1]})


def other_words(part):
    for path in (part / "case.toml", part / "results.zarr" / "zarr.json"):
        path.write_text(path.read_text().replace("gravity =", "gravitation ="))


@pytest.mark.parametrize("change", [other_format, other_checkpoint, other_words])
def test_a_case_that_another_flexcage_began_begins_anew(folder, change, caplog):
    (order,) = orders(folder, short_study(duration="3 ms"))
    part, case = folder.part(order.hash), load_case(order.text)
    with pytest.raises(KeyboardInterrupt):
        simulate(case, out=part, progress=lambda total, label: OneBlock(total, label))
    change(part)
    assert do_case(order) == "done" and "begins anew" in caplog.text
    mean = simulate(case).summary["cage_speed"]
    assert folder.row(order.hash).figures["cage_speed"].value == pytest.approx(mean, rel=1e-12)


def test_figures_alone_are_small_and_computed_again_for_new_outputs(folder):
    (order,) = orders(folder, short_study(keep="figures"))
    assert do_case(order) == "done"
    stored = folder.case(order.hash)
    assert not (stored / "results.zarr").exists()
    assert sum(file.stat().st_size for file in stored.iterdir()) < 20_000
    (order,) = orders(folder, short_study(outputs=("pocket_force.max",), keep="figures"))
    assert do_case(order) == "done"
    assert folder.row(order.hash).figures["pocket_force.max"].unit == "N"
    with pytest.raises(InputError, match="figures only"):
        StudyResults(folder.path).run()


def test_a_kept_run_stays_when_the_study_comes_to_keep_figures(folder, monkeypatch):
    (order,) = orders(folder, short_study())
    assert do_case(order) == "done"
    monkeypatch.setattr(work, "simulate", no_simulation)
    (order,) = orders(folder, short_study(outputs=("pocket_force.max",), keep="figures"))
    assert do_case(order) == "done"
    assert folder.row(order.hash).figures["pocket_force.max"].unit == "N"
    assert StudyResults(folder.path).run().case.hash == order.hash


def test_a_run_is_computed_where_figures_alone_were_kept(folder):
    (order,) = orders(folder, short_study(keep="figures"))
    assert do_case(order) == "done" and not folder.has_run(order.hash)
    (order,) = orders(folder, short_study(outputs=("pocket_force.max",)))
    assert do_case(order) == "done" and folder.has_run(order.hash)


def test_a_stopped_case_goes_on_where_it_was(folder):
    class CtrlC:
        def __init__(self, total, label):
            self.label = label

        def __enter__(self):
            return self

        def __exit__(self, *error):
            pass

        def begin_at(self, done):
            pass

        def to(self, done):
            if self.label == "solving":
                raise KeyboardInterrupt

    (order,) = orders(folder, short_study(duration="3 ms"))
    case = short_case(**{"solver.duration": "3 ms"})
    with pytest.raises(KeyboardInterrupt):
        simulate(case, out=folder.part(order.hash), progress=CtrlC)
    made = (folder.part(order.hash) / "results.zarr" / "zarr.json").stat().st_mtime_ns
    assert folder.running() == {order.hash}
    assert do_case(order) == "done"
    assert (folder.case(order.hash) / "results.zarr" / "zarr.json").stat().st_mtime_ns == made
    unbroken = simulate(case, out=folder.path.parent / "unbroken").summary
    figures = folder.row(order.hash).figures
    for name in ("cage_speed", "whirl_radius", "race_force_inner", "steps"):
        assert figures[name].value == unbroken[name]


def test_a_failed_case_is_a_row_with_its_reason(folder, capsys):
    defect = {"type": "side_beam", "pocket": 5, "displacement": "-0.3 mm"}
    axis = Grid("defects", [[], [defect]])
    case = short_case(**{"limits.assembly_force": "1 N"})
    study = Study(case=case, axes=[axis], outputs=["cage_speed"])
    states = [do_case(order) for order in orders(folder, study)]
    assert states == ["done", "failed"]
    results = StudyResults(folder.path)
    assert list(results.table["state"]) == ["done", "failed"]
    assert "limits.assembly_force (1 N)" in results.table["reason"][1]
    assert folder.failure(results.rows[1].planned.hash).final
    assert cli.main(["study", "report", str(folder.path)]) == 0
    said = capsys.readouterr().out
    assert "1 failed: a defect pinches roller 5" in said and "1 done, 1 failed" in said
    assert (folder.path / "table.csv").is_file() and (folder.path / "table.parquet").is_file()


@pytest.mark.parametrize("end", [KeyboardInterrupt, RunFailed])
def test_the_tables_are_written_when_a_study_ends_early(end, folder, monkeypatch):
    def ends(plan, *args):
        do_case(order_of(plan, plan.cases[0], folder.path))
        raise end("early")

    monkeypatch.setattr(run, "_compute", ends)
    with pytest.raises(end, match="early"):
        run.run_study(short_study(Grid("load.radial", ["500 N", "1 kN"])), out=folder.path)
    stored = pandas.read_parquet(folder.path / "table.parquet")
    assert list(stored["state"]) == ["done", "open"]
    assert list(pandas.read_csv(folder.path / "statistics.csv")["done"]) == [1, 0]


def test_what_the_machine_lacked_is_tried_again(folder, monkeypatch):
    def full_disk(*args, **kwargs):
        raise OSError(28, "No space left on device")

    (order,) = orders(folder, short_study())
    with monkeypatch.context() as patch:
        patch.setattr(work, "simulate", full_disk)
        assert do_case(order) == "failed"
    assert not folder.failure(order.hash).final
    assert do_case(order) == "done"
    assert folder.failure(order.hash) is None


@pytest.mark.parametrize(
    ("change", "words"),
    [({"origin": Origin("0.0.1", "0" * 16)}, "0.0.1"), ({"hash": "f" * 16}, "differs there")],
)
def test_a_worker_that_would_compute_something_else_refuses(folder, change, words):
    (order,) = orders(folder, short_study(), **change)
    assert do_case(order) == "failed"
    assert words in folder.failure(order.hash).reason


def test_a_folder_in_which_another_study_runs(folder):
    one = short_study()
    folder.prepare(make_plan(one))
    before = (folder.path / "plan.json").read_text()
    with (
        folder.held(),
        pytest.raises(InputError, match="Another process .* is computing a study in"),
    ):
        run.run_study(short_study(Grid("load.radial", ["500 N"])), out=folder.path)
    assert (folder.path / "plan.json").read_text() == before
    assert folder.plan().cases and not (folder.path / "running.lock").exists()


def test_figures_that_a_study_may_name_are_those_of_a_run():
    pinch = {"type": "side_beam", "pocket": 5, "displacement": "-0.26 mm"}
    warm = {"cage.model": "flexible", "cage.temperature": "60 degC"}
    case = short_case(**warm).replace("defects", [pinch])
    run = simulate(case)
    keys = {row.key for row in run.summary}
    of_rollers = {
        k for k, f in FIGURES.items()
        if "cylindrical_roller" in (FIGURES.owners(k) or ("cylindrical_roller",))
        and f.needs in ("", CAGED, FLEXIBLE)
        and k not in ("element_touches", "cage_motion")  # a cage keeps them apart; less than a turn
    }  # fmt: skip
    assert keys | {"wall_stress"} == of_rollers - set(marked(LATER))
    assert all(row.shown == FIGURES[row.key].shown for row in run.summary)
    statistics = {row.key for row in run.summary if row.record is not None}
    assert statistics == keys & set(marked(STATISTIC))


@pytest.mark.parametrize(
    ("name", "what"), [("energy_audit", "a text"), ("wall_pictures", "after a run")]
)
def test_a_text_is_no_output_of_a_study(name, what):
    with pytest.raises(InputError, match=f"'{name}' is .*{what}.*takes numbers"):
        check_outputs((name,), sizes={}, flexible=True, family="cylindrical_roller")


def test_what_a_run_does_not_record_is_nan():
    """So a study may compare a rigid cage, or rigid rings, with what bends."""
    run = simulate(short_case(**{"solver.duration": "0.2 ms"}))
    for name in ("modal_velocity.rms", "ring_deflection[bending=radial].max", "support_force.max"):
        assert np.isnan(parse_reduction(name).of(run).value)
    assert parse_reduction("race_force.max").of(run).value > 0.0


def test_a_variable_of_mixed_units_gives_one_of_its_components():
    assert parse_reduction("element_position[cyl=r].max").unit == "m"
    assert parse_reduction("element_position[cyl=psi].max").unit == "rad"
    with pytest.raises(InputError, match=r"would mix m, m, rad; .*'element_position\[cyl=x\].max'"):
        parse_reduction("element_position.max")


def test_parts_of_a_counted_dimension_make_up_the_whole():
    run = simulate(short_case(**{"output.settle": 0.2}))
    whole, one, two, rest = (
        parse_reduction(f"race_force[race=outer{part}].mean").of(run).value
        for part in ("", ",element=0", ",element=1:9", ",element=9:22")
    )
    assert (one + 8 * two + 13 * rest) / 22 == pytest.approx(whole, rel=1e-12)
    assert whole != pytest.approx(two, rel=1e-2)
    with pytest.raises(InputError, match="has 22 places along 'element'"):
        parse_reduction("race_force[race=outer,element=20:23].mean").of(run)


def test_a_push_moves_the_cage_at_its_speed_in_a_direction_of_its_seed():
    velocity = {}
    for push, seed in (("0 mm/s", 0), ("50 mm/s", 1), ("50 mm/s", 2)):
        run = simulate(short_case(**{"start.push": push, "start.seed": seed}))
        velocity[push, seed] = run.dataset["cage_velocity"][0].values
    still = velocity["0 mm/s", 0]
    first, second = velocity["50 mm/s", 1] - still, velocity["50 mm/s", 2] - still
    assert [np.linalg.norm(v) for v in (first, second)] == pytest.approx([0.05, 0.05], rel=1e-3)
    assert abs(first @ second) < 0.999 * 0.05**2


def test_points_of_a_list_fill_the_table_with_the_base_case(folder):
    points = [{"label": "slow", "drive.speed": "3000 rpm"}, {"load.radial": "1.5 kN"}]
    folder.prepare(make_plan(short_study(Points(points, name="which"))))
    results = StudyResults(folder.path)
    assert list(results.table["which"]) == ["slow", ""]
    assert list(results.table["drive.speed [rpm]"]) == [3000.0, 6000.0]
    assert list(results.table["load.radial [N]"]) == [1000.0, 1500.0]
    assert results.report().endswith("2 cases: 0 done, 0 failed, 2 open")


def test_interval_of_three_repetitions():
    mean, half = mean_and_half_width([1.0, 2.0, 3.0, None])
    assert mean == 2.0
    assert half == pytest.approx(4.30265 / np.sqrt(3), rel=1e-5)  # t(0.975, 2) of any table
    assert np.isnan(mean_and_half_width([1.0])[1])


def test_a_mistake_in_ones_own_outputs_is_said_once_as_it_happens(tmp_path, caplog):
    """Three cases fail alike: one sentence tells why, not at the end."""
    own = tmp_path / "mine.py"
    own.write_text(
        "from flexcage.register import outputs\n"
        "outputs(lambda run: {'my_place': run.dataset['cage_place'][0]}, {'my_place': 'um'})\n"
    )
    file = study_file(
        tmp_path, 'use = ["mine.py"]', '[[axes]]', 'path = "load.radial"',
        'values = ["500 N", "600 N", "700 N"]', outputs=("my_place",),
    )  # fmt: skip
    with caplog.at_level("WARNING", logger="flexcage.study.run"):
        results = run_study(load_study(file), out=tmp_path / "out", workers=1)
    assert results.count("failed") == 3
    told = [r.getMessage() for r in caplog.records if " failed: " in r.getMessage()]
    assert len(told) == 1 and "cage_place" in told[0]
