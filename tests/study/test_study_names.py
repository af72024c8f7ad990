"""No name and no link of a study's folder leads out of it."""

import json

import pytest
from study_cases import row_of, short_case, short_study, study_file

from flexcage import cli
from flexcage.core.errors import InputError
from flexcage.core.hashing import sealed
from flexcage.study.axes import Grid
from flexcage.study.folder import Folder
from flexcage.study.maps import Map
from flexcage.study.outputs import StudyFigure
from flexcage.study.plan import make_plan
from flexcage.study.results import StudyResults
from flexcage.study.unknowns import Unknown

OUTSIDE = ["../../escaped_study", "/tmp/x", "a/b", "..", ""]


@pytest.mark.parametrize("name", OUTSIDE)
def test_a_studys_name_stays_in_its_folder(name, tmp_path, capsys, monkeypatch):
    file = study_file(tmp_path)
    file.write_text(file.read_text().replace('name = "small"', f'name = "{name}"'))
    (tmp_path / "a" / "b").mkdir(parents=True)
    monkeypatch.chdir(tmp_path / "a" / "b")
    assert cli.main(["study", "run", str(file)]) == 2
    said = capsys.readouterr().err
    assert "name" in said and repr(name) in said and said.count("\n") == 1
    assert not (tmp_path / "escaped_study").exists() and not list((tmp_path / "a" / "b").iterdir())


@pytest.mark.parametrize("name", OUTSIDE)
def test_a_maps_name_stays_in_its_folder(name):
    load = Unknown(name="load", reason="r", paths={"load.radial": 1.0}, range=("500 N", "2 kN"))
    with pytest.raises(InputError, match="map's name is"):
        Map(name=name, case=short_case(), unknowns=(load,), outputs=("cage_speed",))


@pytest.fixture
def done(tmp_path):
    """A finished study, and a file elsewhere that must stay as it is."""
    folder = Folder(tmp_path / "study")
    plan = make_plan(short_study(Grid("load.radial", ["500 N", "1 kN"])))
    folder.prepare(plan)
    for planned in plan.cases:
        folder.case(planned.hash).mkdir()
        row = row_of(planned, {"cage_speed": StudyFigure(1.0, "rad/s", "rpm")})
        folder.write_row(folder.case(planned.hash), row)
    victim = tmp_path / "victim"
    victim.write_text("mine")
    return folder, victim


@pytest.mark.parametrize("name", ["table.csv", "table.parquet", "statistics.csv"])
def test_tables_are_not_written_through_links(done, name):
    folder, victim = done
    (folder.path / name).symlink_to(victim)
    assert cli.main(["study", "report", str(folder.path)]) == 0
    assert victim.read_text() == "mine" and not (folder.path / name).is_symlink()


@pytest.mark.parametrize("name", ["study.toml", "plan.json", "cases", "failed"])
@pytest.mark.parametrize("action", ["report", "status", "resume"])
def test_a_linked_part_of_the_folder_is_refused(done, name, action, capsys):
    folder, _ = done
    elsewhere = folder.path.parent / "elsewhere"
    (folder.path / name).rename(elsewhere)
    (folder.path / name).symlink_to(elsewhere)
    assert cli.main(["study", action, str(folder.path)]) == 2
    said = capsys.readouterr().err
    assert f"{name}' is a link to" in said and said.count("\n") == 1


def test_a_linked_case_or_row_is_refused(done):
    folder, victim = done
    first, second = (p.hash for p in folder.about()[1])
    row = folder.case(first) / "row.json"
    row.unlink()
    row.symlink_to(victim)
    with pytest.raises(InputError, match="is a link to"):
        StudyResults(folder.path).report()
    row.unlink()
    (folder.case(first)).rmdir()
    (folder.cases / first).symlink_to(folder.cases / second)
    with pytest.raises(InputError, match="is a link to"):
        StudyResults(folder.path).report()


def test_a_plan_of_a_stranger_reads_nothing_outside(done):
    """Its seal may well hold: what it names as a case's hash becomes a path."""
    folder, _ = done
    file = folder.path / "plan.json"
    plan = {k: v for k, v in json.loads(file.read_text()).items() if k != "seal"}
    plan["cases"][0][2] = "../../elsewhere"
    file.write_text(json.dumps(sealed(plan)))
    with pytest.raises(
        InputError, match="hash of a case .* must be usable as the name of a folder"
    ):
        StudyResults(folder.path)
