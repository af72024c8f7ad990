"""Cases of a study, a map or a convergence study that a flexcage of other physics computed: new
ones join them only where that is asked for, and what is shown says so."""

import json
from dataclasses import replace

import pytest
from study_cases import short_case, short_study, study_file

from flexcage import cli
from flexcage.core.errors import InputError
from flexcage.core.sources import physics
from flexcage.study import converge, maps, work
from flexcage.study import run as study_run
from flexcage.study.about import plain
from flexcage.study.axes import Grid
from flexcage.study.case_row import CaseRow
from flexcage.study.folder import Folder
from flexcage.study.maps import Map
from flexcage.study.origin import Origin, this_one
from flexcage.study.outputs import StudyFigure
from flexcage.study.plan import make_plan
from flexcage.study.results import StudyResults
from flexcage.study.spec import load_study
from flexcage.study.unknowns import Unknown

LOADS = ["500 N", "1000 N", "2000 N"]
#: The same version and kernels, and another line of plain Python that makes numbers.
OTHER = Origin(this_one().version, "a" * 16)


def write_row(folder, planned, origin):
    part = folder.case(planned.hash)
    part.mkdir()
    figures = {"cage_speed": StudyFigure(50.0, "rad/s", "rpm")}
    folder.write_row(
        part, CaseRow(planned.hash, 1.0, figures, (), plain(planned.point.values), origin)
    )


@pytest.fixture
def computed(monkeypatch):
    """Cases handed to workers, which the test plays: their rows are of this flexcage."""
    found = []

    def compute(plan, folder, todo, *_):
        found.append(len(todo))
        for planned in plan.cases:
            if planned.hash in todo:
                write_row(folder, planned, this_one())

    monkeypatch.setattr(study_run, "require_packages", lambda: None)
    monkeypatch.setattr(study_run, "_compute", compute)
    return found


def begun(path, *origins, study=None):
    """The folder of a study whose first cases are done, one by each of these flexcages."""
    folder = Folder(path)
    plan = make_plan(study or short_study(Grid("load.radial", LOADS)))
    folder.prepare(plan)
    for planned, origin in zip(plan.cases, origins):
        write_row(folder, planned, origin)
    return folder


def test_a_row_is_bound_to_all_physics():
    assert this_one().physics == physics() and len(physics()) == 16


def test_new_cases_do_not_join_those_of_other_physics_unasked(tmp_path, capsys, computed):
    out = str(begun(tmp_path / "s", OTHER, this_one()).path)
    before = (tmp_path / "s/plan.json").read_bytes()
    assert cli.main(["study", "resume", out]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and "1 of the 2 finished cases" in said
    assert "with the 1 still to compute" in said and "--other-version" in said
    assert not computed and (tmp_path / "s/plan.json").read_bytes() == before

    assert cli.main(["study", "resume", out, "--other-version"]) == 0
    shown = capsys.readouterr()
    assert computed == [1] and "would mix different physics" in shown.err
    told = "Different versions of flexcage computed these cases"
    assert told in " ".join(shown.out.split())
    page = StudyResults(out).page(tmp_path / "page.html").read_text("utf-8")
    assert told in page
    assert cli.main(["study", "resume", out]) == 0  # nothing is left to join them


def test_the_same_physics_goes_on_unasked(tmp_path, capsys, computed):
    out = str(begun(tmp_path / "s", this_one()).path)
    assert cli.main(["study", "resume", out]) == 0
    shown = capsys.readouterr()
    assert computed == [2] and "flexcage computed" not in shown.out + shown.err


def test_a_study_of_other_physics_is_read_and_says_so(tmp_path, capsys):
    out = begun(tmp_path / "s", OTHER, OTHER, OTHER).path
    assert cli.main(["study", "report", str(out)]) == 0
    told = f"Another flexcage, {OTHER}, computed these cases, and this is {this_one()}"
    assert told in " ".join(capsys.readouterr().out.split())
    assert told in StudyResults(out).page(tmp_path / "page.html").read_text("utf-8")


def test_the_command_study_run_asks_as_well(tmp_path, capsys, computed):
    axis = f'[[axes]]\npath = "load.radial"\nvalues = {LOADS}'
    file = study_file(tmp_path, axis)
    begun(tmp_path / "out", OTHER, OTHER, study=load_study(file))
    command = ["study", "run", str(file), "-o", str(tmp_path / "out")]
    assert cli.main(command) == 2 and not computed
    assert "2 of the 2 finished cases" in capsys.readouterr().err
    assert cli.main([*command, "--other-version"]) == 0 and computed == [1]


def test_a_map_asks_as_well(tmp_path, computed, monkeypatch, caplog):
    load = Unknown(name="load", reason="r", paths={"load.radial": 1.0}, range=("500 N", "2 kN"))
    spec = Map(case=short_case(), unknowns=(load,), outputs=("cage_speed",), count=2)
    begun(tmp_path / "m", OTHER, study=spec.study())
    with pytest.raises(InputError, match="1 of the 1 finished cases.*other_version=True"):
        maps.run_map(spec, out=tmp_path / "m")
    assert not (tmp_path / "m/map.json").exists()
    monkeypatch.setattr(study_run, "make_plan", lambda study: pytest.fail("planned again"))
    results = maps.run_map(spec, out=tmp_path / "m", other_version=True)
    assert any("Different versions" in text for text in results.study.cautions())
    assert caplog.text.count("would mix different physics") == 1


def test_a_convergence_study_asks_as_well(tmp_path, monkeypatch):
    """Two of its three runs are there, of other physics."""
    case, ran = short_case(), []
    for level in converge.levels(case, ["tolerance"])[:2]:
        folder = tmp_path / "cases" / level.case.hash
        folder.mkdir(parents=True)
        (folder / "summary.json").write_text("{}")
        (folder / "origin.json").write_text(json.dumps(OTHER.to_store()))

    class Stopped(Exception):
        pass

    def run_all(*_):
        ran.append(1)
        raise Stopped

    monkeypatch.setattr(converge, "_run_all", run_all)
    with pytest.raises(InputError, match="2 of the 2 finished cases.*with the 1 still to compute"):
        converge.converge(case, out=tmp_path, axes=["tolerance"])
    assert not ran
    with pytest.raises(Stopped):
        converge.converge(case, out=tmp_path, axes=["tolerance"], other_version=True)


def test_a_worker_of_other_physics_computes_nothing(tmp_path):
    folder = Folder(tmp_path / "s")
    plan = make_plan(short_study())
    folder.prepare(plan)
    order = replace(work.order_of(plan, plan.cases[0], folder.path), origin=OTHER)
    assert work.do_case(order) == "failed"
    assert f"planned by flexcage {OTHER}" in folder.failure(order.hash).reason
