"""What is given as a path: one sentence for what is none, and ~ is the home folder everywhere."""

from __future__ import annotations

from types import SimpleNamespace

import pytest

import flexcage
from flexcage.core.errors import InputError
from flexcage.mesh.io import read_mesh, write_mesh
from flexcage.mesh.series import new_folder
from flexcage.modes.exchange.formats import read_body, write_body
from flexcage.report.page import write_page
from flexcage.results import export
from flexcage.results.row import SummaryRow
from flexcage.results.summary import Section, Summary
from flexcage.run.run import Run
from flexcage.study import compare

CASE = flexcage.load_case('[bearing]\npreset = "N1013"\n')

ENTRANCES = {
    "simulate": lambda path: flexcage.simulate(CASE, out=path),
    "load_run": flexcage.load_run,
    "StudyResults": flexcage.StudyResults,
    "converge": lambda path: flexcage.converge(CASE, out=path),
    "compare": lambda path: compare.compare(path, path),
    "draw": lambda path: Run.draw(SimpleNamespace(), path),
    "Run.write_table": lambda path: Run.write_table(SimpleNamespace(), path),
    "write_table": lambda path: export.write_table(None, path),
    "write_vtu": new_folder,
    "write_page": lambda path: write_page(None, path),
    "write_mesh": lambda path: write_mesh(None, path),
    "read_mesh": read_mesh,
    "write_body": lambda path: write_body(None, path),
    "read_body": read_body,
}


@pytest.mark.parametrize("value", [3, ["a"], b"x", {"a": 1}])
@pytest.mark.parametrize("entrance", ENTRANCES)
def test_what_is_no_path_gets_one_sentence(entrance, value):
    with pytest.raises(InputError, match="should be a str or PathLike; the path of a file or fold"):
        ENTRANCES[entrance](value)


@pytest.mark.parametrize("entrance", ["simulate", "draw", "write_vtu", "read_mesh"])
def test_a_home_folder_is_found(tmp_path, monkeypatch, entrance):
    """A folder that is called ~ would come to be elsewhere, and nobody find the results."""
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.chdir(tmp_path)
    (tmp_path / "out.msh").write_text("a file, where a folder or a mesh belongs")
    with pytest.raises(InputError, match=f"{tmp_path}/out.msh"):
        ENTRANCES[entrance]("~/out.msh")
    assert not (tmp_path / "~").exists()


def test_a_figure_is_named_by_text():
    summary = Summary((Section("Speeds", (SummaryRow("cage_speed", "Cage speed", 1.0),)),))
    with pytest.raises(KeyError, match="has no figure '3'"):
        summary[3]


@pytest.mark.parametrize("case", [None, "case.toml", 3])
def test_a_traction_law_needs_a_case(case):
    with pytest.raises(InputError, match="load_static reads one from a file"):
        flexcage.ehl_traction(case)
