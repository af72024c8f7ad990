"""A bearing's stiffness over speed and load, for rotor programs."""

from pathlib import Path

import numpy as np
import pytest

from flexcage import load_static, solve_static
from flexcage.core.errors import EnvironmentLacks, InputError
from flexcage.study import stiffness_table

EXAMPLES = Path(__file__).parents[2] / "examples"


@pytest.fixture(scope="module")
def case():
    return load_static(EXAMPLES / "c7010_static.toml")


@pytest.fixture(scope="module")
def table(case):
    return stiffness_table(
        case, speeds=["2000 rpm", "9000 rpm"], radial=[50.0, 150.0], axial=["200 N", "400 N"]
    )


def test_entries_are_those_of_static_solutions(case, table):
    values = {"load.radial": "150 N", "load.axial": "200 N", "drive.speed": "9000 rpm"}
    wanted = solve_static(case.replace(values, si=False))
    assert table.stiffness.shape == (2, 2, 2, 5, 5) and not table.failed
    assert table.stiffness[1, 0, 1] == pytest.approx(wanted.stiffness, rel=1e-12)
    assert table.at(radial=150.0, axial=200.0)[1] == pytest.approx(wanted.stiffness, rel=1e-12)
    middle = table.at(radial=100.0, axial=200.0)
    assert middle == pytest.approx(0.5 * (table.stiffness[0, 0] + table.stiffness[1, 0]))
    k = table.ross_coefficients(radial=150.0, axial=200.0)
    assert k["kxx"][1] == wanted.stiffness[1, 1] and k["kzz"][1] == wanted.stiffness[0, 0]
    assert k["kxy"][1] == wanted.stiffness[1, 2]


def test_a_load_that_cannot_be_borne_is_a_gap_with_a_reason(case, tmp_path):
    found = stiffness_table(case, speeds=["2000 rpm"], axial=["-100 N", "300 N"])
    assert list(found.failed) == [(0, 0, 0)] and "cannot bear this load" in found.failed[0, 0, 0]
    assert np.isnan(found.stiffness[0, 0]).all()
    with pytest.raises(InputError, match="no stiffness at these loads and every speed"):
        found.at(axial=0.0)
    assert np.isfinite(found.at(axial=300.0)).all()
    found.to_csv(tmp_path / "k.csv")
    head, gap, row = (tmp_path / "k.csv").read_text("utf-8").splitlines()
    assert head.split(",")[3] == "k_x_x" and gap.endswith(",,") and len(row.split(",")) == 28
    assert float(row.split(",")[3]) == pytest.approx(found.stiffness[0, 1, 0, 0, 0], rel=1e-8)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"radial": 200.0, "axial": 200.0}, "radial is 200 N, but the table goes from 50 N to 150"),
        ({"radial": 100.0}, "axial is not given, but the table goes from 200 N to 400 N"),
    ],
)
def test_loads_outside_the_table_are_refused(table, asked, words):
    with pytest.raises(InputError, match=words):
        table.at(**asked)


def test_values_must_rise(case):
    with pytest.raises(InputError, match="speeds should be one value or more"):
        stiffness_table(case, speeds=["9000 rpm", "2000 rpm"])


def test_ross_takes_the_table(table):
    try:
        import ross
    except Exception:
        with pytest.raises(EnvironmentLacks, match="ROSS is"):
            table.to_ross(3, radial=100.0, axial=300.0)
        return
    element = table.to_ross(3, damping=10.0, radial=100.0, axial=300.0)
    assert isinstance(element, ross.BearingElement) and element.n == 3
    k = table.ross_coefficients(radial=100.0, axial=300.0)
    assert element.kxx == pytest.approx(k["kxx"]) and element.kyx == pytest.approx(k["kyx"])
