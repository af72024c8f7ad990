"""Maps of a claim from end to end: planned, run once, resumed, judged; and what is refused."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from study_cases import short_case

from flexcage.case import load_extension
from flexcage.cli import main
from flexcage.core.errors import InputError
from flexcage.study.map_report import map_text, write_map
from flexcage.study.maps import Map, MapResults, load_map, run_map
from flexcage.study.outputs import check_outputs, never_negative
from flexcage.study.own import register_outputs
from flexcage.study.plan import make_plan
from flexcage.study.results import StudyResults
from flexcage.study.unknowns import Unknown

OWN = Path(__file__).with_name("my_outputs.py")
MAP = """
name = "small"
case = "short.toml"
use = ["OWN"]
count = 2  # points
starts = 2
outputs = ["cage_speed", "my_last_cage_place", "my_samples"]
conditions = [
  { label = "slow", "drive.speed" = "3000 rpm" },
  { label = "fast", "drive.speed" = "6000 rpm" },
]
[[unknowns]]
name = "load"
path = "load.radial"
range = ["500 N", "2 kN"]
scale = "log"
reason = "a test"
[[unknowns]]
name = "friction"
reason = "a test"
choices = [
  { label = "smooth", "contacts.pocket.friction.dynamic" = 0.02 },
  { label = "rough", "contacts.pocket.friction.dynamic" = 0.2 },
]
"""


def written(folder, text=MAP):
    (folder / "short.toml").write_text(short_case(**{"solver.duration": "0.2 ms"}).to_toml())
    file = folder / "map.toml"
    file.write_text(text.replace("OWN", str(OWN)))
    return file


@pytest.fixture(scope="module")
def done(tmp_path_factory):
    """A map that has run, its spec, and when its first case was finished."""
    folder = tmp_path_factory.mktemp("map")
    spec = load_map(written(folder))
    results = run_map(spec, out=folder / "out", workers=1)
    cases = sorted((folder / "out" / "cases").glob("*/row.json"))
    return spec, results, {case: case.stat().st_mtime_ns for case in cases}


def test_a_map_runs_every_point_under_every_condition_with_starts_of_its_own(done):
    spec, results, cases = done
    assert len(cases) == results.study.count("done") == 2 * 2 * 2
    place = results.values("my_last_cage_place", "fast")
    assert place.shape == (2, 2) and len(np.unique(place)) == 4  # the dummy: another push each
    slow = results.means("cage_speed", "slow")
    np.testing.assert_allclose(results.means("cage_speed", "fast") / slow, 2.0, rtol=0.02)
    assert (results.values("my_samples", "slow") == 10).all()
    assert results.table.shape == (8, 3 + 2 + 3)
    assert results.seconds > 0.0 and 0.0 <= results.noise("my_last_cage_place", "fast")


def test_an_unknown_may_be_how_hard_the_cage_is_pushed(tmp_path):
    """Its pushes take the place of the map's; starts still differ in direction."""
    push = """
[[unknowns]]
name = "push"
path = "start.push"
range = ["10 mm/s", "1000 mm/s"]
scale = "log"
reason = "a test"
"""
    spec = load_map(written(tmp_path, MAP + push))
    cases = [make_plan(spec.study()).case(found) for found in make_plan(spec.study()).cases]
    pushes = sorted({c.start.push for c in cases})
    np.testing.assert_allclose(pushes, np.sort(0.01 * 100.0 ** spec.shares[:, 2]), rtol=1e-5)
    assert len({c.start.seed for c in cases}) == 4


def test_a_map_that_grows_computes_only_what_is_new(done):
    spec, results, cases = done
    table = {**vars(spec), "count": 4}
    larger = Map(**{k: v for k, v in table.items() if k in Map.__dataclass_fields__})
    grown = run_map(larger, out=results.study.folder.path, workers=1)
    assert grown.study.count("done") == 16
    assert {case: case.stat().st_mtime_ns for case in cases} == cases


def test_what_a_map_says_and_writes(done):
    _, results, _ = done
    text = map_text(results)
    assert "unknowns (sample, seed 1), 2 conditions, 2 starts each" in text
    assert "my_samples, slow: no first-order index" in text  # too few points
    names = [path.name for path in write_map(results)]
    assert names == ["map.csv"]


