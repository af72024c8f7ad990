"""A case's reduced cage on the command line: out, and in again."""

from __future__ import annotations

import csv
from pathlib import Path

import numpy as np
import pytest

from flexcage import cli
from flexcage.case import load_case
from flexcage.case.description import in_words
from flexcage.core.errors import InputError
from flexcage.modes.exchange import read_body
from flexcage.simulate import simulate
from flexcage.stages import cage_mesh
from flexcage.study.converge import levels

EXAMPLE = str(Path(__file__).parents[2] / "examples" / "n1013.toml")
COARSE = ["--set", "mesh.fineness=coarse"]


def frequencies(path):
    with open(path, newline="") as file:
        return [float(row["frequency [Hz]"]) for row in csv.DictReader(file)]


def test_out_and_in_again(tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert cli.main(["export", EXAMPLE, *COARSE, "-o", "cage.npz"]) == 0
    assert "written: cage.npz" in capsys.readouterr().out
    assert cli.main(["modes", EXAMPLE, *COARSE, "-o", "own.csv"]) == 0
    capsys.readouterr()
    given = ["--set", "modes.body=cage.npz"]
    assert cli.main(["modes", EXAMPLE, *COARSE, *given, "-o", "given.csv"]) == 0
    before, after = capsys.readouterr().out.split("As the cage of this case:")
    assert frequencies("given.csv") == frequencies("own.csv")
    first = f"{frequencies('own.csv')[0]:9.1f} Hz"
    assert first in before and first in after
    assert "264 of them quasi-static" in before
    # as it was written, with a path from the case's own folder
    (tmp_path / "case.toml").write_text(
        Path(EXAMPLE).read_text() + '\n[modes]\nbody = "cage.npz"\n[mesh]\nfineness = "coarse"\n'
    )
    case = load_case(tmp_path / "case.toml")
    assert case.modes.body == str(tmp_path / "cage.npz")
    assert f"its stiffness and modes those of {tmp_path / 'cage.npz'}" in " ".join(in_words(case))
    with pytest.raises(InputError, match="modes are those of modes.body, so axis 'modes' does not"):
        levels(case, ["modes"])
    named = case.hash
    (tmp_path / "cage.npz").write_bytes((tmp_path / "cage.npz").read_bytes() + b" ")
    assert load_case(tmp_path / "case.toml").hash != named  # the file counts by its bytes


MISTAKES = {
    "an mnf": (
        ["modes", EXAMPLE, *COARSE, "--set", "modes.body={}/cage.mnf"],
        "modal neutral file",
    ),
    "no file": (["modes", EXAMPLE, *COARSE, "--set", "modes.body=none.npz"], "There is no file"),
    "other units": (["modes", EXAMPLE, "--set", "modes.body_units=cm-g-s"], "body_units"),
    "a run's option": (["export", EXAMPLE, "--count", "3"], "--count belongs to a run"),
    "a case's option": (["export", "runs/none", "--full"], "--full belongs to a case"),
    "another ending": (["export", EXAMPLE, "-o", "cage.vtu"], "should end in .npz or .op4"),
    "text": (["export", EXAMPLE, "--text", "-o", "cage.npz"], "--text is for an .op4"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_mistakes_are_told_in_one_sentence(name, tmp_path, capsys, monkeypatch):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "cage.mnf").write_bytes(b"?")
    arguments, words = MISTAKES[name]
    assert cli.main([a.format(tmp_path) for a in arguments]) == 2
    err = capsys.readouterr().err
    assert words in err and err.count("\n") == 1 and err.startswith("flexcage: "), err


def test_full_matrices(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    linear = ["--set", "mesh.order=1"]
    assert cli.main(["export", EXAMPLE, *COARSE, *linear, "--full", "-o", "full.npz"]) == 0
    body = read_body("full.npz")
    assert body.is_full
    whole = body.rigid.T @ (body.mass @ body.rigid)
    case = load_case(EXAMPLE, overrides={"mesh.fineness": "coarse"})
    mass = case.cage.material.density * cage_mesh(case).volume
    np.testing.assert_allclose(np.diag(whole)[:3], mass, rtol=1e-9)


@pytest.mark.slow
def test_a_run_with_the_file_is_the_run_without(tmp_path, monkeypatch):
    """Ritz basis with residual flexibility through an .op4: every sample the same to the bit."""
    pytest.importorskip("pyyeti")
    monkeypatch.chdir(tmp_path)
    assert cli.main(["export", EXAMPLE, *COARSE, "-o", "cage.op4"]) == 0
    case = load_case(EXAMPLE, overrides={"mesh.fineness": "coarse", "solver.duration": "1 ms"})
    given = case.replace("modes.body", str(tmp_path / "cage.op4"))
    assert case.hash != given.hash
    own, other = (simulate(c).dataset for c in (case, given))
    assert set(own) == set(other)
    for name in own:
        np.testing.assert_array_equal(own[name].values, other[name].values, err_msg=name)
