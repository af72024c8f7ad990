"""What the command line says to mistakes: one sentence on standard error, the right exit code."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from flexcage import cli
from flexcage.cli.files import prepare_out

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "n1013.toml")
BALLS = str(Path(__file__).parents[2] / "examples" / "6205_crown.toml")


@pytest.fixture(autouse=True)
def elsewhere(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("FLEXCAGE_CACHE_DIR", str(tmp_path / "cache"))
    monkeypatch.delenv("FLEXCAGE_DEBUG", raising=False)
    return tmp_path


@pytest.fixture
def no_simulation(monkeypatch):
    """Stand-in for the corridor: what it does is set by each test."""
    import types

    import flexcage.study.compare  # noqa: F401  (imported later, it would keep the stand-in)

    module = types.ModuleType("flexcage.simulate")
    monkeypatch.setitem(sys.modules, "flexcage.simulate", module)
    return module


def sentence(capsys):
    err = capsys.readouterr().err
    assert err.startswith("flexcage: ") and err.endswith("\n"), err
    text = err.removeprefix("flexcage: ").rstrip("\n")
    assert "\n" not in text and text.endswith("."), err
    assert "Traceback" not in err
    return text


MISTAKES = {
    "no file": (["run", "none.toml"], ["no case file 'none.toml'"]),
    "a folder": (["run", "."], ["is a folder"]),
    "no unit": (["run", EXAMPLE, "--set", "load.radial=1000"], ["load.radial", "'1000 N'"]),
    "wrong unit": (["run", EXAMPLE, "--set", "load.radial=1 kg"], ["another kind"]),
    "unknown path": (["run", EXAMPLE, "--set", "load.radail=1 N"], ["'radial'"]),
    "unknown room": (["run", EXAMPLE, "--set", "laod.radial=1 N"], ["'load'"]),
    "no value": (["run", EXAMPLE, "--set", "load.radial"], ["path=value"]),
    "no such defect": (
        ["run", EXAMPLE, "--set", "defects.1.displacement=0.1 mm"],
        ["defects has no entry '1'", "0 to 0"],
    ),
    "no defect at all": (
        ["run", BALLS, "--set", "defects.0.displacement=0.1 mm"],
        ["there are none, and the case must have [[defects]] first"],
    ),
    "times that fall": (
        [
            "run",
            EXAMPLE,
            "--set",
            'load.times=["0 s","5 ms","2 ms"]',
            "--set",
            'load.values=["1 N","2 N","3 N"]',
        ],
        ["entry 2 is 0.002 s, after 0.005 s; sort the table, with its values"],
    ),
    "overlap": (["run", EXAMPLE, "--set", "bearing.roller_count=33"], ["33 rollers", "overlap"]),
    "wide pocket": (["mesh", EXAMPLE, "--set", "cage.pocket_width=12 mm"], ["thinner than zero"]),
    "narrow pocket": (["modes", EXAMPLE, "--set", "cage.pocket_width=7 mm"], ["-1 mm"]),
    "big defect": (["run", EXAMPLE, "--set", "defects.0.displacement=2 mm"], ["assembly"]),
    "mesh format": (["mesh", EXAMPLE, "-o", "cage.stl"], ["'cage.stl' should end in .msh"]),
    "mesh folder": (["mesh", EXAMPLE, "-o", "none/cage.msh"], ["no folder 'none'", "make it"]),
    "other preset": (
        ["run", EXAMPLE, "--set", "bearing.preset=N1014"],
        ["'N1014'", "presets are", "N1013"],
    ),
    "preset": (["presets", "N1014"], ["'N1014' is not known", "presets are", "N1013"]),
    "drill": (["run", EXAMPLE, "--set", "drive.speed=6000000 rpm"], ["centrifugal"]),
    "clearance": (["run", EXAMPLE, "--set", "bearing.radial_clearance=5 mm"], ["0.4 mm"]),
    "overload": (["run", EXAMPLE, "--set", "load.radial=500 kN"], ["4 times", "51 kN"]),
    "no run": (["render", "nothing"], ["no folder 'nothing'; name the folder of a run"]),
    "three to compare": (
        ["compare", "a", "b", "c"],
        ["one case", "or two run folders", "given a b c"],
    ),
    "one run to compare": (["compare", "."], ["one case", "two run folders", "given ."]),
    "compare no run": (["compare", "a", "b"], ["no folder 'a'; name the folder of a run"]),
    "nothing to resume": (["run", EXAMPLE, "-o", "nothing", "--resume"], ["not the folder of a"]),
}


@pytest.fixture
def folders(elsewhere):
    """A run, a study, a comparison and a run that has not begun, by their names; and two files."""
    for name in ("runs/good/results.zarr", "runs/other/results.zarr", "both/rigid/results.zarr",
                 "study/cases", "begun", "lost", "packed"):  # fmt: skip
        (elsewhere / name).mkdir(parents=True)
    for name in ("study/study.toml", "both/compare.json", "begun/case.toml", "mine.toml", "a.png",
                 "x.nc", "lost/summary.json", "runs/good/summary.json", "packed/summary.json",
                 "packed/results.zarr.zip"):  # fmt: skip
        (elsewhere / name).write_text("")


ORDERS = {
    "case before command": ["mine.toml", "run"],
    "run before command": ["runs/good"],
    "quiet after it": ["static", "-q", "mine.toml"],
    "spaces in --set": ["run", "mine.toml", "--set", "load.radial", "=", "5 N"],
    "a unit apart": ["run", "mine.toml", "--set", "load.radial=5", "N"],
    "a key as an option": ["run", "mine.toml", "--speed", "6000"],
    "hours in words": ["wear", "runs/good", "--hours", "ten"],
    "rows of none": ["fatigue", "runs/good", "--rows", "0"],
    "no instants": ["export", "runs/good", "--table", "a.csv", "--count", "0"],
    "a count as a float": ["export", "runs/good", "--table", "a.csv", "--count", "1e3"],
}
ORDERS_SAY = {
    "case before command": "the command comes first, as in: flexcage run mine.toml",
    "run before command": "the command comes first, as in: flexcage report runs/good",
    "quiet after it": "-q stands before the command: flexcage -q ...",
    "spaces in --set": '--set takes one word, as --set "load.radial=500 N"',
    "a unit apart": '--set takes one word, as --set "load.radial=500 N"',
    "a key as an option": "a value of the case is changed by --set PATH=VALUE",
    "hours in words": "'ten' should be a number, as 1.5",
    "rows of none": "'0' should be a whole number, 1 or more",
    "no instants": "'0' should be a whole number, 1 or more",
    "a count as a float": "'1e3' should be a whole number, 1 or more",
}


@pytest.mark.parametrize("name", ORDERS)
def test_words_in_a_wrong_order_are_told_the_right_one(name, capsys, folders):
    with pytest.raises(SystemExit) as left:
        cli.main(ORDERS[name])
    assert left.value.code == 2 and ORDERS_SAY[name] in (text := sentence(capsys)), text


BRACKETS = {
    "one for many": ("[defects]\ntype = 'crack'", "write [[defects]] in place of [defects]."),
    "many for one": ("[[cage]]\nmaterial = 'PEEK'", "write [cage] in place of [[cage]]."),
}


@pytest.mark.parametrize("name", BRACKETS)
def test_brackets_of_another_number(name, capsys, elsewhere):
    text, words = BRACKETS[name]
    (elsewhere / "mine.toml").write_text(f'[bearing]\npreset = "N1013"\n{text}\n')
    assert cli.main(["run", "mine.toml"]) == 2
    assert words in (said := sentence(capsys)), said


WRONG_KEYS = {
    "at the root": ("speed = '6000 rpm'", "'speed'; it stands in a section, as drive.speed."),
    "two sections": (
        "radial_clearance = '10 um'",
        "it stands in a section, as bearing.radial_clearance",
    ),
    "a preset": ("bearing = 'N1013'", 'a preset is named as bearing.preset = "N1013".'),
}


@pytest.mark.parametrize("name", WRONG_KEYS)
def test_keys_out_of_place_are_told_their_place(name, capsys, elsewhere):
    line, words = WRONG_KEYS[name]
    more = "" if name == "a preset" else '[bearing]\npreset = "N1013"\n'
    (elsewhere / "mine.toml").write_text(f"{line}\n{more}")
    assert cli.main(["run", "mine.toml"]) == 2
    assert words in (text := sentence(capsys)), text
    setting = line.replace(" = ", "=").replace("'", "")
    assert cli.main(["run", EXAMPLE, "--set", setting]) == 2
    assert words in (text := sentence(capsys)), text


def test_a_study_is_called_one(capsys, elsewhere):
    (elsewhere / "s.toml").write_text(f'case = "{EXAMPLE}"\n')
    assert cli.main(["study", "run", "s.toml"]) == 2
    assert sentence(capsys).startswith("The study lacks 'outputs'")


WRONG_FOLDERS = {
    "a case": (["render", "mine.toml"], "a file, of which 'flexcage run mine.toml' makes one"),
    "a picture": (["wear", "a.png"], "'a.png' is not the folder of a run: it is a file."),
    "a store": (["report", "runs/good/results.zarr"], "lies in that folder; name 'runs/good'"),
    "a file of a run": (["wear", "runs/good/summary.json"], "in that folder; name 'runs/good'"),
    "a netCDF": (["report", "x.nc"], "it is netCDF, which flexcage writes for other programs"),
    "a folder of runs": (["fatigue", "runs"], "it holds 'runs/good', 'runs/other'; name one of"),
    "a study": (["export", "study"], "it is that of a study, whose runs are in 'study/cases'"),
    "a comparison": (["report", "both"], "it is that of a comparison, whose runs are 'both/rigid'"),
    "a run not begun": (["render", "begun"], "its run has not come to its first results"),
    "a run without its arrays": (["wear", "lost"], "is gone; bring it back from a copy"),
    "a packed run": (["report", "packed"], "is gone; unpack 'packed/results.zarr.zip' there"),
    "a run misspelt": (["wear", "runs/goood"], "the nearest one there is 'runs/good'"),
    "no ending": (["run", "mine"], "no case file 'mine'; the nearest one there is 'mine.toml'"),
    "no folder": (["run", "nowhere/mine.toml"], "there is no folder 'nowhere'"),
    "a run as a study": (["study", "resume", "runs/good"], "it is that of a run"),
    "a case as a study": (["study", "status", "mine.toml"], "'flexcage study run mine.toml' makes"),
    "no study": (["study", "run", "mne.toml"], "no study file 'mne.toml'; the nearest one there"),
    "no extension": (["run", "mine.toml", "--use", "law.py"], "There is no file 'law.py'; --use"),
}  # fmt: skip


@pytest.mark.parametrize("name", WRONG_FOLDERS)
def test_a_path_of_another_kind_is_told_what_it_is(name, capsys, folders):
    argv, words = WRONG_FOLDERS[name]
    assert cli.main(argv) == 2
    assert words in (text := sentence(capsys)), text


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes_in_the_input_exit_with_2(name, capsys, no_simulation):
    no_simulation.simulate = no_simulation.cage_modes = no_simulation.load_run = None
    argv, words = MISTAKES[name]
    assert cli.main(argv) == 2
    text = sentence(capsys)
    assert all(word in text for word in words), text


MISTYPED = [
    (["run", EXAMPLE, "--cage", "wooden"], ["--cage 'wooden'", "choose from", "flexcage run --h"]),
    (["run", EXAMPLE, "--rsume"], ["run has no option --rsume", "'--resume'", "flexcage run --h"]),
    (["rnu", EXAMPLE], ["COMMAND 'rnu'", "'run'", "'flexcage --help'"]),
    (["study", "rum", EXAMPLE], ["ACTION 'rum'", "'run'", "'flexcage study --help'"]),
    (["wear", "one", "two"], ["wear takes no 'two' here", "'flexcage wear --help'"]),
]


@pytest.mark.parametrize(("argv", "words"), MISTYPED)
def test_mistyped_commands_and_options_exit_with_2(argv, words, capsys):
    with pytest.raises(SystemExit) as caught:
        cli.main(argv)
    assert caught.value.code == 2
    text = sentence(capsys)
    assert all(word in text for word in words), text


def test_an_existing_folder_is_refused(elsewhere, capsys):
    out = elsewhere / "mine"
    out.mkdir()
    (out / "thesis.tex").write_text("precious")
    assert cli.main(["run", EXAMPLE, "-o", str(out)]) == 2
    text = sentence(capsys)
    assert "exists already" in text and "--resume" in text and "--force" in text
    assert cli.main(["run", EXAMPLE, "-o", str(out), "--force"]) == 2
    assert "did not write" in sentence(capsys)
    assert (out / "thesis.tex").read_text() == "precious"


def test_compare_offers_only_what_it_can(elsewhere, capsys):
    (elsewhere / "mine").mkdir()
    (elsewhere / "mine" / "notes.txt").write_text("precious")
    assert cli.main(["compare", EXAMPLE, "-o", "mine"]) == 2
    text = sentence(capsys)
    assert "--force" in text and "--resume" not in text


def test_runs_are_compared_under_runs_and_again_without_force(elsewhere, capsys, monkeypatch):
    """Where the folder holds a comparison alone; anything else stays."""
    import flexcage.study.compare as room

    told = []

    class Found:
        def text(self, *, every):
            return "every figure" if every else "ten figures"

    monkeypatch.setattr(room, "compare", lambda *runs, out: told.append((runs, out)) or Found())
    for name in ("one", "two"):
        (elsewhere / name / "cases" / "7" / "results.zarr").mkdir(parents=True)
    command = ["compare", "one/cases/7", "two/cases/7"]
    out = Path("runs/one-cases-7-two-cases-7-compare")
    assert cli.main(command) == 0
    assert told == [((Path("one/cases/7"), Path("two/cases/7")), out)]
    assert "ten figures" in capsys.readouterr().out
    (out / "mine.txt").write_text("precious")
    assert cli.main(command) == 2, "no comparison of ours"
    (out / "compare.json").write_text("{}")
    assert cli.main([*command, "--all"]) == 0
    assert "every figure" in capsys.readouterr().out
    (out / "rigid").mkdir()
    assert cli.main(command) == 2 and (out / "mine.txt").read_text() == "precious"
    assert cli.main([*command, "--set", "load.radial=1 N"]) == 2
    assert "--set belongs to a case" in capsys.readouterr().err


def test_a_run_is_not_compared_with_itself(elsewhere, capsys):
    assert cli.main(["compare", "runs/a", "./runs/a"]) == 2
    assert "was given 'runs/a' twice; name two runs" in sentence(capsys)


def test_force_replaces_a_former_run(elsewhere):
    out = elsewhere / "run"
    (out / "results.zarr").mkdir(parents=True)
    (out / "old.png").write_text("")
    prepare_out(out, resume=False, force=True)
    assert list(out.iterdir()) == []


def test_a_file_in_the_way(elsewhere, capsys):
    (elsewhere / "out").write_text("")
    assert cli.main(["run", EXAMPLE, "-o", "out"]) == 2
    assert "is a file" in sentence(capsys)


@pytest.mark.parametrize("command", ["run", "converge", "mesh"])
def test_a_path_that_is_too_long(elsewhere, capsys, command):
    ending = ".vtu" if command == "mesh" else ""
    assert cli.main([command, EXAMPLE, "-o", 5000 * "a" + ending]) == 2
    said = sentence(capsys)
    assert "is too long for this machine" in said and len(said) < 300


def test_a_folder_that_cannot_be_written(elsewhere, capsys, monkeypatch):
    def refuse(*args, **kwargs):
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(Path, "mkdir", refuse)
    assert cli.main(["run", EXAMPLE, "-o", "locked/run"]) == 2
    assert "cannot be written (permission denied)" in sentence(capsys)


@pytest.mark.skipif(not hasattr(os, "geteuid") or os.geteuid() == 0, reason="root may write")
def test_a_read_only_folder(elsewhere, capsys):
    (elsewhere / "locked").mkdir(mode=0o500)
    assert cli.main(["run", EXAMPLE, "-o", "locked/run"]) == 2
    assert "cannot be written" in sentence(capsys)


def test_no_traceback_from_a_real_process(elsewhere):
    done = subprocess.run(
        [sys.executable, "-m", "flexcage.cli", "run", EXAMPLE, "--set", "drive.speed=6000"],
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 2
    assert done.stderr == (
        "flexcage: drive.speed is 6000 without a unit; write it with one, such as '6000 rpm'.\n"
    )


def test_the_package_runs_as_a_module():
    """``python -m flexcage`` is the console script, exit codes included."""
    argv = [sys.executable, "-m", "flexcage", "presets"]
    done = subprocess.run([*argv, "N1013"], capture_output=True, text=True, check=False)
    assert done.returncode == 0 and "Cylindrical roller bearing N1013" in done.stdout
    done = subprocess.run([*argv, "N1014"], capture_output=True, text=True, check=False)
    assert done.returncode == 2 and done.stderr.startswith("flexcage: ")


def test_mesh_may_be_called_again_and_again(elsewhere, capsys):
    """Its own files are written anew; those of others, or that another program changed, are not."""
    argv = ["mesh", EXAMPLE, "--set", "mesh.fineness=coarse", "-o", "cage.msh"]
    assert cli.main(argv) == 0
    first = (elsewhere / "cage.msh").read_bytes()
    assert cli.main([*argv, "--set", "defects=[]"]) == 0
    assert (elsewhere / "cage.msh").read_bytes() != first
    capsys.readouterr()
    for name in ("cage.msh", "cage.vtu"):
        own = (elsewhere / name).read_bytes()
        (elsewhere / name).write_bytes(own + b"\n")
        assert cli.main(argv) == 2
        assert f"'{name}' exists already; --force" in sentence(capsys)
        assert (elsewhere / name).read_bytes() == own + b"\n"
        (elsewhere / name).write_bytes(own)
    (elsewhere / "cage.vtu").write_text("another's")
    assert cli.main([*argv, "--force"]) == 0
