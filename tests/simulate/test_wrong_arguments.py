"""What a script gets wrong is told in one sentence with its value, as a case's mistakes are."""

import numpy as np
import pytest
from simulate_cases import n1013

import flexcage
from flexcage import run_study, solve_static
from flexcage.core.errors import InputError, RunFailed
from flexcage.render import album
from flexcage.results import registry
from flexcage.results.registry import Variable, register
from flexcage.simulate import simulate
from flexcage.spec import SNCurve, WearLaw

SHORT = {"solver.duration": "1 ms"}
BRASS = {"material": "brass", "source": "ours"}


@pytest.fixture(scope="module")
def flexible():
    return simulate(n1013(SHORT))


@pytest.fixture(scope="module")
def rigid():
    return simulate(n1013(SHORT, {"cage.model": "rigid"}))


def refused(call, *words):
    with pytest.raises(InputError) as caught:
        call()
    sentence = str(caught.value)
    assert "\n" not in sentence
    assert all(word in sentence for word in words), sentence


def test_a_time_carries_its_unit_or_is_in_seconds(flexible):
    by_text, by_number = flexible.stress(time="0.5 ms"), flexible.stress(time=5e-4)
    assert by_text.time == by_number.time == pytest.approx(5e-4, abs=1e-5)
    np.testing.assert_array_equal(by_text.stress, by_number.stress)
    for time in (np.float64(5e-4), np.array(5e-4), flexible.dataset["time"][24]):
        assert flexible.stress(time=time).time == by_number.time


@pytest.mark.parametrize("time", [0.5, -1.0, float("nan"), "500 ms"])
def test_stress_beyond_the_run(flexible, time):
    refused(lambda: flexible.stress(time=time), "no sample at", "the run has 0.02 to 1 ms")


def test_times_that_are_none(flexible, tmp_path):
    refused(lambda: flexible.stress(time=[1e-4]), "time is [0.0001], but should be a number")
    refused(lambda: flexible.stress(time="0.5"), "time is 0.5 without a unit")
    for times in (5e-4, [], "0.5 ms"):
        refused(lambda t=times: flexible.write_vtu(tmp_path / "v", times=t), "a list of times")
    refused(lambda: flexible.write_vtu(tmp_path / "v", times=["a"]), "time is 'a'")
    assert not (tmp_path / "v").exists()


@pytest.mark.parametrize(
    ("wrong", "words"),
    [
        ({"slope": -3.0}, "curve.slope is -3"),
        ({"cycles": 0.0}, "curve.cycles is 0"),
        ({"amplitude": -40e6}, "curve.amplitude is -40"),
        ({"amplitude": "40 MPa"}, "curve.amplitude is '40 MPa'"),
        ({"amplitude": 40.0}, "curve.amplitude is 4e-05 MPa, but must be 0.1 MPa or more"),
        ({"tensile_strength": 97.0}, "curve.tensile_strength is 9.7e-05 MPa, but must be 0.1 MPa"),
        ({"tensile_strength": 97e6}, "97 MPa, less than the amplitude of 120 MPa"),
    ],
)
def test_curves_out_of_bounds(flexible, wrong, words):
    pytest.importorskip("pylife")
    fine = {"amplitude": 120e6, "cycles": 1e8, "slope": 11.0, "tensile_strength": 370e6}
    refused(lambda: flexible.fatigue(curve=SNCurve(**BRASS, **fine | wrong)), words)


def test_fatigue_of_what_has_none(flexible, rigid):
    curve = SNCurve(**BRASS, amplitude=1e8, cycles=1e8, slope=11.0, tensile_strength=3e8)
    refused(lambda: flexible.fatigue(curve), "by its name")
    refused(lambda: rigid.fatigue(), "rigid cage has no stress")
    pytest.importorskip("pylife")
    for rows in (0, -1):
        refused(lambda n=rows: flexible.fatigue().table(n), f"rows is {rows}")


