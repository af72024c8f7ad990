"""Plans: which cases a study has, and every mistake found before one of them runs."""

import socket
from dataclasses import replace

import pytest
from study_cases import short_study, study_file

from flexcage import cli
from flexcage.cages.window.defects import CrossbeamDefect
from flexcage.case import load_case
from flexcage.core.errors import InputError
from flexcage.core.wings import FAMILIES
from flexcage.geometry.materials import MATERIALS
from flexcage.results.figures.life import LIFE
from flexcage.study import run
from flexcage.study.axes import Grid, LatinHypercube, Points, Zip
from flexcage.study.folder import Folder
from flexcage.study.maps import load_map
from flexcage.study.outputs import beyond_summary, check_outputs
from flexcage.study.plan import make_plan
from flexcage.study.spec import Repeat, Study, load_study


def test_every_combination_is_a_case():
    study = short_study(
        Grid("load.radial", [500.0, "1 kN"]),  # numbers in Python are SI
        Zip({"drive.speed": ["3000 rpm", "6000 rpm"], "cage.model": ["rigid", "flexible"]}),
        repeat=Repeat(count=3),
    )
    plan = make_plan(study)
    cases = [plan.case(planned) for planned in plan.cases]
    assert len({case.hash for case in cases}) == 12
    assert [c.load.radial for c in cases] == [500.0] * 6 + [1000.0] * 6
    assert {(round(c.drive.speed), c.cage_model) for c in cases} == {
        (314, "rigid"),
        (628, "flexible"),
    }


@pytest.mark.parametrize("family", FAMILIES)
def test_the_cages_motion_and_contacts_are_outputs_of_every_family(family):
    names = ("contact_frequency", "contact_frequency_total", "free_flight_share")
    names += ("whirl_speed_ratio", "velocity_deviation", "velocity_deviation_2khz")
    check_outputs(names, sizes={"element": 12, "pocket": 12}, flexible=False, family=family)


def test_loads_of_rivets_are_outputs_of_ribbon_cages():
    figures = {"sizes": {}, "flexible": True, "family": "ball"}
    check_outputs(("rivet_stress",), **figures, riveted=True)
    with pytest.raises(InputError, match="set cage.type = 'ribbon'"):
        check_outputs(("rivet_stress",), **figures)
    assert beyond_summary(("rivet_stress", "cage_speed")) == ("rivet_stress",)


@pytest.mark.parametrize(
    ("name", "section"),
    [("clearance_initial", "fit"), ("fit_approach", "fit"), (next(iter(LIFE.figures)), "life")],
)
def test_figures_of_a_section_are_outputs_of_cases_that_have_it(name, section):
    figures = {"sizes": {}, "flexible": False, "family": "ball"}
    check_outputs((name,), **figures, sections=[f"section [{section}]"])
    with pytest.raises(InputError, match=rf"no case of the study has it; give \[{section}\]"):
        check_outputs((name,), **figures)


def test_a_study_of_cases_without_a_fit_has_no_clearance_by_fits():
    """The plan says it before anything is computed."""
    with pytest.raises(InputError, match=r"'clearance_initial' is of cases with \[fit\]"):
        make_plan(short_study(outputs=("clearance_initial",)))
    fitted = Grid("fit.shaft", ["k5"])
    plan = make_plan(short_study(fitted, outputs=("clearance_initial",)))
    assert len(plan.cases) == 1


def test_repetitions_differ_in_their_start_alone():
    plan = make_plan(short_study(repeat=Repeat(count=2, push=2e-3, seed=7)))
    first, second = map(plan.case, plan.cases)
    assert first.start.push == second.start.push == 2e-3
    assert (first.start.seed, second.start.seed) == (7, 8)
    assert second.replace("start.seed", 7) == first


def test_values_in_python_may_be_specs(tmp_path):
    bent = CrossbeamDefect(crossbeam=5, displacement=1e-4)
    study = short_study(
        Grid("defects", [(), (bent,)]), Grid("cage.material", [MATERIALS["PEEK"], "PA66"])
    )
    plan = make_plan(study)
    assert [plan.case(p).defects for p in plan.cases[1:3]] == [(), (bent,)]
    assert study.axes[1].values == ("PEEK", "PA66")
    Folder(tmp_path / "study").prepare(plan)
    assert Folder(tmp_path / "study").plan() == plan


def test_cases_of_one_cage_share_its_modes():
    study = short_study(
        Grid("load.radial", ["500 N", "1 kN"]),
        Grid("cage.pocket_width", ["8.2 mm", "8.3 mm"]),
        Grid("cage.model", ["flexible", "rigid"]),
    )
    modes = [planned.modes for planned in make_plan(study).cases]
    assert modes[:4] == modes[4:] and len(set(modes)) == 3
    assert modes[1] == modes[3] == ""


