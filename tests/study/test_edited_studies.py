"""An edit after the run gives no result another name: it is named and ignored, or refused.

Also rows that different versions of flexcage computed, which are not put together unseen.
"""

import json
import shutil
from dataclasses import replace

import numpy as np
import pytest
from study_cases import short_case, short_study

from flexcage import cli
from flexcage.core.errors import InputError
from flexcage.core.hashing import sealed
from flexcage.study import maps
from flexcage.study.about import plain
from flexcage.study.axes import Grid
from flexcage.study.case_row import CaseRow
from flexcage.study.folder import Folder
from flexcage.study.maps import Map, MapResults
from flexcage.study.origin import Origin, this_one
from flexcage.study.outputs import StudyFigure
from flexcage.study.plan import make_plan
from flexcage.study.results import StudyResults
from flexcage.study.samples import samples_of
from flexcage.study.surface import surface_through
from flexcage.study.unknowns import Unknown

HERE = this_one()
LOADS = Grid("load.radial", ["500 N", "1000 N", "2000 N", "3000 N", "4000 N"])


def write_rows(folder, plan, origin=HERE):
    """Rows as workers write them: the figure follows from the load, which the case's text has."""
    for planned in plan.cases:
        case = plan.case(planned)
        part = folder.case(planned.hash)
        part.mkdir(exist_ok=True)
        (part / "case.toml").write_text(case.to_toml())
        figures = {"cage_speed": StudyFigure(case.load.radial / 10.0, "rad/s", "rpm")}
        values = plain(planned.point.values)
        folder.write_row(part, CaseRow(planned.hash, 1.0, figures, (), values, origin))


@pytest.fixture
def done(tmp_path):
    """A finished study of five loads."""
    folder = Folder(tmp_path / "study")
    plan = make_plan(short_study(LOADS))
    folder.prepare(plan)
    write_rows(folder, plan)
    return folder


def edit(file, old, new):
    text = file.read_text()
    assert old in text
    file.write_text(text.replace(old, new))


EDITS = {
    "a value": ('"1000 N"', '"9000 N"', "axes[0].values[1] is 9000 N, was 1000 N"),
    "swapped values": ('"500 N", "1000 N"', '"1000 N", "500 N"', "axes[0].values[0] is 1000 N"),
    "another path": (
        'path = "load.radial"', 'path = "load.axial"', "axes[0].path is load.axial",
    ),
    "the seed": ("seed = 1\n", "seed = 7\n", "seed is 7, was 1"),
    "no TOML": ("[[axes]]", "[[axes]", "is no study any more"),
}  # fmt: skip


@pytest.mark.parametrize("name", EDITS)
def test_an_edited_study_keeps_the_labels_of_what_was_computed(name, done, tmp_path, capsys):
    old, new, words = EDITS[name]
    edit(done.path / "study.toml", old, new)
    assert cli.main(["study", "report", str(done.path)]) == 0
    shown = capsys.readouterr()
    assert words in shown.err and words in " ".join(shown.out.split())
    results = StudyResults(done.path)
    table = results.table
    assert list(table["load.radial [N]"]) == [500.0, 1000.0, 2000.0, 3000.0, 4000.0]
    assert list(table["cage_speed [rad/s]"] * 10.0) == list(table["load.radial [N]"])
    written = (done.path / "table.csv").read_text()
    page = results.page(tmp_path / "page.html").read_text("utf-8")
    assert "9000" not in written and "load.radial [N]" in written
    assert "was edited" in page or "was changed" in page
    assert "500 N, 1000 N, 2000 N, 3000 N, 4000 N" in page


def test_an_edited_plan_or_row_is_refused(done, capsys):
    plan, row = done.path / "plan.json", next(done.cases.glob("*/row.json"))
    for file, old, new, words in (
        (plan, '"load.radial": "1000 N"', '"load.radial": "9000 N"', "resume"),
        (row, '"cage_speed"', '"cage_sped"', "it was edited; remove it"),
    ):
        kept = file.read_text()
        edit(file, old, new)
        assert cli.main(["study", "report", str(done.path)]) == 2
        said = capsys.readouterr().err
        assert words in said and said.count("\n") == 1 and str(file.parent) in said
        file.write_text(kept)
    assert cli.main(["study", "report", str(done.path)]) == 0


DEEP = "[" * 200_000