def test_wear_that_cannot_be(rigid):
    refused(lambda: rigid.wear(WearLaw(**BRASS, coefficient=-1e-17)), "is -1e-08 mm^3")
    as_cubic_millimetres = WearLaw(**BRASS, coefficient=1e-8)
    refused(
        lambda: rigid.wear(as_cubic_millimetres),
        "is 10 mm^3/(N*m), but must be 0.1 mm^3/(N*m) or less",
    )
    refused(lambda: rigid.wear(1e-17), "law is 1e-17", "a WearLaw")
    worn = rigid.wear(WearLaw(**BRASS, coefficient=1e-17))
    for hours, words in ((-2.0, "hours is -2"), (float("nan"), "hours is nan"), ("2 h", "'2 h'")):
        refused(lambda h=hours: worn.depth(h), words)
    assert float(worn.depth(0).max()) == 0.0
    assert float(worn.depth(np.int64(2)).max()) == float(worn.depth(2.0).max())
    assert "the cage is of" not in str(worn)
    other = rigid.wear(WearLaw(material="PA66", coefficient=1e-17))
    assert "the values are of PA66, and the cage is of brass" in str(other)


def test_fatigue_by_a_curve_of_another_material(flexible):
    pytest.importorskip("pylife")
    fine = {"amplitude": 35e6, "cycles": 1e7, "slope": 29.6, "tensile_strength": 83e6}
    found = flexible.fatigue(curve=SNCurve(material="PA66", **fine))
    assert "the values are of PA66, and the cage is of brass" in found.table(1)


def test_a_file_is_no_case(tmp_path):
    refused(lambda: simulate("n1013.toml"), "case is 'n1013.toml'", "load_case")
    refused(lambda: solve_static("n1013.toml"), "StaticCase or Case", "load_static")
    refused(lambda: run_study("study.toml", out=tmp_path), "a Study", "load_study")


def test_another_case_is_not_resumed_and_what_differs_is_named(tmp_path):
    case = n1013(SHORT, {"cage.model": "rigid"})
    simulate(case, out=tmp_path)
    other = case.replace({"load.radial": "900 N", "solver.duration": "2 ms", "name": "other"})
    assert list(other.difference(case)) == ["load.radial", "solver.duration"]
    refused(
        lambda: simulate(other, out=tmp_path, resume=True),
        "load.radial is 900 N, was 1000 N", "solver.duration is 0.002 s, was 0.001 s",
    )  # fmt: skip


def broken(*_arguments):
    raise ZeroDivisionError("boom")


def test_a_users_picture_or_variable_that_fails_is_told_as_the_users(rigid, tmp_path, monkeypatch):
    monkeypatch.setitem(album.PICTURES, "mine", (broken, False))
    with pytest.raises(RunFailed, match=r"picture 'mine' .*boom .*test_wrong_arguments.py, line"):
        rigid.draw(tmp_path)
    assert (tmp_path / "bearing.png").exists()
    register(Variable("mine", ("time",), "N", "mine"), broken)
    for table in (registry.VARIABLES._added, registry.COMPUTED):
        monkeypatch.setitem(table, "mine", table.pop("mine"))  # and gone after this test
    with pytest.raises(RunFailed, match=r"variable 'mine' .*boom .*test_wrong_arguments.py, line"):
        simulate(rigid.case)


def test_a_file_where_a_folder_belongs(rigid, tmp_path):
    (file := tmp_path / "a.png").write_text("mine")
    for call in (
        lambda: simulate(n1013(SHORT), out=file),
        lambda: rigid.draw(file),
    ):
        refused(call, f"'{file}' is a file; name a folder for the output.")
    refused(lambda: rigid.report(tmp_path / "page.pdf"), "page.pdf' should end in .html.")
    assert file.read_text() == "mine" and list(tmp_path.iterdir()) == [file]


def test_one_variable_may_be_a_name(rigid, tmp_path):
    one, listed = (
        rigid.write_table(tmp_path / f"{k}.csv", names)
        for k, names in enumerate(("race_force", ["race_force"]))
    )
    assert one[0].read_bytes() == listed[0].read_bytes()


@pytest.mark.parametrize("what", ["case", "preset", "readings", "run", "static", "study"])
@pytest.mark.parametrize("wrong", [None, 5, ["n1013.toml"]])
def test_what_is_loaded_has_a_name(what, wrong):
    named = {"static": "case"}.get(what, what)
    refused(lambda: getattr(flexcage, f"load_{what}")(wrong), named, f"{wrong!r}", "a str")
