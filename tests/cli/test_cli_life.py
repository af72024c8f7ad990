"""flexcage fatigue and flexcage wear on a stored run."""

import pytest

from flexcage.cli import main
from flexcage.simulate import simulate
from flexcage.verification.runs import n1013


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("runs") / "rigid"
    changes = {"start.push": "200 mm/s", "solver.duration": "2 ms", "cage.model": "rigid"}
    simulate(n1013(changes), out=out)
    return str(out)


def test_wear_prints_its_table(folder, capsys):
    assert main(["wear", folder, "--coefficient", "1e-8 mm^3/(N*m)", "--hours", "100"]) == 0
    said = capsys.readouterr().out
    assert "um in 100 h" in said and "k = 1e-08 mm^3/(N m)" in said and "source: the user" in said
    assert main(["wear", folder, "--coefficient", "1e-8"]) == 2
    assert "without a unit" in capsys.readouterr().err


def test_fatigue_of_a_rigid_cage_is_one_sentence(folder, capsys):
    assert main(["fatigue", folder]) == 2
    assert "a rigid cage has no stress" in capsys.readouterr().err