def test_the_command_goes_on_with_a_map(done, tmp_path, capsys):
    spec, results, cases = done
    folder = results.study.folder.path
    assert main(["study", "map", str(folder.parent / "map.toml"), "-o", str(folder)]) == 0
    assert "8 done" in capsys.readouterr().out
    assert {case: case.stat().st_mtime_ns for case in cases} == cases


def test_the_command_computes_some_points_on_another_mesh(done, tmp_path, capsys):
    _, results, _ = done
    file, other = results.study.folder.path.parent / "map.toml", tmp_path / "fine"
    command = ["study", "map", str(file), "-o", str(other), "--workers", "1"]
    assert main([*command, "--points", "1", "--fineness", "medium"]) == 0
    assert "4 done" in capsys.readouterr().out  # two conditions of two starts
    assert StudyResults(other).about.base["mesh"]["fineness"] == "medium"
    with pytest.raises(SystemExit):
        main([*command, "--points", "1,x"])
    assert "should be whole numbers, as 0,3,17" in capsys.readouterr().err


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("count = 2", "count = 5", "take 4 or 8"),
        ('reason = "a test"\n[[unk', 'reason = ""\n[[unk', "'load' has no reason"),
        ('"500 N"', '"5 kN"', "the lower first"),
        ('label = "slow", ', "", "should have a label"),
        ('case = "short.toml"', "", "names no case"),
        ('"my_samples"', '"my_sample"', "no output 'my_sample'; the nearest known one is"),
        ('"load.radial"', '"load.radia"', "load.radia"),
    ],
)
def test_a_mistake_in_a_map_is_one_sentence(tmp_path, capsys, old, new, words):
    file = written(tmp_path, MAP.replace(old, new))
    assert main(["study", "map", str(file), "-o", str(tmp_path / "out")]) == 2
    said = capsys.readouterr().err.strip()
    assert words in said and "\n" not in said and "Traceback" not in said


def test_a_folder_without_a_map_is_refused(tmp_path, done):
    _, results, _ = done
    (tmp_path / "x").mkdir()
    for file in ("study.toml", "plan.json"):
        (tmp_path / "x" / file).write_bytes((results.study.folder.path / file).read_bytes())
    with pytest.raises(InputError, match="does not hold a map"):
        MapResults(tmp_path / "x")


def test_outputs_of_ones_own_are_checked():
    load_extension(OWN)
    known = {"sizes": {}, "flexible": False, "family": "cylindrical_roller"}
    check_outputs(("my_samples", "cage_speed"), **known)
    assert not never_negative("my_last_cage_place")
    for name, what in (
        ("cage_speed", "A figure"),
        ("pocket_force", "A result variable"),
        ("element_slip_ratio", "A result variable"),
    ):
        with pytest.raises(InputError, match=f"{what} '{name}' exists already"):
            register_outputs(lambda run: {}, {name: ""})
    with pytest.raises(InputError, match="'my_force.max', but must be one word"):  # a reduction
        register_outputs(lambda run: {}, {"my_force.max": "N"})
    with pytest.raises(InputError, match="shown in 'furlong'"):
        register_outputs(lambda run: {}, {"my_length": "furlong"})


def test_some_points_of_a_map(done):
    """Those of a recheck are the same cases as in the whole map."""
    spec, _, _ = done
    some, every = spec.study((1,)).axes[0].points, spec.study().axes[0].points
    assert some == every[2:4]
    with pytest.raises(InputError, match="has points 0 to 1"):
        spec.study((2,))


def test_unknowns_are_checked_before_anything_runs():
    one = Unknown(name="x", reason="r", paths={"load.radial": 1.0}, range=("1 N", "2 N"))
    with pytest.raises(InputError, match="both change 'load.radial'"):
        Map(case=short_case(), unknowns=(one, Unknown(
            name="y", reason="r", paths={"load.radial": 1.0}, range=("1 N", "2 N"))),
            outputs=("cage_speed",))  # fmt: skip


def test_the_map_of_the_page_loads(tmp_path):
    """The map that examples/unknowns.md prints, on the example's case."""
    examples = Path(__file__).parents[2] / "examples"
    text = (examples / "unknowns.md").read_text("utf-8")
    toml = text.split("```toml\n")[1].split("```")[0]
    file = tmp_path / "map.toml"
    file.write_text(toml.replace("c7010.toml", str(examples / "c7010.toml")))
    spec = load_map(file)
    assert len(spec.study().axes[0].points) == 32 and spec.names[-1] == "(start)"