@pytest.mark.parametrize("name", ["plan.json", "cases/{}/row.json", "failed/{}.json"])
def test_a_text_nested_too_deep_is_refused(done, capsys, name):
    (done.path / name.format(done.about()[1][0].hash)).write_text(DEEP)
    assert cli.main(["study", "report", str(done.path)]) == 2
    said = capsys.readouterr().err
    assert said.count("\n") == 1 and str(done.path) in said


def test_a_case_in_the_place_of_another_is_refused(done):
    first, second = (done.case(p.hash) for p in done.about()[1][:2])
    shutil.rmtree(first)
    shutil.copytree(second, first)
    with pytest.raises(InputError, match=f"but of {second.name}"):
        StudyResults(done.path).report()


def test_a_surface_is_laid_over_the_values_of_the_runs(done):
    edit(done.path / "study.toml", '"500 N"', '"1500 N"')
    samples = samples_of(StudyResults(done.path), "cage_speed")
    assert list(samples.x[:, 0]) == list(10.0 * samples.y)
    (caution,) = samples.cautions
    assert "axes[0].values[0] is 1500 N, was 500 N" in caution
    noisy = replace(samples, y=samples.y + np.array([0.1, -0.1, 0.1, -0.2, 0.1]))
    assert caution in surface_through(noisy, models=("quadratic",)).report()


@pytest.mark.parametrize("lacking", ["seal", "warnings", "values", "origin"])
def test_a_row_that_lacks_something_is_refused(lacking, done):
    file = next(done.cases.glob("*/row.json"))
    row = json.loads(file.read_text())
    kept = {key: value for key, value in row.items() if key not in (lacking, "seal")}
    file.write_text(json.dumps(kept if lacking == "seal" else sealed(kept)))
    with pytest.raises(InputError, match="row.json' does not hold the figures"):
        StudyResults(done.path).report()


def test_rows_of_different_versions_are_told_apart(done, tmp_path):
    same = StudyResults(done.path)
    assert not same.cautions()
    plan = make_plan(short_study(Grid("load.radial", ["500 N", "1 kN"])))
    done.prepare(plan)
    case = done.about()[1][0]
    figures = {"cage_speed": StudyFigure(50.0, "rad/s", "rpm")}
    other = CaseRow(case.hash, 1.0, figures, (), plain(case.point.values), Origin("0.0.9", "a" * 8))
    done.write_row(done.case(case.hash), other)
    results = StudyResults(done.path)
    words = f"1 by 0.0.9 (physics aaaaaaaa), 1 by {this_one()}"
    assert words in " ".join(results.report().split())
    assert words in results.page(tmp_path / "page.html").read_text("utf-8")
    assert list(results.table["version"])[0].startswith("0.0.9")


def small_map():
    load = Unknown(name="load", reason="r", paths={"load.radial": 1.0}, range=("500 N", "2 kN"))
    return Map(case=short_case(), unknowns=(load,), outputs=("cage_speed",), count=2)


@pytest.fixture
def mapped(tmp_path, monkeypatch):
    """A finished map of two points."""

    def run(plan, folder, *_, **__):
        write_rows(folder, plan)

    monkeypatch.setattr(maps, "run_plan", run)
    return maps.run_map(small_map(), out=tmp_path / "map")


def test_a_map_nested_too_deep_is_refused(mapped):
    folder = mapped.study.folder.path
    (folder / "map.json").write_text(DEEP)
    with pytest.raises(InputError, match="does not hold the map of this folder"):
        MapResults(folder)


def test_an_edited_map_is_refused(mapped):
    folder = mapped.study.folder.path
    edit(folder / "map.json", '"conditions": [\n  "base"', '"conditions": [\n  "fast"')
    with pytest.raises(InputError, match="it was edited"):
        MapResults(folder)


def test_a_map_beside_the_cases_of_another_is_refused(mapped):
    """As when a changed map is killed before its map.json is written."""
    folder = mapped.study.folder
    folder.prepare(make_plan(small_map().study((1,))))
    with pytest.raises(InputError, match="belongs to other cases"):
        MapResults(folder.path)


def test_an_edited_study_of_a_map_changes_nothing(mapped):
    folder, before = mapped.study.folder.path, mapped.table
    value = str(before["load"][0])
    edit(folder / "study.toml", f'"load.radial" = "{value}"', '"load.radial" = "7 kN"')
    after = MapResults(folder)
    assert after.table.equals(before)
    assert "was edited" in " ".join(after.study.cautions())