def test_one_repetition_is_the_case_itself():
    study = short_study()
    assert [p.hash for p in make_plan(study).cases] == [study.case.hash]


def test_study_in_text_is_the_study(tmp_path):
    study = short_study(
        Grid("load.radial", [500.0, 1000.0]),
        LatinHypercube({"drive.speed": ["1000 rpm", "9000 rpm"]}, 3),
        Points([{"label": "bent", "defects": [{"type": "crossbeam", "crossbeam": 5,
                                               "displacement": "0.1 mm"}]}, {"label": "sound"}]),
        outputs=("cage_speed", "race_force[race=outer].max"),
        repeat=Repeat(count=2),
    )  # fmt: skip
    folder = Folder(tmp_path / "study")
    folder.prepare(make_plan(study))
    again = folder.study()
    assert again == study
    assert folder.plan() == make_plan(again) == make_plan(study)


def test_a_table_with_a_path_is_a_grid(tmp_path):
    text = '[[axes]]\npath = "load.radial"\nvalues = ["500 N", "1 kN"]'
    study = load_study(study_file(tmp_path, text))
    assert study.axes == (Grid("load.radial", ["500 N", "1 kN"]),)


AXIS = '[[axes]]\npath = "{}"\nvalues = {}\n'
LOAD = AXIS.format("load.radial", '["500 N", "1 kN"]')
LABELS = '[[axes]]\ntype = "list"\n{}\npoints = [{{label = "a", "{}" = "{}"}}, {{label = "b"}}]\n'
MISTAKES = {
    "unknown path": ([AXIS.format("load.radail", '["1 N"]')], ["'radail'", "'radial'"]),
    "unknown room": ([AXIS.format("laod.radial", '["1 N"]')], ["'laod'", "'load'"]),
    "no unit": ([AXIS.format("load.radial", "[500]")], ["load.radial is 500 without a unit"]),
    "no unit in a table": (
        [AXIS.format("defects", '[[{type = "side_beam", pocket = 5, displacement = 0.1}]]')],
        ["displacement is 0.1 without a unit"],
    ),
    "no list": (["axes = 3"], ["axes is 3", "a list"]),
    "empty axis": ([AXIS.format("load.radial", "[]")], ["'load.radial' is empty"]),
    "same path twice": ([LOAD, LOAD], ["Axis 1 and axis 0 both set 'load.radial'"]),
    "another name of a path": (
        [AXIS.format(p, '["rigid"]') for p in ("cage.model", "cage_model")],
        ["both set 'cage_model'"],
    ),
    "a path inside another": (
        [LOAD, '[[axes]]\ntype = "zip"\nvalues = {"load" = [{radial = "1 N"}]}'],
        ["overlap", "'load.radial'"],
    ),
    "a path of the repetitions": (
        [AXIS.format("start.seed", "[1, 2]"), "[repeat]\ncount = 2"],
        ["repeat both set 'start.seed'"],
    ),
    "the seventh point": (
        [AXIS.format("cage.pocket_width", str([f"8.{k} mm" for k in range(2, 8)] + ["12 mm"]))],
        ["Point 7 of 7", "12 mm", "thinner than zero"],
    ),
    "same value twice": ([AXIS.format("load.radial", '["1 kN", "1000 N"]')], ["the same case"]),
    "two columns of labels": (
        [LABELS.format("", "load.radial", "1 N"), LABELS.format("", "drive.speed", "1 rpm")],
        ["Axis 1 shows its labels in a column 'label', but axis 0 does so too"],
    ),
    **{
        f"labels in the column {name}": (
            [LABELS.format(f'name = "{name}"', "load.radial", "1 N")],
            [f"column '{name}', but the tables have a column of that name"],
        )
        for name in (
            "point",
            "repetition",
            "state",
            "reason",
            "warnings",
            "seconds",
            "hash",
            "done",
            "cage_speed",
        )
    },
    "labels in the column of a path": (
        [LABELS.format('name = "drive.speed"', "drive.speed", "1 rpm")],
        ["'drive.speed', but an axis sets that path"],
    ),
    "unknown type": (['[[axes]]\ntype = "grdi"'], ["'grdi'", "'grid'"]),
    "no such type": (
        ['[[axes]]\ntype = "qq"'],
        ["'qq'", "choose from grid, zip, list, lhs, sobol."],
    ),
    "no type": (['[[axes]]\nvalues = ["1 N"]'], ["lacks 'type'", "choose from grid, lhs, list"]),
    "unknown key": (["repeats = 3"], ["'repeats'", "'repeat'"]),
    "no points": (["[repeat]\ncount = 0"], ["repeat.count is 0"]),
    "another version": (["format = 9"], ["format 9", "format 1"]),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes_in_the_file(name, tmp_path, capsys):
    tables, words = MISTAKES[name]
    tables = sorted(tables, key=lambda text: text.startswith("["))
    file = study_file(tmp_path, *tables)
    assert cli.main(["study", "run", str(file), "-o", str(tmp_path / "out")]) == 2
    err = capsys.readouterr().err
    assert err.startswith("flexcage: ") and err.count("\n") == 1
    assert all(word in err for word in words), err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("outputs", "words"),
    [
        ((), "has no outputs"),
        (("cage_sped",), "'cage_speed'"),
        (("pocket_force",), "'pocket_force.mean'"),
        (("pocket_forse.max",), "'pocket_force'"),
        (("pocket_force.maximum",), "'max'"),
        (("pocket_force[fase=front].max",), "'face'"),
        (("pocket_force[face=frontal].max",), "'front'"),
        (("pocket_force[pocket=22].max",), "pockets count from 0 to 21"),
        (("pocket_force[pocket=3:3].max",), "pocket=3:6"),
        (("pocket_force[pocket=20:23].max",), "pockets count from 0 to 21"),
        (("pocket_slice_force[slice=64].max",), "slices count from 0 to 63"),
        (
            ("element_omega[element=3:5,spin_axis=axial].frequency",),
            "say which element",
        ),
        (("element_omega[element=first].mean",), "counted from 0"),
        (("cage_position[axis=y,axis=z].max",), "says twice which of one dimension is meant"),
        (("contact_angle.mean",), "is of balls, but the study's bearings have rollers"),
        (("contact_angle_inner",), "is of balls"),
        (("stress_peak",), "needs a flexible cage"),
        (("modal_velocity.rms",), "needs a flexible cage"),
        (("element_position.max",), "would mix m, m, rad; say which cyl of element_position"),
        (("ring_deflection[bending=tilt].max",), "every ring of the study is rigid"),
        (("support_force.max",), "no ring of the study has any; set outer_ring.ring = 'flexible'"),
        (("cage_speed", "cage_speed"), "twice"),
    ],
)
def test_outputs_that_no_run_gives(outputs, words):
    with pytest.raises(InputError, match=words):
        make_plan(short_study(outputs=outputs))


