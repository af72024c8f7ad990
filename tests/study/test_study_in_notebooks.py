"""What a notebook shows of a study: what its report says."""

from xml.etree import ElementTree

from study_cases import row_of, short_study

from flexcage.core.warning import RunWarning
from flexcage.study import Grid, StudyResults
from flexcage.study.folder import Folder
from flexcage.study.outputs import StudyFigure
from flexcage.study.plan import make_plan


def stored(folder, loads):
    """A study over loads; all cases but the last are done, the first with a warning."""
    plan = make_plan(short_study(Grid("load.radial", [f"{load} N" for load in loads])))
    out = Folder(folder)
    out.prepare(plan)
    for k, planned in enumerate(plan.cases[:-1]):
        out.case(planned.hash).mkdir()
        figures = {"cage_speed": StudyFigure(100.0 + k, "rad/s", "rpm")}
        warnings = (RunWarning("short", "Too <short>."),) if k == 0 else ()
        out.write_row(out.case(planned.hash), row_of(planned, figures, warnings))
    return StudyResults(folder)


def test_a_study_shows_status_warnings_and_its_table(tmp_path):
    results = stored(tmp_path / "study", [500, 1000, 1500])
    tree = ElementTree.fromstring(results._repr_html_())
    assert tree[0].text == "Study study: 3 cases: 2 done, 0 failed, 1 open"
    assert [item.text for item in tree.iter("li")] == results.warning_lines()
    assert any("Too <short>." in line for line in results.warning_lines())
    rows = [[cell.text or "" for cell in line] for line in tree.iter("tr")]
    lines = [line for line in results.report().splitlines() if line]
    first = next(k for k, line in enumerate(lines) if line.split()[0] == "point")
    table = lines[first : first + 4]
    assert [" ".join(filter(None, row)).split() for row in rows] == [line.split() for line in table]


def test_a_large_study_shows_its_first_points(tmp_path):
    results = stored(tmp_path / "study", range(500, 565))
    tree = ElementTree.fromstring(results._repr_html_())
    assert len(list(tree.iter("tr"))) == 61
    assert [p.text for p in tree.iter("p")] == ["5 more points: statistics"]
