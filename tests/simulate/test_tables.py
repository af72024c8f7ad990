"""A run's variables go to other programs as tables, as the page on results says."""

import re
import shlex
from pathlib import Path

import numpy as np
import pandas as pd
import pytest
from scipy.io import loadmat
from simulate_cases import bent, n1013

from flexcage import load_run, simulate
from flexcage.cli import main
from flexcage.core.errors import InputError

PAGE = Path(__file__).parents[2] / "examples" / "results.md"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("here")
    simulate(n1013({"solver.duration": "1 ms"}, defects=bent("0.2 mm")), out=folder / "runs/n1013")
    return folder


def test_the_calls_of_the_page_work(folder, monkeypatch, capsys):
    """As printed, in Python and on the command line."""
    section = PAGE.read_text("utf-8").split("## Files for other programs")[1].split("\n## ")[0]
    code = re.findall(r"```python\n(.*?)```", section, flags=re.S)[0]
    lines = re.findall(r"```text\n(.*?)```", section, flags=re.S)[0].splitlines()
    monkeypatch.chdir(folder)
    run = load_run("runs/n1013")
    exec(code, {"run": run})
    for line in lines:
        assert main(shlex.split(line)[1:]) == 0
    assert capsys.readouterr().out.count("written: ") == 2
    assert {p.name for p in folder.iterdir()} == {
        "all_time.csv", "all_time_hf.csv", "contacts.parquet", "acceleration.csv", "run.nc",
        "forces.csv", "vibration.mat", "runs",
    }  # fmt: skip
    table = pd.read_csv("forces.csv", float_precision="round_trip")
    forces, history = run.dataset["pocket_force"], run.stress_history
    heading = "pocket_force[pocket=5,face=rear] (N)"
    assert np.array_equal(table[heading], forces.sel(pocket=5, face="rear"))
    assert table.shape == (50, 1 + forces[0].size + len(history.place_names))
    place = history.place_names[3]
    np.testing.assert_allclose(table[f"stress[place={place}] (Pa)"], history.places[:, 3])
    matrices = loadmat("vibration.mat", simplify_cells=True)
    assert np.array_equal(matrices["outer_acceleration"], run.dataset["outer_acceleration"])
    events = pd.read_parquet("contacts.parquet")
    assert len(events) == run.events.sizes["event"]
    assert set(events["event_place"]) == set(run.events["place"].values)


def test_all_a_run_has_goes_to_a_table(folder, tmp_path):
    run = load_run(folder / "runs/n1013")
    names = [*run.dataset.data_vars, "stress_peak", "film_thickness", "steps", "revolution"]
    paths = run.write_table(tmp_path / "a.parquet", names)
    assert [p.stem for p in paths] == ["a_time", "a_time_hf", "a_step"]
    main_, fine, steps = (pd.read_parquet(path) for path in paths)
    assert len(main_) == 50 and len(fine) == 200 and len(steps) == len(run.steps["time"])
    assert np.array_equal(steps["step_size (s)"], run.steps["step"])
    assert np.array_equal(main_["stress_peak (Pa)"], run.stress_history.peak)
    film = run.film_thickness.sel(element=4, race="outer", film="least")
    heading = "film_thickness[element=4,race=outer,film=least] (m)"
    np.testing.assert_array_equal(main_[heading], film)


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (["a.csv", "pocket_forc"], "the nearest known one is 'pocket_force'"),
        (["a.csv", "stres"], "the nearest known one is 'stress'"),
        (["a.xls"], "should end in .csv, .parquet or .mat"),
        (["a.csv", "--from", "2 ms"], "--from does not go with --table"),
        (["a.csv", "-o", "x"], "-o does not go with --table"),
    ],
)
def test_mistakes_get_one_sentence(folder, tmp_path, monkeypatch, capsys, words, told):
    monkeypatch.chdir(tmp_path)
    assert main(["export", str(folder / "runs/n1013"), "--table", *words]) == 2
    said = capsys.readouterr().err
    assert told in said and said.count("\n") == 1 and not list(tmp_path.iterdir())


def test_a_rigid_cage_has_no_stress_to_write(tmp_path):
    run = simulate(n1013({"solver.duration": "0.2 ms", "cage.model": "rigid"}))
    with pytest.raises(InputError, match="a rigid cage has no stress"):
        run.write_table(tmp_path / "a.csv", ["stress"])