def test_outputs_of_a_study_of_ball_bearings():
    case = load_case({"bearing": {"preset": "7010C-PI"}, "load": {"axial": "100 N"}})
    fine = (
        "contact_angle_inner",
        "element_slip_ratio[element=17].mean",
        "race_force[element=0].max",
    )
    make_plan(Study(case=case, outputs=fine))
    for wrong, words in (
        ("roller_spin", "is of rollers, but the study's bearings have balls"),
        ("rib_force.max", "is of rollers"),
        ("race_force[element=18].max", "the balls count from 0 to 17"),
    ):
        with pytest.raises(InputError, match=words):
            make_plan(Study(case=case, outputs=(wrong,)))


def test_a_study_without_a_case(tmp_path):
    (tmp_path / "study.toml").write_text('outputs = ["cage_speed"]')
    with pytest.raises(InputError, match="names no case"):
        load_study(tmp_path / "study.toml")
    (tmp_path / "case.toml").write_text('[bearing]\npreset = "N1013"\n')
    with pytest.raises(InputError, match="is a case, not a study; take 'flexcage run"):
        load_study(tmp_path / "case.toml")
    (tmp_path / "study.toml").write_text('case = "case.toml"\noutputs = ["cage_speed"]')
    with pytest.raises(InputError, match="is a study, not a case; take 'flexcage study run"):
        load_case(tmp_path / "study.toml")


def test_maps_and_studies_name_each_others_commands(tmp_path):
    (tmp_path / "case.toml").write_text('[bearing]\npreset = "N1013"\n')
    head = 'case = "case.toml"\noutputs = ["cage_speed"]\n'
    axis = 'path = "load.radial"\nvalues = ["1 N"]\n'
    study, a_map = tmp_path / "study.toml", tmp_path / "map.toml"
    study.write_text(f"{head}[[axes]]\n{axis}")
    a_map.write_text(f"{head}[[unknowns]]\n{axis}")
    with pytest.raises(InputError, match="is a map, not a study; take 'flexcage study map"):
        load_study(a_map)
    with pytest.raises(InputError, match="is a study, not a map; take 'flexcage study run"):
        load_map(study)
    with pytest.raises(InputError, match="is a case, not a map; take 'flexcage run"):
        load_map(tmp_path / "case.toml")
    with pytest.raises(InputError, match="is a map, not a case; take 'flexcage study map"):
        load_case(a_map)


def test_lists_without_labels_share_no_column():
    axes = [Points([{path: value}, {}]) for path, value in (("load.radial", "1 N"),
                                                            ("drive.speed", "1 rpm"))]  # fmt: skip
    assert len(make_plan(short_study(*axes)).cases) == 4
    named = replace(axes[0], name="state"), axes[1]
    assert len(make_plan(short_study(*named)).cases) == 4


@pytest.mark.parametrize("text", ["{", '"a"', '{"format": 1}', '{"format": 1, "seconds": 1.0, '
                                  '"figures": {"cage_speed": 3.0}}'])  # fmt: skip
def test_a_broken_row_is_named(text, tmp_path, capsys):
    folder, plan = Folder(tmp_path / "s"), make_plan(short_study())
    folder.prepare(plan)
    name = plan.cases[0].hash
    folder.case(name).mkdir()
    (folder.case(name) / "row.json").write_text(text)
    err = refusal(capsys, "study", "status", str(folder.path))
    assert f"{name}/row.json" in err and "remove it to compute the case anew" in err
    (folder.case(name) / "row.json").unlink()
    (folder.failed / f"{name}.json").write_text(text)
    err = refusal(capsys, "study", "status", str(folder.path))
    assert f"{name}.json" in err and "remove it to compute the case anew" in err


def test_a_broken_plan_is_written_again_by_resume(tmp_path, capsys, monkeypatch):
    folder, plan = Folder(tmp_path / "s"), make_plan(short_study())
    folder.prepare(plan)
    for text in ("{", "[]", "3", "null", '["a", "b"]'):
        (folder.path / "plan.json").write_text(text)
        err = refusal(capsys, "study", "status", str(folder.path))
        assert f"'flexcage study resume {folder.path}', which plans it anew" in err
        with monkeypatch.context() as patch:
            patch.setattr(run, "_compute", lambda *args: None)
            assert cli.main(["study", "resume", str(folder.path)]) == 0
        capsys.readouterr()
        assert folder.plan() == plan


def refusal(capsys, *command):
    """What the command line says as it refuses, one sentence."""
    assert cli.main(list(command)) == 2
    err = capsys.readouterr().err
    assert err.startswith("flexcage: ") and err.count("\n") == 1, err
    return err


def test_a_folder_with_other_things_is_left_alone(tmp_path):
    text = study_file(tmp_path, LOAD).read_text()
    with pytest.raises(InputError, match="holds files and no study"):
        Folder(tmp_path).prepare(make_plan(load_study(tmp_path / "study.toml")))
    assert (tmp_path / "study.toml").read_text() == text


def test_a_folder_of_another_version_is_refused(tmp_path, capsys):
    Folder(tmp_path).prepare(make_plan(short_study()))
    text = (tmp_path / "study.toml").read_text().replace("format = 1", "format = 2")
    (tmp_path / "study.toml").write_text(text)
    for action in ("status", "report", "resume"):
        assert cli.main(["study", action, str(tmp_path)]) == 2
        assert "is a study of format 2" in capsys.readouterr().err
    with pytest.raises(InputError, match="format 2"):
        Folder(tmp_path).prepare(make_plan(short_study()))


def test_a_scheduler_that_does_not_answer(tmp_path, capsys, monkeypatch):
    from flexcage.study import cluster

    monkeypatch.setattr(cluster, "ANSWER", 0.3)
    file = study_file(tmp_path, LOAD)
    with socket.socket() as silent:
        silent.bind(("127.0.0.1", 0))
        silent.listen()
        port = silent.getsockname()[1]
        for address in (f"127.0.0.1:{port}", "tcp://127.0.0.1:1", "x:y", "tls://127.0.0.1:1"):
            command = ["study", "run", str(file), "-o", str(tmp_path / "out")]
            assert cli.main([*command, "--scheduler", address]) == 2
            err = capsys.readouterr().err
            assert f"No scheduler answers at '{address}'" in err
            assert [line[:9] for line in err.splitlines()] == ["warning: ", "flexcage:"]


def test_a_missing_package_is_named(tmp_path, capsys, monkeypatch):
    from flexcage.study import cluster

    monkeypatch.setattr(cluster, "find_spec", lambda name: None)
    assert cli.main(["study", "run", str(study_file(tmp_path, LOAD)), "-o", str(tmp_path)]) == 1
    assert "sources:  pip install '.[study]'" in capsys.readouterr().err


def test_one_axis_and_one_output_need_no_tuple():
    """A text alone was taken for its letters."""
    found = Study(
        case=short_study().case, axes=Grid("load.radial", (1.0, 2.0)), outputs="cage_speed"
    )
    assert found.outputs == ("cage_speed",) and len(found.axes) == 1
    assert len(make_plan(found).cases) == 2
